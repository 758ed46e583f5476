"""Nodes and edges of a cloth and of a solid lattice (slide 28)."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Annotated

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import Positive, domain, require

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


@domain
def cloth(
    rows: Count,
    columns: Count,
    spacing: Positive,
    kinds: Collection[str] = tuple(CLOTH_SPRINGS),
) -> tuple[Array, Integers]:
    """Nodes and edges of a flat cloth in the plane z = 0.

    Columns run along x and rows along y. Node (row, column) has the number
    row · columns + column.

    Parameters
    ----------
    rows, columns : whole numbers of nodes along y and x, at least 1
    spacing : one number, distance of neighbours, m, positive
    kinds : any of "structural", "shear" and "bend"; by default all

    Returns
    -------
    position : (rows · columns, 3), m
    edges : (m, 2), of these kinds

    Raises
    ------
    ValueError
        If a kind is not known.

    Notes
    -----
    Structural springs join neighbours and keep their distance. Shear springs
    are the diagonals: without them a square becomes a rhombus at no cost of
    energy. Bend springs join every second node: without them the cloth folds
    at no cost of energy.
    """
    node = np.arange(rows * columns).reshape(rows, columns)
    row, column = np.divmod(node.ravel(), columns)
    # x counts columns, and y counts rows.
    place = np.stack([column, row, np.zeros(node.size)], axis=-1)
    return spacing * place, _grid_edges(node, CLOTH_SPRINGS, kinds)


@domain
def lattice(
    nx: Count,
    ny: Count,
    nz: Count,
    spacing: Positive,
    kinds: Collection[str] = tuple(LATTICE_SPRINGS),
) -> tuple[Array, Integers]:
    """Nodes and edges of a solid of nx × ny × nz nodes.

    Node (i, j, k), counted along x, y and z, has the number
    (i · ny + j) · nz + k.

    Parameters
    ----------
    nx, ny, nz : whole numbers of nodes along x, y and z, at least 1
    spacing : one number, distance of neighbours, m, positive
    kinds : any of "structural", "face" and "space"; by default all

    Returns
    -------
    position : (nx · ny · nz, 3), m
    edges : (m, 2), of these kinds

    Raises
    ------
    ValueError
        If a kind is not known.

    Notes
    -----
    The structural springs are the edges of the cubes. On their own they let
    every cube shear and collapse. The internal springs along the diagonals of
    the faces and of space stabilise the shape (slide 28).
    """
    node = np.arange(nx * ny * nz).reshape(nx, ny, nz)
    place = np.stack(np.unravel_index(node.ravel(), node.shape), axis=-1)
    return spacing * place, _grid_edges(node, LATTICE_SPRINGS, kinds)


def _grid_edges(
    node: Integers,
    springs: Mapping[str, tuple[Offset, ...]],
    kinds: Collection[str],
) -> Integers:
    """All pairs of nodes of a grid with an offset of these kinds."""
    for kind in kinds:
        if kind not in springs:
            raise ValueError(f"kinds are {', '.join(springs)}, not {kind!r}")
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for kind, offsets in springs.items():
        for offset in offsets if kind in kinds else ():
            first = node[_within(node.shape, offset)]
            second = node[_within(node.shape, tuple(-n for n in offset))]
            pairs.append(np.stack([first.ravel(), second.ravel()], axis=-1))
    return np.concatenate(pairs)


def _within(shape: Offset, offset: Offset) -> tuple[slice, ...]:
    """Places of a grid from which the offset does not lead out of it."""
    return tuple(
        slice(max(0, -step), max(0, size - max(0, step)))
        for size, step in zip(shape, offset, strict=True)
    )


def _count(name: str, count: int) -> int:
    require(count >= 1, f"{name} must be at least 1, not {count}")
    return count


Count = Annotated[int, _count]
"""1, 2, 3 …"""
