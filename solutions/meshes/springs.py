"""What the springs of a mesh do: their forces, their energy, and how both change with the shape (slides 27 to 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.meshes.topology import Array, SpringMesh, lengths


def node_vectors(mesh: SpringMesh, name: str, value: ArrayLike) -> Array:
    """Return the value as (..., n, 3) floats, one vector a node of the mesh.

    Raises
    ------
    ValueError
        If it has another shape.
    """
    array = np.asarray(value, dtype=float)
    if array.shape[-2:] != (len(mesh.mass), 3):
        raise ValueError(f"{name} must have the shape (..., {len(mesh.mass)}, 3), not {array.shape}")
    return array


def finite_vectors(mesh: SpringMesh, name: str, value: ArrayLike) -> Array:
    """Return the value as `node_vectors` does, where infinity or NaN would lead to a wrong number without a trace.

    Raises
    ------
    ValueError
        If it has another shape, or a number in it is not finite.
    """
    array = node_vectors(mesh, name, value)
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name} must be finite, not {array[~np.isfinite(array)][0]}")
    return array


def across_edges(mesh: SpringMesh, vector: Array) -> Array:
    """Difference of a nodes' quantity (..., n, 3) over every edge, (..., m, 3): end 1 less end 2."""
    return np.asarray(np.take(vector, mesh.edges[:, 0], axis=-2) - np.take(vector, mesh.edges[:, 1], axis=-2))


def onto_nodes(mesh: SpringMesh, force: Array) -> Array:
    """Sum for every node, (..., n, 3), of what the edges (..., m, 3) do to it: plus on end 1, minus on end 2."""
    shape = (*force.shape[:-2], len(mesh.mass), 3)
    batch = np.arange(np.prod(shape[:-2], dtype=int))[:, None]
    first, second = (
        ((batch * shape[-2] + end)[..., None] * 3 + np.arange(3)).ravel()
        for end in (mesh.edges[:, 0], mesh.edges[:, 1])
    )
    size = int(np.prod(shape))
    return np.asarray(np.bincount(first, force.ravel(), size) - np.bincount(second, force.ravel(), size)).reshape(shape)


def edge_directions(mesh: SpringMesh, position: ArrayLike) -> tuple[Array, Array]:
    """Unit vector u from end 2 to end 1 of every edge, and its length L.

    Parameters
    ----------
    position : (..., n, 3), m

    Returns
    -------
    direction : (..., m, 3); zero where both ends are at the same place: such an edge has no direction
    length : (..., m), m
    """
    between = across_edges(mesh, node_vectors(mesh, "position", position))
    length = lengths(between)
    return between / np.where(length > 0, length, 1.0)[..., None], length


def mesh_forces(mesh: SpringMesh, position: ArrayLike, velocity: ArrayLike) -> Array:
    """Force of springs and dampers on every node (slides 28 and 29).

    Slide 29 has F = (x' − x_rest) k − v k_d, which pushes away from rest and damps all motion. Along an edge it is

        F = −k (L − L0) u − k_d ((v1 − v2)·u) u    on end 1, and −F on end 2

    Parameters
    ----------
    position, velocity : (..., n, 3), m and m/s

    Returns
    -------
    (..., n, 3), N; on a pinned node what its springs pull with. An edge of no length has no direction, and no force.
    """
    u, length = edge_directions(mesh, position)
    rate = np.einsum("...i,...i->...", across_edges(mesh, node_vectors(mesh, "velocity", velocity)), u)
    tension = mesh.stiffness * (length - mesh.rest_length) + mesh.damping * rate
    return onto_nodes(mesh, -tension[..., None] * u)


def mesh_energy(mesh: SpringMesh, position: ArrayLike) -> Array:
    """Energy stored in the springs: Σ k (L − L0)²/2.

    Parameters
    ----------
    position : (..., n, 3), m

    Returns
    -------
    (...), J
    """
    stretch = edge_directions(mesh, position)[1] - mesh.rest_length
    return np.asarray(np.sum(mesh.stiffness * stretch**2 / 2, axis=-1))


