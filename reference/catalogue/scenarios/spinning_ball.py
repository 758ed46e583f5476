"""A spinning ball that strikes the floor: friction during an impact (slides 12 to 18, 24)."""

from __future__ import annotations

import math
from collections.abc import Callable

from reference import truth
from reference.catalogue import turning
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.bouncing_ball import FLOOR
from reference.engines.base import AT_STEP, EXACT, Method
from reference.prediction import striking
from reference.scene.scenario import GRAVITY, Body, Pair, Scenario, Sphere
from reference.scene.settings import Settings

RADIUS = 0.1
"""Radius of the ball, m."""
DROP_HEIGHT = 1.0
"""Gap below the ball at the start, m."""
AFTER = 0.1
"""How long is watched after the impact, s."""
SHARE, ROUNDING = 1e-3, 1e-9
"""Accepted share of a value, 0.1 %, and what rounding leaves, m/s."""


def _spinning(spin: float, friction: float, restitution: float) -> Case:
    name = f"ω={spin:g},μ={friction:g},e={restitution:g}"
    ball = Body("ball", Sphere(RADIUS), 1.0, (0.0, 0.0, RADIUS + DROP_HEIGHT), angular_velocity=(0.0, spin, 0.0))
    pair = Pair("ball", "floor", restitution, friction)
    duration = truth.fall_time(DROP_HEIGHT, GRAVITY) + AFTER
    scenario = Scenario(f"spinning-ball/{name}", (FLOOR, ball), (pair,), duration)
    return Case(name, (scenario,), {"spin": spin, "friction": friction, "restitution": restitution})


def _after(case: Case) -> tuple[float, float]:
    """Speed along the floor and surface speed after the impact, m/s."""
    speed, spin = truth.impact_speed(DROP_HEIGHT, GRAVITY), case.parameters["spin"]
    return truth.spinning_impact(speed, RADIUS * spin, case.parameters["restitution"], case.parameters["friction"])


def _speed_along(case: Case) -> float:
    return _after(case)[0]


def _surface_speed(case: Case) -> float:
    return _after(case)[1]


def _surface_speed_lost(case: Case) -> float:
    return RADIUS * case.parameters["spin"] - _surface_speed(case)


def _grips(case: Case) -> bool:
    """Whether friction ends the slip during the impact."""
    return math.isclose(_speed_along(case), 2 / 7 * RADIUS * case.parameters["spin"])


def _expect(
    after: Callable[[Case], float], changed: Callable[[Case], float]
) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect a speed after the impact. after: case → that speed. changed: what friction changes of it, m/s."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        exact = after(case)
        if method.kind == EXACT:
            return Expectation(exact, ROUNDING, "rounding only: an impact is all that changes speed and spin")
        near = SHARE * exact
        if _grips(case) or method.kind != AT_STEP:
            return Expectation(exact, near, "0.1 %", shift_reason=_WHY[_grips(case)])
        # What slips through gets μ times the normal impulse per mass, (1 + e) v. A step's impulse carries its weight
        # as well, and its v differs by up to g dt/2.
        kept, speed = 1 + case.parameters["restitution"], truth.impact_speed(DROP_HEIGHT, GRAVITY)
        step = changed(case) * GRAVITY * settings.timestep / speed
        return Expectation(exact, near, "0.1 %", step / kept, _WHY[False], near + step / 2)

    return expect


_WHY = {
    True: "the contact point lies inside the ball, which shortens the lever arm of friction; or friction is too gentle",
    False: "friction of what a step adds to the impact: its weight, and up to g dt/2 of speed",
}
"""Why a speed is away from theory: of a ball that grips, and of one that slips through."""

SPINNING_BALL = Family(
    name="spinning-ball",
    title="Spinning ball that strikes the floor",
    topic="impulse",
    statements=(12, 14, 16, 18, 24),
    about=f"A ball falls {DROP_HEIGHT:g} m, spinning about a level axis, and is watched until just after its rebound.",
    expected="The impulse of friction is at most `μ m (1 + e) v`. If that ends the slip, the ball leaves with `2/7`"
    " of its surface speed `r ω` along the floor, and spins with `2/7` of its spin. If not, it slips"
    " through the whole impact and leaves with `μ (1 + e) v`.",
    why=(
        "A ball that grips takes `2/7` of its surface speed in an impact of any strength. One that slips through is"
        " pushed by `μ` times the normal impulse, and a step's impulse also carries the weight of the step: `g"
        " dt/((1 + e) v)` too much, 0.15 % at 1 ms.",
        "In MuJoCo the contact point lies half the overlap inside the ball, in DART the whole of it, which shortens"
        " the lever arm: a gripping ball leaves a little too fast and with too much spin, and less so at a smaller"
        " timestep.",
        "In MuJoCo's spring profile friction takes slip away as gently as the dashpot takes speed, so that a ball"
        " which should grip still slips when it lets go, and is much too slow. A `solreffriction` of one timestep"
        " would make it right to within 1 %.",
    ),
    cases=tuple(
        _spinning(spin, friction, restitution)
        for spin in (5.0, 20.0, 60.0)
        for friction in (0.1, 0.3)
        for restitution in (0.5, 0.8)
    ),
    quantities=(
        Quantity(
            "speed_along",
            "speed along the floor",
            "m/s",
            lambda trajectory: turning.speed_along(trajectory, "ball", "floor"),
            _expect(_speed_along, _speed_along),  # friction makes all of it
            _speed_along,
        ),
        Quantity(
            "surface_speed",
            "r ω after the impact",
            "m/s",
            lambda trajectory: turning.surface_speed(trajectory, "ball"),
            _expect(_surface_speed, _surface_speed_lost),
            _surface_speed,
        ),
    ),
    curve=Curve(
        "ω=60,μ=0.3,e=0.5",
        "Way along the floor, 60 rad/s, μ = 0.3, e = 0.5",
        "way, m",
        lambda trajectory: trajectory.position("ball")[:, 0],
    ),
    convergence=Convergence("ω=60,μ=0.3,e=0.5", "speed_along"),
    grid=Grid(
        (
            Parameter("spin", "rad/s", (5.0, 20.0, 60.0), 20.0),
            Parameter("friction", "", (0.1, 0.2, 0.3, 0.5), 0.3),
            Parameter("restitution", "", (0.2, 0.5, 0.8), 0.5),
        ),
        (1e-3, 2e-3, 5e-3),
        _spinning,
    ),
    predict=striking.predict,
)

FAMILIES = (SPINNING_BALL,)
