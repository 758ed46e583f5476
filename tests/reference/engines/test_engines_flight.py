"""What engines make of free flight, and of a box that lies."""

from __future__ import annotations

import math

import numpy as np
import pytest
from engine_grid import DAMPING, SCENARIOS, Cell, cells_of, flies_exactly, is_damped, product, setup

from reference.catalogue import measure


@cells_of("thrown-ball", "twirled-ball", "twirled-box")
def test_a_free_body_follows_the_parabola_of_its_integrator(cell, trajectory):
    body = SCENARIOS[cell.scenario].body("thrown")
    t, gravity = trajectory.times[:, None], np.array(SCENARIOS[cell.scenario].gravity)
    parabola = np.array(body.position) + np.array(body.velocity) * t + gravity * t**2 / 2
    off = trajectory.position("thrown") - parabola
    # Semi-implicit Euler: Σ (v0 + g i dt) dt over i = 1 … n is v0 t + g t²/2 + g t dt/2.
    late = 0 if flies_exactly(cell) else gravity * t * trajectory.settings.timestep / 2
    speed = np.linalg.norm(trajectory.velocity("thrown"), axis=1).max()
    # Bullet's own damping takes 0.04 (1 + v) v of the speed a second. All else is rounding, 1e-16 of 50 m a step.
    near = DAMPING * (1 + speed) * speed * t[-1, 0] ** 2 / 2 if is_damped(cell) else 1e-10
    np.testing.assert_allclose(off, np.broadcast_to(late, off.shape), atol=near)


@cells_of("twirled-ball", "twirled-box")
def test_a_body_spins_steadily_about_a_principal_axis(cell, trajectory):
    body, place = SCENARIOS[cell.scenario].body("thrown"), SCENARIOS[cell.scenario].index("thrown")
    spin, found = np.array(body.angular_velocity), trajectory.angular_velocities[:, place]
    start, rate = np.linalg.norm(spin), np.linalg.norm(found, axis=1)
    np.testing.assert_allclose(found / rate[:, None], np.broadcast_to(spin / start, found.shape), atol=1e-9)  # rounding
    if is_damped(cell):  # ω' = −k (1 + ω) ω: ω/(1 + ω) decays as exp(−k t), up to the steps that Bullet does it in
        share = start / (1 + start) * np.exp(-DAMPING * trajectory.times)
        np.testing.assert_allclose(rate, share / (1 - share), rtol=1e-3)
    else:
        np.testing.assert_allclose(rate, start, rtol=1e-9)


@cells_of("twirled-ball", "twirled-box")
def test_the_orientation_turns_with_the_spin(cell, trajectory):
    body, place = SCENARIOS[cell.scenario].body("thrown"), SCENARIOS[cell.scenario].index("thrown")
    spin, end = np.array(body.angular_velocity), float(trajectory.times[-1])
    rate = float(np.linalg.norm(spin))
    turn = np.array([math.cos(rate * end / 2), *(math.sin(rate * end / 2) * spin / rate)])
    expected = np.array(product(turn, body.orientation))
    # Engines turn by ω dt a step, exactly; a quaternion is off by half the angle that damping takes.
    near = DAMPING * (1 + rate) * rate * end**2 / 4 if is_damped(cell) else 1e-9 + turned_too_far(cell, rate)
    assert min(np.linalg.norm(expected - sign * trajectory.orientations[-1, place]) for sign in (1, -1)) < near


def turned_too_far(cell: Cell, rate: float) -> float:
    """Error of the last quaternion where an engine takes x for sin x in each step, as DART does below 1 mrad a step.

    The angle x then grows by x³/6 more, and a quaternion is off by half the angle.
    """
    angle = rate * setup(cell)[2].timestep
    steps = SCENARIOS[cell.scenario].duration / setup(cell)[2].timestep
    return steps * angle**3 / 12 if cell.engine == "dart" and angle < 1e-3 else 0.0


@cells_of("lying-box")
def test_a_box_lying_on_its_side_stays_there(cell, trajectory):
    assert measure.separation(trajectory, "box", "floor")[0] == pytest.approx(0, abs=1e-15)
    assert measure.drift(trajectory, "box", trajectory.scenario.duration) < 1e-3  # 1 mm: nobody sees it
    place = trajectory.scenario.index("box")
    turned = np.abs(trajectory.orientations[:, place] @ trajectory.orientations[0, place])
    assert 2 * math.acos(min(1.0, float(turned.min()))) < 1e-2  # rad: a corner of the box lifts by less than 4 mm
