"""The single movable body of each of N scenarios, which moves as a point does: its state and its events."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.handwritten.scenario_bodies import planes_met
from reference.engines.handwritten.stepping import start
from reference.engines.implementation import Implementation
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Event

Motion = Callable[..., tuple[Array, Array]]
"""Takes positions and velocities (N, 3), accelerations and durations; returns the positions and velocities after."""


class Points:
    """N bodies that do not turn. position, velocity: (N, 3), m and m/s."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        self.dt = settings.timestep
        self.function = functools.cache(implementation.function)  # looked up when a step first needs it
        self.bodies = [next(body for body in scenario.bodies if not body.immovable) for scenario in scenarios]
        self.position = np.array([body.position for body in self.bodies])
        self.velocity = np.array([body.velocity for body in self.bodies])
        self.mass = np.array([body.mass for body in self.bodies])
        self.whole_step = np.full(len(scenarios), self.dt)
        self.events: list[list[Event]] = [[] for _ in scenarios]
        self._start = start(scenarios)
        self._moving = [scenario.bodies.index(body) for scenario, body in zip(scenarios, self.bodies, strict=True)]

    def states(self) -> Array:
        """The 13 numbers of every body that a sample keeps, (N, bodies, 13)."""
        states, every = self._start.copy(), np.arange(len(self._moving))
        states[every, self._moving, :3], states[every, self._moving, 7:10] = self.position, self.velocity
        return states

    def report(self, mask: Mask, time: Array, kind: str) -> None:
        """Note an event at `time` (N,) for the members in the mask."""
        for member in np.flatnonzero(mask):
            self.events[member].append(Event(float(time[member]), kind, self.bodies[member].name))


class PointsAndPlanes(Points):
    """N bodies and the P planes that each of them may meet: normals (N, P, 3), offsets (N, P) and gravity (N, 3)."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        planes = [planes_met(scenario) for scenario in scenarios]
        self.normals = np.array([[plane.shape.normal for plane in each] for each in planes])  # type: ignore[union-attr]
        places = np.array([[plane.position for plane in each] for each in planes])
        self.offsets = -np.sum(self.normals * places, axis=-1)
        self.gravity = np.array([scenario.gravity for scenario in scenarios])
