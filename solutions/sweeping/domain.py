"""What the arguments of the functions about swept volumes may be."""

from __future__ import annotations

from typing import Annotated

from solutions.arrays import Array
from solutions.checks import (
    finite,
    not_negative,
    positive,
    vector,
    whole,
    with_shape,
)
from solutions.domain import require


def a_point_at_least(name: str, value: Array) -> Array:
    """Return sets of points (..., n, 3); refuse empty ones."""
    words = f"shape (..., n, 3) with a point at least, not {value.shape}"
    require(value.shape[-2] > 0, f"{name} must have {words}")
    return value


Extents = Annotated[Array, vector, not_negative, finite]
"""(..., 3), finite and not negative."""
Looks = Annotated[Array, whole, positive, finite]
"""1, 2, 3 …, as floats."""
OneVector = Annotated[Array, with_shape(3), finite]
"""(3,), finite."""
OneHull = Annotated[Array, with_shape("n", 3), finite, a_point_at_least]
"""(n, 3), finite, a point at least."""
Points = Annotated[Array, with_shape(..., "n", 3), finite, a_point_at_least]
"""(..., n, 3), finite, a point at least."""
Edge = Annotated[Array, with_shape(..., 2, 3), finite]
"""(..., 2, 3), finite."""
Triangle = Annotated[Array, with_shape(..., 3, 3), finite]
"""(..., 3, 3), finite."""
