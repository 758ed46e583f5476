"""Balls without weight that fly straight at a fixed wall: which of them a test at each step notices, and turns back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.engines.base import BULLET, TURN_BACK, Method
from reference.engines.mujoco_read_back import margin_of
from reference.engines.pybullet_settings import SWEEP_TOLERANCE
from reference.prediction import bands, striking
from reference.prediction.laws import Bullet
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene import geometry
from reference.scene.scenario import Scenario, Sphere
from reference.scene.settings import Settings


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """What the method makes of a ball that is shot at a wall.

    An engine looks for the nearest face of the wall, which behind the middle is the back one, as in `striking`. By hand
    a ball that overlaps the wall anywhere and approaches its front is turned back, and is not moved.
    """
    if method.rule == BULLET and "swept_inset" in settings.options:
        return _swept_by_bullet(scenario, settings, method)
    if "margin_steps" in settings.options:
        settings = _with_its_margin(scenario, settings)
    if method.rule != TURN_BACK:
        return striking.predict(scenario, settings, method)
    ball = next(body for body in scenario.bodies if not body.immovable)
    wall = next(body for body in scenario.bodies if body.immovable)
    start, velocity = np.array(ball.position), np.array(ball.velocity)
    speed = float(np.linalg.norm(velocity))
    steps = np.arange(settings.steps_for(scenario.duration) + 1)
    # How far the centre has to fly to the middle of the wall, and how far before and behind that it touches a face.
    way = float((np.array(wall.position) - start) @ velocity) / speed
    reach = way - geometry.gap(wall, ball)
    places = speed * settings.timestep * steps - way
    noticed = np.flatnonzero(np.abs(places) <= reach)
    turned = int(noticed[0]) if len(noticed) else len(steps)
    forward, back = np.minimum(steps, turned), np.maximum(steps - turned, 0)
    restitution = scenario.pairs[0].restitution
    position = start + (forward - restitution * back)[:, None] * settings.timestep * velocity
    changed = np.where(steps > turned, -restitution, 1.0)[:, None] * velocity
    path = Path(position, changed)
    return Prediction(trajectory_of(scenario, settings, {ball.name: path}), (bands.contact(settings.timestep),))


def _with_its_margin(scenario: Scenario, settings: Settings) -> Settings:
    """MuJoCo's settings with the margin in metres."""
    options = {name: value for name, value in settings.options.items() if name != "margin_steps"}
    return replace(settings, options=options | {"margin": margin_of(scenario, settings)})


def _swept_by_bullet(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """Bullet's continuous detection: a ball stops where its step meets the wall, and keeps its velocity until the next.

    btDiscreteDynamicsWorld::integrateTransformsInternal sweeps a ball that is smaller by `swept_inset` along the step,
    if the step is longer than half its radius and goes farther than `sweep_from` along the normal. Where this ball
    meets the wall the step ends, and the rest of its time is lost. The next step finds the overlap of the body itself,
    and responds to that as to any other. A sweep that starts within its tolerance of the wall touches it at once: then
    createPredictiveContacts makes a contact without restitution, which ends the approach, even in the air.

    None where a ball that is not swept gets past the middle.
    """
    ball = next(body for body in scenario.bodies if not body.immovable)
    wall = next(body for body in scenario.bodies if body.immovable)
    assert isinstance(ball.shape, Sphere)
    start, velocity, dt = np.array(ball.position), np.array(ball.velocity), settings.timestep
    speed, radius = float(np.linalg.norm(velocity)), ball.shape.radius
    ahead = velocity / speed
    first = geometry.gap(wall, ball)
    deepest = float((np.array(wall.position) - start) @ ahead) - first
    inset = settings.number("swept_inset")
    least = max((radius - inset) / 2, settings.number("sweep_from"))
    law = Bullet(dt, scenario.pairs[0].restitution, method.rest_speed, method.recovery, method.reach)
    gap, rate, places, rates = first, -speed, [first], [-speed]
    for _ in range(settings.steps_for(scenario.duration)):
        rate, push = law.contact(gap, rate, 0.0)
        is_swept = -rate * dt > least and inset < radius
        if is_swept and gap + inset <= SWEEP_TOLERANCE:
            rate = 0.0
        after = gap + rate * dt + push
        gap = -inset if is_swept and after < -inset < gap else after
        if -gap > deepest:
            return None
        places.append(gap)
        rates.append(rate)
    position = start + (first - np.array(places))[:, None] * ahead
    path = Path(position, -np.array(rates)[:, None] * ahead)
    return Prediction(trajectory_of(scenario, settings, {ball.name: path}), (bands.contact(dt),))
