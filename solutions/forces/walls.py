"""How walls near by raise the drag of a slow sphere (slide 26).

Stokes' law is for a fluid without end. Beside a wall, the fluid that the sphere pushes
aside has less room, and the drag is larger by a factor. All factors here are for a
Reynolds number far below 1, as Stokes' law is.
"""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans
from solutions.checks import positive
from solutions.forces.correlations import DragRangeWarning

WIDEST_IN_TUBE = 0.3
"""Largest radius of a sphere, as a share of that of its tube, for Faxén's factor.

It is .24 % too small there, and 6.5 % at .5.
"""
NEAREST_PARALLEL = 1.5
"""Smallest distance from a wall, in radii of the sphere, for Faxén's factor beside it.

It is 1.1 % too large there, and 4.4 % at 1.13. Towards contact it is far too small.
"""


def tube_wall_factor(radius: ArrayLike, tube_radius: ArrayLike) -> Array:
    """Drag of a sphere on the axis of a tube over Stokes' drag, by Faxén.

    Parameters
    ----------
    radius : (...), r, m, positive
    tube_radius : (...), R, m, above the radius of the sphere

    Returns
    -------
    (...), without a unit, above 1
        For a sphere that falls along the tube in a fluid at rest.

    Raises
    ------
    ValueError
        If a radius is not positive or the sphere does not fit into the tube.

    Warns
    -----
    DragRangeWarning
        Where r/R is above `WIDEST_IN_TUBE`. The factor is too small there.

    Notes
    -----
    With λ = r/R the factor is (Faxén 1923)

        1/(1 − 2.10444 λ + 2.08877 λ³ − 0.94813 λ⁵)

    A ball of a tenth of the tube's width, in a viscometer say, already meets 26 % more
    drag than Stokes' law says.
    """
    share = positive("radius", radius) / positive("tube_radius", tube_radius)
    _refuse(share >= 1, "tube_radius must be above the radius of the sphere")
    known = f"Faxén's factor is .24 % too small at r/R = {WIDEST_IN_TUBE:g} and 6.5 % at 0.5"
    _warn(share > WIDEST_IN_TUBE, f"{known}; here r/R is {share.max(initial=0.0):.3g}")
    return np.asarray(1 / (1 - 2.10444 * share + 2.08877 * share**3 - 0.94813 * share**5))


def parallel_wall_factor(radius: ArrayLike, distance: ArrayLike) -> Array:
    """Drag of a sphere that moves along a plane wall over Stokes' drag, by Faxén.

    Parameters
    ----------
    radius : (...), r, m, positive
    distance : (...), h, from the centre of the sphere to the wall, m, above r

    Returns
    -------
    (...), without a unit, above 1
        For a sphere that does not spin.

    Raises
    ------
    ValueError
        If an argument is not positive or the sphere touches the wall.

    Warns
    -----
    DragRangeWarning
        Where h/r is below `NEAREST_PARALLEL`.

    Notes
    -----
    With x = r/h the factor is (Faxén 1924)

        1/(1 − 9/16 x + 1/8 x³ − 45/256 x⁴ − 1/16 x⁵)
    """
    share = _nearness(radius, distance)
    known = f"Faxén's factor is 1 % too large at h/r = {NEAREST_PARALLEL:g}, and too small near contact"
    _warn(share > 1 / NEAREST_PARALLEL, f"{known}; here h/r is {1 / share.max(initial=1e-300):.4g}")
    return np.asarray(1 / (1 - 9 / 16 * share + share**3 / 8 - 45 / 256 * share**4 - share**5 / 16))


def perpendicular_wall_factor(radius: ArrayLike, distance: ArrayLike) -> Array:
    """Drag of a sphere that moves straight towards a plane wall over Stokes' drag.

    Parameters
    ----------
    radius : (...), r, m, positive
    distance : (...), h, from the centre of the sphere to the wall, m, above r

    Returns
    -------
    (...), without a unit, above 1
        It holds at any distance, to 0.71 %, and also for a sphere that moves away.

    Raises
    ------
    ValueError
        If an argument is not positive or the sphere touches the wall.

    Notes
    -----
    With z = h/r − 1, the gap in radii, the factor is

        (6 z² + 9 z + 2)/(6 z² + 2 z)

    Bevan and Prieve (1983) fitted this to the exact series of Brenner (1961). Near
    contact it is 1/z: the fluid has to be squeezed out of the gap, and the smaller the
    gap, the harder. In a perfect fluid the sphere would never touch the wall.

    Far from the wall z² may be too large for a float. With x = r/h, which is never
    above 1, z = (1 − x)/x, and the same factor is

        (6 − 3 x − x²)/(2 (1 − x) (3 − 2 x))
    """
    share = _nearness(radius, distance)
    return np.asarray((6 - 3 * share - share**2) / (2 * (1 - share) * (3 - 2 * share)))


def _nearness(radius: ArrayLike, distance: ArrayLike) -> Array:
    """The share r/h of a sphere that does not touch the wall."""
    share = np.asarray(positive("radius", radius) / positive("distance", distance))
    _refuse(share >= 1, "distance must be above the radius of the sphere: it touches the wall")
    return share


def _refuse(wrong: Booleans, words: str) -> None:
    if np.any(wrong):
        raise ValueError(words)


def _warn(outside: Booleans, words: str) -> None:
    """Warn the caller of the factor."""
    if np.any(outside):
        warnings.warn(words, DragRangeWarning, stacklevel=3)
