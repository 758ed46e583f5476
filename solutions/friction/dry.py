"""Dry friction on a plane: what is held, what slides and where it stops (slide 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, vector


def holds(
    push: ArrayLike,
    normal_force: ArrayLike,
    static_friction: ArrayLike,
) -> NDArray[np.bool_]:
    """Whether static friction can hold a body at rest: ‖push‖ ≤ μ_s N (slide 24).

    Parameters
    ----------
    push : (..., 3), sum of the other forces along the surface, N
    normal_force : (...), N, not negative
    static_friction : (...), μ_s

    Returns
    -------
    (...), bool

    Raises
    ------
    ValueError
        If N or μ_s is negative, something is not finite, or push does not have three
        components.

    Notes
    -----
    The slide's F_s = μ_s F_N is only the largest value that static friction can take. A
    body at rest needs the friction −push, and it stays at rest while that is not above
    this value.
    """
    static = finite(
        "static_friction", not_negative("static_friction", static_friction)
    )
    limit = static * finite(
        "normal_force", not_negative("normal_force", normal_force)
    )
    size = np.linalg.norm(finite("push", vector("push", push)), axis=-1)
    return np.asarray(size <= limit)


def friction_force(
    push: ArrayLike,
    tangent_velocity: ArrayLike,
    normal_force: ArrayLike,
    static_friction: ArrayLike,
    kinetic_friction: ArrayLike,
) -> Array:
    """Friction on a body that slides, is held at rest, or starts to slide.

    Parameters
    ----------
    push : (..., 3), sum of the other forces along the surface, N
    tangent_velocity : (..., 3), along the surface and relative to it, m/s
    normal_force : (...), N, not negative
    static_friction, kinetic_friction : (...), μ_s and μ_k, μ_s ≥ μ_k

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
        If N or μ_k is negative, μ_s is less than μ_k, something is not finite,
        or a vector does not have three components.
    """
    held = holds(push, normal_force, static_friction)[..., None]
    push, velocity = (
        vector("push", push),
        finite(
            "tangent_velocity", vector("tangent_velocity", tangent_velocity)
        ),
    )
    mu = not_negative("kinetic_friction", kinetic_friction)
    not_negative(
        "static_friction less kinetic_friction",
        np.asarray(static_friction) - mu,
    )
    speed = np.linalg.norm(velocity, axis=-1)[..., None]
    size = np.linalg.norm(push, axis=-1)[..., None]
    along_velocity = velocity / np.where(speed > 0, speed, 1.0)
    along_push = push / np.where(size > 0, size, 1.0)
    kinetic = (mu * np.asarray(normal_force))[..., None]
    return np.where(
        speed > 0,
        -kinetic * along_velocity,
        np.where(held, -push, -kinetic * along_push),
    )


def sliding_motion(
    position: ArrayLike,
    tangent_velocity: ArrayLike,
    push: ArrayLike,
    normal_force: ArrayLike,
    static_friction: ArrayLike,
    kinetic_friction: ArrayLike,
    mass: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array, Array]:
    """Motion over dt of a body that slides in a straight line or rests.

    The result is exact even when the body stops within the step.

    Parameters
    ----------
    position, tangent_velocity, push : (..., 3), m, m/s, N
        The push acts along the velocity or against it, or there is no
        velocity.
    normal_force : (...), N, not negative
    static_friction, kinetic_friction : (...), μ_s ≥ μ_k
    mass : (...), kg
    dt : (...), s

    Returns
    -------
    position, tangent_velocity : (..., 3), m, m/s
    stopping_time : (...), s from now
        A stop exactly at dt counts. Infinity where the body does not stop
        within the step, and where it is at rest at the start, held or not.

    Raises
    ------
    ValueError
        As friction_force, or if a mass is not positive, or dt is negative or
        not finite.

    Notes
    -----
    While the body slides, its acceleration a is constant. Where a
    is opposed to the velocity v, the body stops at t = v/a, and friction does
    not turn it round. From there static friction holds the body, or it
    continues to slide along the push.
    """
    p, v, f = (
        vector("position", position),
        vector("tangent_velocity", tangent_velocity),
        vector("push", push),
    )
    m, dt = (
        positive("mass", mass)[..., None],
        finite("dt", not_negative("dt", dt)),
    )

    def acceleration(velocity: Array) -> Array:
        return np.asarray(
            (
                f
                + friction_force(
                    f,
                    velocity,
                    normal_force,
                    static_friction,
                    kinetic_friction,
                )
            )
            / m
        )

    a = acceleration(v)
    speed_squared, closing = np.vecdot(v, v), -np.vecdot(v, a)
    stops = (speed_squared > 0) & (speed_squared <= closing * dt)
    stopping_time = np.where(
        stops, speed_squared / np.where(stops, closing, 1.0), np.inf
    )
    first = np.minimum(stopping_time, dt)[..., None]
    p = p + v * first + a * first * first / 2
    v = np.where(stops[..., None], 0.0, v + a * first)
    rest = dt[..., None] - first
    after = np.where(stops[..., None], acceleration(v), 0.0)
    return p + after * rest * rest / 2, v + after * rest, stopping_time
