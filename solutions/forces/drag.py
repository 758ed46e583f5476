"""Drag in a slow, thick flow, and buoyancy (slide 26)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Triple, domain


@domain
def stokes_drag(
    velocity: Triple,
    fluid_velocity: Triple,
    viscosity: NotNegative,
    radius: NotNegative,
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

    Notes
    -----
    The drag is

        F = −6πr η (v − u)

    The slide writes −K n v, with K = 6πr for a sphere. Its n is the viscosity
    η. Its v must be the velocity relative to the fluid, v − u; otherwise a
    ball that drifts along with a river would be braked. `sphere_shape_factor`
    has the K of a sphere, and `spheroid_shape_factors` those of longer and
    flatter bodies.
    """
    relative = velocity - fluid_velocity
    return -(6 * np.pi * radius * viscosity)[..., None] * relative


@domain
def buoyancy(
    volume: NotNegative, fluid_density: NotNegative, gravity: Triple
) -> Array:
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

    Notes
    -----
    Imagine that the body is replaced by fluid at rest. The pressure around it
    is the same as before, and it carries the weight ρ_f V g of this fluid. So
    the pressure exerts the force

        F = −ρ_f V g

    on the fluid, and also on the body in its place.
    """
    return -(fluid_density * volume)[..., None] * gravity
