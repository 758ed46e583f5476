"""Impulses: moments of inertia, orientations, and the inverse inertia in the world."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions.impulse import (
    box_inertia,
    rod_inertia,
    rotation_matrix,
    sphere_inertia,
    world_inertia,
    world_inverse_inertia,
)

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
QUATERNION = (
    st.tuples(*[st.floats(-1, 1)] * 4)
    .map(np.array)
    .filter(lambda q: np.linalg.norm(q) > 1e-3)
    .map(lambda q: q / np.linalg.norm(q))
)


@given(QUATERNION)
def test_a_quaternion_turns_vectors_as_scipy_says(orientation):
    rotation = oracle("scipy.spatial.transform").Rotation
    expected = rotation.from_quat(np.roll(orientation, -1)).as_matrix()  # scipy has w last
    assert rotation_matrix(orientation) == pytest.approx(expected, abs=2e-15)  # roundings of sums of products below 1
    assert rotation_matrix(-orientation) == pytest.approx(expected, abs=2e-15)


def test_a_quarter_turn_about_z_takes_x_to_y():
    half = math.sqrt(0.5)
    assert rotation_matrix((half, 0, 0, half)) @ (1, 0, 0) == pytest.approx([0, 1, 0], abs=1e-15)


def test_a_single_precision_quaternion_gives_an_exact_rotation():
    single = np.array([0.5, 0.1, -0.7, 0.5], dtype=np.float32) / np.float32(1.0)
    matrix = rotation_matrix(single)
    assert matrix @ matrix.T == pytest.approx(np.eye(3), abs=1e-15)


def test_moments_are_the_sums_over_many_small_parts_of_the_body():
    # n midpoints along an edge miss a share 1/n² of its moment: 4e-4 for 50
    mass, size = 3.0, np.array([1.0, 2.0, 0.5])
    part = np.stack(np.meshgrid(*[(np.arange(50) + 0.5) / 50 - 0.5] * 3), axis=-1).reshape(-1, 3)
    share = mass / len(part)

    def moments(places, each):
        return each * ((places**2).sum(axis=-1)[:, None] - places**2).sum(axis=0)

    assert box_inertia(mass, size) == pytest.approx(moments(part * size, share), rel=5e-4)
    inside = (
        2 * part[(part**2).sum(axis=-1) <= 0.25]
    )  # a ball of radius 1; a tenth of its parts are its rim, cut raggedly
    assert sphere_inertia(mass, 1.0) == pytest.approx(moments(inside, mass / len(inside)), rel=1e-2)
    line = np.outer((np.arange(50) + 0.5) / 50 - 0.5, (0, 0, 2.0))
    assert rod_inertia(mass, 2.0) == pytest.approx(moments(line, mass / 50), rel=5e-4)


@given(st.tuples(*[st.floats(1e-9, 1e9)] * 3))
def test_the_moments_of_the_thinnest_box_are_right_to_the_last_digit(size):
    # m (b² + c²)/12 about a: taken as (a² + b² + c²) − a² a needle would have lost its own moment to rounding
    exact = [sum(Fraction(x) ** 2 for x in size) - Fraction(own) ** 2 for own in size]
    assert box_inertia(12.0, size) == pytest.approx([float(moment) for moment in exact], rel=1e-15)


def test_moments_of_inertia_of_mujocos_ball_and_box():
    mujoco = oracle("mujoco")
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody>"
        "<body><freejoint/><geom type='sphere' size='.3' mass='2'/></body>"
        "<body><freejoint/><geom type='box' size='.5 1 .25' mass='3'/></body>"
        "</worldbody></mujoco>"
    )
    assert sphere_inertia(2.0, 0.3) == pytest.approx(model.body_inertia[1], rel=1e-14)
    # MuJoCo sorts the axes of a body, and says so in its orientation
    turned = world_inertia(model.body_inertia[2], model.body_iquat[2])
    assert np.diag(box_inertia(3.0, (1.0, 2.0, 0.5))) == pytest.approx(turned, abs=1e-14)


@pytest.mark.statement(18, oracle="numpy.linalg.inv of the turned inertia")
@given(QUATERNION, st.tuples(*[st.floats(1e-2, 1e2)] * 3))
def test_inertia_and_inverse_inertia_in_the_world_are_inverse(orientation, moments):
    rotation = oracle("scipy.spatial.transform").Rotation
    turn = rotation.from_quat(np.roll(orientation, -1)).as_matrix()
    there = turn @ np.diag(moments) @ turn.T
    # Moments 1e4 apart: the inverse of the matrix is right to 1e4 roundings of its largest entry, 1e2
    assert world_inverse_inertia(moments, orientation) == pytest.approx(np.linalg.inv(there), abs=1e-9)
    assert world_inertia(moments, orientation) == pytest.approx(there, abs=1e-12)


def test_infinite_moments_and_zero_moments_both_give_no_turning():
    found = world_inverse_inertia((math.inf, 0.0, 4.0), UPRIGHT)
    assert found.tolist() == [[0, 0, 0], [0, 0, 0], [0, 0, 0.25]]


def test_all_moments_of_an_immovable_body_are_infinite():
    for moments in (sphere_inertia(math.inf, 0.0), box_inertia(math.inf, (1, 0, 0)), rod_inertia(math.inf, 0.0)):
        assert moments.tolist() == [math.inf] * 3
        assert not world_inverse_inertia(moments, UPRIGHT).any()


def test_bodies_without_extent_have_no_inertia():
    assert sphere_inertia(2.0, 0.0).tolist() == [0, 0, 0]
    assert rod_inertia(2.0, 0.0).tolist() == [0, 0, 0]
    assert box_inertia(6.0, (0, 0, 1)).tolist() == [0.5, 0.5, 0]


def test_a_batch_of_bodies_is_the_bodies_one_by_one():
    rng = np.random.default_rng(1)
    mass, size = rng.uniform(1, 2, 5), rng.uniform(1, 2, (5, 3))
    turn = rng.normal(size=(5, 4))
    turn /= np.linalg.norm(turn, axis=1)[:, None]
    together = world_inverse_inertia(box_inertia(mass, size), turn)
    for index in range(5):
        alone = world_inverse_inertia(box_inertia(mass[index], size[index]), turn[index])
        assert together[index] == pytest.approx(alone, abs=1e-15)
    for make in (sphere_inertia, rod_inertia):
        assert make(mass, size[:, 0]).tolist() == [make(*pair).tolist() for pair in zip(mass, size[:, 0], strict=True)]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: sphere_inertia(0.0, 1.0), "mass must be positive, not 0"),
        (lambda: sphere_inertia(1.0, -1.0), "radius must be zero or positive, not -1"),
        (lambda: sphere_inertia(1.0, math.inf), "radius must be finite"),
        (lambda: box_inertia(-1.0, (1, 1, 1)), "mass must be positive, not -1"),
        (lambda: box_inertia(1.0, (1, -1, 1)), "size must be zero or positive, not -1"),
        (lambda: box_inertia(1.0, (1, math.inf, 1)), "size must be finite"),
        (lambda: box_inertia(1.0, 1.0), r"size must have shape \(..., 3\)"),
        (lambda: rod_inertia(math.nan, 1.0), "mass must be positive, not nan"),
        (lambda: rod_inertia(1.0, -2.0), "length must be zero or positive, not -2"),
        (lambda: rod_inertia(1.0, math.inf), "length must be finite"),
        (lambda: rotation_matrix((1, 0, 0)), r"orientation must have shape \(..., 4\), not \(3,\)"),
        (lambda: rotation_matrix((1, 1, 0, 0)), "orientation must have length 1, not 1.41421"),
        (lambda: world_inverse_inertia((1, -1, 1), UPRIGHT), "inertia must be zero or positive, not -1"),
        (lambda: world_inverse_inertia((1, math.nan, 1), UPRIGHT), "inertia must be zero or positive, not nan"),
        (lambda: world_inverse_inertia(1.0, UPRIGHT), r"inertia must have shape \(..., 3\)"),
        (lambda: world_inertia((1, math.inf, 1), UPRIGHT), "inertia must be finite, not inf"),
        (lambda: world_inertia((1, -1, 1), UPRIGHT), "inertia must be zero or positive, not -1"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()
