"""A corner against a face, an edge against an edge, in straight motion (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import in_space, positive
from solutions.scaling import in_moderate_units, in_unit, length_of
from solutions.sweeping.advancement import TOLERANCE, Pairs, advance, flat, free_time
from solutions.sweeping.nearest import nearest_weights, triangles


def vertex_face_impact(
    vertex_0: ArrayLike,
    triangle_0: ArrayLike,
    vertex_1: ArrayLike,
    triangle_1: ArrayLike,
    tolerance: ArrayLike = TOLERANCE,
) -> Array:
    """Share of a step at which a moving point meets a moving triangle (slide 10).

    All four points move in straight lines.

    Parameters
    ----------
    vertex_0, vertex_1 : (..., 3), at the start and at the end of the step, m
    triangle_0, triangle_1 : (..., 3, 3), three corners at these times, m
        A triangle without area is a segment or a point.
    tolerance : (...), distance at which the point counts as touching, m
        If it is below 1e-8 of the coordinates, rounding blurs the direction from which
        the point comes. The time then gets no nearer to the true one: it stays early.

    Returns
    -------
    (...), share of the step, 0 to 1
        It is never later than the true contact. At this time the two are at most the
        tolerance apart. If a very slow approach takes more than 1000 rounds, the time
        is earlier still. It is infinity where they stay apart. A point that only comes
        as near as the tolerance may count as a hit, but a hit is never missed. It is 0
        if they touch now, even if they part.

    Raises
    ------
    ValueError
        If tolerance is not positive, or an array is not finite or not of three
        components.

    Notes
    -----
    The usual way is to look for the times at which all four points are coplanar. These
    are the roots of a cubic. If the points lie in one plane all the time, the cubic
    vanishes and says nothing.

    Conservative advancement needs no root. Subtract each corner from the vertex: the
    differences are the corners of another triangle, which moves in straight lines too.
    The vertex is on the first triangle exactly when the origin is on this one. So the
    function follows this triangle until it reaches the origin.
    """
    start = in_space("vertex_0", vertex_0)[..., None, :] - triangles("triangle_0", triangle_0)
    end = in_space("vertex_1", vertex_1)[..., None, :] - triangles("triangle_1", triangle_1)
    return _first_contact(start, end, positive("tolerance", tolerance))


def edge_edge_impact(
    edge_a_0: ArrayLike,
    edge_b_0: ArrayLike,
    edge_a_1: ArrayLike,
    edge_b_1: ArrayLike,
    tolerance: ArrayLike = TOLERANCE,
) -> Array:
    """Share of a step at which two moving edges meet (slide 10).

    All four ends move in straight lines.

    Parameters
    ----------
    edge_a_0, edge_b_0 : (..., 2, 3), both ends at the start of the step, m
        The edges may be parallel, or without length.
    edge_a_1, edge_b_1 : (..., 2, 3), both ends at the end of the step, m
    tolerance : (...), distance at which two edges count as touching, m

    Returns
    -------
    (...), share of the step, 0 to 1
        As for `vertex_face_impact`: never late, infinity where they stay apart, and 0
        if they touch now.

    Raises
    ------
    ValueError
        If tolerance is not positive, or an array is not finite or not two points of
        three components.

    Notes
    -----
    The differences between a point of one edge and a point of the other fill a
    parallelogram. The edges meet when the origin is in it. The parallelogram is made of
    two triangles, and these are followed as in `vertex_face_impact`.
    """
    start = _edge("edge_a_0", edge_a_0)[..., :, None, :] - _edge("edge_b_0", edge_b_0)[..., None, :, :]
    end = _edge("edge_a_1", edge_a_1)[..., :, None, :] - _edge("edge_b_1", edge_b_1)[..., None, :, :]
    tolerance = positive("tolerance", tolerance)
    start, end = start.reshape(*start.shape[:-3], 4, 3), end.reshape(*end.shape[:-3], 4, 3)
    return _first_contact(start, end, tolerance)


def _first_contact(start: Array, end: Array, tolerance: Array) -> Array:
    """Share of a step at which moving triangles first reach the origin.

    It does the same for parallelograms.
    """
    start, end = np.broadcast_arrays(start, end)
    *_, metre = in_moderate_units(np.concatenate([start, end], axis=-2).reshape(*start.shape[:-2], -1))
    start, end, tolerance = in_unit(start, metre, 2), in_unit(end, metre, 2), tolerance / metre
    shape = np.broadcast_shapes(start.shape[:-2], tolerance.shape)
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
    """Unit vectors from the origin to the nearest point of triangles or parallelograms.

    A parallelogram has its corners in the order 00, 01, 10, 11.
    """
    faces = corners[:, None, :, :] if corners.shape[-2] == 3 else corners[:, [[0, 1, 2], [1, 2, 3]], :]
    nearest = (nearest_weights(faces, faces, np.roll(faces, -1, axis=-2) - faces)[..., None, :] @ faces)[..., 0, :]
    distance = length_of(nearest)
    best = np.argmin(distance, axis=-1)[:, None]
    length = np.take_along_axis(distance, best, axis=-1)
    nearest = np.take_along_axis(nearest, best[..., None], axis=-2)[:, 0, :]
    return np.asarray(nearest / np.where(length > 0, length, 1.0))


def _edge(name: str, value: ArrayLike) -> Array:
    ends = in_space(name, value)
    if ends.shape[-2:] != (2, 3):
        raise ValueError(f"{name} must have shape (..., 2, 3), not {ends.shape}")
    return ends
