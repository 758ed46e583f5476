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
    rotated,
    sweep_boxes,
    sweep_oriented_boxes,
    sweep_sphere_plane,
    sweep_sphere_sphere,
    sweep_sphere_triangle,
)

INFINITE = math.inf
# Numbers with few digits: sums and products of them are exact, so that a touch is a touch.
COARSE = st.integers(-16, 16).map(lambda value: value / 4)
COARSE_POSITIVE = st.integers(0, 12).map(lambda value: value / 4)
VECTOR = st.tuples(COARSE, COARSE, COARSE)
SIZES = st.tuples(COARSE_POSITIVE, COARSE_POSITIVE, COARSE_POSITIVE)
TRIANGLE = np.array([[0.0, 0, 0], [2, 0, 0], [0, 2, 0]])


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


def triangle_distance(points, corners):
    """Distance of points from a triangle by least squares with bounds: a different way from ours."""
    a, b, c = corners
    normal = np.cross(b - a, c - a)
    height = np.abs((points - a) @ normal) / np.linalg.norm(normal)
    shares = (points - a) @ np.linalg.pinv(np.column_stack([b - a, c - a])).T
    above = np.all(shares >= 0, axis=-1) & (shares.sum(axis=-1) <= 1)
    sides = [segment_distance(points, *side) for side in ((a, b), (b, c), (c, a))]
    return np.where(above, height, np.min(sides, axis=0))


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


def test_a_crawl_arrives_after_any_number_of_seconds_or_never():
    for time in (
        ray_sphere([2, 0, 0], [-1e-310, 0, 0], 1.0),
        sweep_sphere_plane([0, 0, 2], [0, 0, -1e-310], 1.0, [0, 0, 1], 0, 1.0),
        sweep_sphere_triangle([0.5, 0.5, 2], [0, 0, -1e-310], 1.0, TRIANGLE, 1.0),
        ray_box([2, 0, 0], [-1e-310, 0, 0], [1, 1, 1])[0],
    ):
        assert time > 1e300
    assert ray_box([2, 0, 0], [-1e-310, 0, 0], [1, 1, 1]) == (INFINITE, -INFINITE)  # after all numbers: never


def test_an_endless_step_finds_everything_ahead():
    still = [0, 0, 0]
    assert sweep_sphere_sphere([1e9, 0, 0], [-1, 0, 0], 1, still, still, 1, INFINITE) == 1e9 - 2
    assert sweep_sphere_plane([0, 0, 1e9], [0, 0, -1], 1, [0, 0, 1], 0, INFINITE) == 1e9 - 1
    assert sweep_sphere_triangle([0.5, 0.5, 1e9], [0, 0, -1], 1, TRIANGLE, INFINITE) == 1e9 - 1
    for x, u, expected in (
        ([1e9, 0, 0], [-1, 0, 0], (1e9 - 2, 1e9 + 2)),
        ([1, 0, 0], [0, 0, 0], (0, INFINITE)),
        ([3, 0, 0], [0, 0, 0], (INFINITE, -INFINITE)),
    ):
        assert sweep_boxes(x, u, [1] * 3, still, still, [1] * 3, INFINITE) == expected
        assert sweep_oriented_boxes(x, u, np.eye(3), [1] * 3, np.eye(3), [1] * 3, INFINITE) == expected


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


@pytest.mark.statement(10, oracle="many looks and scipy's brentq")
def test_a_ball_touches_a_triangle_when_the_distance_is_its_radius():
    oracle("scipy")
    rng = np.random.default_rng(2)
    found = []
    for _ in range(60):
        corners, x, r = rng.uniform(-1, 1, (3, 3)), rng.uniform(-3, 3, 3), rng.uniform(0.05, 0.5)
        u = rng.uniform(-0.6, 0.6, 3) - x
        time = float(sweep_sphere_triangle(x, u, r, corners, 2.0))
        true = first_root(lambda points, c=corners, r=r: triangle_distance(points, c) - r, x, u, 2.0, 401)
        found.append(true)
        # brentq's own tolerance, and the slope of the distance near a graze: some ten thousand roundings
        assert time == pytest.approx(true, abs=1e-11)
    assert 20 < np.isfinite(found).sum() < 60  # hits and misses


