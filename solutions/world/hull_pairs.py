"""Where boxes and polyhedra touch half-spaces and each other.

Two convex hulls are apart if and only if a plane that is parallel to a face of
one of them, or to an edge of each, has them on different sides. The largest
separation along the normals of all these planes is that of the contact. In
overlap it belongs to the shortest way out.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.world.edge_contacts import edge_contacts
from solutions.world.face_contacts import face_contacts
from solutions.world.hulls import Hull, hull_of
from solutions.world.round_pairs import above_half_space
from solutions.world.shapes import Placed, Touching

BIAS = 1e-3
"""Share of the smaller size by which an edge must be better than a face.

Where a box rests on a face, rounding and the little overlap that holds it up
must not decide from step to step whether it rests on a face or on an edge, and
on which face. For the same reason a face of A must be better than one of B by
this much.
"""
SAME_NORMAL = np.cos(0.03)
"""Cosine of the angle up to which a face is preferred to edges.

Where a hardly tilted box hangs over another one, two edges cross. The faces
have nearly the same normal there, and more places that hold the box up.
"""
FEATURES = 1 << 16
"""Numbers that a feature may have."""


def hull_half_space(a: Placed, b: Placed, margin: float) -> Touching:
    """Where boxes or polyhedra touch half-spaces: each vertex has a number."""
    return above_half_space(a.vertices, np.zeros(len(a.vertices)), b, margin)


def hull_hull(a: Placed, b: Placed, margin: float) -> Touching:
    """Where boxes or polyhedra touch each other.

    They touch with a face of each, at up to as many places as both faces have
    corners, or with an edge of each at one place. `feature_steps` says how the
    features are numbered. If two solids have more than 65536 of them, the
    numbers begin again at 0.

    Notes
    -----
    Hulls that are apart, but by no more than the margin, may be nearest at two
    vertices, or at a vertex and an edge. The way between these is along no
    normal of a face or of two edges, so that such a place is left out. In
    overlap the shortest way out is always along one of these normals.
    """
    hull_a, hull_b = hull_of(a), hull_of(b)
    over_a, face_a = _best_face(hull_a, hull_b.vertices)
    over_b, face_b = _best_face(hull_b, hull_a.vertices)
    pair = np.flatnonzero(np.maximum(over_a, over_b) <= margin)
    hull_a, over_a, face_a = hull_a.rows(pair), over_a[pair], face_a[pair]
    hull_b, over_b, face_b = hull_b.rows(pair), over_b[pair], face_b[pair]
    bias = BIAS * np.minimum(hull_a.size, hull_b.size)

    # One of the two faces is the reference face; of the other hull, the face
    # counts that looks most nearly against it.
    row = np.arange(len(pair))
    on_b = over_b >= over_a - bias
    out_a, out_b = hull_a.normal[row, face_a], hull_b.normal[row, face_b]
    out = np.where(on_b[:, None], out_b, out_a)
    against_a = np.argmin(np.matvec(hull_a.normal, out), axis=1)
    against_b = np.argmin(np.matvec(hull_b.normal, out), axis=1)
    face_a = np.where(on_b, against_a, face_a)
    face_b = np.where(on_b, face_b, against_b)
    places = face_contacts(hull_a, hull_b, face_a, face_b, on_b)
    edges = edge_contacts(hull_a, hull_b)

    # The contact is that of the faces, or that of two edges.
    normal = np.where(on_b[:, None], out, -out)
    by_edges = edges.separation > np.maximum(over_a, over_b) + bias
    by_edges &= np.vecdot(edges.normal, normal) < SAME_NORMAL
    of_faces = np.where(by_edges[:, None], np.inf, places.separation)
    touching = by_edges & edges.touching
    of_edges = np.where(touching, edges.separation, np.inf)
    separation = np.concatenate([of_faces, of_edges[:, None]], axis=1)
    point = np.concatenate([places.point, edges.point[:, None]], axis=1)
    feature = np.concatenate([places.feature, edges.feature[:, None]], axis=1)
    feature %= FEATURES
    normal = np.where(by_edges[:, None], edges.normal, normal)

    row, slot = np.nonzero(separation <= margin)
    order = np.argsort(row * FEATURES + feature[row, slot], kind="stable")
    row, slot = row[order], slot[order]
    return Touching(
        pair[row],
        point[row, slot],
        normal[row],
        separation[row, slot],
        feature[row, slot],
    )


def _best_face(hull: Hull, vertices: Array) -> tuple[Array, Integers]:
    """How far a face separates a hull from vertices at best, and which one."""
    above = hull.normal @ vertices.mT - hull.offset[..., None]
    heights = np.min(above, axis=2)
    return np.max(heights, axis=1), np.argmax(heights, axis=1)
