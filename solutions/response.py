"""Responding to a collision with a plane (slide 7)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

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
    (..., 3), m/s
    """
    v, n = np.asarray(velocity, dtype=float), np.asarray(normal, dtype=float)
    approach = np.minimum(np.sum(v * n, axis=-1), 0.0)
    return np.asarray(v - ((1 + np.asarray(restitution)) * approach)[..., None] * n)
