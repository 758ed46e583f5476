"""The drag of a sphere above Stokes' limit: fits to experiments (slide 26).

The names are those of the package `fluids`, which has the same formulas; only
Schiller_Naumann is missing there. The drag coefficient is C_D = F/(½ ρ_f v² π r²), and
Stokes' law is C_D = 24/Re.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative

LARGEST_REYNOLDS = 3.38e5
"""Largest Reynolds number at which the fit named Clift knows the drag of a sphere.

Beyond it, the boundary layer of the sphere turns turbulent.
"""


class DragRangeWarning(UserWarning):
    """A formula for drag is used outside the range for which it was made."""


class Correlation(NamedTuple):
    """A formula for the drag coefficient of a smooth sphere.

    Attributes
    ----------
    coefficient : function of Re (...), above zero, that returns C_D (...)
    least, most : the range of Reynolds numbers for which it was made
    source : who published it
    """

    coefficient: Callable[[Array], Array]
    least: float
    most: float
    source: str


def drag_correction(reynolds: ArrayLike, correlation: str = "Clift") -> Array:
    """True drag of a sphere over Stokes' drag, from experiments.

    The fit of Clift, Grace and Weber is the default. With it the ratio is 1.018 at
    Re = 0.1 and 1.13 at Re = 1.

    Parameters
    ----------
    reynolds : (...), Re = 2 r ρ_f v/η, not negative
    correlation : the name of the fit, one of `CORRELATIONS`

    Returns
    -------
    (...), without a unit; 1 at Re = 0

    Raises
    ------
    ValueError
        If reynolds is negative, the name is unknown, or the correlation is Clift and
        reynolds is above `LARGEST_REYNOLDS`.

    Warns
    -----
    DragRangeWarning
        Where reynolds is not 0 and outside the range of another correlation.

    Notes
    -----
    The correction is C_D Re/24, because Stokes' drag has the coefficient 24/Re. The
    formulas for C_D stand in `CORRELATIONS`, each with its range and its source.
    """
    given = not_negative("reynolds", reynolds)
    if correlation == "Clift":
        return _clift(given)
    if correlation not in CORRELATIONS:
        raise ValueError(f"correlation must be one of {', '.join(CORRELATIONS)}, not {correlation!r}")
    chosen = CORRELATIONS[correlation]
    flows = given > 0
    outside = given[flows & ((given < chosen.least) | (given > chosen.most))]
    if outside.size:
        known = f"{correlation} is for Re from {chosen.least:g} to {chosen.most:g}"
        warnings.warn(f"{known}; here Re is {outside.max():.3g}", DragRangeWarning, stacklevel=2)
    re = np.where(flows, given, 1.0)
    return np.where(flows, chosen.coefficient(re) * re / 24, 1.0)


def _clift(given: Array) -> Array:
    """C_D Re/24 in pieces, which meet to 1 %; Oseen's 1 + 3/16 Re below Re = 0.01."""
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


def _stokes(re: Array) -> Array:
    return 24 / re


def _schiller_naumann(re: Array) -> Array:
    return 24 / re * (1 + 0.15 * re**0.687)


def _rouse(re: Array) -> Array:
    return 24 / re + 3 / np.sqrt(re) + 0.34


def _clift_gauvin(re: Array) -> Array:
    return 24 / re * (1 + 0.152 * re**0.677) + 0.417 / (1 + 5070 * re**-0.94)


def _flemmer_banks(re: Array) -> Array:
    power = 0.383 * re**0.356 - 0.207 * re**0.396 - 0.143 / (1 + np.log10(re) ** 2)
    return np.asarray(24 / re * 10**power)


def _khan_richardson(re: Array) -> Array:
    return np.asarray((2.49 * re**-0.328 + 0.34 * re**0.067) ** 3.18)


def _haider_levenspiel(re: Array) -> Array:
    return 24 / re * (1 + 0.1806 * re**0.6459) + 0.4251 / (1 + 6880.95 / re)


def _cheng(re: Array) -> Array:
    return 24 / re * (1 + 0.27 * re) ** 0.43 - 0.47 * np.expm1(-0.04 * re**0.38)


def _terfous(re: Array) -> Array:
    return 2.689 + 21.683 / re + 0.131 / re**2 - 10.616 / re**0.1 + 12.216 / re**0.2


def _mikhailov_freire(re: Array) -> Array:
    above = 1617933 / 2030 + 178861 / 1063 * re + 1219 / 1084 * re**2
    below = 77531 / 422 + 13529 / 976 * re - re**2 / 71154
    return 3808 * above / (681 * re * below)


def _barati(re: Array) -> Array:
    slow = 5.4856e9 * np.tanh(4.3774e-9 / re) + 0.0709 * np.tanh(700.6574 / re)
    middle = 0.3894 * np.tanh(74.1539 / re) - 0.1198 * np.tanh(7429.0843 / re)
    return slow + middle + 1.7174 * np.tanh(9.9851 / (re + 2.3384)) + 0.4744


def _morrison(re: Array) -> Array:
    wake = re / 263000
    drop = 0.411 * wake**0.06 / (1 + wake**8)  # the book's 0.411 wake^−7.94/(1 + wake^−8)
    return 24 / re + 0.52 * re / (1 + (re / 5) ** 1.52) + drop + re**0.8 / 461000


CORRELATIONS = {
    "Stokes": Correlation(_stokes, 0.0, 0.3, "Stokes 1851; range: Rhodes, Particle Technology, 2013"),
    "Schiller_Naumann": Correlation(_schiller_naumann, 0.0, 800.0, "Schiller and Naumann 1933; range: Clift et al."),
    "Clift": Correlation(lambda re: _clift(re) * 24 / re, 0.0, LARGEST_REYNOLDS, "Clift, Grace and Weber 1978, 5.2"),
    "Rouse": Correlation(_rouse, 0.0, 2e5, "Rouse, Fluid Mechanics for Hydraulic Engineers, 1938"),
    "Clift_Gauvin": Correlation(_clift_gauvin, 0.0, 2e5, "Clift and Gauvin, Proc. Chemeca 70, 1970"),
    "Flemmer_Banks": Correlation(_flemmer_banks, 0.0, 2e5, "Flemmer and Banks, Powder Technology 48, 1986"),
    "Khan_Richardson": Correlation(_khan_richardson, 0.01, 2e5, "Khan and Richardson, Chem. Eng. Commun. 62, 1987"),
    "Haider_Levenspiel": Correlation(_haider_levenspiel, 0.0, 2e5, "Haider, Levenspiel, Powder Technol. 58, 1989"),
    "Cheng": Correlation(_cheng, 0.0, 2e5, "Cheng, Powder Technology 189, 2009"),
    "Terfous": Correlation(_terfous, 0.1, 5e4, "Terfous, Hazzab and Ghenaim, Powder Technology 239, 2013"),
    "Mikhailov_Freire": Correlation(_mikhailov_freire, 0.0, 118300.0, "Mikhailov, Freire, Powder Technol. 237, 2013"),
    "Barati": Correlation(_barati, 0.002, 2e5, "Barati, Neyshabouri and Ahmadi, Powder Technology 257, 2014"),
    "Morrison": Correlation(_morrison, 0.0, 1e6, "Morrison, An Introduction to Fluid Mechanics, 2013"),
}
"""The formulas by name. Ranges are those of the package `fluids` where it has them."""
