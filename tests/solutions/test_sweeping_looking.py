"""What one look per step misses, and looks that miss nothing (slide 10)."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.sweeping import advance, missed_share, sweep_convex

ROD = np.array([[-1.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.0, 0.05, 0.02]])
WEDGE = np.array([[0.3, 0.9, -1.0], [0.3, 0.9, 1.0], [2.0, 2.0, 0.0]])
PLACE = np.zeros(3)


@pytest.mark.parametrize("way", [0.4, 0.7, 1.3, 1.4, 1.5, 6.0])
def test_missed_share_is_the_mean_over_random_offsets(way: float) -> None:
    radius = 0.7
    offsets = radius * np.sqrt((np.arange(200_000) + 0.5) / 200_000)  # equal areas of the disk
    missed = np.maximum(0.0, 1 - 2 * np.sqrt(radius**2 - offsets**2) / way)
    assert missed_share(way / 0.1, 0.3, 0.4, 0.1) == pytest.approx(missed.mean(), abs=1e-5)


def test_nothing_that_rests_is_missed_and_points_always_are() -> None:
    np.testing.assert_array_equal(missed_share([0, 2, 2, 0], [0.1, 0.1, 0, 0], 0.0, [1, 0, 1, 1]), [0, 0, 1, 0])


@pytest.mark.parametrize("turn", [(0.0, 0.0, 3.0), (1.0, 2.0, 3.0)])
@pytest.mark.parametrize("velocity", [(0.2, 0.1, 0.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0)])
def test_advance_agrees_with_the_sweep_of_convex_bodies(turn: tuple[float, ...], velocity: tuple[float, ...]) -> None:
    time, _ = advance(ROD, PLACE, velocity, turn, WEDGE, 1.0, 1e-6, 500)
    other = sweep_convex(ROD, PLACE, velocity, turn, 0.0, WEDGE, PLACE, PLACE, PLACE, 0.0, 1.0, 1e-9)
    assert time == pytest.approx(float(other), abs=1e-5)
    assert time <= other


def test_looks_are_counted_and_run_out() -> None:
    time, used = advance(ROD, PLACE, (0.2, 0.1, 0.0), (0.0, 0.0, 3.0), WEDGE, 1.0, 1e-6, 500)
    assert advance(ROD, PLACE, (0.2, 0.1, 0.0), (0.0, 0.0, 3.0), WEDGE, 1.0, 1e-6, used) == (time, used)
    early = advance(ROD, PLACE, (0.2, 0.1, 0.0), (0.0, 0.0, 3.0), WEDGE, 1.0, 1e-6, used - 1)
    assert np.isnan(early[0])
    assert early[1] == used - 1


def test_hulls_that_overlap_touch_now() -> None:
    crossing = np.array([[0.1, -1.0, 0.0], [0.1, 1.0, -0.1], [0.2, 1.0, 0.3]])
    assert advance(ROD, PLACE, (5.0, 0.0, 0.0), PLACE, crossing, 1.0, 1e-6, 3) == (0.0, 1)
