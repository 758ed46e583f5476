from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.forces import (
    acceleration_of,
    explicit_euler,
    semi_implicit_euler,
    spring_damper_force,
    spring_step_limit,
    stokes_drag,
    total_force,
)
from solutions.forces.accumulator import Force

DOWN = np.array([0.0, 0.0, -9.81])
SEEDS = st.integers(0, 2**32 - 1)
RATE = st.floats(-3, 3).map(lambda exponent: 10**exponent)


def scene(seed: int, balls: int = 5, springs: int = 7) -> tuple[np.ndarray, ...]:
    """Arguments of `total_force`: balls and springs anywhere."""
    rng = np.random.default_rng(seed)
    ends = np.array([rng.choice(balls, 2, replace=False) for _ in range(springs)]).reshape(-1, 2)
    return (
        *rng.normal(size=(2, balls, 3)), *rng.uniform(0.1, 2, size=(2, balls)), DOWN, 0.3,
        rng.normal(size=(balls, 3)), ends, *rng.uniform(0.1, 5, size=(3, springs)),
    )  # fmt: skip


# The sum of all forces


@given(SEEDS)
def test_springs_and_dampers_add_nothing_to_the_momentum_of_a_scene(seed):
    given = scene(seed)
    _, v, mass, radius, _, viscosity, stream, *_ = given
    outside = mass[:, None] * DOWN + stokes_drag(v, stream, viscosity, radius)
    assert np.sum(total_force(*given) - outside, axis=0) == pytest.approx(np.zeros(3), abs=1e-12)  # forces up to 100 N


@pytest.mark.statement(30, oracle="each force by itself, added by a matrix of who is at which end")
@given(SEEDS)
def test_every_ball_gets_the_forces_of_all_its_springs(seed):
    x, v, mass, radius, gravity, viscosity, stream, ends, k, rest, damping = scene(seed)
    pulls = spring_damper_force(*(each[ends[:, side]] for each in (x, v) for side in (0, 1)), k, rest, damping)
    sides = np.eye(len(x))[ends]
    alone = mass[:, None] * DOWN - 6 * math.pi * (viscosity * radius)[:, None] * (v - stream)
    found = total_force(x, v, mass, radius, gravity, viscosity, stream, ends, k, rest, damping)
    assert found == pytest.approx(alone + (sides[:, 0] - sides[:, 1]).T @ pulls, abs=1e-12)  # forces up to 100 N


def test_without_springs_weight_and_drag_are_left():
    still, none = np.zeros((2, 3)), np.zeros(0)
    found = total_force(still, still, [1.0, 2.0], 0.1, DOWN, 0.0, DOWN, np.zeros((0, 2), int), none, none, none)
    assert found.tolist() == [[0, 0, -9.81], [0, 0, -19.62]]


def test_a_bead_on_two_springs_is_accelerated_as_by_two_forces_with_names():
    x, v = np.array([[0.0, 0, 0], [1.5, 0, 0], [1.5, 2, 0]]), np.array([[0.0, 0, 1], [1, 0, 0], [0, 3, 0]])
    ends = np.array([[0, 1], [2, 1]])
    found = total_force(x, v, np.ones(3), 0.0, 0 * DOWN, 0.0, DOWN, ends, [8.0, 2.0], 1.0, [0.5, 0.0])

    def pull(a, b, *numbers):
        def on_all(p, u):
            force, every = spring_damper_force(p[a], p[b], u[a], u[b], *numbers), np.eye(3)
            return np.outer(every[a] - every[b], force)

        return on_all

    named = [Force("one", "position", pull(0, 1, 8.0, 1.0, 0.5)), Force("two", "position", pull(2, 1, 2.0, 1.0, 0.0))]
    assert found == pytest.approx(acceleration_of(named, np.ones(3))(x, v), abs=1e-13)


@pytest.mark.parametrize("ends", [[[0, 5]], [[-1, 0]], [0, 1], [[0, 1, 2]]])
def test_springs_must_join_two_balls_of_the_scene(ends):
    given = list(scene(1))
    given[7] = np.array(ends)
    with pytest.raises(ValueError, match=r"ends must (name balls from 0 to 4|have the shape \(S, 2\)), not"):
        total_force(*given)


# The longest steps of a damped spring


@pytest.mark.parametrize("damping", [3.0, 6.0, 40.0])
@pytest.mark.parametrize(("step", "which"), [(explicit_euler, 0), (semi_implicit_euler, 1)])
def test_a_swing_dies_just_below_the_limit_and_grows_just_above(step, which, damping):
    k, m = 90.0, 0.7
    limit = float(spring_step_limit(k, m, damping)[which])
    sizes = []
    for share in (0.97, 1.03):
        x, v = np.array([0.1, 0.0, 0.0]), np.zeros(3)
        for _ in range(2000):
            x, v = step(x, v, -(k * x + damping * v) / m, share * limit)
        sizes.append(abs(x[0]))
    # Three per cent off the limit a step makes 0.2 % at least, which 2000 steps raise to e⁴.
    assert sizes[0] < 0.1 / 7
    assert sizes[1] > 0.1 * 7


def test_limits_broadcast_and_need_a_spring():
    explicit, semi_implicit = spring_step_limit([1.0, 4.0], [[1.0], [4.0]], 0.0)
    assert not explicit.any()
    assert semi_implicit.tolist() == [[2.0, 1.0], [4.0, 2.0]]
    for wrong, words in (((0.0, 1.0, 1.0), "stiffness must be positive"), ((1.0, math.inf, 1.0), "mass must be finite"),
                         ((1.0, 1.0, -1.0), "damping must be zero or positive")):  # fmt: skip
        with pytest.raises(ValueError, match=words):
            spring_step_limit(*wrong)
