"""What a method that resolves impacts at the step does to a bounce: bounds on it, and the bounce itself step by step.

Such a method falls by semi-implicit Euler. It sees the floor at a depth d, which is between 0 and v dt, and lands there
with v²/(2g) = h + d − v dt/2. The impact takes back a share c of the overlap, turns back a share w of the g dt that its
step has added, and gives a share r of the overlap back as speed: see `Method`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference import truth
from reference.arrays import Array
from reference.engines.base import EXACT, Method


def why_late(timestep: float) -> str:
    """Why bounces may be off, with a timestep in s."""
    return f"each impact is met up to a step of {1e3 * timestep:g} ms late; what overlaps of up to v dt do, summed up"


@dataclass(frozen=True)
class Bounce:
    """A dropped ball.

    drop: the gap, m. gravity: m/s². timestep: of the engine that steps through the bounce, s.
    """

    drop: float
    restitution: float
    gravity: float
    timestep: float

    @property
    def speed(self) -> float:
        """Speed of the first impact, m/s."""
        return truth.impact_speed(self.drop, self.gravity)


def apexes_off(bounce: Bounce, method: Method, count: int) -> tuple[float, ...]:
    """By how much the first apexes may be off, m.

    The rebound starts at −(1 − c) d, and its steps rise by u²/(2g) + u dt/2 with u = e v + w e g dt. In all the apex is
    off by e v dt (1 − e)/2 + w e² v dt for d = 0, and by −(1 − c − e/2 − e²/2) v dt + w e² v dt for d = v dt. A share r
    of d as speed, r d/dt, adds up to 2 e r h; a softness s costs 2 e (1 + e) s h. The next apex takes over e² of the
    error of the one before it.
    """
    if method.kind == EXACT:
        return (0.0,) * count
    e, overlap, height, off, found = bounce.restitution, bounce.speed * bounce.timestep, bounce.drop, 0.0, []
    for _ in range(count):
        at_once = (e - e * e) / 2 + method.weighed * e * e
        at_last = at_once - (1 - method.recovery - e * e)
        share = 2 * e * (method.speed_recovery + (1 + e) * method.softness)
        off = e * e * off + max(abs(at_once), abs(at_last)) * overlap + share * height
        off += 2 * bounce.gravity * bounce.timestep**2  # terms of second order in the step
        found.append(off)
        overlap, height = e * overlap, e * e * height
    return tuple(found)


def times_off(bounce: Bounce, method: Method, count: int) -> tuple[float, ...]:
    """By how much the first impacts may be off, s.

    Semi-implicit Euler moves on a parabola that is faster by g dt/2 than its own velocity as it rises, and falls dt/2
    too soon. A ball that meets the floor at v is seen s late, 0 ≤ s ≤ dt, at v + g (s − dt/2). It leaves with e times
    that, and w e g dt, on a parabola that is faster by g dt/2, and is out of the overlap (1 − c) s/e later. There it is
    faster than e v by g dt ((1 − e)/2 + w e) + g s (e − (1 − c)/e), and its flight is longer by 2/g of that. To this
    are added shares r of v as speed and (1 + e) of a softness, e times the error that v had before, and terms of
    second order, g dt²/(e v).
    """
    if method.kind == EXACT:
        return (0.0,) * count
    e, g, dt, landing = bounce.restitution, bounce.gravity, bounce.timestep, bounce.speed
    out, weighed = (1 - method.recovery) / e, method.weighed
    span = np.array([-1.0, 1.0])  # from the least to the most
    time, speed, found = np.full(2, -dt / 2), np.zeros(2), []
    for _ in range(count):
        found.append(float(np.max(np.abs(time))))
        gained = np.array([-(1 + e) * method.softness, method.speed_recovery]) * landing
        # s + (1 − c) s/e until it is out, and 2/g of its speed there
        time = time + 2 * (e * speed + gained) / g + dt * (1 - e + 2 * weighed * e + _reach(1 + 2 * e - out))
        time += span * g * dt**2 / (e * landing)
        speed = e * speed + gained + g * dt * ((1 - e) / 2 + weighed * e + _reach(e - out))
        landing *= e
    return tuple(found)


def _reach(slope: float) -> Array:
    """Least and most of slope·s for 0 ≤ s ≤ 1, (2,)."""
    return np.array([min(slope, 0.0), max(slope, 0.0)])


def end_off(bounce: Bounce, method: Method, least_speed: float) -> float:
    """By how much the end of all bounces may be off, s: what is slower than `least_speed`, m/s, counts as rest.

    The bounces from a speed u on last 2u/g (1 + e + e² + …). Those slower than the method's own speed of rest are
    missing, and those shorter than four steps, u < 2 g dt, are lost in the overlap.
    """
    if method.kind == EXACT:
        return 0.0
    slowest = max(method.rest_speed, 2 * bounce.gravity * bounce.timestep, least_speed)
    impacts = math.ceil(math.log(slowest / bounce.speed) / math.log(bounce.restitution))
    return 2 * slowest / (bounce.gravity * (1 - bounce.restitution)) + times_off(bounce, method, impacts)[-1]


def stepped(
    bounce: Bounce, answer: Callable[[float], float], steps: int, lift: float = 0.0
) -> list[tuple[float, float]]:
    """Gap, m, and velocity, m/s, before each step and after the last: a step resolves an impact or lets the ball fall.

    answer: velocity before the impact → velocity after. lift: how much of the overlap an impact takes back at most, m.
    """
    gap, velocity, states = bounce.drop, 0.0, [(bounce.drop, 0.0)]
    for _ in range(steps):
        strikes = gap <= 0 and velocity < 0
        velocity = answer(velocity) if strikes else velocity - bounce.gravity * bounce.timestep
        gap += velocity * bounce.timestep + (min(-gap, lift) if strikes else 0.0)
        states.append((gap, velocity))
    return states
