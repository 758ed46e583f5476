"""Segments clipped on the sides of a face, seen along its normal."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.vectors import cross

ON_SIDE = 1e-6
"""Share of a hull's size up to which a point is on a side of a face.

Boxes of the same size, one exactly on the other, touch at the four corners of
their faces. Rounding must neither lose one of these nor cut it off twice.
"""


def behind_sides(points: Array, corners: Array, normal: Array) -> Array:
    """How far points are behind the sides of a face, as seen along its normal.

    Parameters
    ----------
    points : (..., p, 3), m
    corners : (..., s, 3), counterclockwise about the normal, m
    normal : (..., 3), unit

    Returns
    -------
    (..., p, s), m
        Positive inside. It is 0 for a side without length, or one that is seen
        from its end.

    Notes
    -----
    The cross product of the normal and a side points into the face.
    """
    sides = np.roll(corners, -1, axis=-2) - corners
    inward = cross(normal[..., None, :], sides)
    length = np.sqrt(np.vecdot(inward, inward))[..., None]
    inward = np.divide(
        inward, length, out=np.zeros_like(inward), where=length > 0
    )
    return points @ inward.mT - np.vecdot(inward, corners)[..., None, :]


class Part(NamedTuple):
    """The part of a segment that is behind all sides of a face.

    Attributes
    ----------
    inside : (...), whether there is such a part
    entry, leaving : (...), 0 to 1
        The shares of the segment at which the part begins and ends.
    cut_in, cut_out : (...), whether a side cuts the segment there
    entry_side, leaving_side : (...), which side does so
    """

    inside: Booleans
    entry: Array
    leaving: Array
    cut_in: Booleans
    cut_out: Booleans
    entry_side: Integers
    leaving_side: Integers


def clip(start: Array, end: Array, on: Array) -> Part:
    """The part of a segment behind all sides, by the method of Cyrus and Beck.

    Parameters
    ----------
    start, end : (..., s), m
        How far the ends of the segment are behind each side.
    on : (...), how far in front of a side an end still counts as on it, m

    Returns
    -------
    Part
        A side on which both ends are does not cut the segment.

    Notes
    -----
    Along the segment, the distance behind a side changes evenly from `start`
    to `end`. It is 0 at the share start/(start − end). If the start is in
    front of the side, the part inside begins there; if the end is, the part
    inside ends there. Of all sides, the last beginning and the first end
    count. Which these are, and whether any part is left between them, is
    decided with all sides moved outwards by `on`.
    """
    near = on[..., None]
    before, after = start < -near, end < -near
    change = np.where(before != after, start - end, 1.0)
    moved = (start + near) / change
    true = np.clip(start / change, 0.0, 1.0)
    entries = np.where(before, np.where(after, np.inf, moved), 0.0)
    leavings = np.where(after & ~before, moved, 1.0)
    entry_side = np.argmax(entries, axis=-1)
    leaving_side = np.argmin(leavings, axis=-1)
    entry, leaving = _at(entries, entry_side), _at(leavings, leaving_side)
    inside = entry <= leaving
    cut_in, cut_out = entry > 0, leaving < 1
    entry = np.where(cut_in, np.minimum(_at(true, entry_side), leaving), 0.0)
    leaving = np.where(cut_out, _at(true, leaving_side), 1.0)
    return Part(
        inside, entry, leaving, cut_in, cut_out, entry_side, leaving_side
    )


def _at(values: Array, side: Integers) -> Array:
    """The value of one side of each segment."""
    return np.take_along_axis(values, side[..., None], axis=-1)[..., 0]
