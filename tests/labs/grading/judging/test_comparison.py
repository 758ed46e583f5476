"""One answer beside the right one: what counts as right, and what is said where it is not."""

from __future__ import annotations

import math

import numpy as np
import pytest
from stand_ins import Function

from labs.grading.diagnosis.probes.probe import made
from labs.grading.errors import ArgumentsChanged
from labs.grading.judging.comparison import each, expect, numbers, plainly, refuse_changes
from labs.grading.judging.examples import Examples


def fails(said, answer):
    """What is said where `answer` is right and the function says something else."""
    with pytest.raises(AssertionError) as raised:
        expect(Function(lambda *_: said), ([0, 1, 0], [0, 0, 2], [3, 0, 0]), answer)
    return str(raised.value)


# One answer


@pytest.mark.parametrize(
    ("said", "answer"),
    [
        ([1000.0, 0.02], [1000.0, 0.0]),  # by the largest number, as single precision has it
        ([1e-5, 0.0], [0.0, 0.0]),
        (1e-5, 0.0),
        ([math.inf, 1.00001], [math.inf, 1.0]),
        (np.float32(0.1), 0.1),
        ([(1, 2), 3], ([1.0, 2.0], 3.0)),
        (True, True),
    ],
)
def test_an_answer_is_right_within_rounding(said, answer):
    expect(Function(lambda *_: said), (1.0,), answer)


@pytest.mark.parametrize(
    ("said", "answer"),
    [
        (1.0001e-3, 1e-3), (4e-5, 0.0),
        ([1000.0, 0.05], [1000.0, 0.0]), ([1e-4, 0.0], [0.0, 0.0]), (1e-4, 0.0), ([math.inf, 1.0001], [math.inf, 1.0]),
        ((1000.0, 0.02), (1000.0, 0.0)), ([2.0], 2.0), (2.0, [2.0, 2.0]), (math.nan, 2.0), ("2", 2.0), (None, 2.0),
        (2.0, (2.0, 2.0)), (1.0, math.inf), (math.inf, -math.inf), (False, True),
    ],
)  # fmt: skip
def test_a_wrong_answer_is_shown_with_what_physics_says(said, answer):
    text = fails(said, answer)
    assert text.startswith("signed_distance(point=(0, 1, 0), normal=(0, 0, 2), offset=(3, 0, 0))\ngives   ")
    assert "\nphysics " in text


def test_a_submission_gets_lists_as_arrays_and_other_values_unchanged():
    vector, number, flag, inner = plainly([1, 2, 3], 2, True, ([0, 1], 0.5))
    np.testing.assert_array_equal(vector, [1.0, 2.0, 3.0], strict=True)
    assert (number, flag, type(inner), inner[1]) == (2, True, tuple, 0.5)
    np.testing.assert_array_equal(inner[0], [0.0, 1.0], strict=True)
    function = Function(lambda v: v.sum())
    expect(function, ([1, 2, 3],), 6.0)
    assert function.asked[0][0].dtype == float


def test_flags_come_as_flags_so_that_not_and_and_work_on_them():
    (flags,) = plainly([True, False])
    np.testing.assert_array_equal(~flags & [True, True], [False, True], strict=True)


def test_flags_stay_flags_when_drawn_cases_are_put_side_by_side():
    probes = made("respond_at_step", (), lambda draw: (draw.vector(), draw.sign() > 0), 0)
    assert {probe.arguments[1].dtype for probe in probes if isinstance(probe.arguments[1], np.ndarray)} == {
        np.dtype(bool)
    }


def test_numbers_come_as_arrays_and_other_values_are_refused():
    one = numbers(Function(lambda v: [1, 2]), ([[0, 0, 1], [0, 0, 2]],))
    np.testing.assert_array_equal(one, [1.0, 2.0], strict=True)
    first, second = numbers(Function(lambda: (1, [2, 3])), (), count=2)
    assert (float(first), second.tolist()) == (1.0, [2.0, 3.0])
    said = r"^signed_distance\(point=1\)\ngives   the text 'up' instead of a number or an array$"
    with pytest.raises(AssertionError, match=said):
        numbers(Function(lambda v: "up"), (1.0,))
    with pytest.raises(AssertionError, match=r"gives   1 thing instead of 2$"):
        numbers(Function(lambda v: [1.0]), (1.0,), count=2)


UP = [0.0, 0.0, 1.0]
BODY = plainly([1, 2, 3], UP, UP, 1.0, np.eye(3))


