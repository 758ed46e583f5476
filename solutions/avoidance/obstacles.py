"""Fixed obstacles: a force field that repels, and steering to the tangent point of a sphere (slide 1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.avoidance.directions import in_space, to_the_left, unit_or_zero
from solutions.checks import not_negative, positive, unit

Array = NDArray[np.float64]
HEAD_ON = 1e-9
"""A wish whose part across the way is smaller than this share of it names no side: rounding must not choose."""


def repelling_force(separation: ArrayLike, normal: ArrayLike, strength: ArrayLike, reach: ArrayLike) -> Array:
    """Force of a field around an obstacle of any shape, which falls smoothly to zero at its reach (slide 1).

        F = F0 (1 − s/R)² n    for 0 ≤ s < R,    zero beyond,    F0 n inside the obstacle

    The slide only says "force fields". Three things no such field can do. It lets nobody fly along a wall: within the
    reach it pushes off. Met head-on it pushes straight back, with no part to the side: a body that is drawn to a goal
    behind the obstacle stops where the two forces balance. And the forces of two obstacles cancel between them.

    Parameters
    ----------
    separation : (...), s, m, from the obstacle's surface, negative inside
    normal : (..., 3), n, unit, away from the obstacle
    strength : (...), F0, N, the force at the surface, not negative
    reach : (...), R, m, positive

    Returns
    -------
    (..., 3), N

    Raises
    ------
    ValueError
        If a normal has not length 1, a strength is negative or a reach is not positive.
    """
    return _field(separation, unit("normal", normal), strength, reach)


def sphere_force(
    position: ArrayLike, centre: ArrayLike, radius: ArrayLike, strength: ArrayLike, reach: ArrayLike
) -> Array:
    """Force of the field around a sphere: `repelling_force` with s = ‖p − c‖ − r, away from the centre (slide 1).

    Parameters
    ----------
    position, centre : (..., 3), m
    radius : (...), m, not negative
    strength : (...), N, at the surface and inside, not negative
    reach : (...), m, from the surface, positive

    Returns
    -------
    (..., 3), N; zero exactly at the centre, where no direction is away.

    Raises
    ------
    ValueError
        If a radius or a strength is negative, a reach is not positive, or a place is not finite or not in space.
    """
    away = in_space("position", position) - in_space("centre", centre)
    separation = np.linalg.norm(away, axis=-1) - not_negative("radius", radius)
    return _field(separation, unit_or_zero(away), strength, reach)


def tangent_point(position: ArrayLike, heading: ArrayLike, centre: ArrayLike, radius: ArrayLike) -> Array:
    """Point where a line from the position touches a bounding sphere, on the side of the heading (slide 1).

    With the distance L to the centre, the way to the tangent point is k = √(L² − r²). It lies t = r²/L short of the
    centre and s = √(r² − t²) to the side. Here s is written r k/L, which is the same and keeps its digits near the
    sphere.

    Parameters
    ----------
    position, centre : (..., 3), m
    heading : (..., 3), any length; its part across the line to the centre chooses the side
    radius : (...), r, m, positive

    Returns
    -------
    (..., 3), m. Where the heading names no side (head-on, straight away, zero): the left as seen from above, or +x
    if the centre is straight above or below. From inside there is no tangent: the nearest point of the surface, and
    from the centre itself the top of the sphere.

    Raises
    ------
    ValueError
        If a radius is not positive, or a vector is not finite or not in space.
    """
    p, c, r = in_space("position", position), in_space("centre", centre), positive("radius", radius)
    towards = unit_or_zero(c - p)
    distance, way = _distance_and_way(c - p, r)
    outside = distance >= r
    length = np.where(outside, distance, 1.0)
    short = np.where(outside, r * r / length, r)[..., None]
    aside = np.where(outside, r * way / length, 0.0)[..., None]
    side = _side(towards, in_space("heading", heading))
    at_centre = (distance == 0)[..., None]
    return np.where(at_centre, c + r[..., None] * np.array([0.0, 0.0, 1.0]), c - short * towards + aside * side)


def is_in_the_way(position: ArrayLike, goal: ArrayLike, centre: ArrayLike, radius: ArrayLike) -> NDArray[np.bool_]:
    """Whether the straight way from a position to a goal goes through a sphere (slide 1).

    A sphere behind the position or beyond the goal is not in the way, nor is one that the way only touches.

    Parameters
    ----------
    position, goal, centre : (..., 3), m
    radius : (...), m, positive

    Returns
    -------
    (...), bool; at the goal: whether that is inside the sphere

    Raises
    ------
    ValueError
        If a radius is not positive, or a vector is not finite or not in space.
    """
    p, c = in_space("position", position), in_space("centre", centre)
    way = in_space("goal", goal) - p
    squared = np.sum(way * way, axis=-1)
    share = np.clip(np.sum((c - p) * way, axis=-1) / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    nearest = p + share[..., None] * way
    return np.asarray(np.linalg.norm(nearest - c, axis=-1) < positive("radius", radius))


def steer_around(
    position: ArrayLike, velocity: ArrayLike, goal: ArrayLike, centre: ArrayLike, radius: ArrayLike
) -> Array:
    """Direction to fly: to the goal, or to the tangent point of a bounding sphere that is in the way (slide 1).

    The tangent makes an angle with the line to the centre whose sine is r/L and whose cosine is k/L:

        d = (k/L) towards the centre + (r/L) to the side

    The side is the one nearer to the velocity; where that names none (head-on, at rest) the one nearer to the goal;
    then the left as seen from above.

    Parameters
    ----------
    position, goal, centre : (..., 3), m
    velocity : (..., 3), m/s
    radius : (...), r, m, positive: of the obstacle together with the flier

    Returns
    -------
    (..., 3), unit; inside the sphere straight out, from its centre to the goal. Zero at the goal. A goal inside the
    sphere is never reached: the flier circles it.

    Raises
    ------
    ValueError
        If a radius is not positive, or a vector is not finite or not in space.
    """
    p, c, r = in_space("position", position), in_space("centre", centre), positive("radius", radius)
    to_goal = in_space("goal", goal) - p
    straight, towards = unit_or_zero(to_goal), unit_or_zero(c - p)
    distance, way = _distance_and_way(c - p, r)
    length = np.maximum(distance, r)
    side = _side(towards, in_space("velocity", velocity), to_goal)
    tangent = (way / length)[..., None] * towards + (r / length)[..., None] * side
    inside = ((distance < r) & (distance > 0))[..., None]
    turns = (is_in_the_way(p, goal, c, r) & (distance > 0))[..., None]
    return np.where(inside, -towards, np.where(turns, tangent, straight))


def _field(separation: ArrayLike, normal: Array, strength: ArrayLike, reach: ArrayLike) -> Array:
    s, limit = np.asarray(separation, dtype=float), positive("reach", reach)
    nearness = np.clip(1 - s / limit, 0.0, 1.0)
    return np.asarray((not_negative("strength", strength) * nearness**2)[..., None] * normal)


def _distance_and_way(to_centre: Array, radius: Array) -> tuple[Array, Array]:
    """L and k = √(L² − r²), as a product so that no two nearly equal squares are subtracted; 0 inside."""
    distance = np.asarray(np.linalg.norm(to_centre, axis=-1))
    return distance, np.sqrt(np.maximum(distance - radius, 0.0) * (distance + radius))


def _side(towards: Array, *wishes: Array) -> Array:
    """Unit vector across the line to the centre, on the side of the first wish that names one."""
    side = to_the_left(towards)
    for wish in reversed(wishes):
        across = _across(_across(wish, towards), towards)  # twice: once leaves the rounding of a long wish
        named = np.linalg.norm(across, axis=-1) > HEAD_ON * np.linalg.norm(wish, axis=-1)
        side = np.where(named[..., None], unit_or_zero(across), side)
    return side


def _across(vector: Array, direction: Array) -> Array:
    return np.asarray(vector - np.sum(vector * direction, axis=-1, keepdims=True) * direction)
