"""The Reynolds number, the limit of Stokes' drag, and the drag above that limit.

The drag is that of slide 26, and the limit bears on slide 30.
"""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative, positive, vector
from solutions.scaling import length_of

STOKES_LIMIT = 0.1
"""Reynolds number above which a `StokesRegimeWarning` is given.

The true drag on a sphere exceeds Stokes' drag by 1.8 % there, and by 13 % at 1.
"""
LARGEST_REYNOLDS = 3.38e5
"""Largest Reynolds number at which `drag_correction` knows the drag of a sphere.

Beyond it, the boundary layer of the sphere turns turbulent.
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
        If viscosity is not positive, radius or fluid_density is negative, or a velocity
        does not have three components.

    Notes
    -----
    The Reynolds number of a sphere is taken with its diameter 2 r and with its speed
    relative to the fluid:

        Re = 2 r ρ_f ‖v − u‖/η
    """
    speed = length_of(vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity))
    rho, r = not_negative("fluid_density", fluid_density), not_negative("radius", radius)
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


def drag_correction(reynolds: ArrayLike) -> Array:
    """True drag of a sphere over Stokes' drag, from experiments.

    It is the fit of Clift, Grace and Weber (1978), table 5.2. It is 1.018 at Re = 0.1
    and 1.13 at Re = 1.

    Parameters
    ----------
    reynolds : (...), Re = 2 r ρ_f v/η, from 0 to `LARGEST_REYNOLDS`

    Returns
    -------
    (...), without a unit; 1 at Re = 0

    Raises
    ------
    ValueError
        If reynolds is negative or above `LARGEST_REYNOLDS`.

    Notes
    -----
    The drag coefficient is C_D = 24/Re times the correction. Below Re = 0.01 the
    correction is Oseen's 1 + 3/16 Re. Above, it is fitted in pieces, which meet to 1 %.
    """
    given = not_negative("reynolds", reynolds)
    if np.any(given > LARGEST_REYNOLDS):
        raise ValueError(f"reynolds must be at most {LARGEST_REYNOLDS:g}, not {given.max():g}")
    re = np.maximum(given, 0.01)
    w = np.log10(re)
    ends = [re <= 20, re <= 260, re <= 1500, re <= 1.2e4, re <= 4.4e4]
    coefficients = [
        10 ** (1.6435 - 1.1242 * w + 0.1558 * w**2),
        10 ** (-2.4571 + 2.5558 * w - 0.9295 * w**2 + 0.1049 * w**3),
        10 ** (-1.9181 + 0.6370 * w - 0.0636 * w**2),
    ]
    last = 10 ** (-4.3390 + 1.5809 * w - 0.1546 * w**2)
    low = [1 + 0.1315 * re ** (0.82 - 0.05 * w), 1 + 0.1935 * re**0.6305]
    fit = np.select(ends, low + [c * re / 24 for c in coefficients], last * re / 24)
    return np.where(given < 0.01, 1 + 3 / 16 * given, fit)
