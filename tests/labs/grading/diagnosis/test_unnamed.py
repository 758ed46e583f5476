"""What a function with an unknown mistake returned is kept in a form in which two students can be compared."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from labs.grading.diagnosis.deviations import Deviation
from labs.grading.diagnosis.fingerprints.reading import known
from labs.grading.diagnosis.misconceptions import read_bank
from labs.grading.diagnosis.recognition import diagnose
from labs.grading.diagnosis.unnamed import is_enough, known_numbers, probe_keys, single_cases, value_of
from labs.grading.diagnosis.words import renamed, told
from solutions.response import kinematic_response

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")  # wrong formulas divide by zero


def found(function, name="kinematic_response"):
    """What is kept of a function."""
    return diagnose(name, lambda _, *arguments: function(*arguments)).unnamed


def for_many(velocity, normal, restitution, plane_velocity=0.0):
    """2.4 in place of 1 + e, for any number of contacts."""
    toward = np.minimum(np.sum((velocity - plane_velocity) * normal, axis=-1), 0.0)
    return velocity - 2.4 * toward[..., None] * normal


def for_one(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    """The same mistake, written as a loop for one contact."""
    toward = 0.0
    for axis in range(3):
        toward += velocity[axis] * normal[axis] - plane_velocity[axis] * normal[axis]
    if toward >= 0:
        return list(velocity)
    return [velocity[axis] - 2 * toward * normal[axis] - 0.4 * normal[axis] * toward for axis in range(3)]


def test_one_mistake_gives_the_same_numbers_however_it_is_written():
    assert found(for_many).numbers == found(for_one).numbers
    assert len(found(for_many).numbers) == len(probe_keys("kinematic_response"))


def test_what_is_kept_is_plain_data_and_shows_the_simplest_wrong_number():
    kept = found(for_many)
    assert json.loads(json.dumps(kept.numbers)) == list(kept.numbers)
    assert kept.numbers[kept.place] != 0
    assert kept.example.probe.note
    probe, right = single_cases("kinematic_response")[kept.place]
    assert probe.note == kept.example.probe.note
    assert right.scales == kept.example.right.scales


def test_nothing_is_kept_of_right_known_and_crashing_functions():
    def crashes(*_):
        raise ValueError("no")

    known_mistake = next(entry.formula for entry in read_bank() if entry.function == "kinematic_response")
    for function in (kinematic_response, known_mistake, crashes, lambda *_: None, lambda *_: "text"):
        assert found(function) is None


@pytest.mark.parametrize("beyond", [math.inf, -math.inf, math.nan, "error"])
def test_an_error_infinity_and_nan_are_all_no_number(beyond):
    def fails_at_rest(velocity, normal, *others):
        if np.ndim(velocity) == 1 and not np.any(velocity):
            if beyond == "error":
                raise ZeroDivisionError
            return np.full(3, beyond)
        return for_many(velocity, normal, *others)

    numbers = found(fails_at_rest).numbers
    assert "none" in numbers
    pairs = zip(numbers, found(for_many).numbers, strict=True)
    assert all(value in ("none", other) for value, other in pairs)


def test_numbers_are_far_closer_than_the_tolerance_and_coarser_than_the_last_digits():
    assert value_of(Deviation(0.12345678901, 1.0)) == 0.1234568
    assert value_of(Deviation(123456.78901, 1.0)) == 123456.8
    assert value_of(Deviation(1e-17, 1.0)) == 0
    assert json.dumps([value_of(Deviation()), value_of(Deviation(-1e-17, 1.0))]) == "[0, 0]"
    assert [value_of(Deviation(failure=each)) for each in ("error", "unwritten", "shape", "kind")] == [
        "none", "none", "shape", "kind",
    ]  # fmt: skip
    assert value_of(Deviation(17.0, 17.0, finite=False)) == "none"


def test_one_wrong_number_is_enough_where_all_are_numbers_and_three_where_some_are_missing():
    assert is_enough([0, 0, 0.5])
    assert not is_enough([0, 0, 0])
    assert not is_enough([])
    assert not is_enough([0.5, 0.5, "none"])
    assert is_enough([0.5, 0.5, 0.1, "none"])
    assert not is_enough(["none", "shape", "kind"])


def test_a_probe_has_a_name_of_its_own_and_known_mistakes_have_a_number_for_each():
    for function in ("kinematic_response", "penalty_force"):
        keys = probe_keys(function)
        assert len(set(keys)) == len(keys)
        assert all(len(known_numbers(function, each)) == len(keys) for each in known(function).mistakes)


def test_a_name_takes_the_place_of_the_words_for_an_unknown_mistake():
    said = told(diagnose("kinematic_response", lambda _, *arguments: for_many(*arguments)))
    assert "in a way that the lab does not know" in " ".join(said.split())
    text = renamed(said, "kinematic_response", "2.4 in place of 1 + e", "What is e for?")
    assert text.startswith("kinematic_response: 2.4 in place of 1 + e\nHint: What is e for?\n")
    assert "does not know" not in " ".join(text.split())
    assert text.endswith(said[said.index("For example") :])
    assert renamed("other words", "f", "a", "b") == "f: a\nHint: b\nother words"
