"""Pieces in general position, and how far apart they are by other means, for the tests of the narrow phase."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.impulse import rotation_matrix
from solutions.sweeping import separation_of_hulls
from solutions.world.boxes import BOX_FACES, BOX_VERTICES
from solutions.world.narrow_phase import PAIRS
from solutions.world.shapes import BOX, CAPSULE, HALF_SPACE, POLYHEDRON, SPHERE, Placed, Touching

NO_FACES = np.zeros((0, 3), dtype=np.int64)
UPRIGHT = np.eye(3)
# A tent: two triangles and three quadrilaterals, no two edges alike, no face parallel to another.
TENT = [(-0.6, -0.4, -0.3), (-0.6, 0.5, -0.3), (-0.5, 0.1, 0.4), (0.8, -0.4, -0.3), (0.7, 0.5, -0.3), (0.5, 0.1, 0.4)]
TENT_FACES = np.array([(0, 2, 1, 1), (3, 4, 5, 5), (0, 1, 4, 3), (0, 3, 5, 2), (1, 2, 5, 4)])


def tent_vertices():
    """The tent with its slanted long sides made plane: the ridge's far end is where both planes meet."""
    v = np.array(TENT)
    first = np.cross(v[3] - v[0], v[2] - v[0])
    second = np.cross(v[2] - v[1], v[4] - v[1])
    ridge = np.cross(first, second)
    v[5] = v[2] + ridge * (0.5 - v[2][0]) / ridge[0]
    return v


TENT_VERTICES = tent_vertices()
SIZES = {
    SPHERE: np.array([0.3, 0.0, 0.0]),
    CAPSULE: np.array([0.2, 0.5, 0.0]),
    BOX: np.array([0.5, 0.7, 0.3]),
    POLYHEDRON: np.zeros(3),
    HALF_SPACE: np.zeros(3),
}
OWN = {SPHERE: np.zeros((1, 3)), BOX: BOX_VERTICES, POLYHEDRON: TENT_VERTICES}
FACES = {BOX: BOX_FACES, POLYHEDRON: TENT_FACES}


def place(kind, position, rotation=UPRIGHT, size=None, vertices=None, faces=None):
    """Pieces at positions (n, 3), each turned by a rotation (3, 3) or (n, 3, 3)."""
    at = np.atleast_2d(np.asarray(position, dtype=float))
    turned = np.array(np.broadcast_to(rotation, (len(at), 3, 3)))
    size = np.array(np.broadcast_to(SIZES[kind] if size is None else size, at.shape), dtype=float)
    if kind not in FACES:
        return Placed(at, turned, size, np.zeros((len(at), 0, 3)), NO_FACES)
    own = OWN[kind] if vertices is None else vertices
    own = own * size[:, None] if kind == BOX else np.broadcast_to(own, (len(at), *own.shape))
    return Placed(at, turned, size, at[:, None] + own @ turned.mT, FACES[kind] if faces is None else faces)


def touch(kinds, a, b, margin=0.0) -> Touching:
    return PAIRS[kinds](a, b, margin)


def about(axis, degrees):
    half = np.radians(degrees) / 2
    return rotation_matrix([np.cos(half), *(np.sin(half) * np.array(axis) / np.linalg.norm(axis))])


def random_turns(rng, count):
    q = rng.normal(size=(count, 4))
    return rotation_matrix(q / np.linalg.norm(q, axis=1, keepdims=True))


def scene(kinds, count, seed, spread):
    """Pieces A and B in general position, some deep in each other, some at the surface, some apart."""
    rng = np.random.default_rng(seed)
    away = rng.normal(size=(count, 3))
    away *= spread * rng.random((count, 1)) / np.linalg.norm(away, axis=1, keepdims=True)
    base = rng.normal(size=(count, 3))
    return tuple(place(kind, at, random_turns(rng, count)) for kind, at in zip(kinds, (base + away, base), strict=True))


def core(piece, kind, i):
    """Points whose hull is the piece, except for its radius."""
    if kind == CAPSULE:
        return piece.position[i] + np.outer([-1, 1], piece.size[i, 1] * piece.rotation[i, :, 2])
    return piece.position[i][None] if kind == SPHERE else piece.vertices[i]


def radius(piece, kind, i):
    return piece.size[i, 0] if kind in (SPHERE, CAPSULE) else 0.0


def way_out(points_a, points_b):
    """Separation of two hulls: by distance where they are apart, else the shortest way out, from all differences."""
    from scipy.spatial import ConvexHull  # noqa: PLC0415

    apart, _ = separation_of_hulls(points_a, points_b)
    if apart > 1e-6:  # nearer, rounding bends its direction
        return float(apart)
    return float(ConvexHull((points_a[:, None] - points_b[None]).reshape(-1, 3)).equations[:, 3].max())


def outside(point, piece, kind, i):
    """How far a point is outside of a piece; negative within it."""
    if kind == HALF_SPACE:
        return (point - piece.position[i]) @ piece.rotation[i, :, 2]
    if kind in FACES:
        corners = piece.vertices[i][piece.faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return np.max(np.sum((point - corners[:, 0]) * normal, axis=1))
    return float(separation_of_hulls(point[None], core(piece, kind, i))[0]) - radius(piece, kind, i)


ALL = list(PAIRS)
NAMES = {SPHERE: "sphere", CAPSULE: "capsule", BOX: "box", POLYHEDRON: "tent", HALF_SPACE: "half-space"}


def each(*kinds):
    return pytest.mark.parametrize("kinds", kinds, ids=["-".join(NAMES[kind] for kind in pair) for pair in kinds])
