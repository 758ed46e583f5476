"""The numbers of a run beside theory and the prediction, as a table in a notebook and as plain text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from html import escape
from typing import TYPE_CHECKING, Any

from labs.desk.case_runs import HANDWRITTEN
from labs.desk.predictions import Prediction
from labs.grading.diagnosis.words import listed
from reference import lecture
from reference.catalogue.family import Quantity
from reference.comparison.verdicts import Row, Verdict
from reference.engines.handwritten.impact_response import MEETS_AGAIN
from reference.engines.profiles import SLIDE, STEP
from reference.report import numbers
from reference.report.marks import MARKS
from reference.report.row_text import error_of, tolerance_of
from reference.report.sections import Line

if TYPE_CHECKING:
    from labs.desk.case_runs import CaseRuns

_MEANINGS = {
    Verdict.PASS: "within the tolerance of theory",
    Verdict.KNOWN_DEVIATION: "differs by the amount that the method predicts",
    Verdict.DISAGREES: "as its method predicts, and wrong by as much as the number itself",
    Verdict.FAIL: "farther off than it should be",
    Verdict.SHOWN: "theory has no number",
}
"""The legend below a table; an implementation without a number says itself why it has none."""
_NEAR = "✓~", "within the tolerance of theory, but not to the last digit what the method gives"
"""Of a student's own number that fails for its last digits: a ✗ beside an error that is allowed would contradict it."""
_METHODS = {STEP: "at the step", SLIDE: "by the slide’s T"}
"""Methods of hand-written code in words."""
_NEEDS = "needs "
"""Begins the note of a run for which a function is not written yet."""
_BEYOND = 10.0
"""A guess that is off by more than so many times theory is only said to be beyond that."""
_STYLE = "border-collapse:collapse;font-variant-numeric:tabular-nums"
_BOX = "min-width:0;max-width:100%;break-inside:avoid"
_SCROLLS = "overflow-x:auto"
"""A table that is wider than the page, as on a telephone, scrolls in a box of its own, and its notes stay in sight."""
_CELL = "padding:2px clamp(5px,1.5vw,12px) 2px 0;text-align:{};border:0;background:none"
_NUMBER = "right;white-space:nowrap"
"""Columns are closer where the page is narrow, and a number stays on one line with its unit."""


@dataclass(frozen=True)
class Table:
    """Numbers of one case. headings: of the columns. rows: a text for each column. notes: lines below the table."""

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()

    def __str__(self) -> str:
        every = [self.headings, *self.rows] if self.rows else []
        widths = [max(len(row[place]) for row in every) for place in range(len(self.headings) if every else 0)]
        lines = [
            "  ".join(text.ljust(width) if place == 0 else text.rjust(width) for place, (text, width) in found).rstrip()
            for found in (enumerate(zip(row, widths, strict=True)) for row in every)
        ]
        return "\n".join([self.title, *lines, *self.notes])

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": "".join(self.markup())}

    def markup(self) -> Iterator[str]:
        """The same as a piece of a page."""
        yield f'<div style="{_BOX}"><b>{escape(self.title)}</b><div style="{_SCROLLS}"><table style="{_STYLE}">'
        for kind, row in [("th", self.headings), *(("td", row) for row in self.rows)] if self.rows else []:
            cells = (
                f'<{kind} style="{_CELL.format("left" if place == 0 else _NUMBER)}">{escape(text)}</{kind}>'
                for place, text in enumerate(row)
            )
            yield f"<tr>{''.join(cells)}</tr>"
        yield "</table></div>"
        yield from _lines(self.notes)
        yield "</div>"


def _lines(notes: Sequence[str]) -> Iterator[str]:
    return (f"<div>{escape(note)}</div>" for note in notes)