@pytest.mark.statement(10, oracle="closed form for each feature")
@pytest.mark.parametrize(
    ("x", "u", "r", "expected"),
    [
        ([0.5, 0.5, 3], [0, 0, -1], 1.0, 2.0),  # face, from above
        ([0.5, 0.5, -3], [0, 0, 1], 1.0, 2.0),  # face, from below
        ([0.5, 0.5, 3], [0, 0, -1], 0.0, 3.0),  # a point
        ([1, -1, 3], [0, 0, -1], 1.25, 2.25),  # an edge, 1 beside it: √(1.25² − 1²) = .75 above
        ([-0.75, -1, 3], [0, 0, -1], 1.25, 3.0),  # a corner, at 1.25: a graze
        ([-2, 1, 0], [1, 0, 0], 0.5, 1.5),  # in its plane, an edge square on
        ([-3, 0, 1], [1, 0, 0], 1.0, 3.0),  # along the face one radius above: first over the corner's edge
        ([0.5, 0.5, 0.25], [0, 0, 1], 0.5, 0.0),  # overlaps, and parts
        ([0.5, 0.5, 0], [0, 0, 0], 0.0, 0.0),  # a point on the face
        ([0.5, 0.5, 3], [0, 0, 1], 1.0, INFINITE),  # moves off
        ([0.5, 0.5, 3], [1, 0, 0], 1.0, INFINITE),  # moves along
        ([0.5, 0.5, 3], [0, 0, 0], 1.0, INFINITE),  # moves as the triangle does
        ([1.5, 1.5, 3], [0, 0, -1], 0.5, INFINITE),  # beside the long edge, .707 away
        ([0.5, 0.5, 30], [0, 0, -1], 1.0, INFINITE),  # later than the step
    ],
)
def test_the_grown_triangle_is_met_where_its_face_edges_and_corners_are(x, u, r, expected):
    assert sweep_sphere_triangle(x, u, r, TRIANGLE, 10.0) == pytest.approx(expected, abs=1e-15)


@pytest.mark.statement(10, oracle="the same shape as a ball or a capsule")
def test_a_triangle_without_area_is_met_as_a_segment_or_a_point():
    rng = np.random.default_rng(3)
    x, a, b = rng.uniform(-1, 1, (3, 500, 3))
    x = 3 * x
    u = rng.uniform(-0.5, 0.5, (500, 3)) - x
    point = sweep_sphere_triangle(x, u, 0.3, np.stack([a, a, a], axis=1), 2.0)
    # the same rays: equal but for the rounding of the distances
    np.testing.assert_allclose(point, sweep_sphere_sphere(x, u, 0.3, a, np.zeros(3), 0.0, 2.0), atol=1e-13)
    segment = sweep_sphere_triangle(x, u, 0.3, np.stack([a, b, (a + b) / 2], axis=1), 2.0)
    true = ray_capsule(x, u, a, b, 0.3)
    np.testing.assert_allclose(segment, np.where(true <= 2, true, np.inf), atol=1e-13)


@given(st.permutations(range(3)), VECTOR, VECTOR)
def test_the_order_of_the_corners_does_not_matter(order, x, u):
    times = [sweep_sphere_triangle(x, u, 0.3, TRIANGLE[list(way)], 5.0) for way in (range(3), order)]
    # the corners enter the sums in another order
    assert times[0] == pytest.approx(times[1], abs=1e-12)


@pytest.mark.statement(10, oracle="points of the seam, chosen beforehand")
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_not_even_a_point_slips_through_the_seam_of_two_triangles(scale):
    rng = np.random.default_rng(11)
    a, b, c, d = scale * rng.normal(size=(4, 4000, 3))
    x, share = a + scale * rng.normal(size=(4000, 3)), rng.uniform(0.05, 0.95, (4000, 1))
    u = a + share * (b - a) - x
    across = np.cross(b - a, u)  # seen along u, c and d must be on two sides of the seam
    two_sides = np.vecdot(across, c - a) * np.vecdot(across, d - a) < 0
    for radius, places in ((0.0, [0, 1, 2]), (0.0, [1, 2, 0]), (1e-9 * scale, [0, 1, 2])):
        first, second = np.stack([a, b, c], axis=1)[:, places], np.stack([b, a, d], axis=1)
        time = np.minimum(*(sweep_sphere_triangle(x, u, radius, corners, 2.0) for corners in (first, second)))
        # it is there at 1; rounding of the height, enlarged where it comes at a flat angle
        assert time[two_sides] == pytest.approx(1.0, abs=1e-5)
    assert two_sides.sum() > 1000


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


def exact_overlap(x, u, half, dt):
    """Entry and exit in fractions; None where they do not meet."""
    start, end = Fraction(0), Fraction(dt)
    for xi, ui, hi in zip(map(Fraction, x), map(Fraction, u), map(Fraction, half), strict=True):
        if ui == 0:
            if abs(xi) > hi:
                return None
            continue
        ends = sorted(((-hi - xi) / ui, (hi - xi) / ui))
        start, end = max(start, ends[0]), min(end, ends[1])
    return (start, end) if start <= end else None


