"""What presses a body on its support and what pushes it along, and when it breaks away (slide 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, unit, vector
from solutions.friction.dry import holds

Array = NDArray[np.float64]


def apparent_force(mass: ArrayLike, gravity: ArrayLike, push: ArrayLike, frame_acceleration: ArrayLike) -> Array:
    """All that acts on a body but its support, seen from the support: m (g − a) + F, (..., 3), N.

    The slide's normal force is the weight. It is not: a push may lean on the body or lift it, and in a lift or on a
    braking lorry the support's own acceleration a counts against g.

    Parameters
    ----------
    mass : (...), kg
    gravity, frame_acceleration : (..., 3), g and a of the support, m/s²
    push : (..., 3), F, N

    Raises
    ------
    ValueError
        If a mass is not positive and finite or a vector has not three components.
    """
    fall = vector("gravity", gravity) - vector("frame_acceleration", frame_acceleration)
    return np.asarray(finite("mass", positive("mass", mass))[..., None] * fall + vector("push", push))


def normal_force(force: ArrayLike, normal: ArrayLike) -> Array:
    """The support's push on the body: N = max(0, −F·n), (...), N.

    On an incline that is m g cos θ, not m g. A force that lifts the body off leaves no normal force: N = 0, and no
    friction.

    Parameters
    ----------
    force : (..., 3), sum of all other forces, N, as from apparent_force
    normal : (..., 3), unit, out of the support

    Raises
    ------
    ValueError
        If a normal has not length 1 or a vector has not three components.
    """
    n = unit("normal", vector("normal", normal))
    return np.asarray(np.maximum(0.0, -np.vecdot(vector("force", force), n)))


def along_surface(force: ArrayLike, normal: ArrayLike) -> Array:
    """The part of a vector along the surface: F_t = F − (F·n) n, (..., 3); what friction has to hold.

    Parameters
    ----------
    force : (..., 3)
    normal : (..., 3), unit

    Raises
    ------
    ValueError
        If a normal has not length 1 or a vector has not three components.
    """
    f, n = vector("force", force), unit("normal", vector("normal", normal))
    return np.asarray(f - np.vecdot(f, n)[..., None] * n)


def friction_angle(static_friction: ArrayLike) -> Array:
    """The steepest slope on which a body stays at rest: θ = arctan μ_s, (...), rad. From tan θ = m g sin θ/(m g cos θ).

    On that slope itself `holds` says what rounding leaves of the equality.

    Parameters
    ----------
    static_friction : (...), μ_s; infinity for a wall, π/2

    Raises
    ------
    ValueError
        If μ_s is negative or NaN.
    """
    return np.asarray(np.arctan(not_negative("static_friction", static_friction)))


def break_away_time(force: ArrayLike, force_rate: ArrayLike, normal: ArrayLike, static_friction: ArrayLike) -> Array:
    """First instant after which static friction no longer holds a body under the force F + F' t, (...), s.

    It holds while ‖F_t + F_t' t‖ ≤ μ_s (N + N' t): the force stays within a cone, and a straight line leaves a cone
    once at most. Squared, a t² + 2 b t + c ≤ 0 with a = F_t'² − μ²N'², b = F_t·F_t' − μ²N N', c = F_t² − μ²N², and
    b² − a c = μ²‖N F_t' − N' F_t‖² − ‖F_t × F_t'‖², which loses no digits where N and F_t end almost together.

    Parameters
    ----------
    force, force_rate : (..., 3), sum of all but the support's force, N, and its growth, N/s
    normal : (..., 3), unit, out of the support
    static_friction : (...), μ_s

    Returns
    -------
    (...), s; 0 where it is not held even now, infinity where it always is, the instant of lifting off where the force
    along the normal ends before friction does

    Raises
    ------
    ValueError
        If μ_s is negative, a normal has not length 1, something is not finite, or a vector has not three components.
    """
    n, mu = unit("normal", vector("normal", normal)), not_negative("static_friction", static_friction)
    force, rate = finite("force", vector("force", force)), finite("force_rate", vector("force_rate", force_rate))
    press, press_rate = -np.vecdot(force, n), -np.vecdot(rate, n)
    f, rate = along_surface(force, n), along_surface(rate, n)
    held = holds(f, np.maximum(0.0, press), mu) & (press >= 0)
    a = np.vecdot(rate, rate) - (mu * press_rate) ** 2
    b = np.vecdot(f, rate) - mu**2 * press * press_rate
    c = np.minimum(0.0, np.vecdot(f, f) - (mu * press) ** 2)  # at the limit rounding may say otherwise than holds
    spread, across = press[..., None] * rate - press_rate[..., None] * f, np.cross(f, rate)
    root = np.sqrt(np.maximum(0.0, mu**2 * np.vecdot(spread, spread) - np.vecdot(across, across)))
    with np.errstate(divide="ignore", invalid="ignore"):
        leaves = np.where(b > 0, -c / (b + root), np.where(a > 0, (root - b) / a, np.inf))
        lifts = np.where(press_rate < 0, -press / press_rate, np.inf)
    return np.where(held, np.minimum(leaves, lifts), 0.0)


def stick_slip_times(
    mass: ArrayLike,
    stiffness: ArrayLike,
    drive_speed: ArrayLike,
    normal_force: ArrayLike,
    static_friction: ArrayLike,
    kinetic_friction: ArrayLike,
) -> tuple[Array, Array]:
    """How long a block drawn by a spring sticks and how long it slips, again and again, (...), s.

    The spring's free end moves at V. The block sticks until the spring pulls with μ_s N, and slips as an oscillator
    about μ_k N, by a = (μ_s − μ_k) N/k, until its speed V + aω sin ωt − V cos ωt is zero again:

        t_slip = (2/ω) (π − arctan(a ω/V)),    t_stick = 2 a/V

    Then the spring pulls with (2 μ_k − μ_s) N. In a cycle the block goes V (t_slip + t_stick). With μ_s = μ_k it does
    not stick at all, though it stops for an instant once in 2π/ω.

    Parameters
    ----------
    mass : (...), kg, finite
    stiffness : (...), k, N/m
    drive_speed : (...), V, m/s, positive
    normal_force : (...), N
    static_friction, kinetic_friction : (...), μ_s ≥ μ_k

    Raises
    ------
    ValueError
        If mass, stiffness or speed is not positive and finite, N or μ_k negative, or μ_s less than μ_k.
    """
    k, m = finite("stiffness", positive("stiffness", stiffness)), finite("mass", positive("mass", mass))
    speed, frequency = finite("drive_speed", positive("drive_speed", drive_speed)), np.sqrt(k / m)
    excess = np.asarray(static_friction, dtype=float) - not_negative("kinetic_friction", kinetic_friction)
    a = not_negative("static_friction less kinetic_friction", excess) * not_negative("normal_force", normal_force) / k
    return 2 * a / speed, 2 / frequency * (np.pi - np.arctan2(a * frequency, speed))
