"""The rounds of conservative advancement, for many pairs at once (slide 10).

A `Look` says what moves, and how: whole bodies or single features.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.vectors import quotient

Pairs = Integers
Look = Callable[[Pairs, Array], tuple[Array, Array]]
"""A function of the numbers of some pairs, and of a time for each of them.

It returns how far each pair is apart at least, m. It also returns for how long
the pair surely stays at least half the tolerance apart, s.
"""
TOLERANCE = 1e-6
"""Distance at which bodies count as touching, a share of the smaller one."""


class UndecidedWarning(UserWarning):
    """Nobody knows whether these bodies touch: the rounds are used up."""


def free_time(separation: Array, closing: Array) -> Array:
    """Time until a separation that shrinks at most this fast is used up.

    It is infinity if the separation does not shrink.
    """
    return quotient(separation, np.maximum(closing, 0.0), np.inf)


def advance_all(
    look: Look,
    dt: Array,
    tolerance: Array,
    began: Array,
    rounds: int,
    pairs: Pairs | None = None,
) -> tuple[Array, Booleans]:
    """Advance from look to look until the pair touches or the step is over.

    The pairs surely stay apart until the times that are returned. They touch
    then, unless the rounds were too few for a pair. The second array says
    which pairs these are. Without the numbers of some pairs, all of them
    advance.
    """
    time, undecided = began.copy(), np.zeros(dt.shape, dtype=bool)
    pairs = np.arange(dt.size) if pairs is None else pairs
    for _ in range(rounds):
        separation, free = look(pairs, time[pairs])
        apart = separation > tolerance[pairs]
        pairs, free = pairs[apart], free[apart]
        time[pairs] += free
        over = time[pairs] > dt[pairs]
        time[pairs[over]] = np.inf
        pairs = pairs[~over]
        if not pairs.size:
            break
    undecided[pairs] = True
    return time, undecided


def or_undecided(time: Array, undecided: Booleans) -> Array:
    """Return the times, with NaN and a warning where a pair is undecided."""
    if undecided.any():
        warnings.warn(
            f"{undecided.sum()} of {time.size} pairs are undecided: they stay "
            f"apart until {time[undecided][0]:.6g}. "
            "Then the rounds are used up, because the bodies move or turn so "
            "fast and so near to each other. "
            "A shorter step from there on, or a larger tolerance, may decide",
            UndecidedWarning,
            stacklevel=4,  # above the check of the arguments
        )
    return np.where(undecided, np.nan, time)


def touching(
    tolerance: Array | None,
    shape: tuple[int, ...],
    size_a: Array,
    size_b: Array,
    apart: Array,
) -> Array:
    """Distances (N,) at which two bodies count as touching, m.

    Without a tolerance, they are a share of the smaller body. A point has no
    size, and then the other body counts; for two points, it is how far they
    are apart at first.
    """
    if tolerance is not None:
        return flat(tolerance, shape)
    smaller, larger = np.minimum(size_a, size_b), np.maximum(size_a, size_b)
    size = np.where(size_a * size_b > 0, smaller, larger)
    return TOLERANCE * np.where(size > 0, size, apart)


def flat(
    value: Array, shape: tuple[int, ...], core: tuple[int, ...] = ()
) -> Array:
    """Broadcast over the leading axes and lay these in one row."""
    return np.broadcast_to(value, shape + core).reshape(-1, *core)
