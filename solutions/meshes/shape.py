"""Keeping a mesh in shape: a limit on the strain, and the shape at rest (slide 28)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import not_negative
from solutions.meshes.mesh import SpringMesh
from solutions.meshes.springs import edge_directions, finite_vectors, mesh_forces, node_vectors, onto_nodes

ROUNDING = 1e-12
"""The share of a length that counts as rounding."""


def limit_strain(
    mesh: SpringMesh,
    position: ArrayLike,
    limit: float = 0.1,
    iterations: int = 1000,
) -> Array:
    """Positions in which no spring is stretched beyond the limit (Provot 1995).

    In each round the function draws the two ends of every spring that is too long
    together, each end in proportion to its inverse mass. The centre of mass of a mesh
    without pins therefore stays in place, and where one end is pinned the other end
    makes the whole move. All springs are corrected at the same time, and a correction
    is smaller where several springs that are too long share a node.

    Parameters
    ----------
    position : (..., n, 3), m
    limit : largest strain allowed, not negative; 0.1 is the usual tenth
        A spring counts as too long when it exceeds the allowed length by more than
        rounding, a share of 1e-12.
    iterations : largest number of rounds; it stops earlier when no spring is too long

    Returns
    -------
    (..., n, 3), m
        A spring between two pinned nodes keeps its length. Where the pins are too far
        apart for all springs to fit, the rounds do not settle, and some springs are
        still too long at the end. Shortened springs, and springs whose rest length is
        zero, are left alone.

    Raises
    ------
    ValueError
        If the limit is negative, or the positions do not fit the mesh.

    Notes
    -----
    Provot corrects one spring after another. Here all springs are corrected in the same
    round. Take a spring that is too long by x, and let w1 and w2 be the inverse masses
    of its ends. The ends move towards each other by w1 λ and w2 λ with

        λ = x/(c1 w1 + c2 w2)

    where c1 and c2 count the springs at each end that are too long. Mass times
    displacement is λ at both ends, in opposite directions, so the centre of mass stays.
    A pinned end has w = 0 and does not move.

    If one spring alone is too long, both counts are 1. Its ends then approach each
    other by w1 λ + w2 λ = x, and the spring fits at once. If many such springs meet at
    a node, the counts keep the sum of their corrections from moving the node too far.
    The number of rounds grows with the distance across the mesh and with the ratio of
    the masses.
    """
    p = node_vectors(mesh, "position", position)
    longest = np.where(mesh.rest_length > 0, mesh.rest_length * (1 + not_negative("limit", limit)), np.inf)
    can_move = ~np.all(mesh.pinned[mesh.edges], axis=-1)
    for _ in range(iterations):
        u, length = edge_directions(mesh, p)
        too_long = (length > longest * (1 + ROUNDING)) & can_move
        if not np.any(too_long):
            break
        weight = np.where(too_long, _counts_and_inverse_masses(mesh, too_long), np.inf)
        p = p - mesh.inverse_mass[:, None] * onto_nodes(mesh, ((length - longest) / weight)[..., None] * u)
    return np.array(p)


def _counts_and_inverse_masses(mesh: SpringMesh, counted: NDArray[np.bool_]) -> Array:
    """For every edge c1 w1 + c2 w2, (..., m), as `limit_strain` needs it.

    The counts c1 and c2 say how many of the counted edges, (..., m), meet at each end.
    """
    at_node = np.zeros((len(mesh.mass), *counted.shape[:-1]))
    for end in mesh.edges.T:
        np.add.at(at_node, end, np.moveaxis(counted, -1, 0).astype(float))
    weighed = np.moveaxis(at_node, 0, -1) * mesh.inverse_mass
    return np.asarray(np.sum(weighed[..., mesh.edges], axis=-1))


def static_shape(
    mesh: SpringMesh,
    position: ArrayLike,
    acceleration: ArrayLike,
    tolerance: float = 1e-8,
    iterations: int = 100_000,
) -> Array:
    """Shape at rest, in which springs and weight balance at every free node.

    It is found by dynamic relaxation (Cundall 1976). Dampers have no influence on it.

    Parameters
    ----------
    position : (..., n, 3), m, the first guess
    acceleration : of gravity, for example; broadcast to (..., n, 3), m/s²
    tolerance : largest net force that may be left at a free node
        It is relative to the largest weight, or to the largest net force at the start
        if no node has a weight.
    iterations : largest number of steps

    Returns
    -------
    (..., n, 3), m
        If several such shapes exist, the result is one to which the first guess leads.
        A first guess in which the forces already cancel is returned as it is, even if
        this equilibrium is unstable.

    Raises
    ------
    RuntimeError
        If no such shape is found within the given number of steps. A mesh without
        pinned nodes, for example, falls for ever.
    ValueError
        If a position is not finite, or the positions do not fit the mesh.

    Notes
    -----
    The function lets the mesh swing without damping. Its total energy then stays the
    same, so when the kinetic energy passes a peak, the potential energy is in a valley.
    There the function sets all velocities to zero, and the mesh starts again from this
    lower potential energy. The swings become smaller until the mesh rests.

    Only the final shape matters, so the inertia of the nodes and the timestep may be
    chosen freely. Each node gets the inertia Σ k, the sum of the stiffnesses of its
    springs, and each step has length 1. With these values `timestep_bound` allows

        dt = 4/√(4 · 2 Σk/Σk) = √2

    so a step of 1 leaves a margin of a factor √2. The weights keep the true masses.
    """
    p = finite_vectors(mesh, "position", position)
    weight = np.where(mesh.pinned, 0.0, mesh.mass)[:, None] * np.asarray(acceleration, dtype=float)
    held_by = np.bincount(mesh.edges.ravel(), np.repeat(mesh.stiffness, 2), len(mesh.mass))[:, None]
    softness = np.where(mesh.pinned[:, None], 0.0, 1 / np.where(held_by > 0, held_by, 1.0))
    v, energy, scale = np.zeros_like(p), np.zeros((*p.shape[:-2], 1, 1)), _largest_force(weight)
    for _ in range(max(1, iterations)):
        net = np.where(mesh.pinned[:, None], 0.0, mesh_forces(mesh, p, np.zeros_like(p)) + weight)
        scale = np.where(scale > 0, scale, _largest_force(net))
        if np.all(_largest_force(net) <= tolerance * scale):
            return np.array(p)
        v = v + softness * net
        before, energy = energy, np.sum(held_by * v * v, axis=(-2, -1), keepdims=True)
        v, energy = np.where(energy < before, 0.0, v), np.where(energy < before, 0.0, energy)
        p = p + v
    left = np.max(_largest_force(net))
    raise RuntimeError(f"no shape at rest found in {iterations} steps: a net force of {left:.3g} N is left")


def _largest_force(force: Array) -> Array:
    """The size of the largest of the forces (..., n, 3), as (...)."""
    return np.asarray(np.max(np.linalg.norm(force, axis=-1), axis=-1, initial=0.0))
