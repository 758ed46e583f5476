"""Kinematic response: the collision gives the body a new velocity at once (slide 7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import in_unit_interval, unit, vector

Array = NDArray[np.float64]


def kinematic_response(velocity: ArrayLike, normal: ArrayLike, restitution: ArrayLike) -> Array:
    """Velocity after the collision: the normal component is reversed and scaled by e (slide 7).

        v' = v − (1 + e) (v·N) N    if v·N < 0

    The slide's v − 2 (v·N) N is the case e = 1 and has no guard: applied to a body that already moves away, it
    would throw it back in.

    Parameters
    ----------
    velocity : (..., 3), m/s, relative to the plane
    normal : (..., 3), unit, out of the plane
    restitution : (...), e, 0 to 1

    Returns
    -------
    (..., 3), m/s; a body that moves away, along the plane or not at all keeps its velocity

    Raises
    ------
    ValueError
        If a normal has not length 1, e is not from 0 to 1, or a vector has not three components.
    """
    v, n = vector("velocity", velocity), unit("normal", vector("normal", normal))
    approach = np.minimum(np.vecdot(v, n), 0.0)
    return np.asarray(v - ((1 + in_unit_interval("restitution", restitution)) * approach)[..., None] * n)


def moving_plane_response(
    velocity: ArrayLike, plane_velocity: ArrayLike, normal: ArrayLike, restitution: ArrayLike
) -> Array:
    """Velocity after the collision with a plane that moves and that nothing can stop (slide 7).

    The slide's rule holds for the relative velocity u = v − w, with w the plane's:

        v' = v − (1 + e) (u·N) N    if u·N < 0

    A racket that comes to meet a ball at speed w sends it back with e v + (1 + e) w: energy may grow, the plane does
    the work. Frictionless: a plane that slides in itself drags nothing along.

    Parameters
    ----------
    velocity, plane_velocity : (..., 3), v and w, m/s
    normal : (..., 3), unit, out of the plane
    restitution : (...), e, 0 to 1

    Returns
    -------
    (..., 3), m/s; a body that the plane does not gain on keeps its velocity

    Raises
    ------
    ValueError
        As kinematic_response.
    """
    v, w = vector("velocity", velocity), vector("plane_velocity", plane_velocity)
    n, e = unit("normal", vector("normal", normal)), in_unit_interval("restitution", restitution)
    approach = np.minimum(np.vecdot(v - w, n), 0.0)
    return np.asarray(v - ((1 + e) * approach)[..., None] * n)
