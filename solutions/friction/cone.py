"""The cone of friction, and the pyramid that many programs use instead (slide 24)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative, unit, vector

SQUARE_TOLERANCE = 1e-6
"""How far the cosine of two axes at right angles may be from 0.

Axes in single precision pass.
"""


def clamp_to_circle(tangent_force: ArrayLike, limit: ArrayLike) -> Array:
    """The part of a force along the surface that friction can give.

    The direction of the force stays.

    Parameters
    ----------
    tangent_force : (..., 3), along the surface, N (or an impulse, N s)
    limit : (...), μ N, in the same unit

    Returns
    -------
    (..., 3), in the same unit
        The force itself up to and including the limit.

    Raises
    ------
    ValueError
        If a limit is negative or the force does not have three components.

    Notes
    -----
    Friction is at most μ N in every direction of the surface, so that its end lies
    within a circle. A larger force is shortened to the radius of this circle:

        F_t min(1, μ N/‖F_t‖)
    """
    force, most = (
        vector("tangent_force", tangent_force),
        not_negative("limit", limit),
    )
    size = np.linalg.norm(force, axis=-1)
    return np.asarray(
        force
        * np.where(size > most, most / np.where(size > 0, size, 1.0), 1.0)[
            ..., None
        ]
    )


def clamp_to_square(
    tangent_force: ArrayLike,
    limit: ArrayLike,
    axis_x: ArrayLike,
    axis_y: ArrayLike,
) -> Array:
    """The force with each component along two axes clamped by itself.

    The limits |F_x| ≤ μ N and |F_y| ≤ μ N make a pyramid instead of a cone.

    Parameters
    ----------
    tangent_force : (..., 3), along the surface, N (or an impulse, N s)
    limit : (...), μ N, in the same unit
    axis_x, axis_y : (..., 3), unit, along the surface and at right angles

    Returns
    -------
    (..., 3), in the same unit

    Raises
    ------
    ValueError
        If a limit is negative, an axis does not have length 1, the axes are not at
        right angles, or a vector does not have three components.

    Notes
    -----
    The pyramid is cheap, and wrong. Along its diagonal friction is √2 times too large.
    A force far beyond the limit is clamped to the diagonal whatever its direction is,
    so that a body slides on a curve. The result depends on the choice of the axes.
    """
    force, most = (
        vector("tangent_force", tangent_force),
        not_negative("limit", limit),
    )
    axes = (
        unit("axis_x", vector("axis_x", axis_x)),
        unit("axis_y", vector("axis_y", axis_y)),
    )
    if np.any(np.abs(np.vecdot(*axes)) > SQUARE_TOLERANCE):
        raise ValueError("axis_x and axis_y must be at right angles")
    x, y = (
        np.clip(np.vecdot(force, axis), -most, most)[..., None] * axis
        for axis in axes
    )
    return np.asarray(x + y)
