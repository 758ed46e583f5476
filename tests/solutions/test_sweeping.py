from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions.sweeping import (
    ray_box,
    ray_capsule,
    ray_sphere,
    relative_motion,
    sweep_sphere_plane,
    sweep_sphere_sphere,
)

INFINITE = math.inf
# Numbers with few digits: sums and products of them are exact, so that a touch is a touch.
COARSE = st.integers(-16, 16).map(lambda value: value / 4)
COARSE_POSITIVE = st.integers(0, 12).map(lambda value: value / 4)
VECTOR = st.tuples(COARSE, COARSE, COARSE)
SIZES = st.tuples(COARSE_POSITIVE, COARSE_POSITIVE, COARSE_POSITIVE)


def first_root(gap, x, u, dt, looks):
    """Time at which the gap of a point x + u t first falls to zero: many looks at once, and a root between two."""
    from scipy.optimize import brentq, minimize_scalar  # noqa: PLC0415

    def distance(time):  # at one time or at many
        return gap(x + np.multiply.outer(time, u))

    times = np.linspace(0, dt, looks)
    values = distance(times)
    if values[0] <= 0:
        return 0.0
    lowest = np.flatnonzero((values[1:-1] < values[:-2]) & (values[1:-1] <= values[2:])) + 1
    ends = sorted([*np.flatnonzero(values <= 0)[:1], *lowest])
    for end in ends:
        bottom = end
        if values[end] > 0:  # a dip between two looks may still reach zero
            dip = minimize_scalar(distance, bounds=(times[end - 1], times[end + 1]), options={"xatol": 1e-14})
            if dip.fun > 0:
                continue
            return brentq(distance, times[end - 1], dip.x, xtol=1e-15)
        return brentq(distance, times[bottom - 1], times[bottom], xtol=1e-15)
    return INFINITE


def segment_distance(points, start, end):
    along = end - start
    share = np.clip((points - start) @ along / (along @ along), 0, 1)
    return np.linalg.norm(points - start - np.multiply.outer(share, along), axis=-1)


# Relative motion


@pytest.mark.statement(10, oracle="invariance under a common velocity, in exact numbers")
@given(VECTOR, VECTOR, VECTOR, VECTOR, VECTOR, COARSE_POSITIVE, COARSE_POSITIVE)
def test_a_wind_that_carries_both_balls_changes_no_time_of_impact(xa, va, xb, vb, wind, ra, rb):
    alone = sweep_sphere_sphere(xa, va, ra, xb, vb, rb, 10.0)
    assert sweep_sphere_sphere(xa, np.add(va, wind), ra, xb, np.add(vb, wind), rb, 10.0) == alone


@pytest.mark.statement(10, oracle="the paths of both bodies")
def test_relative_motion_is_the_difference_of_the_two_paths():
    rng = np.random.default_rng(1)
    xa, va, xb, vb = rng.normal(size=(4, 50, 3))
    x, u = relative_motion(xa, va, xb, vb)
    # a handful of roundings of numbers of order ten
    np.testing.assert_allclose(x + 2.5 * u, (xa + 2.5 * va) - (xb + 2.5 * vb), atol=1e-14)


# Balls


@pytest.mark.statement(10, oracle="exact fractions")
@given(VECTOR, VECTOR, COARSE_POSITIVE)
def test_a_ray_meets_a_sphere_where_the_quadratic_has_a_root_ahead(x, u, r):
    a, b, c = (
        Fraction(value)
        for value in (
            sum(ui * ui for ui in u),
            sum(xi * ui for xi, ui in zip(x, u, strict=True)),
            sum(xi * xi for xi in x) - r * r,
        )
    )
    time = float(ray_sphere(x, u, r))
    if c <= 0:
        assert time == 0
    elif b >= 0 or b * b < a * c:
        assert time == INFINITE
    else:
        root = (-b - Fraction(math.isqrt(int((b * b - a * c) * 2**140)), 2**70)) / a
        # the root's radicand is exact here (few digits); a dozen roundings
        assert time == pytest.approx(float(root), rel=1e-14)


@pytest.mark.statement(10, oracle="closed form: two balls head-on")
def test_two_balls_touch_when_the_gap_is_used_up_by_both():
    time = sweep_sphere_sphere([0, 0, 0], [3, 0, 0], 0.5, [10, 0, 0], [-1, 0, 0], 1.5, 5.0)
    assert time == 2.0  # (10 − 2)/(3 + 1), exact in binary


def test_balls_in_every_special_position_have_the_right_time():
    x = [[1, 0, 0], [2, 0, 0], [2, 0, 0], [-3, 2, 0], [-3, 2.001, 0], [5, 0, 0], [5, 0, 0], [0, 0, 0]]
    u = [[1, 0, 0], [1, 0, 0], [0, 0, 0], [1, 0, 0], [1, 0, 0], [1, 0, 0], [0, 0, 0], [0, 0, 0]]
    time = sweep_sphere_sphere(x, u, 1.25, [0, 0, 0], [0, 0, 0], 0.75, 10.0)
    assert time.tolist() == [0, 0, 0, 3, INFINITE, INFINITE, INFINITE, 0]


