from __future__ import annotations

import importlib
import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles import oracle

from solutions.polyhedra import (
    edges_through_faces,
    mesh_edges,
    mesh_report,
    orient2d,
    orient3d,
    polyhedra_intersect,
    segment_meets_triangle,
    segment_plane,
    segment_triangle,
    side_of_line,
    signed_volume,
)

surface = importlib.import_module("solutions.polyhedra.surface")

# Coarse numbers make points on lines and in planes common; fine ones are as floats come; mixed sizes lose digits.
COARSE = st.integers(-3, 3).map(float)
FINE = st.floats(-10, 10)
MIXED = st.one_of(COARSE, FINE, st.floats(-1e-12, 1e-12), st.floats(1e12, 1e15), st.sampled_from([0.1, 0.2, 0.3, 0.7]))


def points(size, count, number=MIXED):
    return st.lists(st.tuples(*[number] * size), min_size=count, max_size=count)


def minus(a, b):
    return [Fraction(x) - Fraction(y) for x, y in zip(a, b, strict=True)]


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def dot(u, v):
    return sum(x * y for x, y in zip(u, v, strict=True))


def sign(value):
    return (value > 0) - (value < 0)


def exact_orient3d(a, b, c, d):
    return sign(dot(cross(minus(b, a), minus(c, a)), minus(d, a)))


CUBE = np.array(list(itertools.product([0.0, 1.0], repeat=3)))
LOW_X, HIGH_X = [[0, 1, 3], [0, 3, 2]], [[4, 6, 7], [4, 7, 5]]
LOW_Y, HIGH_Y = [[0, 4, 5], [0, 5, 1]], [[2, 3, 7], [2, 7, 6]]
LOW_Z, HIGH_Z = [[0, 2, 6], [0, 6, 4]], [[1, 5, 7], [1, 7, 3]]
CUBE_FACES = np.array([*LOW_Z, *HIGH_Z, *LOW_Y, *HIGH_Y, *LOW_X, *HIGH_X])


# Signs


def test_the_plain_side_of_a_line_is_the_exact_one_away_from_it():
    a, b = np.array([0.5, -1.25]), np.array([3.0, 0.75])
    along, aside = np.random.default_rng(4).uniform(-9, 9, (2, 200, 1))
    c = a + along * (b - a) + aside * [-2, 2.5]
    assert side_of_line(a, b, c).tolist() == np.sign(aside[:, 0]).tolist() == orient2d(a, b, c).tolist()
    assert side_of_line(b, a, c).tolist() == (-np.sign(aside[:, 0])).tolist()
    assert side_of_line([[0, 0], [1, 2]], [2, 4], [[3, 6], [1, 2]]).tolist() == [0, 0]


@pytest.mark.statement(9, oracle="Kettner et al. (2008)")
def test_close_to_a_diagonal_the_plain_side_of_a_line_is_wrong_for_one_point_in_five():
    close = 0.5 + np.stack(np.indices((256, 256)), axis=-1) * 2.0**-53
    q, r = [12.0, 12.0], [24.0, 24.0]
    assert np.sum(side_of_line(close, q, r) != orient2d(close, q, r)) == 11972
    # the differences are taken from the first corner, so another one gives another count
    assert np.sum(side_of_line(q, r, close) != orient2d(q, r, close)) == 5752


@pytest.mark.statement(9, oracle="exact fractions")
@given(points(2, 3))
def test_exact_fractions_give_the_same_side_of_a_line(three):
    a, b, c = three
    u, v = minus(b, a), minus(c, a)
    assert orient2d(a, b, c) == sign(u[0] * v[1] - u[1] * v[0])


@pytest.mark.statement(9, oracle="exact fractions")
@given(points(3, 4))
def test_exact_fractions_give_the_same_side_of_a_face(four):
    assert orient3d(*four) == exact_orient3d(*four)


@pytest.mark.statement(9, oracle="exact fractions")
@given(points(3, 3, FINE), st.floats(-2, 2), st.floats(-2, 2), st.integers(-2, 2))
def test_a_point_a_last_digit_off_the_plane_is_known(three, s, t, steps):
    a, b, c = np.array(three)
    d = a + s * (b - a) + t * (c - a)  # in the plane, but for rounding
    for _ in range(abs(steps)):
        d = np.nextafter(d, np.inf * steps)
    assert orient3d(a, b, c, d) == exact_orient3d(a, b, c, d)


