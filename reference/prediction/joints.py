"""A ball on the spring of a sliding joint, in MuJoCo and in DART."""

from __future__ import annotations

import numpy as np

from reference.engines.base import DART_JOINT, MUJOCO_JOINT, Method
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.straight_spring import on_one_spring

RULES = MUJOCO_JOINT, DART_JOINT


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The way of the ball along its spring; None if it is not all that there is.

    Both compute the new velocity from forces of the end of the step, as far as they are linear in it. With a length s,
    its rate v, and k and c of the spring: MuJoCo's `Euler` takes the damper so, `(m + c dt) v⁺ = m v + dt (m g −
    k (s − s_0))`. DART takes the spring so as well, at `s + v⁺ dt`, which adds k dt² to the bracket. That is backward
    Euler. Then `s⁺ = s + v⁺ dt`.
    """
    if on_one_spring(scenario) is None:
        return None
    (body,), (spring,), dt = scenario.bodies, scenario.springs, settings.timestep
    held = np.array(spring.point_a if spring.body_b else spring.point_b)
    line = np.array(body.position) - held
    length = float(np.sqrt(line @ line))
    way = line / length
    stiffness, damping = spring.stiffness / body.mass, spring.damping / body.mass
    weight = float(np.array(scenario.gravity) @ way)
    slowed = 1 + damping * dt + (stiffness * dt**2 if method.rule == DART_JOINT else 0.0)
    rate = float(np.array(body.velocity) @ way)
    found = [(length, rate)]
    for _ in range(settings.steps_for(scenario.duration)):
        rate = (rate + dt * (weight - stiffness * (length - spring.rest_length))) / slowed
        length += dt * rate
        found.append((length, rate))
    lengths, rates = np.array(found).T[..., None]
    path = Path(held + lengths * way, rates * way)
    return Prediction(trajectory_of(scenario, settings, {body.name: path}))
