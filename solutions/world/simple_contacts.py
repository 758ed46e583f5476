"""Where balls, boxes and half-spaces touch, in plain arrays (slides 2, 9 and 17).

A world is two tuples of arrays, with one entry for each of its n bodies.

    bodies: inverse_mass (n,), moments (n, 3), restitution (n, n), friction (n,
    n),
            meet (n, n), kind (n,), size (n, 3)
    state:  position (n, 3), orientation (n, 4), velocity (n, 3),
            angular_velocity (n, 3)

The kinds are 0, a ball of the radius size[0]; 1, a box with the half extents
size; and 2, a half-space below a plane through its position with the normal
size, along its own axes. An immovable body has the inverse mass 0 and infinite
moments. Two bodies that do not `meet` go through each other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.impulse import rotation_matrix
from solutions.world.boxes import BOX_FACES, BOX_VERTICES
from solutions.world.hidden_places import hidden_places, inside_hulls
from solutions.world.hull_pairs import FEATURES, hull_half_space, hull_hull
from solutions.world.round_pairs import (
    sphere_box,
    sphere_half_space,
    sphere_sphere,
)
from solutions.world.shapes import Placed

BALL, CUBOID, PLANE = range(3)
"""The kinds of bodies in the lab. In a contact, A has the lower kind."""
SimpleBodies = tuple[Array, Array, Array, Array, Booleans, Integers, Array]
"""inverse_mass, moments, restitution, friction, meet, kind, size."""
SimpleState = tuple[Array, Array, Array, Array]
"""position, orientation, velocity, angular_velocity."""
SimpleContacts = tuple[Integers, Integers, Array, Array, Array, Integers]
"""body_a, body_b, point, normal, separation, key."""
NEAR = 1e-9
"""Share of two radii by which balls may miss and yet touch; positions of a few
metres round by 1e-15 m, and what rests overlaps by more.
"""
TOUCHES = {
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
    such as the side of a box that lies level beside the next one; and a ball
    that approaches another one or a box, but passes it if both go straight on.

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
    first, second = (
        np.where(turn, second, first),
        np.where(turn, first, second),
    )
    none = (
        np.zeros(0, dtype=np.int64),
        np.zeros((0, 3)),
        np.zeros((0, 3)),
        np.zeros(0),
        np.zeros(0, dtype=np.int64),
    )
    found = [none]
    for kinds, touch in TOUCHES.items():
        chosen = np.flatnonzero(
            (kind[first] == kinds[0]) & (kind[second] == kinds[1])
        )
        if len(chosen):
            a = _placed(kinds[0], first[chosen], position, rotation, size)
            b = _placed(kinds[1], second[chosen], position, rotation, size)
            touching = touch(a, b, margin)
            found.append((chosen[touching.pair], *touching[1:]))
    pair, point, normal, separation, feature = (
        np.concatenate(parts) for parts in zip(*found, strict=True)
    )
    order = np.argsort(pair, kind="stable")
    a, b = first[pair[order]], second[pair[order]]
    meets = ~_pass(kind, size, state, rotation, a, b)
    order, a, b = order[meets], a[meets], b[meets]
    key = (a * len(kind) + b) * FEATURES + feature[order]
    places = point[order], normal[order], separation[order]

    def inside(number: Integers, at: Array) -> Booleans:
        return inside_hulls(
            _placed(CUBOID, number, position, rotation, size), at
        )

    hidden = hidden_places(
        (a, b), (a, b), *places, bodies[0] > 0, kind == CUBOID, inside
    )
    seen = np.flatnonzero(~hidden)
    point, normal, separation = (each[seen] for each in places)
    return a[seen], b[seen], point, normal, separation, key[seen]


def _pass(
    kind: Integers,
    size: Array,
    state: SimpleState,
    rotation: Array,
    a: Integers,
    b: Integers,
) -> Booleans:
    """Which two bodies (m,) approach, and pass each other: A, a ball.

    Its centre is at x from the nearest place of B, which is the centre of a
    ball, a corner of a box, or a place on an edge or a face. There only what
    leads away from this edge or face counts of the relative velocity w. They
    are nearest after t = −x·w/w². They may miss by the share `NEAR`, so that
    rounding separates none.
    """
    position, _, velocity, spin = state
    box = (kind[b] == CUBOID)[:, None]
    own, half = np.where(box[..., None], rotation[b], np.eye(3)), size[b] * box
    x = np.vecmat(position[a] - position[b], own)
    place = np.clip(x, -half, half)
    turning = np.cross(spin[b], np.matvec(own, place))
    w = np.vecmat(velocity[a] - velocity[b] - turning, own)
    x, w = x - place, np.where(box & (place == x), 0.0, w)
    approach, squared = -np.vecdot(x, w), np.vecdot(w, w)
    nearest = x + w * (approach / np.where(squared > 0, squared, 1.0))[:, None]
    apart = (1 + NEAR) * (size[a, 0] + np.where(box[:, 0], 0.0, size[b, 0]))
    misses = np.vecdot(nearest, nearest) > apart**2
    no_plane = (kind[a] == BALL) & (kind[b] != PLANE)
    return np.asarray(no_plane & (approach > 0) & misses)


def _placed(
    kind: int, number: Integers, position: Array, rotation: Array, size: Array
) -> Placed:
    """Bodies of one kind, as the functions of `TOUCHES` take them."""
    at, turn, own = position[number], rotation[number], size[number]
    corners, faces = (
        np.zeros((len(number), 0, 3)),
        np.zeros((0, 3), dtype=np.int64),
    )
    if kind == CUBOID:
        corners, faces = (
            at[:, None] + (BOX_VERTICES * own[:, None]) @ turn.mT,
            BOX_FACES,
        )
    elif (
        kind == PLANE
    ):  # only the third column of its rotation counts, the normal
        turn = np.matvec(turn, own)[..., None] * np.array([0.0, 0.0, 1.0])
    return Placed(at, turn, own, corners, faces)


def candidate_pairs(lower: ArrayLike, upper: ArrayLike) -> Integers:
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
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("lower must not be above upper")
    begins_before_end = np.all(low[:, None] <= high[None], axis=-1)
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
    extents h reaches as far along x as its farthest corner, R (±h_1, ±h_2,
    ±h_3). Each sign may be chosen so that its term is positive. So it reaches

        |R_x1| h_1 + |R_x2| h_2 + |R_x3| h_3

    and likewise along y and z: |R| h. A half-space has no end. Each box is
    widened by half the margin, because the gap has one of the two at each end.
    """
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation = state[:2]
    of_kind = kind[:, None]
    reach = np.where(
        of_kind == BALL,
        size[:, :1],
        np.matvec(np.abs(rotation_matrix(orientation)), size),
    )
    reach = np.where(of_kind == PLANE, np.inf, reach) + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    first, second = pairs.T
    movable = inverse_mass[first] + inverse_mass[second] > 0
    return manifolds(
        bodies, state, pairs[movable & meet[first, second]], margin
    )
