"""A limit on the strain, and the shape at rest (slide 28)."""

from __future__ import annotations

import math

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import Finite, NotNegative, Number, domain
from solutions.meshes.mesh import Mesh
from solutions.meshes.springs import held, mesh_forces, require_fit
from solutions.vectors import quotient

SLACK = 1e-12
"""The share of a length that counts as rounding."""


@domain
def limit_strain(
    mesh: Mesh,
    position: Number,
    limit: NotNegative = 0.1,
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
    limit : one number, the largest strain allowed, not negative
        0.1 is the usual tenth.
    iterations : whole number of rounds
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
        If the positions do not fit the mesh.

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
    across and with the ratio of the masses.

    The function also takes a batch of positions, (..., n, 3).
    """
    require_fit(mesh, position=position)
    p = position.copy()
    longest = mesh.rest_length * (1 + limit)
    w1, w2 = mesh.inverse_mass[mesh.edges].T
    share = quotient(w1, w1 + w2)
    can_fit = (w1 + w2 > 0) & (longest > 0)
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


@domain
def static_shape(
    mesh: Mesh,
    position: Finite,
    acceleration: Number,
    tolerance: float = 1e-8,
    iterations: int = 100_000,
) -> Array:
    """Shape at rest, in which springs and weight balance at every free node.

    It is found by dynamic relaxation (Cundall 1976). Dampers have no influence
    on it.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position : (..., n, 3), m, finite, the first guess
    acceleration : (3,) for all nodes alike, or (..., n, 3), m/s²
        It is that of gravity, for example.
    tolerance : one number, the net force that may be left at a free node
        It is relative to the largest weight, or to the largest net force at
        the start if no node has a weight.
    iterations : whole number, the most steps

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
        If the positions do not fit the mesh.

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
    `timestep_bound` has

        κ = 2 (Σ k)/(Σ k) = 2
        dt = 4/√(4 κ) = √2

    so a step of 1 leaves a margin of a factor √2. The weights keep the true
    masses.
    """
    require_fit(mesh, position=position)
    mass = np.where(mesh.pinned, 0.0, mesh.mass)[:, None]
    weight = mass * acceleration
    ends = mesh.edges.ravel()
    stiffness = np.bincount(ends, np.repeat(mesh.stiffness, 2), len(mass))
    inertia: Array = stiffness[:, None]
    softness = held(mesh, quotient(1.0, inertia, 1.0))
    scale = _largest_force(weight)
    p = position
    v = np.zeros_like(p)
    energy = np.zeros((*p.shape[:-2], 1, 1))
    for _ in range(max(1, iterations)):
        net = held(mesh, mesh_forces(mesh, p, np.zeros_like(p)) + weight)
        scale = np.where(scale > 0, scale, _largest_force(net))
        if np.all(_largest_force(net) <= tolerance * scale):
            return p.copy()
        v = v + softness * net
        before = energy
        energy = np.sum(inertia * v * v, axis=(-2, -1), keepdims=True)
        past_peak = energy < before
        v = np.where(past_peak, 0.0, v)
        energy = np.where(past_peak, 0.0, energy)
        p = p + v
    left = np.max(_largest_force(net))
    raise RuntimeError(
        f"no shape at rest found in {iterations} steps:"
        f" a net force of {left:.3g} N is left"
    )


def _largest_force(force: Array) -> Array:
    """The size of the largest of the forces (..., n, 3), as (...)."""
    return np.max(np.linalg.norm(force, axis=-1), axis=-1, initial=0.0)
