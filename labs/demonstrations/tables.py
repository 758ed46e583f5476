"""The table of a demonstration in the terminal: narrow and low, so that question, plot and lesson fit beside it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby, zip_longest

from rich.table import Table
from rich.text import Text

from labs.demonstrations.outcomes import Outcome
from reference.report import terminal, terminal_plot
from reference.report.marks import MARKS
from reference.report.row_text import error_of
from reference.report.sections import Line

Cells = tuple[str | Text, ...]
_BY_HAND = "by hand"
"""The title of hand-written code here, where columns are narrow."""


def table_of(outcome: Outcome) -> Table:
    """A row for each case or timestep if there are several, and else a row for each implementation."""
    return _across(outcome) if outcome.demonstration.labels else _down(outcome)


def _down(outcome: Outcome) -> Table:
    """Each implementation with the profile that counts on the left, and its other profiles on the right."""
    asked = outcome.demonstration
    off = ("off",) if outcome.theory(asked.quantity) else ()
    headings = ("", "", asked.heading, *off, *asked.beside.values())
    rows, empty = list(_rows(outcome, bool(off))), ("",) * len(headings)
    beside = any(right for _, _, right in rows)
    table = _table("", *headings, *(headings if beside else ()))
    for title, left, right in rows:
        table.add_row(title, *(left or empty), *((right or empty) if beside else ()))
    return table


def _rows(outcome: Outcome, with_error: bool) -> Iterator[tuple[str, Cells, Cells]]:
    for _, group in groupby(outcome.implementations.values(), key=lambda line: line.result.job.engine):
        lines = list(group)
        counted = [_cells(outcome, line, with_error) for line in lines if line.counts]
        others = [_cells(outcome, line, with_error) for line in lines if not line.counts]
        titles = [_title(lines[0])]
        for title, left, right in zip_longest(titles, counted, others, fillvalue=()):
            yield title or "", left, right


def _cells(outcome: Outcome, line: Line, with_error: bool) -> Cells:
    asked, job = outcome.demonstration, line.result.job
    row = outcome.row(job.engine, job.profile, asked.quantity)
    error = (Text(error_of(row), style=terminal.style_of(row.verdict)) if row else Text(),) if with_error else ()
    beside = [_cell(outcome, line, quantity) if row and row.quantity else "" for quantity in asked.beside]
    return _mark(outcome, line), job.profile, _cell(outcome, line, asked.quantity), *error, *beside


def _across(outcome: Outcome) -> Table:
    asked, lines = outcome.demonstration, list(outcome.implementations.values())
    heads = [Text.assemble(_title(line), "\n", _mark(outcome, line), " ", line.result.job.profile) for line in lines]
    first = "timestep" if asked.timesteps else asked.heading
    theory = "theory" if asked.predicted is None else Text.assemble(terminal_plot.marked(None), " predicted")
    table = _table(f"\n{first}", Text.assemble("\n", theory), *heads)
    for label in asked.labels:
        value = asked.predicted(asked.timesteps[label]) if asked.predicted else outcome.theory(asked.quantity, label)
        cells = [_cell(outcome, line, asked.quantity, label) for line in lines]
        table.add_row(label, outcome.formatted(value, asked.quantity), *cells)
    return table


def _table(*headings: str | Text) -> Table:
    table = Table(box=None, header_style="bold", padding=(0, 1, 0, 0), pad_edge=False)
    for heading in headings:
        table.add_column(heading, no_wrap=True)
    return table


def _title(line: Line) -> str:
    return line.result.title.replace("hand-written", _BY_HAND)


def _mark(outcome: Outcome, line: Line) -> Text:
    drawn = {curve.line.title for curve in outcome.curves if curve.line is not None}
    return terminal_plot.marked(line) if line.title in drawn else Text(" ")


def _cell(outcome: Outcome, line: Line, quantity: str, label: str = "") -> Text:
    """What was measured, or why there is no number: one word, or its mark where that is two words."""
    row = outcome.row(line.result.job.engine, line.result.job.profile, quantity, label)
    if row is None:
        return Text()
    if row.measured is None:
        word = MARKS[row.verdict] if " " in row.verdict else str(row.verdict)
        return Text(word, style=terminal.style_of(row.verdict))
    wrong = bool(outcome.demonstration.labels) and row.error and not outcome.demonstration.predicted
    return Text(outcome.formatted(row.measured, quantity), style=terminal.style_of(row.verdict) if wrong else "")
