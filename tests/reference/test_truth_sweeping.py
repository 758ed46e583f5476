"""Closed forms of what a test at the ends of steps misses, against chance."""

from __future__ import annotations

import numpy as np
import pytest

from reference import sweeping_truth

DRAWN = 400_000
NEAR = 4 * 0.5 / DRAWN**0.5
"""Four standard deviations of a share among so many, at most."""


def drawn(way: float, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Half the chord, and how far behind its start the first step ends: places drawn in a disc, and phases."""
    chance = np.random.default_rng(9)
    places = chance.uniform(-reach, reach, (2, 2 * DRAWN))
    offsets = np.linalg.norm(places, axis=0)
    offsets = offsets[offsets < reach][:DRAWN]
    return np.sqrt(reach**2 - offsets**2), way * chance.uniform(size=DRAWN)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 1.7, 2.0, 3.5, 12.0])
def test_the_share_of_missed_balls_is_that_of_balls_drawn_by_chance(ratio):
    half, first = drawn(0.3 * ratio, 0.3)
    assert sweeping_truth.missed_balls(0.3 * ratio, 0.3) == pytest.approx(np.mean(first > 2 * half), abs=NEAR)
    assert sweeping_truth.unturned_balls(0.3 * ratio, 0.3) == pytest.approx(np.mean(first > half), abs=NEAR)


def test_the_impulse_of_a_meeting_restores_e_times_the_approach():
    mass, other, speed, offset, e = 0.03, 0.012, 40.0, 0.6, 0.5
    impulse = sweeping_truth.impulse_of_a_meeting(speed, offset, e, mass, other)
    closing = 0.8 * speed  # cos α for sin α = 0.6
    parting = impulse / mass + impulse / other - closing
    assert parting == pytest.approx(e * closing)
