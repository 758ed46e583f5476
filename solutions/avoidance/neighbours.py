"""All pairs of points within a radius, by a grid of cells (slide 1).

`flock_step` and `crowd_step` find their neighbours with them.
"""

from __future__ import annotations

import math
from itertools import product

import numpy as np

from solutions.arrays import Array, Integers
from solutions.avoidance.domain import Flock, OnePositive
from solutions.domain import domain, require

EPSILON = float(np.finfo(float).eps)
LARGEST = np.iinfo(np.int64).max


@domain
def neighbour_pairs(
    position: Flock, radius: OnePositive
) -> tuple[Integers, Integers]:
    """All pairs of points no further apart than a radius, each once (slide 1).

    The function does not look at all pairs, so it is fast for many points.

    Parameters
    ----------
    position : (n, d), m, d = 2 or 3
    radius : one number, m, positive

    Returns
    -------
    first, second : (pairs,) each, indices
        They are in ascending order, and first < second.

    Raises
    ------
    ValueError
        If there are too many points to number the cells. A million points may
        be spread out in space in any way.

    Notes
    -----
    The function sorts the points into cells that are as wide as the radius.
    The partners of a point then lie in its own cell or in one of the cells
    around it.

    The cells of one row along the last axis are numbered consecutively. So the
    points that a point may meet in three neighbouring cells of a row form one
    stretch of the sorted points. The function looks at only half of the rows
    around a cell. The other half is covered when the cells there look back.
    """
    key, rows_ahead = _cells(position, radius)
    order = np.argsort(key, kind="stable")
    key, p = key[order], position[order]
    next_one = np.arange(1, len(p) + 1)
    stop = np.searchsorted(key, key + 1, "right")
    near = [_near(p, radius, next_one, stop)]
    for ahead in rows_ahead:
        start = np.searchsorted(key, key + ahead - 1)
        stop = np.searchsorted(key, key + ahead + 1, "right")
        near.append(_near(p, radius, start, stop))
    one, other = (
        order[np.concatenate(ends)] for ends in zip(*near, strict=True)
    )
    first, second = np.minimum(one, other), np.maximum(one, other)
    ascending = np.sort(first * len(p) + second)
    return np.divmod(ascending, max(len(p), 1))


def _cells(p: Array, radius: Array) -> tuple[Integers, list[int]]:
    """Number of each point's cell, and the steps to the rows that lie ahead.

    A step is added to the number of a cell, and rows ahead have higher
    numbers. A cell is wider than the radius by the rounding of the farthest
    coordinate, so that two points within the radius never lie two cells apart.
    """
    size = radius + 4 * EPSILON * (radius + np.abs(p).max(initial=0.0))
    place = np.stack([_closed_up(np.floor(axis / size)) for axis in p.T])
    # There is an empty cell at either end, so that no row touches the next.
    width = [int(axis.max(initial=0)) + 2 for axis in place]
    too_many = f"fewer points so widely spread, not {len(p)}"
    require(math.prod(width) <= LARGEST, f"position must have {too_many}")
    stride = [math.prod(width[axis + 1 :]) for axis in range(len(width))]
    around = product((-1, 0, 1), repeat=len(width) - 1)
    ahead = [int(np.dot(rows, stride[:-1])) for rows in around]
    return np.array(stride) @ place, [step for step in ahead if step > 0]


def _closed_up(cell: Array) -> Integers:
    """Number the occupied cells of an axis from 1.

    Any gap between them counts as one empty cell, however wide it is.
    """
    occupied, back = np.unique(cell, return_inverse=True)
    steps = np.minimum(np.diff(occupied, prepend=occupied[:1] - 1), 2)
    return np.cumsum(steps).astype(np.int64)[back]


def _near(
    p: Array, radius: Array, start: Integers, stop: Integers
) -> tuple[Integers, Integers]:
    """Pairs of each point with those from its start to its stop."""
    count = np.maximum(stop - start, 0)
    one = np.repeat(np.arange(len(p)), count)
    other = np.arange(len(one)) + np.repeat(
        start - (np.cumsum(count) - count), count
    )
    near = sum((axis[one] - axis[other]) ** 2 for axis in p.T) <= radius**2
    return one[near], other[near]
