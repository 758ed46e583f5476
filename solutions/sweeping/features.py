"""Corner against face, edge against edge, in straight motion (slide 10)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans
from solutions.domain import Positive, Vector, domain
from solutions.sweeping.domain import Edge, Triangle
from solutions.sweeping.nearest import nearest_weights
from solutions.sweeping.rounds import (
    Pairs,
    advance_all,
    flat,
    free_time,
    or_undecided,
    touching,
)
from solutions.vectors import direction

LOOKS_UNCUT = 40
"""Looks at a pair before it is cut into halves."""
SPLITS = 12
"""How often a pair is cut at most. What is undecided then remains so."""


@domain
def vertex_face_impact(
    vertex_0: Vector,
    triangle_0: Triangle,
    vertex_1: Vector,
    triangle_1: Triangle,
    tolerance: Positive | None = None,
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
    start = vertex_0[..., None, :] - triangle_0
    end = vertex_1[..., None, :] - triangle_1
    time, undecided, shape = _first_contact(
        start, end, tolerance, np.zeros(()), _size(triangle_0)
    )
    return or_undecided(time, undecided).reshape(shape)


@domain
def edge_edge_impact(
    edge_a_0: Edge,
    edge_b_0: Edge,
    edge_a_1: Edge,
    edge_b_1: Edge,
    tolerance: Positive | None = None,
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

    Notes
    -----
    The differences between a point of one edge and a point of the other fill a
    parallelogram. The edges meet when the origin is in it. The parallelogram
    is made of two triangles, and these are followed as in
    `vertex_face_impact`.
    """
    start = edge_a_0[..., :, None, :] - edge_b_0[..., None, :, :]
    end = edge_a_1[..., :, None, :] - edge_b_1[..., None, :, :]
    start = start.reshape(*start.shape[:-3], 4, 3)
    end = end.reshape(*end.shape[:-3], 4, 3)
    time, undecided, shape = _first_contact(
        start, end, tolerance, _size(edge_a_0), _size(edge_b_0)
    )
    return or_undecided(time, undecided).reshape(shape)


def _size(points: Array) -> Array:
    """Longest edge (...) of the box around points (..., n, 3), m."""
    return np.ptp(points, axis=-2).max(axis=-1)


def _first_contact(
    start: Array,
    end: Array,
    tolerance: Array | None,
    size_a: Array,
    size_b: Array,
) -> tuple[Array, Booleans, tuple[int, ...]]:
    """Share of a step at which moving triangles first reach the origin.

    It does the same for parallelograms. The sizes are those of the two
    features. The function also returns which pairs are undecided, and the
    shape of the arguments.
    """
    shape = np.broadcast_shapes(
        start.shape[:-2],
        end.shape[:-2],
        () if tolerance is None else tolerance.shape,
    )
    near = touching(
        tolerance,
        shape,
        flat(size_a, shape),
        flat(size_b, shape),
        flat(np.linalg.norm(start[..., 0, :], axis=-1), shape),
    )
    place = flat(start, shape, start.shape[-2:])
    motion = flat(end, shape, end.shape[-2:]) - place
    began = np.zeros(near.shape)
    time, undecided = _follow(place, motion, near, began, SPLITS)
    return time, undecided, shape


def _follow(
    place: Array, motion: Array, near: Array, began: Array, splits: int
) -> tuple[Array, Booleans]:
    """Shares of a step until which pieces surely stay away from the origin.

    The second array says where it is undecided whether they reach it then.
    """

    def look(pairs: Pairs, time: Array) -> tuple[Array, Array]:
        corners = place[pairs] + time[:, None, None] * motion[pairs]
        normal = _towards(corners)
        heights = np.vecdot(corners, normal[:, None, :])
        closing = -np.vecdot(motion[pairs], normal[:, None, :])
        free = free_time(heights - near[pairs, None] / 2, closing)
        return heights.min(axis=-1), free.min(axis=-1)

    time, undecided = advance_all(
        look, np.ones(near.shape), near, began, LOOKS_UNCUT
    )
    if splits and undecided.any():
        halves = _halves(place[undecided], motion[undecided])
        near_twice = np.tile(near[undecided], 2)
        time_twice = np.tile(time[undecided], 2)
        times, still_open = _follow(
            *halves, near_twice, time_twice, splits - 1
        )
        times, still_open = times.reshape(2, -1), still_open.reshape(2, -1)
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
    place = np.take_along_axis(place, order, axis=1)
    motion = np.take_along_axis(motion, order, axis=1)
    return _cut(place), _cut(motion)


def _cut(corners: Array) -> Array:
    """Cut triangles between corners 0 and 1, and others between 2 and 3."""
    first, second = corners.copy(), corners.copy()
    for start in range(0, corners.shape[1] - 1, 2):
        middle = corners[:, start : start + 2].mean(axis=1)
        first[:, start + 1] = second[:, start] = middle
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
    edges = np.roll(faces, -1, axis=-2) - faces
    weights = nearest_weights(faces, faces, edges)
    nearest = (weights[..., None, :] @ faces)[..., 0, :]
    best = np.argmin(np.linalg.norm(nearest, axis=-1), axis=-1)
    return direction(nearest[np.arange(len(best)), best])
