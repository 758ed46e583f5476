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
from reference.report import drawing, page
from reference.report.agreement import pairs_csv
from reference.report.drawing import Drawing
from reference.report.first_screen import findings
from reference.report.provenance import compared, engine_versions, machine, provenance
from reference.report.published import page as published_page
from reference.report.published.tables import PublishedCell, PublishedTables
from reference.report.replays import replay_of
from reference.report.row_files import as_json, published_json, rows_csv, rows_json, run_of
from reference.report.sections import Section, sections
from reference.report.staging import PAGE
from reference.running.cache import Cache

PUBLISHED_PAGE = "published.html"
TIMINGS, PROVENANCE = "collisions-lab/timings", "collisions-lab/provenance"
IMPACTS = "P11"
"""The published case that has figures."""
STUDY_CAPTION = "Error against timestep."


def write(
    results: Iterable[JobResult],
    folder: Path,
    published: Iterable[PublishedResult] = (),
    cache: Cache | None = None,
    workers: int = 1,
    unfinished: str = "",
) -> None:
    """Write all files of a report into a folder; those of published cases only where there are any.

    cache: where figures are kept. workers: how many are drawn at a time. unfinished: what the pages and the rows say of
    themselves while runs have not ended.
    """
    tables = PublishedTables.of(published)
    found = sections(results)
    ordered = [line.result for section in found for line in section.lines]
    pairs = [pair for section in found for pair in section.pairs]
    in_page = _figures(found, tables, folder, cache, workers)
    _write(folder / "rows.json", rows_json(ordered, pairs, unfinished))
    _write(folder / "rows.csv", rows_csv(ordered))
    _write(folder / "pairs.csv", pairs_csv(pairs))
    _write(folder / "timings.json", as_json(TIMINGS, {"seconds": [_timing(result) for result in ordered]}))
    _write(folder / "provenance.json", as_json(PROVENANCE, provenance(engine_versions(ordered))))
    address = PUBLISHED_PAGE if tables.lines else ""
    replays = {section.family.name: clip for section in found if (clip := replay_of(section)) is not None}
    small = _small(found, cache)
    whole = page.render(found, in_page, compared(ordered), machine(), address, replays, small, unfinished)
    _write(folder / PAGE, whole)
    if tables.lines:
        _write(folder / "published.json", published_json(tables.rows, unfinished))
        versions = compared([cell.result for name in tables.engines for cell in _cells(tables, name)])
        of_cases = {IMPACTS: in_page[IMPACTS]}
        whole = published_page.render(tables, of_cases, versions, machine(), PAGE, unfinished)
        _write(folder / PUBLISHED_PAGE, whole)


def _cells(tables: PublishedTables, engine: str) -> list[PublishedCell]:
    """The cells of one engine."""
    return [cell for line in tables.lines if (cell := line.cells.get(engine))]


def _figures(
    found: Sequence[Section], tables: PublishedTables, folder: Path, cache: Cache | None, workers: int
) -> dict[str, list[tuple[str, str]]]:
    """Write figures to files of their own, and return SVG and caption of each, by family or published case."""
    impacts = next((line for line in tables.lines if line.case.name == IMPACTS), None)
    wanted: dict[str, list[Drawing]] = {IMPACTS: drawing.of_impacts(impacts) if impacts else []}
    wanted |= {section.family.name: drawing.of_section(section, STUDY_CAPTION) for section in found}
    every = [each for drawings in wanted.values() for each in drawings]
    names = [each.name for each in every]
    svgs = dict(zip(names, drawing.drawn(every, cache, workers), strict=True))
    (folder / "figures").mkdir()
    for name, svg in svgs.items():
        _write(folder / "figures" / f"{name}.svg", svg)
    return {name: [(svgs[each.name], each.caption) for each in drawings] for name, drawings in wanted.items()}


def _small(found: Sequence[Section], cache: Cache | None) -> dict[str, tuple[str, str]]:
    """By family, the small picture of each finding on the first screen, and what it shows."""
    first = {finding.family for finding in findings(found)}
    sections_of_first = [section for section in found if section.family.name in first]
    pictures = [drawing.at_a_glance(section) for section in sections_of_first]
    svgs = drawing.drawn(pictures, cache)
    names = [section.family.name for section in sections_of_first]
    return {name: (svg, each.caption) for name, svg, each in zip(names, svgs, pictures, strict=True)}


def _timing(result: JobResult) -> dict[str, Any]:
    used = {"seconds": round(result.seconds, 3), "processor_seconds": round(result.processor_seconds, 3)}
    return run_of(result) | used | {"cached": result.cached}


def _write(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8", newline="\n")
