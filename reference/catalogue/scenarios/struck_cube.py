"""A spinning ball that strikes a cube off its centre: where the laws of restitution part (slides 12, 16 and 18)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.engines import facts
from reference.engines.base import EXACT, Method
from reference.impact_truth import NEWTON, Contact, planar_impact
from reference.prediction import striking
from reference.scene.scenario import Body, Box, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.spatial_impact import BY_AXES, LAWS_IN_WORDS

HALF, RADIUS = 0.1, 0.05
"""Half the edge of the cube, and the radius of the ball, m. Both bodies have a mass of 1 kg."""
CUBE_INERTIA, BALL_INERTIA = 2 / 3 * HALF**2, 2 / 5 * RADIUS**2
"""About any axis, kg m²."""
SPEED, RESTITUTION = 2.0, 0.5
"""Speed of the ball, m/s, and e."""
FLIGHT = 0.10034
"""Time until the ball strikes, s: no whole number of steps."""
AFTER = 0.02
"""How long is watched after the impact, s."""
SHARE = 1e-3
"""Accepted share of the speed or of the energy: 0.1 %."""


def _struck(arm: float, spin: float, friction: float) -> Case:
    name = f"x={arm:g},ω={spin:g},μ={friction:g}"
    cube = Body("cube", Box((HALF, HALF, HALF)), 1.0)
    start = (arm, 0.0, HALF + RADIUS + SPEED * FLIGHT)
    ball = Body("ball", Sphere(RADIUS), 1.0, start, velocity=(0.0, 0.0, -SPEED), angular_velocity=(0.0, spin, 0.0))
    pair = Pair("ball", "cube", RESTITUTION, friction)
    scenario = Scenario(f"struck-cube/{name}", (cube, ball), (pair,), FLIGHT + AFTER, (0.0, 0.0, 0.0))
    return Case(name, (scenario,), {"arm": arm, "spin": spin, "friction": friction})


def _after(case: Case, law: str) -> tuple[float, float, float]:
    """Speed of parting and slip, each ÷ the speed of approach, and the share of the energy lost, by a law."""
    arm, spin = case.parameters["arm"], case.parameters["spin"]
    along, across = 2 + RADIUS**2 / BALL_INERTIA + HALF**2 / CUBE_INERTIA, -arm * HALF / CUBE_INERTIA
    friction = case.parameters["friction"]
    contact = Contact(along, across, 2 + arm**2 / CUBE_INERTIA, -RADIUS * spin, -SPEED, friction)
    pushed, pressed = planar_impact(contact, RESTITUTION, law)
    slip, parting = contact.after(pushed, pressed)
    lost = -contact.energy_gained(pushed, pressed) / ((SPEED**2 + BALL_INERTIA * spin**2) / 2)
    return parting / SPEED, slip / SPEED, lost


def _expect(which: int) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect what the implementation's own law gives.

    which: place of the number among those of `_after`, which are shares of the approach or of the energy: the slip of
    a ball that grips is zero, and a thousandth of the approach is little.
    """

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        law = NEWTON if method.law == BY_AXES else method.law  # the slip keeps to one axis
        exact = _after(case, law)[which]
        if method.kind == EXACT:
            return Expectation(exact, 1e-9, f"rounding only, by {LAWS_IN_WORDS[law]}")
        return Expectation(exact, SHARE, f"0.1 %, by {LAWS_IN_WORDS[law]}", shift_reason=_WHY, size=1.0)

    return expect


_WHY = "the contact point lies inside the bodies, or friction is too gentle to end the slip"


def _points(trajectory: Trajectory) -> Array:
    """Velocity of the ball's point of contact relative to the cube's after the impact, (3,), m/s."""
    cube, ball = trajectory.scenario.index("cube"), trajectory.scenario.index("ball")
    velocity, spin = trajectory.velocities[-1], trajectory.angular_velocities[-1]
    arm = trajectory.scenario.bodies[ball].position[0]
    at_ball = velocity[ball] + np.cross(spin[ball], (0.0, 0.0, -RADIUS))
    return np.asarray(at_ball - velocity[cube] - np.cross(spin[cube], (arm, 0.0, HALF)))


def _energy_lost(trajectory: Trajectory) -> float:
    """Share of the kinetic energy that the impact has taken."""
    way, turn = (np.sum(x**2, axis=-1) for x in (trajectory.velocities, trajectory.angular_velocities))
    energy = np.sum(way + np.array([CUBE_INERTIA, BALL_INERTIA]) * turn, axis=-1)
    return float(1 - energy[-1] / energy[0])


STRUCK_CUBE = Family(
    name="struck-cube",
    title="Spinning ball that strikes a cube off its centre",
    topic="friction",
    statements=(12, 16, 18),
    about=f"A ball at {SPEED:g} m/s, spinning about a level axis, strikes the top of a cube that floats at rest, to one"
    f" side of its centre, with e = {RESTITUTION:g}. There is no weight.",
    expected="The normal impulse turns the cube, which moves its top sideways, so the slip at the contact changes by"
    " itself. Where the slip stops or turns round, each law of restitution says something else: Newton's"
    " leaves `e` times the speed of approach, Poisson's makes the impulse of parting `e` times that of"
    " approach, and the work of Stronge's is `e²` times it. Where the slip continues, they are one law.",
    why=(
        "Each implementation is judged by what its own law predicts. The hand-written code has four laws: as exact,"
        " Newton's with friction against the slip that is left; as methods of their own Newton's with maximal"
        " dissipation, Poisson's and Stronge's.",
        "PyBullet and DART follow Newton's law. In DART the contact lies inside the bodies by up to the way of a step,"
        " which leaves a little slip where it grips.",
        f"{facts.MUJOCO_CANNOT_RUB_OFF_CENTRE} Here the bodies would part at 0.38 to 0.58 of the speed of approach"
        " instead of 0.5.",
    ),
    cases=tuple(
        _struck(*case) for case in ((0.08, -40.0, 0.3), (0.05, 20.0, 0.3), (0.08, -20.0, 0.1), (0.08, 40.0, 0.1))
    ),
    quantities=(
        Quantity(
            "restitution",
            "speed of parting ÷ of approach",
            "",
            lambda trajectory: float(_points(trajectory)[2]) / SPEED,
            _expect(0),
        ),
        Quantity(
            "slip",
            "slip after ÷ speed of approach",
            "",
            lambda trajectory: float(_points(trajectory)[0]) / SPEED,
            _expect(1),
        ),
        Quantity("lost", "share of the energy lost", "", _energy_lost, _expect(2)),
    ),
    curve=Curve(
        "x=0.08,ω=-40,μ=0.3",
        "Height of the ball above the cube's top, x = 0.08 m, −40 rad/s, μ = 0.3",
        "height, m",
        lambda trajectory: trajectory.position("ball")[:, 2] - HALF - RADIUS,
    ),
    convergence=Convergence("x=0.08,ω=-40,μ=0.3", "restitution"),
    predict=striking.predict,
)

FAMILIES = (STRUCK_CUBE,)
