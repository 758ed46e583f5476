"""Nearest points of convex bodies: their Minkowski difference (slide 10)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import Vector, domain
from solutions.sweeping.domain import Points, Triangle
from solutions.vectors import quotient

ROUNDS = 60
"""Largest number of rounds; boxes take about ten.

Where rounding holds up the search for longer, the separation found so far is
given.
"""
FACES = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
"""Faces of a tetrahedron, by corners."""


@domain
def separation_of_hulls(
    points_a: Points, points_b: Points
) -> tuple[Array, Array]:
    """How far two convex hulls are apart, and along which direction.

    Each hull is that of a set of points. The method is that of Gilbert,
    Johnson and Keerthi.

    Parameters
    ----------
    points_a : (..., n, 3), the corners of A, m
        Two are the core of a capsule, and one is that of a ball.
    points_b : (..., m, 3), the corners of B, m

    Returns
    -------
    separation : (...), m, the smallest n·(a − b)
        It is never more than the true distance s. It falls short of s by at
        most 10⁻¹⁵ L²/s, where L is the largest coordinate. The nearer the
        hulls are, the more rounding bends n. Below some 3·10⁻⁸ L it may be 0.
        It is 0 where the hulls touch or overlap.
    normal : (..., 3), n, of unit length from B to A
        It is zero where the separation is zero.

    Notes
    -----
    The differences a − b between a point of A and a point of B fill a convex
    body too. It contains the origin exactly when the hulls have a point in
    common. If they have none, its point nearest to the origin gives the
    distance and the direction.

    The function moves a tetrahedron of four differences towards the origin.
    Each round finds the part of the tetrahedron that is nearest to the origin,
    and keeps it. It then looks from that nearest point towards the origin, and
    adds the difference that lies farthest in this direction. When this gets no
    nearer, the nearest point is found.

    While the hulls overlap there is no direction that separates them, and the
    separation stays 0.
    """
    shape = np.broadcast_shapes(points_a.shape[:-2], points_b.shape[:-2])
    a = np.broadcast_to(points_a, (*shape, *points_a.shape[-2:]))
    b = np.broadcast_to(points_b, (*shape, *points_b.shape[-2:]))
    corners = np.repeat((a[..., :1, :] - b[..., :1, :]), 4, axis=-2)
    best, normal = np.zeros(shape), np.zeros((*shape, 3))
    done, last = np.zeros(shape, dtype=bool), np.full(shape, np.inf)
    for _ in range(ROUNDS):
        weights, nearest = _nearest_on_tetrahedron(corners)
        distance = np.linalg.norm(nearest, axis=-1)
        n = quotient(nearest, distance[..., None])
        support = farthest(a, -n) - farthest(b, n)
        separation = np.vecdot(n, support)
        # The hulls are apart by this much along n, whether or not n is the
        # best direction.
        better = separation > best
        best = np.where(better, separation, best)
        normal = np.where(better[..., None], n, normal)
        done |= distance >= last  # the distance falls until rounding stops it
        last = np.minimum(distance, last)
        if np.all(done):
            break
        used, spare = weights[..., None] > 0, nearest_corner(corners, weights)
        corners = np.where(used, corners, spare[..., None, :])
        unused = np.argmin(weights, axis=-1)[..., None, None]
        place = np.broadcast_to(unused, (*shape, 1, 3))
        np.put_along_axis(corners, place, support[..., None, :], axis=-2)
    return best, normal


def farthest(body: Array, direction: Array) -> Array:
    """Point (..., 3) of a body (..., n, 3) that is farthest along a direction.

    It is called the support.
    """
    heights = np.vecdot(body, direction[..., None, :])
    return _chosen(body, np.argmax(heights, axis=-1))


def nearest_corner(corners: Array, weights: Array) -> Array:
    """Corner with the largest weight.

    In its place, corners that are no longer needed do no harm.
    """
    return _chosen(corners, np.argmax(weights, axis=-1))


@domain
def nearest_on_triangle(point: Vector, triangle: Triangle) -> Array:
    """Weights of a triangle's corners at its point nearest to a given point.

    Parameters
    ----------
    point : (..., 3), m
    triangle : (..., 3, 3), three corners, m
        A triangle without area is a segment or a point.

    Returns
    -------
    (..., 3)
        No weight is negative, and their sum is 1. With the corners p_i and the
        weights w_i, the nearest point is Σ w_i p_i.

    Notes
    -----
    The nearest point is on one of the three edges, or inside the triangle. It
    is inside where the foot of the perpendicular from the given point to the
    triangle's plane falls inside. The function computes one candidate on each
    edge and one inside, and it takes the nearest of these four. A triangle
    without area therefore needs no treatment of its own: its nearest point is
    on an edge.
    """
    # The edges are not taken from `corners`: far from the point these have
    # lost digits.
    edges = np.roll(triangle, -1, axis=-2) - triangle
    corners = triangle - point[..., None, :]
    return nearest_weights(corners, triangle, edges)


def nearest_weights(corners: Array, places: Array, edges: Array) -> Array:
    """Weights of triangles' corners at the points nearest to the origin.

    The corners are measured from there. Their places, and the edges from one
    place to the next, may be measured from elsewhere.
    """
    on_edges, inside = _on_edges(corners, edges), _inside(corners, edges)
    weights = np.concatenate([on_edges, inside[..., None, :]], axis=-2)
    nearest = weights @ corners
    step = (weights - weights[..., :1, :]) @ (places - places[..., :1, :])
    # This is d² minus the d² of the first candidate. Far away all d² are equal
    # up to rounding, but their differences are not lost.
    farther = np.vecdot(step, nearest + nearest[..., :1, :])
    best = np.argmin(farther, axis=-1)
    return _chosen(weights, best)


def _on_edges(corners: Array, edges: Array) -> Array:
    """Weights (..., 3, 3) of points on edges 01, 12, 20 nearest to 0."""
    share = quotient(-np.vecdot(corners, edges), np.vecdot(edges, edges))
    share = np.clip(share, 0.0, 1.0)[..., None]
    return (1 - share) * np.eye(3) + share * np.roll(np.eye(3), 1, axis=-1)


def _inside(corners: Array, edges: Array) -> Array:
    """Weights (..., 3) of the origin's foot on the plane, pushed back inside.

    Without a plane, they are those of the first corner.
    """
    normal = np.cross(edges[..., 0, :], edges[..., 1, :])
    # Each is in proportion to the area of the triangle of the foot and that
    # edge.
    beside = np.vecdot(np.cross(corners, edges), normal[..., None, :])
    # The triangle on the edge 12 is the weight of the corner 0.
    shares = np.maximum(np.roll(beside, -1, axis=-1), 0.0)
    total = shares.sum(axis=-1, keepdims=True)
    return quotient(shares, total, np.array([1.0, 0.0, 0.0]))


def _nearest_on_tetrahedron(corners: Array) -> tuple[Array, Array]:
    """Point nearest to the origin on a tetrahedron's faces.

    It is given by its weights (..., 4) and its place (..., 3).
    """
    faces = corners[..., FACES, :]
    edges = np.roll(faces, -1, axis=-2) - faces
    on_faces = nearest_weights(faces, faces, edges)
    places = (on_faces[..., None, :] @ faces)[..., 0, :]
    best = np.argmin(np.vecdot(places, places), axis=-1)
    weights = np.zeros((*best.shape, 4))
    np.put_along_axis(weights, FACES[best], _chosen(on_faces, best), axis=-1)
    return weights, _chosen(places, best)


def _chosen(rows: Array, index: Integers) -> Array:
    """Of rows (..., n, d), those (..., d) with the index (...)."""
    chosen = np.take_along_axis(rows, index[..., None, None], axis=-2)
    return chosen[..., 0, :]
