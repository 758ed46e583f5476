from __future__ import annotations

import functools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles import oracle

from solutions.sweeping import (
    UndecidedWarning,
    advancement,
    edge_edge_impact,
    features,
    motion_bound,
    nearest_on_triangle,
    ray_box,
    ray_capsule,
    rotated,
    separation_of_hulls,
    sweep_convex,
    sweep_sphere_sphere,
    vertex_face_impact,
)

TOLERANCE = 1e-6  # how near is a touch, m; by default for bodies of 1 m
COARSE = st.integers(-8, 8).map(lambda value: value / 4)
VECTOR = st.tuples(COARSE, COARSE, COARSE)
CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
STILL = np.zeros(3)


def differences(kind, first, second):
    """Of one instant: the corners of the triangle, or of the two triangles, that must not reach the origin."""
    if kind == "vertex-face":
        return (first[None] - second)[None]
    (p, q), (r, s) = first, second
    return np.array([[p - r, p - s, q - r], [p - s, q - r, q - s]])


def distance_at(kind, query, time):
    """How far apart the two features are at a share of the step; scipy minimises over the weights."""
    from scipy.optimize import nnls  # noqa: PLC0415

    start, end = differences(kind, *query[:2]), differences(kind, *query[2:])
    best = math.inf
    for corners in start + time * (end - start):
        weight = 1e4  # of the row that makes the sum of the weights one
        shares, _ = nnls(np.vstack([corners.T, np.full(3, weight)]), np.array([0.0, 0, 0, weight]))
        best = min(best, float(np.linalg.norm(corners.T @ (shares / shares.sum()))))
    return best


def queries(kind, count, seed):
    """Random steps (start and end) in a cube of 2 m."""
    rng = np.random.default_rng(seed)
    shapes = ((count, 3), (count, 3, 3)) if kind == "vertex-face" else ((count, 2, 3), (count, 2, 3))
    return [rng.uniform(-1, 1, shape) for shape in shapes * 2]


def meeting(kind, count, seed):
    """Random steps made so that the features meet at a share known beforehand, perhaps not for the first time."""
    rng = np.random.default_rng(seed)
    query, time = queries(kind, count, seed), rng.uniform(0, 1, count)
    at = [
        start + (end - start) * time.reshape(-1, *[1] * (start.ndim - 1))
        for start, end in zip(query[:2], query[2:], strict=True)
    ]
    if kind == "vertex-face":
        shift = at[0] - np.einsum("ni,nij->nj", rng.dirichlet(np.ones(3), count), at[1])
        return [query[0], query[1] + shift[:, None], query[2], query[3] + shift[:, None]], time
    on = [np.einsum("ni,nij->nj", rng.dirichlet(np.ones(2), count), edge) for edge in at]
    shift = (on[0] - on[1])[:, None]
    return [query[0], query[1] + shift, query[2], query[3] + shift], time


IMPACT = {
    "vertex-face": functools.partial(vertex_face_impact, tolerance=TOLERANCE),
    "edge-edge": functools.partial(edge_edge_impact, tolerance=TOLERANCE),
}
KINDS = pytest.mark.parametrize("kind", list(IMPACT))


# A corner and a face, two edges


@KINDS
@pytest.mark.statement(10, oracle="steps made so that the features meet at a known time")
def test_no_meeting_is_missed_and_none_is_late(kind):
    query, time = meeting(kind, 1_500, 1)
    found = IMPACT[kind](*query)
    # the meeting was set up with rounding, 1e-15 m of a tolerance of 1e-6 m: none may be later at all
    assert np.all(found <= time)


@KINDS
@pytest.mark.statement(10, oracle="ipctk's tight inclusion, and scipy's non-negative least squares")
@pytest.mark.parametrize("count", [200, pytest.param(15_000, marks=pytest.mark.weekly)])
def test_every_hit_of_ipctk_is_found_unless_the_features_stay_apart(kind, count):
    ipctk = oracle("ipctk")
    query = queries(kind, count, 2)
    found = IMPACT[kind](*query)
    ccd = ipctk.TightInclusionCCD()
    ask = ccd.point_triangle_ccd if kind == "vertex-face" else ccd.edge_edge_ccd
    for row, ours in zip(zip(*query, strict=True), found, strict=True):
        points = [point for feature in row for point in np.atleast_2d(feature)]
        hit, theirs = ask(*points)
        assert hit or ours == math.inf  # ipctk never misses: what it calls free is free
        if hit and ours > theirs + 1e-2:  # it keeps a distance that grows with that at the start: they only pass by
            nearby = np.linspace(theirs - 0.01, theirs + 0.01, 201)
            until_ours = np.linspace(theirs, min(ours, 1.0), 200)[: 200 if ours == math.inf else -1]
            looks = np.clip(np.concatenate([nearby, until_ours]), 0, 1)
            assert min(distance_at(kind, row, time) for time in looks) > TOLERANCE
        elif hit:
            # theirs is before the true contact, ours too; ours may be nearer to it by what theirs keeps
            assert distance_at(kind, row, float(ours)) <= TOLERANCE + 1e-8  # the oracle's own rounding
            assert ours >= theirs - 1e-3


