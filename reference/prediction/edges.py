"""Two boxes that meet edge on edge, without weight, spin and friction: in which step, and what the impact leaves."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from reference.engines.base import COMPLIANT, MUJOCO_ONE_STEP, Method
from reference.prediction import bands
from reference.prediction.edge_impact import meeting
from reference.prediction.impulses import LEAST_FRICTION
from reference.prediction.laws import law_of
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene import geometry
from reference.scene.scenario import Body, Scenario
from reference.scene.settings import Settings

LOOKS = 24
"""So often the boxes are looked at after their impact."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """What the method makes of the impact: its law along the normal, with the arms of the step that notices it.

    An impulse along the normal has the same effect wherever along the normal it acts, so that the overlap itself does
    not matter; but the boxes also pass each other until the overlap is noticed.
    """
    (pair,) = scenario.pairs
    met = meeting(scenario.body(pair.body_a), scenario.body(pair.body_b))
    dt, steps = settings.timestep, settings.steps_for(scenario.duration)
    noticed = math.ceil(met.time / dt)
    late = noticed * dt
    softness = met.softness(late)
    ease = softness / (met.body_a.inverse_mass + met.body_b.inverse_mass)
    law = law_of(settings, method, pair.restitution, ease)
    if law is None:
        return None
    if method.kind == COMPLIANT:
        return None  # the boxes turn while the contact lasts
    _, after = law.step(met.rate * (late - met.time), met.rate, 0.0)
    impulse = (after - met.rate) / softness
    count = np.arange(steps + 1)[:, None]
    before, since = np.minimum(count, noticed), np.maximum(count - noticed, 0)
    paths = {}
    for body, side, turn in zip((met.body_a, met.body_b), (1.0, -1.0), met.turns(late), strict=True):
        first, spin = np.array(body.velocity), side * impulse * turn
        last = first + side * impulse * body.inverse_mass * met.normal
        velocity = np.where(count > noticed, last, first)
        position = np.array(body.position) + dt * (before * first + since * last)
        paths[body.name] = Path(position, velocity, np.where(count > noticed, spin, 0.0))
    if _meet_again((met.body_a, met.body_b), paths, dt, noticed):
        return None
    found = trajectory_of(scenario, settings, paths)
    if method.rule == MUJOCO_ONE_STEP:
        friction = bands.Term("the least friction that MuJoCo has", LEAST_FRICTION)
        return Prediction(found, (bands.contact(dt), friction))
    return Prediction(found, (bands.contact(dt),))


def _meet_again(bodies: Sequence[Body], paths: Mapping[str, Path], dt: float, noticed: int) -> bool:
    """Whether boxes come nearer again that the impact has made spin, if they go on spinning so."""
    steps, gaps = len(paths[bodies[0].name].position) - 1, []
    for step in np.unique(np.linspace(noticed, steps, LOOKS).astype(int)).tolist():
        then = []
        for body in bodies:
            path = paths[body.name]
            assert path.spin is not None
            turn = geometry.turned(np.array(body.orientation), (step - noticed) * dt * path.spin[-1])
            place, orientation = path.position[step].tolist(), tuple(turn.tolist())
            then.append(replace(body, position=tuple(place), orientation=orientation))
        gaps.append(geometry.gap(*then))
    return bool(np.any(np.diff(gaps) < 0))
