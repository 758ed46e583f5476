"""Rays against Minkowski sums, for bodies that translate (slide 10)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import FiniteNotNegative, Vector, domain
from solutions.sweeping.domain import Extents
from solutions.vectors import quotient


@domain
def ray_sphere(
    origin: Vector, direction: Vector, radius: FiniteNotNegative
) -> Array:
    """First time at which a ray is inside or on a sphere around the origin.

    At the time t ≥ 0 the ray is at x + u t.

    Parameters
    ----------
    origin : (..., 3), x, where the ray starts, from the sphere's centre, m
    direction : (..., 3), u, of any length
        It sets the unit of t: seconds if u is a velocity, a share of the
        motion if u is a whole motion.
    radius : (...), r, m; 0 for a point

    Returns
    -------
    (...), t
        It is 0 from within and from the surface, whichever way the ray goes.
        It is infinity for a miss, and where the ray has no direction. A ray
        that grazes the sphere meets it; within rounding of that, rounding
        decides.

    Notes
    -----
    A ray that starts outside can meet the sphere only if it approaches it,
    which means x·u < 0. It is on the sphere where x + u t has the length r.
    Squared, with x² for x·x, this is a quadratic equation for t:

        u² t² + 2 x·u t + x² − r² = 0

    A quarter of its discriminant is (x·u)² − u² (x² − r²). Lagrange's identity

        (x·u)² = x² u² − (x × u)²

    turns it into r² u² − (x × u)². The ray misses the sphere where this is
    negative. Otherwise the smaller root is where the ray enters,

        t = (−x·u − √(r² u² − (x × u)²))/u²
          = (x² − r²)/(−x·u + √(r² u² − (x × u)²))

    The second line follows if the first is multiplied and divided by
    −x·u + √(…). The function uses the second line, because both terms of its
    denominator are positive. It computes x² − r² as (‖x‖ − r)(‖x‖ + r). So no
    two nearly equal roots or squares are subtracted.
    """
    x, u = origin, direction
    distance = np.sqrt(np.vecdot(x, x))
    # From within, the size of the sphere does not matter.
    r = np.minimum(radius, distance)
    closing, across = -np.vecdot(x, u), np.cross(x, u)
    quarter = r**2 * np.vecdot(u, u) - np.vecdot(across, across)
    meets = (closing > 0) & (quarter >= 0)
    root = np.sqrt(np.where(meets, quarter, 0.0))
    # For a miss the denominator is 0, and so the time is infinite.
    denominator = np.where(meets, closing + root, 0.0)
    time = quotient((distance - r) * (distance + r), denominator, np.inf)
    return np.where(distance <= radius, 0.0, time)


@domain
def ray_capsule(
    origin: Vector,
    direction: Vector,
    start: Vector,
    end: Vector,
    radius: FiniteNotNegative,
) -> Array:
    """First time at which a ray is within a radius of a segment.

    This shape is a capsule: a cylinder with a half ball at either end. At the
    time t ≥ 0 the ray is at x + u t.

    Parameters
    ----------
    origin : (..., 3), x, where the ray starts, m
    direction : (..., 3), u, of any length; it sets the unit of t
    start, end : (..., 3), the ends of the segment, m
        Where they are one point, the capsule is a sphere.
    radius : (...), r, m; 0 for the bare segment

    Returns
    -------
    (...), t
        It is 0 from within and from the surface, and infinity for a miss. A
        ray along the segment meets an end. A ray that grazes the capsule
        meets it; within rounding of that, rounding decides.

    Notes
    -----
    Seen along the segment, the cylinder is a circle. In this view the ray is
    one against a sphere, so the parts of x and u across the segment go to
    `ray_sphere`. With d for the segment, from start to end, and x measured
    from its start, they are

        x_across = x − (x·d/d²) d
        u_across = u − (u·d/d²) d

    The time that `ray_sphere` gives counts if the ray is then between the two
    ends of the segment: at a share of d from 0 to 1, which is x·d/d² at first
    and grows at the rate u·d/d². The ends themselves are spheres. The result
    is the first of these three times.
    """
    u, d = direction, end - start
    x, x_from_end = origin - start, origin - end
    length_squared = np.vecdot(d, d)
    share = quotient(np.vecdot(x, d), length_squared)
    share_rate = quotient(np.vecdot(u, d), length_squared)
    x_across = x - share[..., None] * d
    u_across = u - share_rate[..., None] * d
    time_side = ray_sphere(x_across, u_across, radius)
    finite_time = np.where(np.isfinite(time_side), time_side, 0.0)
    share_there = share + share_rate * finite_time
    between_ends = (share_there >= 0) & (share_there <= 1)
    time_side = np.where(between_ends, time_side, np.inf)
    time_start = ray_sphere(x, u, radius)
    time_end = ray_sphere(x_from_end, u, radius)
    return np.minimum(time_side, np.minimum(time_start, time_end))


@domain
def ray_box(
    origin: Vector, direction: Vector, half_extents: Extents
) -> tuple[Array, Array]:
    """From when to when a ray is in a box around the origin: the slab test.

    The edges of the box are along the axes. At the time t ≥ 0 the ray is at
    x + u t.

    Parameters
    ----------
    origin : (..., 3), x, where the ray starts, from the box's centre, m
    direction : (..., 3), u, of any length; it sets the unit of t
    half_extents : (..., 3), h, half the edges, m, not negative
        An edge may be 0: the box is then a sheet, a segment or a point.

    Returns
    -------
    entry, exit : (...), 0 ≤ entry ≤ exit
        From within, entry is 0. The box is closed: a ray that grazes a corner
        has entry = exit, within rounding, and a ray that glides along a face
        is in the box. Without a direction, the ray is in the box from 0 to
        infinity, or never. A miss is an empty interval: entry is infinity and
        exit is −infinity.

    Notes
    -----
    A slab is the space between two parallel faces, |x + u t| ≤ h along one
    axis. Where u > 0, the ray is in it from (−x − h)/u to (−x + h)/u. The box
    is what its three slabs have in common. So the ray is in the box from the
    last time at which it enters a slab until the first time at which it leaves
    one.
    """
    first, last = time_between(origin, direction, half_extents)
    return in_all(first, last)


def time_between(x: Array, u: Array, h: Array) -> tuple[Array, Array]:
    """The times, negative ones too, at which |x + u t| ≤ h begins and ends.

    They are infinity and −infinity where it never holds.
    """
    to_middle = -x * np.sign(u)
    # A ray along the slab is in it from −infinity to infinity, or never.
    without_end = np.where(np.abs(x) <= h, np.inf, -np.inf)
    first = quotient(to_middle - h, np.abs(u), -without_end)
    last = quotient(to_middle + h, np.abs(u), without_end)
    return first, last


def in_all(first: Array, last: Array) -> tuple[Array, Array]:
    """What intervals along the last axis have in common from time 0 on.

    It is infinity and −infinity if they have nothing in common.
    """
    entry = np.maximum(np.max(first, axis=-1), 0.0)
    leaving = np.min(last, axis=-1)
    meets = entry <= leaving
    return np.where(meets, entry, np.inf), np.where(meets, leaving, -np.inf)
