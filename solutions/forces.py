"""Uniform gravity and the motion under it (slide 25)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def uniform_gravity(mass: ArrayLike, gravity: ArrayLike) -> Array:
    """Weight of a body: F = m g (slide 25).

    Parameters
    ----------
    mass : (...), kg
    gravity : (..., 3), acceleration of free fall, m/s²

    Returns
    -------
    (..., 3), N
    """
    return np.asarray(np.asarray(mass, dtype=float)[..., None] * np.asarray(gravity, dtype=float))


def ballistic_motion(
    position: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after a time dt of constant acceleration, exactly: p + v dt + a dt²/2 and v + a dt.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, a = (np.asarray(value, dtype=float) for value in (position, velocity, acceleration))
    time = np.asarray(dt, dtype=float)[..., None]
    return p + v * time + a * time**2 / 2, v + a * time


def semi_implicit_euler(
    position: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after one step of the integrator that most engines use: v' = v + a dt, then p' = p + v' dt.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, a = (np.asarray(value, dtype=float) for value in (position, velocity, acceleration))
    time = np.asarray(dt, dtype=float)[..., None]
    after = v + a * time
    return p + after * time, after
