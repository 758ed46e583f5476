"""Which surfaces come to touch within a step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, alike, pieces_of_contacts
from solutions.world.in_flight import ANYWHERE, meet_in_flight
from solutions.world.narrow_phase import PAIRS
from solutions.world.pieces import place_pieces, placed
from solutions.world.rotation import turned
from solutions.world.shapes import TOUCH, Placed, Touching
from solutions.world.vectors import cross


def normal_speeds(
    contacts: Contacts, position: Array, velocity: Array, spin: Array
) -> Array:
    """How fast the points of each contact part, (m,), m/s; as in `speeds`."""
    relative = _relative_velocity(contacts, position, velocity, spin)
    return np.vecdot(contacts.normal, relative)


def _relative_velocity(
    contacts: Contacts, position: Array, velocity: Array, spin: Array
) -> Array:
    """The velocity of A's point less that of B's, (m, 3), m/s."""
    of_a, of_b = (
        velocity[body] + cross(spin[body], contacts.point - position[body])
        for body in (contacts.body_a, contacts.body_b)
    )
    return of_a - of_b


def closing(
    bodies: Bodies,
    state: State,
    contacts: Contacts,
    velocity: Array,
    spin: Array,
    time: Array,
) -> tuple[Booleans, Booleans]:
    """Which contacts close their gap in a free flight, and which touch.

    Parameters
    ----------
    bodies, state : the world
    contacts : m contacts of this state
    velocity, spin : (n, 3), of the bodies, which keep them, m/s and rad/s
    time : (m,), how long the flight is, s

    Returns
    -------
    closes : (m,), whether the gap along the normal is closed by then
    touches : (m,), whether the surfaces have met

    Notes
    -----
    Along its normal a contact with the gap s and the rate u would touch after
    −s/u. This is the whole answer if neither body moves along the surface. If
    one does, a round one may pass the other. Bodies that do not turn are never
    nearer than along the first normal, because the distance of two convex
    bodies that move straight is a convex function of time. So what does not
    close along the normal does not touch at all, and otherwise
    `meet_in_flight` looks.
    """
    closes = contacts.separation <= TOUCH
    if np.all(closes):
        return closes, closes
    apart = np.flatnonzero(~closes)
    near = contacts.in_order(apart)
    gap, time = near.separation, time[apart]
    slip = _relative_velocity(near, state.position, velocity, spin)
    rate = np.vecdot(near.normal, slip)
    slip -= rate[:, None] * near.normal
    closes[apart] = gap + time * rate <= TOUCH
    touches = closes.copy()
    aside = gap * np.sqrt(np.vecdot(slip, slip)) > -TOUCH * rate
    some = np.flatnonzero(closes[apart] & aside)
    if len(some):
        touches[apart[some]] = _touch_in_flight(
            bodies,
            state,
            near.in_order(some),
            (velocity, spin),
            np.minimum(-gap[some] / rate[some], time[some]),
            time[some],
        )
    return closes, touches


def _touch_in_flight(
    bodies: Bodies,
    state: State,
    contacts: Contacts,
    motion: tuple[Array, Array],
    first: Array,
    last: Array,
) -> Booleans:
    """Whether each contact's pieces touch from `first` to `last`, (m,)."""
    touch = np.zeros(len(first), dtype=bool)
    one, other = pieces_of_contacts(bodies, contacts)
    for kinds, some in alike(bodies.pieces, one, other):

        def nearest(
            chosen: Integers,
            now: Array,
            some: Integers = some,
            kinds: tuple[int, int] = kinds,
        ) -> tuple[Touching, Array]:
            a = _flown(bodies, state, one[some[chosen]], motion, now)
            b = _flown(bodies, state, other[some[chosen]], motion, now)
            places = PAIRS[kinds](a.piece, b.piece, ANYWHERE)
            apart = a.velocity_at(places.point, places.pair)
            apart -= b.velocity_at(places.point, places.pair)
            return places, np.vecdot(places.normal, apart)

        touch[some], _ = meet_in_flight(nearest, first[some], last[some])
    return touch


class _Flown(NamedTuple):
    """Pieces, each at its own instant; centre (k, 3) is that of its body."""

    piece: Placed
    centre: Array
    velocity: Array
    spin: Array

    def velocity_at(self, point: Array, chosen: Integers) -> Array:
        """Velocities of points (m, 3) of the chosen pieces (m,), m/s."""
        arm = point - self.centre[chosen]
        return self.velocity[chosen] + cross(self.spin[chosen], arm)


def _flown(
    bodies: Bodies,
    state: State,
    number: Integers,
    motion: tuple[Array, Array],
    time: Array,
) -> _Flown:
    """Pieces (k,) of one kind and hull, each after a free flight, s."""
    every = np.arange(len(number))
    body = bodies.pieces.body[number]
    seconds = time[:, None]
    velocity, spin = (of_all[body] for of_all in motion)
    centre = state.position[body] + seconds * velocity
    orientation = turned(state.orientation[body], seconds * spin)
    own = bodies.pieces.rows(number)._replace(body=every)
    places = place_pieces(own, centre, orientation)
    return _Flown(placed(own, every, *places), centre, velocity, spin)
