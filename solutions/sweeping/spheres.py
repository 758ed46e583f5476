"""A ball that sweeps through a step, against a ball, a plane and a triangle (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite
from solutions.detection import signed_distance
from solutions.sweeping.motion import extent, in_space, relative_motion, within
from solutions.sweeping.nearest import nearest_on_triangle, triangles
from solutions.sweeping.rays import ray_capsule, ray_sphere

Array = NDArray[np.float64]


def sweep_sphere_sphere(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    radius_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    radius_b: ArrayLike,
    dt: ArrayLike,
) -> Array:
    """Time at which two balls at constant velocities first touch within a step (slide 10).

    Grown by A's radius, B is a ball of r_A + r_B, their Minkowski sum; A is then a point, and its way a ray.

    Parameters
    ----------
    position_a, position_b : (..., 3), centres, m
    velocity_a, velocity_b : (..., 3), m/s
    radius_a, radius_b : (...), m; 0 for a point
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    (...), s from now, 0 to dt; infinity where they do not touch. 0 if they overlap or touch now, even if they part.

    Raises
    ------
    ValueError
        If a radius or dt is negative, a radius is infinite, or a vector is not finite or not in space.
    """
    position, velocity = relative_motion(position_a, velocity_a, position_b, velocity_b)
    radius = extent("radius_a", radius_a) + extent("radius_b", radius_b)
    return within(ray_sphere(position, velocity, radius), dt)


def sweep_sphere_plane(
    position: ArrayLike, velocity: ArrayLike, radius: ArrayLike, normal: ArrayLike, offset: ArrayLike, dt: ArrayLike
) -> Array:
    """Time at which a ball first touches the half-space behind the plane n·p + d = 0 (slide 10).

    Grown by the ball, the half-space ends r further out: t = (s − r)/(−u_n), with the signed distance s.

    Parameters
    ----------
    position : (..., 3), centre, m
    velocity : (..., 3), relative to the plane, m/s
    radius : (...), r, m; 0 for a point
    normal : (..., 3), n, any length but zero
    offset : (...), d, m when n has unit length
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    (...), s from now, 0 to dt; infinity where it does not touch, so if it moves along the plane. 0 for one that touches
    or is behind the plane already, whichever way it moves.

    Raises
    ------
    ValueError
        If a normal is zero, radius or dt is negative, or another argument is not finite or not in space.
    """
    x, u = in_space("position", position), in_space("velocity", velocity)
    n = in_space("normal", normal)
    gap = signed_distance(x, n, finite("offset", offset)) - extent("radius", radius)
    closing = -signed_distance(u, n, 0.0)
    with np.errstate(over="ignore"):  # at a crawl it gets there after any number of seconds: infinity will do
        time = np.where(closing > 0, gap / np.where(closing > 0, closing, 1.0), np.inf)
    return within(np.where(gap <= 0, 0.0, time), dt)


def sweep_sphere_triangle(
    position: ArrayLike, velocity: ArrayLike, radius: ArrayLike, triangle: ArrayLike, dt: ArrayLike
) -> Array:
    """Time at which a ball first touches a triangle: with its face, an edge or a corner (slide 10).

    Grown by the ball, the triangle is a plate of thickness 2r with round edges and corners: two faces r away, and three
    capsules. What the ray of the centre meets first decides.

    Parameters
    ----------
    position : (..., 3), centre, m
    velocity : (..., 3), relative to the triangle, m/s
    radius : (...), m; 0 for a point
    triangle : (..., 3, 3), three corners, m; without area it is a segment or a point. It has no inside and no front
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    (...), s from now, 0 to dt; infinity where it does not touch. 0 if it overlaps or touches now, even if it parts. A
    point, radius 0, never slips through the seam of two triangles. Whether one that moves in a triangle's plane meets
    its edge, or one that goes through a corner meets any triangle there, rounding decides: `segment_triangle` is exact.

    Raises
    ------
    ValueError
        If radius or dt is negative, or another argument is not finite or not in space.
    """
    x, u, corners = in_space("position", position), in_space("velocity", velocity), triangles("triangle", triangle)
    r = extent("radius", radius)
    nearest = (nearest_on_triangle(x, corners)[..., None, :] @ corners)[..., 0, :]
    edges = ray_capsule(
        x[..., None, :], u[..., None, :], corners, np.roll(corners, -1, axis=-2), np.asarray(r)[..., None]
    )
    time = np.minimum(_face(x, u, r, corners), edges.min(axis=-1))
    return within(np.where(np.linalg.norm(x - nearest, axis=-1) <= r, 0.0, time), dt)


def _face(x: Array, u: Array, r: Array, corners: Array) -> Array:
    """Time at which the ball lies on the face between the edges; infinity where it meets the plane elsewhere."""
    a, b, c = corners[..., 0, :], corners[..., 1, :], corners[..., 2, :]
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=-1)
    normal = normal / np.where(length > 0, length, 1.0)[..., None]
    height = np.vecdot(normal, x - a)
    side = np.where(height < 0, -1.0, 1.0)
    closing = -side * np.vecdot(normal, u)
    arrives = (closing > 0) & (np.abs(height) >= r)
    with np.errstate(over="ignore"):  # as above
        time = np.where(arrives, (np.abs(height) - r) / np.where(arrives, closing, 1.0), np.inf)
    lands = x - (side * r)[..., None] * normal  # the ball's point that comes first
    passes = _same_turn(corners - lands[..., None, :], u)
    return np.where(passes, time, np.inf)


def _same_turn(corners: Array, u: Array) -> NDArray[np.bool_]:
    """Whether the line through the origin along u passes all three sides with the same turn, or meets one.

    A side taken the other way round has exactly the opposite turn, rounding included: a point that moves through the
    seam of two triangles never passes between them.
    """
    following = np.roll(corners, -1, axis=-2)
    turn = np.vecdot(np.cross(corners + following, following - corners), u[..., None, :])
    return np.asarray(np.all(turn >= 0, axis=-1) | np.all(turn <= 0, axis=-1))
