"""A comparison as tables in the terminal: one line an implementation, or every case with its numbers."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from reference import lecture
from reference.compare import Row, Verdict
from reference.report import numbers
from reference.report.summary import LEGEND, MARKS, Cell, Line, Section, columns, error_of, left_of, verdict_line
from reference.report.worst import nearest_to_fail

WORST = 5
"""How many rows the list of the worst has."""
_COLUMN = 14
"""Width at which the headings of the figures are broken: five columns fit in a terminal of 80."""
_STYLES = {
    Verdict.PASS: "green",
    Verdict.KNOWN_DEVIATION: "yellow",
    Verdict.FAIL: "red",
    Verdict.CRASHED: "bold red",
}


def print_comparison(console: Console, found: Iterable[Section], with_cases: bool = False) -> None:
    """Print each family: what is asked, a table, and what the marks mean."""
    found = list(found)
    for section in found:
        console.print()
        console.print(Text(section.family.title, style="bold"))
        console.print(Text(_statements(section), style="dim"))
        console.print(Text(section.family.expected))
        for table in _cases(section) if with_cases else [_overview(section)]:
            console.print(table)
        _print_remarks(console, section, with_cases)
    rows = [row for section in found for line in section.lines for row in line.result.rows]
    if len(found) > 1:
        _print_at_a_glance(console, found)
    seen = [verdict for verdict in Verdict if any(row.verdict is verdict for row in rows)]
    console.print()
    for verdict in seen:
        console.print(Text.assemble((f"{MARKS[verdict]} {verdict}", _style(verdict)), f": {LEGEND[verdict]}"))
    console.print(Text(verdict_line(rows), style="bold"))


def _print_at_a_glance(console: Console, found: Sequence[Section]) -> None:
    """All families in one screen: the worst mark of each implementation, and how many of its checks agree."""
    titles = columns(found)
    table = Table(box=None, header_style="bold", padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("\nat a glance", no_wrap=True)
    for title in titles:
        table.add_column(title.replace("hand-written", "by hand").replace(", ", "\n"), no_wrap=True)
    for section in found:
        lines = [section.line(title) for title in titles]
        cells = [
            Text(f"{line.whole.mark} {_short_count(line)}", style=_style(line.whole.verdict)) if line else Text("")
            for line in lines
        ]
        table.add_row(section.family.name, *cells)
    console.print()
    console.print(table)
    worst = nearest_to_fail(found, WORST)
    if worst:
        console.print()
        console.print(Text("tuned, worst first: share of its limit", style="bold"))
    for section, line, row, used in worst:
        what = f"{section.family.name}, {row.case}: {section.family.quantity(row.quantity).title}"
        console.print(Text(f"  {numbers.percent(used).lstrip('+'):>7}  {line.result.title}, {what} {error_of(row)}"))


def _short_count(line: Line) -> str:
    """The count, or `needs`; nothing where the mark says it all."""
    return line.whole.count if "/" in line.whole.count or line.whole.verdict is Verdict.NEEDS else ""


def _statements(section: Section) -> str:
    """Which statements of the lecture the family puts to the test."""
    titles = [f"{number} {lecture.statement(number).title}" for number in section.family.statements]
    return f"Lecture, statement{'s' if len(titles) > 1 else ''} {'; '.join(titles)}"


def _overview(section: Section) -> Table:
    """One line an implementation; in each cell how many cases agree, and the worst error."""
    table = _table("implementation", *(quantity.title for quantity in section.family.quantities))
    for line in section.lines:
        cells = [Text(str(line.whole.verdict), style=_style(line.whole.verdict))] if line.note else _texts(line.cells)
        table.add_row(Text(line.title, style="bold" if line.tuned else ""), *cells)
    return table


def _texts(cells: Sequence[Cell]) -> list[Text]:
    lines = [(f"{cell.mark} {cell.count}".strip(), cell.worst, cell.left) for cell in cells]
    return [
        Text("\n".join(filter(None, texts)), style=_style(cell.verdict))
        for texts, cell in zip(lines, cells, strict=True)
    ]


def _cases(section: Section) -> Iterator[Table]:
    """A table a quantity: under each case what every implementation measured."""
    for quantity in section.family.quantities:
        table = _table(f"\n{quantity.title}", "\nmeasured", "\nerror", "\nleft", "\nverdict")
        for case in section.cases:
            expected = section.expected(case, quantity)
            heading = [case, expected, "", "", "expected"] if expected else [case]
            table.add_row(*(Text(text, style="bold") for text in heading))
            for line in section.lines:
                row = line.row(case, quantity.name)
                if row is not None:
                    table.add_row(Text(f"  {line.title}"), *_figures(row))
        yield table


def _figures(row: Row) -> tuple[str, str, str, Text]:
    measured = "" if row.measured is None else numbers.quantity(row.measured, row.unit)
    error = "" if row.error is None else error_of(row)
    left = left_of(row) if row.verdict is Verdict.KNOWN_DEVIATION else ""
    return measured, error, left, Text(f"{MARKS[row.verdict]} {row.verdict}", style=_style(row.verdict))


def _print_remarks(console: Console, section: Section, with_cases: bool) -> None:
    """Why there is no number; with the cases also why one deviates."""
    for note, titles in section.remarks():
        if with_cases or not note.startswith(str(Verdict.KNOWN_DEVIATION)):
            console.print(Text(f"  {', '.join(titles)}: {note}", style="dim"))


def _table(first: str, *others: str) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1), pad_edge=False)
    table.add_column(first, no_wrap=True)
    for title in others:
        table.add_column("\n".join(textwrap.wrap(title, _COLUMN)) if len(title) > _COLUMN else title, no_wrap=True)
    return table


def _style(verdict: Verdict) -> str:
    return _STYLES.get(verdict, "dim")
