"""Bodies that steer themselves: one hand-written rule moves them in every engine, a student's own rule too."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue import crowd
from reference.catalogue.scenarios import catalogue
from reference.comparison.compare import compare_case
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.engines.steering import functions_of, steers_of
from reference.errors import InvalidInput, NeedsFunction, RunFailed
from reference.lecture import function
from reference.prediction import bands, steered
from reference.scene.clearance import nearest
from reference.scene.geometry import gap, opposite, rotate
from reference.scene.loads import Loads
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.steering import RULES, Steering
from solutions.avoidance import crowd_step, flock_step, steer_around

each_engine = pytest.mark.parametrize("name", ["handwritten", "pybullet", "mujoco", "dart"])
TURNED = (math.cos(0.2), 0.0, 0.0, math.sin(0.2))
PILLAR = Body("pillar", Box((0.3, 0.2, 1.0)), position=(1.0, 0.1, 0.0), orientation=TURNED)
SMALL = Body("small", Sphere(0.1), 2.0, (-0.6, 0.3, 0.0), velocity=(0.5, -0.2, 0.0))
LARGE = Body("large", Sphere(0.2), 9.0, (-0.8, -0.4, 0.0), velocity=(0.9, 0.1, 0.0))
GOALS = ((3.0, -0.2, 0.0), (2.5, 0.6, 0.0))
NUMBERS = {
    "slowing_radius": 0.5, "horizon": 1.5, "strength": 30.0, "reach": 0.6, "response_time": 0.4, "radius": 2.0,
    "separation": 0.3, "alignment": 0.5, "cohesion": 0.2, "max_acceleration": 2.0,
}  # fmt: skip
KEEPS_LEFT = """
from solutions.avoidance import crowd_step as right

def crowd_step(position, velocity, preferred, *others):
    turned = preferred + 0.2 * preferred[:, ::-1] * [-1, 1]
    return right(position, velocity, turned, *others)
