"""What a test at the ends of steps does not see (slides 2 and 9).

The functions say when within a step a ball overlaps a slab, how many balls a
test at each step misses, and how many substeps miss none.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative


def overlap_interval(
    distance: ArrayLike,
    normal_velocity: ArrayLike,
    radius: ArrayLike,
    thickness: ArrayLike,
    dt: ArrayLike,
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
    radius : (...), r, m; 0 for a point
    thickness : (...), w, m
        Infinity for the half-space behind a plane, 0 for a sheet.
    dt : (...), s, length of the step

    Returns
    -------
    start, end : (...), s from now, 0 ≤ start ≤ end ≤ Δt
        Infinity and −infinity, an empty interval, where the ball and the slab
        do not meet. A ball that overlaps already starts at 0. A ball that
        moves with the slab or along it overlaps for the whole step or not at
        all. A ball that only touches, at the first or the last instant of the
        step, has start = end.

    Raises
    ------
    ValueError
        If distance or normal_velocity is not finite, or radius, thickness or
        dt is negative.

    Notes
    -----
    At time t the centre is at x + u t. The ball overlaps the slab while the
    centre is at most r before the front face and at most r behind the back
    face, which is at −w:

        −(w + r) ≤ x + u t ≤ r,  0 ≤ t ≤ Δt

    A test at the ends of the step sees two instants of this interval, or none
    of it.
    """
    x = finite("distance", distance)
    u = finite("normal_velocity", normal_velocity)
    r = not_negative("radius", radius)
    w = not_negative("thickness", thickness)
    dt = not_negative("dt", dt)
    moves = u != 0
    at_front = (r - x) / np.where(moves, u, 1.0)
    at_back = (-(w + r) - x) / np.where(moves, u, 1.0)
    inside = (-(w + r) <= x) & (x <= r)
    first = np.where(moves, np.minimum(at_front, at_back), 0.0)
    at_rest = np.where(inside, np.inf, -np.inf)
    last = np.where(moves, np.maximum(at_front, at_back), at_rest)
    start, end = np.maximum(first, 0.0), np.minimum(last, dt)
    meets = start <= end
    return np.where(meets, start, np.inf), np.where(meets, end, -np.inf)


def missing_probability(
    speed: ArrayLike,
    thickness: ArrayLike,
    radius: ArrayLike,
    dt: ArrayLike,
) -> Array:
    """Share of the balls that a test at each step misses (slide 9).

    This is temporal aliasing. Every phase of the tests is equally likely.

    Parameters
    ----------
    speed : (...), v, along the normal of the wall, m/s
    thickness, radius : (...), w and r, m
    dt : (...), s, between two tests

    Returns
    -------
    (...), 0 to 1
        0 for a ball that does not move, because it cannot pass the wall. 1 for
        a moving point against a sheet.

    Raises
    ------
    ValueError
        If an argument is negative, or speed or dt is not finite.

    Notes
    -----
    A ball overlaps the wall while its centre travels a distance of w + 2r, and
    it moves v Δt between two tests. As every phase of the tests is equally
    likely, a test falls within the overlap with the probability
    (w + 2r)/(v Δt), and certainly where this ratio exceeds 1. The share that
    is missed is

        P = max(0, 1 − (w + 2r)/(v Δt))

    These are the balls whose overlap no test notices. How many of the noticed
    balls an engine then turns back is a different question.
    """
    speed = finite("speed", not_negative("speed", speed))
    dt = finite("dt", not_negative("dt", dt))
    thickness = not_negative("thickness", thickness)
    radius = not_negative("radius", radius)
    way, caught = speed * dt, thickness + 2 * radius
    missed = 1 - caught / np.where(way > 0, way, 1.0)
    return np.where(way > caught, missed, 0.0)
