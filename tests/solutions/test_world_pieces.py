"""Pieces of bodies and their boxes: where they are, how far they reach, and the scale of what touches."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.impulse import rotation_matrix
from solutions.world.boxes import BOX_VERTICES
from solutions.world.hulls import edges_of, hull_of
from solutions.world.narrow_phase import PAIRS
from solutions.world.pieces import bounding_boxes, pieces_of, place_pieces, placed
from solutions.world.shapes import BOX, CAPSULE, POLYHEDRON, SPHERE, Placed
from solutions.world.vectors import tangents

WEDGE = [(-0.4, -0.2, -0.1), (0.5, -0.2, -0.1), (-0.4, 0.6, -0.1), (-0.3, -0.1, 0.7)]
WEDGE_FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
TILTED = np.array([0.5, -0.1, 0.7, 0.5])


def test_the_box_around_a_piece_reaches_as_far_as_its_outermost_points():
    shapes = [
        ("sphere", 0.3),
        ("capsule", 0.1, 0.4),
        ("box", (0.2, 0.3, 0.5)),
        ("polyhedron", WEDGE, WEDGE_FACES),
        ("polyhedron", np.array(WEDGE) * [2, 1, 0.5], WEDGE_FACES),
    ]
    rng = np.random.default_rng(1)
    at, turn = rng.normal(size=(5, 3)), rng.normal(size=(5, 4))
    turn /= np.linalg.norm(turn, axis=-1, keepdims=True)
    pieces = pieces_of(shapes)
    np.testing.assert_array_equal(pieces.size, [(0.3, 0, 0), (0.1, 0.4, 0), (0.2, 0.3, 0.5), (0, 0, 0), (0, 0, 0)])
    lower, upper = bounding_boxes(pieces, *place_pieces(pieces, at, turn))
    # Corners of what lies within the radius, all in the piece's own axes
    cores = [np.zeros((1, 3)), np.array([(0, 0, -0.4), (0, 0, 0.4)]), BOX_VERTICES * (0.2, 0.3, 0.5), np.array(WEDGE)]
    cores.append(np.array(WEDGE) * [2, 1, 0.5])
    for i, (own, radius) in enumerate(zip(cores, (0.3, 0.1, 0, 0, 0), strict=True)):
        points = at[i] + own @ rotation_matrix(turn[i]).T
        # some roundings of numbers of order one
        np.testing.assert_allclose(lower[i], points.min(axis=0) - radius, atol=1e-14)
        np.testing.assert_allclose(upper[i], points.max(axis=0) + radius, atol=1e-14)


def scaled(piece, by):
    """The same pieces, all of whose lengths are so many times as large."""
    return Placed(by * piece.position, piece.rotation, by * piece.size, by * piece.vertices, piece.faces)


def some_of(kind, at, turn):
    """Pieces of one kind, some of 1 m, at positions (n, 3), turned by quaternions (n, 4)."""
    count = len(at)
    shape = {
        SPHERE: ("sphere", 0.3),
        CAPSULE: ("capsule", 0.2, 0.5),
        BOX: ("box", (0.5, 0.7, 0.3)),
        POLYHEDRON: ("polyhedron", WEDGE, WEDGE_FACES),
    }[kind]
    pieces = pieces_of([shape] * count)
    return placed(pieces, np.arange(count), *place_pieces(pieces, at, turn))


@pytest.mark.parametrize("kinds", [kinds for kinds in PAIRS if max(kinds) <= POLYHEDRON])
def test_pieces_a_thousand_times_smaller_touch_at_the_same_places(kinds):
    rng = np.random.default_rng(2)
    turn = rng.normal(size=(2, 40, 4))
    turn /= np.linalg.norm(turn, axis=-1, keepdims=True)
    # Half of them lie flat and flush, as at rest on each other, and some edges and cores are parallel
    turn[:, :20] = TILTED / np.linalg.norm(TILTED)
    at = rng.normal(scale=0.35, size=(40, 3))
    at[:20] = rotation_matrix(turn[0, 0]) @ [0, 0, 0.59]
    at[10:20] += np.matvec(rotation_matrix(turn[0, 0]), rng.uniform(-0.3, 0.3, (10, 3)) * [1, 1, 0.01])
    a, b = some_of(kinds[0], at, turn[0]), some_of(kinds[1], np.zeros((40, 3)), turn[1])
    large, small = PAIRS[kinds](a, b, 0.02), PAIRS[kinds](scaled(a, 1e-3), scaled(b, 1e-3), 0.02e-3)
    assert len(large.pair) > 15
    np.testing.assert_array_equal(small.pair, large.pair)
    np.testing.assert_array_equal(small.feature, large.feature)
    # rounding; a place near an edge comes from quotients of small numbers
    np.testing.assert_allclose(small.point, 1e-3 * large.point, atol=1e-14)
    np.testing.assert_allclose(small.normal, large.normal, atol=1e-11)
    np.testing.assert_allclose(small.separation, 1e-3 * large.separation, atol=1e-14)


def prism(corners):
    """The vertices and faces of a prism 2 m high over a polygon of the plane."""
    count = len(corners)
    ring = np.arange(count)
    base, top = (np.column_stack([corners, np.full(count, z)]) for z in (-1.0, 1.0))
    sides = [[i, (i + 1) % count, (i + 1) % count + count, i + count] for i in ring]
    return np.concatenate([base, top]), [ring[::-1].tolist(), (ring + count).tolist(), *sides]


def test_faces_with_more_and_with_fewer_corners_touch_at_all_they_share():
    # A hexagon and a triangle that lie within the other solid's face, above it and below it
    angle = np.arange(6) * np.pi / 3 + 0.2
    hexagon = ("polyhedron", *prism(0.3 * np.column_stack([np.cos(angle), np.sin(angle)])))
    tetrahedron = ("polyhedron", 0.5 * np.array(WEDGE), WEDGE_FACES)
    table = ("box", (2.0, 2.0, 0.5))
    upright, over = (1.0, 0, 0, 0), (0.0, 1.0, 0, 0)
    for small, low, count in ((hexagon, 1.0, 6), (tetrahedron, 0.05, 3)):
        for turned, way in ((upright, 1), (over, -1)):
            pieces = pieces_of([table, small])
            at = np.array([[0.02, -0.01, 0], [0, 0, way * (0.5 + low - 0.01)]])
            places = place_pieces(pieces, at, np.array([upright, turned]))
            a, b = (placed(pieces, np.array([i]), *places) for i in (0, 1))
            found = PAIRS[BOX, POLYHEDRON](a, b, 0.0)
            corners = b.vertices[0][np.argsort(way * b.vertices[0][:, 2])[:count]]
            expected = np.round(corners[:, :2], 9) + 0.0
            np.testing.assert_array_equal(sorted(expected.tolist()), sorted(np.round(found.point[:, :2], 9).tolist()))
            np.testing.assert_allclose(found.separation, -0.01, atol=1e-15)
    # The corners of a triangular prism on those of a hexagonal one, and the other way round
    triangle = ("polyhedron", *prism([(0.1, 0.0), (-0.05, 0.1), (-0.05, -0.1)]))
    for first, second in ((hexagon, triangle), (triangle, hexagon)):
        pieces = pieces_of([first, second])
        places = place_pieces(pieces, np.array([[0, 0, 1.99], [0, 0, 0]]), np.array([upright, upright]))
        a, b = (placed(pieces, np.array([i]), *places) for i in (0, 1))
        assert len(PAIRS[POLYHEDRON, POLYHEDRON](a, b, 0.0).pair) == 3


def test_a_hulls_size_is_at_least_half_its_widest_and_at_most_all_of_it():
    # The bias of faces and the width of their sides are shares of it
    for shape in (("box", (0.5, 0.7, 0.3)), ("polyhedron", WEDGE, WEDGE_FACES)):
        pieces = pieces_of([shape])
        piece = placed(pieces, np.array([0]), np.ones((1, 3)), np.eye(3)[None])
        widest = np.max(np.linalg.norm(piece.vertices[0][:, None] - piece.vertices[0], axis=-1))
        assert widest / 2 <= hull_of(piece).size[0] <= widest * (1 + 1e-15)


def touch_one_upon_another(upper, at, turn, lower):
    """Where a box, or a polyhedron, touches one at the origin, each a piece of its own."""
    pieces = pieces_of([upper, lower])
    places = place_pieces(pieces, np.array([at, (0, 0, 0)]), np.array([turn, (1.0, 0, 0, 0)]))
    a, b = (placed(pieces, np.array([i]), *places) for i in (0, 1))
    return a, b, PAIRS[pieces.kind[0], pieces.kind[1]](a, b, 0.0)


EIGHTH = (np.cos(np.pi / 8), 0.0, 0.0, np.sin(np.pi / 8))
"""A turn by 45° about z."""


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_corner_that_is_cut_off_leaves_two_places_at_any_size(size):
    # The upper box's side crosses the lower one's corner (1, 1), at 0.01 from it along both edges
    middle = (1.99 / 2 - 3 / np.sqrt(2)) * np.array([1, 1])
    at = size * np.array([*middle, 0.999])
    boxes = [("box", size * np.array(half)) for half in ((3, 3, 0.5), (1, 1, 0.5))]
    *_, found = touch_one_upon_another(boxes[0], at, EIGHTH, boxes[1])
    expected = [(-1, -1), (-1, 1), (0.99, 1), (1, -1), (1, 0.99)]
    # digits that a millimetre keeps beside sizes of 3 mm
    np.testing.assert_allclose(sorted(np.round(found.point[:, :2] / size, 9).tolist()), expected, atol=2e-9)


@pytest.mark.parametrize("corners", [4, 6])
def test_a_place_where_two_edges_cross_is_named_after_both(corners):
    # A box that is turned by 45° lies on one, or on a hexagonal prism, which has more edges
    angle = np.arange(corners) * 2 * np.pi / corners + np.pi / 4
    lower = ("polyhedron", *prism(np.sqrt(2) * np.column_stack([np.cos(angle), np.sin(angle)])))
    a, b, found = touch_one_upon_another(("box", (1, 1.1, 0.5)), (0, 0, 1.49), EIGHTH, lower)
    edges = [edges_of(piece.faces) for piece in (a, b)]
    beyond = len(a.vertices[0]) + len(b.vertices[0])  # the vertices' own names come first
    crossings = 0
    for point, feature in zip(found.point, found.feature, strict=True):
        nearest = []
        for piece, its in zip((a, b), edges, strict=True):
            start, stop = (piece.vertices[0][end] for end in its.ends.T)
            way = (stop - start) / np.linalg.norm(stop - start, axis=-1)[:, None]
            nearest.append(int(np.argmin(np.linalg.norm(np.cross(point - start, way), axis=-1))))
        crossings += feature >= beyond
        assert feature < beyond or feature == beyond + len(edges[1].ends) * nearest[0] + nearest[1]
    assert crossings >= 6
    assert len(np.unique(found.feature)) == len(found.feature)


def test_capsules_hardly_askew_touch_where_their_cores_end():
    # Places of A where the cores begin or end to lie side by side, at the distance of B's core from there
    rng = np.random.default_rng(4)
    at = np.column_stack([rng.uniform(-0.01, 0.01, 40), np.full(40, 0.39), rng.choice([-0.9, 0, 0.9], 40)])
    at[:, 2] += rng.uniform(-0.004, 0.004, 40)
    lean = rng.normal(scale=0.002, size=(40, 3))
    turn = np.column_stack([np.ones(40), lean]) / np.sqrt(1 + np.vecdot(lean, lean))[:, None]
    pieces = pieces_of([("capsule", 0.2, 0.5)] * 40 + [("capsule", 0.2, 0.4)] * 40)
    upright = np.tile([1.0, 0, 0, 0], (40, 1))
    places = place_pieces(pieces, np.concatenate([at, np.zeros((40, 3))]), np.concatenate([turn, upright]))
    a, b = (placed(pieces, np.arange(40) + 40 * i, *places) for i in (0, 1))
    found = PAIRS[CAPSULE, CAPSULE](a, b, 0.05)
    assert np.sum(found.feature > 0) > 20
    on_core = found.point + found.normal * (found.separation / 2 + 0.2)[:, None]
    axis = a.rotation[found.pair, :, 2]
    along = np.vecdot(on_core - a.position[found.pair], axis)
    # rounding of numbers of order one
    np.testing.assert_allclose(a.position[found.pair] + along[:, None] * axis, on_core, atol=1e-14)
    assert np.all(np.abs(along) <= 0.5 + 1e-14)
    nearest = np.stack([0 * along, 0 * along, np.clip(on_core[:, 2], -0.4, 0.4)], axis=-1)
    np.testing.assert_allclose(found.separation, np.linalg.norm(on_core - nearest, axis=-1) - 0.4, atol=1e-14)


def test_a_short_capsule_lies_with_both_ends_on_a_long_one():
    # Its core is 1 cm long, that of the other 20 m
    pieces = pieces_of([("capsule", 0.02, 0.005), ("capsule", 0.02, 10.0)])
    places = place_pieces(pieces, np.array([(0.039, 0, 3), (0, 0, 0)]), np.tile([1.0, 0, 0, 0], (2, 1)))
    found = PAIRS[CAPSULE, CAPSULE](*(placed(pieces, np.array([i]), *places) for i in (0, 1)), 0.0)
    np.testing.assert_array_equal(found.feature, [1, 2])
    np.testing.assert_allclose(found.point, [(0.0195, 0, 2.995), (0.0195, 0, 3.005)], atol=1e-14)


def capsule_on_box(size, half_extents, at, turn):
    """Where a capsule touches a box at the origin."""
    pieces = pieces_of([("capsule", *size), ("box", half_extents)])
    places = place_pieces(pieces, np.array([at, (0, 0, 0)]), np.array([turn, (1.0, 0, 0, 0)]))
    return PAIRS[CAPSULE, BOX](*(placed(pieces, np.array([i]), *places) for i in (0, 1)), 0.0)


def test_a_small_capsule_touches_the_edge_of_a_large_box_where_it_is_nearest():
    # Its axis leans by 60° over an edge of 10 m; what counts as equally near is a share of the capsule's own size
    out, lean = np.array([0.5, 0, np.sqrt(0.75)]), np.pi / 3
    axis = np.array([np.sqrt(0.75), 0, -0.5])
    at = np.array([5, 0.1, 3]) + 0.0038 * out - 0.002 * axis
    found = capsule_on_box((0.004, 0.01), (5, 7, 3), at, (np.cos(lean), 0, np.sin(lean), 0))
    np.testing.assert_array_equal(found.feature, [2])
    # rounding of 5 m, divided by a distance of 4 mm
    np.testing.assert_allclose(found.normal, [out], atol=1e-11)
    np.testing.assert_allclose(found.separation, [-0.0002], atol=1e-14)


def test_a_capsule_that_just_reaches_over_a_face_touches_it_once():
    # Its core ends a tenth of a micrometre within the face
    found = capsule_on_box((0.2, 0.5), (0.5, 0.7, 0.3), (1 - 1e-7, 0.1, 0.49), (np.sqrt(0.5), 0, np.sqrt(0.5), 0))
    assert len(found.pair) == 1
    np.testing.assert_allclose(found.point, [(0.5, 0.1, 0.295)], atol=2e-6)  # up to a millionth of the size


def test_normal_and_tangents_are_a_right_handed_frame():
    normal = np.random.default_rng(5).normal(size=(20, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    frame = np.stack([normal, *tangents(normal)], axis=-1)
    np.testing.assert_allclose(frame.mT @ frame, np.tile(np.eye(3), (20, 1, 1)), atol=1e-15)
    np.testing.assert_allclose(np.linalg.det(frame), 1, atol=1e-15)  # rounding, here and above