def edge_strain(mesh: SpringMesh, position: ArrayLike) -> Array:
    """Strain of every spring: (L − L0)/L0, negative when it is shortened.

    Parameters
    ----------
    position : (..., n, 3), m

    Returns
    -------
    (..., m); zero for a spring of no rest length, which has no strain
    """
    stretch = edge_directions(mesh, position)[1] - mesh.rest_length
    return np.where(mesh.rest_length > 0, stretch / np.where(mesh.rest_length > 0, mesh.rest_length, 1.0), 0.0)


def edge_stiffness(mesh: SpringMesh, position: ArrayLike, clamped: bool = True) -> Array:
    """How the force of every spring answers a small displacement d = d1 − d2 of its ends: it changes by −K d on end 1.

        K = k (u uᵀ + g (I − u uᵀ)),    g = 1 − L0/L

    Along the edge that is k. Across it the tension turns with the edge: a taut spring resists, but in a shortened one
    g is negative, so that it buckles, and a step that relies on K may blow up. Clamped, g is at least 0.

    Parameters
    ----------
    position : (..., n, 3), m
    clamped : whether g < 0 is taken as 0, so that no K has a negative eigenvalue

    Returns
    -------
    (..., m, 3, 3), N/m. At no length: k I for a spring of no rest length, else 0, as there is no direction.
    """
    u, length = edge_directions(mesh, position)
    across = 1 - mesh.rest_length / np.where(length > 0, length, 1.0)
    across = np.where(length > 0, across, np.where(mesh.rest_length > 0, 0.0, 1.0))
    g = np.maximum(across, 0.0) if clamped else across
    along = (1 - g)[..., None, None] * (u[..., :, None] * u[..., None, :])
    return np.asarray(mesh.stiffness[:, None, None] * (along + g[..., None, None] * np.eye(3)))


def edge_damping(mesh: SpringMesh, position: ArrayLike) -> Array:
    """How the force of every damper answers a change of its ends' velocities: by −C (v1 − v2), C = k_d u uᵀ.

    Parameters
    ----------
    position : (..., n, 3), m

    Returns
    -------
    (..., m, 3, 3), N s/m; zero at no length
    """
    u, _ = edge_directions(mesh, position)
    return np.asarray(mesh.damping[:, None, None] * (u[..., :, None] * u[..., None, :]))


def mesh_product(mesh: SpringMesh, blocks: ArrayLike, vector: ArrayLike) -> Array:
    """Product of the matrix of the whole mesh with a vector, edge by edge: the matrix itself is never made.

    Parameters
    ----------
    blocks : (..., m, 3, 3), of every edge, as from `edge_stiffness`
    vector : (..., n, 3)

    Returns
    -------
    (..., n, 3)
    """
    between = across_edges(mesh, node_vectors(mesh, "vector", vector))
    return onto_nodes(mesh, np.einsum("...ij,...j->...i", np.asarray(blocks, dtype=float), between))


def mesh_matrix(mesh: SpringMesh, blocks: ArrayLike) -> Array:
    """Matrix of the whole mesh: every edge adds its block B as +B to both ends and as −B between them.

    Parameters
    ----------
    blocks : (..., m, 3, 3), of every edge, as from `edge_stiffness`

    Returns
    -------
    (..., 3 n, 3 n), rows and columns x, y, z of node 0, then of node 1 …; pinned nodes are in it as if free
    """
    block, nodes = np.asarray(blocks, dtype=float), len(mesh.mass)
    first, second = mesh.edges.T
    matrix = np.zeros((*block.shape[:-3], nodes, nodes, 3, 3))
    by_pair = np.moveaxis(matrix, (-4, -3), (0, 1))
    by_edge = np.moveaxis(block, -3, 0)
    for row, column, sign in ((first, first, 1), (second, second, 1), (first, second, -1), (second, first, -1)):
        np.add.at(by_pair, np.index_exp[row, column], sign * by_edge)
    return np.asarray(np.swapaxes(matrix, -3, -2)).reshape(*block.shape[:-3], 3 * nodes, 3 * nodes)
