"""What docs/world.md says of the responses by hand, measured."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from solutions.detection import time_of_impact_exact, time_of_impact_interpolated
from solutions.forces import ballistic_motion, semi_implicit_euler
from solutions.response import (
    bounce_along_normal,
    kinematic_response,
    penalty_damping,
    penalty_force,
    penalty_rest_depth,
    penalty_step_limit,
    respond_at_impact,
    respond_at_step,
)

PAGE = " ".join((Path(__file__).parents[2] / "docs" / "world.md").read_text(encoding="utf-8").split())
G, UP, RESTITUTION = 9.81, np.array([0.0, 0.0, 1.0]), 0.7
PULL = -G * UP
HEIGHTS = np.linspace(0.45, 0.55, 101)


def rebound_error(step, dt):
    """Root mean square of the relative error of the rebound's height, and the lowest place on the way."""
    position, velocity, lowest = np.outer(HEIGHTS, UP), np.zeros((len(HEIGHTS), 3)), 0.0
    for _ in range(round(0.5 / dt)):
        position, velocity = step(position, velocity, dt)
        lowest = min(lowest, position[:, 2].min())
    # The steps of semi-implicit Euler lie on a parabola whose slope is that of a velocity half a step ago.
    slope = velocity[:, 2] - G * dt / 2 * (step is at_the_step)
    share = (position[:, 2] + slope**2 / (2 * G)) / HEIGHTS / RESTITUTION**2
    return np.sqrt(np.mean((share - 1) ** 2)), -lowest


def backed_up(policy):
    def step(position, velocity, dt):
        if policy == "exact":
            time = time_of_impact_exact(position[:, 2], velocity[:, 2], -G)
        else:
            end = ballistic_motion(position, velocity, PULL, dt)[0][:, 2]
            time = time_of_impact_interpolated(np.maximum(position[:, 2], 0), end, 0.0, dt)
        return respond_at_impact(position, velocity, PULL, UP, RESTITUTION, time, dt)

    return step


def at_the_step(position, velocity, dt):
    return respond_at_step(position, velocity, PULL, UP, position[:, 2] < 0, RESTITUTION, dt)


def penalty(stiffness):
    damping = penalty_damping(RESTITUTION, 1.0, stiffness)

    def step(position, velocity, dt):
        force = penalty_force(position[:, 2], velocity[:, 2], UP, stiffness, damping)
        return semi_implicit_euler(position, velocity, force + PULL, dt)

    return step


# The page prints two digits; 3 % is half a unit of the second one at worst.
TWO_DIGITS = 0.03


def test_backing_up_is_more_accurate_than_resolving_at_the_step():
    assert rebound_error(backed_up("exact"), 1e-3)[0] < 3e-14
    assert rebound_error(backed_up("slide"), 1e-3)[0] == pytest.approx(1.9e-6, rel=TWO_DIGITS)
    assert rebound_error(at_the_step, 1e-3)[0] == pytest.approx(0.0028, rel=TWO_DIGITS)


@pytest.mark.parametrize(
    "figure",
    [
        *("1.9·10⁻⁶", "0.28 %", "4.2 %, 28 mm deep | 29", "5.2 %, 8.9 mm deep | 9", "30 % | 3"),
        *("0.53 %, 2.8 mm deep | 146", "3.8 % remain", "limit of 1.8 ms", "0.83/ω at ζ = 1", "4.9 mm", "1.6 mm"),
        *("20.5 m/s at e = 0.7", "12.5 J have become 210 J", "ΔE = J w·N − ½ m (1 − e²) u_n²"),
        *("98 µm", "15 times the depth", "55 times for ten", "1.01/ω for ten", "6.7 times as slow"),
    ],
)
def test_the_figures_measured_here_are_those_of_the_page(figure):
    assert figure in PAGE


@pytest.mark.parametrize(
    ("stiffness", "dt", "error", "depth", "contact_steps"),
    [
        (1e4, 1e-3, 0.042, 0.028, 29),
        (1e5, 1e-3, 0.052, 0.0089, 9),
        (1e6, 1e-3, 0.30, 0.0031, 3),
        pytest.param(1e6, 2e-5, 0.0053, 0.0028, 146, marks=pytest.mark.slow),
        pytest.param(1e4, 1e-4, 0.038, 0.028, 292, marks=pytest.mark.weekly),
    ],
)
def test_gravity_shifts_a_soft_penalty_contact_and_the_step_a_stiff_one(stiffness, dt, error, depth, contact_steps):
    found, deepest = rebound_error(penalty(stiffness), dt)
    assert found == pytest.approx(error, rel=TWO_DIGITS)
    assert deepest == pytest.approx(depth, rel=TWO_DIGITS)
    # An impact without weight: e = exp(−ζ ω t)
    lasts = -2 * np.log(RESTITUTION) / penalty_damping(RESTITUTION, 1.0, stiffness)
    assert round(float(lasts) / dt) == contact_steps


