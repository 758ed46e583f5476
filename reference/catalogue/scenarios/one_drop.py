"""One drop of a ball on a slope, and three responses: turn the velocity back, push with a spring, ask an engine."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.catalogue.case import Case
from reference.catalogue.family import Convergence, Curve, Expectation, Family, Quantity
from reference.catalogue.grid import Grid, Parameter
from reference.catalogue.scenarios.tolerances import MILLIMETRE, ROUNDING
from reference.engines import facts
from reference.engines.base import (
    AT_STEP,
    BULLET,
    COMPLIANT,
    EXACT,
    INTERPOLATED,
    MUJOCO_ONE_STEP,
    MUJOCO_SPRING,
    Method,
)
from reference.errors import RunFailed
from reference.prediction import bouncing, striking
from reference.prediction.predicted import Prediction
from reference.scene import geometry
from reference.scene.scenario import GRAVITY, Body, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

NORMAL = (2 / 7, 3 / 7, 6 / 7)
"""Of the slope, which falls at 31° in a direction that is no axis."""
DOWN, ALONG = GRAVITY * NORMAL[2], GRAVITY * math.hypot(NORMAL[0], NORMAL[1])
"""Weight towards the slope and along it, per unit mass, m/s²."""
RADIUS, MASS, PLACE = 0.1, 2.3, (0.3, -0.2, 0.5)
"""Of the ball, m and kg; a point of the slope, m."""
HEIGHT = 0.1
"""Gap at the start, along the normal, m; the mean one where drops are jittered."""
DROPS, GRID_DROPS = 7, 3
"""Drops in an ensemble, primes: their phases within a step are evenly spread. A point of the grid has fewer, and so do
drops that are watched until they rest, which take long."""
SPREAD = 0.02
"""The fall times of an ensemble span this, s: whole steps of 4 ms and of timesteps that divide it."""
PAST_APEX, UNTIL_REST = 0.03, 0.29
"""How long after its first apex a drop ends, s; and how long a drop lasts that comes to rest, s."""
AT_REST = 0.2
"""The restitution up to which a drop is watched until it rests."""
READ_OFF, READ_OFF_REASON = 0.01, "1 %: what can be read off a plot"
SHARE = 1e-3
YIELDS = "the contact takes time and depth: rigid bodies would take neither"


def _dropped(restitution: float, count: int = DROPS) -> Case:
    """Drops whose fall times are spread evenly, so that no mean depends on the phase within a step."""
    fall, normal = truth.fall_time(HEIGHT, DOWN), np.array(NORMAL)
    name = f"e={restitution:g}" + (f",drops={count}" if count != DROPS else "")
    if restitution <= AT_REST:
        count = GRID_DROPS
    falls = [fall + SPREAD * (drop - count // 2) / count for drop in range(count)]
    scenarios = []
    for time in sorted(falls, key=lambda time: abs(time - fall)):
        place = PLACE + (RADIUS + DOWN * time**2 / 2) * normal
        ball = Body("ball", Sphere(RADIUS), MASS, tuple(place.tolist()))
        duration = UNTIL_REST if restitution <= AT_REST else time * (1 + restitution) + PAST_APEX
        slope = Body("slope", HalfSpace(NORMAL), position=PLACE)
        pair = Pair("ball", "slope", restitution)
        duration = round(duration, 3)  # whole steps of 1 ms, so that an exact run ends where the scenario does
        scenarios.append(Scenario(f"one-drop/{name}", (slope, ball), (pair,), duration))
    return Case(name, tuple(scenarios), {"restitution": restitution})


def _height(scenario: Scenario) -> float:
    return geometry.gap(scenario.body("slope"), scenario.body("ball"))


def _gap(trajectory: Trajectory) -> Array:
    return measure.separation(trajectory, "ball", "slope")


def _speed(case: Case) -> float:
    """Greatest speed of approach in an ensemble, m/s."""
    return max(truth.impact_speed(_height(scenario), DOWN) for scenario in case.scenarios)


def _rebound(trajectory: Trajectory) -> float:
    return measure.first_apex(trajectory, "ball", "slope") / _height(trajectory.scenario)


def _expect_rebound(case: Case, settings: Settings, method: Method) -> Expectation:
    e = case.parameters["restitution"]
    exact = truth.rebound_ratio(e)
    if method.kind == EXACT:
        return Expectation(exact, ROUNDING, "rounding only: the parabola is solved, not stepped")
    near = READ_OFF * exact
    if method.kind != AT_STEP:
        why = "a contact that cannot pull lets go early, and the weight acts while it lasts"
        return Expectation(exact, near, READ_OFF_REASON, shift_reason=why)
    dt, heights = settings.timestep, [_height(scenario) for scenario in case.scenarios]
    shifts = [truth.rebound_shift_at_step(each, e, DOWN, dt, method.recovery) / each for each in heights]
    # The apex is a sawtooth of the depth d at which the slope is noticed, e² (h + d) − (1 − c) d with 0 ≤ d < v dt. Its
    # mean over N even phases may be off by half an Nth of its height.
    sawtooth = abs(1 - method.recovery - e**2) * _speed(case) * dt
    next_order = (sawtooth / (2 * len(heights)) + 2 * DOWN * dt**2) / HEIGHT
    why = "half a step late: the right speed from the wrong place"
    return Expectation(exact, near, READ_OFF_REASON, sum(shifts) / len(shifts), why, next_order)


def deepest(trajectory: Trajectory) -> float:
    """Greatest depth, m. Within a spring it is read from the cubics through the samples and their velocities.

    A spring's samples are up to 1/√k apart. The cubic misses its path by 1/384 of the depth at most; the deepest sample
    alone would miss it by 12 %. A rigid contact has no path between samples: there the deepest sample counts.
    """
    gap = _gap(trajectory)
    found = max(0.0, float(-gap.min()))
    if "stiffness" not in trajectory.settings.options:
        return found
    rate, steps = trajectory.velocity("ball") @ np.array(NORMAL), np.diff(trajectory.times)
    share = np.linspace(0, 1, 201)[:, None]
    cubic = (1 + 2 * share) * (1 - share) ** 2 * gap[:-1] + share**2 * (3 - 2 * share) * gap[1:]
    cubic += share * (1 - share) * steps * ((1 - share) * rate[:-1] - share * rate[1:])
    inside = (gap[:-1] < 0) & (gap[1:] < 0)
    return max(found, float(-cubic[:, inside].min())) if inside.any() else found


def _expect_deepest(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind in (EXACT, INTERPOLATED):
        return Expectation(0.0, ROUNDING, "rounding only: no step ends below the slope")
    if method.kind == COMPLIANT:
        return Expectation(0.0, MILLIMETRE, "1 mm: nobody sees it in a scene of metres", shift_reason=YIELDS)
    return Expectation(0.0, _speed(case) * settings.timestep, "v dt: the slope is noticed up to a step late")


def time_below(trajectory: Trajectory) -> float:
    """Time between the landing of the first flight and the launch of the second, by their parabolas, s."""
    found = measure.flights(trajectory, "ball", "slope")
    if len(found) < 2:
        raise RunFailed("does not fly a second time")
    return found[1].launch_time - found[0].landing_time


def _expect_time_below(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind == EXACT:
        return Expectation(0.0, ROUNDING, "rounding only: an impact takes no time")
    if method.kind == COMPLIANT:
        return Expectation(0.0, MILLIMETRE, "1 ms: a sixteenth of a picture", shift_reason=YIELDS)
    late = (2 + 1 / case.parameters["restitution"]) * settings.timestep
    return Expectation(0.0, late, "(2 + 1/e) dt: up to a step into the overlap, 1/e as long out of it")


def _end(trajectory: Trajectory) -> float:
    later = trajectory.position("ball")[-1] - measure.at_end(trajectory, "ball")[0]
    return float(_gap(trajectory)[-1] - later @ np.array(NORMAL))


def _expect_end(case: Case, settings: Settings, method: Method) -> Expectation:
    """The rebound's parabola at the end of the drop; of the drops that come to rest, nothing."""
    e, found = case.parameters["restitution"], 0.0
    if e > AT_REST:
        after = [scenario.duration - truth.fall_time(_height(scenario), DOWN) for scenario in case.scenarios]
        speeds = [e * truth.impact_speed(_height(scenario), DOWN) for scenario in case.scenarios]
        found = sum(v * t - DOWN * t**2 / 2 for v, t in zip(speeds, after, strict=True)) / len(after)
    if method.kind == EXACT:
        return Expectation(found, ROUNDING, "rounding only: the flight is solved, not stepped")
    why = "the rebound is higher or lower, and it began late"
    return Expectation(found, MILLIMETRE, "1 mm: nobody sees it in a scene of metres", shift_reason=why)


