"""Pellets shot at walls: speed, timestep and thickness, with a test at the steps and along them (slides 2, 5 and 9)."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.tunnelling import passing_share
from reference.engines.base import AT_STEP, COMPLIANT, EXACT, TURN_BACK, Method
from reference.prediction import passing
from reference.scene import geometry
from reference.scene.scenario import Body, Box, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS, MASS = 0.005, 0.002
"""Of a pellet, m and kg."""
RESTITUTION = 0.5
TURN = (0.4, -0.2, 0.8, 0.4)
"""Orientation of the wall, a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1. The pellets fly along its own x axis."""
BESIDE = (0.0, 0.13, 0.0)
"""Where the pellets meet the wall, beside its middle, in its own axes, m."""
SHOTS = 29
"""Shots in an ensemble, a prime: their phases within a step are evenly spread for any timestep."""
FLIGHT, SPREAD = 0.03003, 0.05
"""Mean time until a pellet touches the wall, and what the times span, s. The span is a whole number of 0.1, 0.2, 0.5, 1
and 2 ms. No flight is: rounding would decide in which step the pellet is noticed."""
AFTER = 0.01
"""How long is watched after the touch, s."""
MILLIMETRE, SHARE, ROUNDING = 1e-3, 1e-3, 1e-9
"""Accepted way, m, share of a speed, and share of what nothing but rounding changes."""


def _in_the_world(vector: tuple[float, float, float]) -> Array:
    return geometry.rotate(np.array(TURN), np.array(vector))


def _shot(name: str, speed: float, thickness: float, time: float) -> Scenario:
    """A weightless pellet that touches the wall after so many seconds."""
    ahead = _in_the_world((1.0, 0.0, 0.0))
    touch = _in_the_world(BESIDE) - (thickness / 2 + RADIUS) * ahead
    start, velocity = touch - speed * time * ahead, speed * ahead
    pellet = Body("pellet", Sphere(RADIUS), MASS, tuple(start.tolist()), velocity=tuple(velocity.tolist()))
    wall = Body("wall", Box((thickness / 2, 0.4, 0.3)), orientation=TURN)
    pair = Pair("pellet", "wall", RESTITUTION)
    return Scenario(f"pellets/{name}", (wall, pellet), (pair,), time + AFTER, gravity=(0.0, 0.0, 0.0))


def _case(speed: float, thickness: float) -> Case:
    name = f"v={speed:g},w={1000 * thickness:g}mm"
    times = sorted(
        (FLIGHT + SPREAD * (number - SHOTS // 2) / SHOTS for number in range(SHOTS)), key=lambda at: abs(at - FLIGHT)
    )
    scenarios = tuple(_shot(name, speed, thickness, time) for time in times)
    return Case(name, scenarios, {"speed": speed, "thickness": thickness})


def caught_way(thickness: float, method: Method) -> float:
    """Way, m, on which a step that ends there turns a pellet back: up to the middle of the wall, or by hand all of it.

    MuJoCo's margin adds to it, which no expectation asks for: the recurrence says what becomes of that.
    """
    to_the_middle = thickness / 2 + RADIUS
    return 2 * to_the_middle if method.rule == TURN_BACK else to_the_middle


def _share_that_passes(case: Case, settings: Settings, method: Method) -> float:
    if method.kind != AT_STEP:
        return 0.0
    way = caught_way(case.parameters["thickness"], method)
    return passing_share(case.parameters["speed"], settings.timestep, way)


def _why(method: Method) -> str:
    if method.kind == COMPLIANT:
        return "the spring gives way so far that the pellet gets past the middle of the wall"
    if method.rule == TURN_BACK:
        return "1 − (w + 2 r)/(v Δt): no step ends where the pellet overlaps the wall"
    return "1 − (w/2 + r)/(v Δt): no step ends where the pellet overlaps the wall on its own side of the middle"


def _ahead(trajectory: Trajectory) -> Array:
    velocity = np.array(trajectory.scenario.body("pellet").velocity)
    return np.asarray(velocity / np.linalg.norm(velocity))


def _before_the_wall(trajectory: Trajectory) -> Array:
    """How far the pellet is from the first touch, along its flight, m; positive before it."""
    wall, pellet = trajectory.scenario.body("wall"), trajectory.scenario.body("pellet")
    way = (trajectory.position("pellet") - np.array(pellet.position)) @ _ahead(trajectory)
    return np.asarray(geometry.gap(wall, pellet) - way)


def _passed(trajectory: Trajectory) -> float:
    """1 for a pellet that ends behind the wall, 0 for one that does not."""
    wall = trajectory.scenario.body("wall")
    behind = (trajectory.position("pellet")[-1] - np.array(wall.position)) @ _ahead(trajectory)
    return float(behind > 0)


def _expect_passed(case: Case, settings: Settings, method: Method) -> Expectation:
    # Each pellet passes or does not: one that passes is as wrong as it can be. Over evenly spread phases a share
    # differs by less than one pellet; one more for rounding where a phase is an edge.
    one = 1 / SHOTS
    shift = _share_that_passes(case, settings, method)
    bound = min(2 * one, shift / 2)
    return Expectation(0.0, one / 2, "not one pellet of them all", shift, _why(method), bound, one)


def _velocity_kept(trajectory: Trajectory) -> float:
    """Velocity at the end over velocity at the start: −e for a pellet that came back, 1 for one that passed unseen."""
    along = trajectory.velocity("pellet") @ _ahead(trajectory)
    return float(along[-1] / along[0])


def _expect_velocity(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(-RESTITUTION, ROUNDING, "rounding only: an impact is all that changes a speed")
    turned, near = 1 + RESTITUTION, SHARE * RESTITUTION
    shift = turned * _share_that_passes(case, settings, method)
    bound = min(2 * turned / SHOTS + near, shift / 2)
    reason = "0.1 %: without weight or air an impact is all that changes a speed"
    return Expectation(-RESTITUTION, near, reason, shift, _why(method), bound)


def _late(trajectory: Trajectory) -> float:
    """How much later than in theory the pellet is where it is at the end, s; negative if it is early.

    In theory it comes back from the touch at e v. One that has passed the wall is farther behind on this way the
    longer one looks.
    """
    wall, pellet = trajectory.scenario.body("wall"), trajectory.scenario.body("pellet")
    speed, way_there = float(np.linalg.norm(pellet.velocity)), geometry.gap(wall, pellet)
    in_theory = RESTITUTION * (speed * float(trajectory.times[-1]) - way_there)
    return float(in_theory - _before_the_wall(trajectory)[-1]) / (RESTITUTION * speed)


def _expect_late(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(0.0, ROUNDING, "rounding only: the instant of the touch is solved for")
    near = MILLIMETRE / (RESTITUTION * case.parameters["speed"])
    why = "an impact is resolved at the start of a step, and what passes never comes back"
    return Expectation(0.0, near, "1 mm of the way back: nobody sees it in a scene of metres", shift_reason=why)


SPEEDS, THICKNESSES = (20.0, 60.0, 180.0), (0.003, 0.012)
PELLETS = Family(
    name="pellets",
    title="Pellets at a wall: speed, timestep and thickness",
    topic="detection",
    statements=(2, 5, 9, 10),
    about=f"A weightless pellet of {1000 * RADIUS:g} mm radius flies straight at a fixed wall that is turned in space,"
    f" and would hit it beside its middle. Every figure is the mean over {SHOTS} shots that touch the wall at evenly"
    " spread instants of a step.",
    expected="No pellet passes, each comes back with `−e v`, and it turns back at the instant of the touch, `T = t +"
    " Δt s0/(s0 − s1)`.",
    why=(
        "One number decides how many pellets pass a test at the ends of steps: the length of a step, `v Δt`, divided"
        " by the length of the path on which a pellet is turned back. That path is `w/2 + r` long in an engine, and `w"
        " + 2r` in the hand-written code. Tripling the speed has the same effect as tripling the timestep. At 60 m/s"
        " and 1 ms, 89 % of the pellets pass a wall of 3 mm, and 82 % pass one of 12 mm.",
        "PyBullet has continuous detection (`ccdSweptSphereRadius`), which its profile `swept` uses: a smaller ball is"
        " swept along the step, and the step ends where it meets the wall. No pellet passes, and each comes back with"
        " `−e v`. The rest of the step is lost, because the velocity changes only in the next one. So the pellet is"
        " late, by half a timestep on average.",
        "MuJoCo has no continuous detection. In its profile `swept` a contact counts from a gap of `v Δt` on"
        " (`margin`), so that some step ends within it. No pellet passes, but none touches the wall either: each turns"
        " back before it, and so is early, by up to `(1 + e)/e` timesteps.",
        "DART has neither continuous detection nor such a margin, and only a smaller timestep helps. The hand-written"
        " code asks `overlap_interval` for the first instant of the step at which the pellet overlaps the wall. It"
        " turns the pellet back at that instant, and then moves it for the rest of the step.",
    ),
    cases=tuple(_case(speed, thickness) for speed in SPEEDS for thickness in THICKNESSES),
    quantities=(
        Quantity("passed", "share that passes", "", _passed, _expect_passed),
        Quantity(
            "velocity_kept", "velocity after ÷ before", "", _velocity_kept, _expect_velocity, lambda case: RESTITUTION
        ),
        Quantity("late", "delay of the way back", "s", _late, _expect_late),
    ),
    curve=Curve("v=60,w=12mm", "The first of the shots at 60 m/s", "distance before the touch, m", _before_the_wall),
    convergence=Convergence("v=60,w=12mm", "passed", (4.0, 2.0, 1.0, 0.5)),
    grid=Grid(
        (Parameter("speed", "m/s", SPEEDS, 60.0), Parameter("thickness", "m", THICKNESSES, 0.012)),
        (2e-4, 1e-3, 2e-3),
        _case,
    ),
    predict=passing.predict,
)

FAMILIES = (PELLETS,)
