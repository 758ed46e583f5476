from __future__ import annotations

import itertools

import numpy as np
import pytest
from oracles import oracle

from solutions.impulse import rotation_matrix
from solutions.sweeping import separation_of_hulls
from solutions.world.boxes import BOX_FACES, BOX_VERTICES
from solutions.world.hull_pairs import BIAS
from solutions.world.hulls import edges_of
from solutions.world.narrow_phase import PAIRS
from solutions.world.shapes import BOX, CAPSULE, HALF_SPACE, POLYHEDRON, SPHERE, Found, Placed

NO_FACES = np.zeros((0, 3), dtype=np.int64)
UPRIGHT = np.eye(3)
# A tent: two triangles and three quadrilaterals, no two edges alike, no face parallel to another.
TENT = [(-0.6, -0.4, -0.3), (-0.6, 0.5, -0.3), (-0.5, 0.1, 0.4), (0.8, -0.4, -0.3), (0.7, 0.5, -0.3), (0.5, 0.1, 0.4)]
TENT_FACES = np.array([(0, 2, 1, 1), (3, 4, 5, 5), (0, 1, 4, 3), (0, 3, 5, 2), (1, 2, 5, 4)])


def tent_vertices():
    """The tent with its slanted long sides made plane: the ridge's far end is where both planes meet."""
    v = np.array(TENT)
    first = np.cross(v[3] - v[0], v[2] - v[0])
    second = np.cross(v[2] - v[1], v[4] - v[1])
    ridge = np.cross(first, second)
    v[5] = v[2] + ridge * (0.5 - v[2][0]) / ridge[0]
    return v


TENT_VERTICES = tent_vertices()
SIZES = {
    SPHERE: np.array([0.3, 0.0, 0.0]),
    CAPSULE: np.array([0.2, 0.5, 0.0]),
    BOX: np.array([0.5, 0.7, 0.3]),
    POLYHEDRON: np.zeros(3),
    HALF_SPACE: np.zeros(3),
}
OWN = {SPHERE: np.zeros((1, 3)), BOX: BOX_VERTICES, POLYHEDRON: TENT_VERTICES}
FACES = {BOX: BOX_FACES, POLYHEDRON: TENT_FACES}


def place(kind, position, rotation=UPRIGHT, size=None, vertices=None, faces=None):
    """Pieces at positions (n, 3), each turned by a rotation (3, 3) or (n, 3, 3)."""
    at = np.atleast_2d(np.asarray(position, dtype=float))
    turned = np.array(np.broadcast_to(rotation, (len(at), 3, 3)))
    size = np.array(np.broadcast_to(SIZES[kind] if size is None else size, at.shape), dtype=float)
    if kind not in FACES:
        return Placed(at, turned, size, np.zeros((len(at), 0, 3)), NO_FACES)
    own = OWN[kind] if vertices is None else vertices
    own = own * size[:, None] if kind == BOX else np.broadcast_to(own, (len(at), *own.shape))
    return Placed(at, turned, size, at[:, None] + own @ turned.mT, FACES[kind] if faces is None else faces)


def touch(kinds, a, b, margin=0.0) -> Found:
    return PAIRS[kinds](a, b, margin)


def about(axis, degrees):
    half = np.radians(degrees) / 2
    return rotation_matrix([np.cos(half), *(np.sin(half) * np.array(axis) / np.linalg.norm(axis))])


def random_turns(rng, count):
    q = rng.normal(size=(count, 4))
    return rotation_matrix(q / np.linalg.norm(q, axis=1, keepdims=True))


def scene(kinds, count, seed, spread):
    """Pieces A and B in general position, some deep in each other, some at the surface, some apart."""
    rng = np.random.default_rng(seed)
    away = rng.normal(size=(count, 3))
    away *= spread * rng.random((count, 1)) / np.linalg.norm(away, axis=1, keepdims=True)
    base = rng.normal(size=(count, 3))
    return tuple(place(kind, at, random_turns(rng, count)) for kind, at in zip(kinds, (base + away, base), strict=True))


