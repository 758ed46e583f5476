"""Visible checks turn red at the very function that is wrong: every mutant of a solution fails a check of its function.

A mutant is a solution with one thing wrong, made by the fixed operators of `mutants`. The checks that count are those
with fixed numbers: what a run draws may catch a mistake today and miss it tomorrow. Mutants that give right numbers
everywhere are listed in `mutants.equivalents`, each with its reason.
"""

from __future__ import annotations

import contextlib
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from mutants.equivalents import reason, unmatched
from mutants.making import mutants, solution
from tests_in_process import TOPICS, Asked, collected

from reference import lecture
from reference.errors import CollisionsError

WRITTEN = [entry.name for topic in TOPICS for entry in lecture.functions_of(topic) if entry.role == "written"]
IN_EVERY_RUN = ("impulse_magnitude", "apply_impulse", "kinematic_response", "friction_force", "overlap_interval")
CHECKS = {
    name: [test for _, test, _ in tests if "with_solutions" not in test.__code__.co_names]
    for name, tests in collected("visible").items()
}
"""The visible checks of each function, without whole scenarios."""


@pytest.fixture(autouse=True)
def cache_folder():
    """No cache: nothing here runs a scenario in a worker."""


class NotDrawn:
    """Takes the place of drawn examples, which do not count here."""

    def every(self, *given):
        pass

    agree = together = every


@contextlib.contextmanager
def part(points, reason):
    yield


def is_red(name, function):
    """Whether a check of the function fails."""
    asked = Asked(name, function)
    given = {"submission": SimpleNamespace(**{name: asked}), "part": part, "examples": NotDrawn()}
    try:
        for test in CHECKS[name]:
            test(**{each: given[each] for each in test.__code__.co_varnames[: test.__code__.co_argcount]})
    except (AssertionError, CollisionsError):
        return True
    return name in asked.functions.case_by_case.functions  # right for one case alone


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in IN_EVERY_RUN else pytest.mark.slow) for name in WRITTEN]
)
def test_every_mutant_turns_a_check_of_its_function_red(name):
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        made = list(mutants(name))
        green = {mutant.name: reason(mutant) for mutant in made if not is_red(name, mutant.call)}
    assert [change for change, why in green.items() if not why] == []
    assert [mutant.name for mutant in made if reason(mutant) and mutant.name not in green] == []  # listed for nothing
    assert unmatched(name, made) == []


def test_the_sources_that_are_mutated_pass_the_checks():
    assert [name for name in WRITTEN if is_red(name, solution(name))] == []


@pytest.mark.parametrize(
    ("name", "change"),
    [
        (
            "inverse_effective_mass",
            "term dropped: _softness(body_a, normal) + _softness(body_b, normal) → _softness(body_a, normal)",
        ),
        ("apply_impulse", "sign flipped: w_b - dw_b → w_b + dw_b"),
        ("impulse_magnitude", "arm of body_b: that of arm of body_a"),
        ("inverse_effective_mass", "inverse_mass of body_b: its inverse"),
        ("collide", "in apply_impulse: term dropped: w_b - dw_b → w_b"),
        ("normal_velocity", "angular_velocity of body_b: that of angular_velocity of body_a"),
        ("normal_velocity", "in point_velocity: term dropped: velocity + np.cross(angular_velocity, arm) → velocity"),
        ("audit", "in _gained: term dropped: spin_momentum - np.cross(r, momentum) → spin_momentum"),
        ("audit", "velocity_b of after: sign flipped"),
        ("apply_impulse", "size for it: w_b - dw_b → w_b - np.abs(dw_b)"),
        ("impulse_magnitude", "arm of body_b: size for it"),
    ],
)
def test_mistakes_about_the_second_body_are_among_the_mutants(name, change):
    with np.errstate(all="ignore"):
        found = [mutant for mutant in mutants(name) if mutant.name == change]
        assert len(found) == 1
        assert is_red(name, found[0].call)
