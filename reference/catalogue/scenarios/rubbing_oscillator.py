"""A slab that swings on a spring and rubs on the floor until it sticks (slides 23 and 24)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from reference import friction_truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.friction import slab_on_plane
from reference.catalogue.scenarios.tolerances import ROUNDING, within_a_millimetre
from reference.checks import Vector
from reference.engines import facts
from reference.engines.base import EXACT, MUJOCO_ONE_STEP, Method
from reference.errors import RunFailed
from reference.prediction import sliding
from reference.prediction.predicted import Prediction
from reference.scene.forces import Spring
from reference.scene.scenario import GRAVITY, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

MASS, REST_LENGTH = 1.5, 0.3
"""kg; m, of the spring, which never gets shorter than a third of that."""
WATCHED = 0.2
"""How long a slab that has stuck is watched, s."""
READ_AT = 0.02
"""The speed that tells swinging from what a slab that sticks may still do, m/s; at most half of the last swing's."""
SHARE = 0.01


@dataclass(frozen=True)
class _Swing:
    """The slab's start, its distance beyond the end of the spring at rest, m, and velocity, m/s; both along the line.

    stiffness: N/m. friction: the coefficient.
    """

    start: float
    velocity: float
    stiffness: float
    friction: float

    @property
    def frequency(self) -> float:
        """√(k/m), rad/s."""
        return math.sqrt(self.stiffness / MASS)

    @property
    def dead_band(self) -> float:
        """How far from the end of the spring friction still holds the slab, m."""
        return self.friction * MASS * GRAVITY / self.stiffness

    @property
    def slowest(self) -> float:
        """Largest speed of the last half swing, m/s."""
        before, end = (self.start, *self.turns()[1])[-2:]
        return self.frequency * abs(float(end) - float(before)) / 2

    def turns(self) -> tuple[Array, Array]:
        """Instants, s, and places, m, of all turning points after the start, the last of which is the end."""
        return friction_truth.turning_points(self.start, self.velocity, self.frequency, self.dead_band)


def _case(friction: float, stiffness: float, start: float, velocity: float = 0.0, degrees: float = 0.0) -> Case:
    thrown, turned = f",v={velocity:g}" if velocity else "", f",φ={degrees:g}°" if degrees else ""
    name = f"μ={friction:g},k={stiffness:g},x={start:g}{thrown}{turned}"
    swing = _Swing(start, velocity, stiffness, friction)
    duration = float(swing.turns()[0][-1]) + WATCHED
    scenario = slab_on_plane(f"friction-oscillator/{name}", friction, 0.0, velocity, duration, math.radians(degrees))
    height = scenario.body("slab").position[2]
    x, y = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    place: Vector = (start * x, start * y, height)
    bodies = tuple(body if body.immovable else replace(body, mass=MASS, position=place) for body in scenario.bodies)
    spring = Spring("slab", "", stiffness, REST_LENGTH, point_b=(-REST_LENGTH * x, -REST_LENGTH * y, height))
    scenario = replace(scenario, bodies=bodies, springs=(spring,))
    return Case(name, (scenario,), {"friction": friction, "stiffness": stiffness, "start": start, "speed": velocity})


def _swing_of(scenario: Scenario) -> _Swing:
    place, velocity, line = _along(scenario)
    spring = scenario.springs[0]
    return _Swing(float(place @ line), float(velocity @ line), spring.stiffness, scenario.pairs[0].kinetic_friction)


def _along(scenario: Scenario) -> tuple[Array, Array, Array]:
    """Place of the slab at the start, seen from the end of the spring at rest, its velocity, and the spring's line."""
    slab, spring = scenario.body("slab"), scenario.springs[0]
    anchor = np.array(spring.point_b)
    away = np.array(slab.position) - anchor
    line = away / np.linalg.norm(away)
    return away - spring.rest_length * line, np.array(slab.velocity), line


# What is measured


def _course(trajectory: Trajectory) -> tuple[Array, Array]:
    """Displacement from the end of the spring at rest, m, and velocity along the spring, m/s, at each sample."""
    _, _, line = _along(trajectory.scenario)
    spring = trajectory.scenario.springs[0]
    away = trajectory.position("slab") - np.array(spring.point_b)
    return away @ line - spring.rest_length, trajectory.velocity("slab") @ line


def _turn_after(trajectory: Trajectory, sample: int) -> tuple[float, float]:
    """Instant, s, and place, m, of the turning point that follows a sample in motion.

    Until then the slab swings about a point that friction has shifted, along an arc of x and v/ω about that point.
    """
    swing, (places, speeds) = _swing_of(trajectory.scenario), _course(trajectory)
    way = math.copysign(1.0, speeds[sample])
    ahead, rate = way * places[sample] + swing.dead_band, abs(float(speeds[sample])) / swing.frequency
    turn = way * (math.hypot(ahead, rate) - swing.dead_band)
    return float(trajectory.times[sample]) + math.atan2(rate, ahead) / swing.frequency, turn


def _first_turn(trajectory: Trajectory) -> tuple[float, float]:
    """Read a quarter of the first swing before its end, where speed and place are both far from zero."""
    times, _ = _swing_of(trajectory.scenario).turns()
    return _turn_after(trajectory, int(np.argmin(np.abs(trajectory.times - times[0] * 0.75))))


def _last_turn(trajectory: Trajectory) -> tuple[float, float]:
    """Read from the last sample in motion."""
    _, speeds = _course(trajectory)
    moving = np.flatnonzero(np.abs(speeds) > min(READ_AT, _swing_of(trajectory.scenario).slowest / 2))
    if len(moving) == 0:
        raise RunFailed("the slab never swings")
    return _turn_after(trajectory, int(moving[-1]))


