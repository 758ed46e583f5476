"""Friction: a slab that slides to a stop, and a slab on an incline that holds or slides (slide 24)."""

from __future__ import annotations

import math

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import TENTHS, Grid, Parameter
from reference.catalogue.scenarios.slopes import downhill_on, normal_of
from reference.catalogue.scenarios.tolerances import MILLIMETRE, ROUNDING, from_rest, within_a_millimetre
from reference.checks import Vector
from reference.engines import facts
from reference.engines.base import BULLET, EXACT, MUJOCO_ONE_STEP, Method
from reference.prediction import bands, sliding
from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Body, Box, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

HALF_EXTENTS = (0.2, 0.2, 0.02)
"""A slab, not a cube: friction acts below the centre of mass, and a tall box would tip or hop."""
WATCHED = 0.5
"""How long a slab that has stopped is watched, s."""
INCLINE_DURATION = 3.0
HOLDS, SLIDES = 0.0, 1.0
"""Outcomes on a slope, as numbers: the slab stays where it is, or slides down."""


def slab_on_plane(
    name: str,
    friction: float,
    slope: float,
    speed: float,
    duration: float,
    heading: float = 0.0,
    half_extents: Vector = HALF_EXTENTS,
) -> Scenario:
    """A slab, or another box, that starts flat on a plane.

    slope: of the plane, rad, downhill towards +x. speed: m/s along the plane. heading: its angle from downhill, rad.
    """
    normal = normal_of(slope)
    orientation = geometry.upright_on(normal)
    velocity = speed * (math.cos(heading) * downhill_on(slope) + math.sin(heading) * np.array([0.0, 1.0, 0.0]))
    slab = Body(
        "slab",
        Box(half_extents),
        mass=1.0,
        position=tuple(normal * half_extents[2]),
        orientation=tuple(orientation),
        velocity=tuple(velocity),
    )
    plane = Body("plane", HalfSpace(tuple(normal)))
    return Scenario(name, (plane, slab), (Pair("slab", "plane", kinetic_friction=friction),), duration)


def _sliding(friction: float, speed: float, heading: float = 0.0) -> Case:
    turned = f",heading={heading:g}°" if heading else ""
    name = f"μ={friction:g},v={speed:g}{turned}"
    duration = truth.stopping_time(speed, friction, GRAVITY) + 2 * WATCHED
    scenario = slab_on_plane(f"sliding-slab/{name}", friction, 0.0, speed, duration, math.radians(heading))
    return Case(name, (scenario,), {"friction": friction, "speed": speed})


def _distance(case: Case) -> float:
    return truth.stopping_distance(case.parameters["speed"], case.parameters["friction"], GRAVITY)


def _expect_distance(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _distance(case)
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * exact, "rounding only: the stop within a step is solved for")
    shift = truth.semi_implicit_stopping_shift(case.parameters["speed"], settings.timestep)
    why = "−v₀ dt/2: a step moves with the velocity that friction has already reduced"
    within_a_step = case.parameters["friction"] * GRAVITY * settings.timestep**2
    return Expectation(exact, 1e-3 * exact, "0.1 % of the way", shift, why, within_a_step)


def _expect_time(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = truth.stopping_time(case.parameters["speed"], case.parameters["friction"], GRAVITY)
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * exact, "rounding only")
    below = measure.REST_SPEED / (case.parameters["friction"] * GRAVITY)
    step = settings.timestep * (settings.sample_every + 1)
    return Expectation(exact, below + step, "read from samples, one step and one sample wide, at 1 mm/s instead of 0")


def _sideways(trajectory: Trajectory) -> float:
    """Distance of the final position from the straight line that the slab set out on, m."""
    positions, start = trajectory.position("slab"), trajectory.velocity("slab")[0]
    way = positions[-1] - positions[0]
    direction = start / np.linalg.norm(start)
    across = way - (way @ direction) * direction
    return float(np.hypot(across[0], across[1]))


BULLETS_SHARE = 0.08
"""Share of an overlap that Bullet takes back in a step as a speed (`m_erp2`, which no profile sets)."""


