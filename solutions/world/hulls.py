"""Convex hulls: the planes of their faces, and the faces beside each edge."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.shapes import Placed
from solutions.world.vectors import cross

EVEN = 1e-6
"""Share of a solid's size by which a vertex may lie in front of a face.

Rounding may have put it there.
"""
FLAT = 1e-9
"""Share of its size by which some vertex has to lie behind each face."""


class Edges(NamedTuple):
    """The edges of all hulls with the same faces.

    Attributes
    ----------
    ends : (e, 2), numbers of vertices, the smaller first
    beside : (e, 2), numbers of the faces to the left and to the right
        This is how they are seen from outside by someone who walks from the
        first end to the second.
    number : (f, s), which edge runs from each corner of a face to the next
    real : (f, s), False where a face repeats its last corner
        There is no edge then.
    """

    ends: Integers
    beside: Integers
    number: Integers
    real: Booleans


class Hull(NamedTuple):
    """Convex hulls with the same faces, where they are at an instant.

    Attributes
    ----------
    vertices : (n, v, 3), m
    faces : (f, s), numbers of vertices, counterclockwise from outside
    normal : (n, f, 3), unit, out of each face
    offset : (n, f), n·p of all points p of the face, m
    size : (n,), m, from the first vertex to the one farthest from it
        It is at least half of the largest distance of two vertices.
    edges : of all of them
    """

    vertices: Array
    faces: Integers
    normal: Array
    offset: Array
    size: Array
    edges: Edges

    def rows(self, chosen: Integers) -> Hull:
        """Some of the hulls, in the order given."""
        placed = (self.vertices, self.normal, self.offset, self.size)
        vertices, normal, offset, size = (values[chosen] for values in placed)
        return Hull(vertices, self.faces, normal, offset, size, self.edges)


def hull_of(piece: Placed) -> Hull:
    """Boxes or polyhedra with their planes and edges.

    Raises
    ------
    ValueError
        If the faces do not bound a solid: each edge must have two faces, which
        run along it in opposite directions.

    Notes
    -----
    The triangles from the first corner of a face to each of its sides have the
    normals (p_k − p_0)×(p_k+1 − p_0). Their sum is twice the area of the face
    long, and it points outwards. A corner that is repeated, or lies straight
    between its neighbours, adds nothing.
    """
    vertices, faces = piece.vertices, piece.faces
    first = vertices[:, faces[:, 0]]
    spokes = vertices[:, faces[:, 1:]] - first[:, :, None]
    normal = np.sum(cross(spokes[:, :, :-1], spokes[:, :, 1:]), axis=2)
    normal /= np.sqrt(np.vecdot(normal, normal))[..., None]
    across = vertices - vertices[:, :1]
    size = np.sqrt(np.max(np.vecdot(across, across), axis=1))
    offset = np.vecdot(normal, first)
    return Hull(vertices, faces, normal, offset, size, edges_of(faces))


def checked_solid(vertices: Array, faces: Integers) -> tuple[Array, Integers]:
    """Return vertices (v, 3) and faces (f, s), if they are a polyhedron's.

    Raises
    ------
    ValueError
        If the faces do not bound a convex solid, counterclockwise from
        outside.
    """
    if vertices.ndim != 2 or faces.ndim != 2 or faces.dtype.kind not in "iu":
        raise ValueError(
            f"faces must be lists of whole numbers, not {faces.dtype} of"
            f" {faces.shape}"
        )
    wrong = (faces < 0) | (faces >= len(vertices))
    if np.any(wrong):
        raise ValueError(
            f"faces must name vertices 0 to {len(vertices) - 1}, not"
            f" {faces[wrong][0]}"
        )
    faces = faces.astype(np.int64)
    nowhere = np.zeros((1, 3))
    piece = Placed(nowhere, np.eye(3)[None], nowhere, vertices[None], faces)
    with np.errstate(invalid="ignore"):
        hull = hull_of(piece)
    heights = (vertices @ hull.normal[0].T - hull.offset[0]).T
    # The heights over a face without an area are NaN, and it is refused too.
    convex = np.max(heights, axis=1) <= EVEN * hull.size
    convex &= np.min(heights, axis=1) < -FLAT * hull.size
    if not np.all(convex):
        face = faces[~convex][0].tolist()
        raise ValueError(
            "faces must bound a convex solid, counterclockwise from"
            f" outside, not {face}"
        )
    return vertices, faces


def edges_of(faces: Integers) -> Edges:
    """The edges of a solid with these faces; see `hull_of`."""
    whole = np.ascontiguousarray(faces, dtype=np.int64)
    return _edges(whole.tobytes(), whole.shape)


@lru_cache(maxsize=256)
def _edges(content: bytes, shape: tuple[int, int]) -> Edges:
    """The same; kept, because a world asks for the same few in every step."""
    faces = np.frombuffer(content, dtype=np.int64).reshape(shape)
    following = np.roll(faces, -1, axis=1)
    real = faces != following
    count = np.max(faces) + 1
    code = np.minimum(faces, following) * count + np.maximum(faces, following)
    codes = np.unique(code[real])
    number = np.where(real, np.searchsorted(codes, code), 0)
    beside = np.full((len(codes), 2), -1)
    for side, along in enumerate((faces < following, faces > following)):
        face, corner = np.nonzero(along)
        beside[number[face, corner], side] = face
    if np.any(beside < 0) or np.count_nonzero(real) != 2 * len(codes):
        raise ValueError(
            "faces must bound a solid: each edge must have two faces, which"
            " run along it in opposite ways"
        )
    ends = np.column_stack(np.divmod(codes, count))
    return Edges(ends, beside, number, real)