@given(points(3, 4))
def test_two_corners_swapped_turn_the_face_round(four):
    a, b, c, d = four
    assert orient3d(a, b, c, d) == -orient3d(b, a, c, d) == -orient3d(a, b, d, c) == orient3d(b, c, a, d)


def test_signs_are_right_at_both_ends_of_the_range_of_floats():
    tiny, huge = 5e-324, 1e100
    assert orient2d([0, 0], [tiny, 0], [0, tiny]) == 1
    assert orient2d([0, 0], [huge, 0], [1, -tiny]) == -1
    assert orient2d([0, 0], [1e200, 1e-200], [1e200, 0]) == -1
    assert orient3d([0, 0, 0], [huge, 0, 0], [0, huge, 0], [huge, huge, -tiny]) == -1
    assert orient2d(np.zeros((4, 1, 2)), [1, 0], [[0, 1], [0, -1], [2, 0]]).tolist() == [[1, -1, 0]] * 4
    with pytest.raises(ValueError, match="b must be finite"):
        orient2d([0, 0], [np.nan, 0], [1, 1])
    with pytest.raises(ValueError, match=r"c must have shape \(..., 2\)"):
        orient2d([0, 0], [1, 0], [1, 1, 1])


def test_the_smallest_possible_triangles_have_the_right_sign():
    # neighbouring Fibonacci numbers span an area of exactly one unit in the last place squared
    fibonacci = [0, 1]
    while len(fibonacci) < 77:
        fibonacci.append(fibonacci[-1] + fibonacci[-2])
    far = 2.0**52  # from here to 2^53 floats are the whole numbers
    for n in (74, 75):
        a, b, c = ([far + x, far + y] for x, y in ((0, 0), fibonacci[n : n - 2 : -1], fibonacci[n + 1 : n - 1 : -1]))
        expected = fibonacci[n] ** 2 - fibonacci[n - 1] * fibonacci[n + 1]
        assert abs(expected) == 1
        assert orient2d(a, b, c) == expected
        assert orient3d([*a, far], [*b, far], [*c, far], [far, far, far + 1]) == expected


# A segment and a plane


@pytest.mark.statement(9, oracle="the definition, in fractions")
@given(points(3, 2, COARSE), st.tuples(*[COARSE] * 3).filter(any), COARSE)
def test_exact_fractions_give_the_same_point_of_a_plane(ends, normal, offset):
    s0, s1 = (dot(map(Fraction, p), map(Fraction, normal)) + Fraction(offset) for p in ends)
    t = segment_plane(*ends, normal, offset)
    if s0 * s1 > 0:
        assert t == np.inf
    else:
        assert t == pytest.approx(float(s0 / (s0 - s1)) if s0 != s1 else 0.0, abs=1e-15)  # a quotient of roundings


def test_a_segment_in_the_plane_meets_it_at_its_start():
    assert segment_plane(
        [[0, 0, 0], [0, 0, 1], [0, 0, 1]], [[1, 0, 0], [1, 0, 1], [0, 0, 0]], [0, 0, 2], 0
    ).tolist() == [
        0,
        np.inf,
        1,
    ]
    with pytest.raises(ValueError, match="normal is zero"):
        segment_plane([0, 0, 0], [1, 0, 0], [0, 0, 0], 0)
    with pytest.raises(ValueError, match="end must be finite"):
        segment_plane([0, 0, 0], [np.inf, 0, 0], [0, 0, 1], 0)


# A segment and a triangle


def exact_meeting(p, q, triangle):
    """In fractions: the first t at which p + t (q − p) is in the triangle, or None."""
    a, b, c = triangle
    normal = cross(minus(b, a), minus(c, a))
    low, high = Fraction(0), Fraction(1)
    bounds = [(normal, a), ([-x for x in normal], a)]  # both sides of the plane, then the three sides of the triangle
    bounds += [(cross(normal, minus(end, start)), start) for start, end in ((a, b), (b, c), (c, a))]
    for inward, at in bounds:
        s0, s1 = dot(inward, minus(p, at)), dot(inward, minus(q, at))
        if s0 < 0 and s1 < 0:
            return None
        if s0 < 0:
            low = max(low, s0 / (s0 - s1))
        elif s1 < 0:
            high = min(high, s0 / (s0 - s1))
    return low if low <= high else None


