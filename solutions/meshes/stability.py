"""How long a step a mesh can take, and which motions it does not resist at all (slide 28)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.meshes.springs import edge_damping, edge_stiffness, finite_vectors, mesh_matrix, mesh_product
from solutions.meshes.topology import Array, SpringMesh

SEED = 28
"""Of the vector that a power iteration starts from: any will do that has some of the mode it looks for."""


def zero_energy_modes(mesh: SpringMesh, position: ArrayLike, tolerance: float = 1e-9) -> NDArray[np.int64]:
    """How many independent small motions of the free nodes cost no energy: eigenvalues of the stiffness that are zero.

    A free body that keeps its shape has six, its rigid motions. Each one more is a way to collapse. A cube of edges
    alone has twelve; its internal springs leave six (slide 28).

    Parameters
    ----------
    position : (..., n, 3), m, the shape at rest; tension in a stretched mesh would resist some of the motions
    tolerance : below which share of the largest eigenvalue one counts as zero

    Returns
    -------
    (...), at most three for each node that is not pinned

    Raises
    ------
    ValueError
        If a position is not finite.
    """
    free = np.repeat(~mesh.pinned, 3)
    matrix = mesh_matrix(mesh, edge_stiffness(mesh, finite_vectors(mesh, "position", position)))[..., free, :][
        ..., free
    ]
    values = np.linalg.eigvalsh(matrix)
    largest = np.max(np.abs(values), axis=-1, keepdims=True, initial=0.0)
    return np.asarray(np.sum(values <= tolerance * largest, axis=-1))


def largest_eigenvalue(
    mesh: SpringMesh, position: ArrayLike, tolerance: float = 1e-4, iterations: int = 10_000
) -> Array:
    """Largest eigenvalue λ = ω² of M⁻¹K by power iteration: x ← K x, until x only grows longer.

    With x scaled by √M the matrix is symmetric, and the quotient x·Kx/x·x is never above λ and reaches it twice as
    fast as x settles.

    Parameters
    ----------
    position : (..., n, 3), m
    tolerance : stop when ‖Kx − λx‖ is below this share of λ, so that an eigenvalue lies as near as that
    iterations : rounds at most; then the answer is what has been found, not above λ

    Returns
    -------
    (...), rad²/s²; zero for a mesh that nothing holds

    Raises
    ------
    ValueError
        If a position is not finite.
    """
    p = finite_vectors(mesh, "position", position)
    blocks, scale = edge_stiffness(mesh, p), np.sqrt(mesh.inverse_mass)[:, None]
    x = _start(p.shape)
    for _ in range(max(1, iterations)):
        onto = scale * mesh_product(mesh, blocks, scale * x)
        quotient = _dot(x, onto)
        if np.all(_length(onto - quotient * x) <= tolerance * quotient):
            break
        x = onto / _not_zero(_length(onto))
    return np.asarray(quotient[..., 0, 0])


def stable_timestep(mesh: SpringMesh, position: ArrayLike, tolerance: float = 1e-4, iterations: int = 10_000) -> Array:
    """Longest stable step of semi-implicit Euler in small vibrations: 2/√λ without damping (slides 28 and 29).

    A vibration x grows as soon as its step turns it over, x' = −x, with no loss: when (dt² K + 2 dt C) x = 4 M x. So

        dt = min over x of 4/(c + √(c² + 4 k)),    k = x·Kx/x·Mx,  c = x·Cx/x·Mx

    which is 2/ω for c = 0 and (2/ω)(√(1 + ζ²) − ζ) for c = 2ζω. The x that gives the least is found by power iteration
    on dt² K + 2 dt C. The single spring's 2√(m/k) is too optimistic for a node that many springs hold: a 10×10 cloth
    takes 1.01, 0.72 and 0.646 √(m/k) as structural, shear and bend springs are added.

    Parameters
    ----------
    position : (..., n, 3), m
    tolerance, iterations : as for `largest_eigenvalue`

    Returns
    -------
    (...), s; infinity for a mesh that nothing holds. Never below the true limit: stay a little under it.

    Raises
    ------
    ValueError
        If a position is not finite.
    """
    p = finite_vectors(mesh, "position", position)
    stiffness, damping = edge_stiffness(mesh, p), edge_damping(mesh, p)
    scale = np.sqrt(mesh.inverse_mass)[:, None]
    x = _start(p.shape)
    for _ in range(max(1, iterations)):
        kx, cx = (scale * mesh_product(mesh, blocks, scale * x) for blocks in (stiffness, damping))
        k, c = _dot(x, kx), _dot(x, cx)
        dt = _quotient(4.0, c + np.sqrt(c * c + 4 * k))
        step = np.where(np.isinf(dt), 0.0, dt)
        onto = step * (step * kx + 2 * cx)
        if np.all(_length(onto - 4 * x) <= 4 * tolerance):
            break
        x = onto / _not_zero(_length(onto))
    return np.asarray(dt[..., 0, 0])


def timestep_bound(mesh: SpringMesh) -> float:
    """A step that is safe in every shape of the mesh, found by adding up alone (Gershgorin).

        dt = least over the nodes of 4/(c + √(c² + 4 k)),    k = 2 Σ stiffness/mass,  c = 2 Σ damping/mass

    with the sums over the springs at a node and its own mass. No direction of an edge and no tension makes a spring
    stiffer than its stiffness, so no shape has a shorter limit.

    Returns
    -------
    s; infinity for a mesh that nothing holds
    """
    ends = mesh.edges.ravel()
    k, c = (
        2 * np.bincount(ends, np.repeat(each, 2), len(mesh.mass)) * mesh.inverse_mass
        for each in (mesh.stiffness, mesh.damping)
    )
    return float(np.min(_quotient(4.0, c + np.sqrt(c * c + 4 * k)), initial=np.inf))


def _start(shape: tuple[int, ...]) -> Array:
    x = np.random.default_rng(SEED).normal(size=shape[-2:])
    return np.broadcast_to(x / _length(x), shape)


def _dot(a: Array, b: Array) -> Array:
    """Product over all nodes, (..., 1, 1)."""
    return np.asarray(np.sum(a * b, axis=(-2, -1), keepdims=True))


def _length(x: Array) -> Array:
    return np.sqrt(_dot(x, x))


def _not_zero(value: Array) -> Array:
    return np.where(value > 0, value, 1.0)


def _quotient(a: float, b: Array) -> Array:
    return np.where(b > 0, a / _not_zero(b), np.inf)