def test_a_touch_exactly_at_the_end_of_the_step_counts():
    balls = ([0, 0, 0], [1, 0, 0], 1.0, [4, 0, 0], [0, 0, 0], 1.0)
    assert sweep_sphere_sphere(*balls, [2.0, np.nextafter(2, 0), 0.0]).tolist() == [2, INFINITE, INFINITE]
    assert sweep_sphere_plane([0, 0, 3], [0, 0, -1], 1.0, [0, 0, 1], 0, [2.0, 1.999]).tolist() == [2, INFINITE]


def test_points_meet_when_they_move_straight_at_each_other():
    time = sweep_sphere_sphere([0, 0, 0], [1, 1, 0], 0.0, [2, 2, 0], [0, 0, 0], 0.0, 5.0)
    assert time == pytest.approx(2.0, rel=1e-15)  # the rounding of a square root
    assert sweep_sphere_sphere([1, 1, 1], [0, 0, 0], 0.0, [1, 1, 1], [0, 0, 0], 0.0, 5.0) == 0.0


def test_an_endless_step_finds_everything_ahead():
    still = [0, 0, 0]
    assert sweep_sphere_sphere([1e9, 0, 0], [-1, 0, 0], 1, still, still, 1, INFINITE) == 1e9 - 2
    assert sweep_sphere_plane([0, 0, 1e9], [0, 0, -1], 1, [0, 0, 1], 0, INFINITE) == 1e9 - 1
    for x, u, expected in (
        ([1e9, 0, 0], [-1, 0, 0], (1e9 - 2, 1e9 + 2)),
        ([1, 0, 0], [0, 0, 0], (0, INFINITE)),
        ([3, 0, 0], [0, 0, 0], (INFINITE, -INFINITE)),
    ):
        assert ray_box(x, u, [2] * 3) == expected


@pytest.mark.statement(10, oracle="the separation at the time given, and exact fractions")
@given(VECTOR, VECTOR, COARSE_POSITIVE, COARSE)
def test_a_ball_meets_a_plane_when_its_nearest_point_does(x, u, r, offset):
    time = float(sweep_sphere_plane(x, u, r, [0, 0, 2], 2 * offset, 100.0))  # a normal of any length
    gap = Fraction(x[2]) + Fraction(offset) - Fraction(r)
    if gap <= 0:
        assert time == 0
    elif u[2] >= 0:
        assert time == INFINITE
    else:
        assert time == float(gap / -Fraction(u[2]))  # one quotient of exact numbers


# Rays


@pytest.mark.statement(10, oracle="pymunk's segment queries")
def test_pymunk_finds_the_same_points_of_circles_boxes_and_capsules():
    pymunk = oracle("pymunk")
    rng = np.random.default_rng(4)
    body, hits = pymunk.Space().static_body, 0
    for _ in range(300):
        angle, r = rng.uniform(0, 2 * math.pi), rng.uniform(0.1, 0.5)
        x = rng.uniform(2, 3) * np.array([math.cos(angle), math.sin(angle), 0.0])
        u = 2 * (np.array([*rng.uniform(-1, 1, 2), 0.0]) - x)
        a, b = rng.uniform(-1, 1, (2, 2))
        half = rng.uniform(0.1, 1, 2)
        shapes = (
            (pymunk.Circle(body, r), ray_sphere(x, u, r)),
            (pymunk.Segment(body, tuple(a), tuple(b), r), ray_capsule(x, u, [*a, 0], [*b, 0], r)),
            (pymunk.Poly.create_box(body, tuple(2 * half)), ray_box(x, u, [*half, 1])[0]),
        )
        for shape, time in shapes:
            shape.cache_bb()
            hit = shape.segment_query(tuple(x[:2]), tuple((x + u)[:2]), 0)
            assert (hit is not None and hit.shape is not None) == (time <= 1)
            if time <= 1:
                hits += 1
                # some ten roundings, enlarged where the ray arrives at a flat angle
                assert float(time) == pytest.approx(hit.alpha, abs=1e-9)
    assert hits > 200


@pytest.mark.statement(10, oracle="many looks and scipy's brentq")
def test_a_ray_enters_a_capsule_where_the_distance_is_the_radius():
    oracle("scipy")
    rng = np.random.default_rng(5)
    for _ in range(40):
        x, a, b = 3 * rng.uniform(-1, 1, 3), *rng.uniform(-1, 1, (2, 3))
        u, r = rng.uniform(-1, 1, 3) - x, rng.uniform(0.05, 0.5)
        true = first_root(lambda points, a=a, b=b, r=r: segment_distance(points, a, b) - r, x, u, 2.0, 401)
        time = float(ray_capsule(x, u, a, b, r))
        assert (time if time <= 2 else INFINITE) == pytest.approx(true, abs=1e-11)  # brentq's tolerance, near a graze