def test_the_step_limits_of_the_page():
    stiff = penalty_step_limit(1.0, 1e6, penalty_damping(RESTITUTION, 1.0, 1e6))
    assert stiff == pytest.approx(1.8e-3, rel=TWO_DIGITS)
    assert penalty_step_limit(1.0, 1.0, [0.0, 2.0]) == pytest.approx([2, 0.83], rel=TWO_DIGITS)


@pytest.mark.statement(7, oracle="work of the moving plane: J w·N, less ½ m (1 − e²) u_n²")
def test_a_racket_gives_a_ball_energy_and_a_plane_at_rest_never_does():
    struck = kinematic_response([-5.0, 0, 0], [1.0, 0, 0], 0.7, [10.0, 0, 0])
    assert struck == pytest.approx([20.5, 0, 0], rel=1e-15)
    assert struck @ struck / 2 == pytest.approx(210, abs=0.2)  # of 12.5 J
    rng = np.random.default_rng(7)
    v, w, n = rng.normal(size=(3, 500, 3))
    n, e = n / np.linalg.norm(n, axis=-1, keepdims=True), rng.uniform(0, 1, 500)
    gained = (np.sum(kinematic_response(v, n, e, w) ** 2, axis=-1) - np.sum(v * v, axis=-1)) / 2
    closing, plane = np.minimum(np.vecdot(v - w, n), 0.0), np.vecdot(w, n)
    assert gained == pytest.approx(-(1 + e) * closing * plane - (1 - e * e) * closing**2 / 2, abs=1e-13)
    assert np.array_equal((gained > 1e-12) | (closing == 0), (plane > (1 - e) * -closing / 2) | (closing == 0))
    assert 50 < np.sum(gained > 0) < 450
    at_rest = kinematic_response(v, n, e)
    assert np.all(np.sum(at_rest * at_rest, axis=-1) <= np.sum(v * v, axis=-1) * (1 + 1e-14))


def test_resolved_at_the_step_a_resting_body_sinks_or_jitters():
    depths = []
    for e in (0.0, 0.5):
        position, velocity = np.zeros(3), np.zeros(3)
        for _ in range(1000):
            position, velocity = respond_at_step(position, velocity, PULL, UP, position[2] < 0, e, 1e-3)
        depths.append(-position[2])
    assert depths[0] == pytest.approx(G * 1e-3 / 2, rel=1e-12)
    assert depths == pytest.approx([4.9e-3, 1.6e-3], rel=TWO_DIGITS)
    assert velocity[2] > 1e-3  # of the second one: not still


def test_at_rest_only_the_penalty_body_lies_a_little_in_the_floor():
    assert [float(part) for part in bounce_along_normal(0.0, 0.0, -G, 0.5, 1.0)][:2] == [0.0, 0.0]
    position, velocity = np.zeros(3), np.zeros(3)
    damping = penalty_damping(0.5, 1.0, 1e5)
    for _ in range(1000):
        force = penalty_force(position[2], velocity[2], UP, 1e5, damping)
        position, velocity = semi_implicit_euler(position, velocity, force + PULL, 1e-3)
    assert -position[2] == pytest.approx(float(penalty_rest_depth(1.0, G, 1e5)), rel=1e-12)
    assert -position[2] == pytest.approx(98e-6, rel=TWO_DIGITS)
    assert abs(velocity[2]) < 1e-15


def test_a_stack_of_penalty_contacts_sags_and_needs_a_shorter_step():
    sags, limits, slowest = [], [], []
    for count in (1, 5, 10):
        difference = np.eye(count) - np.eye(count, k=-1)  # overlap of each body with the one below
        stiffness = difference.T @ difference  # in k; masses are 1
        sags.append(np.linalg.solve(stiffness, np.ones(count))[-1])
        squares = np.linalg.eigvalsh(stiffness)
        limits.append(float(penalty_step_limit(1.0, squares[-1])))
        slowest.append(np.sqrt(squares[0]))
    assert sags == pytest.approx([1, 15, 55], rel=1e-12)
    assert limits[0] == 2
    assert limits[2] == pytest.approx(1.01, rel=0.005)
    assert slowest[0] / slowest[2] == pytest.approx(6.7, rel=0.01)
