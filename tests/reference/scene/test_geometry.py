from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.errors import InvalidInput
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere

RNG_SEED = 5
UNIT = st.tuples(*[st.floats(-1, 1)] * 3).map(np.array).filter(lambda v: np.linalg.norm(v) > 1e-2)
UNIT = UNIT.map(lambda v: v / np.linalg.norm(v))


def quaternions(rng: np.random.Generator, count: int) -> np.ndarray:
    q = rng.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def matrix(q: np.ndarray) -> np.ndarray:
    """The rotation matrix of a unit quaternion w x y z, body to world, as every text book has it."""
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


# Rotations


def test_a_quarter_turn_about_z_takes_x_to_y():
    quarter = np.array([math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])
    assert geometry.rotate(quarter, np.array([1.0, 0.0, 0.0])) == pytest.approx([0, 1, 0], abs=1e-15)


def test_a_quaternion_turns_a_vector_as_its_matrix_does():
    rng = np.random.default_rng(RNG_SEED)
    turns, vectors = quaternions(rng, 100), rng.normal(size=(100, 3))
    expected = [matrix(turn) @ vector for turn, vector in zip(turns, vectors, strict=True)]
    assert geometry.rotate(turns, vectors) == pytest.approx(np.array(expected), abs=1e-14)  # numbers of order one


def test_a_turn_about_an_axis_keeps_the_axis():
    for angle in np.linspace(-3, 3, 13):
        turn = np.array([math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0])
        turned = geometry.rotate(turn, np.array([[0.0, 5.0, 0.0], [0.0, 0.0, 1.0]]))
        assert turned == pytest.approx(np.array([[0, 5, 0], [math.sin(angle), 0, math.cos(angle)]]), abs=1e-14)


def test_one_turn_serves_many_vectors_and_many_turns_one_vector():
    rng = np.random.default_rng(RNG_SEED)
    turns, vectors = quaternions(rng, 4), rng.normal(size=(6, 3))
    together = geometry.rotate(turns[:, None], vectors)
    assert together.shape == (4, 6, 3)
    for one, other in np.ndindex(4, 6):
        assert together[one, other] == pytest.approx(matrix(turns[one]) @ vectors[other], abs=1e-14)


@given(UNIT, UNIT)
def test_the_turn_between_two_directions_is_the_shortest_one(start, end):
    turn = geometry.quaternion_between(start, end)
    assert np.linalg.norm(turn) == pytest.approx(1, abs=1e-15)
    # Directions within √(2 · 1e-12) of opposite are taken as opposite
    assert geometry.rotate(turn, start) == pytest.approx(end, abs=1.5e-6)
    angle = math.atan2(np.linalg.norm(np.cross(start, end)), start @ end)
    assert 2 * math.acos(min(1.0, turn[0])) == pytest.approx(angle, abs=1.5e-6)


@given(UNIT)
def test_the_turn_between_opposite_directions_is_half_a_turn(start):
    turn = geometry.quaternion_between(start, -start)
    assert turn[0] == 0
    assert geometry.rotate(turn, start) == pytest.approx(-start, abs=1e-14)


def test_the_turn_between_nearly_opposite_directions_keeps_nine_digits():
    for off in (1e-5, 1e-4, 1e-3):
        end = np.array([math.sin(off), 0.0, -math.cos(off)])
        turn = geometry.quaternion_between(np.array([0.0, 0.0, 1.0]), end)
        # 1 + cos is rounded to 1e-16, of off²/2; the error of the angle is that over off
        assert geometry.rotate(turn, np.array([0.0, 0.0, 1.0])) == pytest.approx(end, abs=1e-10)


def test_between_equal_directions_there_is_no_turn():
    up = np.array([0.0, 0.0, 1.0])
    assert geometry.quaternion_between(up, up).tolist() == [1.0, 0.0, 0.0, 0.0]


# Gaps


def scene(shape, normal=(0.0, 0.0, 1.0), support=(0.0, 0.0, 0.0), **pose):
    plane = Body("plane", HalfSpace(normal), position=support)
    return Scenario("rest", (plane, Body("body", shape, mass=1.0, **pose)), (Pair("body", "plane"),), 1.0)


