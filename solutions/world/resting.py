"""Bodies that rest on each other, and their forces (slide 22).

Each contact is a row of a matrix, and the forces solve a problem made of these
rows.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import finite, matrix, not_negative, unit, vector, whole


def contact_jacobian(
    body_a: ArrayLike,
    body_b: ArrayLike,
    direction: ArrayLike,
    arm_a: ArrayLike,
    arm_b: ArrayLike,
    bodies: int,
) -> Array:
    """Rows that turn the velocities of the bodies into u·d at each contact.

    Here u is the velocity of A's point of contact minus that of B's.

    Parameters
    ----------
    body_a, body_b : (m,), numbers of the bodies from 0, −1 for the immovable
    ground
    direction : (m, 3), d, unit
        The normal from B to A, or a direction along the surface.
    arm_a, arm_b : (m, 3), from each centre of mass to the contact, m
    bodies : how many bodies there are

    Returns
    -------
    (m, 6 bodies)
        The columns hold v and ω of a body, one body after another. A row is
        zero at every body that is not part of its contact; the ground has no
        columns.

    Raises
    ------
    ValueError
        If a number is not that of a body, a direction does not have length 1,
        or a vector does not have three components.

    Notes
    -----
    The velocity of A's point of contact is v_A + ω_A × r_A. Its component
    along d is d·v_A + (r_A × d)·ω_A, because the three vectors of a triple
    product may be rotated. The same holds for B, which is subtracted. So the
    row has four parts, for v_A, ω_A, v_B and ω_B:

        d,  r_A × d,  −d,  −r_B × d

    With the normal for d, the row times the velocities is the speed of
    separation. The transpose of the matrix turns the contact forces into
    forces and torques on the bodies.
    """
    rows = unit("direction", vector("direction", direction))
    if rows.ndim != 2:
        raise ValueError(f"direction must have shape (m, 3), not {rows.shape}")
    jacobian = np.zeros((len(rows), bodies, 6))
    for name, body, arm, sign in (
        ("body_a", body_a, arm_a, 1.0),
        ("body_b", body_b, arm_b, -1.0),
    ):
        number = _numbers(name, body, len(rows), bodies)
        there = np.flatnonzero(number >= 0)
        entries = np.concatenate(
            [rows, np.cross(vector(name.replace("body", "arm"), arm), rows)],
            axis=-1,
        )
        jacobian[there, number[there]] += sign * entries[there]
    return jacobian.reshape(len(rows), 6 * bodies)


def inverse_mass_matrix(
    inverse_mass: ArrayLike, inverse_inertia: ArrayLike
) -> Array:
    """Inverse masses and inverse inertias of all bodies in one matrix, M⁻¹.

    Parameters
    ----------
    inverse_mass : (n,), 1/kg
    inverse_inertia : (n, 3, 3), in the world frame, 1/(kg m²)

    Returns
    -------
    (6 n, 6 n)
        Body after body along the diagonal: 1/m three times, then I⁻¹; zero
        elsewhere.

    Raises
    ------
    ValueError
        If 1/m is negative or not finite, or the shapes do not fit.
    """
    shares = finite("inverse_mass", not_negative("inverse_mass", inverse_mass))
    if shares.ndim != 1:
        raise ValueError(
            f"inverse_mass must have shape (n,), not {shares.shape}"
        )
    blocks = np.zeros((len(shares), 6, len(shares), 6))
    each = np.arange(len(shares))
    blocks[each, :3, each, :3] = shares[:, None, None] * np.eye(3)
    blocks[each, 3:, each, 3:] = matrix("inverse_inertia", inverse_inertia)
    return blocks.reshape(6 * len(shares), 6 * len(shares))


def resting_problem(
    jacobian: ArrayLike,
    inverse_mass: ArrayLike,
    force: ArrayLike,
) -> tuple[Array, Array]:
    """The complementarity problem that the forces of resting contacts solve.

    Parameters
    ----------
    jacobian : (..., m, d), G, of the normals
    inverse_mass : (..., d, d), M⁻¹
    force : (..., d), F, all other forces and torques, N and N m

    Returns
    -------
    matrix : (..., m, m), A, 1/kg
        The accelerations along the normals that unit contact forces give.
    offset : (..., m), b, m/s²
        The accelerations along the normals that all other forces give.

    Notes
    -----
    The contact forces f and all other forces F give the bodies the
    accelerations M⁻¹ (Gᵀ f + F). Multiplied by G, these are the accelerations
    along the normals, A f + b, with

        A = G M⁻¹ Gᵀ,    b = G M⁻¹ F

    The forces solve a linear complementarity problem. A f + b ≥ 0: no body
    accelerates into another. f ≥ 0: no contact pulls. f·(A f + b) = 0: a
    contact that lifts off has no force. With a velocity in place of M⁻¹ F, the
    same problem gives impulses.
    """
    g, w = (
        np.asarray(jacobian, dtype=float),
        np.asarray(inverse_mass, dtype=float),
    )
    return g @ w @ np.swapaxes(g, -1, -2), np.matvec(
        g @ w, np.asarray(force, dtype=float)
    )


def sequential_impulses(
    velocity: ArrayLike,
    jacobian: ArrayLike,
    inverse_mass: ArrayLike,
    friction: ArrayLike,
    sweeps: int = 50,
    start: ArrayLike = 0.0,
    least: ArrayLike = 0.0,
) -> tuple[Array, Array]:
    """Velocities and impulses of resting contacts with friction (slide 22).

    Parameters
    ----------
    velocity : (d,), of all bodies before, m/s and rad/s
        With the Δt g of gravity already added.
    jacobian : (m, 3, d)
        For each contact the row of the normal and of two directions along the
        surface.
    inverse_mass : (d, d), M⁻¹
    friction : (m,) or one number, μ
    sweeps : how often to go through all contacts
    start : (m, 3), impulses to begin with, such as those of the last step, N s
    least : (m,) or one number, m/s
        The least speed along each normal that the impulses have to reach:
        −gap/Δt lets two surfaces come together that are not in touch yet.

    Returns
    -------
    velocity : (d,), m/s and rad/s
    impulse : (m, 3), along the normal and the two directions, N s
        None along a row that moves nothing, as between two immovable bodies.

    Raises
    ------
    ValueError
        If μ is negative or not finite, a velocity is not finite, or sweeps is
        no whole number from 0.

    Notes
    -----
    The function goes through the contacts one after another, again and again.
    Each contact in its turn gets the impulse that ends its own approach, and
    then the impulse that ends its own slip. The sum of all impulses that a
    contact has had so far is clamped, and not the single impulse. The sum
    along the normal is clamped at zero, so that a later impulse may take back
    what an earlier one gave too much. The sum along the surface is clamped to
    the circle of radius μ j_n.
    """
    v, rows = (
        np.array(finite("velocity", velocity)),
        np.asarray(jacobian, dtype=float),
    )
    mu = np.broadcast_to(
        finite("friction", not_negative("friction", friction)), len(rows)
    )
    impulses = np.array(np.broadcast_to(start, (len(rows), 3)), dtype=float)
    wanted = np.broadcast_to(finite("least", least), len(rows))
    # The velocities that unit impulses give, (m, 3, d), and what they change
    # at their own place, (m, 3, 3).
    answers = rows @ np.asarray(inverse_mass, dtype=float)
    v += np.tensordot(impulses, answers, axes=2)
    own = answers @ rows.mT
    gained = np.diagonal(own, axis1=-2, axis2=-1)
    masses = np.where(gained > 0, 1 / np.where(gained > 0, gained, 1.0), 0.0)
    # Three numbers at a time are faster in plain Python.
    once = [each.tolist() for each in (masses, own[:, 1:, 0], mu, wanted)]
    sums = impulses.tolist()
    count = int(
        finite("sweeps", not_negative("sweeps", whole("sweeps", sweeps)))
    )
    for _ in range(count):
        for k, (mass, beside, limit, least_speed) in enumerate(
            zip(*once, strict=True)
        ):
            speeds, (pressed, *rubbed) = (rows[k] @ v).tolist(), sums[k]
            normal = max(0.0, pressed - mass[0] * (speeds[0] - least_speed))
            more = normal - pressed
            first, second = (
                rubbed[i] - mass[i + 1] * (speeds[i + 1] + more * beside[i])
                for i in (0, 1)
            )
            slip, most = math.hypot(first, second), limit * normal
            if slip > most:  # as clamp_to_circle, which takes arrays
                first, second = first * most / slip, second * most / slip
            v += (more, first - rubbed[0], second - rubbed[1]) @ answers[k]
            sums[k] = [normal, first, second]
    return v, np.array(sums, dtype=float).reshape(impulses.shape)


def _numbers(
    name: str, body: ArrayLike, contacts: int, bodies: int
) -> NDArray[np.int_]:
    """The numbers of bodies, (m,); refuse one that is not that of a body."""
    number = np.broadcast_to(np.asarray(body, dtype=float), contacts)
    wrong = ~(
        (number >= -1) & (number < bodies) & (number == np.floor(number))
    )
    if np.any(wrong):
        raise ValueError(
            f"{name} must be a number of a body, -1 to {bodies - 1}, not"
            f" {number[wrong][0]:g}"
        )
    return number.astype(int)
