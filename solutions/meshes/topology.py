"""What a spring mesh is made of: nodes with a mass and edges as springs (slide 28).

Every edge has a spring, and a damper beside it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import not_negative, positive

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]
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
    "face": ((1, 1, 0), (1, -1, 0), (1, 0, 1), (1, 0, -1), (0, 1, 1), (0, 1, -1)),
    "space": ((1, 1, 1), (1, 1, -1), (1, -1, 1), (1, -1, -1)),
}
"""Which nodes of a solid lattice each kind of spring joins.

"structural" springs are the edges of the cubes. The others are the internal springs
along the diagonals of their faces and of space.
"""


@dataclass(frozen=True, eq=False)
class SpringMesh:
    """A spring mesh of n nodes and m springs, as plain arrays that nothing writes to.

    Rest length, stiffness, damping and pinned may be given as one number for all.

    Parameters
    ----------
    edges : (m, 2), the nodes at the two ends of each spring
    rest_length : (m,), m, not negative and finite
    stiffness : (m,), N/m, not negative and finite
    damping : (m,), N s/m, not negative and finite
    mass : (n,), kg, positive; infinity for an immovable node, which counts as pinned
    pinned : (n,), bool, the nodes that do not move

    Raises
    ------
    ValueError
        If an edge joins a node to itself or to one that does not exist, a mass is not
        positive, or any of the other numbers is negative or not finite.
    """

    edges: Integers
    rest_length: Array
    stiffness: Array
    damping: Array
    mass: Array
    pinned: Booleans

    def __post_init__(self) -> None:
        mass = positive("mass", self.mass)
        if mass.ndim != 1:
            raise ValueError(f"mass must have the shape (nodes,), not {mass.shape}")
        edges = checked_edges(self.edges, len(mass))
        pinned = np.broadcast_to(np.asarray(self.pinned, dtype=bool), mass.shape) | np.isinf(mass)
        found: dict[str, NDArray[np.generic]] = {"edges": edges, "mass": mass.copy(), "pinned": pinned}
        for name in ("rest_length", "stiffness", "damping"):
            found[name] = np.array(np.broadcast_to(_finite(name, getattr(self, name)), edges.shape[:1]))
        for name, array in found.items():
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def inverse_mass(self) -> Array:
        """Inverse mass of every node, (n,), 1/kg: zero where the node is pinned."""
        return np.where(self.pinned, 0.0, 1 / self.mass)


def _finite(name: str, value: ArrayLike) -> Array:
    array = not_negative(name, value)
    if np.any(np.isinf(array)):
        raise ValueError(f"{name} must be finite, not inf")
    return array


def lengths(vector: Array) -> Array:
    """Lengths of the vectors (..., 3).

    Every length of an edge is computed with this formula, so a mesh in its first shape
    is at rest to the last bit.
    """
    return np.asarray(np.sqrt(np.einsum("...i,...i->...", vector, vector)))


def checked_edges(edges: ArrayLike, nodes: int) -> Integers:
    """Return a copy of the edges as (m, 2) integers, if they can be edges.

    Parameters
    ----------
    edges : (m, 2), integers; an empty list means that there are no edges
    nodes : number of nodes

    Returns
    -------
    (m, 2), a copy; (0, 2) if there are no edges

    Raises
    ------
    ValueError
        If the shape is another, an end is not one of the nodes 0 to nodes − 1, or both
        ends of an edge are the same node.
    """
    found = np.asarray(edges)
    if found.size == 0:
        return np.zeros((0, 2), dtype=np.int64)
    if found.ndim != 2 or found.shape[1] != 2 or found.dtype.kind not in "iu":
        raise ValueError(f"edges must be integers of the shape (edges, 2), not {found.dtype} of {found.shape}")
    for edge in found[np.any((found < 0) | (found >= nodes), axis=1)]:
        raise ValueError(f"edges must join nodes from 0 to {nodes - 1}, not {edge.tolist()}")
    for edge in found[found[:, 0] == found[:, 1]]:
        raise ValueError(f"edges must join two different nodes, not {edge.tolist()}")
    return found.astype(np.int64)


def spring_mesh(
    position: ArrayLike,
    edges: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
    mass: ArrayLike = 1.0,
    pinned: Sequence[int] = (),
) -> SpringMesh:
    """Mesh in which every edge is a spring at rest in this shape (slide 28).

    Parameters
    ----------
    position : (n, 3), m
    edges : (m, 2), the nodes at the two ends
    stiffness, damping : (m,) or one for all, N/m and N s/m
    mass : (n,) or one for all, kg, of each node
    pinned : numbers of the nodes that do not move

    Returns
    -------
    SpringMesh
        The rest length of each spring is the distance between its ends in this shape.

    Raises
    ------
    ValueError
        As `SpringMesh` does. Also if a position is not finite, or a pinned node does
        not exist.
    """
    place = np.asarray(position, dtype=float)
    if place.ndim != 2 or place.shape[1] != 3 or not np.all(np.isfinite(place)):
        raise ValueError(f"position must be finite and of the shape (nodes, 3), not {place.shape}: {place}")
    found = checked_edges(edges, len(place))
    length = lengths(place[found[:, 0]] - place[found[:, 1]])
    masses = np.broadcast_to(np.asarray(mass, dtype=float), len(place))
    mesh = SpringMesh(found, length, np.asarray(stiffness), np.asarray(damping), masses, np.zeros(len(place), bool))
    return pin(mesh, pinned)


def pin(mesh: SpringMesh, nodes: Sequence[int]) -> SpringMesh:
    """The mesh with these nodes pinned, in addition to those that already are.

    Parameters
    ----------
    nodes : numbers of the nodes, from 0 on

    Returns
    -------
    SpringMesh
        A new mesh; the given one stays as it is.

    Raises
    ------
    ValueError
        If a node does not exist.
    """
    for node in nodes:
        if not 0 <= node < len(mesh.mass):
            raise ValueError(f"pinned nodes are numbered from 0 to {len(mesh.mass) - 1}, not {node}")
    return replace(mesh, pinned=mesh.pinned | np.isin(np.arange(len(mesh.mass)), nodes))


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
    Structural springs join neighbours and keep their distance. Shear springs are the
    diagonals: without them a square becomes a rhombus at no cost of energy. Bend
    springs join every second node: without them the cloth folds at no cost of energy.
    """
    node = _node_numbers({"rows": rows, "columns": columns})
    row, column = np.divmod(np.arange(node.size), columns)
    position = positive("spacing", spacing) * np.stack([column, row, np.zeros(node.size)], axis=-1)
    return position, _grid_edges(node, CLOTH_SPRINGS, kinds)


