from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from reference.catalogue.scenarios import tunnelling
from solutions.detection import is_colliding, missing_probability, overlap_interval, side_of_plane

EPSILON = np.finfo(float).eps
DISTANCE, DURATION = st.floats(-10, 10), st.floats(0, 2)
VELOCITY = st.floats(-50, 50).map(lambda value: round(value, 9))  # no crawl that lasts longer than any float
RADIUS, THICKNESS = st.one_of(st.just(0.0), st.floats(1e-3, 2)), st.one_of(st.just(0.0), st.floats(1e-3, 2))
# Numbers with few digits: sums and products of them are exact, so that a touch is a touch.
COARSE = st.integers(-40, 40).map(lambda value: value / 8)
COARSE_POSITIVE = st.integers(0, 24).map(lambda value: value / 8)

# The side of a plane


def test_a_point_in_front_on_or_behind_the_plane():
    behind = -np.finfo(float).smallest_subnormal
    assert side_of_plane([2.0, 0.0, -0.0, behind, -2.0]).tolist() == [1, 0, 0, -1, -1]


@pytest.mark.statement(4, oracle="the definition, at the edges of the tolerance")
def test_a_point_within_the_tolerance_or_at_its_edge_is_on_the_plane():
    s = np.array([0.25, np.nextafter(0.25, 1), -0.25, np.nextafter(-0.25, -1)])
    assert side_of_plane(s, 0.25).tolist() == [0, 1, 0, -1]
    assert side_of_plane(0.5, [0.25, 0.5, 0.75]).tolist() == [1, 0, 0]


@given(DISTANCE, st.floats(0, 5))
def test_turning_the_plane_round_swaps_its_sides(s, tolerance):
    assert side_of_plane(-s, tolerance) == -side_of_plane(s, tolerance)
    assert (side_of_plane(s, tolerance) == -1) == is_colliding(s, tolerance)


# Overlap over a step


def exact_interval(x, u, r, w, dt):
    """The same interval in fractions, from where the centre may be; None where there is none."""
    x, u, r, w, dt = (Fraction(value) for value in (x, u, r, w, dt))
    if u == 0:
        return (Fraction(0), dt) if -(w + r) <= x <= r else None
    ends = sorted(((r - x) / u, (-(w + r) - x) / u))
    start, end = max(ends[0], Fraction(0)), min(ends[1], dt)
    return (start, end) if start <= end else None


@pytest.mark.statement(2, oracle="exact fractions")
@given(COARSE, COARSE, COARSE_POSITIVE, COARSE_POSITIVE, COARSE_POSITIVE)
def test_the_overlap_starts_and_ends_when_exact_arithmetic_says(x, u, r, w, dt):
    expected = exact_interval(x, u, r, w, dt)
    # Both ends are one quotient of exact numbers. Where they meet by equality of two rounded quotients, so do these:
    # equal fractions round alike.
    wanted = (math.inf, -math.inf) if expected is None else tuple(float(value) for value in expected)
    assert tuple(map(float, overlap_interval(x, u, r, w, dt))) == wanted


@pytest.mark.statement(2, oracle="a look at a thousand instants of the step")
@given(DISTANCE, VELOCITY, RADIUS, THICKNESS, DURATION)
def test_ball_and_slab_overlap_exactly_within_the_interval(x, u, r, w, dt):
    start, end = overlap_interval(x, u, r, w, dt)
    times = np.linspace(0, dt, 1001)
    outside = np.maximum(x + u * times - r, -(w + r) - (x + u * times))  # how far the ball is from the slab
    overlaps = (start <= times) & (times <= end)
    rounding = 1e-13  # of ways up to 110 m
    assert np.all(outside[overlaps] <= rounding)
    assert np.all(outside[~overlaps] >= -rounding)


@pytest.mark.statement(2, oracle="pymunk's swept query of a circle against a box")
def test_a_swept_query_of_pymunk_finds_the_same_first_touch():
    pymunk = oracle("pymunk")
    rng = np.random.default_rng(3)
    space = pymunk.Space()
    for _ in range(100):
        x, u, r, w = rng.uniform(0.5, 2), rng.uniform(-4, -1), rng.uniform(0.01, 0.3), rng.uniform(0.01, 0.5)
        wall = pymunk.Poly(space.static_body, [(-w, -5), (0, -5), (0, 5), (-w, 5)])
        wall.cache_bb()  # a query takes the corners from where it was last placed
        hit = wall.segment_query((x, 0.3), (x + u, 0.3), r)
        start, end = overlap_interval(x, u, r, w, 1.0)
        assert (hit is not None) == (start <= end)
        if hit is not None:
            assert start == pytest.approx(hit.alpha, abs=1e-12)  # some ten roundings of numbers of order one