# What is expected


def _truth(case: Case) -> tuple[Array, Array]:
    return _swing_of(case.scenarios[0]).turns()


def _near(exact: float, size: float, method: Method, reason: str) -> Expectation:
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * size, "rounding only: the swing is solved for", size=size)
    return Expectation(exact, SHARE * size, reason, size=size)


def _is_a_tie(scenario: Scenario, settings: Settings, method: Method) -> bool:
    """Whether the last half swing is slower than what friction takes in a step: what a solver leaves decides on it."""
    swing = _swing_of(scenario)
    return method.kind != EXACT and swing.slowest < swing.friction * GRAVITY * settings.timestep


def _predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    return None if _is_a_tie(scenario, settings, method) else sliding.predict(scenario, settings, method)


def _expect_last_instant(case: Case, settings: Settings, method: Method) -> Expectation | None:
    return None if _is_a_tie(case.scenarios[0], settings, method) else _expect_instant(case, method, -1)


def _expect_instant(case: Case, method: Method, which: int) -> Expectation:
    exact = float(_truth(case)[0][which])
    return _near(exact, exact, method, "1 %: each half swing may be some steps longer or shorter")


def _expect_place(case: Case, method: Method, which: int) -> Expectation:
    _, places = _truth(case)
    reason = "1 % of the distance of the first turning point"
    return _near(float(places[which]), abs(float(places[0])), method, reason)


def _slack_of_the_end(case: Case, settings: Settings, method: Method) -> float:
    """How much later the last turning point seems, s, where the speed that it is read from is too large.

    In MuJoCo the slab rocks under friction, and now and then stands on two corners alone. In such a step it gets none
    of the friction, and its speed is μ g dt larger for as long. Spring and friction, which end the swing, take as long
    as that over their deceleration for it; that is least at the end, where the spring pulls back no more or ahead.
    """
    if method.rule != MUJOCO_ONE_STEP:
        return 0.0
    swing, (_, places) = _swing_of(case.scenarios[0]), _truth(case)
    way = float(np.sign(np.diff([swing.start, *places])[-1]))
    deceleration = swing.frequency**2 * (way * float(places[-1]) + swing.dead_band)
    return float(swing.friction * GRAVITY * settings.timestep / deceleration)


def _reach(case: Case) -> float:
    return abs(float(_truth(case)[1][0]))


FRICTION_OSCILLATOR = Family(
    name="friction-oscillator",
    title="Slab on a spring that rubs on the floor",
    topic="friction",
    statements=(24, 23),
    about=f"A slab of {MASS:g} kg swings on a spring over a level floor, along an axis or at 30° to the axes. Friction"
    " brakes it until it sticks.",
    expected="Friction is constant on each half swing and shifts its centre by `f = μ m g/k`. So a half swing takes `π"
    " √(m/k)`, as without friction, and each turning point is nearer by `2 f` than the one before it. The slab sticks"
    " at the first turning point whose distance from the place where the spring is at rest is at most `f`.",
    why=(
        "Each implementation uses the spring's force at the start of every step. With this force semi-implicit Euler"
        " is right about the frequency to second order in `ω dt`.",
        "At a turning point the hand-written method `step` stops the slab for a whole step, because friction may not"
        " turn the slab back. The engines end the slip within a step and continue. So the method `step` is about one"
        " step later at the end.",
        f"{facts.MUJOCO_CREEPS} Here the slab creeps towards the place where the spring is at rest, and never stops."
        " In the case at 30° the friction cones of stock MuJoCo and stock DART push the slab off its line.",
    ),
    cases=(
        _case(0.5, 300.0, 0.15),
        _case(0.3, 300.0, -0.1),
        _case(0.4, 240.0, 0.05, velocity=0.9, degrees=30.0),
    ),
    quantities=(
        Quantity(
            "first_turn",
            "first turning point",
            "m",
            lambda trajectory: _first_turn(trajectory)[1],
            lambda case, settings, method: _expect_place(case, method, 0),
            _reach,
        ),
        Quantity(
            "first_instant",
            "its instant",
            "s",
            lambda trajectory: _first_turn(trajectory)[0],
            lambda case, settings, method: _expect_instant(case, method, 0),
            lambda case: float(_truth(case)[0][0]),
        ),
        Quantity(
            "last_instant",
            "instant at which it sticks",
            "s",
            lambda trajectory: _last_turn(trajectory)[0],
            _expect_last_instant,
            lambda case: float(_truth(case)[0][-1]),
            _slack_of_the_end,
            absent="never swings",
        ),
        Quantity(
            "end",
            "where it sticks",
            "m",
            lambda trajectory: float(_course(trajectory)[0][-1]),
            lambda case, settings, method: _expect_place(case, method, -1),
            _reach,
        ),
        Quantity(
            "creep",
            f"creep in the last {WATCHED / 2:g} s",
            "m",
            lambda trajectory: measure.drift(trajectory, "slab", WATCHED / 2),
            within_a_millimetre,
        ),
    ),
    curve=Curve("μ=0.5,k=300,x=0.15", "Swinging at μ = 0.5", "displacement, m", lambda run: _course(run)[0]),
    convergence=Convergence("μ=0.5,k=300,x=0.15", "last_instant"),
    grid=Grid(
        (
            Parameter("friction", "", (0.2, 0.3, 0.5), 0.3),
            Parameter("stiffness", "N/m", (200.0, 300.0, 400.0), 300.0),
        ),
        (1e-3, 2e-3),
        lambda friction, stiffness: _case(friction, stiffness, 0.15),
    ),
    predict=_predict,
)

FAMILIES = (FRICTION_OSCILLATOR,)
