"""A ball that sweeps through a step, up to another body (slide 10)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.detection import signed_distance
from solutions.domain import (
    Finite,
    FiniteNotNegative,
    NotNegative,
    Vector,
    domain,
)
from solutions.sweeping.motion import relative_motion
from solutions.sweeping.rays import ray_sphere
from solutions.sweeping.rounds import free_time


@domain
def sweep_sphere_sphere(
    position_a: Vector,
    velocity_a: Vector,
    radius_a: FiniteNotNegative,
    position_b: Vector,
    velocity_b: Vector,
    radius_b: FiniteNotNegative,
    dt: NotNegative,
) -> Array:
    """Time at which two balls first touch within a step (slide 10).

    Their velocities are constant.

    Parameters
    ----------
    position_a, position_b : (..., 3), centres, m
    velocity_a, velocity_b : (..., 3), m/s
    radius_a, radius_b : (...), m; 0 for a point
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    (...), s from now, 0 to dt
        It is 0 if the balls overlap or touch now, even if they part. It is
        infinity where they do not touch.

    Notes
    -----
    Two balls touch when their centres are r_A + r_B apart. So A may be shrunk
    to a point if B is grown by A's radius. The grown ball is the Minkowski sum
    of the two. Seen from B, the point moves along a straight line, and the
    question becomes one for `ray_sphere`.
    """
    position, velocity = relative_motion(
        position_a, velocity_a, position_b, velocity_b
    )
    return within(ray_sphere(position, velocity, radius_a + radius_b), dt)


@domain
def sweep_sphere_plane(
    position: Vector,
    velocity: Vector,
    radius: FiniteNotNegative,
    normal: Vector,
    offset: Finite,
    dt: NotNegative,
) -> Array:
    """Time at which a ball touches the half-space behind a plane (slide 10).

    The plane is n·p + d = 0.

    Parameters
    ----------
    position : (..., 3), centre, m
    velocity : (..., 3), u, relative to the plane, m/s
    radius : (...), r, m; 0 for a point
    normal : (..., 3), n, any length but zero
    offset : (...), d, m when n has unit length
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    (...), s from now, 0 to dt
        It is 0 for a ball that touches the plane or is behind it already,
        whichever way the ball moves. It is infinity where the ball does not
        touch, which includes a ball that moves along the plane.

    Raises
    ------
    ValueError
        If a normal is zero.

    Notes
    -----
    Grown by the ball, the half-space ends r further out. The gap between the
    centre and this end is s − r, where s is the signed distance of the centre
    from the plane. The gap shrinks at the rate −u_n, where u_n is the velocity
    along n. It is used up after

        t = (s − r)/(−u_n)
    """
    gap = signed_distance(position, normal, offset) - radius
    # u_n = n·u/‖n‖ is the formula of a distance, without an offset.
    closing = -signed_distance(velocity, normal, 0.0)
    time = np.where(gap <= 0, 0.0, free_time(gap, closing))
    return within(time, dt)


def within(time: Array, dt: Array) -> Array:
    """Return the time, or infinity where it is later than dt, the step's end.

    The step may be infinitely long.
    """
    return np.where(time <= dt, time, np.inf)
