"""A spring in a joint of the engine's own: what MuJoCo and DART make of it, against eigenvalues of their steps."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import find
from reference.engines import mujoco_own_forces
from reference.engines.profiles import JOINT
from reference.engines.read_back import NotAsTold
from reference.engines.sliding_joint import joint_of
from reference.errors import InvalidInput
from reference.prediction import joints
from reference.scene.forces import Spring
from reference.scene.settings import Settings

(SCENARIO,) = find("oscillator/ζ=1")[1].scenarios
TURN = (0.5, -0.7, 0.1, 0.5)
"""A unit quaternion: 0.25 + 0.49 + 0.01 + 0.25 = 1."""


def oscillator(frequency, ratio, steps, timestep):
    """A turned ball on a weightless spring askew in space, 1 mm out of balance: ω in rad/s, ζ, and so many steps."""
    (ball,), (spring,) = SCENARIO.bodies, SCENARIO.springs
    stiffness, damping = ball.mass * frequency**2, 2 * ratio * ball.mass * frequency
    along = np.array(ball.position) - spring.point_b
    place = spring.point_b + along * (spring.rest_length + 1e-3) / np.linalg.norm(along)
    return replace(
        SCENARIO,
        bodies=(replace(ball, position=tuple(place.tolist()), orientation=TURN, velocity=(0.0, 0.0, 0.0)),),
        springs=(replace(spring, stiffness=stiffness, damping=damping),),
        gravity=(0.0, 0.0, 0.0),
        duration=steps * timestep,
    )


def swing(engine, scenario, timestep):
    """Stretch in units of the first, and the speed divided by ω in the same unit, at each step."""
    settings = engine.settings(scenario, JOINT).change(timestep=timestep)
    run = engine.run(scenario, replace(settings, sample_every=1))
    (ball,), (spring,) = scenario.bodies, scenario.springs
    away = run.position("ball") - spring.point_b
    direction = away[0] / np.linalg.norm(away[0])
    frequency = math.sqrt(spring.stiffness / ball.mass)
    np.testing.assert_allclose(run.orientations[:, 0], np.broadcast_to(TURN, (len(run.times), 4)), atol=1e-12)
    stretch = away @ direction - spring.rest_length
    return stretch / stretch[0], run.velocity("ball") @ direction / (frequency * stretch[0])


def test_darts_joint_takes_its_share_of_a_swing_in_every_step(installed):
    place, speed = swing(installed("dart"), oscillator(10.0, 0.0, 63, 0.01), 0.01)
    # Backward Euler: the eigenvalues are 1/(1 ± iω dt), so x² + (v/ω)² shrinks by 1 + (ω dt)² in each step
    np.testing.assert_allclose(place**2 + speed**2, 1.01 ** -np.arange(64.0), rtol=1e-10)
    assert math.hypot(place[-1], speed[-1]) == pytest.approx(0.731, abs=5e-4)  # 1.01^(−63/2) after a swing of 0.63 s


@pytest.mark.parametrize("name", ["mujoco", "dart"])
def test_every_step_of_a_joint_with_a_damper_is_as_predicted(name, installed):
    engine, scenario = installed(name), replace(SCENARIO, duration=0.1)
    settings = engine.settings(scenario, JOINT)
    found = joints.predict(scenario, settings, engine.method(scenario, settings))
    run = engine.run(scenario, settings)
    np.testing.assert_allclose(run.positions, found.trajectory.positions, rtol=0, atol=found.near)
    np.testing.assert_allclose(run.velocities, found.trajectory.velocities, rtol=0, atol=found.near)


def test_no_timestep_makes_darts_joint_explode(installed):
    place, _ = swing(installed("dart"), oscillator(60.0, 1.0, 20, 1.0), 1.0)
    assert np.all(np.diff(np.abs(place)) <= 0)


@pytest.mark.parametrize("ratio", [0.0, 0.4, 1.0])
def test_mujocos_joint_explodes_beyond_twice_the_sum_of_root_and_damping(ratio, installed):
    # (1 + b) z² − (2 + b − a) z + 1 = 0 with a = (ω dt)² and b = 2ζω dt has a root −1 at a = 4 + 2b
    limit = 2 * (math.sqrt(1 + ratio**2) + ratio)
    grown = [
        np.max(np.abs(swing(installed("mujoco"), oscillator(share * limit, ratio, 160, 1.0), 1.0)[0]))
        for share in (0.99, 1.01)
    ]
    assert grown[0] < 10 < grown[1]


@pytest.mark.parametrize("name", ["stiffness", "damping", "rest_length"])
def test_a_model_whose_joint_is_another_spring_is_refused(name, installed):
    mujoco = installed("mujoco")
    settings = mujoco.settings(SCENARIO, JOINT)
    model, joint = mujoco._model(mujoco.module(), SCENARIO, settings), joint_of(SCENARIO, settings)
    mujoco_own_forces.check_joint(model, joint)
    other = replace(joint, spring=replace(joint.spring, **{name: 1.1 * getattr(joint.spring, name)}))
    with pytest.raises(NotAsTold, match=name.replace("_", " ")):
        mujoco_own_forces.check_joint(model, other)


@pytest.mark.parametrize(
    ("setter", "said"),
    [
        ("setSpringStiffness", "stiffness of the joint"),
        ("setDampingCoefficient", "damping of the joint"),
        ("setRestPosition", "rest length of the spring"),
        ("setPosition", "length of the spring"),
        ("setVelocity", "rate of the spring"),
    ],
)
def test_a_joint_that_dart_was_not_told_is_refused(setter, said, installed, monkeypatch):
    dart = installed("dart")
    monkeypatch.setattr(dart.module().dynamics.PrismaticJoint, setter, lambda *given: None)
    with pytest.raises(NotAsTold, match=said):
        dart.run(SCENARIO, dart.settings(SCENARIO, JOINT))


def test_two_springs_or_two_balls_fit_no_joint(installed):
    two_springs = replace(SCENARIO, springs=(*SCENARIO.springs, Spring("ball", "", 1.0)))
    (two_balls,) = find("oscillator/ζ=0.3,two balls")[1].scenarios
    sideways = replace(SCENARIO, bodies=(replace(SCENARIO.bodies[0], velocity=(0.1, 0.0, 0.0)),))
    for scenario in (two_springs, two_balls, sideways):
        for name in ("mujoco", "dart"):
            assert JOINT not in installed(name).profiles(scenario)
        with pytest.raises(InvalidInput, match="one ball that moves along one spring"):
            joint_of(scenario, Settings(1e-3, options={"springs": JOINT}))
