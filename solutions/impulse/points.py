"""Velocities where two bodies touch (slides 12, 14, 15, 19 and 21)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import (
    Finite,
    NotNegative,
    Share,
    Triple,
    Unit,
    domain,
)
from solutions.impulse.body import AnyBody

COLLIDING, RESTING, SEPARATING = -1, 0, 1
"""Results of `classify_contact`.

Each is the sign of the normal velocity where that is beyond the threshold, and
0 elsewhere.
"""


@domain
def point_velocity(
    velocity: Triple, angular_velocity: Triple, arm: Triple
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

    Notes
    -----
    The point moves with the centre of mass, and it also turns about that
    centre:

        ṗ = v + ω × r

    The slide's p_A(t) = v_A(t) + ω_A(t) × r_A has lost its dot. The quantity
    is a velocity, not a position.
    """
    return velocity + np.cross(angular_velocity, arm)


@domain
def relative_velocity(
    point_velocity_a: Triple, point_velocity_b: Triple
) -> Array:
    """Velocity of A's point of contact as seen from B's (slide 15).

    The velocity of B's point is subtracted from that of A's point.

    Parameters
    ----------
    point_velocity_a, point_velocity_b : (..., 3), ṗ_A and ṗ_B, m/s

    Returns
    -------
    (..., 3), u, m/s

    Notes
    -----
        u = ṗ_A − ṗ_B

    The slide says "the difference" and not in which order to subtract. The
    order matters: with the normal from B to A, this order makes n·u negative
    when the points approach.
    """
    return point_velocity_a - point_velocity_b


@domain
def normal_velocity(body_a: AnyBody, body_b: AnyBody, normal: Unit) -> Array:
    """Rate at which two bodies part at their contact (slides 15 and 19).

    Each body has a point there, which moves as the body flies and spins (slide
    14). The rate is taken along the normal.

    Parameters
    ----------
    body_a, body_b : Body, or a tuple in its order
        Neither the masses nor the inertias make a difference.
    normal : (..., 3), n, unit, from B to A

    Returns
    -------
    (...), u_n, m/s, negative when approaching
        What the points do along the surface does not count.

    Notes
    -----
        ṗ = v + ω × r
        u = ṗ_A − ṗ_B
        u_n = n·u

    The velocities before the impact give u_n⁻, and those after it give u_n⁺.
    """
    v_a, w_a, r_a, *_ = body_a
    v_b, w_b, r_b, *_ = body_b
    point_a = point_velocity(v_a, w_a, r_a)
    point_b = point_velocity(v_b, w_b, r_b)
    return np.vecdot(relative_velocity(point_a, point_b), normal)


@domain
def rebound_velocity(normal_velocity: Finite, restitution: Share) -> Array:
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

    Notes
    -----
    The slide's "fraction of the relative velocity the points will have" leaves
    out the minus sign. With e u_n⁻ the points would continue into the other
    body. The rule also holds for the normal component alone: without friction
    the user cannot choose the tangential one.
    """
    rebound = -restitution * normal_velocity
    return np.where(normal_velocity < 0, rebound, normal_velocity)


@domain
def classify_contact(
    normal_velocity: Finite, threshold: NotNegative = 0.0
) -> Integers:
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

    Notes
    -----
    The slide tests V_rel > threshold for colliding, then V_rel < −threshold
    for resting. Its first test takes n from A to B. In its second test `<`
    should be `>`: as printed, it calls bodies that move away resting, and
    bodies that rest moving away.
    """
    approaching = normal_velocity < -threshold
    parting = normal_velocity > threshold
    not_colliding = np.where(parting, SEPARATING, RESTING)
    return np.where(approaching, COLLIDING, not_colliding)
