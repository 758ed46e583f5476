"""Which scenarios a simple driver can run: one body over one plane that moves as a point does, without turning."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reference import geometry
from reference.scenario import Body, Box, HalfSpace, Scenario, Sphere

Array = NDArray[np.float64]
_ROUNDING = 1e-9  # lengths, speeds and sines below this are zero


def kind(scenario: Scenario) -> type[Sphere] | type[Box] | None:
    """Sphere for a ball that nothing makes spin, Box for a box that slides as a point does, both over one plane.

    None for what needs a rigid-body world.
    """
    movable = [body for body in scenario.bodies if not body.immovable]
    fixed = [body for body in scenario.bodies if body.immovable]
    if len(movable) != 1 or len(fixed) != 1 or not isinstance(fixed[0].shape, HalfSpace) or not scenario.pairs:
        return None
    body, normal = movable[0], np.array(fixed[0].shape.normal)
    if any(body.angular_velocity):
        return None
    if isinstance(body.shape, Sphere):
        along = [np.linalg.norm(np.cross(vector, normal)) for vector in (body.velocity, scenario.gravity)]
        return None if max(along) > _ROUNDING and _friction(scenario) > 0 else Sphere
    place = np.array([body.position]), np.array([body.orientation])
    gap = geometry.separation(scenario, body.name, fixed[0].name, *place)[0]
    flat = abs(gap) < _ROUNDING and _stands_on_a_face(body, normal) and not _may_tip(scenario, body, normal)
    return Box if flat and _slides_straight(scenario, body, normal) else None


def _friction(scenario: Scenario) -> float:
    pair = scenario.pairs[0]
    return max(pair.kinetic_friction, pair.static_friction or 0.0)


def _stands_on_a_face(body: Body, normal: Array) -> bool:
    """Whether the normal lies along one of the body's own axes."""
    return bool(np.sort(_along_own_axes(body, normal))[1] < _ROUNDING)


def _may_tip(scenario: Scenario, body: Body, normal: Array) -> bool:
    """Whether friction could turn a standing box over an edge.

    Friction, at most μ N, acts a height h below the centre. The normal force balances its moment h μ N by moving up to
    μ h ahead, and that must lie within the face whichever way the friction points.
    """
    up, extents = int(np.argmax(_along_own_axes(body, normal))), np.array(body.shape.half_extents)  # type: ignore[union-attr]
    return bool(_friction(scenario) * extents[up] > np.delete(extents, up).min())


def _along_own_axes(body: Body, direction: Array) -> Array:
    """Sizes of a direction's components along the body's own axes, (3,)."""
    own = geometry.rotate(np.array(body.orientation) * np.array([1.0, -1.0, -1.0, -1.0]), direction)
    return np.asarray(np.abs(own))


def _slides_straight(scenario: Scenario, body: Body, normal: Array) -> bool:
    """Whether the body is pressed on, not thrown off, and its weight pulls along its way if at all."""
    velocity, gravity = np.array(body.velocity), np.array(scenario.gravity)
    pull = gravity - (gravity @ normal) * normal
    leaves = abs(velocity @ normal) > _ROUNDING or gravity @ normal > 0
    return not leaves and bool(np.linalg.norm(np.cross(velocity, pull)) < _ROUNDING)
