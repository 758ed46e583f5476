"""What is right for things of everyday size alone loses a point: no test keeps to metres and seconds.

A threshold such as "slower than 1 cm/s is at rest", or "10 m is far away", gives right numbers as long as everything is
about as large as a ball. So each argument of a solution in turn is rounded to four digits after the point, or cut off
beyond some ten thousand, and the tests of the function have to notice both.
"""

from __future__ import annotations

import inspect
from collections import defaultdict
from types import SimpleNamespace

import numpy as np
import pytest
from mutants.making import solution
from tests_in_process import Asked, collected, loses_a_part

from labs.grading.judging.case_by_case import CaseByCase
from labs.grading.judging.same_answers import SameAnswers
from reference import lecture

LABS = ("impulse", "response", "friction", "polyhedra", "sweeping", "forces", "meshes", "avoidance", "world")
WRITTEN = [entry.name for topic in LABS for entry in lecture.functions_of(topic) if entry.role == "written"]
TESTS = collected("visible", "hidden")
OF_ONE_SIZE = {
    "normal", "restitution", "behind", "faces", "faces_a", "faces_b", "steps", "looks", "adhesive", "friction",
    "static_friction", "kinetic_friction", "steps_per_contact", "ends", "drag_coefficient",
    "edges", "candidates", "limit", "iterations", "first", "second", "sweeps", "most", "orientation",
}  # fmt: skip
"""Arguments without a unit."""
SPARED = {
    ("advance", "tolerance", "without the large"),
    ("mesh_sphere_contact", "mesh", "without the small"),
    ("mesh_sphere_contact", "mesh", "without the large"),
}
"""A tolerance is small, and a node meets a sphere whatever its springs and its mass are."""


def without_the_small(value):
    return np.round(value, 4)


def without_the_large(value):
    return np.where(np.isfinite(value), np.clip(value, -4e4, 4e4), value)


@pytest.fixture(autouse=True)
def cache_folder():
    """No cache: nothing here runs a scenario in a worker."""


@pytest.fixture(autouse=True)
def quiet():
    """Lengths that are rounded to nothing divide by zero."""
    with np.errstate(all="ignore"):
        yield


def seen(value, change):
    """An argument as it is seen; of the tuple of a world, all numbers that are not whole."""
    if isinstance(value, tuple):
        return tuple(seen(part, change) for part in value)
    return change(value) if np.asarray(value).dtype.kind == "f" else value


def changed(function, place, change):
    """A function that sees one of its arguments changed."""
    return lambda *given: function(*(seen(each, change) if at == place else each for at, each in enumerate(given)))


def loses(name, function):
    asked = SimpleNamespace(
        **{name: Asked(name, function)}, case_by_case=CaseByCase(), same_answers=defaultdict(SameAnswers)
    )
    tests = [(test, points) for _, test, points in TESTS[name] if "with_solutions" not in test.__code__.co_names]
    return any(loses_a_part(test, points, asked) for test, points in tests)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name == "clamp_to_circle" else pytest.mark.slow) for name in WRITTEN]
)
def test_a_function_for_things_of_everyday_size_alone_loses_points(name):
    function, unnoticed = solution(name), set()
    for place, argument in enumerate(inspect.signature(function).parameters):
        for change in (without_the_small, without_the_large):
            if argument not in OF_ONE_SIZE and not loses(name, changed(function, place, change)):
                unnoticed.add((name, argument, change.__name__.replace("_", " ")))
    assert unnoticed == {each for each in SPARED if each[0] == name}