@pytest.mark.statement(9, oracle="exact fractions, by clipping")
@given(points(3, 5, COARSE))
def test_exact_fractions_give_the_same_point_of_a_triangle(five):
    p, q, *triangle = five
    assume(any(cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))))
    expected = exact_meeting(p, q, triangle)
    t, weights = segment_triangle(p, q, triangle)
    assert bool(segment_meets_triangle(p, q, triangle)) == (expected is not None)
    if expected is None:
        assert t == np.inf
        assert np.all(np.isnan(weights))
    else:
        assert t == pytest.approx(float(expected), abs=1e-15)  # of small whole numbers: one quotient
        assert np.all(weights >= 0)
        there = np.array(p) + t * (np.array(q) - p)
        assert weights @ np.array(triangle) == pytest.approx(there, abs=1e-14)  # some roundings of numbers up to 3


@pytest.mark.statement(9, oracle="exact fractions, by clipping")
@given(points(3, 5, st.one_of(FINE, COARSE)))
def test_whether_they_meet_is_exact_for_any_floats(five):
    p, q, *triangle = five
    assume(any(cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))))
    assert bool(segment_meets_triangle(p, q, triangle)) == (exact_meeting(p, q, triangle) is not None)


FLAT = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0.0]])


def test_in_its_plane_a_triangle_is_met_at_a_side_or_at_the_start():
    start = [[-1, 1, 0], [1, 1, 0], [-1, 1, 0], [-2, 2, 0], [5, 5, 0], [-1, 5, 0], [-4, 0, 0]]
    end = [[1, 1, 0], [9, 9, 0], [-2, 1, 0], [2, -2, 0], [9, 9, 0], [5, -1, 0], [4, 0, 0]]
    t, weights = segment_triangle(start, end, FLAT)
    # through a side; from within; away; through a corner; beyond; along the long side; along another
    assert t == pytest.approx([0.5, 0, np.inf, 0.5, np.inf, 1 / 6, 0.5], abs=1e-16)
    assert weights[[0, 3, 5, 6]] == pytest.approx(
        np.array([[0.75, 0, 0.25], [1, 0, 0], [0, 0, 1], [1, 0, 0]]), abs=1e-15
    )


@pytest.mark.statement(9, oracle="exact fractions, by clipping")
@given(st.integers(0, 2**32), st.permutations(range(3)), st.lists(st.integers(-3, 3), min_size=4, max_size=4))
def test_exact_fractions_give_the_same_point_along_or_beside_a_side(seed, order, way):
    # sides with 24 digits: small multiples are exact, so the segment is in the plane, cross products are not
    rng = np.random.default_rng(seed)
    e, f = rng.normal(size=(2, 3)).astype(np.float32).astype(float) * 2.0 ** rng.integers(-20, 21)
    corners = np.array([0 * e, e, f])[order]
    i, j, k, m = way
    for p, q in ((i * e, k * e), (i * e + j * f, k * e + j * f), (i * e + j * f, k * e + m * f)):
        expected = exact_meeting(p, q, corners)
        t, weights = segment_triangle(p, q, corners)
        if expected is None:
            assert t == np.inf
        else:
            assert t == pytest.approx(float(expected), abs=1e-12)  # some roundings; of flat triangles more
            size = np.max(np.abs([p, q, *corners]))
            assert weights @ corners == pytest.approx(p + t * (q - p), abs=1e-13 * size)


