"""Published figures judged: what passes, what deviates for a reason, what fails and what has no number."""

from __future__ import annotations

import math

import pytest

from reference.comparison.verdicts import NOTHING_FINITE, Verdict
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.errors import EngineNotInstalled, NeedsFunction
from reference.published.answers import Answer, as_answers
from reference.published.case import Published
from reference.published.drivers import DRIVERS, NOT_SET_UP, Drivers
from reference.published.judging import compare_published, judged, passes
from reference.published.theirs import published

CASE = Published(
    number=99,
    title="A case",
    statement=1,
    kind="verification",
    source="nobody",
    setup={"height": 1.0, "drops": (1.0, 2.0)},
    expected={"speed": 2.0, "times": (1.0, 3.0)},
    tolerance={"speed": 0.1, "times": (0.1, 0.3)},
    reason="its own digits",
)
ALL = "".join(f"from solutions.{topic} import *\n" for topic in ("detection", "response", "forces"))
WRONG = "right = kinematic_response\nkinematic_response = lambda v, n, e: right(v, n, 0.9 * e)\n"
HAND, PYBULLET = load_engine("handwritten"), load_engine("pybullet")


def rows_of(speed=2.0, times=(1.0, 3.0)):
    return judged(CASE, "handwritten", as_answers(speed=speed, times=times))


def test_every_number_has_a_row_with_its_difference_and_reason():
    speed, first, second = rows_of(2.05, (0.95, 3.2))
    assert [row.place for row in (speed, first, second)] == [0, 1, 2]
    assert [row.difference for row in (speed, first, second)] == pytest.approx([0.05, -0.05, 0.2])
    assert [row.tolerance for row in (speed, first, second)] == [0.1, 0.1, 0.3]
    assert {row.reason for row in (speed, first, second)} == {"its own digits"}
    assert passes((speed, first, second))


@pytest.mark.parametrize(("speed", "verdict"), [(1.89, Verdict.FAIL), (1.91, Verdict.PASS), (2.11, Verdict.FAIL)])
def test_a_number_fails_on_either_side_of_its_tolerance(speed, verdict):
    rows = rows_of(speed)
    assert rows[0].verdict is verdict
    assert passes(rows) == (verdict is Verdict.PASS)


def test_each_number_of_a_figure_has_its_own_tolerance():
    assert [row.verdict for row in rows_of(times=(1.2, 3.2))[1:]] == [Verdict.FAIL, Verdict.PASS]


def test_a_wider_tolerance_of_an_answer_counts_with_its_own_reason():
    assert rows_of(2.4)[0].verdict is Verdict.FAIL
    wide = judged(CASE, "mujoco", {"speed": Answer(2.4, tolerance=0.5, reason="it is coarse")})[0]
    assert (wide.verdict, wide.reason) == (Verdict.PASS, "it is coarse")


@pytest.mark.parametrize(
    ("speed", "verdict"),
    [(2.48, Verdict.FAIL), (2.5, Verdict.KNOWN_DEVIATION), (2.52, Verdict.FAIL), (2.09, Verdict.PASS)],
)
def test_a_known_deviation_has_a_band_with_two_sides_and_a_reason(speed, verdict):
    given = Answer(speed, shift=0.5, shift_reason="it is late", shift_tolerance=0.01)
    row = judged(CASE, "mujoco", {"speed": given})[0]
    assert row.verdict is verdict
    assert row.note == ("it is late" if verdict is Verdict.KNOWN_DEVIATION else "")


def test_the_numbers_of_a_figure_may_deviate_one_by_one():
    times = Answer((1.5, 3.0), shift=(0.5, 0.0), shift_reason="late once", shift_tolerance=(0.01, 0.0))
    rows = judged(CASE, "mujoco", {"times": times})
    assert [row.verdict for row in rows[1:]] == [Verdict.KNOWN_DEVIATION, Verdict.PASS]
    assert not passes(rows)


def test_a_figure_without_an_answer_has_a_note_and_no_number():
    rows = judged(CASE, "mujoco", {"times": Answer(None, reason="it keeps no time")})
    assert [row.verdict for row in rows] == [Verdict.CANNOT_EXPRESS] * 3
    assert [row.note for row in rows] == ["it was not asked", "it keeps no time", "it keeps no time"]
    assert [row.expected for row in rows] == [2.0, 1.0, 3.0]
    assert [row.measured for row in rows] == [row.difference for row in rows] == [None] * 3


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_number_that_is_nan_fails(value):
    row = rows_of(value)[0]
    assert (row.verdict, row.measured, row.note) == (Verdict.FAIL, None, NOTHING_FINITE)


def asked(engine, **drivers):
    with pytest.MonkeyPatch.context() as patched:
        patched.setitem(DRIVERS, CASE.name, Drivers(**drivers))
        rows, _ = compare_published(CASE, engine)
    return [(row.verdict, row.note) for row in rows]


def test_a_case_that_an_engine_does_not_run_says_why():
    assert asked(HAND) == [(Verdict.NO_WORDS, NOT_SET_UP)]
    assert asked(HAND, why_not_in={"handwritten": "no step does it"}) == [(Verdict.CANNOT_EXPRESS, "no step does it")]
    assert asked(PYBULLET, lacking="no fluid") == [(Verdict.NO_WORDS, "no fluid")]
    assert asked(PYBULLET, why_not="no engine steers") == [(Verdict.CANNOT_EXPRESS, "no engine steers")]
    only = {
        "in_engines": lambda *_: as_answers(speed=2.0, times=(1.0, 3.0)),
        "why_not_in": {"pybullet": "no springs"},
    }
    assert asked(PYBULLET, **only) == [(Verdict.CANNOT_EXPRESS, "no springs")]


def test_an_error_of_a_driver_becomes_a_row():
    def missing(*_):
        raise NeedsFunction("needs signed_distance (detection, step 1)")

    assert asked(HAND, by_hand=missing) == [(Verdict.NEEDS, "needs signed_distance (detection, step 1)")]
    ((verdict, note),) = asked(HAND, by_hand=lambda *_: 1 / 0)
    assert verdict is Verdict.CRASHED
    assert note.startswith("ZeroDivisionError: division by zero, at line ")
    ((verdict, note),) = asked(HAND, by_hand=lambda *_: as_answers(speed=2.0, times=(1.0, 2.0, 3.0)))
    assert verdict is Verdict.CRASHED
    assert note.startswith("ValueError")


def test_an_engine_that_is_not_installed_is_asked_nothing(monkeypatch):
    def missing(_):
        raise EngineNotInstalled("it is not here")

    monkeypatch.setattr(type(PYBULLET), "module", missing)
    with pytest.raises(EngineNotInstalled, match="it is not here"):
        compare_published(published("P13"), PYBULLET)
    # But why a case cannot be said to it is known without it
    assert asked(PYBULLET, lacking="no fluid") == [(Verdict.NO_WORDS, "no fluid")]
    assert asked(PYBULLET, why_not="no engine steers") == [(Verdict.CANNOT_EXPRESS, "no engine steers")]


def test_a_published_case_by_hand_runs_the_requested_implementation(tmp_path):
    file = tmp_path / "mine.py"
    case, mine = published("P5"), load_engine("handwritten", Implementation(str(file)))
    file.write_text(ALL)
    assert compare_published(case, mine)[0] == compare_published(case, HAND)[0]
    file.write_text(ALL + WRONG)
    assert {row.verdict for row in compare_published(case, mine)[0]} == {Verdict.FAIL}
    file.write_text(ALL + "del kinematic_response\n")
    assert [row.note for row in compare_published(case, mine)[0]] == ["needs kinematic_response (response, step 1)"]
