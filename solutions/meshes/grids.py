"""Nodes and edges of a cloth and of a solid lattice (slide 28)."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from solutions.arrays import Array, Integers
from solutions.checks import positive

Offset = tuple[int, ...]
CLOTH_SPRINGS: Mapping[str, tuple[Offset, ...]] = {
    "structural": ((0, 1), (1, 0)),
    "shear": ((1, 1), (1, -1)),
    "bend": ((0, 2), (2, 0)),
}
"""Which nodes of a cloth each kind of spring joins.

An offset is (rows, columns) from the first end to the second.
"""
LATTICE_SPRINGS: Mapping[str, tuple[Offset, ...]] = {
    "structural": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "face": (
        (1, 1, 0),
        (1, -1, 0),
        (1, 0, 1),
        (1, 0, -1),
        (0, 1, 1),
        (0, 1, -1),
    ),
    "space": ((1, 1, 1), (1, 1, -1), (1, -1, 1), (1, -1, -1)),
}
"""Which nodes of a solid lattice each kind of spring joins.

"structural" springs are the edges of the cubes. The others are the internal
springs along the diagonals of their faces and of space.
"""


def cloth(
    rows: int,
    columns: int,
    spacing: float,
    kinds: Collection[str] = tuple(CLOTH_SPRINGS),
) -> tuple[Array, Integers]:
    """Nodes and edges of a flat cloth in the plane z = 0.

    Columns run along x and rows along y. Node (row, column) has the number
    row · columns + column.

    Parameters
    ----------
    rows, columns : numbers of nodes along y and x, at least 1
    spacing : distance of neighbours, m, positive
    kinds : any of "structural", "shear" and "bend"; by default all

    Returns
    -------
    position : (rows · columns, 3), m
    edges : (m, 2), of the wanted kinds

    Raises
    ------
    ValueError
        If a count or the spacing is not positive, or a kind is not known.

    Notes
    -----
    Structural springs join neighbours and keep their distance. Shear springs
    are the diagonals: without them a square becomes a rhombus at no cost of
    energy. Bend springs join every second node: without them the cloth folds
    at no cost of energy.
    """
    node = _node_numbers({"rows": rows, "columns": columns})
    row, column = np.divmod(np.arange(node.size), columns)
    position = positive("spacing", spacing) * np.stack(
        [column, row, np.zeros(node.size)], axis=-1
    )
    return position, _grid_edges(node, CLOTH_SPRINGS, kinds)


def lattice(
    nx: int,
    ny: int,
    nz: int,
    spacing: float,
    kinds: Collection[str] = tuple(LATTICE_SPRINGS),
) -> tuple[Array, Integers]:
    """Nodes and edges of a solid of nx × ny × nz nodes.

    Node (i, j, k), counted along x, y and z, has the number (i · ny + j) · nz
    + k.

    Parameters
    ----------
    nx, ny, nz : numbers of nodes along x, y and z, at least 1
    spacing : distance of neighbours, m, positive
    kinds : any of "structural", "face" and "space"; by default all

    Returns
    -------
    position : (nx · ny · nz, 3), m
    edges : (m, 2), of the wanted kinds

    Raises
    ------
    ValueError
        If a count or the spacing is not positive, or a kind is not known.

    Notes
    -----
    The structural springs are the edges of the cubes. On their own they let
    every cube shear and collapse. The internal springs along the diagonals of
    the faces and of space stabilise the shape (slide 28).
    """
    node = _node_numbers({"nx": nx, "ny": ny, "nz": nz})
    position = positive("spacing", spacing) * np.stack(
        np.unravel_index(np.arange(node.size), node.shape), axis=-1
    )
    return position, _grid_edges(node, LATTICE_SPRINGS, kinds)


def _node_numbers(counts: Mapping[str, int]) -> Integers:
    for name, count in counts.items():
        if count < 1:
            raise ValueError(f"{name} must be at least 1, not {count}")
    shape = tuple(counts.values())
    return np.arange(np.prod(shape)).reshape(shape)


def _grid_edges(
    node: Integers,
    springs: Mapping[str, tuple[Offset, ...]],
    kinds: Collection[str],
) -> Integers:
    """All pairs of nodes of a grid with an offset of the wanted kinds."""
    for kind in kinds:
        if kind not in springs:
            raise ValueError(f"kinds are {', '.join(springs)}, not {kind!r}")
    offsets = [
        offset
        for kind, group in springs.items()
        if kind in kinds
        for offset in group
    ]
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for offset in offsets:
        first = tuple(
            _within(size, step)
            for size, step in zip(node.shape, offset, strict=True)
        )
        second = tuple(
            _within(size, -step)
            for size, step in zip(node.shape, offset, strict=True)
        )
        pairs.append(
            np.stack([node[first].ravel(), node[second].ravel()], axis=-1)
        )
    return np.concatenate(pairs)


def _within(size: int, step: int) -> slice:
    """Places along an axis from which one step stays on the grid."""
    return slice(max(0, -step), max(0, size - max(0, step)))
