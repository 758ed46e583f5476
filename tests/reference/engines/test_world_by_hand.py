"""The hand-written world as a method: many scenarios in one batch, each by itself, and what its settings mean."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import Job
from reference.comparison.verdicts import Verdict
from reference.engines import load_engine
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput, NeedsFunction
from reference.running.study import run_job
from reference.scene.forces import Force
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere

ENGINE = load_engine("handwritten")
FLOOR = Body("floor", HalfSpace())


def ball(name: str, place, restitution: float, friction: float = 0.0, **changes) -> Scenario:
    """A ball 0.15 m above a floor."""
    body = Body("ball", Sphere(0.05), 0.7, (*place, 0.2), **changes)
    return Scenario(name, (FLOOR, body), (Pair("floor", "ball", restitution, friction),), 0.22)


def run(*scenarios: Scenario, **changes):
    return ENGINE.run_many(scenarios, ENGINE.settings(scenarios[0], "world").change(**changes))


@pytest.mark.slow
def test_scenarios_in_one_batch_do_what_each_does_alone():
    spinning = ball("spins", (0.1, 0.0), 0.5, 0.4, angular_velocity=(3.0, 20.0, -5.0), velocity=(0.4, 0.1, 0.0))
    tumbling = Scenario(
        "tumbles",
        (FLOOR, Body("box", Box((0.1, 0.07, 0.05)), 1.3, (0.0, 0.05, 0.2), (0.4, -0.2, 0.8, 0.4))),
        (Pair("box", "floor", 0.3, 0.5, 0.7),),
        0.2,
    )
    # They lie in one another, with other coefficients, other durations and other numbers of bodies.
    beside = replace(spinning, bodies=(*spinning.bodies, Body("far", Sphere(0.1), 2.0, (0.0, 0.0, 3.0))), duration=0.15)
    scenarios = spinning, tumbling, beside
    for scenario, found in zip(scenarios, run(*scenarios), strict=True):
        (alone,) = run(scenario)
        assert len(found.times) == len(alone.times) == round(scenario.duration * 1000) + 1
        for part in ("positions", "orientations", "velocities", "angular_velocities"):
            # The sweeps of a batch end when the slowest scenario is done, so that the others have a few more.
            np.testing.assert_allclose(getattr(found, part), getattr(alone, part), atol=1e-8)


def test_each_scenario_of_a_batch_has_its_own_restitution():
    dull, lively = (ball(f"e={e}", (0.0, 0.0), e) for e in (0.2, 0.9))
    fall = math.sqrt(2 * 9.81 * 0.15)
    for scenario, found in zip((dull, lively), run(dull, lively), strict=True):
        speed = found.velocity("ball")[:, 2]
        # What a step gains of weight, 10 mm/s, is all by which the instant of the impact is uncertain.
        assert speed.max() == pytest.approx(scenario.pairs[0].restitution * fall, abs=0.02)


def test_a_pair_that_is_not_listed_does_not_collide_in_the_world():
    upper = Body("upper", Sphere(0.05), 1.0, (0.0, 0.0, 0.4))
    scenario = ball("through", (0.0, 0.0), 0.0)
    both = replace(scenario, bodies=(*scenario.bodies, upper), pairs=(Pair("floor", "upper"), *scenario.pairs))
    (found,) = run(replace(both, duration=0.3))
    resting = found.positions[-1, 1:, 2]
    np.testing.assert_allclose(resting, 0.05, atol=1e-5)  # both on the floor, in the same place


def test_constant_forces_act_on_their_own_bodies_in_the_world():
    pushed = Body("pushed", Box((0.1, 0.1, 0.05)), 2.0, (0.0, 0.0, 0.05))
    left = Body("left", Box((0.1, 0.1, 0.05)), 2.0, (0.0, 1.0, 0.05))
    pairs = Pair("floor", "pushed", kinetic_friction=0.1), Pair("floor", "left", kinetic_friction=0.1)
    (found,) = run(Scenario("push", (FLOOR, pushed, left), pairs, 0.2, forces=(Force("pushed", (5.0, 0.0, 0.0)),)))
    assert found.velocity("pushed")[-1, 0] == pytest.approx(0.2 * (5.0 / 2 - 0.1 * 9.81), rel=1e-6)
    np.testing.assert_allclose(found.velocity("left")[-1], 0.0, atol=1e-9)


def test_static_friction_holds_a_slab_that_kinetic_friction_would_not():
    pull = (9.81 * math.sin(0.4), 0.0, -9.81 * math.cos(0.4))  # tan 0.4 = 0.42
    slab = Body("slab", Box((0.2, 0.1, 0.02)), 1.0, (0.0, 0.0, 0.02))
    held, slides = (
        Scenario(f"μ_s={static}", (FLOOR, slab), (Pair("slab", "floor", 0.0, 0.3, static),), 0.05, pull)
        for static in (0.45, 0.4)
    )
    speeds = [found.velocity("slab")[-1, 0] for found in run(held, slides)]
    assert speeds[0] == pytest.approx(0.0, abs=1e-9)
    assert speeds[1] == pytest.approx(0.05 * 9.81 * (math.sin(0.4) - 0.3 * math.cos(0.4)), rel=1e-6)


def test_fewer_sweeps_leave_more_of_what_a_stack_has_to_carry():
    stack = replace(catalogue()["stack"].case("boxes=5").scenarios[0], duration=0.03)
    few, many = (np.abs(run(stack, sweeps=count)[0].velocities).max() for count in (2, 200))
    assert few > 30 * many


@pytest.mark.parametrize(("name", "value"), [("sweeps", 0), ("tolerance", -1.0), ("overlap_recovery", 1.5)])
def test_settings_of_the_world_that_make_no_sense_are_refused(name, value):
    scenario = ball("refused", (0.0, 0.0), 0.5)
    with pytest.raises(InvalidInput, match=name):
        run(scenario, **{name: value})


def test_an_implementation_without_a_world_needs_its_step(tmp_path):
    mine = tmp_path / "mine.py"
    mine.write_text("")
    scenario = ball("needs", (0.0, 0.0), 0.5)
    engine = load_engine("handwritten", Implementation(str(mine)))
    with pytest.raises(NeedsFunction, match=r"^needs step_world \(world, step 1\)$"):
        engine.run(scenario, engine.settings(scenario, "world"))


# All cases of a job in one batch

COUNTING = """
from solutions.friction import *
from solutions.impulse import *
from solutions.world import *
from solutions import world

