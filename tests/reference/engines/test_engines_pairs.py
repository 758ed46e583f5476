"""What a scenario means, in every engine: coefficients are of pairs, and what there are no words for is refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from engine_grid import FLOOR, REPORT_CONTACTS, SCENARIOS
from promises.scenarios import LIGHT_BALL

from reference.catalogue import measure
from reference.engines import load_engine
from reference.engines.profiles import WORLD
from reference.errors import CannotExpress
from reference.scene.scenario import GRAVITY, Body, HalfSpace, Pair, Scenario, Sphere


@pytest.mark.parametrize(
    ("name", "profile", "option", "turns", "pushed", "parts"),
    [
        # By hand the velocities are solved at once, and turns only take back the overlap: a step at 10 m/s, 10 mm.
        pytest.param("handwritten", WORLD, "push_sweeps", 200, 10.0 * 1e-3, 2.9e-3, marks=pytest.mark.slow),
        # Stock, Bullet stops at a velocity that is wrong by a share of 10 m/s, for the rest of the 30 ms.
        ("pybullet", "stock", "solver_iterations", 50, 10.0 * 0.03, 85.4e-3),
    ],
)
def test_turns_leave_what_they_cannot_carry_through_a_light_ball(
    name, profile, option, turns, pushed, parts, installed
):
    engine, scenario = installed(name), SCENARIOS[LIGHT_BALL]
    first, middle, last = (1 / body.mass for body in scenario.bodies)
    # Of two contacts that share a ball, a turn leaves the square of their coupling: 0.9957 here
    left = (middle**2 / ((first + middle) * (middle + last))) ** turns
    told = engine.settings(scenario, profile)

    def apart(**changes: float) -> float:
        settings = replace(told, options={**told.options, **changes})
        one, other = (
            engine.run(replace(scenario, bodies=bodies), settings)
            for bodies in (scenario.bodies, scenario.bodies[::-1])
        )
        return max(float(np.abs(one.position(it.name) - other.position(it.name)).max()) for it in scenario.bodies)

    assert apart() == pytest.approx(parts, rel=0.01)  # m, as measured: whatever changes it is to be noticed
    assert apart() < left * pushed
    # A hundred times as many turns leave less than 10⁻⁹ of it: rounding, and the tolerance by hand, 10⁻¹⁰
    enough = {option: 100 * turns} | ({"solver_residual": 0.0} if name == "pybullet" else {})
    assert apart(**enough) < 1e-9


TWO_BALLS = Scenario(
    "two-balls",
    (
        Body("dull", Sphere(0.1), 1.0, (-2.0, 0.0, 1.1)),
        FLOOR,
        Body("lively", Sphere(0.1), 1.0, (2.0, 0.0, 1.1)),
    ),
    (Pair("dull", "floor", restitution=0.2), Pair("floor", "lively", restitution=0.8)),
    0.9,  # the lively ball is at its apex after 0.45 s × 1.8
)


@pytest.mark.parametrize("name", REPORT_CONTACTS)
def test_two_balls_on_one_floor_bounce_each_as_its_own_pair_says(name, installed):
    engine = installed(name)
    trajectory = engine.run(TWO_BALLS, engine.settings(TWO_BALLS, "tuned"))
    overlap = math.sqrt(2 * GRAVITY) * 1e-3  # v dt: a single drop may be off by as much, at 1 ms
    assert measure.first_apex(trajectory, "dull", "floor") == pytest.approx(0.2**2, abs=overlap)
    assert measure.first_apex(trajectory, "lively", "floor") == pytest.approx(0.8**2, abs=overlap)


@pytest.mark.parametrize("profile", ["tuned", "stock"])
@pytest.mark.parametrize("name", REPORT_CONTACTS)
def test_bodies_whose_pair_is_not_listed_pass_through_each_other(name, profile, installed):
    engine = installed(name)
    scenario = replace(TWO_BALLS, pairs=TWO_BALLS.pairs[1:], duration=0.6)
    trajectory = engine.run(scenario, engine.settings(scenario, profile))
    fallen = GRAVITY * 0.6**2 / 2  # 1.77 m from 1.1 m: below the floor
    assert trajectory.position("dull")[-1, 2] == pytest.approx(1.1 - fallen, abs=0.05)  # drag takes 0.04 · 0.6 of it
    assert trajectory.position("lively")[-1, 2] > 0.09
    alone = replace(scenario, pairs=())
    lonely = engine.run(alone, engine.settings(alone, profile))
    assert lonely.position("lively")[-1, 2] == pytest.approx(1.1 - fallen, abs=0.05)


@pytest.mark.parametrize("name", REPORT_CONTACTS)
@pytest.mark.parametrize("profile", ["tuned", "stock"])
def test_an_engine_with_one_coefficient_of_friction_refuses_two(name, profile, installed):
    engine, scenario = installed(name), SCENARIOS["incline"]
    two = replace(scenario, pairs=(replace(scenario.pairs[0], static_friction=0.5),))
    with pytest.raises(CannotExpress, match="friction"):
        engine.run(two, engine.settings(two, profile))


def test_the_hand_written_slab_uses_both_coefficients_of_friction():
    engine, scenario = load_engine("handwritten"), replace(SCENARIOS["incline"], duration=0.6)
    # tan 20° = 0.364 against μ = 0.3
    settings = engine.settings(scenario, "exact")
    held = replace(scenario, pairs=(replace(scenario.pairs[0], static_friction=0.5),))
    assert measure.displacement(engine.run(scenario, settings), "slab") > 0.1
    assert measure.displacement(engine.run(held, settings), "slab") == 0


def test_a_ball_landing_on_a_tilted_plane_as_a_step_ends_bounces_once():
    # Left on the plane by an impact, it may be behind it by rounding, which the slide's T must not take for the next.
    rng, engine, dt = np.random.default_rng(2), load_engine("handwritten"), 1e-3
    scenarios = []
    for number in range(300):
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        foot, speed, time = 30 * rng.normal(size=3), 0.1 * rng.integers(1, 50), dt * rng.integers(1, 12)
        gap = speed * time + GRAVITY * time**2 / 2
        ball = Body("ball", Sphere(0.1), 1.0, tuple(foot + (0.1 + gap) * normal), velocity=tuple(-speed * normal))
        plane = Body("plane", HalfSpace(tuple(normal)), position=tuple(foot))
        pair = Pair("ball", "plane", restitution=1.0)
        scenarios.append(Scenario(f"landing-{number}", (plane, ball), (pair,), 0.018, tuple(-GRAVITY * normal)))
    for profile in ("exact", "slide"):
        settings = engine.settings(scenarios[0], profile)
        for trajectory in engine.run_many(scenarios, settings):
            # It leaves with 0.1 m/s or more, so the next impact is 20 ms later at the least.
            assert [event.kind for event in trajectory.events] == ["impact"]
            landing, end = trajectory.events[0].time, float(trajectory.times[-1])
            normal = np.array(trajectory.scenario.body("plane").shape.normal)
            speeds = trajectory.velocity("ball") @ normal
            # v + g t in, the same out; rounding of 1e-14 m in the gap moves the landing by that over 0.1 m/s.
            assert speeds[-1] == pytest.approx(-speeds[0] + 2 * GRAVITY * landing - GRAVITY * end, abs=1e-9)
