from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.forces import ballistic_motion, semi_implicit_euler, uniform_gravity

RNG_SEED = 11
COMPONENT = st.floats(-10, 10)
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
TIME = st.floats(-5, 5)
ROUNDING = 1e-12
"""Some ten roundings of terms up to 10 m/s² × (10 s)²."""
DOWN = (0.0, 0.0, -9.81)


# Weight


def test_two_kilograms_weigh_twice_what_one_does():
    assert uniform_gravity([1.0, 2.0], DOWN).tolist() == [[0, 0, -9.81], [0, 0, -19.62]]


@given(st.floats(1e-3, 1e6), VECTOR)
def test_all_bodies_fall_alike(mass, gravity):
    # One product and one quotient, each rounded by half a spacing; 1e-300: numbers that are hardly there lose more
    assert uniform_gravity(mass, gravity) / mass == pytest.approx(gravity, rel=2.3e-16, abs=1e-300)


def test_what_has_no_mass_has_no_weight():
    assert uniform_gravity(0.0, DOWN).tolist() == [0.0, 0.0, 0.0]


# Flight under constant acceleration


@given(VECTOR, VECTOR, VECTOR, TIME)
def test_the_flight_is_the_parabola_of_exact_arithmetic(p, v, a, dt):
    position, velocity = ballistic_motion(p, v, a, dt)
    for axis in range(3):
        x, u, b, t = (Fraction(float(value)) for value in (p[axis], v[axis], a[axis], dt))
        assert position[axis] == pytest.approx(float(x + u * t + b * t * t / 2), abs=1e-13)  # terms up to 125 m
        assert velocity[axis] == pytest.approx(float(u + b * t), abs=1e-14)  # terms up to 50 m/s


def test_a_ball_thrown_up_at_g_metres_per_second_is_back_in_two_seconds():
    position, velocity = ballistic_motion((1.0, 0.0, 0.0), (3.0, 0.0, 10.0), (0.0, 0.0, -10.0), 2.0)
    assert position.tolist() == [7.0, 0.0, 0.0]
    assert velocity.tolist() == [3.0, 0.0, -10.0]


@given(VECTOR, VECTOR, VECTOR, TIME, TIME)
def test_two_flights_one_after_the_other_are_one_long_flight(p, v, a, first, second):
    halfway = ballistic_motion(p, v, a, first)
    position, velocity = ballistic_motion(*halfway, a, second)
    whole = ballistic_motion(p, v, a, first + second)
    assert position == pytest.approx(whole[0], abs=ROUNDING)
    assert velocity == pytest.approx(whole[1], abs=ROUNDING)


@given(VECTOR, VECTOR, VECTOR, TIME)
def test_the_flight_keeps_its_energy(p, v, a, dt):
    def energy(position, velocity):
        return velocity @ velocity / 2 - a @ position  # J per kg

    # Energies up to 1e4 J/kg, rounded some ten times
    assert energy(*ballistic_motion(p, v, a, dt)) == pytest.approx(energy(p, v), abs=1e-10)


@pytest.mark.parametrize("move", [ballistic_motion, semi_implicit_euler])
@given(p=VECTOR, v=VECTOR, a=VECTOR, dt=TIME, boost=VECTOR)
def test_a_moving_observer_sees_the_same_flight(move, p, v, a, dt, boost):
    position, velocity = move(p, v + boost, a, dt)
    at_rest = move(p, v, a, dt)
    assert position - boost * dt == pytest.approx(at_rest[0], abs=ROUNDING)
    assert velocity - boost == pytest.approx(at_rest[1], abs=ROUNDING)


@pytest.mark.parametrize("move", [ballistic_motion, semi_implicit_euler])
def test_turning_the_whole_scene_turns_the_flight(move):
    rng = np.random.default_rng(RNG_SEED)
    for _ in range(20):
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        p, v, a = rng.normal(size=(3, 3))
        turned, straight = move(turn @ p, turn @ v, turn @ a, 0.7), move(p, v, a, 0.7)
        for one, other in zip(turned, straight, strict=True):
            assert one == pytest.approx(turn @ other, abs=1e-14)  # numbers of order one


