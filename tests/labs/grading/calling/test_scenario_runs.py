"""A submission in the lab's scenarios: whose functions run, what counts as right, and what is told."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from labs.grading.calling import scenario_runs
from labs.grading.calling.scenario_runs import (
    MOST_CALLS,
    SINGLE,
    WITHOUT_OTHERS,
    Mixed,
    compared_with_theory,
    with_solutions,
)
from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.errors import FunctionRaised
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction, RunFailed
from solutions.response import respond_at_impact


def submission(**functions):
    """A submission that defines these."""
    own = SimpleNamespace(function=functions.__getitem__)
    call = SimpleNamespace(implementation=lambda: own, defines=lambda name: name in functions)
    return SimpleNamespace(process=lambda: call, one_case=one_case)


def half(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    return respond_at_impact(position, velocity, acceleration, normal, restitution / 2, time_of_impact, dt)


def test_a_wrong_run_is_reported_beside_theory_and_the_engines():
    right = with_solutions(submission(respond_at_impact=respond_at_impact), "response")
    compared_with_theory(right, "dropped-ball", ["e=0.2"], ["rebound"])
    wrong = with_solutions(submission(respond_at_impact=half), "response")
    with pytest.raises(AssertionError) as raised:
        compared_with_theory(wrong, "dropped-ball", ["e=0.2"], ["rebound"])
    lines = str(raised.value).splitlines()
    assert lines[:3] == [
        "Dropped ball: bounce heights, e=0.2: first rebound ÷ drop height", "gives   0.01", "physics 0.04",
    ]  # fmt: skip
    assert lines[3].startswith("engines PyBullet 0.03999")
    assert lines[3].endswith(" (recorded)")
    assert lines[3].count("0.0") == 3
    compared_with_theory(wrong, "dropped-ball", ["e=0"], ["rebound"])
    with pytest.raises(AssertionError, match=r"e=0\.2"):
        compared_with_theory(wrong, "dropped-ball", ["e=0", "e=0.2"], ["rebound"])


def test_lists_are_as_good_as_arrays():
    listed = submission(respond_at_impact=lambda *given: tuple(part.tolist() for part in respond_at_impact(*given)))
    compared_with_theory(with_solutions(listed, "response"), "dropped-ball", ["e=0.2"], ["rebound"])


def test_a_run_takes_only_functions_of_the_topic_from_the_submission():
    code = Mixed(
        call=submission(respond_at_impact=half, side_of_plane=None, ballistic_motion=None).process(), topic="response"
    )
    assert code.function("side_of_plane")(-1.0) == -1  # of detection: the right one
    _, velocity = code.function("respond_at_impact")([0, 0, 0], [0, 0, -2], [0, 0, 0], [0, 0, 1], 1.0, 0.0, 1.0)
    np.testing.assert_allclose(velocity, [0, 0, 1])
    assert Mixed(topic="response").function("side_of_plane")(-1.0) == -1


def test_a_run_of_too_many_calls_is_stopped():
    code = with_solutions(submission(kinematic_response=lambda *_: 1.0), "response")
    for _ in range(MOST_CALLS + 1):
        code.function("kinematic_response")()
    with pytest.raises(RunFailed, match="comes to no end"):
        code.function("side_of_plane")(0.0)


def test_a_run_is_skipped_if_other_topics_have_no_answers_yet(monkeypatch):
    monkeypatch.setattr(Implementation, "function", lambda self, name: (_ for _ in ()).throw(NeedsFunction("needs it")))
    with pytest.raises(pytest.skip.Exception, match=WITHOUT_OTHERS):
        with_solutions(submission(), "response")


@pytest.mark.parametrize(
    ("changes", "right"),
    [
        ({"verdict": Verdict.PASS}, True),
        ({"verdict": Verdict.KNOWN_DEVIATION}, True),
        ({"measured": 2.0 * (1 + 0.9 * SINGLE)}, True),
        ({"measured": 2.0 * (1 - 0.9 * SINGLE)}, True),
        ({"measured": 2.0 * (1 + 1.1 * SINGLE)}, False),
        ({"measured": 2.0 * (1 - 1.1 * SINGLE)}, False),
        ({"measured": 2.0 + 9 * SINGLE, "scale": 10.0}, True),
        ({"measured": 0.9e-3 * SINGLE, "expected": 0.0}, True),
        ({"measured": 1.1e-3 * SINGLE, "expected": 0.0}, False),
        ({"measured": None}, False),
        ({"measured": 2.0, "expected": None}, False),
    ],
)
def test_a_run_is_right_within_single_precision_of_theory(changes, right, monkeypatch):
    def rows(*given):
        (first, *_), timing = compare_case(*given)
        return [
            replace(first, **{"verdict": Verdict.FAIL, "expected": 2.0, "scale": None, "measured": 3.0, **changes})
        ], timing

    monkeypatch.setattr(scenario_runs, "compare_case", rows)
    if right:
        compared_with_theory(Implementation("solutions"), "dropped-ball", ["e=0.2"], ["rebound"])
    else:
        with pytest.raises(AssertionError, match=r"bounce heights, e=0\.2") as raised:
            compared_with_theory(Implementation("solutions"), "dropped-ball", ["e=0.2"], ["rebound"])
        assert ("physics says nothing" in str(raised.value)) == ("expected" in changes and changes["expected"] is None)


def test_a_run_calls_functions_of_one_case_for_one_at_a_time():
    def single(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
        time = float(time_of_impact)  # refuses an array of several
        return respond_at_impact(position, velocity, acceleration, normal, restitution, time, dt)

    compared_with_theory(
        with_solutions(submission(respond_at_impact=single), "response"), "dropped-ball", ["e=0.2"], ["rebound"]
    )


def test_a_run_calls_functions_of_many_alone_for_all_at_once():
    def of_many(position, velocity, *others):
        if np.ndim(velocity) < 2:
            raise FunctionRaised("respond_at_impact raised IndexError")
        return respond_at_impact(position, velocity, *others)

    compared_with_theory(
        with_solutions(submission(respond_at_impact=of_many), "response"), "dropped-ball", ["e=0.2"], ["rebound"]
    )


def test_a_run_that_fails_names_the_reason():
    def broken(*_):
        raise NeedsFunction("needs respond_at_impact")

    code = with_solutions(submission(respond_at_impact=broken), "response")
    with pytest.raises(AssertionError, match=r"^Dropped ball: bounce heights, e=0\.2: .*needs respond_at_impact"):
        compared_with_theory(code, "dropped-ball", ["e=0.2"], ["rebound"])