@pytest.mark.statement(9, oracle="exact fractions, by clipping")
@pytest.mark.parametrize(
    ("scale", "lift"),
    [
        *((1.0, lift) for lift in (0.0, 1e-17, 1e-13, 1.0)),
        *((scale, 1e-15) for scale in (1e-6, 1e6)),
        *(pytest.param(1.0, lift, marks=pytest.mark.slow) for lift in (1e-15, 1e-9)),
        *(
            pytest.param(scale, lift, marks=pytest.mark.weekly)
            for scale in (1e-6, 1e6)
            for lift in (0.0, 1e-17, 1e-13, 1e-9, 1.0)
        ),
    ],
)
def test_a_segment_meets_a_triangle_at_one_point_at_any_angle(scale, lift):
    rng = np.random.default_rng(8)
    corners = rng.normal(size=(150, 3, 3))
    a, b, c = np.moveaxis(corners, 1, 0)
    along = rng.normal(size=(150, 3)) * [1, 1, lift]
    u = np.vecdot(along[..., None], np.stack([b - a, c - a, np.cross(b - a, c - a)], axis=1), axis=1)
    p = np.vecdot(rng.dirichlet(np.ones(3), 150)[..., None], corners, axis=1) - rng.uniform(-0.1, 1.1, (150, 1)) * u
    p, q, triangles = scale * p, scale * (p + u), scale * corners
    t, weights = segment_triangle(p, q, triangles)
    meets = np.isfinite(t)
    assert meets.tolist() == [exact_meeting(*row) is not None for row in zip(p, q, triangles, strict=True)]
    assert np.sum(meets) > 10  # nearly in the plane, rounding lifts many off it
    assert weights[meets].sum(axis=-1) == pytest.approx(1, abs=1e-15)  # a rounding or two
    on_triangle = np.vecdot(weights[..., None], triangles, axis=1)[meets]
    # roundings of lengths up to 20, a hundred times more in the flattest of these triangles
    assert on_triangle == pytest.approx((p + t[:, None] * (q - p))[meets], abs=1e-12 * scale)


def test_in_the_plane_a_segment_passes_a_corner_or_only_touches_a_side():
    # past the corner (4, 0): each end is on the inner side of one of the two sides there, none parts them
    past, touches = [[3, -1, 0], [6, 1, 0]], [[2, -1, 0], [2, 0, 0]]
    for order in itertools.permutations(range(3)):
        for (p, q), there, back in ((past, np.inf, np.inf), (touches, 1, 0)):
            assert segment_triangle(p, q, FLAT[list(order)])[0] == there
            assert segment_triangle(q, p, FLAT[list(order)])[0] == back


def test_a_point_is_a_segment_and_nothing_meets_a_flat_triangle():
    assert segment_meets_triangle([1, 1, 0], [1, 1, 0], FLAT)
    assert not segment_meets_triangle([3, 3, 0], [3, 3, 0], FLAT)
    assert not segment_meets_triangle([1, 1, 1], [1, 1, 1], FLAT)
    assert not segment_meets_triangle([0, 0, -1], [0, 0, 1], FLAT * [1, 0, 0])
    with pytest.raises(ValueError, match="triangle must have an area"):
        segment_triangle([0, 0, -1], [0, 0, 1], FLAT * [1, 0, 0])
    with pytest.raises(ValueError, match="triangle must have shape"):
        segment_triangle([0, 0, -1], [0, 0, 1], FLAT[:2])
    t, weights = segment_triangle(np.zeros((5, 1, 3)) - [0, 0, 1], [1, 1, 1], np.stack([FLAT, FLAT]))
    assert (t.shape, weights.shape) == ((5, 2), (5, 2, 3))
    assert t == pytest.approx(0.5)


# Two polyhedra


def boxes_touch(low_a, size_a, low_b, size_b):
    return all(x <= y + t and y <= x + s for x, s, y, t in zip(low_a, size_a, low_b, size_b, strict=True))


WHOLE, SIDE = st.tuples(*[st.integers(-3, 3)] * 3), st.tuples(*[st.integers(1, 5)] * 3)


@pytest.mark.statement(9, oracle="the intervals of two boxes")
@given(WHOLE, SIDE, WHOLE, SIDE)
def test_two_boxes_intersect_when_their_intervals_do_on_all_axes(low_a, size_a, low_b, size_b):
    a, b = CUBE * size_a + low_a, CUBE * size_b + low_b
    expected = boxes_touch(low_a, size_a, low_b, size_b)
    assert polyhedra_intersect(a, CUBE_FACES, b, CUBE_FACES) == expected
    assert polyhedra_intersect(b, CUBE_FACES, a, CUBE_FACES[:, ::-1]) == expected


