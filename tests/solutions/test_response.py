from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.response import kinematic_response

RNG_SEED = 7
COMPONENT = st.floats(-100, 100)
VELOCITY = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
DIRECTION = st.tuples(*[st.floats(-1, 1)] * 3).map(np.array).filter(lambda n: np.linalg.norm(n) > 1e-3)
NORMAL = DIRECTION.map(lambda n: n / np.linalg.norm(n))
RESTITUTION = st.floats(0, 1)
ROUNDING = 1e-12
"""Some ten roundings of velocities up to 200 m/s; a normal is a unit vector to 1e-16 only."""
UP = (0.0, 0.0, 1.0)


@pytest.mark.statement(7, oracle="arithmetic by hand")
def test_a_ball_that_drops_on_the_floor_leaves_with_e_times_its_speed():
    assert kinematic_response((0.0, 0.0, -4.0), UP, 0.75).tolist() == [0.0, 0.0, 3.0]


def test_only_the_component_along_the_normal_is_reversed():
    # Normal (0.6, 0, 0.8): the velocity 5 (−0.6, 0, −0.8) + 10 (0.8, 0, −0.6) + (0, 2, 0) comes in at 5 m/s.
    after = kinematic_response((5.0, 2.0, -10.0), (0.6, 0.0, 0.8), 0.5)
    assert after == pytest.approx([8 + 1.5, 2, -6 + 2], abs=1e-14)  # a few roundings of numbers up to 10


def test_the_elastic_response_is_the_slides_mirror():
    velocity, normal = np.array([3.0, -1.0, -2.0]), np.array([0.0, 0.6, 0.8])
    mirrored = velocity - 2 * (velocity @ normal) * normal
    assert kinematic_response(velocity, normal, 1.0) == pytest.approx(mirrored, abs=1e-15)


def test_without_restitution_the_body_slides_on_along_the_plane():
    assert kinematic_response((3.0, -1.0, -2.0), UP, 0.0).tolist() == [3.0, -1.0, 0.0]


@pytest.mark.statement(7, oracle="Newton's restitution, component by component")
@given(VELOCITY, NORMAL, RESTITUTION)
def test_a_body_leaves_with_e_times_its_normal_speed(velocity, normal, e):
    before, after = velocity @ normal, kinematic_response(velocity, normal, e) @ normal
    assert after == pytest.approx(-e * before if before < 0 else before, abs=ROUNDING)
    along = velocity - before * normal
    assert kinematic_response(velocity, normal, e) - after * normal == pytest.approx(along, abs=ROUNDING)


@pytest.mark.statement(7, oracle="the guard")
@given(VELOCITY, NORMAL, RESTITUTION)
def test_a_body_that_moves_away_or_along_is_left_alone(velocity, normal, e):
    leaving = velocity + (ROUNDING - min(velocity @ normal, 0.0)) * normal  # by a little more than rounding can undo
    assert np.array_equal(kinematic_response(leaving, normal, e), leaving)


def test_a_grazing_or_resting_body_is_left_alone():
    assert kinematic_response((3.0, -4.0, 0.0), UP, 0.5).tolist() == [3.0, -4.0, 0.0]
    assert kinematic_response((0.0, 0.0, 0.0), UP, 0.5).tolist() == [0.0, 0.0, 0.0]


@given(VELOCITY, NORMAL, RESTITUTION)
def test_resolving_the_same_collision_twice_changes_nothing_more(velocity, normal, e):
    once = kinematic_response(velocity, normal, e)
    assert kinematic_response(once, normal, e) == pytest.approx(once, abs=ROUNDING)


@pytest.mark.statement(7, oracle="energy")
@given(VELOCITY, NORMAL, RESTITUTION)
def test_a_collision_takes_one_minus_e_squared_of_the_normal_energy(velocity, normal, e):
    approach = min(velocity @ normal, 0.0)
    after = kinematic_response(velocity, normal, e)
    lost = (velocity @ velocity - after @ after) / 2  # J per kg
    # Energies up to 1.5e4 J/kg are differences of squares, rounded to some 1e-16 of that
    assert lost == pytest.approx((1 - e**2) * approach**2 / 2, abs=1e-10)


@given(VELOCITY, NORMAL)
def test_an_elastic_collision_runs_backwards_as_well(velocity, normal):
    incoming = velocity - 2 * max(velocity @ normal, 0.0) * normal
    back = -kinematic_response(-kinematic_response(incoming, normal, 1.0), normal, 1.0)
    assert back == pytest.approx(incoming, abs=ROUNDING)


@given(VELOCITY, NORMAL, RESTITUTION, VELOCITY)
def test_an_observer_who_moves_along_the_plane_sees_the_same_collision(velocity, normal, e, boost):
    along = boost - (boost @ normal) * normal
    seen = kinematic_response(velocity + along, normal, e) - along
    assert seen == pytest.approx(kinematic_response(velocity, normal, e), abs=ROUNDING)


