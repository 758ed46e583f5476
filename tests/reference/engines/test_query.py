"""Questions of geometry: closed forms, whoever answers."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from reference.engines import dart_engine, load_engine
from reference.errors import CannotExpress, InvalidInput
from reference.scene import geometry
from reference.scene.query import Distance, Ray
from reference.scene.scenario import Body, Box, HalfSpace, Sphere

each_engine = pytest.mark.parametrize("name", ["handwritten", "pybullet", "mujoco", "dart"])
TURNED = (0.4, -0.2, 0.8, 0.4)  # a unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1
NEAR = {"handwritten": 1e-12, "pybullet": 1e-6, "mujoco": 1e-9, "dart": 1e-12}
"""What an answer may be off by: rounding; Bullet's rays and closest points are iterated, to some 1e-7."""


def turned(vector) -> tuple[float, ...]:
    return tuple(geometry.rotate(np.array(TURNED), np.array(vector, dtype=float)))


BALL = Body("ball", Sphere(1.0), position=(1.0, 0.0, 0.0))
BOX = Body("box", Box((1.0, 1.0, 0.5)))
LEANING = Body("box", Box((1.0, 2.0, 3.0)), orientation=TURNED)
FLOOR = Body("floor", HalfSpace((0.0, 0.0, 1.0)), position=(0.0, 0.0, -1.0))
ROUND = 1e-3
"""Radius of the edges of Bullet's boxes, m: along a normal n in the box's own axes they are ROUND (‖n‖₁ − 1) short."""
SHORT = {
    "a slanting ray": ROUND * (math.sqrt(2) - 1) / math.hypot(4, 4),  # of the way, onto an edge
    "a ball and a corner": ROUND * (11 / 7 - 1),
    "a ball and a turned edge": ROUND * (7 / 5 - 1),
    "two boxes, corner to corner": 2 * ROUND * (11 / 7 - 1),
}
RAYS = {
    "a ball half-way": (Ray(BALL, (-4, 0, 0), (8, 0, 0)), 0.5),  # published with Box2D's tests
    "a box": (Ray(BOX, (-4, 0, 0), (8, 0, 0)), 0.375),  # published with Box2D's tests
    "a ball off its centre": (Ray(BALL, (-4, 0.6, 0), (8, 0, 0)), (5 - 0.8) / 8),
    "a turned box": (Ray(LEANING, turned((-4, 0.5, 1)), turned((6, 0, 0))), 0.5),
    "a slanting ray": (Ray(BOX, (-3, -3, 0), (4, 4, 0)), 0.5),
    "a floor": (Ray(FLOOR, (0, 0, 3), (1, 2, -8)), 0.5),
    "a miss": (Ray(BALL, (-4, 1.5, 0), (8, 0, 0)), math.inf),
    "a ray that ends too soon": (Ray(BALL, (-4, 0, 0), (3, 0, 0)), math.inf),
    "a ray that goes away": (Ray(BOX, (-4, 0, 0), (-8, 0, 0)), math.inf),
    "a ray away from the floor": (Ray(FLOOR, (0, 0, 3), (0, 0, 8)), math.inf),
}
DISTANCES = {
    "two balls": (Distance(BALL, Body("other", Sphere(0.5), position=(1.0, 3.0, 4.0))), 3.5),
    "a ball and a face": (Distance(BOX, Body("ball", Sphere(0.5), position=(0.3, 0.2, 2.0))), 1.0),
    "a ball and a corner": (Distance(Body("ball", Sphere(0.5), position=(3.0, 4.0, 6.5)), BOX), 7.0 - 0.5),
    "a ball and a turned edge": (Distance(Body("ball", Sphere(1.0), position=turned((4.0, 6.0, 1.0))), LEANING), 4.0),
    "two boxes, face to face": (Distance(BOX, Body("other", Box((0.5, 0.5, 0.5)), position=(0.5, 0.5, 3.0))), 2.0),
    "two boxes, corner to corner": (Distance(BOX, Body("other", Box((1, 1, 0.5)), position=(4, 5, 7))), 7.0),
    "a ball over a floor": (Distance(FLOOR, BALL), 0.0),
    "a ball in a floor": (Distance(Body("ball", Sphere(1.0), position=(0, 0, -0.5)), FLOOR), -0.5),
    "two balls that overlap": (Distance(BALL, Body("other", Sphere(1.0), position=(2.5, 0, 0))), -0.5),
}


