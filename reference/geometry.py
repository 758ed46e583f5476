"""Gaps between shapes, computed from the poses alone: the referee's own ruler, whatever an engine reports."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from reference.errors import InvalidInput
from reference.scenario import Body, Box, HalfSpace, Scenario, Shape, Sphere

Array = NDArray[np.float64]


def rotate(orientation: Array, vector: Array) -> Array:
    """Rotate vectors (..., 3) by unit quaternions (..., 4), w x y z: v + 2 w (q × v) + 2 q × (q × v)."""
    w, q = orientation[..., :1], orientation[..., 1:]
    twice = 2 * np.cross(q, vector)
    return np.asarray(vector + w * twice + np.cross(q, twice))


def quaternion_between(start: Array, end: Array) -> Array:
    """The shortest rotation, w x y z, that turns the unit vector `start` (3,) into the unit vector `end` (3,)."""
    w = 1 + float(np.dot(start, end))
    if w < 1e-12:  # opposite: half a turn about any axis across
        axis = np.cross(start, np.eye(3)[np.argmin(np.abs(start))])
        w = 0.0
    else:
        axis = np.cross(start, end)
    quaternion = np.array([w, *axis])
    return np.asarray(quaternion / np.linalg.norm(quaternion))


def separation(scenario: Scenario, body: str, plane: str, positions: Array, orientations: Array) -> Array:
    """Signed gap (n,) in m between a body and a half-space; negative when they overlap.

    positions (n, 3) and orientations (n, 4) are the body's.
    """
    support, surface = scenario.body(plane), scenario.body(body).shape
    if not isinstance(support.shape, HalfSpace):
        raise InvalidInput(f"{plane} is a {type(support.shape).__name__}; the gap is known for a half-space")
    normal = np.array(support.shape.normal)
    height = (positions - np.array(support.position)) @ normal
    return np.asarray(height - _reach(surface, orientations, normal))


def _reach(shape: Shape, orientations: Array, normal: Array) -> Array:
    """How far a shape extends from its centre against a direction: (n,), m."""
    if isinstance(shape, Sphere):
        return np.full(len(orientations), shape.radius)
    if isinstance(shape, Box):
        signs = np.array(list(itertools.product((-1, 1), repeat=3)))
        corners = rotate(orientations[:, None, :], signs * np.array(shape.half_extents))
        return np.asarray(-np.min(corners @ normal, axis=-1))
    raise InvalidInput(f"the gap between two bodies of shape {type(shape).__name__} is not defined")


def gap(body_a: Body, body_b: Body) -> float:
    """Gap between two bodies as they start, m; negative when they overlap.

    Spheres and half-spaces: exact. Two boxes: the largest gap along any face normal or cross product of edges, which is
    exact where faces meet and never too large.
    """
    shapes = body_a.shape, body_b.shape
    if isinstance(body_a.shape, HalfSpace):
        normal = np.array(body_a.shape.normal)
        height = (np.array(body_b.position) - np.array(body_a.position)) @ normal
        return float(height - _reach(body_b.shape, np.array([body_b.orientation]), normal)[0])
    if isinstance(body_b.shape, HalfSpace):
        return gap(body_b, body_a)
    between = np.array(body_b.position) - np.array(body_a.position)
    if all(isinstance(shape, Sphere) for shape in shapes):
        directions = [between]
    else:
        axes = [rotate(np.array([body.orientation]), np.eye(3)) for body in (body_a, body_b)]
        crossed = [np.cross(first, second) for first in axes[0] for second in axes[1]]
        directions = [*axes[0], *axes[1], *crossed, between]
    units = [direction / np.linalg.norm(direction) for direction in directions if np.linalg.norm(direction) > 1e-9]
    poses = [np.array([body.orientation]) for body in (body_a, body_b)]
    reach = [_reach(body_a.shape, poses[0], -unit)[0] + _reach(body_b.shape, poses[1], unit)[0] for unit in units]
    return float(max(abs(between @ unit) - far for unit, far in zip(units, reach, strict=True)))


def touching(scenario: Scenario, tolerance: float = 1e-6) -> list[tuple[Body, Body]]:
    """The pairs that collide and touch at the start, with a gap below the tolerance, m."""
    pairs = [(scenario.body(pair.body_a), scenario.body(pair.body_b)) for pair in scenario.pairs]
    return [(a, b) for a, b in pairs if not (a.immovable and b.immovable) and abs(gap(a, b)) < tolerance]


def starts_in_contact(scenario: Scenario) -> bool:
    """Whether every movable body touches another one at the start."""
    touched = {body.name for pair in touching(scenario) for body in pair}
    return all(body.name in touched for body in scenario.bodies if not body.immovable)


def leaning(scenario: Scenario) -> bool:
    """Whether two movable bodies touch at the start, as in a stack."""
    return any(not a.immovable and not b.immovable for a, b in touching(scenario))
