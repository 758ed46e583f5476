"""Forces between a body and its support, and when the body breaks away (slide 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, unit, vector
from solutions.friction.dry import holds


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
        return np.where(held, np.minimum(leaves, lifts), 0.0)
