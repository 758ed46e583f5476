"""Bodies that steer themselves and meet nothing: semi-implicit Euler with the rule that steered them."""

from __future__ import annotations

import numpy as np

from reference.engines.base import BULLET_DAMPED, Method
from reference.engines.steering import steers_of
from reference.errors import CollisionsError, as_failed_run
from reference.prediction import bands
from reference.prediction.forces import Forces
from reference.prediction.loaded import BULLETS_DAMPING
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene.clearance import nearest
from reference.scene.forces import Force
from reference.scene.loads import Steers
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

LEAST_GAP = 1e-6
"""A recurrence without contacts holds as long as bodies that collide are farther apart than this, m."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The ways of bodies that the same code steers as in the run: v⁺ = v + dt (g + F/m), x⁺ = x + dt v⁺.

    A multibody of Bullet's is damped as well, as in `loaded`.

    None where bodies that collide touch, as there the recurrence knows no more; where something spins; where the
    code cannot be loaded here: a student's copy may judge a recording without the code that steered in it; and where
    the code fails here, as it may when bodies go through each other that stop each other in the run.
    """
    if not method.rule or not method.steered_by or any(any(body.angular_velocity) for body in scenario.bodies):
        return None
    try:
        with as_failed_run():
            damping = BULLETS_DAMPING if method.rule == BULLET_DAMPED else 0.0
            found = without_contacts(scenario, settings, steers_of(scenario, method.steered_by), damping)
    except CollisionsError:
        return None
    return None if _touch(found) else Prediction(found, (bands.STEERED,))


def without_contacts(scenario: Scenario, settings: Settings, steers: Steers | None, damping: float = 0.0) -> Trajectory:
    """How bodies move that are steered and go through each other."""
    return trajectory_of(scenario, settings, _paths(scenario, settings, steers, damping))


def _paths(scenario: Scenario, settings: Settings, steers: Steers | None, damping: float) -> dict[str, Path]:
    """The ways of all bodies that can be moved. As long as the accelerations stay as they are, many steps are one."""
    dt, steps, forces = settings.timestep, settings.steps_for(scenario.duration), Forces(scenario)
    others = scenario.springs or scenario.attractions or scenario.fluid
    steady = damping == 0 and not others and all(isinstance(push, Force) for push in scenario.forces)
    position, orientation, velocity, spin = np.split(
        np.array([body.state() for body in scenario.bodies]), (3, 7, 10), 1
    )
    inverse_mass = np.array([[body.inverse_mass] for body in scenario.bodies])
    weight = np.where(inverse_mass > 0, np.array(scenario.gravity), 0.0)
    positions, velocities, number = [position[None]], [velocity[None]], 0
    while number < steps:
        force, _ = forces.on_bodies(number * dt, position, orientation, velocity, spin)
        last = steps - number if steady else 1
        if steers:
            force = force + steers(number * dt, position, velocity)
            last = next((more for more in range(1, last) if not steers.waits((number + more) * dt)), last)
        lost = damping * (1 + np.linalg.norm(velocity, axis=-1, keepdims=True)) * velocity
        gained = np.arange(1, last + 1)[:, None, None] * dt * (weight + inverse_mass * force - lost)
        velocities.append(velocity + gained)
        positions.append(position + dt * np.cumsum(velocities[-1], axis=0))
        position, velocity, number = positions[-1][-1], velocities[-1][-1], number + last
    ways, speeds = np.concatenate(positions), np.concatenate(velocities)
    movable = ((place, body) for place, body in enumerate(scenario.bodies) if not body.immovable)
    return {body.name: Path(ways[:, place], speeds[:, place]) for place, body in movable}


def _touch(trajectory: Trajectory) -> bool:
    """Whether any two bodies that are listed as a pair come into contact."""
    if not trajectory.scenario.pairs:
        return False
    found = nearest(trajectory.scenario, trajectory.positions)
    return found is not None and found.gap < LEAST_GAP
