"""Timesteps that a mesh allows, motions that it does not resist (slide 28)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import Finite, domain
from solutions.meshes.matrices import (
    dot,
    edge_damping,
    edge_stiffness,
    mesh_matrix,
    mesh_product,
)
from solutions.meshes.mesh import Mesh
from solutions.vectors import quotient

SEED = 28
"""Seed of the random vector from which a power iteration starts.

Any vector will do that has a part along the mode to be found.
"""


@domain
def zero_energy_modes(
    mesh: Mesh, position: Finite, tolerance: float = 1e-9
) -> Integers:
    """Number of independent small motions that cost no energy.

    A free body that keeps its shape has six of them, its rigid motions. Each
    further one is a way to collapse, which internal springs have to forbid
    (slide 28).

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position : (..., n, 3), m, finite, the shape at rest
        In a stretched mesh the tension would resist some of the motions.
    tolerance : one number, share of the largest eigenvalue
        An eigenvalue up to this size counts as zero.

    Returns
    -------
    (...), at most three for each node that is not pinned

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.

    Notes
    -----
    A small motion d of the free nodes costs the energy d·K d/2, with the
    stiffness matrix K of the whole mesh at rest. K is symmetric and has no
    negative eigenvalue, so this energy is zero exactly for the motions with
    K d = 0. The number of independent ones is the number of eigenvalues that
    are zero.
    """
    free = np.repeat(~mesh.pinned, 3)
    matrix = mesh_matrix(mesh, edge_stiffness(mesh, position))
    values = np.linalg.eigvalsh(matrix[..., free, :][..., free])
    largest = np.max(np.abs(values), axis=-1, keepdims=True, initial=0.0)
    return np.sum(values <= tolerance * largest, axis=-1)


@domain
def timestep_bound(mesh: Mesh) -> float:
    """A timestep that is safe in every shape of the mesh.

    It is the longest step that is stable at every node by itself, if all
    neighbours of the node move as far as it does and exactly against it, along
    every one of its springs and dampers.

    Parameters
    ----------
    mesh : SpringMesh of n nodes

    Returns
    -------
    float, s
        Infinity if no spring and no damper acts on a node that can move.

    Notes
    -----
    With the sums over the springs at a node, and with its own mass, let

        κ = 2 (Σ stiffness)/mass
        γ = 2 (Σ damping)/mass
        dt = 4/(γ + √(γ² + 4 κ))

    The result is the shortest of the steps of all nodes. It needs no
    iteration, and is at most as long as `stable_timestep`, whatever the shape.

    No direction of an edge and no tension makes a spring stiffer than its
    stiffness. So a spring whose ends move by x1 and x2 contributes at most
    stiffness ‖x1 − x2‖² to x·Kx, and ‖x1 − x2‖² is at most 2 ‖x1‖² + 2 ‖x2‖².
    Collect these terms at each node: x·Kx is at most the sum of κ mass ‖x‖²
    over the nodes, and x·Cx the sum of γ mass ‖x‖². If dt² κ + 2 dt γ ≤ 4 at
    every node, dt is therefore within the limit of `stable_timestep`. The
    longest such dt is the formula above. It is the bound that Gershgorin's
    theorem gives.
    """
    nodes = len(mesh.mass)
    ends = mesh.edges.ravel()
    stiffness = np.bincount(ends, np.repeat(mesh.stiffness, 2), nodes)
    damping = np.bincount(ends, np.repeat(mesh.damping, 2), nodes)
    kappa = 2 * stiffness * mesh.inverse_mass
    gamma = 2 * damping * mesh.inverse_mass
    root = np.sqrt(gamma * gamma + 4 * kappa)
    dt = quotient(4.0, gamma + root, np.inf)
    return float(np.min(dt, initial=np.inf))


@domain
def largest_eigenvalue(
    mesh: Mesh,
    position: Finite,
    tolerance: float = 1e-4,
    iterations: int = 10_000,
) -> Array:
    """Largest eigenvalue λ = ω² of M⁻¹K, found by power iteration.

    M holds the masses and K the stiffnesses of the mesh, so ω is its highest
    angular frequency.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position : (..., n, 3), m, finite
    tolerance : one number, share of λ by which it may miss an eigenvalue
        The iteration stops when ‖A x − λ x‖ is at most this share of λ, for x
        of length 1 and the matrix A = M⁻¹K in its symmetric form. An
        eigenvalue of A then lies as near as that.
    iterations : whole number, the most rounds
        If it is reached, the result is the value found so far.

    Returns
    -------
    (...), rad²/s²
        Never above the true λ. Zero if no spring acts on a free node.

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.

    Notes
    -----
    Multiplying a vector x by a matrix A with no negative eigenvalue stretches
    its part along the mode with the largest eigenvalue more than any other
    part. If x is replaced by A x again and again, it therefore turns into that
    mode, until multiplication changes only its length.

    The function scales x by √M, which turns M⁻¹K into a symmetric matrix with
    the same eigenvalues:

        A = M^(−1/2) K M^(−1/2)

    For a symmetric matrix the quotient (x·Ax)/(x·x) is an average of the
    eigenvalues, so it is never above λ. Its error is of second order in the
    error of x, so it settles twice as fast as x does.
    """
    blocks = edge_stiffness(mesh, position)
    scale = np.sqrt(mesh.inverse_mass)[:, None]
    x = _start(position.shape)
    for _ in range(max(1, iterations)):
        stretched = scale * mesh_product(mesh, blocks, scale * x)
        average = dot(x, stretched)
        if np.all(_length(stretched - average * x) <= tolerance * average):
            break
        x = quotient(stretched, _length(stretched))
    return average[..., 0, 0]


@domain
def stable_timestep(
    mesh: Mesh,
    position: Finite,
    tolerance: float = 1e-4,
    iterations: int = 10_000,
) -> Array:
    """Longest stable timestep of semi-implicit Euler (slide 28).

    Damping is included: it makes the limit shorter (slide 29).

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position : (..., n, 3), m, finite
    tolerance : one number, as for `largest_eigenvalue`
    iterations : whole number, as for `largest_eigenvalue`

    Returns
    -------
    (...), s
        Never below the true limit, so stay a little under it. Infinity if no
        spring and no damper acts on a free node.

    Raises
    ------
    ValueError
        If the positions do not fit the mesh.

    Notes
    -----
    For a small displacement x and a velocity v the integrator takes the steps

        v' = v − dt M⁻¹(K x + C v)
        x' = x + dt v'

    With a longer and longer dt, a vibration begins to grow when one step only
    turns it over, without loss: x' = −x and v' = −v. The second rule then
    gives v = 2 x/dt, and with this the first rule becomes

        (dt² K + 2 dt C) x = 4 M x

    Multiply by x from the left and divide by x·Mx. The result is a quadratic
    equation for dt, dt² κ + 2 dt γ = 4. Its positive solution is the step that
    turns x over:

        κ = (x·Kx)/(x·Mx)
        γ = (x·Cx)/(x·Mx)
        dt = 4/(γ + √(γ² + 4 κ))

    The limit is the shortest of these steps. Without damping γ = 0, and the
    limit is 2/ω = 2/√λ. With γ = 2ζω it is (2/ω)(√(1 + ζ²) − ζ). The function
    finds the x that gives the shortest step by power iteration on
    dt² K + 2 dt C, with x scaled by √M as in `largest_eigenvalue`.

    The limit of a single spring, 2√(m/k), is too optimistic for a node that
    many springs hold. A 10×10 cloth takes 1.01, 0.72 and 0.646 √(m/k) as
    structural, shear and bend springs are added.
    """
    stiffness = edge_stiffness(mesh, position)
    damping = edge_damping(mesh, position)
    scale = np.sqrt(mesh.inverse_mass)[:, None]
    x = _start(position.shape)
    for _ in range(max(1, iterations)):
        kx = scale * mesh_product(mesh, stiffness, scale * x)
        cx = scale * mesh_product(mesh, damping, scale * x)
        # As x has length 1, κ and γ are just products.
        kappa = dot(x, kx)
        gamma = dot(x, cx)
        root = np.sqrt(gamma * gamma + 4 * kappa)
        dt = quotient(4.0, gamma + root, np.inf)
        finite_dt = np.where(np.isinf(dt), 0.0, dt)
        stretched = finite_dt * (finite_dt * kx + 2 * cx)
        # The mode is found when (dt² K + 2 dt C) x = 4 x.
        if np.all(_length(stretched - 4 * x) <= 4 * tolerance):
            break
        x = quotient(stretched, _length(stretched))
    return dt[..., 0, 0]


def _start(shape: tuple[int, ...]) -> Array:
    """Random vectors of all nodes, of length 1, the same for every mesh."""
    x = np.random.default_rng(SEED).normal(size=shape[-2:])
    return np.broadcast_to(x / _length(x), shape)


def _length(x: Array) -> Array:
    return np.sqrt(dot(x, x))