def _falls_by_chance(case: Case, settings: Settings, method: Method) -> float:
    """Tuned PyBullet's ball rests with a gap of 0, and rounding decides in which steps that is a contact, m.

    In a step without one the ball falls by g dt², and the next step puts a share of that back.
    """
    return DOWN * settings.timestep**2 if method.rule == BULLET else 0.0


def _along(trajectory: Trajectory) -> float:
    """Acceleration along the slope, m/s², from the whole way: 2 s/t²."""
    way = trajectory.position("ball")[-1] - trajectory.position("ball")[0]
    normal = np.array(NORMAL)
    return float(2 * np.linalg.norm(way - (way @ normal) * normal) / trajectory.times[-1] ** 2)


def _expect_along(case: Case, settings: Settings, method: Method) -> Expectation:
    if method.kind in (EXACT, INTERPOLATED):
        return Expectation(ALONG, ROUNDING * ALONG, "rounding only: the flight is solved, not stepped")
    if method.kind == COMPLIANT:
        return Expectation(ALONG, SHARE * ALONG, "0.1 %")
    late = sum(settings.timestep / scenario.duration for scenario in case.scenarios) / len(case.scenarios)
    why = "+a t dt/2: a step moves with the velocity that it has just gained"
    # The last sample is up to a step beside the end of the scenario
    return Expectation(ALONG, SHARE * ALONG, "0.1 %", ALONG * late, why, 2 * ALONG * late**2 + 1e-9)


