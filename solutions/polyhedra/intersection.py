"""Whether two polyhedra intersect, and which edges meet faces (slide 9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.polyhedra.inside import inside_by_parity
from solutions.polyhedra.segments import segment_meets_triangle
from solutions.polyhedra.surface import blocks, checked_mesh, mesh_edges


def edges_through_faces(
    vertices_a: ArrayLike,
    faces_a: ArrayLike,
    vertices_b: ArrayLike,
    faces_b: ArrayLike,
) -> tuple[Integers, Integers]:
    """All edges of A that meet a face of B (slide 9).

    The function decides exactly, and touching counts. An edge is listed once
    for each face that it meets.

    Parameters
    ----------
    vertices_a : (v, 3), m
    faces_a : (f, 3), indices of the corners
    vertices_b, faces_b : the same of B

    Returns
    -------
    edge : (k, 2), vertices of A at the ends of the edge
    face : (k,), index of the face of B that it meets
        `segment_triangle` gives the place where they meet. Both arrays are
        empty if nothing meets.

    Raises
    ------
    ValueError
        If the vertices of a mesh are not finite or do not fit its faces.
    """
    a, _ = checked_mesh(vertices_a, faces_a)
    b, f = checked_mesh(vertices_b, faces_b)
    edges = mesh_edges(vertices_a, faces_a)
    found = [(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64))]
    for block in blocks(len(edges), len(f)):
        edge, face = boxes_that_meet(a[edges[block]], b[f])
        start, end = np.moveaxis(a[edges[block][edge]], 1, 0)
        meets = segment_meets_triangle(start, end, b[f[face]])
        found.append((edge[meets] + block.start, face[meets]))
    edge, face = (np.concatenate(part) for part in zip(*found, strict=True))
    return edges[edge], face


def polyhedra_intersect(
    vertices_a: ArrayLike,
    faces_a: ArrayLike,
    vertices_b: ArrayLike,
    faces_b: ArrayLike,
) -> bool:
    """Whether two solids have a point in common, convex or not (slide 9).

    Parameters
    ----------
    vertices_a : (v, 3), m
    faces_a : (f, 3), indices of the corners
        The surface must be closed.
    vertices_b, faces_b : the same of B

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
        If a surface is open, or the vertices of a mesh are not finite or do
        not fit its faces.

    Notes
    -----
    Suppose that the two solids have a point in common. Either their surfaces
    meet as well. Then two faces meet, and an edge of one meets a face of the
    other (`edges_through_faces`). Or the surfaces do not meet. Then a whole
    part of one solid is inside the other, and so are its vertices
    (`inside_by_parity`). The function looks for both, in A and in B.

    Neither half will do by itself. A bar pushed through a cube has no vertex
    in the cube, and the cube has none in the bar. A small cube within a large
    one meets none of its faces. Nor will the edges of A alone: where a bar
    goes through the middle of a large face, its own edges go through that
    face, but no edge of the face goes through the bar.
    """
    a, b = checked_mesh(vertices_a, faces_a), checked_mesh(vertices_b, faces_b)
    inside = [
        np.any(inside_by_parity(one[0][np.unique(one[1])], *other))
        for one, other in ((a, b), (b, a))
    ]
    return (
        any(inside)
        or len(edges_through_faces(*a, *b)[1]) > 0
        or len(edges_through_faces(*b, *a)[1]) > 0
    )


def boxes_that_meet(first: Array, second: Array) -> tuple[Integers, Integers]:
    """Pairs of corner sets whose boxes touch or overlap.

    The sets have the shapes (m, corners, 3) and (n, corners, 3).
    """
    low_1, high_1 = np.min(first, axis=1), np.max(first, axis=1)
    low_2, high_2 = np.min(second, axis=1), np.max(second, axis=1)
    touch = np.ones((len(first), len(second)), dtype=bool)
    for axis in range(3):
        touch &= (low_1[:, None, axis] <= high_2[:, axis]) & (
            low_2[:, axis] <= high_1[:, None, axis]
        )
    one, other = np.nonzero(touch)
    return one, other
