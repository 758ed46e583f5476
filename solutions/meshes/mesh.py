"""Parts of a mesh: nodes with a mass, edges as springs (slide 28).

Every edge has a spring, and a damper beside it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import finite, not_negative, positive


class _Parts(NamedTuple):
    edges: Integers
    rest_length: Array
    stiffness: Array
    damping: Array
    mass: Array
    pinned: Booleans


class SpringMesh(_Parts):
    """A spring mesh of n nodes and m springs, as read-only arrays.

    Rest length, stiffness, damping and pinned may be given as one number for
    all. The mesh is a tuple of its six arrays, with names: `mesh.edges` is the
    first of them.

    Attributes
    ----------
    edges : (m, 2), the nodes at the two ends of each spring
    rest_length : (m,), m, not negative and finite
    stiffness : (m,), N/m, not negative and finite
    damping : (m,), N s/m, not negative and finite
    mass : (n,), kg, positive
        Infinity for an immovable node, which counts as pinned.
    pinned : (n,), bool, the nodes that do not move
    inverse_mass : (n,), 1/kg, zero where the node is pinned

    Raises
    ------
    ValueError
        If an edge joins a node to itself or to one that does not exist, a mass
        is not positive, or any of the other numbers is negative or not finite.
    """

    __slots__ = ()

    def __new__(
        cls,
        edges: ArrayLike,
        rest_length: ArrayLike,
        stiffness: ArrayLike,
        damping: ArrayLike,
        mass: ArrayLike,
        pinned: ArrayLike,
    ) -> SpringMesh:
        """Make a mesh of its six arrays, and refuse impossible ones."""
        masses = positive("mass", mass).copy()
        if masses.ndim != 1:
            raise ValueError(
                f"mass must have the shape (nodes,), not {masses.shape}"
            )
        ends = checked_edges(edges, len(masses))
        flags = np.asarray(pinned, dtype=bool)
        held = np.broadcast_to(flags, masses.shape) | np.isinf(masses)
        rest, stiff, damp = (
            np.array(
                np.broadcast_to(
                    finite(name, not_negative(name, value)), ends.shape[:1]
                )
            )
            for name, value in (
                ("rest_length", rest_length),
                ("stiffness", stiffness),
                ("damping", damping),
            )
        )
        for array in (ends, rest, stiff, damp, masses, held):
            array.flags.writeable = False
        return super().__new__(cls, ends, rest, stiff, damp, masses, held)

    def _replace(self, **parts: Any) -> SpringMesh:
        """The mesh with other arrays, by name, checked again."""
        return SpringMesh(**{**self._asdict(), **parts})

    @property
    def inverse_mass(self) -> Array:
        """Inverse mass of every node, (n,), 1/kg: zero where it is pinned."""
        return np.where(self.pinned, 0.0, 1 / self.mass)


AnyMesh = (
    SpringMesh
    | tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike, ArrayLike, ArrayLike]
)
"""A `SpringMesh`, or a plain tuple in its order."""


def as_mesh(mesh: AnyMesh) -> SpringMesh:
    """Return the mesh; of a plain tuple of its arrays, make one."""
    return mesh if isinstance(mesh, SpringMesh) else SpringMesh(*mesh)


def lengths(vector: Array) -> Array:
    """Lengths of the vectors (..., 3).

    Every length of an edge is computed with this formula, so a mesh in its
    first shape is at rest to the last bit.
    """
    return np.asarray(np.sqrt(np.vecdot(vector, vector)))


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
        If the shape is another, an end is not one of the nodes 0 to nodes − 1,
        or both ends of an edge are the same node.
    """
    found = np.asarray(edges)
    if found.size == 0:
        return np.zeros((0, 2), dtype=np.int64)
    if found.ndim != 2 or found.shape[1] != 2 or found.dtype.kind not in "iu":
        raise ValueError(
            "edges must be integers of the shape (edges, 2), not"
            f" {found.dtype} of {found.shape}"
        )
    for edge in found[np.any((found < 0) | (found >= nodes), axis=1)]:
        raise ValueError(
            f"edges must join nodes from 0 to {nodes - 1}, not {edge.tolist()}"
        )
    for edge in found[found[:, 0] == found[:, 1]]:
        raise ValueError(
            f"edges must join two different nodes, not {edge.tolist()}"
        )
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
        The rest length of each spring is the distance between its ends in this
        shape.

    Raises
    ------
    ValueError
        As `SpringMesh` does. Also if a position is not finite, or a pinned
        node does not exist.
    """
    place = np.asarray(position, dtype=float)
    if (
        place.ndim != 2
        or place.shape[1] != 3
        or not np.all(np.isfinite(place))
    ):
        raise ValueError(
            "position must be finite and of the shape (nodes, 3), not"
            f" {place.shape}: {place}"
        )
    found = checked_edges(edges, len(place))
    length = lengths(place[found[:, 0]] - place[found[:, 1]])
    masses = np.broadcast_to(np.asarray(mass, dtype=float), len(place))
    mesh = SpringMesh(
        found,
        length,
        np.asarray(stiffness),
        np.asarray(damping),
        masses,
        np.zeros(len(place), bool),
    )
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
            raise ValueError(
                "pinned nodes are numbered from 0 to"
                f" {len(mesh.mass) - 1}, not {node}"
            )
    return mesh._replace(
        pinned=mesh.pinned | np.isin(np.arange(len(mesh.mass)), nodes)
    )
