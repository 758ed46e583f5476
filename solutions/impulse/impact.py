"""The impulse of an impact, and what it does (slides 11, 18, 20 and 21)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Share, Unit, Vector, domain
from solutions.impulse.body import (
    AnyBody,
    Body,
    Velocities,
    velocity_changes,
)
from solutions.impulse.points import (
    COLLIDING,
    classify_contact,
    normal_velocity,
)
from solutions.vectors import quotient

NO_LEVER = 1e-15
"""Sine of the angle between arm and normal up to which r × n counts as zero.

Up to this value r × n is rounding.
"""


@domain
def apply_impulse(
    body_a: AnyBody, body_b: AnyBody, impulse: Vector
) -> Velocities:
    """Velocities after an impulse, J on A and −J on B (slide 18).

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    impulse : (..., 3), J, on A, at the point of contact, N s

    Returns
    -------
    v_A, ω_A, v_B, ω_B : (..., 3) each, m/s and rad/s
        An immovable body keeps its velocities.

    Notes
    -----
    An impulse changes the momentum of a body by J and its angular momentum by
    r × J. Divided by the mass and multiplied by I⁻¹, these are changes of v
    and ω:

        v_A⁺ = v_A⁻ + J/M_A
        ω_A⁺ = ω_A⁻ + I_A⁻¹(r_A × J)
        v_B⁺ = v_B⁻ − J/M_B
        ω_B⁺ = ω_B⁻ − I_B⁻¹(r_B × J)

    The slide has a plus sign for both bodies. This contradicts the slides' own
    pseudo-code, P_B −= J, and Newton's third law: the pair would push itself
    along.
    """
    v_a, w_a, *_ = body_a
    v_b, w_b, *_ = body_b
    dv_a, dw_a = velocity_changes(body_a, impulse)
    dv_b, dw_b = velocity_changes(body_b, impulse)
    return v_a + dv_a, w_a + dw_a, v_b - dv_b, w_b - dw_b


@domain
def impulse_magnitude(
    body_a: AnyBody, body_b: AnyBody, normal: Unit, restitution: Share
) -> Array:
    """Size of the impulse after which the points part at −e u_n⁻ (slide 20).

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), n, unit, from B to A
    restitution : (...), e, 0 to 1

    Returns
    -------
    (...), j, N s
        The function has no guard: for points that separate, j is negative, an
        impulse that would pull them back. `collide` has a guard. j is 0 where
        no impulse stops the points, k = 0, and they go through each other:
        both bodies are immovable, or they turn about pivots through which the
        normal goes.

    Notes
    -----
    The slides say "put in terms of the unknown impulse … compute impulse" and
    give no formula. It follows step by step:

    1. Drop the time dependence. An impact is so short that r, n and I⁻¹ stay
       as they are and the weight has no effect.
    2. Slide 18, with a minus sign for B: v_A⁺ = v_A⁻ + j n/M_A and
       ω_A⁺ = ω_A⁻ + I_A⁻¹(r_A × j n). For B, replace j by −j.
    3. Slide 14 gives the velocities of the points: ṗ_A⁺ = v_A⁺ + ω_A⁺ × r_A,
       which is ṗ_A⁻ + j (n/M_A + (I_A⁻¹(r_A × n)) × r_A). For B, replace j by
       −j.
    4. Slide 19 gives the normal velocity: u_n⁺ = n·(ṗ_A⁺ − ṗ_B⁺) = u_n⁻ + j k,
       where k collects the factors of j. All four terms of k have a plus sign,
       because B's minus meets the minus of the difference, and n·n = 1.
    5. Slide 12 gives the rebound that the user wants: u_n⁺ = −e u_n⁻. So
       u_n⁻ + j k = −e u_n⁻, and j = −(1 + e) u_n⁻/k.

    Written out, the result is

        j = −(1 + e) u_n⁻ / k

        k = 1/M_A + 1/M_B
            + n·((I_A⁻¹(r_A × n)) × r_A) + n·((I_B⁻¹(r_B × n)) × r_B)
    """
    u_n = normal_velocity(body_a, body_b, normal)
    k = inverse_effective_mass(body_a, body_b, normal)
    # Rounding may leave a k that is zero just below it.
    return quotient(-(1 + restitution) * u_n, np.maximum(k, 0.0))


@domain
def inverse_effective_mass(
    body_a: AnyBody, body_b: AnyBody, normal: Unit
) -> Array:
    """Normal velocity that the points gain from a unit impulse (slide 20).

    It is the denominator of j in `impulse_magnitude`.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), n, unit, from B to A
        The opposite normal gives the same k.

    Returns
    -------
    (...), k, 1/kg
        It is 1/M_A + 1/M_B where the normal goes through both centres,
        r × n = 0, and it is 0 where both bodies are immovable.

    Notes
    -----
    A unit impulse n on A changes v_A by n/M_A and ω_A by I_A⁻¹(r_A × n). It
    therefore changes the velocity of A's point of contact by

        n/M_A + (I_A⁻¹(r_A × n)) × r_A

    On B the impulse is −n, and all these changes have a minus sign, which the
    difference ṗ_A − ṗ_B turns into a plus. Along the normal, with n·n = 1,
    the sum is

        k = 1/M_A + 1/M_B
            + n·((I_A⁻¹(r_A × n)) × r_A) + n·((I_B⁻¹(r_B × n)) × r_B)

    A body that can turn gives way more easily at its rim: the effective mass
    1/k is never more than the mass of either body.

    k equals n·K n with the matrix K = K_A + K_B of `point_inverse_mass`.
    Friction needs the whole matrix; this function keeps the terms in the order
    in which one derives them.
    """
    return _softness(body_a, normal) + _softness(body_b, normal)


def _softness(body: Body, normal: Array) -> Array:
    """One body's part of k: 1/M + n·((I⁻¹(r × n)) × r).

    A lever that is only rounding counts as none. Otherwise it would give a
    body on a pivot, 1/M = 0, a spin of any size.
    """
    r = body.arm
    dv, dw = velocity_changes(body, normal)
    lever = np.linalg.norm(np.cross(r, normal), axis=-1)
    has_lever = lever > NO_LEVER * np.linalg.norm(r, axis=-1)
    turning = np.where(has_lever, np.vecdot(normal, np.cross(dw, r)), 0.0)
    return np.vecdot(normal, dv) + turning  # n·(n/M) is 1/M


@domain
def collide(
    body_a: AnyBody,
    body_b: AnyBody,
    normal: Unit,
    restitution: Share,
    threshold: NotNegative = 0.0,
) -> Velocities:
    """Velocities of two bodies after an impact at a point (slides 11 and 21).

    The velocities change only if the bodies collide at this point.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), n, unit, from B to A
    restitution : (...), e, 0 to 1
    threshold : (...), m/s, not negative
        A pair that closes no faster than this is resting.

    Returns
    -------
    v_A, ω_A, v_B, ω_B : (..., 3) each, m/s and rad/s
        Unchanged for a pair that rests, grazes or separates, and for a pair
        that no impulse stops, such as two immovable bodies.

    Notes
    -----
    This is slide 21 with velocities: `apply_impulse_to_momenta` has its P and
    L. Compute the velocities of the two points and the velocity along the
    normal. If the points collide, apply the impulse j n to A and −j n to B. If
    they rest or move away, do nothing: these branches are empty here, as they
    are on the slide.
    """
    u_n = normal_velocity(body_a, body_b, normal)
    colliding = classify_contact(u_n, threshold) == COLLIDING
    j = impulse_magnitude(body_a, body_b, normal, restitution)
    j = np.where(colliding, j, 0.0)
    return apply_impulse(body_a, body_b, j[..., None] * normal)


@domain
def energy_lost(
    body_a: AnyBody, body_b: AnyBody, normal: Unit, restitution: Share
) -> Array:
    """Kinetic energy that an impact takes from two bodies.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
    normal : (..., 3), n, unit, from B to A
    restitution : (...), e, 0 to 1

    Returns
    -------
    (...), J
        0 for a pair that does not approach, and for two immovable bodies.

    Notes
    -----
    The closing motion has the energy of an effective mass 1/k that moves at
    u_n⁻, with the k of `inverse_effective_mass`: u_n⁻²/(2k). The parting
    motion has the velocity −e u_n⁻ and so the share e² of this energy. The
    impact takes the difference:

        E_lost = (1 − e²) u_n⁻²/(2k)

    An immovable body that moves does work besides. Beside such a body, E_lost
    is the loss as seen by an observer who moves along with its point of
    contact.
    """
    u_n = normal_velocity(body_a, body_b, normal)
    closing = np.minimum(u_n, 0.0)
    k = inverse_effective_mass(body_a, body_b, normal)
    return quotient((1 - restitution**2) * closing**2, np.maximum(2 * k, 0.0))
