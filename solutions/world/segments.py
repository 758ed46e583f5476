"""Segments, as cores of capsules and edges of hulls: where two are nearest."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.world.shapes import Placed


def ends_of(capsule: Placed) -> Array:
    """The ends (n, 2, 3) of the cores of capsules, that at −z first, m.

    Both are the centre for a sphere, which is a capsule without length.
    """
    half = capsule.size[:, 1:2] * capsule.rotation[:, :, 2]
    return np.stack([capsule.position - half, capsule.position + half], axis=1)


def nearest_on_segments(
    start_a: Array, way_a: Array, start_b: Array, way_b: Array
) -> tuple[Array, Array]:
    """The shares of two segments at which they are nearest to each other.

    Parameters
    ----------
    start_a, start_b : (..., 3), one end of each segment, m
    way_a, way_b : (..., 3), from there to its other end, m; may be zero

    Returns
    -------
    share_a, share_b : (...), from 0 to 1
        For parallel segments, one of the places that are equally near.

    Notes
    -----
    Squared, the distance of p + s d from q + t e is a parabola in s for each
    t, and in t for each s. Both derivatives vanish where the lines are
    nearest:

        r = p − q
        s = ((d·e)(e·r) − (e·e)(d·r)) / ((d·d)(e·e) − (d·e)²)

    This s is kept within 0 to 1. The best t for it is (e·(r + s d))/(e·e),
    also kept within 0 to 1. The best s for that t is found in the same way,
    and ends the search (Ericson, *Real-Time Collision Detection*, section
    5.1.9).
    """
    between = start_a - start_b
    aa, bb = np.vecdot(way_a, way_a), np.vecdot(way_b, way_b)
    ab = np.vecdot(way_a, way_b)
    ar, br = np.vecdot(way_a, between), np.vecdot(way_b, between)
    first = _share(ab * br - bb * ar, aa * bb - ab * ab)
    share_b = _share(br + first * ab, bb)
    return _share(share_b * ab - ar, aa), share_b


def _share(part: Array, whole: Array) -> Array:
    """A part of a whole, from 0 to 1; 0 where there is no whole."""
    some = whole > 0
    share = np.clip(part / np.where(some, whole, 1.0), 0.0, 1.0)
    return np.where(some, share, 0.0)
