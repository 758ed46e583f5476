"""Writing the files of a report: the page, the rows, timings and provenance apart, and the figures.

`rows.json`, `rows.csv`, the figures and the page hold only what was compared: the same code on the same machine writes
the same bytes. How long it took, and which results came from the cache, is in `timings.json`; when and on which machine
it ran, in `provenance.json`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from reference.comparison.results import JobResult
from reference.published.results import PublishedResult
from reference.report import figures, page
from reference.report.first_screen import findings
from reference.report.provenance import compared, engine_versions, machine, provenance
from reference.report.published import page as published_page
from reference.report.published.figures import oblique_impacts
from reference.report.published.tables import PublishedTables
from reference.report.replays import replay_of
from reference.report.row_files import as_json, published_json, rows_csv, rows_json, run_of
from reference.report.sections import Section, sections
from reference.report.staging import PAGE

PUBLISHED_PAGE = "published.html"
TIMINGS, PROVENANCE = "collisions-lab/timings", "collisions-lab/provenance"
IMPACTS = "P11"
"""The published case that has figures."""
STUDY_CAPTION = "Error against timestep."


def write(results: Iterable[JobResult], folder: Path, published: Iterable[PublishedResult] = ()) -> None:
    """Write all files of a report into a folder; those of published cases only where there are any."""
    others = list(published)
    found = sections(results)
    ordered = [line.result for section in found for line in section.lines]
    drawn = {section.family.name: _figures(section) for section in found}
    (folder / "figures").mkdir()
    in_page = {name: _write_figures(pictures, folder) for name, pictures in drawn.items()}
    _write(folder / "rows.json", rows_json(ordered))
    _write(folder / "rows.csv", rows_csv(ordered))
    _write(folder / "timings.json", as_json(TIMINGS, {"seconds": [_timing(result) for result in ordered]}))
    _write(folder / "provenance.json", as_json(PROVENANCE, provenance(engine_versions(ordered))))
    address = PUBLISHED_PAGE if others else ""
    replays = {section.family.name: clip for section in found if (clip := replay_of(section)) is not None}
    first = {finding.family for finding in findings(found)}
    small = {section.family.name: _glance(section) for section in found if section.family.name in first}
    _write(folder / PAGE, page.render(found, in_page, compared(ordered), machine(), address, replays, small))
    if others:
        _write_published(others, folder)


def _write_published(results: Sequence[PublishedResult], folder: Path) -> None:
    """The page of published cases and their rows."""
    tables = PublishedTables.of(results)
    impacts = next((line for line in tables.lines if line.case.name == IMPACTS), None)
    in_page = {IMPACTS: _write_figures(oblique_impacts(impacts) if impacts else [], folder)}
    _write(folder / "published.json", published_json(tables.rows))
    ordered = [cell.result for name in tables.engines for line in tables.lines if (cell := line.cells.get(name))]
    _write(folder / PUBLISHED_PAGE, published_page.render(tables, in_page, compared(ordered), machine(), PAGE))


def _figures(section: Section) -> list[tuple[str, str, str]]:
    """Name, SVG and caption of the family's figures."""
    family = section.family
    pictures = [
        (f"{family.name}-trajectories", figures.trajectories(section), f"{family.curve.title}: all implementations."),
        (f"{family.name}-convergence", figures.convergence(section), STUDY_CAPTION),
    ]
    return [picture for picture in pictures if picture[1]]


def _glance(section: Section) -> tuple[str, str]:
    """The small picture of a family, and what it shows."""
    return figures.glance(section), f"{section.family.curve.title}: {section.family.curve.y_label} against time."


def _write_figures(pictures: Iterable[tuple[str, str, str]], folder: Path) -> list[tuple[str, str]]:
    """Write figures to files of their own, and return SVG and caption of each for the page."""
    in_page = []
    for name, svg, caption in pictures:
        _write(folder / "figures" / f"{name}.svg", svg)
        in_page.append((svg, caption))
    return in_page


def _timing(result: JobResult) -> dict[str, Any]:
    return run_of(result) | {"seconds": round(result.seconds, 3), "cached": result.cached}


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")
