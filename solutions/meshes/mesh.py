"""A mesh: nodes with masses, and springs with dampers as edges (slide 28)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.checks import finite, positive
from solutions.domain import (
    FiniteNotNegative,
    Positive,
    Truth,
    domain,
    require,
)


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
        They are two different nodes.
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
        If an edge names a node that does not exist, or an array has too many
        numbers or too few.
    """

    __slots__ = ()

    @domain
    def __new__(
        cls,
        edges: Edges,
        rest_length: FiniteNotNegative,
        stiffness: FiniteNotNegative,
        damping: FiniteNotNegative,
        mass: Masses,
        pinned: Truth,
    ) -> SpringMesh:
        """Make a mesh of its six arrays, and refuse impossible ones."""
        require_nodes(edges, len(mass))
        parts = (
            edges,
            np.array(np.broadcast_to(rest_length, len(edges))),
            np.array(np.broadcast_to(stiffness, len(edges))),
            np.array(np.broadcast_to(damping, len(edges))),
            np.array(mass),
            np.broadcast_to(pinned, len(mass)) | np.isinf(mass),
        )
        for part in parts:
            part.flags.writeable = False
        return super().__new__(cls, *parts)

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


def as_mesh(_name: str, mesh: AnyMesh) -> SpringMesh:
    """Return the mesh; of a plain tuple of its arrays, make one."""
    return mesh if isinstance(mesh, SpringMesh) else SpringMesh(*mesh)


Mesh = Annotated[SpringMesh, as_mesh]
"""A `SpringMesh`; a plain tuple of its arrays is welcome."""


@domain
def spring_mesh(
    position: Places,
    edges: Edges,
    stiffness: FiniteNotNegative,
    damping: FiniteNotNegative = 0.0,
    mass: Positive = 1.0,
    pinned: Sequence[int] = (),
) -> SpringMesh:
    """Mesh in which every edge is a spring at rest in this shape (slide 28).

    Parameters
    ----------
    position : (n, 3), m, finite
    edges : (m, 2), the nodes at the two ends, two different ones
    stiffness : (m,) or one for all, N/m, not negative and finite
    damping : (m,) or one for all, N s/m, not negative and finite
    mass : (n,) or one for all, kg, of each node, positive
    pinned : a sequence of whole numbers, the nodes that do not move

    Returns
    -------
    SpringMesh
        The rest length of each spring is the distance between its ends in this
        shape.

    Raises
    ------
    ValueError
        If an edge names a node that does not exist, or a pinned node does not
        exist.
    """
    require_nodes(edges, len(position))
    first, second = edges.T
    mesh = SpringMesh(
        edges,
        lengths(position[first] - position[second]),
        stiffness,
        damping,
        np.broadcast_to(mass, len(position)),
        False,
    )
    return pin(mesh, pinned)


@domain
def pin(mesh: Mesh, nodes: Sequence[int]) -> SpringMesh:
    """The mesh with these nodes pinned, in addition to those that already are.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    nodes : a sequence of whole numbers, from 0 to n − 1

    Returns
    -------
    SpringMesh
        A new mesh; the given one stays as it is.

    Raises
    ------
    ValueError
        If a node does not exist.
    """
    count = len(mesh.mass)
    for node in nodes:
        words = f"pinned nodes are numbered from 0 to {count - 1}, not {node}"
        require(0 <= node < count, words)
    return mesh._replace(pinned=mesh.pinned | np.isin(np.arange(count), nodes))


def _edges(name: str, value: Any) -> Integers:
    """Return a copy of edges as (m, 2) integers, for none of them (0, 2)."""
    edges = np.asarray(value)
    if edges.size == 0:
        return np.zeros((0, 2), dtype=np.int64)
    if edges.ndim != 2 or edges.shape[1] != 2 or edges.dtype.kind not in "iu":
        raise ValueError(
            f"{name} must be integers of the shape (edges, 2), not"
            f" {edges.dtype} of {edges.shape}"
        )
    for edge in edges[edges[:, 0] == edges[:, 1]]:
        raise ValueError(
            f"{name} must join two different nodes, not {edge.tolist()}"
        )
    return edges.astype(np.int64)


def _per_node(name: str, vectors: Array) -> Array:
    """Return vectors (n, 3); refuse other shapes."""
    words = f"{name} must be finite and of the shape (nodes, 3), not"
    require(vectors.shape[1:] == (3,), f"{words} {vectors.shape}")
    return vectors


def _in_a_row(name: str, masses: Array) -> Array:
    """Return masses (n,); refuse other shapes."""
    words = f"{name} must have the shape (nodes,), not"
    require(masses.ndim == 1, f"{words} {masses.shape}")
    return masses


Edges = Annotated[Integers, _edges]
"""(m, 2), the nodes at the two ends of each spring; these are two nodes."""
Places = Annotated[Array, finite, _per_node]
"""(n, 3), finite."""
Masses = Annotated[Array, positive, _in_a_row]
"""(n,), positive. Infinity is the mass of an immovable node."""


def lengths(vector: Array) -> Array:
    """Lengths of the vectors (..., 3).

    Every length of an edge is computed with this formula, so a mesh in its
    first shape is at rest to the last bit.
    """
    return np.sqrt(np.vecdot(vector, vector))


def require_nodes(edges: Integers, nodes: int) -> None:
    """Raise a ValueError unless all ends are nodes from 0 to nodes − 1."""
    for edge in edges[np.any((edges < 0) | (edges >= nodes), axis=1)]:
        raise ValueError(
            f"edges must join nodes from 0 to {nodes - 1}, not {edge.tolist()}"
        )
