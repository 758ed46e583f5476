"""The cone of friction, and the pyramid that many programs use (slide 24)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Triple, Unit, domain, require
from solutions.vectors import quotient

SQUARE_TOLERANCE = 1e-6
"""How far the cosine of two axes at right angles may be from 0.

Axes in single precision pass.
"""


@domain
def clamp_to_circle(tangent_force: Triple, limit: NotNegative) -> Array:
    """The part of a force along the surface that friction can give.

    The direction of the force stays.

    Parameters
    ----------
    tangent_force : (..., 3), F_t, along the surface, N (or an impulse, N s)
    limit : (...), μ N, in the same unit, not negative

    Returns
    -------
    (..., 3), in the same unit
        The force itself up to and including the limit.

    Notes
    -----
    Friction is at most μ N in every direction of the surface, so that its end
    lies within a circle. A larger force is shortened to the radius of this
    circle:

        F_t min(1, μ N/‖F_t‖)
    """
    size = np.linalg.norm(tangent_force, axis=-1)
    share = np.where(size > limit, quotient(limit, size), 1.0)
    return share[..., None] * tangent_force


@domain
def clamp_to_square(
    tangent_force: Triple,
    limit: NotNegative,
    axis_x: Unit,
    axis_y: Unit,
) -> Array:
    """The force with each component along two axes clamped by itself.

    The limits |F_x| ≤ μ N and |F_y| ≤ μ N make a pyramid instead of a cone.

    Parameters
    ----------
    tangent_force : (..., 3), F_t, along the surface, N (or an impulse, N s)
    limit : (...), μ N, in the same unit, not negative
    axis_x, axis_y : (..., 3), unit, along the surface and at right angles

    Returns
    -------
    (..., 3), in the same unit

    Raises
    ------
    ValueError
        If the axes are not at right angles.

    Notes
    -----
    The pyramid is cheap, and wrong. Along its diagonal friction is √2 times
    too large. A force far beyond the limit is clamped to the diagonal whatever
    its direction is, so that a body slides on a curve. The result depends on
    the choice of the axes.
    """
    skew = np.abs(np.vecdot(axis_x, axis_y)) > SQUARE_TOLERANCE
    require(~skew, "axis_x and axis_y must be at right angles")
    x = np.clip(np.vecdot(tangent_force, axis_x), -limit, limit)
    y = np.clip(np.vecdot(tangent_force, axis_y), -limit, limit)
    return x[..., None] * axis_x + y[..., None] * axis_y
