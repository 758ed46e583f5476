"""Places of contact that no body can reach: a neighbour is in front of them.

Two boxes lie side by side and make one level floor. A slab that lies on the
first of them has sunk into it a little, by less than a step falls. So it
overlaps the second one, too, at the upper edge of its side, and the shortest
way out is back. But nothing could come there from outside: where the slab lies
on the first box, it is above the side of the second one.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.hulls import hull_of
from solutions.world.shapes import TOUCH, Placed

SAME_WAY = 1e-12
"""Squared sine of the angle between two normals that count as the same."""
Inside = Callable[[Integers, Array], Booleans]
"""Whether points (k, 3) are in pieces (k,), on their surface included."""


def inside_hulls(piece: Placed, point: Array) -> Booleans:
    """Whether each point (k, 3) is in its box or polyhedron, or on it."""
    hull = hull_of(piece)
    height = np.matvec(hull.normal, point) - hull.offset
    return np.max(height, axis=1) <= TOUCH


def hidden_places(
    body: tuple[Integers, Integers],
    piece: tuple[Integers, Integers],
    point: Array,
    normal: Array,
    separation: Array,
    movable: Booleans,
    has_corners: Booleans,
    inside: Inside,
) -> Booleans:
    """Which places of contact (m,) no body can reach.

    Parameters
    ----------
    body : (m,) twice, the bodies A and B of each place
    piece : (m,) twice, their pieces; places of two pieces follow one another
    point : (m, 3), halfway between the two surfaces, m
    normal : (m, 3), unit, from B to A
    separation : (m,), m
    movable : (n,), which bodies an impulse moves
    has_corners : (p,), which pieces are boxes or polyhedra
    inside : whether points are in such pieces

    Notes
    -----
    Take a convex piece X that touches Y with the normal n at a place p of Y's
    surface, and that touches Z with the normal n' at a place p' of Z's
    surface. Z keeps X above the plane through p' across n', because X is
    convex. Another piece of the same body may be below it. X cannot reach p if

        n'·(p − p') ≤ 0         p is not above this plane, and
        p + λ t is not in Y     Y does not go on above the plane

    Here t = n' − (n'·n) n is the way along Y's surface that leads out of the
    plane. The second condition keeps the floor Y in front of a wall Z, where a
    body stands in the corner: the floor goes on in front of the wall. It does
    not keep the side of a box Y that ends where its level neighbour Z ends.

    Two pieces touch with one normal. If some of their places can be reached,
    all of them stay: a body strikes a step with the whole part of its face
    that is in front of the step, however deep it has sunk into the floor.
    """
    count = len(separation)
    if not count or np.all(np.vecdot(normal, normal[0]) ** 2 > 1 - SAME_WAY):
        return np.zeros(count, dtype=bool)
    x, y = np.concatenate(piece), np.concatenate(piece[::-1])
    way = np.concatenate([normal, -normal])
    half = np.tile(separation, 2)[:, None] / 2
    place = np.concatenate([point, point]) - way * half
    body_x, body_y = np.concatenate(body), np.concatenate(body[::-1])
    of, by = _neighbours(x, y, body_x, body_y, way, movable, has_corners)
    is_hidden = np.zeros(2 * count, dtype=bool)
    if not len(of):
        return is_hidden[:count]
    height = np.vecdot(way[by], place[of] - place[by])
    out = way[by] - np.vecdot(way[by], way[of])[:, None] * way[of]
    steep = np.vecdot(out, out)
    below = np.flatnonzero((height <= TOUCH) & (steep > SAME_WAY))
    of, by = of[below], by[below]
    if not len(of):
        return is_hidden[:count]
    share = (2 * TOUCH - height[below]) / steep[below]
    above = place[of] + share[:, None] * out[below]
    is_hidden[of[~inside(y[of], above)]] = True
    hidden = is_hidden[:count] | is_hidden[count:]
    return hidden & _all_of_each(hidden, *piece)


def _neighbours(
    x: Integers,
    y: Integers,
    body_x: Integers,
    body_y: Integers,
    way: Array,
    movable: Booleans,
    has_corners: Booleans,
) -> tuple[Integers, Integers]:
    """Places (k,) where X touches and that may be hidden, and others of X.

    The two are on other pieces. What cannot move is lifted out of nothing,
    and so two pieces hide places from it only if they are of one body.
    """
    none = np.zeros(0, dtype=np.int64)
    if not np.any(has_corners[y]):
        return none, none
    pieces, bodies = len(has_corners), len(movable)
    group = np.where(movable[body_x], x, pieces + bodies * x + body_y)
    order = np.argsort(group, kind="stable")
    starts = np.flatnonzero(np.diff(group[order], prepend=-1))
    size = np.diff(starts, append=len(order))
    turned = np.vecdot(way[order], np.repeat(way[order[starts]], size, axis=0))
    bent = np.logical_or.reduceat(1 - turned**2 > SAME_WAY, starts)
    if not np.any(bent):
        return none, none
    some = np.repeat(bent, size) & has_corners[y[order]]
    begin, length = np.repeat(starts, size)[some], np.repeat(size, size)[some]
    of = np.repeat(order[some], length)
    within = np.arange(len(of)) - np.repeat(np.cumsum(length) - length, length)
    by = order[np.repeat(begin, length) + within]
    other = y[of] != y[by]
    return of[other], by[other]


def _all_of_each(
    chosen: Booleans, piece_a: Integers, piece_b: Integers
) -> Booleans:
    """Whether all places of the same two pieces are chosen, (m,)."""
    new = np.ones(len(chosen), dtype=bool)
    new[1:] = (np.diff(piece_a) != 0) | (np.diff(piece_b) != 0)
    starts = np.flatnonzero(new)
    of_each = np.logical_and.reduceat(chosen, starts)
    return np.repeat(of_each, np.diff(starts, append=len(chosen)))
