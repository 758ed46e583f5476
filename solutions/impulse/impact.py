"""An impact of two rigid bodies: the impulse that makes them rebound, and what it does (slides 11, 18, 20, 21)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, in_unit_interval, unit, vector
from solutions.impulse.body import AnyBody, Arrays, checked, moved
from solutions.impulse.momentum import contact_impulses
from solutions.impulse.points import COLLIDING, classify_contact, normal_velocity, point_velocity

Array = NDArray[np.float64]
NO_LEVER = 1e-15
"""Sine of the angle of arm and normal up to which r × n is rounding, and taken for zero."""
Velocities = tuple[Array, Array, Array, Array]
"""v_A, ω_A, v_B, ω_B, (..., 3) each, m/s and rad/s."""


def inverse_effective_mass(body_a: AnyBody, body_b: AnyBody, normal: ArrayLike) -> Array:
    """Normal velocity u_n that the points of contact gain from a unit impulse: the denominator of slide 20.

        k = 1/M_A + 1/M_B + n·((I_A⁻¹(r_A × n)) × r_A) + n·((I_B⁻¹(r_B × n)) × r_B)

    A unit impulse n on A changes v_A by n/M_A and ω_A by I_A⁻¹(r_A × n), so the velocity of its point by
    n/M_A + (I_A⁻¹(r_A × n)) × r_A. On B all that has a minus, which the difference ṗ_A − ṗ_B takes away again. A body
    that can turn gives way more easily at its rim: 1/k is never more than the mass of either. It is n·K n, with the
    matrix K = K_A + K_B of `point_inverse_mass`, which friction needs whole; here it stays as one derives it.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), unit, from B to A; the other way round k is the same

    Returns
    -------
    (...), k, 1/kg; 1/M_A + 1/M_B where the normal goes through both centres, r × n = 0; 0 where both are immovable

    Raises
    ------
    ValueError
        If a normal has not length 1, an inverse mass or the diagonal of an inverse inertia is negative, or something
        is not finite or does not fit.
    """
    n = unit("normal", vector("normal", normal))
    return _softness(checked(body_a), n) + _softness(checked(body_b), n)


def impulse_magnitude(body_a: AnyBody, body_b: AnyBody, normal: ArrayLike, restitution: ArrayLike) -> Array:
    """Size j of the impulse after which the points of contact part at −e u_n⁻ (slide 20).

        j = −(1 + e) u_n⁻ / (1/M_A + 1/M_B + n·((I_A⁻¹(r_A × n)) × r_A) + n·((I_B⁻¹(r_B × n)) × r_B))

    The slides say "put in terms of the unknown impulse … compute impulse" and give no formula. Step by step:

    1. Drop the time dependence: an impact is so short that r, n and I⁻¹ stand still and the weight does nothing.
    2. Slide 18, B with its minus: v_A⁺ = v_A⁻ + j n/M_A and ω_A⁺ = ω_A⁻ + I_A⁻¹(r_A × j n), for B with −j.
    3. Slide 14: so ṗ_A⁺ = v_A⁺ + ω_A⁺ × r_A = ṗ_A⁻ + j (n/M_A + (I_A⁻¹(r_A × n)) × r_A), for B with −j.
    4. Slide 19: u_n⁺ = n·(ṗ_A⁺ − ṗ_B⁺) = u_n⁻ + j k, where k gathers what stands beside j: all four terms with plus,
       for B's minus meets the minus of the difference, and n·n = 1.
    5. Slide 12, the reaction the user wants: u_n⁺ = −e u_n⁻. So u_n⁻ + j k = −e u_n⁻, and j = −(1 + e) u_n⁻/k.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), unit, from B to A
    restitution : (...), e, 0 to 1

    Returns
    -------
    (...), j, N s. It has no guard: of points that separate it is negative, an impulse that would pull them back;
    `collide` has one. 0 where no impulse stops them, k = 0, and they go through each other: both are immovable, or
    turn about pivots through which the normal goes.

    Raises
    ------
    ValueError
        If e is not from 0 to 1, or as inverse_effective_mass.
    """
    a, b, n = checked(body_a), checked(body_b), unit("normal", vector("normal", normal))
    e, k = in_unit_interval("restitution", restitution), _softness(a, n) + _softness(b, n)
    wanted = -(1 + e) * _closing(a, b, n)
    return np.where(k > 0, wanted / np.where(k > 0, k, 1.0), 0.0)


def apply_impulse(body_a: AnyBody, body_b: AnyBody, impulse: ArrayLike) -> Velocities:
    """Velocities after an impulse, J on A and −J on B (slide 18).

        v_A⁺ = v_A⁻ + J/M_A        ω_A⁺ = ω_A⁻ + I_A⁻¹(r_A × J)
        v_B⁺ = v_B⁻ − J/M_B        ω_B⁺ = ω_B⁻ − I_B⁻¹(r_B × J)

    The slide has plus for both. That contradicts its own pseudo-code, P_B −= J, and Newton's third law: the pair would
    push itself along.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    impulse : (..., 3), J, on A, at the point of contact, N s

    Returns
    -------
    v_A, ω_A, v_B, ω_B : (..., 3) each; an immovable body goes on as it did

    Raises
    ------
    ValueError
        As inverse_effective_mass, or if an impulse is not finite.
    """
    a, b, impulse = checked(body_a), checked(body_b), finite("impulse", vector("impulse", impulse))
    (dv_a, dw_a), (dv_b, dw_b) = moved(a, impulse), moved(b, impulse)
    return a[0] + dv_a, a[1] + dw_a, b[0] - dv_b, b[1] - dw_b


def collide(
    body_a: AnyBody, body_b: AnyBody, normal: ArrayLike, restitution: ArrayLike, threshold: ArrayLike = 0.0
) -> Velocities:
    """Velocities of two bodies after an impact at a point, if they collide there (slides 11 and 21).

    The whole of slide 21: the velocities of the points, the velocity along the normal, and if that is colliding the
    impulse j n on A and −j n on B.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), unit, from B to A
    restitution : (...), e, 0 to 1
    threshold : (...), m/s: what closes no faster than this is resting

    Returns
    -------
    v_A, ω_A, v_B, ω_B : (..., 3) each; of a pair that rests, grazes or separates unchanged, and so of one that no
        impulse stops, such as two immovable bodies

    Raises
    ------
    ValueError
        If a threshold is negative, or as impulse_magnitude.
    """
    a, b, n = checked(body_a), checked(body_b), unit("normal", vector("normal", normal))
    colliding = classify_contact(_closing(a, b, n), threshold) == COLLIDING
    magnitude = np.where(colliding, impulse_magnitude(a, b, n, restitution), 0.0)
    on_a, _ = contact_impulses(magnitude, n)
    return apply_impulse(a, b, on_a)


def energy_lost(body_a: AnyBody, body_b: AnyBody, normal: ArrayLike, restitution: ArrayLike) -> Array:
    """Kinetic energy that an impact takes: ΔE = (1 − e²) u_n⁻²/(2k), with the k of `inverse_effective_mass`.

    It is the energy of the closing motion of an effective mass 1/k, less that of the parting motion. An immovable body
    that moves does work besides: beside one, ΔE is what an observer sees who moves along with its point of contact.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), unit, from B to A
    restitution : (...), e, 0 to 1

    Returns
    -------
    (...), J; 0 of a pair that does not approach, and of two immovable bodies

    Raises
    ------
    ValueError
        As impulse_magnitude.
    """
    a, b, n = checked(body_a), checked(body_b), unit("normal", vector("normal", normal))
    e, k = in_unit_interval("restitution", restitution), _softness(a, n) + _softness(b, n)
    closing = np.minimum(_closing(a, b, n), 0.0)
    return np.where(k > 0, (1 - e**2) * closing**2 / np.where(k > 0, 2 * k, 1.0), 0.0)


def _softness(body: Arrays, normal: Array) -> Array:
    """One body's part of k: 1/M + n·((I⁻¹(r × n)) × r).

    A lever that is but rounding counts as none: it would give a body on a pivot, 1/M = 0, any spin there is.
    """
    r = body[2]
    dv, dw = moved(body, normal)
    lever = np.linalg.norm(np.cross(r, normal), axis=-1) > NO_LEVER * np.linalg.norm(r, axis=-1)
    turning = np.where(lever, np.vecdot(normal, np.cross(dw, r)), 0.0)
    return np.asarray(np.vecdot(normal, dv) + turning)


def _closing(a: Arrays, b: Arrays, normal: Array) -> Array:
    """The normal velocity u_n⁻ of the points of contact."""
    return normal_velocity(point_velocity(*a[:3]), point_velocity(*b[:3]), normal)
