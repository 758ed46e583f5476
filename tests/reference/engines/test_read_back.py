"""What engines say of their own world: how it is compared with what they were told, and which of it is true."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference.engines import read_back
from reference.errors import NotAsTold
from reference.scene.scenario import Body, Scenario, Sphere

# The comparison


@pytest.mark.parametrize(
    ("told", "found"),
    [
        (1e-3, 1.000001e-3),
        (0.0, 1e-300),
        (1.0, math.nan),
        (math.inf, 1e9),
        (1.0, math.inf),
        ((0.0, 0.0, -9.81), (0.0, 0.0, -9.80)),
        ((0.0, 0.0, -9.81), (0.0, 1e-6, -9.81)),
        ((1.0, 2.0), (1.0, 2.0, 3.0)),
        ("EULER", "RK4"),
        (True, False),
    ],
)
def test_an_answer_that_differs_is_refused(told, found):
    with pytest.raises(NotAsTold):
        read_back.check("An engine", "a quantity", told, found)


@pytest.mark.parametrize(
    ("told", "found"),
    [
        (0.37, math.sqrt(0.37) ** 2),
        (0.9, 1 / (1 / 0.9)),
        (math.inf, math.inf),
        ((0.0, 0.0, -9.81), np.array([0.0, 1e-16, -9.81])),
        (5, 5.0),
        ("EULER", "EULER"),
    ],
)
def test_an_answer_that_is_rounded_is_accepted(told, found):
    read_back.check("An engine", "a quantity", told, found)


def test_the_refusal_names_engine_quantity_and_both_values():
    with pytest.raises(NotAsTold, match=r"^PyBullet says timestep 0\.0005 s, and was told 0\.001 s$"):
        read_back.check("PyBullet", "timestep", 1e-3, 5e-4, "s")
    with pytest.raises(
        NotAsTold, match=r"^MuJoCo says gravity \(0, 0, -9\.8\) m/s², and was told \(0, 0, -9\.81\) m/s²$"
    ):
        read_back.check("MuJoCo", "gravity", (0, 0, -9.81), (0.0, 0.0, -9.8), "m/s²")


# Which answers are true: all that are checked, which the engines' steps show, except where a test says otherwise


@pytest.mark.parametrize("name", ["pybullet", "mujoco", "dart"])
def test_an_engine_steps_with_the_timestep_and_gravity_it_returns(name, installed):
    engine, gravity = installed(name), (0.11, 0.22, -9.33)
    scenario = Scenario("falling", (Body("ball", Sphere(0.1), 1.3),), (), 0.0137, gravity)
    settings = engine.settings(scenario, "tuned").change(timestep=0.00137)
    fallen = engine.run(scenario, settings).velocity("ball")[-1]
    np.testing.assert_allclose(fallen, 10 * 0.00137 * np.array(gravity), rtol=1e-12)


# PyBullet: which of its answers are true


@pytest.fixture
def bullet(installed):
    """PyBullet with a client of its own, which is number 0 as long as no other one is open."""
    module = installed("pybullet").module()
    client = module.connect(module.DIRECT)
    yield lambda name, *positional, **named: getattr(module, name)(*positional, **named, physicsClientId=client)
    module.disconnect(client)


def bullet_balls(bullet, count: int, maximal: bool) -> list[int]:
    """Balls whose coefficients are all different, apart from each other."""
    numbers = []
    for place in range(count):
        shape = bullet("createCollisionShape", 2, radius=0.1)  # 2: GEOM_SPHERE
        at = {"basePosition": (2 * place, 0, 0), "useMaximalCoordinates": maximal}
        number = bullet("createMultiBody", 1.1 + place, shape, **at)
        bullet("changeDynamics", number, -1, restitution=0.11 + 0.2 * place, lateralFriction=0.07 + 0.3 * place)
        moments = (0.004 + place, 0.005 + place, 0.006 + place)
        bullet("changeDynamics", number, -1, mass=1.1 + place, localInertiaDiagonal=moments)
        bullet("changeDynamics", number, -1, linearDamping=0, angularDamping=0)
        numbers.append(number)
    return numbers


def test_pybullet_returns_timestep_gravity_and_iterations(bullet):
    bullet("setTimeStep", 0.00137)
    bullet("setGravity", 0.11, 0.22, -9.33)
    bullet("setPhysicsEngineParameter", numSolverIterations=77)
    world = bullet("getPhysicsEngineParameters")
    assert (world["fixedTimeStep"], world["numSolverIterations"], world["numSubSteps"]) == (0.00137, 77, 0)
    assert [world[f"gravityAcceleration{axis}"] for axis in "XYZ"] == [0.11, 0.22, -9.33]


def test_pybullet_returns_none_of_the_parameters_of_its_contacts(bullet):
    told = {"contactSlop": 0.012, "contactERP": 0.37, "solverResidualThreshold": 1e-5, "enableConeFriction": 0}
    told |= {"useSplitImpulse": 1, "splitImpulsePenetrationThreshold": 0.007, "restitutionVelocityThreshold": 0.31}
    bullet("setPhysicsEngineParameter", **told)
    returned = bullet("getPhysicsEngineParameters")
    assert set(returned) == {
        *("fixedTimeStep", "numSubSteps", "numSolverIterations", "numNonContactInnerIterations"),
        *("useRealTimeSimulation", "gravityAccelerationX", "gravityAccelerationY", "gravityAccelerationZ"),
    }


@pytest.mark.parametrize("maximal", [True, False], ids=["maximal", "multibody"])
def test_pybullet_returns_the_mass_inertia_and_friction_it_uses(bullet, maximal):
    bullet("setTimeStep", 1e-3)
    numbers = bullet_balls(bullet, 3, maximal)
    bullet("stepSimulation")  # see the next test
    for place, number in enumerate(numbers):
        mass, friction, inertia, *_ = bullet("getDynamicsInfo", number, -1)
        assert (mass, friction) == pytest.approx((1.1 + place, 0.07 + 0.3 * place), rel=1e-12)
        assert inertia == pytest.approx((0.004 + place, 0.005 + place, 0.006 + place), rel=1e-12)
        bullet("applyExternalForce", number, -1, (3, 0, 0), (2 * place, 0, 0), 1)  # 1: in the world's axes
        bullet("applyExternalTorque", number, -1, (0.3, 0.2, 0.1), 1)
        bullet("stepSimulation")
        velocity, spin = bullet("getBaseVelocity", number)
        assert velocity[0] == pytest.approx(3 / mass * 1e-3, rel=1e-9)
        # The change of the spin that its own turn makes is of second order in the step.
        np.testing.assert_allclose(spin, np.divide((0.3, 0.2, 0.1), inertia) * 1e-3, rtol=0.05)


@pytest.mark.parametrize(("maximal", "moment"), [(True, 0.4 * 1.1 * 0.1**2), (False, 0.006)])
def test_pybullets_first_step_turns_a_maximal_body_by_its_shape(bullet, maximal, moment):
    bullet("setTimeStep", 1e-3)
    (ball,) = bullet_balls(bullet, 1, maximal)
    bullet("applyExternalTorque", ball, -1, (0, 0, 0.1), 1)
    bullet("stepSimulation")
    _, spin = bullet("getBaseVelocity", ball)
    assert spin[2] == pytest.approx(0.1 / moment * 1e-3, rel=1e-9)


def test_pybullet_returns_the_restitution_of_multibodies_only(bullet):
    for number in bullet_balls(bullet, 3, maximal=False):
        assert bullet("getDynamicsInfo", number, -1)[5] == pytest.approx(0.11 + 0.2 * number)
    other = bullet_balls(bullet, 2, maximal=True)
    # Of a body in maximal coordinates it returns what the last multibody that was asked for had.
    assert [bullet("getDynamicsInfo", number, -1)[5] for number in other] == [pytest.approx(0.51)] * 2
