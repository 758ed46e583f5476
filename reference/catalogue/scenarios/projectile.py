"""A ball thrown obliquely, which meets nothing: its range and its apex (slide 25)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference import forces_truth
from reference.arrays import Array
from reference.catalogue import throws
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.engines import facts
from reference.engines.base import BULLET_DAMPED, EXACT, Method
from reference.prediction import loaded
from reference.scene.forces import Force
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

SPEED = 12.0
"""Of the throws of the report, m/s."""
MASS, AZIMUTH = 0.8, math.radians(25)
"""Mass of the ball, kg, and the direction of the throw, from the x axis, rad: no number lies along an axis."""
PUSH = (2.0, -3.0, 1.5)
"""A steady force, N: it carries the ball on, aside and up."""
AFTER = 0.05
"""How long is watched after the ball is back, s."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a number, 0.1 %, and of one that nothing but rounding changes."""
AHEAD = np.array([math.cos(AZIMUTH), math.sin(AZIMUTH), 0.0])
ASIDE = np.array([-math.sin(AZIMUTH), math.cos(AZIMUTH), 0.0])


def _thrown(speed: float, angle: float, pushed: bool = False) -> Case:
    name = f"v={speed:g},θ={angle:g}°" + (",pushed" if pushed else "")
    slope = math.radians(angle)
    velocity = speed * (math.cos(slope) * AHEAD + math.sin(slope) * np.array([0.0, 0.0, 1.0]))
    ball = Body(
        "ball", Sphere(0.1), MASS, (0.4, -0.3, 1.5), velocity=tuple(velocity), angular_velocity=(2.0, -1.0, 3.0)
    )
    forces = (Force("ball", PUSH),) if pushed else ()
    parameters = {"speed": speed, "angle": angle, "pushed": float(pushed)}
    duration = forces_truth.flight_time(velocity, _pull(parameters)) + AFTER
    return Case(name, (Scenario(f"projectile/{name}", (ball,), (), duration, forces=forces),), parameters)


def _pull(parameters: dict[str, float]) -> Array:
    return np.array([0.0, 0.0, -9.81]) + parameters["pushed"] * np.array(PUSH) / MASS


Theory = Callable[[Array, Array], tuple[float, float, float]]
"""Velocity of the launch and acceleration, (3,) each → a number, what semi-implicit Euler adds to it per second of
timestep, and what it adds per square of it."""


def _along(direction: Array) -> Theory:
    """How far the landing lies in a direction: a step method comes (1 − dt/T) times as far."""

    def theory(velocity: Array, pull: Array) -> tuple[float, float, float]:
        way = float(forces_truth.landing(velocity, pull) @ direction)
        return way, -way / forces_truth.flight_time(velocity, pull), 0.0

    return theory


def _apex(velocity: Array, pull: Array) -> tuple[float, float, float]:
    """With v + a dt/2 for v the apex is v²/(2g) − v dt/2 + g dt²/8."""
    return forces_truth.apex_height(velocity, pull), -velocity[2] / 2, -pull[2] / 8


def _apex_time(velocity: Array, pull: Array) -> tuple[float, float, float]:
    return forces_truth.apex_time(velocity, pull), -0.5, 0.0


def _of(case: Case, theory: Theory) -> tuple[float, float, float]:
    scenario = case.scenarios[0]
    return theory(np.array(scenario.body("ball").velocity), throws.acceleration(scenario, "ball"))


def _expect(theory: Theory, size: Callable[[Case], float]) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect what theory says within 0.1 % of a size; a step method flies as if it set out with v + a dt/2."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact, first, second = _of(case, theory)
        large = size(case)
        if method.kind == EXACT:
            return Expectation(exact, ROUNDING * large, "rounding only: the flight is solved", size=large)
        dt, why = settings.timestep, facts.PYBULLET_DAMPED if method.rule == BULLET_DAMPED else _LATE
        beyond = abs(second) * dt**2 + ROUNDING * large
        return Expectation(exact, SHARE * large, "0.1 %", first * dt, why, beyond, large)

    return expect


_LATE = "semi-implicit Euler flies as if it had set out with v − g dt/2"


def _quantity(
    name: str, title: str, unit: str, measure: Callable[[Trajectory], float], theory: Theory, size: Theory
) -> Quantity:
    def scale(case: Case) -> float:
        return _of(case, size)[0]

    return Quantity(name, title, unit, measure, _expect(theory, scale), scale if size is theory else None)


_RANGE = _along(AHEAD)
PROJECTILE = Family(
    name="projectile",
    title="Projectile: range and apex",
    topic="forces",
    statements=(23, 25, 30),
    about=f"A ball of {MASS:g} kg is thrown obliquely, not along any axis, and meets nothing. The run ends soon after"
    " it is back at the height of its launch. In one case a steady force carries it on, aside and up.",
    expected="Under a constant acceleration `a` the ball flies along a parabola. It is highest after `v sin θ/g`, at"
    " `(v sin θ)²/(2 g)`, and back after twice that time, at the range `v² sin 2θ/g`. The mass of the ball"
    " matters only where another force than its weight acts.",
    why=(
        "Semi-implicit Euler first adds `g dt` to the velocity and then moves with it. After n steps the ball has"
        " fallen `g n (n + 1) dt²/2`, which is `g t dt/2` too far. All positions lie on another parabola exactly, the"
        " one of a ball that sets out with `v − g dt/2`. So the apex comes `dt/2` too early and is `v sin θ dt/2` too"
        " low. The range is too short by the share `dt/T` of itself, where T is the time of flight.",
        "PyBullet, MuJoCo, DART and the hand-written world agree with this to rounding. They agree with each other,"
        " and all of them have the same error: agreement between engines does not show that they are right.",
        f"{facts.PYBULLET_DAMPS} The range of a fast ball is therefore much too short.",
    ),
    cases=(*(_thrown(SPEED, angle) for angle in (30.0, 45.0, 60.0, 75.0)), _thrown(SPEED, 60.0, True)),
    quantities=(
        _quantity(
            "range", "range", "m", lambda trajectory: float(throws.landing(trajectory, "ball") @ AHEAD), _RANGE, _RANGE
        ),
        _quantity(
            "aside",
            "way aside",
            "m",
            lambda trajectory: float(throws.landing(trajectory, "ball") @ ASIDE),
            _along(ASIDE),
            _RANGE,
        ),
        _quantity(
            "apex", "height of the apex", "m", lambda trajectory: throws.apex(trajectory, "ball")[1], _apex, _apex
        ),
        _quantity(
            "apex_time",
            "time of the apex",
            "s",
            lambda trajectory: throws.apex(trajectory, "ball")[0],
            _apex_time,
            _apex_time,
        ),
    ),
    curve=Curve(
        "v=12,θ=60°",
        "A throw at 12 m/s and 60°",
        "height above the launch, m",
        lambda trajectory: trajectory.position("ball")[:, 2] - trajectory.position("ball")[0, 2],
    ),
    convergence=Convergence("v=12,θ=60°", "range"),
    grid=Grid(
        (
            Parameter("speed", "m/s", (6.0, 9.0, 12.0), 12.0),
            Parameter("angle", "°", (15.0, 30.0, 45.0, 60.0, 75.0), 45.0),
        ),
        (1e-3, 5e-3, 2e-2),
        _thrown,
    ),
    predict=loaded.predict,
)

FAMILIES = (PROJECTILE,)
