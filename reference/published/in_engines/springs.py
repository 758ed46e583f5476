"""Published springs in the engine that has contacts which yield: MuJoCo's.

Its contact sets the acceleration to −k r − c ṙ − (1 − d) g, with the separation r, negative inside, and an impedance d.
The weight is carried by the contact for d → 1, and acts in full for d → 0: then the contact is a spring and a dashpot
as in the textbooks, but for the share d of the weight. 10⁻⁴ is the least that MuJoCo takes.
"""

from __future__ import annotations

import math

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.catalogue import measure
from reference.engines.base import Engine
from reference.published import Answer, Answers, Published
from reference.published.in_engines.scenes import ball_over_floor, gravity_of
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings

LEAST_IMPEDANCE = 1e-4
ABOVE = 1e-3
"""Gap under a ball that is to come to rest, m: the spring profile is for what falls."""


def spring(engine: Engine, scenario: Scenario, timestep: float, stiffness: float, impedance: float) -> Settings:
    """A resolved contact of the given stiffness per unit mass, 1/s²; its damping follows from the restitution."""
    settings = engine.settings(scenario, "spring")
    return settings.change(timestep=timestep, stiffness=stiffness, impedance=impedance, sample_every=1)


def rest_depths(case: Published, engine: Engine) -> Answers:
    """P9: how deep a ball lies in the contact, 25 times the time in which its slower motion dies away by e."""
    found = []
    columns = (case.values(name) for name in ("solref_first", "solref_second", "stiffness", "impedance"))
    for first, second, stiffness, impedance in zip(*columns, strict=True):
        frequency = math.sqrt(stiffness)
        ratio = second if first > 0 else -second / (2 * frequency)
        decay = frequency * (ratio - math.sqrt(max(ratio**2 - 1, 0.0)))
        scenario = ball_over_floor(case, ABOVE, 25 / decay, truth.spring_dashpot_restitution(ratio))
        trajectory = engine.run(scenario, spring(engine, scenario, 0.02 / frequency, stiffness, impedance))
        found.append(-measure.rest_height(trajectory, "ball", "floor"))
    return {"depth": Answer(tuple(found))}


def undamped_spring(case: Published, engine: Engine) -> Answers:
    """P18: how deep the ball gets and how fast, sampled at each step, where both are at their extremes."""
    touch, stiffness = case.value("contact"), case.value("stiffness") / case.value("mass")
    drop = case.value("height") - touch
    duration = math.sqrt(2 * drop / gravity_of(case)) + math.pi / math.sqrt(stiffness)
    scenario = ball_over_floor(case, drop, duration, 1.0, touch, case.value("mass"))
    trajectory = engine.run(scenario, spring(engine, scenario, 1e-4, stiffness, LEAST_IMPEDANCE))
    fastest = float(np.max(-trajectory.velocity("ball")[:, 2]))
    return {"lowest": Answer(float(np.min(trajectory.position("ball")[:, 2]))), "fastest": Answer(fastest)}


def spring_and_dashpot(case: Published, engine: Engine) -> Answers:
    """P3: the same spring and dashpot, but that MuJoCo's never pulls; in steps of a hundredth of its own time."""
    radius, gravity = case.value("diameter") / 2, gravity_of(case)
    stiffness = case.value("stiffness") / (case.value("density") * 4 / 3 * math.pi * radius**3)
    logarithm = math.log(case.value("restitution"))
    ratio, drop = -logarithm / math.hypot(math.pi, logarithm), case.value("height") - radius
    restitution = truth.spring_dashpot_restitution(ratio)
    times = np.array(case.values("steps")) * case.value("timestep")
    scenario = ball_over_floor(case, drop, times[-1], restitution, radius)
    timestep = case.value("timestep") / 20
    trajectory = engine.run(scenario, spring(engine, scenario, timestep, stiffness, LEAST_IMPEDANCE))
    at, speed = np.rint(times / timestep).astype(int), truth.impact_speed(drop, gravity)
    after, gap, leaving = _let_go(speed, stiffness, ratio, gravity)
    flown = np.maximum(times - truth.fall_time(drop, gravity) - after, 0.0)
    theory = radius + gap + leaving * flown - gravity * flown**2 / 2, leaving - gravity * flown
    near = truth.coarse_contact(restitution, stiffness, timestep) * speed
    found = (trajectory.position("ball")[at, 2], trajectory.velocity("ball")[at, 2])
    return {
        "position": _without_pull(case, "position", found[0], theory[0], near * flown),
        "velocity": _without_pull(case, "velocity", found[1][1:], theory[1][1:], np.full(2, near)),
    }


def _let_go(speed: float, stiffness: float, ratio: float, gravity: float) -> tuple[float, float, float]:
    """When, s, where (gap, m) and how fast (m/s) a ball leaves a spring with a dashpot that never pulls.

    From the rest depth g/k on, x = −g/k + exp(−ζ ω t) (a cos νt + b sin νt) with x(0) = 0 and ẋ(0) = −v. It leaves when
    the force per mass, −ω² x − 2 ζ ω ẋ, is zero, which it is once within six tenths of a swing.
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

    low, high = 0.0, 1.2 * math.pi / swing
    for _ in range(100):
        middle = (low + high) / 2
        place, velocity = state(middle)
        pushes = -stiffness * place - 2 * decay * velocity > 0
        low, high = (middle, high) if pushes else (low, middle)
    return low, *state(low)


def _without_pull(case: Published, figure: str, found: Array, theory: Array, near: Array) -> Answer:
    """Where the ball has been in the contact: what theory makes of a dashpot that never pulls."""
    shift = np.where(near > 0, theory - np.array(case.expected[figure]), 0.0)
    reason = "its contact never pulls: with the same dashpot the ball comes back with 0.902 of its speed, not 0.9"
    return Answer(tuple(found.tolist()), None, "", tuple(shift.tolist()), reason, tuple(near.tolist()))