def test_a_balls_gap_is_its_height_less_its_radius():
    positions = np.array([[3.0, -2.0, 1.0], [0.0, 0.0, 0.25], [0.0, 0.0, 0.125]])
    gaps = geometry.separation(scene(Sphere(0.25)), "body", "plane", positions, np.tile([1.0, 0, 0, 0], (3, 1)))
    assert gaps.tolist() == [0.75, 0.0, -0.125]


def test_the_gap_of_a_ball_is_that_of_the_lowest_point_of_its_surface():
    rng = np.random.default_rng(RNG_SEED)
    surface = rng.normal(size=(20_000, 3))
    surface *= 0.3 / np.linalg.norm(surface, axis=1, keepdims=True)
    for _ in range(10):
        made = scene(Sphere(0.3), tuple(rng.normal(size=3)), tuple(rng.normal(size=3)))
        position, plane = rng.normal(size=3), made.body("plane")
        lowest = np.min((position + surface - plane.position) @ plane.shape.normal)
        gap = geometry.separation(made, "body", "plane", position[None], np.array([[1.0, 0, 0, 0]]))[0]
        # Of 20 000 points on 1.1 m² the lowest is within some 3 cm of the true one, so 0.03²/(2 · 0.3) m above it
        assert gap <= lowest < gap + 2e-3


def test_the_gap_of_a_box_is_that_of_its_lowest_corner():
    rng = np.random.default_rng(RNG_SEED)
    corners = np.array(list(itertools.product((-0.1, 0.1), (-0.2, 0.2), (-0.4, 0.4))))
    made = scene(Box((0.1, 0.2, 0.4)), (1.0, -2.0, 2.0), (0.5, 0.25, -1.0))
    normal = np.array([1.0, -2.0, 2.0]) / 3
    positions, turns = rng.normal(size=(50, 3)), quaternions(rng, 50)
    gaps = geometry.separation(made, "body", "plane", positions, turns)
    for gap, position, turn in zip(gaps, positions, turns, strict=True):
        world = position + corners @ matrix(turn).T
        assert gap == pytest.approx(np.min((world - (0.5, 0.25, -1.0)) @ normal), abs=1e-14)  # numbers of order one


def test_a_box_on_its_edge_stands_half_a_diagonal_below_its_centre():
    eighth = np.array([[math.cos(math.pi / 8), math.sin(math.pi / 8), 0.0, 0.0]])  # 45° about x
    gap = geometry.separation(scene(Box((1.0, 1.0, 1.0))), "body", "plane", np.array([[0.0, 0.0, 2.0]]), eighth)
    assert gap[0] == pytest.approx(2 - math.sqrt(2), abs=1e-15)


def test_turning_the_whole_scene_does_not_change_the_gap():
    rng = np.random.default_rng(RNG_SEED)
    box, turns = Box((0.1, 0.2, 0.4)), quaternions(rng, 10)
    at, support, normal = rng.normal(size=(3, 3))
    pose = quaternions(rng, 1)
    here = geometry.separation(scene(box, tuple(normal), tuple(support)), "body", "plane", at[None], pose)
    for turn in turns:
        w, q = turn[0], turn[1:]
        turned_pose = np.array(
            [[w * pose[0, 0] - q @ pose[0, 1:], *(w * pose[0, 1:] + pose[0, 0] * q + np.cross(q, pose[0, 1:]))]]
        )
        made = scene(box, tuple(matrix(turn) @ normal), tuple(matrix(turn) @ support))
        there = geometry.separation(made, "body", "plane", (matrix(turn) @ at)[None], turned_pose)
        assert there == pytest.approx(here, abs=1e-14)


def test_a_gap_needs_a_half_space_and_a_body():
    pose = np.zeros((1, 3)), np.array([[1.0, 0, 0, 0]])
    with pytest.raises(InvalidInput, match="body is a Sphere; the gap is known for a half-space"):
        geometry.separation(scene(Sphere(1.0)), "plane", "body", *pose)
    with pytest.raises(InvalidInput, match="the gap between two bodies of shape HalfSpace is not defined"):
        geometry.separation(scene(Sphere(1.0)), "plane", "plane", *pose)


# Starting in contact


