"""Bodies that rest on each other: one row per contact, and the problem that their forces solve (slide 22)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import not_negative, vector
from solutions.friction.cone import clamp_to_circle

Array = NDArray[np.float64]


def contact_jacobian(
    body_a: ArrayLike, body_b: ArrayLike, direction: ArrayLike, arm_a: ArrayLike, arm_b: ArrayLike, bodies: int
) -> Array:
    """Rows that turn the bodies' velocities into u·d at each contact: (d, r_A × d, −d, −r_B × d), (m, 6 bodies).

    A column holds v and ω of a body, one body after another. With d the normal it is the speed of separation; its
    transpose turns the contact forces into forces and torques on the bodies.

    Parameters
    ----------
    body_a, body_b : (m,), numbers of the bodies from 0, −1 for the immovable ground
    direction : (m, 3), d, unit: the normal from B to A, or a direction along the surface
    arm_a, arm_b : (m, 3), from each centre of mass to the contact, m

    Raises
    ------
    ValueError
        If a number is no body's, or a vector has not three components.
    """
    rows = vector("direction", direction)
    jacobian = np.zeros((len(rows), bodies, 6))
    for name, body, arm, sign in (("body_a", body_a, arm_a, 1.0), ("body_b", body_b, arm_b, -1.0)):
        number = np.broadcast_to(body, len(rows))
        if np.any((number < -1) | (number >= bodies)):
            raise ValueError(f"{name} must be from -1 to {bodies - 1}, not {number}")
        there = np.flatnonzero(number >= 0)
        entries = np.concatenate([rows, np.cross(vector(name.replace("body", "arm"), arm), rows)], axis=-1)
        jacobian[there, number[there]] += sign * entries[there]
    return jacobian.reshape(len(rows), 6 * bodies)


def inverse_mass_matrix(inverse_mass: ArrayLike, inverse_inertia: ArrayLike) -> Array:
    """M⁻¹ of all bodies together, (6 n, 6 n): 1/m three times and I⁻¹, body after body along the diagonal.

    Parameters
    ----------
    inverse_mass : (n,), 1/kg
    inverse_inertia : (n, 3, 3), in the world frame, 1/(kg m²)

    Raises
    ------
    ValueError
        If 1/m is negative.
    """
    shares = not_negative("inverse_mass", inverse_mass)
    blocks = np.zeros((len(shares), 6, len(shares), 6))
    each = np.arange(len(shares))
    blocks[each, :3, each, :3] = shares[:, None, None] * np.eye(3)
    blocks[each, 3:, each, 3:] = inverse_inertia
    return blocks.reshape(6 * len(shares), 6 * len(shares))


def resting_problem(jacobian: ArrayLike, inverse_mass: ArrayLike, force: ArrayLike) -> tuple[Array, Array]:
    """The problem of resting contacts: A = G M⁻¹ Gᵀ, (..., m, m), 1/kg, and b = G M⁻¹ F, (..., m), m/s².

    The contact forces f solve a linear complementarity problem: A f + b ≥ 0, nothing accelerates into another;
    f ≥ 0, nothing pulls; f·(A f + b) = 0, what lifts off feels no force. With a velocity in place of M⁻¹ F the same
    problem gives impulses.

    Parameters
    ----------
    jacobian : (..., m, d), G, of the normals
    inverse_mass : (..., d, d), M⁻¹
    force : (..., d), all other forces and torques, F
    """
    g, w = np.asarray(jacobian, dtype=float), np.asarray(inverse_mass, dtype=float)
    return g @ w @ np.swapaxes(g, -1, -2), np.matvec(g @ w, np.asarray(force, dtype=float))


def sequential_impulses(
    velocity: ArrayLike, jacobian: ArrayLike, inverse_mass: ArrayLike, friction: ArrayLike, sweeps: int = 50
) -> tuple[Array, Array]:
    """Velocities and impulses of contacts that rest, with friction: contact after contact, again and again (slide 22).

    Each contact in its turn gets the impulse that ends its own approach, and its own slip. What is clamped is the
    sum of all its impulses so far: the normal one at zero, so that a later impulse may take back what an earlier one
    gave too much; the one along the surface at the circle μ j_n.

    Parameters
    ----------
    velocity : (d,), of all bodies before, gravity's Δt g added, m/s and rad/s
    jacobian : (m, 3, d), for each contact the row of the normal and of two directions along the surface
    inverse_mass : (d, d), M⁻¹
    friction : (m,) or one number, μ
    sweeps : how often to go through all contacts

    Returns
    -------
    velocity : (d,), m/s and rad/s
    impulse : (m, 3), along the normal and the two directions, N s

    Raises
    ------
    ValueError
        If μ is negative.
    """
    v, rows = np.array(velocity, dtype=float), np.asarray(jacobian, dtype=float)
    mu = np.broadcast_to(not_negative("friction", friction), len(rows))
    impulses = np.zeros((len(rows), 3))
    answers = rows @ np.asarray(inverse_mass, dtype=float)  # velocities that unit impulses give, (m, 3, d)
    masses = 1 / np.maximum(np.vecdot(answers, rows), np.finfo(float).tiny)  # no row, no impulse
    for _ in range(sweeps):
        for g, answer, mass, total, limit in zip(rows, answers, masses, impulses, mu, strict=True):
            before = total.copy()
            total[0] = max(0.0, total[0] - mass[0] * (g[0] @ v))
            v += (total[0] - before[0]) * answer[0]
            total[1:] -= mass[1:] * (g[1:] @ v)
            total[1:] = clamp_to_circle([*total[1:], 0.0], limit * total[0])[:2]
            v += (total[1:] - before[1:]) @ answer[1:]
    return v, impulses
