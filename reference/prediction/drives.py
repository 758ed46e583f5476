"""What pulls a body along a plane where that changes: pushes that grow, and springs, all along one line."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.scene.forces import GrowingForce, Spring
from reference.scene.scenario import Body, Scenario

ALIGNED = 1e-9
"""Sine of the angle between two directions that count as one."""


@dataclass(frozen=True)
class Drive:
    """ahead: unit vector, (3,), along which everything pulls.

    pull: number of the step and way so far, m → what is added to the speed along `ahead` in that step, m/s.
    """

    ahead: Array
    pull: Callable[[int, float], float]


def drive_of(scenario: Scenario, body: Body, normal: Array, dt: float) -> Drive | None:
    """The drive of one body on a level plane; None where anything pulls it aside, off the plane or about its centre."""
    level = float(np.linalg.norm(np.cross(scenario.gravity, normal))) < ALIGNED
    if not level or scenario.attractions or scenario.fluid:
        return None
    if not all(isinstance(push, GrowingForce) for push in scenario.forces):
        return None
    if not all(_holds_the_centre(spring, body) for spring in scenario.springs):
        return None
    rates = [np.array(push.rate) for push in scenario.forces if isinstance(push, GrowingForce)]
    lines = [_from_anchor(spring, body) for spring in scenario.springs]
    ways = [vector for vector in (*rates, *lines, np.array(body.velocity)) if np.linalg.norm(vector) > ALIGNED]
    ahead = ways[0] / np.linalg.norm(ways[0])
    aside = max(float(np.linalg.norm(np.cross(ahead, way)) / np.linalg.norm(way)) for way in ways)
    if aside > ALIGNED or abs(float(ahead @ normal)) > ALIGNED:
        return None
    rate = float(sum((each @ ahead for each in rates), 0.0)) * dt
    springs = [
        (spring.stiffness, float(line @ ahead), spring.rest_length)
        for spring, line in zip(scenario.springs, lines, strict=True)
    ]

    def pull(number: int, way: float) -> float:
        force = rate * number
        for stiffness, start, rest in springs:
            place = start + way
            force -= stiffness * (place - np.sign(place) * rest)
        return force * dt / body.mass

    return Drive(ahead, pull)


def _holds_the_centre(spring: Spring, body: Body) -> bool:
    """Whether a spring pulls a body's centre towards a point of the world, without a damper."""
    return spring.body_a == body.name and not spring.body_b and not any(spring.point_a) and spring.damping == 0


def _from_anchor(spring: Spring, body: Body) -> Array:
    """From where a spring is held in the world to the body's centre, (3,), m."""
    return np.subtract(body.position, spring.point_b)
