"""The worst first: nothing that comes near its limit or misses theory by far hides in a long table."""

from __future__ import annotations

import pytest

from reference.comparison.results import Job, JobResult
from reference.comparison.verdicts import Row, Verdict
from reference.report.sections import sections
from reference.report.worst_first import furthest_from_theory, nearest_to_fail


def row(measured: float, verdict: Verdict = Verdict.PASS, profile: str = "tuned", **more) -> Row:
    """A time of rest in s that should be 10 s, within 1 s."""
    given = {"expected": 10.0, "tolerance": 1.0, "scale": 10.0} | more
    return Row("ball-to-rest", "e=0.5", "handwritten", profile, "rest_time", "s", verdict, measured, **given)


def found(*rows: Row):
    profiles = dict.fromkeys(entry.profile for entry in rows)
    return sections(
        JobResult(
            Job("ball-to-rest", "handwritten", profile),
            "hand-written",
            "",
            tuple(entry for entry in rows if entry.profile == profile),
        )
        for profile in profiles
    )


def used(*rows: Row, count: int = 10) -> list[float]:
    return [share for *_, share in nearest_to_fail(found(*rows), count)]


def test_the_row_that_uses_most_of_its_limit_comes_first():
    assert used(row(10.2), row(9.1), row(10.5)) == pytest.approx([0.9, 0.5, 0.2])


def test_no_more_rows_than_requested_are_listed():
    assert used(row(10.2), row(9.1), row(10.5), count=2) == pytest.approx([0.9, 0.5])


def test_a_known_shift_is_not_counted_against_a_method():
    known = row(7.1, Verdict.KNOWN_DEVIATION, shift=-3.0)
    inside = row(9.1, shift=-0.9)
    assert used(known, inside) == pytest.approx([0.1, 0.0])


def test_the_limit_of_a_predicted_number_is_its_band():
    assert used(row(10.2, predicted=10.199, off=-0.001, band=0.004), row(10.5)) == pytest.approx([0.5, 0.25])


def test_a_failure_has_used_up_more_than_its_limit():
    assert used(row(13.0, Verdict.FAIL)) == pytest.approx([3.0])


def test_rows_without_limit_or_number_are_left_out():
    shown = row(3.0, Verdict.SHOWN, expected=None, tolerance=None)
    nothing = Row("ball-to-rest", "e=0.5", "handwritten", "exact", "", "", Verdict.NEEDS)
    yes_or_no = row(10.0, tolerance=0.0)
    assert used(shown, nothing, yes_or_no, row(19.0, Verdict.FAIL, "stock")) == []


def test_failures_of_other_profiles_are_listed_once_a_line():
    rows = (
        row(5.0, Verdict.FAIL),  # tuned: it counts, and stands elsewhere
        row(14.0, Verdict.FAIL, "stock"),
        row(4.0, Verdict.FAIL, "stock"),
        row(30.0, Verdict.FAIL, "slide"),
        row(10.1, Verdict.PASS, "slide"),
    )
    listed = [(line.result.job.profile, entry.measured) for _, line, entry in furthest_from_theory(found(*rows), 10)]
    assert listed == [("slide", 30.0), ("stock", 4.0)]
