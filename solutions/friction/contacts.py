"""Bodies that rest on each other: one row per contact, and the problem that their forces solve (slide 22)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, matrix, not_negative, unit, vector
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
    bodies : how many there are

    Raises
    ------
    ValueError
        If a number is no body's, a direction has not length 1, or a vector has not three components.
    """
    rows = unit("direction", vector("direction", direction))
    if rows.ndim != 2:
        raise ValueError(f"direction must have shape (m, 3), not {rows.shape}")
    jacobian = np.zeros((len(rows), bodies, 6))
    for name, body, arm, sign in (("body_a", body_a, arm_a, 1.0), ("body_b", body_b, arm_b, -1.0)):
        number = _numbers(name, body, len(rows), bodies)
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
        If 1/m is negative or not finite, or the shapes do not fit.
    """
    shares = finite("inverse_mass", not_negative("inverse_mass", inverse_mass))
    if shares.ndim != 1:
        raise ValueError(f"inverse_mass must have shape (n,), not {shares.shape}")
    blocks = np.zeros((len(shares), 6, len(shares), 6))
    each = np.arange(len(shares))
    blocks[each, :3, each, :3] = shares[:, None, None] * np.eye(3)
    blocks[each, 3:, each, 3:] = matrix("inverse_inertia", inverse_inertia)
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
    impulse : (m, 3), along the normal and the two directions, N s; none along a row that moves nothing, as between two
        immovable bodies

    Raises
    ------
    ValueError
        If μ is negative or not finite, or a velocity is not finite.
    """
    v, rows = np.array(finite("velocity", velocity)), np.asarray(jacobian, dtype=float)
    mu = np.broadcast_to(finite("friction", not_negative("friction", friction)), len(rows))
    impulses = np.zeros((len(rows), 3))
    answers = rows @ np.asarray(inverse_mass, dtype=float)  # velocities that unit impulses give, (m, 3, d)
    gained = np.vecdot(answers, rows)
    masses = np.where(gained > 0, 1 / np.where(gained > 0, gained, 1.0), 0.0)
    for _ in range(sweeps):
        for g, answer, mass, total, limit in zip(rows, answers, masses, impulses, mu, strict=True):
            before = total.copy()
            total[0] = max(0.0, total[0] - mass[0] * (g[0] @ v))
            v += (total[0] - before[0]) * answer[0]
            total[1:] -= mass[1:] * (g[1:] @ v)
            total[1:] = clamp_to_circle([*total[1:], 0.0], limit * total[0])[:2]
            v += (total[1:] - before[1:]) @ answer[1:]
    return v, impulses


def _numbers(name: str, body: ArrayLike, contacts: int, bodies: int) -> NDArray[np.int_]:
    """The numbers of the bodies, (m,); refuse what is no body's."""
    number = np.broadcast_to(np.asarray(body, dtype=float), contacts)
    wrong = ~((number >= -1) & (number < bodies) & (number == np.floor(number)))
    if np.any(wrong):
        raise ValueError(f"{name} must be a number of a body, -1 to {bodies - 1}, not {number[wrong][0]:g}")
    return number.astype(int)
