"""The longest steps of a spring with its damper, yours and the engines': both sides of each limit are tried."""

from __future__ import annotations

import math

import pytest

from labs.desk import step_limits
from reference.errors import InvalidInput

DT, STEPS = 1e-3, 1500
"""s. With steps of 2 % on either side of the limit the motion changes by a factor of e^10 at least."""


def in_pybullet(stiffness, damping):
    import pybullet

    client = pybullet.connect(pybullet.DIRECT)
    try:
        pybullet.setTimeStep(DT, client)
        shape = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.1, physicsClientId=client)
        ball = pybullet.createMultiBody(1.0, shape, basePosition=(1e-6, 0, 0), physicsClientId=client)
        pybullet.changeDynamics(ball, -1, linearDamping=0, physicsClientId=client)
        for _ in range(STEPS):
            place = pybullet.getBasePositionAndOrientation(ball, client)[0][0]
            speed = pybullet.getBaseVelocity(ball, client)[0][0]
            if abs(place) > 1e-2:
                break
            push = (-stiffness * place - damping * speed, 0, 0)
            pybullet.applyExternalForce(ball, -1, push, (place, 0, 0), pybullet.WORLD_FRAME, client)
            pybullet.stepSimulation(client)
        return abs(place)
    finally:
        pybullet.disconnect(client)


def in_mujoco(stiffness, damping, tendon, integrator):
    import mujoco

    numbers = f'stiffness="{stiffness}" damping="{damping}"'
    spatial = f'<tendon><spatial springlength="1" {numbers}><site site="a"/><site site="b"/></spatial></tendon>'
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{DT}" gravity="0 0 0" integrator="{integrator}"/><worldbody>'
        f'<site name="a" pos="-1 0 0"/><body><joint type="slide" axis="1 0 0" {"" if tendon else numbers}/>'
        f'<geom size=".1" mass="1"/><site name="b"/></body></worldbody>{spatial if tendon else ""}</mujoco>'
    )
    data = mujoco.MjData(model)
    data.qpos[0] = 1e-6
    for _ in range(STEPS):
        mujoco.mj_step(model, data)
        if abs(data.qpos[0]) > 1e-2:
            break
    return abs(data.qpos[0])


def in_dart(stiffness, damping):
    import dartpy

    world, skeleton = dartpy.simulation.World(), dartpy.dynamics.Skeleton()
    world.setTimeStep(DT)
    world.setGravity([0, 0, 0])
    joint, body = skeleton.createPrismaticJointAndBodyNodePair()
    body.setMass(1.0)
    joint.setSpringStiffness(0, stiffness)
    joint.setDampingCoefficient(0, damping)
    joint.setPosition(0, 1e-6)
    world.addSkeleton(skeleton)
    for _ in range(STEPS):
        world.step()
    return abs(joint.getPosition(0))


RUNS = {
    "PyBullet, the force told in every step": in_pybullet,
    "MuJoCo, a tendon, integrator Euler": lambda *numbers: in_mujoco(*numbers, True, "Euler"),
    "MuJoCo, a tendon, implicitfast": lambda *numbers: in_mujoco(*numbers, True, "implicitfast"),
    "MuJoCo, a sliding joint, Euler": lambda *numbers: in_mujoco(*numbers, False, "Euler"),
    "DART, a sliding joint": in_dart,
}


@pytest.mark.parametrize("measured", step_limits.ENGINES, ids=lambda each: each.title)
def test_a_spring_dies_below_the_limit_of_an_engine_and_grows_above(measured, installed):
    installed(measured.engine)

    def end(step):
        frequency = step / DT
        return RUNS[measured.title](frequency**2, 2 * frequency)  # ζ = 1

    if math.isinf(measured.limit):
        assert end(step_limits.LARGEST) < 1e-6
    else:
        assert end(0.98 * measured.limit) < 1e-7
        assert end(1.02 * measured.limit) > 1e-3


def test_the_measured_limits_are_those_of_the_two_formulas():
    limits = [each.limit for each in step_limits.ENGINES if math.isfinite(each.limit)]
    own = [2 * (math.sqrt(2) - 1)] * 2 + [
        2 * (math.sqrt(2) + 1)
    ] * 2  # a damper at the start, and at the end of the step
    assert limits == pytest.approx(own, rel=5e-4)  # found by halving down to half a thousandth


def test_your_limits_are_drawn_above_the_engines():
    shown = step_limits.step_limits({"explicit": 2.0, "semi-implicit": 0.8284})
    assert "yours, explicit: 2.00; yours, semi-implicit: 0.83; PyBullet" in shown.text
    assert "DART, a sliding joint: none up to 60" in shown.text


@pytest.mark.parametrize("wrong", [{}, {"explicit": 0.0}, {"explicit": math.nan}])
def test_limits_that_are_no_numbers_above_zero_are_refused(wrong):
    with pytest.raises(InvalidInput, match="give limits above zero by name"):
        step_limits.step_limits(wrong)
