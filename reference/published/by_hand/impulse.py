"""Impulses by hand: what a floor gives to a ball, and two balls to each other."""

from __future__ import annotations

import math

import numpy as np

from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, UP, X
from reference.published.case import Published

_NO_ROTATION = np.zeros((3, 3))
"""Inverse inertia of a body that no impulse turns."""
_UPRIGHT = (1.0, 0.0, 0.0, 0.0)
"""An orientation, as a quaternion wxyz; a sphere's inertia is the same in any."""
FLOOR = (STILL, STILL, STILL, 0.0, _NO_ROTATION)
"""As a body: velocity, angular velocity, arm, inverse mass, inverse inertia."""


def textbook_bounce(case: Published, code: Implementation) -> Answers:
    """P21: from the heights to the impulse, and from that to the mean forces."""
    mass, gravity, height = case.values("mass", "gravity", "height")
    e, ball = math.sqrt(case.value("rebound") / height), _dropped(mass, height, gravity)
    impulse = float(code.function("impulse_magnitude")(ball, FLOOR, UP, e))
    force, time = code.function("mean_force"), case.value("contact_time")
    return as_answers(
        restitution=e,
        impulse=impulse,
        energy_change=-float(code.function("energy_lost")(ball, FLOOR, UP, e)),
        net_force=float(force(impulse * UP, time)[2]),
        contact_force=float(force(impulse * UP, time, -mass * gravity * UP)[2]),
    )


def elastic_bounce(case: Published, code: Implementation) -> Answers:
    """P22: the change of momentum is the impulse."""
    ball = _dropped(*case.values("mass", "height", "gravity"))
    return as_answers(impulse=float(code.function("impulse_magnitude")(ball, FLOOR, UP, 1.0)))


def _dropped(mass: float, height: float, gravity: float) -> tuple[object, ...]:
    """A ball as it meets the floor, with the entries of `FLOOR`."""
    return -math.sqrt(2 * gravity * height) * UP, STILL, STILL, 1 / mass, _NO_ROTATION


def colliding_pair(case: Published, code: Implementation) -> Answers:
    """P27: two balls head-on, in one impulse."""
    e = np.array(case.numbers("restitution"))
    radius, speed, mass = case.values("radius", "speed", "mass")
    inertia = code.function("world_inverse_inertia")(code.function("sphere_inertia")(mass, radius), _UPRIGHT)
    left = (speed * X, STILL, radius * X, 1 / mass, inertia)
    right = (-speed * X, STILL, -radius * X, 1 / mass, inertia)
    after_left, _, after_right, _ = code.function("collide")(left, right, -X, e)
    parting = after_right[..., 0] - after_left[..., 0]
    return as_answers(restitution=tuple((parting / (2 * speed)).tolist()))
