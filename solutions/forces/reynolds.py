"""The Reynolds number and the limit of Stokes' drag (slide 26)."""

from __future__ import annotations

import warnings

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Positive, Triple, domain

STOKES_LIMIT = 0.1
"""Reynolds number above which a `StokesRegimeWarning` is given.

The true drag on a sphere exceeds Stokes' drag by 1.8 % there, and by 13 % at
1.
"""


class StokesRegimeWarning(UserWarning):
    """The flow is too fast for the drag to be proportional to the velocity."""


@domain
def reynolds_number(
    velocity: Triple,
    fluid_velocity: Triple,
    radius: NotNegative,
    fluid_density: NotNegative,
    viscosity: Positive,
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

    Notes
    -----
    The Reynolds number of a sphere is taken with its diameter 2 r and with its
    speed relative to the fluid:

        Re = 2 r ρ_f ‖v − u‖/η
    """
    speed = np.linalg.norm(velocity - fluid_velocity, axis=-1)
    return 2 * radius * fluid_density * speed / viscosity


@domain
def check_stokes_regime(reynolds: NotNegative) -> None:
    """Warn where the flow is too fast for Stokes' drag.

    There is one warning, and it names the largest Reynolds number.

    Parameters
    ----------
    reynolds : (...), Re, of a sphere, without a unit, not negative

    Warns
    -----
    StokesRegimeWarning
        Where reynolds is above `STOKES_LIMIT`.
    """
    largest = np.max(reynolds, initial=0.0)
    if largest > STOKES_LIMIT:
        warnings.warn(
            "Stokes' drag is 1.8 % too small at Re = 0.1 and 13 % at 1;"
            f" here Re is {largest:.3g}",
            StokesRegimeWarning,
            stacklevel=5,  # the line that calls `terminal_velocity`
        )
