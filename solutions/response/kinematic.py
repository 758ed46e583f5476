"""Kinematic response: the collision gives the body a new velocity at once (slide 7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import in_unit_interval, unit, vector


def kinematic_response(
    velocity: ArrayLike,
    normal: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """Velocity after the collision, its normal component reversed and scaled (slide 7).

    Parameters
    ----------
    velocity : (..., 3), m/s, relative to the plane
    normal : (..., 3), unit, out of the plane
    restitution : (...), e, 0 to 1

    Returns
    -------
    (..., 3), m/s
        A body that moves away, moves along the plane or does not move keeps its
        velocity.

    Raises
    ------
    ValueError
        If a normal does not have length 1, e is not from 0 to 1, or a vector does not
        have three components.

    Notes
    -----
    The velocity is the sum of its component along the plane, v − (v·N) N, and its
    normal component (v·N) N. The collision leaves the first as it is and multiplies the
    second by −e. Added up again, this is

        v' = v − (1 + e) (v·N) N    if v·N < 0

    The slide's v − 2 (v·N) N is the case e = 1. The slide has no guard: its formula,
    applied to a body that already moves away, would throw the body back in.
    """
    v, n = vector("velocity", velocity), unit("normal", vector("normal", normal))
    approach = np.minimum(np.vecdot(v, n), 0.0)
    return np.asarray(v - ((1 + in_unit_interval("restitution", restitution)) * approach)[..., None] * n)


def moving_plane_response(
    velocity: ArrayLike,
    plane_velocity: ArrayLike,
    normal: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """Velocity after the collision with a moving plane that nothing can stop (slide 7).

    Parameters
    ----------
    velocity, plane_velocity : (..., 3), v and w, m/s
    normal : (..., 3), unit, out of the plane
    restitution : (...), e, 0 to 1

    Returns
    -------
    (..., 3), m/s
        A body that the plane does not gain on keeps its velocity.

    Raises
    ------
    ValueError
        As kinematic_response.

    Notes
    -----
    The slide's rule holds for the relative velocity u = v − w, where w is the velocity
    of the plane: u' = u − (1 + e) (u·N) N. The plane keeps its velocity, so that
    v' = u' + w:

        v' = v − (1 + e) (u·N) N    if u·N < 0

    A racket that comes to meet a ball at speed w sends it back with e v + (1 + e) w.
    The energy of the ball may grow, because the plane does work on it. There is no
    friction: a plane that slides within itself does not drag the body along.
    """
    v, w = vector("velocity", velocity), vector("plane_velocity", plane_velocity)
    n, e = unit("normal", vector("normal", normal)), in_unit_interval("restitution", restitution)
    approach = np.minimum(np.vecdot(v - w, n), 0.0)
    return np.asarray(v - ((1 + e) * approach)[..., None] * n)
