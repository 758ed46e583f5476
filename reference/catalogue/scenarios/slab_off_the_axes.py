"""A slab sent off at 30° to the axes of the ground, where friction cones that are no circles show (slide 24)."""

from __future__ import annotations

import math

import numpy as np

from reference import friction_truth, truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.friction import slab_on_plane, slack_aside, way_of
from reference.catalogue.scenarios.tolerances import MILLIMETRE, ROUNDING
from reference.engines import facts
from reference.engines.base import CIRCLE, EXACT, Method
from reference.prediction import sliding
from reference.scene.scenario import GRAVITY
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

LONGEST = 1.45
"""The longest slide on any cone, over that on a circle: √2 at 45° on a diamond; a little more."""
WATCHED = 0.3
"""How long a slab that has stopped is watched, s."""
SHARE, SHARE_OF_A_CONE = 1e-3, 0.01


def _case(friction: float, speed: float, degrees: float) -> Case:
    name = f"μ={friction:g},v={speed:g},heading={degrees:g}°"
    duration = LONGEST * truth.stopping_time(speed, friction, GRAVITY) + WATCHED
    scenario = slab_on_plane(f"slab-at-30-degrees/{name}", friction, 0.0, speed, duration, math.radians(degrees))
    return Case(name, (scenario,), {"friction": friction, "speed": speed, "heading": math.radians(degrees)})


def _numbers(case: Case) -> tuple[float, float, float]:
    return case.parameters["speed"], case.parameters["friction"], case.parameters["heading"]


def _distance(case: Case) -> float:
    speed, friction, _ = _numbers(case)
    return truth.stopping_distance(speed, friction, GRAVITY)


def _across(trajectory: Trajectory) -> Array:
    """To the left of the direction that the slab sets out in, (3,)."""
    start = trajectory.velocity("slab")[0]
    return np.cross([0.0, 0.0, 1.0], start / np.linalg.norm(start))


def _aside(trajectory: Trajectory) -> float:
    positions = trajectory.position("slab")
    return float((positions[-1] - positions[0]) @ _across(trajectory))


def _end(case: Case, cone: str, timestep: float) -> tuple[float, float]:
    """Way, and how far it ends to the left of the first direction, m: of a step method with this cone.

    Each part of the velocity ends v dt/2 early, as it has already been braked when a step moves with it.
    """
    speed, friction, heading = _numbers(case)
    direction = np.array([math.cos(heading), math.sin(heading)])
    place = np.array(friction_truth.end_of_slide(cone, speed, friction, GRAVITY, heading))
    place += direction * truth.semi_implicit_stopping_shift(speed, timestep)
    return float(np.linalg.norm(place)), float(direction[0] * place[1] - direction[1] * place[0])


def _why(method: Method) -> str:
    if method.cone != CIRCLE:
        return f"its friction cone is a {method.cone}"
    return "−v₀ dt/2: a step moves with the velocity that friction has already reduced"


def _expect_distance(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _distance(case)
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * exact, "rounding only: the stop within a step is solved for")
    way, _ = _end(case, method.cone, settings.timestep)
    within_a_step = case.parameters["friction"] * GRAVITY * settings.timestep**2
    near = within_a_step if method.cone == CIRCLE else SHARE_OF_A_CONE * way
    return Expectation(exact, SHARE * exact, "0.1 % of the way", way - exact, _why(method), near)


def _expect_aside(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _distance(case)
    if method.kind == EXACT:
        return Expectation(0.0, ROUNDING, "rounding only")
    why = "1 mm: nobody sees it in a scene of metres"
    if method.cone == CIRCLE:
        return Expectation(0.0, MILLIMETRE, why)
    _, aside = _end(case, method.cone, settings.timestep)
    return Expectation(0.0, MILLIMETRE, why, aside, _why(method), SHARE_OF_A_CONE * exact, exact)


SLAB_AT_30_DEGREES = Family(
    name="slab-at-30-degrees",
    title="Slab sent off at 30°: the shape of a friction cone",
    topic="friction",
    statements=(24,),
    about="A slab is sent off over a level floor at 30° to the axes, and at 15°, 45° and 75°. It should slide along a"
    " straight line and stop.",
    expected="Friction of `μ m g` opposes the velocity, whatever its direction: Coulomb's cone is a circle. The slab"
    " stops after `v²/(2 μ g)`, in the time `v/(μ g)`, on the line that it set out on.",
    why=(
        "A cone with edges is easier for a solver, and wrong between its axes. With a diamond the magnitudes of the"
        " two components of friction add up to at most `μ m g`. Friction first opposes only the larger component of"
        " the velocity, and then acts along the diagonal. The slab ends at `D (1, sin 2φ)` in place of `D (cos φ, sin"
        " φ)`. Here `D` is the right stopping distance and φ the angle to the axis. At 30° the slab gets 32 % too far,"
        " and ends a quarter of `D` to one side. Stock MuJoCo has this cone.",
        "With a square each component of friction is at most `μ m g`. Each component of the velocity is braked by"
        " itself, and the slab ends at `D (cos² φ, sin² φ)`. At 30° it stops 21 % too early, and 16 % of `D` to the"
        " other side. Stock DART has this cone, and PyBullet with `enableConeFriction=0`.",
        "At 45° the slab stays on its line with both cones: it gets 41 % too far with the diamond, and stops 29 % too"
        " early with the square.",
        "All tuned engines have a circle, and the slab stops `v dt/2` too early, as the method predicts. Stock"
        f" PyBullet has a circle too. {facts.PYBULLET_DAMPS}",
    ),
    cases=(
        *(_case(0.4, 2.0, degrees) for degrees in (15.0, 30.0, 45.0, 75.0)),
        _case(0.2, 1.0, 30.0),
        _case(0.7, 3.0, 30.0),
    ),
    quantities=(
        Quantity(
            "distance",
            "distance from start to end",
            "m",
            lambda trajectory: measure.displacement(trajectory, "slab"),
            _expect_distance,
            _distance,
        ),
        Quantity("aside", "end to the left of the line", "m", _aside, _expect_aside, _distance, slack_aside),
    ),
    curve=Curve("μ=0.4,v=2,heading=30°", "Sent off at 30°, μ = 0.4, v₀ = 2 m/s", "distance, m", way_of),
    convergence=Convergence("μ=0.4,v=2,heading=30°", "distance", (2.0, 1.0, 0.5, 0.25)),
    grid=Grid(
        (
            Parameter("friction", "", (0.2, 0.4, 0.7), 0.4),
            Parameter("speed", "m/s", (1.0, 2.0), 2.0),
            Parameter("angle", "°", (0.0, 15.0, 30.0, 45.0), 30.0),
        ),
        (1e-3, 2e-3),
        lambda friction, speed, angle: _case(friction, speed, angle),
    ),
    predict=sliding.predict,
)

FAMILIES = (SLAB_AT_30_DEGREES,)
