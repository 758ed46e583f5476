"""The linear system of an implicit step, solved but never built (slide 28)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from solutions.arrays import Array, Integers
from solutions.checks import finite
from solutions.domain import Number, domain
from solutions.meshes.mesh import Mesh, SpringMesh
from solutions.meshes.springs import held, require_fit
from solutions.vectors import quotient

ROUNDING = 64 * np.finfo(float).eps
"""Share of the largest terms that rounding may leave of a residual."""


@domain
def conjugate_gradient(
    mesh: Mesh,
    blocks: Number,
    right: Number,
    tolerance: float = 1e-8,
    iterations: int | None = None,
) -> Array:
    """Solution x of (M + B) x = r for the free nodes, by conjugate gradients.

    M holds the masses of the nodes, and B is the matrix of the mesh with the
    given blocks. M + B must be positive definite: use clamped blocks.

    Parameters
    ----------
    mesh : SpringMesh of n nodes and m springs
    blocks : (..., m, 3, 3), one block for each edge, kg
    right : (..., n, 3), r, kg m/s, finite at free nodes
        The values at pinned nodes have no influence.
    tolerance : one number, largest residual of any node
        It is measured relative to the mass of that node times the largest x of
        all nodes. So a light node is solved as well as the heavy ones beside
        it.
    iterations : whole number, the most rounds
        The default is ten times the number of unknowns, as rounding costs some
        rounds.

    Returns
    -------
    (..., n, 3), x, m/s
        Zero at pinned nodes.

    Raises
    ------
    RuntimeError
        If a residual is still too large after the last round.
    ValueError
        If the right side does not fit the mesh, or is not finite at a free
        node: no residual would reveal that.

    Notes
    -----
    Every round moves x along a direction d that is conjugate to the directions
    d' of all earlier rounds,

        dᵀ(M + B) d' = 0

    and it moves x until the residual has no part along d. A conjugate
    direction does not undo what the earlier rounds have achieved. So n
    unknowns need at most n rounds, except for rounding.

    Each direction starts from P s, where s is the residual, and P holds the
    inverse of every node's own 3 × 3 block of M + B. P s says how far each
    node would go if its neighbours stayed where they are. The residual itself
    would be a poor start beside heavy nodes: theirs are large for no other
    reason than their mass.
    """
    require_fit(mesh, right=right)
    right = finite("right", held(mesh, right))
    system, r = _System.of(mesh, blocks, right)
    x = np.zeros_like(r)
    d = np.zeros_like(r)
    residual = r
    square = np.zeros(())
    for _ in range(30 * len(mesh.mass) if iterations is None else iterations):
        start = system.alone(residual)
        unsolved = system.worst(residual, x + start) > tolerance
        if not np.any(unsolved):
            break
        before = square
        square = np.where(unsolved, _dot(residual, start), square)
        d = start + quotient(square, before) * d
        product = system.product(d)
        curvature = np.where(unsolved, _dot(d, product), 0.0)
        step = quotient(square, curvature)
        x = x + step * d
        residual = residual - step * product
    worst = system.worst(r - system.product(x), x, ROUNDING)
    if np.any(worst > tolerance):
        raise RuntimeError(
            "conjugate gradients: a node has a residual of"
            f" {np.max(worst):.1e} of its mass times the largest result;"
            f" {tolerance:.1e} is allowed"
        )
    return np.moveaxis(x, 0, -1)


@dataclass(frozen=True)
class _System:
    """M + B of the free nodes, for vectors (3, ..., n).

    blocks : (3, 3, ..., m), of the edges
    own : (3, 3, ..., n), the block of each node on the diagonal of M + B
    inverse : of these blocks
    mass : (n,), that of pinned nodes is 1 and has no influence
    ends : two of (3 N m,), for N systems that are solved at once
        In the vectors as one row, they are the places of both ends of every
        edge.
    """

    mesh: SpringMesh
    blocks: Array
    own: Array
    inverse: Array
    mass: Array
    ends: tuple[Integers, Integers]

    @classmethod
    def of(
        cls, mesh: SpringMesh, blocks: Array, right: Array
    ) -> tuple[_System, Array]:
        """Return the system and its right side, (3, ..., n)."""
        nodes = len(mesh.mass)
        mass = np.where(mesh.pinned, 1.0, mesh.mass)
        own = np.zeros((nodes, *blocks.shape[:-3], 3, 3))
        for end in mesh.edges.T:
            np.add.at(own, end, np.moveaxis(blocks, -3, 0))
        own = np.moveaxis(own, 0, -3) + mass[:, None, None] * np.eye(3)

        batch = np.broadcast_shapes(blocks.shape[:-3], right.shape[:-2])
        row = np.arange(3 * math.prod(batch))[:, None] * nodes
        first, second = mesh.edges.T
        system = cls(
            mesh,
            _nodes_last(blocks, 2),
            _nodes_last(own, 2),
            _nodes_last(np.linalg.inv(own), 2),
            mass,
            ((row + first).ravel(), (row + second).ravel()),
        )
        right = np.broadcast_to(right, (*batch, nodes, 3))
        return system, _nodes_last(right, 1)

    def product(self, x: Array) -> Array:
        """(M + B) x, added up edge by edge; 0 at pinned nodes."""
        first, second = self.mesh.edges.T
        between = np.take(x, first, axis=-1) - np.take(x, second, axis=-1)
        force = np.einsum("ij...,j...->i...", self.blocks, between).ravel()
        gained, lost = (np.bincount(end, force, x.size) for end in self.ends)
        product = self.mass * x + (gained - lost).reshape(x.shape)
        return np.where(self.mesh.pinned, 0.0, product)

    def alone(self, residual: Array) -> Array:
        """How far each node would go if all others stayed where they are."""
        return np.einsum("ij...,j...->i...", self.inverse, residual)

    def worst(self, residual: Array, x: Array, rounding: float = 0.0) -> Array:
        """Largest residual (..., 1) of a node, over mass times largest x.

        A share of the largest terms that make up the residual may be left as
        rounding.
        """
        size = _lengths(x).max(axis=-1, keepdims=True, initial=0.0)
        left = _lengths(residual) - rounding * np.trace(self.own) * size
        worst = (left / self.mass).max(axis=-1, keepdims=True, initial=0.0)
        return quotient(worst, size, worst)


def _nodes_last(array: Array, axes: int) -> Array:
    """The array with its last axes, those of x, y and z, as the first ones."""
    moved = np.moveaxis(array, range(-axes, 0), range(axes))
    return np.ascontiguousarray(moved)


def _lengths(vectors: Array) -> Array:
    """Lengths (..., n) of vectors (3, ..., n)."""
    return np.sqrt(np.einsum("i...,i...->...", vectors, vectors))


def _dot(a: Array, b: Array) -> Array:
    """Scalar product (..., 1) over all nodes, of vectors (3, ..., n)."""
    return np.einsum("i...n,i...n->...", a, b)[..., None]
