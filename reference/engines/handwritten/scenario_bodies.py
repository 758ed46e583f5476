"""Which body of a scenario is which, and how one of them lies and turns: what kinds and drivers have in common."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.scene import geometry
from reference.scene.scenario import Body, HalfSpace, Scenario, Sphere

ROUNDING = 1e-9
"""A length, m, a speed, m/s, or a sine below this is zero."""


def planes_met(scenario: Scenario) -> list[Body]:
    """The bodies that the single movable one collides with, in the order of the pairs."""
    (movable,) = (body.name for body in scenario.bodies if not body.immovable)
    return [scenario.body(pair.body_b if pair.body_a == movable else pair.body_a) for pair in scenario.pairs]


def movable(scenario: Scenario) -> Body:
    """Return the first body that can move."""
    return next(body for body in scenario.bodies if not body.immovable)


def ball_and_other(scenario: Scenario) -> tuple[Body, Body]:
    """Return the two bodies, a ball first if there is one."""
    first, second = scenario.bodies
    return (first, second) if isinstance(first.shape, Sphere) else (second, first)


def box_and_plane(scenario: Scenario) -> tuple[Body, Body]:
    """Return the two bodies, the half-space last if there is one."""
    first, second = scenario.bodies
    return (second, first) if isinstance(first.shape, HalfSpace) else (first, second)


def turns_steadily(body: Body, orientation: Array, spin: Array) -> bool:
    """Whether a body that nothing pushes keeps its spin (3,), rad/s: it turns about a principal axis, or not at all."""
    own_spin = geometry.rotate(geometry.opposite(orientation), spin)
    moments = np.array(body.moments_of_inertia())
    size = np.linalg.norm(spin) ** 2 * moments.max()
    return bool(np.linalg.norm(np.cross(own_spin, moments * own_spin)) <= ROUNDING * size)


def face_towards(ball: Body, box: Body) -> Array:
    """Normal out of the face of the box, (3,), beyond which the ball lies farthest."""
    along = in_own_axes(box, np.subtract(ball.position, box.position))
    nearest = int(np.argmax(np.abs(along) - np.array(box.shape.half_extents)))  # type: ignore[union-attr]
    return geometry.rotate(np.array(box.orientation), np.sign(along[nearest]) * np.eye(3)[nearest])


def along_own_axes(body: Body, direction: Array) -> Array:
    """Sizes of a direction's components along the body's own axes, (3,)."""
    return np.asarray(np.abs(in_own_axes(body, direction)))


def in_own_axes(body: Body, vector: Array) -> Array:
    """A vector of the world in the body's own axes, (3,)."""
    return geometry.rotate(geometry.opposite(np.array(body.orientation)), vector)
