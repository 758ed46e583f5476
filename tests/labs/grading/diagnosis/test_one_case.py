"""What one case is, and mistakes in functions that take one case alone.

That known mistakes are named there too is in `test_known_mistakes.py`.
"""

from __future__ import annotations

import importlib

import numpy as np
import pytest
from known_mistakes import refuses_many

from labs.grading.diagnosis.deviations import Answer, Right, deviation_of, fitted
from labs.grading.diagnosis.fingerprints.reading import known
from labs.grading.diagnosis.output_names import OUTPUT_NAMES
from labs.grading.diagnosis.probes import probed, probes
from labs.grading.diagnosis.probes.one_case import one_case
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.diagnosis.words import told

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero


def solution(name):
    topic = next(entry.topic for entry in probed() if entry.name == name)
    return getattr(importlib.import_module(f"solutions.{topic}"), name)


def test_several_contacts_in_one_call_are_told_from_a_single_one():
    for entry in probed():
        case = one_case(entry.name)
        for probe in probes(entry.name):
            if probe.group != "refused":
                assert bool(case.leading(probe.arguments)) == (probe.group == "many"), (entry.name, probe)


def test_solutions_asked_one_at_a_time_give_the_right_answers_for_many():
    for entry in probed():
        case = one_case(entry.name)
        for probe, right in zip(probes(entry.name), known(entry.name).right, strict=True):
            if probe.group == "many":
                value = case.one_by_one(solution(entry.name), probe.arguments)
                answer = Answer(fitted(value, right, case.leading(probe.arguments)))
                assert deviation_of(answer, right).right, (entry.name, probe.note)


def one_radius(v, w, r, dt):
    return np.maximum(0, 1 - (np.asarray(w) + r) / (np.asarray(v) * dt))


def along_the_centres(e, f, a, b):
    apart = np.asarray(a) - np.asarray(b)
    return apart / np.linalg.norm(apart, axis=-1, keepdims=True)


def nothing_beyond_the_limit(force, limit):
    size = np.linalg.norm(force, axis=-1, keepdims=True)
    return np.where(size < np.asarray(limit)[..., None], force, 0)


@pytest.mark.parametrize(
    ("function", "mistaken"),
    [
        ("missing_probability", one_radius),
        ("edge_edge_normal", along_the_centres),
        ("clamp_to_circle", nothing_beyond_the_limit),
        ("overlap_interval", lambda *given: never_empty(*np.broadcast_arrays(*map(np.asarray, given)))),
    ],
)
def test_a_mistake_that_is_the_same_for_many_is_not_said_to_differ(function, mistaken):
    found = diagnose(function, lambda _, *given: mistaken(*given))
    assert found.mistakes
    assert not found.one_alone
    assert "another way" not in told(found)


def never_empty(x, u, r, w, dt):
    first, last = (r - x) / u, (-w - r - x) / u
    inside = (x <= r) & (x >= -w - r)
    start = np.where(u == 0, np.where(inside, 0, np.inf), np.maximum(np.minimum(first, last), 0))
    return start, np.where(u == 0, np.where(inside, dt, -np.inf), np.minimum(np.maximum(first, last), dt))


def test_right_limiting_cases_are_not_called_wrong_in_another_way():
    found = diagnose("overlap_interval", lambda _, *given: never_empty(*np.broadcast_arrays(*map(np.asarray, given))))
    said = " ".join(told(found).split())
    assert (found.verdict, found.odd, found.spares_limits) == ("likely", None, True)
    assert "limiting cases are right that it would get wrong" in said
    assert "else is wrong" not in said


def test_a_likely_mistake_with_other_numbers_for_many_is_said_to_differ():
    found = diagnose("missing_probability", lambda _, *given: one_radius(*given) / (1 + any(map(np.ndim, given))))
    assert (found.mistakes[0].id, found.one_alone) == ("missing_probability/one radius", True)


def test_a_right_function_of_one_case_makes_no_mistake():
    asked_for_many = [entry for entry in probed() if any(probe.group == "many" for probe in probes(entry.name))]
    for entry in asked_for_many[::6]:  # without those of one mesh or one solid
        found = diagnose(entry.name, refuses_many(entry.name, solution(entry.name)))
        assert (found.verdict, found.mistakes) == ("one at a time", ()), told(found)


# Outputs


def test_an_output_given_for_each_contact_is_as_right_as_given_once():
    right = Right((np.arange(3.0),), (1.0,))
    full = np.broadcast_to(np.arange(3.0), (2, 3))
    assert fitted(full, right, (2, 3)).shape == (3,)
    assert fitted(full + np.array([[0.0], [1.0]]), right, (2, 3)).shape == (2, 3)  # the two differ
    assert np.shape(fitted(full, right, (3,))) == (2, 3)  # no axis of the call


def test_everything_that_a_function_returns_has_a_name():
    several = {entry.name: len(known(entry.name).right[0].outputs) for entry in probed()}
    assert {name: len(names) for name, names in OUTPUT_NAMES.items()} == {
        name: count for name, count in several.items() if count > 1
    }


@pytest.mark.parametrize("function", ["apply_impulse", "sliding_motion", "overlap_interval"])
def test_right_numbers_in_another_order_are_no_mistake_of_physics(function):
    names = OUTPUT_NAMES[function]
    order = (*range(1, len(names)), 0)

    def turned(_, *arguments):
        value = solution(function)(*arguments)
        return tuple(value[at] for at in order)

    found = diagnose(function, turned)
    assert (found.verdict, found.mistakes, found.order) == ("another order", (), order)
    assert f"it returns {', '.join(names[at] for at in order)}, and should return {', '.join(names)}" in " ".join(
        told(found).split()
    )
