"""A ball that falls into a bowl: it rests on the floor, or on the invisible lid of the bowl's hull (slide 9)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios import bowls, solids
from reference.catalogue.scenarios.bowls import RIM, SIZE
from reference.catalogue.scenarios.tolerances import ROUNDING
from reference.checks import Quaternion
from reference.engines import facts
from reference.engines.base import BULLET, EXACT, Method
from reference.engines.surveying import CONTACTS_OF, HULL
from reference.errors import RunFailed
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import GRAVITY, Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory
from reference.solid_truth import Fall, after_a_wall, lid

DROP = 0.2
"""Height of the ball's underside above the rim at the start, m."""
RESTITUTION = 0.4
MASS, DURATION = 1.0, 1.0
PLACE = (1.3, -0.7, 0.4)
ABOUT_Z: Quaternion = (0.96, 0.0, 0.0, 0.28)
"""A unit quaternion, 0.9216 + 0.0784 = 1: a turn by 32.5° about the vertical."""
BESIDE = (0.1, -0.15)
"""Where the ball falls in, in the bowl's own axes, m: beside the middle, and not over an edge of a triangle."""
ALONG = 0.2
"""The same along the wall that the ball strikes on its way, m."""
DEEP, SHALLOW, RADIUS, SMALL = 0.3125, 0.1875, 0.1, 0.05
SHARE, SPEED = 0.01, 2.9
"""Accepted share of a speed, 1 %, of that at which the ball strikes the wall, m/s: it has fallen 0.437 m by then."""
ON_THE_LID = "the bowl's hull has a lid, and the ball meets that"
"""Why a method is away from theory that has nothing but the hull."""


def _case(name: str, shape: Polyhedron, radius: float, x: float, y: float, wall: bool = False) -> Case:
    solid = solids.placed(shape, PLACE, ABOUT_Z)
    ball = Body("ball", Sphere(radius), MASS, solid.at(np.array([x, y, RIM + DROP + radius])))
    pairs = (Pair("ball", "solid", RESTITUTION),)
    scenario = Scenario(f"ball-in-a-bowl/{name}", (solid.body, ball), pairs, DURATION)
    return Case(name, (scenario,), {"depth": bowls.depth_of(shape), "radius": radius, "wall": float(wall)})


def _dropped(depth: float, radius: float) -> Case:
    return _case(f"depth={depth:g},radius={radius:g}", bowls.bowl(depth), radius, *BESIDE)


def _on_the_wall(depth: float, radius: float) -> Case:
    """The ball strikes the left wall on its way, halfway down."""
    shape = bowls.bowl(depth)
    corner, normal = _left_wall(shape)
    halfway = corner[0] - normal[2] / normal[0] * (RIM - depth / 2 - corner[2])
    return _case("wall", shape, radius, halfway + radius * normal[0], ALONG, True)


def _left_wall(shape: Polyhedron) -> tuple[Array, Array]:
    """A corner of the wall that faces along x, and its normal, in the bowl's own axes."""
    return next((corner, normal) for corner, normal in bowls.inner_faces(shape) if normal[0] > 0.5)


# What is measured


def _underside(trajectory: Trajectory) -> Array:
    """Height of the ball's lowest point above the underside of the bowl at each sample, (n,), m."""
    scenario = trajectory.scenario
    solid, ball = scenario.body("solid"), scenario.body("ball")
    assert isinstance(ball.shape, Sphere)
    return np.asarray(trajectory.position("ball")[:, 2] - solid.position[2] - ball.shape.radius)


def _rest(trajectory: Trajectory) -> float:
    """Height of the ball's centre above the underside of the bowl at the end, m."""
    ball = trajectory.scenario.body("ball").shape
    assert isinstance(ball, Sphere)
    return float(_underside(trajectory)[-1]) + ball.radius


def _falls_by_chance(case: Case, settings: Settings, method: Method) -> float:
    """Tuned PyBullet's ball rests with a gap of 0, and rounding decides in which steps that is a contact, m.

    In a step without one the ball falls by g dt², and the next step puts a share of that back.
    """
    return GRAVITY * settings.timestep**2 if method.rule == BULLET else 0.0


def _level(trajectory: Trajectory) -> float:
    """Height of the level face that the ball comes nearest to with its lowest point, above the underside, m."""
    shape = trajectory.scenario.body("solid").shape
    assert isinstance(shape, Polyhedron)
    lowest = float(np.min(_underside(trajectory)))
    return min(bowls.levels(shape), key=lambda level: abs(level - lowest))