def test_a_fast_ball_overlaps_a_thin_wall_only_within_the_step():
    # 20 m/s over 10 ms are 0.2 m; wall 10 mm and radius 20 mm: 50 mm of overlap, 2.5 ms
    start, end = overlap_interval(0.07, -20.0, 0.02, 0.01, 0.01)
    assert (start, end) == (pytest.approx(0.0025, rel=1e-14), pytest.approx(0.005, rel=1e-14))


def test_a_ball_that_keeps_its_distance_overlaps_always_or_never():
    start, end = overlap_interval([0.5, 0.25, 0.0, -1.25, -1.5], 0.0, 0.25, 1.0, 2.0)
    assert start.tolist() == [math.inf, 0.0, 0.0, 0.0, math.inf]
    assert end.tolist() == [-math.inf, 2.0, 2.0, 2.0, -math.inf]


def test_the_interval_of_a_ball_that_overlaps_begins_with_the_step():
    start, end = overlap_interval(-0.5, [-1.0, 1.0, 0.0], 0.25, 1.0, 10.0)
    assert start.tolist() == [0.0, 0.0, 0.0]
    assert end.tolist() == [0.75, 0.75, 10.0]


def test_a_touch_at_either_end_of_the_step_is_an_interval_of_no_length():
    arrives = overlap_interval(1.25, -1.0, 0.25, 1.0, 1.0)
    leaves = overlap_interval(0.25, 1.0, 0.25, 1.0, 1.0)
    out_behind = overlap_interval(-1.25, -1.0, 0.25, 1.0, 1.0)
    assert [tuple(map(float, pair)) for pair in (arrives, leaves, out_behind)] == [(1.0, 1.0), (0.0, 0.0), (0.0, 0.0)]
    assert overlap_interval(np.nextafter(1.25, 2), -1.0, 0.25, 1.0, 1.0)[0] == math.inf


def test_a_point_meets_a_sheet_for_an_instant_and_stays_in_a_half_space():
    assert tuple(map(float, overlap_interval(1.0, -2.0, 0.0, 0.0, 1.0))) == (0.5, 0.5)
    assert tuple(map(float, overlap_interval(1.0, -2.0, 0.0, math.inf, 1.0))) == (0.5, 1.0)
    assert tuple(map(float, overlap_interval(-7.0, 2.0, 0.0, math.inf, 9.0))) == (0.0, 3.5)


def test_a_step_of_no_length_looks_only_at_where_they_are():
    start, end = overlap_interval([0.0, 1.0], -1.0, 0.25, 1.0, 0.0)
    assert start.tolist() == [0.0, math.inf]
    assert end.tolist() == [0.0, -math.inf]


@given(COARSE, COARSE, COARSE_POSITIVE, COARSE_POSITIVE, COARSE_POSITIVE)
def test_seen_from_the_other_face_the_same_overlap_takes_place(x, u, r, w, dt):
    assert overlap_interval(-w - x, -u, r, w, dt) == overlap_interval(x, u, r, w, dt)


@given(COARSE, COARSE, COARSE_POSITIVE, COARSE_POSITIVE, COARSE_POSITIVE)
def test_only_the_sum_of_radius_and_half_thickness_counts(x, u, r, w, dt):
    # A ball of radius r against the slab is a point against the slab with r put on either face.
    assert overlap_interval(x - r, u, 0.0, w + 2 * r, dt) == overlap_interval(x, u, r, w, dt)


# Temporal aliasing

SPEED, STEP, SIZE = st.floats(0.1, 100), st.floats(1e-4, 1e-1), st.floats(0.0, 0.5)


@pytest.mark.statement(9, oracle="a count over evenly spread phases, and the continuous test")
@pytest.mark.parametrize(("speed", "thickness", "radius"), [(20.0, 0.01, 0.02), (20.0, 0.0, 0.01), (5.0, 0.1, 0.0)])
def test_the_missing_share_is_a_count_over_all_phases_of_a_step(speed, thickness, radius):
    dt, shots = 0.01, 100_000
    way = speed * dt
    first = way * (np.arange(shots) + 0.5) / shots  # of the centre from the face, at the last look before the ball's
    looks = first[:, None] - way * np.arange(6)  # surface arrives: phases evenly spread over a step
    looks = looks + radius
    caught = np.any((looks <= radius) & (looks >= -(thickness + radius)), axis=1)
    # One ball at either edge of the phases
    assert 1 - caught.mean() == pytest.approx(missing_probability(speed, thickness, radius, dt), abs=2 / shots)
    start, end = overlap_interval(first + radius, -speed, radius, thickness, 5 * dt)
    assert np.all(start <= end)  # the continuous test misses none of them


