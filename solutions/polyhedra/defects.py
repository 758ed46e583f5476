"""What is wrong with a mesh that may have no clear inside (slide 9)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.domain import domain
from solutions.polyhedra.intersection import boxes_that_meet
from solutions.polyhedra.orientation import LOOKS, orient2d, orient3d
from solutions.polyhedra.segments import segment_meets_triangle
from solutions.polyhedra.surface import (
    Faces,
    Vertices,
    blocks,
    corners_of,
    directed_edges,
    same_places,
)


@dataclass(frozen=True, eq=False)
class MeshReport:
    """The faults of a mesh as indices; none for the surface of a solid.

    Attributes
    ----------
    open_edges : (k, 2), vertices at the ends of an edge
        Edges with an odd number of faces, as at the rim of a hole.
    crowded_edges : (k, 2), vertices
        Edges with more than two faces.
    twisted_edges : (k, 2), vertices
        Edges with an even number of faces that run through the edge more often
        one way than the other. One of these faces is turned over.
    degenerate_faces : (k,), faces
        Faces without area.
    duplicate_faces : (k,), faces
        Faces with the same corners as an earlier face.
    crossing_faces : (k, 2), pairs of faces
        Pairs of faces that have more in common than corners and sides.
    """

    open_edges: Integers
    crowded_edges: Integers
    twisted_edges: Integers
    degenerate_faces: Integers
    duplicate_faces: Integers
    crossing_faces: Integers

    @property
    def is_watertight(self) -> bool:
        """Whether each edge has an even number of faces: enough for parity."""
        return not len(self.open_edges)

    @property
    def is_oriented(self) -> bool:
        """Whether all faces are turned alike.

        For a watertight mesh this is enough for the winding number.
        """
        return not len(self.twisted_edges)

    @property
    def bounds_a_solid(self) -> bool:
        """Whether nothing is wrong.

        If so, parity and winding number agree everywhere off the surface.
        """
        return not any(len(fault) for fault in vars(self).values())


@domain
def mesh_report(vertices: Vertices, faces: Faces) -> MeshReport:
    """Look for all that keeps a mesh from having a clear inside (slide 9).

    Vertices at the same place count as one vertex. Areas and intersections are
    judged exactly.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners

    Returns
    -------
    MeshReport
        A mesh without faces has no faults.
    """
    flat = _without_area(corners_of(vertices, faces))
    places = same_places(vertices, faces)
    count, excess, ends = _edges_at(places, faces)
    odd = count % 2 == 1
    return MeshReport(
        open_edges=ends[odd],
        crowded_edges=ends[count > 2],
        twisted_edges=ends[~odd & (excess != 0)],
        degenerate_faces=np.flatnonzero(flat),
        duplicate_faces=_repeated(places),
        crossing_faces=_crossing(vertices, faces, places, ~flat),
    )


def _without_area(corners: Array) -> Booleans:
    """Whether the corners of a face are on one line, seen along x, y and z."""
    a, b, c = np.moveaxis(corners, 1, 0)
    views = [orient2d(a[:, i], b[:, i], c[:, i]) for i in LOOKS]
    return np.all(np.stack(views) == 0, axis=0)


def _edges_at(
    places: Integers, faces: Integers
) -> tuple[Integers, Integers, Integers]:
    """Number of faces at every edge, their excess one way, and its ends.

    The excess is how many more faces run through the edge up than down. The
    ends are vertices.
    """
    directed, ends = directed_edges(places), directed_edges(faces)
    proper = directed[:, 0] != directed[:, 1]
    directed, ends = directed[proper], ends[proper]
    edges, first, edge, count = np.unique(
        np.sort(directed, axis=1),
        axis=0,
        return_index=True,
        return_inverse=True,
        return_counts=True,
    )
    up = np.where(directed[:, 0] < directed[:, 1], 1, -1)
    excess = np.bincount(edge.reshape(-1), up, len(edges)).astype(np.int64)
    return count, excess, np.sort(ends[first], axis=1)


def _repeated(places: Integers) -> Integers:
    """Faces that have the three corners of an earlier one, in any order."""
    _, first = np.unique(np.sort(places, axis=1), axis=0, return_index=True)
    return np.setdiff1d(np.arange(len(places)), first)


def _crossing(
    vertices: Array, faces: Integers, places: Integers, has_area: Booleans
) -> Integers:
    """Pairs of faces with an area that cross, (k, 2)."""
    kept = np.flatnonzero(has_area)
    corners = vertices[faces[kept]]
    crossing = [np.empty((0, 2), dtype=np.int64)]
    for block in blocks(len(kept), len(kept)):
        one, other = boxes_that_meet(corners[block], corners)
        one = one + block.start
        pairs = np.stack([kept[one], kept[other]], axis=1)[one < other]
        crossing.append(pairs[_cross(vertices, faces, places, pairs)])
    return np.concatenate(crossing)


def _cross(
    vertices: Array, faces: Integers, places: Integers, pairs: Integers
) -> Booleans:
    """Whether faces cross, which depends on how many corners they share."""
    same = places[pairs[:, 0]][:, :, None] == places[pairs[:, 1]][:, None, :]
    shared = np.sum(same, axis=(1, 2))
    crosses = shared == 3  # the same face twice
    apart = shared < 2
    mesh = vertices, faces
    crosses[apart] = _edge_meets_face(*mesh, pairs[apart], same[apart])
    folded = shared == 2
    crosses[folded] = _folded(*mesh, pairs[folded], same[folded])
    return crosses


def _edge_meets_face(
    vertices: Array, faces: Integers, pairs: Integers, same: Booleans
) -> Booleans:
    """Whether a side of one face meets the other face.

    Sides that begin or end at a shared corner are left out.
    """
    meets = np.zeros(len(pairs), dtype=bool)
    for one, other, axis in ((0, 1, 2), (1, 0, 1)):
        mine = vertices[faces[pairs[:, one]]]
        taken = np.any(same, axis=axis)
        for k in range(3):
            end = (k + 1) % 3
            free = ~(taken[:, k] | taken[:, end] | meets)
            corners = vertices[faces[pairs[free, other]]]
            meets[free] = segment_meets_triangle(
                mine[free, k], mine[free, end], corners
            )
    return meets


def _folded(
    vertices: Array, faces: Integers, pairs: Integers, same: Booleans
) -> Booleans:
    """Whether two faces at one edge lie on each other.

    They do if they are in one plane and on the same side of the edge.
    """
    alone_1 = np.argmin(np.any(same, axis=2), axis=1)
    alone_2 = np.argmin(np.any(same, axis=1), axis=1)
    row = np.arange(len(pairs))
    first, second = faces[pairs[:, 0]], faces[pairs[:, 1]]
    a, b, c = (vertices[first[row, (alone_1 + k) % 3]] for k in (1, 2, 0))
    d = vertices[second[row, alone_2]]
    in_one_plane = orient3d(a, b, c, d) == 0
    views = [
        orient2d(a[:, i], b[:, i], c[:, i])
        * orient2d(a[:, i], b[:, i], d[:, i])
        for i in LOOKS
    ]
    return in_one_plane & np.any(np.stack(views) > 0, axis=0)
