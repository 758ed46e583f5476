"""A slab whose static friction is larger than its kinetic one: it holds where it would slide on (slide 24)."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from reference import truth
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.scenarios.friction import slab_on_plane, way_of
from reference.engines.base import EXACT, Method
from reference.prediction import sliding
from reference.scene.forces import Force
from reference.scene.scenario import GRAVITY, Pair
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

STATIC, KINETIC = 0.5, 0.3
"""The coefficients: critical slopes are 26.6° and 16.7°, and on the level the limits are 4.905 N and 2.943 N."""
SET_OFF = 0.1
"""A small speed that tells sliding from rest, m/s."""
DURATION = 1.5
NEAR = 1e-9
"""Share of a way or a speed, or m and m/s where it is zero, that rounding may reach in some thousand steps."""
SHARE = 1e-3


def _slab(name: str, degrees: float = 0.0, speed: float = 0.0, force: float = 0.0) -> Case:
    """A slab of 1 kg on a slope of so many degrees, or on the level; speed and force point down the slope, along +x."""
    slope = math.radians(degrees)
    scenario = slab_on_plane(f"two-frictions/{name}", KINETIC, slope, speed, DURATION)
    pairs = (Pair("slab", "plane", kinetic_friction=KINETIC, static_friction=STATIC),)
    forces = (Force("slab", (force, 0.0, 0.0)),) if force else ()
    return Case(
        name, (replace(scenario, pairs=pairs, forces=forces),), {"slope": slope, "speed": speed, "force": force}
    )


class _Motion(NamedTuple):
    """How a slab moves, down the slope: its acceleration, m/s², until it stops (s, ∞ if it does not); way and speed."""

    acceleration: float
    stop: float
    way: float
    speed: float


def _motion(case: Case) -> _Motion:
    """The closed form. At rest a pull up to μ_s N is held; what moves has μ_k N against it, until it stops.

    Of the cases that stop, each has a pull that static friction holds.
    """
    slope, v = case.parameters["slope"], case.parameters["speed"]
    pull = GRAVITY * math.sin(slope) + case.parameters["force"]  # of 1 kg, and a force pushes on the level alone
    pressed = GRAVITY * math.cos(slope)
    if v == 0 and pull <= STATIC * pressed:
        return _Motion(0.0, 0.0, 0.0, 0.0)
    a = pull - math.copysign(KINETIC * pressed, v)  # from rest a slab sets out along the pull, +x as +0.0
    if a * v < 0 and -v / a < DURATION:
        return _Motion(a, -v / a, abs(v * v / (2 * a)), 0.0)
    return _Motion(a, math.inf, v * DURATION + a * DURATION**2 / 2, v + a * DURATION)


def _true_way(case: Case) -> float:
    return _motion(case).way


def _true_speed(case: Case) -> float:
    return _motion(case).speed


def _expect_way(case: Case, settings: Settings, method: Method) -> Expectation:
    a, stop, way, _ = _motion(case)
    if method.kind == EXACT or way == 0:
        return Expectation(
            way, NEAR * (way or 1.0), "rounding only: what holds does not move, and a stop is solved for"
        )
    if stop < math.inf:
        shift = truth.semi_implicit_stopping_shift(abs(case.parameters["speed"]), settings.timestep)
        why = "−v₀ dt/2: a step moves with the velocity that friction has already reduced"
    else:
        shift = truth.semi_implicit_sliding_shift(a, settings.timestep, DURATION)
        why = "+a t dt/2: a step moves with the velocity that it has just gained"
    return Expectation(way, SHARE * way, "0.1 % of the way", shift, why, SHARE * way)


def _expect_speed(case: Case, settings: Settings, method: Method) -> Expectation:
    speed = _true_speed(case)
    return Expectation(speed, NEAR * (speed or 1.0), "rounding only: friction is the same in every step of the way")


def _end_speed(trajectory: Trajectory) -> float:
    return float(np.linalg.norm(measure.at_end(trajectory, "slab")[1]))


def _way(trajectory: Trajectory) -> float:
    return measure.displacement(trajectory, "slab")


TWO_FRICTIONS = Family(
    name="two-frictions",
    title="Static and kinetic friction that differ",
    topic="friction",
    statements=(24,),
    about=f"A slab of 1 kg has a static coefficient of friction of {STATIC:g} and a kinetic one of {KINETIC:g}. It is"
    " let go, set off or pushed on slopes and on the level, where static friction would hold it and kinetic friction"
    " would not, and beyond.",
    expected="A slab at rest stays at rest while the pull along the plane is at most `μ_s N`. Once it moves, `μ_k N`"
    " acts against it, however small its speed: between the two limits it holds at rest, and speeds up if"
    " it has been set off.",
    why=(
        "Exact hand-written code has both coefficients; stepped, it has the shifts of every slide, `v₀ dt/2` and `a"
        " t dt/2`. The engines have one coefficient for a pair, and none of their other settings holds more at rest"
        " than in motion.",
    ),
    cases=(
        *(_slab(f"θ={degrees:g}°", degrees) for degrees in (18.0, 22.0, 26.0, 28.0)),
        *(_slab(f"θ={degrees:g}°,v={SET_OFF:g}", degrees, SET_OFF) for degrees in (18.0, 22.0, 26.0)),
        _slab("θ=22°,v=-2", 22.0, -2.0),
        *(_slab(f"F={force:g}", force=force) for force in (3.0, 4.0, 4.8, 5.0)),
        *(_slab(f"F={force:g},v={SET_OFF:g}", speed=SET_OFF, force=force) for force in (2.5, 3.0, 4.0, 4.8)),
        *(_slab(f"v={speed:g}", speed=speed) for speed in (1.0, 3.0)),
    ),
    quantities=(
        Quantity("way", f"distance in {DURATION:g} s", "m", _way, _expect_way, _true_way),
        Quantity("speed", f"speed after {DURATION:g} s", "m/s", _end_speed, _expect_speed, _true_speed),
    ),
    curve=Curve("θ=22°,v=0.1", "Set off at 0.1 m/s on 22°", "distance, m", way_of),
    convergence=Convergence("θ=22°,v=0.1", "way"),
    predict=sliding.predict,
)

FAMILIES = (TWO_FRICTIONS,)
