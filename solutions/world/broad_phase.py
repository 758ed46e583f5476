"""The broad phase: which boxes along the axes overlap (slide 2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.domain import Number, domain

FEW = 32
"""So few boxes need no grid: it takes less time to compare them all."""
SMALLEST = -3.0
"""Boxes narrower than 2⁻³ of the usual width count as being of this size."""
FARTHEST = 2**18
"""So far from the middle columns are counted; all beyond are in the last."""
ACROSS = 2 * FARTHEST + 3
"""Columns in a line across the grid, with an empty one at either end."""
SPARE = 1e-6
"""By what share a column is wider than the widest box."""
AROUND = np.array([[x * ACROSS + y] for x in (-1, 0, 1) for y in (-1, 0, 1)])
"""Steps from the number of a column to the nine in and around it."""


@domain
def pairs_in_grid(
    lower: Number, upper: Number, group: ArrayLike | None = None
) -> Integers:
    """All pairs of boxes along the axes that overlap, each once.

    This is the broad phase. It does not look at all pairs, so it is fast for
    many boxes. Bodies whose boxes do not overlap cannot touch, so the narrow
    phase looks at these pairs alone.

    Parameters
    ----------
    lower, upper : (n, 3), opposite corners of the boxes, m
        A box may have no end, as that of a half-space: its corners are
        infinite there.
    group : (n,), integers, optional
        Only boxes of the same group are compared. So many scenes that do not
        know of one another are searched at once.

    Returns
    -------
    pairs : (p, 2), numbers of two boxes, the smaller number first
        The pairs are in ascending order. Boxes that touch overlap.

    Raises
    ------
    ValueError
        If a coordinate is NaN, a lower corner is above an upper one, both are
        the same infinity, or the arrays do not fit.

    Notes
    -----
    Seen from above, the boxes stand in the square columns of a grid. No box is
    wider than a column, and each box belongs to the column in which its lower
    corner lies. So two boxes that overlap belong to the same column or to two
    columns that are next to each other, across a corner included.

    All boxes are sorted by the height at which they begin. If two boxes
    overlap, one of them begins between the bottom and the top of the other. So
    each box looks into nine columns, its own and the eight around it, for the
    boxes that begin above its own bottom and not above its own top. In each
    sorted column these boxes follow one another, and two binary searches find
    the first and the last of them. They overlap the box in height; the other
    two axes remain to be compared. Every pair is found once, by the box that
    begins lower.

    One grid does not serve boxes of very different sizes: in columns as wide
    as the largest, a small box would look at too many others. So there is a
    grid for each size: the usual width, twice as much, four times as much and
    so on. In the grid of its own size, a box is compared with the boxes of
    that size and with all smaller ones. The grid for boxes without end is a
    single column.

    Sorting n boxes and searching among them takes a time that grows like n log
    n. The rest grows like the number of boxes that are looked at. That is
    proportional to n, as long as no place becomes more crowded.
    """
    _refuse_inside_out(lower, upper)
    if len(lower) <= FEW:
        return _each_with_each(lower, upper, _named(group, len(lower)))
    scene, is_small = _scenes(group, len(lower))
    # From here on the boxes are sorted and numbered by the height at which
    # they begin.
    order = np.argsort(lower[:, 2])
    low, high, scene = lower[order], upper[order], scene[order]
    end = np.searchsorted(low[:, 2], high[:, 2], "right")
    width = np.where(is_small[order], np.inf, _width(low, high))
    size = _size(width)
    pairs = [np.empty((2, 0), dtype=np.int64)]
    for this in np.unique(size):
        box = np.flatnonzero(size <= this)
        widest = float(width[size == this].max())
        column, around = _columns(low[box, :2], scene[box], widest)
        # Sorted by column, and by height in each.
        column, box = np.divmod(np.sort(column * len(low) + box), len(low))
        own, smaller = size[box] == this, size[box] < this
        columns = around[:, column]
        # Boxes of this size look among all, smaller ones among those of it.
        for looking, others in ((own, own | smaller), (smaller, own)):
            pairs.append(
                _beginning_within(
                    box[looking],
                    columns[:, looking],
                    box[others],
                    column[others],
                    end,
                )
            )
    one, other = np.concatenate(pairs, axis=1)
    for axis in (0, 1):
        first = low[:, axis].copy()
        last = high[:, axis].copy()
        overlap = (first[one] <= last[other]) & (first[other] <= last[one])
        one, other = one[overlap], other[overlap]
    return _ascending(order[one], order[other], len(low))


def _refuse_inside_out(low: Array, high: Array) -> None:
    """Refuse corners (n, 3) that are not the lower and the upper of boxes."""
    if low.shape != high.shape or low.shape[1:] != (3,):
        raise ValueError(
            "lower and upper must both have the shape (n, 3), not"
            f" {low.shape} and {high.shape}"
        )
    with np.errstate(over="ignore", invalid="ignore"):
        wrong = ~np.all(high - low >= 0, axis=1)  # true for NaN
    if np.any(wrong):
        raise ValueError(
            f"lower must not be above upper, not {low[wrong][0]} and"
            f" {high[wrong][0]}"
        )


def _named(group: ArrayLike | None, count: int) -> Integers:
    """The group of each box; 0 where none is given."""
    if group is None:
        return np.zeros(count, dtype=np.int64)
    named = np.asarray(group)
    if named.shape != (count,):
        raise ValueError(
            f"group must have the shape ({count},), not {named.shape}"
        )
    return named


def _each_with_each(low: Array, high: Array, group: Integers) -> Integers:
    """All pairs that overlap: every box is compared with every other."""
    overlap = np.all(low[:, None] <= high, axis=-1) & (group[:, None] == group)
    return np.argwhere(np.triu(overlap & overlap.T, 1))


def _scenes(group: ArrayLike | None, count: int) -> tuple[Integers, Booleans]:
    """Number of each box's group, from 0, and whether that has few boxes."""
    named = _named(group, count)
    _, scene, members = np.unique(
        named, return_inverse=True, return_counts=True
    )
    return scene, members[scene] <= FEW


