"""Checks of arguments: each returns a float array or raises ValueError.

The message of the error names the argument and the first value that is wrong.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans

UNIT_TOLERANCE = 1e-6
"""How far the length of a unit vector may be from 1.

Unit vectors in single precision pass; others do not.
"""


def positive(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse zero, negative numbers and NaN.

    Infinity passes, because it is the mass of an immovable body.
    """
    array = real(name, value)
    return _only(name, array, array > 0, "positive")


def not_negative(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse negative numbers and NaN. Infinity passes."""
    array = real(name, value)
    return _only(name, array, array >= 0, "zero or positive")


def whole(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse NaN, fractions and bools. Infinity passes."""
    array = real(name, value)
    if np.asarray(value).dtype == bool:
        raise ValueError(f"{name} must be a whole number, not {value!r}")
    return _only(name, array, array == np.floor(array), "a whole number")


def in_unit_interval(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse NaN and what is not from 0 to 1."""
    return between(name, value, 0, 1)


def between(name: str, value: ArrayLike, least: float, most: float) -> Array:
    """Return the value; refuse NaN and what is not from least to most."""
    array = real(name, value)
    inside = (array >= least) & (array <= most)
    return _only(name, array, inside, f"from {least:g} to {most:g}")


def finite(name: str, value: ArrayLike) -> Array:
    """Return the value; refuse infinity and NaN."""
    array = real(name, value)
    return _only(name, array, np.isfinite(array), "finite")


def vector(name: str, value: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse a last axis of another length."""
    array = real(name, value)
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
        shape = array.shape
        raise ValueError(f"{name} must have shape (..., 3, 3), not {shape}")
    return array


def unit(name: str, vector: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse every vector whose length is not 1."""
    array = real(name, vector)
    length = np.sqrt(np.vecdot(array, array))
    wrong = ~(np.abs(length - 1) <= UNIT_TOLERANCE)  # true for NaN
    if np.any(wrong):
        found = length[wrong][0]
        raise ValueError(f"{name} must have length 1, not {found:g}")
    return array


def not_zero(name: str, vector: ArrayLike) -> Array:
    """Return vectors (..., 3); refuse a vector without a direction."""
    array = real(name, vector)
    if np.any(np.linalg.norm(array, axis=-1) == 0):
        raise ValueError(f"{name} is zero: it has no direction")
    return array


def of_shape(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Array:
    """Return an own array of this shape, into which the value is spread."""
    array = real(name, value)
    try:
        return np.array(np.broadcast_to(array, shape))
    except ValueError:
        raise ValueError(
            f"{name} must have the shape {shape}, or one that fits it, not"
            f" {array.shape}"
        ) from None


def with_shape(*form: object) -> Callable[[str, ArrayLike], Array]:
    """A check that returns arrays of one shape, and refuses others.

    The shape is written as in a docstring, such as `..., 2` or `"n", 3`. A
    name, such as "n", is any length.
    """
    words = ", ".join("..." if part is ... else str(part) for part in form)
    words += "," * (len(form) == 1)
    axes = [part for part in form if part is not ...]

    def check(name: str, value: ArrayLike) -> Array:
        array = real(name, value)
        last = array.shape[-len(axes) :] if ... in form else array.shape
        fits = len(last) == len(axes) and all(
            isinstance(axis, str) or axis == length
            for axis, length in zip(axes, last, strict=True)
        )
        if not fits:
            shape = array.shape
            raise ValueError(f"{name} must have shape ({words}), not {shape}")
        return array

    return check


def truth(name: str, value: ArrayLike) -> Booleans:
    """Return the value as True and False."""
    return np.asarray(value, dtype=bool)


def real(name: str, value: ArrayLike) -> Array:
    """Return the value as floats; refuse complex numbers and no numbers."""
    if isinstance(value, np.ndarray) and value.dtype == np.float64:
        return value
    try:
        array = np.asarray(value)
        if array.dtype.kind != "c":
            return array.astype(float, copy=False)
    except (TypeError, ValueError):
        pass
    raise ValueError(f"{name} must be real numbers, not {value!r:.60}")


def _only(name: str, array: Array, right: Booleans, words: str) -> Array:
    if not right.all():
        wrong = array[~right][0]
        raise ValueError(f"{name} must be {words}, not {wrong:g}")
    return array
