"""A step with one collision (slide 6).

A program can back up to the collision, or respond at the end of the step.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative
from solutions.detection import is_colliding, signed_distance
from solutions.forces import ballistic_motion
from solutions.response.kinematic import kinematic_response


def respond_at_impact(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: ArrayLike,
    normal: ArrayLike,
    restitution: ArrayLike,
    time_of_impact: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after a step with one collision, reached by backing up to it (slide 6).

    The body moves freely to T, responds there, and moves freely to the end of the step.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
        At the start of the step.
    normal : (..., 3), unit, out of the plane
    restitution : (...), e, 0 to 1
    time_of_impact : (...), T, s from the start of the step
        Exact or the slide's. A T later than dt means no collision.
    dt : (...), s, length of the step

    Returns
    -------
    position, velocity : (..., 3) each, at the end of the step
        A second collision in the same step is not seen here.

    Raises
    ------
    ValueError
        If T or dt is negative or not a number, or as kinematic_response.

    Notes
    -----
    The slide stops at the response. The rest of the step, Δt − T, must be integrated
    with the new velocity. If a program left it out, every bounce would lose half a step
    of time on average.
    """
    time, dt = not_negative("time_of_impact", time_of_impact), not_negative("dt", dt)
    struck, before = time <= dt, np.minimum(time, dt)
    position, velocity = ballistic_motion(position, velocity, acceleration, before)
    answered = kinematic_response(velocity, normal, restitution)
    velocity = np.where(struck[..., None], answered, velocity)
    return ballistic_motion(position, velocity, acceleration, dt - before)


def respond_at_step(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: ArrayLike,
    normal: ArrayLike,
    offset: ArrayLike,
    restitution: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after a step that looks for a collision only at its end (slide 6).

    This is the slide's response after the fact. A body that ends behind the plane
    n·p + d = 0 and still moves in gets its new velocity there.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
        At the start of the step.
    normal : (..., 3), unit, out of the plane
    offset : (...), d, m
    restitution : (...), e, 0 to 1
    dt : (...), s, length of the step

    Returns
    -------
    position, velocity : (..., 3) each, at the end of the step
        The body stays where the free motion over the whole step has taken it, up to v
        Δt too deep, and it responds with the speed that it has at that place.

    Raises
    ------
    ValueError
        If dt is negative, or as kinematic_response and signed_distance.
    """
    position, velocity = ballistic_motion(position, velocity, acceleration, not_negative("dt", dt))
    behind = is_colliding(signed_distance(position, normal, offset))
    answered = kinematic_response(velocity, normal, restitution)
    return position, np.where(behind[..., None], answered, velocity)
