"""Springs of a surface of triangles (slide 28: edges are springs)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Integers


def surface_edges(triangles: ArrayLike) -> Integers:
    """Edges of a surface, each of them once, however many triangles share it.

    Parameters
    ----------
    triangles : (t, 3), the nodes at the corners, in either sense

    Returns
    -------
    (m, 2), in ascending order, the smaller node first

    Raises
    ------
    ValueError
        If the triangles are not integers of the shape (t, 3), a node is
        negative, or a triangle has the same corner twice.
    """
    return np.asarray(
        np.unique(_sides(_checked_triangles(triangles))[0], axis=0)
    )


def bend_edges(triangles: ArrayLike) -> Integers:
    """Pairs of nodes that face each other across an edge (bend springs).

    Two triangles share such an edge, and the pair are the two corners opposite
    to it.

    Parameters
    ----------
    triangles : (t, 3), the nodes at the corners, in either sense

    Returns
    -------
    (b, 2), in ascending order, the smaller node first
        An edge at the rim has no pair. A pair that is already an edge is left
        out: in a tetrahedron all pairs are. A pair that faces across several
        edges comes once: in an octahedron all pairs do. Two triangles with the
        same three corners have no pair.

    Raises
    ------
    ValueError
        As `surface_edges` does. Also if more than two triangles share an edge,
        because then no two corners face each other.

    Notes
    -----
    Two springs between the same two nodes act as one spring that is twice as
    stiff. This is why no pair comes twice, and why no pair that is already an
    edge is returned.
    """
    sides, facing = _sides(_checked_triangles(triangles))
    edges, which, count = np.unique(
        sides, axis=0, return_inverse=True, return_counts=True
    )
    for edge in edges[count > 2]:
        raise ValueError(
            f"triangles: more than two share the edge {edge.tolist()}"
        )
    order = np.argsort(which.ravel(), kind="stable")
    # The place in that order from which the two sides of an inner edge are
    # listed.
    start = np.cumsum(count)[count == 2] - 2
    pairs = np.unique(
        np.sort(
            np.stack(
                [facing[order[start]], facing[order[start + 1]]], axis=-1
            ),
            axis=-1,
        ),
        axis=0,
    )
    known = {tuple(edge) for edge in edges.tolist()}
    fresh = [
        tuple(pair) not in known and pair[0] != pair[1]
        for pair in pairs.tolist()
    ]
    return np.asarray(pairs[np.array(fresh, dtype=bool)])


def _sides(triangles: Integers) -> tuple[Integers, Integers]:
    """Sides of all triangles, (3 t, 2), and the corners that face them.

    The smaller node of a side comes first.
    """
    sides = np.concatenate(
        [triangles[:, [1, 2]], triangles[:, [2, 0]], triangles[:, [0, 1]]]
    )
    return np.sort(sides, axis=-1), triangles.T.ravel()


def _checked_triangles(triangles: ArrayLike) -> Integers:
    found = np.asarray(triangles)
    if found.ndim != 2 or found.shape[1] != 3 or found.dtype.kind not in "iu":
        raise ValueError(
            "triangles must be integers of the shape (triangles, 3), not"
            f" {found.dtype} of {found.shape}"
        )
    if np.any(found < 0):
        raise ValueError(
            f"triangles must name nodes from 0 on, not {found.min()}"
        )
    for corners in found[np.any(found == np.roll(found, 1, axis=1), axis=1)]:
        raise ValueError(
            "triangles must have three different corners, not"
            f" {corners.tolist()}"
        )
    return found.astype(np.int64)
