"""Vectors of the world's contacts."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array


def cross(a: Array, b: Array) -> Array:
    """Cross product of vectors (..., 3).

    `numpy.cross` gives the same. It prepares for vectors of two components and for any
    axis, which takes four times as long as the product of a few vectors itself.
    """
    x, y, z = a[..., 0], a[..., 1], a[..., 2]
    u, v, w = b[..., 0], b[..., 1], b[..., 2]
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u], axis=-1)


def tangents(normal: Array) -> tuple[Array, Array]:
    """Two unit vectors at right angles to a normal and to each other, (..., 3) each.

    The second is the normal times the first, so that the three are right-handed.
    """
    across = cross(normal, np.eye(3)[np.argmin(np.abs(normal), axis=-1)])
    first = across / np.sqrt(np.vecdot(across, across))[..., None]
    return first, cross(normal, first)
