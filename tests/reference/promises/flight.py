"""What engines promise of free flight, and of a box that lies."""

from __future__ import annotations

import math

import numpy as np
import pytest
from engine_grid import DAMPING, Cell, flies_exactly, is_damped, product

from reference.catalogue import measure

from .run import Promise, Run


def a_free_body_follows_the_parabola_of_its_integrator(run: Run) -> None:
    trajectory, body = run.trajectory, run.scenario.body("thrown")
    t, gravity = trajectory.times[:, None], np.array(run.scenario.gravity)
    parabola = np.array(body.position) + np.array(body.velocity) * t + gravity * t**2 / 2
    off = trajectory.position("thrown") - parabola
    # Semi-implicit Euler: Σ (v0 + g i dt) dt over i = 1 … n is v0 t + g t²/2 + g t dt/2.
    late = 0 if flies_exactly(run.cell) else gravity * t * run.settings.timestep / 2
    speed = np.linalg.norm(trajectory.velocity("thrown"), axis=1).max()
    # Bullet's own damping takes 0.04 (1 + v) v of the speed a second. All else is rounding, 1e-16 of 50 m a step.
    near = DAMPING * (1 + speed) * speed * t[-1, 0] ** 2 / 2 if is_damped(run.cell) else 1e-10
    np.testing.assert_allclose(off, np.broadcast_to(late, off.shape), atol=near)


def a_body_spins_steadily_about_a_principal_axis(run: Run) -> None:
    trajectory, place = run.trajectory, run.scenario.index("thrown")
    spin, found = np.array(run.scenario.body("thrown").angular_velocity), trajectory.angular_velocities[:, place]
    start, rate = np.linalg.norm(spin), np.linalg.norm(found, axis=1)
    np.testing.assert_allclose(found / rate[:, None], np.broadcast_to(spin / start, found.shape), atol=1e-9)  # rounding
    if is_damped(run.cell):  # ω' = −k (1 + ω) ω: ω/(1 + ω) decays as exp(−k t), up to the steps that Bullet does it in
        share = start / (1 + start) * np.exp(-DAMPING * trajectory.times)
        np.testing.assert_allclose(rate, share / (1 - share), rtol=1e-3)
    else:
        np.testing.assert_allclose(rate, start, rtol=1e-9)


def the_orientation_turns_with_the_spin(run: Run) -> None:
    trajectory, body = run.trajectory, run.scenario.body("thrown")
    spin, end = np.array(body.angular_velocity), float(trajectory.times[-1])
    rate = float(np.linalg.norm(spin))
    turn = np.array([math.cos(rate * end / 2), *(math.sin(rate * end / 2) * spin / rate)])
    expected = np.array(product(turn, body.orientation))
    # Engines turn by ω dt a step, exactly; a quaternion is off by half the angle that damping takes.
    near = DAMPING * (1 + rate) * rate * end**2 / 4 if is_damped(run.cell) else 1e-9 + turned_too_far(run, rate)
    last = trajectory.orientations[-1, run.scenario.index("thrown")]
    assert min(np.linalg.norm(expected - sign * last) for sign in (1, -1)) < near


def turned_too_far(run: Run, rate: float) -> float:
    """Error of the last quaternion where an engine takes x for sin x in each step, as DART does below 1 mrad a step.

    The angle x then grows by x³/6 more, and a quaternion is off by half the angle.
    """
    angle = rate * run.settings.timestep
    steps = run.scenario.duration / run.settings.timestep
    return steps * angle**3 / 12 if run.cell.engine == "dart" and angle < 1e-3 else 0.0


def a_box_lying_on_its_side_stays_there(run: Run) -> None:
    trajectory, place = run.trajectory, run.scenario.index("box")
    assert measure.separation(trajectory, "box", "floor")[0] == pytest.approx(0, abs=1e-15)
    assert measure.drift(trajectory, "box", run.scenario.duration) < 1e-3  # 1 mm: nobody sees it
    turned = np.abs(trajectory.orientations[:, place] @ trajectory.orientations[0, place])
    assert 2 * math.acos(min(1.0, float(turned.min()))) < 1e-2  # rad: a corner of the box lifts by less than 4 mm


def flies(cell: Cell) -> bool:
    return cell.scenario == "thrown-ball" or spins(cell)


def spins(cell: Cell) -> bool:
    return cell.scenario in ("twirled-ball", "twirled-box")


def lies(cell: Cell) -> bool:
    return cell.scenario == "lying-box"


PROMISES = (
    Promise(a_free_body_follows_the_parabola_of_its_integrator, flies),
    Promise(a_body_spins_steadily_about_a_principal_axis, spins),
    Promise(the_orientation_turns_with_the_spin, spins),
    Promise(a_box_lying_on_its_side_stays_there, lies),
)
