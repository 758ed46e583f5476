"""A slab that friction must hold, on a slope or under a steady push: how fast it creeps (slide 24)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from reference import friction_truth
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.friction import slab_on_plane, way_of
from reference.engines import facts
from reference.engines.base import DIAMOND, EXACT, Method
from reference.prediction import sliding
from reference.scene.forces import Force
from reference.scene.scenario import GRAVITY
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

MASS = 1.5
"""kg, of a slab that is pushed."""
DURATION = 1.5
LATE = 0.75
"""The part of the run in which the speed is read, s: a soft contact has settled long before."""
SLOW = 1e-3 / 3.0
"""A millimetre in 3 s, m/s."""
SHARE = 1e-3


def _on_a_slope(friction: float, degrees: float) -> Case:
    slope = math.radians(degrees)
    name = f"μ={friction:g},θ={degrees:g}°"
    scenario = slab_on_plane(f"creep/{name}", friction, slope, 0.0, DURATION)
    pull = GRAVITY * math.sin(slope)
    return Case(name, (scenario,), _told(friction, pull, 0.0, GRAVITY * math.cos(slope)))


def _pushed(friction: float, share: float, degrees: float) -> Case:
    """Pushed on the level with a share of what friction can hold, at an angle to the x axis."""
    heading, pull = math.radians(degrees), share * friction * GRAVITY
    name = f"μ={friction:g},F={share:g}μmg,heading={degrees:g}°"
    scenario = slab_on_plane(f"creep/{name}", friction, 0.0, 0.0, DURATION)
    bodies = tuple(body if body.immovable else replace(body, mass=MASS) for body in scenario.bodies)
    x, y = pull * math.cos(heading), pull * math.sin(heading)
    scenario = replace(scenario, bodies=bodies, forces=(Force("slab", (MASS * x, MASS * y, 0.0)),))
    return Case(name, (scenario,), _told(friction, x, y, GRAVITY))


def _told(friction: float, x: float, y: float, pressed: float) -> dict[str, float]:
    """The pull along the plane and the pressure into it, m/s²."""
    return {"friction": friction, "x": x, "y": y, "pressed": pressed}


def _speed(trajectory: Trajectory) -> float:
    """Mean speed over the late part of the run, m/s."""
    late = trajectory.times >= trajectory.times[-1] - LATE * (1 + 1e-9)
    times, positions = trajectory.times[late], trajectory.position("slab")[late]
    return float(np.linalg.norm(positions[-1] - positions[0]) / (times[-1] - times[0]))


def _expect_speed(case: Case, settings: Settings, method: Method) -> Expectation:
    size = 1 / DURATION  # the band of what holds is for the way of the whole run
    if method.kind == EXACT:
        return Expectation(0.0, 1e-15, "rounding only: what friction holds does not move", size=size)
    why = "1 mm in 3 s: nobody sees it"
    if method.cone != DIAMOND or settings.options.get("contact") != "default":
        return Expectation(0.0, SLOW, why, size=size)
    told = case.parameters
    creeps = math.hypot(
        *friction_truth.creep_of_a_soft_pyramid(told["friction"], (told["x"], told["y"]), told["pressed"])
    )
    soft = facts.MUJOCO_CREEPS.removesuffix(".")
    return Expectation(0.0, SLOW, why, creeps, soft, SHARE * creeps, size)


CREEP = Family(
    name="creep",
    title="Creep of a slab that friction holds",
    topic="friction",
    statements=(24,),
    about="A slab is let go on slopes on which friction should hold it, or lies on level ground under a steady push"
    f" below the limit of friction, in one case at 30° to the axes. The speed is measured from {DURATION - LATE:g} s"
    f" to the end, at {DURATION:g} s.",
    expected="Static friction balances the pull as long as the pull is at most `μ N`. So nothing moves.",
    why=(
        "Hand-written code sets the velocity to zero. Tuned PyBullet and DART end any slip within a step, and hardly"
        " creep.",
        facts.MUJOCO_ROCKS,
        "Stock MuJoCo creeps for a different reason. Its friction is a dashpot: an edge of its pyramid pushes back"
        " only while the slab moves. The speed at which the dashpots carry the pull has a closed form. With default"
        " contacts, on four corners, it is the pull over the mass times `(1 + μ²) (1 − d) d₁ t_c/(8 d)`. Here `t_c` is"
        " 20 ms, and the impedance `d` is 0.9 and grows with the overlap, to `d₁ = 0.95`. Where the pull exceeds half"
        " of `μ N`, one edge of the pyramid can no longer push, and the speed becomes up to twice as large. A smaller"
        " timestep changes nothing.",
        f"{facts.DART_HAS_ONE_POINT} The slab wanders off that way.",
    ),
    cases=(
        *(_on_a_slope(*each) for each in ((1.0, 40.0), (0.7, 30.0), (0.5, 20.0), (0.3, 10.0))),
        _pushed(0.4, 0.9, 0.0),
        _pushed(0.5, 0.4, 30.0),
    ),
    quantities=(Quantity("speed", "speed of the creep", "m/s", _speed, _expect_speed),),
    curve=Curve("μ=1,θ=40°", "Held on 40° at μ = 1", "distance, m", way_of),
    convergence=Convergence("μ=1,θ=40°", "speed"),
    grid=Grid(
        (
            Parameter("friction", "", (0.5, 0.8, 1.0), 1.0),
            Parameter("angle", "°", (0.0, 10.0, 20.0, 26.0), 20.0),
        ),
        (1e-3, 4e-3),
        lambda friction, angle: _on_a_slope(friction, angle),
    ),
    predict=sliding.predict,
)

FAMILIES = (CREEP,)
