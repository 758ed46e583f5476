"""Figures as plain data until they are drawn: taken from the cache, or drawn here or in worker processes."""

from __future__ import annotations

import importlib.metadata
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job, JobResult
from reference.published.results import PublishedResult
from reference.published.theirs import published
from reference.report import figures, small_pictures
from reference.report.published.figures import PANELS, oblique_impact
from reference.report.published.tables import PublishedCell, PublishedLine
from reference.report.sections import Line, Section
from reference.running import sources
from reference.running.cache import Cache, key
from reference.running.jobs import each_isolated
from reference.running.shelf import FIGURE, sealed, unsealed

SCHEMA = "collisions-lab figure 1\n"
FEW = 4
"""So many figures are drawn here: a worker process would first have to import matplotlib."""
_CODE = re.compile(r"<script|<foreignobject|javascript:|\son\w+\s*=", re.IGNORECASE)
"""What none of our figures holds. One from the cache goes into the page as it is, and must not run anything there."""


@dataclass(frozen=True)
class Drawing:
    """A figure that is still to be drawn: plain data, which pickles.

    name: of its file. caption: below it. draw: a function at module level. shown: all that the figure depends on.
    """

    name: str
    caption: str
    draw: Callable[..., str]
    shown: tuple[Any, ...]

    def __call__(self) -> str:
        """The SVG; empty where there is nothing to draw."""
        return self.draw(*self.shown)


def of_section(section: Section, study_caption: str) -> list[Drawing]:
    """The figures of a family."""
    name, title = section.family.name, section.family.curve.title
    curves = tuple(_only(line.result, "series") for line in section.lines if line.result.series is not None)
    studies = tuple(_only(line.result, "convergence") for line in section.studied)
    found = [
        Drawing(f"{name}-trajectories", f"{title}: all implementations.", _trajectories, curves),
        Drawing(f"{name}-convergence", study_caption, _convergence, studies),
    ]
    return [drawing for drawing in found if drawing.shown]


def at_a_glance(section: Section) -> Drawing:
    """The small picture of a family: what counts, and what is plain."""
    lines = [line for line in section.lines if (line.counts or line.plain) and line.result.series is not None]
    shown = tuple(_only(line.result, "series") for line in lines)
    return Drawing(f"{section.family.name}-glance", small_pictures.in_words(section), _glance, shown)


def of_impacts(line: PublishedLine) -> list[Drawing]:
    """The figures of the published impacts."""
    results = tuple(replace(cell.result, answers={}, seconds=0.0, cached=False) for cell in line.cells.values())
    return [Drawing(panel.name, panel.caption, _impact, (place, *results)) for place, panel in enumerate(PANELS)]


def drawn(drawings: Sequence[Drawing], cache: Cache | None = None, workers: int = 1) -> list[str]:
    """The SVG of each figure."""
    keys = _keys(drawings) if cache else []
    found = {name: text for name in keys if cache and (text := _read(cache, name)) is not None}
    missing = [place for place in range(len(drawings)) if not keys or keys[place] not in found]
    calls = [drawings[place] for place in missing]
    texts = each_isolated(_call, calls, workers) if len(calls) > FEW and workers > 1 else [each() for each in calls]
    new = dict(zip(missing, texts, strict=True))
    if cache:
        for place, text in new.items():
            cache.keep(f"{keys[place]}{FIGURE}", sealed(SCHEMA, text.encode()))
    return [new[place] if place in new else found[keys[place]] for place in range(len(drawings))]


def _keys(drawings: Sequence[Drawing]) -> list[str]:
    """A hash for each figure of all that it depends on."""
    made_by = [SCHEMA, sources.digest("reference"), importlib.metadata.version("matplotlib")]
    return [key([*made_by, drawing.name, repr(drawing.shown)]) for drawing in drawings]


def _read(cache: Cache, name: str) -> str | None:
    content = None if cache.fresh else cache.read(f"{name}{FIGURE}")
    body = unsealed(SCHEMA, content) if content is not None else None
    text = body.decode(errors="replace") if body is not None else ""
    return text if text.startswith("<svg") and not _CODE.search(text) else None


def _call(drawing: Drawing) -> str:
    return drawing()


def _only(result: JobResult, name: str) -> JobResult:
    """A result with nothing but one of its curves."""
    job = Job(result.job.family, result.job.engine, result.job.profile)
    return JobResult(job, result.title, "", (), **{name: getattr(result, name)})


def _section(results: Sequence[JobResult]) -> Section:
    family = catalogue()[results[0].job.family]
    return Section(family, tuple(Line(result, family) for result in results))


def _trajectories(*results: JobResult) -> str:
    return figures.trajectories(_section(results))


def _convergence(*results: JobResult) -> str:
    return figures.convergence(_section(results))


def _glance(*results: JobResult) -> str:
    return small_pictures.picture(_section(results)) if results else ""


def _impact(place: int, *results: PublishedResult) -> str:
    cells = {result.job.engine: PublishedCell(result) for result in results}
    return oblique_impact(PublishedLine(published(results[0].job.case), cells), place)
