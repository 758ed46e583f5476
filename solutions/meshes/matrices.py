"""Stiffness and damping as matrices, and their products (slide 28)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import Number, domain
from solutions.meshes.mesh import Mesh
from solutions.meshes.springs import (
    across_edges,
    edge_directions,
    onto_nodes,
    require_fit,
)
from solutions.vectors import quotient


@domain
def edge_stiffness(
    mesh: Mesh, position: Number, clamped: bool = True
) -> Array:
    """Stiffness matrix K of every spring, for small displacements of its ends.

    If end 1 moves by d1 and end 2 by d2, the force on end 1 changes by −K d,
    with the relative displacement d = d1 − d2. The force on end 2 changes by
    +K d.

    Parameters
    ----------
    mesh : SpringMesh of n nodes and m springs
    position : (..., n, 3), m
    clamped : True or False, whether K has no negative eigenvalue
        A shortened spring has a negative stiffness across its edge, as it
        buckles. If clamped is true, zero is used in its place.

    Returns
    -------
    (..., m, 3, 3), N/m
        At zero length K is k I for a spring whose rest length is zero. For any
        other spring it is 0 there, as the edge has no direction.

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.

    Notes
    -----
    The spring pulls end 1 along −u with the tension t = k (L − L0). A small
    displacement d changes the length by u·d and turns the direction by
    (I − u uᵀ) d/L, which is the part of d across the edge divided by the
    length. By the product rule the force changes by

        −k (u·d) u − (t/L) (I − u uᵀ) d

    and comparing this with −K d gives

        g = 1 − L0/L
        K = k (u uᵀ + g (I − u uᵀ))

    Along the edge the stiffness is k. Across the edge it is k g, because the
    tension turns with the edge: a taut spring resists. In a shortened spring g
    is negative, so the spring buckles, and a step that relies on K may blow
    up. Clamped, g is never negative.
    """
    u, length = edge_directions(mesh, position)
    at_zero_length = np.where(mesh.rest_length > 0, 1.0, 0.0)
    g = 1 - quotient(mesh.rest_length, length, at_zero_length)
    if clamped:
        g = np.maximum(g, 0.0)
    # u uᵀ + g (I − u uᵀ) = (1 − g) u uᵀ + g I
    along = (1 - g)[..., None, None] * (u[..., :, None] * u[..., None, :])
    all_round = g[..., None, None] * np.eye(3)
    return mesh.stiffness[:, None, None] * (along + all_round)


@domain
def edge_damping(mesh: Mesh, position: Number) -> Array:
    """Damping matrix C of every damper, for the velocities of its ends.

    If the relative velocity v1 − v2 changes by Δ, the force on end 1 changes
    by −C Δ, and the force on end 2 by +C Δ.

    Parameters
    ----------
    mesh : SpringMesh of n nodes and m springs
    position : (..., n, 3), m

    Returns
    -------
    (..., m, 3, 3), N s/m
        Zero where the edge has zero length.

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.

    Notes
    -----
    The damper's force on end 1 is −k_d ((v1 − v2)·u) u. It is linear in
    v1 − v2, with

        C = k_d u uᵀ
    """
    u, _ = edge_directions(mesh, position)
    return mesh.damping[:, None, None] * (u[..., :, None] * u[..., None, :])


@domain
def mesh_product(mesh: Mesh, blocks: Number, vector: Number) -> Array:
    """Product of the matrix of the whole mesh with a vector.

    The product is added up edge by edge. The matrix itself is never built.

    Parameters
    ----------
    mesh : SpringMesh of n nodes and m springs
    blocks : (..., m, 3, 3), N/m or N s/m, one for each edge
        They are as `edge_stiffness` and `edge_damping` return them.
    vector : (..., n, 3), m or m/s, one for each node

    Returns
    -------
    (..., n, 3), N
        Pinned nodes are treated as if they were free.

    Raises
    ------
    ValueError
        If the vector does not fit the mesh.
    """
    require_fit(mesh, vector=vector)
    between = across_edges(mesh, vector)
    return onto_nodes(mesh, np.einsum("...ij,...j->...i", blocks, between))


@domain
def mesh_matrix(mesh: Mesh, blocks: Number) -> Array:
    """Matrix of the whole mesh, built from the blocks of its edges.

    Parameters
    ----------
    mesh : SpringMesh of n nodes and m springs
    blocks : (..., m, 3, 3), N/m or N s/m, one for each edge
        They are as `edge_stiffness` and `edge_damping` return them.

    Returns
    -------
    (..., 3 n, 3 n), N/m or N s/m
        The rows and columns are x, y, z of node 0, then of node 1, and so on.
        Pinned nodes are included as if they were free.

    Notes
    -----
    An edge with the block B gives end 1 the force −B (d1 − d2) and end 2 the
    opposite force. So every edge adds +B to the diagonal blocks of both its
    ends, and −B to the two blocks that couple them.
    """
    batch = blocks.shape[:-3]
    nodes = len(mesh.mass)
    matrix = np.zeros((*batch, nodes, nodes, 3, 3))
    by_pair = np.moveaxis(matrix, (-4, -3), (0, 1))
    by_edge = np.moveaxis(blocks, -3, 0)
    first, second = mesh.edges.T
    np.add.at(by_pair, (first, first), by_edge)
    np.add.at(by_pair, (second, second), by_edge)
    np.add.at(by_pair, (first, second), -by_edge)
    np.add.at(by_pair, (second, first), -by_edge)
    size = 3 * nodes
    return np.swapaxes(matrix, -3, -2).reshape(*batch, size, size)


def dot(a: Array, b: Array) -> Array:
    """Scalar product (..., 1, 1) over all nodes, of vectors (..., n, 3)."""
    return np.sum(a * b, axis=(-2, -1), keepdims=True)