def advance_world(bodies, state, *others, **named):
    with open({calls!r}, "a") as calls:
        calls.write(f"{{len(state[0])}} ")
    if {most} < len(state[0]):
        raise ValueError("too many bodies for me")
    return world.advance_world(bodies, state, *others, **named)
"""
FAMILY, CASES = "off-centre-impact", ("corner,e=0.5,μ=0.2", "corner,e=0.5,μ=0.5")


def counted(tmp_path, most: int):
    mine, calls = tmp_path / "mine.py", tmp_path / "calls"
    mine.write_text(COUNTING.format(calls=str(calls), most=most))
    found = run_job(Job(FAMILY, "handwritten", "world", CASES, str(mine)))
    return found.rows, [int(each) for each in calls.read_text().split()]


def test_the_cases_of_a_job_take_their_steps_together(tmp_path):
    rows, bodies = counted(tmp_path, 100)
    longest = max(catalogue()[FAMILY].case(name).scenarios[0].duration for name in CASES)
    assert bodies == [4] * math.ceil(longest / 1e-3)
    assert {row.verdict for row in rows} == {Verdict.PASS}


def test_where_the_batch_of_a_job_fails_each_case_runs_by_itself(tmp_path):
    rows, bodies = counted(tmp_path, 3)
    assert bodies[0] == 4
    assert set(bodies[1:]) == {2}
    assert {row.verdict for row in rows} == {Verdict.PASS}
