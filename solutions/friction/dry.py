"""Dry friction: what is held, what slides and where it stops (slide 24)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans
from solutions.domain import (
    FiniteNotNegative,
    Positive,
    Triple,
    Vector,
    domain,
    require,
)
from solutions.vectors import direction, quotient


@domain
def holds(
    push: Vector,
    normal_force: FiniteNotNegative,
    static_friction: FiniteNotNegative,
) -> Booleans:
    """Whether static friction can hold a body at rest (slide 24).

    Parameters
    ----------
    push : (..., 3), sum of the other forces along the surface, N
    normal_force : (...), N, in newtons, not negative
    static_friction : (...), μ_s, not negative

    Returns
    -------
    (...), bool

    Notes
    -----
    The slide's F_s = μ_s F_N is only the largest value that static friction
    can take. A body at rest needs the friction −push, and it stays at rest
    while

        ‖push‖ ≤ μ_s N
    """
    return np.linalg.norm(push, axis=-1) <= static_friction * normal_force


@domain
def friction_force(
    push: Vector,
    tangent_velocity: Vector,
    normal_force: FiniteNotNegative,
    static_friction: FiniteNotNegative,
    kinetic_friction: FiniteNotNegative,
) -> Array:
    """Friction on a body that slides, is held or starts to slide (slide 24).

    Parameters
    ----------
    push : (..., 3), sum of the other forces along the surface, N
    tangent_velocity : (..., 3), v_t, along the surface, m/s
        Relative to the surface.
    normal_force : (...), N, in newtons, not negative
    static_friction, kinetic_friction : (...), μ_s ≥ μ_k ≥ 0

    Returns
    -------
    (..., 3), N
        For a body that slides, however slowly, μ_k N against its velocity. For
        a body at rest whose push is at most μ_s N, −push. A body at rest whose
        push is above μ_s N starts to slide along the push, and friction
        opposes the push with μ_k N.

    Raises
    ------
    ValueError
        If μ_k is above μ_s.

    Notes
    -----
    The slide's F_k = μ_k F_N and F_s = μ_s F_N give no direction, and the
    second is only the maximum of static friction. A body that slides has

        F = −μ_k N v_t/‖v_t‖

    A body at rest is held while ‖push‖ ≤ μ_s N (see `holds`):

        F = −push

    Beyond that it starts to slide along the push:

        F = −μ_k N push/‖push‖
    """
    rule = "static_friction must not be less than kinetic_friction"
    require(static_friction >= kinetic_friction, rule)
    slides = np.linalg.norm(tangent_velocity, axis=-1) > 0
    held = ~slides & holds(push, normal_force, static_friction)
    motion_or_push = np.where(slides[..., None], tangent_velocity, push)
    kinetic_size = (kinetic_friction * normal_force)[..., None]
    kinetic = kinetic_size * direction(motion_or_push)
    return np.where(held[..., None], -push, -kinetic)


@domain
def sliding_motion(
    position: Triple,
    tangent_velocity: Vector,
    push: Vector,
    normal_force: FiniteNotNegative,
    static_friction: FiniteNotNegative,
    kinetic_friction: FiniteNotNegative,
    mass: Positive,
    dt: FiniteNotNegative,
) -> tuple[Array, Array, Array]:
    """Motion over dt of a body that slides in a straight line or rests.

    The result is exact even when the body stops within the step.

    Parameters
    ----------
    position, tangent_velocity, push : (..., 3), m, m/s, N
        The push acts along the velocity or against it, or there is no
        velocity.
    normal_force : (...), N, in newtons, not negative
    static_friction, kinetic_friction : (...), μ_s ≥ μ_k ≥ 0
    mass : (...), m, kg, positive
    dt : (...), Δt, s, not negative

    Returns
    -------
    position, tangent_velocity : (..., 3), m, m/s
    stopping_time : (...), s from now
        A stop exactly at dt counts. Infinity where the body does not stop
        within the step, and where it is at rest at the start, held or not.

    Raises
    ------
    ValueError
        If μ_k is above μ_s.

    Notes
    -----
    While the body slides, its acceleration a is constant. Where a is opposed
    to the velocity v, the body stops at

        t = ‖v‖/‖a‖ = v·v/(−v·a)

    and friction does not turn it round. From there static friction holds the
    body, or it continues to slide along the push.
    """

    def acceleration(velocity: Array) -> Array:
        force = push + friction_force(
            push, velocity, normal_force, static_friction, kinetic_friction
        )
        return force / mass[..., None]

    v = tangent_velocity
    a = acceleration(v)
    speed_squared = np.vecdot(v, v)
    braking = -np.vecdot(v, a)
    # t ≤ Δt, multiplied by −v·a
    stops = (speed_squared > 0) & (speed_squared <= braking * dt)
    # Where the body does not stop, a divisor of 0 makes the time infinite.
    divisor = np.where(stops, braking, 0.0)
    stopping_time = quotient(speed_squared, divisor, np.inf)
    sliding_time = np.minimum(stopping_time, dt)[..., None]
    p = position + v * sliding_time + a * sliding_time * sliding_time / 2
    v = np.where(stops[..., None], 0.0, v + a * sliding_time)
    # From here on v = 0, or nothing remains of the step.
    remaining = dt[..., None] - sliding_time
    a = np.where(stops[..., None], acceleration(v), 0.0)
    p = p + a * remaining * remaining / 2
    return p, v + a * remaining, stopping_time
