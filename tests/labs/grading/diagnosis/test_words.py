"""Numbers and diagnoses in words."""

from __future__ import annotations

import math

import numpy as np
import pytest

from labs.grading.diagnosis.deviations import Answer, Right
from labs.grading.diagnosis.findings import Counterexample, Diagnosis
from labs.grading.diagnosis.fingerprints import known
from labs.grading.diagnosis.probes.probe import usual
from labs.grading.diagnosis.words import MOST, called, compared, shown, told

FIRST, SECOND = known("impulse_magnitude").mistakes[:2]

EXAMPLE = Counterexample(
    "impulse_magnitude", usual("down", -2.0, 0.5), ("v", "e"), Answer(-1.0), Right((np.array(1.0),), (1.0,))
)


# Numbers


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (1 / 3, "0.333333"),
        (-0.0, "0"),
        (1e-12, "1e-12"),
        (math.inf, "inf"),
        (True, "True"),
        (np.array([True, False]), "(True, False)"),
        ([1, 2.5], "(1, 2.5)"),
        (((1.0, 2), np.zeros(2)), "((1, 2), (0, 0))"),
        ("up", "'up'"),
        (np.zeros(MOST), f"({', '.join(['0'] * MOST)})"),
        (np.zeros((1, MOST + 1)), f"an array (1, {MOST + 1})"),
        (np.array([[1.0, 0.0], [2.0, 1.0]]), "((1, 0), (2, 1))"),
        (np.diag([1.0, 2.0]), "diag(1, 2)"),
        (np.zeros((3, 3)), "((0, 0, 0), (0, 0, 0), (0, 0, 0))"),
        (np.arange(15) % 7 == 2, "an array (15,), True at (2, 9)"),
        (np.zeros(15, dtype=bool), "an array (15,)"),
        (np.eye(2, dtype=bool), "((True, False), (False, True))"),
        (np.zeros((2, 3)), "((0, 0, 0), (0, 0, 0))"),
        (np.ones((1, 1)), "((1,),)"),
        (np.array([[1.0, -2, 3]] * 4 + [[0, 4, 5]]), "an array (5, 3) between (0, -2, 3) and (1, 4, 5)"),
        (np.arange(15).reshape(5, 3), "an array (5, 3)"),
    ],
)
def test_a_value_is_shown_in_few_digits_and_a_long_array_as_its_shape_or_box(value, words):
    assert shown(value) == words


def test_arguments_are_shown_with_their_names():
    assert called(("v", "e"), (-2.0, np.ones(2))) == "v=-2, e=(1, 1)"
    assert called(("v", "e"), (-2.0,)) == "v=-2"


@pytest.mark.parametrize(
    ("answer", "right", "came"),
    [
        (Answer(2), (1.0,), "2"),
        (Answer((2, [1, 2])), (1.0, [1.0, 1.0]), "2, (1, 2)"),
        (Answer(error="ValueError: no"), (1.0,), "ValueError: no"),
        (Answer("up"), (1.0,), "the text 'up' instead of a number or an array"),
        (Answer(2.0), (1.0, 1.0), "one float instead of 2 arrays"),
        (Answer([2.0]), (1.0,), "(2,) of shape (1,) instead of ()"),
        (Answer(([2.0], 1.0)), (1.0, 1.0), "(2,), 1 of shape (1,), () instead of (), ()"),
    ],
)
def test_the_answer_is_shown_above_what_physics_says(answer, right, came):
    arrays = tuple(np.asarray(each) for each in right)
    physics = ", ".join(shown(each) for each in arrays)
    assert compared(answer, Right(arrays, (1.0,) * len(arrays))) == f"gives   {came}\nphysics {physics}"


def test_what_rounding_leaves_of_zero_is_shown_as_zero():
    right = Right((np.array([0.0, 3.0]),), (3.0,))
    assert "gives   (0, 2)" in compared(Answer([-2.2e-16, 2.0]), right)
    assert "gives   (1e-06, 2)" in compared(Answer([1e-6, 2.0]), right)
    small = Right((np.array([0.0, 3e-9]),), (3e-9,))
    assert "gives   (1e-16, 3e-09)" in compared(Answer([1e-16, 3e-9]), small)


def words(verdict, *mistakes, **more):
    return " ".join(told(Diagnosis("f", verdict, mistakes, **more)).split())


# A diagnosis


def test_each_verdict_has_its_own_words():
    assert words("right") == "f: right on every probe."
    assert words("unwritten", crashes=("no",), accepted=("less",)) == "f: not written yet."
    assert words("crashes", crashes=("no",)) == "f: it ends in an error."
    assert words("named", FIRST) == f"f: {FIRST.rationale} Hint: {FIRST.help}"
    assert words("likely", FIRST) == f"f: most of its numbers fit this mistake: - {FIRST.rationale} Hint: {FIRST.help}"
    several = words("several", FIRST, SECOND)
    assert several.endswith(f"and do not say which it is: - {FIRST.rationale} - {SECOND.rationale}")
    assert "Hint" not in several
    for verdict in ("shape", "one at a time", "unknown"):
        assert words(verdict).startswith("f: ")


def test_further_findings_are_added_to_a_verdict():
    example = "For example impulse_magnitude(v=-2, e=0.5), down gives -1 physics 1"
    assert words("unknown", counterexample=EXAMPLE).endswith(example)
    in_place = "it writes into its arguments, as a += b and a[0] = b do: the caller's own arrays change."
    assert words("right", changes_input=True) == f"f: its answers are right, but {in_place}"
    assert words("wrong", changes_input=True) == f"f: {in_place}"
    assert words("named", FIRST, changes_input=True).endswith(f"Hint: {FIRST.help} I{in_place[1:]}")
    assert words("right", accepted=("less", "more")).endswith("It should refuse, with a ValueError: less; more.")
    assert words("unknown", crashes=("first", "second")).endswith("On some input it ends in an error: first")
    alone = "With several cases in one call it is wrong in another way besides."
    assert words("named", FIRST, one_alone=True).endswith(alone)
    crash = words("named", FIRST, one_alone=True, crash_in_many=True, crashes=("no",))
    assert crash.endswith("With several cases in one call it ends in an error: no")
    assert alone not in crash


def test_a_diagnosis_fits_a_terminal_of_80_columns():
    for entry in known("collide").mistakes:
        lines = told(Diagnosis("collide", "named", (entry,))).splitlines()
        assert max(map(len, lines)) <= 80
        assert len(lines) < 2 + (len(entry.rationale) + len(entry.help)) / 40
