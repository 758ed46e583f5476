"""Which contacts of a ball the hand-written world makes: those that the ball can reach in the step."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.prediction.bodies import Bodies, State, matrix
from reference.prediction.laws import TOUCHING, World
from reference.prediction.touching import Meeting, Touch, touch
from reference.scene import geometry
from reference.scene.scenario import Box

LOOKS = 40
"""How often a gap is looked at again while it closes."""
PARALLEL = 1e-12
"""Squared sine of the angle between two normals that are one."""


def is_reached(
    bodies: Bodies,
    state: State,
    own: tuple[Meeting, Touch],
    near: list[tuple[Meeting, Touch]],
    law: World,
    carried: bool,
) -> bool:
    """Whether the hand-written world makes this contact in a step.

    near: all that the bodies may touch. carried: whether the contact had an impulse in the last step.
    """
    meeting, touched = own
    if is_hidden(bodies, state, own, near):
        return False
    if touched.gap <= TOUCHING:
        return True
    gained = bodies.weight * law.dt
    fall = float(touched.normal @ (gained[meeting.ball] - gained[meeting.other]))
    rebounds = law.rebound(rate_of(state, meeting, touched), fall) > 0
    if carried and not rebounds:
        return True
    free = state._replace(velocity=state.velocity + gained)
    return not passes(bodies, free, meeting, law.dt / 2 if rebounds else law.dt)


def passes(bodies: Bodies, state: State, meeting: Meeting, time: float) -> bool:
    """Whether a ball would close its gap along the normal in this time, and yet flies by.

    state: with the velocities that the forces of the step leave. The distance is a convex function of time as long as
    nothing turns. So a line that touches its graph leads to an instant before the touch, and from there the next one.
    """
    passed, first = 0.0, True
    for _ in range(LOOKS):
        then = _flown(state, passed)
        there = touch(bodies, then, meeting)
        rate = rate_of(then, meeting, there)
        if first and there.gap + time * rate > TOUCHING:
            return False
        if there.gap <= TOUCHING:
            return False
        if rate >= 0:
            return True
        passed -= there.gap / rate
        if first:
            passed, first = min(passed, time), False
        if passed > time:
            return True
    return True


def _flown(state: State, time: float) -> State:
    orientation = geometry.turned(state.orientation, state.spin * time) if state.spin.any() else state.orientation
    return state._replace(position=state.position + state.velocity * time, orientation=orientation)


def rate_of(state: State, meeting: Meeting, touched: Touch) -> float:
    """How fast the gap grows, m/s."""
    point = (touched.on_ball + touched.on_other) / 2
    of_ball, of_other = (
        state.velocity[place] + np.cross(state.spin[place], point - state.position[place])
        for place in (meeting.ball, meeting.other)
    )
    return float(touched.normal @ (of_ball - of_other))


def is_hidden(bodies: Bodies, state: State, own: tuple[Meeting, Touch], others: list[tuple[Meeting, Touch]]) -> bool:
    """Whether a ball would touch a box at a place of which another contact of the ball keeps it clear.

    The other contact keeps the ball above a plane. The place is in the plane or below it, and on the way along the
    box's surface out of the plane the box ends.
    """
    meeting, touched = own
    if not isinstance(bodies.shapes[meeting.other], Box) or bodies.inverse_mass[meeting.ball] == 0:
        return False
    for met, other in others:
        if met.ball != meeting.ball or met.other == meeting.other:
            continue
        height = float(other.normal @ (touched.on_other - other.on_other))
        out = other.normal - (other.normal @ touched.normal) * touched.normal
        steep = float(out @ out)
        if height <= TOUCHING and steep > PARALLEL:
            above = touched.on_other + (2 * TOUCHING - height) / steep * out
            if not _is_inside(bodies, state, meeting.other, above):
                return True
    return False


def _is_inside(bodies: Bodies, state: State, box: int, point: Array) -> bool:
    own = (point - state.position[box]) @ matrix(state.orientation[box])
    return bool(np.all(np.abs(own) <= np.array(bodies.shapes[box].half_extents) + TOUCHING))  # type: ignore[union-attr]
