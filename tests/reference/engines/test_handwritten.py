from __future__ import annotations

import math

import numpy as np
import pytest

from reference.catalogue import measure
from reference.engines import load_engine
from reference.errors import InvalidInput, NeedsFunction, RunFailed
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere

G = 9.81
SLOPE = 0.3
UP = (0.0, 0.0, 1.0)
TILTED = (math.sin(SLOPE), 0.0, math.cos(SLOPE))
DOWNHILL = np.array([math.cos(SLOPE), 0.0, -math.sin(SLOPE)])
HANDWRITTEN = load_engine("handwritten")
PROFILES = ("exact", "slide", "step")


def ball(normal=UP, restitution=0.5, friction=0.0, duration=2.0, gap=0.5, **state):
    """A ball above a plane through the origin."""
    position = tuple((0.1 + gap) * np.array(normal))
    body = Body("ball", Sphere(0.1), mass=2.0, position=position, **state)
    pair = Pair("ball", "plane", restitution, kinetic_friction=friction)
    return Scenario("ball", (Body("plane", HalfSpace(normal)), body), (pair,), duration)


def slab(normal=UP, friction=0.3, turn=None, duration=2.0, height=0.1, gravity=(0.0, 0.0, -G), static=None, **state):
    """A slab on a plane through the origin, flat where no other turn is given."""
    if turn is None:
        turn = geometry.quaternion_between(np.array(UP), np.array(normal))
    position = tuple(height * np.array(normal))
    body = Body("slab", Box((0.4, 0.3, 0.1)), mass=2.0, position=position, orientation=tuple(turn), **state)
    bodies = Body("plane", HalfSpace(normal)), body
    pair = Pair("slab", "plane", kinetic_friction=friction, static_friction=static)
    return Scenario("slab", bodies, (pair,), duration, gravity)


def run(scenario, profile="exact", **changes):
    return HANDWRITTEN.run(scenario, HANDWRITTEN.settings(scenario, profile).change(**changes))


# A ball that has come to rest on a smooth plane


@pytest.mark.parametrize("profile", PROFILES)
def test_a_ball_that_no_longer_bounces_slides_over_a_smooth_floor(profile):
    made = run(ball(velocity=(1.5, -0.5, 0.0), duration=3.0), profile)
    assert made.velocity("ball")[-1] == pytest.approx([1.5, -0.5, 0.0], abs=1e-15)
    # 3000 steps of rounding. Normal to the floor, a step method may be v dt off.
    assert made.position("ball")[-1][:2] == pytest.approx([4.5, -1.5], abs=1e-11)
    assert measure.rest_height(made, "ball", "plane") == pytest.approx(0, abs=4e-3)
    assert measure.rest_time(made, "ball") == math.inf


@pytest.mark.parametrize(
    ("restitution", "profile"),
    [
        (0.5, "exact"),
        (0.0, "slide"),
        (0.5, "step"),
        *(pytest.param(*each, marks=pytest.mark.slow) for each in ((0.0, "exact"), (0.5, "slide"), (0.0, "step"))),
    ],
)
def test_a_ball_on_a_smooth_slope_accelerates_by_g_sin_theta(profile, restitution):
    made = run(ball(TILTED, restitution), profile)
    pull, duration = G * math.sin(SLOPE), 2.0
    # 2000 steps of rounding: only the normal velocity is ever answered
    assert made.velocity("ball")[-1] @ DOWNHILL == pytest.approx(pull * duration, abs=1e-10)
    ahead = pull * duration * 1e-3 / 2 if profile == "step" else 0.0  # a step moves with the velocity just gained
    way = (made.position("ball")[-1] - made.position("ball")[0]) @ DOWNHILL
    assert way == pytest.approx(pull * duration**2 / 2 + ahead, abs=1e-10)
    assert measure.rest_height(made, "ball", "plane") == pytest.approx(0, abs=4e-3)


def test_a_ball_that_bounces_several_times_within_a_step_is_where_it_should_be():
    falling = ball(restitution=0.9, gap=0.02, duration=0.5)  # 64 ms of fall, then flights of 115 ms, 103 ms and less
    long, short = (run(falling, timestep=timestep) for timestep in (0.25, 0.001))
    assert sum(event.time <= 0.25 for event in short.events) == 2
    np.testing.assert_allclose(long.position("ball"), short.position("ball")[::250], atol=1e-11)
    np.testing.assert_allclose(long.velocity("ball"), short.velocity("ball")[::250], atol=1e-10)


