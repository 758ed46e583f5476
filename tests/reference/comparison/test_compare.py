"""Verdicts: how a number stands to what is expected of it, and what a run that gave none is called."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.scenarios.bouncing_ball import falling_ball
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Row, Verdict, judge, verdict_of
from reference.engines.base import AT_STEP, Engine, Method
from reference.errors import (
    CannotExpress,
    EngineNotInstalled,
    InvalidInput,
    NeedsFunction,
    OutOfMemory,
    RunFailed,
    Unforeseen,
    UnknownName,
    WorkerCrashed,
    WorkerKilled,
    WorkerTimeout,
)
from reference.prediction.bands import Term
from reference.prediction.predicted import Prediction
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Recorder, Trajectory

BIASED = Expectation(10.0, 1.0, "near", shift=-5.0, shift_reason="a known bias", shift_tolerance=0.5)
NO_TRAJECTORY = {
    NeedsFunction: Verdict.NEEDS,
    CannotExpress: Verdict.CANNOT_EXPRESS,
    EngineNotInstalled: Verdict.NOT_AVAILABLE,
    RunFailed: Verdict.CRASHED,
    Unforeseen: Verdict.CRASHED,
    WorkerCrashed: Verdict.CRASHED,
    WorkerTimeout: Verdict.LOST,
    WorkerKilled: Verdict.LOST,
    OutOfMemory: Verdict.LOST,
}
errors = pytest.mark.parametrize("error", NO_TRAJECTORY, ids=lambda error: error.__name__)


class Still(Engine):
    """An engine whose bodies stay where they are, or which fails with the given error."""

    name = "still"
    title = "a still life"

    def __init__(self, error: BaseException | None = None) -> None:
        super().__init__()
        self.error = error

    def settings(self, scenario: Scenario, profile: str) -> Settings:
        return Settings(0.1, options={"colour": "grey"})

    def method(self, scenario: Scenario, settings: Settings) -> Method:
        return Method(AT_STEP, recovery=0.25)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        if self.error:
            raise self.error
        recorder = Recorder(self.name, scenario, settings)
        bodies = scenario.bodies
        state = [n for b in bodies for n in (*b.position, *b.orientation, *b.velocity, *b.angular_velocity)]
        for _ in range(3):
            recorder.sample(state)
        return recorder.trajectory()


def height(trajectory: Trajectory) -> float:
    return float(trajectory.position("ball")[-1, 2])


def height_below_ten(trajectory: Trajectory) -> float:
    if height(trajectory) > 10:
        raise RunFailed("above ten")
    return height(trajectory)


def family(expect=None, measure=height, heights=(1.0,), scale=None) -> Family:
    """One case of balls at these heights, and one quantity."""
    scenarios = tuple(falling_ball("still/only", 0.5, value - 0.1, 0.2) for value in heights)
    return Family(
        "still",
        "Still life",
        "response",
        (3,),
        "",
        "",
        (),
        (Case("only", scenarios, {"height": 7.0}),),
        (Quantity("height", "height", "m", measure, expect, scale),),
        Curve("only", "", "", lambda trajectory: trajectory.times),
        Convergence("only", "height"),
    )


def compare(entry: Family, engine: Engine | None = None, profile: str = "tuned") -> list[Row]:
    engine = engine or Still()
    return compare_case(entry, entry.cases[0], engine, profile, engine.settings(entry.cases[0].scenarios[0], profile))[
        0
    ]


# Judging a number


@pytest.mark.parametrize(
    ("measured", "verdict"),
    [
        (10.0, Verdict.PASS),
        (9.0, Verdict.PASS),
        (11.0, Verdict.PASS),
        (11.001, Verdict.FAIL),
        (8.999, Verdict.FAIL),  # between the two bands
        (5.5, Verdict.KNOWN_DEVIATION),
        (5.0, Verdict.KNOWN_DEVIATION),
        (4.5, Verdict.KNOWN_DEVIATION),
        (5.501, Verdict.FAIL),  # better than the known bias, and still not what is known
        (4.499, Verdict.FAIL),
        (15.0, Verdict.FAIL),  # the bias has a sign
        (math.nan, Verdict.FAIL),
        (math.inf, Verdict.FAIL),
        (-math.inf, Verdict.FAIL),
    ],
)
def test_a_number_near_theory_passes_and_one_near_the_shift_is_known(measured, verdict):
    assert judge(measured, BIASED) is verdict


def test_a_number_in_both_bands_passes():
    overlapping = replace(BIASED, shift=-1.0, shift_tolerance=2.0)
    assert judge(9.5, overlapping) is Verdict.PASS
    assert judge(8.5, overlapping) is Verdict.KNOWN_DEVIATION


def test_without_a_shift_there_is_no_known_deviation():
    assert judge(10.4, Expectation(10.0, 0.1, "", shift=0.0, shift_tolerance=1.0)) is Verdict.FAIL


def test_a_tolerance_of_zero_accepts_the_exact_number_alone():
    assert judge(1.0, Expectation(1.0, 0.0, "")) is Verdict.PASS
    assert judge(math.nextafter(1.0, 2.0), Expectation(1.0, 0.0, "")) is Verdict.FAIL


@pytest.mark.parametrize(
    ("measured", "as_predicted", "verdict"),
    [
        (10.4, True, Verdict.PASS),
        (10.4, False, Verdict.FAIL),  # near theory, and nearer than the method can be
        (5.0, False, Verdict.FAIL),  # a known shift does not excuse what a recurrence does not give
        (12.0, True, Verdict.KNOWN_DEVIATION),
        (1.5, True, Verdict.KNOWN_DEVIATION),
        (0.5, True, Verdict.DISAGREES),  # as far off as the quantity is large, within the tolerance
        (0.0, True, Verdict.DISAGREES),
        (-3.0, True, Verdict.DISAGREES),
        (20.0, True, Verdict.DISAGREES),
        (math.nan, True, Verdict.FAIL),
    ],
)
def test_where_a_recurrence_predicts_a_number_it_must_be_that(measured, as_predicted, verdict):
    assert judge(measured, BIASED, as_predicted) is verdict


def test_a_quantity_that_is_nothing_in_theory_has_no_size_to_be_off_by():
    assert judge(3.0, Expectation(0.0, 1.0, ""), True) is Verdict.KNOWN_DEVIATION


NUMBER = st.floats(-1e3, 1e3)
BAND = st.floats(0, 1e3)


@given(NUMBER, NUMBER, BAND, NUMBER, BAND)
def test_a_verdict_is_the_same_in_the_mirror(measured, value, tolerance, shift, shift_tolerance):
    here = Expectation(value, tolerance, "", shift, "", shift_tolerance)
    mirrored = Expectation(-value, tolerance, "", -shift, "", shift_tolerance)
    assert judge(measured, here) is judge(-measured, mirrored)


@given(NUMBER, NUMBER, BAND, NUMBER, BAND)
def test_wider_tolerances_keep_a_pass_a_pass(measured, value, tolerance, shift, shift_tolerance):
    rank = {Verdict.FAIL: 0, Verdict.DISAGREES: 1, Verdict.KNOWN_DEVIATION: 1, Verdict.PASS: 2}
    narrow = Expectation(value, tolerance, "", shift, "", shift_tolerance)
    wide = Expectation(value, 2 * tolerance, "", shift, "", 2 * shift_tolerance)
    assert rank[judge(measured, narrow)] <= rank[judge(measured, wide)]


# Rows


def test_a_row_contains_everything_its_expectation_says():
    (row,) = compare(family(lambda case, settings, method: BIASED, scale=lambda case: 4.0))
    assert (row.family, row.case, row.engine, row.profile) == ("still", "only", "still", "tuned")
    assert (row.quantity, row.unit, row.measured, row.spread) == ("height", "m", 1.0, None)
    assert (row.expected, row.tolerance, row.reason, row.shift) == (10.0, 1.0, "near", -5.0)
    assert (row.error, row.relative_error) == (-9.0, -9.0 / 4.0)
    assert row.verdict is Verdict.FAIL
    assert row.note == ""
    assert "timestep 0.1 s" in row.settings
    assert "colour grey" in row.settings


def test_an_expectation_receives_case_settings_and_method():
    seen = []

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        seen.append((case.parameters["height"], settings.timestep, method.recovery))
        return BIASED

    compare(family(expect))
    assert seen == [(7.0, 0.1, 0.25)]


def test_a_known_deviation_carries_its_reason_and_a_pass_needs_none():
    (deviating,) = compare(family(lambda *_: BIASED, heights=(5.2,)))
    (passing,) = compare(family(lambda *_: BIASED, heights=(10.2,)))
    assert (deviating.verdict, deviating.note) == (Verdict.KNOWN_DEVIATION, "a known bias")
    assert (passing.verdict, passing.note) == (Verdict.PASS, "")


def test_a_number_without_an_expectation_is_shown_and_not_judged():
    (row,) = compare(family(None))
    assert (row.verdict, row.measured, row.expected, row.error) == (Verdict.SHOWN, 1.0, None, None)


def test_an_ensemble_is_judged_by_its_mean_and_shows_its_spread():
    (row,) = compare(family(lambda *_: Expectation(2.0, 1e-12, ""), heights=(1.0, 2.0, 3.0)))
    assert row.measured == pytest.approx(2.0, abs=1e-12)  # rounding of 0.9 + 0.1
    assert row.spread == pytest.approx(math.sqrt(2 / 3))
    assert row.verdict is Verdict.PASS


class Late(Still):
    """An engine whose samples are at other times than those of the scenario, which lasts 0.2 s."""

    def __init__(self, *times: float) -> None:
        super().__init__()
        self.times = np.array(times)

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        whole = super().run(scenario, settings)
        states = ("positions", "orientations", "velocities", "angular_velocities")
        count = len(self.times)
        return replace(whole, times=self.times, **{name: getattr(whole, name)[:count] for name in states})


@pytest.mark.parametrize("times", [(0.0, 0.03), (0.0, 0.1), (0.0, 0.1, 0.199), (0.01, 0.1, 0.2)])
def test_a_run_that_does_not_last_as_long_as_its_scenario_has_no_numbers(times):
    (row,) = compare(family(lambda *_: Expectation(1.0, 1.0, "")), Late(*times))
    assert row.verdict is Verdict.CRASHED
    assert f"lasts from 0 to 0.2 s, and the samples are from {times[0]:g} to {times[-1]:g} s" in row.note
    (whole,) = compare(family(lambda *_: Expectation(1.0, 1.0, "")), Late(0.0, 0.1, 0.2))
    assert whole.verdict is Verdict.PASS


def speed(trajectory: Trajectory) -> float:
    return float(np.max(np.linalg.norm(trajectory.velocity("ball"), axis=-1)))


class Falling(Still):
    """An engine whose ball is said to be elsewhere, and at another speed, from the second sample on."""

    def __init__(self, way: float, velocity: float) -> None:
        super().__init__()
        self.way, self.velocity = way, velocity

    def run(self, scenario: Scenario, settings: Settings) -> Trajectory:
        found = super().run(scenario, settings)
        position, velocity, ball = found.positions.copy(), found.velocities.copy(), scenario.index("ball")
        position[1:, ball, 2] -= self.way
        velocity[1:, ball, 2] -= self.velocity
        return replace(found, positions=position, velocities=velocity)


@pytest.mark.parametrize(
    ("measure", "theory", "engine", "is_evidence"),
    [
        (height, 0.7, Falling(0.3, 1.0), True),  # at rest it would be 1 m high
        (height, 1.0, Falling(0.0, 0.0), False),
        (height, 0.98, Falling(0.03, 0.0), False),  # near enough to the start
        (speed, 2.0, Falling(0.0, 2.0), True),
        (speed, 0.0, Falling(0.3, 0.0), False),
    ],
)
def test_a_check_that_bodies_at_rest_in_their_starts_would_pass_is_no_evidence(measure, theory, engine, is_evidence):
    (row,) = compare(family(lambda *_: Expectation(theory, 0.05, ""), measure), engine)
    assert (row.verdict, row.evidence) == (Verdict.PASS, is_evidence)
    (failed,) = compare(family(lambda *_: Expectation(theory + 1.0, 0.05, ""), measure), engine)
    assert (failed.verdict, failed.evidence) == (Verdict.FAIL, True)  # whatever is at rest: a failure counts


@pytest.mark.parametrize("kind", ["cost", "reported"])
def test_what_a_run_costs_or_reports_is_not_compared_with_a_recurrence(kind):
    found = predicted(1.5, 2.0, 2.5)
    own = replace(found.quantities[0], **{kind: True})
    (row,) = compare(replace(found, quantities=(replace(own, expect=None),)))
    assert (row.verdict, row.predicted) == (Verdict.SHOWN, None)
    (judged,) = compare(replace(found, quantities=(replace(own, expect=lambda *_: Expectation(2.0, 0.1, "")),)))
    assert judged.verdict is Verdict.PASS


def predicted(*heights: float | None, near: float = 1e-9) -> Family:
    """Balls 1, 2 and 3 m high, and a prediction that has them at these heights, or has none."""
    found = family(lambda *_: replace(BIASED, value=2.0), heights=(1.0, 2.0, 3.0))
    wanted = dict(zip(found.cases[0].scenarios, heights, strict=True))

    def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
        if wanted[scenario] is None:
            return None
        there = falling_ball("there", 0.5, wanted[scenario] - 0.1, 0.2)
        return Prediction(Still().run(there, settings), (Term("near", near),))

    return replace(found, predict=predict)


def test_every_member_of_an_ensemble_is_judged_by_its_own_prediction():
    (row,) = compare(predicted(1.0, 2.0, 3.0))
    assert (row.verdict, row.values) == (Verdict.PASS, pytest.approx((1.0, 2.0, 3.0)))
    assert (row.predicted, row.off, row.shift) == (pytest.approx(2.0), pytest.approx(0.0, abs=1e-12), 0.0)
    (scattered,) = compare(predicted(1.001, 2.0, 2.999))  # the mean is right, two members are not
    assert scattered.verdict is Verdict.FAIL
    assert scattered.predicted == pytest.approx(2.0)
    assert abs(scattered.off) == pytest.approx(1e-3)
    assert scattered.note.startswith("predicted ")
    (accepted,) = compare(predicted(1.001, 2.0, 2.999, near=1e-3))
    assert accepted.verdict is Verdict.PASS
    assert accepted.band == pytest.approx(2.999e-3)  # a share of the number, or of one unit


def test_a_tie_costs_only_its_own_member_the_prediction():
    (row,) = compare(predicted(None, 2.0, 3.0))
    assert (row.verdict, row.predicted) == (Verdict.PASS, pytest.approx(2.0))
    (wrong,) = compare(predicted(None, 2.0, 2.4))
    assert (wrong.verdict, wrong.off, wrong.note) == (Verdict.FAIL, pytest.approx(0.6), "predicted 2.4, measured 3")
    assert wrong.predicted == pytest.approx(1.8)
    (most,) = compare(predicted(None, 2.7, None))  # theory judges
    assert (most.verdict, most.predicted) == (Verdict.PASS, None)


@pytest.mark.parametrize(("heights", "off"), [((1.001, 2.0, 2.996), 4e-3), ((1.005, 2.0, 2.998), -5e-3)])
def test_the_difference_from_a_prediction_has_the_sign_of_measured_less_predicted(heights, off):
    (row,) = compare(predicted(*heights))
    assert row.off == pytest.approx(off)


def test_a_number_that_the_recurrence_does_not_have_fails():
    found = predicted(1.0, 2.0, 11.0)
    (row,) = compare(replace(found, quantities=(Quantity("height", "height", "m", height_below_ten, None),)))
    assert (row.verdict, row.note) == (Verdict.FAIL, "predicted: above ten")


def test_a_number_that_neither_has_disagrees_with_theory_as_it_must():
    found, rising = predicted(11.0, 12.0, 13.0), family(lambda *_: BIASED, height_below_ten, (11.0, 12.0, 13.0))
    heights = dict(zip(rising.cases[0].scenarios, found.cases[0].scenarios, strict=True))
    entry = replace(rising, predict=lambda scenario, *more: found.predict(heights[scenario], *more))
    (row,) = compare(entry)
    assert (row.verdict, row.note, row.measured) == (Verdict.DISAGREES, "above ten", None)


def test_a_quantity_without_theory_is_judged_by_its_prediction_alone():
    found = predicted(1.0, 2.0, 3.0)
    (row,) = compare(replace(found, quantities=(replace(found.quantities[0], expect=None),)))
    assert (row.verdict, row.expected) == (Verdict.PASS, None)


ENDLESS = {
    "never": lambda trajectory: math.inf,
    "one of them never": lambda trajectory: math.inf if height(trajectory) > 1.5 else 1.0,
    "never either way": lambda trajectory: math.copysign(math.inf, height(trajectory) - 1.5),  # ∞ − ∞ has no mean
    "no number": lambda trajectory: math.nan,
    "a mean that no float holds": lambda trajectory: 1.7e308,
}


@pytest.mark.parametrize("what", ENDLESS)
def test_an_event_that_did_not_happen_fails_where_it_is_expected(what):
    (judged,) = compare(family(lambda *_: BIASED, measure=ENDLESS[what], heights=(1.0, 2.0)))
    (shown,) = compare(family(None, measure=ENDLESS[what], heights=(1.0, 2.0)))
    for row, verdict in ((judged, Verdict.FAIL), (shown, Verdict.SHOWN)):
        assert (row.verdict, row.measured, row.spread, row.error) == (verdict, None, None, None)
        assert row.note == "no finite number: the event to be measured did not happen before the run ended"
    assert judged.expected == BIASED.value


def test_a_spread_that_no_float_holds_is_left_out():
    (row,) = compare(family(measure=lambda trajectory: 1e200 * height(trajectory), heights=(1.0, 2.0)))
    assert (row.measured, row.spread) == (1.5e200, None)


@pytest.mark.parametrize("name", ["measured", "spread", "expected", "tolerance", "shift", "scale"])
@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_a_row_carries_no_number_that_is_not_finite(name, value):
    with pytest.raises(InvalidInput, match=f"still/only, height: {name} is"):
        replace(compare(family())[0], **{name: value})


def test_a_quantity_without_a_number_fails_and_the_others_are_judged():
    def never(trajectory: Trajectory) -> float:
        raise RunFailed("the ball never stops")

    entry = family(lambda *_: Expectation(1.0, 1e-12, ""))
    entry = replace(entry, quantities=(replace(entry.quantities[0], name="stop", measure=never), *entry.quantities))
    stop, found = compare(entry)
    assert (stop.verdict, stop.note, stop.measured) == (Verdict.FAIL, "the ball never stops", None)
    assert found.verdict is Verdict.PASS
    (shown,) = compare(family(None, measure=never))
    assert (shown.verdict, shown.note, shown.measured) == (Verdict.SHOWN, "the ball never stops", None)


def test_a_scale_of_zero_gives_no_percentage():
    (row,) = compare(family(lambda *_: BIASED, scale=lambda case: 0.0))
    assert row.error == -9.0
    assert row.relative_error is None


def test_rows_that_differ_only_in_their_settings_line_are_equal():
    (row,) = compare(family())
    assert replace(row, settings="another line") == row
    assert replace(row, measured=2.0) != row


# Runs that gave no trajectory


@errors
def test_each_error_has_its_verdict(error):
    assert verdict_of(error("why")) is NO_TRAJECTORY[error]


@errors
def test_a_failed_run_gives_one_row_with_the_reason(error):
    entry = family(lambda *_: BIASED)
    engine = Still(error("because of the moon"))
    rows, trajectories = compare_case(entry, entry.cases[0], engine, "stock", Settings(0.1))
    assert [(row.verdict, row.note) for row in rows] == [(NO_TRAJECTORY[error], "because of the moon")]
    assert (rows[0].case, rows[0].profile, rows[0].measured, rows[0].error) == ("only", "stock", None, None)
    assert trajectories == []


@pytest.mark.parametrize(
    ("error", "note"),
    [
        (ZeroDivisionError("by the moon"), "ZeroDivisionError: by the moon"),
        (ZeroDivisionError(), "ZeroDivisionError"),
        (KeyError("moon"), "KeyError: 'moon'"),
        (np.linalg.LinAlgError("two\n lines"), "numpy.linalg.LinAlgError: two lines"),
    ],
    ids=str,
)
def test_an_unforeseen_error_is_a_crash_of_its_case(error, note):
    (row,) = compare(family(lambda *_: BIASED), Still(error))
    assert (row.case, row.verdict, row.measured) == ("only", Verdict.CRASHED, None)
    assert re.fullmatch(rf"{re.escape(note)}, at line \d+ of test_compare\.py, in \w+", row.note)


def test_an_engine_that_cannot_name_its_method_crashed():
    class Nameless(Still):
        def method(self, scenario: Scenario, settings: Settings) -> Method:
            raise AttributeError("kind")

    (row,) = compare(family(lambda *_: BIASED), Nameless())
    assert row.verdict is Verdict.CRASHED
    assert re.fullmatch(r"AttributeError: kind, at line \d+ of test_compare\.py, in method", row.note)


@pytest.mark.parametrize("expect", [None, lambda *_: Expectation(1.0, 1e-12, "")])
def test_an_unforeseen_error_of_a_measurement_costs_its_quantity_alone(expect):
    def broken(trajectory: Trajectory) -> float:
        raise IndexError("out of the sky")

    entry = family(expect)
    entry = replace(entry, quantities=(replace(entry.quantities[0], name="stop", measure=broken), *entry.quantities))
    stop, found = compare(entry)
    assert (stop.quantity, stop.verdict, stop.measured) == ("stop", Verdict.CRASHED, None)
    assert re.fullmatch(r"IndexError: out of the sky, at line \d+ of test_compare\.py, in broken", stop.note)
    assert (found.verdict, found.measured) == (Verdict.PASS if expect else Verdict.SHOWN, 1.0)


def test_a_measurement_without_enough_memory_loses_its_case_and_fails_nothing():
    def greedy(trajectory: Trajectory) -> float:
        return float(np.zeros(2**50).sum())

    entry = family(lambda *_: BIASED)
    (row,) = compare(replace(entry, quantities=(replace(entry.quantities[0], measure=greedy),)))
    assert (row.verdict, row.measured) == (Verdict.LOST, None)
    assert row.note.startswith("it ran out of memory, at line ")


@pytest.mark.parametrize("error", [InvalidInput("no such moon"), UnknownName("moon", "phobos", ())], ids=str)
def test_a_mistake_of_the_caller_is_raised(error):
    with pytest.raises(type(error)) as caught:
        compare(family(), Still(error))
    assert caught.value is error


def test_an_interrupt_is_raised():
    with pytest.raises(KeyboardInterrupt):
        compare(family(), Still(KeyboardInterrupt()))


# Looking up


def test_an_unknown_case_or_quantity_is_refused_with_the_known_ones():
    entry = family()
    assert entry.case("only") is entry.cases[0]
    assert entry.quantity("height") is entry.quantities[0]
    with pytest.raises(UnknownName, match=r"only") as case:
        entry.case("lonely")
    with pytest.raises(UnknownName, match=r"height") as quantity:
        entry.quantity("hight")
    assert (case.value.choices, quantity.value.choices) == (("only",), ("height",))


def test_means_and_spreads_are_plain_floats():
    (row,) = compare(family(lambda *_: BIASED, heights=(1.0, 2.0)))
    assert type(row.measured) is float
    assert type(row.spread) is float
