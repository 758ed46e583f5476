"""Where two hulls touch with an edge of each."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.face_contacts import feature_steps
from solutions.world.hulls import Hull
from solutions.world.segments import nearest_on_segments
from solutions.world.vectors import cross

EDGES_PARALLEL = 1e-6
"""Sine of the angle below which two edges count as parallel.

Rounding would decide about the direction of their cross product.
"""
ON_EDGE = 1e-6
"""Share of the smaller size by which rounding may move the nearest points."""


class Crossing(NamedTuple):
    """The two edges of each pair that separate the hulls best.

    Attributes
    ----------
    separation : (n,), m; −infinity if no two edges do
    normal : (n, 3), unit, from B to A
    point : (n, 3), halfway between the edges, m
    feature : (n,), a number that names the two edges
    touching : (n,), whether the edges themselves touch, not their lines
        They do if the points nearest to each other are along the normal.
    """

    separation: Array
    normal: Array
    point: Array
    feature: Integers
    touching: Booleans


def edge_contacts(a: Hull, b: Hull) -> Crossing:
    """The two edges, one of each hull, whose common normal separates best.

    Notes
    -----
    The planes that touch a hull along an edge have the normals between those
    of the faces beside it. On the unit sphere these normals are an arc. A
    plane that touches A along one edge, and B from the other side along
    another, exists if the arc of the first edge crosses that of the second,
    reflected at the origin. Let d_A be the first edge, and l_A and r_A the
    normals to the left and to the right of it. The arcs cross if each has its
    ends on both sides of the other's plane, in the same half of the sphere
    (Gregorius, *The Separating Axis Test between Convex Polyhedra*, 2013):

        (l_B·d_A)(r_B·d_A) < 0
        (l_A·d_B)(r_A·d_B) < 0
        (l_B·d_A)(r_A·d_B) < 0

    With d_A along l_A×r_A, the cross product of both edges is

        d_A×d_B ∝ (l_A·d_B) r_A − (r_A·d_B) l_A

    So it points out of A where l_A·d_B is positive, and otherwise out of B. No
    other vertex needs to be looked at: the separation is the distance of both
    edges along it.
    """
    starts_a, way_a = _edge_ways(a)
    starts_b, way_b = _edge_ways(b)
    along_b, along_a = way_a @ b.normal.mT, a.normal @ way_b.mT
    left_b, right_b = (along_b[:, :, side] for side in b.edges.beside.T)
    left_a, right_a = (along_a[:, side] for side in a.edges.beside.T)
    crossing = (left_b * right_b < 0) & (left_a * right_a < 0)
    crossing &= left_b * right_a < 0
    pair, edge_a, edge_b = np.nonzero(crossing)
    first, second = way_a[pair, edge_a], way_b[pair, edge_b]
    out = cross(first, second)
    length = np.sqrt(np.vecdot(out, out))
    sizes = np.sqrt(np.vecdot(first, first) * np.vecdot(second, second))
    real = np.flatnonzero(length > EDGES_PARALLEL * sizes)
    pair, edge_a, edge_b = pair[real], edge_a[real], edge_b[real]
    towards_a = np.where(left_a[pair, edge_a, edge_b] > 0, -1.0, 1.0)
    normal = out[real] * (towards_a / length[real])[:, None]
    between = starts_a[pair, edge_a] - starts_b[pair, edge_b]
    separation = np.vecdot(normal, between)
    return _best(a, b, (pair, edge_a, edge_b), separation, normal)


def _best(
    a: Hull,
    b: Hull,
    edges: tuple[Integers, Integers, Integers],
    separation: Array,
    normal: Array,
) -> Crossing:
    """The edges of each pair that separate best, and where they touch."""
    count = len(a.vertices)
    pair, edge_a, edge_b = edges
    order = np.lexsort((-separation, pair))
    best = order[np.flatnonzero(np.diff(pair[order], prepend=-1))]
    pair, edge_a, edge_b = pair[best], edge_a[best], edge_b[best]
    start_a, end_a = (a.vertices[pair, end] for end in a.edges.ends[edge_a].T)
    start_b, end_b = (b.vertices[pair, end] for end in b.edges.ends[edge_b].T)
    way_a, way_b = end_a - start_a, end_b - start_b
    share_a, share_b = nearest_on_segments(start_a, way_a, start_b, way_b)
    point_a = start_a + share_a[:, None] * way_a
    point_b = start_b + share_b[:, None] * way_b
    _, of_edges, row = feature_steps(a, b)
    beside = point_a - point_b - normal[best] * separation[best, None]
    near = ON_EDGE * np.minimum(a.size, b.size)[pair]
    crossing = Crossing(
        np.full(count, -np.inf),
        np.zeros((count, 3)),
        np.zeros((count, 3)),
        np.zeros(count, int),
        np.zeros(count, bool),
    )
    crossing.separation[pair] = separation[best]
    crossing.normal[pair] = normal[best]
    crossing.point[pair] = (point_a + point_b) / 2
    crossing.feature[pair] = of_edges + row * edge_a + edge_b
    crossing.touching[pair] = np.vecdot(beside, beside) <= near**2
    return crossing


def _edge_ways(hull: Hull) -> tuple[Array, Array]:
    """First ends of edges, and the ways to the second ones, (n, e, 3), m."""
    starts, ends = (hull.vertices[:, end] for end in hull.edges.ends.T)
    return starts, ends - starts
