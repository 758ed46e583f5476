"""MuJoCo's tendons: a spring in its own words, to its own order of accuracy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.engines import mujoco_own_forces
from reference.engines.read_back import NotAsTold
from reference.scene.forces import OscillatingForce, Spring

FAMILY, CASE = find("oscillator/ζ=0.3")
(SCENARIO,) = CASE.scenarios


def test_a_tendon_moves_a_ball_as_a_spring_from_outside_does(installed):
    mujoco = installed("mujoco")
    pushed = replace(SCENARIO, duration=0.3, forces=(OscillatingForce("ball", (0.0, 2.0, 1.0), 7.0),))
    off_centre = replace(pushed, springs=(replace(pushed.springs[0], point_a=(0.03, -0.02, 0.01)),))
    outside, own = (mujoco.run(off_centre, mujoco.settings(off_centre, name)) for name in ("tuned", "tendons"))
    np.testing.assert_allclose(own.positions, outside.positions, atol=1e-11)
    np.testing.assert_allclose(own.angular_velocities, outside.angular_velocities, atol=1e-8)


def test_with_runge_kutta_a_tendon_is_of_fourth_order(installed):
    mujoco, place = installed("mujoco"), FAMILY.quantity("place")
    settings = mujoco.settings(SCENARIO, "tendons").change(integrator="RK4")
    coarse, fine = (
        place.measure(mujoco.run(SCENARIO, settings.change(timestep=dt))) - place.theory(CASE) for dt in (8e-3, 4e-3)
    )
    assert np.log2(coarse / fine) == pytest.approx(4, abs=0.2)  # the next order is ω dt = 8 % of it


def test_a_model_whose_tendon_is_another_spring_is_refused(installed):
    mujoco = installed("mujoco")
    model = mujoco._model(mujoco.module(), SCENARIO, mujoco.settings(SCENARIO, "tendons"))
    mujoco_own_forces.check_tendons(model, SCENARIO)
    (spring,) = SCENARIO.springs
    for name in ("stiffness", "damping", "rest_length"):
        other = replace(SCENARIO, springs=(replace(spring, **{name: 1.1 * getattr(spring, name)}),))
        with pytest.raises(NotAsTold, match=name.replace("_", " ")):
            mujoco_own_forces.check_tendons(model, other)
    two = replace(SCENARIO, springs=(spring, Spring("ball", "", 1.0)))
    assert "tendons" not in mujoco.profiles(two)
    with pytest.raises(NotAsTold, match="number of tendons"):
        mujoco_own_forces.check_tendons(model, two)
