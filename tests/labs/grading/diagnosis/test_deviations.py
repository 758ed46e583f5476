"""How far an answer is off, in one number: what counts as right, as the same mistake, and as no answer."""

from __future__ import annotations

import math

import numpy as np
import pytest

from labs.grading.diagnosis.deviations import TOLERANCE, Answer, Deviation, Right, ask, deviation_of, outputs
from labs.grading.diagnosis.probes.probe import edge, usual
from labs.grading.errors import FunctionMissing, FunctionRaised, GraderFailed
from reference.errors import NeedsFunction


def right(*arrays, scales=()):
    found = tuple(np.asarray(array, dtype=float) for array in arrays)
    return Right(found, scales or (1.0,) * len(found))


def off(answer, *arrays, scales=()):
    return deviation_of(Answer(answer), right(*arrays, scales=scales))


# What is right


def test_an_answer_is_right_within_the_tolerance_of_its_scale():
    for sign in (-1, 1):
        assert off([2.0, 5.0 + sign * 0.9 * TOLERANCE], [2.0, 5.0]).right
        assert not off([2.0, 5.0 + sign * 1.1 * TOLERANCE], [2.0, 5.0]).right
        assert off([2.0, 5.0 + sign * 9 * TOLERANCE], [2.0, 5.0], scales=(10.0,)).right
        assert not off([2.0, 5.0 + sign * 11 * TOLERANCE], [2.0, 5.0], scales=(10.0,)).right


def test_single_precision_is_right_and_half_a_part_in_ten_thousand_wrong():
    assert off(1.0 + 2e-5, 1.0) == Deviation(0.0, 0.0)
    assert not off(1.0 + 5e-5, 1.0).right


def test_each_output_is_compared_on_its_own_scale():
    assert off((100.0 + 50 * TOLERANCE, 1.0), 100.0, 1.0, scales=(100.0, 1.0)).right
    assert not off((100.0, 1.0 + 50 * TOLERANCE), 100.0, 1.0, scales=(100.0, 1.0)).right


def test_infinity_and_nan_are_right_only_where_they_are_expected():
    values = (math.inf, -math.inf, math.nan, 0.0, -5.0)
    deviations = {(mine, theirs): off(mine, theirs) for mine in values for theirs in values}
    for i, mine in enumerate(values):
        for j, theirs in enumerate(values):
            assert deviations[mine, theirs].right == (i == j), (mine, theirs)
            assert deviations[mine, theirs].spread == 0 or deviations[mine, theirs].spread > 4


def test_each_wrong_infinity_and_nan_has_its_own_deviation():
    finite = [off(mine, 1.0).total for mine in (math.inf, -math.inf, math.nan, 2.0)]
    infinite = [off(mine, math.inf).total for mine in (-math.inf, math.nan, 1.0, 2.0)]
    assert len({round(number, 6) for number in finite}) == len({round(number, 6) for number in infinite}) == 4
    assert finite[0] == -finite[1] > 0


def test_errors_in_other_components_have_another_deviation():
    assert off([1.0, 0.0, 0.0], np.zeros(3)).total != off([0.0, 1.0, 0.0], np.zeros(3)).total
    mixed = off([1.0, -1.0], np.zeros(2))
    assert abs(mixed.total) < mixed.spread


# What is the same mistake


def test_deviations_agree_within_the_tolerance_of_their_sum():
    known = Deviation(10.0, 10.0)
    assert Deviation(10.0 + 10.9 * TOLERANCE, 10.0).agrees(known)
    assert not Deviation(10.0 + 11.1 * TOLERANCE, 10.0).agrees(known)
    assert Deviation(10.0 + 90 * TOLERANCE, 100.0).agrees(known)
    assert Deviation(-10.0, 10.0).agrees(Deviation(-10.0, 10.0))
    assert not Deviation(-10.0, 10.0).agrees(known)


def test_a_right_answer_agrees_with_no_wrong_one():
    cancels = Deviation(0.0, 3.0)  # two errors of the same size
    assert not cancels.right
    assert not Deviation().agrees(cancels)
    assert not cancels.agrees(Deviation())
    assert Deviation().agrees(Deviation())


def test_a_failure_agrees_only_with_the_same_failure():
    for other in (Deviation(), Deviation(0.0, 3.0), Deviation(failure="shape")):
        assert not Deviation(failure="error").agrees(other)
        assert not other.agrees(Deviation(failure="error"))
    assert Deviation(failure="error").agrees(Deviation(failure="error"))
    assert not Deviation(failure="error").right


