"""A limit on the strain, and the shape at rest (slide 28)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import not_negative
from solutions.meshes.mesh import AnyMesh, SpringMesh, as_mesh
from solutions.meshes.springs import finite_vectors, mesh_forces, node_vectors

SLACK = 1e-12
"""The share of a length that counts as rounding."""


def limit_strain(
    mesh: AnyMesh,
    position: ArrayLike,
    limit: float = 0.1,
    iterations: int = 1000,
) -> Array:
    """Positions in which no spring is too long (Provot 1995).

    One round goes through all springs, in their order. A spring whose strain
    is above the limit is shortened until its strain is the limit: its two ends
    are drawn together along the spring, and the centre of mass of the two
    stays in place. The next spring finds them there.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position : (n, 3), m
    limit : largest strain allowed, not negative; 0.1 is the usual tenth
    iterations : number of rounds
        The function may stop earlier, when no spring is too long.

    Returns
    -------
    (n, 3), m
        A pinned node stays, and the other end makes the whole move. A spring
        between two pinned nodes keeps its length. Shortened springs, and
        springs whose rest length is zero, are left alone. Where the pins are
        too far apart for all springs to fit, some springs are still too long
        at the end.

    Raises
    ------
    ValueError
        If the limit is negative, or the positions do not fit the mesh.

    Notes
    -----
    Take a spring that is too long by x, and let w1 and w2 be the inverse
    masses of its ends. Their centre of mass stays if mass times displacement
    is the same at both ends, in opposite directions, so each end moves in
    proportion to its inverse mass:

        w1/(w1 + w2) x    and    w2/(w1 + w2) x

    A pinned end has w = 0 and does not move. Each correction may make another
    spring too long, and it does so for its neighbours only. So a correction
    crawls across the mesh, and the number of rounds grows with the distance
    across and with the ratio of the masses. Leading axes of the position make
    a batch, (..., n, 3).
    """
    mesh = as_mesh(mesh)
    p = node_vectors(mesh, "position", position).copy()
    longest = mesh.rest_length * (1 + not_negative("limit", limit))
    w = mesh.inverse_mass[mesh.edges]
    both = w[:, 0] + w[:, 1]
    share = w[:, 0] / np.where(both > 0, both, 1.0)
    can_fit = (both > 0) & (longest > 0)
    springs = list(
        zip(mesh.edges[can_fit], longest[can_fit], share[can_fit], strict=True)
    )
    for at in np.ndindex(p.shape[:-2]):
        _fit(p[at], springs, iterations)
    return p


def _fit(
    p: Array, springs: list[tuple[Integers, float, float]], rounds: int
) -> None:
    """Move the nodes of one mesh, (n, 3), until the springs fit."""
    for _ in range(rounds):
        moved = False
        for (one, other), longest, share in springs:
            between = p[one] - p[other]
            length = math.hypot(*between)
            if length > longest * (1 + SLACK):
                excess = (1 - longest / length) * between
                p[one] -= share * excess
                p[other] += (1 - share) * excess
                moved = True
        if not moved:
            break


def static_shape(
    mesh: SpringMesh,
    position: ArrayLike,
    acceleration: ArrayLike,
    tolerance: float = 1e-8,
    iterations: int = 100_000,
) -> Array:
    """Shape at rest, in which springs and weight balance at every free node.

    It is found by dynamic relaxation (Cundall 1976). Dampers have no influence
    on it.

    Parameters
    ----------
    position : (..., n, 3), m, the first guess
    acceleration : of gravity, for example; broadcast to (..., n, 3), m/s²
    tolerance : largest net force that may be left at a free node
        It is relative to the largest weight, or to the largest net force at
        the start if no node has a weight.
    iterations : largest number of steps

    Returns
    -------
    (..., n, 3), m
        If several such shapes exist, the result is one to which the first
        guess leads. A first guess in which the forces already cancel is
        returned as it is, even if this equilibrium is unstable.

    Raises
    ------
    RuntimeError
        If no such shape is found within the given number of steps. A mesh
        without pinned nodes, for example, falls for ever.
    ValueError
        If a position is not finite, or the positions do not fit the mesh.

    Notes
    -----
    The function lets the mesh swing without damping. Its total energy then
    stays the same, so when the kinetic energy passes a peak, the potential
    energy is in a valley. There the function sets all velocities to zero, and
    the mesh starts again from this lower potential energy. The swings become
    smaller until the mesh rests.

    Only the final shape matters, so the inertia of the nodes and the timestep
    may be chosen freely. Each node gets the inertia Σ k, the sum of the
    stiffnesses of its springs, and each step has length 1. With these values
    `timestep_bound` allows

        dt = 4/√(4 · 2 Σk/Σk) = √2

    so a step of 1 leaves a margin of a factor √2. The weights keep the true
    masses.
    """
    p = finite_vectors(mesh, "position", position)
    weight = np.where(mesh.pinned, 0.0, mesh.mass)[:, None] * np.asarray(
        acceleration, dtype=float
    )
    held_by = np.bincount(
        mesh.edges.ravel(), np.repeat(mesh.stiffness, 2), len(mesh.mass)
    )[:, None]
    softness = np.where(
        mesh.pinned[:, None], 0.0, 1 / np.where(held_by > 0, held_by, 1.0)
    )
    v, energy, scale = (
        np.zeros_like(p),
        np.zeros((*p.shape[:-2], 1, 1)),
        _largest_force(weight),
    )
    for _ in range(max(1, iterations)):
        net = np.where(
            mesh.pinned[:, None],
            0.0,
            mesh_forces(mesh, p, np.zeros_like(p)) + weight,
        )
        scale = np.where(scale > 0, scale, _largest_force(net))
        if np.all(_largest_force(net) <= tolerance * scale):
            return np.array(p)
        v = v + softness * net
        before, energy = (
            energy,
            np.sum(held_by * v * v, axis=(-2, -1), keepdims=True),
        )
        v, energy = (
            np.where(energy < before, 0.0, v),
            np.where(energy < before, 0.0, energy),
        )
        p = p + v
    left = np.max(_largest_force(net))
    raise RuntimeError(
        f"no shape at rest found in {iterations} steps:"
        f" a net force of {left:.3g} N is left"
    )


def _largest_force(force: Array) -> Array:
    """The size of the largest of the forces (..., n, 3), as (...)."""
    return np.asarray(
        np.max(np.linalg.norm(force, axis=-1), axis=-1, initial=0.0)
    )
