"""A ball without weight between walls: in a corner, and back and forth between two (slides 5 to 7, 12)."""

from __future__ import annotations

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import TENTHS, Grid, Parameter
from reference.engines import facts
from reference.engines.base import EXACT, INTERPOLATED, Method
from reference.errors import RunFailed
from reference.prediction import striking
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

RADIUS = 0.1
"""Radius of the ball, m."""
SPEED = 2.0
"""First speed of the ball, m/s; in the corner, towards each wall."""
GAP = 0.8
"""Free way between the two walls, m."""
IMPACTS = 5
"""How many impacts are awaited between the two walls."""
FLIGHT = 0.50004
"""Time until the ball in the corner meets the floor, s. Half a second would be a whole number of every timestep, and
rounding would decide in which step the impact is noticed."""
START = 1e-6
"""Gap between the ball and the left one of two walls at the start, m: too small to see, but not zero, so that at no
timestep the ball is exactly at a wall at the end of a step."""
AFTER = 0.1
"""How long a ball is watched after its last impact, s."""
SHARE = 1e-3
"""Accepted share of a value: 0.1 %."""
ROUNDING = 1e-12
"""Share of a value by which rounding may change it in some thousand steps."""
STILL = 1e-6
"""Share of the first speed below which a ball stands still."""
WEIGHTLESS = (0.0, 0.0, 0.0)


def _corner(restitution: float, later: float) -> Case:
    """A ball that meets the wall `later` seconds after the floor."""
    name = f"e={restitution:g}" + (f",later={later:g}" if later else "")
    away = FLIGHT * SPEED
    position = (RADIUS + away + later * SPEED, 0.0, RADIUS + away)
    ball = Body("ball", Sphere(RADIUS), 1.0, position, velocity=(-SPEED, 0.0, -SPEED))
    bodies = (Body("floor", HalfSpace()), Body("wall", HalfSpace((1.0, 0.0, 0.0))), ball)
    pairs = (Pair("ball", "floor", restitution), Pair("ball", "wall", restitution))
    scenario = Scenario(f"corner/{name}", bodies, pairs, FLIGHT + later + AFTER, WEIGHTLESS)
    return Case(name, (scenario,), {"restitution": restitution})


def _expect_kept(case: Case, settings: Settings, method: Method) -> Expectation:
    exact = case.parameters["restitution"]
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * exact, "rounding only: the instants of both impacts are solved for")
    return Expectation(exact, SHARE * exact, "0.1 %: without weight or friction an impact is all that changes a speed")


def _restitution(case: Case) -> float:
    return case.parameters["restitution"]


def _distance(trajectory: Trajectory) -> Array:
    """Distance of the ball's surface from the floor's edge along the wall, m."""
    positions = trajectory.position("ball")
    return np.asarray(np.hypot(positions[:, 0] - RADIUS, positions[:, 2] - RADIUS))


CORNER = Family(
    name="corner",
    title="Ball in a corner",
    topic="response",
    statements=(6, 7, 12, 22),
    about=f"A ball without weight flies into the corner of a floor and a wall, at {SPEED:g} m/s towards each. It meets"
    " both at once, or the wall a little after the floor.",
    expected="Each impact reverses the velocity along its own normal and keeps `e` of it. The two normals are"
    " perpendicular, so neither impact disturbs the other: the ball leaves with `−e v`.",
    why=(
        "Without weight, impacts are all there is, and PyBullet and the hand-written code are right to the last"
        " digits. MuJoCo's one-step contact returns a ten-thousandth of the overlap as speed. DART's contact is not"
        " quite hard: the share `10⁻⁵` of the change of speed is missing, tuned and stock.",
    ),
    cases=tuple(_corner(restitution, later) for restitution in (0.5, 0.8, 1.0) for later in (0.0, 0.0005, 0.02)),
    quantities=(
        Quantity(
            "kept_by_floor",
            "share kept, speed towards floor",
            "",
            lambda trajectory: float(trajectory.velocity("ball")[-1, 2] / SPEED),
            _expect_kept,
            _restitution,
        ),
        Quantity(
            "kept_by_wall",
            "share kept, speed towards wall",
            "",
            lambda trajectory: float(trajectory.velocity("ball")[-1, 0] / SPEED),
            _expect_kept,
            _restitution,
        ),
    ),
    curve=Curve("e=0.8", "Both at once at e = 0.8", "distance from the corner, m", _distance),
    convergence=Convergence("e=0.8", "kept_by_floor"),
    grid=Grid(
        (Parameter("restitution", "", TENTHS[1:], 0.8), Parameter("later", "s", (0.0, 5e-4, 2e-2), 0.0)),
        (1e-3, 2e-3, 5e-3),
        _corner,
    ),
    predict=striking.predict,
)


def _impacts(restitution: float) -> Array:
    return truth.wall_impacts(GAP, SPEED, restitution, IMPACTS) - START / SPEED


