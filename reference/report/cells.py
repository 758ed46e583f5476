"""One cell of the tables: which error and which mark stand for the rows of one quantity, or of all quantities."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from reference.catalogue.family import Family
from reference.comparison.pairs import SHARE
from reference.comparison.verdicts import Row, Verdict
from reference.report.marks import AGREES, MARKS, SEVERITY
from reference.report.row_text import error_of, left_of

_AWAY = (Verdict.FAIL, Verdict.DISAGREES)
"""The verdicts of numbers that are far from theory, so that how far is not the question."""


@dataclass(frozen=True)
class Cell:
    """One cell of a table, for the rows of one quantity in one implementation, or of all quantities.

    family: theirs, where the cell has to name a quantity, or what a run does that has no number.
    """

    rows: tuple[Row, ...]
    family: Family | None = None

    @cached_property
    def verdict(self) -> Verdict:
        """The worst verdict among the rows."""
        return min((row.verdict for row in self.rows), key=SEVERITY.index)

    @property
    def mark(self) -> str:
        """One character for the verdict."""
        return MARKS[self.verdict]

    @property
    def judged(self) -> int:
        """How many rows have an expectation, or should have had one."""
        return sum(row.verdict not in (Verdict.SHOWN, Verdict.RUNNING) for row in self.rows)

    @property
    def agreeing(self) -> int:
        """How many rows agree with theory, known deviations included."""
        return sum(row.verdict in AGREES for row in self.rows)

    @property
    def count(self) -> str:
        """`5/6` of the rows agree; "" where no row is judged, the verdict where no row has a number."""
        if all(row.measured is None and row.verdict not in (Verdict.FAIL, Verdict.DISAGREES) for row in self.rows):
            return str(self.verdict)
        return f"{self.agreeing}/{self.judged}" if self.judged else ""

    @cached_property
    def worst(self) -> str:
        """The largest error, or the largest value where nothing is expected; runs that have no number come first."""
        absent = [row for row in self.rows if row.measured is None and row.quantity and row.verdict is Verdict.FAIL]
        if absent:
            quantity = absent[0].quantity
            asked = sum(row.quantity in (quantity, "") for row in self.rows)
            words = self.family.quantity(quantity).absent if self.family else "no number"
            return f"{words}: {sum(row.quantity == quantity for row in absent)} of {asked}"
        measured = [row for row in self.rows if row.measured is not None and row.tolerance != 0]  # 0: yes or no
        return error_of(max(measured, key=_badness)) if measured else ""

    @cached_property
    def in_words(self) -> str:
        """The worst row of several quantities, with the name of its quantity: `stopping distance −0.1 %`.

        Of rows that fail or disagree it is the one that is most of its tolerance away from theory; of others the one of
        the first quantity that uses most of it.
        """
        judged = [row for row in self.rows if row.verdict is not Verdict.SHOWN]
        if not judged or self.family is None or not self.count.partition("/")[2]:
            return ""
        order = [quantity.name for quantity in self.family.quantities]

        def badness(row: Row) -> tuple[int, bool, int, float]:
            away = row.verdict in _AWAY
            place = 0 if away or not row.quantity else -order.index(row.quantity)
            if not away and row.tolerance == 0:  # yes or no
                place -= len(order)
            severity = SEVERITY.index(Verdict.FAIL) if away else SEVERITY.index(row.verdict)
            return -severity, row.measured is None, place, _distance(row)

        worst = max(judged, key=badness)
        if not worst.quantity:
            cases = {row.case for row in judged}
            return f"{worst.verdict}: {sum(not row.quantity for row in judged)} of {len(cases)} cases"
        own = Cell(tuple(row for row in self.rows if row.quantity in (worst.quantity, "")), self.family)
        title = self.family.quantity(worst.quantity).title
        if worst.measured is None:
            return own.worst
        if worst.tolerance == 0:
            return f"{title}: {own.judged - own.agreeing} of {own.judged} wrong"
        return f"{title} {error_of(worst)}"

    @cached_property
    def left(self) -> str:
        """What the method does not explain of the largest known deviation."""
        known = [row for row in self.rows if row.verdict is Verdict.KNOWN_DEVIATION]
        return f"left {left_of(max(known, key=_badness))}" if known else ""


def _badness(row: Row) -> tuple[int, float]:
    error = row.relative_error if row.relative_error is not None else row.error
    size = abs(error) if error is not None else abs(row.measured or 0.0)
    return -SEVERITY.index(row.verdict), size if math.isfinite(size) else math.inf


def _distance(row: Row) -> float:
    """How far a row is from theory, as a share of what counts as near, so that all quantities can be compared.

    Where only rounding is accepted, a thousandth of what theory says counts as near.
    """
    if row.error is None or not row.tolerance:
        return 0.0
    return abs(row.error) / max(row.tolerance, SHARE * abs(row.expected or 0.0))
