"""Forces between a body and its support, and when the body breaks away (slide 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, unit, vector
from solutions.friction.dry import holds
from solutions.scaling import in_moderate_units


def support_force(
    mass: ArrayLike,
    gravity: ArrayLike,
    push: ArrayLike,
    frame_acceleration: ArrayLike,
    normal: ArrayLike,
) -> tuple[Array, Array]:
    """The normal force on a body, and the force that friction has to hold.

    The body is seen from its support, which may accelerate: a lift, or a
    lorry.

    Parameters
    ----------
    mass : (...), kg
    gravity, frame_acceleration : (..., 3), g and a of the support, m/s²
    push : (..., 3), F, any other force on the body, N
    normal : (..., 3), unit, out of the support

    Returns
    -------
    normal_force : (...), N
        What the support pushes with. It cannot pull: a force that lifts the
        body off leaves 0.
    along : (..., 3), N
        The part along the surface of all forces except the support's, as the
        support sees them, whether or not the body is lifted off.

    Raises
    ------
    ValueError
        If a mass is not positive and finite, a normal does not have length 1,
        or a vector does not have three components.

    Notes
    -----
    Seen from a support that accelerates with a, a body that moves
    with the support is at rest, and the inertial force −m a acts on it beside
    the weight m g and the push:

        F_all = m (g − a) + F

    A body that stays on its support does not accelerate along the normal, so
    that the support balances F_all·n. It can push but not pull:

        N = max(0, −F_all·n)

    The slide takes the weight for the normal force. On an incline N is m g cos
    θ; a push may lean on the body or lift it; and in a lift a counts against
    g. What remains of the force without its part along the normal is left to
    friction:

        F_t = F_all − (F_all·n) n
    """
    fall = vector("gravity", gravity) - vector(
        "frame_acceleration", frame_acceleration
    )
    force = finite("mass", positive("mass", mass))[..., None] * fall + vector(
        "push", push
    )
    n = unit("normal", vector("normal", normal))
    return np.asarray(np.maximum(0.0, -np.vecdot(force, n))), less_normal_part(
        force, n
    )


def less_normal_part(vectors: Array, normal: Array) -> Array:
    """The part of vectors along a surface with a unit normal: F − (F·n) n."""
    return np.asarray(vectors - np.vecdot(vectors, normal)[..., None] * normal)


def friction_angle(static_friction: ArrayLike) -> Array:
    """The steepest slope on which a body stays at rest: θ = arctan μ_s.

    Parameters
    ----------
    static_friction : (...), μ_s, finite

    Returns
    -------
    (...), rad
        On a slope of exactly this angle, `holds` says what rounding leaves of the
        equality.

    Raises
    ------
    ValueError
        If μ_s is negative or not finite.

    Notes
    -----
    On a slope the weight pushes the body with m g sin θ along the surface, and the
    normal force is m g cos θ. The steepest slope is the one on which the push equals
    μ_s times the normal force:

        μ_s = m g sin θ/(m g cos θ) = tan θ

    No finite μ_s holds a body on a wall, θ = π/2, because nothing presses it on. An
    infinite one would have to hold it with ∞·0 N. That has no value, so this function
    refuses infinity, as `holds`, `friction_force` and `sphere_grips` do.
    """
    return np.asarray(
        np.arctan(
            finite(
                "static_friction",
                not_negative("static_friction", static_friction),
            )
        )
    )


def break_away_time(
    force: ArrayLike,
    force_rate: ArrayLike,
    normal: ArrayLike,
    static_friction: ArrayLike,
) -> Array:
    """First instant after which static friction no longer holds a body.

    The force on the body is F + F' t: it grows at a steady rate.

    Parameters
    ----------
    force, force_rate : (..., 3), F and F', N and N/s
        The sum of all forces except the support's, and the rate at which it
        grows.
    normal : (..., 3), unit, out of the support
    static_friction : (...), μ_s

    Returns
    -------
    (...), s
        0 where the body is not held even now: the push is above μ_s N, or the
        force pulls the body off. Infinity where it is held for ever. If N
        falls to zero before the push is above μ_s N, that instant.

    Raises
    ------
    ValueError
        If μ_s is negative, a normal does not have length 1, something is not
        finite, or a vector does not have three components.

    Notes
    -----
    Split the force into its part along the surface, F_t + F_t' t,
    and the normal force, N + N' t. Static friction holds the body while

        ‖F_t + F_t' t‖ ≤ μ_s (N + N' t)

    In this range the force lies within a cone, and a straight line leaves a
    cone at most once. Squared, with μ for μ_s, the condition is

        a t² + 2 b t + c ≤ 0
        a = F_t'² − μ²N'²,  b = F_t·F_t' − μ²N N',  c = F_t² − μ²N²

    The condition fails from t = (√(b² − a c) − b)/a on. The code writes the
    discriminant as

        b² − a c = μ²‖N F_t' − N' F_t‖² − ‖F_t × F_t'‖²

    which loses no digits where N and F_t end almost together.
    """
    n, mu = (
        unit("normal", vector("normal", normal)),
        not_negative("static_friction", static_friction),
    )
    force, rate = (
        finite("force", vector("force", force)),
        finite("force_rate", vector("force_rate", force_rate)),
    )
    (force, _, newton), (rate, _, newton_a_second) = (
        in_moderate_units(force),
        in_moderate_units(rate),
    )
    press, press_rate = -np.vecdot(force, n), -np.vecdot(rate, n)
    f, rate = less_normal_part(force, n), less_normal_part(rate, n)
    held = holds(f, np.maximum(0.0, press), mu) & (press >= 0)
    a = np.vecdot(rate, rate) - (mu * press_rate) ** 2
    b = np.vecdot(f, rate) - mu**2 * press * press_rate
    # At the limit of `holds`, rounding may make c positive.
    c = np.minimum(0.0, np.vecdot(f, f) - (mu * press) ** 2)
    spread, across = (
        press[..., None] * rate - press_rate[..., None] * f,
        np.cross(f, rate),
    )
    root = np.sqrt(
        np.maximum(
            0.0, mu**2 * np.vecdot(spread, spread) - np.vecdot(across, across)
        )
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        leaves = np.where(
            b > 0, -c / (b + root), np.where(a > 0, (root - b) / a, np.inf)
        )
        lifts = np.where(press_rate < 0, -press / press_rate, np.inf)
        return np.where(
            held, np.minimum(leaves, lifts) * newton / newton_a_second, 0.0
        )


def stick_slip_times(
    mass: ArrayLike,
    stiffness: ArrayLike,
    drive_speed: ArrayLike,
    normal_force: ArrayLike,
    static_friction: ArrayLike,
    kinetic_friction: ArrayLike,
) -> tuple[Array, Array]:
    """How long a block drawn by a spring sticks, and how long it slips, in each cycle.

    The free end of the spring moves at the constant speed V.

    Parameters
    ----------
    mass : (...), kg, finite
    stiffness : (...), k, N/m
    drive_speed : (...), V, m/s, positive
    normal_force : (...), N
    static_friction, kinetic_friction : (...), μ_s ≥ μ_k

    Returns
    -------
    stick, slip : (...), s each
        With μ_s = μ_k the block does not stick at all, though it stops for an instant
        once in 2π/ω.

    Raises
    ------
    ValueError
        If mass, stiffness or speed is not positive and finite, N or μ_k is negative, or
        μ_s is less than μ_k or not finite.

    Notes
    -----
    The block sticks until the spring pulls with μ_s N. Then it slips. Seen from the
    free end of the spring, it oscillates with ω = √(k/m) about the place where the
    spring pulls with μ_k N, and it starts at the distance a = (μ_s − μ_k) N/k from
    there. Its speed is

        V + a ω sin ωt − V cos ωt

    The block sticks again when this is zero. With 1 − cos ωt = 2 sin²(ωt/2) and sin
    ωt = 2 sin(ωt/2) cos(ωt/2), the condition is tan(ωt/2) = −a ω/V, and so

        t_slip = (2/ω) (π − arctan(a ω/V))

    By the symmetry of the oscillation the spring then pulls with (2 μ_k − μ_s) N. It
    must be stretched by 2 a at the speed V before the block slips again:

        t_stick = 2 a/V

    In a cycle the block travels V (t_slip + t_stick).
    """
    k, m = (
        finite("stiffness", positive("stiffness", stiffness)),
        finite("mass", positive("mass", mass)),
    )
    speed, frequency = (
        finite("drive_speed", positive("drive_speed", drive_speed)),
        np.sqrt(k / m),
    )
    excess = finite("static_friction", static_friction) - not_negative(
        "kinetic_friction", kinetic_friction
    )
    a = (
        not_negative("static_friction less kinetic_friction", excess)
        * not_negative("normal_force", normal_force)
        / k
    )
    return 2 * a / speed, 2 / frequency * (
        np.pi - np.arctan2(a * frequency, speed)
    )
