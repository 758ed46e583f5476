"""Gaps between shapes, computed from the poses alone: the referee's own ruler, which trusts no engine's report."""

from __future__ import annotations

import itertools

import numpy as np

from reference.arrays import Array
from reference.errors import InvalidInput
from reference.scene import surfaces
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Shape, Sphere

TOUCHING = 2e-6
"""Two bodies with a smaller gap touch at the start, m. The catalogue's gaps keep clear of it, so that rounding does not
decide: the cradle's 1 µm counts as touching, its 10 µm does not."""
_NEXT, _AFTER = np.array([1, 2, 0]), np.array([2, 0, 1])
"""For each axis, the next and the one after it."""


def cross(one: Array, other: Array) -> Array:
    """Product a × b of vectors (..., 3), to the last bit that of NumPy, whose own takes three times as long."""
    first = one.take(_NEXT, -1) * other.take(_AFTER, -1)
    return np.asarray(first - one.take(_AFTER, -1) * other.take(_NEXT, -1))


def rotate(orientation: Array, vector: Array) -> Array:
    """Rotate vectors (..., 3) by unit quaternions (..., 4), w x y z: v + 2 w (q × v) + 2 q × (q × v)."""
    w, q = orientation[..., :1], orientation[..., 1:]
    twice = 2 * cross(q, vector)
    return np.asarray(vector + w * twice + cross(q, twice))


def opposite(orientation: Array) -> Array:
    """The turns back of unit quaternions (..., 4), w x y z: their conjugates."""
    return np.asarray(orientation * np.array([1.0, -1.0, -1.0, -1.0]))


def turned(orientation: Array, rotation: Array) -> Array:
    """Orientations (..., 4), w x y z, after a turn by the vectors `rotation` (..., 3), rad, about the world's axes.

    It is the Hamilton product of (cos θ/2, sin θ/2 · axis) and the orientation.
    """
    angle = np.linalg.norm(rotation, axis=-1, keepdims=True)
    w, q = np.cos(angle / 2), rotation * np.sinc(angle / (2 * np.pi)) / 2
    w_before, q_before = orientation[..., :1], orientation[..., 1:]
    scalar = w * w_before - np.sum(q * q_before, axis=-1, keepdims=True)
    return np.concatenate([scalar, w * q_before + w_before * q + cross(q, q_before)], axis=-1)


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


def upright_on(normal: Array) -> Array:
    """Orientation, w x y z, of a body whose own z axis points along the unit normal (3,) of what it stands on."""
    return quaternion_between(np.array([0.0, 0.0, 1.0]), normal)


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

    Exact where one is a half-space or a sphere. Two boxes: the largest gap along any face normal or cross product of
    edges, which is exact where faces or edges meet or boxes overlap, and never too large. Of a polyhedron the gap is
    known to a sphere alone.
    """
    order = (HalfSpace, Sphere, Box, Polyhedron)
    if order.index(type(body_a.shape)) > order.index(type(body_b.shape)):
        return gap(body_b, body_a)
    if isinstance(body_b.shape, Polyhedron) and not isinstance(body_a.shape, Sphere):
        raise InvalidInput(f"the gap between {body_a.name} and {body_b.name} is not defined: {body_b.name} is a mesh")
    between = np.array(body_b.position) - np.array(body_a.position)
    poses = [np.array([body.orientation]) for body in (body_a, body_b)]
    if isinstance(body_a.shape, HalfSpace):
        normal = np.array(body_a.shape.normal)
        return float(between @ normal - _reach(body_b.shape, poses[1], normal)[0])
    if isinstance(body_a.shape, Sphere):
        return _out_of(body_b, -between) - body_a.shape.radius
    axes = [rotate(pose, np.eye(3)) for pose in poses]
    crossed = [np.cross(first, second) for first in axes[0] for second in axes[1]]
    directions = [*axes[0], *axes[1], *crossed]
    units = [direction / np.linalg.norm(direction) for direction in directions if np.linalg.norm(direction) > 1e-9]
    reach = [_reach(body_a.shape, poses[0], -unit)[0] + _reach(body_b.shape, poses[1], unit)[0] for unit in units]
    return float(max(abs(between @ unit) - far for unit, far in zip(units, reach, strict=True)))


def _out_of(body: Body, place: Array) -> float:
    """How far a place, seen from the body's centre, lies outside a sphere, a box or a mesh, m; negative inside."""
    if isinstance(body.shape, Sphere):
        return float(np.linalg.norm(place)) - body.shape.radius
    if isinstance(body.shape, Polyhedron):
        own = rotate(opposite(np.array(body.orientation)), place)
        away = float(np.linalg.norm(surfaces.nearest_points(own[None], body.shape.triangles)[0] - own))
        return -away if surfaces.winding_number(own, body.shape.triangles) > 0.5 else away
    return float(out_of_box(place, np.array(body.orientation), np.array(body.shape.half_extents)))  # type: ignore[union-attr]


def out_of_box(place: Array, orientation: Array, half_extents: Array) -> Array:
    """How far places (..., 3), seen from a box's centre, lie outside it, (...), m; negative inside.

    orientation: (..., 4), the box's. half_extents: (3,), m.
    """
    own = rotate(opposite(orientation), place)
    beyond = np.abs(own) - half_extents
    return np.asarray(np.linalg.norm(np.maximum(beyond, 0.0), axis=-1) + np.minimum(np.max(beyond, axis=-1), 0.0))


def touching(scenario: Scenario) -> list[tuple[Body, Body]]:
    """The pairs that collide and touch at the start."""
    pairs = [(scenario.body(pair.body_a), scenario.body(pair.body_b)) for pair in scenario.pairs]
    return [(a, b) for a, b in pairs if not (a.immovable and b.immovable) and abs(gap(a, b)) < TOUCHING]


def starts_in_contact(scenario: Scenario) -> bool:
    """Whether every movable body touches another one at the start."""
    touched = {body.name for pair in touching(scenario) for body in pair}
    return all(body.name in touched for body in scenario.bodies if not body.immovable)


def leaning(scenario: Scenario) -> bool:
    """Whether two movable bodies touch at the start, as in a stack."""
    return any(not a.immovable and not b.immovable for a, b in touching(scenario))