@pytest.mark.parametrize(
    ("height", "rests"), [(0.25, True), (0.25 + 9e-7, True), (0.25 - 9e-7, True), (0.26, False), (0.24, False)]
)
def test_a_body_with_a_gap_below_a_micrometre_starts_in_contact(height, rests):
    assert geometry.starts_in_contact(scene(Sphere(0.25), position=(0.0, 0.0, height))) is rests


FLOOR = Body("floor", HalfSpace())
LOW = Body("low", Sphere(0.5), mass=1.0, position=(0.0, 0.0, 0.5))
HIGH = Body("high", Sphere(0.5), mass=1.0, position=(5.0, 0.0, 2.0))
CEILING = Body("ceiling", HalfSpace((0.0, 0.0, -1.0)), position=(0.0, 0.0, 2.5))


def test_all_bodies_must_rest_for_a_scenario_to_start_in_contact():
    low, high, top = Pair("low", "floor"), Pair("high", "floor"), Pair("ceiling", "high")
    assert geometry.starts_in_contact(Scenario("one", (FLOOR, LOW), (low,), 1.0))
    assert not geometry.starts_in_contact(Scenario("two", (FLOOR, LOW, HIGH), (low, high), 1.0))
    assert geometry.starts_in_contact(Scenario("three", (FLOOR, LOW, HIGH, CEILING), (low, high, top), 1.0))


def test_touching_bodies_whose_pair_is_not_listed_are_not_in_contact():
    assert not geometry.starts_in_contact(Scenario("none", (LOW,), (), 1.0))
    assert not geometry.starts_in_contact(Scenario("unlisted", (FLOOR, LOW), (), 1.0))
    through = Scenario("through", (FLOOR, LOW, HIGH, CEILING), (Pair("low", "floor"), Pair("high", "floor")), 1.0)
    assert not geometry.starts_in_contact(through)
    assert [(a.name, b.name) for a, b in geometry.touching(through)] == [("low", "floor")]


def test_two_immovable_bodies_are_never_in_contact():
    bodies, pairs = (FLOOR, CEILING, LOW), (Pair("floor", "ceiling"), Pair("low", "floor"))
    assert [(a.name, b.name) for a, b in geometry.touching(Scenario("fixed", bodies, pairs, 1.0))] == [("low", "floor")]
    with pytest.raises(InvalidInput, match="the gap between two bodies of shape HalfSpace is not defined"):
        geometry.gap(FLOOR, CEILING)


@pytest.mark.parametrize(("height", "stands"), [(1.5, True), (1.5 + 9e-7, True), (1.5 - 9e-7, True), (1.51, False)])
def test_two_movable_bodies_that_touch_lean_on_each_other(height, stands):
    upper = Body("upper", Sphere(0.5), mass=1.0, position=(0.0, 0.0, height))
    pairs = (Pair("low", "floor"), Pair("upper", "low"))
    assert geometry.leaning(Scenario("stack", (FLOOR, LOW, upper), pairs, 1.0)) is stands
    assert not geometry.leaning(Scenario("apart", (FLOOR, LOW, upper), pairs[:1], 1.0)), "they do not collide"


def test_a_body_on_the_floor_does_not_lean_on_another():
    assert not geometry.leaning(scene(Sphere(0.25), position=(0.0, 0.0, 0.25)))


def test_a_tilted_box_that_starts_flat_on_a_slope_is_in_contact():
    normal = np.array([math.sin(0.3), 0.0, math.cos(0.3)])
    turn = geometry.quaternion_between(np.array([0.0, 0.0, 1.0]), normal)
    made = scene(Box((0.2, 0.2, 0.1)), tuple(normal), position=tuple(0.1 * normal), orientation=tuple(turn))
    assert geometry.starts_in_contact(made)
    level = scene(Box((0.2, 0.2, 0.1)), tuple(normal), position=tuple(0.1 * normal))
    assert not geometry.starts_in_contact(level)


# Gaps between any two bodies


def nearest(first: Body, second: Body) -> float:
    """Distance of two boxes or a ball's centre and a box by projections in turn, m: never too small; near zero inside.

    Projecting onto one convex body, then onto the other, comes ever closer to the nearest points (Cheney, Goldstein).
    """
    at = np.array(first.position)
    for _ in range(300 if isinstance(first.shape, Box) else 1):
        at = onto(second, at)
        at = onto(first, at)
    return float(np.linalg.norm(at - onto(second, at)))