def test_a_cube_within_another_intersects_it_without_meeting_edges():
    small = CUBE / 4 + 0.3
    assert not len(edges_through_faces(small, CUBE_FACES, CUBE, CUBE_FACES)[1])
    assert polyhedra_intersect(small, CUBE_FACES, CUBE, CUBE_FACES)
    assert polyhedra_intersect(CUBE, CUBE_FACES, small, CUBE_FACES)
    assert not polyhedra_intersect(small + 2, CUBE_FACES, CUBE, CUBE_FACES)


def test_a_cube_in_the_hollow_of_another_does_not_intersect_it():
    hollow = np.concatenate([CUBE, CUBE * 0.8 + 0.1]), np.concatenate([CUBE_FACES, CUBE_FACES[:, ::-1] + 8])
    assert not polyhedra_intersect(CUBE / 4 + 0.3, CUBE_FACES, *hollow)
    assert polyhedra_intersect(CUBE / 4 - 0.1, CUBE_FACES, *hollow)


def test_a_bar_through_a_cube_meets_two_of_its_sides_with_four_edges():
    bar = (CUBE - 0.5) * [4, 0.25, 0.125] + [0.5, 0.45, 0.31]
    edge, face = edges_through_faces(bar, CUBE_FACES, CUBE, CUBE_FACES)
    along = np.ptp(bar[edge], axis=1)[:, 0] > 0
    assert np.all(along)
    assert len(np.unique(edge, axis=0)) >= 4
    assert set(face.tolist()) <= {8, 9, 10, 11}  # the two sides across x
    t, _ = segment_triangle(*np.moveaxis(bar[edge], 1, 0), CUBE[CUBE_FACES[face]])
    x = bar[edge[:, 0], 0] + t * (bar[edge[:, 1], 0] - bar[edge[:, 0], 0])
    assert np.all((np.abs(x) < 1e-15) | (np.abs(x - 1) < 1e-15))  # a quotient and a product of numbers near 1
    # in return only the diagonals of those two sides meet the bar
    diagonals = edges_through_faces(CUBE, CUBE_FACES, bar, CUBE_FACES)[0]
    assert {tuple(pair) for pair in diagonals.tolist()} == {(0, 3), (4, 7)}


def test_a_bar_through_a_cube_is_found_by_its_own_edges_alone():
    bar = (CUBE - 0.5) * [4, 0.1, 0.1] + [0.5, 0.75, 0.2]  # beside the diagonals of the sides across x
    assert len(edges_through_faces(bar, CUBE_FACES, CUBE, CUBE_FACES)[1])
    assert not len(edges_through_faces(CUBE, CUBE_FACES, bar, CUBE_FACES)[1])
    assert polyhedra_intersect(bar, CUBE_FACES, CUBE, CUBE_FACES)
    assert polyhedra_intersect(CUBE, CUBE_FACES, bar, CUBE_FACES)


def test_edges_meet_faces_whichever_corner_comes_first():
    spike = np.array([[6, 6, 6], [-3, 0, 0], [0, -3, 0], [0, 0, -3.0]])
    sides = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    crumb = (CUBE - 0.5) / 4 + [-0.75, -0.75, 0.6]  # on a side of the spike, far from its point
    for first in range(3):
        turned = np.roll(sides, first, axis=1)
        edge, face = edges_through_faces(crumb, CUBE_FACES, spike, turned)
        assert len(edge) > 2
        assert set(face.tolist()) == {0}
        assert polyhedra_intersect(crumb, CUBE_FACES, spike, turned)


# The report on a mesh


def faults(report):
    return {name: np.asarray(found).tolist() for name, found in vars(report).items() if len(found)}


def test_a_cube_bounds_a_solid_even_as_loose_triangles():
    report = mesh_report(CUBE, CUBE_FACES)
    assert report.bounds_a_solid
    assert report.is_watertight
    assert report.is_oriented
    assert signed_volume(CUBE, CUBE_FACES) == 1
    assert len(mesh_edges(CUBE, CUBE_FACES)) == 18
    assert mesh_report(CUBE[CUBE_FACES].reshape(-1, 3), np.arange(36).reshape(-1, 3)).bounds_a_solid
    assert mesh_report(np.zeros((0, 3)), np.zeros((0, 3), dtype=int)).bounds_a_solid


