"""The loop over a plane that responds at time steps."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.response import bounce, kinematic_response

G = 9.81
UP = np.array([0.0, 0.0, 1.0])
LEANS = np.array([2.0, -6.0, 3.0]) / 7


@pytest.mark.statement(6, oracle="arithmetic by hand")
def test_each_step_looks_first_then_responds_then_moves():
    # 1 m up it falls freely; at −1 m it turns 4 m/s into 2, and the plane carries the weight of that step.
    positions, velocities = bounce((5, 0, 1), (1, 0, -2), (0, 0, -2), UP, 0.0, 0.5, 1.0, 3)
    assert positions.tolist() == [[5, 0, 1], [6, 0, -3], [7, 0, -1], [8, 0, -1]]
    assert velocities.tolist() == [[1, 0, -2], [1, 0, -4], [1, 0, 2], [1, 0, 0]]


def test_touching_the_plane_is_not_behind_it():
    positions, velocities = bounce((0, 0, 2), (0, 0, -1), (0, 0, 0), UP, -2.0, 1.0, 0.5, 2)
    assert positions[:, 2].tolist() == [2.0, 1.5, 2.0]
    assert velocities[:, 2].tolist() == [-1.0, -1.0, 1.0]


def one_after_another(p, v, a, n, d, e, dt, steps):
    """The same ball, in the frame of its plane: height h over the plane and the motion along it apart."""
    h, u, g = p @ n + d, v @ n, a @ n
    at, along, pull = p - (p @ n) * n, v - u * n, a - g * n
    rows = [(at + (h - d) * n, along + u * n)]
    for _ in range(steps):
        u = -e * u + max(g, 0.0) * dt if h < 0 and u < 0 else u + g * dt
        h, along = h + u * dt, along + pull * dt
        at = at + along * dt
        rows.append((at + (h - d) * n, along + u * n))
    return map(np.array, zip(*rows, strict=True))


@pytest.mark.statement(6, oracle="height and motion along the plane, each by itself")
def test_balls_over_planes_that_lean_bounce_as_each_does_by_itself():
    rng = np.random.default_rng(3)
    n = np.stack([UP, LEANS, LEANS[[1, 2, 0]]])
    p, v = rng.normal(size=(2, 3, 3)) + 2 * n
    a, d = rng.normal(size=(3, 3)) - 6 * n, rng.uniform(-0.5, 0.5, 3)
    e, dt = np.array([0.3, 0.6, 0.9]), np.array([0.02, 0.03, 0.04])
    positions, velocities = bounce(p, v, a, n, d, e, dt, 150)
    assert positions.shape == velocities.shape == (151, 3, 3)
    for i in range(3):
        places, speeds = one_after_another(p[i], v[i], a[i], n[i], d[i], e[i], dt[i], 150)
        assert positions[:, i] == pytest.approx(places, abs=1e-11)  # 150 steps, some roundings each
        assert velocities[:, i] == pytest.approx(speeds, abs=1e-11)
        assert np.sum(np.diff(velocities[:, i] @ n[i]) > 0) >= 2  # it bounced twice or more


@pytest.mark.statement(3, oracle="e² h − (1 − e) v Δt/2, on average over the phases of the steps")
def test_the_apex_misses_e_squared_h_by_what_the_order_of_the_loop_predicts():
    e, dt, drops = 0.5, 1e-3, 400
    phases = (np.arange(drops) + 0.5) / drops - 0.5
    heights = G * (np.sqrt(2 / G) + phases * dt) ** 2 / 2
    positions, _ = bounce(np.outer(heights, UP), np.zeros(3), -G * UP, UP, 0.0, e, dt, 700)
    apex = positions[500:, :, 2].max(axis=0)  # after 0.45 s of fall
    v = np.sqrt(2 * G)
    # 0.01 mm: the highest of the steps is up to g Δt²/8 below their parabola, 1.2 µm.
    assert np.mean(apex - e**2 * heights) == pytest.approx(-(1 - e) * v * dt / 2, abs=1e-5)


def test_one_plane_and_one_ball_serve_many_coefficients():
    positions, velocities = bounce((0, 0, -1), (0, 0, -2), (0, 0, 0), UP, 0.0, [0.0, 0.5, 1.0], [[0.5], [1.0]], 1)
    assert positions.shape == velocities.shape == (2, 2, 3, 3)
    assert positions[0].tolist() == [[[0, 0, -1]] * 3] * 2
    assert positions[1, ..., 2].tolist() == [[-1, -0.5, 0], [-1, 0, 1]]


def test_without_steps_the_start_alone_is_returned():
    positions, velocities = bounce((0, 0, 3), (0, 0, -2), -G * UP, UP, 0.0, 0.5, 0.1, 0)
    assert positions.tolist() == [[0, 0, 3]]
    assert velocities.tolist() == [[0, 0, -2]]


def test_the_start_is_left_as_it_was():
    p, v = np.array([0.0, 0.0, -1.0]), np.array([1.0, 0.0, -2.0])
    for array in (p, v):
        array.flags.writeable = False  # writing to it would raise
    positions, velocities = bounce(p, v, -G * UP, UP, 0.0, 0.5, 0.1, 3)
    assert not np.shares_memory(positions, p)
    assert velocities[1] == pytest.approx(kinematic_response(v, UP, 0.5), abs=1e-15)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"steps": -1}, "steps must be zero or positive, not -1"),
        ({"steps": 1.5}, "steps must be a whole number, not 1.5"),
        ({"steps": np.inf}, "steps must be finite, not inf"),
        ({"dt": -0.1}, "dt must be zero or positive, not -0.1"),
        ({"restitution": 1.5}, "restitution must be from 0 to 1, not 1.5"),
        ({"normal": (0, 0, 2)}, "normal must have length 1, not 2"),
        ({"position": 1.0}, "position must have shape"),
    ],
)
def test_a_loop_that_makes_no_sense_is_refused_by_name_and_value(change, message):
    right = {
        "position": (0, 0, 1), "velocity": (0, 0, -1), "acceleration": (0, 0, -9.81), "normal": UP, "offset": 0.0,
        "restitution": 0.5, "dt": 0.1, "steps": 2,
    }  # fmt: skip
    with pytest.raises(ValueError, match=message):
        bounce(**(right | change))