def onto(body: Body, place: np.ndarray) -> np.ndarray:
    """The point of a solid box that is nearest to a place; of a ball, its centre."""
    if isinstance(body.shape, Sphere):
        return np.array(body.position)
    turn = matrix(np.array(body.orientation))
    extents = np.array(body.shape.half_extents)
    own = turn.T @ (place - body.position)
    return np.array(body.position) + turn @ np.clip(own, -extents, extents)


def random_body(rng: np.random.Generator, name: str, shape) -> Body:
    return Body(name, shape, 1.0, tuple(rng.normal(size=3)), tuple(quaternions(rng, 1)[0]))


def test_the_gap_to_a_half_space_is_the_same_in_both_functions():
    rng = np.random.default_rng(RNG_SEED)
    for shape in (Sphere(0.3), Box((0.1, 0.2, 0.4))):
        for _ in range(20):
            plane = Body("plane", HalfSpace(tuple(rng.normal(size=3))), position=tuple(rng.normal(size=3)))
            body = random_body(rng, "body", shape)
            made = Scenario("one", (plane, body), (), 1.0)
            ruler = geometry.separation(made, "body", "plane", np.array([body.position]), np.array([body.orientation]))[
                0
            ]
            # The ruler itself is held against surfaces and corners above; numbers of order one.
            assert geometry.gap(plane, body) == pytest.approx(ruler, abs=1e-14)
            assert geometry.gap(body, plane) == geometry.gap(plane, body)


def test_the_gap_of_two_balls_is_their_distance_less_both_radii():
    one, other = (Body(name, Sphere(r), 1.0, at) for name, r, at in (("a", 0.5, (1, 2, 2)), ("b", 0.25, (0, 0, 0))))
    assert geometry.gap(one, other) == geometry.gap(other, one) == pytest.approx(3 - 0.75, abs=1e-15)
    assert geometry.gap(one, Body("c", Sphere(0.25), 1.0, one.position)) == pytest.approx(-0.75, abs=1e-15)


def test_the_gap_of_ball_and_box_is_the_distance_to_its_nearest_point():
    rng = np.random.default_rng(RNG_SEED)
    kinds = set()
    for _ in range(200):
        box, ball = random_body(rng, "box", Box((0.3, 0.5, 0.8))), random_body(rng, "ball", Sphere(0.05))
        own = matrix(np.array(box.orientation)).T @ (np.array(ball.position) - box.position)
        beyond = np.abs(own) - box.shape.half_extents
        kinds.add(int((beyond > 0).sum()))
        if beyond.max() > 0:  # nearest to a face, an edge or a corner
            assert geometry.gap(ball, box) == pytest.approx(nearest(ball, box) - 0.05, abs=1e-13)
        else:  # inside: the way to the nearest face
            assert geometry.gap(ball, box) == pytest.approx(beyond.max() - 0.05, abs=1e-13)
        assert geometry.gap(ball, box) == geometry.gap(box, ball)
    assert kinds == {0, 1, 2, 3}


def test_the_gap_of_two_boxes_is_never_too_large_and_often_exact():
    rng = np.random.default_rng(RNG_SEED)
    apart, exact = 0, 0
    for _ in range(60):
        first, second = (
            random_body(rng, "first", Box((0.2, 0.4, 0.6))),
            random_body(rng, "second", Box((0.3, 0.3, 0.5))),
        )
        gap, distance = geometry.gap(first, second), nearest(first, second)
        assert geometry.gap(second, first) == pytest.approx(gap, abs=1e-13)
        assert gap <= distance + 1e-12  # rounding: any two points of the boxes are at least the true distance apart
        assert gap > 0 or distance < 1e-6, "a gap of zero or less is an overlap"  # 300 projections come that near
        if gap > 0:
            apart, exact = apart + 1, exact + (distance - gap < 1e-6)
    assert apart > 20
    assert exact > 0


