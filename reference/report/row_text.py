"""The numbers of a row as text: its error, its tolerance, and what remains of a known deviation."""

from __future__ import annotations

from reference.comparison.verdicts import Row
from reference.report import numbers


def error_of(row: Row) -> str:
    """A row's error: in percent where there is a scale, else in the unit; the value where nothing is expected."""
    if row.measured is None:
        return ""
    if row.error is None:
        return numbers.size(abs(row.measured), row.unit)
    return _as_share(row, row.error)


def left_of(row: Row) -> str:
    """Size of what the method does not explain of an error, in percent where there is a scale, else in the unit."""
    if row.error is None:
        return ""
    return _as_share(row, row.error - row.shift if row.off is None else row.off).lstrip("+−")


def tolerance_of(row: Row) -> str:
    """How far off a row may be, in percent where there is a scale, else in the unit; empty where nothing is given."""
    return "" if row.tolerance is None else _as_share(row, row.tolerance).lstrip("+")


def _as_share(row: Row, error: float) -> str:
    return numbers.percent(error / row.scale) if row.scale else numbers.deviation(error, row.unit)