def exact_meeting(kind, count, seed, flat):
    """Steps in eighths of a metre that meet half-way, in a corner, on an edge or inside; flat: all in one plane."""
    rng = np.random.default_rng(seed)
    shapes = ((count, 3), (count, 3, 3)) if kind == "vertex-face" else ((count, 2, 3), (count, 2, 3))
    middle, half_way = ([rng.integers(-8, 9, shape) / 8 for shape in shapes] for _ in range(2))
    if flat:
        for array in (*middle, *half_way):
            array[..., 2] = 0
    weights = {2: [[1, 0], [0.5, 0.5], [0.25, 0.75]], 3: [[1, 0, 0], [0.5, 0.5, 0], [0.25, 0.25, 0.5]]}
    on = [
        array if array.ndim == 2 else np.einsum("ni,nij->nj", rng.choice(weights[array.shape[1]], count), array)
        for array in middle
    ]
    middle[1] = middle[1] + (on[0] - on[1])[:, None]
    return [m - h for m, h in zip(middle, half_way, strict=True)] + [
        m + h for m, h in zip(middle, half_way, strict=True)
    ]


MORE = pytest.param(100_000, marks=pytest.mark.weekly)


@KINDS
@pytest.mark.parametrize("flat", [False, True])
@pytest.mark.parametrize("count", [1_000, MORE])
@pytest.mark.statement(10, oracle="steps of eighths that meet exactly half-way")
def test_no_exact_meeting_is_missed_or_late(kind, flat, count):
    # every number is a multiple of 1/32 below 4: no rounding, so that not even the last digit may be late
    assert np.all(IMPACT[kind](*exact_meeting(kind, count, 5, flat)) <= 0.5)


@KINDS
@pytest.mark.parametrize("count", [300, pytest.param(1_000, marks=pytest.mark.weekly)])
@pytest.mark.statement(10, oracle="ipctk's tight inclusion")
def test_exact_steps_that_ipctk_hits_are_hit_no_later(kind, count):
    ipctk = oracle("ipctk")
    ccd = ipctk.TightInclusionCCD(TOLERANCE, 1000)
    ask = ccd.point_triangle_ccd if kind == "vertex-face" else ccd.edge_edge_ccd
    query = exact_meeting(kind, count, 6, False)  # in one plane, where features touch all along, it refines for minutes
    found = IMPACT[kind](*query)
    for row, ours in zip(zip(*query, strict=True), found, strict=True):
        hit, theirs = ask(*[point for feature in row for point in np.atleast_2d(feature)])
        assert hit
        assert ours <= 0.5
        # Both are early; theirs by a distance that grows with that at the start, ours until it is near enough.
        assert ours >= theirs - 1e-3 or distance_at(kind, row, float(ours)) <= TOLERANCE + 1e-8


@KINDS
@pytest.mark.weekly
@pytest.mark.statement(10, oracle="steps made so that the features meet at a known time")
def test_no_meeting_of_many_more_is_missed_and_none_is_late(kind):
    query, time = meeting(kind, 50_000, 7)
    assert np.all(IMPACT[kind](*query) <= time)


@KINDS
@pytest.mark.parametrize("count", [60, pytest.param(200, marks=pytest.mark.weekly)])
@pytest.mark.statement(10, oracle="the exact sign of the cubic in fractions")
def test_the_four_points_are_almost_coplanar_at_the_time_of_impact(kind, count):
    query, _ = meeting(kind, count, 3)
    found = IMPACT[kind](*query, tolerance=1e-7)
    ahead = 0
    for row, time in zip(zip(*query, strict=True), found, strict=True):
        points = [
            [[Fraction(float(x)) for x in p] for p in np.concatenate([np.atleast_2d(f) for f in half])]
            for half in (row[:2], row[2:])
        ]

        def volume(t, points=points):
            p, q, r, s = ([a + (b - a) * t for a, b in zip(u, v, strict=True)] for u, v in zip(*points, strict=True))
            e, f, g = ([b - a for a, b in zip(p, w, strict=True)] for w in (q, r, s))
            return (
                e[0] * (f[1] * g[2] - f[2] * g[1])
                - e[1] * (f[0] * g[2] - f[2] * g[0])
                + e[2] * (f[0] * g[1] - f[1] * g[0])
            )

        before, after = Fraction(float(time)), Fraction(float(time)) + Fraction(1, 10**4)
        # a root within a ten-thousandth of the step: the approach is seldom slower than 1e-3 m a step
        ahead += volume(before) * volume(after) <= 0
    assert ahead >= 0.98 * count


