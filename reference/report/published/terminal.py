"""Published cases as three tables in the terminal: a line for each case, or every number."""

from __future__ import annotations

from rich.console import Console
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from reference.comparison.verdicts import Verdict
from reference.published.results import PublishedRow
from reference.report import numbers
from reference.report.marks import MARKS, occurring
from reference.report.published.tables import (
    LEGEND,
    TITLES,
    PublishedLine,
    PublishedTables,
    engine_title,
    figure,
    label,
)
from reference.report.terminal import print_legend, short_title, style_of

_ALWAYS = tuple(map(str, (Verdict.FAIL, Verdict.CRASHED, Verdict.LOST, Verdict.NEEDS, Verdict.NOT_AVAILABLE)))
"""The verdicts whose reasons the overview prints as well; it prints all other reasons with the cases."""


def print_published(console: Console, tables: PublishedTables, with_cases: bool = False) -> None:
    """Print three tables, what the marks mean, and which cases no other implementation found as published."""
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


def _table(*headings: str, wrapped: int | None = None) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1, 0, 0), pad_edge=False)
    for place, heading in enumerate(headings):
        table.add_column(heading, no_wrap=place != wrapped)
    return table


def _overview(tables: PublishedTables, lines: list[PublishedLine]) -> Table:
    """A line for each case; in each cell how many of its numbers agree."""
    titles = (short_title(engine_title(name)) for name in tables.engines)
    table = _table("", "case", *titles, wrapped=1)
    for line in lines:
        cells = [line.cells.get(name) for name in tables.engines]
        texts = [Text(cell.text, style=style_of(cell.verdict)) if cell else Text() for cell in cells]
        table.add_row(line.case.name, Text(line.case.title), *texts)
    return table


def _print_case(console: Console, line: PublishedLine) -> None:
    """Print every number of one case: the published one, and below it that of each implementation."""
    case = line.case
    console.print()
    console.print(Text(f"{case.name} {case.title}", style="bold"))
    console.print(Text(case.source, style="dim"))
    table = _table("figure", "value", "difference", "accepted", "verdict")
    for found in line.figures():
        _add_figure(table, line, found)
    if table.row_count:
        console.print(table)
    accepted = [(f"accepted: {reason}", titles) for reason, titles in line.tolerances]
    for reason, titles in [*accepted, *line.reasons]:
        console.print(_indented(f"{', '.join(titles)}: {reason}"))
    if case.note:
        console.print(_indented(case.note))


def _indented(text: str) -> Padding:
    return Padding(Text(text, style="dim"), (0, 0, 0, 2))


def _add_figure(table: Table, line: PublishedLine, found: dict[str, PublishedRow]) -> None:
    heading = label(line.case, next(iter(found.values())))
    headings = (heading, figure(line.theirs(found)), "", "", "published")
    table.add_row(*(Text(text, style="bold") for text in headings))
    for name, row in found.items():
        difference = "" if row.difference is None else numbers.deviation(row.difference, "")
        accepted = "" if row.tolerance is None else numbers.digits(row.tolerance, 2)
        verdict = Text(f"{MARKS[row.verdict]} {row.verdict}", style=style_of(row.verdict))
        table.add_row(f"  {engine_title(name)}", figure(row.measured), difference, accepted, verdict)


def _print_end(console: Console, tables: PublishedTables, with_cases: bool) -> None:
    console.print()
    for line in [] if with_cases else tables.lines:
        for reason, titles in line.reasons:
            if reason.startswith(_ALWAYS):
                console.print(Text(f"{line.case.name}, {', '.join(titles)}: {reason}", style="dim"))
    print_legend(console, occurring(tables.rows), LEGEND)
    for recorded in tables.recordings:
        console.print(Text(recorded))
    console.print(Text(tables.sentence, style="bold"))
    for exception in tables.exceptions:
        console.print(_indented(exception))
    if not with_cases:
        console.print(Text("With --cases: every number, the reason of each tolerance, and why some have none."))
