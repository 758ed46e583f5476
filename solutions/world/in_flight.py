"""Whether two bodies that are apart come to touch in a free flight."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.shapes import TOUCH, Touching

LOOKS = 40
"""How often a gap is looked at; a graze takes 20 from 1 mm to 1e-10 m."""
ANYWHERE = 1e300
"""A margin within which two bodies have their places wherever they are, m."""
NearestPlaces = Callable[[Integers, Array], tuple[Touching, Array]]
"""Where the chosen pairs (k,) are nearest at some instants (k,), in s.

Also how fast the two bodies part at each of these places, in m/s. A pair may
have several places.
"""


def meet_in_flight(
    nearest: NearestPlaces, first: Array, last: Array
) -> tuple[Booleans, Booleans]:
    """Which pairs touch between two instants, and which do not pass by then.

    Parameters
    ----------
    nearest : where some of the pairs are nearest at instants of their own
    first, last : (m,), the instants of each pair, s

    Returns
    -------
    touch, near : (m,) each
        Pairs that are still coming nearer at the last instant are near, and do
        not touch. All others that do not touch pass each other.

    Notes
    -----
    A gap s that closes at the rate u would be zero after s/u. The gap at that
    instant is the next s. The distance of two convex bodies that move straight
    is a convex function of time. So each look comes nearer to the touch, as
    Newton's method does, until the gap is closed or the two part.
    """
    touch, near = np.zeros((2, len(first)), dtype=bool)
    some, now = np.arange(len(first)), first
    for _ in range(LOOKS):
        if not len(some):
            break
        places, rates = nearest(some, now)
        order = np.lexsort((places.separation, places.pair))
        is_first = np.diff(places.pair[order], prepend=-1)
        closest = order[np.flatnonzero(is_first)]
        pair, gap = places.pair[closest], places.separation[closest]
        rate = rates[closest]
        touch[some[pair[gap <= TOUCH]]] = True
        nearer = (gap > TOUCH) & (rate < 0)
        pair, gap, rate = pair[nearer], gap[nearer], rate[nearer]
        some, now = some[pair], now[pair] - gap / rate
        late = now > last[some]
        near[some[late]] = True
        some, now = some[~late], now[~late]
    near[some] = True
    return touch, near