DEGENERATE = {
    # in one plane all the time: the cubic vanishes. The point runs into the edge x = 0 half-way
    "coplanar motion": ("vertex-face", [-1, 0.5, 0], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [2, 0, 0], 0.5),
    "coplanar and past it": ("vertex-face", [-1, 1.5, 0], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [2, 0, 0], math.inf),
    "resting on the face": ("vertex-face", [0.2, 0.2, 0], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [0, 0, 0], 0.0),
    "resting and parting": ("vertex-face", [0.2, 0.2, 0], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [0, 0, 1], 0.0),
    "gliding above the face": ("vertex-face", [-1, 0.2, 0.01], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [3, 0, 0], math.inf),
    "touch at the very end": ("vertex-face", [0.2, 0.2, 1], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [0, 0, -1], 1.0),
    "a triangle that is a segment": ("vertex-face", [1, 1, 0], [[0, 0, 0], [1, 0, 0], [2, 0, 0]], [0, -2, 0], 0.5),
    "a triangle that is a point": ("vertex-face", [1, 1, 0], [[0, 0, 0]] * 3, [-2, -2, 0], 0.5),
    "nothing moves": ("vertex-face", [1, 1, 1], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [0, 0, 0], math.inf),
    "on a corner": ("vertex-face", [0, 0, 2], [[0, 0, 0], [0, 1, 0], [1, 0, 0]], [0, 0, -4], 0.5),
    "parallel edges": ("edge-edge", [[0, 0, 1], [1, 0, 1]], [[0.5, 0, 0], [2, 0, 0]], [0, 0, -2], 0.5),
    "parallel, past each other": ("edge-edge", [[0, 0, 1], [1, 0, 1]], [[1.5, 0, 0], [2, 0, 0]], [0, 0, -2], math.inf),
    "parallel, end to end": ("edge-edge", [[0, 0, 1], [1, 0, 1]], [[1, 0, 0], [2, 0, 0]], [0, 0, -2], 0.5),
    "on one line": ("edge-edge", [[0, 0, 0], [1, 0, 0]], [[2, 0, 0], [3, 0, 0]], [2, 0, 0], 0.5),
    "on one line, overlapping": ("edge-edge", [[0, 0, 0], [1, 0, 0]], [[0.5, 0, 0], [3, 0, 0]], [2, 0, 0], 0.0),
    "in one plane": ("edge-edge", [[-1, 0, 0], [0, 0, 0]], [[1, -1, 0], [1, 1, 0]], [2, 0, 0], 0.5),
    "an edge without length": ("edge-edge", [[0, 0, 1], [0, 0, 1]], [[-1, 0, 0], [1, 0, 0]], [0, 0, -2], 0.5),
    "two edges without length": ("edge-edge", [[0, 0, 1], [0, 0, 1]], [[0, 0, 0], [0, 0, 0]], [0, 0, -2], 0.5),
    "crossing": ("edge-edge", [[-1, 0, 1], [1, 0, 1]], [[0, -1, 0], [0, 1, 0]], [0, 0, -2], 0.5),
    "resting across": ("edge-edge", [[-1, 0, 0], [1, 0, 0]], [[0, -1, 0], [0, 1, 0]], [0, 0, 1], 0.0),
}


@pytest.mark.statement(10, oracle="closed form for each degenerate step")
@pytest.mark.parametrize(("kind", "first", "second", "way", "expected"), DEGENERATE.values(), ids=DEGENERATE)
def test_degenerate_steps_have_the_right_time(kind, first, second, way, expected):
    first, second = np.array(first, dtype=float), np.array(second, dtype=float)
    found = float(IMPACT[kind](first, second, first + way, second))
    assert found <= expected
    if expected < math.inf:
        assert found == pytest.approx(expected, abs=TOLERANCE)  # ways of 1 m and more a step
    ipctk = oracle("ipctk")
    ccd = ipctk.TightInclusionCCD(TOLERANCE, 1000)  # where features touch all along, it would refine for seconds
    ask = ccd.point_triangle_ccd if kind == "vertex-face" else ccd.edge_edge_ccd
    hit, _ = ask(*[p for f in (first, second, first + way, second) for p in np.atleast_2d(f)])
    assert hit == (expected < math.inf)


