"""One flier and a pillar between it and its goal: it steers around, or it is repelled (slide 1)."""

from __future__ import annotations

import math

import numpy as np

from reference import avoidance_truth as truth
from reference.arrays import Array
from reference.catalogue import crowd
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.scenarios.walkers import INTERVAL, MAX_SPEED, WEIGHTLESS, clearance, contacts, walker
from reference.engines import facts
from reference.engines.base import Method
from reference.engines.implementation import Implementation
from reference.prediction import steered
from reference.scene.scenario import Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.steering import Steering
from reference.scene.trajectory import Trajectory

RADIUS, PILLAR = 0.12, Body("pillar", Sphere(0.6), position=(0.8, 0.3, 0.0))
"""Radius of the flier, m, and what is in its way."""
MARGIN, LONG = 0.08, 7.0
"""Gap that a flier that steers keeps from the pillar, m, and how long is watched, s."""
START, GOAL = (-2.5, 0.15), (8.5, -0.4)
"""Where a flier that steers begins, and where it wants to go, m: farther than it gets."""
COURSE, BEFORE, BEHIND = math.radians(30.0), 3.4, 4.1
"""Direction of a flier that meets the pillar head-on, rad; how far it begins before the pillar's centre, and how far
behind it its goal is, m."""
STRENGTH, REACH, RESPONSE = 150.0, 0.8, 0.4
"""Of the field: its force at the surface, N, and its reach, m. Time in which the flier would turn to its goal, s."""
LATE = "damping slows the flier, or it decides too seldom"
"""Why a flier is not where it should be."""
NEAR, SLOW = 0.01, 0.005
"""Accepted of a length, m, and of a speed, m/s."""


def _flier(rule: str, start: tuple[float, float], ahead: tuple[float, float], goal: tuple[float, float]) -> Case:
    flier = walker("flier", RADIUS, start, (MAX_SPEED * ahead[0], MAX_SPEED * ahead[1]))
    field = (("strength", STRENGTH), ("reach", REACH), ("response_time", RESPONSE))
    steers = rule == "steer_around"
    told = Steering(
        rule, ("flier",), ((*goal, 0.0),), MAX_SPEED, INTERVAL, obstacles=("pillar",), margin=MARGIN if steers else 0.0,
        parameters=() if steers else field,
    )  # fmt: skip
    pair, name = Pair("flier", "pillar"), "steers" if steers else "repelled"
    scenario = Scenario(f"lone-flier/{name}", (PILLAR, flier), (pair,), LONG, WEIGHTLESS, steering=(told,))
    return Case(name, (scenario,), {"steers": float(steers)})


def _steers() -> Case:
    """It starts in the direction of the tangent, so that it need not turn before it gets there."""
    ahead, far = np.subtract(PILLAR.position[:2], START), _keeps()
    angle = math.atan2(ahead[1], ahead[0]) - math.asin(far / math.hypot(*ahead))
    return _flier("steer_around", START, (math.cos(angle), math.sin(angle)), GOAL)


def _repelled() -> Case:
    """Straight at the middle of the pillar, with the goal straight behind."""
    x, y = math.cos(COURSE), math.sin(COURSE)
    start, goal = ((PILLAR.position[0] + way * x, PILLAR.position[1] + way * y) for way in (-BEFORE, BEHIND))
    return _flier("repelling_force", start, (x, y), goal)


def _keeps() -> float:
    """From the pillar's centre to that of a flier that steers around it, m."""
    assert isinstance(PILLAR.shape, Sphere)
    return PILLAR.shape.radius + RADIUS + MARGIN


def _gap(case: Case) -> float:
    """The gap that is kept, or at which the field carries the pull to the goal, m."""
    if case.parameters["steers"]:
        return MARGIN
    flier = case.scenarios[0].body("flier")
    return truth.gap_of_balance(STRENGTH, REACH, flier.mass * MAX_SPEED / RESPONSE)


