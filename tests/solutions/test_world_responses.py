"""The world's responses against closed forms: several impacts, and one ball."""

from __future__ import annotations

import numpy as np
import pytest
from balls_and_rods import EXACT, G, drops, energy, once, row, run, slope
from hypothesis import given, settings
from hypothesis import strategies as st

from solutions.response import penalty_rest_depth
from solutions.world.bodies import make_bodies, make_state
from solutions.world.rules import LAWS, Rules
from solutions.world.time_order import step_in_time_order

# Several impacts


@pytest.mark.parametrize(
    ("response", "after"),
    [
        ("in time order", [0, 0, 0, 0, 1]),
        ("simultaneous", [-0.6, 0.4, 0.4, 0.4, 0.4]),
        ("sequential", [-0.6, 0.4, 0.4, 0.4, 0.4]),
    ],
)
def test_cradle_passes_the_impulse_on_or_shares_it(response, after):
    velocity, _ = once(*row([1.0, 0, 0, 0, 0]), Rules(response=response, **EXACT))
    # Five numbers near 1; the sweeps end where nothing changes any more
    assert velocity[:, 0] == pytest.approx(np.array(after), abs=1e-12)


def test_left_impact_of_unequal_balls_comes_first_in_time_order():
    # 1 strikes 3, then 3 strikes the right 1; worked out by hand in quarters
    velocity, _ = once(*row([1.0, 0, -1.0], mass=(1.0, 3.0, 1.0)), Rules(response="in time order"))
    assert velocity[:, 0] == pytest.approx(np.array([-0.5, -0.25, 1.25]), abs=1e-15)
    for response in ("simultaneous", "sequential"):  # a mirror image stays one
        velocity, _ = once(*row([1.0, 0, -1.0], mass=(1.0, 3.0, 1.0)), Rules(response=response, **EXACT))
        assert velocity[:, 0] == pytest.approx(np.array([-1.0, 0, 1.0]), abs=1e-12)


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_together_a_ball_that_leaves_may_gain_energy(response):
    # All three speeds by hand: the right pair, which parts at 0.1 m/s, is driven together again
    bodies, state = row([1.0, 0, 0.1])
    velocity, _ = once(bodies, state, Rules(response=response, **EXACT))
    assert velocity[:, 0] == pytest.approx(np.array([-0.3, 0.7, 0.7]), abs=1e-12)
    after = state._replace(velocity=velocity)
    assert energy(bodies, after) == pytest.approx(0.535, abs=1e-12)
    assert energy(bodies, state) == pytest.approx(0.505, abs=1e-12)
    velocity, _ = once(bodies, state, Rules(response="in time order"))
    assert energy(bodies, state._replace(velocity=velocity)) == pytest.approx(0.505, abs=1e-15)


