"""Bodies that are moved by forces without contact: semi-implicit Euler, which all engines share."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.engines.base import BULLET_DAMPED, DART, Method
from reference.engines.pybullet_settings import STOCK_DAMPING
from reference.prediction import integrators, joints
from reference.prediction.bodies import darts_stretch, turn_by
from reference.prediction.forces import Forces
from reference.prediction.predicted import Path, Prediction, trajectory_of
from reference.scene import geometry
from reference.scene.scenario import Scenario, Sphere
from reference.scene.settings import Settings

BULLETS_DAMPING = float(np.float32(STOCK_DAMPING))
"""In the single precision in which Bullet keeps it, 1/s."""


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The ways of balls and point masses under the forces of the start of each step; None for boxes, which tumble.

    v⁺ = v + dt (g + F/m), x⁺ = x + dt v⁺, and the same for spins, ω⁺ = ω + dt τ/I; or another integrator, where the
    rule names one. A multibody of Bullet's also loses dt d (1 + v) v of its velocity, and as much of its spin:
    `btMultiBody::computeAccelerationsArticulatedBody…`.
    """
    if method.rule in joints.RULES:
        return joints.predict(scenario, settings, method)
    movable = [place for place, body in enumerate(scenario.bodies) if not body.immovable]
    bodies = [scenario.bodies[place] for place in movable]
    if scenario.pairs or not method.rule or not all(isinstance(body.shape, Sphere) for body in bodies):
        return None
    moments = np.array([body.moments_of_inertia() for body in bodies])
    if np.any(np.ptp(moments, axis=-1) > 0):
        return None
    if scenario.fluid and method.drag != 1 and any(any(body.angular_velocity) for body in bodies):
        return None  # a spin is slowed by another share
    dt, steps, forces = settings.timestep, settings.steps_for(scenario.duration), Forces(scenario, method.drag)
    mass, gravity = np.array([body.mass for body in bodies])[:, None], np.array(scenario.gravity)
    damping = BULLETS_DAMPING if method.rule == BULLET_DAMPED else 0.0
    state = np.array([body.state() for body in scenario.bodies])
    states = [state]
    advance = integrators.STEPS.get(method.rule, integrators.semi_implicit_euler)
    for number in range(steps):
        position, orientation, velocity, spin = state[:, :3], state[:, 3:7], state[:, 7:10], state[:, 10:].copy()
        torque = np.zeros(spin.shape)

        def pull(
            place: Array, moving: Array, time: float = number * dt, now: tuple[Array, ...] = (orientation, spin, torque)
        ) -> Array:
            turn, turning, twist = now
            force, twist[:] = forces.on_bodies(time, place, turn, moving, turning)
            own = moving[movable]
            found = np.zeros(place.shape)
            found[movable] = gravity + force[movable] / mass
            if damping:
                found[movable] -= _lost(damping, own)
            return found

        position, velocity = advance(pull, position, velocity, dt)
        if np.any(spin) or np.any(torque):
            spin[movable] += dt * (torque[movable] / moments - _lost(damping, spin[movable]))
        if np.any(spin):
            orientation = geometry.turned(orientation, turn_by(method.rule, dt * spin))
        state = np.concatenate([position, orientation, velocity, spin], axis=-1)
        states.append(state)
    ways = np.array(states)
    paths = {
        body.name: Path(ways[:, place, :3], ways[:, place, 7:10], ways[:, place, 10:], ways[:, place, 3:7])
        for place, body in zip(movable, bodies, strict=True)
    }
    trajectory = trajectory_of(scenario, settings, paths)
    return Prediction(trajectory, (darts_stretch(trajectory),) if method.rule == DART else ())


def _lost(damping: float, velocity: Array) -> Array:
    """What Bullet's damping takes in a second from velocities or spins, (bodies, 3)."""
    return np.asarray(damping * (1 + np.linalg.norm(velocity, axis=-1, keepdims=True)) * velocity)
