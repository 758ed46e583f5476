"""The Reynolds number and the limit of Stokes' drag (slide 26)."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative, positive, vector

STOKES_LIMIT = 0.1
"""Reynolds number above which a `StokesRegimeWarning` is given.

The true drag on a sphere exceeds Stokes' drag by 1.8 % there, and by 13 % at 1.
"""


class StokesRegimeWarning(UserWarning):
    """The flow is too fast for the drag to be proportional to the velocity."""


def reynolds_number(
    velocity: ArrayLike,
    fluid_velocity: ArrayLike,
    radius: ArrayLike,
    fluid_density: ArrayLike,
    viscosity: ArrayLike,
) -> Array:
    """How far inertia outweighs viscosity in the flow around a sphere.

    Parameters
    ----------
    velocity : (..., 3), v, of the sphere, m/s
    fluid_velocity : (..., 3), u, of the fluid, m/s
    radius : (...), r, m, not negative
    fluid_density : (...), ρ_f, kg/m³, not negative
    viscosity : (...), η, Pa s, above zero

    Returns
    -------
    (...), Re, without a unit

    Raises
    ------
    ValueError
        If viscosity is not positive, radius or fluid_density is negative, or a
        velocity does not have three components.

    Notes
    -----
    The Reynolds number of a sphere is taken with its diameter 2 r and with its
    speed relative to the fluid:

        Re = 2 r ρ_f ‖v − u‖/η
    """
    u = vector("fluid_velocity", fluid_velocity)
    speed = np.linalg.norm(vector("velocity", velocity) - u, axis=-1)
    r = not_negative("radius", radius)
    rho = not_negative("fluid_density", fluid_density)
    return np.asarray(2 * r * rho * speed / positive("viscosity", viscosity))


def check_stokes_regime(reynolds: ArrayLike) -> None:
    """Warn where the flow is too fast for Stokes' drag.

    There is one warning, and it names the largest Reynolds number.

    Parameters
    ----------
    reynolds : (...), of a sphere, not negative

    Raises
    ------
    ValueError
        If reynolds is negative.

    Warns
    -----
    StokesRegimeWarning
        Where reynolds is above `STOKES_LIMIT`.
    """
    largest = np.max(not_negative("reynolds", reynolds), initial=0.0)
    if largest > STOKES_LIMIT:
        text = f"Stokes' drag is 1.8 % too small at Re = 0.1 and 13 % at 1; here Re is {largest:.3g}"
        warnings.warn(text, StokesRegimeWarning, stacklevel=3)