def slack_of_the_stop(case: Case, settings: Settings, method: Method) -> float:
    """How much later the speed of a slab may drop below 1 mm/s, s.

    MuJoCo's friction makes the speed chatter: a sample and more. At larger timesteps up to 7000 dt² was measured, 7 ms
    at a timestep of 1 ms.

    In Bullet a fast slab loses corners and falls onto one edge, by up to `bands.LOST_CORNERS` falls of a step. Bullet
    takes a share of this overlap back in each step, as a speed; the centre gets half of it. The slab has stopped when
    this speed, which falls by that share in each step, is below 1 mm/s too.
    """
    if method.rule == BULLET:
        if not sliding.loses_corners(case.scenarios[0].body("slab"), case.parameters["speed"], settings.timestep):
            return 0.0
        rises = BULLETS_SHARE * bands.LOST_CORNERS * GRAVITY * settings.timestep / 2
        late = math.log(max(rises / measure.REST_SPEED, 1.0)) / -math.log1p(-BULLETS_SHARE)
        return settings.timestep * math.ceil(late)
    if method.rule != MUJOCO_ONE_STEP:
        return 0.0
    return 1.01 * settings.timestep * settings.sample_every + 1e4 * settings.timestep**2


CREEPS = "the slab rocks on its corners and creeps, at this timestep by more than 1 mm"


def slack_of_creep(case: Case, settings: Settings, method: Method) -> float:
    """In MuJoCo a slab that holds creeps by up to 4 dt in 3 s, so that a large timestep makes it a slide."""
    return 1.0 if method.rule == MUJOCO_ONE_STEP and 5 * settings.timestep > MILLIMETRE else 0.0


def slack_aside(case: Case, settings: Settings, method: Method) -> float:
    """Its corners, which come off the ground in turn, push a slab aside in MuJoCo: by 0.4 m for each second of dt."""
    return 1.5 * settings.timestep if method.rule == MUJOCO_ONE_STEP else 0.0


def way_of(trajectory: Trajectory) -> Array:
    """Distance of the slab from where it started, at each sample (n,), m."""
    positions = trajectory.position("slab")
    return np.asarray(np.linalg.norm(positions - positions[0], axis=1))


SLIDING_SLAB = Family(
    name="sliding-slab",
    title="Sliding slab: stopping distances",
    topic="friction",
    statements=(24,),
    about="A slab slides over a level floor and stops. Three cases head off at 30° to the axes, for engines whose"
    " friction cone is a pyramid.",
    expected="Kinetic friction `μ m g` takes away the kinetic energy `m v₀²/2` over the distance `v₀²/(2 μ g)`, in"
    " the time `v₀/(μ g)`. Then the slab stays where it is.",
    why=(
        "A step moves with the velocity that friction has already reduced, so a step method stops `v₀ dt/2` short. The"
        " tuned engines do so too; hand-written code solves for the stop and is exact.",
        f"{facts.PYBULLET_TAKES_CORNERS_IN_TURN} As these change, they push the slab aside. Tuned, its ground is a"
        " large box, on which it finds all four corners at once.",
        f"{facts.MUJOCO_LIFTS} That is so with the elliptic cone as well. Tuned, friction is left to the noslip"
        " passes, which lift nothing.",
        "MuJoCo and DART have a pyramid for a cone as installed, and a circle when they are tuned;"
        " `slab-at-30-degrees` shows the difference.",
    ),
    cases=(
        *(_sliding(friction, speed) for friction in (0.1, 0.2, 0.4, 0.7) for speed in (1.0, 2.0, 5.0)),
        *(_sliding(friction, 2.0, heading=30.0) for friction in (0.1, 0.4, 0.7)),
    ),
    quantities=(
        Quantity(
            "stopping_distance",
            "stopping distance",
            "m",
            lambda trajectory: measure.stopping_distance(trajectory, "slab", "plane"),
            _expect_distance,
            _distance,
            absent="never stops",
        ),
        Quantity(
            "stopping_time",
            "stopping time",
            "s",
            lambda trajectory: measure.rest_time(trajectory, "slab"),
            _expect_time,
            lambda case: truth.stopping_time(case.parameters["speed"], case.parameters["friction"], GRAVITY),
            slack_of_the_stop,
            absent="never stops",
        ),
        Quantity(
            "sideways",
            "distance from the straight line",
            "m",
            _sideways,
            within_a_millimetre,
            slack=slack_aside,
        ),
        Quantity(
            "creep",
            "creep after the stop",
            "m",
            lambda trajectory: measure.drift(trajectory, "slab", WATCHED),
            within_a_millimetre,
        ),
    ),
    curve=Curve("μ=0.4,v=2,heading=30°", "Sliding at μ = 0.4, v₀ = 2 m/s, heading 30°", "distance, m", way_of),
    convergence=Convergence("μ=0.4,v=2", "stopping_distance", (2.0, 1.0, 0.5, 0.25)),
    grid=Grid(
        (Parameter("friction", "", TENTHS[1:], 0.4), Parameter("speed", "m/s", (1.0, 2.0, 5.0), 2.0)),
        (1e-3, 2e-3, 5e-3),
        _sliding,
    ),
    predict=sliding.predict,
)


