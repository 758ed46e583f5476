"""Walkers on a circle, each of whom wants to get to the opposite side (slide 1)."""

from __future__ import annotations

import math

from reference import avoidance_truth as truth
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Family
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.walkers import (
    FORCE,
    INTERVAL,
    MARGIN,
    MAX_SPEED,
    arrived,
    avoiding,
    clearance,
    contacts,
    everybody,
    last_arrival,
    least_gap,
    left,
    overlap,
    speeding,
    walker,
)
from reference.engines import facts
from reference.prediction import steered
from reference.scene.scenario import Sphere

CIRCLE = 2.4
"""Radius of the circle on which everybody starts, m."""
RADII = 0.20, 0.24, 0.28, 0.22, 0.30, 0.26
"""Radii of the walkers, m, in the order in which they stand on the circle."""
ASIDE = 8.0
"""Everybody's goal lies so many degrees to the right of the opposite point."""
LONG, STRONG = 6.5, 1e6
"""How long is watched, s, and a force that limits nothing, N."""


def _on_a_circle(horizon: float) -> Case:
    name = f"τ={horizon:g}"
    angles = [2 * math.pi * place / len(RADII) + 0.13 * math.sin(3 * place) for place in range(len(RADII))]
    places = [(CIRCLE * math.cos(angle), CIRCLE * math.sin(angle)) for angle in angles]
    across = [angle + math.pi - math.radians(ASIDE) for angle in angles]
    goals = [(CIRCLE * math.cos(angle), CIRCLE * math.sin(angle), 0.0) for angle in across]
    both = zip(RADII, places, strict=True)
    bodies = tuple(walker(f"walker {number}", *told) for number, told in enumerate(both, 1))
    scenario = avoiding(f"antipodal-circle/{name}", bodies, goals, horizon, LONG)
    return Case(name, (scenario,), {"horizon": horizon, "head_on": 0.0})


def _head_on(horizon: float) -> Case:
    """Two of unequal size on one line, at rest; nothing says on which side to pass."""
    bodies = walker("small", 0.2, (-2.0, 0.0)), walker("large", 0.3, (2.6, 0.0))
    goals = (2.2, 0.0, 0.0), (-2.2, 0.0, 0.0)
    scenario = avoiding("antipodal-circle/head-on", bodies, goals, horizon, LONG, STRONG)
    return Case("head-on", (scenario,), {"horizon": horizon, "head_on": 1.0})


def _arrived(case: Case) -> float:
    return 0.0 if case.parameters["head_on"] else everybody(case)


def _left(case: Case) -> float:
    if not case.parameters["head_on"]:
        return 0.0
    (one, other), (rule,) = case.scenarios[0].bodies, case.scenarios[0].steering
    apart = math.dist(one.position, other.position)
    radii = sum(body.shape.radius for body in (one, other) if isinstance(body.shape, Sphere))
    ways = math.dist(one.position, rule.goals[0]), math.dist(other.position, rule.goals[1])
    return truth.left_where_two_meet(ways, apart - radii - 2 * MARGIN)


ANTIPODAL_CIRCLE = Family(
    name="antipodal-circle",
    title="Across a circle, and through each other's way",
    topic="avoidance",
    statements=(1,),
    about=f"Six walkers of unequal size and mass stand on a circle with a radius of {CIRCLE:g} m. Each wants to reach"
    f" the opposite side, {ASIDE:g}° to the right, at up to {MAX_SPEED:g} m/s. Every {1e3 * INTERVAL:g} ms the rule"
    " `crowd_step` (reciprocal avoidance, ORCA) says which velocity each walker should have, and a force of up to"
    f" {FORCE:g} N brings that velocity about. Each walker counts as {1e3 * MARGIN:g} mm larger than it is. The rule"
    " looks τ seconds ahead. One hand-written function steers the bodies of every implementation. In the case head-on"
    " two walkers approach each other on one line.",
    expected="Nobody touches anybody. That is checked with the positions, with the contacts that an implementation"
    " reports, and with its own answer for the two walkers that come nearest. Nobody exceeds the top speed, and"
    " everybody arrives. Theory does not say how near they come or when the last one arrives. The recurrence does: `v⁺"
    " = v + F Δt/m`, `x⁺ = x + v⁺ Δt`, where the same function gives the force. Two walkers that start from rest and"
    " meet exactly head-on stop in front of each other: each covers half of the gap, and nothing tells either of them"
    " on which side to pass.",
    why=(
        "No contact ever acts here. An engine therefore only has to integrate a force, and all four implementations do"
        " that by semi-implicit Euler. They agree with the recurrence, and with each other, to rounding. The least gap"
        f" is twice the margin, {2e3 * MARGIN:g} mm, because the rule lets two walkers pass as near as that.",
        f"{facts.PYBULLET_DAMPS} The rule notices this and makes up for it, but in each interval the walkers lose some"
        " speed again, so that the last of them arrives a little later than in the other implementations.",
        "The deadlock is a fault of the rule and not of an engine: in all four implementations the two walkers stop in"
        " the same places. A goal that lies a few degrees to the right is enough to avoid it. Their gap shrinks as"
        " `e^(−t/τ)`. At the end of the run they are 2.7 mm short of the place where they would meet, whatever the"
        " timestep.",
    ),
    cases=(_on_a_circle(1.0), _on_a_circle(0.3), _head_on(1.0)),
    quantities=(clearance(), overlap(), contacts(), arrived(_arrived), left(_left), last_arrival(), speeding()),
    curve=Curve("τ=1", "Six walkers across a circle", "least gap between any two, m", least_gap),
    convergence=Convergence("τ=1", "left"),
    grid=Grid((Parameter("horizon", "s", (0.3, 0.5, 1.0), 1.0),), (0.025,), _on_a_circle),
    predict=steered.predict,
)


FAMILIES = (ANTIPODAL_CIRCLE,)
