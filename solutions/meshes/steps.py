"""How a mesh moves: cheap steps with a limit, costly ones without."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.checks import finite
from solutions.domain import Finite, FinitePositive, Number, Positive, domain
from solutions.forces import semi_implicit_euler
from solutions.meshes.conjugate_gradients import conjugate_gradient
from solutions.meshes.matrices import (
    edge_damping,
    edge_stiffness,
    mesh_product,
)
from solutions.meshes.mesh import Mesh
from solutions.meshes.springs import held, mesh_forces, require_fit


@domain
def mesh_step(
    mesh: Mesh,
    position: Number,
    velocity: Number,
    acceleration: Number,
    dt: Positive,
) -> tuple[Array, Array]:
    """State after one step of semi-implicit Euler.

    The step computes the forces first, then the velocities, then the
    positions.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position, velocity : (n, 3), p and v, m, m/s
    acceleration : (3,) for all nodes alike, or (n, 3), a, m/s²
        It is due to everything else, such as gravity.
    dt : one number, s, positive

    Returns
    -------
    position, velocity : (n, 3) each, m, m/s
        Pinned nodes stay where they are and have no velocity. A velocity given
        for a pinned node counts for nothing, also in the dampers.

    Raises
    ------
    ValueError
        If an array does not fit the mesh.

    Notes
    -----
    With the force f of springs and dampers at the start of the step, and the
    mass m of a node, the step is

        v' = v + (f/m + a) dt
        p' = p + v' dt

    It is stable for a dt below `stable_timestep`. Above that limit the
    shortest wave of the mesh grows with every step.

    The function also takes a batch of states, (..., n, 3), with a dt for each.
    """
    require_fit(mesh, velocity=velocity)
    v = held(mesh, velocity)
    force = mesh_forces(mesh, position, v)
    total = mesh.inverse_mass[:, None] * force + held(mesh, acceleration)
    # There is one dt for all nodes of a mesh.
    return semi_implicit_euler(position, v, total, dt[..., None])


@domain
def implicit_mesh_step(
    mesh: Mesh,
    position: Finite,
    velocity: Number,
    acceleration: Number,
    dt: FinitePositive,
    tolerance: float = 1e-8,
) -> tuple[Array, Array]:
    """State after a step of backward Euler (Baraff and Witkin 1998).

    Vibrations do not grow, however long dt is, but they lose amplitude in
    every step, and high frequencies disappear at once: an angular frequency ω
    keeps the share 1/√(1 + (ω dt)²) of its amplitude. Momentum is conserved to
    the tolerance; angular momentum is not.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position : (..., n, 3), p, m, finite
    velocity : (..., n, 3), v, m/s
    acceleration : (3,) for all nodes alike, or (..., n, 3), a, m/s²
        It is due to everything else, such as gravity.
    dt : (...), s, positive and finite
    tolerance : one number, of `conjugate_gradient`
        It is relative to the mass of each node.

    Returns
    -------
    position, velocity : (..., n, 3) each, m, m/s
        Pinned nodes stay where they are and have no velocity. A flat cloth,
        which resists nothing across its plane, falls freely until the next
        step.

    Raises
    ------
    RuntimeError
        If the conjugate gradients do not reach the tolerance.
    ValueError
        If an array does not fit the mesh, or the velocity or acceleration of a
        node that is not pinned is not finite. Also if a force is too large for
        a float; the message calls it `right`.

    Notes
    -----
    Backward Euler takes the forces at the end of the step. They are not known
    yet, so the function expands them about the start of the step, with the
    stiffness K and the damping C of the whole mesh:

        f(p + dt v', v') ≈ f − dt K v' − C (v' − v)

    Insert this in

        M (v' − v) = dt (f(p + dt v', v') + M a)

    and write dt K v' with v' = v + (v' − v). Everything that contains the
    unknown v' − v moves to the left:

        (M + dt C + dt² K)(v' − v) = dt (f + M a − dt K v)
        p' = p + dt v'

    K is clamped, because shortened springs would make the matrix indefinite.
    As the forces are linearised only once, a step knows only the directions
    that the springs have at its start. That is why a flat cloth falls freely
    in its first step.

    Rounding limits how stiff the springs may be, as the velocities are left
    over from much larger terms dt² K v. For a mesh that turns freely, with
    springs k between masses m, they have an error of up to some 10⁻¹⁶ dt² k/m.
    Six digits are right where dt² k/m is 10¹⁰, and none where it is 10¹⁶.
    Gaussian elimination on the whole matrix loses a digit more.
    """
    require_fit(mesh, position=position, velocity=velocity)
    v = finite("velocity", held(mesh, velocity))
    a = finite("acceleration", held(mesh, acceleration))
    dt = dt[..., None, None]
    stiffness = edge_stiffness(mesh, position)
    damping = edge_damping(mesh, position)
    mass = np.where(mesh.pinned, 0.0, mesh.mass)[:, None]
    force = mesh_forces(mesh, position, v) + mass * a
    right = dt * (force - dt * mesh_product(mesh, stiffness, v))
    blocks = dt[..., None] * (damping + dt[..., None] * stiffness)
    v = v + conjugate_gradient(mesh, blocks, right, tolerance)
    return position + dt * v, v
