"""Published springs in the two engines whose contacts can yield, MuJoCo and PyBullet.

MuJoCo's contact sets the acceleration to −k r − c ṙ − (1 − d) g, with the separation r, negative inside, and an
impedance d. For d → 1 the contact carries the weight, and for d → 0 the weight acts in full: then the contact is a
spring and a dashpot as in the textbooks, except for the share d of the weight.

PyBullet's contact is a spring and a dashpot on which the weight always acts in full. Its steps are known one by one:
see `BulletSpring`.
"""

from __future__ import annotations

import math

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.engines.base import Engine
from reference.prediction.bouncing import by_steps
from reference.prediction.laws import BulletSpring
from reference.published.answers import Answer, Answers
from reference.published.case import Published
from reference.published.in_engines.scenes import ball_over_floor, gravity_of
from reference.published.solid_sphere import mass_of
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

LEAST_IMPEDANCE = 1e-4
"""The least impedance that MuJoCo takes."""
ABOVE = 1e-3
"""Gap under a ball that is to come to rest, m: the spring profile is for bodies that fall."""
LANDED = 2
"""After how many fall times from there the ball stays in the contact."""
DECAYS = 25
"""How often the slower part of a ball's motion dies away by e before its depth is read: 10⁻¹¹ of it is left."""
FINE_SHARE = 0.02
"""Timestep of a ball that comes to rest, as a share of the contact's 1/ω."""
SPRING_STEP = 1e-4
"""Timestep of the undamped spring, s: (ω dt)² is 10⁻⁶."""
SUBSTEPS = 20
"""Steps here for one of P3's own: each is then a 320th of the contact's 1/ω, where theirs is a 16th."""
LAST_TOUCH = 0.6
"""Share of a full swing within which a contact has let go, as `_let_go` says."""
ROUNDING = 1e-10
"""What rounding may make of 50 000 steps, m or m/s."""
HALVINGS = 100
"""How often the bracket of the instant of letting go is halved: down to rounding."""


def spring(
    engine: Engine, scenario: Scenario, timestep: float, stiffness: float, impedance: float = LEAST_IMPEDANCE
) -> Settings:
    """A resolved contact of the given stiffness per unit mass, 1/s²; its damping follows from the restitution."""
    settings = engine.settings(scenario, "spring").change(timestep=timestep, stiffness=stiffness, sample_every=1)
    return settings.change(impedance=impedance) if "impedance" in settings.options else settings


def rest_depths(case: Published, engine: Engine) -> Answers:
    """P9: how deep a ball lies in the contact after its motion has died away.

    PyBullet has no impedance. It gets the spring that has the same depth, 1/(1 − d) as stiff, with critical damping.
    """
    found = []
    columns = (case.numbers(name) for name in ("solref_first", "solref_second", "stiffness", "impedance"))
    for first, second, stiffness, impedance in zip(*columns, strict=True):
        frequency = math.sqrt(stiffness)
        ratio = second if first > 0 else -second / (2 * frequency)
        if engine.name == "pybullet":
            stiffness /= 1 - impedance
            frequency, ratio = math.sqrt(stiffness), 1.0
        decay = frequency * (ratio - math.sqrt(max(ratio**2 - 1, 0.0)))
        duration = LANDED * truth.fall_time(ABOVE, gravity_of(case)) + DECAYS / decay
        scenario = ball_over_floor(case, ABOVE, duration, truth.spring_dashpot_restitution(ratio))
        trajectory = engine.run(scenario, spring(engine, scenario, FINE_SHARE / frequency, stiffness, impedance))
        found.append(-measure.rest_height(trajectory, "ball", "floor"))
    return {"depth": Answer(tuple(found))}


def undamped_spring(case: Published, engine: Engine) -> Answers:
    """P18: how deep the ball gets and how fast, sampled at each step, where both are at their extremes."""
    touch, stiffness = case.value("contact"), case.value("stiffness") / case.value("mass")
    drop = case.value("height") - touch
    duration = math.sqrt(2 * drop / gravity_of(case)) + math.pi / math.sqrt(stiffness)
    scenario = ball_over_floor(case, drop, duration, 1.0, touch, case.value("mass"))
    trajectory = engine.run(scenario, spring(engine, scenario, SPRING_STEP, stiffness))
    fastest = float(np.max(-trajectory.velocity("ball")[:, 2]))
    return {"lowest": Answer(float(np.min(trajectory.position("ball")[:, 2]))), "fastest": Answer(fastest)}


