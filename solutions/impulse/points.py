"""Velocities at the point of contact (slides 12, 14, 15, 19 and 21).

They say whether two bodies collide, and how they are to rebound.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import (
    finite,
    in_unit_interval,
    not_negative,
    unit,
    vector,
)
from solutions.impulse.body import AnyBody, checked

COLLIDING, RESTING, SEPARATING = -1, 0, 1
"""Results of `classify_contact`.

Each is the sign of the normal velocity where that is beyond the threshold, and
0 elsewhere.
"""


def point_velocity(
    velocity: ArrayLike,
    angular_velocity: ArrayLike,
    arm: ArrayLike,
) -> Array:
    """Velocity of a point that moves with a body (slide 14).

    Parameters
    ----------
    velocity : (..., 3), v of the centre of mass, m/s
    angular_velocity : (..., 3), ω in the world frame, rad/s
    arm : (..., 3), r, m
        From the centre of mass to the point, in the world frame.

    Returns
    -------
    (..., 3), m/s
        v itself for the centre of mass, and for a point on the axis through
        it.

    Raises
    ------
    ValueError
        If an argument does not have three components.

    Notes
    -----
    The point moves with the centre of mass, and it also turns about that
    centre:

        ṗ = v + ω × r

    The slide's p_A(t) = v_A(t) + ω_A(t) × r_A has lost its dot. The quantity
    is a velocity, not a position.
    """
    v, omega = (
        vector("velocity", velocity),
        vector("angular_velocity", angular_velocity),
    )
    return np.asarray(v + np.cross(omega, vector("arm", arm)))


def relative_velocity(
    point_velocity_a: ArrayLike,
    point_velocity_b: ArrayLike,
) -> Array:
    """Velocity of A's point of contact as seen from B's (slide 15).

    The velocity of B's point is subtracted from that of A's point.

    Parameters
    ----------
    point_velocity_a, point_velocity_b : (..., 3), ṗ_A and ṗ_B, m/s

    Returns
    -------
    (..., 3), u, m/s

    Raises
    ------
    ValueError
        If an argument does not have three components.

    Notes
    -----
        u = ṗ_A − ṗ_B

    The slide says "the difference" and not in which order to subtract. The
    order matters: with the normal from B to A, this order makes n·u negative
    when the points approach.
    """
    return np.asarray(
        vector("point_velocity_a", point_velocity_a)
        - vector("point_velocity_b", point_velocity_b)
    )


def normal_velocity(
    body_a: AnyBody, body_b: AnyBody, normal: ArrayLike
) -> Array:
    """Rate at which two bodies part at their contact (slides 15 and 19).

    Each body has a point there, which moves as the body flies and spins (slide
    14). The rate is taken along the normal.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
        Neither the masses nor the inertias make a difference.
    normal : (..., 3), unit, from B to A

    Returns
    -------
    (...), u_n, m/s, negative when approaching
        What the points do along the surface does not count.

    Raises
    ------
    ValueError
        If a normal does not have length 1, an inverse mass or the diagonal of
        an inverse inertia is negative, or something is not finite or does not
        fit.

    Notes
    -----
        u_n = n·u    u = ṗ_A − ṗ_B    ṗ = v + ω × r

    The velocities before the impact give u_n⁻. The velocities after the impact
    give u_n⁺ = n·(v_A⁺ + ω_A⁺ × r_A − v_B⁺ − ω_B⁺ × r_B).
    """
    v_a, w_a, r_a, *_ = checked(body_a)
    v_b, w_b, r_b, *_ = checked(body_b)
    u = relative_velocity(
        point_velocity(v_a, w_a, r_a), point_velocity(v_b, w_b, r_b)
    )
    return np.asarray(np.vecdot(u, unit("normal", vector("normal", normal))))


def rebound_velocity(
    normal_velocity: ArrayLike, restitution: ArrayLike
) -> Array:
    """Normal velocity that the user wants: u_n⁺ = −e u_n⁻ (slide 12).

    Parameters
    ----------
    normal_velocity : (...), u_n⁻, m/s, negative when approaching
    restitution : (...), e, 0 to 1

    Returns
    -------
    (...), u_n⁺, m/s
        For points that separate or graze, u_n⁻ ≥ 0, the velocity that they
        have.

    Raises
    ------
    ValueError
        If e is not from 0 to 1, or a velocity is not finite.

    Notes
    -----
    The slide's "fraction of the relative velocity the points will have" leaves
    out the minus sign. With e u_n⁻ the points would continue into the other
    body. The rule also holds for the normal component alone: without friction
    the user cannot choose the tangential one.
    """
    u_n, e = (
        finite("normal_velocity", normal_velocity),
        in_unit_interval("restitution", restitution),
    )
    return np.where(u_n < 0, -e * u_n, u_n)


def classify_contact(
    normal_velocity: ArrayLike,
    threshold: ArrayLike = 0.0,
) -> NDArray[np.int_]:
    """Whether two bodies collide, rest or separate (slide 21).

    Parameters
    ----------
    normal_velocity : (...), u_n, m/s, negative when approaching
    threshold : (...), m/s, not negative
        With 0 only u_n = 0 exactly, a grazing contact, is resting.

    Returns
    -------
    (...), COLLIDING −1, RESTING 0 or SEPARATING 1
        Colliding where u_n < −threshold, resting where |u_n| ≤ threshold, and
        separating where u_n > threshold.

    Raises
    ------
    ValueError
        If a velocity is not finite (a NaN would pass for resting), or a
        threshold is negative.

    Notes
    -----
    The slide tests V_rel > threshold for colliding, then V_rel < −threshold
    for resting. Its first test takes n from A to B. In its second test `<`
    should be `>`: as printed, it calls bodies that move away resting, and
    bodies that rest moving away.
    """
    u_n, threshold = (
        finite("normal_velocity", normal_velocity),
        not_negative("threshold", threshold),
    )
    return np.where(
        u_n < -threshold,
        COLLIDING,
        np.where(u_n > threshold, SEPARATING, RESTING),
    )