@pytest.mark.parametrize("profile", PROFILES)
def test_a_ball_dropped_straight_down_stays_where_it_came_to_rest(profile):
    made = run(ball(duration=3.0), profile)
    assert measure.rest_time(made, "ball") < 1.2
    assert measure.drift(made, "ball", 1.5) == 0.0
    assert measure.residual_speed(made, "ball", 1.5) == 0.0


@pytest.mark.parametrize("profile", PROFILES)
def test_the_first_impact_is_as_early_or_late_as_its_method_makes_it(profile):
    gaps = np.linspace(0.3, 0.31, 11)
    drops = [ball(restitution=0.3, gap=float(gap), duration=0.38) for gap in gaps]
    for gap, made in zip(gaps, HANDWRITTEN.run_many(drops, HANDWRITTEN.settings(drops[0], profile)), strict=True):
        fall, speed = math.sqrt(2 * gap / G), math.sqrt(2 * gap * G)
        (impact,) = made.events  # once, though it may be behind the floor for another step
        late = impact.time - fall
        early = {"exact": 0.0, "slide": G * 1e-6 / (8 * (speed - G * 1e-3)), "step": 1e-3}[profile]
        # A step of semi-implicit Euler is half a step ahead of the fall; it is answered when the next one begins
        assert -early - 1e-12 <= late <= (1e-3 if profile == "step" else 1e-12)


@pytest.mark.parametrize(("steps", "impacts"), [(0.9, 1), (1.1, 2)])
def test_a_rebound_shorter_than_the_shortest_flight_is_taken_for_rest(steps, impacts):
    # A rebound at e u = g dt · steps/2 is in the air for so many steps; the one after it for half as many
    speed = G * 1e-3 * steps
    made = run(ball(restitution=0.5, gap=speed**2 / (2 * G)), shortest_flight=1.0)
    assert [event.kind for event in made.events] == ["impact"] * impacts + ["rest"]


def test_the_rest_speed_is_that_of_half_the_shortest_flight():
    steps = {"exact": 1e-9, "slide": 1.0, "step": 2.0}
    for profile in PROFILES:
        method = HANDWRITTEN.method(ball(), HANDWRITTEN.settings(ball(), profile))
        assert method.rest_speed == pytest.approx(G * steps[profile] * 1e-3 / 2, rel=1e-15)
    assert HANDWRITTEN.method(slab(), HANDWRITTEN.settings(slab(), "step")).rest_speed == 0


def test_the_slides_t_refuses_flights_shorter_than_a_step():
    scenario = ball()
    with pytest.raises(InvalidInput, match="shortest_flight is 1e-09; with the policy interpolated it is at least 1"):
        run(scenario, "exact", policy="interpolated")
    with pytest.raises(InvalidInput, match=r"shortest_flight is 0\.5"):
        run(scenario, "slide", shortest_flight=0.5)
    settings = HANDWRITTEN.settings(scenario, "exact").change(policy="interpolated", shortest_flight=1.0)
    assert np.array_equal(HANDWRITTEN.run(scenario, settings).positions, run(scenario, "slide").positions)


def test_an_unknown_policy_is_refused_with_the_known_ones():
    with pytest.raises(InvalidInput, match="policy is 'guess'; here it is one of exact_root, interpolated, at_step"):
        run(ball(), policy="guess")
    with pytest.raises(InvalidInput, match="policy is 'interpolated'; here it is one of exact_root, at_step"):
        run(slab(), policy="interpolated")


# What needs a rigid-body world

