"""What kind a scenario is, and so which driver can run it: a point over a plane, two bodies, a row of balls."""

from __future__ import annotations

from enum import Enum
from functools import lru_cache
from itertools import pairwise

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten.closed_forms import form_of
from reference.engines.handwritten.mesh_kinds import drapes, settles, vibrates
from reference.engines.handwritten.scenario_bodies import (
    ROUNDING,
    along_own_axes,
    ball_and_other,
    box_and_plane,
    face_towards,
    in_own_axes,
    movable,
    planes_met,
    turns_steadily,
)
from reference.scene import geometry
from reference.scene.forces import GrowingForce
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere
from reference.scene.survey import Survey


class Kind(Enum):
    """The kinds of scenario, one for each driver."""

    BOUNCE = "bounce"
    """A ball over a plane that nothing makes spin."""
    WALLS = "walls"
    """A ball without weight between several planes."""
    THIN_WALL = "thin wall"
    """A ball that flies straight at a face of a fixed box, without weight, spin and friction."""
    SLIDE = "slide"
    """A box that slides as a point does."""
    PUSHED = "pushed"
    """A box at rest, until pushes that grow along the plane break it away."""
    SWINGING = "swinging"
    """A box that swings on a spring along the plane, until friction holds it."""
    BALLS = "balls"
    """Two balls that strike each other; they may spin and rub."""
    FACE = "face"
    """A ball that strikes a plane, or straight on a face of a box; it may spin and rub."""
    CORNER = "corner"
    """A box without weight that flies at a plane; it may spin and rub."""
    SPINNING = "spinning"
    """A box without weight that turns steadily and strikes a smooth ball."""
    ROW = "row"
    """Balls in a line, without weight."""
    FLIGHT = "flight"
    """Balls that meet nothing, and whose motion has a closed form."""
    ORBIT = "orbit"
    """Two balls that attract each other."""
    MESH = "mesh"
    """Point masses on springs that a fluid brings to rest."""
    VIBRATION = "vibration"
    """Point masses on springs that vibrate."""
    DRAPE = "drape"
    """Small balls on springs that a fluid brings to rest on a fixed ball."""


@lru_cache(maxsize=4096)
def kind(scenario: Scenario) -> Kind | None:
    """Return the kind of a scenario, or None if it needs a rigid-body world."""
    if isinstance(scenario, Survey):
        return None
    if form_of(scenario):
        return Kind.FLIGHT
    if _is_orbit(scenario):
        return Kind.ORBIT
    if not scenario.pairs:
        return Kind.MESH if settles(scenario) else Kind.VIBRATION if vibrates(scenario) else None
    if drapes(scenario):
        return Kind.DRAPE
    if scenario.pushes_change:
        return _driven(scenario)
    if _is_row(scenario):
        return Kind.ROW
    if len(scenario.bodies) > 2:
        return Kind.WALLS if _is_between_planes(scenario) else None
    if len(scenario.bodies) != 2 or geometry.starts_in_contact(scenario):
        return _over_a_plane(scenario)
    return _over_a_plane(scenario) or _strikes(scenario)


def laws_may_part(scenario: Scenario) -> bool:
    """Whether a box that can turn may be struck with friction: the laws of restitution may differ there."""
    if kind(scenario) is Kind.CORNER:
        return True  # even without friction, so that all cases of a family have the same profiles
    if kind(scenario) is not Kind.FACE or _friction(scenario) == 0:
        return False
    _, other = ball_and_other(scenario)
    return isinstance(other.shape, Box) and not other.immovable


def _over_a_plane(scenario: Scenario) -> Kind | None:
    """One body over one plane that moves as a point does, without turning."""
    movable = [body for body in scenario.bodies if not body.immovable]
    fixed = [body for body in scenario.bodies if body.immovable]
    if len(movable) != 1 or len(fixed) != 1 or not isinstance(fixed[0].shape, HalfSpace):
        return None
    body, normal = movable[0], np.array(fixed[0].shape.normal)
    if any(body.angular_velocity):
        return None
    if isinstance(body.shape, Sphere):
        along = [np.linalg.norm(np.cross(vector, normal)) for vector in (body.velocity, scenario.gravity)]
        return None if max(along) > ROUNDING and _friction(scenario) > 0 else Kind.BOUNCE
    place = np.array([body.position]), np.array([body.orientation])
    gap = geometry.separation(scenario, body.name, fixed[0].name, *place)[0]
    flat = abs(gap) < ROUNDING and _stands_on_a_face(body, normal) and not _may_tip(scenario, body, normal)
    return Kind.SLIDE if flat and _slides_straight(scenario, body, normal) else None


