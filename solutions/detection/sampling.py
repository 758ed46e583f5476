"""What a test at the ends of steps sees of a collision (slides 2 and 9)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import Finite, FiniteNotNegative, NotNegative, domain
from solutions.vectors import quotient


@domain
def overlap_interval(
    distance: Finite,
    normal_velocity: Finite,
    radius: NotNegative,
    thickness: NotNegative,
    dt: NotNegative,
) -> tuple[Array, Array]:
    """When within a step a ball overlaps a slab (slide 2).

    This is the continuous test. The ball moves at constant velocity. Touching
    counts as overlapping, so that the interval includes both of its ends.

    Parameters
    ----------
    distance : (...), x, m
        Of the centre from the slab's front face, positive before it.
    normal_velocity : (...), u, m/s
        Velocity of the ball relative to the slab, along the normal of the
        front face.
    radius : (...), r, m, not negative; 0 for a point
    thickness : (...), w, m, not negative
        Infinity for the half-space behind a plane, 0 for a sheet.
    dt : (...), Δt, s, length of the step, not negative

    Returns
    -------
    start, end : (...), s from now, 0 ≤ start ≤ end ≤ Δt
        Infinity and −infinity, an empty interval, where the ball and the slab
        do not meet. A ball that overlaps already starts at 0. A ball that
        moves with the slab or along it overlaps for the whole step or not at
        all. A ball that only touches, at the first or the last instant of the
        step, has start = end.

    Notes
    -----
    At time t the centre is at x + u t. The ball overlaps the slab while the
    centre is at most r before the front face and at most r behind the back
    face, which is at −w:

        −(w + r) ≤ x + u t ≤ r,  0 ≤ t ≤ Δt

    A test at the ends of the step sees two instants of this interval, or none
    of it.
    """
    x, u, r, w = distance, normal_velocity, radius, thickness
    inside = (-(w + r) <= x) & (x <= r)
    # When the centre is r before the front face and r behind the back face.
    # A ball with u = 0 overlaps from −∞ to ∞, or at no time.
    time_at_front = quotient(r - x, u, np.where(inside, np.inf, -np.inf))
    time_at_back = quotient(-(w + r) - x, u, -np.inf)
    start = np.maximum(np.minimum(time_at_front, time_at_back), 0.0)
    end = np.minimum(np.maximum(time_at_front, time_at_back), dt)
    meets = start <= end
    return np.where(meets, start, np.inf), np.where(meets, end, -np.inf)


@domain
def missing_probability(
    speed: FiniteNotNegative,
    thickness: NotNegative,
    radius: NotNegative,
    dt: FiniteNotNegative,
) -> Array:
    """Share of the balls that a test at each step misses (slide 9).

    This is temporal aliasing. Every phase of the tests is equally likely.

    Parameters
    ----------
    speed : (...), v, along the normal of the wall, m/s, not negative
    thickness, radius : (...), w and r, m, not negative
    dt : (...), Δt, s, between two tests, not negative

    Returns
    -------
    (...), 0 to 1
        0 for a ball that does not move, because it cannot pass the wall. 1 for
        a moving point against a sheet.

    Notes
    -----
    A ball overlaps the wall while its centre travels a distance of w + 2r, and
    it moves v Δt between two tests. As every phase of the tests is equally
    likely, a test falls within the overlap with the probability

        (w + 2r)/(v Δt)

    and certainly where this ratio exceeds 1. The share that is missed is

        P = max(0, 1 − (w + 2r)/(v Δt))

    These are the balls whose overlap no test notices. How many of the noticed
    balls an engine then turns back is a different question.
    """
    overlap = thickness + 2 * radius
    moved = speed * dt
    # A ball that does not move is never missed.
    return np.maximum(0.0, 1 - quotient(overlap, moved, 1.0))