@KINDS
@pytest.mark.statement(10, oracle="scipy's non-negative least squares")
@settings(max_examples=settings.default.max_examples * 2 // 5)
@given(st.data())
def test_coarse_steps_are_never_called_free_while_the_features_touch(kind, data):
    sizes = ((), (3,)) if kind == "vertex-face" else ((2,), (2,))
    half = [
        np.reshape(data.draw(st.lists(VECTOR, min_size=math.prod(n), max_size=math.prod(n))), (*n, 3))
        for n in sizes * 2
    ]
    found = float(IMPACT[kind](*half))
    looks = np.linspace(0, min(found, 1.0), 12)[: 12 if found == math.inf else -1]
    # before the time given, and all along a free step, they are apart; the oracle's own rounding is 1e-9
    assert found == 0 or all(distance_at(kind, half, time) > TOLERANCE / 2 - 1e-8 for time in looks)
    if found < math.inf:
        assert distance_at(kind, half, found) <= TOLERANCE + 1e-8


# Nearest points


@pytest.mark.statement(10, oracle="scipy's non-negative least squares")
def test_least_squares_find_the_same_nearest_point_of_a_triangle():
    nnls = oracle("scipy.optimize").nnls
    rng = np.random.default_rng(4)
    points, triangles = rng.uniform(-1, 1, (300, 3)), rng.uniform(-1, 1, (300, 3, 3))
    triangles[:50, 2] = triangles[:50, :2].mean(axis=1)  # no area
    triangles[50:60] = triangles[50:60, :1]  # a point
    weights = nearest_on_triangle(points, triangles)
    assert np.all(weights >= 0)
    np.testing.assert_allclose(weights.sum(axis=-1), 1, atol=1e-15)  # a rounding or two
    for point, corners, share in zip(points, triangles, weights, strict=True):
        theirs, _ = nnls(np.vstack([corners.T - point[:, None], np.full(3, 1e4)]), np.array([0, 0, 0, 1e4]))
        ours, best = (np.linalg.norm(w @ corners / w.sum() - point) for w in (share, theirs))
        assert ours == pytest.approx(best, abs=1e-7)  # the oracle weighs the sum of its weights with 1e4


@pytest.mark.statement(10, oracle="points above, beside and off a triangle, placed beforehand")
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("height", [1e-9, 1.0, 1e6])
def test_from_any_height_the_nearest_point_of_a_triangle_is_the_foot(scale, height):
    rng = np.random.default_rng(12)
    corners = rng.uniform(-1, 1, (500, 3, 3))
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=-1)
    normal, edge = normal / area[:, None], b - a
    out = np.cross(edge, normal) / np.linalg.norm(edge, axis=-1, keepdims=True)  # away from c
    weights = rng.dirichlet(np.ones(3), 500)
    on_edge = weights / weights[:, :2].sum(axis=-1, keepdims=True) * [1, 1, 0]
    for shares, way in ((weights, normal), (on_edge, out), (on_edge, normal + out)):
        foot = np.vecdot(shares[..., None], corners, axis=1)
        found = nearest_on_triangle(scale * (foot + height * way), scale * corners)
        # rounding of the height leans the foot by 1e-16 of it, the more the flatter the triangle is
        off = np.linalg.norm(np.vecdot(found[..., None], corners, axis=1) - foot, axis=-1)
        assert np.all(off < 1e-14 * (1 + height) / area)


@pytest.mark.statement(10, oracle="gaps left beforehand beside a face")
@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_narrow_gap_is_never_overestimated(scale):
    rng = np.random.default_rng(13)
    turn, other = rotated(np.eye(3), rng.normal(size=(2, 200, 1, 3))).mT
    normal = turn[:, :, 0]
    wall, corners = (turn @ CUBE.T).mT, (other @ CUBE.T).mT
    corners = corners - corners[np.arange(200), np.vecdot(corners, normal[:, None]).argmin(axis=-1)][:, None]
    foot = normal / 2 + (turn[:, :, 1:] @ rng.uniform(-0.4, 0.4, (200, 2, 1)))[..., 0]
    for gap in (1e-3, 1e-6, 1e-7, 1e-9, 0.0, -1e-9):
        body = corners + (foot + gap * normal)[:, None]
        separation, found = separation_of_hulls(scale * body, scale * wall)
        size = np.abs(body).max()
        assert np.all(separation <= scale * (gap + 4e-16) if gap > 0 else separation <= scale * 1e-15)
        if gap >= 1e-7:
            assert np.all(separation >= scale * (gap - 1e-15 * size**2 / gap))
            # n is bent by no more than rounding over the gap
            np.testing.assert_allclose(found, normal, atol=1e-15 * size / gap)


@pytest.mark.statement(10, oracle="scipy's linear programs and quadratic minimum over the weights")
def test_the_separation_of_two_hulls_is_between_their_nearest_points():
    optimize = oracle("scipy.optimize")
    rng = np.random.default_rng(5)
    apart = 0
    for _ in range(60):
        a, b = rng.uniform(-1, 1, (6, 3)), rng.uniform(-1, 1, (5, 3)) + rng.uniform(-2.5, 2.5, 3)
        separation, normal = separation_of_hulls(a, b)
        difference = (a[:, None] - b).reshape(-1, 3)
        equal = np.vstack([difference.T, np.ones(30)])
        meets = optimize.linprog(np.zeros(30), A_eq=equal, b_eq=[0, 0, 0, 1]).status == 0
        assert meets == (separation == 0)
        if separation > 0:
            apart += 1
            # n is a certificate: all of A is that far beyond B; and a point of the difference is no farther than that
            assert (difference @ normal).min() == pytest.approx(separation, abs=1e-15)
            shares, _ = optimize.nnls(np.vstack([difference.T, np.full(30, 1e3)]), np.array([0.0, 0, 0, 1e3]))
            best = np.linalg.norm(shares @ difference / shares.sum())
            assert separation == pytest.approx(best, abs=1e-5)  # the oracle weighs the sum of its weights with 1e3
            assert separation <= best + 1e-12  # a lower bound, whatever the rounding
    assert 20 < apart < 60


