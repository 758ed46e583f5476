"""Coulomb's friction step by step along a straight line: how speed and slip change, one stretch of steps after another.

While a body slips, or while it grips, the same happens in every step, so a whole stretch is one sum. `pull` is what the
weight adds to the speed in a step, m/s. Impulses are per mass, in m/s.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from reference.arrays import Array


def by_limits(
    speed: float, pull: float, limits: Array, ease: float = 1.0, softness: float = 0.0, static: float = 1.0
) -> tuple[Array, Array]:
    """Speed of a body and slip of its contact after each step, (steps + 1,), m/s; at the start both are `speed`.

    limits: (steps,), μ times the normal impulse of each step. ease: how many times as much an impulse changes the slip
    as it changes the speed; 1 for a body that does not turn. An impulse of (slip + pull)/ease would end the slip.
    Friction is 1/(1 + softness) of that impulse, which leaves some slip, or the limit where that is less. static: how
    many times as much as the limit friction may be where it ends the slip.
    """
    steps, done = len(limits), 0
    speeds, slips = np.full(steps + 1, speed), np.full(steps + 1, speed)
    while done < steps:
        count: Array = np.arange(1.0, steps - done + 1)
        slip, most = float(slips[done]), limits[done:]
        ended = static * ease * (1 + softness) * most  # the largest slip that friction can end
        way = math.copysign(1.0, slip + pull)
        slipping = abs(slip + pull) > ended[0]
        if slipping:
            after = slip + count * pull - way * ease * np.cumsum(most, dtype=np.float64)
        else:
            left = pull * softness  # a step leaves softness/(1 + softness) of slip + pull; in the end that is as much
            after = left + (softness / (1 + softness)) ** count * (slip - left)
        before = np.concatenate([[slip], after[:-1]]) + pull
        alike = way * before > ended if slipping else np.abs(before) <= ended
        taken = len(alike) if alike.all() else int(np.argmin(alike))
        now = slice(done + 1, done + taken + 1)
        slips[now] = after[:taken]
        # Friction has taken slip + count pull − after from the slip, and 1/ease of that from the speed.
        speeds[now] = speeds[done] + (count * pull - (slip + count * pull - after) / ease)[:taken]
        done += taken
    return speeds, slips


def by_arms(
    speed: float, pull: float, limits: Array, arms: Array, gyration: float, softness: float = 0.0, static: float = 1.0
) -> tuple[Array, Array]:
    """As `by_limits`, of a ball whose arm changes while it sinks in: each impulse turns it by the arm of its own step.

    arms: (steps + 1,), m, after each step. gyration: I/m of the ball, m².
    """
    turning = 0.0  # rad/s, forwards
    speeds, slips = [speed], [speed]
    for most, arm, after in zip(limits.tolist(), arms[:-1].tolist(), arms[1:].tolist(), strict=True):
        impulse = (speed + pull - arm * turning) / ((1 + arm**2 / gyration) * (1 + softness))
        if abs(impulse) > static * most:
            impulse = math.copysign(most, impulse)
        speed, turning = speed + pull - impulse, turning + impulse * arm / gyration
        speeds.append(speed)
        slips.append(speed - after * turning)
    return np.array(speeds), np.array(slips)


def by_hand(speed: float, pull: float, static: float, kinetic: float, steps: int) -> Array:
    """Speed after each step, (steps + 1,), m/s, as the lecture's friction makes it: against the velocity before it.

    A body at rest stays there as long as the pull is no larger than `static`, μ_s times the weight's impulse on the
    plane. `kinetic` is the same with μ_k. Friction stops a body and does not turn it back.
    """
    speeds, done = np.zeros(steps + 1), 0
    speeds[0] = speed
    while done < steps and (speed != 0 or abs(pull) > static):
        way = math.copysign(1.0, speed or pull)
        after = speed + np.arange(1, steps - done + 1) * (pull - way * kinetic)
        turned = way * after <= 0
        taken = int(np.argmax(turned)) if turned.any() else len(after)
        speeds[done + 1 : done + taken + 1] = after[:taken]
        done, speed = done + taken + 1, 0.0
    return speeds


def step_by_step(
    pull: Callable[[int, float], float],
    limits: Array,
    dt: float,
    speed: float = 0.0,
    ease: float = 1.0,
    softness: float = 0.0,
    static: float = 1.0,
) -> tuple[Array, Array]:
    """As `by_limits`, where the pull changes: pull(number of the step, way so far in m) → m/s in that step."""
    slip, way = speed, 0.0
    speeds, slips = [speed], [slip]
    for number, most in enumerate(limits.tolist()):
        added = pull(number, way)
        impulse = (slip + added) / (ease * (1 + softness))
        if abs(impulse) > static * most:
            impulse = math.copysign(most, impulse)
        speed, slip = speed + added - impulse, slip + added - ease * impulse
        way += speed * dt
        speeds.append(speed)
        slips.append(slip)
    return np.array(speeds), np.array(slips)


def step_by_step_by_hand(
    pull: Callable[[int, float], float], static: float, kinetic: float, steps: int, dt: float, speed: float = 0.0
) -> Array:
    """As `by_hand`, where the pull changes in the same way."""
    way, speeds = 0.0, [speed]
    for number in range(steps):
        added = pull(number, way)
        if speed == 0 and abs(added) <= static:
            after = 0.0
        else:
            after = speed + added - math.copysign(kinetic, speed or added)
            after = 0.0 if after * speed < 0 else after  # friction stops a body and does not turn it back
        speed = after
        way += speed * dt
        speeds.append(speed)
    return np.array(speeds)
