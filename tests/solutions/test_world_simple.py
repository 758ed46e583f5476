"""The world of the lab: eight functions that a student writes, judged by the full world and by what has to stay."""

from __future__ import annotations

import numpy as np
import pytest

from labs.plain_worlds import BALL, BOX, FLOOR, PLANE, thing, world
from solutions.impulse import rotation_matrix
from solutions.world import (
    candidate_pairs,
    collect_contacts,
    find_contacts,
    make_bodies,
    make_state,
    pairs_in_grid,
    rotate_by_momentum,
    step_world,
    turn_freely,
)

DOWN = np.array([0.0, 0.0, -9.81])
NAMES = {BALL: "sphere", BOX: "box", PLANE: "half-space"}


def run(bodies, state, dt, steps, sweeps=10, weight=DOWN):
    """The state after some steps, and the deepest overlap on the way, m."""
    rules, memory, deepest = (2 * 9.81 * dt, 1e-3, sweeps), None, 0.0
    for _ in range(steps):
        *state, key, impulse = step_world(bodies, tuple(state), weight, dt, rules, memory)
        memory = key, impulse
        deepest = max(deepest, -np.min(collect_contacts(bodies, tuple(state), 0.0)[4], initial=0.0))
    return tuple(state), deepest


def angular_momentum(q, w, moments):
    r = rotation_matrix(q)
    return np.matvec(r, moments * np.vecmat(w, r))


def test_a_free_body_keeps_its_angular_momentum_to_rounding_and_gains_energy():
    moments, q, w = np.array([1.0, 2.0, 3.0]), np.array([1.0, 0, 0, 0]), np.array([1.0, 1.0, 0.0])
    first = angular_momentum(q, w, moments)
    energies = []
    for _ in range(2000):
        q, w = rotate_by_momentum(q, w, moments, 0.01)
        energies.append(w @ angular_momentum(q, w, moments) / 2)
    assert np.allclose(angular_momentum(q, w, moments), first, rtol=1e-12)
    assert 0.05 < energies[-1] / 1.5 - 1 < 0.15  # the lab says by how much


def test_half_a_step_halves_the_error_of_the_turn():
    q, w, moments = np.array([0.8, 0, 0.6, 0]), np.array([0.5, 2.0, -1.0]), np.array([3.0, 1.0, 2.0])
    exact, spin = q, w
    for _ in range(1000):
        exact, spin = turn_freely(exact, spin, moments, 1e-3)
    errors = []
    for count in (100, 200):
        place, spin = q, w
        for _ in range(count):
            place, spin = rotate_by_momentum(place, spin, moments, 1 / count)
        errors.append(np.linalg.norm(place - exact))
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.1)


def test_comparing_all_boxes_finds_what_the_grid_finds():
    rng = np.random.default_rng(1)
    low = rng.uniform(-5, 5, (60, 3))
    high = low + rng.uniform(0, 3, (60, 3))
    assert np.array_equal(candidate_pairs(low, high), pairs_in_grid(low, high))


def test_contacts_are_those_of_the_full_world():
    rng = np.random.default_rng(2)
    for _ in range(20):
        turns = rng.normal(size=(5, 4))
        turns /= np.linalg.norm(turns, axis=1, keepdims=True)
        things = [FLOOR, *(thing(BALL, rng.uniform(0.2, 0.8), 1.0, rng.uniform(-1, 1, 3)) for _ in range(2))]
        things += [thing(BOX, rng.uniform(0.1, 0.8, 3), 1.0, rng.uniform(-1, 1, 3), q) for q in turns[:3]]
        bodies, state = world(things)
        shapes = [(NAMES[k], s[0] if k == BALL else s) for k, s in zip(bodies[5], bodies[6], strict=True)]
        with np.errstate(divide="ignore"):
            full = make_bodies(shapes, 1 / bodies[0], bodies[1])
        found, wanted = collect_contacts(bodies, state, 0.05), find_contacts(full, make_state(*state), 0.05)
        assert np.array_equal(found[0], wanted.body_a)
        assert np.array_equal(found[1], wanted.body_b)
        for mine, theirs in zip(found[2:5], wanted[2:5], strict=True):
            assert np.allclose(mine, theirs, atol=1e-12)


