"""The drag of a sphere above Stokes' limit: a fit to experiments (slide 26).

The drag coefficient is C_D = F/(½ ρ_f v² π r²), and Stokes' law is
C_D = 24/Re.
"""

from __future__ import annotations

from functools import partial
from typing import Annotated

import numpy as np

from solutions.arrays import Array
from solutions.checks import between, not_negative
from solutions.domain import domain

LARGEST_REYNOLDS = 3.38e5
"""Largest Reynolds number at which the fit knows the drag of a sphere.

Beyond it, the boundary layer of the sphere turns turbulent.
"""
Known = Annotated[
    Array, not_negative, partial(between, least=0, most=LARGEST_REYNOLDS)
]
"""A Reynolds number at which the fit knows the drag."""


@domain
def drag_correction(reynolds: Known) -> Array:
    """True drag of a sphere over Stokes' drag, from experiments.

    It is the fit of Clift, Grace and Weber (1978). The ratio is 1.018 at
    Re = 0.1 and 1.13 at Re = 1.

    Parameters
    ----------
    reynolds : (...), Re = 2 r ρ_f v/η, without a unit
        It is from 0 to `LARGEST_REYNOLDS`.

    Returns
    -------
    (...), without a unit; 1 at Re = 0

    Notes
    -----
    The correction is C_D Re/24, because Stokes' drag has the coefficient
    24/Re. The fit gives C_D in pieces, which meet to 1 %. Below Re = 0.01 the
    function takes Oseen's

        1 + (3/16) Re
    """
    re = np.maximum(reynolds, 0.01)
    w = np.log10(re)
    fit = np.select(
        [re <= 20, re <= 260, re <= 1500, re <= 1.2e4, re <= 4.4e4],
        [
            1 + 0.1315 * re ** (0.82 - 0.05 * w),
            1 + 0.1935 * re**0.6305,
            10 ** (1.6435 - 1.1242 * w + 0.1558 * w**2) * re / 24,
            10 ** (-2.4571 + 2.5558 * w - 0.9295 * w**2 + 0.1049 * w**3)
            * re
            / 24,
            10 ** (-1.9181 + 0.6370 * w - 0.0636 * w**2) * re / 24,
        ],
        10 ** (-4.3390 + 1.5809 * w - 0.1546 * w**2) * re / 24,
    )
    return np.where(reynolds < 0.01, 1 + 3 / 16 * reynolds, fit)
