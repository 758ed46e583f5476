"""Bodies that rest on each other, and their forces (slide 22).

Each contact is a row of a matrix, and the forces solve a problem made of these
rows.
"""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from solutions.arrays import Array
from solutions.checks import finite, not_negative, unit, with_shape
from solutions.domain import (
    Finite,
    FiniteNotNegative,
    Matrix,
    Number,
    Triple,
    Whole,
    domain,
)
from solutions.vectors import quotient

UnitRows = Annotated[Array, with_shape("m", 3), unit]
"""(m, 3), of length 1 each."""
InverseMasses = Annotated[Array, with_shape("n"), not_negative, finite]
"""(n,), finite and not negative."""


@domain
def contact_jacobian(
    body_a: Number,
    body_b: Number,
    direction: UnitRows,
    arm_a: Triple,
    arm_b: Triple,
    bodies: int,
) -> Array:
    """Rows that turn the velocities of the bodies into u·d at each contact.

    Here u is the velocity of A's point of contact minus that of B's.

    Parameters
    ----------
    body_a, body_b : (m,), numbers of the bodies from 0
        Or −1 for the immovable ground.
    direction : (m, 3), d, unit
        The normal from B to A, or a direction along the surface.
    arm_a, arm_b : (m, 3), from each centre of mass to the contact, m
    bodies : how many bodies there are, a number

    Returns
    -------
    (m, 6 bodies)
        The columns hold v and ω of a body, one body after another. A row is
        zero at every body that is not part of its contact; the ground has no
        columns.

    Raises
    ------
    ValueError
        If a number is not that of a body.

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
    m = len(direction)
    jacobian = np.zeros((m, bodies, 6))
    for name, body, arm, sign in (
        ("body_a", body_a, arm_a, 1.0),
        ("body_b", body_b, arm_b, -1.0),
    ):
        number = _numbers(name, body, m, bodies)
        there = np.flatnonzero(number >= 0)
        turn = np.cross(arm, direction)
        entries = np.concatenate([direction, turn], axis=-1)
        jacobian[there, number[there]] += sign * entries[there]
    return jacobian.reshape(m, 6 * bodies)


@domain
def inverse_mass_matrix(
    inverse_mass: InverseMasses, inverse_inertia: Matrix
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
    """
    n = len(inverse_mass)
    body = np.arange(n)
    blocks = np.zeros((n, 6, n, 6))
    blocks[body, :3, body, :3] = inverse_mass[:, None, None] * np.eye(3)
    blocks[body, 3:, body, 3:] = inverse_inertia
    return blocks.reshape(6 * n, 6 * n)


@domain
def resting_problem(
    jacobian: Number, inverse_mass: Number, force: Number
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

        A = G M⁻¹ Gᵀ
        b = G M⁻¹ F

    The forces solve a linear complementarity problem:

        A f + b ≥ 0         no body accelerates into another
        f ≥ 0               no contact pulls
        f·(A f + b) = 0     a contact that lifts off has no force

    With a velocity in place of M⁻¹ F, the same problem gives impulses.
    """
    g, w = jacobian, inverse_mass
    return g @ w @ np.swapaxes(g, -1, -2), np.matvec(g @ w, force)


@domain
def sequential_impulses(
    velocity: Finite,
    jacobian: Number,
    inverse_mass: Number,
    friction: FiniteNotNegative,
    sweeps: Whole = 50,
    start: Number = 0.0,
    least: Finite = 0.0,
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
    sweeps : how often to go through all contacts, a number
    start : (m, 3), impulses to begin with, such as those of the last step, N s
    least : (m,) or one number, m/s
        The least speed along each normal that the impulses have to reach:
        −gap/Δt lets two surfaces come together that are not in touch yet.

    Returns
    -------
    velocity : (d,), m/s and rad/s
    impulse : (m, 3), along the normal and the two directions, N s
        None along a row that moves nothing, as between two immovable bodies.

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
    count = len(jacobian)
    # The velocities that unit impulses give, (m, 3, d), and what they change
    # at their own place, (m, 3, 3).
    answers = jacobian @ inverse_mass
    own = answers @ jacobian.mT
    gained = np.diagonal(own, axis1=-2, axis2=-1)
    masses = np.where(gained > 0, quotient(1.0, gained), 0.0)
    impulse = np.broadcast_to(start, (count, 3))
    v = velocity + np.tensordot(impulse, answers, axes=2)
    # Three numbers at a time are faster in plain Python.
    sums, masses, across, mu, least = (
        array.tolist()
        for array in (
            impulse,
            masses,
            own[:, 1:, 0],
            np.broadcast_to(friction, count),
            np.broadcast_to(least, count),
        )
    )
    contacts = list(zip(masses, across, mu, least, strict=True))
    for _ in range(int(sweeps)):
        for k, (mass, beside, limit, least_speed) in enumerate(contacts):
            speeds = (jacobian[k] @ v).tolist()
            pressed, *rubbed = sums[k]
            normal = max(0.0, pressed - mass[0] * (speeds[0] - least_speed))
            more = normal - pressed
            first, second = (
                rubbed[i] - mass[i + 1] * (speeds[i + 1] + more * beside[i])
                for i in (0, 1)
            )
            rub, most = math.hypot(first, second), limit * normal
            if rub > most:  # as clamp_to_circle, which takes arrays
                first, second = first * most / rub, second * most / rub
            v += (more, first - rubbed[0], second - rubbed[1]) @ answers[k]
            sums[k] = [normal, first, second]
    return v, np.array(sums, dtype=float).reshape(count, 3)


def _numbers(
    name: str, body: Array, contacts: int, bodies: int
) -> NDArray[np.int_]:
    """The numbers of bodies, (m,); refuse one that is not that of a body."""
    number = np.broadcast_to(body, contacts)
    right = (number >= -1) & (number < bodies) & (number == np.floor(number))
    wrong = ~right
    if np.any(wrong):
        raise ValueError(
            f"{name} must be a number of a body, -1 to {bodies - 1}, not"
            f" {number[wrong][0]:g}"
        )
    return number.astype(int)
