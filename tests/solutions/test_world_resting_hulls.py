"""Where boxes and polyhedra touch that lie on each other, and which of these places stay the same."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from oracles import oracle
from pieces_in_touch import SIZES, UPRIGHT, about, each, place, random_turns, scene, touch

from solutions.world.boxes import BOX_FACES, BOX_VERTICES
from solutions.world.hull_pairs import BIAS
from solutions.world.hulls import edges_of
from solutions.world.shapes import BOX, HALF_SPACE, POLYHEDRON


def corners_found(found, pair=0, digits=9):
    """Points of a pair in the plane, rounded, so that they can be sorted."""
    return np.array(sorted(np.round(found.point[found.pair == pair][:, :2], digits).tolist()))


def boxes_on(position, turn, half_a, half_b=(1.0, 1, 1)):
    half_a = np.asarray(half_a, dtype=float)
    height = 1 + half_a[2] - 0.01
    return place(BOX, [*position, height], turn, half_a), place(BOX, [0, 0, 0], UPRIGHT, half_b)


def test_a_tilted_tent_rests_on_the_corners_that_reach_the_ground():
    turn = about([1.0, 0, 0], 3)
    tent = place(POLYHEDRON, [0, 0, 0.2], turn)
    heights = tent.vertices[0][:, 2]
    found = touch((POLYHEDRON, HALF_SPACE), tent, place(HALF_SPACE, [0, 0, 0]), -0.08)
    assert [0, 3] == np.flatnonzero(heights <= -0.08).tolist() == found.feature.tolist()
    # one rounding of numbers of order one
    np.testing.assert_allclose(found.separation, heights[found.feature], atol=1e-15)
    np.testing.assert_allclose(found.point[:, 2], heights[found.feature] / 2, atol=1e-15)


@pytest.mark.parametrize("noise", [0.0, 1e-16, 1e-12, 1e-8])
def test_a_box_exactly_on_its_like_touches_at_its_four_corners(noise):
    rng = np.random.default_rng(12)
    turn = np.stack([about(axis, np.degrees(noise)) for axis in rng.normal(size=(30, 3))])
    a = place(BOX, np.array([0, 0, 1.99]) + noise * rng.normal(size=(30, 3)), turn, (1, 1, 1))
    found = touch((BOX, BOX), a, place(BOX, np.zeros((30, 3)), UPRIGHT, (1, 1, 1)), 0.01)
    np.testing.assert_array_equal(found.feature, np.tile(np.flatnonzero(BOX_VERTICES[:, 2] < 0), 30))
    # a corner is 1.7 m from the centre, and no draw is larger than 4
    np.testing.assert_allclose(found.point[:, :2], np.tile(BOX_VERTICES[::2, :2], (30, 1)), atol=1e-15 + 6 * noise)
    np.testing.assert_allclose(found.separation, -0.01, atol=1e-15 + 6 * noise)
    # that of B itself, although that of A is as good
    np.testing.assert_array_equal(found.normal, np.tile([0.0, 0, 1], (120, 1)))
    # where no edge is along an axis of the world, rounding is everywhere
    lean = random_turns(rng, 30)
    leaning = place(BOX, np.matvec(lean, a.position), lean @ turn, (1, 1, 1))
    found = touch((BOX, BOX), leaning, place(BOX, np.zeros((30, 3)), lean, (1, 1, 1)), 0.01)
    np.testing.assert_array_equal(found.feature, np.tile(np.flatnonzero(BOX_VERTICES[:, 2] < 0), 30))
    np.testing.assert_allclose(found.separation, -0.01, atol=1e-14 + 6 * noise)


def test_a_box_shifted_by_a_tenth_of_a_millimetre_loses_that_much():
    found = touch((BOX, BOX), *boxes_on((1e-4, 2e-4), UPRIGHT, (1, 1, 1)), 0.01)
    x, y = -1 + 1e-4, -1 + 2e-4
    np.testing.assert_allclose(corners_found(found), [[x, y], [x, 1], [1, y], [1, 1]], atol=1e-9)


@pytest.mark.parametrize("degrees", [0.01, 1, 20, 44, -0.01, -1, -20, -44])
def test_a_corner_on_a_side_is_one_place(degrees):
    shapely = oracle("shapely")
    turn = about([0, 0, 1.0], degrees)
    corner = turn @ [
        0.8,
        np.copysign(0.6, degrees),
        0,
    ]  # it is put at x = 1, on the side, and the next one is farther out
    a, b = boxes_on((1 - corner[0], 0.3), turn, (0.8, 0.6, 1))
    points = touch((BOX, BOX), a, b, 0.01).point[:, :2]
    between = np.linalg.norm(points[:, None] - points, axis=-1) + np.eye(len(points))
    assert between.min() > 1e-4
    shared = shapely.intersection(
        *(shapely.MultiPoint(base_of(v, z)).convex_hull for v, z in ((a.vertices[0], -1), (b.vertices[0], 1)))
    )
    assert shapely.MultiPoint(points).convex_hull.area == pytest.approx(shared.area, abs=1e-5)  # 3.5e-6 m on a side


@pytest.mark.parametrize("degrees", [0.05, -0.05])
def test_a_side_that_grazes_a_corner_adds_nothing_beyond_it(degrees):
    # It is nearly parallel to a side of the lower box, and passes a corner one micrometre farther out.
    turn = about([0, 0, 1.0], degrees)
    middle = np.array([1, 1, 0]) - turn @ [0.5, 2 - 1e-6, 0]
    points = touch((BOX, BOX), *boxes_on(middle[:2], turn, (3, 2, 1)), 0.01).point[:, :2]
    # up to some millionths of the size, which is 3.5 m
    assert np.abs(points).max() <= 1 + 2e-5
    assert [len(points[np.all(points * corner > 0.99, axis=1)]) for corner in BOX_VERTICES[::2, :2]] == [1, 1, 1, 1]


def test_triangles_touch_boxes_at_three_corners_or_at_four():
    # A pyramid on three corners, whose faces repeat their last one, between two boxes.
    corners = np.array([[1.0, 0, 0], [-0.5, 0.8, 0], [-0.5, -0.9, 0], [0.1, 0.1, -1]])
    faces = np.array([[0, 1, 2, 2], [0, 3, 1, 1], [1, 3, 2, 2], [2, 3, 0, 0]])
    pyramid = place(POLYHEDRON, [0, 0, 0], UPRIGHT, None, corners, faces)
    small = touch((BOX, POLYHEDRON), place(BOX, [0, 0, 0.09], UPRIGHT, (0.2, 0.15, 0.1)), pyramid)
    np.testing.assert_array_equal(small.feature, np.flatnonzero(BOX_VERTICES[:, 2] < 0))
    large = touch((BOX, POLYHEDRON), place(BOX, [0, 0, 0.99], UPRIGHT, (2, 2, 1)), pyramid)
    np.testing.assert_array_equal(large.feature, [8, 9, 10])
    cube = place(POLYHEDRON, [0, 0, 0.09], UPRIGHT, None, BOX_VERTICES / 10, BOX_FACES)
    under = touch((POLYHEDRON, POLYHEDRON), pyramid, cube)
    np.testing.assert_array_equal(under.feature, 4 + np.flatnonzero(BOX_VERTICES[:, 2] < 0))
    upside_down = place(POLYHEDRON, [0, 0, 0], about([1.0, 0, 0], 180), None, corners, faces)
    flipped = touch((BOX, POLYHEDRON), place(BOX, [0, 0, -0.09], UPRIGHT, (0.2, 0.15, 0.1)), upside_down)
    np.testing.assert_array_equal(flipped.feature, np.flatnonzero(BOX_VERTICES[:, 2] > 0))


def test_features_of_solids_with_many_edges_stay_within_16_bits():
    # Two prisms with 90 sides have 270 edges each, and so 72,900 pairs of edges.
    angle = np.arange(90) * np.pi / 45
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    corners = np.vstack([np.column_stack([ring, np.full(90, z)]) for z in (-0.5, 0.5)])
    sides = [[i, (i + 1) % 90, (i + 1) % 90 + 90, *[i + 90] * 87] for i in range(90)]
    faces = np.array([[*range(89, -1, -1)], [*range(90, 180)], *sides])
    a, b = (
        place(POLYHEDRON, [0, 0, z], about([0, 0, 1.0], turn), None, corners, faces) for z, turn in ((0, 0), (0.99, 2))
    )
    found = touch((POLYHEDRON, POLYHEDRON), a, b)
    assert len(found.feature) == 180
    assert np.all((found.feature >= 0) & (found.feature < 65536))


def test_a_box_turned_by_45_degrees_on_its_like_touches_at_eight_corners():
    found = touch((BOX, BOX), *boxes_on((0, 0), about([0, 0, 1.0], 45), (1, 1, 1)), 0.01)
    c = np.sqrt(2) - 1  # a regular octagon around a circle of radius 1
    octagon = [(x, y) for u, v in itertools.product([-1, 1], [-c, c]) for x, y in ((u, v), (v, u))]
    np.testing.assert_allclose(corners_found(found), sorted(np.round(octagon, 9).tolist()), atol=1e-9)


def test_a_box_whose_corners_are_on_the_others_sides_touches_at_four():
    diamond = about([0, 0, 1.0], 45)
    inside = touch((BOX, BOX), *boxes_on((0, 0), diamond, (np.sqrt(0.5), np.sqrt(0.5), 1)), 0.01)
    np.testing.assert_allclose(corners_found(inside), [[-1, 0], [0, -1], [0, 1], [1, 0]], atol=1e-9)
    around = touch((BOX, BOX), *boxes_on((0, 0), diamond, (np.sqrt(2), np.sqrt(2), 1)), 0.01)
    # where a side only grazes a corner, the place is on the side, within a millionth of the size, which is 3.5 m
    np.testing.assert_allclose(corners_found(around), [[-1, -1], [-1, 1], [1, -1], [1, 1]], atol=1.5e-5)


def test_bricks_flush_at_two_sides_touch_at_the_corners_of_what_they_share():
    found = touch((BOX, BOX), *boxes_on((1.0, 1.0), UPRIGHT, (2, 2, 0.5)), 0.01)
    np.testing.assert_allclose(corners_found(found), [[-1, -1], [-1, 1], [1, -1], [1, 1]], atol=1e-9)
    crossed = touch((BOX, BOX), *boxes_on((0.5, 0.25), UPRIGHT, (2, 0.5, 0.5)), 0.01)
    np.testing.assert_allclose(corners_found(crossed), [[-1, -0.25], [-1, 0.75], [1, -0.25], [1, 0.75]], atol=1e-9)


@each((BOX, BOX), (BOX, POLYHEDRON), (POLYHEDRON, POLYHEDRON))
def test_faces_touch_at_the_corners_of_what_they_share(kinds):
    shapely = oracle("shapely")
    rng = np.random.default_rng(9)
    # The upper piece stands on its base, and the lower one hangs from its own. Both bases are 0.3 m from the origin.
    yaws = np.stack([about([0, 0, 1.0], angle) for angle in rng.uniform(0, 360, 40)])
    a = place(kinds[0], np.column_stack([rng.uniform(-0.6, 0.6, (40, 2)), np.full(40, 0.599)]), yaws)
    b = place(kinds[1], np.zeros((40, 3)), about([1.0, 0, 0], 180))
    found, counts = touch(kinds, a, b, 1e-3), []
    for i in range(40):
        shared = shapely.intersection(
            *(shapely.MultiPoint(base_of(piece.vertices[i], z)).convex_hull for piece, z in ((a, -1), (b, 1)))
        )
        corners = shapely.get_coordinates(shared.normalize())[:-1]
        np.testing.assert_allclose(corners_found(found, i), sorted(np.round(corners, 9).tolist()), atol=2e-9)
        counts.append(len(corners))
    # the bases are 1 mm deep in each other, everywhere; rounding
    np.testing.assert_allclose(found.separation, -1e-3, atol=1e-14)
    assert {4, 5, 6} <= set(counts)


def base_of(vertices, sign):
    heights = sign * vertices[:, 2]
    return vertices[heights > heights.max() - 1e-9][:, :2]


def test_the_places_under_a_tilted_face_have_their_own_separations():
    tilt = about([0.2, 1.0, 0], 0.5)  # by 0.5°, about an axis in the plane
    a = place(BOX, [0.4, 0.3, 1.99], tilt @ about([0, 0, 1.0], 20), (1, 1, 1))
    found = touch((BOX, BOX), a, place(BOX, [0, 0, 0], UPRIGHT, (1.0, 1, 1)), 0.05)
    # A's face is n·(p − c) = −1; it is this far above the plane z = 1 at the same x and y
    below = a.position[0] - tilt[:, 2]
    height = below[2] - (found.point[:, :2] - below[:2]) @ tilt[:2, 2] / tilt[2, 2] - 1
    assert len(found.pair) == 5
    # some roundings of numbers of order one
    np.testing.assert_allclose(found.separation, height, atol=1e-14)
    assert np.ptp(height) > 0.01


def test_crossing_edges_touch_at_one_place():
    # Each box stands on an edge, along x and along y, and the upper edge is 0.02 below the lower one's.
    reach = np.sqrt(2) * 0.5
    a = place(BOX, [0.1, 0.2, 2 * reach - 0.02], about([1.0, 0, 0], 45), (2, 0.5, 0.5))
    b = place(BOX, [0.3, -0.1, 0], about([0, 1.0, 0], 45), (0.5, 2, 0.5))
    found = touch((BOX, BOX), a, b)
    np.testing.assert_allclose(found.point, [[0.3, 0.2, reach - 0.01]], atol=1e-14)
    np.testing.assert_allclose(found.normal, [[0, 0, 1]], atol=1e-14)
    assert found.separation == pytest.approx(-0.02, rel=1e-12)
    lowest, highest = edge_with(a.vertices[0], -1), edge_with(b.vertices[0], 1)
    np.testing.assert_array_equal(found.feature, 16 + 12 * lowest + highest)


def test_edges_touch_only_where_no_face_is_nearly_as_good():
    a, b = scene((BOX, BOX), 600, 13, 1.2)
    found = touch((BOX, BOX), a, b)
    alone = np.bincount(found.pair, minlength=600)[found.pair] == 1
    chosen = np.flatnonzero(alone & (found.feature >= 16))
    for i, separation in zip(found.pair[chosen], found.separation[chosen], strict=True):
        both = [heights_above(b.vertices[i], a, i), heights_above(a.vertices[i], b, i)]
        by_face = max(float(np.max(np.min(heights, axis=0))) for heights in both)
        along_face = np.max(
            np.abs(np.concatenate([a.rotation[i].T, b.rotation[i].T]) @ found.normal[found.pair == i][0])
        )
        # some are on a face whose other places are too high
        assert along_face > 1 - 1e-9 or separation > by_face + BIAS * 2 * np.linalg.norm(SIZES[BOX])
    assert len(chosen) >= 30


def heights_above(points, piece, i):
    """How far points are above the planes of a box's faces, (p, 6)."""
    seen = (points - piece.position[i]) @ piece.rotation[i]
    return np.concatenate([seen, -seen], axis=1) - np.tile(piece.size[i], 2)


