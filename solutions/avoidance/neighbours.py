"""All pairs of points within a radius, by a grid of cells (slide 1).

Flocks and crowds find their neighbours with it.
"""

from __future__ import annotations

import math
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import finite, positive

EPSILON = float(np.finfo(float).eps)


def neighbour_pairs(
    position: ArrayLike, radius: float
) -> tuple[Integers, Integers]:
    """All pairs of points no further apart than a radius, each once (slide 1).

    The function does not look at all pairs, so it is fast for many points.

    Parameters
    ----------
    position : (n, d), m, d = 2 or 3
    radius : m, positive

    Returns
    -------
    first, second : (pairs,) each, indices with first < second, in ascending
    order

    Raises
    ------
    ValueError
        If positions are not finite or not (n, 2) or (n, 3), if the radius is
        not positive, or if there are too many points to number the cells. A
        million points may be spread out in space in any way.

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
    p, reach = _points(position), float(positive("radius", radius))
    key, rows_ahead = _cells(p, reach)
    order = np.argsort(key, kind="stable")
    key, p = key[order], p[order]
    found = [
        _near(
            p,
            reach,
            np.arange(1, len(p) + 1),
            np.searchsorted(key, key + 1, "right"),
        )
    ]
    for ahead in rows_ahead:
        there = key + ahead
        found.append(
            _near(
                p,
                reach,
                np.searchsorted(key, there - 1),
                np.searchsorted(key, there + 1, "right"),
            )
        )
    one, other = (
        order[np.concatenate(side)] for side in zip(*found, strict=True)
    )
    ascending = np.sort(
        np.minimum(one, other) * len(p) + np.maximum(one, other)
    )
    return np.divmod(ascending, max(len(p), 1))


def _points(position: ArrayLike) -> Array:
    p = np.asarray(position, dtype=float)
    if p.ndim != 2 or p.shape[1] not in (2, 3):
        raise ValueError(
            f"position must have the shape (n, 2) or (n, 3), not {p.shape}"
        )
    return finite("position", p)


def _cells(p: Array, radius: float) -> tuple[Integers, list[int]]:
    """Number of each point's cell, and the steps to the rows that lie ahead.

    A step is added to the number of a cell, and rows ahead have higher
    numbers. A cell is wider than the radius by the rounding of the farthest
    coordinate, so that two points within the radius never lie two cells apart.
    """
    size = radius + 4 * EPSILON * (radius + np.abs(p).max(initial=0.0))
    place = np.stack([_closed_up(np.floor(axis / size)) for axis in p.T])
    # There is an empty cell at either end, so that no row touches the next.
    width = [int(axis.max(initial=0)) + 2 for axis in place]
    if math.prod(width) > np.iinfo(np.int64).max:
        raise ValueError(
            f"position must have fewer points so widely spread, not {len(p)}"
        )
    stride = [math.prod(width[axis + 1 :]) for axis in range(len(width))]
    around = (
        sum(np.multiply(step, stride[:-1]))
        for step in product((-1, 0, 1), repeat=len(width) - 1)
    )
    return np.asarray(stride) @ place, [
        int(ahead) for ahead in around if ahead > 0
    ]


def _closed_up(cell: Array) -> Integers:
    """Number the occupied cells of an axis from 1.

    Any gap between them counts as one empty cell, however wide it is.
    """
    occupied, back = np.unique(cell, return_inverse=True)
    steps = np.minimum(np.diff(occupied, prepend=occupied[:1] - 1), 2)
    return np.asarray(np.cumsum(steps).astype(np.int64)[back])


def _near(
    p: Array, radius: float, start: Integers, stop: Integers
) -> tuple[Integers, Integers]:
    """Pairs of each point with those from its start to its stop."""
    count = np.maximum(stop - start, 0)
    one = np.repeat(np.arange(len(p)), count)
    other = np.arange(len(one)) + np.repeat(
        start - (np.cumsum(count) - count), count
    )
    near = sum((axis[one] - axis[other]) ** 2 for axis in p.T) <= radius**2
    return one[near], other[near]
