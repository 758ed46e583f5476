"""Whether a scenario's impacts may act on a body off its centre, with rebound: decided before it runs."""

from __future__ import annotations

import itertools

import numpy as np

from reference.arrays import Array
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere

_TIMES = 0.0, 1.0  # s; a push that is zero along a direction at both never acts along it
_ROUNDING = 1e-9  # a length (m) or a speed (m/s, rad/s) below this is zero


def may_strike_off_centre(scenario: Scenario, smooth: bool = False) -> bool:
    """Whether some pair with e > 0 and μ > 0 may meet where a push along the normal turns one of the two.

    smooth: whether pairs without friction count too.

    Such an impact couples the normal with the surface: friction changes the speed of parting, and the normal impulse
    changes the slip. A ball alone never turns by a push along its normal, and a half-space never turns at all. So only
    movable boxes are looked at. Each is taken in the orientation in which it starts; one that spins about anything but
    the normal meets the other body in an orientation that we do not work out, and counts as struck off its centre.
    """
    return any(
        isinstance(body.shape, Box) and not body.immovable and _turned_by_a_push(scenario, body, other)
        for pair in scenario.pairs
        if pair.restitution > 0 and (smooth or pair.kinetic_friction > 0)
        for body, other in itertools.permutations((scenario.body(pair.body_a), scenario.body(pair.body_b)))
    )


def may_rub_off_centre(scenario: Scenario) -> bool:
    """Whether some pair with e > 0 and μ > 0 may meet with an edge or a face that moves along the other body.

    The corners that meet lie beside the centre, each by itself, even if their middle lies under it. Friction acts below
    the centre and turns the box, so that the corners ahead are pressed more than those behind. A pair that touches at
    the start has nothing to rebound from and is not looked at.
    """
    return any(
        isinstance(body.shape, Box) and not body.immovable and _rubs_on_corners(scenario, body, other)
        for pair in scenario.pairs
        if pair.restitution > 0 and pair.kinetic_friction > 0
        for body, other in itertools.permutations((scenario.body(pair.body_a), scenario.body(pair.body_b)))
    )


def _rubs_on_corners(scenario: Scenario, box: Body, other: Body) -> bool:
    if isinstance(other.shape, Sphere) or geometry.gap(box, other) < geometry.TOUCHING:
        return False
    normal = _towards(box, other)
    ways = [np.subtract(other.velocity, box.velocity)]
    if other.immovable:
        ways.append(np.array(scenario.gravity))  # else both fall alike
    ways += [
        np.array(push.at(time)) for push in scenario.forces if push.body in (box.name, other.name) for time in _TIMES
    ]
    moves_along = any(np.linalg.norm(np.cross(way, normal)) > _ROUNDING for way in ways)
    return moves_along and len(_nearest_corners(box, normal)) > 1


def _turned_by_a_push(scenario: Scenario, box: Body, other: Body) -> bool:
    """Whether a push on a box along the normal towards another body passes beside the centre of the box."""
    normal = _towards(box, other)
    spin = np.cross(box.angular_velocity, normal)
    if np.linalg.norm(spin) > _ROUNDING or np.linalg.norm(_nearest_point(box, normal)) > _ROUNDING:
        return True
    if isinstance(other.shape, HalfSpace) or (isinstance(other.shape, Box) and other.immovable):
        return False  # where on its surface the box arrives does not matter
    ways = [np.subtract(other.position, box.position), np.subtract(other.velocity, box.velocity)]
    if other.immovable:
        ways.append(np.array(scenario.gravity))  # else both fall alike
    return any(np.linalg.norm(np.cross(way, normal)) > _ROUNDING for way in ways)


def _towards(box: Body, other: Body) -> Array:
    """Unit direction (3,) along which the surface of another body lies, seen from a box."""
    if isinstance(other.shape, HalfSpace):
        return -np.array(other.shape.normal)
    between = np.subtract(other.position, box.position)
    if isinstance(other.shape, Sphere):
        return np.asarray(between / np.linalg.norm(between))
    faces = [geometry.rotate(np.array(body.orientation), axis) for body in (box, other) for axis in np.eye(3)]
    apart = [abs(between @ face) - _reach(box, face) - _reach(other, face) for face in faces]
    face = faces[int(np.argmax(apart))]
    return np.asarray(np.sign(between @ face) * face)


def _corners(box: Body) -> Array:
    """The corners of a box from its centre, (8, 3), m."""
    signs = np.array(list(itertools.product((-1, 1), repeat=3)))
    return geometry.rotate(np.array(box.orientation), signs * np.array(box.shape.half_extents))  # type: ignore[union-attr]


def _reach(box: Body, direction: Array) -> float:
    """How far a box extends from its centre along a direction, m."""
    return float(np.max(_corners(box) @ direction))


def _nearest_point(box: Body, direction: Array) -> Array:
    """Middle of the corner, edge or face of a box that lies farthest along a direction, across it, (3,), m."""
    middle = np.mean(_nearest_corners(box, direction), axis=0)
    return np.asarray(middle - (middle @ direction) * direction)


def _nearest_corners(box: Body, direction: Array) -> Array:
    """The corners of a box that lie farthest along a direction, from its centre, (n, 3), m."""
    corners = _corners(box)
    heights = corners @ direction
    return np.asarray(corners[heights > heights.max() - _ROUNDING])
