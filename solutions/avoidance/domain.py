"""What the arguments of the functions about avoidance may be."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import (
    UNIT_TOLERANCE,
    finite,
    not_negative,
    positive,
    unit,
    whole,
    with_shape,
)
from solutions.domain import require


def indices(name: str, value: ArrayLike) -> Integers:
    """Return the indices as an array."""
    return np.asarray(value)


def flat_or_in_space(name: str, value: Array) -> Array:
    """Return points (n, d); refuse a d that is neither 2 nor 3."""
    shapes = f"shape (n, 2) or (n, 3), not {value.shape}"
    require(value.shape[-1] in (2, 3), f"{name} must have {shapes}")
    return value


def unit_or_zero(name: str, value: Array) -> Array:
    """Return vectors (..., d); refuse a length that is neither 1 nor 0."""
    length = np.linalg.norm(value, axis=-1)
    wrong = length[(np.abs(length - 1) > UNIT_TOLERANCE) & (length != 0)]
    words = f"length 1 or 0, not {wrong.max(initial=0.0):g}"
    require(not wrong.size, f"{name} must have {words}")
    return value


OnePositive = Annotated[Array, with_shape(), positive]
"""One positive number."""
OneNotNegative = Annotated[Array, with_shape(), not_negative]
"""One number, not negative."""
Count = Annotated[Array, whole, not_negative]
"""0, 1, 2 … as floats, or infinity."""
Direction = Annotated[Array, unit]
"""(..., d), of length 1."""
Planar = Annotated[Array, with_shape(..., 2), finite]
"""(..., 2), finite: vectors of the plane."""
PlanarNormal = Annotated[Array, with_shape(..., 2), finite, unit_or_zero]
"""(..., 2), of length 1, or zero."""
Crowd = Annotated[Array, with_shape("n", 2), finite]
"""(n, 2), finite."""
Flock = Annotated[Array, with_shape("n", "d"), flat_or_in_space, finite]
"""(n, d), d = 2 or 3, finite."""
Indices = Annotated[Integers, indices]
"""(pairs,), as an index takes them."""
