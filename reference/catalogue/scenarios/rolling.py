"""Balls that begin to roll, on the level and on a slope (slide 24)."""

from __future__ import annotations

import math

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue import turning
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import TENTHS, Grid, Parameter
from reference.catalogue.scenarios.slopes import downhill_on, normal_of
from reference.catalogue.scenarios.tolerances import from_rest
from reference.engines.base import EXACT, Method
from reference.prediction import sliding
from reference.scene.scenario import GRAVITY, Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.1
"""Radius of the ball, m."""
WATCHED = 0.5
"""How long a ball is watched once it rolls, s."""
SLOPE_DURATION = 2.0
SHARE = 1e-3
"""Accepted share of a value: 0.1 %."""


def ball_on_plane(
    name: str,
    friction: float,
    slope: float,
    speed: float,
    duration: float,
    radius: float = RADIUS,
    mass: float = 1.0,
) -> Scenario:
    """A ball without spin that touches a plane. slope: rad, downhill towards +x. speed: m/s, downhill."""
    normal = normal_of(slope)
    ball = Body("ball", Sphere(radius), mass, tuple(radius * normal), velocity=tuple(speed * downhill_on(slope)))
    plane = Body("plane", HalfSpace(tuple(normal)))
    return Scenario(name, (plane, ball), (Pair("ball", "plane", kinetic_friction=friction),), duration)


def _sliding(friction: float, speed: float) -> Case:
    name = f"μ={friction:g},v={speed:g}"
    duration = truth.rolling_start(speed, friction, GRAVITY) + WATCHED
    scenario = ball_on_plane(f"sliding-ball/{name}", friction, 0.0, speed, duration)
    return Case(name, (scenario,), {"friction": friction, "speed": speed})


def _rolling_speed(case: Case) -> float:
    return truth.rolling_speed(case.parameters["speed"])


