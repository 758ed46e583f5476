"""Timesteps that a mesh allows, motions that it does not resist."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.meshes.matrices import (
    dot,
    edge_damping,
    edge_stiffness,
    mesh_matrix,
    mesh_product,
)
from solutions.meshes.mesh import AnyMesh, SpringMesh, as_mesh
from solutions.meshes.springs import finite_vectors

SEED = 28
"""Seed of the random vector from which a power iteration starts.

Any vector will do that has a part along the mode to be found.
"""


def zero_energy_modes(
    mesh: SpringMesh,
    position: ArrayLike,
    tolerance: float = 1e-9,
) -> NDArray[np.int64]:
    """Number of independent small motions that cost no energy.

    A free body that keeps its shape has six of them, its rigid motions. Each
    further one is a way to collapse, which internal springs have to forbid
    (slide 28).

    Parameters
    ----------
    position : (..., n, 3), m, the shape at rest
        In a stretched mesh the tension would resist some of the motions.
    tolerance : share of the largest eigenvalue up to which an eigenvalue
        counts as zero

    Returns
    -------
    (...), at most three for each node that is not pinned

    Raises
    ------
    ValueError
        If a position is not finite, or the positions do not fit the mesh.

    Notes
    -----
    A small motion d of the free nodes costs the energy d·K d/2, with the
    stiffness matrix K of the whole mesh at rest. K is symmetric and has no
    negative eigenvalue, so this energy is zero exactly for the motions with
    K d = 0. The number of independent ones is the number of eigenvalues that
    are zero.
    """
    free = np.repeat(~mesh.pinned, 3)
    matrix = mesh_matrix(
        mesh, edge_stiffness(mesh, finite_vectors(mesh, "position", position))
    )[..., free, :][..., free]
    values = np.linalg.eigvalsh(matrix)
    largest = np.max(np.abs(values), axis=-1, keepdims=True, initial=0.0)
    return np.asarray(np.sum(values <= tolerance * largest, axis=-1))


def largest_eigenvalue(
    mesh: SpringMesh,
    position: ArrayLike,
    tolerance: float = 1e-4,
    iterations: int = 10_000,
) -> Array:
    """Largest eigenvalue λ = ω² of M⁻¹K, found by power iteration.

    M holds the masses and K the stiffnesses of the mesh, so ω is its highest
    angular frequency.

    Parameters
    ----------
    position : (..., n, 3), m
    tolerance : share of λ by which the result may miss an eigenvalue
        The iteration stops when ‖A x − λ x‖ is at most this share of λ, for x
        of length 1 and the matrix A = M⁻¹K in its symmetric form. An
        eigenvalue of A then lies as near as that.
    iterations : largest number of rounds
        If it is reached, the result is the value found so far.

    Returns
    -------
    (...), rad²/s²
        Never above the true λ. Zero if no spring acts on a free node.

    Raises
    ------
    ValueError
        If a position is not finite, or the positions do not fit the mesh.

    Notes
    -----
    Multiplying a vector x by a matrix A with no negative eigenvalue stretches
    its part along the mode with the largest eigenvalue more than any other
    part. If x is replaced by A x again and again, it therefore turns into that
    mode, until multiplication changes only its length.

    The function scales x by √M, which turns M⁻¹K into a symmetric matrix with
    the same eigenvalues:

        A = M^(−1/2) K M^(−1/2)

    For a symmetric matrix the quotient x·Ax/x·x is an average of the
    eigenvalues, so it is never above λ. Its error is of second order in the
    error of x, so it settles twice as fast as x does.
    """
    p = finite_vectors(mesh, "position", position)
    blocks, scale = (
        edge_stiffness(mesh, p),
        np.sqrt(mesh.inverse_mass)[:, None],
    )
    x = _start(p.shape)
    for _ in range(max(1, iterations)):
        onto = scale * mesh_product(mesh, blocks, scale * x)
        quotient = dot(x, onto)
        if np.all(_length(onto - quotient * x) <= tolerance * quotient):
            break
        x = onto / _not_zero(_length(onto))
    return np.asarray(quotient[..., 0, 0])


def stable_timestep(
    mesh: SpringMesh,
    position: ArrayLike,
    tolerance: float = 1e-4,
    iterations: int = 10_000,
) -> Array:
    """Longest stable timestep of semi-implicit Euler (slide 28).

    Damping is included: it makes the limit shorter (slide 29).

    Parameters
    ----------
    position : (..., n, 3), m
    tolerance, iterations : as for `largest_eigenvalue`

    Returns
    -------
    (...), s
        Never below the true limit, so stay a little under it. Infinity if no
        spring and no damper acts on a free node.

    Raises
    ------
    ValueError
        If a position is not finite, or the positions do not fit the mesh.

    Notes
    -----
    For a small displacement x and a velocity v the integrator takes the steps
    v' = v − dt M⁻¹(K x + C v) and x' = x + dt v'. With a longer and longer dt,
    a vibration begins to grow when one step only turns it over, without loss:
    x' = −x and v' = −v. The second rule then gives v = 2 x/dt, and with this
    the first rule becomes

        (dt² K + 2 dt C) x = 4 M x

    Multiply by x from the left and divide by x·Mx. The result is a quadratic
    equation for dt, dt² k + 2 dt c = 4. Its positive solution is the step that
    turns x over, and the limit is the shortest of these steps:

        dt = min over x of 4/(c + √(c² + 4 k))
        k = x·Kx/x·Mx,  c = x·Cx/x·Mx

    Without damping c = 0, and the limit is 2/ω = 2/√λ. With c = 2ζω it is
    (2/ω)(√(1 + ζ²) − ζ). The function finds the x that gives the shortest step
    by power iteration on dt² K + 2 dt C.

    The limit of a single spring, 2√(m/k), is too optimistic for a node that
    many springs hold. A 10×10 cloth takes 1.01, 0.72 and 0.646 √(m/k) as
    structural, shear and bend springs are added.
    """
    p = finite_vectors(mesh, "position", position)
    stiffness, damping = edge_stiffness(mesh, p), edge_damping(mesh, p)
    scale = np.sqrt(mesh.inverse_mass)[:, None]
    x = _start(p.shape)
    for _ in range(max(1, iterations)):
        kx, cx = (
            scale * mesh_product(mesh, blocks, scale * x)
            for blocks in (stiffness, damping)
        )
        k, c = dot(x, kx), dot(x, cx)
        dt = _quotient(4.0, c + np.sqrt(c * c + 4 * k))
        step = np.where(np.isinf(dt), 0.0, dt)
        onto = step * (step * kx + 2 * cx)
        if np.all(_length(onto - 4 * x) <= 4 * tolerance):
            break
        x = onto / _not_zero(_length(onto))
    return np.asarray(dt[..., 0, 0])


def timestep_bound(mesh: AnyMesh) -> float:
    """A timestep that is safe in every shape of the mesh.

    It is the longest step that is stable at every node by itself, if all
    neighbours of the node move as far as it does and exactly against it, along
    every one of its springs and dampers.

    Parameters
    ----------
    mesh : SpringMesh

    Returns
    -------
    s
        Infinity if no spring and no damper acts on a node that can move.

    Notes
    -----
    The formula is

        dt = least over the nodes of 4/(c + √(c² + 4 k))
        k = 2 Σ stiffness/mass,  c = 2 Σ damping/mass

    with the sums over the springs at a node, and with its own mass. It needs
    no iteration, and is at most as long as `stable_timestep`, whatever the
    shape.

    No direction of an edge and no tension makes a spring stiffer than its
    stiffness. So a spring whose ends move by x1 and x2 contributes at most
    stiffness ‖x1 − x2‖² to x·Kx, and ‖x1 − x2‖² is at most 2 ‖x1‖² + 2 ‖x2‖².
    Collect these terms at each node: x·Kx is at most the sum of k mass ‖x‖²
    over the nodes, and x·Cx the sum of c mass ‖x‖². If dt² k + 2 dt c ≤ 4 at
    every node, dt is therefore within the limit of `stable_timestep`, whatever
    the shape. The longest such dt is the formula above. It is the bound that
    Gershgorin's theorem gives.
    """
    mesh = as_mesh(mesh)
    ends = mesh.edges.ravel()
    k, c = (
        2
        * np.bincount(ends, np.repeat(each, 2), len(mesh.mass))
        * mesh.inverse_mass
        for each in (mesh.stiffness, mesh.damping)
    )
    return float(
        np.min(_quotient(4.0, c + np.sqrt(c * c + 4 * k)), initial=np.inf)
    )


def _start(shape: tuple[int, ...]) -> Array:
    x = np.random.default_rng(SEED).normal(size=shape[-2:])
    return np.broadcast_to(x / _length(x), shape)


def _length(x: Array) -> Array:
    return np.sqrt(dot(x, x))


def _not_zero(value: Array) -> Array:
    return np.where(value > 0, value, 1.0)


def _quotient(a: float, b: Array) -> Array:
    return np.where(b > 0, a / _not_zero(b), np.inf)
