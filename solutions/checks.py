"""Checks of arguments: each returns its argument as a float array or raises ValueError.

The message of the error names the argument and the first value that is wrong.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array

UNIT_TOLERANCE = 1e-6
"""How far the length of a unit vector may be from 1.

Unit vectors in single precision pass; a vector that nobody normalised does not.
"""


def positive(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse zero, negative numbers and NaN.

    Infinity passes, because it is the mass of an immovable body.
    """
    return _where(name, value, lambda array: array > 0, "positive")


def not_negative(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse negative numbers and NaN. Infinity passes."""
    return _where(name, value, lambda array: array >= 0, "zero or positive")


def whole(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse NaN and what is no whole number. Infinity passes."""
    return _where(name, value, lambda array: array == np.floor(array), "a whole number")


def in_unit_interval(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse NaN and every number that is not from 0 to 1."""
    return _where(name, value, lambda array: (array >= 0) & (array <= 1), "from 0 to 1")


def between(name: str, value: ArrayLike, least: float, most: float) -> Array:
    """Return the value; refuse NaN and every number that is not from least to most."""
    return _where(name, value, lambda array: (array >= least) & (array <= most), f"from {least:g} to {most:g}")


def finite(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse infinity and NaN."""
    return _where(name, value, np.isfinite, "finite")


def vector(name: str, value: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse arrays whose last axis does not have length 3."""
    array = np.asarray(value, dtype=float)
    if array.shape[-1:] != (3,):
        raise ValueError(f"{name} must have shape (..., 3), not {array.shape}")
    return array


def in_space(name: str, value: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse other shapes, infinity and NaN."""
    return finite(name, vector(name, value))


def matrix(name: str, value: ArrayLike) -> Array:
    """Return matrices (..., 3, 3); refuse other shapes, infinity and NaN."""
    array = finite(name, value)
    if array.shape[-2:] != (3, 3):
        raise ValueError(f"{name} must have shape (..., 3, 3), not {array.shape}")
    return array


def unit(name: str, vector: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse every vector whose length is not 1."""
    array = np.asarray(vector, dtype=float)
    length = np.linalg.norm(array, axis=-1)
    wrong = ~(np.abs(length - 1) <= UNIT_TOLERANCE)  # true for NaN
    if np.any(wrong):
        raise ValueError(f"{name} must have length 1, not {length[wrong][0]:g}")
    return array


def _where(name: str, value: ArrayLike, holds: Callable[[Array], NDArray[np.bool_]], words: str) -> Array:
    array = np.asarray(value, dtype=float)
    wrong = ~holds(array)
    if np.any(wrong):
        raise ValueError(f"{name} must be {words}, not {array[wrong][0]:g}")
    return array
