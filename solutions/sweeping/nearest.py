"""The nearest points of two convex bodies: of their Minkowski difference, the point nearest to the origin."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.sweeping.motion import in_space

Array = NDArray[np.float64]
ROUNDS = 60
"""Boxes take about ten; where rounding holds it up beyond these, the separation found so far is given."""
FACES = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
"""Of a tetrahedron, by corners."""


def triangles(name: str, value: ArrayLike) -> Array:
    """Return triangles (..., 3, 3); refuse what has not three corners in space or is not finite."""
    corners = in_space(name, value)
    if corners.shape[-2:] != (3, 3):
        raise ValueError(f"{name} must have shape (..., 3, 3), not {corners.shape}")
    return corners


def point_set(name: str, value: ArrayLike) -> Array:
    """Return sets of points (..., n, 3); refuse what has no point, is not in space or is not finite."""
    array = in_space(name, value)
    if array.ndim < 2 or not array.shape[-2]:
        raise ValueError(f"{name} must have shape (..., n, 3) with a point at least, not {array.shape}")
    return array


def nearest_on_triangle(point: ArrayLike, triangle: ArrayLike) -> Array:
    """Weights of the three corners at the point of a triangle that is nearest to a given one.

    It lies on one of the three edges, or inside where the point's shadow on the plane falls inside. Of these four
    candidates the nearest is taken; so a triangle without area, a segment or a point, is none of its own kind.

    Parameters
    ----------
    point : (..., 3), m
    triangle : (..., 3, 3), three corners, m

    Returns
    -------
    (..., 3), none negative, their sum 1; the point is Σ w_i p_i

    Raises
    ------
    ValueError
        If an array is not finite or not in space.
    """
    places = triangles("triangle", triangle)
    corners = places - in_space("point", point)[..., None, :]
    ways = np.roll(places, -1, axis=-2) - places  # not of `corners`: far away these have lost digits
    weights = np.concatenate([_on_edges(corners, ways), _inside(corners, ways)[..., None, :]], axis=-2)
    nearest, step = weights @ corners, (weights - weights[..., :1, :]) @ (places - places[..., :1, :])
    farther = np.vecdot(step, nearest + nearest[..., :1, :])  # d² less that of the first: far away all d² are alike
    best = np.argmin(farther, axis=-1)[..., None, None]
    return np.asarray(np.take_along_axis(weights, best, axis=-2)[..., 0, :])


def _on_edges(corners: Array, ways: Array) -> Array:
    """Weights (..., 3, 3) of the points nearest to the origin on the edges 01, 12, 20."""
    squared = np.vecdot(ways, ways)
    share = -np.vecdot(corners, ways) / np.where(squared > 0, squared, 1.0)
    share = np.clip(share, 0.0, 1.0)[..., None]
    return np.asarray((1 - share) * np.eye(3) + share * np.roll(np.eye(3), 1, axis=-1))


def _inside(corners: Array, ways: Array) -> Array:
    """Weights (..., 3) of the origin's shadow on the plane, pushed back inside; the first corner without a plane."""
    normal = np.cross(ways[..., 0, :], ways[..., 1, :])
    beside = np.vecdot(np.cross(corners, ways), normal[..., None, :])  # as large as the triangle on that edge
    shares = np.maximum(np.roll(beside, -1, axis=-1), 0.0)  # the one on the edge 12 weighs the corner 0
    total = shares.sum(axis=-1, keepdims=True)
    return np.where(total > 0, shares / np.where(total > 0, total, 1.0), np.array([1.0, 0.0, 0.0]))


def separation_of_hulls(points_a: ArrayLike, points_b: ArrayLike) -> tuple[Array, Array]:
    """How far the convex hulls of two sets of points are apart, and along which direction (Gilbert, Johnson, Keerthi).

    The differences a − b fill a convex body too, and the hulls overlap if the origin is in it. A tetrahedron of four
    differences is moved towards the origin: keep the part of it that is nearest, and add the difference that lies
    farthest that way. When it gets no nearer, the nearest point is found. While the hulls overlap there is no direction
    that separates them, and the answer stays 0.

    Parameters
    ----------
    points_a : (..., n, 3), m: the corners of A; two for the core of a capsule, one for that of a ball
    points_b : (..., m, 3), m

    Returns
    -------
    separation : (...), m, min n·(a − b): never more than the distance s, and short of it by 10⁻¹⁵ L²/s at most, with L
        the largest coordinate: the nearer they are, the more does rounding bend n. Below some 3·10⁻⁸ L it may be 0,
        which it is where the hulls touch or overlap
    normal : (..., 3), n, of unit length from B to A; zero where the separation is

    Raises
    ------
    ValueError
        If a body has no points, or an array is not finite or not in space.
    """
    a, b = point_set("points_a", points_a), point_set("points_b", points_b)
    shape = np.broadcast_shapes(a.shape[:-2], b.shape[:-2])
    a, b = np.broadcast_to(a, (*shape, *a.shape[-2:])), np.broadcast_to(b, (*shape, *b.shape[-2:]))
    corners = np.repeat((a[..., :1, :] - b[..., :1, :]), 4, axis=-2)
    best, normal = np.zeros(shape), np.zeros((*shape, 3))
    done, last = np.zeros(shape, dtype=bool), np.full(shape, np.inf)
    for _ in range(ROUNDS):
        weights, nearest = _nearest_on_tetrahedron(corners)
        distance = np.linalg.norm(nearest, axis=-1)
        way = nearest / np.where(distance > 0, distance, 1.0)[..., None]
        support = farthest(a, -way) - farthest(b, way)
        separation = np.vecdot(way, support)
        better = separation > best  # whichever way it was found: they are apart by that much
        best, normal = np.where(better, separation, best), np.where(better[..., None], way, normal)
        done |= distance >= last  # it falls in every round until rounding stops it
        last = np.minimum(distance, last)
        if np.all(done):
            break
        unused = np.argmin(weights, axis=-1)[..., None, None]
        corners = np.where(weights[..., None] > 0, corners, nearest_corner(corners, weights)[..., None, :])
        np.put_along_axis(corners, np.broadcast_to(unused, (*shape, 1, 3)), support[..., None, :], axis=-2)
    return best, normal


def farthest(body: Array, direction: Array) -> Array:
    """Give the point (..., 3) of a body's (..., n, 3) that lies farthest along a direction: the support."""
    index = np.argmax(np.vecdot(body, direction[..., None, :]), axis=-1)[..., None, None]
    return np.asarray(np.take_along_axis(body, index, axis=-2)[..., 0, :])


def nearest_corner(corners: Array, weights: Array) -> Array:
    """Give the corner with the largest weight: in its place the ones that are no longer needed do no harm."""
    return np.asarray(np.take_along_axis(corners, np.argmax(weights, axis=-1)[..., None, None], axis=-2)[..., 0, :])


def _nearest_on_tetrahedron(corners: Array) -> tuple[Array, Array]:
    """Weights (..., 4) and place (..., 3) of the point on a tetrahedron's faces nearest to the origin."""
    faces = corners[..., FACES, :]
    on_faces = nearest_on_triangle(np.zeros(3), faces)
    places = (on_faces[..., None, :] @ faces)[..., 0, :]
    best = np.argmin(np.vecdot(places, places), axis=-1)[..., None]
    weights = np.zeros((*best.shape[:-1], 4))
    chosen = np.take_along_axis(on_faces, best[..., None], axis=-2)[..., 0, :]
    np.put_along_axis(weights, FACES[best[..., 0]], chosen, axis=-1)
    place = np.take_along_axis(places, best[..., None], axis=-2)[..., 0, :]
    return weights, place