ON_ITS_SIDE = {"turn": (math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0), "height": 0.3}  # 0.3 up, 0.4 and 0.1 across
ON_ITS_END = {"turn": (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0), "height": 0.4}  # 0.4 up, 0.3 and 0.1 across
NEEDS_A_WORLD_IN_THE_END = {
    "a rough ball thrown along the floor": ball(friction=0.2, velocity=(1.0, 0.0, 0.0)),
    "a rough ball dropped on a slope": ball(TILTED, friction=0.2),
    "a spinning ball": ball(angular_velocity=(0.0, 1.0, 0.0)),
}
NEEDS_A_WORLD = {
    "a ball that would stick to a slope": Scenario(
        "ball", ball(TILTED).bodies, (Pair("ball", "plane", static_friction=0.2),), 1.0
    ),
    "a slab above the floor": slab(height=0.2),
    "a slab that leaves the floor": slab(velocity=(1.0, 0.0, 0.5)),
    "a slab that turns": slab(angular_velocity=(0.0, 0.0, 1.0)),
    "a slab on its edge": slab(
        turn=(math.cos(0.25), math.sin(0.25), 0.0, 0.0), height=0.3 * math.sin(0.5) + 0.1 * math.cos(0.5)
    ),
    "a slab that crosses a slope": slab(TILTED, velocity=(0.0, 1.0, 0.0)),
    "a slab on its side, so rough that it may tip": slab(friction=0.34, velocity=(1.0, 0.0, 0.0), **ON_ITS_SIDE),
    "a slab on its end, so rough that it may tip": slab(friction=0.26, velocity=(1.0, 0.0, 0.0), **ON_ITS_END),
    "a slab on its side that may tip before it slides": slab(friction=0.1, static=0.34, **ON_ITS_SIDE),
    "a slab pulled off the floor": slab(gravity=(0.0, 0.0, 1.0)),
    "a box without a plane": Scenario("box", (Body("box", Box((1.0, 1.0, 1.0)), mass=1.0),), (), 1.0),
    "a ball above a pillar": Scenario(
        "ball", (Body("pillar", Sphere(1.0)), ball().body("ball")), (Pair("ball", "pillar"),), 1.0
    ),
}


@pytest.mark.parametrize("what", NEEDS_A_WORLD_IN_THE_END)
def test_a_ball_that_would_roll_when_it_has_come_to_rest_needs_a_world(what):
    with pytest.raises(NeedsFunction, match="needs a rigid-body world"):
        run(NEEDS_A_WORLD_IN_THE_END[what], timestep=0.01)


@pytest.mark.parametrize("what", NEEDS_A_WORLD)
def test_a_body_that_turns_or_leaves_its_line_runs_in_the_world_alone(what):
    assert list(HANDWRITTEN.profiles(NEEDS_A_WORLD[what])) == ["world"]


ALONE = {
    "a rough ball dropped straight down": ball(friction=0.2),
    "a smooth ball thrown along the floor": ball(velocity=(1.0, 0.0, 0.0)),
    "a slab on the level, heading anywhere": slab(velocity=(1.0, 2.0, 0.0)),
    "a slab on its side": slab(velocity=(1.0, 0.0, 0.0), **ON_ITS_SIDE),
    "a slab on its side, not rough enough to tip": slab(friction=0.33, velocity=(1.0, 0.0, 0.0), **ON_ITS_SIDE),
    "a slab on its end, not rough enough to tip": slab(friction=0.24, velocity=(1.0, 0.0, 0.0), **ON_ITS_END),
    "a flat slab, however rough": slab(friction=2.9, velocity=(1.0, 0.0, 0.0)),
    "a slab that slides down": slab(TILTED, velocity=tuple(DOWNHILL)),
    "a slab that slides up": slab(TILTED, velocity=tuple(-DOWNHILL)),
    "a slab that drifts without weight": slab(gravity=(0.0, 0.0, 0.0), velocity=(1.0, 2.0, 0.0)),
    "a slab let go on a slope": slab(TILTED),
}


@pytest.mark.parametrize("what", ALONE)
def test_a_body_that_moves_as_a_point_needs_no_world(what):
    made = run(ALONE[what], timestep=0.01)
    assert made.times[-1] == pytest.approx(2.0, abs=1e-12)
    assert np.array_equal(made.orientations[-1], made.orientations[0])


def test_a_batch_of_balls_and_slabs_runs_in_the_world_alone():
    scenario = ball()
    with pytest.raises(RunFailed, match="ball has no policy that could run it; the profile world can"):
        HANDWRITTEN.run_many([scenario, slab()], HANDWRITTEN.settings(scenario, "exact"))


# A slab