@pytest.mark.statement(10, oracle="exact fractions")
@given(VECTOR, VECTOR, SIZES, SIZES, VECTOR, VECTOR)
def test_exact_fractions_give_the_same_overlap_of_two_boxes(x, u, half_a, half_b, xb, ub):
    exact = exact_overlap(x, u, np.add(half_a, half_b), 3.0)
    wanted = (INFINITE, -INFINITE) if exact is None else tuple(map(float, exact))
    found = sweep_boxes(np.add(x, xb), np.add(u, ub), half_a, xb, ub, half_b, 3.0)
    # both ends are one quotient of exact numbers; where they meet, equal fractions round alike
    assert tuple(map(float, found)) == wanted


@pytest.mark.statement(10, oracle="the slab test of boxes along the axes")
@given(VECTOR, VECTOR, SIZES, SIZES)
def test_oriented_boxes_that_are_not_turned_are_boxes_along_the_axes(x, u, half_a, half_b):
    quarter = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    plain = sweep_boxes(x, u, half_a, [0, 0, 0], [0, 0, 0], half_b, 3.0)
    assert sweep_oriented_boxes(x, u, np.eye(3), half_a, np.eye(3), half_b, 3.0) == plain
    turned = np.array(half_a)[[1, 0, 2]]  # a quarter turn about z swaps the first two edges
    assert sweep_oriented_boxes(x, u, quarter, turned, np.eye(3), half_b, 3.0) == plain


@pytest.mark.statement(10, oracle="scipy's linear programs: have the two boxes a point in common?")
@pytest.mark.parametrize("count", [15, pytest.param(40, marks=pytest.mark.weekly)])
def test_two_turned_boxes_share_a_point_exactly_within_the_interval(count):
    linprog = oracle("scipy.optimize").linprog
    random = oracle("scipy.spatial.transform").Rotation.random
    rotations = random(2 * count, 6).as_matrix().reshape(count, 2, 3, 3)
    rng = np.random.default_rng(6)
    hits = 0
    for axes_a, axes_b in rotations:
        x, half_a, half_b = 3 * rng.uniform(-1, 1, 3), rng.uniform(0.1, 0.8, 3), rng.uniform(0.1, 0.8, 3)
        u = 2 * (rng.uniform(-2, 2, 3) - x)
        entry, leaving = sweep_oriented_boxes(x, u, axes_a, half_a, axes_b, half_b, 1.0)
        hits += bool(np.isfinite(entry))

        def overlap(time, x=x, u=u, axes_a=axes_a, half_a=half_a, axes_b=axes_b, half_b=half_b):
            sides = np.concatenate([axes_a.T, -axes_a.T, axes_b.T, -axes_b.T])
            place = axes_a.T @ (x + u * time)
            limits = np.concatenate([half_a + place, half_a - place, half_b, half_b])
            return linprog(np.zeros(3), sides, limits, bounds=(None, None)).status == 0

        margin = 1e-5  # the solver's own tolerance is 1e-7 m
        for time in np.concatenate([np.linspace(0, 1, 9), np.nan_to_num([entry, leaving], posinf=0, neginf=0)]):
            for look in (time - margin, time + margin):
                if abs(look - entry) > margin / 2 and abs(look - leaving) > margin / 2 and 0 <= look <= 1:
                    assert overlap(look) == (entry < look < leaving)
    assert count / 4 < hits < count


def test_only_a_cross_product_of_edges_parts_boxes_edge_to_edge():
    # Two cubes turned by 45°, about x and about y: edge along x of one over edge along y of the other.
    c = math.sqrt(0.5)
    about_x, about_y = np.array([[1, 0, 0], [0, c, -c], [0, c, c]]), np.array([[c, 0, c], [0, 1, 0], [-c, 0, c]])
    half = np.full(3, 0.5)
    entry, _ = sweep_oriented_boxes([0, 0, 3], [0, 0, -1], about_x, half, about_y, half, 5.0)
    assert entry == pytest.approx(3 - math.sqrt(2), abs=1e-15)


@pytest.mark.parametrize("angle", [1e-12, 1e-9, 1e-7, 0.9e-6, 1.1e-6, 1e-5])
def test_a_tiny_turn_changes_the_overlap_only_as_it_moves_a_corner(angle):
    rng = np.random.default_rng(14)
    x, u, axis = rng.uniform(-3, 3, (3, 300, 3))
    u = 0.3 * u - x
    half_a, half_b = rng.uniform(0.1, 1, (2, 300, 3))
    axis = angle * axis / np.linalg.norm(axis, axis=-1, keepdims=True)
    turned = sweep_oriented_boxes(x, u, rotated(np.eye(3), axis[:, None]).mT, half_a, np.eye(3), half_b, 2.0)
    plain = sweep_boxes(x, u, half_a, [0, 0, 0], [0, 0, 0], half_b, 2.0)
    hit = np.isfinite(turned[0]) & np.isfinite(plain[0])
    assert np.sum(hit) > 100
    assert np.sum(np.isfinite(turned[0]) ^ np.isfinite(plain[0])) <= 1  # one that grazes
    slowest = np.abs(u[hit]).min(axis=-1)
    for ours, theirs in zip(turned, plain, strict=True):
        # a corner is at most √3 m from the middle, and moves by the angle times that; rounding of sums of ten numbers
        assert np.all(np.abs(ours[hit] - theirs[hit]) <= (2 * angle + 1e-14) / slowest)