# What is no answer


@pytest.mark.parametrize(
    ("value", "count"), [("up", 1), (1j, 1), ([[1], [1, 2]], 1), (3.0, 2), ("up", 2), ({1: 2.0, 3: 4.0}, 2),
                         ((1.0, 2.0, 3.0), 2), ((1.0,), 2), (np.array(3.0), 2)]
)  # fmt: skip
def test_an_answer_needs_the_right_count_of_numeric_outputs(value, count):
    assert outputs(value, count) is None
    assert deviation_of(Answer(value), right(*(0.0,) * count)).failure == "kind"


@pytest.mark.parametrize("value", [[1, 2], (1, 2), np.array([1, 2], np.float32), [True, 2]])
def test_numbers_are_an_answer_in_any_form(value):
    (one,) = outputs(value, 1)
    np.testing.assert_array_equal(one, [1.0, 2.0], strict=True)
    first, second = outputs(value, 2)
    assert (first.dtype, float(first), float(second)) == (np.dtype(float), 1.0, 2.0)


def test_a_wrong_shape_is_wrong_even_if_numpy_would_broadcast_it():
    for value in (1.0, [1.0], [[1.0, 1.0]], [[1.0], [1.0]]):
        assert off(value, [1.0, 1.0]).failure == "shape"
    assert off(([1.0], 1.0), 1.0, 1.0).failure == "shape"


def test_an_error_is_distinguished_from_an_unwritten_function():
    assert deviation_of(Answer(error="no"), right(1.0)).failure == "error"
    assert deviation_of(Answer(error="no", unwritten=True), right(1.0)).failure == "unwritten"


# Asking


def asked(function, *probes):
    return ask(lambda name, *arguments: function(*arguments), "f", probes)


@pytest.mark.parametrize(
    ("error", "told", "unwritten"),
    [
        (ValueError("so"), "ValueError: so", False),
        (NotImplementedError(), "NotImplementedError", True),
        (NeedsFunction("needs f"), "needs f", True),
        (FunctionMissing("needs f"), "needs f", True),
        (FunctionRaised("f raised E: m"), "f raised E: m", False),
    ],
)
def test_an_error_becomes_an_answer_in_words(error, told, unwritten):
    def fails(x):
        raise error

    (answer,) = asked(fails, usual("", 1.0))
    assert answer.error.startswith(told)
    assert (answer.unwritten, answer.value) == (unwritten, None)


def test_a_failure_of_the_grader_is_raised():
    def fails(x):
        raise GraderFailed("ours")

    with pytest.raises(GraderFailed):
        asked(fails, usual("", 1.0))


def test_each_probe_gets_its_own_copy_and_changes_to_it_are_noticed():
    body = (np.zeros(3), 1.0, math.nan, np.array([math.nan]))
    probe = edge("", body, np.ones(2))

    def writes(one, other):
        one[0][1] = 5.0
        return other

    assert [answer.changed for answer in asked(writes, probe, probe)] == [True, True]
    assert [answer.changed for answer in asked(lambda one, other: other, probe)] == [False]
    np.testing.assert_array_equal(probe.arguments[0][0], np.zeros(3))


def test_a_list_without_rows_is_right_where_there_are_none_of_any_length():
    nothing = Right((np.zeros((0, 3)),), (1.0,))
    assert deviation_of(Answer([]), nothing).right
    assert deviation_of(Answer(np.zeros((0, 2))), nothing).failure == "shape"
    assert deviation_of(Answer([]), Right((np.zeros((1, 3)),), (1.0,))).failure == "shape"


@pytest.mark.parametrize("columns", [(2,), (3,), (3, 3)])
def test_an_array_without_rows_has_the_columns_that_are_promised(columns):
    right = np.zeros((0, *columns))
    assert deviation_of(Answer(np.zeros(0)), Right((right,), (1.0,))).failure == "shape"
    assert deviation_of(Answer(right), Right((right,), (1.0,))).right
    assert deviation_of(Answer(([1.0], np.zeros(0))), Right((np.ones(1), right), (1.0, 1.0))).failure == "shape"
    assert deviation_of(Answer(([1.0], [])), Right((np.ones(1), right), (1.0, 1.0))).right
