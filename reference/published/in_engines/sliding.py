"""Published cases of friction in the engines: boxes that slide to a stop, or rest on a slope; a box in free flight."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from reference import truth
from reference.catalogue import measure
from reference.catalogue.scenarios.friction import slab_on_plane
from reference.engines.base import Engine
from reference.published.answers import Answer, Answers
from reference.published.case import Published
from reference.published.in_engines.scenes import gravity_of, with_gravity_of
from reference.scene.scenario import Body, Box, Scenario

WATCHED = 0.5
"""How long a box that has stopped is watched, s."""
RESTS = 1e-3
"""A box that creeps less than this in `LET_GO` rests, m."""
LET_GO = 0.2
"""How long a box on a slope is watched, s: the slowest of those that slide, 20° at μ = 0.3, goes 12 mm."""
BENCHMARK_BOX = Body("box", Box((0.2, 0.3, 0.5)), 1.0, angular_velocity=(0.1, 5.0, 0.1))
"""The box of P14, as it turns in the benchmark; no torque acts on it, and its centre flies like a point."""


def stopping_box(case: Published, engine: Engine) -> Answers:
    """P7, P8: how far a cube slides until it stops, for one coefficient or several."""
    half = case.value("half_edge") if "half_edge" in case.setup else case.value("edge") / 2
    speed, found = case.value("speed"), []
    for friction in case.numbers("friction"):
        duration = truth.stopping_time(speed, friction, gravity_of(case)) + WATCHED
        scenario = with_gravity_of(
            case, slab_on_plane(case.name, friction, 0.0, speed, duration, 0.0, (half, half, half))
        )
        settings = engine.settings(scenario, "tuned")
        if "timestep" in case.setup:
            settings = settings.change(timestep=case.value("timestep"))
        found.append(measure.stopping_distance(engine.run(scenario, settings), "slab", "plane"))
    return {"distance": Answer(tuple(found) if len(found) > 1 else found[0])}


def ramp(case: Published, engine: Engine) -> Answers:
    """P10: 1 for each pair of coefficient and slope at which a slab rests, 0 where it slides."""
    rests = []
    for friction in case.numbers("friction"):
        for slope in case.numbers("slope"):
            scenario = with_gravity_of(case, slab_on_plane(case.name, friction, math.radians(slope), 0.0, LET_GO))
            settings = engine.settings(scenario, "tuned")
            trajectory = engine.run(scenario, replace(settings, sample_every=round(LET_GO / 2 / settings.timestep)))
            rests.append(float(measure.displacement(trajectory, "slab") < RESTS))
    return {"rests": Answer(tuple(rests))}


def free_flight(case: Published, engine: Engine) -> Answers:
    """P14: distance from the exact flight at the end."""
    velocity, gravity = np.array(case.numbers("velocity")), np.array(case.numbers("gravity"))
    box = replace(BENCHMARK_BOX, velocity=tuple(velocity))
    scenario = Scenario(case.name, (box,), (), case.value("duration"), tuple(gravity))
    settings = engine.settings(scenario, "tuned").change(timestep=case.value("timestep"))
    trajectory = engine.run(scenario, replace(settings, sample_every=100))
    duration = float(trajectory.times[-1])
    exact = velocity * duration + gravity * duration**2 / 2
    return {"position_error": Answer(float(np.linalg.norm(trajectory.position("box")[-1] - exact)))}
