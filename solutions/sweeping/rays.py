"""A ray against a Minkowski sum: what a relative translation comes down to (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.sweeping.motion import extent, in_space

Array = NDArray[np.float64]


def ray_sphere(origin: ArrayLike, direction: ArrayLike, radius: ArrayLike) -> Array:
    """First t ≥ 0 at which x + u t is inside or on a sphere about the coordinates' origin.

        t = (x² − r²)/(−x·u + √(r² u² − (x × u)²))    if x·u < 0

    The root is written so that no two nearly equal numbers are subtracted.

    Parameters
    ----------
    origin : (..., 3), x, where the ray starts, from the sphere's centre, m
    direction : (..., 3), u, of any length: t counts in it, s for a velocity, a share for a way
    radius : (...), r, m; 0 for a point

    Returns
    -------
    (...); 0 from within and from the surface, whichever way the ray goes; infinity for a miss, and without a direction.
    A ray that grazes the sphere meets it; within rounding of that, rounding decides.

    Raises
    ------
    ValueError
        If radius is negative, an argument is not finite, or a vector not in space.
    """
    x, u, r = in_space("origin", origin), in_space("direction", direction), extent("radius", radius)
    distance, closing = np.linalg.norm(x, axis=-1), -np.vecdot(x, u)
    discriminant = r**2 * np.vecdot(u, u) - np.sum(np.cross(x, u) ** 2, axis=-1)
    meets = (closing > 0) & (discriminant >= 0)
    root = np.sqrt(np.where(meets, discriminant, 0.0))
    with np.errstate(over="ignore"):  # at a crawl it gets there after any number of seconds: infinity will do
        time = (distance - r) * (distance + r) / np.where(meets, closing + root, 1.0)
    return np.where(distance <= r, 0.0, np.where(meets, time, np.inf))


def ray_capsule(origin: ArrayLike, direction: ArrayLike, start: ArrayLike, end: ArrayLike, radius: ArrayLike) -> Array:
    """First t ≥ 0 at which x + u t is within r of a segment: a cylinder with a half ball at either end.

    The cylinder is a circle for whoever looks along the segment: there the ray is one against a sphere, and counts if
    it arrives between the two ends. The ends are spheres.

    Parameters
    ----------
    origin, direction : (..., 3), x in m and u, as for `ray_sphere`
    start, end : (..., 3), the ends of the segment, m; where they are one point, it is a sphere
    radius : (...), r, m; 0 for the bare segment

    Returns
    -------
    (...); 0 from within and from the surface; infinity for a miss. A ray along the segment meets an end.

    Raises
    ------
    ValueError
        If radius is negative, an argument is not finite, or a vector not in space.
    """
    x, u = in_space("origin", origin), in_space("direction", direction)
    a, b = in_space("start", start), in_space("end", end)
    along = b - a
    squared = np.vecdot(along, along)
    scale = np.where(squared > 0, squared, 1.0)
    place, rate = np.vecdot(x - a, along) / scale, np.vecdot(u, along) / scale
    side = ray_sphere(x - a - place[..., None] * along, u - rate[..., None] * along, radius)
    there = place + rate * np.where(np.isfinite(side), side, 0.0)
    side = np.where((there >= 0) & (there <= 1), side, np.inf)
    return np.minimum(side, np.minimum(ray_sphere(x - a, u, radius), ray_sphere(x - b, u, radius)))


def time_between(place: Array, rate: Array, half: Array) -> tuple[Array, Array]:
    """Give the times, negative ones too, at which |x + u t| ≤ h begins and ends; infinity and −infinity for never."""
    moves = rate != 0
    speed = np.where(moves, np.abs(rate), 1.0)
    with np.errstate(over="ignore"):  # as in `ray_sphere`
        middle, sign = -place * np.sign(rate), np.where(np.abs(place) <= half, 1.0, -1.0)
        first, last = (middle - half) / speed, (middle + half) / speed
    return np.where(moves, first, -sign * np.inf), np.where(moves, last, sign * np.inf)


def ray_box(origin: ArrayLike, direction: ArrayLike, half_extents: ArrayLike) -> tuple[Array, Array]:
    """From when to when x + u t is in a box about the coordinates' origin, along the axes: the slab test.

    A box is what three slabs have in common. The ray is in it from the last time that it enters a slab until the first
    time that it leaves one.

    Parameters
    ----------
    origin : (..., 3), x, from the box's centre, m
    direction : (..., 3), u, of any length
    half_extents : (..., 3), half the edges, m; 0 for a sheet, a segment or a point

    Returns
    -------
    entry, exit : (...), 0 ≤ entry ≤ exit; infinity and −infinity, an empty interval, for a miss. The box is closed: a
    ray that grazes a corner has entry = exit, one that glides along a face is in it. From within, entry is 0. Without
    a direction it is all times or none.

    Raises
    ------
    ValueError
        If half_extents is negative, or a vector is not finite or not in space.
    """
    x, u = in_space("origin", origin), in_space("direction", direction)
    half = extent("half_extents", in_space("half_extents", half_extents))
    return in_all(*time_between(x, u, half))


def in_all(first: Array, last: Array) -> tuple[Array, Array]:
    """Give what intervals along the last axis have in common from time 0 on; infinity and −infinity for nothing."""
    entry, leaving = np.maximum(np.max(first, axis=-1), 0.0), np.min(last, axis=-1)
    meets = (entry <= leaving) & (entry < np.inf)
    return np.where(meets, entry, np.inf), np.where(meets, leaving, -np.inf)