def shift_apart(first: Body, second: Body, gap: float) -> float:
    """The shortest push, m, that takes two overlapping boxes apart, by trying 20 000 directions; 0 if it is the gap."""
    rng = np.random.default_rng(RNG_SEED)
    directions = rng.normal(size=(20_000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    corners = [
        np.array(body.position)
        + np.array(list(itertools.product(*[(-half, half) for half in body.shape.half_extents])))
        @ matrix(np.array(body.orientation)).T
        for body in (first, second)
    ]
    tops, bottoms = (corners[0] @ directions.T).max(axis=0), (corners[1] @ directions.T).min(axis=0)
    return float(np.min(tops - bottoms)) + gap


def test_the_gap_of_overlapping_boxes_is_the_shortest_separating_push():
    rng = np.random.default_rng(RNG_SEED)
    for _ in range(20):
        first = random_body(rng, "first", Box((0.5, 0.7, 0.9)))
        near = tuple(np.array(first.position) + 0.3 * rng.normal(size=3))
        second = Body("second", Box((0.6, 0.6, 0.8)), 1.0, near, tuple(quaternions(rng, 1)[0]))
        gap = geometry.gap(first, second)
        assert gap < 0
        # Of 20 000 directions the best is within 1.5° of the right one; the corners that meet are up to 2 m apart, and
        # the push grows with the square where a face is the best direction, linearly where it is an edge.
        assert 0 <= shift_apart(first, second, gap) + 1e-12 < 0.06


@pytest.mark.parametrize("gap", [-1e-3, 0.0, 1e-7, 0.2])
def test_the_gap_of_stacked_boxes_is_right_however_they_are_turned(gap):
    rng = np.random.default_rng(RNG_SEED)
    for _ in range(10):
        turn = quaternions(rng, 1)[0]
        lower = Body("lower", Box((0.3, 0.4, 0.1)), 1.0, tuple(rng.normal(size=3)), tuple(turn))
        up = matrix(turn) @ np.array([0.05, -0.1, 0.1 + 0.2 + gap])
        spun = geometry.quaternion_between(
            np.array([0.0, 0.0, 1.0]), matrix(turn)[:, 2]
        )  # turned about the common axis
        upper = Body("upper", Box((0.15, 0.25, 0.2)), 1.0, tuple(np.array(lower.position) + up), tuple(spun))
        assert geometry.gap(lower, upper) == pytest.approx(gap, abs=1e-14)  # rounding of numbers of order one
        assert geometry.leaning(Scenario("two", (lower, upper), (Pair("lower", "upper"),), 1.0)) is (abs(gap) < 1e-6)


def test_a_turn_about_the_worlds_axes_follows_the_earlier_turns():
    first = np.array([math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])  # x to y
    turned = geometry.turned(first, np.array([0.0, 0.0, math.pi / 2]))  # and on to −x
    np.testing.assert_allclose(geometry.rotate(turned, np.array([1.0, 0, 0])), [-1, 0, 0], atol=1e-15)
    about_x = geometry.turned(first, np.array([math.pi / 2, 0.0, 0.0]))  # y to z, in the world
    np.testing.assert_allclose(geometry.rotate(about_x, np.array([1.0, 0, 0])), [0, 0, 1], atol=1e-15)


def test_many_small_turns_add_up_to_the_large_one():
    spin, count = np.array([0.3, -1.2, 0.5]), 1000
    orientation = np.array([[0.4, -0.2, 0.8, 0.4]])
    small = orientation
    for _ in range(count):
        small = geometry.turned(small, spin[None] / count)
    np.testing.assert_allclose(small, geometry.turned(orientation, spin[None]), atol=1e-13)  # 1000 roundings
    assert np.array_equal(geometry.turned(orientation, np.zeros((1, 3))), orientation)


def test_distance_from_a_box_is_to_its_face_edge_or_corner():
    half, upright = np.array([1.0, 2.0, 3.0]), np.array([1.0, 0.0, 0.0, 0.0])
    places = np.array([[1.5, 0, 0], [1 + 3, 2 + 4, 0], [1 + 2, 2 + 3, 3 + 6], [0.9, 0, 0], [0, 0, -3.5]])
    np.testing.assert_allclose(geometry.out_of_box(places, upright, half), [0.5, 5, 7, -0.1, 0.5], atol=1e-15)
    turned = np.array([math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])  # its x axis along y
    np.testing.assert_allclose(geometry.out_of_box(np.array([0, 1.5, 0]), turned, half), 0.5, atol=1e-15)
