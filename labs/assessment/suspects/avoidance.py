"""Wrong functions about avoidance, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import Contract, not_negative, number, positive, unit, vector
from reference.arrays import Array


def nearest_approach(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    radius_a: float = 0.0,
    radius_b: float = 0.0,
) -> tuple[float, float]:
    """When two ferries are nearest, and how near."""
    x = np.subtract(position_a, position_b).astype(float)
    u = np.subtract(velocity_a, velocity_b).astype(float)
    squared = float(u @ u)
    time = -float(x @ u) / squared if squared > 0 else 0.0
    return time, float(np.linalg.norm(x + time * u)) - radius_a - radius_b


def repelling_force(separation: float, normal: ArrayLike, strength: float, reach: float) -> Array:
    """The push of a field on a model boat around a lighthouse."""
    left = max(0.0, 1 - abs(separation) / reach)
    return np.asarray(strength * left**2 * np.asarray(normal, dtype=float))


def tangent_point(position: ArrayLike, heading: ArrayLike, centre: ArrayLike, radius: float) -> Array:
    """Where a drone should aim to pass a balloon."""
    p, c, v = (np.asarray(value, dtype=float) for value in (position, centre, heading))
    distance = float(np.linalg.norm(c - p))
    if distance == 0:
        return np.asarray(c + np.array([0.0, 0.0, radius]))
    towards = (c - p) / distance
    if distance < radius:
        return np.asarray(c - radius * towards)
    flat = float(np.hypot(towards[0], towards[1]))
    left = np.array([-towards[1], towards[0], 0.0]) / flat if flat > 0 else np.array([1.0, 0.0, 0.0])
    side = -left if v @ left < 0 else left
    short = radius**2 / distance
    return np.asarray(c - short * towards + np.sqrt(radius**2 - short**2) * side)


def _one_after_another(program: Callable[..., Any]) -> str:
    """What is wrong with the step of a flock of which no boid may move before all have looked."""
    flocks = (
        ([[0.0, 0.0], [1.0, 0.0]], [[0.0, 0.0], [0.0, 0.0]]),
        ([[0.0, 0.0], [0.8, 0.6], [-0.5, 1.0]], [[1.0, 0.0], [0.0, -1.0], [0.5, 0.5]]),
        ([[0.0, 0.0], [3.0, 0.0], [3.5, 0.0]], [[0.2, 0.0], [0.0, 0.0], [0.0, 0.1]]),
    )
    for places, speeds in flocks:
        place, speed = np.array(places), np.array(speeds)
        expected = _step(place, speed, 0.1, 2.0)
        found = tuple(np.asarray(each, dtype=float) for each in program(place.copy(), speed.copy(), 0.1, 2.0))
        for name, unit_of, at in (("velocity", "m/s", 1), ("place", "m", 0)):
            mine, theirs = found[at], expected[at]
            if mine.shape != theirs.shape:
                return f"Your program returns an array {mine.shape} for {len(place)} boids in the plane."
            wrong = np.flatnonzero(np.max(np.abs(mine - theirs), axis=-1) > NEAR)
            if len(wrong):
                which = int(wrong[0])
                (x, y), (a, b) = theirs[which], mine[which]
                return (
                    f"Of a flock of {len(place)} boids, boid {which} should have the {name} ({x:.4f}, {y:.4f})"
                    f" {unit_of} after one step, and your program says ({a:.4f}, {b:.4f})."
                ).replace("-", "−")
    return ""


def _step(position: Array, velocity: Array, dt: float, radius: float) -> tuple[Array, Array]:
    """Places and velocities after a step in which all look first, and move then."""
    apart = position[:, None] - position
    squared = np.sum(apart**2, axis=-1)
    near = (squared > 0) & (squared <= radius**2)
    push = np.sum(np.where(near, 1 / np.where(near, squared, 1.0), 0.0)[..., None] * apart, axis=1)
    moving = velocity + dt * push
    return position + dt * moving, moving


NEAR = 1e-9
"""A mended program may differ from the right numbers by so much, m or m/s."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"drift": _one_after_another}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "ferries": (
        "nearest_approach",
        nearest_approach,
        Contract(
            {
                "position_a": vector,
                "velocity_a": vector,
                "position_b": vector,
                "velocity_b": vector,
                "radius_a": not_negative,
                "radius_b": not_negative,
            },
            optional=2,
        ),
    ),
    "lighthouse": (
        "repelling_force",
        repelling_force,
        Contract({"separation": number, "normal": unit(), "strength": not_negative, "reach": positive}),
    ),
    "balloon": (
        "tangent_point",
        tangent_point,
        Contract({"position": vector, "heading": vector, "centre": vector, "radius": positive}),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