def _between(restitution: float) -> Case:
    name = f"e={restitution:g}"
    ball = Body("ball", Sphere(RADIUS), 1.0, (RADIUS + START, 0.0, 0.0), velocity=(SPEED, 0.0, 0.0))
    left = Body("left", HalfSpace((1.0, 0.0, 0.0)))
    right = Body("right", HalfSpace((-1.0, 0.0, 0.0)), position=(GAP + 2 * RADIUS, 0.0, 0.0))
    pairs = (Pair("ball", "left", restitution), Pair("ball", "right", restitution))
    duration = float(_impacts(restitution)[-1]) + AFTER
    scenario = Scenario(f"two-walls/{name}", (left, right, ball), pairs, duration, WEIGHTLESS)
    return Case(name, (scenario,), {"restitution": restitution})


def _speed_left(case: Case) -> float:
    return SPEED * float(case.parameters["restitution"] ** IMPACTS)


def _expect_speed_left(case: Case, settings: Settings, method: Method) -> Expectation:
    exact, why = _speed_left(case), ""
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING * exact, "rounding only: each impact keeps e of the speed")
    if exact < case.parameters["restitution"] * method.rest_speed:
        why = "the last impact is slower than what is taken for rest"
    reason = f"0.1 % after {IMPACTS} impacts: nothing but what comes back of the overlap changes the speed"
    return Expectation(exact, SHARE * exact, reason, shift_reason=why)


def _before_last_impact(trajectory: Trajectory) -> int:
    """Place of the last sample before the last impact; `RunFailed` where there were fewer impacts."""
    velocity = trajectory.velocity("ball")[:, 0]
    still = np.abs(velocity) < STILL * SPEED  # a ball that stays at a wall has met it too
    turns = np.flatnonzero(np.diff(np.where(still, 0.0, np.sign(velocity))) != 0)
    if len(turns) < IMPACTS:
        raise RunFailed(f"the ball has met the walls {len(turns)} times, not {IMPACTS}")
    return int(turns[IMPACTS - 1])


def _speed_at_end(trajectory: Trajectory) -> float:
    """Speed after the last impact, m/s; a ball that was caught before has none."""
    _before_last_impact(trajectory)
    return float(np.linalg.norm(trajectory.velocity("ball")[-1]))


def _last_impact(trajectory: Trajectory) -> float:
    """Instant of the last impact, s: where the straight flights before and after it meet the wall."""
    velocity, position = trajectory.velocity("ball")[:, 0], trajectory.position("ball")[:, 0]
    before = _before_last_impact(trajectory)
    wall = RADIUS + GAP if velocity[before] > 0 else RADIUS
    return float(trajectory.times[before] + (wall - position[before]) / velocity[before])


def _true_last_impact(case: Case) -> float:
    return float(_impacts(case.parameters["restitution"])[-1])


def _expect_last_impact(case: Case, settings: Settings, method: Method) -> Expectation:
    exact, restitution = _true_last_impact(case), case.parameters["restitution"]
    if method.kind in (EXACT, INTERPOLATED):
        return Expectation(exact, 1e-9, "rounding only: without weight the way is straight, and its chord is the way")
    # An impact is noticed up to dt late, and the way back from behind the wall takes up to dt/e more. All that follows
    # is late by as much, no more: a delay, unlike a way, is the same at every speed.
    delays = (IMPACTS - 1) * settings.timestep * (1 + 1 / restitution)
    why = "each impact is noticed up to a step late, and it takes a while to come back from behind the wall"
    return Expectation(exact, SHARE * exact, "0.1 %", delays / 2, why, delays / 2 + SHARE * exact)


_TOO_FEW = f"no impact {IMPACTS}"

TWO_WALLS = Family(
    name="two-walls",
    title="Ball between two walls",
    topic="response",
    statements=(5, 6, 7, 12),
    about=f"A ball without weight flies back and forth between two walls and has {GAP:g} m of free way between them.",
    expected="Each impact keeps `e` of the speed, so every crossing takes `1/e` of the time of the one before, and"
    " `eⁿ` of the speed is left after n impacts.",
    why=(
        "The speeds are right: by hand and in PyBullet exactly, and nearly in MuJoCo. The times are late by up to `dt"
        " (1 + 1/e)` an impact where an impact is noticed at the end of its step, because the way back from behind the"
        " wall takes `1/e` of what was overshot. Hand-written code that solves for the impact is right, also with the"
        " slide's T, since the ball's way is straight. In MuJoCo at e = 0.5 the little speed that its contact adds"
        " weighs more, and the last impact is early.",
        f"{facts.DART_RESTS} So the last one at e = 0.5, of 0.0625 m/s, does not happen.",
    ),
    cases=tuple(_between(restitution) for restitution in (0.5, 0.8, 1.0)),
    quantities=(
        Quantity(
            "speed_left",
            f"speed after {IMPACTS} impacts",
            "m/s",
            _speed_at_end,
            _expect_speed_left,
            _speed_left,
            absent=_TOO_FEW,
        ),
        Quantity(
            "last_impact",
            f"impact {IMPACTS}",
            "s",
            _last_impact,
            _expect_last_impact,
            _true_last_impact,
            absent=_TOO_FEW,
        ),
    ),
    curve=Curve("e=0.8", "To and fro at e = 0.8", "place, m", lambda trajectory: trajectory.position("ball")[:, 0]),
    convergence=Convergence("e=0.8", "last_impact"),
    grid=Grid((Parameter("restitution", "", TENTHS[5:], 0.8),), (5e-4, 1e-3, 2e-3, 5e-3), _between),
    predict=striking.predict,
)

FAMILIES = (CORNER, TWO_WALLS)