@pytest.mark.parametrize(
    ("name", "arguments", "wrong", "said"),
    [
        (
            "apply_impulse",
            (BODY, BODY, UP),
            (np.zeros((0, 3)),) * 4,
            r"shape (\(0, 3\), ){3}\(0, 3\) instead of \(3,\)",
        ),
        ("normal_velocity", (BODY, BODY, UP), np.zeros(3), r"of shape \(3,\) instead of \(\)$"),
        ("world_inverse_inertia", (UP, [1.0, 0, 0, 0]), np.ones(3), r"of shape \(3,\) instead of \(3, 3\)$"),
        (
            "face_planes",
            (np.eye(3), np.array([[0, 1, 2]])),
            (UP, 0.5),
            r"of shape \(3,\), \(\) instead of \(1, 3\), \(1,\)$",
        ),
        ("candidate_pairs", (np.eye(3), np.eye(3)), np.zeros(2), r"of shape \(2,\) instead of \(n, 2\)$"),
        ("kinematic_response", (UP, UP, 0.5, UP), [], r"of shape \(0,\) instead of \(3,\)$"),
    ],
)
def test_a_property_is_asked_of_the_right_shape_alone(name, arguments, wrong, said):
    with pytest.raises(AssertionError, match=said):
        numbers(
            Function(lambda *_: wrong, name=name), plainly(*arguments), len(wrong) if isinstance(wrong, tuple) else 1
        )


def test_a_list_without_rows_fits_any_number_of_rows_and_several_cases_may_share_an_output():
    contacts = [], [], np.zeros((0, 3)), [], [], []
    assert len(numbers(Function(lambda *_: contacts, name="collect_contacts"), (1.0, 2.0, 3.0), 6)) == 6
    several = plainly([[1, 2, 3], [4, 5, 6]], UP, 0.5, UP)
    assert numbers(Function(lambda *_: np.zeros((2, 3)), name="kinematic_response"), several).shape == (2, 3)


def test_infinite_numbers_are_asked_for_where_they_may_be_right():
    ray = plainly(UP, UP, 1.0)
    assert numbers(Function(lambda *_: math.inf, name="ray_sphere"), ray, finite=False) == math.inf
    with pytest.raises(AssertionError, match="where finite numbers should be"):
        numbers(Function(lambda *_: math.inf, name="ray_sphere"), ray)


def test_a_function_that_prints_instead_of_returning_hears_so():
    for printed, why in (("2.0", "it prints, and has to return"), ("", r"is a return missing\?")):
        with pytest.raises(AssertionError, match=rf"gives   nothing \(None\): {why}\nphysics 2$"):
            expect(Function(lambda v: None, printed=printed), (1.0,), 2.0)
        with pytest.raises(AssertionError, match=rf"gives   nothing \(None\): {why}$"):
            numbers(Function(lambda v: None, printed=printed), (1.0,))


def test_writing_into_arguments_loses_the_part():
    refuse_changes(Function(abs))
    with pytest.raises(ArgumentsChanged, match="writes into its arguments"):
        refuse_changes(Function(abs, changed=(0,)))
    with pytest.raises(ArgumentsChanged, match="writes into its arguments"):
        Examples(1).together(Function(lambda v: v, changed=(0,)), lambda v: v, lambda draw: (draw.vector(),))


# A formula for one contact, for many


def test_a_formula_for_one_contact_is_called_contact_by_contact():
    many = each(lambda v, body: (v @ body[0], v * body[1]), (np.zeros(3), (np.zeros(3), 1.0)))
    v, arm, mass = np.arange(6.0).reshape(2, 1, 3), np.arange(9.0).reshape(3, 3), np.array([1.0, 2.0, 3.0])
    products, scaled = many(v, (arm, mass))
    np.testing.assert_allclose(products, np.sum(v * arm, axis=-1))
    np.testing.assert_allclose(scaled, v * mass[:, None])
    assert each(lambda v: v @ v, (np.zeros(3),))(np.ones(3)).shape == ()


def test_only_values_that_all_contacts_share_may_be_given_once():
    def draws(draw):
        return draw.unit(), draw.number(1, 2)

    def right(n, e):
        return n * e, e

    Examples(1).together(Function(lambda n, e: (n * e, e)), right, draws, single=(1,))
    Examples(1).together(Function(lambda n, e: e), lambda n, e: e, draws, single=(1,))
    with pytest.raises(AssertionError):
        Examples(1).together(Function(lambda n, e: (n[..., :1] * e, e)), right, draws, single=(1,))
    with pytest.raises(AssertionError):
        Examples(1).together(Function(lambda n, e: e.flat[0]), lambda n, e: e, draws)
    with pytest.raises(AssertionError):
        expect(Function(lambda e: 2.0), (1.0,), [2.0, 2.0])


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("up", "the text 'up' instead of"), (None, "nothing"),
        ([1.0] * 7, r"of shape \(7,\)"), ((1.0, 2.0), r"of shape \(2,\)"),
        ([[1.0], [1.0, 2.0]], "a list that is not a number or an array"), (np.zeros((0, 3)), r"of shape \(0, 3\)"),
    ],
)  # fmt: skip
def test_a_batch_without_a_usable_answer_fails_like_any_other(said, told):
    """As an AssertionError: any other error would cost the parts of the test that follow."""
    with pytest.raises(AssertionError, match=rf"(?s)signed_distance\(point=.*\ngives   .*{told}"):
        Examples(1).together(Function(lambda v: said), lambda v: v, lambda draw: (draw.vector(),))
