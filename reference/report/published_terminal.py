"""Published cases as three tables in the terminal, one line a case, or every number."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table
from rich.text import Text

from reference.compare import Verdict
from reference.published.judging import PublishedRow
from reference.report import numbers
from reference.report.published_summary import (
    TITLES,
    PublishedLine,
    PublishedTables,
    engine_title,
    figure,
    label,
    seen_verdicts,
)
from reference.report.summary import MARKS
from reference.report.terminal import style_of

LEGEND = {
    Verdict.PASS: "as published, within the tolerance",
    Verdict.KNOWN_DEVIATION: "off by what the method is known to do, for a reason",
    Verdict.FAIL: "neither",
    Verdict.CANNOT_EXPRESS: "cannot be said to it",
    Verdict.NEEDS: "a function that is not written yet",
    Verdict.NOT_AVAILABLE: "the engine is not installed here",
    Verdict.CRASHED: "the run died, hung or gave no usable state",
}
_ALWAYS = (Verdict.FAIL, Verdict.CRASHED, Verdict.NEEDS, Verdict.NOT_AVAILABLE)


def print_published(console: Console, tables: PublishedTables, with_cases: bool = False) -> None:
    """Print three tables, what the marks mean, and which cases nobody else found as published."""
    for kind, title in TITLES.items():
        lines = tables.of_kind(kind)
        if lines:
            console.print()
            console.print(Text(title, style="bold"))
        if with_cases:
            for line in lines:
                _print_case(console, line)
        elif lines:
            console.print(_overview(tables, lines))
    _print_end(console, tables, with_cases)


def _table(*headings: str) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    for place, heading in enumerate(headings):
        table.add_column(heading, no_wrap=place != 1)
    return table


def _overview(tables: PublishedTables, lines: list[PublishedLine]) -> Table:
    """One line a case; in each cell how many of its numbers agree."""
    table = _table("", "case", *(engine_title(name).replace("hand-written", "by hand") for name in tables.engines))
    for line in lines:
        cells = [line.cells.get(name) for name in tables.engines]
        texts = [Text(cell.text, style=style_of(cell.verdict)) if cell else Text() for cell in cells]
        table.add_row(line.case.name, Text(line.case.title), *texts)
    return table


def _print_case(console: Console, line: PublishedLine) -> None:
    """Every number of one case: theirs, and below it what each implementation says."""
    case = line.case
    console.print()
    console.print(Text(f"{case.name} {case.title}", style="bold"))
    console.print(Text(case.source, style="dim"))
    table = _table("figure", "", "ours", "difference", "tolerance", "verdict")
    rows = {name: {(row.figure, row.place): row for row in cell.rows} for name, cell in line.cells.items()}
    for key in dict.fromkeys(key for own in rows.values() for key in own if key[0]):
        found = {name: own[key] for name, own in rows.items() if key in own}
        _add_figure(table, line, found)
    if table.row_count:
        console.print(table)
    for reason in _reasons(line):
        console.print(Text(f"  {reason}", style="dim"))
    if case.note:
        console.print(Text(f"  {case.note}", style="dim"))


def _add_figure(table: Table, line: PublishedLine, found: dict[str, PublishedRow]) -> None:
    first, unit = next(iter(found.values())), line.case.units.get(next(iter(found.values())).figure, "")
    theirs = next((row.expected for row in found.values() if row.expected is not None), None)
    table.add_row(
        Text(label(line.case, first), style="bold"), Text("published"), Text(f"{figure(theirs)} {unit}", "bold")
    )
    for name, row in found.items():
        difference = "" if row.difference is None else numbers.deviation(row.difference, unit)
        tolerance = "" if row.tolerance is None else numbers.size(row.tolerance, unit)
        verdict = Text(f"{MARKS[row.verdict]} {row.verdict}", style=style_of(row.verdict))
        table.add_row("", engine_title(name), figure(row.measured), difference, tolerance, verdict)


def _reasons(line: PublishedLine) -> list[str]:
    """Why so near is near enough, why a number deviates, why there is none: each once, with whom it holds for."""
    found: dict[str, dict[str, None]] = {}
    for name, cell in line.cells.items():
        accepted = [f"accepted: {row.reason}" for row in cell.rows if row.reason]
        for reason in [*accepted, *cell.reasons]:
            found.setdefault(reason, {})[engine_title(name)] = None
    return [f"{', '.join(names)}: {reason}" for reason, names in found.items()]


def _print_end(console: Console, tables: PublishedTables, with_cases: bool) -> None:
    console.print()
    if not with_cases:
        for line in tables.lines:
            for name, cell in line.cells.items():
                if cell.verdict in _ALWAYS:
                    console.print(
                        Text(f"{line.case.name}, {engine_title(name)}: {'; '.join(cell.reasons)}", style="dim")
                    )
    for verdict in seen_verdicts(tables.rows):
        console.print(Text.assemble((f"{MARKS[verdict]} {verdict}", style_of(verdict)), f": {LEGEND[verdict]}"))
    for recorded in tables.recordings:
        console.print(Text(recorded))
    console.print(Text(tables.sentence, style="bold"))
    for exception in tables.exceptions:
        console.print(Text(f"  {exception}"))
