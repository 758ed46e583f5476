"""A slab on a spring that rubs on the floor: by hand and in the engines, against the recurrence and closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from reference import friction_truth
from reference.catalogue.scenarios import catalogue
from reference.catalogue.scenarios.friction import slab_on_plane
from reference.engines import load_engine
from reference.engines.handwritten.scenario_kind import Kind, kind
from reference.prediction import sliding
from reference.scene.forces import Force, Spring
from reference.scene.scenario import GRAVITY, Pair, Scenario

FAMILY = catalogue()["friction-oscillator"]


def on_a_spring(start: float, friction: float = 0.35, speed: float = 0.0, duration: float = 1.2, **spring) -> Scenario:
    """A slab of 1 kg on a spring along the x axis, `start` beyond its end at rest; speed along x."""
    level = slab_on_plane("swings", friction, 0.0, speed, duration)
    height = level.body("slab").position[2]
    anchor = {"point_b": (-0.5 - start, 0.0, height)} | spring
    return replace(level, springs=(Spring("slab", "", 150.0, 0.5, **anchor),))


def test_exact_slabs_of_a_batch_turn_and_stick_where_theory_has_it():
    starts = {(0.2, 0.35): 0.0, (-0.15, 0.3): 0.0, (0.05, 0.35): 1.1}
    scenes = [on_a_spring(start, friction, speed) for (start, friction), speed in starts.items()]
    engine = load_engine("handwritten")
    runs = engine.run_many(scenes, engine.settings(scenes[0], "exact"))
    for ((start, friction), speed), run in zip(starts.items(), runs, strict=True):
        times, places = friction_truth.turning_points(start, speed, np.sqrt(150.0), friction * GRAVITY / 150.0)
        course = run.position("slab")[:, 0] + start
        near = np.rint(times / run.settings.timestep).astype(int)
        # Half a step beside a turning point the slab is off by at most k x dt²/8.
        np.testing.assert_allclose(course[near], places, atol=150.0 * 0.2 * 1e-6 / 8 * 2)
        assert course[-1] == pytest.approx(places[-1], abs=1e-14)
        assert not np.any(run.velocity("slab")[-1])


@pytest.mark.parametrize(
    ("name", "profile"), [("pybullet", "tuned"), ("mujoco", "tuned"), ("dart", "tuned"), ("handwritten", "step")]
)
def test_every_sample_of_a_rubbing_swing_is_as_predicted(name, profile, installed):
    case = FAMILY.case("μ=0.4,k=240,x=0.05,v=0.9,φ=30°")
    engine, scenario = installed(name), replace(case.scenarios[0], duration=0.15 if name == "mujoco" else 0.4)
    settings = engine.settings(scenario, profile)
    found = sliding.predict(scenario, settings, engine.method(scenario, settings))
    off = found.trajectory.position("slab") - engine.run(scenario, settings).position("slab")
    assert np.max(np.linalg.norm(off, axis=1)) < found.near


SWINGS = on_a_spring(0.2)
OTHERS = {
    "a damper": on_a_spring(0.2, damping=1.0),
    "a point beside the centre": on_a_spring(0.2, point_a=(0.1, 0.0, 0.0)),
    "an anchor above": on_a_spring(0.2, point_b=(-0.6, 0.0, 0.3)),
    "a swing through the anchor": on_a_spring(0.2, speed=7.0),
    "a second spring": replace(SWINGS, springs=SWINGS.springs * 2),
    "a push": replace(SWINGS, forces=(Force("slab", (1.0, 0.0, 0.0)),)),
    "two coefficients": replace(SWINGS, pairs=(Pair("slab", "plane", kinetic_friction=0.3, static_friction=0.4),)),
}


@pytest.mark.parametrize("what", OTHERS)
def test_only_the_world_steps_what_swings_otherwise(what):
    assert kind(SWINGS) is Kind.SWINGING
    assert kind(OTHERS[what]) is None
