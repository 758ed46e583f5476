"""What the shape of a body does to Stokes' drag, and what the speed does (slide 26)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, vector

Array = NDArray[np.float64]
_NEAR_SPHERE = 0.25
"""|1 − b²/a²| below which the series is summed: the closed forms lose the digits that this is short of 1."""
_ORDERS = np.arange(30)  # 0.25³⁰ is 1e-18
_SERIES_ALONG = 1 / (2 * _ORDERS + 1) + 1 / (2 * _ORDERS + 3)
_SERIES_ACROSS = 3 / (2 * _ORDERS + 1) - 1 / (2 * _ORDERS + 3)
LARGEST_REYNOLDS = 3.38e5
"""Up to which `drag_correction` knows the drag of a sphere: beyond, its boundary layer turns turbulent."""


def sphere_shape_factor(radius: ArrayLike) -> Array:
    """Shape factor of a sphere: K = 6πr (slide 26).

    Parameters
    ----------
    radius : (...), m

    Returns
    -------
    (...), m
    """
    return np.asarray(6 * np.pi * not_negative("radius", radius))


def spheroid_shape_factors(along: ArrayLike, across: ArrayLike) -> Array:
    """Shape factors of a spheroid along its axis and across it, exactly (Oberbeck 1876, Perrin 1934).

    With the semi-axes a along the axis of symmetry and b across it, and e² = 1 − b²/a² for a long (prolate) one,

        K_∥ = 8π a e³/((1 + e²) artanh e − e),    K_⊥ = 16π a e³/(e + (3e² − 1) artanh e)

    or e² = 1 − a²/b² for a flat (oblate) one:

        K_∥ = 8π b e³/(e √(1 − e²) − (1 − 2e²) arcsin e),    K_⊥ = 16π b e³/((1 + 2e²) arcsin e − e √(1 − e²))

    Near a sphere all four are quotients of small numbers. There both kinds are one power series in m = 1 − b²/a²:

        K_∥ = 8π a/Σ mᵏ (1/(2k+1) + 1/(2k+3)),    K_⊥ = 16π a/Σ mᵏ (3/(2k+1) − 1/(2k+3))

    A sphere has 6πr twice; a disc, a = 0, has 16 b and 32/3 b.

    Parameters
    ----------
    along : (...), a, m, not negative
    across : (...), b, m, above zero

    Returns
    -------
    (..., 2), K_∥ and K_⊥, m
    """
    a, b = np.broadcast_arrays(
        finite("along", not_negative("along", along)), finite("across", positive("across", across))
    )
    difference = (a - b) * (a + b)
    near = np.abs(difference) < _NEAR_SPHERE * a**2
    safe_a, safe_b = np.where(near, 2.0, a), np.where(near, 1.0, b)  # any spheroid: its answer is not taken
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
    """True drag of a sphere over Stokes', from experiments (fit of Clift, Grace and Weber 1978, table 5.2).

    It is 1.018 at Re = 0.1 and 1.13 at 1. The drag coefficient is C_D = 24/Re times it. Below Re = 0.01 it is
    Oseen's 1 + 3/16 Re. The pieces of the fit meet to 1 %.

    Parameters
    ----------
    reynolds : (...), 2 r ρ_f v/η

    Returns
    -------
    (...), 1 at Re = 0

    Raises
    ------
    ValueError
        Above `LARGEST_REYNOLDS`.
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
    """Velocity of steady fall of a sphere with its measured drag, also where Stokes' law is out.

    Stokes' fall has some Reynolds number S. The true one obeys Re φ(Re) = S with the correction φ ≥ 1, whose left side
    grows with Re: halving the interval from 0 to S sixty times finds it to the last digit but one.

    Parameters
    ----------
    radius : (...), m
    density, fluid_density : (...), kg/m³
    viscosity : (...), Pa s
    gravity : (..., 3), m/s²
    correction : function of the Reynolds number (...): true drag over Stokes'

    Returns
    -------
    (..., 3), m/s, relative to the fluid

    Raises
    ------
    ValueError
        If the fall is faster than the correction is known for.
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
