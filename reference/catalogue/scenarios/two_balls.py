"""Two balls that strike each other, head-on and off-axis (slides 11 to 21)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines.base import AT_STEP, EXACT, Method
from reference.prediction import striking
from reference.scene.scenario import Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.125
"""Radius of every ball, m: a sum of such numbers has no rounding, so that balls touch which are meant to."""
REACH = 2 * RADIUS
"""Distance of two centres that touch, m."""
SPEED = 2.0
"""First speed of the ball that strikes another, m/s."""
STARTS = 11
"""Scenarios in an ensemble, a prime: their phases within a step are evenly spread for any timestep."""
GRID_STARTS = 3
"""The same for a point of the grid, of which there are many."""
FLIGHT, SPREAD = 0.14997, 0.1
"""Mean time until the impact, and what the times of an ensemble span, s. No flight is a whole number of 0.1, 0.2, 1, 2
or 5 ms or of 1/240 s: rounding would decide in which step the impact is noticed."""
AFTER = 0.05
"""How long is watched after the impact, s."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a speed, 0.1 %, and of one that nothing but rounding changes."""
WEIGHTLESS = (0.0, 0.0, 0.0)


def _striking(restitution: float, mass: float, offset: float, starts: int = STARTS) -> Case:
    name = f"e={restitution:g},m={mass:g},b={offset:g}" + (f",starts={starts}" if starts != STARTS else "")
    target = Body("target", Sphere(RADIUS), mass)
    touches = -REACH * math.sqrt(1 - offset**2)
    times = [FLIGHT + SPREAD * (start - starts // 2) / starts for start in range(starts)]
    scenarios = []
    for time in sorted(times, key=lambda time: abs(time - FLIGHT)):
        position = (touches - SPEED * time, offset * REACH, 0.0)
        striker = Body("striker", Sphere(RADIUS), 1.0, position, velocity=(SPEED, 0.0, 0.0))
        pair = Pair("striker", "target", restitution)
        scenarios.append(Scenario(f"two-balls/{name}", (target, striker), (pair,), time + AFTER, WEIGHTLESS))
    return Case(name, tuple(scenarios), {"restitution": restitution, "mass": mass, "offset": offset})


Velocities = tuple[Array, Array]
Number = Callable[[Velocities, float], float]
"""Velocities of the striker and the target after the impact, (2,) each, m/s, and the target's mass → a number."""


def _speed_of(which: int) -> Number:
    return lambda velocities, mass: float(np.linalg.norm(velocities[which]))


def _way(velocities: Velocities, mass: float) -> float:
    """Angle between the target's way and the striker's line of flight, rad."""
    return math.atan2(-velocities[1][1], velocities[1][0])


def _corner(velocities: Velocities, mass: float) -> float:
    """v_A·v_B ÷ v²: 0 for two ways at a right angle."""
    return float(velocities[0] @ velocities[1]) / SPEED**2


def _energy(velocities: Velocities, mass: float) -> float:
    """Energy after the impact ÷ energy before."""
    return float(velocities[0] @ velocities[0] + mass * velocities[1] @ velocities[1]) / SPEED**2


def _theory(case: Case, offset: float) -> Velocities:
    return truth.balls_after(SPEED, offset, case.parameters["restitution"], 1.0, case.parameters["mass"])


def _seen(trajectory: Trajectory) -> Velocities:
    return trajectory.velocity("striker")[-1, :2], trajectory.velocity("target")[-1, :2]


def _expect(number: Number, size: Callable[[Case], float]) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect what theory says, within 0.1 % of a size.

    A step method sees the impact up to a step late: the balls overlap by up to d = v cos α dt, and their line of
    centres stands at sin α = b/(1 − d/D).
    """

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        offset, mass, large = case.parameters["offset"], case.parameters["mass"], size(case)
        exact = number(_theory(case, offset), mass)
        if method.kind == EXACT:
            reason = "rounding only: the balls are met where they touch"
            return Expectation(exact, ROUNDING * large, reason, size=large)
        near, shift = SHARE * large, 0.0
        if method.kind == AT_STEP:
            deepest = SPEED * math.sqrt(1 - offset**2) * settings.timestep
            leaning = min(1.0, offset / (1 - deepest / REACH))
            shift = (number(_theory(case, leaning), mass) - exact) / 2
        why = "the line of centres has turned while the balls overlap"
        return Expectation(exact, near, "0.1 %", shift, why, abs(shift) + near, large)

    return expect


def _quantity(name: str, title: str, unit: str, number: Number, size: Callable[[Case], float]) -> Quantity:
    return Quantity(
        name,
        title,
        unit,
        lambda trajectory: number(_seen(trajectory), trajectory.scenario.body("target").mass),
        _expect(number, size),
        size if unit == "m/s" else None,
        share_of="the energy before" if name == "energy" else "",
    )


def _speed(case: Case) -> float:
    return SPEED


def _speed_of_the_target(case: Case) -> float:
    """What a target of any mass gets: one of 10⁶ kg has some 10⁻⁶ m/s."""
    return _speed_of(1)(_theory(case, case.parameters["offset"]), case.parameters["mass"])


def _one(case: Case) -> float:
    return 1.0


def _gap(trajectory: Trajectory) -> Array:
    between = trajectory.position("striker") - trajectory.position("target")
    return np.asarray(np.linalg.norm(between, axis=1) - REACH)


TWO_BALLS = Family(
    name="two-balls",
    title="Two balls, head-on and off-axis",
    topic="impulse",
    statements=(11, 12, 15, 16, 18, 20, 21),
    about=f"A smooth ball of 1 kg flies without weight at {SPEED:g} m/s past or into another one at rest, of mass m,"
    f" b times the sum of their radii beside its centre. Every figure is the mean over {STARTS} starts whose impacts"
    " come at evenly spread phases of a step.",
    expected="The impulse acts along the line of centres alone: `j = (1 + e) v cos α/(1/m_A + 1/m_B)` with `sin α ="
    " b`. Equal elastic balls swap what they have along it: head-on the striker stops, and off-axis the two"
    " part at a right angle, `v·w = 0`.",
    why=(
        "Head-on, an engine's only error is that of its contact. Off-axis, a step method sees the impact up to a step"
        " late: the balls overlap, and their line of centres has turned, for `sin α = b/(1 − d/D)` at a depth `d`. The"
        " struck ball goes too far aside, in PyBullet and in hand-written code at the step alike.",
        "A target 10⁶ times as heavy as the striker is no trouble: with two bodies and one contact, a solver has"
        " nothing to iterate.",
        "In the spring profiles the contact takes 3 ms, in which the balls slide around each other, and the struck one"
        " goes farther aside.",
    ),
    cases=(
        *(_striking(1.0, 1.0, offset) for offset in (0.0, 0.3, 0.5, 0.8)),
        *(_striking(0.5, 1.0, offset) for offset in (0.0, 0.5)),
        _striking(0.0, 1.0, 0.5),
        _striking(0.8, 3.0, 0.5),
        _striking(1.0, 1 / 3, 0.0),
        _striking(1.0, 1e6, 0.5),
    ),
    quantities=(
        _quantity("striker", "striker", "m/s", _speed_of(0), _speed),
        _quantity("target", "struck ball", "m/s", _speed_of(1), _speed_of_the_target),
        _quantity("way", "direction", "rad", _way, _one),
        _quantity("corner", "v·w ÷ v₀²", "", _corner, _one),
        _quantity("energy", "energy", "", _energy, _one),
    ),
    curve=Curve("e=1,m=1,b=0.5", "Off-axis at e = 1", "gap between the balls, m", _gap),
    convergence=Convergence("e=1,m=1,b=0.5", "way"),
    grid=Grid(
        (
            Parameter("restitution", "", (0.0, 0.3, 0.5, 0.8, 1.0), 1.0),
            Parameter("mass", "kg", (1 / 3, 1.0, 3.0, 1e6), 1.0, in_ratio=True),
            Parameter("offset", "", (0.0, 0.5, 0.8), 0.5),
        ),
        (1e-3, 2e-3, 5e-3),
        lambda restitution, mass, offset: _striking(restitution, mass, offset, GRID_STARTS),
    ),
    predict=striking.predict,
)


FAMILIES = (TWO_BALLS,)
