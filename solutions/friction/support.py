"""Forces between a body and its support, and its break-away (slide 24)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    Triple,
    Unit,
    Vector,
    domain,
)
from solutions.friction.dry import holds
from solutions.vectors import part_across, quotient


@domain
def support_force(
    mass: FinitePositive,
    gravity: Triple,
    push: Triple,
    frame_acceleration: Triple,
    normal: Unit,
) -> tuple[Array, Array]:
    """The normal force on a body, and the force that friction has to hold.

    The body is seen from its support, which may accelerate: a lift, or a
    lorry.

    Parameters
    ----------
    mass : (...), m, kg, positive
    gravity, frame_acceleration : (..., 3), g and a of the support, m/s²
    push : (..., 3), F, any other force on the body, N
    normal : (..., 3), n, unit, out of the support

    Returns
    -------
    normal_force : (...), N, in newtons
        What the support pushes with. It cannot pull: a force that lifts the
        body off leaves 0.
    along : (..., 3), N
        The part along the surface of all forces except the support's, as the
        support sees them, whether or not the body is lifted off.

    Notes
    -----
    Seen from a support that accelerates with a, a body that moves with the
    support is at rest, and the inertial force −m a acts on it beside the
    weight m g and the push:

        F_all = m (g − a) + F

    A body that stays on its support does not accelerate along the normal, so
    that the support balances F_all·n. It can push but not pull:

        N = max(0, −F_all·n)

    The slide takes the weight for the normal force. On an incline N is
    m g cos θ; a push may lean on the body or lift it; and in a lift a counts
    against g. What remains of the force without its part along the normal is
    left to friction:

        F_t = F_all − (F_all·n) n
    """
    force = mass[..., None] * (gravity - frame_acceleration) + push
    normal_force = np.maximum(0.0, -np.vecdot(force, normal))
    return normal_force, part_across(force, normal)


@domain
def break_away_time(
    force: Vector,
    force_rate: Vector,
    normal: Unit,
    static_friction: FiniteNotNegative,
) -> Array:
    """First instant after which static friction no longer holds a body.

    The force on the body is F + F' t: it grows at a steady rate.

    Parameters
    ----------
    force, force_rate : (..., 3), F and F', N and N/s
        The sum of all forces except the support's, and the rate at which it
        grows.
    normal : (..., 3), n, unit, out of the support
    static_friction : (...), μ_s, not negative

    Returns
    -------
    (...), s
        0 where the body is not held even now: the push is above μ_s N, or the
        force pulls the body off. Infinity where it is held for ever. If N
        falls to zero before the push is above μ_s N, that instant.

    Notes
    -----
    Split the force into its part along the surface, F_t + F_t' t, and the
    normal force, N + N' t:

        N = −F·n
        N' = −F'·n
        F_t = F − (F·n) n
        F_t' = F' − (F'·n) n

    Static friction holds the body while

        ‖F_t + F_t' t‖ ≤ μ_s (N + N' t)

    In this range the force lies within a cone, and a straight line leaves a
    cone at most once. Squared, with μ for μ_s, the condition is

        a t² + 2 b t + c ≤ 0
        a = F_t'² − μ² N'²
        b = F_t·F_t' − μ² N N'
        c = F_t² − μ² N²

    The discriminant is written as

        b² − a c = μ² ‖N F_t' − N' F_t‖² − ‖F_t × F_t'‖²

    which loses no digits where N and F_t end almost together. The condition
    fails from the larger root on, which has two forms. Each is used where it
    subtracts no two nearly equal numbers:

        t = −c/(b + √(b² − a c))     where b > 0
        t = (√(b² − a c) − b)/a      where b ≤ 0 and a > 0

    Apart from this, the body lifts off where N + N' t = 0, at t = −N/N' if
    N' < 0.
    """
    mu = static_friction
    press = -np.vecdot(force, normal)
    press_rate = -np.vecdot(force_rate, normal)
    along = part_across(force, normal)
    along_rate = part_across(force_rate, normal)
    held = holds(along, np.maximum(0.0, press), mu) & (press >= 0)
    a = np.vecdot(along_rate, along_rate) - (mu * press_rate) ** 2
    b = np.vecdot(along, along_rate) - mu**2 * press * press_rate
    # At the limit of `holds`, rounding may make c positive.
    c = np.minimum(0.0, np.vecdot(along, along) - (mu * press) ** 2)
    # N F_t' − N' F_t and F_t × F_t'
    spread = press[..., None] * along_rate - press_rate[..., None] * along
    turn = np.cross(along, along_rate)
    discriminant = mu**2 * np.vecdot(spread, spread) - np.vecdot(turn, turn)
    root = np.sqrt(np.maximum(0.0, discriminant))
    slides = np.where(
        b > 0,
        quotient(-c, b + root),
        np.where(a > 0, quotient(root - b, a), np.inf),
    )
    lifts = np.where(press_rate < 0, quotient(-press, press_rate), np.inf)
    return np.where(held, np.minimum(slides, lifts), 0.0)
