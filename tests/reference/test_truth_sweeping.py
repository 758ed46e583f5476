"""Closed forms of what a test at the ends of steps misses, against counting."""

from __future__ import annotations

import numpy as np
import pytest

from reference import sweeping_truth

PLACES, TURN = 832_040, 514_229
"""Neighbouring Fibonacci numbers: with multiples of their ratio as phases, places fill offsets and phases evenly."""
NEAR = PLACES ** (-2 / 3)
"""By how much the share of such places in an area with a curved border may be off."""


def spread(way: float, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Half the chord, for offsets spread over a disc, and how far behind its start the first step ends."""
    number = np.arange(PLACES)
    squared = reach**2 * (number + 0.5) / PLACES  # as many offsets within any radius as its disc has of the area
    return np.sqrt(reach**2 - squared), way * (number * TURN % PLACES) / PLACES


@pytest.mark.parametrize("ratio", [0.3, 1.0, 1.7, 2.0, 3.5, 12.0])
def test_the_share_of_missed_balls_is_that_of_balls_at_all_offsets_and_phases(ratio):
    half, first = spread(0.3 * ratio, 0.3)
    assert sweeping_truth.missed_balls(0.3 * ratio, 0.3) == pytest.approx(np.mean(first > 2 * half), abs=NEAR)
    assert sweeping_truth.unturned_balls(0.3 * ratio, 0.3) == pytest.approx(np.mean(first > half), abs=NEAR)


def test_the_impulse_of_a_meeting_restores_e_times_the_approach():
    mass, other, speed, offset, e = 0.03, 0.012, 40.0, 0.6, 0.5
    impulse = sweeping_truth.impulse_of_a_meeting(speed, offset, e, mass, other)
    closing = 0.8 * speed  # cos α for sin α = 0.6
    parting = impulse / mass + impulse / other - closing
    assert parting == pytest.approx(e * closing)