def _rises(trajectory: Trajectory) -> int:
    """The first sample in which the ball moves upwards."""
    upwards = np.flatnonzero(trajectory.velocity("ball")[:, 2] > measure.REST_SPEED)
    if not len(upwards):
        raise RunFailed("the ball never moves upwards again")
    return int(upwards[0])


def _flights(trajectory: Trajectory, samples: slice) -> list[measure.Flight]:
    """The flights above the level face that the ball met, among some samples."""
    scenario = trajectory.scenario
    x, y, z = scenario.body("solid").position
    level = Body("level", HalfSpace(), position=(x, y, z + _level(trajectory)))
    flat = replace(scenario, bodies=(level, scenario.body("ball")), pairs=(Pair("ball", "level"),))
    told = bowls.told_of(flat, trajectory)
    part = replace(
        told,
        times=told.times[samples],
        positions=told.positions[samples],
        orientations=told.orientations[samples],
        velocities=told.velocities[samples],
        angular_velocities=told.angular_velocities[samples],
    )
    return measure.flights(part, "ball", "level")


def _over_the_floor(trajectory: Trajectory) -> Array:
    """Height of the ball's lowest point above the floor at each sample, (n,), m."""
    shape = trajectory.scenario.body("solid").shape
    assert isinstance(shape, Polyhedron)
    return _underside(trajectory) - bowls.levels(shape)[0]


def _landing(trajectory: Trajectory) -> float:
    """When the last flight before the ball first rises ends on the level face, s."""
    found = _flights(trajectory, slice(0, max(2, _rises(trajectory))))
    if not found:
        raise RunFailed("the ball does not fly before it lands")
    return found[-1].landing_time


def _rebound(trajectory: Trajectory) -> float:
    """Height of the ball's lowest point above the floor at the top of its first rebound, m."""
    found = _flights(trajectory, slice(_rises(trajectory), None))
    shape = trajectory.scenario.body("solid").shape
    assert isinstance(shape, Polyhedron)
    above = _level(trajectory) - bowls.levels(shape)[0]
    return above + (found[0].apex_height if found else 0.0)


def _aside(trajectory: Trajectory) -> float:
    """Level speed at the end, m/s."""
    return float(np.hypot(*trajectory.velocity("ball")[-1, :2]))


# What theory says


def _fall(case: Case, on_the_lid: bool) -> Fall:
    """The fall of a case, in a bowl or on the lid of its hull."""
    depth, radius = case.parameters["depth"], case.parameters["radius"]
    if on_the_lid or not case.parameters["wall"]:
        height = DROP if on_the_lid else DROP + depth
        return after_a_wall(height, 0.0, (0.0, 0.0), RESTITUTION, GRAVITY)
    shape = case.scenarios[0].body("solid").shape
    assert isinstance(shape, Polyhedron)
    _, normal = _left_wall(shape)
    # It touches the wall where its centre is a radius from it, with the touching point halfway down.
    to_wall = DROP + radius + depth / 2 - radius * float(normal[2])
    return after_a_wall(to_wall, DROP + depth - to_wall, (float(normal[0]), float(normal[2])), RESTITUTION, GRAVITY)


def _resting(case: Case, on_the_lid: bool) -> float:
    floor = RIM - case.parameters["depth"]
    (left, right), _ = bowls.OUTER
    return case.parameters["radius"] + (lid((left, RIM), (right, RIM), BESIDE[0]) if on_the_lid else floor)


def _rebound_in_theory(case: Case, on_the_lid: bool) -> float:
    return (case.parameters["depth"] if on_the_lid else 0.0) + _fall(case, on_the_lid).rebound


Tolerance = Callable[[float, Settings], tuple[float, str]]
"""The value and the settings → how near is near enough, and why."""


def _expect(theory: Callable[[Case, bool], float], near: Tolerance) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect what theory says; of a method that has the hull alone, with the shift from the bowl to the lid."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        value, depth = theory(case, False), case.parameters["depth"]
        tolerance, reason = near(value, settings) if method.kind != EXACT else (ROUNDING, "rounding only")
        if depth == 0 or settings.options.get(CONTACTS_OF) != HULL:
            return Expectation(value, tolerance, reason, shift_reason=_why(settings, method), size=depth)
        shift = theory(case, True) - value
        return Expectation(value, tolerance, reason, shift, ON_THE_LID, tolerance, abs(shift))

    return expect


def _why(settings: Settings, method: Method) -> str:
    if bowls.falls_through(settings, method):
        return "its default detector gives depths in a mesh a wrong sign, and the ball falls through"
    return "it notices the impact at a step, and the ball is in overlap by then"


