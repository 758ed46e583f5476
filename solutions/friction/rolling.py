"""A ball that slides until it rolls (slide 24)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    Vector,
    domain,
    require,
)
from solutions.friction.cone import clamp_to_circle

UP = np.array([0.0, 0.0, 1.0])


@domain
def roll_step(
    velocity: Vector,
    spin: Vector,
    radius: FinitePositive,
    friction: FiniteNotNegative,
    gravity: FiniteNotNegative,
    dt: FiniteNotNegative,
) -> tuple[Array, Array]:
    """Velocity and spin of a solid ball after a step on a level floor.

    Parameters
    ----------
    velocity : (..., 3), v of the centre, along the floor: v_z = 0, m/s
    spin : (..., 3), ω, rad/s
    radius : (...), R, m, positive
    friction : (...), μ, static and kinetic, not negative
    gravity : (...), g, downwards, m/s², not negative
    dt : (...), Δt, s, not negative

    Returns
    -------
    velocity, spin : (..., 3) each, m/s and rad/s
        Friction acts where the ball touches the floor, and opposes the slip
        there. A ball whose slip friction can stop within the step rolls at its
        end. Spin about the vertical stays as it is.

    Raises
    ------
    ValueError
        If a velocity is not along the floor.

    Notes
    -----
    The ball touches the floor at the arm r = −R z from its centre, where z is
    the unit vector upwards, and slips there with

        u = v + ω × r

    An impulse J per mass, along the floor, changes v by J, and ω by
    (r × J)/(2/5 R²), because the inertia of a solid ball is 2/5 m R². So it
    changes the slip by

        J + (r × J) × r/(2/5 R²) = J + 5/2 J = 7/2 J

    The slip stops with

        J = −2/7 u

    In a step friction gives at most μ N Δt, which is μ g Δt per mass, in any
    direction. Where that is less than 2/7 of the slip, J is shortened to it.

    A ball that starts without spin therefore rolls with 5/7 of its speed,
    whatever μ is: a smaller μ only takes longer.
    """
    rule = "velocity must be along the floor: its z component must be 0"
    require(velocity[..., 2] == 0, rule)
    arm = -radius[..., None] * UP
    slip = velocity + np.cross(spin, arm)
    impulse = clamp_to_circle(-2 / 7 * slip, friction * gravity * dt)
    inertia = (2 / 5 * radius**2)[..., None]  # per mass
    return velocity + impulse, spin + np.cross(arm, impulse) / inertia