@given(SPEED, SIZE, SIZE, STEP)
def test_no_ball_is_missed_as_long_as_a_step_is_shorter_than_the_overlap(v, w, r, dt):
    share = missing_probability(v, w, r, dt)
    assert 0 <= share <= 1
    assert (share == 0) == (v * dt <= w + 2 * r) or share < 1e-15
    # exact: one quotient and one difference
    exact = max(Fraction(0), 1 - (Fraction(w) + 2 * Fraction(r)) / (Fraction(v) * Fraction(dt)))
    assert float(share) == pytest.approx(float(exact), abs=4 * EPSILON)


def test_a_table_tennis_ball_and_a_thin_wall():
    # 20 m/s and 10 ms: 0.2 m between two looks, 0.05 m of overlap
    assert missing_probability(20.0, 0.01, 0.02, 0.01) == 0.75
    assert missing_probability([20.0, 5.0, 0.0], 0.01, 0.02, 0.01).tolist() == [0.75, 0.0, 0.0]
    assert missing_probability(1.0, 0.0, 0.0, 0.1) == 1.0
    assert missing_probability(0.0, 0.0, 0.0, 0.1) == 0.0
    assert missing_probability(1.0, math.inf, 0.0, 0.1) == 0.0


def test_pushing_out_the_nearest_way_stops_fewer_balls_than_are_seen():
    # What the comparison's thin wall expects of an engine: only w/2 + r of the way turns the ball back.
    speed, dt = 20.0, 0.01
    seen = missing_probability(speed, tunnelling.THICKNESS, tunnelling.RADIUS, dt)
    assert tunnelling.passing_share(speed, dt) == pytest.approx(0.875, abs=1e-12)
    assert seen == pytest.approx(0.75, abs=1e-12)
    # A half-space of overlap w/2 + r is a wall of that thickness against a point
    turned_back = missing_probability(speed, tunnelling.THICKNESS / 2 + tunnelling.RADIUS, 0.0, dt)
    assert turned_back == pytest.approx(tunnelling.passing_share(speed, dt), abs=1e-15)


# What is refused


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: side_of_plane(math.nan), "separation must be finite, not nan"),
        (lambda: side_of_plane(1.0, -0.5), "tolerance must be zero or positive, not -0.5"),
        (lambda: is_colliding(math.nan), "separation must be finite, not nan"),
        (lambda: is_colliding(0.0, -0.5), "tolerance must be zero or positive, not -0.5"),
        (lambda: overlap_interval(math.inf, 1.0, 1.0, 1.0, 1.0), "distance must be finite, not inf"),
        (lambda: overlap_interval(0.0, math.nan, 1.0, 1.0, 1.0), "normal_velocity must be finite, not nan"),
        (lambda: overlap_interval(0.0, 0.0, -1.0, 1.0, 1.0), "radius must be zero or positive, not -1"),
        (lambda: overlap_interval(0.0, 0.0, 1.0, -2.0, 1.0), "thickness must be zero or positive, not -2"),
        (lambda: overlap_interval(0.0, 0.0, 1.0, 1.0, [1.0, -3.0]), "dt must be zero or positive, not -3"),
        (lambda: missing_probability(-1.0, 1.0, 1.0, 1.0), "speed must be zero or positive, not -1"),
        (lambda: missing_probability(math.inf, 1.0, 1.0, 1.0), "speed must be finite, not inf"),
        (lambda: missing_probability(1.0, -1.0, 1.0, 1.0), "thickness must be zero or positive, not -1"),
        (lambda: missing_probability(1.0, 1.0, -1.0, 1.0), "radius must be zero or positive, not -1"),
        (lambda: missing_probability(1.0, 1.0, 1.0, -1.0), "dt must be zero or positive, not -1"),
        (lambda: missing_probability(1.0, 1.0, 1.0, math.inf), "dt must be finite, not inf"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()


# One is many


def test_many_walls_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(5)
    x, u = rng.normal(size=(2, 4, 5))
    r, w, dt, v = rng.uniform(0.01, 1, size=(4, 4, 5))
    together = (*overlap_interval(x, u, r, w, dt), missing_probability(v, w, r, dt), side_of_plane(x, r))
    assert [values.shape for values in together] == [(4, 5)] * 4
    for at in np.ndindex(4, 5):
        one = (*overlap_interval(x[at], u[at], r[at], w[at], dt[at]), missing_probability(v[at], w[at], r[at], dt[at]))
        one = (*one, side_of_plane(x[at], r[at]))
        assert [values[at] for values in together] == list(one)


def test_looking_at_a_wall_changes_none_of_the_inputs():
    arrays = np.random.default_rng(5).uniform(0.01, 1, size=(5, 6))
    kept = arrays.copy()
    arrays.flags.writeable = False  # writing to one would raise
    overlap_interval(*arrays)
    missing_probability(*arrays[1:])
    side_of_plane(*arrays[:2])
    assert np.array_equal(arrays, kept)
