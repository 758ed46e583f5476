"""Where a ball touches another ball, a plane or a box, with the true geometry of one instant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.prediction.bodies import Bodies, State, matrix
from reference.scene import geometry
from reference.scene.scenario import Box, HalfSpace, Pair, Sphere


@dataclass(frozen=True)
class Meeting:
    """A pair that may touch: a ball, A, and another ball, a plane or a box, B, by their places among the bodies."""

    ball: int
    other: int
    pair: Pair


@dataclass(frozen=True)
class Touch:
    """How the two of a pair lie. gap: m, negative in overlap. normal: unit, from B to A.

    on_ball: the point of the ball's surface that is nearest to B or deepest inside it. on_other: the nearest point of
    B's surface. Both (3,), m.
    """

    gap: float
    normal: Array
    on_ball: Array
    on_other: Array


def meetings(bodies: Bodies) -> list[Meeting] | None:
    """The pairs of a scenario, a ball first in each; None where a pair has no ball.

    Of two balls the one that the scenario has first is A: hand-written code lets the impulse act on its surface.
    """
    found = []
    for pair in bodies.scenario.pairs:
        first, second = sorted(bodies.scenario.index(name) for name in (pair.body_a, pair.body_b))
        if not isinstance(bodies.shapes[first], Sphere):
            first, second = second, first
        if not isinstance(bodies.shapes[first], Sphere):
            return None
        found.append(Meeting(first, second, pair))
    return found


def touch(bodies: Bodies, state: State, meeting: Meeting) -> Touch:
    """Gap, normal and points of a pair; a box with the ball's centre inside it pushes it out of the nearest face."""
    ball, shape = bodies.shapes[meeting.ball], bodies.shapes[meeting.other]
    assert isinstance(ball, Sphere)
    centre, place = state.position[meeting.ball], state.position[meeting.other]
    between = centre - place
    if isinstance(shape, Sphere):
        distance = float(np.sqrt(between @ between))
        normal, reach = between / distance, shape.radius
        nearest = place + reach * normal
        distance -= reach
    elif isinstance(shape, HalfSpace):
        normal = np.array(shape.normal)
        distance = float(between @ normal)
        nearest = centre - distance * normal
    else:
        assert isinstance(shape, Box)
        axes, half = matrix(state.orientation[meeting.other]), np.array(shape.half_extents)
        own = between @ axes
        closest = np.clip(own, -half, half)
        distance = float(np.sqrt((own - closest) @ (own - closest)))
        if distance > 0:
            normal = axes @ ((own - closest) / distance)
        else:
            face = int(np.argmax(np.abs(own) - half))
            side = 1.0 if own[face] > 0 else -1.0
            closest[face], distance = side * half[face], float(abs(own[face]) - half[face])
            normal = side * axes[:, face]
        nearest = place + axes @ closest
    return Touch(distance - ball.radius, normal, centre - ball.radius * normal, nearest)


def gaps(bodies: Bodies, positions: Array, orientations: Array, meeting: Meeting) -> Array:
    """The gap of a pair at many instants, (n,), m. positions, orientations: of all bodies, (n, bodies, 3 and 4)."""
    ball, shape = bodies.shapes[meeting.ball], bodies.shapes[meeting.other]
    assert isinstance(ball, Sphere)
    between = positions[:, meeting.ball] - positions[:, meeting.other]
    if isinstance(shape, Sphere):
        return np.asarray(np.linalg.norm(between, axis=1) - shape.radius - ball.radius)
    if isinstance(shape, HalfSpace):
        return np.asarray(between @ np.array(shape.normal) - ball.radius)
    assert isinstance(shape, Box)
    outside = geometry.out_of_box(between, orientations[:, meeting.other], np.array(shape.half_extents))
    return np.asarray(outside - ball.radius)
