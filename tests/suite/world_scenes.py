"""Scenes of the hand-written world, body by body, for the tests that put it to the proof."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from solutions.impulse import box_inertia, rotation_matrix, sphere_inertia
from solutions.world.bodies import Bodies, State, make_bodies, make_state

GRAVITY = 9.81
DOWN = np.array([0.0, 0.0, -GRAVITY])
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
FLOOR_NORMAL = (0.0, 0.0, 1.0)


class Thing(NamedTuple):
    """One body: a shape, a mass in kg (infinite: immovable), and how it starts, all in SI units."""

    shape: tuple[Any, ...]
    mass: float = np.inf
    position: Any = (0.0, 0.0, 0.0)
    orientation: Any = UPRIGHT
    velocity: Any = (0.0, 0.0, 0.0)
    spin: Any = (0.0, 0.0, 0.0)
    group: int = 0


FLOOR = Thing(("half-space", FLOOR_NORMAL))


def turn(axis: Any, angle: float) -> np.ndarray:
    """Quaternion of a turn about an axis, which need not have length 1."""
    direction = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    return np.array([np.cos(angle / 2), *(np.sin(angle / 2) * direction)])


def moments(shape: tuple[Any, ...], mass: float) -> np.ndarray:
    """Principal moments of a solid body, (3,), kg m²; of an immovable one they are infinite."""
    if np.isinf(mass):
        return np.full(3, np.inf)
    if shape[0] == "sphere":
        return np.asarray(sphere_inertia(mass, shape[1]))
    if shape[0] == "box":
        return np.asarray(box_inertia(mass, 2 * np.asarray(shape[1], dtype=float)))
    return _capsule_moments(mass, *shape[1:])


def _capsule_moments(mass: float, radius: float, half_length: float) -> np.ndarray:
    """Those of a cylinder and two half balls, whose centres of mass lie 3/8 r beyond its ends."""
    cylinder, ball = 2 * half_length, 4 / 3 * radius
    cylinder, ball = mass * cylinder / (cylinder + ball), mass * ball / (cylinder + ball)
    along = cylinder * radius**2 / 2 + ball * 2 / 5 * radius**2
    across = cylinder * (radius**2 / 4 + half_length**2 / 3)
    across += ball * (2 / 5 * radius**2 + half_length**2 + 3 / 4 * half_length * radius)
    return np.array([across, across, along])


def scene(things: Sequence[Thing], **coefficients: Any) -> tuple[Bodies, State]:
    """A world of solid bodies, and its start; the coefficients are those of `make_bodies`."""
    bodies = make_bodies(
        [each.shape for each in things],
        [each.mass for each in things],
        [moments(each.shape, each.mass) for each in things],
        group=[each.group for each in things],
        **coefficients,
    )
    orientation = [each.orientation for each in things]
    start = make_state(
        [each.position for each in things],
        orientation,
        [each.velocity for each in things],
        [each.spin for each in things],
    )
    return bodies, start


def energy(bodies: Bodies, state: State, gravity: float = 0.0) -> np.ndarray:
    """Kinetic energy, and that of the height, of each body, (..., n), J; 0 of immovable ones."""
    movable = bodies.inverse_mass > 0
    mass = np.where(movable, 1 / np.where(movable, bodies.inverse_mass, 1.0), 0.0)
    own = np.vecmat(state.angular_velocity, rotation_matrix(state.orientation))
    about = np.where(movable[:, None], bodies.moments, 0.0)
    kinetic = (mass * np.vecdot(state.velocity, state.velocity) + np.vecdot(about * own, own)) / 2
    return np.asarray(kinetic + mass * gravity * state.position[..., 2])


def momentum(bodies: Bodies, state: State) -> tuple[np.ndarray, np.ndarray]:
    """Momentum of all movable bodies, (..., 3), kg m/s, and their angular momentum about the origin, kg m²/s."""
    movable = bodies.inverse_mass > 0
    mass = np.where(movable, 1 / np.where(movable, bodies.inverse_mass, 1.0), 0.0)
    linear = mass[:, None] * state.velocity
    to_world = rotation_matrix(state.orientation)
    own = np.where(movable[:, None], bodies.moments, 0.0) * np.vecmat(state.angular_velocity, to_world)
    angular = np.cross(state.position, linear) + np.matvec(to_world, own)
    return np.sum(linear, axis=-2), np.sum(angular, axis=-2)