def _width(low: Array, high: Array) -> Array:
    """The larger of the two horizontal edges, m."""
    with np.errstate(over="ignore"):
        return np.maximum(high[:, 0] - low[:, 0], high[:, 1] - low[:, 1])


def _size(width: Array) -> Array:
    """How often the usual width is doubled to give this one, rounded."""
    ordinary = width[(width > 0) & (width < np.inf)]
    usual = np.median(ordinary) if ordinary.size else 1.0
    with np.errstate(divide="ignore"):
        doublings = np.round(np.log2(width) - np.log2(usual))
    return np.maximum(doublings, SMALLEST)


def _columns(
    corner: Array, scene: Integers, widest: float
) -> tuple[Integers, Integers]:
    """Sort boxes into columns; those of different groups are never neighbours.

    Rounding errors are smaller than the spare part of a column, so they do not
    separate boxes that overlap by two columns.

    Returns
    -------
    column : (n,), number of each box's column
        Only columns with boxes are numbered.
    around : (k, columns), k ≤ 9, numbers of the columns in and around each one
        A column without a box has the first number that is free.
    """
    cell = np.zeros(corner.shape, dtype=np.int64)
    if widest < np.inf:
        with np.errstate(over="ignore"):
            from_middle = corner - np.median(corner, axis=0)
            steps = from_middle / ((1 + SPARE) * (widest or 1.0))
        cell = np.floor(np.clip(steps, -FARTHEST, FARTHEST)).astype(np.int64)
    number = (scene * ACROSS + cell[:, 0]) * ACROSS + cell[:, 1]
    occupied, column = np.unique(number, return_inverse=True)
    nine = occupied + AROUND
    around = np.minimum(np.searchsorted(occupied, nine), len(occupied) - 1)
    around = np.where(occupied[around] == nine, around, len(occupied))
    return column, around[np.any(around < len(occupied), axis=1)]


def _beginning_within(
    one: Integers,
    around: Integers,
    other: Integers,
    column: Integers,
    end: Integers,
) -> Integers:
    """Pairs (2, p) of one box and another that begins within its height.

    Parameters
    ----------
    one : (m,), numbers of the boxes that look
    around : (k, m), the columns into which each of them looks
    other : (l,), numbers of the boxes among which they look
        Sorted by column, and by height in each.
    column : (l,), that of each other box
    end : (n,), of every box the number of the first that begins above its top
    """
    count = len(end)
    queue = column * count + other
    start = np.searchsorted(queue, around * count + one, "right").ravel()
    stop = np.searchsorted(queue, around * count + end[one]).ravel()
    length = stop - start
    looking = np.repeat(np.tile(one, len(around)), length)
    ahead = np.cumsum(length) - length
    place = np.arange(len(looking)) + np.repeat(start - ahead, length)
    return np.stack([looking, other[place]])


def _ascending(one: Integers, other: Integers, count: int) -> Integers:
    """Pairs (p, 2), in each the smaller number first, sorted."""
    pairs = np.sort(np.minimum(one, other) * count + np.maximum(one, other))
    return np.stack(np.divmod(pairs, count), axis=1)