def spring_and_dashpot(case: Published, engine: Engine) -> Answers:
    """P3: the same spring and dashpot, except that no engine's contact pulls, in finer steps than the published."""
    radius, gravity = case.value("diameter") / 2, gravity_of(case)
    stiffness = case.value("stiffness") / mass_of(radius, case.value("density"))
    logarithm = math.log(case.value("restitution"))
    ratio, drop = -logarithm / math.hypot(math.pi, logarithm), case.value("height") - radius
    restitution = truth.spring_dashpot_restitution(ratio)
    times = np.array(case.numbers("steps")) * case.value("timestep")
    scenario = ball_over_floor(case, drop, times[-1], restitution, radius)
    timestep = case.value("timestep") / SUBSTEPS
    trajectory = engine.run(scenario, spring(engine, scenario, timestep, stiffness))
    at, speed = np.rint(times / timestep).astype(int), truth.impact_speed(drop, gravity)
    after, gap, leaving = _let_go(speed, stiffness, ratio, gravity)
    flown = np.maximum(times - truth.fall_time(drop, gravity) - after, 0.0)
    theory = radius + gap + leaving * flown - gravity * flown**2 / 2, leaving - gravity * flown
    near = truth.coarse_contact(restitution, stiffness, timestep) * speed
    found = (trajectory.position("ball")[at, 2], trajectory.velocity("ball")[at, 2])
    if engine.name == "pybullet":
        damping = 2 * ratio * math.sqrt(stiffness)
        law = BulletSpring(timestep, stiffness, damping)
        gaps, rates, _ = by_steps(drop, 0.0, -gravity * timestep, law, int(at[-1]))
        return {
            "position": _as_stepped(case, "position", found[0], gaps[at] + radius),
            "velocity": _as_stepped(case, "velocity", found[1][1:], rates[at][1:]),
        }
    return {
        "position": _without_pull(case, "position", found[0], theory[0], near * flown),
        "velocity": _without_pull(case, "velocity", found[1][1:], theory[1][1:], np.full(2, near)),
    }


def _let_go(speed: float, stiffness: float, ratio: float, gravity: float) -> tuple[float, float, float]:
    """When, s, where (gap, m) and how fast (m/s) a ball leaves a spring with a dashpot that never pulls.

    Measured from the surface, x = −g/k + exp(−ζ ω t) (a cos νt + b sin νt) with x(0) = 0 and ẋ(0) = −v. The ball leaves
    when the force per mass, −ω² x − 2 ζ ω ẋ, is zero, which happens once within six tenths of a swing.
    """
    frequency = math.sqrt(stiffness)
    decay, swing = ratio * frequency, frequency * math.sqrt(1 - ratio**2)
    a = gravity / stiffness
    b = (decay * a - speed) / swing

    def state(time: float) -> tuple[float, float]:
        cosine, sine = math.cos(swing * time), math.sin(swing * time)
        gone = math.exp(-decay * time)
        place = gone * (a * cosine + b * sine)
        return place - a, -decay * place + gone * swing * (b * cosine - a * sine)

    low, high = 0.0, LAST_TOUCH * 2 * math.pi / swing
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        place, velocity = state(middle)
        pushes = -stiffness * place - 2 * decay * velocity > 0
        low, high = (middle, high) if pushes else (low, middle)
    return low, *state(low)


def _as_stepped(case: Published, figure: str, found: Array, predicted: Array) -> Answer:
    """Answer with the shift that the engine's own steps make, which are known except for rounding."""
    shift = predicted - np.array(case.expected[figure])
    reason = "its contact never pulls, and its steps of first order fall g t dt/2 too far; predicted step by step"
    return Answer(tuple(found.tolist()), None, "", tuple(shift.tolist()), reason, (ROUNDING,) * len(found))


def _without_pull(case: Published, figure: str, found: Array, theory: Array, near: Array) -> Answer:
    """Answer with the shift, once the ball has left the contact, that a dashpot which never pulls makes in theory."""
    shift = np.where(near > 0, theory - np.array(case.expected[figure]), 0.0)
    reason = "its contact never pulls: with the same dashpot the ball comes back with 0.902 of its speed, not 0.9"
    return Answer(tuple(found.tolist()), None, "", tuple(shift.tolist()), reason, tuple(near.tolist()))
