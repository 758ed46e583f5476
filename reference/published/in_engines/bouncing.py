"""Published bounces in the engines: a ball let go above a floor, its impacts, its apexes and its energy."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.engines.base import Engine
from reference.published.answers import Answer, Answers, answer_within
from reference.published.case import Published
from reference.published.in_engines.at_step import Bounce, apexes_off, end_off, stepped, times_off, why_late
from reference.published.in_engines.scenes import AFTER_APEX, FINE, ball_over_floor, gravity_of, tuned
from reference.published.landing import at_impact
from reference.scene.scenario import Scenario
from reference.scene.settings import Option, Settings

DART_LIFT = 1e-3
"""How fast DART takes back overlap, m/s; a constant of its source code."""
MULTIBODY: dict[str, Option] = {
    "coordinates": "multibody",
    "linear_damping": 0.0,
    "angular_damping": 0.0,
    "contact_gap_falls": 0.0,
    "contact_erp": 0.0,
}
"""Bullet's multibodies with nothing but the impact: no damping, no contact ahead of the touch, no push out."""
COARSE = 1e-3
"""Timestep of a flight of four seconds, s, whose figures have three digits."""
SMALL = 0.02
"""Radius of the ball where the case gives none, m."""
AFTER_REST = 0.2
"""How long a ball is watched after its last bounce, s, so that its rest is seen."""
SECOND_ORDER = 1e-3
"""How far the loop of three lines may be off an engine, as a share of the shift: a softness squared and the like."""


def elastic_balls(case: Published, engine: Engine) -> Answers:
    """P1: the balls do not touch each other, so that one ball's energy counts for all."""
    height, radius, mass, duration = case.values("height", "radius", "mass", "duration")
    scenario = ball_over_floor(case, height - radius, duration, 1.0, radius, mass)
    settings = [tuned(engine, scenario, timestep) for timestep in case.numbers("timesteps")]
    weighed = engine.method(scenario, settings[0]).weighed > 0
    columns = {"bullet" if weighed else "ode": settings}
    if engine.name == "pybullet":
        columns["bullet"] = [Settings(timestep, options=MULTIBODY) for timestep in case.numbers("timesteps")]
    absent = Answer(None, reason=f"{engine.title} answers with the speed {'after' if weighed else 'before'} gravity")
    return dict.fromkeys(case.expected, absent) | {
        column: _energies(case, engine, scenario, column, chosen) for column, chosen in columns.items()
    }


def _energies(case: Published, engine: Engine, scenario: Scenario, column: str, chosen: list[Settings]) -> Answer:
    """One column, with a number for each timestep, and its shift: what the engine's own impact does to the number."""
    mass, gravity, drop = case.value("mass"), gravity_of(case), case.value("height") - case.value("radius")
    found, theory = [], []
    for settings in chosen:
        energy = measure.energy(engine.run(scenario, settings.change(sample_every=1)), "ball")[:-1]
        bounce, weighed = Bounce(drop, 1.0, gravity, settings.timestep), float(column == "bullet")
        states = _by_three_lines(bounce, engine, scenario, settings, len(energy), weighed)
        energies = (energy, mass * (gravity * states[:-1, 0] + states[:-1, 1] ** 2 / 2))
        squares = [float(np.mean((case.value("balls") * (each - each[0])) ** 2)) for each in energies]
        found.append(squares[0])
        theory.append(squares[1])
    shift = np.subtract(theory, case.expected[column])
    reason = "the three lines that give the published number, with what the engine's own contact makes of an impact"
    near = SECOND_ORDER * np.abs(shift)
    return Answer(tuple(found), None, "", tuple(shift.tolist()), reason, tuple(near.tolist()))


def _by_three_lines(
    bounce: Bounce, engine: Engine, scenario: Scenario, settings: Settings, steps: int, weighed: float
) -> Array:
    """Gap and velocity before each step and after the last, (steps + 1, 2), as the engine's impacts would make them.

    The velocity before an impact may have the step's gravity in it (`weighed`), and its change falls short by a share
    (`softness`). With an impedance d the contact carries the share d of the weight, and the share 1 − d still acts.
    """
    method, fall = engine.method(scenario, settings), bounce.gravity * bounce.timestep
    leak = 1 - settings.number("impedance") if "impedance" in settings.options else 0.0

    def answer(velocity: float) -> float:
        landing = velocity - weighed * fall
        return landing - (1 + bounce.restitution) * (1 - method.softness) * landing - leak * fall

    lift = DART_LIFT * settings.timestep if engine.name == "dart" else 0.0
    return np.array(stepped(bounce, answer, steps, lift))


def apexes(case: Published, engine: Engine) -> Answers:
    """P5: apexes of the gap, one after another."""
    drop, e = case.value("height") - case.value("radius"), case.value("restitution")
    count = len(case.expected_numbers("apexes"))
    end = float(truth.bounce_times(drop, e, gravity_of(case), count + 1)[-1])
    scenario = ball_over_floor(case, drop, end, e, case.value("radius"))
    settings = tuned(engine, scenario)
    heights = measure.apex_heights(engine.run(scenario, settings), "ball", "floor")[:count]
    bounce = Bounce(drop, e, gravity_of(case), settings.timestep)
    off = apexes_off(bounce, engine.method(scenario, settings), count)
    return {"apexes": answer_within(case, "apexes", tuple(heights.tolist()), off, why_late(settings.timestep))}


