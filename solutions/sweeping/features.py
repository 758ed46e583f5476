"""Corner against face, edge against edge, in straight motion (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import in_space
from solutions.sweeping.nearest import nearest_weights, triangles
from solutions.sweeping.rounds import (
    Pairs,
    advance_all,
    flat,
    free_time,
    or_undecided,
    touching,
)

LOOKS_UNCUT = 40
"""Looks at a pair before it is cut into halves."""
SPLITS = 12
"""How often a pair is cut at most. What is undecided then remains so."""


def vertex_face_impact(
    vertex_0: ArrayLike,
    triangle_0: ArrayLike,
    vertex_1: ArrayLike,
    triangle_1: ArrayLike,
    tolerance: ArrayLike | None = None,
) -> Array:
    """Share of a step at which a point meets a moving triangle (slide 10).

    All four points move in straight lines.

    Parameters
    ----------
    vertex_0, vertex_1 : (..., 3), at the start and at the end of the step, m
    triangle_0, triangle_1 : (..., 3, 3), three corners at these times, m
        A triangle without area is a segment or a point.
    tolerance : (...), distance at which the point counts as touching, m
        Without it, it is a millionth of the triangle's size, which is the
        longest edge of the box along the axes around it. If it is below 1e-8
        of the coordinates, rounding blurs the direction from which the point
        comes. The time then gets no nearer to the true one: it stays early, or
        it is NaN.

    Returns
    -------
    (...), share of the step, 0 to 1
        It is never later than the true contact. At this time the two are at
        most the tolerance apart. It is infinity where they stay apart. A point
        that only comes as near as the tolerance may count as a hit, but a hit
        is never missed. It is 0 if they touch now, even if they part, and NaN
        where it could not be decided whether they touch.

    Warns
    -----
    UndecidedWarning
        If a share is NaN.

    Raises
    ------
    ValueError
        If tolerance is not positive, or an array is not finite or not of three
        components.

    Notes
    -----
    The usual way is to look for the times at which all four points are
    coplanar. These are the roots of a cubic. If the points lie in one plane
    all the time, the cubic vanishes and says nothing.

    Conservative advancement needs no root. Subtract each corner from the
    vertex: the differences are the corners of another triangle, which moves in
    straight lines too. The vertex is on the first triangle exactly when the
    origin is on this one. So the function follows this triangle until it
    reaches the origin.

    A triangle that turns while it approaches has corners that are faster than
    the point that will touch, and the free times become short. After 40 rounds
    the triangle is therefore cut into halves, which are followed on their own:
    the smaller a piece, the less its corners' velocities differ.
    """
    start = in_space("vertex_0", vertex_0)[..., None, :] - triangles(
        "triangle_0", triangle_0
    )
    end = in_space("vertex_1", vertex_1)[..., None, :] - triangles(
        "triangle_1", triangle_1
    )
    size = _size(triangles("triangle_0", triangle_0))
    time, undecided, shape = _first_contact(
        start, end, tolerance, np.zeros(()), size
    )
    return or_undecided(time, undecided).reshape(shape)


def edge_edge_impact(
    edge_a_0: ArrayLike,
    edge_b_0: ArrayLike,
    edge_a_1: ArrayLike,
    edge_b_1: ArrayLike,
    tolerance: ArrayLike | None = None,
) -> Array:
    """Share of a step at which two moving edges meet (slide 10).

    All four ends move in straight lines.

    Parameters
    ----------
    edge_a_0, edge_b_0 : (..., 2, 3), both ends at the start of the step, m
        The edges may be parallel, or without length.
    edge_a_1, edge_b_1 : (..., 2, 3), both ends at the end of the step, m
    tolerance : (...), distance at which two edges count as touching, m
        Without it, it is a millionth of the smaller edge's size.

    Returns
    -------
    (...), share of the step, 0 to 1
        As for `vertex_face_impact`: never late, infinity where they stay
        apart, 0 if they touch now, and NaN, with a warning, where it could not
        be decided.

    Raises
    ------
    ValueError
        If tolerance is not positive, or an array is not finite or not two
        points of three components.

    Notes
    -----
    The differences between a point of one edge and a point of the other fill a
    parallelogram. The edges meet when the origin is in it. The parallelogram
    is made of two triangles, and these are followed as in
    `vertex_face_impact`.
    """
    edge_a, edge_b = _edge("edge_a_0", edge_a_0), _edge("edge_b_0", edge_b_0)
    start = edge_a[..., :, None, :] - edge_b[..., None, :, :]
    end = (
        _edge("edge_a_1", edge_a_1)[..., :, None, :]
        - _edge("edge_b_1", edge_b_1)[..., None, :, :]
    )
    start = start.reshape(*start.shape[:-3], 4, 3)
    end = end.reshape(*end.shape[:-3], 4, 3)
    time, undecided, shape = _first_contact(
        start, end, tolerance, _size(edge_a), _size(edge_b)
    )
    return or_undecided(time, undecided).reshape(shape)


def _size(points: Array) -> Array:
    """Longest edge (...) of the box around points (..., n, 3), m."""
    return np.asarray(np.ptp(points, axis=-2).max(axis=-1))


def _first_contact(
    start: Array,
    end: Array,
    tolerance: ArrayLike | None,
    size_a: Array,
    size_b: Array,
) -> tuple[Array, NDArray[np.bool_], tuple[int, ...]]:
    """Share of a step at which moving triangles first reach the origin.

    It does the same for parallelograms. The sizes are those of the two
    features. The result also tells which pairs are undecided, and the shape of
    the arguments.
    """
    start, end = np.broadcast_arrays(start, end)
    given = np.asarray(0.0 if tolerance is None else tolerance)
    shape = np.broadcast_shapes(start.shape[:-2], given.shape)
    near = touching(
        tolerance,
        shape,
        flat(size_a, shape),
        flat(size_b, shape),
        flat(np.linalg.norm(start[..., 0, :], axis=-1), shape),
    )
    place = flat(start, shape, start.shape[-2:])
    motion = flat(end, shape, end.shape[-2:]) - place
    return *_follow(place, motion, near, np.zeros(near.shape), SPLITS), shape


def _follow(
    place: Array, motion: Array, near: Array, began: Array, splits: int
) -> tuple[Array, NDArray[np.bool_]]:
    """Shares of a step until which pieces surely stay away from the origin.

    The second array tells where it is undecided whether they reach it then.
    """

    def look(pairs: Pairs, time: Array) -> tuple[Array, Array]:
        corners = place[pairs] + time[:, None, None] * motion[pairs]
        normal = _towards(corners)
        heights = np.vecdot(corners, normal[:, None, :])
        closing = -np.vecdot(motion[pairs], normal[:, None, :])
        return heights.min(axis=-1), free_time(
            heights - near[pairs, None] / 2, closing
        ).min(axis=-1)

    time, undecided = advance_all(
        look, np.ones(near.shape), near, began, LOOKS_UNCUT
    )
    if splits and undecided.any():
        halves = _halves(place[undecided], motion[undecided])
        near_twice = np.tile(near[undecided], 2)
        time_twice = np.tile(time[undecided], 2)
        found = _follow(*halves, near_twice, time_twice, splits - 1)
        times, still_open = (value.reshape(2, -1) for value in found)
        first = np.argmin(times, axis=0)[None]
        time[undecided] = np.take_along_axis(times, first, axis=0)[0]
        undecided[undecided] = np.take_along_axis(still_open, first, axis=0)[0]
    return time, undecided


def _halves(place: Array, motion: Array) -> tuple[Array, Array]:
    """First all first halves of N pieces, then all second ones, with motion.

    Each piece is cut across the edge along which the velocities differ most.
    """
    orders = np.array(
        [[0, 1, 2], [1, 2, 0], [2, 0, 1]]
        if place.shape[1] == 3
        else [[0, 1, 2, 3], [0, 2, 1, 3]]
    )
    differences = np.linalg.norm(
        motion[:, orders[:, 1]] - motion[:, orders[:, 0]], axis=-1
    )
    order = orders[np.argmax(differences, axis=-1)][..., None]
    place, motion = (
        np.take_along_axis(points, order, axis=1) for points in (place, motion)
    )
    return _cut(place), _cut(motion)


def _cut(corners: Array) -> Array:
    """Cut triangles between corners 0 and 1, and others between 2 and 3."""
    first, second = corners.copy(), corners.copy()
    for start in range(0, corners.shape[1] - 1, 2):
        first[:, start + 1] = second[:, start] = corners[
            :, start : start + 2
        ].mean(axis=1)
    return np.concatenate([first, second])


def _towards(corners: Array) -> Array:
    """Unit vectors from the origin to the nearest point of each piece.

    A parallelogram has its corners in the order 00, 01, 10, 11.
    """
    faces = (
        corners[:, None, :, :]
        if corners.shape[-2] == 3
        else corners[:, [[0, 1, 2], [1, 2, 3]], :]
    )
    nearest = (
        nearest_weights(faces, faces, np.roll(faces, -1, axis=-2) - faces)[
            ..., None, :
        ]
        @ faces
    )[..., 0, :]
    distance = np.linalg.norm(nearest, axis=-1)
    best = np.argmin(distance, axis=-1)[:, None]
    length = np.take_along_axis(distance, best, axis=-1)
    nearest = np.take_along_axis(nearest, best[..., None], axis=-2)[:, 0, :]
    return np.asarray(nearest / np.where(length > 0, length, 1.0))


def _edge(name: str, value: ArrayLike) -> Array:
    ends = in_space(name, value)
    if ends.shape[-2:] != (2, 3):
        raise ValueError(
            f"{name} must have shape (..., 2, 3), not {ends.shape}"
        )
    return ends
