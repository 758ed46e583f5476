"""Where balls and capsules touch each other and boxes, by hand."""

from __future__ import annotations

import numpy as np
import pytest
from pieces_in_touch import about, place, random_turns, touch

from solutions.world.shapes import BOX, CAPSULE, HALF_SPACE, POLYHEDRON, SPHERE


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