def _quantities() -> tuple[Quantity, ...]:
    scale: Callable[[Case], float] = lambda case: ALONG  # noqa: E731
    return (
        Quantity("rebound", "rebound", "", _rebound, _expect_rebound, share_of="the height of the drop"),
        Quantity("deepest", "depth", "m", deepest, _expect_deepest),
        Quantity("time_below", "in contact", "s", time_below, _expect_time_below, absent="never flies again"),
        Quantity("end", "end gap", "m", _end, _expect_end, slack=_falls_by_chance),
        Quantity("along", "along slope", "m/s²", _along, _expect_along, scale),
        Quantity("steps", "steps", "1/s", lambda trajectory: 1 / trajectory.settings.timestep, None, cost=True),
    )


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The recurrence of the method for a smooth slope; in MuJoCo for one with friction.

    MuJoCo has no smooth contact. It takes 10⁻⁵ for the least friction, and the ball meets the slope at an angle.
    """
    is_rough = method.rule in (MUJOCO_ONE_STEP, MUJOCO_SPRING)
    found = striking.predict if is_rough else bouncing.predict
    return found(scenario, settings, method)


ONE_DROP = Family(
    name="one-drop",
    title="One drop, three responses",
    topic="response",
    statements=(3, 6, 7, 8),
    about=f"A smooth ball of {MASS:g} kg is let go {HEIGHT:g} m above a slope of 31° and rebounds. One response turns"
    " its velocity back. Another lets a spring with a dashpot push it out, with `k/m = 10⁶ 1/s²` and the damping that"
    " would give e without weight. Each engine has its own response. At e = 0.2 the ball is watched until it rests on"
    f" its way down the slope; every other figure is the mean over {DROPS} drops that reach the slope at evenly spread"
    " phases of a step.",
    expected="The velocity along the normal becomes `−e v`, and the velocity along the slope stays as it is. The ball"
    " rises to `e² h`. A rigid contact has no depth and takes no time. A penalty contact without a dashpot is `v"
    " √(m/k)` deep and lasts `π √(m/k)`, here 1.3 mm and 3.1 ms. A ball at rest on it is `m g/k` deep, here 8.4 µm.",
    why=(
        "A penalty contact cannot give `e² h`. It ends while the ball is still inside, because it must not pull, and"
        " weight acts during the whole contact. At e = 0.5 the closed form of the rebound is 0.2450 of the height. The"
        " hand-written spring gives a little less, because its dashpot uses the velocity before each step, and"
        " PyBullet's gives a little more, because it uses the velocity after the step.",
        "MuJoCo's spring does not feel the weight. Its `solref` sets the acceleration of the contact, and MuJoCo adds"
        " the force that carries the ball. So the ball rebounds higher, as on a spring without weight. At rest the"
        " impedance leaves a ten-thousandth of the depth `m g/k`, which is less than the chatter of about `g dt/2`"
        " that is measured.",
        "Accuracy has its price. The exact root takes 1000 steps a second and has only rounding errors. Responding at"
        " the step takes as many steps, and has the error of a step. The spring takes 20,000 steps a second in the"
        " hand-written code and in PyBullet, and 5000 in MuJoCo, which evaluates the force four times in each. Its"
        " error is about as large, mostly because it is a spring.",
        f"{facts.MUJOCO_ALWAYS_RUBS} The ball meets the slope at an angle, and this friction takes a share of the"
        " normal impulse from its motion along the slope.",
        "DART has no spring. Its contact is rigid, and the lab's recurrence gives each of its numbers.",
    ),
    cases=tuple(_dropped(restitution) for restitution in (AT_REST, 0.5, 0.8, 1.0)),
    quantities=_quantities(),
    curve=Curve("e=0.5", "One drop at e = 0.5", "gap below the ball, m", _gap),
    convergence=Convergence("e=0.5", "rebound", (4.0, 2.0, 1.0)),
    grid=Grid(
        (Parameter("restitution", "", (0.2, 0.35, 0.5, 0.65, 0.8, 1.0), 0.5),),
        (1e-3, 2e-3),
        lambda restitution: _dropped(restitution, GRID_DROPS),
    ),
    predict=predict,
)

FAMILIES = (ONE_DROP,)
