"""A function that gives the same answer to every question of a test earns nothing, whatever the answer is."""

from __future__ import annotations

import numpy as np
import pytest
from submissions import sheet_of

from labs.grading.judging.same_answers import SameAnswers

ZEROS = np.zeros(3)
SAME = {
    "a number": (7.0, 7, np.float32(7)),
    "NaN": (np.nan, np.full(4, np.nan)),
    "a number for one case and for several": (0.0, ZEROS, np.zeros((2, 3))),
    "a row, and the same row many times": (np.array([0, 0, 1]), np.array([[0, 0, 1], [0, 0, 1]])),
    "several things": ((ZEROS, 0.0), (np.zeros((2, 3)), np.zeros(2))),
    "no numbers": (np.zeros(0), np.zeros((0, 3))),
    "no numbers in any of several things": ((np.zeros((0, 3)), np.zeros(0)),) * 2,
    "no numbers at times": (np.zeros(0), 1.0, np.ones((0, 2)), 1.0),
    "a matrix": (np.arange(4.0).reshape(2, 2),) * 2,
    "words": ("up", "up"),
    "nothing": (None, None),
}
DIFFERENT = {
    "two numbers": (0.0, 1.0),
    "a number that differs in the last place": (1.0, np.nextafter(1.0, 2.0)),
    "truth values": (True, False),
    "one of several things": ((ZEROS, 0.0), (ZEROS, 1.0)),
    "a row among rows": (np.zeros((2, 3)), np.array([[0, 0, 0], [0, 0, 1]])),
    "infinities": (np.inf, -np.inf),
    "a number and NaN": (1.0, np.nan),
    "the last of many": (*(2.0,) * 9, 3.0),
    "one answer": (1.0,),
    "no answer": (),
}
ZEROS_ALONE = """
import numpy as np


def penalty_force(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    return np.zeros(3)
"""


def found(answers):
    noted = SameAnswers()
    for answer in answers:
        noted.note(answer)
    return noted.found()


@pytest.mark.parametrize("answers", SAME.values(), ids=SAME)
def test_an_answer_that_does_not_depend_on_the_question_is_noticed(answers):
    assert found(answers).startswith("gives ")
    assert found(answers).endswith(" in every call of this test")


@pytest.mark.parametrize("answers", DIFFERENT.values(), ids=DIFFERENT)
def test_two_different_answers_are_enough_and_one_says_nothing(answers):
    assert found(answers) == ""


def test_a_function_that_fails_at_times_does_not_give_the_same_every_time():
    noted = SameAnswers()
    for answer in (0.0, 0.0):
        noted.note(answer)
    noted.note_error()
    assert noted.found() == ""


def test_zeros_earn_nothing_though_they_are_right_in_limiting_cases(tmp_path, grader):
    sheet = sheet_of(tmp_path, grader, ZEROS_ALONE, "penalty_force", topic="response")
    assert sheet.earned == 0
    said = [part.said for outcome in sheet.outcomes for part in outcome.parts]
    assert "penalty_force gives (0, 0, 0) in every call of this test" in said