def test_hulls_of_points_and_of_touching_bodies_have_their_separation():
    separation, normal = separation_of_hulls([[3.0, 0, 4]], [[0.0, 0, 0]])
    assert separation == 5.0
    assert normal == pytest.approx([0.6, 0, 0.8], abs=1e-15)
    for shift in ([1.0, 0, 0], [1.0, 1, 1], [0, 0, 0], [0.3, 0.2, -0.4]):  # face, corner, the same, inside
        separation, normal = separation_of_hulls(CUBE + shift, CUBE)
        assert separation == 0
        assert normal.tolist() == [0, 0, 0]
    # two edges at d² = 4, as their nearest points are (−1, 0) and (1, 0)
    assert separation_of_hulls([[-1.0, -1, 0], [-1, 1, 0]], [[2.0, 0, 0], [1, 0, 0]])[0] ** 2 == 4.0


# Bodies that turn


@pytest.mark.statement(10, oracle="scipy's rotations")
def test_turning_a_vector_is_what_scipy_calls_a_rotation():
    rotation = oracle("scipy.spatial.transform").Rotation
    rng = np.random.default_rng(6)
    points, turns = rng.normal(size=(2, 100, 3))
    turns[:4] *= [[0.0], [1e-9], [1e-60], [10.0]]
    # a dozen roundings of numbers of order one
    np.testing.assert_allclose(rotated(points, turns), rotation.from_rotvec(turns).apply(points), atol=5e-15)


@pytest.mark.statement(10, oracle="the motion of every point, looked at a hundred times")
@given(VECTOR, VECTOR, VECTOR)
def test_no_point_of_a_turning_body_ever_moves_faster_than_its_bound(v, w, n):
    if not any(n):
        n = (0.0, 0.0, 1.0)
    n = np.array(n) / np.linalg.norm(n)
    bound = motion_bound(v, w, np.linalg.norm(CUBE[0]), n)
    places = rotated(CUBE, np.multiply.outer(np.linspace(0, 3, 100), w)[:, None, :])
    speeds = (v + np.cross(w, places)) @ n
    assert speeds.max() <= bound + 1e-13  # rounding


def test_the_end_of_a_rod_that_turns_across_reaches_its_bound():
    assert motion_bound([1, 0, 0], [0, 0, 3], 2.0, [1, 0, 0]) == 7.0
    assert motion_bound([1, 0, 0], [3, 0, 0], 2.0, [1, 0, 0]) == 1.0  # turning about n moves nothing along it
    assert motion_bound([-1, 0, 0], [0, 0, 0], 2.0, [1, 0, 0]) == -1.0


@pytest.mark.statement(10, oracle="closed form: a rod turns into a wall")
def test_a_turning_rod_meets_a_ball_when_its_line_comes_within_the_radius():
    # A rod of ±1 m on x turns at 2 rad/s towards a ball of .1 m at (.8 cos 1, .8 sin 1): met at angle 1 − asin(.1/.8).
    rod = np.array([[-1.0, 0, 0], [1, 0, 0]])
    ball = 0.8 * np.array([math.cos(1), math.sin(1), 0])
    time = sweep_convex(rod, STILL, STILL, [0, 0, 2], 0.0, [STILL], ball, STILL, STILL, 0.1, 2.0)
    expected = (1 - math.asin(0.1 / 0.8)) / 2
    assert time <= expected
    assert time == pytest.approx(expected, abs=TOLERANCE)  # at 1.6 m/s the tolerance is used up sooner
    # half the rod, about its end, is there at the same time
    half = sweep_convex(rod * [[0], [1]], STILL, STILL, [0, 0, 2], 0.0, [STILL], ball, STILL, STILL, 0.1, 2.0)
    assert expected - TOLERANCE <= half <= expected


@pytest.mark.statement(10, oracle="closed form: the tip of a rod on its circle")
@pytest.mark.parametrize("scale", [1.0, 1e-6, 1e5])
@pytest.mark.parametrize("speed", [4.0, 10.0, 200.0])
def test_a_spinning_rod_that_stays_clear_of_a_wall_never_hits_it(speed, scale):
    rod, wall = np.array([[0, -0.5, 0.1], [0, 0.5, 0.1]]), 2 * CUBE * [0.05, 2, 2]

    def meets(face, approach=0.0):
        moving = ([(face + 0.05) * scale, 0.3 * scale, 0], [-approach * scale, 0, 0], STILL)
        return float(
            sweep_convex(rod * scale, STILL, STILL, (0, 0, speed), 0.01 * scale, wall * scale, *moving, 0, 1.0)
        )

    assert meets(0.51 + 1e-2) == meets(0.51 + 1e-4) == math.inf
    expected = math.asin(0.4 / 0.5) / speed
    assert expected - 1e-6 <= meets(0.41) <= expected  # the tip comes at 1.2 m/s and more
    assert 0.01 - 1e-6 <= meets(0.51 + 1e-2, approach=1.0) <= 0.01 + math.pi / speed  # by then a tip points at it