def _incline(friction: float, degrees: float) -> Case:
    name = f"μ={friction:g},θ={degrees:g}°"
    scenario = slab_on_plane(f"incline/{name}", friction, math.radians(degrees), 0.0, INCLINE_DURATION)
    return Case(name, (scenario,), {"friction": friction, "slope": math.radians(degrees)})


def _acceleration(case: Case) -> float:
    return truth.incline_acceleration(case.parameters["friction"], case.parameters["slope"], GRAVITY)


def _slid(case: Case) -> float:
    """Way after the whole duration, m; 0 where the slab holds."""
    return _acceleration(case) * INCLINE_DURATION**2 / 2


def _moves(trajectory: Trajectory) -> float:
    return SLIDES if measure.displacement(trajectory, "slab") > MILLIMETRE else HOLDS


def _expect_moves(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(
        SLIDES if _slid(case) > 0 else HOLDS,
        0.0,
        "holds (0) if it creeps less than 1 mm in 3 s, else slides (1)",
        shift_reason=CREEPS,
    )


def _expect_way(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _slid(case)
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * max(exact, 1.0), "rounding only")
    if exact == 0:
        return Expectation(0.0, MILLIMETRE, "1 mm in 3 s: a slope that holds must not creep")
    return from_rest(_acceleration(case), INCLINE_DURATION, settings, 1e-3, "0.1 % of the way")


INCLINE = Family(
    name="incline",
    title="Incline: hold or slide",
    topic="friction",
    statements=(24,),
    about="A slab is let go on a slope, for five coefficients of friction and five angles. Each case is watched for 3"
    " s.",
    expected="Static friction holds at most `μ m g cos θ` against the pull `m g sin θ`: the slab stays where it is"
    " if `tan θ ≤ μ`. Otherwise it slides with `g (sin θ − μ cos θ)`.",
    why=(
        "All, exact or tuned, decide every case as `tan θ ≤ μ` does. They differ in how still a held slab is:"
        " hand-written code sets its velocity to zero, and PyBullet and DART leave less than a micrometre."
        f" {facts.MUJOCO_ROCKS}",
    ),
    cases=tuple(
        _incline(friction, degrees)
        for friction in (0.1, 0.3, 0.5, 0.7, 1.0)
        for degrees in (3.0, 10.0, 20.0, 30.0, 40.0)
    ),
    quantities=(
        Quantity("moves", "holds (0) or slides (1)", "", _moves, _expect_moves, slack=slack_of_creep),
        Quantity(
            "way",
            "distance in 3 s",
            "m",
            lambda trajectory: measure.displacement(trajectory, "slab"),
            _expect_way,
            _slid,
        ),
    ),
    curve=Curve("μ=0.3,θ=20°", "Sliding down 20° at μ = 0.3", "distance, m", way_of),
    convergence=Convergence("μ=0.3,θ=20°", "way"),
    grid=Grid(
        (
            Parameter("friction", "", (0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0), 0.3),
            Parameter("angle", "°", (3.0, 10.0, 20.0, 30.0, 40.0), 20.0),
        ),
        (1e-3, 2e-3, 5e-3),
        lambda friction, angle: _incline(friction, angle),
    ),
    predict=sliding.predict,
)

FAMILIES = (SLIDING_SLAB, INCLINE)
