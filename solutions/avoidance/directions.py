"""Lengths and turns of vectors in space and in the plane."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Number, domain
from solutions.vectors import direction


@domain
def limited(value: Number, largest: NotNegative) -> Array:
    """Vectors shortened to a largest length, with their direction kept.

    Parameters
    ----------
    value : (..., d), in any unit
    largest : (...), in the same unit, not negative

    Returns
    -------
    (..., d), in the same unit
        A vector that is not longer than the largest length stays as it is.
    """
    length = np.linalg.norm(value, axis=-1)
    too_long = length > largest
    share = np.where(too_long, largest, 1.0) / np.where(too_long, length, 1.0)
    return value * share[..., None]


def to_the_left(heading: Array) -> Array:
    """Horizontal unit vector to the left of a heading (..., 3).

    It is +x where the heading is vertical or zero.
    """
    x, y = heading[..., 0], heading[..., 1]
    left = direction(np.stack([-y, x, np.zeros_like(x)], axis=-1))
    has_one = np.any(left != 0, axis=-1, keepdims=True)
    return np.where(has_one, left, np.array([1.0, 0.0, 0.0]))


def turned_left(vectors: Array) -> Array:
    """Vectors (..., 2), turned left by a quarter turn."""
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([-y, x], axis=-1)