def lattice(
    nx: int,
    ny: int,
    nz: int,
    spacing: float,
    kinds: Collection[str] = tuple(LATTICE_SPRINGS),
) -> tuple[Array, Integers]:
    """Nodes and edges of a solid of nx × ny × nz nodes.

    Node (i, j, k), counted along x, y and z, has the number (i · ny + j) · nz + k.

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
    The structural springs are the edges of the cubes. On their own they let every cube
    shear and collapse. The internal springs along the diagonals of the faces and of
    space stabilise the shape (slide 28).
    """
    node = _node_numbers({"nx": nx, "ny": ny, "nz": nz})
    position = positive("spacing", spacing) * np.stack(np.unravel_index(np.arange(node.size), node.shape), axis=-1)
    return position, _grid_edges(node, LATTICE_SPRINGS, kinds)


def _node_numbers(counts: Mapping[str, int]) -> Integers:
    for name, count in counts.items():
        if count < 1:
            raise ValueError(f"{name} must be at least 1, not {count}")
    shape = tuple(counts.values())
    return np.arange(np.prod(shape)).reshape(shape)


def _grid_edges(node: Integers, springs: Mapping[str, tuple[Offset, ...]], kinds: Collection[str]) -> Integers:
    """All pairs of nodes of a grid whose offset belongs to one of the wanted kinds."""
    for kind in kinds:
        if kind not in springs:
            raise ValueError(f"kinds are {', '.join(springs)}, not {kind!r}")
    offsets = [offset for kind, group in springs.items() if kind in kinds for offset in group]
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for offset in offsets:
        first = tuple(_within(size, step) for size, step in zip(node.shape, offset, strict=True))
        second = tuple(_within(size, -step) for size, step in zip(node.shape, offset, strict=True))
        pairs.append(np.stack([node[first].ravel(), node[second].ravel()], axis=-1))
    return np.concatenate(pairs)


def _within(size: int, step: int) -> slice:
    """Places along an axis from which one step stays on the grid."""
    return slice(max(0, -step), max(0, size - max(0, step)))
