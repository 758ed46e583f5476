"""One contact of a ball in one step: where the impulses act, the plane in which they lie, and what they change."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from reference.arrays import Array
from reference.engines.base import BULLET, BULLET_SPRING, DART, RESPOND_THEN_STEP, Method
from reference.impact_truth import Contact
from reference.prediction.axes import darts_axes
from reference.prediction.bodies import Bodies, State
from reference.prediction.impulses import Met, noslip_gives_up
from reference.prediction.touching import Meeting, Touch
from reference.scene.scenario import Sphere
from reference.scene.settings import Settings

OWN, DEEPEST, FLAT, MIDWAY = "each on its own surface", "deepest of the ball", "on what is flat", "midway"
"""Where a method lets the impulse of an overlap act."""
ASIDE = 1e-9
"""A contact is in a plane if an impulse in that plane moves the bodies aside of it by no larger share than this."""


class NoRule(Exception):
    """A contact that the rules do not cover: an impulse aside of the plane of its normal and its slip, say."""


class Both:
    """The two bodies of a contact: the arms to it, and what impulses do there."""

    def __init__(
        self, bodies: Bodies, state: State, meeting: Meeting, touched: Touch, points: str, felt: float = 0.0
    ) -> None:
        """felt: for how long weight acts before friction looks where the surfaces slip, s."""
        self.bodies, self.meeting, self.touched = bodies, meeting, touched
        at_ball, at_other = _points(touched, isinstance(bodies.shapes[meeting.other], Sphere), points)
        self.sides = [
            (place, point - state.position[place], bodies.inverse_inertia(state, place), sign)
            for place, point, sign in ((meeting.ball, at_ball, 1.0), (meeting.other, at_other, -1.0))
        ]
        self.velocity = sum(
            sign * (state.velocity[place] + cross(state.spin[place], arm)) for place, arm, _, sign in self.sides
        )
        falling = felt * (bodies.weight[meeting.ball] - bodies.weight[meeting.other])
        normal, along = self.touched.normal, self._along(self.velocity + falling)
        self.along = along
        self.inverse_masses = self.k(along, along), self.k(along, normal), self.k(normal, normal)
        """K along t, from n to t, and along n, 1/kg."""
        self.before = np.array([self.velocity @ along, self.velocity @ normal])
        """Velocity of the contact along t and n before the step, m/s."""

    def k(self, one: Array, other: Array) -> float:
        """What a unit impulse along a direction changes of the velocity along another one, 1/kg."""
        found = float(one @ other) * self.inverse_mass
        return found + sum(float(cross(arm, other) @ inertia @ cross(arm, one)) for _, arm, inertia, _ in self.sides)

    @cached_property
    def inverse_mass(self) -> float:
        """Sum of the inverse masses, 1/kg."""
        return float(sum(self.bodies.inverse_mass[place] for place, *_ in self.sides))

    def _along(self, velocity: Array) -> Array:
        """Unit vector along the slip of a velocity, or where the normal impulse starts one, (3,)."""
        normal = self.touched.normal
        starts = sum(cross(inertia @ cross(arm, normal), arm) for _, arm, inertia, _ in self.sides)
        for way in (velocity, starts, np.eye(3)[np.argmin(np.abs(normal))]):
            slip = way - (way @ normal) * normal
            size = float(np.sqrt(slip @ slip))
            if size > ASIDE:
                along = slip / size
                break
        aside = cross(normal, along)
        if max(abs(self.k(along, aside)), abs(self.k(normal, aside))) > ASIDE * self.k(normal, normal):
            raise NoRule
        return np.asarray(along)

    def noslip_gives_up(self) -> bool:
        """Whether MuJoCo's noslip passes make no friction here."""
        way = cross(self.touched.normal, self.along)
        return noslip_gives_up(self.inverse_masses[0], self.k(way, way), self.meeting.pair.kinetic_friction)

    def aside(self, change: Array) -> float:
        """What changes of velocity and spin of all bodies, (bodies, 2, 3), make of the slip aside of t, m/s."""
        way = cross(self.touched.normal, self.along)
        return sum(
            sign * float(way @ (change[place, 0] + cross(change[place, 1], arm))) for place, arm, _, sign in self.sides
        )

    def rows(self) -> Array:
        """By which numbers velocity and spin of all bodies make the velocities along t and n, (2, bodies, 2, 3)."""
        return self._of_directions(lambda place, arm, inertia, way: (way, cross(arm, way)))

    def effects(self) -> Array:
        """What unit impulses along t and n change of velocity and spin of all bodies, (2, bodies, 2, 3)."""
        masses = self.bodies.inverse_mass
        return self._of_directions(lambda place, arm, inertia, way: (masses[place] * way, inertia @ cross(arm, way)))

    def _of_directions(self, of: Callable[[int, Array, Array, Array], tuple[Array, Array]]) -> Array:
        found = np.zeros((2, len(self.bodies.inverse_mass), 2, 3))
        for number, way in enumerate((self.along, self.touched.normal)):
            for place, arm, inertia, sign in self.sides:
                found[number, place] = of(place, arm, inertia, sign * way)
        return found

    def met(self, weight: Array, others: Array) -> Met:
        """The contact at the start of a step in which weight and other contacts add to its velocities, (2,) each."""
        (along, across), (by_others, by_others_across) = weight.tolist(), others.tolist()
        return Met(self._contact, self.touched.gap, (along, across), (by_others, by_others_across), self.inverse_mass)

    @cached_property
    def _contact(self) -> Contact:
        """The contact at the start of the step, of which every sweep of the step asks."""
        slip, rate = self.before.tolist()
        return Contact(*self.inverse_masses, slip, rate, self.meeting.pair.kinetic_friction)


def points_of(settings: Settings, method: Method) -> str:
    """Where a method lets impulses act; DART leaves it to its detector, which by default is FCL."""
    if method.rule == DART and settings.options.get("detector") == "dart":
        return FLAT
    return {BULLET: OWN, BULLET_SPRING: OWN, RESPOND_THEN_STEP: DEEPEST}.get(method.rule, MIDWAY)


def _points(touched: Touch, balls: bool, points: str) -> tuple[Array, Array]:
    """The points of the ball and of the other body on which an impulse acts, (3,) each. Two balls have nothing flat."""
    if points == OWN:
        return touched.on_ball, touched.on_other
    if points == DEEPEST:
        return touched.on_ball, touched.on_ball
    if points == FLAT and not balls:
        return touched.on_other, touched.on_other
    middle = (touched.on_ball + touched.on_other) / 2
    return middle, middle


def along_its_base(both: Both) -> bool:
    """Whether a slip is along an axis of DART's stock pyramid."""
    share = abs(float(darts_axes(both.touched.normal)[0] @ both.along))
    return min(share, abs(1 - share)) < ASIDE


def cross(a: Array, b: Array) -> Array:
    """Product a × b of two vectors (3,); NumPy's own takes ten times as long."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
