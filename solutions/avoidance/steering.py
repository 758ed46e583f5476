"""Steering to or from a target, after Reynolds (slide 1: "as in flocking")."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.avoidance.directions import limited, unit_or_zero
from solutions.checks import not_negative, positive


def seek(
    position: ArrayLike, target: ArrayLike, max_speed: ArrayLike
) -> Array:
    """Velocity wanted by a body that seeks a target (slide 1).

    It wants to move straight towards the target, at full speed.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), v_max, m/s, not negative

    Returns
    -------
    (..., d), m/s
        Zero at the target.

    Raises
    ------
    ValueError
        If a speed is negative.

    Notes
    -----
    The vector target − position points from the body to the target. Divided by
    its length, it is the direction, so

        v_wanted = v_max (target − position)/‖target − position‖

    A widely copied text has position − target. With this sign the body flees.
    """
    speed = not_negative("max_speed", max_speed)
    return np.asarray(
        speed[..., None] * unit_or_zero(np.subtract(target, position))
    )


def flee(
    position: ArrayLike, target: ArrayLike, max_speed: ArrayLike
) -> Array:
    """Velocity wanted by a body that flees from a target (slide 1).

    It wants to move straight away from the target, at full speed.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), m/s, not negative

    Returns
    -------
    (..., d), m/s
        Zero at the target, from which no direction leads away.

    Raises
    ------
    ValueError
        If a speed is negative.
    """
    return -seek(position, target, max_speed)


def arrive(
    position: ArrayLike,
    target: ArrayLike,
    max_speed: ArrayLike,
    slowing_radius: ArrayLike,
) -> Array:
    """Velocity wanted by a body that is to stop at a target.

    Outside the slowing radius the body moves towards the target at full speed.
    Inside, its speed is proportional to the distance that is left.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), v_max, m/s, not negative
    slowing_radius : (...), R, m, positive

    Returns
    -------
    (..., d), m/s
        Zero at the target.

    Raises
    ------
    ValueError
        If a speed is negative or a slowing radius is not positive.

    Notes
    -----
    The formula is

        v_wanted = v_max min(1, distance/R) towards the target

    Suppose that the body is steered with the response time τ, as in
    `steering_force`. At the distance x, inside the slowing radius, its
    acceleration is (v_wanted − v)/τ with v_wanted = −v_max x/R. The body is
    then an oscillator:

        x″ = −(x′ + v_max x/R)/τ

    It stops without overshoot if its damping is at least critical. The
    characteristic equation τ λ² + λ + v_max/R = 0 has real solutions if R ≥ 4
    v_max τ. The force must also be large enough to brake. A body that follows
    v_wanted loses speed at the rate v_max² x/R², which is largest at x = R, so
    the condition is F_max ≥ m v_max²/R.
    """
    rate = not_negative("max_speed", max_speed) / positive(
        "slowing_radius", slowing_radius
    )
    return limited(rate[..., None] * np.subtract(target, position), max_speed)


def steering_force(
    velocity: ArrayLike,
    wanted: ArrayLike,
    mass: ArrayLike,
    response_time: ArrayLike,
    max_force: ArrayLike,
) -> Array:
    """Force that changes a velocity into the wanted one (slide 1).

    The force would complete the change within the response time. It is
    shortened to the largest force that the body is able to exert.

    Parameters
    ----------
    velocity, wanted : (..., d), m/s
    mass : (...), m, kg, positive
    response_time : (...), τ, s, positive
    max_force : (...), F_max, N, not negative

    Returns
    -------
    (..., d), N
        Zero where the velocity is the wanted one.

    Raises
    ------
    ValueError
        If a mass or a response time is not positive or a force is negative.

    Notes
    -----
    To change v into v_wanted within the time τ takes the acceleration
    (v_wanted − v)/τ. Newton's law gives the force:

        F = m (v_wanted − v)/τ, shortened to F_max

    Reynolds writes steering = desired − velocity. That is a difference of
    velocities, although he calls it a force. Only the division by a response
    time τ makes it one. In his text that time is one frame.
    """
    gain = positive("mass", mass) / positive("response_time", response_time)
    change = np.asarray(np.subtract(wanted, velocity), dtype=float)
    return limited(
        gain[..., None] * change, not_negative("max_force", max_force)
    )
