"""Vectors of the world's contacts."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array


def cross(a: Array, b: Array) -> Array:
    """Cross product of vectors (..., 3).

    `numpy.cross` gives the same. It prepares for vectors of two components and
    for any axis, which takes four times as long as the product of a few
    vectors itself.
    """
    product = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.subtract(
            a[..., j] * b[..., k], a[..., k] * b[..., j], out=product[..., i]
        )
    return product


def tangents(normal: Array) -> tuple[Array, Array]:
    """Two unit vectors at right angles to a normal and each other, (..., 3).

    The second is the normal times the first, so that the three are
    right-handed.
    """
    across = cross(normal, np.eye(3)[np.argmin(np.abs(normal), axis=-1)])
    first = across / np.sqrt(np.vecdot(across, across))[..., None]
    return first, cross(normal, first)
