"""MuJoCo's fluids: which of its models has Stokes' drag, and that a model is what it was told."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.engines import mujoco_own_forces
from reference.engines.read_back import NotAsTold
from reference.prediction import loaded
from reference.scene.forces import Fluid, Spring

(SCENARIO,) = find("sinking-ball/m=4.3,η=200,stream")[1].scenarios
SPINNING = replace(SCENARIO, bodies=(replace(SCENARIO.bodies[0], angular_velocity=(1.0, -2.0, 3.0)),), duration=0.05)


def test_the_ellipsoid_model_has_stokes_drag_on_motion_and_on_spin(installed):
    mujoco = installed("mujoco")
    outside, own = (mujoco.run(SPINNING, mujoco.settings(SPINNING, name)) for name in ("tuned", "ellipsoid"))
    np.testing.assert_allclose(own.positions, outside.positions, atol=1e-14)
    np.testing.assert_allclose(own.velocities, outside.velocities, atol=1e-14)
    np.testing.assert_allclose(own.angular_velocities, outside.angular_velocities, atol=1e-12)


def test_the_inertia_box_has_the_drag_of_its_own_recurrence(installed):
    mujoco = installed("mujoco")
    settings = mujoco.settings(SCENARIO, "inertia box")
    method = mujoco.method(SCENARIO, settings)
    assert method.drag == pytest.approx(np.sqrt(0.6))
    expected = loaded.predict(SCENARIO, settings, method).trajectory
    np.testing.assert_allclose(mujoco.run(SCENARIO, settings).velocities, expected.velocities, atol=1e-14)
    assert loaded.predict(SPINNING, settings, method) is None  # its drag on a spin is another share


def test_a_model_with_another_fluid_is_refused(installed):
    mujoco = installed("mujoco")
    settings = mujoco.settings(SCENARIO, "ellipsoid")
    model = mujoco._model(mujoco.module(), SCENARIO, settings)
    mujoco_own_forces.check(model, SCENARIO, settings)
    fluid = SCENARIO.fluid
    wrong = {
        "viscosity of the fluid": replace(fluid, viscosity=201.0),
        "lift of ball": replace(fluid, density=1401.0),
        "wind": Fluid(fluid.density, fluid.viscosity, (0.0, 0.0, 0.0)),
    }
    for name, other in wrong.items():
        with pytest.raises(NotAsTold, match=name):
            mujoco_own_forces.check(model, replace(SCENARIO, fluid=other), settings)
    with pytest.raises(NotAsTold, match="fluid model of ball"):
        mujoco_own_forces.check(model, SCENARIO, mujoco.settings(SCENARIO, "inertia box"))
    hung = replace(SCENARIO, springs=(Spring("ball", "", 1.0),))
    assert not {"ellipsoid", "inertia box"} & set(mujoco.profiles(hung))  # one thing at a time in its own words