@dataclass(frozen=True)
class Tables:
    """Tables side by side, as far as there is room. title, notes: of all of them together; the title may be empty."""

    title: str
    tables: tuple[Table, ...]
    notes: tuple[str, ...]

    def __str__(self) -> str:
        return "\n".join([self.title, *map(str, self.tables), *self.notes])

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        markup = "".join("".join(table.markup()) for table in self.tables)
        row = f'<div style="display:flex;flex-wrap:wrap;gap:8px 40px">{markup}</div>'
        above = [f'<div style="break-after:avoid">{escape(self.title)}</div>'] if self.title else []
        return {"text/plain": str(self), "text/html": "".join([*above, row, *_lines(self.notes)])}


def tables(runs: CaseRuns, quantities: Sequence[str], predictions: Sequence[Prediction] = ()) -> Table | Tables:
    """One table per quantity: who ran, the value, and how far it is from theory.

    A predicted number is listed in the first table. A prediction in words is quoted below all tables if nobody knows
    whether it is right.
    """
    wanted = [runs.family.quantity(name) for name in quantities] or list(runs.family.quantities)
    guesses = [each for each in predictions if isinstance(each.answer, float)]
    found = [_table(runs, quantity, guesses if place == 0 else ()) for place, quantity in enumerate(wanted)]
    words = [each for each in predictions if isinstance(each.answer, str) and not each.verdict()]
    said = [f"You predicted {each.shown}. {each.question}" for each in words]
    notes = (*said, *_notes(runs, [quantity.name for quantity in wanted]))
    if len(found) > 1:
        return Tables(runs.title, tuple(table for table in found if table.rows), notes)
    return replace(found[0], title=f"{found[0].title} ({runs.title})", notes=notes)


def theory(runs: CaseRuns, quantities: Sequence[str]) -> float | None:
    """What theory expects of the first of these quantities, or of the family's first; None if it has no number."""
    return _theory(runs, runs.family.quantity(quantities[0]) if quantities else runs.family.quantities[0])


def who(line: Line) -> str:
    """An implementation as a table names it: `yours`, `PyBullet`; with its method if another one counts."""
    if line.counts:
        return line.result.title
    method = _METHODS.get(line.result.job.profile, line.result.job.profile)
    return f"{line.result.title}, {method}" if line.result.job.engine == HANDWRITTEN else line.title


def absent(line: Line) -> str:
    """Why an implementation has no number, as a sentence if it is the student's own."""
    if line.result.job.engine != HANDWRITTEN:
        return f"{who(line)}: {line.note}"
    note = line.note.removeprefix(_NEEDS)
    return f"Your implementation waits for {note}." if note != line.note else f"Your implementation {note}"


def capital(text: str) -> str:
    """A title with a capital letter; a symbol stays as it is."""
    return text[:1].upper() + text[1:] if text[1:2].isalpha() else text


def _table(runs: CaseRuns, quantity: Quantity, guesses: Sequence[Prediction]) -> Table:
    rows = [(line, row) for line in runs.lines if (row := _row(line, quantity.name))]
    expected = _theory(runs, quantity)
    cells = [_cells(line, row, runs.timestep(line)) for line, row in rows]
    cells[:0] = [("you predicted", guess.shown, _off(guess, expected), "", "", "") for guess in guesses]
    if expected is not None:
        cells.append(("theory", _value(expected), "", "", "", ""))
    unit = f", {quantity.unit}" if quantity.unit else ""
    headings = ("", f"value{unit}", "off by", "", "allowed", "timestep")
    used = [place for place in range(len(headings)) if place < 2 or any(row[place] for row in cells)]
    return Table(
        capital(quantity.title),
        tuple(headings[place] for place in used),
        tuple(tuple(row[place] for place in used) for row in cells),
    )


def _theory(runs: CaseRuns, quantity: Quantity) -> float | None:
    rows = [row for line in runs.lines if (row := _row(line, quantity.name))]
    return next((row.expected for row in rows if row.expected is not None), None)