def _expect_speed(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _rolling_speed(case)
    return Expectation(exact, SHARE * exact, "0.1 %: friction keeps the angular momentum about the floor, step by step")


def _rolling_start(case: Case) -> float:
    return truth.rolling_start(case.parameters["speed"], case.parameters["friction"], GRAVITY)


def _expect_start(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _rolling_start(case)
    # Slip falls by 7/2 μ g, so what counts as none, 1 mm/s, is reached a share 1 mm/s ÷ v₀ too early: 0.1 % at 1 m/s.
    reason = "0.1 %: the slip falls along a straight line, and 1 mm/s of it counts as none"
    if method.kind == EXACT:
        return Expectation(exact, SHARE * exact, reason)
    return Expectation(exact, SHARE * exact + settings.timestep, f"{reason}; and a step in which the contact is made")


def _rolling_way(case: Case) -> float:
    duration = case.scenarios[0].duration
    return truth.rolling_way(case.parameters["speed"], case.parameters["friction"], GRAVITY, duration)


def _expect_way(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _rolling_way(case)
    if method.kind == EXACT:
        return Expectation(exact, SHARE * exact, "0.1 % of the way")
    shift = truth.semi_implicit_rolling_shift(case.parameters["speed"], settings.timestep)
    why = "−v₀ dt/7: a step moves with the velocity that friction has already reduced"
    within_a_step = case.parameters["friction"] * GRAVITY * settings.timestep**2
    return Expectation(exact, SHARE * exact, "0.1 % of the way", shift, why, within_a_step)


def _way(trajectory: Trajectory) -> float:
    """Way after the scenario's duration, m; the last sample may lie a little later."""
    end = turning.position_at(trajectory, "ball", trajectory.scenario.duration)
    return float(np.linalg.norm(end - trajectory.position("ball")[0]))


def _slips(trajectory: Trajectory) -> float:
    return float(turning.slip(trajectory, "ball", "plane")[-1])


def _expect_grip(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(0.0, turning.ROLLING_SLIP, "1 mm/s: what counts as rolling")


def _speeds(trajectory: Trajectory) -> Array:
    return np.asarray(np.linalg.norm(trajectory.velocity("ball"), axis=1))


SLIDING_BALL = Family(
    name="sliding-ball",
    title="Sliding ball that begins to roll",
    topic="friction",
    statements=(14, 15, 24),
    about="A ball is set down on a level floor with a speed and no spin. Friction slows it and makes it spin, until"
    " its lowest point stands still: it rolls.",
    expected="Friction acts at the floor and so cannot change the angular momentum about a point of the floor. The"
    " ball rolls with `5/7` of its first speed for any friction, from `t = 2 v₀/(7 μ g)` on.",
    why=(
        "The tuned engines find `5/7` to more digits than anyone needs, since a friction impulse changes speed and"
        " spin together. Their way is `v₀ dt/7` short: a step moves with the velocity that friction has already"
        " reduced.",
    ),
    cases=tuple(_sliding(friction, speed) for friction in (0.1, 0.3, 0.6) for speed in (1.0, 2.0, 5.0)),
    quantities=(
        Quantity(
            "rolling_speed",
            "speed when rolling",
            "m/s",
            lambda trajectory: turning.speed_along(trajectory, "ball", "plane"),
            _expect_speed,
            _rolling_speed,
        ),
        Quantity(
            "rolling_start",
            "begins to roll",
            "s",
            lambda trajectory: turning.rolling_time(trajectory, "ball", "plane"),
            _expect_start,
            _rolling_start,
            absent="never rolls",
        ),
        Quantity("way", "way", "m", _way, _expect_way, _rolling_way),
        Quantity("slip", "slip at the end", "m/s", _slips, _expect_grip),
    ),
    curve=Curve("μ=0.1,v=2", "Speed at μ = 0.1, v₀ = 2 m/s", "speed, m/s", _speeds),
    convergence=Convergence("μ=0.1,v=2", "way"),
    grid=Grid(
        (Parameter("friction", "", TENTHS[1:], 0.3), Parameter("speed", "m/s", (1.0, 2.0, 5.0), 2.0)),
        (1e-3, 2e-3, 5e-3),
        _sliding,
    ),
    predict=sliding.predict,
)


def _on_slope(friction: float, degrees: float) -> Case:
    name = f"μ={friction:g},θ={degrees:g}°"
    scenario = ball_on_plane(f"rolling-ball/{name}", friction, math.radians(degrees), 0.0, SLOPE_DURATION)
    return Case(name, (scenario,), {"friction": friction, "slope": math.radians(degrees)})


def _acceleration(case: Case) -> float:
    return truth.rolling_acceleration(case.parameters["friction"], case.parameters["slope"], GRAVITY)


def _way_down(case: Case) -> float:
    return _acceleration(case) * SLOPE_DURATION**2 / 2


def _expect_way_down(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = _way_down(case)
    if method.kind == EXACT:
        return Expectation(exact, SHARE * exact, "0.1 % of the way")
    return from_rest(_acceleration(case), SLOPE_DURATION, settings, SHARE, "0.1 % of the way")


def _ratio(trajectory: Trajectory) -> float:
    return turning.surface_speed(trajectory, "ball") / turning.speed_along(trajectory, "ball", "plane")


def _true_ratio(case: Case) -> float:
    return truth.rolling_ratio(case.parameters["friction"], case.parameters["slope"], GRAVITY)


def _expect_ratio(case: Case, settings: Settings, method: Method) -> Expectation:
    return Expectation(_true_ratio(case), SHARE * _true_ratio(case), "0.1 %: speed and spin grow in the same steps")


ROLLING_BALL = Family(
    name="rolling-ball",
    title="Ball on a slope: rolling or slipping",
    topic="friction",
    statements=(14, 15, 24),
    about=f"A ball is let go on a slope, for three coefficients of friction and five angles, and watched for"
    f" {SLOPE_DURATION:g} s.",
    expected="Rolling takes a friction of `2/7 m g sin θ`, so the ball rolls while `tan θ ≤ 7 μ/2`, with `5/7 g sin"
    " θ`. Beyond that it slips, with `g (sin θ − μ cos θ)`, and its spin falls behind.",
    why=(
        "The tuned engines roll and slip where theory says, even at 20° and μ = 0.1, where `tan θ` is 4 % above `7"
        " μ/2`. The way is `a t dt/2` long, as for every body that sets out from rest in a step method.",
    ),
    cases=tuple(
        _on_slope(friction, degrees) for friction in (0.1, 0.3, 0.6) for degrees in (5.0, 10.0, 20.0, 30.0, 40.0)
    ),
    quantities=(
        Quantity("way", f"way in {SLOPE_DURATION:g} s", "m", _way, _expect_way_down, _way_down),
        Quantity("ratio", "r ω ÷ v", "", _ratio, _expect_ratio, _true_ratio),
    ),
    curve=Curve("μ=0.1,θ=30°", "Speed down 30° at μ = 0.1", "speed, m/s", _speeds),
    convergence=Convergence("μ=0.3,θ=20°", "way"),
    grid=Grid(
        (Parameter("friction", "", TENTHS[1:], 0.3), Parameter("angle", "°", (5.0, 10.0, 20.0, 30.0, 40.0), 20.0)),
        (1e-3, 2e-3, 5e-3),
        lambda friction, angle: _on_slope(friction, angle),
    ),
    predict=sliding.predict,
)


FAMILIES = (SLIDING_BALL, ROLLING_BALL)
