"""Gaps between shapes, computed from the poses alone: the referee's own ruler, whatever an engine reports."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from reference.errors import InvalidInput
from reference.scenario import Box, HalfSpace, Scenario, Shape, Sphere

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


def starts_in_contact(scenario: Scenario, tolerance: float = 1e-6) -> bool:
    """Whether every movable body rests on a half-space at the start, with a gap below the tolerance, m."""
    planes = [body.name for body in scenario.bodies if isinstance(body.shape, HalfSpace)]
    for body in scenario.bodies:
        if body.immovable:
            continue
        pose = np.array([body.position]), np.array([body.orientation])
        gaps = [abs(float(separation(scenario, body.name, plane, *pose)[0])) for plane in planes]
        if not gaps or min(gaps) > tolerance:
            return False
    return True
