"""A comparison as tables in the terminal: a line for each implementation, or every case with its numbers."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from rich.console import Console
from rich.table import Table
from rich.text import Text

from reference import lecture
from reference.comparison.pairs import Relation
from reference.comparison.verdicts import Row, Verdict
from reference.report import agreement, numbers
from reference.report.agreement import Matrix
from reference.report.cells import Cell
from reference.report.formulas import plain
from reference.report.marks import LEGEND, MARKS, occurring
from reference.report.overview import Overview, verdict_line
from reference.report.provenance import compared
from reference.report.results_in_words import remarks
from reference.report.row_text import error_of, left_of
from reference.report.sections import Line, Section, recordings
from reference.report.sensitivity import kept_sentence
from reference.report.worst_first import nearest_to_fail

WORST = 5
"""How many rows the list of the worst has."""
_WITH_BLANKS = 12
"""Implementations up to which a mark and its number have a blank between them: more columns would be too wide."""
_COLUMN = 14
"""Width at which the headings of the quantities are broken."""
_ANY_WIDTH = 1000
"""Wider than any table, so that a table can be measured at the width it would like to have."""
_STYLES = {
    Verdict.PASS: "green",
    Verdict.KNOWN_DEVIATION: "yellow",
    Verdict.DISAGREES: "red",
    Verdict.FAIL: "red",
    Verdict.CRASHED: "bold red",
    Verdict.LOST: "bold red",
}
_RELATIONS = {Relation.ALIKE: "green", Relation.EXPLAINED: "yellow", Relation.APART: "red"}


def print_comparison(console: Console, found: Iterable[Section], with_cases: bool = False, remark: str = "") -> None:
    """Print each family with its question and its tables, then the overview, what the marks mean, and a remark."""
    found = list(found)
    for section in found:
        console.print()
        console.print(Text(section.family.title, style="bold"))
        console.print(Text(_statements(section), style="dim"))
        console.print(Text(plain(section.family.expected)))
        for table in _cases(section) if with_cases else _implementations(console, section):
            console.print(table)
        _print_remarks(console, section, with_cases)
        _print_agreement(console, Matrix.of(section))
        if noticed := kept_sentence(section):
            console.print(Text(noticed, style="dim"))
    rows = [row for section in found for line in section.lines for row in line.result.rows]
    versions = compared(line.result for section in found for line in section.lines)
    if len(found) > 1:
        _print_overview(console, Overview.of(found))
        _print_worst_first(console, found)
    console.print()
    print_legend(console, occurring(rows), LEGEND)
    if versions:
        console.print(Text(f"Compared: {', '.join(versions)}."))
    for recorded in recordings(line.result for section in found for line in section.lines):
        console.print(Text(recorded))
    if between := agreement.sentence(pair for section in found for pair in section.pairs):
        console.print(Text(between))
    if remark:
        console.print(Text(remark))
    console.print(Text(verdict_line(rows), style="bold"))


def _print_agreement(console: Console, matrix: Matrix) -> None:
    """Print who agrees with whom, each implementation against those above it, and why some are apart."""
    if len(matrix.titles) < 2:
        return
    console.print()
    table = Table(box=None, header_style="bold", padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("who agrees with whom", no_wrap=True)
    blank = " " if len(matrix.titles) <= _WITH_BLANKS else ""
    for number in range(1, len(matrix.titles)):
        table.add_column(str(number), no_wrap=True)
    for number, (title, entries) in enumerate(zip(matrix.titles, matrix.rows, strict=True), 1):
        texts = [entry.text.replace(" ", blank) if entry else "" for entry in entries]
        styles = [_RELATIONS[entry.relation] if entry else "" for entry in entries]
        table.add_row(Text(f"{number} {short_title(title)}"), *map(Text, texts, styles))
    console.print(table)
    for why, titles in matrix.whys:
        whose = f"{' and '.join(map(short_title, titles))}: " if titles else ""
        console.print(Text(f"≠ {whose}{why}", style="dim"))


def print_legend(console: Console, verdicts: Iterable[Verdict], legend: Mapping[Verdict, str]) -> None:
    """Print what the marks of these verdicts mean, a line each."""
    for verdict in verdicts:
        console.print(Text.assemble((f"{MARKS[verdict]} {verdict}", style_of(verdict)), f": {legend[verdict]}"))


def _print_overview(console: Console, overview: Overview) -> None:
    """Print all families in one screen; where that is too wide, in parts, what counts first."""
    whole = _overview(overview)
    tables = [whole] if _fits(console, whole) else [t for part in overview.in_parts() for t in _halved(console, part)]
    for table in tables:
        console.print()
        console.print(table)


def _halved(console: Console, part: Overview) -> list[Table]:
    """A table of some implementations, or of one half of them after the other where they do not fit."""
    table, middle = _overview(part), math.ceil(len(part.titles) / 2)
    if _fits(console, table) or len(part.titles) == 1:
        return [table]
    halves = replace(part, titles=part.titles[:middle]), replace(part, titles=part.titles[middle:])
    return [half for each in halves for half in _halved(console, each)]


def _overview(overview: Overview) -> Table:
    """The worst mark of each implementation in each family, and how many of its checks agree."""
    table = Table(box=None, header_style="bold", padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("\nat a glance", no_wrap=True)
    for title in overview.titles:
        table.add_column(short_title(title).replace(", ", "\n"), no_wrap=True)
    for section, cells in overview.rows:
        texts = [
            Text(f"{line.whole.mark} {_short_count(line)}", style=style_of(line.whole.verdict)) if line else Text("")
            for _, line in cells
        ]
        table.add_row(section.family.name, *texts)
    return table


def short_title(title: str) -> str:
    """An implementation's title in the head of a narrow column."""
    return title.replace("hand-written", "by hand")