def test_ten_boxes_stand():
    things = [FLOOR, *(thing(BOX, (0.1, 0.1, 0.1), 1.0, (0, 0, 0.1 + 0.2 * k)) for k in range(10))]
    bodies, state = world(things, 0.0, 0.5)
    after, _ = run(bodies, state, 1 / 240, 40)
    assert np.allclose(after[0], state[0], atol=2e-3)  # they sink until the sweeps have found the weight


@pytest.mark.slow
def test_a_box_that_falls_on_its_corner_comes_to_rest_on_a_face():
    tilted = thing(BOX, (0.1, 0.15, 0.2), 1.0, (0, 0, 0.6), (0.8, 0.4, 0.4, 0.2))
    after, deepest = run(*world([FLOOR, tilted], 0.3, 0.5), 1 / 240, 480)
    axis = rotation_matrix(after[1][1])[2]
    assert np.max(np.abs(axis)) == pytest.approx(1, abs=1e-5)
    assert np.allclose(after[2], 0, atol=1e-6)
    assert deepest < 0.02  # it strikes at 3 m/s, and a step takes 4 ms


def test_a_blow_runs_through_a_cradle():
    balls = [thing(BALL, 0.125, 1.0, (0.25 * k, 0, 0)) for k in range(5)]
    balls[0] = thing(BALL, 0.125, 1.0, (-0.05, 0, 0), velocity=(1, 0, 0))
    after, _ = run(*world(balls, 1.0), 0.01, 12, weight=np.zeros(3))
    assert np.allclose(after[2][:, 0], [0, 0, 0, 0, 1], atol=1e-12)


def test_two_boxes_that_strike_in_the_air_keep_momentum_and_lose_energy():
    rng = np.random.default_rng(3)
    turns = rng.normal(size=(2, 4))
    turns /= np.linalg.norm(turns, axis=1, keepdims=True)
    a = thing(BOX, (0.3, 0.2, 0.1), 2.0, (-0.5, 0, 0.05), turns[0], (2, 0, 0), (1, 2, 3))
    b = thing(BOX, (0.2, 0.2, 0.2), 1.0, (0.5, 0, 0), turns[1], (-2, 0.3, 0), (0, -1, 1))
    bodies, state = world([a, b], 0.7, 0.4)

    def kept(state):
        x, q, v, w = state
        mass = 1 / bodies[0][:, None]
        spin = angular_momentum(q, w, bodies[1])
        turning = np.sum(np.cross(x, mass * v) + spin, axis=0)
        return np.sum(mass * v, axis=0), turning, np.sum(mass * v * v) / 2 + np.sum(w * spin) / 2

    after, _ = run(bodies, state, 0.002, 200, weight=np.zeros(3))
    (p, turning, energy), (p_after, turning_after, energy_after) = kept(state), kept(after)
    assert not np.allclose(after[2], state[2])
    assert np.allclose(p_after, p, atol=1e-12)
    # Moving overlaps away shifts momenta aside, by a fraction of the overlap of 8 mm.
    assert np.allclose(turning_after, turning, atol=0.01 * np.linalg.norm(turning))
    assert energy_after < energy


@pytest.mark.slow
def test_a_heap_of_balls_stays_in_its_box():
    walls = [thing(PLANE, n, position=-0.3 * np.array(n)) for n in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]
    rng = np.random.default_rng(4)
    places = [(0.2 * (k % 2) - 0.1, 0.2 * (k // 2 % 2) - 0.1, 0.2 + 0.22 * (k // 4)) for k in range(12)]
    balls = [thing(BALL, 0.1, 1.0, place + rng.uniform(-0.01, 0.01, 3)) for place in places]
    after, deepest = run(*world([FLOOR, *walls, *balls], 0.3, 0.4), 1 / 240, 240)
    assert np.max(np.abs(after[0][5:, :2])) < 0.21
    assert np.max(np.linalg.norm(after[2], axis=1)) < 0.5
    assert deepest < 0.02
