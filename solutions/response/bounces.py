"""Every bounce within a step, until the body is at rest (slide 3)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.detection import signed_distance, time_of_impact_exact
from solutions.domain import (
    Finite,
    NotNegative,
    Share,
    Unit,
    Vector,
    domain,
)
from solutions.forces import ballistic_motion
from solutions.vectors import quotient


@domain
def time_until_rest(
    separation: Finite,
    normal_velocity: Finite,
    normal_acceleration: Finite,
    restitution: Share,
) -> Array:
    """Time until a bouncing body lies on the plane for good (slide 3).

    The body makes infinitely many impacts in a finite time.

    Parameters
    ----------
    separation : (...), s, m; below zero counts as zero
    normal_velocity : (...), u, m/s, positive when moving away
    normal_acceleration : (...), a, m/s², negative towards the plane
    restitution : (...), e, 0 to 1

    Returns
    -------
    (...), s from now
        Infinity where e = 1 and the body moves, where it never arrives, and
        where no acceleration brings it back after a bounce; an a > 0 pulls it
        off in the end. 0 where the body lies on the plane already. The time
        t₁ of the first impact where e = 0.

    Notes
    -----
    The body arrives for the first time at t₁, with the speed

        w = √(u² − 2 a s)

    Each impact multiplies the speed by e, so that the body leaves impact n
    with the speed w eⁿ. It takes the time w eⁿ/|a| to turn round and the same
    time to come back, and so the flight after impact n lasts 2 w eⁿ/|a|. All
    flights together are a geometric series:

        t₁ + (2 w/|a|) (e + e² + …) = t₁ + (2 w/|a|) e/(1 − e)
                                    = t₁ + 2 e w/(|a| (1 − e))

    For a body that falls from rest t₁ = w/|a|, and the sum is
    t₁ (1 + e)/(1 − e).
    """
    s = np.maximum(separation, 0.0)
    u, a = normal_velocity, normal_acceleration
    rebound = restitution * _arrival_speed(s, u, a)
    # |a| is −a, because only a < 0 brings the body back.
    flights = quotient(2 * rebound, -a * (1 - restitution), np.inf)
    flights = np.where(rebound > 0, flights, 0.0)
    until_rest = time_of_impact_exact(s, u, a) + flights
    lies = (s == 0) & (u == 0) & (a <= 0)
    return np.where(lies, 0.0, np.where(a > 0, np.inf, until_rest))


@domain
def bounce_along_normal(
    separation: Finite,
    normal_velocity: Finite,
    normal_acceleration: Finite,
    restitution: Share,
    dt: NotNegative,
    most_impacts: int = 1000,
) -> tuple[Array, Array, Array, Array]:
    """Motion along the normal over a step with any number of impacts, exactly.

    Parameters
    ----------
    separation : (...), s, m; below zero counts as zero
    normal_velocity : (...), u, m/s, positive when moving away
    normal_acceleration : (...), a, m/s², negative towards the plane
    restitution : (...), e, 0 to 1
    dt : (...), s, length of the step, not negative
    most_impacts : int, how many rounds at most

    Returns
    -------
    separation, normal_velocity : (...), m and m/s, at the end of the step
    impacts : (...), how many
        Infinity where the body came to rest by bouncing, 1 where e = 0 stopped
        it at its first impact, 0 where it lay on the plane from the start.
    time_left : (...), s
        0 where the step is done. Where the rounds did not suffice, the part of
        the step that remains after the last impact, so that the caller may
        continue from there.

    Notes
    -----
    Each round goes to the next impact and turns the arrival speed w into e w,
    until the step has no further impact. A body that comes to rest within the
    step makes infinitely many impacts (Zeno's paradox), and no number of
    rounds would reach their end. Where `time_until_rest` says that this end
    lies within the step, the function puts the body on the plane, at rest,
    without a round.
    """
    s, u, a, e, left = np.broadcast_arrays(
        np.maximum(separation, 0.0),
        normal_velocity,
        normal_acceleration,
        restitution,
        dt,
    )
    rests = time_until_rest(s, u, a, e) <= left
    lay = (s == 0) & (u == 0)
    impacts = np.where(rests & ~lay, np.where(e > 0, np.inf, 1.0), 0.0)
    s, u, left = (np.where(rests, 0.0, value) for value in (s, u, left))
    moving = np.array(~rests)
    for _ in range(most_impacts):
        time = time_of_impact_exact(s[moving], u[moving], a[moving])
        struck = time <= left[moving]
        if not struck.any():
            break
        # Of those that moved, the ones not struck meet the plane no more.
        moving[moving] = struck
        u[moving] = e[moving] * _arrival_speed(s[moving], u[moving], a[moving])
        s[moving] = 0.0
        left[moving] -= time[struck]
        impacts[moving] += 1
    due = time_of_impact_exact(s, u, a) <= left  # the rounds did not suffice
    flight = np.where(due, 0.0, left)
    s = np.maximum(s + u * flight + a * flight * flight / 2, 0.0)
    return s, u + a * flight, impacts, left - flight


@domain
def bounce_through_step(
    position: Vector,
    velocity: Vector,
    acceleration: Vector,
    normal: Unit,
    offset: Finite,
    restitution: Share,
    dt: NotNegative,
    most_impacts: int = 1000,
) -> tuple[Array, Array, Array, Array]:
    """State after a step in which every collision is resolved at its instant.

    The collisions are those with the plane n·p + d = 0.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
        At the start of the step.
    normal : (..., 3), n, unit, out of the plane
    offset : (...), d, m
    restitution : (...), e, 0 to 1
    dt : (...), s, length of the step, not negative
    most_impacts : int, how many rounds at most

    Returns
    -------
    position, velocity : (..., 3) each, m and m/s
        A body that came to rest lies on the plane and continues to slide
        along it.
    impacts : (...), how many, as in bounce_along_normal
    time_left : (...), s, as in bounce_along_normal

    Notes
    -----
    Let p_f and v_f be where the body would be without the plane, and how fast,
    and s_f its separation there. Without friction an impact does not change
    the motion along the plane, which is the free one throughout. The motion
    along the normal is that of `bounce_along_normal`, which gives the
    separation s and the velocity u. So

        p = p_f + (s − s_f) n
        v = v_f + (u − v_f·n) n
    """
    separation, u, impacts, left = bounce_along_normal(
        signed_distance(position, normal, offset),
        np.vecdot(velocity, normal),
        np.vecdot(acceleration, normal),
        restitution,
        dt,
        most_impacts,
    )
    # The free motion over the time that is done, p_f and v_f
    p, v = ballistic_motion(position, velocity, acceleration, dt - left)
    # What the plane adds to it along the normal
    lift = separation - signed_distance(p, normal, offset)
    kick = u - np.vecdot(v, normal)
    p = p + lift[..., None] * normal
    return p, v + kick[..., None] * normal, impacts, left


def _arrival_speed(
    separation: Array, normal_velocity: Array, normal_acceleration: Array
) -> Array:
    """Speed √(u² − 2 a s) at which a body meets the plane, m/s.

    0 where it does not meet it.
    """
    u, a, s = normal_velocity, normal_acceleration, separation
    return np.sqrt(np.maximum(u * u - 2 * a * s, 0.0))
