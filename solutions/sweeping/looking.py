"""What looks now and then miss, and looks that miss nothing (slide 10)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import FiniteNotNegative, Positive, domain
from solutions.sweeping.domain import Looks, OneHull, OneVector
from solutions.sweeping.motion import motion_bound, rotated
from solutions.sweeping.nearest import separation_of_hulls
from solutions.vectors import quotient


@domain
def missed_share(
    speed: FiniteNotNegative,
    radius_a: FiniteNotNegative,
    radius_b: FiniteNotNegative,
    dt: FiniteNotNegative,
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

    Notes
    -----
    Between two looks A moves D = v Δt. A passes B at the offset b < R, where
    R = r_A + r_B. It then overlaps B along a chord of the length

        c = 2 √(R² − b²)

    A look falls on the chord with the probability c/D, and certainly where
    c ≥ D. The offsets within b are π b² of all π R². With c² = 4 (R² − b²),
    the share of the chords shorter than c is therefore c²/(4R²), and the share
    of those between c and c + dc is c dc/(2R²). Chords shorter than D can be
    missed, each with the probability 1 − c/D. For D ≤ 2R the share missed is

        ∫₀ᴰ (1 − c/D) c dc/(2R²) = D²/(12R²)

    A longer step can miss every chord, also the longest one of 2R. The
    integral then ends at 2R, and its value is

        1 − 4R/(3D)
    """
    radius = radius_a + radius_b
    moved = speed * dt
    of_short_step = quotient(moved, radius) ** 2 / 12
    of_long_step = 1 - quotient(4 / 3 * radius, moved)
    return np.where(moved <= 2 * radius, of_short_step, of_long_step)


@domain
def advance(
    points_a: OneHull,
    position_a: OneVector,
    velocity_a: OneVector,
    angular_velocity_a: OneVector,
    points_b: OneHull,
    dt: FiniteNotNegative,
    tolerance: Positive,
    looks: Looks,
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
    dt : one number, s, finite, length of the step
    tolerance : one number, m, above 0
        Hulls that are at most so far apart count as touching.
    looks : one whole number, at least 1
        It says how often the separation may be measured.

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
    reach = np.linalg.norm(points_a, axis=-1).max()
    time = 0.0
    for used in range(1, int(looks) + 1):
        turned = rotated(points_a, angular_velocity_a * time)
        a = position_a + velocity_a * time + turned
        separation, normal = separation_of_hulls(a, points_b)
        if separation <= tolerance:
            return time, used
        closing = motion_bound(velocity_a, angular_velocity_a, reach, -normal)
        if closing <= 0:
            return np.inf, used
        time = time + float(separation / closing)  # by s/μ
        if time > dt:
            return np.inf, used
    return np.nan, used
