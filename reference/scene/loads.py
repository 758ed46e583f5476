"""The sum of a scenario's forces on each body, for predictions and for engines that get forces step by step.

Arrays have bodies along their last axis but one, in the scenario's order, and any axes before.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from reference.arrays import Array, Integers
from reference.errors import InvalidInput
from reference.scene import geometry
from reference.scene.forces import NOWHERE, Force
from reference.scene.scenario import Scenario, Sphere


class Steers(Protocol):
    """What steering rules ask for."""

    def __call__(self, time: float, position: Array, velocity: Array, /) -> Array:
        """The force with which each body steers itself at a time, s, (bodies, 3), N."""

    def waits(self, time: float) -> bool:
        """Whether all forces are at this time what they were when they were last asked for."""


class Loads:
    """Pushes, springs, attractions, fluid and steering of one scenario.

    only_pushes: leave springs, attractions and fluid out, for an engine that has them itself. steers:
    what the scenario's steering rules ask for. Its code is an implementation's, which this folder does not know, and it
    remembers what it was told, so that each run needs its own.
    """

    def __init__(self, scenario: Scenario, only_pushes: bool = False, steers: Steers | None = None) -> None:
        if scenario.steering and steers is None:
            raise InvalidInput(f"{scenario.name}: its bodies are steered, and nothing here says how")
        self.scenario, self._steers = scenario, steers
        self._pushed = [scenario.index(push.body) for push in scenario.forces]
        self._springs = None if only_pushes or not scenario.springs else _Springs(scenario)
        self._attractions = None if only_pushes or not scenario.attractions else _Attractions(scenario)
        self._found: tuple[Array, Array] | None = None
        others = bool(scenario.springs or scenario.attractions or scenario.fluid)
        self._held = bool(steers) and not others and all(isinstance(push, Force) for push in scenario.forces)
        self._fluid = None if only_pushes or not scenario.fluid else _Immersed(scenario)

    def kept(self, time: float) -> tuple[Array, Array] | None:
        """What `on_bodies` gave last, where it would give the same at this time, however the bodies move."""
        return self._found if self._held and self._steers and self._steers.waits(time) else None

    def on_bodies(
        self, time: float, position: Array, orientation: Array, velocity: Array, spin: Array
    ) -> tuple[Array, Array]:
        """Force, N, and torque about the centre, N m, on each body, (…, bodies, 3), in the world frame.

        position: (…, bodies, 3), m. orientation: (…, bodies, 4), w x y z. velocity: m/s. spin: rad/s, world frame.
        """
        force, torque = np.zeros(position.shape), np.zeros(position.shape)
        for place, push in zip(self._pushed, self.scenario.forces, strict=True):
            force[..., place, :] += push.at(time)
        if self._springs:
            self._springs.act(force, torque, position, orientation, velocity, spin)
        if self._attractions:
            self._attractions.act(force, position)
        if self._fluid:
            self._fluid.act(force, torque, velocity, spin)
        if self._steers:
            force += self._steers(time, position, velocity)
        self._found = force, torque
        return self._found


class _Springs:
    """All springs side by side. The world is one more body, at rest in the origin."""

    def __init__(self, scenario: Scenario) -> None:
        springs, world = scenario.springs, len(scenario.bodies)
        self.ends = [
            np.array([scenario.index(name) if name else world for name in names])
            for names in ([each.body_a for each in springs], [each.body_b for each in springs])
        ]
        self.on_bodies = [np.flatnonzero(end < world) for end in self.ends]
        """Places of the springs of which this end is on a body."""
        self.points = np.array([each.point_a for each in springs]), np.array([each.point_b for each in springs])
        self.stiffness = np.array([each.stiffness for each in springs])
        self.rest_length = np.array([each.rest_length for each in springs])
        self.damping = np.array([each.damping for each in springs])
        self._off_centre = any(
            any(point)
            for each in springs
            for name, point in ((each.body_a, each.point_a), (each.body_b, each.point_b))
            if name
        )
        """Whether any spring turns a body; in meshes of point masses none does, and much less is to be computed."""

    def act(
        self, force: Array, torque: Array, position: Array, orientation: Array, velocity: Array, spin: Array
    ) -> None:
        """Add what each spring does at its two ends."""
        at, moves = _with_world(position, NOWHERE), _with_world(velocity, NOWHERE)
        places = [at[..., end, :] + point for end, point in zip(self.ends, self.points, strict=True)]
        speeds, arms = [moves[..., end, :] for end in self.ends], list[Array]()
        if self._off_centre:
            turn, turns = _with_world(orientation, (1.0, 0.0, 0.0, 0.0)), _with_world(spin, NOWHERE)
            for number, (end, point) in enumerate(zip(self.ends, self.points, strict=True)):
                arms.append(geometry.rotate(turn[..., end, :], np.broadcast_to(point, places[number].shape)))
                places[number] = at[..., end, :] + arms[-1]
                speeds[number] = speeds[number] + geometry.cross(turns[..., end, :], arms[-1])
        along = places[0] - places[1]
        length = np.linalg.norm(along, axis=-1)
        direction = along / np.where(length > 0, length, 1.0)[..., None]
        rate = np.sum((speeds[0] - speeds[1]) * direction, axis=-1)
        pull = -self.stiffness * (length - self.rest_length) - self.damping * rate
        on_first = pull[..., None] * direction
        for number, (end, own) in enumerate(zip(self.ends, (on_first, -on_first), strict=True)):
            there = self.on_bodies[number]
            _add(force, end[there], own[..., there, :])
            if arms:
                _add(torque, end[there], geometry.cross(arms[number], own)[..., there, :])


class _Attractions:
    def __init__(self, scenario: Scenario) -> None:
        self.first = np.array([scenario.index(each.body_a) for each in scenario.attractions])
        self.second = np.array([scenario.index(each.body_b) for each in scenario.attractions])
        mass = np.array([body.mass for body in scenario.bodies])
        constants = np.array([each.constant for each in scenario.attractions])
        self.strength = constants * mass[self.first] * mass[self.second]

    def act(self, force: Array, position: Array) -> None:
        """Add the pull of each two bodies on each other."""
        towards = position[..., self.second, :] - position[..., self.first, :]
        distance = np.linalg.norm(towards, axis=-1)
        pull = (self.strength / distance**3)[..., None] * towards
        _add(force, self.first, pull)
        _add(force, self.second, -pull)


class _Immersed:
    """Stokes' law for balls, and Archimedes'."""

    def __init__(self, scenario: Scenario) -> None:
        fluid = scenario.fluid
        assert fluid
        radius = np.array(
            [
                body.shape.radius if isinstance(body.shape, Sphere) and not body.immovable else 0.0
                for body in scenario.bodies
            ]
        )[:, None]
        self.velocity = np.array(fluid.velocity)
        self.lift = -fluid.density * (4 / 3 * math.pi * radius**3) * np.array(scenario.gravity)
        self.drag = 6 * math.pi * fluid.viscosity * radius
        self.spin_drag = 8 * math.pi * fluid.viscosity * radius**3

    def act(self, force: Array, torque: Array, velocity: Array, spin: Array) -> None:
        """Add lift and drag of each ball."""
        force += self.lift - self.drag * (velocity - self.velocity)
        torque -= self.spin_drag * spin


def _add(total: Array, places: Integers, values: Array) -> None:
    """Add vectors (…, n, 3) to those at these places (n,), which may come several times."""
    if len(places) == 1:
        total[..., places[0], :] += values[..., 0, :]
    elif total.ndim == 2:
        np.add.at(total, places, values)
    else:
        np.add.at(np.moveaxis(total, -2, 0), places, np.moveaxis(values, -2, 0))


def _with_world(values: Array, own: tuple[float, ...]) -> Array:
    found = np.empty((*values.shape[:-2], values.shape[-2] + 1, values.shape[-1]))
    found[..., :-1, :], found[..., -1, :] = values, own
    return found
