"""Curves: thinned without being moved, and the same again after they were packed."""

from __future__ import annotations

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison.curves import MOST_POINTS, NEAR, VALUE_DECIMALS, Series, corners, pack, unpack
from reference.engines import load_engine

TIMES = np.linspace(0.0, 2.0, 2001)


@pytest.mark.parametrize(
    "values",
    [
        np.abs(np.cos(5 * TIMES)) * np.exp(-TIMES),  # bounces
        np.where(TIMES < 0.7, 1.0, -0.5),  # an impact
        9.81 * TIMES**2,
        3 - 2 * TIMES,
        np.full_like(TIMES, 4.0),
    ],
    ids=["bounces", "impact", "fall", "way", "rest"],
)
def test_no_value_is_moved_by_more_than_a_share_of_the_range(values):
    kept = corners(TIMES, values)
    drawn = np.interp(TIMES, TIMES[kept], values[kept])
    assert np.abs(drawn - values).max() <= NEAR * np.ptp(values) + 1e-12
    assert (kept[0], kept[-1]) == (0, len(TIMES) - 1)
    assert len(kept) < 200


def test_thinning_keeps_the_samples_on_both_sides_of_an_impact():
    assert corners(TIMES, np.where(TIMES < 0.7, 1.0, -0.5)) == [0, 699, 700, 2000]
    assert corners(TIMES, np.zeros_like(TIMES)) == [0, 2000]


@pytest.mark.parametrize("count", [0, 1, 2])
def test_fewer_than_three_points_stay_as_they_are(count):
    assert corners(TIMES[:count], TIMES[:count]) == list(range(count))


def test_a_curve_that_is_nowhere_straight_keeps_the_allowed_points():
    assert len(corners(TIMES, np.random.default_rng(0).normal(size=len(TIMES)))) == MOST_POINTS


def test_a_packed_curve_keeps_its_times_and_seven_digits():
    curve = Series((0.0, 1.234567, 9.999999), (0.1, -123.4567, 1e-7))
    assert unpack(pack(curve)) == curve
    assert unpack(pack(Series((), ()))) == Series((), ())


def test_points_for_markers_lie_on_the_curve_and_keep_a_jump():
    curve = Series((0.0, 1.0, 1.0, 2.0), (0.0, 3.0, -1.0, -1.0))
    times, values = curve.dense()
    assert len(times) > 100
    assert np.diff(times).max() < 0.01
    assert np.abs(values - np.where(times < 1, 3 * times, np.where(times > 1, -1.0, values))).max() < 1e-12
    assert {0.0, 3.0, -1.0} <= set(values)
    assert [column.tolist() for column in Series((), ()).dense()] == [[], []]
    assert [set(column) for column in Series((0.5,), (2.0,)).dense()] == [{0.5}, {2.0}]


def test_samples_a_microsecond_apart_do_not_divide_by_zero():
    times = np.array([0.0, 1.0, 1.0, 1.0, 2.0])
    assert corners(times, np.array([0.0, 0.0, 5.0, 1.0, 1.0]))[-1] == 4


@pytest.mark.parametrize("family", ["dropped-ball", "cradle", "sliding-slab"])
def test_the_curve_of_a_run_passes_through_its_samples(family):
    family, engine = catalogue()[family], load_engine("handwritten")
    scenario = family.case(family.curve.case).scenarios[0]
    trajectory = engine.run(scenario, engine.settings(scenario, "exact"))
    exact, curve = family.curve.values(trajectory), Series.of(family, trajectory)
    drawn = np.interp(trajectory.times, curve.times, curve.values)
    kept = [int(np.argmin(np.abs(trajectory.times - time))) for time in curve.times]
    assert np.abs(exact[kept] - curve.values).max() <= 10.0**-VALUE_DECIMALS
    # Times are kept to a microsecond, in which an impact's line between two samples, 1 ms apart, moves by 1/1000.
    assert np.abs(drawn - exact).max() <= 2.1 * NEAR * np.ptp(exact)