def edge_with(vertices, sign):
    """The number of the edge that is lowest or highest."""
    return np.argmax(sign * np.sum(vertices[edges_of(BOX_FACES).ends][:, :, 2], axis=1))


def test_edges_that_would_only_cross_if_they_were_longer_do_not_touch():
    # The same, 0.04 apart. The upper edge ends 5 mm before the lower one, and then 5 mm behind it.
    height = np.sqrt(2) * 0.5 * 2 + 0.04
    a = place(BOX, [[2.005, 0.2, height], [1.995, 0.2, height]], about([1.0, 0, 0], 45), (2, 0.5, 0.5))
    b = place(BOX, [[0, 0, 0]] * 2, about([0, 1.0, 0], 45), (0.5, 2, 0.5))
    found = touch((BOX, BOX), a, b, 0.05)
    np.testing.assert_array_equal(found.pair, [1])
    assert found.separation == pytest.approx(0.04, rel=1e-12)


def test_a_box_hardly_tilted_over_the_edge_of_another_keeps_several_places():
    # It hangs over a good part of its length, dips by some 0.5°, and its sides are not parallel to the other's.
    rng = np.random.default_rng(0)
    axes, yaws = rng.normal(size=(200, 3)) * [1, 1, 0.1], rng.uniform(-3, 3, 200)
    tilts = np.stack([about(axis, 0.5) @ about([0, 0, 1.0], yaw) for axis, yaw in zip(axes, yaws, strict=True)])
    at = np.column_stack([rng.uniform(0.6, 0.9, 200), rng.uniform(-0.3, 0.3, 200), np.full(200, 1.49)])
    found = touch(
        (BOX, BOX), place(BOX, at, tilts, (1, 0.8, 0.5)), place(BOX, np.zeros((200, 3)), UPRIGHT, (1, 1, 1)), 0.01
    )
    assert np.all(np.bincount(found.pair) >= 2)
    np.testing.assert_allclose(found.normal[:, 2], 1.0, atol=1e-4)  # the cosine of 0.5° is 4e-5 below 1


