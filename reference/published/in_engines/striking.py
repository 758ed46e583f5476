"""Published impacts in the engines: their impulse and energy, two balls head-on, and measured oblique impacts."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from reference import truth
from reference.catalogue import measure
from reference.engines.base import Engine
from reference.published.answers import Answer, Answers, answer_within
from reference.published.case import Published
from reference.published.in_engines.at_step import Bounce, apexes_off, why_late
from reference.published.in_engines.scenes import AFTER_APEX, ball_over_floor, gravity_of, tuned
from reference.published.rigid_law import against_rigid_law
from reference.scene.scenario import Body, HalfSpace, Pair, Scenario, Sphere

ONE_STEP = "its impact lasts a step: a mean force needs a contact that lasts, and the 15 ms are not its own"
FLOOR = Body("floor", HalfSpace())
SHORT = 1e-6
"""Timestep of an oblique impact, s: a ball of 2.5 mm at 3.9 m/s overlaps the floor by up to 4 µm."""
OVERLAP = 1.6e-3
"""By how much that overlap shortens the lever arm, as a share of it."""
APPROACH = 100
"""Steps before an oblique impact."""
TOGETHER = 1e-5
"""Timestep of an impact on two balls at once, s: at 1 m/s, balls of 5 cm overlap by up to a ten-thousandth of that."""
FLIGHT = 0.05
"""How long two balls fly before and after their impact, s."""


def textbook_bounce(case: Published, engine: Engine) -> Answers:
    """P21, P22: impulse, energy and restitution, read from the flights before and after the impact."""
    drop, gravity, mass = case.value("height"), gravity_of(case), case.value("mass")
    e = math.sqrt(case.value("rebound") / drop) if "rebound" in case.setup else 1.0
    fall = truth.fall_time(drop, gravity)
    scenario = ball_over_floor(case, drop, (1 + e) * fall + AFTER_APEX, e, mass=mass)
    settings = tuned(engine, scenario)
    before, after, *_ = measure.flights(engine.run(scenario, settings), "ball", "floor")
    down, up = before.landing_speed, after.launch_speed
    (off,) = apexes_off(Bounce(drop, e, gravity, settings.timestep), engine.method(scenario, settings), 1)
    off_speed = gravity * off / up  # of u²/(2g)
    found = {
        "impulse": (mass * (down + up), mass * off_speed),
        "energy_change": (mass * (up**2 - down**2) / 2, mass * gravity * off),
        "restitution": (up / down, off_speed / down),
    }
    asked = {
        name: answer_within(case, name, *found[name], why_late(settings.timestep))
        for name in found
        if name in case.expected
    }
    return asked | {name: Answer(None, reason=ONE_STEP) for name in case.expected if name not in found}


def colliding_pair(case: Published, engine: Engine) -> Answers:
    """P27: two balls head-on, for each restitution: the ratio of the speeds after and before."""
    radius, speed, found = case.value("radius"), case.value("speed"), []
    for e in case.numbers("restitution"):
        balls = tuple(
            Body(
                name,
                Sphere(radius),
                1.0,
                (-way * (radius + speed * FLIGHT), 0.0, 0.0),
                velocity=(way * speed, 0.0, 0.0),
            )
            for name, way in (("left", 1.0), ("right", -1.0))
        )
        scenario = Scenario(case.name, balls, (Pair("left", "right", e),), 2 * FLIGHT, (0.0, 0.0, 0.0))
        velocities = engine.run(scenario, engine.settings(scenario, "tuned")).velocities[-1, :, 0]
        found.append(float(velocities[1] - velocities[0]) / (2 * speed))
    return {"restitution": Answer(tuple(found))}


def oblique_impacts(case: Published, engine: Engine) -> Answers:
    """P11: tangent restitutions and spins. Where a rigid ball grips, the measured one behaves differently."""
    restitution, _ = sweep(case, engine, case.numbers("angle"))
    _, spin = sweep(case, engine, case.numbers("angle_of_spin"))
    return against_rigid_law(case, restitution, spin, OVERLAP)


def sweep(case: Published, engine: Engine, angles: Sequence[float]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Tangent restitutions, and spins left, rad/s, of a ball that meets a floor at angles from the normal, degrees.

    There is no gravity: within 0.3 ms it would change nothing. The first gap is `APPROACH` steps wide.
    """
    scenarios = [_oblique(case, math.radians(angle)) for angle in angles]
    settings = engine.settings(scenarios[0], "tuned").change(timestep=SHORT, sample_every=APPROACH)
    ends = engine.run_many(scenarios, settings)
    along = [float(end.velocity("ball")[-1, 0] / end.velocity("ball")[0, 0]) for end in ends]
    return tuple(along), tuple(float(np.linalg.norm(end.angular_velocity("ball")[-1])) for end in ends)


def _oblique(case: Published, angle: float) -> Scenario:
    radius, speed = case.value("radius"), case.value("speed")
    velocity = (speed * math.sin(angle), 0.0, -speed * math.cos(angle))
    ball = Body("ball", Sphere(radius), 1e-3, (0.0, 0.0, radius - APPROACH * SHORT * velocity[2]), velocity=velocity)
    pair = Pair("ball", "floor", case.value("restitution"), case.value("friction"))
    return Scenario(case.name, (FLOOR, ball), (pair,), 3 * APPROACH * SHORT, (0.0, 0.0, 0.0))


def three_discs(case: Published, engine: Engine) -> Answers:
    """P37: three balls instead of discs, with their centres in one plane."""
    found, off = [], []
    for spread in case.numbers("spread"):
        scenario = _three_balls(case, spread)
        settings = engine.settings(scenario, "tuned").change(timestep=TOGETHER, sample_every=APPROACH)
        trajectory, method = engine.run(scenario, settings), engine.method(scenario, settings)
        found.append(float(trajectory.velocity("first")[-1, 0]))
        # the velocity changes with the spread by 8 η/(6 − η²)², and an overlap d makes η larger by up to η d/(2 r)
        overlap = case.value("speed") * TOGETHER / (2 * case.value("radius"))
        off.append(case.value("speed") * (8 * spread**2 / (6 - spread**2) ** 2 * overlap + 2 * method.softness))
    reason = "the balls overlap by up to v dt, and lean more to the side then; and what a softness takes"
    return {"velocity": answer_within(case, "velocity", tuple(found), tuple(off), reason)}


def _three_balls(case: Published, spread: float) -> Scenario:
    """A ball on its way to two others, whose centres are `spread` diameters apart."""
    radius, mass, speed = case.values("radius", "mass", "speed")
    ahead = 2 * radius * math.sqrt(1 - spread**2 / 4) + (APPROACH - 0.5) * TOGETHER * speed
    first = Body("first", Sphere(radius), mass, velocity=(speed, 0.0, 0.0))
    others = tuple(
        Body(name, Sphere(radius), mass, (ahead, side * spread * radius, 0.0))
        for name, side in (("left", 1.0), ("right", -1.0))
    )
    pairs = tuple(Pair("first", other.name, 1.0) for other in others)
    return Scenario(case.name, (first, *others), pairs, 2 * APPROACH * TOGETHER, (0.0, 0.0, 0.0))