def _near_in_length(value: float, settings: Settings) -> tuple[float, str]:
    return solids.SHARE * SIZE, "0.1 % of the bowl's size"


def _near_in_time(value: float, settings: Settings) -> tuple[float, str]:
    return 2 * settings.timestep, "two steps: a step falls g t dt/2 too far, and notices each impact up to a step late"


def _near_in_speed(value: float, settings: Settings) -> tuple[float, str]:
    return SHARE * SPEED, "1 % of the speed at which the ball strikes the wall"


def _radius(case: Case) -> float:
    return case.parameters["radius"]


BALL_IN_A_BOWL = Family(
    name="ball-in-a-bowl",
    title="A ball in a bowl",
    topic="polyhedra",
    statements=(9,),
    about="A smooth ball of 1 kg is let go 0.2 m above the rim of a bowl, beside its middle, and bounces with e = 0.4."
    " The bowl is a concave polyhedron 1.6 m wide: a floor and four slanting walls of unequal width, with a level"
    " rim, turned about the vertical. In the case `wall` the ball strikes a wall on its way; in the case `hull` the"
    " solid is the bowl's convex hull, a block.",
    expected="The ball comes to rest on the floor, with its centre one radius above it. It reaches the floor after"
    " `√(2h/g)` and rebounds to `e² h`. A wall turns the velocity along its normal into `−e` times itself, so that the"
    " ball leaves the wall with the level speed `(1 + e) v n_x n_z`. On the block the ball rests one radius above the"
    " rim.",
    why=(
        "A convex hull contains every segment between two of its points. The hull of the bowl therefore has a lid from"
        " rim to rim. Nobody sees the lid, but the ball comes to rest on it, as high above the floor as the bowl is"
        " deep.",
        f"{facts.PYBULLET_MAKES_HULLS} {facts.PYBULLET_WIDENS_HULLS} If it is given the faces as well (`indices`), it"
        " keeps the triangles of a body that does not move, and the ball falls to the floor. The tuned settings do"
        " that.",
        f"{facts.MUJOCO_TAKES_HULLS} The tuned settings give it the bowl as five convex pieces, one geom each.",
        "DART keeps the triangles. But its default detector, the Flexible Collision Library, reports the depth of a"
        " ball in a mesh as a negative number, and DART ignores a contact without depth. So the ball falls through"
        " every mesh, through the block as well as through the bowl. In the tuned settings DART's own detector finds"
        " the contacts.",
        "The hand-written world uses convex pieces too. The pieces meet along the edges between walls, and the floor is"
        " one piece, so that no edge within a flat face can stop the ball.",
    ),
    cases=(
        _case(f"depth={DEEP:g}", bowls.bowl(DEEP), RADIUS, *BESIDE),
        _case(f"depth={SHALLOW:g}", bowls.bowl(SHALLOW), RADIUS, *BESIDE),
        _case(f"radius={SMALL:g}", bowls.bowl(DEEP), SMALL, *BESIDE),
        _on_the_wall(DEEP, RADIUS),
        _case("hull", bowls.block(), RADIUS, *BESIDE),
    ),
    quantities=(
        Quantity("rest", "height at rest", "m", _rest, _expect(_resting, _near_in_length), _radius,
                 _falls_by_chance),
        Quantity("landing", "time of landing", "s", _landing,
                 _expect(lambda case, lid: _fall(case, lid).time, _near_in_time), lambda case: _fall(case, False).time,
                 absent="falls through"),
        Quantity("rebound", "first rebound", "m", _rebound, _expect(_rebound_in_theory, _near_in_length), _radius,
                 absent="falls through"),
        Quantity("aside", "level speed", "m/s", _aside, _expect(lambda case, lid: _fall(case, lid).aside,
                 _near_in_speed), lambda case: SPEED),
    ),
    curve=Curve(f"depth={DEEP:g}", "A ball falls into a bowl", "height over the floor, m", _over_the_floor),
    convergence=Convergence("wall", "aside", (4.0, 2.0, 1.0)),
    grid=Grid(
        (
            Parameter("depth", "m", (0.125, 0.1875, 0.25, 0.3125), DEEP),
            Parameter("radius", "m", (0.05, 0.1, 0.15), RADIUS),
        ),
        (1e-3, 2e-3),
        _dropped,
    ),
    predict=bowls.predict,
)  # fmt: skip

FAMILIES = (BALL_IN_A_BOWL,)
