"""A ball that sweeps through a step, up to another body (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import finite, in_space
from solutions.detection import signed_distance
from solutions.scaling import (
    cross_product,
    in_moderate_units,
    in_unit,
    length_of,
)
from solutions.sweeping.motion import extent, relative_motion, within
from solutions.sweeping.nearest import nearest_on_triangle, triangles
from solutions.sweeping.rays import ray_capsule, ray_sphere


def sweep_sphere_sphere(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    radius_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    radius_b: ArrayLike,
    dt: ArrayLike,
) -> Array:
    """Time at which two balls first touch within a step (slide 10).

    Their velocities are constant.

    Parameters
    ----------
    position_a, position_b : (..., 3), centres, m
    velocity_a, velocity_b : (..., 3), m/s
    radius_a, radius_b : (...), m; 0 for a point
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    (...), s from now, 0 to dt
        It is 0 if the balls overlap or touch now, even if they part. It is
        infinity where they do not touch.

    Raises
    ------
    ValueError
        If a radius or dt is negative, a radius is infinite, or a vector is not
        finite or not of three components.

    Notes
    -----
    Two balls touch when their centres are r_A + r_B apart. So A may be shrunk
    to a point if B is grown by A's radius. The grown ball is the Minkowski sum
    of the two. Seen from B, the point moves along a straight line, and the
    question becomes one for `ray_sphere`.
    """
    position, velocity = relative_motion(
        position_a, velocity_a, position_b, velocity_b
    )
    radius = extent("radius_a", radius_a) + extent("radius_b", radius_b)
    return within(ray_sphere(position, velocity, radius), dt)


def sweep_sphere_plane(
    position: ArrayLike,
    velocity: ArrayLike,
    radius: ArrayLike,
    normal: ArrayLike,
    offset: ArrayLike,
    dt: ArrayLike,
) -> Array:
    """Time at which a ball touches the half-space behind a plane (slide 10).

    The plane is n·p + d = 0.

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
    (...), s from now, 0 to dt
        It is 0 for a ball that touches the plane or is behind it already,
        whichever way the ball moves. It is infinity where the ball does not
        touch, which includes a ball that moves along the plane.

    Raises
    ------
    ValueError
        If a normal is zero, radius or dt is negative, or another argument is
        not finite or not of three components.

    Notes
    -----
    Grown by the ball, the half-space ends r further out. The gap between the
    centre and this end is s − r, where s is the signed distance of the centre
    from the plane. The gap shrinks at the rate −u_n, where u_n is the velocity
    along n. It is used up after

        t = (s − r)/(−u_n)
    """
    x, u = in_space("position", position), in_space("velocity", velocity)
    n = in_space("normal", normal)
    gap = signed_distance(x, n, finite("offset", offset)) - extent(
        "radius", radius
    )
    closing = -signed_distance(u, n, 0.0)
    # At a crawl the time may be longer than any float: infinity stands for it.
    with np.errstate(over="ignore"):
        time = np.where(
            closing > 0, gap / np.where(closing > 0, closing, 1.0), np.inf
        )
    return within(np.where(gap <= 0, 0.0, time), dt)


def sweep_sphere_triangle(
    position: ArrayLike,
    velocity: ArrayLike,
    radius: ArrayLike,
    triangle: ArrayLike,
    dt: ArrayLike,
) -> Array:
    """Time at which a ball first touches a triangle within a step (slide 10).

    It may touch the face, an edge or a corner.

    Parameters
    ----------
    position : (..., 3), centre, m
    velocity : (..., 3), relative to the triangle, m/s
    radius : (...), m; 0 for a point
    triangle : (..., 3, 3), three corners, m
        It has no inside and no front. Without area it is a segment or a point.
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    (...), s from now, 0 to dt
        It is 0 if the ball overlaps or touches the triangle now, even if they
        part. It is infinity where the ball does not touch. A point, which is a
        ball of radius 0, never slips through the seam of two triangles.
        Rounding decides whether a point that moves in a triangle's plane meets
        the triangle's edge, and whether a point that goes through a corner
        meets any triangle there. `segment_triangle` is exact in these cases.

    Raises
    ------
    ValueError
        If radius or dt is negative, or another argument is not finite or not
        of three components.

    Notes
    -----
    Grown by the ball, the triangle is a plate of thickness 2r with round edges
    and corners. This plate consists of two faces, each r away from the
    triangle, and of three capsules around the edges. The centre of the ball
    moves along a ray. The first of these parts that the ray meets gives the
    time.
    """
    x = in_space("position", position)
    u = in_space("velocity", velocity)
    corners = triangles("triangle", triangle)
    r = extent("radius", radius)
    nearest = (nearest_on_triangle(x, corners)[..., None, :] @ corners)[
        ..., 0, :
    ]
    edges = ray_capsule(
        x[..., None, :],
        u[..., None, :],
        corners,
        np.roll(corners, -1, axis=-2),
        np.asarray(r)[..., None],
    )
    time = np.minimum(_face(x, u, r, corners), edges.min(axis=-1))
    return within(np.where(length_of(x - nearest) <= r, 0.0, time), dt)


def _face(x: Array, u: Array, r: Array, corners: Array) -> Array:
    """Time at which the ball lies on the face, between the edges.

    It is infinity where the ball meets the plane elsewhere.
    """
    a, b, c = corners[..., 0, :], corners[..., 1, :], corners[..., 2, :]
    normal, length = cross_product(b - a, c - a)
    normal = normal / np.where(length > 0, length, 1.0)[..., None]
    height = np.vecdot(normal, x - a)
    side = np.where(height < 0, -1.0, 1.0)
    closing = -side * np.vecdot(normal, u)
    arrives = (closing > 0) & (np.abs(height) >= r)
    with np.errstate(over="ignore"):  # as in `sweep_sphere_plane`
        time = np.where(
            arrives,
            (np.abs(height) - r) / np.where(arrives, closing, 1.0),
            np.inf,
        )
    lands = x - (side * r)[..., None] * normal  # the ball's foremost point
    passes = _same_turn(corners - lands[..., None, :], u)
    return np.where(passes, time, np.inf)


def _same_turn(corners: Array, u: Array) -> NDArray[np.bool_]:
    """Whether a line through the origin passes all sides with the same turn.

    A line that meets a side counts too. A side taken the other way round has
    exactly the opposite turn, rounding included. So a point that moves through
    the seam of two triangles never passes between them.
    """
    *_, metre = in_moderate_units(corners.reshape(*corners.shape[:-2], 9))
    corners, (u, *_) = in_unit(corners, metre, 2), in_moderate_units(u)
    following = np.roll(corners, -1, axis=-2)
    turn = np.vecdot(
        np.cross(corners + following, following - corners), u[..., None, :]
    )
    return np.asarray(np.all(turn >= 0, axis=-1) | np.all(turn <= 0, axis=-1))