@pytest.mark.slow
@given(st.integers(0, 10_000))
@settings(max_examples=25)
def test_together_balls_that_all_approach_never_gain_energy(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    mass, fall = rng.uniform(0.2, 5, count), np.sort(rng.normal(size=count))[::-1]
    bodies, state = row(fall, mass=mass)
    kinds = np.arange(count)
    uneven = rng.uniform(size=(count, count))
    surfaces = bodies.surfaces._replace(
        restitution=(uneven + uneven.T) / 2,
        static_friction=np.zeros((count, count)),
        kinetic_friction=np.zeros((count, count)),
        collide=np.ones((count, count), dtype=bool),
    )
    bodies = bodies._replace(material=kinds, surfaces=surfaces)
    velocity, _ = once(bodies, state, Rules(response="simultaneous", rest_speed=0.0))
    before = energy(bodies, state)
    # rounding of the largest number
    assert energy(bodies, state._replace(velocity=velocity)) <= before * (1 + 1e-12)


# One ball


def test_drop_in_time_order_follows_its_parabolas_at_any_timestep():
    height, e, dt = 1.0, 0.5, 0.01
    fall = np.sqrt(2 * height / G)
    states = run(*drops([height], e), dt, 70, Rules(response="in time order", rest_speed=0.01))
    for step in (45, 46, 60, 68):  # before and after the impact, and on both sides of the apex
        since = step * dt - fall
        speed = e * np.sqrt(2 * G * height)
        z = speed * since - G * since**2 / 2 if since > 0 else height - G * (step * dt) ** 2 / 2
        # A hundred flights of numbers near 1
        assert states[step - 1].position[0, 2] - 0.1 == pytest.approx(z, abs=1e-13)


def test_drop_in_time_order_rests_when_its_bounces_end():
    # Bounces of 2 e v/g, 2 e² v/g, … sum up; those below the threshold of 1 mm/s would last 0.5 ms more
    e, height, dt = 0.7, 0.5, 0.05
    end = np.sqrt(2 * height / G) * (1 + e) / (1 - e)
    states = run(*drops([height], e), dt, int(end / dt) + 2, Rules(response="in time order", rest_speed=1e-3))
    still = [abs(state.velocity[0, 2]) < 1e-12 for state in states]
    assert still.index(True) == int(end / dt)  # the first step that ends after the last bounce
    # A bounce below the threshold is stopped within a step: it rises by at most 1 mm/s Δt/2
    assert states[-1].position[0, 2] == pytest.approx(0.1, abs=2.5e-5)


def test_bounces_without_end_are_cut_off_at_the_number_of_looks():
    # With no threshold the bounces converge; the world goes on, and the ball lies on the floor
    bodies, state = drops([0.5], 0.7)
    rules = Rules(response="in time order", rest_speed=0.0, looks=60)
    gravity = np.array([(0, 0, -G), (0, 0, 0)])
    after, impacts = step_in_time_order(bodies, state, gravity, 0 * gravity, 3.0, rules)
    assert impacts == 30  # every other look is a flight
    # What is left of the 3 s is flown without approach; the last bounce of 0.7³⁰ · 3.1 m/s is stopped in it
    assert after.position[0, 2] == pytest.approx(0.1, abs=1e-4)
    assert after.velocity[0, 2] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_drop_at_the_step_loses_what_its_lateness_predicts(response):
    # The ball leaves at e v, Δt/2 late on average, in which it has fallen by v Δt/2: e times that is in e v
    e, dt, heights = 0.5, 0.01, 1.0 + np.linspace(0, 0.0443, 24, endpoint=False)
    states = run(*drops(heights, e), dt, 70, Rules(response=response, recovery=0.0, margin=0.0))
    z = np.array([state.position[::2, 2] for state in states]) - 0.1
    struck = np.argmax(np.diff(z, axis=0) > 0, axis=0)
    apex = np.array([np.max(z[k:, i]) for i, k in enumerate(struck)])
    late = np.mean(apex - e**2 * heights) / np.mean(np.sqrt(2 * G * heights) * dt / 2)
    assert late == pytest.approx(-(1 - e), abs=0.03)  # the next order is g Δt/v = 2 %


@pytest.mark.parametrize("restitution", [1.0, 0.5])
def test_penalty_contact_lasts_half_a_swing_and_leaves_e(restitution):
    k, dt, v = 1e4, 5e-4, 0.7
    bodies, state = drops([0.0], restitution)
    state = state._replace(velocity=np.array([(0, 0, -v), (0, 0, 0)]))
    states = run(bodies, state, dt, 75, Rules(response="penalty", stiffness=k), gravity=0.0)
    depth = np.array([each.position[0, 2] for each in states]) - 0.1
    # The dashpot's steps are of first order, ω Δt/2 = 2.5 %; without it they are of second order
    assert states[-1].velocity[0, 2] / v == pytest.approx(restitution, rel=1e-3 if restitution == 1 else 0.02)
    if restitution == 1:
        out = int(np.argmax(depth > 0))
        lasts = dt * (out + depth[out - 1] / (depth[out - 1] - depth[out]))
        assert lasts == pytest.approx(np.pi / np.sqrt(k), rel=2e-3)
        assert np.min(depth) == pytest.approx(-v / np.sqrt(k), rel=1e-3)


def test_penalty_ball_sinks_until_its_spring_carries_it():
    k = 5e3
    states = run(*drops([0.0], 0.0), 5e-3, 60, Rules(response="penalty", stiffness=k))
    # critically damped, ω t = 21
    assert 0.1 - states[-1].position[0, 2] == pytest.approx(float(penalty_rest_depth(1.0, G, k)), rel=1e-5)


def test_penalty_friction_swings_as_fast_as_the_contact_itself():
    # The slip of a ball that sticks: a spring with ω = √(k/m) and ζ = ½ is fastest, and the slip 0, at ω_d t = π/3
    k, v = 1e4, 1e-4
    bodies, state = drops([-G / k], 0.5, friction=5.0)
    state = state._replace(velocity=np.array([(v, 0, 0), (0, 0, 0)]))
    dt = 5e-4
    states = run(bodies, state, dt, 30, Rules(response="penalty"))
    slip = [each.velocity[0, 0] - 0.1 * each.angular_velocity[0, 1] for each in states]
    out = int(np.argmax(np.array(slip) < 0))
    crossing = dt * (out + slip[out - 1] / (slip[out - 1] - slip[out]))
    # first order in ω Δt = 5 %
    assert crossing == pytest.approx(np.pi / 3 / (np.sqrt(0.75) * np.sqrt(k)), rel=0.05)


@pytest.mark.parametrize("response", list(LAWS))
def test_ball_rolls_down_a_slope_with_five_sevenths(response):
    down, normal = slope(20)
    bodies, state = drops([0.0], 0.0, floor=("half-space", normal), friction=0.6)
    state = state._replace(position=np.array([0.1 * normal, (0, 0, 0)]))
    dt, steps = (5e-3, 100) if response == "penalty" else (0.05, 10)
    states = run(bodies, state, dt, steps, Rules(response=response))
    a = 5 / 7 * G * np.sin(np.radians(20))
    # a penalty ball first sinks in, and its friction spring swings for some ms
    limit = 0.01 if response == "penalty" else 1e-5
    assert states[-1].velocity[0] @ down == pytest.approx(a * dt * steps, rel=limit)
    assert states[-1].angular_velocity[0] == pytest.approx(
        np.cross(normal, states[-1].velocity[0]) / 0.1, rel=limit, abs=2e-3 if response == "penalty" else 1e-6
    )
    if response == "in time order":  # no error of the timestep either
        assert states[-1].position[0] @ down == pytest.approx(a * (dt * steps) ** 2 / 2, rel=1e-5)


def test_penalty_friction_holds_a_box_without_creep():
    down, normal = slope(20)
    half = np.radians(20) / 2
    moments = [[0.04, 0.08, 0.1], [np.inf] * 3]
    bodies = make_bodies([("box", (0.3, 0.2, 0.1)), ("half-space", normal)], [2.0, np.inf], moments, 0.0, 0.5)
    orientation = [(np.cos(half), 0, np.sin(half), 0), (1, 0, 0, 0)]
    state = make_state([0.1 * normal, (0, 0, 0)], orientation)
    states = run(bodies, state, 2e-3, 90, Rules(response="penalty", stiffness=2e4))
    along = np.array([each.position[0] @ down for each in states])
    # Its four springs, 2/7 to 1 of those along the normal, carry m g sin 20° at some 0.1 mm
    assert 2e-5 < along[-1] < 5e-4
    # Friction in proportion to the slip, all of it at 1 mm/s, would let it creep by 30 µm in these 40 ms
    assert along[-1] == pytest.approx(along[-21], abs=1e-8)