def _left(case: Case) -> float:
    if case.parameters["steers"]:
        way = truth.way_around((*START, 0.0), (*GOAL, 0.0), PILLAR.position, _keeps())
        return way - MAX_SPEED * LONG
    return BEHIND + _keeps() - MARGIN + _gap(case)


def _distance(trajectory: Trajectory) -> Array:
    """The gap to the pillar at each sample, m."""
    between = trajectory.position("flier") - PILLAR.position
    return np.asarray(np.linalg.norm(between, axis=-1) - _keeps() + MARGIN)


def _gap_kept(trajectory: Trajectory) -> float:
    """The least gap of a flier that steers, and the last one of a flier that waits, m."""
    steers = trajectory.scenario.steering[0].rule == "steer_around"
    return crowd.clearance(trajectory) if steers else float(_distance(trajectory)[-1])


def _speed(trajectory: Trajectory) -> float:
    return float(np.linalg.norm(trajectory.velocity("flier")[-1]))


def _why(method: Method) -> str:
    """Why a flier is not where it should be. Anyone who hands in a rule should look there first."""
    if method.steered_by is None or method.steered_by.source == Implementation.source:
        return LATE
    return f"the rule that steers it is not the lab's own; or {LATE}"


def _expect_gap(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(_gap(case), NEAR, "1 cm", shift_reason=_why(method))


def _expect_left(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(_left(case), NEAR, "1 cm", shift_reason=_why(method))


def _expect_speed(case: Case, settings: Settings, method: Method) -> Expectation:
    value = MAX_SPEED if case.parameters["steers"] else 0.0
    return Expectation(
        value, SLOW, "5 mm/s: a flier that is repelled comes to rest slowly", shift_reason=_why(method), size=MAX_SPEED
    )


LONE_FLIER = Family(
    name="lone-flier",
    title="Steer around a pillar, or be repelled by it",
    topic="avoidance",
    statements=(1,),
    about="A pillar stands between a flier and its goal. In the case steers, `steer_around` sends the flier to the"
    f" tangent point of a sphere that is {1e3 * MARGIN:g} mm larger than both together, and it always flies at"
    f" {MAX_SPEED:g} m/s. In the case repelled, a force m (v_wanted − v)/τ draws it to the goal, and the field of"
    " `repelling_force` pushes it off the pillar, which it meets exactly head-on.",
    expected="A flier that steers goes the shortest way, two tangents and the arc between them: `√(L² − r²)` for each"
    " tangent, and r times the angle that is left. At the end its length less v t is left of that way, and the least"
    " gap is the margin. The field has no lateral part for a flier that meets it head-on. That flier therefore waits"
    " in front of the pillar for ever, where `F₀(1 − s/R)²` balances the pull `m v/τ`.",
    why=(
        "The four implementations agree with the recurrence to rounding. The way of the flier that steers is 0.5 mm"
        " longer than the shortest one: it decides every 50 ms only, and so it flies a polygon around the sphere"
        " instead of an arc. Each side of the polygon touches the sphere, so that the least gap is the margin.",
        "The flier that is repelled first comes as near as 0.22 m, bounces back, and then waits at 0.37 m. No engine"
        " is at fault here, and a smaller timestep does not help: the field offers no way around the pillar.",
        f"{facts.PYBULLET_DAMPS} The flier that steers is slower there, and has farther to fly at the end. The flier"
        " that waits is where it should be, because at rest nothing is damped.",
    ),
    cases=(_steers(), _repelled()),
    quantities=(
        clearance(),
        Quantity("gap", "gap kept, or waited at", "m", _gap_kept, _expect_gap),
        contacts(),
        Quantity("left", "way left at the end", "m", crowd.farthest_left, _expect_left),
        Quantity("speed", "speed at the end", "m/s", _speed, _expect_speed),
    ),
    curve=Curve("repelled", "Head-on into a repelling field", "gap to the pillar, m", _distance),
    convergence=Convergence("repelled", "gap"),
    predict=steered.predict,
)


FAMILIES = (LONE_FLIER,)