@pytest.mark.parametrize("move", [ballistic_motion, semi_implicit_euler])
def test_in_no_time_nothing_moves(move):
    position, velocity = move((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), DOWN, 0.0)
    assert position.tolist() == [1.0, 2.0, 3.0]
    assert velocity.tolist() == [4.0, 5.0, 6.0]


# Semi-implicit Euler


def test_a_step_moves_with_the_velocity_at_its_end():
    position, velocity = semi_implicit_euler((0.0, 0.0, 1.0), (2.0, 0.0, 0.0), (0.0, 0.0, -10.0), 0.5)
    assert velocity.tolist() == [2.0, 0.0, -5.0]
    assert position.tolist() == [1.0, 0.0, -1.5]


@given(VECTOR, VECTOR, VECTOR, st.floats(1e-3, 0.1), st.integers(1, 40))
def test_after_n_steps_it_is_half_a_step_ahead_of_the_parabola(p, v, a, dt, count):
    position, velocity = p, v
    for _ in range(count):
        position, velocity = semi_implicit_euler(position, velocity, a, dt)
    time = count * dt
    true_position, true_velocity = ballistic_motion(p, v, a, time)
    # 1 + 2 + … + n = n²/2 + n/2: the second part is a t dt/2 too much. Rounding of 40 steps of terms up to 100.
    assert position == pytest.approx(true_position + a * time * dt / 2, abs=1e-11)
    assert velocity == pytest.approx(true_velocity, abs=1e-11)


def test_an_oscillator_neither_gains_nor_loses_energy_in_the_long_run():
    # With p″ = −p the step keeps p² + v² − dt p v exactly, so p² + v² stays within (1 + dt/2)/(1 − dt/2) of its start.
    dt, position, velocity = 0.1, np.array([1.0, 0.0, 0.0]), np.zeros(3)
    energies, kept = [], []
    for _ in range(3_000):
        position, velocity = semi_implicit_euler(position, velocity, -position, dt)
        energies.append(position @ position + velocity @ velocity)
        kept.append(position @ position + velocity @ velocity - dt * position @ velocity)
    assert kept == pytest.approx(np.ones(3_000), abs=1e-11)  # each step is rounded by some 1e-16
    assert max(energies) <= (1 + dt / 2) / (1 - dt / 2)
    assert min(energies) >= (1 - dt / 2) / (1 + dt / 2)


# One is many


def test_many_bodies_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(RNG_SEED)
    p, v, a = rng.normal(size=(3, 4, 5, 3))
    mass, dt = rng.uniform(1, 2, size=(2, 4, 5))
    weights = uniform_gravity(mass, a)
    for move in (ballistic_motion, semi_implicit_euler):
        positions, velocities = move(p, v, a, dt)
        assert positions.shape == velocities.shape == (4, 5, 3)
        for at in np.ndindex(4, 5):
            position, velocity = move(p[at], v[at], a[at], dt[at])
            assert np.array_equal(positions[at], position)
            assert np.array_equal(velocities[at], velocity)
            assert np.array_equal(weights[at], uniform_gravity(mass[at], a[at]))


def test_one_body_can_be_followed_at_many_instants():
    position, velocity = ballistic_motion((0, 0, 5), (1, 0, 0), (0, 0, -10), [0.0, 1.0, 2.0])
    assert position.tolist() == [[0, 0, 5], [1, 0, 0], [2, 0, -15]]
    assert velocity[:, 2].tolist() == [0, -10, -20]


@pytest.mark.parametrize("move", [ballistic_motion, semi_implicit_euler])
def test_moving_a_body_changes_none_of_the_inputs(move):
    rng = np.random.default_rng(RNG_SEED)
    arrays = [*rng.normal(size=(3, 6, 3)), rng.uniform(size=6)]
    kept = [array.copy() for array in arrays]
    for array in arrays:
        array.flags.writeable = False  # writing to one would raise
    answers = (*move(*arrays), uniform_gravity(arrays[3], arrays[0]))
    assert all(np.array_equal(array, copy) for array, copy in zip(arrays, kept, strict=True))
    assert not any(np.shares_memory(answer, array) for answer in answers for array in arrays)