def test_each_fault_of_a_mesh_is_found_and_no_other():
    lost = CUBE_FACES[1:]
    assert faults(mesh_report(CUBE, lost)) == {"open_edges": [[0, 2], [0, 6], [2, 6]]}
    turned = np.concatenate([CUBE_FACES[:1, ::-1], lost])
    assert faults(mesh_report(CUBE, turned)) == {"twisted_edges": [[0, 2], [0, 6], [2, 6]]}
    again = np.concatenate([CUBE_FACES, CUBE_FACES[:1, [1, 2, 0]]])
    found = faults(mesh_report(CUBE, again))
    assert (found["duplicate_faces"], found["crossing_faces"]) == ([12], [[0, 12]])
    assert found["crowded_edges"] == found["open_edges"] == [[0, 2], [0, 6], [2, 6]]
    idle = np.concatenate([CUBE_FACES, [[3, 3, 5]]])
    assert faults(mesh_report(CUBE, idle)) == {"degenerate_faces": [12]}


def test_faces_cross_only_in_cubes_that_intersect():
    def two(shift):
        return mesh_report(np.concatenate([CUBE, CUBE + shift]), np.concatenate([CUBE_FACES, CUBE_FACES + 8]))

    assert two(3.0).bounds_a_solid
    through = two(0.37)
    assert set(faults(through)) == {"crossing_faces"}
    assert np.all((through.crossing_faces < 12) == [True, False])


def test_faces_that_share_a_corner_cross_only_if_they_share_more():
    corners = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [1, 1, 1], [1, 1, -1], [-1, -1, 1], [-1, -2, 1], [1, 0.5, 0]])

    def crossing(one, other):
        # whichever corner comes first
        found = {
            len(mesh_report(corners, [np.roll(one, i), np.roll(other, j)]).crossing_faces)
            for i, j in itertools.product(range(3), repeat=2)
        }
        assert len(found) == 1
        return found.pop()

    assert crossing([0, 1, 2], [0, 3, 4]) == 1  # at the corner 0, and through the opposite side
    assert crossing([0, 1, 2], [0, 5, 6]) == 0
    assert crossing([0, 1, 2], [1, 0, 7]) == 1  # folded onto it
    assert crossing([0, 1, 2], [1, 0, 3]) == 0
    flat = corners * [1, 1, 0] - [0, 0.5, 0] * (np.arange(8) == 7)[:, None] * 2
    for first in range(3):
        beside = [[0, 1, 2], np.roll([1, 0, 7], first)]  # in one plane
        assert len(mesh_report(flat, beside).crossing_faces) == 0


def test_pairs_do_not_depend_on_the_size_of_a_block(monkeypatch):
    both = np.concatenate([CUBE, CUBE + 0.37]), np.concatenate([CUBE_FACES, CUBE_FACES + 8])
    crossing, pairs = mesh_report(*both).crossing_faces, edges_through_faces(CUBE, CUBE_FACES, CUBE + 0.37, CUBE_FACES)
    assert len(crossing)
    assert len(pairs[1])
    monkeypatch.setattr(surface, "PAIRS", 7)
    assert np.array_equal(mesh_report(*both).crossing_faces, crossing)
    again = edges_through_faces(CUBE, CUBE_FACES, CUBE + 0.37, CUBE_FACES)
    assert all(np.array_equal(one, other) for one, other in zip(again, pairs, strict=True))


@pytest.mark.statement(9, oracle="trimesh's watertight and winding checks")
@pytest.mark.parametrize("lost", [0, 1])
def test_trimesh_agrees_what_is_watertight_and_oriented(lost):
    trimesh = oracle("trimesh")
    mesh = trimesh.creation.torus(2.0, 0.7, major_sections=8, minor_sections=6)
    vertices, faces = np.asarray(mesh.vertices), np.asarray(mesh.faces)[lost:]
    theirs = trimesh.Trimesh(vertices, faces, process=False)
    report = mesh_report(vertices, faces)
    assert report.is_watertight == theirs.is_watertight == (not lost)
    assert report.is_oriented == theirs.is_winding_consistent
    assert not len(report.crossing_faces)
