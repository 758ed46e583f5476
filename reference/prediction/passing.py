"""Balls without weight that fly straight at a fixed wall: which of them a test at each step notices, and turns back."""

from __future__ import annotations

import numpy as np

from reference.engines.base import TURN_BACK, Method
from reference.prediction import striking
from reference.prediction.predicted import ROUNDING, Path, Prediction, trajectory_of
from reference.scene import geometry
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """What the method makes of a ball that is shot at a wall.

    An engine looks for the nearest face of the wall, which behind the middle is the back one, as in `striking`. By hand
    a ball that overlaps the wall anywhere and approaches its front is turned back, and is not moved.
    """
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
    why = "the recurrence of the method, to rounding"
    return Prediction(trajectory_of(scenario, settings, {ball.name: Path(position, changed)}), ROUNDING, why)