@pytest.mark.parametrize("shift", [1e-12, 1e-8, 1e-4])
def test_features_stay_the_same_while_a_box_creeps(shift):
    rng = np.random.default_rng(10)
    spots, yaws = (
        rng.uniform(-0.9, 0.9, (30, 2)),
        np.stack([about([0, 0, 1.0], angle) for angle in rng.uniform(5, 40, 30)]),
    )
    lower = place(BOX, np.zeros((30, 3)), UPRIGHT, (1.0, 1, 1))

    def features(move):
        tilt = about([1.0, 0.3, 0], np.degrees(move))
        at = np.column_stack([spots + np.array([move, -move]), np.full(30, 1.699 + move)])
        found = touch((BOX, BOX), place(BOX, at, tilt @ yaws, (0.8, 0.9, 0.7)), lower, 0.01)
        return np.column_stack([found.pair, found.feature])

    np.testing.assert_array_equal(features(0.0), features(shift))


def test_a_corner_has_one_number_whichever_face_is_clipped():
    # A small box in the middle of a face of a large one, above and below: A's, then B's four corners.
    small, large = (0.2, 0.3, 1), (1.0, 1, 1)
    above = touch((BOX, BOX), *boxes_on((0.1, 0.2), UPRIGHT, small, large))
    below = touch((BOX, BOX), *boxes_on((0.1, 0.2), UPRIGHT, large, small))
    np.testing.assert_array_equal(above.feature, np.flatnonzero(BOX_VERTICES[:, 2] < 0))
    np.testing.assert_array_equal(below.feature, 8 + np.flatnonzero(BOX_VERTICES[:, 2] > 0))


def test_faces_that_do_not_close_a_solid_are_refused():
    with pytest.raises(ValueError, match="faces must bound a solid"):
        edges_of(BOX_FACES[:5])
    with pytest.raises(ValueError, match="faces must bound a solid"):
        edges_of(np.vstack([BOX_FACES[:5], BOX_FACES[5:, ::-1]]))
    with pytest.raises(ValueError, match="faces must bound a solid"):
        edges_of(np.vstack([BOX_FACES, BOX_FACES[:1]]))
