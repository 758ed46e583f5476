"""Vectors in space and in the plane: checks, directions and lengths."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative


def in_plane(name: str, value: ArrayLike) -> Array:
    """Return vectors (..., 2); refuse other shapes, infinity and NaN."""
    array = np.asarray(value, dtype=float)
    if array.shape[-1:] != (2,):
        raise ValueError(f"{name} must have shape (..., 2), not {array.shape}")
    return finite(name, array)


def unit_or_zero(value: ArrayLike) -> Array:
    """Return the directions of vectors (..., d), as vectors of length 1.

    A vector that is zero has no direction, and stays zero.
    """
    v = np.asarray(value, dtype=float)
    length = np.linalg.norm(v, axis=-1)[..., None]
    return np.asarray(v / np.where(length > 0, length, 1.0))


def limited(value: ArrayLike, largest: ArrayLike) -> Array:
    """Vectors shortened to a largest length, with their direction kept.

    Parameters
    ----------
    value : (..., d), in any unit
    largest : (...), in the same unit, not negative

    Returns
    -------
    (..., d), in the same unit
        A vector that is not longer than the largest length stays as it is.

    Raises
    ------
    ValueError
        If a largest length is negative.
    """
    v, largest = (
        np.asarray(value, dtype=float),
        not_negative("largest", largest),
    )
    length = np.linalg.norm(v, axis=-1)
    too_long = length > largest
    share = np.where(too_long, largest, 1.0) / np.where(too_long, length, 1.0)
    return np.asarray(v * share[..., None])


def to_the_left(direction: ArrayLike) -> Array:
    """Return the horizontal unit vector to the left of a direction (..., 3).

    It is +x where the direction is vertical or zero.
    """
    d = np.asarray(direction, dtype=float)
    left = unit_or_zero(
        np.stack([-d[..., 1], d[..., 0], np.zeros(d.shape[:-1])], axis=-1)
    )
    has_one = np.any(left != 0, axis=-1, keepdims=True)
    return np.where(has_one, left, np.array([1.0, 0.0, 0.0]))


def turned_left(value: ArrayLike) -> Array:
    """Return vectors (..., 2), turned left by a quarter turn."""
    v = np.asarray(value, dtype=float)
    return np.stack([-v[..., 1], v[..., 0]], axis=-1)
