"""A corner against a face and an edge against an edge, while every point moves in a straight line (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import positive
from solutions.sweeping.advancement import TOLERANCE, Pairs, advance, flat, free_time
from solutions.sweeping.motion import in_space
from solutions.sweeping.nearest import nearest_on_triangle, triangles

Array = NDArray[np.float64]


def vertex_face_impact(
    vertex_0: ArrayLike,
    triangle_0: ArrayLike,
    vertex_1: ArrayLike,
    triangle_1: ArrayLike,
    tolerance: ArrayLike = TOLERANCE,
) -> Array:
    """When within a step a point meets a triangle, while all four points move in straight lines (slide 10).

    The four are coplanar at the roots of a cubic, and where all lie in one plane all the time it vanishes and says
    nothing. Conservative advancement needs no root: it follows the triangle of the differences vertex − corner.

    Parameters
    ----------
    vertex_0, vertex_1 : (..., 3), at the start and the end of the step, m
    triangle_0, triangle_1 : (..., 3, 3), three corners, m; without area it is a segment or a point
    tolerance : (...), how near is a touch, m. Below 1e-8 of the coordinates rounding blurs the direction from which the
        point comes, and the time gets no nearer to the true one: it stays early

    Returns
    -------
    (...), share of the step, 0 to 1; infinity where they stay apart. Never later than the true contact; at the time
    given they are at most the tolerance apart (after 1000 rounds of a very slow approach it is earlier still). What
    comes as near as the tolerance may count as a hit, what hits is never missed. 0 if they touch now, even if they
    part.

    Raises
    ------
    ValueError
        If tolerance is not positive, or an array is not finite or not in space.
    """
    start = in_space("vertex_0", vertex_0)[..., None, :] - triangles("triangle_0", triangle_0)
    end = in_space("vertex_1", vertex_1)[..., None, :] - triangles("triangle_1", triangle_1)
    return _first_contact(start, end, positive("tolerance", tolerance))


def edge_edge_impact(
    edge_a_0: ArrayLike, edge_b_0: ArrayLike, edge_a_1: ArrayLike, edge_b_1: ArrayLike, tolerance: ArrayLike = TOLERANCE
) -> Array:
    """When within a step two edges meet, while all four ends move in straight lines (slide 10).

    The differences of two edges fill a parallelogram, two triangles; they are followed as in `vertex_face_impact`.

    Parameters
    ----------
    edge_a_0, edge_b_0 : (..., 2, 3), both ends at the start of the step, m; they may be parallel, or without length
    edge_a_1, edge_b_1 : (..., 2, 3), at its end, m
    tolerance : (...), how near is a touch, m

    Returns
    -------
    (...), share of the step, as for `vertex_face_impact`

    Raises
    ------
    ValueError
        If tolerance is not positive, or an array is not finite or not two points in space.
    """
    start = _edge("edge_a_0", edge_a_0)[..., :, None, :] - _edge("edge_b_0", edge_b_0)[..., None, :, :]
    end = _edge("edge_a_1", edge_a_1)[..., :, None, :] - _edge("edge_b_1", edge_b_1)[..., None, :, :]
    tolerance = positive("tolerance", tolerance)
    start, end = start.reshape(*start.shape[:-3], 4, 3), end.reshape(*end.shape[:-3], 4, 3)
    return _first_contact(start, end, tolerance)


def _first_contact(start: Array, end: Array, tolerance: Array) -> Array:
    """Share of a step at which triangles, or parallelograms, of moving corners first reach the origin."""
    shape = np.broadcast_shapes(start.shape[:-2], end.shape[:-2], tolerance.shape)
    near, place = flat(tolerance, shape), flat(start, shape, start.shape[-2:])
    motion = flat(end, shape, end.shape[-2:]) - place

    def look(pairs: Pairs, time: Array) -> tuple[Array, Array]:
        corners = place[pairs] + time[:, None, None] * motion[pairs]
        normal = _towards(corners)
        heights = np.vecdot(corners, normal[:, None, :])
        closing = -np.vecdot(motion[pairs], normal[:, None, :])
        return heights.min(axis=-1), free_time(heights - near[pairs, None] / 2, closing).min(axis=-1)

    return advance(look, np.ones(near.shape), near).reshape(shape)


def _towards(corners: Array) -> Array:
    """Unit vectors from the origin to the nearest point of triangles, or of parallelograms 00, 01, 10, 11."""
    faces = corners[:, None, :, :] if corners.shape[-2] == 3 else corners[:, [[0, 1, 2], [1, 2, 3]], :]
    nearest = (nearest_on_triangle(np.zeros(3), faces)[..., None, :] @ faces)[..., 0, :]
    distance = np.linalg.norm(nearest, axis=-1)
    best = np.argmin(distance, axis=-1)[:, None]
    length = np.take_along_axis(distance, best, axis=-1)
    nearest = np.take_along_axis(nearest, best[..., None], axis=-2)[:, 0, :]
    return np.asarray(nearest / np.where(length > 0, length, 1.0))


def _edge(name: str, value: ArrayLike) -> Array:
    ends = in_space(name, value)
    if ends.shape[-2:] != (2, 3):
        raise ValueError(f"{name} must have shape (..., 2, 3), not {ends.shape}")
    return ends
