"""The forces of a scenario, stated a second time, so that a recurrence shares no number with what engines are told.

Engines get the sums of `reference.scene.loads`. If a recurrence got these sums too, it would follow a drag that is too
large there, and so would every engine.
"""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.prediction.bodies import matrix
from reference.scene.forces import Fluid, Force, GrowingForce, Push
from reference.scene.scenario import Scenario, Sphere


def pushed(push: Push, time: float) -> Array:
    """A push at a time, (3,), N."""
    if isinstance(push, Force):
        return np.array(push.force)
    if isinstance(push, GrowingForce):
        return time * np.array(push.rate)
    return math.cos(push.angular_frequency * time + push.phase) * np.array(push.amplitude)


class Forces:
    """All forces of a scenario besides weight, contact and steering.

    drag: of balls in the fluid, as a share of Stokes' drag.
    """

    def __init__(self, scenario: Scenario, drag: float = 1.0) -> None:
        self.pushes = [(scenario.index(push.body), push) for push in scenario.forces]
        self.pulls = [
            (scenario.index(each.body_a), scenario.index(each.body_b), _strength(scenario, each.constant, *names))
            for each in scenario.attractions
            for names in [(each.body_a, each.body_b)]
        ]
        self.fluid = _Stokes(scenario, scenario.fluid, drag) if scenario.fluid else None
        self.springs = _Incidence(scenario) if scenario.springs else None

    def on_bodies(
        self, time: float, position: Array, orientation: Array, velocity: Array, spin: Array
    ) -> tuple[Array, Array]:
        """Force, N, and torque about the centre, N m, on each body, (bodies, 3), from the state of all of them."""
        force, torque = np.zeros(position.shape), np.zeros(position.shape)
        for place, push in self.pushes:
            force[place] += pushed(push, time)
        for a, b, strength in self.pulls:
            way = position[b] - position[a]
            pull = strength * way / float(way @ way) ** 1.5
            force[a] += pull
            force[b] -= pull
        if self.fluid:
            force += self.fluid.force(velocity)
            torque += self.fluid.torque(spin)
        if self.springs:
            self.springs.add(force, torque, position, orientation, velocity, spin)
        return force, torque


def _strength(scenario: Scenario, constant: float, *names: str) -> float:
    return constant * math.prod(scenario.body(name).mass for name in names)


class _Stokes:
    """6πηr (u − v) and −8πηr³ ω on each ball that can move, and the weight of the fluid in its place, upwards."""

    def __init__(self, scenario: Scenario, fluid: Fluid, drag: float) -> None:
        movable = [isinstance(body.shape, Sphere) and not body.immovable for body in scenario.bodies]
        radii = [getattr(body.shape, "radius", 0.0) for body in scenario.bodies]
        self.radius = np.where(movable, radii, 0.0)[:, None]
        self.six_eta = 6 * math.pi * fluid.viscosity * drag
        self.stream = np.array(fluid.velocity)
        self.lift = 4 / 3 * math.pi * self.radius**3 * fluid.density * -np.array(scenario.gravity)

    def force(self, velocity: Array) -> Array:
        return np.asarray(self.six_eta * self.radius * (self.stream - velocity) + self.lift)

    def torque(self, spin: Array) -> Array:
        return np.asarray(-4 / 3 * self.six_eta * self.radius**3 * spin)


class _Incidence:
    """All springs by one matrix: a row has 1 at its first body and −1 at its second, so that it makes differences.

    Its transpose hands each spring's force to its two bodies.
    """

    def __init__(self, scenario: Scenario) -> None:
        springs = scenario.springs
        self.matrix = np.zeros((len(springs), len(scenario.bodies)))
        self.in_the_world = np.zeros((len(springs), 3))
        self.arms = list[tuple[int, int, float, Array]]()
        """Of the ends beside a centre: the spring, the body, ±1, and the place in the body's own axes, m."""
        for row, spring in enumerate(springs):
            ends = (spring.body_a, spring.point_a, 1.0), (spring.body_b, spring.point_b, -1.0)
            for name, point, sign in ends:
                if not name:
                    self.in_the_world[row] += sign * np.array(point)
                    continue
                self.matrix[row, scenario.index(name)] = sign
                if any(point):
                    self.arms.append((row, scenario.index(name), sign, np.array(point)))
        self.stiffness, self.rest, self.damping = np.array(
            [(each.stiffness, each.rest_length, each.damping) for each in springs]
        ).T

    def add(
        self, force: Array, torque: Array, position: Array, orientation: Array, velocity: Array, spin: Array
    ) -> None:
        """Add −k (L − L₀) − c dL/dt along each spring, at both of its ends."""
        between, moving = self.matrix @ position + self.in_the_world, self.matrix @ velocity
        turned = [matrix(orientation[place]) @ point for _, place, _, point in self.arms]
        for (row, place, sign, _), arm in zip(self.arms, turned, strict=True):
            between[row] += sign * arm
            moving[row] += sign * np.cross(spin[place], arm)
        length = np.sqrt(np.sum(between**2, axis=1))
        safe = np.where(length > 0, length, 1.0)
        rate = np.sum(moving * between, axis=1) / safe
        pull = -self.stiffness * (length - self.rest) - self.damping * rate
        along = (pull / safe)[:, None] * between
        force += self.matrix.T @ along
        for (row, place, sign, _), arm in zip(self.arms, turned, strict=True):
            torque[place] += np.cross(arm, sign * along[row])
