"""The worst rows first: those nearest to their limits, and those furthest from theory."""

from __future__ import annotations

from collections.abc import Iterable

from reference.comparison.verdicts import Row, Verdict
from reference.report.sections import Line, Section


def nearest_to_fail(found: Iterable[Section], count: int) -> list[tuple[Section, Line, Row, float]]:
    """The rows that count and come closest to their limits, worst first, each with the share of the limit that it uses.

    Where the method's recurrence predicts the number, its band is the limit. Elsewhere a known shift does not count
    against it: the distance is the smaller one of those from theory and from theory + shift.
    """
    rows = [
        (section, line, row, used)
        for section in found
        for line in section.lines
        if line.counts
        for row in line.result.rows
        if (used := _used(row)) is not None
    ]
    return sorted(rows, key=lambda entry: -entry[3])[:count]


def _used(row: Row) -> float | None:
    if row.off is not None and row.band:
        return abs(row.off) / row.band
    if row.error is None or not row.tolerance:
        return None
    return min(abs(row.error), abs(row.error - row.shift)) / row.tolerance


def furthest_from_theory(found: Iterable[Section], count: int) -> list[tuple[Section, Line, Row]]:
    """The rows of profiles that do not count that miss theory by the largest share, worst first, one a line."""
    worst = [
        (section, line, max(failed, key=lambda row: abs(row.relative_error or 0.0)))
        for section in found
        for line in section.lines
        if not line.counts
        if (
            failed := [
                row for row in line.result.rows if row.verdict is Verdict.FAIL and row.relative_error is not None
            ]
        )
    ]
    return sorted(worst, key=lambda entry: -abs(entry[2].relative_error or 0.0))[:count]
