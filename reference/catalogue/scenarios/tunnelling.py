"""Small fast balls shot at a thin wall: how many pass through it unnoticed (slides 2, 9 and 10)."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import AT_STEP, EXACT, TURN_BACK, Method
from reference.prediction import passing
from reference.scene.scenario import Body, Box, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.02
"""Radius of the ball, m: that of table tennis."""
THICKNESS = 0.01
"""Thickness of the wall, m."""
CAUGHT = THICKNESS / 2 + RADIUS
"""Length of the way, m, on which a ball overlaps the wall and is still on its own side of the middle."""
OVERLAPPED = THICKNESS + 2 * RADIUS
"""Length of the way, m, on which a ball overlaps the wall at all."""
RESTITUTION = 0.5
SHOTS = 53
"""Shots in an ensemble, a prime: their phases within a step are evenly spread for any timestep. Each is judged by
itself; the mean is shown."""
MIDDLE, SPREAD = 0.06003, 0.1
"""Mean flight time, and what the flight times span, s. The span is a whole number of 4 ms and of 1/60 s, and of what
divides these. No flight is: rounding would decide in which step the ball is noticed."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a speed, 0.1 %, and of one that nothing but rounding changes."""
AFTER = 0.03
"""How long a ball is watched after it should have met the wall, s."""


def shot(name: str, speed: float, flight_time: float) -> Scenario:
    """A weightless ball that meets the wall after so many seconds; the wall's middle is x = 0."""
    start = -(CAUGHT + speed * flight_time)
    ball = Body("ball", Sphere(RADIUS), 0.01, (start, 0.0, 0.0), velocity=(speed, 0.0, 0.0))
    wall = Body("wall", Box((THICKNESS / 2, 0.5, 0.5)))
    pair = Pair("ball", "wall", RESTITUTION)
    return Scenario(name, (wall, ball), (pair,), flight_time + AFTER, gravity=(0.0, 0.0, 0.0))


def _case(speed: float) -> Case:
    name = f"v={speed:g}"
    times = (MIDDLE + SPREAD * (number - SHOTS // 2) / SHOTS for number in range(SHOTS))
    scenarios = tuple(shot(f"thin-wall/{name}", speed, time) for time in times)
    return Case(name, scenarios, {"speed": speed, "thickness": THICKNESS})


def passing_share(speed: float, timestep: float, caught: float = CAUGHT) -> float:
    """Share of the balls that no step catches, if it is left to chance where in a step they meet the wall.

    caught: length of the way on which a step that ends there turns the ball back, m.
    """
    return max(0.0, 1.0 - caught / (speed * timestep))


def _shift(case: Case, settings: Settings, method: Method) -> float:
    """The share that passes: an engine pushes a ball out of the nearest face, by hand any overlap turns it back.

    A ball is caught if the first step that ends after it has met the wall ends soon enough.
    """
    if method.kind != AT_STEP:
        return 0.0
    caught = OVERLAPPED if method.rule == TURN_BACK else CAUGHT
    meets = np.array([scenario.duration - AFTER for scenario in case.scenarios])
    late = -meets % settings.timestep
    return float(np.mean(late * case.parameters["speed"] > caught))


def _why_through(method: Method) -> str:
    if method.rule == TURN_BACK:
        return "1 − (w + 2 r)/(v Δt): no step ends where the ball overlaps the wall"
    return "1 − (w/2 + r)/(v Δt): no step ends where the ball overlaps the wall on its own side of the middle"


def _passed(trajectory: Trajectory) -> float:
    """1 for a ball that ends behind the wall, 0 for one that does not."""
    return float(trajectory.position("ball")[-1, 0] > 0)


def _expect_passed(case: Case, settings: Settings, method: Method) -> Expectation:
    # Each ball passes or does not: one that passes is as wrong as it can be. Over evenly spread phases a share differs
    # by less than one ball; one more for rounding where a phase is an edge.
    one = 1 / SHOTS
    shift = _shift(case, settings, method)
    return Expectation(0.0, one / 2, "not one ball of them all", shift, _why_through(method), 2 * one, one)


def _velocity_kept(trajectory: Trajectory) -> float:
    """Velocity at the end over velocity at the start: −e for a ball that came back, 1 for one that was not noticed."""
    velocities = trajectory.velocity("ball")[:, 0]
    return float(velocities[-1] / velocities[0])


def _expect_velocity(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(-RESTITUTION, ROUNDING, "rounding only: an impact is all that changes a speed")
    share, turned = _shift(case, settings, method), 1 + RESTITUTION
    near = SHARE * RESTITUTION
    reason = "0.1 %: without weight or air an impact is all that changes a speed"
    return Expectation(-RESTITUTION, near, reason, turned * share, _why_through(method), 2 * turned / SHOTS + near)


def _place(trajectory: Trajectory) -> Array:
    return trajectory.position("ball")[:, 0]


THIN_WALL = Family(
    name="thin-wall",
    title="Fast ball against a thin wall",
    topic="detection",
    statements=(2, 9, 10),
    about=f"A weightless ball of {1000 * RADIUS:g} mm radius flies straight at a fixed wall, {1000 * THICKNESS:g} mm"
    f" thick. Every figure is the mean over {SHOTS} shots that meet the wall at evenly spread instants of a step.",
    expected="A solid wall stops every ball: none passes, and each comes back with `−e v`. A continuous test of the"
    " swept volume sees this; a test at the end of each step may not.",
    why=(
        "A step moves the ball by `v Δt`, and its centre is pushed back only if a step ends while the ball overlaps"
        " the wall and is still before its middle, on a way of `w/2 + r`. So the share `1 − (w/2 + r)/(v Δt)`"
        f" passes: at 20 m/s none up to a timestep of {1000 * CAUGHT / 20:g} ms, and 70 % at PyBullet's stock 1/240"
        " s. Only a smaller timestep or a continuous test helps.",
        "Hand-written code asks `overlap_interval`. Over the whole step, it finds the first instant at which the ball"
        " overlaps the wall, and no ball passes. At the ends of steps alone, it turns a ball back wherever it overlaps"
        " the wall, also behind the middle: on a way of `w + 2 r`, twice as long as an engine's.",
    ),
    cases=tuple(_case(speed) for speed in (5.0, 10.0, 20.0)),
    quantities=(
        Quantity("passed", "share that passes", "", _passed, _expect_passed),
        Quantity(
            "velocity_kept", "velocity after ÷ before", "", _velocity_kept, _expect_velocity, lambda case: RESTITUTION
        ),
    ),
    curve=Curve("v=20", "The first of the shots at 20 m/s", "distance behind the wall's middle, m", _place),
    convergence=Convergence("v=20", "passed", (10.0, 4.0, 2.0, 1.0)),
    grid=Grid(
        (Parameter("speed", "m/s", (5.0, 10.0, 20.0), 20.0),),
        (5e-4, 1e-3, 1 / 960, 1 / 720, 2e-3, 1 / 480, 1 / 240, 1 / 120, 1 / 60),
        _case,
    ),
    predict=passing.predict,
)

FAMILIES = (THIN_WALL,)
