"""The hand-written drivers of impacts: what they answer, when, and what they refuse."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from reference import truth
from reference.engines import load_engine
from reference.engines.handwritten.scenario_kind import Kind, kind
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, NeedsFunction
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere

WEIGHTLESS = (0.0, 0.0, 0.0)
HANDWRITTEN = load_engine("handwritten")
PROFILES = ("exact", "step")
SPEED, R = 2.0, 0.1
STRUCK = 0.2003  # s: in the middle of a step
ROD = Box((0.5, 0.03, 0.02))
TURNED = (math.cos(0.3), 0.0, math.sin(0.3), 0.0)  # about y


def run(scenario, profile="exact", timestep=5e-3, **changes):
    return HANDWRITTEN.run(scenario, HANDWRITTEN.settings(scenario, profile).change(timestep=timestep, **changes))


def balls(offset=0.0, restitution=1.0, friction=0.0, mass=1.0, other=1.0, spin=(0, 0, 0), gravity=WEIGHTLESS, gap=0.3):
    """A ball that flies along +x at another one, whose centre is offset · 2R beside its line; they meet after `gap`."""
    start = (-gap - 2 * R * math.sqrt(1 - offset**2), offset * 2 * R, 0.0)
    striker = Body("striker", Sphere(R), mass, start, velocity=(SPEED, 0.0, 0.0), angular_velocity=spin)
    target = Body("target", Sphere(R), other)
    return Scenario("balls", (striker, target), (Pair("striker", "target", restitution, friction),), 0.3, gravity)


def rod(arm=0.5, restitution=0.5, mass=1.0, duration=0.4, turn=(1, 0, 0, 0), off=0.0, **state):
    """A ball that flies down onto a rod at rest and meets it at `STRUCK`."""
    start = (arm, off, 0.02 + R + STRUCK * SPEED)
    ball = Body("ball", Sphere(R), mass, start, velocity=(0.0, 0.0, -SPEED))
    bodies = (Body("rod", ROD, 1.0, orientation=turn, **state), ball)
    return Scenario("rod", bodies, (Pair("ball", "rod", restitution),), duration, WEIGHTLESS)


def row(velocities, gaps=(), lead=0.1, restitution=1.0, masses=None):
    """Balls along the diagonal of x and z. gaps: between neighbours, m, none where not given."""
    along = np.array([math.sqrt(0.5), 0.0, math.sqrt(0.5)])
    gaps = [lead, *(gaps or [0.0] * (len(velocities) - 2))]
    places = np.concatenate([[0.0], np.cumsum(np.array(gaps) + 2 * R)])
    masses = masses or [1.0] * len(velocities)
    bodies = tuple(
        Body(f"ball {n}", Sphere(R), m, tuple(place * along), velocity=tuple(v * along))
        for n, (place, v, m) in enumerate(zip(places, velocities, masses, strict=True))
    )
    pairs = tuple(Pair(a.name, b.name, restitution) for a, b in pairwise(bodies))
    return Scenario("row", bodies, pairs, 0.5, WEIGHTLESS)


def along_row(trajectory):
    return trajectory.velocities[-1, :, 0] * math.sqrt(2)


def momenta(trajectory):
    """Momentum, and angular momentum about the origin, of bodies that are all balls, at each sample."""
    total = np.zeros((len(trajectory.times), 6))
    for body in trajectory.scenario.bodies:
        place, velocity = trajectory.position(body.name), trajectory.velocity(body.name)
        spin = 0.4 * body.mass * body.shape.radius**2 * trajectory.angular_velocity(body.name)
        total += np.concatenate([body.mass * velocity, np.cross(place, body.mass * velocity) + spin], axis=1)
    return total


# Two balls


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("offset", [0.0, 0.3, 0.9])
def test_two_balls_at_the_exact_instant_leave_as_theory_says(offset, restitution):
    made = run(balls(offset, restitution, mass=1.5, other=0.7))
    striker, target = truth.balls_after(SPEED, offset, restitution, 1.5, 0.7)
    # The way is b below the target here, so the normal points down there. Rounding of numbers of some m/s.
    np.testing.assert_allclose(made.velocity("striker")[-1, :2], striker, atol=1e-14)
    np.testing.assert_allclose(made.velocity("target")[-1, :2], target, atol=1e-14)
    assert [event.kind for event in made.events] == ["impact"]
    assert made.events[0].time == pytest.approx(0.15, abs=1e-14)


def test_at_the_step_the_line_of_centres_has_turned_with_the_overlap():
    made = run(balls(0.5, gap=0.3003), "step", timestep=1e-3)
    reach, time = 2 * R * math.sqrt(0.75), 0.151  # s: the first step that begins in overlap
    distance = math.hypot(reach + 0.3003 - SPEED * time, R)
    _, target = truth.balls_after(SPEED, R / distance, 1.0, 1.0, 1.0)
    np.testing.assert_allclose(made.velocity("target")[-1, :2], target, atol=1e-13)
    assert R / distance > 0.5


ROUGH = {
    "offset": st.floats(-0.95, 0.95),
    "friction": st.floats(0, 1),
    "restitution": st.floats(0, 1),
    "spin": st.tuples(*[st.floats(-50, 50)] * 3),
    "other": st.floats(0.1, 10),
}


def check_momenta(profile, offset, friction, restitution, spin, other):
    made = momenta(run(balls(offset, restitution, friction, 1.0, other, spin), profile, timestep=0.01))
    # What the slip costs acts at one point of both. At the step the points are an overlap of some cm apart: A's counts.
    np.testing.assert_allclose(made, np.broadcast_to(made[0], made.shape), atol=1e-12 * (10 + np.abs(made).max()))


@pytest.mark.parametrize("profile", PROFILES)
@settings(max_examples=30)
@given(**ROUGH)
def test_two_rough_balls_keep_both_their_momenta(profile, **impact):
    check_momenta(profile, **impact)


@pytest.mark.slow
@pytest.mark.parametrize("profile", PROFILES)
@settings(max_examples=100)
@given(**ROUGH)
def test_rough_balls_keep_both_momenta_in_many_more_impacts(profile, **impact):
    check_momenta(profile, **impact)


def test_two_balls_falling_side_by_side_meet_as_if_weightless():
    still, falling = (run(balls(0.4, gravity=gravity)) for gravity in (WEIGHTLESS, (0.0, 0.0, -9.81)))
    assert falling.events[0].time == pytest.approx(still.events[0].time, abs=1e-14)
    np.testing.assert_allclose(falling.velocity("target")[:, :2], still.velocity("target")[:, :2], atol=1e-13)
    np.testing.assert_allclose(falling.velocity("target")[:, 2], -9.81 * falling.times, atol=1e-13)


def test_balls_without_restitution_strike_once_and_move_on_together():
    made = run(balls(0.0, restitution=0.0))
    assert len(made.events) == 1
    assert made.velocity("striker")[-1, 0] == pytest.approx(1.0, abs=1e-15)
    gap = np.linalg.norm(made.position("striker") - made.position("target"), axis=1) - 2 * R
    assert gap.min() == pytest.approx(0.0, abs=1e-12)


def test_an_immovable_ball_throws_a_striker_back():
    made = run(balls(0.0, restitution=0.5, other=math.inf))
    assert made.velocity("striker")[-1].tolist() == pytest.approx([-1.0, 0.0, 0.0], abs=1e-15)
    assert not made.velocity("target").any()


def test_impacts_in_a_batch_give_what_each_gives_alone():
    scenarios = [balls(0.0), balls(0.7, 0.5), replace(balls(0.3, other=3.0), duration=0.2)]
    chosen = HANDWRITTEN.settings(scenarios[0], "exact").change(timestep=5e-3)
    for alone, together in zip(scenarios, HANDWRITTEN.run_many(scenarios, chosen), strict=True):
        np.testing.assert_allclose(together.positions, HANDWRITTEN.run(alone, chosen).positions, atol=1e-15)


# Rods


@pytest.mark.parametrize("profile", PROFILES)
@pytest.mark.parametrize("turn", [(1, 0, 0, 0), TURNED])
def test_a_rod_turned_with_its_ball_moves_like_a_level_one(profile, turn):
    level = run(rod(0.4), profile)
    w, y = turn[0], turn[2]
    tilt = 2 * math.atan2(y, w)
    matrix = np.array([[math.cos(tilt), 0, math.sin(tilt)], [0, 1, 0], [-math.sin(tilt), 0, math.cos(tilt)]])
    scenario = rod(0.4)
    ball = scenario.body("ball")
    ball = replace(ball, position=tuple(matrix @ ball.position), velocity=tuple(matrix @ ball.velocity))
    scenario = replace(scenario, bodies=(replace(scenario.body("rod"), orientation=turn), ball))
    made = run(scenario, profile)
    np.testing.assert_allclose(made.position("ball"), level.position("ball") @ matrix.T, atol=1e-12)
    np.testing.assert_allclose(made.angular_velocity("rod"), level.angular_velocity("rod"), atol=1e-12)


def test_a_first_collide_runs_before_inertia_is_turned_into_the_world(tmp_path):
    path = tmp_path / "first.py"
    path.write_text(
        "def world_inverse_inertia(*arguments):\n    raise NotImplementedError\n\n"
        "def collide(a, b, normal, restitution):\n    assert a[4].shape == b[4].shape == (1, 3, 3)\n"
        "    return b[0], a[1], a[0], b[1]\n"
    )
    engine = load_engine("handwritten", Implementation(f"{path} | solutions"))
    found = engine.run(rod(), engine.settings(rod(), "exact"))
    assert found.velocity("rod")[-1] == pytest.approx([0, 0, -SPEED])
    with pytest.raises(NeedsFunction, match="needs world_inverse_inertia"):
        engine.run(rod(turn=(0, 0, 0, 1)), engine.settings(rod(), "exact"))


def test_a_struck_rod_turns_at_a_steady_rate():
    made = run(rod(0.4))
    struck = made.times > STRUCK
    spin = made.angular_velocity("rod")[struck][:, 1]
    assert np.ptp(spin) == 0.0
    w, y = made.orientation("rod")[struck][:, [0, 2]].T
    # θ = ω (t − t₁), and the ball has gone its own way since.
    np.testing.assert_allclose(2 * np.arctan2(y, w), spin * (made.times[struck] - STRUCK), atol=1e-12)


@pytest.mark.parametrize("profile", PROFILES)
def test_a_ball_that_the_rod_strikes_again_as_it_turns_needs_a_world(profile):
    with pytest.raises(NeedsFunction, match="needs a rigid-body world"):
        run(rod(0.25, restitution=1.0, mass=20.0, duration=1.0), profile)


# Planes


def test_a_spinning_ball_needs_a_world_once_it_comes_to_rest():
    ball = Body("ball", Sphere(R), 1.0, (0, 0, 0.6), velocity=(1, 0, 0), angular_velocity=(0, 30, 0))
    bodies, pairs = (Body("floor", HalfSpace()), ball), (Pair("ball", "floor", 0.5, 0.2),)
    for profile in PROFILES:
        assert len(run(Scenario("spin", bodies, pairs, 0.7), profile).events) == 2
        with pytest.raises(NeedsFunction, match="needs a rigid-body world"):
            run(Scenario("spin", bodies, pairs, 2.0), profile)


def test_a_fast_ball_passes_a_thin_wall_only_in_the_step_method():
    wall = Body("wall", Box((0.005, 1.0, 1.0)))
    ball = Body("ball", Sphere(0.02), 1.0, (-1.03, 0, 0), velocity=(100.0, 0, 0))
    scenario = Scenario("shot", (wall, ball), (Pair("ball", "wall", 0.5),), 0.03, WEIGHTLESS)
    assert run(scenario).velocity("ball")[-1, 0] == pytest.approx(-50.0, abs=1e-12)
    through = run(scenario, "step", timestep=1e-3)  # 0.1 m a step, from 3 cm before the wall to 7 cm behind it
    assert not through.events
    assert through.velocity("ball")[-1, 0] == 100.0


# Rows of balls


@pytest.mark.parametrize("count", [3, 5])
def test_touching_balls_by_hand_answer_in_pairs_or_all_at_once(count):
    first = [1.0] + [0.0] * (count - 1)
    in_turn, at_once = (along_row(run(row(first), profile)) for profile in PROFILES)
    np.testing.assert_allclose(in_turn, first[::-1], atol=1e-14)
    np.testing.assert_allclose(at_once, truth.cradle_at_once(np.array(first), 0), atol=1e-14)


def test_balls_apart_answer_one_after_another_in_both_methods():
    for profile in PROFILES:
        made = run(row([1.0, 0, 0, 0], gaps=[0.01, 0.02]), profile)
        np.testing.assert_allclose(along_row(made), [0, 0, 0, 1], atol=1e-14)
    instants = sorted({round(event.time, 9) for event in run(row([1.0, 0, 0, 0], gaps=[0.01, 0.02])).events})
    assert instants == pytest.approx([0.1, 0.11, 0.13], abs=1e-9)


def test_two_groups_of_touching_balls_answer_separately():
    made = run(row([1.0, 0, 0, 0], gaps=[0.0, 1.0]), "step")
    np.testing.assert_allclose(along_row(made), [-1 / 3, 2 / 3, 2 / 3, 0], atol=1e-14)


ROWS = {
    "velocities": st.lists(st.floats(-2, 2), min_size=3, max_size=5),
    "restitution": st.floats(0.2, 1),
    "masses": st.lists(st.floats(0.5, 2), min_size=5, max_size=5),
}
EVER_SMALLER = {
    "velocities": [0.0, 0.0, -1.8656198669200021, -0.963548400274244],
    "restitution": 0.203125,
    "masses": [1.0, 0.5, 0.5, 1.0],
}
"""A row that strikes itself again and again, each time with a smaller impulse."""


def check_momentum(velocities, restitution, masses):
    masses = masses[: len(velocities)]
    for profile in PROFILES:
        made = run(row(velocities, restitution=restitution, masses=masses), profile, timestep=0.01)
        assert along_row(made) @ masses == pytest.approx(np.dot(velocities, masses), abs=1e-12)


@settings(max_examples=25)
@given(**ROWS)
@example(**EVER_SMALLER)
def test_a_row_of_any_masses_keeps_its_momentum(**balls):
    check_momentum(**balls)


@pytest.mark.slow
@settings(max_examples=100)
@given(**ROWS)
def test_many_more_rows_keep_their_momentum(**balls):
    check_momentum(**balls)


# What is for which driver

FLOOR = Body("floor", HalfSpace())
WALL = Body("wall", Box((0.005, 1.0, 1.0)))
SHOT = Scenario(
    "shot",
    (WALL, Body("ball", Sphere(R), 1.0, (-1, 0, 0), velocity=(9, 0, 0))),
    (Pair("ball", "wall"),),
    1.0,
    WEIGHTLESS,
)
CLOSE_BY = Body("ball", Sphere(R), 1.0, (0, 0, 0.5), velocity=(1, 0, 0))
KINDS = {
    Kind.BALLS: {"balls": balls(), "rough balls": balls(friction=0.3), "falling balls": balls(gravity=(0, 0, -9.81))},
    Kind.FACE: {
        "a rod": rod(),
        "a rod struck at its centre": rod(0.0),
        "a rough ball thrown at a floor": Scenario("ball", (FLOOR, CLOSE_BY), (Pair("ball", "floor", 0.5, 0.3),), 1.0),
        "a ball shot at a rough wall": replace(SHOT, pairs=(Pair("ball", "wall", 0.5, 0.3),)),
        "a ball that falls on a block": replace(SHOT, gravity=(9.81, 0.0, 0.0)),
    },
    Kind.THIN_WALL: {"a ball shot at a wall": SHOT},
    Kind.SPINNING: {"a rod that spins": rod(angular_velocity=(0.0, 1.0, 0.0))},
    Kind.ROW: {"a row": row([1.0, 0.0, 0.0])},
    Kind.BOUNCE: {
        "a smooth ball over a floor": Scenario("ball", (FLOOR, CLOSE_BY), (Pair("ball", "floor", 0.5),), 1.0)
    },
    Kind.FLIGHT: {"no pair": replace(balls(), pairs=()), "one ball": replace(balls(), bodies=(CLOSE_BY,), pairs=())},
    None: {
        "a ball that falls on a fixed one": balls(other=math.inf, gravity=(0, 0, -9.81)),
        "a rod that tumbles": rod(angular_velocity=(0.0, 1.0, 1.0)),
        "a rough rod that spins": replace(
            rod(angular_velocity=(0.0, 1.0, 0.0)), pairs=(Pair("ball", "rod", 0.5, 0.1),)
        ),
        "a rod struck beside its axis": rod(0.3, off=0.01),
        "a ball beyond the rod's end": rod(0.51),
        "a ball that slants at a rod": replace(
            rod(), bodies=(rod().body("rod"), replace(rod().body("ball"), velocity=(0.1, 0.0, -SPEED)))
        ),
        "two coefficients of friction": replace(
            balls(), pairs=(Pair("striker", "target", 0.5, kinetic_friction=0.1, static_friction=0.2),)
        ),
        "a row with weight": replace(row([1.0, 0.0, 0.0]), gravity=(0.0, 0.0, -9.81)),
        "a row that is none": replace(row([1.0, 0.0, 0.0]), pairs=row([1.0, 0.0, 0.0]).pairs[:1]),
        "two rods": Scenario(
            "rods", (Body("a", ROD, 1.0), Body("b", ROD, 1.0, (0, 0, 1))), (Pair("a", "b"),), 1.0, WEIGHTLESS
        ),
    },
}


@pytest.mark.parametrize(
    ("expected", "scenario"),
    [pytest.param(kind, scenario, id=name) for kind, found in KINDS.items() for name, scenario in found.items()],
)
def test_each_scenario_goes_to_the_driver_that_can_answer_it(expected, scenario):
    assert kind(scenario) is expected
    if expected is None:
        assert list(load_engine("handwritten").profiles(scenario)) == ["world"]


def test_an_unknown_policy_of_impacts_is_refused_with_the_known_ones():
    for scenario in (balls(), rod(), row([1.0, 0.0, 0.0])):
        with pytest.raises(InvalidInput, match="policy is 'interpolated'; here it is one of exact_root, at_step"):
            run(scenario, policy="interpolated")
