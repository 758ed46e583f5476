"""How a mesh moves: a step that is cheap and limited, and one that is dear and takes any timestep (slide 28)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.checks import positive
from solutions.forces import semi_implicit_euler
from solutions.meshes.springs import (
    edge_damping,
    edge_stiffness,
    finite_vectors,
    mesh_forces,
    mesh_product,
    node_vectors,
)
from solutions.meshes.topology import Array, SpringMesh


def mesh_step(
    mesh: SpringMesh, position: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after one step of semi-implicit Euler: forces, then velocities, then positions.

    Stable for a dt below `stable_timestep`; above it the shortest wave of the mesh grows with every step.

    Parameters
    ----------
    position, velocity : (..., n, 3), m and m/s
    acceleration : what all else gives the nodes, such as gravity; broadcast to (..., n, 3), m/s²
    dt : (...), s, positive

    Returns
    -------
    position, velocity : (..., n, 3) each; pinned nodes stay where they are and have no velocity

    Raises
    ------
    ValueError
        If dt is not positive, or an array does not fit the mesh.
    """
    v = _held(mesh, node_vectors(mesh, "velocity", velocity))
    a = mesh.inverse_mass[:, None] * mesh_forces(mesh, position, v)
    a = a + _held(mesh, np.asarray(acceleration, dtype=float))
    return semi_implicit_euler(position, v, a, positive("dt", dt)[..., None])


def conjugate_gradient(
    mesh: SpringMesh, blocks: ArrayLike, right: ArrayLike, tolerance: float = 1e-8, iterations: int | None = None
) -> Array:
    """Solve (M + B) x = r for the free nodes by conjugate gradients, with M the masses and B the matrix of the mesh.

    Every round goes along a direction d that is conjugate to all earlier ones, dᵀ(M + B)d' = 0, as far as the residual
    says; so n unknowns need n rounds at most, but for rounding. The matrix must be positive definite: clamped blocks.

    Parameters
    ----------
    blocks : (..., m, 3, 3), of every edge, kg
    right : (..., n, 3), r; what stands at pinned nodes does not count
    tolerance : how small the residual must be, relative to r
    iterations : rounds at most; by default ten times the number of unknowns, as rounding costs some

    Returns
    -------
    (..., n, 3), x; zero at pinned nodes

    Raises
    ------
    RuntimeError
        If the residual is still too large after the last round.
    ValueError
        If the right side is not finite: then no residual tells.
    """
    mass = np.where(mesh.pinned, 1.0, mesh.mass)[:, None]
    residual = finite_vectors(mesh, "right", _held(mesh, node_vectors(mesh, "right", right)))
    x, direction, square = np.zeros_like(residual), residual, _dot(residual, residual)
    enough = tolerance**2 * square
    for _ in range(30 * len(mass) if iterations is None else iterations):
        going = square > enough
        if not np.any(going):
            return x
        onto = _held(mesh, mass * direction + mesh_product(mesh, blocks, direction))
        curvature = _dot(direction, onto)
        length = np.where(going, square / np.where(going, curvature, 1.0), 0.0)
        x, residual = x + length * direction, residual - length * onto
        before, square = square, np.where(going, _dot(residual, residual), square)
        direction = residual + square / np.where(going, before, np.inf) * direction
    if np.any(square > enough):
        share = np.sqrt(np.max(square[square > enough] / enough[square > enough])) * tolerance
        raise RuntimeError(f"conjugate gradients: a residual of {share:.1e} of the right side is left")
    return x


def implicit_mesh_step(
    mesh: SpringMesh,
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: ArrayLike,
    dt: ArrayLike,
    tolerance: float = 1e-8,
) -> tuple[Array, Array]:
    """State after one step of backward Euler, linearised once (Baraff and Witkin 1998).

    The forces are those at the end of the step, f(p + dt v', v') ≈ f − dt K v' − C (v' − v), which gives

        (M + dt C + dt² K)(v' − v) = dt (f + M a − dt K v),    p' = p + dt v'

    K is clamped: shortened springs would make the matrix indefinite. So vibrations do not grow however long dt is, but
    they are damped: at ω each step keeps 1/√(1 + ω² dt²) of one (`amplitude_kept`), and high frequencies are gone at
    once. Linearised once, a step knows the directions of the springs at its start alone: a flat cloth, which resists
    nothing across, falls free until the next. Momentum is kept, to the tolerance; angular momentum is not.

    Parameters
    ----------
    position, velocity : (..., n, 3), m and m/s
    acceleration : what all else gives the nodes, such as gravity; broadcast to (..., n, 3), m/s²
    dt : (...), s, positive
    tolerance : of the conjugate gradients

    Returns
    -------
    position, velocity : (..., n, 3) each; pinned nodes stay where they are and have no velocity

    Raises
    ------
    ValueError
        If dt is not positive, an array does not fit the mesh, or the forces are not finite.
    """
    p, v = node_vectors(mesh, "position", position), _held(mesh, node_vectors(mesh, "velocity", velocity))
    step = positive("dt", dt)[..., None, None]
    stiffness, damping = edge_stiffness(mesh, p), edge_damping(mesh, p)
    mass = np.where(mesh.pinned, 0.0, mesh.mass)[:, None]
    force = mesh_forces(mesh, p, v) + mass * np.asarray(acceleration, dtype=float)
    right = step * (force - step * mesh_product(mesh, stiffness, v))
    v = v + conjugate_gradient(mesh, step[..., None] * (damping + step[..., None] * stiffness), right, tolerance)
    return p + step * v, v


def amplitude_kept(frequency: ArrayLike, dt: ArrayLike) -> Array:
    """Share of the amplitude of an undamped vibration that one step of backward Euler keeps: 1/√(1 + ω² dt²).

    Parameters
    ----------
    frequency : (...), ω, rad/s
    dt : (...), s

    Returns
    -------
    (...), 0 to 1
    """
    return np.asarray(1 / np.hypot(1, np.asarray(frequency, dtype=float) * np.asarray(dt, dtype=float)))


def _held(mesh: SpringMesh, vector: Array) -> Array:
    """The vectors with those of pinned nodes set to zero."""
    return np.where(mesh.pinned[:, None], 0.0, vector)


def _dot(a: Array, b: Array) -> Array:
    """Product over all nodes, (..., 1, 1)."""
    return np.asarray(np.sum(a * b, axis=(-2, -1), keepdims=True))
