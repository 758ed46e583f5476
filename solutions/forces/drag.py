"""Drag in a slow, thick flow, and buoyancy (slide 26)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative, unit, vector


def stokes_drag(
    velocity: ArrayLike,
    fluid_velocity: ArrayLike,
    viscosity: ArrayLike,
    radius: ArrayLike,
) -> Array:
    """Drag of a thick fluid on a ball that moves slowly through it (slide 26).

    The drag is proportional to the velocity of the ball relative to the fluid.
    This holds only for a Reynolds number far below 1, see `reynolds_number`.

    Parameters
    ----------
    velocity : (..., 3), v, of the ball, m/s
    fluid_velocity : (..., 3), u, of the fluid, m/s
    viscosity : (...), η, Pa s, not negative
    radius : (...), r, of the ball, m, not negative

    Returns
    -------
    (..., 3), on the ball, N
        A ball that drifts along with the fluid feels no force.

    Raises
    ------
    ValueError
        If viscosity or radius is negative, or a velocity does not have three
        components.

    Notes
    -----
    The drag is

        F = −6πr η (v − u)

    The slide writes −K n v, with K = 6πr for a sphere. Its n is the viscosity
    η. Its v must be the velocity relative to the fluid, v − u; otherwise a
    ball that drifts along with a river would be braked. `sphere_shape_factor`
    has the K of a sphere, and `spheroid_drag` the drag of longer and flatter
    bodies.
    """
    relative = vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity)
    size = 6 * np.pi * not_negative("radius", radius) * not_negative("viscosity", viscosity)
    return np.asarray(-size[..., None] * relative)


def spheroid_drag(
    velocity: ArrayLike,
    fluid_velocity: ArrayLike,
    viscosity: ArrayLike,
    shape_factors: ArrayLike,
    axis: ArrayLike,
) -> Array:
    """Drag of a thick fluid on a spheroid that may point in any direction (slide 26).

    The slide says "shape". The spheroid's axis of symmetry need not be along its
    motion.

    Parameters
    ----------
    velocity : (..., 3), v, of the body, m/s
    fluid_velocity : (..., 3), u, of the fluid, m/s
    viscosity : (...), η, Pa s, not negative
    shape_factors : (..., 2), K_∥ along the axis and K_⊥ across it, m, not negative
        These are what `spheroid_shape_factors` returns.
    axis : (..., 3), d, the axis of symmetry, of unit length

    Returns
    -------
    (..., 3), N

    Raises
    ------
    ValueError
        If axis does not have length 1, viscosity or a shape factor is negative, or a
        velocity does not have three components.

    Notes
    -----
    Split the velocity relative to the fluid into a part along the axis and a part
    across it. Each part is resisted with its own shape factor:

        F = −η (K_∥ (w·d) d + K_⊥ (w − (w·d) d)),    w = v − u

    A slender body falls up to twice as fast lengthwise as broadside. If it falls
    aslant, it drifts to the side, because its K_∥ is smaller than its K_⊥.
    """
    d, k = unit("axis", axis), not_negative("shape_factors", shape_factors)
    relative = vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity)
    along = np.sum(relative * d, axis=-1)[..., None] * d
    resisted = k[..., 0, None] * along + k[..., 1, None] * (relative - along)
    return np.asarray(-not_negative("viscosity", viscosity)[..., None] * resisted)


def buoyancy(volume: ArrayLike, fluid_density: ArrayLike, gravity: ArrayLike) -> Array:
    """Lift by the fluid that a body displaces (slide 26).

    The slide leaves it out.

    Parameters
    ----------
    volume : (...), V, of the body, m³, not negative
    fluid_density : (...), ρ_f, kg/m³, not negative
    gravity : (..., 3), g, m/s²

    Returns
    -------
    (..., 3), N, against gravity

    Raises
    ------
    ValueError
        If volume or fluid_density is negative, or gravity does not have three
        components.

    Notes
    -----
    Imagine that the body is replaced by fluid at rest. The pressure around it is the
    same as before, and it carries the weight ρ_f V g of this fluid. So the pressure
    exerts the force

        F = −ρ_f V g

    on the fluid, and also on the body in its place.
    """
    displaced = not_negative("fluid_density", fluid_density) * not_negative("volume", volume)
    return np.asarray(-displaced[..., None] * vector("gravity", gravity))
