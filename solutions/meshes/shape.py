"""Keeping a mesh in shape: how far a spring may stretch, and where a mesh comes to rest (slide 28)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import not_negative
from solutions.meshes.springs import edge_directions, finite_vectors, mesh_forces, node_vectors, onto_nodes
from solutions.meshes.topology import Array, SpringMesh

ROUNDING = 1e-12
"""Share of a length that is taken for rounding."""


def limit_strain(mesh: SpringMesh, position: ArrayLike, limit: float = 0.1, iterations: int = 1000) -> Array:
    """Draw the ends of every spring that is stretched by more than the limit together, again and again (Provot 1995).

    Provot takes one spring after another, here all are taken at once. One that is too long by x moves its ends by w1 λ
    and w2 λ, with the inverse masses w; so the centre of mass stays, and a pinned end leaves all to the other. With

        λ = x/(c1 w1 + c2 w2)

    where c counts the too long springs at an end, one spring alone fits at once, and many do not move a node too far.
    It takes more rounds the longer the way across the mesh and the more unequal the masses.

    Parameters
    ----------
    position : (..., n, 3), m
    limit : longest strain allowed, 0.1 for the usual tenth
    iterations : rounds at most; it ends earlier when no spring is too long

    Returns
    -------
    (..., n, 3), m. Springs between two pinned nodes stay as they are. Where the pins are too far apart for all springs
    to fit it does not settle, and some are too long in the end. Shortened springs, and those of no rest length, are
    left alone.

    Raises
    ------
    ValueError
        If the limit is negative, or the positions do not fit the mesh.
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
    """For every edge c1 w1 + c2 w2, (..., m), where c is how many of the counted edges (..., m) meet at an end."""
    at_node = np.zeros((len(mesh.mass), *counted.shape[:-1]))
    for end in mesh.edges.T:
        np.add.at(at_node, end, np.moveaxis(counted, -1, 0).astype(float))
    weighed = np.moveaxis(at_node, 0, -1) * mesh.inverse_mass
    return np.asarray(np.sum(weighed[..., mesh.edges], axis=-1))


def static_shape(
    mesh: SpringMesh, position: ArrayLike, acceleration: ArrayLike, tolerance: float = 1e-8, iterations: int = 100_000
) -> Array:
    """Shape in which springs and weight cancel at every free node, by dynamic relaxation (Cundall 1976).

    Let it swing, and take all velocity away whenever the kinetic energy has passed a peak: there the potential energy
    is in a valley. As only the end counts, time and masses are free: each node gets the mass Σ k of its springs and
    the steps are 1 long, which `timestep_bound` allows with √2 to spare. Dampers have no say in it.

    Parameters
    ----------
    position : (..., n, 3), m, the first guess
    acceleration : as of gravity, broadcast to (..., n, 3), m/s²
    tolerance : largest net force left at a free node, relative to the largest weight; if there is none, to the largest
        net force at first
    iterations : steps at most

    Returns
    -------
    (..., n, 3), m. Where there are several such shapes, one that the first guess leads to; out of a shape in which the
    forces cancel already it does not move, even if that balances on edge.

    Raises
    ------
    RuntimeError
        If no such shape is found in so many steps: as for a mesh that nothing holds, which falls for ever.
    ValueError
        If a position is not finite.
    """
    p = finite_vectors(mesh, "position", position)
    weight = np.where(mesh.pinned, 0.0, mesh.mass)[:, None] * np.asarray(acceleration, dtype=float)
    held_by = np.bincount(mesh.edges.ravel(), np.repeat(mesh.stiffness, 2), len(mesh.mass))[:, None]
    softness = np.where(mesh.pinned[:, None], 0.0, 1 / np.where(held_by > 0, held_by, 1.0))
    v, energy, scale = np.zeros_like(p), np.zeros((*p.shape[:-2], 1, 1)), _largest(weight)
    for _ in range(max(1, iterations)):
        net = np.where(mesh.pinned[:, None], 0.0, mesh_forces(mesh, p, np.zeros_like(p)) + weight)
        scale = np.where(scale > 0, scale, _largest(net))
        if np.all(_largest(net) <= tolerance * scale):
            return np.array(p)
        v = v + softness * net
        before, energy = energy, np.sum(held_by * v * v, axis=(-2, -1), keepdims=True)
        v, energy = np.where(energy < before, 0.0, v), np.where(energy < before, 0.0, energy)
        p = p + v
    left = np.max(_largest(net))
    raise RuntimeError(f"no shape at rest found in {iterations} steps: a net force of {left:.3g} N is left")


def _largest(force: Array) -> Array:
    """Of the forces (..., n, 3), the size of the largest, (...)."""
    return np.asarray(np.max(np.linalg.norm(force, axis=-1), axis=-1, initial=0.0))
