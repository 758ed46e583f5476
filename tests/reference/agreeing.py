"""When a number or a curve that is measured now is the one that was recorded."""

from __future__ import annotations

import math

import numpy as np

from reference.comparison.curves import NEAR, Series
from reference.comparison.verdicts import Row

IN_ANY_ORDER = 5e-3
"""How near the way of a box that tips must be in DART, where nothing is judged by it. DART's solver meets contacts in
the order of their addresses in memory, and the way was seen to differ by 0.07 % from run to run."""


def same(now: Row, then: Row) -> None:
    assert (now.case, now.quantity) == (then.case, then.quantity)
    if now.measured is None or then.measured is None:
        assert (now.measured, now.verdict) == (then.measured, then.verdict)
        return
    # Another processor rounds differently, and thousands of steps add that up: far below what is judged by.
    ways_of_dart = (then.family, then.engine, str(then.verdict)) == ("tipping-box", "dart", "shown")
    share = IN_ANY_ORDER if ways_of_dart else 1e-6
    near = max(share * abs(then.measured), 0.01 * (then.tolerance or 0.0), 1e-9)
    assert math.isclose(now.measured, then.measured, rel_tol=0, abs_tol=near), (now.case, now.quantity)
    # A way that is a t dt/2 long is, at a timestep of t/1000, off by just the 0.1 % that are accepted.
    on_edge = then.tolerance and math.isclose(abs(then.error), then.tolerance, rel_tol=1e-6)
    assert now.verdict == then.verdict or on_edge, (now.case, now.quantity)


def same_curve(now: Series, then: Series) -> None:
    """Both are thinned, and rounding may keep other points: each is near what it was thinned from."""
    assert (now.times[0], now.times[-1]) == (then.times[0], then.times[-1])
    drawn = np.interp(now.times, then.times, then.values)
    # Thinning moves either by a share of the range; where a contact chatters, rounding to seven digits is added.
    np.testing.assert_allclose(drawn, now.values, atol=2 * NEAR * np.ptp(now.values) + 1e-6, rtol=0)
