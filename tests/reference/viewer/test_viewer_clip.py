"""Clips: what a replay keeps of poses, and what it makes of broken ones."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from clips import BALL, EVIL, RATE, bouncing, chain, flying, three_engines, unpacked
from numpy.testing import assert_allclose

from reference.catalogue.scenarios import catalogue
from reference.errors import InvalidInput, UnknownName
from reference.scene.forces import Spring
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere
from reference.viewer.camera import INTO, OBLIQUE, basis
from reference.viewer.clip import DASHES, FINENESS, LOOKS, STEP, TURN, Clip, Run, Solid
from reference.viewer.clip_making import clip, mesh_clip
from reference.viewer.packing import packed
from reference.viewer.page import html
from reference.viewer.picture_bounds import framed, seen_into
from reference.viewer.poses import Poses
from reference.viewer.shapes import Capsule, Convex, faces_of, vertices_of, written
from reference.viewer.still import still

TETRAHEDRON = Convex(
    ((0.3, 0.3, 0.3), (-0.3, -0.3, 0.3), (-0.3, 0.3, -0.3), (0.3, -0.3, -0.3)),
    ((0, 1, 3), (0, 3, 2), (0, 2, 1), (1, 2, 3)),
)


def read(made: Clip) -> dict:
    return json.loads(made.json())


def replaced(poses: Poses, **changes: object) -> Poses:
    names = ("title", "bodies", "times", "positions", "orientations", "recording")
    return Poses(**{name: getattr(poses, name) for name in names} | changes)


# What is kept


def test_poses_come_back_within_half_a_step_of_rounding():
    poses, found = bouncing(), read(three_engines())
    (run, *_) = found["runs"]
    positions = unpacked(run["positions"], run["count"], 3) * found["step"]
    turns = unpacked(run["turns"], run["count"], 4) * found["turn"]
    assert_allclose(positions, poses.positions[:, 0], atol=found["step"] / 2 * (1 + 1e-6), rtol=0)
    assert_allclose(turns, poses.orientations[:, 0], atol=TURN / 2 * (1 + 1e-6), rtol=0)
    assert found["step"] <= STEP


def test_a_picture_is_as_high_and_its_solids_are_where_the_clip_says():
    post = Solid("post", Box((0.5, 0.3, 0.2)), (1.25, -2.5, 0.75), (0.6, 0.0, 0.8, 0.0))
    low, high = np.array([-1.0, -3.0, 0.5]), np.array([3.0, -1.0, 2.5])
    found = read(Clip("a post", 60, (post,), (), low=low, high=high))
    assert (found["low"], found["high"]) == (low.tolist(), high.tolist())
    assert found["ratio"] == 0.5  # seen from the front: 4 m wide and 2 m high
    assert found["solids"][0]["at"] == [1.25, -2.5, 0.75]
    assert found["solids"][0]["turn"] == [0.6, 0.0, 0.8, 0.0]


def test_points_of_a_mesh_come_back_within_half_a_step_of_rounding():
    made = chain()
    found = read(made)
    for run, kept in zip(found["runs"], made.runs, strict=True):
        points = unpacked(run["points"], run["count"], 3 * run["mesh"]) * found["step"]
        assert_allclose(points.reshape(-1, 4, 3), kept.points, atol=found["step"] / 2 * (1 + 1e-6), rtol=0)
    assert found["springs"] == [[0, 1], [1, 2], [2, 3]]


@pytest.mark.parametrize(
    "values", [[0, 0, 0, 0], [5, 5, 5, 5, 5], [-1, 200, -40000, 3, 0, 0, 0, 0, 1], [2**29, -(2**29)], [7], [1, 2, 3, 4]]
)
def test_any_whole_numbers_can_be_packed(values):
    table = np.array([values, values[::-1]], dtype=float).T
    assert unpacked(packed(table, 1.0), len(values), 2).tolist() == table.tolist()


def test_small_motions_are_packed_more_finely():
    small = mesh_clip("ant", [(0, 1)], {"it": np.array([[[0.0, 0.0, 0.0], [0.001, 0.0, 0.0]]])})
    assert read(small)["step"] <= 1.001e-3 / FINENESS
    scenario, poses = flying(Sphere(1e-5), (0.0, 1.0, 0.0))
    ant = replace(scenario, bodies=scenario.bodies[1:])  # without the floor, which is seen as well
    found = read(clip(ant, {"it": replaced(poses, positions=1e-3 * poses.positions)}))
    places = unpacked(found["runs"][0]["positions"], 31, 3) * found["step"]
    assert_allclose(places, 1e-3 * poses.positions[:, 0], atol=found["step"] / 2 * (1 + 1e-6), rtol=0)
    assert found["step"] < STEP


def test_a_body_that_flies_off_does_not_shrink_the_scale_of_the_rest():
    poses = bouncing("MuJoCo")
    away = poses.positions.copy()
    away[30:, 0, 0] = 1e300
    made = clip(BALL, {"handwritten": bouncing(), "mujoco": replaced(poses, positions=away)})
    assert np.max(made.high - made.low) < 2.5  # the ball's own way is 1.2 m
    assert read(made)["runs"][1]["count"] == 61


def test_the_same_poses_make_the_same_bytes():
    assert three_engines().json() == three_engines().json()
    assert html([three_engines()]) == html([three_engines()])


def test_a_clip_of_three_runs_and_four_bodies_fits_the_budget():
    rng, count = np.random.default_rng(1), 301
    names = tuple(f"ball {i}" for i in range(4))
    scenario, _ = flying(Sphere(0.1), (0.0, 0.0, 0.0))
    body = scenario.bodies[1]
    bodies = tuple(replace(body, name=name, position=(0.0, 0.0, 1.0 + i)) for i, name in enumerate(names))
    scenario = replace(scenario, bodies=(scenario.bodies[0], *bodies))
    times = np.arange(count) / RATE
    runs = {}
    for engine in ("handwritten", "pybullet", "mujoco"):
        jitter = np.cumsum(rng.normal(0, 2e-3, (count, 4, 3)), axis=0)  # m: no engine's contacts are as restless
        turns = np.array([1.0, 0.0, 0.0, 0.0]) + rng.normal(0, 0.01, (count, 4, 4))
        turns /= np.linalg.norm(turns, axis=-1, keepdims=True)
        runs[engine] = Poses(engine, names, times, jitter, turns)
    assert len(html([clip(scenario, runs)]).encode()) < 110_000


# Names are text of somebody else's


def test_hostile_names_stay_text_in_the_json_of_a_page():
    text = clip(replace(BALL, name=EVIL), {"handwritten": bouncing(EVIL)}).json()
    assert not set("<>&\u2028\u2029") & set(text)
    found = json.loads(text)
    assert (found["title"], found["runs"][0]["title"]) == (EVIL, EVIL)


def test_line_separators_that_break_old_scripts_are_escaped():
    assert "\u2028" not in mesh_clip("a\u2028b", [], {"it": np.zeros((1, 1, 3))}).json()


# Broken runs


def test_a_run_ends_where_it_stops_being_finite():
    poses = bouncing("PyBullet")
    broken = poses.positions.copy()
    broken[25:40] = np.nan
    made = clip(BALL, {"handwritten": bouncing(), "pybullet": replaced(poses, positions=broken)})
    assert [run.count for run in made.runs] == [61, 25]
    assert "NaN" not in made.json()


def test_an_orientation_that_is_not_finite_ends_a_run_too():
    poses = bouncing()
    broken = poses.orientations.copy()
    broken[10, 0, 2] = np.inf
    assert clip(BALL, {"handwritten": replaced(poses, orientations=broken)}).runs[0].count == 10


def test_a_clip_is_as_long_as_its_longest_run():
    made = clip(BALL, {"handwritten": bouncing(count=20), "pybullet": bouncing("PyBullet", count=61)})
    assert (made.count, [run["count"] for run in read(made)["runs"]]) == (61, [20, 61])


@pytest.mark.parametrize("count", [0, 1, 2])
def test_a_clip_may_have_very_few_poses(count):
    whole = bouncing()
    few = Poses("none", whole.bodies, whole.times[:count], whole.positions[:count], whole.orientations[:count])
    for runs in ({"handwritten": few}, {"handwritten": few, "pybullet": whole}, {}):
        made = clip(BALL, runs)
        assert made.count == max([run.count for run in made.runs] + [1])
        assert np.all(np.isfinite([*made.low, *made.high]))
        assert html([made])


def test_runs_sampled_at_different_rates_are_refused():
    poses = bouncing()
    with pytest.raises(InvalidInput, match="samples a second here: handwritten 60, pybullet 120"):
        clip(BALL, {"handwritten": poses, "pybullet": replaced(poses, times=poses.times / 2)})


def test_an_unknown_body_is_refused_with_the_known_ones():
    with pytest.raises(UnknownName, match=r"unknown body 'bal'.*Choices: floor, ball"):
        clip(BALL, {"handwritten": replaced(bouncing(), bodies=("bal",))})


def test_springs_and_faces_that_join_nothing_are_refused():
    with pytest.raises(InvalidInput, match=r"spring \(0, 4\) is none of the 2 points"):
        mesh_clip("net", [(0, 4)], {"it": np.zeros((3, 2, 3))})
    with pytest.raises(InvalidInput, match=r"have shape \(3, 2\); expected \(n, p, 3\)"):
        mesh_clip("net", [], {"it": np.zeros((3, 2))})
    with pytest.raises(InvalidInput, match=r"face \(0, 1, 9\) is none of 4 vertices"):
        Convex(TETRAHEDRON.vertices, ((0, 1, 9),))


# How runs are told apart


def test_each_engine_has_its_own_line_in_every_replay():
    alone = clip(BALL, {"mujoco": bouncing("MuJoCo"), "mine.py": bouncing("mine")})
    assert alone.runs[0].look == LOOKS["mujoco"] == three_engines().runs[2].look
    many = clip(BALL, {name: bouncing(name) for name in ("theory", "pybullet", "pybullet stock", "mujoco", "mine.py")})
    looks = [run.look for run in many.runs]
    assert looks[0] == 0
    assert len(set(looks)) == len(looks)
    assert len(set(DASHES)) == len(DASHES)


def test_every_run_has_a_label_of_its_own():
    names = {"a": "PyBullet", "b": "PyBullet, stock", "c": "* odd", "d": "…", "e": "pymunk"}
    tags = clip(BALL, {name: bouncing(title) for name, title in names.items()}).tags()
    assert tags == ["PyBullet", "PyBullet stock", "odd", "…", "pymunk"]


def test_a_run_can_be_hidden_at_first():
    made = clip(BALL, {"handwritten": bouncing(), "step": bouncing("step")}, hidden={"step"})
    assert [run["shown"] for run in read(made)["runs"]] == [True, False]


def test_the_body_that_is_marked_is_the_one_that_differs_most():
    assert read(chain())["runs"][1]["marked"] == 3  # the free end, 5 % further out
    points = chain().runs[0].points
    other = points.copy()
    other[:, 2] += 0.1
    assert read(mesh_clip("", [], {"it": points, "other": other}))["runs"][1]["marked"] == 2


def test_a_ball_that_hides_its_whole_way_is_shown_where_it_began():
    poses = bouncing()
    way, radius = poses.positions - poses.positions[:1], BALL.body("ball").shape.radius
    near = replaced(poses, positions=poses.positions[:1] + 0.5 * radius * way / np.abs(way).max())
    still_there = replaced(poses, positions=np.repeat(poses.positions[:1], len(poses.positions), axis=0))
    covered = [read(clip(BALL, {"handwritten": each}))["runs"][0]["covered"] for each in (near, still_there, poses)]
    assert covered == [[0], [], []]
    rings = [still(clip(BALL, {"handwritten": each})).count(' r="5"/>') for each in (near, still_there, poses)]
    assert rings == [1, 0, 0]
    told = [html([clip(BALL, {"handwritten": each})]).count("; a ring where") for each in (near, still_there, poses)]
    assert told == [2, 0, 0]  # of the replay, and of its still picture


# The view


def test_a_motion_in_a_plane_is_seen_from_its_side():
    assert three_engines().view == (-90.0, 0.0)
    assert chain().view == (-90.0, 0.0)


def test_a_slanting_motion_is_seen_from_its_side_with_the_vertical_upright():
    scenario, poses = flying(Sphere(0.1), (0.0, 0.0, 0.0))
    azimuth, pitch = clip(scenario, {"it": poses}).view
    right, up, towards = basis((azimuth, pitch))
    assert_allclose(abs(right @ [1, 1, 0]), np.sqrt(2), atol=1e-4)
    assert_allclose(up, [0, 0, 1], atol=1e-12)
    assert abs(towards @ [1, 1, 0]) < 1e-3


@pytest.mark.parametrize(("turn", "flat"), [((2.0, -2.0, 0.0), True), ((0.0, 0.0, 2.0), False), ((2.0, 0, 0), False)])
def test_a_body_that_turns_out_of_the_plane_is_seen_obliquely(turn, flat):
    scenario, poses = flying(Box((0.1, 0.2, 0.3)), turn)
    assert (clip(scenario, {"it": poses}).view != OBLIQUE) is flat


def test_a_horizontal_motion_without_a_floor_is_seen_from_above():
    times = np.arange(31) / RATE
    points = np.stack([np.cos(times), np.sin(times), 0 * times], axis=-1)[:, None]
    assert mesh_clip("round", [], {"it": points}).view == (-90.0, 90.0)


def test_the_bounds_hold_all_that_the_first_run_shows():
    scenario, poses = flying(Box((0.1, 0.2, 0.3)), (0.0, 0.0, 2.0))
    made = clip(scenario, {"it": poses})
    corners, _ = vertices_of(Box((0.1, 0.2, 0.3)))
    far = float(np.linalg.norm(corners[0, :2]))
    assert_allclose(made.high[2], 1.3, atol=1e-9)
    assert_allclose(made.low[2], 0.0, atol=0.4)  # the floor, as far as it is near
    assert made.low[0] == pytest.approx(-0.1, abs=0.15)
    assert made.high[0] <= 0.5 + far


# Shapes


@pytest.mark.parametrize("shape", [Box((0.1, 0.2, 0.3)), TETRAHEDRON])
def test_faces_are_flat_and_look_outwards(shape):
    points, _ = vertices_of(shape)
    for face in faces_of(shape):
        corners = points[list(face)]
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
        assert_allclose((corners - corners[0]) @ normal, 0.0, atol=1e-12)
        assert np.all((points - corners[0]) @ normal <= 1e-12)


def test_every_shape_is_written_in_the_scripts_words():
    assert written(Sphere(0.5)) == {"sphere": 0.5}
    assert written(Capsule(0.1, 0.4)) == {"capsule": [0.1, 0.4]}
    assert written(HalfSpace()) == {"plane": [0.0, 0.0, 1.0]}
    assert set(written(TETRAHEDRON)) == set(written(Box((1.0, 1.0, 1.0)))) == {"points", "faces"}


def test_a_clip_of_any_shapes_can_be_made_without_a_scenario():
    poses = np.zeros((5, 2, 7))
    poses[..., 3] = 1
    poses[:, 1, 0] = np.arange(5)
    solids = (Solid("it", TETRAHEDRON), Solid("pill", Capsule(0.1, 0.2)), Solid("wall", Box((0.1, 1, 1)), (6.0, 0, 0)))
    made = framed(Clip("odd", 60, solids, (Run("theory", 0, ("it", "pill"), poses, np.zeros((5, 0, 3))),)))
    assert made.high[0] == pytest.approx(6.1, abs=1.0)
    assert [solid["name"] for solid in read(made)["solids"]] == ["it", "pill", "wall"]


def test_a_short_run_is_offered_in_stated_slow_motion():
    poses = bouncing()
    fast = clip(BALL, {"it": replaced(poses, times=poses.times / 20)})
    assert [label for _, label in read(three_engines())["speeds"]] == ["×¼", "×½", "×1", "×2"]
    assert [label for _, label in read(fast)["speeds"]] == ["×1/80", "×1/40", "×1/20", "×1/10"]


# Scenarios with springs, and surveys


def test_springs_of_a_scenario_end_where_its_bodies_are():
    turned = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))  # a quarter turn about z
    post = Body("post", Sphere(0.1), position=(0.0, 0.0, 2.0), orientation=turned)
    bob = Body("bob", Sphere(0.1), 1.0, (1.0, 0.0, 0.0))
    springs = (
        Spring("bob", "post", 10.0, 1.0, point_b=(0.3, 0.0, 0.0)),
        Spring("bob", "", 10.0, 1.0, point_b=(4, 5, 6)),
    )
    scenario = Scenario("swing", (post, bob), (), 1.0, springs=springs)
    positions = np.array([[[1.0, 0.0, 0.0]], [[1.5, 0.0, -0.5]]])
    poses = Poses("ours", ("bob",), np.array([0.0, 1 / RATE]), positions, np.tile([1.0, 0.0, 0.0, 0.0], (2, 1, 1)))
    made = clip(scenario, {"ours": poses})
    assert made.springs == ((0, 1), (0, 2))
    expected = [[at, (0.0, 0.3, 2.0), (4, 5, 6)] for at in positions[:, 0]]
    assert_allclose(made.runs[0].points, expected, atol=1e-12)


def test_a_clip_of_a_survey_has_only_the_bodies_that_are_watched():
    case = catalogue()["convex-solid"].cases[0]
    (scenario,) = case.scenarios
    assert len(scenario.bodies) > 20
    passing = scenario.body("passing")
    poses = Poses(
        "ours",
        ("passing",),
        np.array([0.0, 1 / RATE]),
        np.tile(passing.position, (2, 1, 1)),
        np.tile([1.0, 0.0, 0.0, 0.0], (2, 1, 1)),
    )
    assert {solid.name for solid in clip(scenario, {"ours": poses}).solids} == {"solid", "passing"}


def test_looking_into_a_solid_shows_all_of_it_and_where_the_ball_starts():
    tub = Body("tub", Box((0.8, 0.6, 0.2)), position=(1.5, -0.7, 0.2))
    ball = Body("ball", Sphere(0.15), 1.0, (1.2, -0.9, 3.0))
    seen = seen_into(clip(Scenario("above a tub", (tub, ball), (), 1.0), {"one": bouncing()}))
    assert seen.view == INTO
    assert_allclose(seen.low, [0.7, -1.3, 0.0])
    assert_allclose(seen.high[:2], [2.3, -0.1])
    assert seen.high[2] == pytest.approx(3.15)
