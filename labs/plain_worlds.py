"""Worlds in plain arrays, as the functions of the lab `world` take them: for its notebook, its tests and its probes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from reference.arrays import Array

BALL, BOX, PLANE = range(3)
INFINITY = float("inf")
UNTURNED, UP, REST = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)
WEIGHT = np.array([0.0, 0.0, -10.0])
"""Of a kilogram, N."""


def thing(
    kind: int,
    size: Any,
    mass: float = INFINITY,
    position: Any = REST,
    orientation: Any = UNTURNED,
    velocity: Any = REST,
    spin: Any = REST,
) -> tuple[Any, ...]:
    """One body: its inverse mass, its moments, kind and size, and how it starts; without a mass nothing moves it.

    size: the radius of a ball, m; (3,) the half extents of a box, m, or the normal of a plane. mass: kg. orientation:
    (4,), a unit quaternion. position, velocity, spin: (3,), m, m/s and rad/s.
    """
    if kind == BALL:
        size = (float(size), 0.0, 0.0)
    a, b, c = np.square(size)
    if mass == INFINITY:
        moments = np.full(3, INFINITY)
    elif kind == BALL:
        moments = 0.4 * mass * np.full(3, a)
    else:
        moments = mass / 3 * np.array([b + c, c + a, a + b])
    return 1 / mass, moments, kind, size, position, orientation, velocity, spin


FLOOR = thing(PLANE, UP)
EMPTY = np.zeros(0, int), np.zeros((0, 3))
"""The memory of a step without contacts."""


def world(things: Sequence[tuple[Any, ...]], restitution: Any = 0.5, friction: Any = 0.0, meet: Any = True) -> Any:
    """Bodies and their state, in the plain arrays of the lab. Coefficients: (n, n), or one for all."""
    share, moments, kind, size, *state = (np.array(column) for column in zip(*things, strict=True))
    tables = (np.array(np.broadcast_to(table, (len(things), len(things)))) for table in (restitution, friction, meet))
    e, mu, meets = tables
    bodies = (share, moments, e.astype(float), mu.astype(float), meets.astype(bool), kind, size.astype(float))
    return bodies, tuple(each.astype(float) for each in state)


def contacts(*several: tuple[int, int, Any, Any, float]) -> tuple[Any, ...]:
    """Contacts by hand: A, B, place (3,), unit normal (3,) from B to A, and separation of each, m."""
    if not several:
        return np.zeros(0, int), np.zeros(0, int), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0), np.zeros(0, int)
    a, b, point, normal, separation = (np.array(column) for column in zip(*several, strict=True))
    places = np.asarray(point, dtype=float), np.asarray(normal, dtype=float), np.asarray(separation, dtype=float)
    return a, b, *places, np.arange(10, 10 + len(several))


def load(bodies: Any, others: Any = REST, turning: Any = REST) -> Array:
    """Weight and other forces, and torques, on each body, (n, 6), N and N m; nothing on what cannot be moved."""
    movable = bodies[0] > 0
    mass = np.where(movable, 1 / np.where(movable, bodies[0], 1.0), 0.0)[:, None]
    return np.concatenate([mass * WEIGHT + (mass > 0) * others, (mass > 0) * np.asarray(turning)], axis=-1)
