"""Where bodies touch: the contacts of an instant (slides 2, 9 and 17)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.bodies import Bodies, State
from solutions.world.broad_phase import pairs_in_grid
from solutions.world.hidden_places import hidden_places, inside_hulls
from solutions.world.hull_pairs import FEATURES
from solutions.world.narrow_phase import PAIRS
from solutions.world.pieces import (
    Pieces,
    bounding_boxes,
    place_pieces,
    placed,
)
from solutions.world.shapes import Touching


class Contacts(NamedTuple):
    """All m contacts of an instant, in an order that repeats bit for bit.

    Attributes
    ----------
    body_a, body_b : (m,), numbers of the bodies
    point : (m, 3), halfway between the two surfaces, m
    normal : (m, 3), unit, from B to A
    separation : (m,), m; negative in overlap
    key : (m,), names the two features that touch, from one step to the next
    """

    body_a: Integers
    body_b: Integers
    point: Array
    normal: Array
    separation: Array
    key: Integers

    def in_order(self, order: Integers) -> Contacts:
        """Some of the contacts, or all of them in another order."""
        return Contacts(
            self.body_a[order],
            self.body_b[order],
            self.point[order],
            self.normal[order],
            self.separation[order],
            self.key[order],
        )


def find_contacts(
    bodies: Bodies, state: State, margin: float = 0.0
) -> Contacts:
    """The contacts of a world at an instant: broad phase, then narrow phase.

    Parameters
    ----------
    bodies, state : the world
    margin : a gap up to which two surfaces count as a contact, m

    Returns
    -------
    Contacts

    Notes
    -----
    The broad phase finds the pieces whose boxes along the axes overlap. Pairs
    that cannot collide are left out: pieces of one body, two immovable bodies,
    materials that do not collide. The narrow phase has one function for each
    two kinds of pieces. It takes all pairs of those kinds at once, because a
    function of a batch costs little more than that of one pair. At last those
    are left out that no body can reach, because a neighbour is in front.
    """
    pieces = bodies.pieces
    places = place_pieces(pieces, state.position, state.orientation)
    lower, upper = bounding_boxes(pieces, *places)
    pairs = pairs_in_grid(
        lower - margin / 2, upper + margin / 2, bodies.group[pieces.body]
    )
    first, second = _can_collide(bodies, pairs)
    parts = []
    for kinds, chosen in alike(pieces, first, second):
        a = placed(pieces, first[chosen], *places)
        b = placed(pieces, second[chosen], *places)
        touching = PAIRS[kinds](a, b, margin)
        parts.append(touching._replace(pair=chosen[touching.pair]))
    contacts = _contacts(bodies, first, second, parts)
    hidden = _hidden(bodies, contacts, places)
    if not np.any(hidden):
        return contacts
    return contacts.in_order(np.flatnonzero(~hidden))


def pieces_of_contacts(
    bodies: Bodies, contacts: Contacts
) -> tuple[Integers, Integers]:
    """The convex pieces of A and of B that touch at each contact, (m,)."""
    a, b = np.divmod(contacts.key // FEATURES, len(bodies.pieces.body))
    return a, b


def _hidden(
    bodies: Bodies, contacts: Contacts, places: tuple[Array, Array]
) -> Booleans:
    """Which contacts no body can reach; see `hidden_places`."""
    pieces = bodies.pieces

    def inside(number: Integers, point: Array) -> Booleans:
        is_inside = np.zeros(len(number), dtype=bool)
        for hull in np.unique(pieces.hull[number]):
            some = np.flatnonzero(pieces.hull[number] == hull)
            piece = placed(pieces, number[some], *places)
            is_inside[some] = inside_hulls(piece, point[some])
        return is_inside

    return hidden_places(
        (contacts.body_a, contacts.body_b),
        pieces_of_contacts(bodies, contacts),
        contacts.point,
        contacts.normal,
        contacts.separation,
        bodies.inverse_mass > 0,
        pieces.hull >= 0,
        inside,
    )


def _can_collide(bodies: Bodies, pairs: Integers) -> tuple[Integers, Integers]:
    """The pieces A and B of pairs that can collide; A has the lower kind."""
    first, second = pairs[:, 0], pairs[:, 1]
    a, b = bodies.pieces.body[first], bodies.pieces.body[second]
    movable = bodies.inverse_mass[a] + bodies.inverse_mass[b] > 0
    meet = bodies.surfaces.collide[bodies.material[a], bodies.material[b]]
    kept = (a != b) & movable & meet
    first, second = first[kept], second[kept]
    turn = bodies.pieces.kind[first] > bodies.pieces.kind[second]
    return np.where(turn, second, first), np.where(turn, first, second)


def alike(
    pieces: Pieces, first: Integers, second: Integers
) -> list[tuple[tuple[int, int], Integers]]:
    """Kinds of A and B, and the numbers of all pairs alike."""
    kind, hull = pieces.kind, pieces.hull
    most = len(pieces.hulls) + 1
    sign_a = kind[first] * most + hull[first] + 1
    signs = (sign_a * 8 + kind[second]) * most + hull[second] + 1
    groups = [np.flatnonzero(signs == sign) for sign in np.unique(signs)]
    return [
        ((int(kind[first[group[0]]]), int(kind[second[group[0]]])), group)
        for group in groups
    ]


def _contacts(
    bodies: Bodies, first: Integers, second: Integers, parts: list[Touching]
) -> Contacts:
    """All places in touch, pair by pair in the order of the broad phase."""
    if not parts:
        none, no_vectors = np.zeros(0, dtype=np.int64), np.zeros((0, 3))
        return Contacts(none, none, no_vectors, no_vectors, np.zeros(0), none)
    pair, point, normal, separation, feature = (
        np.concatenate(arrays) for arrays in zip(*parts, strict=True)
    )
    a, b = first[pair], second[pair]
    key = (a * len(bodies.pieces.body) + b) * FEATURES + feature
    contacts = Contacts(
        bodies.pieces.body[a],
        bodies.pieces.body[b],
        point,
        normal,
        separation,
        key,
    )
    return contacts.in_order(np.argsort(pair, kind="stable"))
