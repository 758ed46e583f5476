"""Words for what recurs: directions, parts along a normal, quotients."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array


def direction(vectors: Array) -> Array:
    """Directions (..., d) of vectors, of length 1; zero has none, and is 0."""
    return quotient(vectors, np.linalg.norm(vectors, axis=-1)[..., None])


def part_along(vectors: Array, normal: Array) -> Array:
    """The part (v·n) n of vectors (..., 3) along unit normals."""
    return np.asarray(np.vecdot(vectors, normal)[..., None] * normal)


def part_across(vectors: Array, normal: Array) -> Array:
    """The part v − (v·n) n of vectors (..., 3) that lies in the surface."""
    return vectors - part_along(vectors, normal)


def quotient(
    dividend: Array | float, divisor: Array, otherwise: Array | float = 0.0
) -> Array:
    """dividend/divisor, and a stated value where the divisor is zero."""
    none = np.equal(divisor, 0)
    if not none.any():
        return dividend / divisor
    return np.where(none, otherwise, dividend / np.where(none, 1.0, divisor))
