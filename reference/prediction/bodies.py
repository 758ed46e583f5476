"""Rigid bodies between two contacts: what they are, their state, and their flight in steps."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np

from reference.arrays import Array
from reference.engines.base import BULLET, BULLET_DAMPED, BULLET_SPRING, DART
from reference.prediction import bands
from reference.scene import geometry
from reference.scene.scenario import Scenario
from reference.scene.trajectory import Trajectory

SMALL_TURN = 1e-3
"""A turn below this angle, rad, DART makes with the matrix I + [φ] + [φ]²/2, which turns by arcsin |φ|."""


LARGE_TURN = np.pi / 4
"""A turn above this angle, rad, is too small in Bullet (`btTransformUtil::integrateTransform`)."""


class State(NamedTuple):
    """All bodies at one instant, or after each of some steps: (..., bodies, 3 or 4), SI, in the world frame."""

    position: Array
    orientation: Array
    velocity: Array
    spin: Array


def turn_by(rule: str, turn: Array) -> Array:
    """How far a method turns bodies that are to turn by vectors (..., 3), rad: by so much, but in two engines.

    DART turns by arcsin φ where the angle φ is small. Bullet makes a quaternion from the turn v with the sine and the
    cosine of half the angle, both of LARGE_TURN if φ is larger. But the sine multiplies v, which is longer than that.
    """
    angle = np.linalg.norm(turn, axis=-1, keepdims=True)
    if rule == DART:
        differs = (angle > 0) & (angle < SMALL_TURN)
        made = np.arcsin(np.where(differs, angle, 0.0))
    elif rule in (BULLET, BULLET_DAMPED, BULLET_SPRING):
        differs = angle > LARGE_TURN
        made = 2 * np.arctan(angle / LARGE_TURN * np.tan(LARGE_TURN / 2))
    else:
        return turn
    return np.asarray(np.where(differs, made / np.where(differs, angle, 1.0), 1.0) * turn)


def darts_stretch(trajectory: Trajectory) -> bands.Term:
    """The term of all turns of a run that are small enough for that matrix."""
    turns = np.linalg.norm(trajectory.angular_velocities, axis=-1) * trajectory.settings.timestep
    steps = trajectory.settings.steps_for(trajectory.scenario.duration)
    return bands.darts_matrix(float(np.max(turns, where=turns < SMALL_TURN, initial=0.0)), steps)


class Bodies:
    """The bodies of a scenario: their shapes, and what an impulse does to each. rule: of the method that turns them."""

    def __init__(self, scenario: Scenario, rule: str = "") -> None:
        self.scenario, self.turned_by = scenario, partial(turn_by, rule)
        self.shapes = [body.shape for body in scenario.bodies]
        self.inverse_mass = np.array([body.inverse_mass for body in scenario.bodies])
        self.inverse_moments = np.array(
            [np.zeros(3) if body.immovable else 1 / np.array(body.moments_of_inertia()) for body in scenario.bodies]
        )
        self.weight = np.where(self.inverse_mass[:, None] > 0, np.array(scenario.gravity), 0.0)
        """Acceleration of each, (bodies, 3), m/s²."""

    def start(self) -> State:
        """The bodies as the scenario has them at time 0."""
        states = np.array([body.state() for body in self.scenario.bodies])
        return State(*np.split(states, (3, 7, 10), axis=-1))

    def inverse_inertia(self, state: State, place: int) -> Array:
        """Of one body, about the world's axes, (3, 3), 1/(kg m²)."""
        moments = self.inverse_moments[place]
        if moments[0] == moments[1] == moments[2]:
            return np.diag(moments)
        axes = matrix(state.orientation[place])
        return np.asarray(axes * moments @ axes.T)

    def spins_steadily(self, state: State) -> bool:
        """Whether every spin is about a principal axis, so that nothing but a contact changes it."""
        for place, spin in enumerate(state.spin):
            if spin.any() and len(set(self.inverse_moments[place])) > 1:
                own = spin @ matrix(state.orientation[place])
                if np.linalg.norm(np.cross(own, own / self.inverse_moments[place])) > 1e-9 * (own @ own):
                    return False
        return True

    def flight(self, state: State, dt: float, in_parabolas: bool, steps: int) -> State:
        """The states after each of so many steps without contact, (steps, bodies, 3 or 4)."""
        count = np.arange(1, steps + 1)[:, None, None]
        weight = count**2 / 2 if in_parabolas else count * (count + 1) / 2
        position = state.position + dt * (count * state.velocity + dt * weight * self.weight)
        orientation = np.tile(state.orientation, (steps, 1, 1))
        turns = self.turned_by(dt * state.spin)
        for place in np.flatnonzero(state.spin.any(axis=1)):
            orientation[:, place] = geometry.turned(state.orientation[place], count[:, 0] * turns[place])
        velocity = state.velocity + count * dt * self.weight
        return State(position, orientation, velocity, np.broadcast_to(state.spin, (steps, *state.spin.shape)))


def matrix(orientation: Array) -> Array:
    """The rotation, body to world, as a matrix (3, 3)."""
    w, x, y, z = orientation.tolist()
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
