"""The forces of scenarios on the bodies of the hand-written world: every formula is the implementation's own."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache, cached_property

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.engines.steering import steers_of
from reference.scene import geometry
from reference.scene.scenario import Scenario, Sphere

GRAVITATIONAL_CONSTANT = 6.67430e-11
"""G of CODATA 2018, N m²/kg²: with this one `universal_gravity` works."""
_WORLD = np.zeros((1, 3)), np.array([[1.0, 0.0, 0.0, 0.0]]), np.zeros((1, 3)), np.zeros((1, 3))
"""Position, orientation, velocity and spin of the world, to which springs are tied: a body at rest in the origin."""


class LoadsByHand:
    """What pushes, springs, attractions and fluids do to the bodies of many scenarios, side by side."""

    def __init__(self, scenarios: Sequence[Scenario], implementation: Implementation) -> None:
        self.count = sum(len(scenario.bodies) for scenario in scenarios)
        self._function = cache(implementation.function)
        self._pushes, self._springs, self._attractions, self._balls, self._steered = [], [], [], [], []
        first = 0
        for scenario in scenarios:
            places = {body.name: first + place for place, body in enumerate(scenario.bodies)}
            self._pushes += [(places[push.body], push) for push in scenario.forces]
            places[""] = self.count  # the world, a body at rest in the origin
            self._springs += [(places[each.body_a], places[each.body_b], each) for each in scenario.springs]
            self._attractions += [
                (places[each.body_a], places[each.body_b], scenario.body(each.body_a), scenario.body(each.body_b), each)
                for each in scenario.attractions
            ]
            if scenario.fluid:
                self._balls += [
                    (places[body.name], body.shape.radius, scenario.fluid, scenario.gravity)
                    for body in scenario.bodies
                    if isinstance(body.shape, Sphere) and not body.immovable
                ]
            if steers := steers_of(scenario, implementation):
                self._steered.append((slice(first, first + len(scenario.bodies)), steers))
            first += len(scenario.bodies)
        self._steady = all(not scenario.pushes_change for scenario in scenarios)
        self._found: tuple[Array, Array] | None = None

    def on_bodies(self, time: float, state: Sequence[Array]) -> tuple[Array, Array]:
        """Force, N, and torque about the centre, N m, on each body, (bodies, 3), in the world frame.

        state: position, orientation, velocity and angular velocity of all bodies.
        """
        if self._steady and self._found:
            return self._found
        force, torque = np.zeros((self.count + 1, 3)), np.zeros((self.count + 1, 3))
        for place, push in self._pushes:
            force[place] += push.at(time)
        if self._springs:
            self._stretch(force, torque, state)
        if self._attractions:
            self._attract(force, state[0])
        if self._balls:
            self._immerse(force, torque, state)
        for own, steers in self._steered:
            force[own] += steers(time, state[0][own], state[2][own])
        self._found = force[:-1], torque[:-1]
        return self._found

    @cached_property
    def _stretched(self) -> tuple[list[list[int]], list[Array], list[Array]]:
        """Places and points of the two ends of all springs; their stiffness, rest length and damping."""
        first, second, springs = (list(each) for each in zip(*self._springs, strict=True))
        points = [np.array([getattr(each, name) for each in springs]) for name in ("point_a", "point_b")]
        numbers = [
            np.array([getattr(each, name) for each in springs]) for name in ("stiffness", "rest_length", "damping")
        ]
        return [first, second], points, numbers

    def _stretch(self, force: Array, torque: Array, state: Sequence[Array]) -> None:
        position, orientation, velocity, spin = (
            np.concatenate([each, own]) for each, own in zip(state, _WORLD, strict=True)
        )
        (first, second), points, numbers = self._stretched
        moving = self._function("point_velocity")
        arms = [geometry.rotate(orientation[end], own) for end, own in zip((first, second), points, strict=True)]
        pull = self._function("spring_damper_force")(
            position[first] + arms[0],
            position[second] + arms[1],
            moving(velocity[first], spin[first], arms[0]),
            moving(velocity[second], spin[second], arms[1]),
            *numbers,
        )
        for end, arm, own in ((first, arms[0], pull), (second, arms[1], -pull)):
            np.add.at(force, end, own)
            np.add.at(torque, end, geometry.cross(arm, own))

    @cached_property
    def _attracted(self) -> tuple[list[int], list[int], list[Array]]:
        """Places and masses of the bodies that attract each other.

        As if both masses were larger, so that the real G between them has the effect of the scenario's constant.
        """
        first, second, bodies_a, bodies_b, each = (list(column) for column in zip(*self._attractions, strict=True))
        larger = np.sqrt(np.array([one.constant for one in each]) / GRAVITATIONAL_CONSTANT)
        masses = [larger * np.array([body.mass for body in bodies]) for bodies in (bodies_a, bodies_b)]
        return first, second, masses

    def _attract(self, force: Array, position: Array) -> None:
        first, second, masses = self._attracted
        pull = self._function("universal_gravity")(*masses, position[first], position[second])
        np.add.at(force, first, pull)
        np.add.at(force, second, -pull)

    @cached_property
    def _immersed(self) -> tuple[list[int], tuple[Array, ...]]:
        """Places of the balls in a fluid; and radius, density, viscosity and velocity of the fluid, and gravity."""
        places, radii, fluids, gravity = (list(column) for column in zip(*self._balls, strict=True))
        density, viscosity, stream = (
            np.array([getattr(fluid, name) for fluid in fluids]) for name in ("density", "viscosity", "velocity")
        )
        return places, (np.array(radii), density, viscosity, stream, np.array(gravity))

    def _immerse(self, force: Array, torque: Array, state: Sequence[Array]) -> None:
        places, (radius, density, viscosity, stream, gravity) = self._immersed
        force[places] += self._function("stokes_drag")(state[2][places], stream, viscosity, radius)
        force[places] += self._function("buoyancy")(4 / 3 * math.pi * radius**3, density, gravity)
        # The lecture has no drag on a spin; Stokes' law for it, −8πηr³ ω.
        torque[places] -= (8 * math.pi * viscosity * radius**3)[:, None] * state[3][places]
