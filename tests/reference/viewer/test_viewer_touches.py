"""Contacts and impulses of a replay, against what the closed forms of the impacts say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from clips import BALL, GRAVITY, HEIGHT, KEPT, RATE, bouncing
from numpy.testing import assert_allclose

from reference.catalogue.scenarios import catalogue
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.viewer.contacts import MOST, Touch, touches
from reference.viewer.poses import Poses, poses_of


def impacts(found: list[Touch]) -> list[Touch]:
    return [touch for touch in found if touch.impulse]


def of_family(name: str, case: str) -> tuple[Scenario, Poses]:
    """A case of the catalogue as the hand-written code runs it."""
    scenario = catalogue()[name].case(case).scenarios[0]
    engine = load_engine("handwritten", Implementation("solutions"))
    return scenario, poses_of(engine.run(scenario, engine.settings(scenario, "exact")))


def still(*centres: tuple[float, float, float], names: tuple[str, ...], count: int = 30) -> Poses:
    """Bodies that stay where they are."""
    positions = np.tile(np.array(centres), (count, 1, 1))
    turns = np.tile([1.0, 0.0, 0.0, 0.0], (count, len(names), 1))
    return Poses("", names, np.arange(count) / RATE, positions, turns)


@pytest.mark.parametrize("late", [0.0, 0.0155])  # s: with the second, 98 % of the impact is in one sample
def test_the_impulse_of_a_bounce_is_the_change_of_momentum(late):
    (impact,) = impacts(touches(BALL, bouncing(late=late)))
    fall = np.sqrt(2 * HEIGHT / GRAVITY)
    # m (1 + e) v; of the two samples between which it falls, each sees its share, and together the whole.
    assert impact.impulse[2] == pytest.approx(2.0 * (1 + KEPT) * GRAVITY * fall, rel=2e-3)  # kept to three digits
    assert_allclose(impact.impulse[:2], 0.0, atol=1e-9)
    assert abs(impact.first - (fall + late) * RATE) <= 1
    assert impact.normal == (0.0, 0.0, 1.0)
    assert impact.place[2] == pytest.approx(0.0, abs=1e-4)  # on the floor


def test_a_free_flight_has_no_contact():
    assert touches(BALL, bouncing(count=26)) == []  # it lands at 0.45 s, sample 27


def test_a_body_at_rest_has_one_lasting_contact_and_no_impact():
    scenario = replace(BALL, bodies=(BALL.bodies[0], replace(BALL.bodies[1], position=(0.0, 0.0, 0.1))))
    found = touches(scenario, still((0.0, 0.0, 0.1), names=("ball",)))
    assert found == [Touch(0, 29, "ball", (0.0, 0.0, -0.1), (0.0, 0.0, 1.0))]


@pytest.mark.parametrize(("height", "touching"), [(0.1875, True), (0.5, False)], ids=["floor", "lid"])
def test_a_ball_in_a_bowl_touches_the_floor_and_no_lid(height, touching):
    scenario = catalogue()["ball-in-a-bowl"].case("depth=0.3125").scenarios[0]
    ball, solid = scenario.body("ball"), scenario.body("solid")
    at_rest = (*ball.position[:2], solid.position[2] + height + 0.1)
    found = touches(scenario, still(at_rest, names=("ball",)))
    assert found == ([Touch(0, 29, "ball", (0.0, 0.0, -0.1), (0.0, 0.0, 1.0))] if touching else [])


def test_a_rolling_ball_keeps_one_contact_below_its_centre():
    times = np.arange(40) / RATE
    poses = still((0.0, 0.0, 0.1), names=("ball",), count=40)
    positions = poses.positions + np.stack([times, 0 * times, 0 * times], axis=-1)[:, None]
    turns = np.stack([np.cos(5 * times), 0 * times, np.sin(5 * times), 0 * times], axis=-1)[:, None]
    body = replace(BALL.bodies[1], position=(0.0, 0.0, 0.1), velocity=(1.0, 0.0, 0.0))
    found = touches(replace(BALL, bodies=(BALL.bodies[0], body)), Poses("", ("ball",), poses.times, positions, turns))
    assert [(touch.first, touch.last, touch.place) for touch in found] == [(0, 39, (0.0, 0.0, -0.1))]


def test_two_balls_push_each_other_along_the_line_of_their_centres():
    scenario, poses = of_family("two-balls", "e=1,m=1,b=0.5")
    (impact,) = impacts(touches(scenario, poses))
    # Equal masses, e = 1, u = 2 m/s at sin θ = 0.5: the impulse is m u cos θ = √3 N s along the normal.
    assert np.linalg.norm(impact.impulse) == pytest.approx(np.sqrt(3), rel=2e-3)
    assert_allclose(np.array(impact.impulse) / np.linalg.norm(impact.impulse), impact.normal, atol=2e-3)


def test_an_impact_at_the_start_is_found_from_the_first_velocities():
    shape, turns = Sphere(0.1), np.tile([1.0, 0.0, 0.0, 0.0], (31, 2, 1))
    balls = Body("a", shape, 3.0, (-0.1, 0.0, 0.0), velocity=(2.0, 0.0, 0.0)), Body("b", shape, 3.0, (0.1, 0.0, 0.0))
    scenario = Scenario("touching", balls, (Pair("a", "b", 1.0),), 0.5, (0.0, 0.0, 0.0))
    times = np.arange(31) / RATE
    way = np.stack([np.full_like(times, -0.1), 0.1 + 2 * times], axis=-1)[..., None] * [1.0, 0.0, 0.0]
    (impact,) = impacts(touches(scenario, Poses("", ("a", "b"), times, way, turns)))
    assert (impact.first, impact.impulse) == (0, (-6.0, 0.0, 0.0))


def test_an_impulse_through_a_chain_of_balls_is_found_at_each_contact():
    scenario, poses = of_family("cradle", "5 touching")
    found = impacts(touches(scenario, poses))
    assert [touch.body for touch in found] == ["ball 1", "ball 2", "ball 3", "ball 4"]
    assert_allclose([touch.impulse for touch in found], [(-1.0, 0.0, 0.0)] * 4, atol=5e-3)


def test_a_ball_in_a_corner_is_pushed_by_both_walls():
    floor, wall = Body("floor", HalfSpace()), Body("wall", HalfSpace((1.0, 0.0, 0.0)))
    ball = Body("ball", Sphere(0.1), 2.0, (1.1, 0.0, 1.1), velocity=(-3.0, 0.0, -3.0))
    pairs = (Pair("ball", "floor", 1.0), Pair("ball", "wall", 1.0))
    scenario = Scenario("corner", (floor, wall, ball), pairs, 0.5, (0.0, 0.0, 0.0))
    times = np.arange(31) / RATE
    way = 0.1 + np.abs(1.0 - 3.0 * times)
    turns = np.tile([1.0, 0.0, 0.0, 0.0], (31, 1, 1))
    found = impacts(touches(scenario, Poses("", ("ball",), times, np.stack([way, 0 * way, way], -1)[:, None], turns)))
    assert_allclose(sorted(touch.impulse for touch in found), [(0.0, 0.0, 12.0), (12.0, 0.0, 0.0)], atol=1e-6)


def test_a_rod_on_a_peg_is_pushed_by_the_fixed_peg():
    scenario, poses = of_family("rod-on-peg", "e=0.5,x=0.499")
    found = impacts(touches(scenario, poses))
    assert {touch.body for touch in found} == {"rod"}
    assert found[0].impulse[2] > 0
    assert found[0].normal[2] > 0.99


def test_boxes_of_a_stack_touch_face_to_face_with_upward_normals():
    cubes = [Body(f"cube {i}", Box((0.1, 0.1, 0.1)), 1.0, (0.0, 0.0, 0.1 + 0.2 * i)) for i in range(3)]
    bodies = (Body("floor", HalfSpace()), *cubes)
    pairs = tuple(Pair(one.name, other.name, 0, 0.5) for one, other in zip(bodies[1:], bodies[:-1], strict=True))
    scenario = Scenario("stack", bodies, pairs, 1.0)
    found = touches(scenario, still(*(cube.position for cube in cubes), names=tuple(cube.name for cube in cubes)))
    assert {touch.body for touch in found} == {cube.name for cube in cubes}
    for touch in found:
        assert (touch.first, touch.last, touch.normal, touch.impulse) == (0, 29, (0.0, 0.0, 1.0), ())
        assert_allclose(touch.place, (0.0, 0.0, -0.1), atol=1e-9)


def test_a_ball_on_a_box_touches_it_where_it_is_nearest():
    box = Body("box", Box((0.5, 0.5, 0.1)))
    ball = Body("ball", Sphere(0.1), 1.0, (0.2, 0.0, 0.2))
    for pair in (Pair("ball", "box"), Pair("box", "ball")):
        scenario = Scenario("on a box", (box, ball), (pair,), 1.0)
        assert touches(scenario, still((0.2, 0.0, 0.2), names=("ball",))) == [
            Touch(0, 29, "ball", (0.0, 0.0, -0.1), (0.0, 0.0, 1.0))
        ]


def test_bodies_without_a_pair_have_no_contact():
    assert touches(replace(BALL, pairs=()), bouncing()) == []


def test_a_rattling_body_has_at_most_the_allowed_contacts():
    poses = still((0.0, 0.0, 0.1), names=("ball",), count=2000)
    rattling = poses.positions + np.array([0.0, 0.0, 0.02]) * (np.arange(2000) % 2)[:, None, None]
    found = touches(BALL, Poses("", ("ball",), poses.times, rattling, poses.orientations))
    assert len(found) == MOST
