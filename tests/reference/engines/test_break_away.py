"""A slab at rest under a growing push: when it breaks away, by hand and in the engines, against the recurrence."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.friction import slab_on_plane
from reference.engines import load_engine
from reference.engines.handwritten.scenario_kind import Kind, kind
from reference.errors import CannotExpress
from reference.prediction import sliding
from reference.scene.forces import Force, GrowingForce, OscillatingForce, Spring
from reference.scene.scenario import GRAVITY, Pair, Scenario

FAMILY = catalogue()["break-away"]
ASLANT = "μ=0.4,rate=20,heading=30°"


def pushed(static: float, kinetic: float, rate: tuple[float, float, float], duration: float = 0.45) -> Scenario:
    """A slab of 1 kg on the level."""
    level = slab_on_plane("pushed", kinetic, 0.0, 0.0, duration)
    pair = Pair("slab", "plane", kinetic_friction=kinetic, static_friction=static)
    return replace(level, pairs=(pair,), forces=(GrowingForce("slab", rate),))


def in_fine_steps(scenario: Scenario) -> tuple[np.ndarray, np.ndarray]:
    """Way and velocity along the push at the end, from the middles of twenty thousand steps."""
    (pair,), (force,) = scenario.pairs, scenario.forces
    rate, steps = float(np.linalg.norm(force.rate)), 20_000
    dt, speed, way = scenario.duration / steps, 0.0, 0.0
    for number in range(steps):
        push = rate * (number + 0.5) * dt
        gain = 0.0 if speed == 0 and push <= pair.static_friction * GRAVITY else push - pair.kinetic_friction * GRAVITY
        way += (speed + gain * dt / 2) * dt
        speed += gain * dt
    ahead = np.array(force.rate) / rate
    return way * ahead, speed * ahead


def test_exact_slabs_of_a_batch_break_away_each_at_its_own_instant():
    scenes = [pushed(0.35, 0.35, (11.0, 7.0, 0.0)), pushed(0.5, 0.2, (-9.0, 12.0, 0.0)), pushed(0.9, 0.9, (5.0, 0, 0))]
    engine = load_engine("handwritten")
    runs = engine.run_many(scenes, engine.settings(scenes[0], "exact"))
    for scene, run in zip(scenes, runs, strict=True):
        way, velocity = in_fine_steps(scene)
        start = np.array(scene.body("slab").position)
        # A fine step late, 22 µs, is 10⁻⁴ of a speed of 1 m/s and of a way of 0.2 m.
        np.testing.assert_allclose(run.position("slab")[-1] - start, way, atol=1e-4)
        np.testing.assert_allclose(run.velocity("slab")[-1], velocity, atol=1e-4)
    instants = [[(event.kind, event.time) for event in run.events] for run in runs]
    assert instants[0] == [("break-away", pytest.approx(0.35 * GRAVITY / math.hypot(11, 7), rel=1e-12))]
    assert instants[1] == [("break-away", pytest.approx(0.5 * GRAVITY / 15, rel=1e-12))]
    assert instants[2] == []


def test_the_instant_is_read_back_to_where_the_jump_of_friction_starts_the_slide():
    scenario = FAMILY.case("μs=0.5,μk=0.3,rate=30").scenarios[0]
    run = load_engine("handwritten").run(scenario, load_engine("handwritten").settings(scenario, "exact"))
    leaves = 0.5 * 1.5 * GRAVITY / 30
    assert FAMILY.quantity("break_away").measure(run) == pytest.approx(leaves, rel=1e-9)
    assert FAMILY.quantity("push").measure(run) == pytest.approx(0.5 * 1.5 * GRAVITY, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "profile"), [*((name, "tuned") for name in ("pybullet", "mujoco", "dart")), ("handwritten", "step")]
)
def test_every_sample_of_a_break_away_is_as_predicted(name, profile, installed):
    engine, scenario = installed(name), FAMILY.case(ASLANT).scenarios[0]
    settings = engine.settings(scenario, profile)
    found = sliding.predict(scenario, settings, engine.method(scenario, settings))
    off = found.trajectory.position("slab") - engine.run(scenario, settings).position("slab")
    assert np.max(np.linalg.norm(off, axis=1)) < found.near


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(case.name, marks=pytest.mark.slow if case.name == ASLANT else pytest.mark.weekly)
        for case in FAMILY.cases
    ],
)
def test_the_world_breaks_away_at_most_one_step_early(case):
    engine, scenario = load_engine("handwritten"), FAMILY.case(case).scenarios[0]
    settings = engine.settings(scenario, "world")
    found = sliding.predict(scenario, settings, engine.method(scenario, settings))
    off = found.trajectory.position("slab") - engine.run(scenario, settings).position("slab")
    assert np.max(np.linalg.norm(off, axis=1)) < found.near


LEVEL = pushed(0.4, 0.4, (10.0, 0.0, 0.0))
SLOPE = replace(slab_on_plane("slope", 0.4, 0.1, 0.0, 0.4), forces=LEVEL.forces)
OTHERS = {
    "on a slope": SLOPE,
    "in motion": replace(slab_on_plane("moves", 0.4, 0.0, 0.3, 0.4), forces=LEVEL.forces),
    "off the plane": pushed(0.4, 0.4, (10.0, 0.0, 2.0)),
    "to and fro": replace(LEVEL, forces=(OscillatingForce("slab", (5.0, 0.0, 0.0), 8.0),)),
    "with a steady push": replace(LEVEL, forces=(*LEVEL.forces, Force("slab", (0.0, 1.0, 0.0)))),
    "on a spring": replace(LEVEL, springs=(Spring("slab", "", 30.0, 0.1, point_b=(-1.0, 0.0, 0.02)),)),
}


@pytest.mark.parametrize("what", OTHERS)
def test_only_the_world_steps_what_is_pushed_otherwise(what):
    assert kind(LEVEL) is Kind.PUSHED
    assert kind(OTHERS[what]) is None
    assert list(load_engine("handwritten").profiles(OTHERS[what])) == ["world"]


def test_two_coefficients_under_a_growing_push_are_beyond_an_engine(installed):
    scenario = FAMILY.case("μs=0.5,μk=0.3,rate=30").scenarios[0]
    for name in ("pybullet", "mujoco", "dart"):
        with pytest.raises(CannotExpress, match="it has one coefficient of friction"):
            installed(name).run(scenario, installed(name).settings(scenario, "tuned"))
