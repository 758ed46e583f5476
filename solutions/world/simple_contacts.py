"""Where balls, boxes and half-spaces touch (slides 2, 9 and 17).

A world is two tuples of arrays, with one entry for each of its n bodies.

    bodies: inverse_mass (n,), moments (n, 3), restitution (n, n),
            friction (n, n), meet (n, n), kind (n,), size (n, 3)
    state:  position (n, 3), orientation (n, 4), velocity (n, 3),
            angular_velocity (n, 3)

The kinds are 0, a ball of the radius size[0]; 1, a box with the half extents
size; and 2, a half-space below a plane through its position with the normal
size, along its own axes. An immovable body has the inverse mass 0 and infinite
moments. Two bodies that do not `meet` go through each other.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.domain import Number, domain, require
from solutions.impulse import rotation_matrix
from solutions.world.boxes import BOX_FACES, BOX_VERTICES
from solutions.world.hidden_places import hidden_places, inside_hulls
from solutions.world.hull_pairs import FEATURES, hull_half_space, hull_hull
from solutions.world.in_flight import ANYWHERE, meet_in_flight
from solutions.world.rotation import turned
from solutions.world.round_pairs import (
    sphere_box,
    sphere_half_space,
    sphere_sphere,
)
from solutions.world.shapes import TOUCH, Placed, Touching

BALL, CUBOID, PLANE = range(3)
"""The kinds of bodies in the lab. In a contact, A has the lower kind."""
SimpleBodies = tuple[Array, Array, Array, Array, Booleans, Integers, Array]
"""inverse_mass, moments, restitution, friction, meet, kind, size."""
SimpleState = tuple[Array, Array, Array, Array]
"""position, orientation, velocity, angular_velocity."""
SimplePlaces = tuple[Integers, Integers, Array, Array, Array]
"""body_a, body_b, point, normal, separation."""
SimpleContacts = tuple[Integers, Integers, Array, Array, Array, Integers]
"""body_a, body_b, point, normal, separation, key."""
Touch = Callable[[Placed, Placed, float], Touching]
TOUCHES: dict[tuple[int, int], Touch] = {
    (BALL, BALL): sphere_sphere,
    (BALL, CUBOID): sphere_box,
    (BALL, PLANE): sphere_half_space,
    (CUBOID, CUBOID): hull_hull,
    (CUBOID, PLANE): hull_half_space,
}
"""The function that finds where two bodies touch, by their kinds."""


def manifolds(
    bodies: SimpleBodies, state: SimpleState, pairs: ArrayLike, margin: float
) -> SimpleContacts:
    """All places at which some pairs of bodies touch, or nearly do.

    Those are left out that no body can reach, because another one is in front,
    such as the side of a box that lies level beside the next one; and those of
    two bodies that approach, but pass each other if they go straight on.

    Parameters
    ----------
    bodies, state : the world
    pairs : (p, 2), numbers of two bodies
    margin : m, the gap up to which two surfaces count as touching

    Returns
    -------
    body_a, body_b : (m,), numbers of the bodies; A has the lower kind
    point : (m, 3), halfway between the two surfaces, m
    normal : (m, 3), unit, from B to A
    separation : (m,), m; negative in overlap
    key : (m,), a number that names the place from one step to the next
    """
    *_, kind, size = bodies
    position, rotation = state[0], rotation_matrix(state[1])
    first, second = np.asarray(pairs, dtype=np.int64).reshape(-1, 2).T
    turn = kind[first] > kind[second]
    first, second = np.where(turn, [second, first], [first, second])
    no_number, no_vector = np.zeros(0, dtype=np.int64), np.zeros((0, 3))
    parts = [(no_number, no_vector, no_vector, np.zeros(0), no_number)]
    for (kind_a, kind_b), touch in TOUCHES.items():
        chosen = np.flatnonzero(
            (kind[first] == kind_a) & (kind[second] == kind_b)
        )
        if len(chosen):
            a = _placed(kind_a, first[chosen], position, rotation, size)
            b = _placed(kind_b, second[chosen], position, rotation, size)
            touching = touch(a, b, margin)
            parts.append((chosen[touching.pair], *touching[1:]))
    pair, point, normal, separation, feature = (
        np.concatenate(arrays) for arrays in zip(*parts, strict=True)
    )
    order = np.argsort(pair, kind="stable")
    one, other = first[pair[order]], second[pair[order]]
    places = one, other, point[order], normal[order], separation[order]
    meets = np.flatnonzero(~_pass(kind, size, state, places))
    order, one, other = order[meets], one[meets], other[meets]
    key = (one * len(kind) + other) * FEATURES + feature[order]
    met = point[order], normal[order], separation[order]

    def inside(number: Integers, at: Array) -> Booleans:
        boxes = _placed(CUBOID, number, position, rotation, size)
        return inside_hulls(boxes, at)

    ab = one, other
    hidden = hidden_places(ab, ab, *met, bodies[0] > 0, kind == CUBOID, inside)
    seen = np.flatnonzero(~hidden)
    point, normal, separation = (array[seen] for array in met)
    return one[seen], other[seen], point, normal, separation, key[seen]


def _pass(
    kind: Integers, size: Array, state: SimpleState, places: SimplePlaces
) -> Booleans:
    """Which places (m,) close, but belong to two bodies that pass each other.

    Both go straight on and keep their spin, up to the touch, or until the
    place has moved as far as the larger of the two is; then forces may decide.
    """
    a, b, point, normal, separation = places
    passes = np.zeros(len(a), dtype=bool)
    apart = np.flatnonzero(separation > TOUCH)
    slip = _apart(state, a[apart], b[apart], point[apart])
    rate = np.vecdot(normal[apart], slip)
    speed = np.linalg.norm(slip, axis=-1)
    closes = rate < 0
    closing, rate, speed = apart[closes], rate[closes], speed[closes]
    extent = np.max(size * (kind != PLANE)[:, None], axis=-1)
    last = np.maximum(extent[a[closing]], extent[b[closing]]) / speed
    for kinds, touch in TOUCHES.items():
        some = np.flatnonzero(
            (kind[a[closing]] == kinds[0]) & (kind[b[closing]] == kinds[1])
        )

        def nearest(
            chosen: Integers,
            now: Array,
            pairs: Integers = closing[some],
            kinds: tuple[int, int] = kinds,
            touch: Touch = touch,
        ) -> tuple[Touching, Array]:
            one, other = np.split(np.arange(2 * len(chosen)), 2)
            bodies = np.concatenate([a[pairs[chosen]], b[pairs[chosen]]])
            flown = _flown(state, bodies, np.tile(now, 2))
            where = flown[0], rotation_matrix(flown[1]), size[bodies]
            touching = touch(
                _placed(kinds[0], one, *where),
                _placed(kinds[1], other, *where),
                ANYWHERE,
            )
            pair, at, along, *_ = touching
            slip = _apart(flown, one[pair], other[pair], at)
            return touching, np.vecdot(along, slip)

        first = -separation[closing[some]] / rate[some]
        touches, near = meet_in_flight(nearest, first, last[some])
        passes[closing[some]] = ~(touches | near)
    return passes


def _apart(
    state: SimpleState, a: Integers, b: Integers, point: Array
) -> Array:
    """Velocity of A's point less that of B's, (m, 3), m/s."""
    position, _, velocity, spin = state
    of_a, of_b = (
        velocity[body] + np.cross(spin[body], point - position[body])
        for body in (a, b)
    )
    return of_a - of_b


def _flown(state: SimpleState, number: Integers, time: Array) -> SimpleState:
    """Bodies after free flights, each of a time (k,), s."""
    position, orientation, velocity, spin = (part[number] for part in state)
    seconds = time[:, None]
    position = position + seconds * velocity
    return position, turned(orientation, seconds * spin), velocity, spin


def _placed(
    kind: int, number: Integers, position: Array, rotation: Array, size: Array
) -> Placed:
    """Bodies of one kind, as the functions of `TOUCHES` take them."""
    at, turn, own = position[number], rotation[number], size[number]
    if kind == CUBOID:
        corners = at[:, None] + (BOX_VERTICES * own[:, None]) @ turn.mT
        return Placed(at, turn, own, corners, BOX_FACES)
    if kind == PLANE:
        # Only the third column of its rotation counts, the normal.
        turn = np.matvec(turn, own)[..., None] * np.array([0.0, 0.0, 1.0])
    corners = np.zeros((len(number), 0, 3))
    return Placed(at, turn, own, corners, np.zeros((0, 3), dtype=np.int64))


@domain
def candidate_pairs(lower: Number, upper: Number) -> Integers:
    """All pairs of boxes along the axes that overlap, each once.

    Parameters
    ----------
    lower, upper : (n, 3), opposite corners of n boxes, m
        A box without an end has infinite corners.

    Returns
    -------
    pairs : (p, 2), numbers of two boxes, from 0, the smaller number first
        The pairs are in ascending order. Boxes that only touch overlap, too.
        (0, 2) where no two boxes overlap.

    Raises
    ------
    ValueError
        If a lower corner is above an upper one, or is not a number.

    Notes
    -----
    Two boxes overlap if their intervals overlap along each of the three axes.
    They do so along one axis if each begins before the other ends:

        lower_i ≤ upper_j    and    lower_j ≤ upper_i

    The second condition is the first with i and j exchanged: the table of all
    pairs and its transpose. This compares n² pairs. `pairs_in_grid` is for
    many boxes: its time grows like n log n.
    """
    require(lower <= upper, "lower must not be above upper")
    begins_before_end = np.all(lower[:, None] <= upper[None], axis=-1)
    return np.argwhere(np.triu(begins_before_end & begins_before_end.T, 1))


def collect_contacts(
    bodies: SimpleBodies,
    state: SimpleState,
    margin: float,
) -> SimpleContacts:
    """The contacts of a world at an instant.

    Parameters
    ----------
    bodies : inverse_mass, moments, restitution, friction, meet, kind, size
    state : position, orientation, velocity, angular_velocity
    margin : m, the gap up to which two surfaces count as touching

    Returns
    -------
    body_a, body_b, point, normal, separation, key
        As `manifolds` gives them, for every pair of bodies that meet, of which
        an impulse can move at least one, and whose surfaces are no farther
        apart than the margin.

    Notes
    -----
    A ball reaches as far as its radius r along every axis. A box with the half
    extents h reaches as far along x as its farthest corner,
    R (±h_1, ±h_2, ±h_3). Each sign may be chosen so that its term is positive.
    So it reaches

        |R_x1| h_1 + |R_x2| h_2 + |R_x3| h_3

    and likewise along y and z: |R| h. A half-space has no end. Each box is
    widened by half the margin, because the gap has one of the two at each end.
    """
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation = state[:2]
    of_kind = kind[:, None]
    of_box = np.matvec(np.abs(rotation_matrix(orientation)), size)
    reach = np.where(of_kind == BALL, size[:, :1], of_box)
    reach = np.where(of_kind == PLANE, np.inf, reach) + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    first, second = pairs.T
    movable = inverse_mass[first] + inverse_mass[second] > 0
    pairs = pairs[movable & meet[first, second]]
    return manifolds(bodies, state, pairs, margin)
