from __future__ import annotations

import math

import numpy as np
import pytest

from reference.published import published
from solutions.friction import (
    apparent_force,
    contact_jacobian,
    friction_force,
    inverse_mass_matrix,
    normal_force,
    sequential_impulses,
    sphere_grips,
    sphere_impact,
)

X, Y, UP = np.eye(3)
STILL = np.zeros(3)


def within(case, name, value):
    return value == pytest.approx(case.expected[name], abs=case.tolerance[name])


@pytest.mark.statement(24, oracle="P4: LAMMPS' sphere that begins to roll")
def test_a_sphere_slides_spins_up_and_rolls_as_in_lammps():
    case = published("P4")
    radius, mu, dt, g = (case.setup[name] for name in ("radius", "friction", "timestep", "gravity"))
    mass = case.setup["density"] * 4 / 3 * math.pi * radius**3
    press = normal_force(apparent_force(mass, -g * UP, STILL, STILL), UP)

    def accelerations(v, spin):
        force = friction_force(STILL, (v - radius * spin) * X, press, mu, mu)[0]
        return force / mass, -force / (0.4 * mass * radius)

    x, v, spin, a, turn = 0.0, case.setup["speed"], 0.0, 0.0, 0.0  # no friction in the first evaluation
    step = 0
    while a <= 0:  # until the slip, and with it friction, turns round: within a step of rolling
        v, spin = v + a * dt / 2, spin + turn * dt / 2
        x += v * dt
        a, turn = accelerations(v, spin)
        v, spin = v + a * dt / 2, spin + turn * dt / 2
        step += 1
        if step == case.setup["steps"]:
            assert within(case, "position", x)
            assert within(case, "velocity", v)
            assert within(case, "spin", spin)
    assert within(case, "rolls_at", step * dt)
    assert within(case, "rolls_with", v)


def kharaz(case, angle):
    radians = np.radians(case.setup[angle])
    speed, e, mu = (case.setup[name] for name in ("speed", "restitution", "friction"))
    before = speed * (np.outer(np.sin(radians), X) - np.outer(np.cos(radians), UP))
    grips = sphere_grips(before[:, 0], -before[:, 2], e, mu)
    return before, sphere_impact(before, STILL, UP, case.setup["radius"], e, mu), grips


@pytest.mark.statement(16, oracle="P11: Kharaz' measured impacts")
def test_measured_spheres_that_slide_through_the_impact_keep_the_share_that_the_rigid_law_says():
    case = published("P11")
    before, (after, _), grips = kharaz(case, "angle")
    measured, ours = np.array(case.expected["tangent_restitution"]), after[:, 0] / before[:, 0]
    assert grips.tolist() == [True] * 3 + [False] * 4
    assert ours[~grips] == pytest.approx(measured[~grips], abs=case.tolerance["tangent_restitution"])
    # a rigid sphere that grips keeps 5/7 at every angle; the measured dip is not in any rigid law
    assert ours[grips] == pytest.approx(np.full(3, 5 / 7), abs=1e-14)
    assert (ours - measured)[grips] == pytest.approx([0.039, 0.115, 0.024], abs=1e-3)


@pytest.mark.statement(16, oracle="P11: Kharaz' measured impacts")
def test_measured_spheres_that_slide_through_the_impact_spin_as_the_rigid_law_says_and_gripping_ones_more():
    case = published("P11")
    _, (_, spin), grips = kharaz(case, "angle_of_spin")
    measured = np.array(case.expected["spin"])
    assert spin[~grips, 1] == pytest.approx(measured[~grips], abs=case.tolerance["spin"])
    assert np.all(measured[grips] > spin[grips, 1])


@pytest.mark.statement(24, oracle="P13: Drake's inclined plane")
@pytest.mark.parametrize("friction", [0.08, 1.0])  # tan 15° 2/7 = 0.0766 is enough
def test_a_sphere_rolls_down_drakes_slope(friction):
    case = published("P13")
    radius, mass, g, slope = (case.setup[name] for name in ("radius", "mass", "gravity", "slope"))
    arm = -radius * UP[None]
    rows = np.stack([contact_jacobian(0, -1, d[None], arm, arm, 1) for d in (UP, X, Y)], axis=1)
    weights = inverse_mass_matrix([1 / mass], np.eye(3)[None] / (0.4 * mass * radius**2))
    fall = g * np.array([math.sin(math.radians(slope)), 0, -math.cos(math.radians(slope)), 0, 0, 0])
    v, dt = np.zeros(6), 0.01
    for _ in range(round(case.setup["duration"] / dt)):
        v, impulse = sequential_impulses(v + dt * fall, rows, weights, friction)
        assert within(case, "friction", -impulse[0, 1] / dt)
    assert within(case, "speed", v[0])
    assert radius * v[4] == pytest.approx(v[0], rel=1e-12)  # rolls; fifty sweeps of one contact


@pytest.mark.statement(16, oracle="P17: Siconos' ball with friction")
def test_a_spinning_ball_bounces_off_with_the_speed_and_spin_of_siconos():
    case = published("P17")
    radius, e, mu = (case.setup[name] for name in ("radius", "restitution", "friction"))
    fall = math.sqrt(2 * case.setup["gravity"] * (case.setup["height"] - radius))
    v, spin = -fall * UP, case.setup["spin"] * Y
    for bounce in range(30):
        v, spin = sphere_impact(v, spin, UP, radius, e, mu)
        assert v[2] == pytest.approx(fall * e ** (bounce + 1), rel=1e-13)
        assert within(case, "speed", v[0])
        assert within(case, "spin", spin[1])
        v = v * [1, 1, -1]
