"""The two directions along a plane in which Bullet and DART see friction."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array

LEAST_ACROSS = 1e-6
"""Sine of the angle between two directions that DART takes for parallel."""


def bullets_axes(normal: Array) -> Array:
    """Two unit vectors along a plane, as btPlaneSpace1 picks them, and its normal, one a row, (3, 3)."""
    x, y, z = normal
    first = np.array([0.0, -z, y] if abs(z) > 0.5**0.5 else [-y, x, 0.0])
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first), normal])


def darts_axes(normal: Array) -> Array:
    """The same as DART picks them: the first is across the world's z, or across x where z is the normal."""
    first = np.cross(normal, [0.0, 0.0, 1.0])
    if np.linalg.norm(first) < LEAST_ACROSS:
        first = np.cross(normal, [1.0, 0.0, 0.0])
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first), normal])
