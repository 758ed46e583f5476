"""The cone of friction, and the pyramid that many programs take for it (slide 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import not_negative, unit, vector

Array = NDArray[np.float64]
SQUARE_TOLERANCE = 1e-6
"""How far the cosine of two axes at right angles may be from 0: single precision passes."""


def clamp_to_circle(tangent_force: ArrayLike, limit: ArrayLike) -> Array:
    """The force, or what friction can give of it: F_t min(1, μ N/‖F_t‖), (..., 3), N. The direction stays.

    Parameters
    ----------
    tangent_force : (..., 3), along the surface, N (or an impulse, N s)
    limit : (...), μ N, in the same unit

    Raises
    ------
    ValueError
        If a limit is negative or the force has not three components.
    """
    force, most = vector("tangent_force", tangent_force), not_negative("limit", limit)
    size = np.linalg.norm(force, axis=-1)
    return np.asarray(force * np.where(size > most, most / np.where(size > 0, size, 1.0), 1.0)[..., None])


def clamp_to_square(tangent_force: ArrayLike, limit: ArrayLike, axis_x: ArrayLike, axis_y: ArrayLike) -> Array:
    """The same with each component clamped on its own, |F_x| ≤ μ N and |F_y| ≤ μ N: a pyramid instead of a cone.

    Cheap, and wrong: along the diagonal friction is √2 times too large, and a force far beyond the limit is answered
    along the diagonal whatever its direction, so that a body slides on a curve. The answer depends on the axes chosen.

    Parameters
    ----------
    tangent_force : (..., 3), along the surface, N (or an impulse, N s)
    limit : (...), μ N, in the same unit
    axis_x, axis_y : (..., 3), unit, along the surface and at right angles

    Raises
    ------
    ValueError
        If a limit is negative, an axis has not length 1, the axes are not at right angles, or a vector has not three
        components.
    """
    force, most = vector("tangent_force", tangent_force), not_negative("limit", limit)
    axes = (unit("axis_x", vector("axis_x", axis_x)), unit("axis_y", vector("axis_y", axis_y)))
    if np.any(np.abs(np.vecdot(*axes)) > SQUARE_TOLERANCE):
        raise ValueError("axis_x and axis_y must be at right angles")
    x, y = (np.clip(np.vecdot(force, axis), -most, most)[..., None] * axis for axis in axes)
    return np.asarray(x + y)
