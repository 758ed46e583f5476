"""Bounces by hand: balls that fall on a floor, resolved at the instant of an impact, within its step or at its end."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import UP
from reference.published.case import Published

FIRST_REBOUND = 0.9
"""How long the drops of P6 are watched, s: they fall for 0.44 s, and rise again for 0.35 s at most."""


def elastic_balls(case: Published, code: Implementation) -> Answers:
    """P1: the mean squared error of the energy of balls whose impacts are resolved at the step, as in ODE and Bullet.

    On the step that resolves an impact ODE turns the velocity round as it is. Bullet adds the step's gravity first and
    turns the sum round.
    """
    ode, bullet = (
        tuple(_energy_error(case, code, dt, gravity_first) for dt in case.numbers("timesteps"))
        for gravity_first in (False, True)
    )
    return as_answers(ode=ode, bullet=bullet)


def _energy_error(case: Published, code: Implementation, dt: float, gravity_first: bool) -> float:
    """Mean of (E − E0)², J², with the energy E before each step of dt, s."""
    pull, left = -case.value("gravity") * UP, round(case.value("duration") / dt)
    respond = code.function("kinematic_response")
    z, v, energies = case.value("height") * UP, 0 * UP, []
    while left:
        places, speeds = _flight(code, z, v, pull, dt, left)
        struck = _touches(case, code, places) & (speeds[:, 2] < 0)
        steps = int(np.argmax(struck)) if struck.any() else left - 1
        energies.append(case.value("gravity") * places[: steps + 1, 2] + speeds[: steps + 1, 2] ** 2 / 2)
        v = respond(speeds[steps] + (pull * dt if gravity_first else 0.0), UP, 1.0)
        z, left = places[steps] + v * dt, left - steps - 1
    energy = case.value("balls") * case.value("mass") * np.concatenate(energies)
    return float(np.mean((energy - energy[0]) ** 2))


def _flight(code: Implementation, z: Array, v: Array, pull: Array, dt: float, steps: int) -> tuple[Array, Array]:
    """Position and velocity before each of so many steps v' = v + g dt, z' = z + v' dt, without a floor.

    The positions lie on the parabola that starts g dt/2 faster, so that all of them are found at once, and exactly.
    """
    times = dt * np.arange(steps)
    places, speeds = code.function("ballistic_motion")(z, v + pull * dt / 2, pull, times)
    return places, speeds - pull * dt / 2


def _touches(case: Published, code: Implementation, places: Array, slop: float = 0.0) -> Mask:
    """Whether a ball with its centre at these places is within `slop` of the floor, m."""
    gaps = code.function("signed_distance")(places, UP, -case.value("radius"))
    found: Mask = code.function("side_of_plane")(gaps, slop) <= 0
    return found


def thousand_steps(case: Published, code: Implementation) -> Answers:
    """P12: each step either resolves an impact or lets gravity act."""
    respond, step = code.function("kinematic_response"), code.function("semi_implicit_euler")
    dt, pull = case.value("timestep"), -case.value("gravity") * UP
    z, v = case.value("height") * UP, 0 * UP
    for _ in range(int(case.value("steps"))):
        if v[2] < 0 and _touches(case, code, z, case.value("slop")):
            v = respond(v, UP, case.value("restitution"))
            z = z + v * dt
        else:
            z, v = step(z, v, pull, dt)
    return as_answers(height=float(z[2]), velocity=float(v[2]))


def apexes(case: Published, code: Implementation) -> Answers:
    """P5: heights above the contact, from impact to impact."""
    height, radius, e, gravity = case.values("height", "radius", "restitution", "gravity")
    _, heights = _bounces(code, height - radius, e, gravity, len(case.expected_numbers("apexes")))
    return as_answers(apexes=heights)


def impacts_and_rest(case: Published, code: Implementation) -> Answers:
    """P15: from impact to impact, and the end of infinitely many."""
    height, e, gravity = case.values("height", "restitution", "gravity")
    impacts, heights = _bounces(code, height, e, gravity, len(case.expected_numbers("impacts")))
    rest = float(code.function("time_until_rest")(height, 0.0, -gravity, e))
    return as_answers(impacts=impacts, apexes=heights[: len(case.expected_numbers("apexes"))], rest=rest)


def rebounds(case: Published, code: Implementation) -> Answers:
    """P26: the first rebound of each ball."""
    drops = zip(case.numbers("drop"), case.numbers("restitution"), strict=True)
    both = [_bounces(code, drop, e, case.value("gravity"), 1) for drop, e in drops]
    return as_answers(rebound=tuple(height for _, (height,) in both))


def _bounces(
    code: Implementation, drop: float, restitution: float, gravity: float, count: int
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Instants, s, of the first impacts of a ball let go at a gap, m, and the apexes of the gap after them, m."""
    fall, fly = code.function("time_of_impact_exact"), code.function("ballistic_motion")
    respond = code.function("kinematic_response")
    z, v, pull, time, impacts, heights = drop * UP, 0 * UP, -gravity * UP, 0.0, [], []
    for _ in range(count):
        until = float(fall(z[2], v[2], -gravity))
        z, v = fly(z, v, pull, until)
        v, time = respond(v, UP, restitution), time + until
        impacts.append(time)
        heights.append(float(fly(z, v, pull, v[2] / gravity)[0][2]))
    return tuple(impacts), tuple(heights)


def first_rebound(case: Published, code: Implementation) -> Answers:
    """P6: drops with the case's timestep, each impact resolved within its step; the highest sample of the rebound."""
    dt, radius, height, e = *case.values("timestep", "radius", "height"), np.array(case.numbers("restitution"))
    step, pull = code.function("bounce_through_step"), -case.value("gravity") * UP
    z, v = np.tile(height * UP, (len(e), 1)), np.zeros((len(e), 3))
    bounced, highest = np.zeros(len(e), bool), np.zeros(len(e))
    for _ in range(round(FIRST_REBOUND / dt)):
        z, v, impacts, _ = step(z, v, pull, UP, -radius, e, dt)
        bounced |= impacts > 0
        highest = np.where(bounced, np.maximum(highest, z[:, 2] - radius), 0.0)
    return as_answers(ratio=tuple((highest / (height - radius)).tolist()))