def _print_worst_first(console: Console, found: Sequence[Section]) -> None:
    worst = nearest_to_fail(found, WORST)
    if worst:
        console.print()
        console.print(Text("exact and tuned, worst first: how much of its limit a number uses", style="bold"))
    for section, line, row, used in worst:
        what = f"{section.family.name}, {row.case}: {section.family.quantity(row.quantity).title}"
        error = error_of(row) if row.error is not None else "where theory is silent"
        console.print(Text(f"  {numbers.percent(used).lstrip('+'):>7}  {line.result.title}, {what} {error}"))


def _short_count(line: Line) -> str:
    """The count, or `needs`; nothing where the mark alone is enough."""
    return line.whole.count if "/" in line.whole.count or line.whole.verdict is Verdict.NEEDS else ""


def _statements(section: Section) -> str:
    """Which statements of the lecture the family tests."""
    titles = [f"{number} {lecture.statement(number).title}" for number in section.family.statements]
    return f"Lecture, statement{'s' if len(titles) > 1 else ''} {'; '.join(titles)}"


def _implementations(console: Console, section: Section) -> list[Table]:
    """A line for each implementation; in each cell how many cases agree, and the worst error.

    Where the quantities do not fit beside one another there are more tables, as equal as can be.
    """
    quantities = len(section.family.quantities)
    for parts in range(1, quantities + 1):
        size = math.ceil(quantities / parts)
        tables = [_quantities(section, first, first + size) for first in range(0, quantities, size)]
        if all(_fits(console, table) for table in tables):
            break
    return tables


def _quantities(section: Section, first: int, end: int) -> Table:
    table = _table("implementation", *(quantity.title for quantity in section.family.quantities[first:end]))
    for line in section.lines:
        noted = [Text(str(line.whole.verdict), style=style_of(line.whole.verdict))] if line.note else []
        table.add_row(Text(line.title, style="bold" if line.counts else ""), *(noted or _texts(line.cells[first:end])))
    return table


def _fits(console: Console, table: Table) -> bool:
    return console.measure(table, options=console.options.update(width=_ANY_WIDTH)).maximum <= console.width


def _texts(cells: Sequence[Cell]) -> list[Text]:
    lines = [(f"{cell.mark} {cell.count}".strip(), cell.worst, cell.left) for cell in cells]
    return [
        Text("\n".join(filter(None, texts)), style=style_of(cell.verdict))
        for texts, cell in zip(lines, cells, strict=True)
    ]


def _cases(section: Section) -> Iterator[Table]:
    """A table for each quantity: under each case what every implementation measured."""
    for quantity in section.family.quantities:
        table = _table(f"\n{quantity.title}", "\nmeasured", "\nerror", "\nleft", "\nverdict")
        for case in section.cases:
            expected = section.expected(case, quantity)
            heading = [case, expected, "", "", "expected"] if expected else [case]
            table.add_row(*(Text(text, style="bold") for text in heading))
            for line in section.lines:
                row = line.row(case, quantity.name)
                if row is not None:
                    table.add_row(Text(f"  {line.title}"), *_numbers(row))
        yield table


def _numbers(row: Row) -> tuple[str, str, str, Text]:
    """What was measured, its error, what is left of a known deviation, and the verdict."""
    measured = "" if row.measured is None else numbers.quantity(row.measured, row.unit)
    error = "" if row.error is None else error_of(row)
    left = left_of(row) if row.verdict is Verdict.KNOWN_DEVIATION else ""
    return measured, error, left, Text(f"{MARKS[row.verdict]} {row.verdict}", style=style_of(row.verdict))


def _print_remarks(console: Console, section: Section, with_cases: bool) -> None:
    """Print why there is no number and, with the cases, why a number deviates."""
    for remark in remarks(section):
        if with_cases or remark.verdict is not Verdict.KNOWN_DEVIATION:
            console.print(Text(remark.said, style="dim"))


def _table(first: str, *others: str) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    table.add_column(first, no_wrap=True)
    for title in others:
        table.add_column("\n".join(textwrap.wrap(title, _COLUMN)) if len(title) > _COLUMN else title, no_wrap=True)
    return table


def style_of(verdict: Verdict) -> str:
    """How a verdict is coloured."""
    return _STYLES.get(verdict, "dim")
