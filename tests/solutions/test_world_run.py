"""Runs of the world: continued, and with forces that depend on time."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from solutions.world.bodies import State, make_bodies, make_state
from solutions.world.memory import NOTHING
from solutions.world.rules import Rules
from solutions.world.run import run_world

DOWN = (0.0, 0.0, -9.81)
FLOOR = ("half-space", (0.0, 0.0, 1.0))


def last(run):
    """The last state of a run, as someone has it who stored the arrays alone."""
    return State(*(array[-1] for array in run))


def tower(masses, aside, turn):
    """Boxes on each other, each aside from the one below by turns, all turned about the vertical."""
    count = len(masses)
    moments = np.array(masses)[:, None] * np.array([0.4**2 + 0.2**2, 0.2**2 + 0.2**2, 0.2**2 + 0.4**2]) / 12
    bodies = make_bodies(
        [FLOOR, *[("box", (0.1, 0.2, 0.1))] * count],
        [np.inf, *masses],
        np.vstack([np.full(3, np.inf), moments]),
        friction=0.5,
    )
    q = np.array([np.cos(turn / 2), 0, 0, np.sin(turn / 2)])
    place = [(0.0, 0.0, 0.0), *((aside * (-1) ** k, aside * (k % 3 - 1), 0.1 + 0.2 * k) for k in range(count))]
    return bodies, make_state(place, np.vstack([(1.0, 0, 0, 0), *[q] * count]))


@pytest.mark.parametrize(
    ("masses", "aside", "turn", "pieces"),
    [
        ([3.0, 1.0, 2.0, 1.0], 0.02, -0.7, 5),
        pytest.param([1.0] * 6, 0.01, 0.3, 5, marks=pytest.mark.slow),
        pytest.param([1.0, 0.5, 2.0, 1.0, 1.0, 3.0, 1.0, 1.0], 0.015, 1.1, 10, marks=pytest.mark.slow),
        pytest.param([1.0] * 12, 0.01, 0.0, 20, marks=pytest.mark.weekly),
    ],
)
def test_a_tower_stands_also_when_its_run_is_continued_from_arrays_alone(masses, aside, turn, pieces):
    bodies, start = tower(masses, aside, turn)
    state = start
    for _ in range(4):
        state = last(run_world(bodies, state, DOWN, 1 / 60, pieces, every=pieces))
    # Box k may come down by what sweeps leave, and by no more than the slop of each contact below
    assert np.max(np.linalg.norm(state.position - start.position, axis=-1)) < 1e-4


def test_a_tower_is_not_disturbed_by_what_strikes_elsewhere():
    """A ball far away strikes the floor in the first step of each call."""
    masses = [1.0, 2.0, 1.5, 2.5, 1.0, 2.8]
    bodies, start = tower(masses, 0.01, 0.3)
    shapes = [FLOOR, *[("box", (0.1, 0.2, 0.1))] * len(masses), ("sphere", 0.05)]
    moments = np.vstack([bodies.moments, np.full(3, 0.4 * 0.1 * 0.05**2)])
    both = make_bodies(shapes, [np.inf, *masses, 0.1], moments, friction=0.5, restitution=0.9)
    place, q = (
        np.vstack([each, one]) for each, one in ((start.position, (5.0, 0, 0.051)), (start.orientation, (1.0, 0, 0, 0)))
    )
    state = make_state(place, q)
    for _ in range(4):
        falls = state.velocity.copy()
        falls[-1] = 0.0, 0.0, -1.0
        again = State(np.vstack([state.position[:-1], place[-1:]]), state.orientation, falls, state.angular_velocity)
        state = last(run_world(both, again, DOWN, 1 / 60, 5, every=5))
    assert np.max(np.linalg.norm(state.position[:-1] - start.position, axis=-1)) < 1e-4


@pytest.mark.parametrize("rules", [Rules(sweeps=3), Rules(sleep_speed=0.02, sleep_after=0.1)])
def test_a_run_continued_with_its_memory_is_the_same_to_the_last_digit(rules):
    bodies, start = tower([2.0, 1.0], 0.02, 0.4)
    whole = run_world(bodies, start, DOWN, 0.01, 24, rules)
    for steps in (3, 15):
        first = run_world(bodies, start, DOWN, 0.01, steps, rules)
        rest = run_world(bodies, last(first), DOWN, 0.01, 24 - steps, rules, memory=first.memory)
        for all_of_it, part in zip(whole, rest, strict=True):
            assert np.array_equal(all_of_it[steps:], part)
    assert run_world(bodies, start, DOWN, 0.01, 0).memory is NOTHING


def test_a_force_that_depends_on_time_drives_bodies_by_the_recurrence_of_the_step():
    # m v⁺ = m v + Δt a cos(Ω t + φ), x⁺ = x + Δt v⁺: sums of cosines, also of the second part of a run
    mass, push, omega, phase, dt = np.array([2.0, 0.5]), np.array([(3.0, -1, 2), (0, 4, 1)]), 5.0, 0.4, 0.01
    bodies = make_bodies([("sphere", 0.1)] * 2, mass, np.full((2, 3), 0.01))
    start = make_state([(0, 0, 0), (3, 0, 0)], velocity=[(1, 0, 0), (0, -1, 2)])

    def driven(state, t):
        return np.cos(omega * t + phase) * push, np.zeros((2, 3))

    first = run_world(bodies, start, (0, 0, 0), dt, 60, forces=[driven])
    rest = run_world(bodies, last(first), (0, 0, 0), dt, 40, forces=[driven], memory=first.memory, time=60 * dt)
    gained = np.cumsum(np.cos(omega * dt * np.arange(100) + phase))[:, None, None] * dt * push / mass[:, None]
    velocity = start.velocity + gained
    place = start.position + dt * np.cumsum(velocity, axis=0)
    found = [np.concatenate([a[1:], b[1:]]) for a, b in zip(first, rest, strict=True)]
    np.testing.assert_allclose(found[2], velocity, atol=1e-13)  # a hundred roundings of some m/s
    np.testing.assert_allclose(found[0], place, atol=1e-13)
    # and the sum is the integral a sin(Ω t + φ)/Ω, but for half a step of the difference of its ends
    t = 100 * dt
    whole = (np.sin(omega * t + phase) - np.sin(phase)) / omega
    half_a_step = dt / 2 * (np.cos(omega * t + phase) - np.cos(phase))
    closed = push / mass[:, None] * (whole - half_a_step)
    # Euler and Maclaurin: the next term is Δt²/12 of the difference of slopes, Ω at most
    np.testing.assert_allclose(gained[-1], closed, atol=dt**2 / 12 * 2 * omega * np.max(push / mass[:, None]))


class Wind:
    """An object that can be called, and needs the time."""

    def __call__(self, state, t):
        return push_at(state, t)


def push_at(state, t):
    return np.tile([t, 0.0, 0.0], (2, 1)), np.zeros((2, 3))


def steady(state, t=1.0):
    return push_at(state, t)


def loose(*args):
    assert len(args) == 1
    return push_at(args[0], 1.0)


def scaled(state, share, t):
    return push_at(state, share * t)


def by_name(state, *, time):
    return push_at(state, time)


@pytest.mark.parametrize(
    ("force", "sees_time"),
    [
        (push_at, True),
        (lambda state, t: push_at(state, t), True),
        (Wind(), True),
        (Wind().__call__, True),
        (by_name, True),
        (functools.partial(scaled, share=1.0), True),
        (functools.partial(push_at, t=1.0), False),
        (steady, False),
        (loose, False),
        (lambda state, k=1.0: push_at(state, k), False),
        (lambda state, **more: push_at(state, 1.0 + len(more)), False),
    ],
)
def test_a_function_gets_the_time_if_it_needs_one_argument_more(force, sees_time):
    bodies = make_bodies([("sphere", 0.1)] * 2, [1.0, 2.0], np.full((2, 3), 0.01))
    run = run_world(bodies, make_state([(0, 0, 0), (3, 0, 0)]), (0, 0, 0), 0.5, 1, forces=[force], time=3.0)
    assert run.velocity[-1, :, 0].tolist() == ([1.5, 0.75] if sees_time else [0.5, 0.25])


ONE, NONE = np.ones((3, 3)), np.zeros((3, 3))


@pytest.mark.parametrize(
    ("returned", "says"),
    [
        (ONE, r"forces\[1\] must return forces and torques, two arrays of the shape \(3, 3\) each, not 3"),
        (ONE[:2], r"not float64 of \(3,\)"),
        ((ONE,), "not 1"),
        ((ONE, NONE, NONE), "not 3"),
        ((ONE[0], NONE), r"not float64 of \(3,\)"),
        ((ONE[:, :2], NONE), r"not float64 of \(3, 2\)"),
        (None, "not NoneType"),
        (lambda state: (ONE, NONE), "not function"),
        ((ONE, None), r"not object of \(\)"),
        ((1j * ONE, NONE), r"not complex128 of \(3, 3\)"),
        ((ONE, [[1, 2, 3], [1, 2], [3]]), "rows of unequal length"),
        ([], "not 0"),
        ((ONE, np.diag([0.0, np.nan, 0.0])), r"forces\[1\] returned nan at 0 s"),
    ],
)
def test_what_is_no_force_and_torque_of_each_body_is_refused(returned, says):
    bodies = make_bodies([("sphere", 0.1)] * 3, [1.0] * 3, np.full((3, 3), 0.01))
    state = make_state([(0, 0, 0), (1, 0, 0), (2, 0, 0)])
    whole_numbers = [[0, 0, 1]] * 3, [[0, 0, 0]] * 3  # lists of whole numbers are right
    with pytest.raises(ValueError, match=says):
        run_world(bodies, state, DOWN, 0.01, 1, forces=[lambda s: whole_numbers, lambda s: returned])


def test_a_function_of_more_than_state_and_time_is_refused_and_so_is_a_time_that_is_none():
    bodies, state = make_bodies([("sphere", 0.1)], [1.0], [[0.01] * 3]), make_state([(0, 0, 0)])
    with pytest.raises(ValueError, match="the state and the time, not of state, share, t"):
        run_world(bodies, state, DOWN, 0.01, 1, forces=[scaled])
    with pytest.raises(ValueError, match="time must be finite, not nan"):
        run_world(bodies, state, DOWN, 0.01, 1, time=np.nan)
    with pytest.raises(ValueError, match="forces must be a list of functions, not None"):
        run_world(bodies, state, DOWN, 0.01, 1, forces=None)


@pytest.mark.parametrize("response", ["sequential", "penalty"])
@pytest.mark.parametrize(
    ("stiffness", "damping", "of_spin"), [(0.0, 5e3, 0.0), (1e7, 0.0, 0.0), (2e6, 8e3, 0.0), (0.0, 0.0, 50.0)]
)
def test_what_runs_away_beyond_its_step_limit_is_refused_soon(stiffness, damping, of_spin, response):
    shapes = [("sphere", 0.1), ("half-space", (0, 0, 1))]
    bodies = make_bodies(shapes, [1.0, np.inf], [[0.01] * 3] * 2, restitution=0.5)
    state = make_state([(0.1, 0, 0.1), (0, 0, 0)], velocity=[(1, 0, 1), (0, 0, 0)], angular_velocity=[(0, 0, 1)])

    def force(now):
        return -stiffness * now.position - damping * now.velocity, -of_spin * now.angular_velocity

    with pytest.raises(ValueError, match=r"has reached .* step limit"):
        run_world(bodies, state, (0, 0, 0), 0.01, 50, Rules(response=response), [force])
