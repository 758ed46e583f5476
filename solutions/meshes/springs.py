"""Forces, energy and strain of the springs (slides 27 to 29)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite
from solutions.meshes.mesh import AnyMesh, SpringMesh, as_mesh, lengths


def node_vectors(mesh: SpringMesh, name: str, value: ArrayLike) -> Array:
    """Return the value as floats (..., n, 3), one vector for each node.

    Raises
    ------
    ValueError
        If the value has another shape.
    """
    array = np.asarray(value, dtype=float)
    if array.shape[-2:] != (len(mesh.mass), 3):
        raise ValueError(
            f"{name} must have the shape (..., {len(mesh.mass)}, 3),"
            f" not {array.shape}"
        )
    return array


def finite_vectors(mesh: SpringMesh, name: str, value: ArrayLike) -> Array:
    """Return the value as `node_vectors` does, and refuse infinity and NaN.

    Functions use it where such a number would silently lead to a wrong result.

    Raises
    ------
    ValueError
        If the value has another shape, or a number in it is not finite.
    """
    return finite(name, node_vectors(mesh, name, value))


def across_edges(mesh: SpringMesh, vector: Array) -> Array:
    """Difference over every edge of a quantity: end 1 minus end 2.

    It turns (..., n, 3) into (..., m, 3).
    """
    return np.asarray(
        np.take(vector, mesh.edges[:, 0], axis=-2)
        - np.take(vector, mesh.edges[:, 1], axis=-2)
    )


def onto_nodes(mesh: SpringMesh, force: Array) -> Array:
    """Sum for every node over its edges: plus on end 1, minus on end 2.

    It turns (..., m, 3) into (..., n, 3).
    """
    shape = (*force.shape[:-2], len(mesh.mass), 3)
    batch = np.arange(math.prod(shape[:-2]))[:, None]
    first, second = (
        ((batch * shape[-2] + end)[..., None] * 3 + np.arange(3)).ravel()
        for end in (mesh.edges[:, 0], mesh.edges[:, 1])
    )
    size = math.prod(shape)
    return np.asarray(
        np.bincount(first, force.ravel(), size)
        - np.bincount(second, force.ravel(), size)
    ).reshape(shape)


def edge_directions(
    mesh: SpringMesh, position: ArrayLike
) -> tuple[Array, Array]:
    """Unit vector u from end 2 to end 1 of every edge, and its length L.

    Parameters
    ----------
    position : (..., n, 3), m

    Returns
    -------
    direction : (..., m, 3)
        Zero where both ends are at the same place: such an edge has no
        direction.
    length : (..., m), m

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.
    """
    between = across_edges(mesh, node_vectors(mesh, "position", position))
    length = lengths(between)
    return between / np.where(length > 0, length, 1.0)[..., None], length


def mesh_forces(
    mesh: AnyMesh, position: ArrayLike, velocity: ArrayLike
) -> Array:
    """Force of springs and dampers on every node (slides 28 and 29).

    A spring that is longer than its rest length pulls its two ends together,
    and a shorter one pushes them apart. The damper beside it resists only the
    rate at which the length changes.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position, velocity : (n, 3), m and m/s

    Returns
    -------
    (n, 3), N
        For a pinned node it is the force with which its springs and dampers
        pull. An edge of zero length has no direction, and therefore no force.

    Raises
    ------
    ValueError
        If an array does not fit the mesh.

    Notes
    -----
    Slide 29 prints F = (x' − x_rest) k − v k_d. With this sign the spring
    pushes the body away from its rest position, and the damper acts on all of
    the motion. Along an edge of length L and rest length L0, with the unit
    vector u from end 2 to end 1, the force is

        F = −k (L − L0) u − k_d ((v1 − v2)·u) u    on end 1, and −F on end 2

    The length changes at the rate (v1 − v2)·u, the part along the edge of the
    velocity with which end 1 moves as seen from end 2. The remaining part
    turns the edge, and no damper resists it. Leading axes of position and
    velocity make a batch, (..., n, 3).
    """
    mesh = as_mesh(mesh)
    u, length = edge_directions(mesh, position)
    rate = np.einsum(
        "...i,...i->...",
        across_edges(mesh, node_vectors(mesh, "velocity", velocity)),
        u,
    )
    tension = (
        mesh.stiffness * (length - mesh.rest_length) + mesh.damping * rate
    )
    return onto_nodes(mesh, -tension[..., None] * u)


def mesh_energy(mesh: SpringMesh, position: ArrayLike) -> Array:
    """Energy stored in the springs.

    Parameters
    ----------
    position : (..., n, 3), m

    Returns
    -------
    (...), J, summed over all springs

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.

    Notes
    -----
    To stretch a spring from its rest length L0 to the length L takes the work
    of its force k (L − L0), which grows in proportion to the stretch. Summed
    over the springs, this is

        E = Σ k (L − L0)²/2
    """
    stretch = edge_directions(mesh, position)[1] - mesh.rest_length
    return np.asarray(np.sum(mesh.stiffness * stretch**2 / 2, axis=-1))


def edge_strain(mesh: SpringMesh, position: ArrayLike) -> Array:
    """Strain of every spring, negative where the spring is shortened.

    Parameters
    ----------
    position : (..., n, 3), m

    Returns
    -------
    (..., m)
        Zero for a spring whose rest length is zero, as no strain is defined
        for it.

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.

    Notes
    -----
    For the length L and the rest length L0 it is

        (L − L0)/L0
    """
    stretch = edge_directions(mesh, position)[1] - mesh.rest_length
    return np.where(
        mesh.rest_length > 0,
        stretch / np.where(mesh.rest_length > 0, mesh.rest_length, 1.0),
        0.0,
    )
