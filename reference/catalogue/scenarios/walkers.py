"""Walkers that steer themselves past each other: what the families of crowds share (slide 1)."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable

import numpy as np

from reference.arrays import Array
from reference.catalogue import crowd
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation, Quantity
from reference.checks import Vector
from reference.engines.base import Method
from reference.scene.scenario import Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.steering import Steering
from reference.scene.trajectory import Trajectory

MAX_SPEED = 1.2
"""Top speed of everybody, m/s: that of a person who walks."""
INTERVAL = 0.05
"""How often everybody looks around and decides, s: 12 steps of stock PyBullet, 25 of stock MuJoCo, 50 of stock DART."""
MARGIN = 0.04
"""By which everybody counts as larger than they are, m, so that two keep twice as much between them."""
FORCE = 150.0
"""Force of everybody's legs, N."""
SLOWING = 0.6
"""Distance from the goal within which one slows down, m: at least four times speed × interval, or one overshoots."""
ROUNDING = 1e-9
"""Accepted of an overlap, m, and of a speed, m/s, where there must be none."""
WEIGHTLESS = (0.0, 0.0, 0.0)
_AREA_DENSITY = 1000.0
"""Mass per squared radius of a body, kg/m²: 40 kg at 0.2 m."""


def walker(name: str, radius: float, position: tuple[float, float], velocity: tuple[float, float] = (0.0, 0.0)) -> Body:
    """A ball in the plane z = 0, heavier the larger it is."""
    mass = _AREA_DENSITY * radius**2
    return Body(name, Sphere(radius), mass, (*position, 0.0), velocity=(*velocity, 0.0))


def everybody(case: Case) -> float:
    """How many are steered."""
    return float(len(case.scenarios[0].steering[0].bodies))


def avoiding(
    name: str, bodies: tuple[Body, ...], goals: Iterable[Vector], horizon: float, duration: float, force: float = FORCE
) -> Scenario:
    """Walkers that avoid each other and want to get to their goals. Everybody may collide with everybody."""
    pairs = tuple(Pair(one.name, other.name) for one, other in itertools.combinations(bodies, 2))
    names, told = tuple(body.name for body in bodies), (("slowing_radius", SLOWING), ("horizon", horizon))
    rule = Steering("crowd_step", names, tuple(goals), MAX_SPEED, INTERVAL, force, margin=MARGIN, parameters=told)
    return Scenario(name, bodies, pairs, duration, WEIGHTLESS, steering=(rule,))


# What the families measure


def _expect_nothing(reason: str, near: float) -> Callable[[Case, Settings, Method], Expectation]:
    return lambda case, settings, method: Expectation(0.0, near, reason, size=1.0)


def clearance() -> Quantity:
    """The least gap between any two bodies, by the implementation's own answer."""
    return Quantity("clearance", "least gap", "m", crowd.clearance, None, asked=crowd.clearance_asked)


def contacts() -> Quantity:
    """How many contacts the implementation reports."""
    expect = _expect_nothing("a count: not one", 0.5)
    return Quantity("contacts", "contacts reported", "", crowd.contacts, expect)


def speeding() -> Quantity:
    """By how much the fastest one is too fast."""
    expect = _expect_nothing("rounding only: no rule asks for more than the top speed", ROUNDING)
    return Quantity("speeding", "excess speed", "m/s", crowd.speeding, expect)


def overlap(expected: Callable[[Case], float] = lambda case: 0.0) -> Quantity:
    """How deep two bodies overlap, by the positions."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        reason = "rounding only: who avoids others touches nobody, and who does not goes straight on"
        return Expectation(expected(case), ROUNDING, reason, size=1.0)

    return Quantity("overlap", "deepest overlap", "m", crowd.overlap, expect)


def arrived(expected: Callable[[Case], float] = everybody) -> Quantity:
    """How many are at their goals in the end."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        return Expectation(expected(case), 0.5, "a count: exactly so many", size=1.0)

    return Quantity("arrived", "at their goals", "", crowd.arrived, expect)


def left(expected: Callable[[Case], float] = lambda case: 0.0) -> Quantity:
    """How far the last one is from its goal in the end."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        reason = "5 cm, which counts as arrived: the end of the way is walked more and more slowly"
        return Expectation(expected(case), crowd.ARRIVED, reason, size=1.0)

    return Quantity("left", "farthest from its goal at the end", "m", crowd.farthest_left, expect)


def last_arrival() -> Quantity:
    """When everybody has arrived."""
    return Quantity(
        "arrival", "last arrival", "s", crowd.time_to_arrive, None, absent="does not bring all to their goals"
    )


def least_gap(trajectory: Trajectory) -> Array:
    """The least gap between any two bodies at each sample, m."""
    scenario, gaps = trajectory.scenario, []
    for one, other in itertools.combinations(scenario.bodies, 2):
        between = trajectory.position(one.name) - trajectory.position(other.name)
        radii = sum(body.shape.radius for body in (one, other) if isinstance(body.shape, Sphere))
        gaps.append(np.linalg.norm(between, axis=-1) - radii)
    return np.asarray(np.min(gaps, axis=0))
