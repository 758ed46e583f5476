"""Keeping a mesh in shape: how far a spring may stretch, and where a mesh comes to rest (slide 28)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import not_negative
from solutions.meshes.springs import edge_directions, mesh_forces, node_vectors, onto_nodes
from solutions.meshes.topology import Array, SpringMesh

ROUNDING = 1e-12
"""Share of a length that is taken for rounding."""


def limit_strain(mesh: SpringMesh, position: ArrayLike, limit: float = 0.1, iterations: int = 1000) -> Array:
    """Draw the ends of every spring that is stretched by more than the limit together, again and again (Provot 1995).

    Provot takes one spring after another. Here all are taken at once, each by the share 1/c of what it is too long,
    where c is how many such springs meet at its busier end: so no node is moved too far. The ends move by their inverse
    masses, which leaves the centre of mass where it was; a pinned end stays, and the other takes it all.

    Parameters
    ----------
    position : (..., n, 3), m
    limit : longest strain allowed, 0.1 for the usual tenth
    iterations : rounds at most; it ends earlier when no spring is too long

    Returns
    -------
    (..., n, 3), m. Springs between two pinned nodes stay as they are, and where the pins are too far apart for all
    springs to fit, some stay too long. Shortened springs, and those of no rest length, are left alone.

    Raises
    ------
    ValueError
        If the limit is negative, or the positions do not fit the mesh.
    """
    p = node_vectors(mesh, "position", position)
    longest = np.where(mesh.rest_length > 0, mesh.rest_length * (1 + not_negative("limit", limit)), np.inf)
    inverse_mass = np.take(mesh.inverse_mass, mesh.edges)
    share = inverse_mass.sum(axis=-1)
    for _ in range(iterations):
        u, length = edge_directions(mesh, p)
        excess = np.where((length > longest * (1 + ROUNDING)) & (share > 0), length - longest, 0.0)
        if not np.any(excess):
            break
        impulse = excess / np.where(share > 0, share, 1.0) / _busier_end(mesh, excess > 0)
        p = p - mesh.inverse_mass[:, None] * onto_nodes(mesh, impulse[..., None] * u)
    return np.array(p)


def _busier_end(mesh: SpringMesh, counted: NDArray[np.bool_]) -> Array:
    """For every edge, how many of the counted edges (..., m) meet at that end of it where more do; at least 1."""
    at_node = np.zeros((len(mesh.mass), *counted.shape[:-1]))
    for end in mesh.edges.T:
        np.add.at(at_node, end, np.moveaxis(counted, -1, 0).astype(float))
    busier = np.max(at_node[mesh.edges], axis=1)
    return np.asarray(np.maximum(np.moveaxis(busier, 0, -1), 1.0))


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
    tolerance : largest net force left at a free node, relative to the largest weight or, if larger, net force at first
    iterations : steps at most

    Returns
    -------
    (..., n, 3), m. Where there are several such shapes, one that the first guess leads to; out of a shape in which the
    forces cancel already it does not move, even if that balances on edge.

    Raises
    ------
    RuntimeError
        If no such shape is found in so many steps: as for a mesh that nothing holds, which falls for ever.
    """
    p = node_vectors(mesh, "position", position)
    weight = np.where(mesh.pinned, 0.0, mesh.mass)[:, None] * np.asarray(acceleration, dtype=float)
    held_by = np.bincount(mesh.edges.ravel(), np.repeat(mesh.stiffness, 2), len(mesh.mass))[:, None]
    softness = np.where(mesh.pinned[:, None] | (held_by == 0), 0.0, 1 / np.where(held_by > 0, held_by, 1.0))
    v, energy, enough = np.zeros_like(p), np.zeros((*p.shape[:-2], 1, 1)), None
    for _ in range(iterations):
        net = np.where(mesh.pinned[:, None], 0.0, mesh_forces(mesh, p, np.zeros_like(p)) + weight)
        if enough is None:
            enough = tolerance * np.maximum(_largest(net), _largest(weight))
        if np.all(_largest(net) <= enough):
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
