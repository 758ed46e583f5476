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
    """Friction on a body that slides, is held at rest, or starts to slide.

    Parameters
    ----------
    push : (..., 3), sum of the other forces along the surface, N
    tangent_velocity : (..., 3), along the surface and relative to it, m/s
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
    """
    rule = "static_friction must not be less than kinetic_friction"
    require(static_friction >= kinetic_friction, rule)
    slides = np.linalg.norm(tangent_velocity, axis=-1) > 0
    held = ~slides & holds(push, normal_force, static_friction)
    way = np.where(slides[..., None], tangent_velocity, push)
    kinetic = (kinetic_friction * normal_force)[..., None] * direction(way)
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
    stops = (speed_squared > 0) & (speed_squared <= braking * dt)
    braking = np.where(stops, braking, 0.0)
    stopping_time = quotient(speed_squared, braking, np.inf)
    sliding = np.minimum(stopping_time, dt)[..., None]
    p = position + v * sliding + a * sliding * sliding / 2
    v = np.where(stops[..., None], 0.0, v + a * sliding)
    remaining = dt[..., None] - sliding
    a = np.where(stops[..., None], acceleration(v), 0.0)
    p = p + a * remaining * remaining / 2
    return p, v + a * remaining, stopping_time
