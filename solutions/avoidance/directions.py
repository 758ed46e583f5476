"""Vectors in space and in the plane: what may enter, their directions and lengths."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, vector

Array = NDArray[np.float64]


def in_space(name: str, value: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse other shapes, infinity and NaN."""
    return finite(name, vector(name, value))


def in_plane(name: str, value: ArrayLike) -> Array:
    """Return vectors (..., 2); refuse other shapes, infinity and NaN."""
    array = np.asarray(value, dtype=float)
    if array.shape[-1:] != (2,):
        raise ValueError(f"{name} must have shape (..., 2), not {array.shape}")
    return finite(name, array)


def unit_or_zero(value: ArrayLike) -> Array:
    """Return the direction of vectors (..., d): length 1, or zero where the vector is zero and has none."""
    v = np.asarray(value, dtype=float)
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.asarray(v / np.where(length > 0, length, 1.0))


def limited(value: ArrayLike, largest: ArrayLike) -> Array:
    """Shorten vectors to a largest length and keep their direction; shorter ones stay as they are.

    Parameters
    ----------
    value : (..., d), in any unit
    largest : (...), in the same unit, not negative

    Returns
    -------
    (..., d)

    Raises
    ------
    ValueError
        If a largest length is negative.
    """
    v, largest = np.asarray(value, dtype=float), not_negative("largest", largest)
    length = np.linalg.norm(v, axis=-1)
    too_long = length > largest
    share = np.where(too_long, largest, 1.0) / np.where(too_long, length, 1.0)
    return np.asarray(v * share[..., None])


def to_the_left(direction: ArrayLike) -> Array:
    """Return the horizontal unit vector to the left of a direction (..., 3); x where that is vertical or zero."""
    d = np.asarray(direction, dtype=float)
    left = unit_or_zero(np.stack([-d[..., 1], d[..., 0], np.zeros(d.shape[:-1])], axis=-1))
    has_one = np.any(left != 0, axis=-1, keepdims=True)
    return np.where(has_one, left, np.array([1.0, 0.0, 0.0]))


def turned_left(value: ArrayLike) -> Array:
    """Return vectors (..., 2) of the plane turned by a quarter to the left: (x, y) → (−y, x)."""
    v = np.asarray(value, dtype=float)
    return np.stack([-v[..., 1], v[..., 0]], axis=-1)
