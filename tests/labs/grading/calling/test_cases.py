"""A call with several contacts taken apart into calls for one each, and put together again."""

from __future__ import annotations

import numpy as np
import pytest

from labs.grading.calling.cases import OneCase

SCALED = OneCase((0, 1))
"""A number and a vector."""
PUSHED = OneCase(((1, 0), 1), outputs=2)
"""A body of a vector and a number, and a vector; two things come back."""


def scaled(number, vector):
    assert type(number) is float
    assert vector.shape == (3,)
    return number * vector


def pushed(body, vector):
    velocity, mass = body
    return [velocity + vector, float(mass) * vector[0]]


def test_the_axes_of_the_contacts_are_those_beyond_a_single_one():
    assert SCALED.leading((2.0, np.zeros(3))) == ()
    assert SCALED.leading((2.0, (0.0, 0.0, 1.0))) == ()
    assert SCALED.leading((np.ones((2, 1)), np.zeros((4, 3)))) == (2, 4)
    assert PUSHED.leading(((np.zeros((5, 3)), 1.0), np.zeros(3))) == (5,)
    assert OneCase((1,)).leading((2.0, np.ones(3))) == (3,)  # a number for a row; an argument that is not listed


def test_each_contact_is_asked_alone_and_the_answers_stand_side_by_side():
    numbers, vectors = np.array([[1.0], [2.0]]), np.arange(12.0).reshape(4, 3)
    np.testing.assert_array_equal(SCALED.one_by_one(scaled, (numbers, vectors)), numbers[..., None] * vectors)


def test_a_body_is_taken_apart_and_each_output_put_together():
    velocity, moved = PUSHED.one_by_one(pushed, ((np.ones((2, 3)), np.array([1.0, 2.0])), np.array([3.0, 0, 0])))
    np.testing.assert_array_equal(velocity, [[4, 1, 1], [4, 1, 1]])
    np.testing.assert_array_equal(moved, [3, 6])


def test_arguments_of_any_leading_axes_become_rows_of_one_length():
    seen = []

    def rows(number, vector, flag):
        seen.append((number.shape, vector.shape, flag))
        return (number.T * vector.T).T

    numbers, vectors = np.array([[1.0], [2.0]]), np.arange(12.0).reshape(4, 3)
    found = OneCase((0, 1)).in_rows(rows, (numbers, vectors, True))
    assert seen == [((8,), (8, 3), True)]
    np.testing.assert_array_equal(found, numbers[..., None] * vectors)


def test_the_steps_of_a_run_come_before_its_cases():
    def run(number, vector):
        return np.multiply.outer(np.arange(4.0), (np.asarray(number) * np.asarray(vector).T).T)

    numbers, vectors = np.array([[1.0], [2.0]]), np.arange(15.0).reshape(5, 3)
    case, right = OneCase((0, 1), before=1), np.multiply.outer(np.arange(4.0), numbers[..., None] * vectors)
    np.testing.assert_array_equal(case.one_by_one(run, (numbers, vectors)), right)
    np.testing.assert_array_equal(case.in_rows(run, (numbers, vectors)), right)


@pytest.mark.parametrize("answer", [None, [1.0], "two"])
def test_answers_that_do_not_fit_together_are_refused(answer):
    with pytest.raises(ValueError, match="not 2 things"):
        PUSHED.one_by_one(lambda *_: answer, ((np.ones((2, 3)), 1.0), np.zeros(3)))


def test_no_contact_at_all_is_refused():
    with pytest.raises(ValueError, match="no contact"):
        SCALED.one_by_one(scaled, (np.zeros(0), np.zeros(3)))


def test_an_answer_of_another_shape_for_one_contact_is_refused():
    answers = iter([np.zeros(3), np.zeros(2)])
    with pytest.raises(ValueError, match="same shape"):
        SCALED.one_by_one(lambda *_: next(answers), (np.ones(2), np.zeros(3)))
