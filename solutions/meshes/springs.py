"""Forces, energy and strain of the springs (slides 27 to 29)."""

from __future__ import annotations

import math

import numpy as np

from solutions.arrays import Array
from solutions.domain import Number, domain
from solutions.meshes.mesh import Mesh, SpringMesh, lengths
from solutions.vectors import quotient


@domain
def mesh_forces(mesh: Mesh, position: Number, velocity: Number) -> Array:
    """Force of springs and dampers on every node (slides 28 and 29).

    A spring that is longer than its rest length pulls its two ends together,
    and a shorter one pushes them apart. The damper beside it resists only the
    rate at which the length changes.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position, velocity : (n, 3), m, m/s

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
    vector u from end 2 to end 1, the force on end 1 is

        F = −k (L − L0) u − k_d ((v1 − v2)·u) u

    and the force on end 2 is −F. The length changes at the rate (v1 − v2)·u,
    the part along the edge of the velocity with which end 1 moves as seen from
    end 2. The remaining part turns the edge, and no damper resists it.

    The function also takes a batch of states, (..., n, 3).
    """
    require_fit(mesh, velocity=velocity)
    u, length = edge_directions(mesh, position)
    relative_velocity = across_edges(mesh, velocity)  # v1 − v2
    lengthening = np.einsum("...i,...i->...", relative_velocity, u)
    spring_tension = mesh.stiffness * (length - mesh.rest_length)
    damper_tension = mesh.damping * lengthening
    tension = spring_tension + damper_tension
    return onto_nodes(mesh, -tension[..., None] * u)


@domain
def edge_directions(mesh: Mesh, position: Number) -> tuple[Array, Array]:
    """Unit vector u from end 2 to end 1 of every edge, and its length L.

    Parameters
    ----------
    mesh : SpringMesh of n nodes and m springs
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
    require_fit(mesh, position=position)
    between = across_edges(mesh, position)
    length = lengths(between)
    return quotient(between, length[..., None]), length


@domain
def mesh_energy(mesh: Mesh, position: Number) -> Array:
    """Energy stored in the springs.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
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
    _, length = edge_directions(mesh, position)
    stretch = length - mesh.rest_length
    return np.sum(mesh.stiffness * stretch**2 / 2, axis=-1)


@domain
def edge_strain(mesh: Mesh, position: Number) -> Array:
    """Strain of every spring, negative where the spring is shortened.

    Parameters
    ----------
    mesh : SpringMesh of n nodes and m springs
    position : (..., n, 3), m

    Returns
    -------
    (..., m), without a unit
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
    _, length = edge_directions(mesh, position)
    return quotient(length - mesh.rest_length, mesh.rest_length)


def require_fit(mesh: SpringMesh, **vectors: Array) -> None:
    """Raise a ValueError unless each is (..., n, 3), one vector a node."""
    nodes = len(mesh.mass)
    for name, array in vectors.items():
        if array.shape[-2:] != (nodes, 3):
            raise ValueError(
                f"{name} must have the shape (..., {nodes}, 3),"
                f" not {array.shape}"
            )


def held(mesh: SpringMesh, vectors: Array) -> Array:
    """The vectors of the nodes, with those of pinned nodes set to zero."""
    return np.where(mesh.pinned[:, None], 0.0, vectors)


def across_edges(mesh: SpringMesh, vectors: Array) -> Array:
    """Difference over every edge of a quantity: end 1 minus end 2.

    It turns (..., n, 3) into (..., m, 3).
    """
    first, second = mesh.edges.T
    return np.take(vectors, first, axis=-2) - np.take(vectors, second, axis=-2)


def onto_nodes(mesh: SpringMesh, force: Array) -> Array:
    """Sum for every node over its edges: plus on end 1, minus on end 2.

    It turns (..., m, 3) into (..., n, 3).
    """
    shape = (*force.shape[:-2], len(mesh.mass), 3)
    # Every component of every node is one bin.
    batch = np.arange(math.prod(shape[:-2]))[:, None]
    first, second = (
        ((batch * shape[-2] + end)[..., None] * 3 + np.arange(3)).ravel()
        for end in mesh.edges.T
    )
    gained = np.bincount(first, force.ravel(), math.prod(shape))
    lost = np.bincount(second, force.ravel(), math.prod(shape))
    return (gained - lost).reshape(shape)