@given(VELOCITY, NORMAL, RESTITUTION, VELOCITY)
def test_a_moving_plane_reverses_the_relative_velocity(velocity, normal, e, plane):
    # The function takes the velocity relative to the plane; the plane's own comes back on top.
    after = kinematic_response(velocity - plane, normal, e) + plane
    relative = (velocity - plane) @ normal
    assert (after - plane) @ normal == pytest.approx(-e * relative if relative < 0 else relative, abs=ROUNDING)


@given(VELOCITY, NORMAL, RESTITUTION, st.integers(0, 99))
def test_turning_the_whole_scene_turns_the_answer(velocity, normal, e, seed):
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    turned = kinematic_response(turn @ velocity, turn @ normal, e)
    assert turned == pytest.approx(turn @ kinematic_response(velocity, normal, e), abs=ROUNDING)


def test_the_other_side_of_the_plane_is_another_collision():
    assert kinematic_response((0.0, 0.0, 2.0), (0.0, 0.0, -1.0), 0.5).tolist() == [0.0, 0.0, -1.0]


def test_a_bouncing_ball_loses_height_as_e_to_the_power_two_n():
    e, velocity, heights = 0.8, np.array([0.0, 0.0, -1.0]), []
    for _ in range(5):
        velocity = kinematic_response(velocity, UP, e)
        heights.append(velocity[2] ** 2)  # v²/(2g) over v0²/(2g)
        velocity = -velocity  # the flight brings the speed back, downwards
    assert heights == pytest.approx([e ** (2 * n) for n in range(1, 6)], rel=1e-14)  # ten roundings


# Another engine


@pytest.mark.statement(7, oracle="pymunk's impulse on a fixed or driven wall")
@pytest.mark.parametrize("wall_speed", [0.0, 1.5, -0.5])
def test_an_impulse_solver_in_the_plane_gives_the_same_velocity(wall_speed):
    pymunk = oracle("pymunk")
    rng = np.random.default_rng(RNG_SEED)
    for _ in range(20):
        angle, e = rng.uniform(0, 6.28), rng.uniform(0.05, 1)
        normal = np.array([np.cos(angle), np.sin(angle)])
        velocity = rng.normal(size=2) - 3 * normal  # comes in
        space = pymunk.Space()
        wall = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        wall.angle, wall.velocity = angle - np.pi / 2, tuple(wall_speed * normal)
        floor = pymunk.Poly(wall, [(-9, -9), (9, -9), (9, 0), (-9, 0)])
        ball = pymunk.Body(1, 1)
        ball.position, ball.velocity = tuple(0.0999 * normal), tuple(velocity)  # touches
        shape = pymunk.Circle(ball, 0.1)
        floor.elasticity, shape.elasticity = e, 1.0  # they multiply
        space.add(wall, floor, ball, shape)
        space.step(1e-9)
        plane = (*(wall_speed * normal), 0.0)
        after = kinematic_response((*velocity, 0.0), (*normal, 0.0), e, plane)
        approaches = (velocity @ normal) < wall_speed
        expected = ball.velocity if approaches else velocity
        assert after[:2] == pytest.approx(tuple(expected), abs=1e-13)  # some ten roundings of speeds up to 6 m/s


# A plane that moves


def test_a_racket_adds_one_plus_e_times_its_own_speed():
    # v = 4 in, w = 2 towards it, e = 0.5: 0.5 · 4 + 1.5 · 2
    assert kinematic_response((1.0, 0.0, -4.0), UP, 0.5, (0.0, 0.0, 2.0)).tolist() == [1.0, 0.0, 5.0]


def test_a_plane_that_recedes_or_slides_in_itself_does_nothing():
    assert kinematic_response((1.0, 0.0, -4.0), UP, 0.5, (0.0, 0.0, -4.0)).tolist() == [1.0, 0.0, -4.0]
    assert kinematic_response((1.0, 0.0, -4.0), UP, 0.5, (0.0, 0.0, -5.0)).tolist() == [1.0, 0.0, -4.0]
    assert kinematic_response((1.0, 0.0, 4.0), UP, 0.5, (9.0, 9.0, 0.0)).tolist() == [1.0, 0.0, 4.0]


def test_an_approaching_plane_pushes_off_a_ball_at_rest():
    assert kinematic_response((0.0, 0.0, 0.0), UP, 0.0, (3.0, 0.0, 2.0)).tolist() == [0.0, 0.0, 2.0]


@pytest.mark.statement(7, oracle="the relative velocity, reversed")
@given(VELOCITY, NORMAL, RESTITUTION, VELOCITY)
def test_an_observer_on_the_moving_plane_sees_an_ordinary_collision(velocity, normal, e, plane):
    relative = (velocity - plane) @ normal
    after = kinematic_response(velocity, normal, e, plane)
    assert (after - plane) @ normal == pytest.approx(-e * relative if relative < 0 else relative, abs=ROUNDING)
    along = velocity - (velocity @ normal) * normal
    assert after - (after @ normal) * normal == pytest.approx(along, abs=ROUNDING)