def test_rays_along_a_capsule_meet_its_end():
    a, b = [0, 0, 0], [2, 0, 0]
    assert ray_capsule([-3, 0, 0], [1, 0, 0], a, b, 1.0) == 2.0
    assert ray_capsule([5, 0, 0], [-1, 0, 0], a, b, 1.0) == 2.0
    # grazes along the whole side, from the first end on; the rounding of a square root
    assert ray_capsule([-3, 0.5, 0], [1, 0, 0], a, b, 0.5) == pytest.approx(3.0, rel=1e-15)
    assert ray_capsule([1, 0.2, 0], [0, 1, 0], a, b, 0.5) == 0.0
    assert ray_capsule([1, 2, 0], [0, -1, 0], a, b, 0.0) == 2.0
    assert ray_capsule([3, 2, 0], [0, -1, 0], a, b, 0.5) == INFINITE
    assert ray_capsule([-3, 0, 0], [1, 0, 0], a, a, 1.0) == 2.0  # no length: a ball


# Boxes


def exact_overlap(x, u, half):
    """Entry and exit in fractions; None where they do not meet."""
    start, end = Fraction(0), Fraction(10**9)
    for xi, ui, hi in zip(map(Fraction, x), map(Fraction, u), map(Fraction, half), strict=True):
        if ui == 0:
            if abs(xi) > hi:
                return None
            continue
        ends = sorted(((-hi - xi) / ui, (hi - xi) / ui))
        start, end = max(start, ends[0]), min(end, ends[1])
    return (start, end) if start <= end else None


@pytest.mark.statement(10, oracle="exact fractions")
@given(VECTOR, VECTOR, SIZES)
def test_exact_fractions_give_the_same_overlap_with_a_box(x, u, half):
    exact = exact_overlap(x, u, half)
    wanted = (INFINITE, -INFINITE) if exact is None else tuple(float(t) if t < 10**9 else INFINITE for t in exact)
    found = ray_box(x, u, half)
    # both ends are one quotient of exact numbers; where they meet, equal fractions round alike
    assert tuple(map(float, found)) == wanted


@pytest.mark.statement(10, oracle="a change of the unit of length")
@pytest.mark.parametrize("scale", [2.0**-20, 2.0**20])
def test_times_do_not_depend_on_the_unit_of_length(scale):
    rng = np.random.default_rng(15)
    x, a, b, c = rng.uniform(-1, 1, (4, 500, 3)) * [[[3]], [[1]], [[1]], [[1]]]
    u, r, half = 0.3 * rng.normal(size=(500, 3)) - x, rng.uniform(0, 0.5, 500), rng.uniform(0, 0.5, (500, 3))

    def times(s):
        return [
            ray_sphere(s * x, s * u, s * r),
            ray_capsule(s * x, s * u, s * a, s * b, s * r),
            *ray_box(s * x, s * u, s * half),
            sweep_sphere_plane(s * x, s * u, s * r, c, s * r, 2.0),
        ]

    # a power of two changes no digit
    for near, far in zip(times(1.0), times(scale), strict=True):
        assert 50 < np.sum(np.isfinite(near)) < 500
        assert np.array_equal(near, far)


# What is refused


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: ray_sphere([0, 0, 0], [1, 0, 0], -1.0), "radius must be zero or positive, not -1"),
        (lambda: ray_sphere([0, 0, 0], [1, 0, 0], math.inf), "radius must be finite, not inf"),
        (lambda: sweep_sphere_plane([0] * 3, [1, 0, 0], math.inf, [0, 0, 1], 0, 1.0), "radius must be finite, not inf"),
        (lambda: ray_sphere([0, 0, math.nan], [1, 0, 0], 1.0), "origin must be finite, not nan"),
        (lambda: ray_capsule([0, 0], [1, 0, 0], [0, 0, 0], [0, 0, 0], 1.0), r"origin must have shape \(\.\.\., 3\)"),
        (lambda: ray_box([0, 0, 0], [1, 0, 0], [1, -2, 1]), "half_extents must be zero or positive, not -2"),
        (lambda: sweep_sphere_sphere([0] * 3, [0] * 3, -1, [0] * 3, [0] * 3, 2, 1.0), "radius_a"),
        (lambda: sweep_sphere_sphere([0] * 3, [0] * 3, 1, [0] * 3, [0] * 3, 2, math.nan), "dt must be"),
        (lambda: sweep_sphere_plane([0, 0, 1], [0, 0, 1], 1, [0, 0, 0], 1, 1), "normal is zero"),
    ],
)
def test_an_invalid_sweep_is_refused_by_name_and_value(call, complaint):
    with pytest.raises(ValueError, match=complaint):
        call()
