"""Two groups of walkers that cross each other at an angle (slide 1)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from reference import avoidance_truth as truth
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Family
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.walkers import (
    FORCE,
    INTERVAL,
    MAX_SPEED,
    SLOWING,
    WEIGHTLESS,
    arrived,
    avoiding,
    clearance,
    contacts,
    last_arrival,
    least_gap,
    left,
    overlap,
    speeding,
    walker,
)
from reference.checks import Vector
from reference.engines import facts
from reference.prediction import steered
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.steering import Steering

ANGLE = 70.0
"""Angle between the ways of the two streams, degrees."""
WAY, LONG = 5.0, 7.0
"""Length of everybody's way, m, and how long is watched, s."""
HORIZON = 1.0
"""For how long everybody excludes collisions, s."""
FIRST = (0.22, -2.6, 0.33), (0.28, -2.5, -0.38), (0.25, -3.4, 0.05), (0.20, -3.3, -0.75)
SECOND = (0.26, -2.45, -0.31), (0.21, -2.7, 0.42), (0.24, -3.35, 0.1), (0.29, -3.5, -0.62)
"""Radius and place of those in each stream, m: along their way, and to the left of it."""


def _stream(name: str, members: tuple[tuple[float, float, float], ...], angle: float) -> Iterator[tuple[Body, Vector]]:
    """The walkers of a stream whose way has this angle, degrees, from the x axis, each with its goal."""
    x, y = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    for place, (radius, along, aside) in enumerate(members, 1):
        start = along * x - aside * y, along * y + aside * x
        body = walker(f"{name} {place}", radius, start, (MAX_SPEED * x, MAX_SPEED * y))
        yield body, (start[0] + WAY * x, start[1] + WAY * y, 0.0)


def _streams(angle: float, straight_on: bool = False) -> Case:
    name = f"θ={angle:g}°" + (",straight on" if straight_on else "")
    both = *_stream("first", FIRST, 0.0), *_stream("second", SECOND, angle)
    bodies, goals = tuple(body for body, _ in both), tuple(goal for _, goal in both)
    scenario = avoiding(f"crossing-streams/{name}", bodies, goals, HORIZON, LONG)
    if straight_on:
        names, told = tuple(body.name for body in bodies), (("slowing_radius", SLOWING),)
        rule = Steering("arrive", names, goals, MAX_SPEED, INTERVAL, FORCE, parameters=told)
        # Without pairs: otherwise they would hold up each other.
        scenario = Scenario(scenario.name, bodies, (), LONG, WEIGHTLESS, steering=(rule,))
    return Case(name, (scenario,), {"angle": angle, "straight_on": float(straight_on)})


def _overlap(case: Case) -> float:
    if not case.parameters["straight_on"]:
        return 0.0
    bodies = case.scenarios[0].bodies
    radii = [body.shape.radius for body in bodies if isinstance(body.shape, Sphere)]
    places, speeds = [body.position for body in bodies], [body.velocity for body in bodies]
    return max(0.0, -truth.least_gap_of_straight_ways(places, speeds, radii))


CROSSING_STREAMS = Family(
    name="crossing-streams",
    title="Two streams that cross",
    topic="avoidance",
    statements=(1,),
    about="Two groups of four walkers, of unequal size and mass, cross at an angle θ. All of them start at"
    f" {MAX_SPEED:g} m/s and want to go {WAY:g} m straight ahead. The rule `crowd_step` steers them with a force of up"
    f" to {FORCE:g} N, as it does on the circle. In the case straight on, the rule is `arrive`, which pays no attention"
    " to others, and the bodies may pass through each other.",
    expected="With avoidance nobody touches anybody, everybody arrives, and nobody exceeds the top speed. Straight on,"
    " two walkers at constant velocities are nearest at `t = −x·u/u²`, where the gap between them is"
    " `√(x² − (x·u)²/u²) − r_A − r_B`. It is negative for walkers that overlap. The deepest overlap of all pairs is"
    " what must be measured, and also what the implementation's own distance query must answer.",
    why=(
        "No contact ever acts here, and all implementations integrate a force by semi-implicit Euler. They agree with"
        " the recurrence to rounding. So do their distance queries with the formula, also in overlap.",
        "Letting the other stream pass takes time: at 70° the last walker arrives 1.6 s later than without avoidance.",
        f"{facts.PYBULLET_DAMPS} The walkers come to the crossing later there and pass it in another order: at 70° the"
        " last one arrives earlier than in the other implementations, at 115° later.",
    ),
    cases=(_streams(ANGLE), _streams(115.0), _streams(ANGLE, straight_on=True)),
    quantities=(clearance(), overlap(_overlap), contacts(), arrived(), left(), last_arrival(), speeding()),
    curve=Curve(f"θ={ANGLE:g}°", "Two streams at 70°", "least gap between any two, m", least_gap),
    convergence=Convergence(f"θ={ANGLE:g}°", "left"),
    grid=Grid((Parameter("angle", "°", (50.0, 70.0, 90.0, 115.0), ANGLE),), (0.025,), _streams),
    predict=steered.predict,
)


FAMILIES = (CROSSING_STREAMS,)
