"""A ball that slides until it rolls (slide 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, vector
from solutions.friction.cone import clamp_to_circle

UP = np.array([0.0, 0.0, 1.0])


def roll_step(
    velocity: ArrayLike,
    spin: ArrayLike,
    radius: ArrayLike,
    friction: ArrayLike,
    gravity: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """Velocity and spin of a solid ball after a step on a level floor.

    Parameters
    ----------
    velocity : (..., 3), v of the centre, along the floor: v_z = 0, m/s
    spin : (..., 3), ω, rad/s
    radius : (...), m
    friction : (...), μ, static and kinetic
    gravity : (...), g, downwards, m/s²
    dt : (...), s

    Returns
    -------
    velocity, spin : (..., 3) each, m/s and rad/s
        Friction acts where the ball touches the floor, and opposes the slip
        there. A ball whose slip friction can stop within the step rolls at its
        end. Spin about the vertical stays as it is.

    Raises
    ------
    ValueError
        If a velocity is not along the floor, a radius is not positive, μ, g or
        dt is negative, something is not finite, or a vector does not have
        three components.

    Notes
    -----
    The ball touches the floor at the arm r = −R z from its centre,
    and slips there with

        u = v + ω × r

    An impulse J per mass, along the floor, changes v by J, and ω by
    (r × J)/(2/5 R²), because the inertia of a solid ball is 2/5 m R². So it changes
    the slip by

        J + (r × J) × r/(2/5 R²) = J + 5/2 J = 7/2 J

    The slip stops with J = −2/7 u. In a step friction gives at most μ N dt,
    which is μ g dt per mass, in any direction. Where that is less than 2/7 of
    the slip, J is shortened to it.

    A ball that starts without spin therefore rolls with 5/7 of its speed,
    whatever μ is: a smaller μ only takes longer.
    """
    v, omega = (
        finite("velocity", vector("velocity", velocity)),
        finite("spin", vector("spin", spin)),
    )
    if np.any(v[..., 2]):
        raise ValueError(
            "velocity must be along the floor: its z component must be 0"
        )
    size = finite("radius", positive("radius", radius))[..., None]
    most = finite("friction", not_negative("friction", friction)) * finite(
        "gravity", not_negative("gravity", gravity)
    )
    arm = -size * UP
    slip = v + np.cross(omega, arm)
    impulse = clamp_to_circle(
        -2 / 7 * slip, most * finite("dt", not_negative("dt", dt))
    )
    return np.asarray(v + impulse), np.asarray(
        omega + np.cross(arm, impulse) / (2 / 5 * size**2)
    )