def _row(line: Line, quantity: str) -> Row | None:
    return next((row for row in line.result.rows if row.quantity == quantity), None)


def _cells(line: Line, row: Row, timestep: float) -> tuple[str, ...]:
    value = _value(row.measured) if row.measured is not None else "none"
    row = _by_theory(row)
    error = error_of(row) if row.error is not None else ""
    return who(line), value, error, _marked(line, row)[0], _allowed(row), f"{1000 * timestep:.3g} ms"


def _by_theory(row: Row) -> Row:
    """A row whose percentages are of what theory expects, which is beside them; without any where that is zero."""
    return replace(row, scale=abs(row.expected)) if row.scale and row.expected is not None else row


def _marked(line: Line, row: Row) -> tuple[str, str]:
    """The mark of a row and what it means; what its method predicts is no ✓ where theory has no number."""
    own = line.result.job.engine == HANDWRITTEN and row.verdict is Verdict.FAIL
    if own and row.error is not None and row.tolerance is not None and abs(row.error) <= row.tolerance:
        return _NEAR
    verdict = Verdict.SHOWN if row.expected is None and row.verdict is Verdict.PASS else row.verdict
    return MARKS[verdict], _MEANINGS.get(verdict, "")


def _allowed(row: Row) -> str:
    """The tolerance of a row; a tolerance of rounding needs no figure."""
    allowed = tolerance_of(row)
    return "rounding" if allowed.startswith("<") else f"±{allowed}" if allowed else ""


def _off(prediction: Prediction, theory: float | None) -> str:
    """How far a guess is from theory, as a share of theory and up to `_BEYOND`.

    Empty if theory is zero, or if something else is right, such as what an engine's own method gives.
    """
    if prediction.right.number is not None:
        return ""
    if theory is None or _value(theory) == "0" or not isinstance(prediction.answer, float):
        return ""
    off = (prediction.answer - theory) / abs(theory)
    return numbers.percent(off) if abs(off) <= _BEYOND else f">{_BEYOND * 100:.0f} %"


def _value(value: float) -> str:
    """A number with five digits; zero if it is nothing but rounding."""
    return numbers.quantity(value, "")


def _notes(runs: CaseRuns, quantities: Sequence[str]) -> Iterator[str]:
    """Who has no number and why, what the marks mean, why numbers deviate, and which were recorded elsewhere."""
    for line in runs.lines:
        if not any(_row(line, name) for name in quantities):
            yield absent(line)
    rows = [(line, row) for line in runs.lines for row in line.result.rows if row.quantity in quantities]
    if any(line.result.job.engine == HANDWRITTEN and _is_wrong(line) for line in runs.lines):
        yield _what_a_check_says(runs)
    meanings = dict.fromkeys(f"{mark} {meaning}" for mark, meaning in (_marked(*each) for each in rows) if meaning)
    if meanings:
        yield f"({'; '.join(meanings)})"
    for note in dict.fromkeys(row.note for _, row in rows if row.note):
        names = dict.fromkeys(who(line) for line, row in rows if row.note == note)
        yield f"{' and '.join(names)}: {note}"
    yield from (line.result.recording for line in runs.lines if line.result.recording)


def _what_a_check_says(runs: CaseRuns) -> str:
    """What a check adds to a wrong run. Of a function with several versions it tests the last one alone."""
    own = [name for name in runs.results[0].functions if name in runs.own]
    drafted = [name for name in own if lecture.function(name).begun]
    alone = f" It checks the last version of {listed(drafted)}." if drafted else ""
    return f"lab.check() says more about your functions.{alone}"


def _is_wrong(line: Line) -> bool:
    """Whether a run hints at a wrong function: it failed, crashed or took too long, or its result is impossible."""
    hints = (Verdict.FAIL, Verdict.CRASHED, Verdict.LOST)
    return any(row.verdict in hints or row.note == MEETS_AGAIN for row in line.result.rows)
