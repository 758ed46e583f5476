"""Velocities at the point of contact, and what they say of it (slides 12, 14, 15, 19, 21)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, in_unit_interval, not_negative, unit, vector

Array = NDArray[np.float64]
COLLIDING, RESTING, SEPARATING = -1, 0, 1
"""What `classify_contact` answers: the sign of the normal velocity, where it is more than the threshold."""


def point_velocity(velocity: ArrayLike, angular_velocity: ArrayLike, arm: ArrayLike) -> Array:
    """Velocity of a point that moves with a body: ṗ = v + ω × r (slide 14).

    The slide's p_A(t) = v_A(t) + ω_A(t) × r_A has lost its dot: it is a velocity, not a place.

    Parameters
    ----------
    velocity : (..., 3), v of the centre of mass, m/s
    angular_velocity : (..., 3), ω in the world frame, rad/s
    arm : (..., 3), r from the centre of mass to the point, in the world frame, m

    Returns
    -------
    (..., 3), m/s; v itself for the centre of mass, and for a point on the axis through it

    Raises
    ------
    ValueError
        If an argument has not three components.
    """
    v, omega = vector("velocity", velocity), vector("angular_velocity", angular_velocity)
    return np.asarray(v + np.cross(omega, vector("arm", arm)))


def relative_velocity(point_velocity_a: ArrayLike, point_velocity_b: ArrayLike) -> Array:
    """Velocity of A's point of contact as seen from B's: u = ṗ_A − ṗ_B (slide 15).

    The slide says "the difference" and not which way. The order matters: with the normal from B to A, this one makes
    n·u negative when they approach.

    Parameters
    ----------
    point_velocity_a, point_velocity_b : (..., 3), ṗ_A and ṗ_B, m/s

    Returns
    -------
    (..., 3), m/s

    Raises
    ------
    ValueError
        If an argument has not three components.
    """
    return np.asarray(vector("point_velocity_a", point_velocity_a) - vector("point_velocity_b", point_velocity_b))


def normal_velocity(point_velocity_a: ArrayLike, point_velocity_b: ArrayLike, normal: ArrayLike) -> Array:
    """Rate at which two points of contact part: u_n = n·(ṗ_A − ṗ_B) (slides 15 and 19).

    Before the impact it is u_n⁻; of the velocities after it, n·(v_A⁺ + ω_A⁺ × r_A − v_B⁺ − ω_B⁺ × r_B), it is u_n⁺.

    Parameters
    ----------
    point_velocity_a, point_velocity_b : (..., 3), ṗ_A and ṗ_B, m/s
    normal : (..., 3), unit, from B to A

    Returns
    -------
    (...), m/s, negative when approaching

    Raises
    ------
    ValueError
        If a normal has not length 1, or an argument has not three components.
    """
    n = unit("normal", vector("normal", normal))
    return np.asarray(np.vecdot(relative_velocity(point_velocity_a, point_velocity_b), n))


def rebound_velocity(normal_velocity: ArrayLike, restitution: ArrayLike) -> Array:
    """Normal velocity that the user asks for after the impact: u_n⁺ = −e u_n⁻ (slide 12).

    "The fraction of the relative velocity the points will have" leaves out the minus: e u_n⁻ goes on into the other
    body. And it is the normal component alone: without friction the tangential one is not the user's to choose.

    Parameters
    ----------
    normal_velocity : (...), u_n⁻, m/s, negative when approaching
    restitution : (...), e, 0 to 1

    Returns
    -------
    (...), u_n⁺, m/s; of points that separate or graze, u_n⁻ ≥ 0, the velocity they have

    Raises
    ------
    ValueError
        If e is not from 0 to 1, or a velocity is not finite.
    """
    u_n, e = finite("normal_velocity", normal_velocity), in_unit_interval("restitution", restitution)
    return np.where(u_n < 0, -e * u_n, u_n)


def classify_contact(normal_velocity: ArrayLike, threshold: ArrayLike = 0.0) -> NDArray[np.int_]:
    """Whether two bodies that touch are colliding, resting or separating (slide 21).

        u_n < −threshold    colliding       |u_n| ≤ threshold    resting       u_n > threshold    separating

    The slide tests V_rel > threshold, then V_rel < −threshold for resting. Its first test takes n from A to B; its
    second `<` should be `>`, or what moves away is called resting and what rests is called moving away.

    Parameters
    ----------
    normal_velocity : (...), u_n, m/s, negative when approaching
    threshold : (...), m/s, not negative; with 0 only u_n = 0 exactly, a grazing contact, is resting

    Returns
    -------
    (...), COLLIDING −1, RESTING 0 or SEPARATING 1

    Raises
    ------
    ValueError
        If a velocity is not finite (a NaN would pass for resting), or a threshold is negative.
    """
    u_n, threshold = finite("normal_velocity", normal_velocity), not_negative("threshold", threshold)
    return np.where(u_n < -threshold, COLLIDING, np.where(u_n > threshold, SEPARATING, RESTING))