@pytest.mark.statement(10, oracle="a change of the unit of length")
@pytest.mark.parametrize("scale", [2.0**-20, 2.0**20])
def test_times_do_not_depend_on_the_unit_of_length(scale):
    rng = np.random.default_rng(15)
    x, a, b, c = rng.uniform(-1, 1, (4, 500, 3)) * [[[3]], [[1]], [[1]], [[1]]]
    u, r, half = 0.3 * rng.normal(size=(500, 3)) - x, rng.uniform(0, 0.5, 500), rng.uniform(0, 0.5, (500, 3))
    axes = rotated(np.eye(3), rng.normal(size=(500, 1, 3))).mT

    def times(s):
        return [
            ray_sphere(s * x, s * u, s * r),
            ray_capsule(s * x, s * u, s * a, s * b, s * r),
            *ray_box(s * x, s * u, s * half),
            sweep_sphere_plane(s * x, s * u, s * r, c, s * r, 2.0),
            sweep_sphere_triangle(s * x, s * u, s * r, s * np.stack([a, b, c], axis=1), 2.0),
            *sweep_oriented_boxes(s * x, s * u, axes, s * half, np.eye(3), s * half[::-1], 2.0),
        ]

    # a power of two changes no digit
    for near, far in zip(times(1.0), times(scale), strict=True):
        assert 50 < np.sum(np.isfinite(near)) < 500
        assert np.array_equal(near, far)


def test_rods_and_sheets_without_thickness_are_boxes_too():
    rod = [1.0, 0.0, 0.0]
    quarter = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    entry, leaving = sweep_oriented_boxes([0, 0, 2], [0, 0, -1], np.eye(3), rod, quarter, rod, 5.0)
    assert (entry, leaving) == (2.0, 2.0)
    entry, _ = sweep_boxes([2, 0, 0], [-2, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 0], [1, 1, 0], 1.0)
    assert entry == 0.5


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
        (lambda: sweep_boxes([0] * 3, [0] * 3, [1] * 3, [0] * 3, [0] * 3, [-1, 1, 1], 1.0), "half_extents_b"),
        (lambda: sweep_boxes([0] * 3, [0] * 3, [1] * 3, [0] * 3, [0] * 3, [1, 1, 1], -1.0), "dt must be zero or pos"),
        (lambda: sweep_sphere_sphere([0] * 3, [0] * 3, -1, [0] * 3, [0] * 3, 2, 1.0), "radius_a"),
        (lambda: sweep_sphere_sphere([0] * 3, [0] * 3, 1, [0] * 3, [0] * 3, 2, math.nan), "dt must be"),
        (lambda: sweep_sphere_plane([0, 0, 1], [0, 0, 1], 1, [0, 0, 0], 1, 1), "normal is zero"),
        (lambda: sweep_sphere_triangle([0, 0, 1], [0, 0, 1], 1, np.zeros((2, 3)), 1), r"triangle must have shape"),
        (
            lambda: sweep_oriented_boxes([0] * 3, [0] * 3, 2 * np.eye(3), [1] * 3, np.eye(3), [1] * 3, 1.0),
            "axes_a must be rotation matrices",
        ),
        (
            lambda: sweep_oriented_boxes([0] * 3, [0] * 3, np.eye(3), [1] * 3, np.ones(3), [1] * 3, 1.0),
            r"axes_b must have shape \(\.\.\., 3, 3\)",
        ),
    ],
)
def test_an_invalid_sweep_is_refused_by_name_and_value(call, complaint):
    with pytest.raises(ValueError, match=complaint):
        call()


def test_a_thousand_sweeps_at_once_are_the_same_as_one_at_a_time():
    rng = np.random.default_rng(7)
    x, u = rng.uniform(-2, 2, (2, 4, 5, 3))
    dt = rng.uniform(0.5, 2, 5)
    together = sweep_sphere_triangle(x, u, 0.2, TRIANGLE, dt)
    assert together.shape == (4, 5)
    for i, j in np.ndindex(4, 5):
        assert together[i, j] == sweep_sphere_triangle(x[i, j], u[i, j], 0.2, TRIANGLE, dt[j])
