"""Steering of one body to or from a target, after Reynolds (slide 1: "as in flocking")."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.avoidance.directions import limited, unit_or_zero
from solutions.checks import not_negative, positive

Array = NDArray[np.float64]


def seek(position: ArrayLike, target: ArrayLike, max_speed: ArrayLike) -> Array:
    """Velocity wanted by a body that seeks a target: full speed towards it (slide 1).

        v_wanted = v_max (target − position)/‖target − position‖

    A widely copied text has position − target: the wrong sign, it flees.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), v_max, m/s, not negative

    Returns
    -------
    (..., d), m/s; zero at the target

    Raises
    ------
    ValueError
        If a speed is negative.
    """
    speed = not_negative("max_speed", max_speed)
    return np.asarray(speed[..., None] * unit_or_zero(np.subtract(target, position)))


def flee(position: ArrayLike, target: ArrayLike, max_speed: ArrayLike) -> Array:
    """Velocity wanted by a body that flees from a target: full speed away from it (slide 1).

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), m/s, not negative

    Returns
    -------
    (..., d), m/s; zero at the target, from which no direction leads away

    Raises
    ------
    ValueError
        If a speed is negative.
    """
    return -seek(position, target, max_speed)


def arrive(position: ArrayLike, target: ArrayLike, max_speed: ArrayLike, slowing_radius: ArrayLike) -> Array:
    """Velocity wanted by a body that is to stop at a target: from the slowing radius on in step with the distance.

        v_wanted = v_max min(1, distance/R) towards the target

    Steered with the response time τ, the body is near the target an oscillator, x″ = −(x′ + v_max x/R)/τ. It stops
    without overshoot if R ≥ 4 v_max τ (critical damping) and if the force is large enough to brake: F_max ≥ m v_max²/R.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), v_max, m/s, not negative
    slowing_radius : (...), R, m, positive

    Returns
    -------
    (..., d), m/s

    Raises
    ------
    ValueError
        If a speed is negative or a slowing radius is not positive.
    """
    rate = not_negative("max_speed", max_speed) / positive("slowing_radius", slowing_radius)
    return limited(rate[..., None] * np.subtract(target, position), max_speed)


def steering_force(
    velocity: ArrayLike, wanted: ArrayLike, mass: ArrayLike, response_time: ArrayLike, max_force: ArrayLike
) -> Array:
    """Force that brings a velocity to the wanted one within the response time, as far as the body is able to (slide 1).

        F = m (v_wanted − v)/τ, shortened to F_max

    Reynolds writes steering = desired − velocity: a difference of velocities, called a force. The response time τ is
    what makes it one; his is one frame.

    Parameters
    ----------
    velocity, wanted : (..., d), m/s
    mass : (...), m, kg, positive
    response_time : (...), τ, s, positive
    max_force : (...), F_max, N, not negative

    Returns
    -------
    (..., d), N

    Raises
    ------
    ValueError
        If a mass or a response time is not positive or a force is negative.
    """
    gain = positive("mass", mass) / positive("response_time", response_time)
    change = np.asarray(np.subtract(wanted, velocity), dtype=float)
    return limited(gain[..., None] * change, not_negative("max_force", max_force))