def core(piece, kind, i):
    """Points whose hull is the piece, except for its radius."""
    if kind == CAPSULE:
        return piece.position[i] + np.outer([-1, 1], piece.size[i, 1] * piece.rotation[i, :, 2])
    return piece.position[i][None] if kind == SPHERE else piece.vertices[i]


def radius(piece, kind, i):
    return piece.size[i, 0] if kind in (SPHERE, CAPSULE) else 0.0


def way_out(points_a, points_b):
    """Separation of two hulls: by distance where they are apart, else the shortest way out, from all differences."""
    from scipy.spatial import ConvexHull  # noqa: PLC0415

    apart, _ = separation_of_hulls(points_a, points_b)
    if apart > 1e-6:  # nearer, rounding bends its direction
        return float(apart)
    return float(ConvexHull((points_a[:, None] - points_b[None]).reshape(-1, 3)).equations[:, 3].max())


def outside(point, piece, kind, i):
    """How far a point is outside of a piece; negative within it."""
    if kind == HALF_SPACE:
        return (point - piece.position[i]) @ piece.rotation[i, :, 2]
    if kind in FACES:
        corners = piece.vertices[i][piece.faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return np.max(np.sum((point - corners[:, 0]) * normal, axis=1))
    return float(separation_of_hulls(point[None], core(piece, kind, i))[0]) - radius(piece, kind, i)


ALL = list(PAIRS)
NAMES = {SPHERE: "sphere", CAPSULE: "capsule", BOX: "box", POLYHEDRON: "tent", HALF_SPACE: "half-space"}


def each(*kinds):
    return pytest.mark.parametrize("kinds", kinds, ids=["-".join(NAMES[kind] for kind in pair) for pair in kinds])


# Round pieces


def test_two_balls_touch_halfway_between_their_surfaces():
    a = place(SPHERE, [[0, 0, 1.0], [5, 0, 0], [3, 4.0, 0]], size=[[0.3, 0, 0], [1, 0, 0], [2, 0, 0]])
    b = place(SPHERE, [[0, 0, 0], [0, 0, 0], [0, 0, 0]], size=[[0.6, 0, 0], [1, 0, 0], [3.5, 0, 0]])
    found = touch((SPHERE, SPHERE), a, b, 0.2)
    np.testing.assert_array_equal(found.pair, [0, 2])
    # numbers with few digits: some roundings of numbers up to 5
    np.testing.assert_allclose(found.separation, [0.1, -0.5], atol=1e-15)
    np.testing.assert_allclose(found.normal, [[0, 0, 1], [0.6, 0.8, 0]], atol=1e-15)
    np.testing.assert_allclose(found.point, [[0, 0, 0.65], [3.25 * 0.6, 3.25 * 0.8, 0]], atol=1e-15)


def test_balls_at_the_same_place_are_pushed_apart_upwards():
    at = [[1, 2, 3], [1, 2, 3.0]]
    found = touch((SPHERE, SPHERE), place(SPHERE, at), place(SPHERE, at - np.array([[0, 0, 0], [1e-6, 0, 0]])))
    # a millionth of a metre has ten digits here, and is a direction
    np.testing.assert_allclose(found.normal, [[0, 0, 1], [1, 0, 0]], atol=1e-9)
    np.testing.assert_allclose(found.separation, [-0.6, 1e-6 - 0.6], rtol=1e-15)


def test_a_ball_on_the_core_of_a_capsule_leaves_across_the_core():
    lying = about([0.0, 1, 0], 90)
    found = touch((SPHERE, CAPSULE), place(SPHERE, [0.3, 0, 0]), place(CAPSULE, [0, 0, 0.0], lying))
    # a cosine of 90° is 6e-17
    assert found.normal[0] @ lying[:, 2] == pytest.approx(0.0, abs=1e-15)
    assert found.separation == pytest.approx(-0.5, rel=1e-15)


def test_a_ball_in_a_box_leaves_through_the_nearest_face():
    at, turn = np.array([0.1, -0.2, 0.25]), about([1, 2, 3], 40)
    found = touch((SPHERE, BOX), place(SPHERE, turn @ at), place(BOX, [0, 0, 0], turn))
    # the face at z = 0.3 is 0.05 above the centre; some roundings
    assert found.separation == pytest.approx(-0.05 - 0.3, rel=1e-14)
    np.testing.assert_allclose(found.normal[0], turn[:, 2], atol=1e-15)
    np.testing.assert_allclose(turn.T @ found.point[0], [0.1, -0.2, 0.3 - 0.35 / 2], atol=1e-15)


def test_a_ball_in_the_middle_of_a_box_has_a_way_out():
    found = touch((SPHERE, BOX), place(SPHERE, [0, 0, 0]), place(BOX, [0, 0, 0]))
    np.testing.assert_array_equal(np.abs(found.normal), [[0, 0, 1]])  # through the nearer faces
    assert found.separation == pytest.approx(-0.6, rel=1e-15)


def test_a_ball_on_a_face_touches_it_once():
    found = touch((SPHERE, POLYHEDRON), place(SPHERE, [0.1, 0.1, -0.59]), place(POLYHEDRON, [0, 0, 0]))
    np.testing.assert_allclose(found.point, [[0.1, 0.1, -0.295]], atol=1e-15)


def test_an_upright_capsule_just_beyond_an_edge_touches_the_edge():
    away = np.array([0.003, 0, 0.19])
    at = np.array([0.5, 0.1, 0.3]) + away + [0, 0, 0.5]
    found = touch((CAPSULE, BOX), place(CAPSULE, at), place(BOX, [0, 0, 0]))
    distance = np.linalg.norm(away)
    # some roundings of numbers of order one, divided by a distance of 0.2
    np.testing.assert_allclose(found.normal, [away / distance], atol=1e-14)
    assert found.separation == pytest.approx(distance - 0.2, abs=1e-15)


def test_a_capsule_deep_in_a_box_along_its_edges_leaves_through_a_face():
    turn = random_turns(np.random.default_rng(2), 20)
    boxes = place(BOX, np.zeros((20, 3)), turn, (0.9, 0.8, 0.7))
    found = touch((CAPSULE, BOX), place(CAPSULE, turn @ [0.1, -0.7, 0.05], turn, (0.2, 0.5, 0)), boxes)
    # its core is 0.1 deep; rounding of some numbers of order one
    np.testing.assert_allclose(found.separation, -0.3, atol=1e-14)
    np.testing.assert_array_equal(found.feature, [0, 1] * 20)
    np.testing.assert_allclose(found.normal, -turn[found.pair][:, :, 1], atol=1e-14)


def test_capsules_whose_cores_cross_are_pushed_apart_across_both():
    a, b = place(CAPSULE, [0, 0, 0], about([0, 1.0, 0], 90)), place(CAPSULE, [0, 0, 0], about([1.0, 0, 0], 60))
    found = touch((CAPSULE, CAPSULE), a, b)
    out = np.cross([1, 0, 0], b.rotation[0, :, 2])
    assert abs(found.normal[0] @ out) == pytest.approx(1.0, rel=1e-14)


def test_crossing_capsules_touch_where_their_cores_are_nearest():
    a = place(CAPSULE, [0.1, 0.2, 0.35], about([0, 1.0, 0], 90))
    b = place(CAPSULE, [0.3, 0.1, 0], about([1.0, 0, 0], 90))
    found = touch((CAPSULE, CAPSULE), a, b)
    # cores along x and y, 0.35 apart in z; radii 0.2
    np.testing.assert_allclose(found.point, [[0.3, 0.2, 0.175]], atol=1e-15)
    np.testing.assert_allclose(found.normal, [[0, 0, 1]], atol=1e-15)
    assert found.separation == pytest.approx(-0.05, rel=1e-14)


def test_capsules_side_by_side_touch_at_both_ends_of_what_they_share():
    lying = about([0.0, 1, 0], 90)  # its z axis along x
    a = place(CAPSULE, [[0.4, 0, 0.39]] * 2, lying)
    b = place(CAPSULE, np.zeros((2, 3)), np.stack([lying, about([0, 0, 1.0], 0.1) @ lying]), size=[0.2, 0.7, 0])
    found = touch((CAPSULE, CAPSULE), a, b)
    np.testing.assert_array_equal(found.feature, [1, 2, 1, 2])
    # the core of A reaches from −0.1 to 0.9, that of B to 0.7
    np.testing.assert_allclose(found.point[:2], [[-0.1, 0, 0.195], [0.7, 0, 0.195]], atol=1e-15)
    # 0.1° at 0.7 m is 1.2 mm to the side
    np.testing.assert_allclose(found.point[2:], found.point[:2], atol=1.3e-3)


def test_capsules_end_to_end_touch_at_one_place():
    a, b = place(CAPSULE, [0, 0, 1.35]), place(CAPSULE, [0, 0, 0])
    found = touch((CAPSULE, CAPSULE), a, b)
    np.testing.assert_allclose(found.point, [[0, 0, 0.675]], atol=1e-15)
    assert found.separation == pytest.approx(-0.05, rel=1e-14)


def test_a_lying_capsule_rests_on_both_ends_and_a_tilted_one_on_one():
    ground = place(HALF_SPACE, [[0, 0, 0.1]] * 2)
    a = place(CAPSULE, [[0, 0, 0.29]] * 2, np.stack([about([0, 1.0, 0], 90), about([0, 1.0, 0], 60)]))
    found = touch((CAPSULE, HALF_SPACE), a, ground, 0.01)
    np.testing.assert_array_equal(found.pair, [0, 0, 1])
    np.testing.assert_array_equal(found.feature, [0, 1, 0])
    low = -0.01 - 0.5 * np.cos(np.radians(60))
    np.testing.assert_allclose(found.separation, [-0.01, -0.01, low], atol=1e-15)
    x = -0.5 * np.sin(np.radians(60))
    np.testing.assert_allclose(found.point, [[-0.5, 0, 0.095], [0.5, 0, 0.095], [x, 0, 0.1 + low / 2]], atol=1e-15)


def test_a_capsule_that_hangs_over_a_box_rests_up_to_the_edge():
    lying = about([0.0, 1, 0], 90)
    found = touch((CAPSULE, BOX), place(CAPSULE, [0.3, 0.1, 0.49], lying), place(BOX, [0, 0, 0]))
    np.testing.assert_array_equal(found.feature, [0, 1])
    # the core reaches from −0.2 to 0.8, and the face to 0.5; it lies 0.19 above the face
    np.testing.assert_allclose(found.point, [[-0.2, 0.1, 0.295], [0.5, 0.1, 0.295]], atol=1e-15)


def test_a_capsule_tilted_over_an_edge_of_a_box_touches_across_both():
    tilted = about([0.0, 1, 0], 120)  # its axis runs down to the right by 30°
    out = np.array([0.5, 0, np.sqrt(0.75)])
    at = np.array([0.5, 0.1, 0.3]) + 0.19 * out - 0.1 * tilted[:, 2]
    found = touch((CAPSULE, BOX), place(CAPSULE, at, tilted), place(BOX, [0, 0, 0]))
    np.testing.assert_array_equal(found.feature, [2])
    np.testing.assert_allclose(found.normal, [out], atol=1e-14)
    # some roundings of numbers of order one, divided by a distance of 0.2
    np.testing.assert_allclose(found.point, [np.array([0.5, 0.1, 0.3]) - 0.005 * out], atol=1e-14)


# Any two pieces


@each(*(kinds for kinds in ALL if HALF_SPACE not in kinds))
def test_deepest_place_is_as_deep_as_the_shortest_way_out(kinds):
    oracle("scipy")
    a, b = scene(kinds, 30, 3, 1.2)
    found, exact, overlapping = touch(kinds, a, b), 0, 0
    for i in range(30):
        way = way_out(core(a, kinds[0], i), core(b, kinds[1], i)) - radius(a, kinds[0], i) - radius(b, kinds[1], i)
        depths = found.separation[found.pair == i]
        assert (depths.size > 0) == (way <= 0)
        if depths.size:
            # a face may be preferred to edges by the bias, of which the size is at most 2 m here
            assert depths.min() == pytest.approx(way, abs=2 * BIAS)
            overlapping += 1
            exact += abs(depths.min() - way) < 1e-12  # rounding of a hull of differences
    assert overlapping >= 10
    assert exact >= 0.8 * overlapping  # few are near enough to both for the bias to matter


@each(*ALL)
def test_contact_is_halfway_between_the_surfaces_along_the_normal(kinds):
    a, b = scene(kinds, 40, 4, 1.2)
    found = touch(kinds, a, b, 0.05)
    np.testing.assert_allclose(np.linalg.norm(found.normal, axis=1), 1.0, rtol=1e-14)
    assert np.all(found.separation <= 0.05)
    assert len(np.unique(found.pair)) >= 10
    ways = found.normal * found.separation[:, None] / 2
    for i, on_a, on_b in zip(found.pair, found.point + ways, found.point - ways, strict=True):
        for point, piece, kind in ((on_a, a, kinds[0]), (on_b, b, kinds[1])):
            # rounding; only a tilted capsule bulges beyond the place where a face cuts its core
            assert outside(point, piece, kind, i) <= 1e-12
            assert kind == CAPSULE or outside(point, piece, kind, i) >= -1e-12


@each((SPHERE, SPHERE), (CAPSULE, CAPSULE), (BOX, BOX), (POLYHEDRON, POLYHEDRON))
def test_swapping_two_pieces_turns_the_normal_and_nothing_else(kinds):
    a, b = scene(kinds, 30, 5, 1.2)
    found, swapped = touch(kinds, a, b), touch(kinds, b, a)

    def in_space_order(places, sign):
        rows = np.column_stack([places.pair, places.point, sign * places.normal, places.separation])
        return rows[np.lexsort(np.round(rows, 9).T[::-1])]

    # rounding, where other faces are clipped
    np.testing.assert_allclose(in_space_order(found, 1), in_space_order(swapped, -1), atol=1e-12)
    assert len(found.pair) >= 15


@each(*ALL)
def test_turning_both_pieces_turns_the_contacts_with_them(kinds):
    a, b = scene(kinds, 30, 6, 1.2)
    turn, shift = about([3.0, -1, 2], 77), np.array([0.4, -1.5, 2.0])

    def moved(piece):
        return Placed(
            piece.position @ turn.T + shift,
            turn @ piece.rotation,
            piece.size,
            piece.vertices @ turn.T + shift,
            piece.faces,
        )

    before, after = touch(kinds, a, b, 0.02), touch(kinds, moved(a), moved(b), 0.02)
    np.testing.assert_array_equal(before.pair, after.pair)
    np.testing.assert_array_equal(before.feature, after.feature)
    # some roundings of numbers of order one, some of them divided by a small distance
    np.testing.assert_allclose(after.point, before.point @ turn.T + shift, atol=1e-12)
    np.testing.assert_allclose(after.normal, before.normal @ turn.T, atol=1e-12)
    np.testing.assert_allclose(after.separation, before.separation, atol=1e-12)


@each(*ALL)
def test_contacts_of_a_pair_do_not_depend_on_other_pairs(kinds):
    pieces = scene(kinds, 12, 7, 0.9)
    together = touch(kinds, *pieces, 0.1)
    key = together.pair * 65536 + together.feature
    assert np.all(np.diff(key) > 0)  # in order, and no feature twice
    assert together.feature.min() >= 0
    assert together.feature.max() < 65536
    for i in range(12):
        alone = touch(
            kinds, *(Placed(*(value[i : i + 1] for value in piece[:4]), piece.faces) for piece in pieces), 0.1
        )
        for one, all_of_them in zip(alone[1:], together[1:], strict=True):
            np.testing.assert_array_equal(one, all_of_them[together.pair == i])


@each(*ALL)
def test_a_smaller_margin_leaves_out_distant_contacts_alone(kinds):
    a, b = scene(kinds, 30, 8, 1.3)
    wide, narrow = touch(kinds, a, b, 0.3), touch(kinds, a, b, 0.0)
    near = wide.separation <= 0
    assert 0 < np.count_nonzero(near) < len(near)
    for few, many in zip(narrow, wide, strict=True):
        np.testing.assert_array_equal(few, many[near])


@each(*ALL)
def test_no_pairs_and_pairs_far_apart_have_no_contacts(kinds):
    far = place(kinds[0], [[0, 0, 50.0]]), place(kinds[1], [[0, 0, 0.0]])
    none = (Placed(*(value[:0] for value in piece[:4]), piece.faces) for piece in far)
    for found in (touch(kinds, *far, 0.1), touch(kinds, *none, 0.1)):
        assert found.point.shape == found.normal.shape == (0, 3)
        assert found.pair.shape == found.separation.shape == found.feature.shape == (0,)


# Hulls at rest on each other


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


# Against an engine


@pytest.mark.slow
@each((SPHERE, SPHERE), (SPHERE, CAPSULE), (CAPSULE, CAPSULE), (SPHERE, BOX), (CAPSULE, BOX), (BOX, BOX))
def test_pieces_are_as_far_apart_as_in_pybullet(kinds):
    bullet = oracle("pybullet")
    a, b = scene(kinds, 200, 11, 1.4)
    found, compared = touch(kinds, a, b, 0.1), 0
    client = bullet.connect(bullet.DIRECT)
    try:
        for i in range(200):
            bodies = [in_bullet(bullet, client, piece, kind, i) for piece, kind in ((a, kinds[0]), (b, kinds[1]))]
            theirs = bullet.getClosestPoints(*bodies, 0.1, physicsClientId=client)
            ours = found.separation[found.pair == i]
            nearest = min((contact[8] for contact in theirs), default=np.inf)
            if ours.size and -0.2 < nearest < 0.1:
                # theirs ends its search at some 1e-4 m; ours may prefer a face by the bias, of a size up to 1.9 m
                assert ours.min() == pytest.approx(nearest, abs=2.5e-3)
                compared += 1
            for body in bodies:
                bullet.removeBody(body, physicsClientId=client)
    finally:
        bullet.disconnect(client)
    assert compared >= 15


def in_bullet(bullet, client, piece, kind, i):
    r, half, _ = piece.size[i]
    shape = {
        SPHERE: {"shapeType": bullet.GEOM_SPHERE, "radius": r},
        CAPSULE: {"shapeType": bullet.GEOM_CAPSULE, "radius": r, "height": 2 * half},
        BOX: {"shapeType": bullet.GEOM_BOX, "halfExtents": piece.size[i].tolist()},
    }[kind]
    number = bullet.createCollisionShape(**shape, physicsClientId=client)
    return bullet.createMultiBody(
        1.0, number, -1, piece.position[i].tolist(), quaternion(piece.rotation[i]), physicsClientId=client
    )


def quaternion(rotation):
    """In PyBullet's order x, y, z, w."""
    from scipy.spatial.transform import Rotation  # noqa: PLC0415

    return Rotation.from_matrix(rotation).as_quat().tolist()
