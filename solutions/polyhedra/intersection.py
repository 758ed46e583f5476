"""Whether two polyhedra intersect, and which edges meet faces (slide 9)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import domain
from solutions.polyhedra.inside import inside_by_parity
from solutions.polyhedra.segments import segment_meets_triangle
from solutions.polyhedra.surface import (
    Faces,
    Vertices,
    blocks,
    corners_of,
    mesh_edges,
)


@domain
def edges_through_faces(
    vertices_a: Vertices, faces_a: Faces, vertices_b: Vertices, faces_b: Faces
) -> tuple[Integers, Integers]:
    """All edges of A that meet a face of B (slide 9).

    The function decides exactly, and touching counts. An edge is listed once
    for each face that it meets.

    Parameters
    ----------
    vertices_a : (v, 3), m
    faces_a : (f, 3), indices of the corners of A's faces
    vertices_b : (v, 3), m
    faces_b : (f, 3), indices of the corners of B's faces

    Returns
    -------
    edge : (k, 2), vertices of A at the ends of the edge
    face : (k,), index of the face of B that it meets
        `segment_triangle` gives the place where they meet. Both arrays are
        empty if nothing meets.
    """
    edges = mesh_edges(vertices_a, faces_a)
    ends = vertices_a[edges]
    corners = corners_of(vertices_b, faces_b)
    pairs = [np.empty((0, 2), dtype=np.int64)]  # numbers of edges and faces
    for block in blocks(len(edges), len(corners)):
        edge, face = boxes_that_meet(ends[block], corners)
        edge = edge + block.start
        start, end = np.moveaxis(ends[edge], 1, 0)
        meets = segment_meets_triangle(start, end, corners[face])
        pairs.append(np.column_stack([edge[meets], face[meets]]))
    edge, face = np.concatenate(pairs).T
    return edges[edge], face


@domain
def polyhedra_intersect(
    vertices_a: Vertices, faces_a: Faces, vertices_b: Vertices, faces_b: Faces
) -> bool:
    """Whether two solids have a point in common, convex or not (slide 9).

    Parameters
    ----------
    vertices_a : (v, 3), m
    faces_a : (f, 3), indices of the corners of A's faces
        The surface must be closed, and so must that of B.
    vertices_b : (v, 3), m
    faces_b : (f, 3), indices of the corners of B's faces

    Returns
    -------
    bool
        It is True also where the solids only touch, and where one of them, or
        a part of it, lies within the other. A solid that lies in the hollow of
        the other is not in it: False. As for `inside_by_parity`, faces may
        look either way, and what a surface encloses twice is outside. Vertices
        of no face do not count. A mesh without faces has nothing in common
        with anything.

    Raises
    ------
    ValueError
        If a surface is open.

    Notes
    -----
    Suppose that the two solids have a point in common. If their surfaces do
    not meet, a whole part of one solid is inside the other, and so are its
    vertices (`inside_by_parity`). If their surfaces meet, two faces meet, and
    an edge of one meets a face of the other (`edges_through_faces`). The
    function looks for both, in A and in B.

    Neither half will do by itself. A bar pushed through a cube has no vertex
    in the cube, and the cube has none in the bar. A small cube within a large
    one meets none of its faces. Nor will the edges of A alone: where a bar
    goes through the middle of a large face, its own edges go through that
    face, but no edge of the face goes through the bar.
    """
    a = vertices_a, faces_a
    b = vertices_b, faces_b
    # All vertices that belong to a face are the end of an edge.
    corners_a = vertices_a[np.unique(mesh_edges(*a))]
    corners_b = vertices_b[np.unique(mesh_edges(*b))]
    a_in_b = np.any(inside_by_parity(corners_a, *b))
    b_in_a = np.any(inside_by_parity(corners_b, *a))
    return bool(
        a_in_b
        or b_in_a
        or len(edges_through_faces(*a, *b)[1])
        or len(edges_through_faces(*b, *a)[1])
    )


def boxes_that_meet(first: Array, second: Array) -> tuple[Integers, Integers]:
    """Pairs of corner sets whose boxes touch or overlap.

    The sets have the shapes (m, corners, 3) and (n, corners, 3).
    """
    low_1, high_1 = np.min(first, axis=1), np.max(first, axis=1)
    low_2, high_2 = np.min(second, axis=1), np.max(second, axis=1)
    touch = np.ones((len(first), len(second)), dtype=bool)
    for axis in range(3):
        touch &= low_1[:, None, axis] <= high_2[:, axis]
        touch &= low_2[:, axis] <= high_1[:, None, axis]
    one, other = np.nonzero(touch)
    return one, other
