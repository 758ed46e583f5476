"""How a mesh moves: a cheap step with a limit, a dear one without."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, positive
from solutions.forces import semi_implicit_euler
from solutions.meshes.conjugate_gradients import conjugate_gradient
from solutions.meshes.matrices import (
    edge_damping,
    edge_stiffness,
    mesh_product,
)
from solutions.meshes.mesh import AnyMesh, SpringMesh, as_mesh
from solutions.meshes.springs import finite_vectors, mesh_forces, node_vectors


def mesh_step(
    mesh: AnyMesh,
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after one step of semi-implicit Euler.

    The step computes the forces first, then the velocities, then the
    positions.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position, velocity : (n, 3), m and m/s
    acceleration : due to everything else, such as gravity, m/s²
        (3,) for all nodes alike, or (n, 3).
    dt : s, positive

    Returns
    -------
    position, velocity : (n, 3) each, m and m/s
        Pinned nodes stay where they are and have no velocity. A velocity given
        for a pinned node counts for nothing, also in the dampers.

    Raises
    ------
    ValueError
        If dt is not positive, or an array does not fit the mesh.

    Notes
    -----
    With the force f of springs and dampers at the start of the step, the mass
    m of a node and the other acceleration a, the step is

        v' = v + (f/m + a) dt,    p' = p + v' dt

    It is stable for a dt below `stable_timestep`. Above that limit the
    shortest wave of the mesh grows with every step. Leading axes of position
    and velocity make a batch, (..., n, 3), with a dt for each.
    """
    mesh = as_mesh(mesh)
    v = _held(mesh, node_vectors(mesh, "velocity", velocity))
    a = mesh.inverse_mass[:, None] * mesh_forces(mesh, position, v)
    a = a + _held(mesh, np.asarray(acceleration, dtype=float))
    return semi_implicit_euler(position, v, a, positive("dt", dt)[..., None])


def implicit_mesh_step(
    mesh: SpringMesh,
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: ArrayLike,
    dt: ArrayLike,
    tolerance: float = 1e-8,
) -> tuple[Array, Array]:
    """State after a step of backward Euler (Baraff and Witkin 1998).

    Vibrations do not grow, however long dt is, but they lose amplitude in
    every step, and high frequencies disappear at once: an angular frequency ω
    keeps the share 1/√(1 + (ω dt)²) of its amplitude.
    Momentum is conserved to the tolerance; angular momentum is not.

    Parameters
    ----------
    position, velocity : (..., n, 3), m and m/s
    acceleration : due to everything else, such as gravity
        Broadcast to (..., n, 3), m/s².
    dt : (...), s, positive and finite
    tolerance : of `conjugate_gradient`, for each node relative to its own mass

    Returns
    -------
    position, velocity : (..., n, 3) each, m and m/s
        Pinned nodes stay where they are and have no velocity. A flat cloth,
        which resists nothing across its plane, falls freely until the next
        step.

    Raises
    ------
    RuntimeError
        If the conjugate gradients do not reach the tolerance.
    ValueError
        If dt is not positive, an array does not fit the mesh, or dt, a
        position, or the velocity or acceleration of a node that is not pinned
        is not finite. Also if a force is too large for a float; the message
        calls it `right`.

    Notes
    -----
    Backward Euler takes the forces at the end of the step. They are not known
    yet, so the function expands them about the start of the step, with the
    stiffness K and the damping C of the whole mesh:

        f(p + dt v', v') ≈ f − dt K v' − C (v' − v)

    Insert this in M (v' − v) = dt (f(p + dt v', v') + M a), and write dt K v'
    with v' = v + (v' − v). Everything that contains the unknown v' − v moves
    to the left:

        (M + dt C + dt² K)(v' − v) = dt (f + M a − dt K v),    p' = p + dt v'

    K is clamped, because shortened springs would make the matrix indefinite. A
    vibration of frequency ω keeps the share 1/√(1 + ω² dt²) of its amplitude
    in each step. As the forces are linearised only once, a step knows only the
    directions that the springs have at its start. That is why a flat cloth
    falls freely in its first step.

    Rounding limits how stiff the springs may be, as the velocities are left
    over from much larger terms dt² K v. For a mesh that turns freely, with
    springs k between masses m, they have an error of up to some 10⁻¹⁶ dt² k/m.
    Six digits are right where dt² k/m is 10¹⁰, and none where it is 10¹⁶.
    Gaussian elimination on the whole matrix loses a digit more.
    """
    p = finite_vectors(mesh, "position", position)
    v = finite(
        "velocity", _held(mesh, node_vectors(mesh, "velocity", velocity))
    )
    other = finite(
        "acceleration", _held(mesh, np.asarray(acceleration, dtype=float))
    )
    step = finite("dt", positive("dt", dt))[..., None, None]
    stiffness, damping = edge_stiffness(mesh, p), edge_damping(mesh, p)
    mass = np.where(mesh.pinned, 0.0, mesh.mass)[:, None]
    force = mesh_forces(mesh, p, v) + mass * other
    right = step * (force - step * mesh_product(mesh, stiffness, v))
    v = v + conjugate_gradient(
        mesh,
        step[..., None] * (damping + step[..., None] * stiffness),
        right,
        tolerance,
    )
    return p + step * v, v


def _held(mesh: SpringMesh, vector: Array) -> Array:
    """The vectors, with those of pinned nodes set to zero."""
    return np.where(mesh.pinned[:, None], 0.0, vector)
