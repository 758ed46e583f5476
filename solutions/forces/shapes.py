"""What the shape of a body does to Stokes' drag, and what the speed does (slide 26)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, vector

Array = NDArray[np.float64]
_NEAR_SPHERE = 0.25
"""|1 − b²/a²| below which the series is summed.

The closed forms lose as many digits as this is short of 1.
"""
_ORDERS = np.arange(30)  # 0.25³⁰ is 1e-18
_SERIES_ALONG = 1 / (2 * _ORDERS + 1) + 1 / (2 * _ORDERS + 3)
_SERIES_ACROSS = 3 / (2 * _ORDERS + 1) - 1 / (2 * _ORDERS + 3)
LARGEST_REYNOLDS = 3.38e5
"""Largest Reynolds number at which `drag_correction` knows the drag of a sphere.

Beyond it, the boundary layer of the sphere turns turbulent.
"""


def sphere_shape_factor(radius: ArrayLike) -> Array:
    """Shape factor of a sphere in Stokes' drag (slide 26).

    Parameters
    ----------
    radius : (...), r, m, not negative

    Returns
    -------
    (...), K, m

    Raises
    ------
    ValueError
        If radius is negative.

    Notes
    -----
    Stokes' drag on a sphere has the size 6πr η v. It is written K η v for a body of any
    shape, so that the sphere has

        K = 6πr
    """
    return np.asarray(6 * np.pi * not_negative("radius", radius))


def spheroid_shape_factors(along: ArrayLike, across: ArrayLike) -> Array:
    """Shape factors of a spheroid along its axis and across it, exactly.

    They are those of Oberbeck (1876) and Perrin (1934).

    Parameters
    ----------
    along : (...), a, semi-axis along the axis of symmetry, m, not negative and finite
    across : (...), b, semi-axis across it, m, above zero and finite

    Returns
    -------
    (..., 2), K_∥ and K_⊥, m
        A sphere has 6πr twice. A disc, a = 0, has 16 b and 32/3 b.

    Raises
    ------
    ValueError
        If along is negative, across is not positive, or one of them is not finite.

    Notes
    -----
    For a long (prolate) spheroid, with e² = 1 − b²/a²,

        K_∥ = 8π a e³/((1 + e²) artanh e − e)
        K_⊥ = 16π a e³/(e + (3e² − 1) artanh e)

    For a flat (oblate) spheroid, with e² = 1 − a²/b²,

        K_∥ = 8π b e³/(e √(1 − e²) − (1 − 2e²) arcsin e)
        K_⊥ = 16π b e³/((1 + 2e²) arcsin e − e √(1 − e²))

    Near a sphere all four are quotients of small numbers, in which rounding would take
    over. There the function sums a power series in m = 1 − b²/a² instead. For a long
    spheroid it follows if the series of artanh e is put in, and numerator and
    denominator are divided by e³. A flat spheroid has the same series, with a negative
    m:

        K_∥ = 8π a/Σ mᵏ (1/(2k+1) + 1/(2k+3))
        K_⊥ = 16π a/Σ mᵏ (3/(2k+1) − 1/(2k+3))
    """
    a, b = np.broadcast_arrays(
        finite("along", not_negative("along", along)), finite("across", positive("across", across))
    )
    difference = (a - b) * (a + b)
    near = np.abs(difference) < _NEAR_SPHERE * a**2
    # Where the series is used, any spheroid will do here, as its result is not taken.
    safe_a, safe_b = np.where(near, 2.0, a), np.where(near, 1.0, b)
    long = safe_a > safe_b
    prolate = _prolate(np.where(long, safe_a, 2.0), np.where(long, safe_b, 1.0))
    oblate = _oblate(np.where(long, 1.0, safe_a), np.where(long, 2.0, safe_b))
    series = _near_sphere(a, np.where(near, difference, 0.0) / np.where(near, a, 1.0) ** 2)
    return np.where(near[..., None], series, np.where(long[..., None], prolate, oblate))


def _prolate(a: Array, b: Array) -> Array:
    e, artanh = np.sqrt((a - b) * (a + b)) / a, np.arccosh(a / b)
    along = 8 * np.pi * a * e**3 / ((1 + e**2) * artanh - e)
    across = 16 * np.pi * a * e**3 / (e + (3 * e**2 - 1) * artanh)
    return np.stack([along, across], axis=-1)


def _oblate(a: Array, b: Array) -> Array:
    e, arcsin, root = np.sqrt((b - a) * (b + a)) / b, np.arccos(a / b), a / b
    along = 8 * np.pi * b * e**3 / (e * root - (1 - 2 * e**2) * arcsin)
    across = 16 * np.pi * b * e**3 / ((1 + 2 * e**2) * arcsin - e * root)
    return np.stack([along, across], axis=-1)


def _near_sphere(a: Array, squared: Array) -> Array:
    powers = squared[..., None] ** _ORDERS
    along = 8 * np.pi * a / np.sum(powers * _SERIES_ALONG, axis=-1)
    across = 16 * np.pi * a / np.sum(powers * _SERIES_ACROSS, axis=-1)
    return np.stack([along, across], axis=-1)


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


def terminal_velocity_corrected(
    radius: ArrayLike,
    density: ArrayLike,
    fluid_density: ArrayLike,
    viscosity: ArrayLike,
    gravity: ArrayLike,
    correction: Callable[[Array], Array] = drag_correction,
) -> Array:
    """Velocity of steady fall of a sphere with its measured drag.

    It holds also where Stokes' law does not.

    Parameters
    ----------
    radius : (...), r, m, above zero
    density : (...), ρ_s, of the sphere, kg/m³, not negative
    fluid_density : (...), ρ_f, kg/m³, not negative
    viscosity : (...), η, Pa s, above zero
    gravity : (..., 3), m/s²
    correction : function φ of the Reynolds number (...)
        It returns the true drag over Stokes' drag.

    Returns
    -------
    (..., 3), m/s, relative to the fluid
        It is along gravity for a sphere that is denser than the fluid, and against
        gravity for a lighter one.

    Raises
    ------
    ValueError
        If the fall is faster than the correction is known for. If radius or viscosity
        is not positive, a density is negative, or gravity does not have three
        components.

    Notes
    -----
    Stokes' law predicts a fall with some Reynolds number S. In a steady fall the drag
    equals the weight less the buoyancy, so the true drag is Stokes' drag at S. The true
    drag at the Reynolds number Re is φ(Re) times Stokes' drag at Re, and Stokes' drag
    is proportional to Re. Therefore

        Re φ(Re) = S

    The left side grows with Re, and φ ≥ 1, so Re is between 0 and S. Halving this
    interval sixty times finds Re to the last digit but one.
    """
    r, rho, eta = (
        positive("radius", radius),
        not_negative("fluid_density", fluid_density),
        positive("viscosity", viscosity),
    )
    excess = not_negative("density", density) - rho
    stokes = (2 * excess * r**2 / (9 * eta))[..., None] * vector("gravity", gravity)
    target = 2 * r * rho * np.linalg.norm(stokes, axis=-1) / eta
    low, high = np.zeros_like(target), np.minimum(target, LARGEST_REYNOLDS)
    if np.any(high * correction(high) < target):
        raise ValueError(f"the fall is too fast: its Reynolds number is above {LARGEST_REYNOLDS:g}")
    for _ in range(60):
        middle = (low + high) / 2
        slower = middle * correction(middle) < target
        low, high = np.where(slower, middle, low), np.where(slower, high, middle)
    return np.asarray(stokes * np.where(target > 0, high / np.where(target > 0, target, 1.0), 1.0)[..., None])