def test_a_pair_is_undecided_where_the_rounds_are_used_up(monkeypatch):
    monkeypatch.setattr(advancement, "LOOKS", 2)
    rod, post, dt = [[-0.5, 0, 0], [0.5, 0, 0]], [0.4, 0.2, 0], [0.01, 1.0]
    with pytest.warns(UndecidedWarning, match=r"^1 of 2 pairs are undecided: they stay apart until 0\.0\d+\. "):
        found = sweep_convex(rod, STILL, STILL, (0, 0, 10), 0, [STILL], post, STILL, STILL, 0.01, dt, tolerance=1e-9)
    assert found[0] == math.inf
    assert math.isnan(found[1])


def test_pairs_at_a_steady_pace_get_more_rounds(monkeypatch):
    # Two rods that turn alike, at a right angle to each other, stay 4 cm apart or more; a turn takes some 20 looks.
    monkeypatch.setattr(advancement, "LOOKS", 100)
    first, second = [[-0.5, 0, 0], [0.5, 0, 0]], [[0, -0.5, 0], [0, 0.5, 0]]
    spin, place = [0, 0, 50.0], [0.75, 0, 0]
    assert sweep_convex(first, STILL, STILL, spin, 0, second, place, STILL, spin, 0, 1.0) == math.inf
    with pytest.warns(UndecidedWarning, match="move or turn so fast and so near to each other"):
        assert math.isnan(sweep_convex(first, STILL, STILL, spin, 0, second, place, STILL, spin, 0, 9.0))


def test_no_pairs_have_no_times():
    none, triangle, edge = np.zeros((0, 3)), np.zeros((0, 3, 3)), np.zeros((0, 2, 3))
    separation, normal = separation_of_hulls(triangle, edge)
    times = [
        vertex_face_impact(none, triangle, none, triangle),
        edge_edge_impact(edge, edge, edge, edge),
        sweep_convex(edge, none, none, none, 0, triangle, none, none, none, 0, 1.0),
        separation,
    ]
    assert [time.shape for time in times] == 4 * [(0,)]
    assert normal.shape == (0, 3)


def test_features_are_undecided_where_the_cuts_are_used_up(monkeypatch):
    monkeypatch.setattr(features, "SPLITS", 1)
    shrinking = [[0, 0, -0.25], [0, 0.25, 0]], np.zeros((2, 3)), [[0, 0, 0], [0, 0, 0.25]], np.zeros((2, 3))
    with pytest.warns(UndecidedWarning) as told:
        assert math.isnan(edge_edge_impact(*shrinking))
    assert told[0].filename == __file__
    monkeypatch.undo()
    assert edge_edge_impact(*shrinking) == pytest.approx(1 - 1e-3, abs=1e-4)  # .25 (1 − t)² m apart


@pytest.mark.statement(10, oracle="closed form: two balls on one circle")
def test_a_ball_on_a_turning_arm_meets_another_on_its_circle():
    # A ball at 45° on an arm of 1 m turns at 2 rad/s; the other is 1 rad ahead, and both have .05 m.
    arm, ball = ([math.cos(angle), math.sin(angle), 0] for angle in (math.pi / 4, math.pi / 4 + 1))
    time = sweep_convex([arm], STILL, STILL, [0, 0, 2], 0.05, [STILL], ball, STILL, STILL, 0.05, 2.0)
    expected = (1 - 2 * math.asin(0.05)) / 2
    assert time <= expected
    assert time == pytest.approx(expected, abs=TOLERANCE)  # at 2 m/s the tolerance is used up sooner


@pytest.mark.statement(10, oracle="closed form: a corner of a turning cube against a plane face")
def test_a_spinning_cube_meets_a_slab_with_its_corner():
    # Turning about z beside a large slab whose face is at x = .65: the nearest corner is at √½ cos(45° − ω t).
    slab = np.array([[1.65, 0, 0]]) + CUBE * [2, 8, 8]
    time = sweep_convex(CUBE, STILL, STILL, [0, 0, 1], 0.0, slab, STILL, STILL, STILL, 0.0, 2.0)
    expected = math.pi / 4 - math.acos(0.65 * math.sqrt(2))
    assert time <= expected
    assert time == pytest.approx(expected, abs=4 * TOLERANCE)  # it comes at .28 m/s


@pytest.mark.statement(10, oracle="many looks by scipy's least squares at bodies turned by scipy")
def test_turning_boxes_are_apart_until_the_time_given_and_touch_then():
    optimize = oracle("scipy.optimize")
    rotation = oracle("scipy.spatial.transform").Rotation
    rng = np.random.default_rng(7)
    count = 30
    a = CUBE * rng.uniform(0.3, 1.2, (count, 1, 3))
    b = CUBE * rng.uniform(0.3, 1.2, (count, 1, 3))
    x = rng.uniform(1.2, 2, (count, 1)) * (lambda d: d / np.linalg.norm(d, axis=-1, keepdims=True))(
        rng.normal(size=(count, 3))
    )
    v, wa, wb = rng.uniform(-1, 1, (count, 3)) - x, *rng.normal(scale=3, size=(2, count, 3))
    found = sweep_convex(a, STILL, STILL, wa, 0.05, b, x, v, wb, 0.02, 1.0)
    assert 5 < np.isfinite(found).sum() < count
    for i, time in enumerate(found):

        def gap(t, i=i):
            first = rotation.from_rotvec(wa[i] * t).apply(a[i])
            second = rotation.from_rotvec(wb[i] * t).apply(b[i]) + x[i] + v[i] * t
            difference = (first[:, None] - second).reshape(-1, 3)
            shares, _ = optimize.nnls(np.vstack([difference.T, np.full(64, 1e3)]), np.array([0.0, 0, 0, 1e3]))
            return np.linalg.norm(shares @ difference / shares.sum()) - 0.07

        looks = np.linspace(0, min(time, 1.0), 40)[: 40 if time == math.inf else 39]
        assert time == 0 or all(gap(t) > -1e-6 for t in looks)  # the oracle's rounding
        if time < math.inf:
            assert gap(time) <= TOLERANCE + 1e-5


