"""What the shape of a body does to Stokes' drag (slide 26)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive

_NEAR_SPHERE = 0.25
"""|1 − b²/a²| below which the series is summed.

The closed forms lose as many digits as this is short of 1.
"""
_ORDERS = np.arange(30)  # 0.25³⁰ is 1e-18
_SERIES_ALONG = 1 / (2 * _ORDERS + 1) + 1 / (2 * _ORDERS + 3)
_SERIES_ACROSS = 3 / (2 * _ORDERS + 1) - 1 / (2 * _ORDERS + 3)


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
        finite("along", not_negative("along", along)),
        finite("across", positive("across", across)),
    )
    difference = (a - b) * (a + b)
    near = np.abs(difference) < _NEAR_SPHERE * a**2
    # Where the series is used, any spheroid will do here, as its result is not taken.
    safe_a, safe_b = np.where(near, 2.0, a), np.where(near, 1.0, b)
    long = safe_a > safe_b
    prolate = _prolate(
        np.where(long, safe_a, 2.0), np.where(long, safe_b, 1.0)
    )
    oblate = _oblate(np.where(long, 1.0, safe_a), np.where(long, 2.0, safe_b))
    series = _near_sphere(
        a, np.where(near, difference, 0.0) / np.where(near, a, 1.0) ** 2
    )
    return np.where(
        near[..., None], series, np.where(long[..., None], prolate, oblate)
    )


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