@given(VELOCITY, NORMAL, RESTITUTION, VELOCITY, VELOCITY)
def test_a_moving_observer_sees_the_same_collision_with_a_moving_plane(velocity, normal, e, plane, boost):
    seen = kinematic_response(velocity + boost, normal, e, plane + boost) - boost
    assert seen == pytest.approx(kinematic_response(velocity, normal, e, plane), abs=ROUNDING)


@given(VELOCITY, NORMAL, RESTITUTION)
def test_a_plane_at_rest_is_the_ordinary_case(velocity, normal, e):
    after = kinematic_response(velocity, normal, e, (0.0, 0.0, 0.0))
    assert np.array_equal(after, kinematic_response(velocity, normal, e))


# The slide as printed


@pytest.mark.erratum(7)
def test_as_printed_a_point_still_behind_the_plane_never_leaves():
    dt, places = 0.01, {}
    for name, respond in (
        ("printed", as_printed.mirror_response),
        ("guarded", lambda velocity, normal: kinematic_response(velocity, normal, 1.0)),
    ):
        z, v = -0.015, np.array([0.0, 0.0, 1.0])  # answered 1.5 cm inside, by half its speed; now on its way out
        for _ in range(201):
            z = z + v[2] * dt
            if z < 0:
                v = respond(v, UP)
        places[name] = z
    assert places["printed"] == pytest.approx(-0.005, abs=1e-12)  # thrown back in at every second step, for ever
    assert places["guarded"] == pytest.approx(1.995, abs=1e-12)  # 201 steps, some roundings each


@pytest.mark.erratum(7)
def test_as_printed_a_departing_body_is_reflected_without_loss():
    assert as_printed.mirror_response((1.0, 0.0, 3.0), UP).tolist() == [1.0, 0.0, -3.0]
    assert as_printed.mirror_response((1.0, 0.0, -3.0), UP).tolist() == [1.0, 0.0, 3.0]
    assert kinematic_response((1.0, 0.0, -3.0), UP, 0.5).tolist() == [1.0, 0.0, 1.5]


# What is refused


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: kinematic_response((0, 0, -1), (0, 0, 2), 0.5), "normal must have length 1, not 2"),
        (lambda: kinematic_response((0, 0, -1), (0, 0, 0), 0.5), "normal must have length 1, not 0"),
        (lambda: kinematic_response((0, 0, -1), UP, 1.1), "restitution must be from 0 to 1, not 1.1"),
        (lambda: kinematic_response((0, 0, -1), UP, [0.5, -0.1]), "restitution must be from 0 to 1, not -0.1"),
        (lambda: kinematic_response(-1.0, UP, 0.5), r"velocity must have shape \(..., 3\), not \(\)"),
        (lambda: kinematic_response((0, 0, -1), 1.0, 0.5), r"normal must have shape \(..., 3\), not \(\)"),
        (lambda: kinematic_response((0, 0, -1), UP, 0.5, 1.0), r"plane_velocity must have shape \(..., 3\), not"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()


# One is many


def test_many_collisions_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(RNG_SEED)
    velocities, normals = rng.normal(size=(2, 4, 5, 3))
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    e = rng.uniform(size=(4, 5))
    together = kinematic_response(velocities, normals, e)
    assert together.shape == (4, 5, 3)
    for at in np.ndindex(4, 5):
        # Sums over the last axis may be grouped differently in a batch
        assert together[at] == pytest.approx(kinematic_response(velocities[at], normals[at], e[at]), abs=1e-15)
    planes = rng.normal(size=(4, 5, 3))
    together = kinematic_response(velocities, normals, e, planes)
    for at in np.ndindex(4, 5):
        one = kinematic_response(velocities[at], normals[at], e[at], planes[at])
        assert together[at] == pytest.approx(one, abs=2e-15)


def test_one_plane_serves_many_bodies_and_one_body_many_coefficients():
    assert kinematic_response([(0, 0, -2), (1, 0, 2)], UP, 0.5).tolist() == [[0, 0, 1], [1, 0, 2]]
    assert kinematic_response((0, 0, -2), UP, [0.0, 0.5, 1.0])[:, 2].tolist() == [0, 1, 2]


def test_resolving_a_collision_changes_none_of_its_inputs():
    arrays = [np.array([[0.0, 1.0, -2.0]]), np.array([[0.0, 0.0, 1.0]]), np.array([0.5])]
    kept = [array.copy() for array in arrays]
    for array in arrays:
        array.flags.writeable = False  # writing to one would raise
    answer = kinematic_response(*arrays, arrays[0])
    assert all(np.array_equal(array, copy) for array, copy in zip(arrays, kept, strict=True))
    assert not np.shares_memory(answer, arrays[0])