def in_step(x, v, half):
    """When a ray enters a box within a step of 1 s; infinity where it does not."""
    entry, _ = ray_box(x, v, half)
    return np.where(entry <= 1, entry, math.inf)


def test_two_cubes_meet_edge_over_edge():
    # Turned by 45°, about x and about y: an edge along x of one over an edge along y of the other
    above, below = (rotated(CUBE, np.pi / 4 * axis) for axis in np.eye(3)[:2])
    entry = sweep_convex(above, [0, 0, 3], [0, 0, -1], STILL, 0.0, below, STILL, STILL, STILL, 0.0, 5.0)
    assert entry == pytest.approx(3 - math.sqrt(2), abs=TOLERANCE)


@pytest.mark.statement(10, oracle="the rays, which know no turning")
def test_bodies_that_do_not_turn_meet_when_rays_say():
    rng = np.random.default_rng(8)
    x = rng.uniform(-3, 3, (60, 3))
    v = rng.uniform(-1.5, 1.5, (60, 3)) - x
    balls = sweep_convex([STILL], x, v, STILL, 0.4, [STILL], STILL, STILL, STILL, 0.3, 1.0)
    true = sweep_sphere_sphere(x, v, 0.4, STILL, STILL, 0.3, 1.0)
    assert np.all(balls <= true)
    turn = rotated(np.eye(3), rng.normal(size=(60, 1, 3))).mT
    cubes = (turn @ CUBE.T).mT
    boxes = sweep_convex(cubes, x, v, STILL, 0.0, cubes, STILL, STILL, STILL, 0.0, 1.0)
    slabs = in_step(*(np.vecmat(each, turn) for each in (x, v)), np.ones(3))  # in their own axes
    assert np.all(boxes <= slabs + 1e-14)  # the two round apart where they overlap from the start
    for ours, theirs in ((balls, true), (boxes, slabs)):
        assert np.array_equal(np.isfinite(ours), np.isfinite(theirs))
        hit = np.isfinite(ours)
        assert 10 < hit.sum() < 60
        # near a graze the tolerance is used up at a slow approach: 1e-6 m at some 1e-2 m/s
        assert np.abs(ours[hit] - theirs[hit]).max() < 1e-4


@pytest.mark.statement(10, oracle="the slab test and the rays, which know no turning")
def test_flat_boxes_face_to_face_are_neither_missed_nor_late():
    rng = np.random.default_rng(10)
    x, v, half_a, half_b = (rng.integers(low, high, (400, 3)) / 4 for low, high in ((-12, 13),) * 2 + ((0, 5),) * 2)
    true = in_step(x, v, half_a + half_b)  # sheets, segments and points among them
    boxes = sweep_convex(2 * CUBE * half_a[:, None], x, v, STILL, 0, 2 * CUBE * half_b[:, None], *[STILL] * 3, 0, 1.0)
    corners, u = rng.uniform(-1, 1, (400, 3, 3)), rng.uniform(-1, 1, (400, 3)) - x
    rays = ray_capsule(x, u, corners[:, 0], corners[:, 1], 0.3)
    rays = np.where(rays <= 1, rays, math.inf)
    balls = sweep_convex([STILL], x, u, STILL, 0.3, corners[:, :2], STILL, STILL, STILL, 0.0, 1.0)
    for ours, expected in ((boxes, true), (balls, rays)):
        hit = np.isfinite(expected)
        assert hit.sum() > 30
        assert np.array_equal(np.isfinite(ours), hit)
        assert np.all(ours <= expected)
        assert np.all(ours[hit] >= expected[hit] - 1e-4)  # 1e-6 m at the slowest approach of some 1e-2 m/s


def test_bodies_that_overlap_part_or_stand_still_have_the_right_time():
    def sweep(x, v, w=STILL, dt=1.0):
        return sweep_convex(CUBE, x, v, w, 0.0, CUBE, STILL, STILL, STILL, 0.0, dt)

    assert sweep([0.5, 0.2, 0], [9, 0, 0]) == 0  # overlap, and part
    assert sweep([1, 0, 0], [9, 0, 0]) == 0  # touch, and part
    assert sweep([2, 0, 0], [0, 0, 0]) == math.inf
    assert sweep([2, 0, 0], [0, 0, 0], [0, 0, 5.0]) == math.inf  # spins on the spot, √½ + ½ < 2
    assert sweep([2, 0, 0], [-2, 0, 0], dt=0.0) == math.inf
    assert sweep([2, 0, 0], [0, 3, 0]) == math.inf
    assert sweep([2, 0, 0], [-2, 0, 0]) == pytest.approx(0.5, abs=TOLERANCE)


