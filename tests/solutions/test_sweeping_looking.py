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


def test_a_short_way_past_small_balls_is_longer_than_every_chord() -> None:
    assert missed_share(0.5, 0.05, 0.05, 1.0) == pytest.approx(1 - 4 * 0.1 / (3 * 0.5))


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("wrong", [-1.0, np.inf, np.nan])
def test_a_speed_radius_or_time_that_is_none_has_no_share(place: int, wrong: float) -> None:
    given = [1.0, 0.1, 0.1, 0.1]
    given[place] = wrong
    with pytest.raises(ValueError, match="must be"):
        missed_share(*given)


def test_what_is_exactly_the_tolerance_apart_touches_also_at_the_very_end() -> None:
    point, falls = np.zeros((1, 3)), (0.0, -0.5, 0.0)
    assert advance(point, (0.0, 2.25, 0.0), falls, PLACE, [[0.0, 2.0, 0.0]], 1.0, 0.25, 9) == (0.0, 1)
    assert advance(point, (0.0, 1.0, 0.0), falls, PLACE, point, 2.0, 0.25, 9) == (2.0, 2)
    assert advance(point, (0.0, 1.0, 0.0), falls, PLACE, point, 1.999, 0.25, 9) == (np.inf, 1)


@pytest.mark.parametrize(
    ("place", "wrong", "words"),
    [
        (0, np.zeros((2, 3, 3)), "points_a must have shape"),
        (0, np.zeros((0, 3)), "points_a must have shape"),
        (1, (0.0, np.nan, 0.0), "position_a must be finite"),
        (2, np.zeros((4, 3)), "velocity_a must have shape"),
        (5, -1.0, "dt must be zero or positive"),
        (5, np.inf, "dt must be finite"),
        (6, 0.0, "tolerance must be positive"),
        (7, 0, "looks must be positive"),
        (7, 2.5, "looks must be a whole number"),
        (7, np.inf, "looks must be finite"),
    ],
)
def test_advance_refuses_what_is_no_pair_of_hulls_or_no_step(place: int, wrong: object, words: str) -> None:
    given = [ROD, PLACE, (0.2, 0.1, 0.0), (0.0, 0.0, 3.0), WEDGE, 1.0, 1e-6, 500]
    given[place] = wrong
    with pytest.raises(ValueError, match=words):
        advance(*given)  # type: ignore[arg-type]