"""
CALLS_NOTHING = "def arrive(position, target, max_speed, slowing_radius):\n    raise NotImplementedError\n"


def scene(rule: str, duration: float = 0.6) -> Scenario:
    told = tuple((name, NUMBERS[name]) for name in RULES[rule])
    around = ("pillar",) if rule in ("steer_around", "repelling_force", "flock_step") else ()
    steering = Steering(rule, ("small", "large"), GOALS, 1.5, 0.05, 40.0, around, 0.05, told)
    bodies, pairs = (SMALL, PILLAR, LARGE), (Pair("small", "large"), Pair("small", "pillar"))
    return Scenario(f"steered/{rule}", bodies, pairs, duration, (0.0, 0.0, 0.0), steering=(steering,))


@pytest.mark.parametrize("rule", RULES)
def test_a_rule_calls_no_function_of_avoidance_that_is_not_listed(rule):
    implementation, scenario = Implementation(), scene(rule)
    engine = load_engine("handwritten", implementation)
    engine.run(scenario, engine.settings(scenario, "world"))
    called = {name for name in implementation.asked if function(name).topic == "avoidance"}
    assert called
    assert called <= functions_of([scenario])


def counted(engine) -> str:
    return "world" if engine.name == "handwritten" else "tuned"


@each_engine
@pytest.mark.parametrize(
    "rule", ["crowd_step", *(pytest.param(rule, marks=pytest.mark.slow) for rule in RULES if rule != "crowd_step")]
)
def test_each_rule_moves_two_unequal_bodies_as_the_recurrence_says(name, rule, installed):
    engine, scenario = installed(name), scene(rule)
    settings = engine.settings(scenario, counted(engine))
    run = engine.run(scenario, settings)
    expected = steered.predict(scenario, settings, engine.method(scenario, settings)).trajectory
    np.testing.assert_allclose(run.positions, expected.positions, atol=1e-11)
    np.testing.assert_allclose(run.velocities, expected.velocities, atol=1e-11)
    assert np.max(np.abs(run.velocities[-1] - run.velocities[0])) > 0.1


@each_engine
def test_a_students_rule_steers_the_bodies_of_every_engine(name, installed, tmp_path):
    installed(name)
    path, scenario = tmp_path / "mine.py", scene("crowd_step")
    path.write_text(KEEPS_LEFT, encoding="utf-8")
    ends = []
    for source in ("solutions", f"{path} | solutions"):
        engine = load_engine(name, Implementation(source))
        ends.append(engine.run(scenario, engine.settings(scenario, counted(engine))).position("small")[-1])
    assert (ends[1] - ends[0]) @ [0, 1, 0] > 0.01


@each_engine
def test_a_missing_rule_is_asked_for_in_every_engine(name, installed, tmp_path):
    installed(name)
    path = tmp_path / "mine.py"
    path.write_text(CALLS_NOTHING, encoding="utf-8")
    engine, family = load_engine(name, Implementation(f"{path} | solutions")), catalogue()["antipodal-circle"]
    settings = engine.settings(family.cases[0].scenarios[0], counted(engine))
    ((row,), _) = compare_case(family, family.cases[0], engine, counted(engine), settings)
    assert (row.verdict, row.note) == (Verdict.NEEDS, "needs arrive (avoidance, step 2)")


@each_engine
def test_walkers_who_heed_nobody_meet_in_contacts_that_are_reported(name, installed):
    engine, streams = installed(name), catalogue()["crossing-streams"]
    straight = streams.case("θ=70°,straight on").scenarios[0]
    scenario = replace(straight, pairs=streams.case("θ=70°").scenarios[0].pairs, duration=3.0)
    run = engine.run(scenario, engine.settings(scenario, counted(engine)))
    assert crowd.contacts(run) > 0
    assert steered.predict(scenario, run.settings, engine.method(scenario, run.settings)) is None


def test_a_rule_of_ones_own_is_named_first_where_a_flier_is_not_in_its_place(tmp_path):
    path, family = tmp_path / "mine.py", catalogue()["lone-flier"]
    path.write_text("def steer_around(position, *others):\n    return 0.5 + 0.0 * position\n", encoding="utf-8")
    engine, case = load_engine("handwritten", Implementation(f"{path} | solutions")), family.case("steers")
    rows, _ = compare_case(family, case, engine, "world", engine.settings(case.scenarios[0], "world"))
    (left,) = (row for row in rows if row.quantity == "left")
    assert left.note.startswith("the rule that steers it is not the lab's own")


def test_a_rule_that_fails_in_the_recurrence_alone_costs_no_number(tmp_path, installed):
    """In the recurrence nothing stops the flier, which gets into the pillar where this rule fails."""
    path, family = tmp_path / "mine.py", catalogue()["lone-flier"]
    path.write_text(
        "import numpy as np\n"
        "def steer_around(position, velocity, target, centre, reach):\n"
        "    away = np.linalg.norm(centre - position, axis=-1, keepdims=True)\n"
        "    if np.any(away < 0.5):\n"
        "        raise ValueError('within the pillar')\n"
        "    return (centre - position) / away\n",
        encoding="utf-8",
    )
    installed("mujoco")
    engine, case = load_engine("mujoco", Implementation(f"{path} | solutions")), family.case("steers")
    rows, _ = compare_case(family, case, engine, "tuned", engine.settings(case.scenarios[0], "tuned"))
    assert [row.quantity for row in rows] == [quantity.name for quantity in family.quantities]
    assert all(row.measured is not None for row in rows)


WRONG = {
    "seek": [
        ("np.full_like(position, np.nan)", "seek returned nan; it must return finite numbers"),
        ("position[:, :2]", r"seek returned an array \(2, 2\); its shape must be \(2, 3\)"),
        ("position[0]", r"seek returned an array \(3,\); its shape must be \(2, 3\)"),
        ("1.0", r"seek returned an array \(\); its shape must be \(2, 3\)"),
        ("[[1.0], [2.0, 3.0]]", r"seek returned rows of unequal length; it must return an array \(2, 3\)"),
        ("position + 1j", "of real numbers"),
        ("'left'", "seek returned 'left'; it must return an array"),
    ],
    "crowd_step": [
        ("velocity", "crowd_step returned .*; it must return two arrays, positions and velocities"),
        ("(position, np.inf * velocity)", "crowd_step returned (nan|inf|-inf); it must return finite numbers"),
    ],
    "flock_step": [("(position, velocity[:1])", r"flock_step returned an array \(1, 3\)")],
}


@pytest.mark.parametrize(
    ("rule", "answer", "words"), [(rule, *each) for rule, wrong in WRONG.items() for each in wrong]
)
def test_a_rule_that_gives_no_velocities_is_named_with_what_it_gave(rule, answer, words, tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(f"import numpy as np\ndef {rule}(position, velocity, *others):\n    return {answer}\n", "utf-8")
    engine, scenario = load_engine("handwritten", Implementation(f"{path} | solutions")), scene(rule)
    with pytest.raises(RunFailed, match=words):
        engine.run(scenario, engine.settings(scenario, "world"))


@pytest.mark.parametrize("changed", ["position", "target"])
def test_a_rule_cannot_change_the_scenario_through_its_arguments(changed, tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(f"def seek(position, target, speed):\n    {changed} -= 1.0\n    return target\n", "utf-8")
    engine, scenario = load_engine("handwritten", Implementation(f"{path} | solutions")), scene("seek")
    with pytest.raises(ValueError, match="read-only"):
        engine.run(scenario, engine.settings(scenario, "world"))


def test_a_force_stays_for_an_interval_and_is_shortened_to_the_largest():
    steers = steers_of(scene("seek"), Implementation("solutions"))
    position = np.array([body.position for body in (SMALL, PILLAR, LARGE)])
    velocity = np.array([body.velocity for body in (SMALL, PILLAR, LARGE)])
    first = steers(0.0, position, velocity)
    wanted = 1.5 * (np.array(GOALS[0]) - SMALL.position) / math.dist(GOALS[0], SMALL.position)
    np.testing.assert_allclose(first[0], SMALL.mass * (wanted - SMALL.velocity) / 0.05)
    np.testing.assert_allclose(np.linalg.norm(first, axis=-1)[1:], [0.0, 40.0])  # the large one needs 110 N
    assert steers.waits(0.049)
    np.testing.assert_array_equal(steers(0.049, position[::-1], 2 * velocity), first)
    assert not steers.waits(0.05)
    assert np.any(steers(0.05, position, 2 * velocity) != first)


@pytest.mark.parametrize("rule", ["crowd_step", "flock_step", "steer_around"])
def test_a_step_without_a_limit_gives_the_velocity_of_the_rule_itself(rule):
    scenario = scene(rule)
    (told,) = scenario.steering
    told = replace(told, max_force=1e9, obstacles=() if rule == "flock_step" else told.obstacles)
    scenario = replace(scenario, steering=(told,), duration=0.05)
    engine = load_engine("handwritten", Implementation("solutions"))
    settings = replace(engine.settings(scenario, "world"), timestep=0.05, sample_every=1)
    found = engine.run(scenario, settings).velocities[-1, [0, 2]]
    p, v = (np.array([getattr(body, at) for body in (SMALL, LARGE)]) for at in ("position", "velocity"))
    goals, to_goal = np.array(GOALS), np.array(GOALS) - p
    if rule == "crowd_step":
        wished = 1.5 * to_goal / np.linalg.norm(to_goal, axis=-1, keepdims=True)
        expected = crowd_step(p[:, :2], v[:, :2], wished[:, :2], [0.15, 0.25], 1.5, 1.5, 0.05)[1]
        np.testing.assert_allclose(found[:, :2], expected, atol=1e-12)
        return
    if rule == "steer_around":
        reach = math.hypot(0.3, 0.2, 1.0) + np.array([0.15, 0.25])
        expected = 1.5 * steer_around(p, v, goals, PILLAR.position, reach)
    else:
        among = flock_step(p, v, 0.05, 2.0, (0.3, 0.5, 0.2), 1.5, 2.0)[1]
        expected = among + 0.05 / 0.4 * (1.5 * to_goal / np.linalg.norm(to_goal, axis=-1, keepdims=True) - v)
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_a_recurrence_with_half_a_percent_of_another_mass_is_seen():
    scenario = scene("crowd_step")
    engine = load_engine("mujoco")
    settings = engine.settings(scenario, "tuned")
    ways = []
    for mass in (9.0, 9.045):
        bodies = (SMALL, PILLAR, replace(LARGE, mass=mass))
        other = replace(scenario, bodies=bodies)
        ways.append(steered.predict(other, settings, engine.method(other, settings)).trajectory.position("large"))
    assert np.max(np.abs(ways[0] - ways[1])) > 100 * bands.STEERED.share


def test_the_recurrence_is_silent_without_the_code_that_steered():
    scenario = scene("crowd_step")
    engine = load_engine("mujoco", Implementation("no_such_package"))
    settings = engine.settings(scenario, "tuned")
    assert steered.predict(scenario, settings, engine.method(scenario, settings)) is None


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rule": "sekk"}, "seek"),
        ({"bodies": ("small", "small")}, "each once"),
        ({"goals": GOALS[:1]}, "1 goals for 2 bodies"),
        ({"parameters": ()}, "it needs"),
        ({"obstacles": ("pillar",)}, "heeds no obstacles"),
        ({"interval": 0.0}, "interval"),
    ],
)
def test_a_rule_that_makes_no_sense_is_refused(change, message):
    with pytest.raises(InvalidInput, match=message):
        replace(scene("crowd_step").steering[0], **change)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bodies": ("small", "pillar")}, "pillar is steered, and is immovable"),
        ({"rule": "steer_around", "parameters": (), "obstacles": ("large",)}, "large is an obstacle"),
        ({"bodies": ("small", "tall")}, "tall"),
    ],
)
def test_a_scenario_refuses_to_steer_what_it_cannot(change, message):
    scenario = scene("crowd_step")
    with pytest.raises(InvalidInput, match=message):
        replace(scenario, steering=(replace(scenario.steering[0], **change),))
    with pytest.raises(InvalidInput, match="two rules steer one body"):
        replace(scenario, steering=2 * scenario.steering)


def test_an_obstacle_without_a_size_is_refused_by_name():
    scenario = scene("steer_around")
    scenario = replace(scenario, bodies=(SMALL, Body("pillar", HalfSpace()), LARGE))
    with pytest.raises(InvalidInput, match="pillar is a HalfSpace"):
        steers_of(scenario, Implementation("solutions"))


def test_forces_without_code_that_steers_are_refused():
    with pytest.raises(InvalidInput, match="nothing here says how"):
        Loads(scene("seek"))


@each_engine
def test_a_timestep_beyond_the_interval_is_refused(name):
    engine, scenario = load_engine(name), scene("seek")
    with pytest.raises(InvalidInput, match=r"longer than the 0\.05 s after which seek is asked again"):
        engine.check_settings(scenario, replace(engine.settings(scenario, counted(engine)), timestep=0.06))


def test_a_missing_function_is_named_by_the_query_too(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text("", encoding="utf-8")
    run = load_engine("handwritten", Implementation("solutions"))
    found = run.run(scene("seek"), run.settings(scene("seek"), "world"))
    with pytest.raises(NeedsFunction, match="separation_of_hulls"):
        crowd.clearance_asked(found, load_engine("handwritten", Implementation(str(path))).query)


# How near two bodies come


def test_the_least_gap_lies_between_two_samples():
    balls = Body("a", Sphere(0.1), 1.0, (0, 0, 0)), Body("b", Sphere(0.2), 1.0, (0, 1, 0))
    scenario = Scenario("cross", balls, (), 1.0)
    found = nearest(scenario, np.array([[(-1.0, 0, 0), (0.5, -2, 0)], [(1.0, 0, 0), (0.5, 1, 0)]]))
    # x = (−1.5 + 2 t, 2 − 3 t): its square is least at t = 9/13.
    assert found.gap == pytest.approx(math.hypot(-1.5 + 18 / 13, 2 - 27 / 13) - 0.3, abs=1e-12)
    np.testing.assert_allclose(found.position_a, [-1 + 18 / 13, 0, 0], atol=1e-12)


@each_engine
def test_an_engines_answer_is_the_least_gap_beside_a_turned_box(name, installed):
    engine = installed(name)
    positions = np.array([[(-0.2, 0.9, 0.0), PILLAR.position], [(2.0, 0.3, 0.0), PILLAR.position]])
    scenario = Scenario("past", (SMALL, PILLAR), (), 1.0)
    found = nearest(scenario, positions)
    # The nearest place is on an edge, and the edges of Bullet's boxes are rounded.
    near = 1e-3 * (math.sqrt(2) - 1) if name == "pybullet" else 1e-9
    assert engine.query(found.question()) == pytest.approx(found.gap, abs=near)
    shares = np.linspace(0.0, 1.0, 2001)[:, None, None]
    gaps = [
        gap(replace(SMALL, position=tuple(p)), PILLAR) for p, _ in (1 - shares) * positions[0] + shares * positions[1]
    ]
    # A step of 1.1 mm passes the minimum by half of it: (0.55 mm)² ÷ (2 · 0.11 m).
    assert found.gap == pytest.approx(min(gaps), abs=2e-6)
    assert 0.01 < found.gap < min(gaps[0], gaps[-1])


def test_pybullet_finds_a_boid_beside_an_edge_farther_away(installed):
    """Its boxes are boxes that are 1 mm smaller on each side, and a ball of 1 mm around each of their points."""
    engine, scenario = installed("pybullet"), catalogue()["flock-past-pillar"].case("w=0.4").scenarios[0]
    found = nearest(scenario, engine.run(scenario, engine.settings(scenario, "tuned")).positions)
    box, ball = (found.body_a, found.position_b - found.position_a), found.body_b
    assert (box[0].name, ball.name) == ("pillar", "boid 6")
    own = rotate(opposite(np.array(box[0].orientation)), box[1])
    sharp, inner = (np.maximum(np.abs(own) - np.array(box[0].shape.half_extents) + less, 0.0) for less in (0.0, 1e-3))
    farther = np.linalg.norm(inner) - 1e-3 - np.linalg.norm(sharp)
    assert engine.query(found.question()) - found.gap == pytest.approx(farther, abs=1e-7)
    assert farther == pytest.approx(0.26e-3, abs=0.01e-3)


CROWDS = ("antipodal-circle", "crossing-streams", "lone-flier", "flock-past-pillar")
ONCE = tuple(zip(CROWDS, ("handwritten", "pybullet", "mujoco", "dart"), strict=True))
"""Each family and each engine once."""


@pytest.mark.parametrize(
    ("family", "name"),
    [
        pytest.param(*pair, marks=pytest.mark.slow if pair in ONCE else pytest.mark.weekly)
        for pair in itertools.product(CROWDS, ("handwritten", "pybullet", "mujoco", "dart"))
    ],
)
def test_whole_runs_differ_from_the_recurrence_by_rounding_alone(family, name, installed):
    engine = installed(name)
    for case in catalogue()[family].cases:
        scenario = case.scenarios[0]
        settings = engine.settings(scenario, counted(engine))
        expected = steered.predict(scenario, settings, engine.method(scenario, settings)).trajectory
        np.testing.assert_allclose(engine.run(scenario, settings).positions, expected.positions, atol=3e-13)
