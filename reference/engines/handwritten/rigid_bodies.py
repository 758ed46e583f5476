"""One rigid body of each of N scenarios, as arrays: its state, how it moves, and what an impact has to know of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction
from reference.scene import geometry
from reference.scene.scenario import Body, Box, Scenario, Sphere

IN_OWN_AXES = (1.0, 0.0, 0.0, 0.0)
"""Orientation of a body that has not been turned, w x y z."""


class RigidBodies:
    """N bodies, one of each scenario; immovable ones have an inverse mass of zero, and their weight does not move them.

    position, velocity: (N, 3), m and m/s. orientation: (N, 4), w x y z. spin: (N, 3), rad/s, world frame.
    """

    def __init__(self, scenarios: Sequence[Scenario], bodies: Sequence[Body], implementation: Implementation) -> None:
        self.bodies = bodies
        self.place = [scenario.bodies.index(body) for scenario, body in zip(scenarios, bodies, strict=True)]
        self.position = np.array([body.position for body in bodies])
        self.orientation = np.array([body.orientation for body in bodies])
        self.velocity = np.array([body.velocity for body in bodies])
        self.spin = np.array([body.angular_velocity for body in bodies])
        self.inverse_mass = np.array([body.inverse_mass for body in bodies])
        self.moments = np.array([moments_of_inertia(body, implementation) for body in bodies])
        falls = self.inverse_mass[:, None] > 0
        self.acceleration = np.where(falls, [scenario.gravity for scenario in scenarios], 0.0)
        self._world_inverse_inertia = implementation.function("world_inverse_inertia")

    def struck_at(self, arm: Array) -> tuple[Array, Array, Array, Array, Array]:
        """What an impact has to know: velocity, angular velocity, arm (N, 3), inverse mass and inverse inertia."""
        return self.velocity, self.spin, arm, self.inverse_mass, self._inverse_inertia()

    def move(self, motion: Callable[..., tuple[Array, Array]], duration: Array) -> None:
        """Move for a while (N,), s, spinning about an axis that keeps its direction."""
        moved = motion(self.position, self.velocity, self.acceleration, duration)
        self.position, self.velocity = map(np.asarray, moved)
        self.orientation = geometry.turned(self.orientation, self.spin * duration[:, None])

    def set_velocities(self, struck: Mask, velocity: Array, spin: Array) -> None:
        """Give the bodies that are struck their velocities after the impact."""
        self.velocity = np.where(struck[:, None], velocity, self.velocity)
        self.spin = np.where(struck[:, None], spin, self.spin)

    def _inverse_inertia(self) -> Array:
        """Inverse inertia in the world frame, (N, 3, 3), 1/(kg m²).

        As long as no function turns it, bodies that lie in their own axes can still strike each other: a first version
        of `collide` runs before `world_inverse_inertia` is written.
        """
        try:
            return np.asarray(self._world_inverse_inertia(self.moments, self.orientation))
        except NeedsFunction:
            if np.any(self.orientation != IN_OWN_AXES):
                raise
            return np.asarray(np.eye(3) / self.moments[:, None, :])

    def states(self) -> Array:
        """The 13 numbers that a sample keeps, (N, 13)."""
        return np.concatenate([self.position, self.orientation, self.velocity, self.spin], axis=-1)


def moments_of_inertia(body: Body, implementation: Implementation) -> Array:
    """Moments of inertia about the body's own axes, (3,), kg m²; infinite for a plane, which nothing turns."""
    if body.inertia:
        return np.array(body.inertia)
    if isinstance(body.shape, Sphere):
        return np.asarray(implementation.function("sphere_inertia")(body.mass, body.shape.radius))
    if isinstance(body.shape, Box):
        return np.asarray(implementation.function("box_inertia")(body.mass, 2 * np.array(body.shape.half_extents)))
    return np.full(3, np.inf)