def first_rebounds(case: Published, engine: Engine) -> Answers:
    """P6: rebound over drop, for two coefficients, at the timestep of the case."""
    drop, found, off = case.value("height") - case.value("radius"), [], []
    for e in case.numbers("restitution"):
        height, near = _first_apex(case, engine, drop, e, case.value("timestep"), case.value("radius"))
        found.append(height / drop)
        off.append(near / drop)
    return {"ratio": answer_within(case, "ratio", tuple(found), tuple(off), why_late(case.value("timestep")))}


def measured_rebounds(case: Published, engine: Engine) -> Answers:
    """P26: rebounds with the apparent coefficients."""
    both = zip(case.numbers("drop"), case.numbers("restitution"), strict=True)
    found, off = zip(*(_first_apex(case, engine, drop, e) for drop, e in both), strict=True)
    return {"rebound": answer_within(case, "rebound", found, off, why_late(FINE))}


def _first_apex(
    case: Published, engine: Engine, drop: float, restitution: float, timestep: float = FINE, radius: float = SMALL
) -> tuple[float, float]:
    """Height of the first rebound, m, and by how much the method may be off."""
    fall = truth.fall_time(drop, gravity_of(case))
    scenario = ball_over_floor(case, drop, (1 + restitution) * fall + AFTER_APEX, restitution, radius)
    settings = tuned(engine, scenario, timestep)
    bounce = Bounce(drop, restitution, gravity_of(case), timestep)
    (off,) = apexes_off(bounce, engine.method(scenario, settings), 1)
    return measure.first_apex(engine.run(scenario, settings), "ball", "floor"), off


def thousand_steps(case: Published, engine: Engine) -> Answers:
    """P12: the same steps in an engine, which resolves the impact when bodies touch, and not 2 cm before."""
    radius, timestep, steps = case.value("radius"), case.value("timestep"), int(case.value("steps"))
    bounce = Bounce(case.value("height") - radius, case.value("restitution"), gravity_of(case), timestep)
    scenario = ball_over_floor(case, bounce.drop, steps * timestep, bounce.restitution, radius)
    settings = tuned(engine, scenario, timestep)
    pushes_out = [option for option in ("contact_erp", "overlap_recovery") if option in settings.options]
    settings = settings.change(**dict.fromkeys(pushes_out, 0.0))
    trajectory = engine.run(scenario, settings)
    weighed = engine.method(scenario, settings).weighed
    gap, speed = _by_three_lines(bounce, engine, scenario, settings, steps, weighed)[-1].tolist()
    reason = "no engine answers 2 cm before the touch: without that the same loop ends where the engine does"
    pairs = {
        "height": (trajectory.position("ball")[-1, 2], gap + radius),
        "velocity": (trajectory.velocity("ball")[-1, 2], speed),
    }
    return {
        name: Answer(
            float(value),
            shift=expected - case.expected[name],
            shift_reason=reason,
            shift_tolerance=case.tolerance[name],
        )
        for name, (value, expected) in pairs.items()
    }


def impacts_and_rest(case: Published, engine: Engine) -> Answers:
    """P15: impacts, apexes and the end of the bounces."""
    drop, e, gravity = case.value("height"), case.value("restitution"), gravity_of(case)
    scenario = ball_over_floor(case, drop, truth.bounce_end(drop, e, gravity) + AFTER_REST, e)
    settings = tuned(engine, scenario)
    method, trajectory = engine.method(scenario, settings), engine.run(scenario, settings)
    bounce = Bounce(drop, e, gravity, settings.timestep)
    impacts, tops = len(case.expected_numbers("impacts")), len(case.expected_numbers("apexes"))
    times = measure.impact_times(trajectory, "ball", "floor")[:impacts]
    heights = measure.apex_heights(trajectory, "ball", "floor")[:tops]
    end, why = measure.rest_time(trajectory, "ball"), why_late(settings.timestep)
    return {
        "impacts": answer_within(case, "impacts", tuple(times.tolist()), times_off(bounce, method, impacts), why),
        "apexes": answer_within(case, "apexes", tuple(heights.tolist()), apexes_off(bounce, method, tops), why),
        "rest": answer_within(
            case,
            "rest",
            end,
            end_off(bounce, method, measure.REST_SPEED),
            "what is too slow for the engine counts as rest; from there on the bounces would last for so long",
        ),
    }


def hot_rock(case: Published, engine: Engine) -> Answers:
    """P28: a ball as the rock, which starts as far above a floor as the rock strikes below."""
    angle, gravity = math.radians(case.value("angle")), gravity_of(case)
    thrown = (case.value("speed") * math.cos(angle), 0.0, case.value("speed") * math.sin(angle))
    highest = case.value("below") + thrown[2] ** 2 / (2 * gravity)
    duration = thrown[2] / gravity + truth.fall_time(highest, gravity) + AFTER_APEX
    dropped = ball_over_floor(case, case.value("below"), duration, 0.0)
    floor, ball = dropped.bodies
    scenario = replace(dropped, bodies=(floor, replace(ball, velocity=thrown)))
    trajectory = engine.run(scenario, tuned(engine, scenario, COARSE))
    flight = measure.flights(trajectory, "ball", "floor")[0]
    flying = int(np.searchsorted(trajectory.times, flight.landing_time)) - 1
    along = float(trajectory.velocity("ball")[flying, 0])
    return at_impact(flight.landing_time, np.array([along, 0.0, -flight.landing_speed]))