def test_bodies_within_the_tolerance_at_the_end_of_the_step_touch():
    # after 1.75 s half the tolerance is left, exactly
    for dt, expected in ((1.75, 1.75), (1.5, math.inf)):
        balls = ([STILL], [2, 0, 0], [-1, 0, 0], STILL, 0.0, [STILL], STILL, STILL, STILL, 0.0)
        assert sweep_convex(*balls, dt, tolerance=0.5) == expected
    face = np.array([[0, 0, 0], [0, 1, 0], [1, 0, 0.0]])
    for way, expected in ((1.75, 1.0), (1.5, math.inf)):
        assert vertex_face_impact([0.2, 0.2, 2], face, [0.2, 0.2, 2 - way], face, 0.5) == expected


def test_many_pairs_at_once_are_the_same_as_one_at_a_time():
    rng = np.random.default_rng(9)
    x, w = rng.uniform(1, 3, (2, 3, 3)), rng.normal(size=(3, 3))
    together = sweep_convex(CUBE, x, -2 * x, w, 0.0, CUBE, STILL, STILL, STILL, [0.0, 0.1, 0.2], 1.0)
    assert together.shape == (2, 3)
    for i, j in np.ndindex(2, 3):
        alone = sweep_convex(CUBE, x[i, j], -2 * x[i, j], w[j], 0.0, CUBE, STILL, STILL, STILL, j / 10, 1.0)
        assert together[i, j] == pytest.approx(float(alone), abs=1e-9)  # the rounds of one do not depend on the others
    cubes = CUBE * np.array([0.5, 1, 1.5])[:, None, None]  # the only ones that are many
    for a, b in ((np.add(cubes, [3, 0, 0]), CUBE), (np.add(CUBE, [3, 0, 0]), cubes)):
        assert separation_of_hulls(a, b)[0] == pytest.approx([2.25, 2, 1.75], abs=1e-15)
    for a, b in ((cubes, CUBE), (CUBE, cubes)):
        sizes = sweep_convex(a, [3, 0, 0], [-2, 0, 0], STILL, 0.0, b, STILL, STILL, STILL, 0.0, 2.0)
        assert sizes == pytest.approx([1.125, 1, 0.875], abs=TOLERANCE)  # closed form: the gap over 2 m/s
    vertex, triangle = rng.normal(size=(2, 1, 3)), rng.normal(size=(4, 3, 3))
    assert vertex_face_impact(vertex, triangle, -vertex, triangle).shape == (2, 4)


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: vertex_face_impact(STILL, CUBE[:3], STILL, CUBE[:3], 0.0), "tolerance must be positive, not 0"),
        (lambda: vertex_face_impact(STILL, CUBE[:2], STILL, CUBE[:3]), "triangle_0 must have shape"),
        (
            lambda: edge_edge_impact(CUBE[:2], CUBE[:2], CUBE[:3], CUBE[:2]),
            r"edge_a_1 must have shape \(\.\.\., 2, 3\)",
        ),
        (lambda: edge_edge_impact(CUBE[:2], CUBE[:2] * math.nan, CUBE[:2], CUBE[:2]), "edge_b_0 must be finite"),
        (lambda: motion_bound(STILL, STILL, -1, [0, 0, 1]), "reach must be zero or positive, not -1"),
        (lambda: motion_bound(STILL, STILL, 1, [0, 0, 2]), "normal must have length 1, not 2"),
        (lambda: rotated([0, 0], STILL), "point must have shape"),
        (
            lambda: separation_of_hulls(np.zeros((0, 3)), CUBE),
            r"points_a must have shape \(\.\.\., n, 3\) with a point",
        ),
        (lambda: separation_of_hulls(CUBE, STILL), r"points_b must have shape .* not \(3,\)"),
        (
            lambda: sweep_convex(STILL, STILL, STILL, STILL, 0, CUBE, STILL, STILL, STILL, 0, 1),
            r"points_a must have shape \(\.\.\., n, 3\)",
        ),
        (
            lambda: sweep_convex(CUBE, STILL, STILL, STILL, -1, CUBE, STILL, STILL, STILL, 0, 1),
            "radius_a must be zero or positive",
        ),
        (
            lambda: sweep_convex(CUBE, STILL, STILL, STILL, 0, CUBE, STILL, STILL, STILL, 0, math.inf),
            "dt must be finite, not inf",
        ),
        (
            lambda: sweep_convex(CUBE, STILL, STILL, STILL, 0, CUBE, STILL, STILL, STILL, 0, 1, 0.0),
            "tolerance must be positive, not 0",
        ),
    ],
)
def test_an_invalid_advancement_is_refused_by_name_and_value(call, complaint):
    with pytest.raises(ValueError, match=complaint):
        call()