def test_a_slab_that_has_stopped_is_sampled_to_the_end():
    whole = run(slab(velocity=(1.0, 0.0, 0.0)))
    parts = run(slab(velocity=(1.0, 0.0, 0.0)), sample_every=7)
    assert len(whole.times) == 2001
    assert parts.times == pytest.approx(7e-3 * np.arange(287), rel=1e-12)  # 286 samples of 7 steps cover 2 s
    assert np.array_equal(parts.positions[:286], whole.positions[::7])
    assert np.array_equal(parts.positions[-1], whole.positions[-1])


def test_a_batch_continues_while_one_of_its_members_moves():
    short, long = slab(velocity=(0.1, 0.0, 0.0)), slab(velocity=(3.0, 0.0, 0.0))
    settings = HANDWRITTEN.settings(long, "exact").change(timestep=5e-3)
    together = HANDWRITTEN.run_many([short, long], settings)
    for scenario, found in zip((short, long), together, strict=True):
        alone = HANDWRITTEN.run(scenario, settings)
        assert np.array_equal(found.positions, alone.positions)
        assert found.events == alone.events


def test_every_bounce_that_lasts_one_step_is_reported():
    speed = G * 1e-3 / 2  # up and down again in 1 ms: position and velocity are the same at every step
    scenario = ball(restitution=1.0, gap=0.0, duration=0.1, velocity=(0.0, 0.0, speed))
    impacts = [event.time for event in run(scenario, shortest_flight=0.5).events]
    assert len(impacts) >= 99  # the last one falls on the end, up to rounding
    assert impacts[:99] == pytest.approx(1e-3 * np.arange(1, 100), abs=1e-9)


def test_a_slab_that_slides_up_a_smooth_slope_comes_back_as_fast():
    made = run(slab(TILTED, friction=0.0, velocity=tuple(-2.0 * DOWNHILL), duration=4 / (G * math.sin(SLOPE))))
    back = 4 / (G * math.sin(SLOPE))
    assert made.velocity("slab")[-1] @ DOWNHILL == pytest.approx(-2 + G * math.sin(SLOPE) * made.times[-1], abs=1e-10)
    assert made.times[-1] == pytest.approx(back, abs=1e-3)  # to the next sample
    assert measure.rest_time(made, "slab") == math.inf  # it stops on the way, but not for good


def test_a_stepped_slab_stops_half_a_step_of_its_first_speed_short():
    friction, speed = 0.3, 1000.5 * 0.3 * G * 1e-3  # in the middle of a step, so that rounding does not decide in which
    made = run(slab(friction=friction, velocity=(speed, 0.0, 0.0)), "step")
    way = speed**2 / (2 * friction * G) - speed * 1e-3 / 2
    # A stop in the middle of a step is μ g dt²/8 off the sum over whole ones
    assert made.position("slab")[-1] == pytest.approx([way, 0, 0.1], abs=friction * G * 1e-6 / 7)
    assert made.velocity("slab")[-1].tolist() == [0.0, 0.0, 0.0]


def test_a_stepped_slab_gains_half_a_step_of_its_last_speed():
    made = run(slab(TILTED, friction=0.1), "step")
    pull = G * (math.sin(SLOPE) - 0.1 * math.cos(SLOPE))
    assert made.velocity("slab")[-1] @ DOWNHILL == pytest.approx(pull * 2.0, abs=1e-10)  # 2000 steps of rounding
    assert measure.displacement(made, "slab") == pytest.approx(pull * 2.0 + pull * 2.0 * 1e-3 / 2, abs=1e-10)


def test_a_stepped_slab_does_not_creep_where_it_holds():
    assert measure.displacement(run(slab(TILTED, friction=0.5), "step"), "slab") < 1e-12


def test_a_slab_that_slides_up_a_rough_slope_stays_up():
    friction = 0.5  # tan 0.3 is 0.31
    made = run(slab(TILTED, friction, velocity=tuple(-2.0 * DOWNHILL)))
    slowing = G * (math.sin(SLOPE) + friction * math.cos(SLOPE))
    assert measure.rest_time(made, "slab") == pytest.approx(2 / slowing, rel=1e-12)
    assert measure.stopping_distance(made, "slab", "plane") == pytest.approx(2 / slowing, rel=1e-12)  # v²/(2a), v = 2