def _driven(scenario: Scenario) -> Kind | None:
    """A box that lies on a level plane, as one that slides does, under pushes that grow, or on one spring."""
    if len(scenario.bodies) != 2 or scenario.attractions or scenario.fluid:
        return None
    if _over_a_plane(scenario) is not Kind.SLIDE:
        return None
    normal = np.array(planes_met(scenario)[0].shape.normal)  # type: ignore[union-attr]
    if float(np.linalg.norm(np.cross(scenario.gravity, normal))) > ROUNDING:
        return None
    if scenario.springs:
        return Kind.SWINGING if not scenario.forces and _swings(scenario, normal) else None
    growing = all(isinstance(push, GrowingForce) for push in scenario.forces)
    along = all(abs(np.dot(push.at(1.0), normal)) < ROUNDING for push in scenario.forces)
    return Kind.PUSHED if growing and along and not any(movable(scenario).velocity) else None


def _swings(scenario: Scenario, normal: Array) -> bool:
    """Whether one spring without a damper swings the box to and fro along one line, on one side of its anchor."""
    body, spring, pair = movable(scenario), scenario.springs[0], scenario.pairs[0]
    at_centre = spring.body_a == body.name and not spring.body_b and not any(spring.point_a)
    if len(scenario.springs) > 1 or not at_centre or spring.damping or pair.static_friction != pair.kinetic_friction:
        return False
    line, velocity = np.subtract(body.position, spring.point_b), np.array(body.velocity)
    length, speed = float(np.linalg.norm(line)), float(np.linalg.norm(velocity))
    aside = max(abs(float(line @ normal)), float(np.linalg.norm(np.cross(velocity, line))))
    if spring.stiffness == 0 or aside > ROUNDING:
        return False
    return bool(
        np.hypot(length - spring.rest_length, speed * np.sqrt(body.mass / spring.stiffness)) < spring.rest_length
    )


def _is_between_planes(scenario: Scenario) -> bool:
    """Whether one ball without weight, friction and spin flies between planes, each of which it collides with."""
    movable = [body for body in scenario.bodies if not body.immovable]
    if len(movable) != 1 or not isinstance(movable[0].shape, Sphere) or any(movable[0].angular_velocity):
        return False
    fixed = [body for body in scenario.bodies if body.immovable]
    listed = {frozenset((pair.body_a, pair.body_b)) for pair in scenario.pairs}
    smooth = not any(pair.static_friction for pair in scenario.pairs)
    only_planes = all(isinstance(body.shape, HalfSpace) for body in fixed)
    meets_all = listed == {frozenset((movable[0].name, body.name)) for body in fixed}
    return only_planes and meets_all and smooth and not any(scenario.gravity)


def _is_orbit(scenario: Scenario) -> bool:
    """Whether two balls attract each other and nothing else acts."""
    others = scenario.forces or scenario.springs or scenario.fluid or any(scenario.gravity)
    alone = scenario.in_flight and len(scenario.bodies) == 2 and len(scenario.attractions) == 1
    return alone and not others


def _is_row(scenario: Scenario) -> bool:
    """Whether all bodies are smooth balls on one line, move along it alone, and collide with their neighbours."""
    balls = scenario.bodies
    if not all(_is_ball(ball) and not ball.immovable for ball in balls):
        return False
    if any(scenario.gravity) or _friction(scenario) > 0:
        return False
    along = np.array(balls[-1].position) - np.array(balls[0].position)
    across = [np.cross(np.subtract(ball.position, balls[0].position), along) for ball in balls]
    across += [np.cross(ball.velocity, along) for ball in balls]
    neighbours = {frozenset((a.name, b.name)) for a, b in pairwise(balls)}
    listed = {frozenset((pair.body_a, pair.body_b)) for pair in scenario.pairs}
    return len(balls) > 2 and float(np.max(np.abs(across))) < ROUNDING and listed == neighbours


def _strikes(scenario: Scenario) -> Kind | None:
    """A ball that flies at another one, at a plane, or straight at a face of a box that does not turn; or a box."""
    ball, other = ball_and_other(scenario)
    pair = scenario.pairs[0]
    if pair.static_friction != pair.kinetic_friction:
        return None
    if isinstance(other.shape, Polyhedron):
        return None
    if not isinstance(ball.shape, Sphere):
        return Kind.CORNER if _flies_at_a_plane(scenario) else None
    if not _is_ball(ball):
        return None
    if isinstance(other.shape, Sphere):
        if not _is_ball(other):
            return None
        one_falls = any(scenario.gravity) and ball.immovable != other.immovable
        return None if one_falls else Kind.BALLS  # seen from either ball, the other flies straight
    if _turns_at_a_ball(scenario, ball, other):
        return Kind.SPINNING
    straight = isinstance(other.shape, HalfSpace) or _straight_at_a_face(scenario, ball, other)
    if not straight:
        return None
    return Kind.THIN_WALL if _is_shot(scenario, ball, other) else Kind.FACE