@each_engine
@pytest.mark.parametrize("what", RAYS)
def test_the_length_of_a_ray_agrees_with_the_closed_form(name, what, installed):
    query, expected = RAYS[what]
    short = SHORT.get(what, 0.0) if name == "pybullet" else 0.0
    assert installed(name).query(query) == pytest.approx(expected + short, abs=NEAR[name])


@each_engine
@pytest.mark.parametrize("what", DISTANCES)
def test_a_distance_agrees_with_the_closed_form_in_either_order(name, what, installed):
    engine, (query, expected) = installed(name), DISTANCES[what]
    short = SHORT.get(what, 0.0) if name == "pybullet" else 0.0
    for asked in (query, Distance(query.body_b, query.body_a)):
        assert engine.query(asked) == pytest.approx(expected + short, abs=NEAR[name])


def test_dart_prefers_faces_to_edges_that_are_nearer_by_a_fiftieth(installed):
    engine, rng, excess = installed("dart"), np.random.default_rng(3), []
    for _ in range(100):
        quaternions = rng.normal(size=(2, 4))
        first, second = (tuple(q / np.linalg.norm(q)) for q in quaternions)
        box = Body("box", Box(tuple(rng.uniform(0.1, 1.0, 3))), orientation=first)
        other = Body("other", Box(tuple(rng.uniform(0.1, 1.0, 3))), 1.0, tuple(rng.normal(size=3)), second)
        gap, found = geometry.gap(box, other), engine.query(Distance(box, other))
        if gap < 0:  # the ruler is exact for boxes that overlap
            excess.append(found / gap - 1)
        else:
            assert found > gap - 1e-12  # where corners are nearest the ruler is short
    assert len(excess) > 30
    assert min(excess) > -1e-9  # rounding
    assert 0.015 < max(excess) < 0.02
    assert np.count_nonzero(np.array(excess) > 1e-9) < 0.2 * len(excess)


@pytest.mark.parametrize(
    ("detector", "casts_rays", "measures"),
    [("dart", True, True), ("fcl", False, True), ("bullet", True, False), ("ode", False, False)],
)
def test_only_darts_own_detector_knows_rays_distances_and_depths(
    detector, casts_rays, measures, installed, monkeypatch
):
    engine = installed("dart")
    monkeypatch.setitem(dart_engine.DETECTORS, "dart", dart_engine.DETECTORS[detector])
    assert (engine.query(RAYS["a box"][0]) == pytest.approx(0.375)) is casts_rays
    if not measures:
        with pytest.raises(CannotExpress):
            engine.query(DISTANCES["two balls"][0])
        return
    assert engine.query(DISTANCES["two balls"][0]) == pytest.approx(3.5)
    depths = [engine.query(DISTANCES[what][0]) for what in ("two balls that overlap", "a ball in a floor")]
    assert depths == ([-0.5, -0.5] if detector == "dart" else [-1.0, 0.0])


def test_dart_refuses_the_distance_of_two_half_spaces(installed):
    with pytest.raises(CannotExpress, match="two half-spaces"):
        installed("dart").query(Distance(FLOOR, Body("wall", HalfSpace((1.0, 0.0, 0.0)))))


def test_boxes_that_overlap_have_no_depth_by_hand():
    with pytest.raises(CannotExpress, match="cannot tell how deep"):
        load_engine("handwritten").query(Distance(BOX, Body("other", Box((1, 1, 1)), position=(0.5, 0, 0))))
    with pytest.raises(CannotExpress, match="two half-spaces"):
        load_engine("handwritten").query(Distance(FLOOR, Body("wall", HalfSpace((1.0, 0.0, 0.0)))))


def test_an_unknown_kind_of_query_is_refused():
    with pytest.raises(InvalidInput, match="a ray needs a direction"):
        Ray(BALL, (0, 0, 0), (0, 0, 0))
    with pytest.raises(InvalidInput, match="share the name 'ball'"):
        Distance(BALL, BALL)


def test_an_engine_without_geometry_refuses_queries():
    toy = load_engine(str(Path(__file__).parents[1] / "toy_engine.py"))
    with pytest.raises(CannotExpress, match="answers no questions of geometry"):
        toy.query(RAYS["a box"][0])
