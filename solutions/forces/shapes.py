"""What the shape of a body does to Stokes' drag (slide 26)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    NotNegative,
    domain,
)
from solutions.vectors import quotient

_NEAR_SPHERE = 0.25
"""|1 − b²/a²| below which the series is summed.

The closed forms lose as many digits as this is short of 1.
"""
_ORDERS = np.arange(30)  # 0.25³⁰ is 1e-18
_SERIES_ALONG = 1 / (2 * _ORDERS + 1) + 1 / (2 * _ORDERS + 3)
_SERIES_ACROSS = 3 / (2 * _ORDERS + 1) - 1 / (2 * _ORDERS + 3)


@domain
def sphere_shape_factor(radius: NotNegative) -> Array:
    """Shape factor of a sphere in Stokes' drag (slide 26).

    Parameters
    ----------
    radius : (...), r, m, not negative

    Returns
    -------
    (...), K, m

    Notes
    -----
    Stokes' drag on a sphere has the size 6πr η v. It is written K η v for a
    body of any shape, so that the sphere has

        K = 6πr
    """
    return 6 * np.pi * radius


@domain
def spheroid_shape_factors(
    along: FiniteNotNegative, across: FinitePositive
) -> Array:
    """Shape factors of a spheroid along its axis and across it, exactly.

    They are those of Oberbeck (1876) and Perrin (1934).

    Parameters
    ----------
    along : (...), a, semi-axis of symmetry, m, not negative and finite
    across : (...), b, semi-axis across it, m, above zero and finite

    Returns
    -------
    (..., 2), K_∥ and K_⊥, m
        A sphere has 6πr twice. A disc, a = 0, has 16 b and (32/3) b.

    Notes
    -----
    For a long (prolate) spheroid, with e² = 1 − b²/a²,

        K_∥ = 8π a e³/((1 + e²) artanh e − e)
        K_⊥ = 16π a e³/(e + (3e² − 1) artanh e)

    For a flat (oblate) spheroid, with e² = 1 − a²/b²,

        K_∥ = 8π b e³/(e √(1 − e²) − (1 − 2e²) arcsin e)
        K_⊥ = 16π b e³/((1 + 2e²) arcsin e − e √(1 − e²))

    Near a sphere all four are quotients of small numbers, in which rounding
    would take over. There the function sums a power series in m = 1 − b²/a²
    instead. For a long spheroid it follows if the series of artanh e is put
    in, and numerator and denominator are divided by e³. A flat spheroid has
    the same series, with a negative m:

        K_∥ = 8π a/Σ mᵏ (1/(2k+1) + 1/(2k+3))
        K_⊥ = 16π a/Σ mᵏ (3/(2k+1) − 1/(2k+3))
    """
    difference = (along - across) * (along + across)
    near = np.abs(difference) < _NEAR_SPHERE * along**2
    # Each form gets a spheroid of its own kind where its result is not taken.
    long = ~near & (along > across)
    flat = ~near & ~long
    prolate = _prolate(np.where(long, along, 2.0), np.where(long, across, 1.0))
    oblate = _oblate(np.where(flat, along, 1.0), np.where(flat, across, 2.0))
    m = quotient(np.where(near, difference, 0.0), along**2)
    return np.where(
        near[..., None],
        _near_sphere(along, m),
        np.where(long[..., None], prolate, oblate),
    )


def _prolate(a: Array, b: Array) -> Array:
    e = np.sqrt((a - b) * (a + b)) / a
    artanh = np.arccosh(a / b)
    along = 8 * np.pi * a * e**3 / ((1 + e**2) * artanh - e)
    across = 16 * np.pi * a * e**3 / (e + (3 * e**2 - 1) * artanh)
    return np.stack([along, across], axis=-1)


def _oblate(a: Array, b: Array) -> Array:
    e = np.sqrt((b - a) * (b + a)) / b
    root = a / b
    arcsin = np.arccos(root)
    along = 8 * np.pi * b * e**3 / (e * root - (1 - 2 * e**2) * arcsin)
    across = 16 * np.pi * b * e**3 / ((1 + 2 * e**2) * arcsin - e * root)
    return np.stack([along, across], axis=-1)


def _near_sphere(a: Array, m: Array) -> Array:
    powers = m[..., None] ** _ORDERS
    along = 8 * np.pi * a / np.sum(powers * _SERIES_ALONG, axis=-1)
    across = 16 * np.pi * a / np.sum(powers * _SERIES_ACROSS, axis=-1)
    return np.stack([along, across], axis=-1)
