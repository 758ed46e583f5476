"""A ball that slides until it rolls: the 5/7 of a bowling ball, spin about the vertical, and what a step leaves."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.friction import roll_step, sphere_impact

G, UP = 9.81, np.eye(3)[2]
ARM = -0.11 * UP
AMOUNT = st.floats(-20, 20).map(lambda value: round(value, 6))


@pytest.mark.statement(24, oracle="the angular momentum about the point of contact")
@given(AMOUNT, AMOUNT, st.tuples(AMOUNT, AMOUNT, AMOUNT), st.floats(0.05, 1.0), st.floats(1e-3, 10))
def test_friction_keeps_the_angular_momentum_about_the_point_of_contact(vx, vy, spin, friction, dt):
    # per mass: 2/5 R² ω + (−arm) × v, from a point of the floor below the centre
    velocity = np.array([vx, vy, 0.0])
    after, turning = roll_step(velocity, spin, 0.11, friction, G, dt)
    gained = 0.4 * 0.11**2 * (turning - spin) + np.cross(-ARM, after - velocity)
    assert gained == pytest.approx(np.zeros(3), abs=1e-13)  # some roundings of 0.11 m times 20 m/s


@pytest.mark.statement(24, oracle="5/7 of the speed, after 2 v/(7 μ g) and 12 v²/(49 μ g)")
@pytest.mark.parametrize("friction", [0.04, 0.2, 0.7])
def test_a_ball_thrown_without_spin_rolls_with_five_sevenths_whatever_the_friction(friction):
    velocity, spin, place, steps = np.array([3.0, -4.0, 0.0]), np.zeros(3), np.zeros(3), 1000
    until = 2 * 5.0 / (7 * friction * G)
    for _ in range(steps):
        before = velocity
        velocity, spin = roll_step(velocity, spin, 0.11, friction, G, until / steps)
        place += (before + velocity) / 2 * until / steps  # exact while the deceleration is constant
    assert velocity == pytest.approx([15 / 7, -20 / 7, 0.0], rel=1e-12)  # a thousand roundings
    assert spin == pytest.approx(np.cross(UP, velocity) / 0.11, rel=1e-10)
    assert np.linalg.norm(place) == pytest.approx(12 * 25 / (49 * friction * G), rel=1e-12)


def test_a_ball_spun_about_the_vertical_keeps_its_spin_and_stays_where_it_is():
    velocity, spin = roll_step(np.zeros(3), (0.0, 0.0, 40.0), 0.11, 0.5, G, 1.0)
    assert velocity.tolist() == [0.0, 0.0, 0.0]
    assert spin.tolist() == [0.0, 0.0, 40.0]


def test_a_ball_that_rolls_rolls_on():
    velocity, spin = np.array([1.5, 0.5, 0.0]), np.array([-5.0, 15.0, 2.0])
    after, turning = roll_step(velocity, spin, 0.1, 0.3, G, 0.5)
    assert after == pytest.approx(velocity, abs=1e-15)
    assert turning == pytest.approx(spin, abs=1e-13)


@given(AMOUNT, AMOUNT, st.tuples(AMOUNT, AMOUNT, AMOUNT), st.floats(0.05, 1.0))
def test_a_step_is_an_impact_whose_push_is_the_weight_times_the_step(vx, vy, spin, friction):
    # sphere_impact limits friction by μ (1 + e) v_n; a ball that falls with g dt and does not bounce has the same limit
    dt = 0.05
    step = roll_step((vx, vy, 0.0), spin, 0.3, friction, G, dt)
    impact = sphere_impact((vx, vy, -G * dt), spin, UP, 0.3, 0.0, friction)
    assert step[0] == pytest.approx(impact[0], abs=1e-12)  # a few roundings of 20 m/s, and of a spin of 20 rad/s below
    assert step[1] == pytest.approx(impact[1], abs=1e-12 / 0.3)


def test_several_balls_in_one_call_are_each_as_alone():
    rng = np.random.default_rng(4)
    velocities, spins = rng.normal(size=(5, 3)) * [3, 3, 0], rng.normal(size=(5, 3)) * 20
    radii, frictions = rng.uniform(0.05, 0.4, 5), rng.uniform(0, 0.8, 5)
    together = roll_step(velocities, spins, radii, frictions, G, 0.02)
    for at in range(5):
        alone = roll_step(velocities[at], spins[at], radii[at], frictions[at], G, 0.02)
        assert np.array_equal(together[0][at], alone[0])
        assert np.array_equal(together[1][at], alone[1])


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"velocity": (1.0, 0.0, 0.5)}, "along the floor"),
        ({"radius": 0.0}, "radius must be positive"),
        ({"friction": -0.1}, "friction"),
        ({"gravity": -9.81}, "gravity"),
        ({"dt": -0.1}, "dt"),
        ({"dt": math.inf}, "dt"),
        ({"spin": (1.0, 2.0)}, "spin"),
    ],
)
def test_bad_input_is_refused_by_name(wrong, said):
    right = {"velocity": (1.0, 2.0, 0.0), "spin": (0.0, 1.0, 3.0), "radius": 0.1, "friction": 0.3, "gravity": G}
    with pytest.raises(ValueError, match=said):
        roll_step(**({**right, "dt": 0.1} | wrong))