def _turns_at_a_ball(scenario: Scenario, ball: Body, other: Body) -> bool:
    """Whether a box that turns steadily and a ball that does not, neither with weight or friction, may meet."""
    if not isinstance(other.shape, Box) or other.immovable or ball.immovable or not any(other.angular_velocity):
        return False
    smooth = _friction(scenario) == 0 and not any(ball.angular_velocity) and not any(scenario.gravity)
    return smooth and turns_steadily(other, np.array(other.orientation), np.array(other.angular_velocity))


def _is_shot(scenario: Scenario, ball: Body, other: Body) -> bool:
    """Whether a ball is shot at a fixed box, and nothing but the box will change its velocity."""
    smooth = _friction(scenario) == 0 and not any(ball.angular_velocity) and not any(scenario.gravity)
    return smooth and isinstance(other.shape, Box) and other.immovable and not ball.immovable


def _is_ball(body: Body) -> bool:
    """Whether a body is a sphere whose moments of inertia are equal, so that its spin stays constant in flight."""
    return isinstance(body.shape, Sphere) and len(set(body.moments_of_inertia())) == 1


def _flies_at_a_plane(scenario: Scenario) -> bool:
    """Whether a box without weight, clear of a half-space at the start, keeps its velocity and its spin on the way."""
    box, plane = box_and_plane(scenario)
    if not isinstance(box.shape, Box) or not isinstance(plane.shape, HalfSpace) or box.immovable:
        return False
    free = not any(scenario.gravity) and geometry.gap(plane, box) > 0
    return free and turns_steadily(box, np.array(box.orientation), np.array(box.angular_velocity))


def _straight_at_a_face(scenario: Scenario, ball: Body, box: Body) -> bool:
    """Whether the motion stays in a plane of symmetry of the box: then its spin after the impact stays constant."""
    normal = face_towards(ball, box)
    pull = np.array(scenario.gravity) if ball.immovable != box.immovable else np.zeros(3)
    across = [np.cross(vector, normal) for vector in (np.subtract(ball.velocity, box.velocity), pull)]
    place = np.abs(in_own_axes(box, np.subtract(ball.position, box.position)))
    beyond = place > np.array(box.shape.half_extents)  # type: ignore[union-attr]
    beside = np.sort(place[~beyond])
    over_the_face = beyond.sum() == 1 and beside[0] < ROUNDING
    return over_the_face and not any(box.angular_velocity) and float(np.max(np.abs(across))) < ROUNDING


def _friction(scenario: Scenario) -> float:
    pair = scenario.pairs[0]
    return max(pair.kinetic_friction, pair.static_friction or 0.0)


def _stands_on_a_face(body: Body, normal: Array) -> bool:
    """Whether the normal lies along one of the body's own axes."""
    return bool(np.sort(along_own_axes(body, normal))[1] < ROUNDING)


def _may_tip(scenario: Scenario, body: Body, normal: Array) -> bool:
    """Whether friction could turn a standing box over an edge.

    Friction, at most μ N, acts a height h below the centre. The normal force balances its moment h μ N by moving up to
    μ h ahead, and that must lie within the face whichever way the friction points.
    """
    up, extents = int(np.argmax(along_own_axes(body, normal))), np.array(body.shape.half_extents)  # type: ignore[union-attr]
    return bool(_friction(scenario) * extents[up] > np.delete(extents, up).min())


def _slides_straight(scenario: Scenario, body: Body, normal: Array) -> bool:
    """Whether weight and other forces press the body onto the plane and pull, if at all, along the way that it slides.

    The forces act at the centre, as weight does, and so cannot tip the body either.
    """
    velocity, pushes = np.array(body.velocity), [push.at(0.0) for push in scenario.forces]
    acceleration = np.array(scenario.gravity) + np.sum([*pushes, (0.0, 0.0, 0.0)], axis=0) / body.mass
    pull = acceleration - (acceleration @ normal) * normal
    leaves = abs(velocity @ normal) > ROUNDING or acceleration @ normal > 0
    return not leaves and bool(np.linalg.norm(np.cross(velocity, pull)) < ROUNDING)
