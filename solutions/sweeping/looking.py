"""What looks now and then miss, and looks that miss nothing (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import (
    finite,
    in_space,
    not_negative,
    of_shape,
    positive,
    whole,
)
from solutions.sweeping.motion import extent, motion_bound, rotated
from solutions.sweeping.nearest import point_set, separation_of_hulls


def missed_share(
    speed: ArrayLike, radius_a: ArrayLike, radius_b: ArrayLike, dt: ArrayLike
) -> Array:
    """Share of the collisions of two balls that one look per step misses.

    The balls pass through each other unhindered. They meet at a random offset:
    the line along which A moves, as seen from B, crosses every part of the
    disk of radius r_A + r_B around B equally often. Every phase of the looks
    is equally likely.

    Parameters
    ----------
    speed : (...), v, of A relative to B, m/s
    radius_a, radius_b : (...), m; 0 for a point
    dt : (...), s, between two looks

    Returns
    -------
    (...), 0 to 1
        0 where speed or dt is 0, also for two points. 1 for two points
        otherwise.

    Raises
    ------
    ValueError
        If an argument is negative or not finite.

    Notes
    -----
    Between two looks A moves D = v Δt. A passes B at the offset b < R, where
    R = r_A + r_B. It then overlaps B along a chord of the length

        c = 2 √(R² − b²)

    A look falls on the chord with the probability c/D, and certainly where
    c ≥ D. The offsets within b are π b² of all π R². With c² = 4 (R² − b²),
    the share of the chords shorter than c is therefore c²/4R², and the share
    of those between c and c + dc is c dc/2R². Chords shorter than D can be
    missed, each with the probability 1 − c/D. For D ≤ 2R the share missed is

        ∫₀ᴰ (1 − c/D) c dc/2R² = D²/12R²

    A longer step can miss every chord, also the longest one of 2R. The
    integral then ends at 2R, and its value is

        1 − 4R/3D
    """
    speed, dt = extent("speed", speed), extent("dt", dt)
    radius = extent("radius_a", radius_a) + extent("radius_b", radius_b)
    way = speed * dt
    few = (way / np.where(radius > 0, radius, 1.0)) ** 2 / 12
    many = 1 - 4 / 3 * radius / np.where(way > 0, way, 1.0)
    return np.where(way <= 2 * radius, few, many)


def advance(
    points_a: ArrayLike,
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    angular_velocity_a: ArrayLike,
    points_b: ArrayLike,
    dt: ArrayLike,
    tolerance: ArrayLike,
    looks: int,
) -> tuple[float, int]:
    """Time at which a hull that moves and turns first touches one that rests.

    This is conservative advancement, for one pair of hulls.

    Parameters
    ----------
    points_a : (n, 3), corners of A, m
        They are measured from the point about which A turns, along the axes of
        the world, at the start of the step.
    position_a : (3,), the point about which A turns, m
    velocity_a : (3,), of that point, m/s, constant over the step
    angular_velocity_a : (3,), rad/s, constant over the step
    points_b : (m, 3), corners of B, which rests, as places in the world, m
    dt : s, finite, length of the step
    tolerance : m, above 0; hulls at most so far apart count as touching
    looks : whole number, at least 1; how often the separation may be measured

    Returns
    -------
    time : s from now, 0 to dt
        It is never later than the true contact, and the hulls are then at most
        the tolerance apart. It is 0 if they touch or overlap now, and infinity
        where they stay apart over the step. It is NaN where all looks are used
        up before it is decided whether the hulls touch. The last look may
        still decide that they stay apart, by the time to which the clock
        then advances.
    used : how often the separation was measured, from 1 to looks
        The first look is at the start of the step. After each one the clock
        advances as far as the separation and the `motion_bound` of all of A
        allow, whose reach is that of A's farthest corner. No look is taken
        after dt; one at dt is.

    Raises
    ------
    ValueError
        If dt is negative, tolerance is not positive, looks is not a whole
        number from 1, a hull has no points, or an array is not finite or does
        not have the shape above.

    Notes
    -----
    The hulls are apart by s along a direction n from B to A. B rests, and no
    point of A moves along −n faster than the bound μ (`motion_bound`). The gap
    along n therefore shrinks by at most μ t in a time t, and the hulls surely
    stay apart for

        s/μ

    The loop advances the clock by this time, and looks again. If μ ≤ 0, no
    point of A ever comes nearer along n, and the hulls stay apart for ever.
    """
    corners = _one_hull("points_a", points_a)
    b = _one_hull("points_b", points_b)
    position = _one_vector("position_a", position_a)
    velocity = _one_vector("velocity_a", velocity_a)
    turn = _one_vector("angular_velocity_a", angular_velocity_a)
    end = finite("dt", not_negative("dt", dt))
    near = positive("tolerance", tolerance)
    most = int(finite("looks", positive("looks", whole("looks", looks))))
    reach = np.linalg.norm(corners, axis=-1).max()
    time = 0.0
    for used in range(1, most + 1):
        a = position + velocity * time + rotated(corners, turn * time)
        separation, normal = separation_of_hulls(a, b)
        if separation <= near:
            return time, used
        closing = motion_bound(velocity, turn, reach, -normal)
        time = time + float(separation / closing) if closing > 0 else np.inf
        if time > end:
            return np.inf, used
    return np.nan, most


def _one_hull(name: str, points: ArrayLike) -> Array:
    """Return the corners (n, 3) of one hull; refuse those of several."""
    corners = point_set(name, points)
    return of_shape(name, corners, (corners.shape[-2], 3))


def _one_vector(name: str, value: ArrayLike) -> Array:
    """Return one vector (3,); refuse several."""
    return of_shape(name, in_space(name, value), (3,))
