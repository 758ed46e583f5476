"""Where capsules, or spheres, which have no length, touch hulls."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans
from solutions.world.clipping import ON_SIDE, behind_sides, clip
from solutions.world.edge_contacts import EDGES_PARALLEL
from solutions.world.hull_pairs import BIAS
from solutions.world.hulls import Hull, hull_of
from solutions.world.segments import ends_of, nearest_on_segments
from solutions.world.shapes import Placed, Touching
from solutions.world.vectors import cross

ON_SURFACE = 1e-9
"""Share of a hull's size up to which a core is on its surface.

The way from the hull to the core then gives no direction.
"""


class Nearest(NamedTuple):
    """One place of each pair.

    Attributes
    ----------
    distance : (n,), of the core in front of the hull, m
        It is negative if the core goes into the hull.
    normal : (n, 3), unit, from the hull to the core
    core : (n, 3), the place on the core, m
    """

    distance: Array
    normal: Array
    core: Array


def capsule_hull(a: Placed, b: Placed, margin: float) -> Touching:
    """Where capsules, or spheres, touch boxes or polyhedra.

    The features 0 and 1 are the ends of the part of a core that is over a
    face, in the sense of the capsule's axis. Where the core is nearest to an
    edge or a vertex, that place is feature 2.

    Notes
    -----
    A core that is outside has a nearest place. The core of a capsule that lies
    on a face has many of them. A face counts as nearest if no part of the core
    is less in front of it than the core is away from the hull, and if a place
    over the face is no farther away; both except for `BIAS`. Then the part of
    the core over the face touches with both of its ends.

    A core that goes into the hull leaves it by the shortest way. It is across
    a face, or across the core and an edge.
    """
    hull, ends = hull_of(b), ends_of(a)
    radius = a.size[:, 0]
    heights = ends @ hull.normal.mT - hull.offset[:, None]
    lowest = np.min(heights, axis=1)
    pair = np.flatnonzero(np.max(lowest, axis=1) - radius <= margin)
    hull, ends, radius = hull.rows(pair), ends[pair], radius[pair]
    heights, lowest = heights[pair], lowest[pair]
    way = ends[:, 1] - ends[:, 0]

    # The place of the core that is nearest to the hull, or deepest in it
    row = np.arange(len(pair))
    face, over = np.argmax(lowest, axis=1), np.max(lowest, axis=1)
    out = hull.normal[row, face]
    lower_end = np.argmin(heights[row, :, face], axis=1)
    by_face = Nearest(over, out, ends[row, lower_end])
    by_edge = _way_out(hull, ends, way)
    inside = _where(by_edge.distance > over, by_edge, by_face)
    outside = _nearest_outside(hull, ends, way, heights)
    is_outside = inside.distance > ON_SURFACE * hull.size
    nearest = _where(is_outside, outside, inside)

    # The part of the core over that face, if the core lies flat on it
    corners = hull.vertices[row[:, None], hull.faces[face]]
    length = np.sqrt(np.vecdot(way, way))
    on = ON_SIDE * hull.size
    bias = BIAS * np.minimum(hull.size, length + 2 * radius)
    behind = behind_sides(ends, corners, out)
    part = clip(behind[:, 0], behind[:, 1], on)
    shares = np.stack([part.entry, part.leaving], axis=1)
    on_face = ends[:, :1] + shares[..., None] * way[:, None]
    above = np.vecdot(on_face - corners[:, :1], out[:, None])
    flat = (
        part.inside
        & (over >= nearest.distance - bias)
        & (np.min(above, axis=1) <= nearest.distance + bias)
    )
    two = flat & ((part.leaving - part.entry) * length > 4 * on)

    # All places that touch: the ends of that part, or the nearest place
    places = np.concatenate([on_face, nearest.core[:, None]], axis=1)
    normal = np.stack([out, out, nearest.normal], axis=1)
    distance = np.concatenate([above, nearest.distance[:, None]], axis=1)
    distance[~np.stack([flat, two, ~flat], axis=1)] = np.inf
    row, feature = np.nonzero(distance - radius[:, None] <= margin)
    normal, distance = normal[row, feature], distance[row, feature]
    radius = radius[row]
    point = places[row, feature] - normal * ((distance + radius) / 2)[:, None]
    return Touching(pair[row], point, normal, distance - radius, feature)


def _nearest_outside(
    hull: Hull, ends: Array, way: Array, heights: Array
) -> Nearest:
    """The nearest place of cores that do not go into the hull.

    It is the end of a core over a face, or any place of the core that is
    nearest to an edge. The ends and the heights above all faces are (n, 2, 3)
    and (n, 2, f).
    """
    corners = hull.vertices[:, hull.faces]
    behind = behind_sides(ends[:, None], corners, hull.normal)
    over = np.all(behind >= 0, axis=3).mT & (heights > 0)
    low, high = np.moveaxis(np.where(over, heights, np.inf), 1, 0)
    first, second = (hull.vertices[:, end] for end in hull.edges.ends.T)
    edges = second - first
    share, along = nearest_on_segments(ends[:, :1], way[:, None], first, edges)
    place = ends[:, :1] + share[..., None] * way[:, None]
    away = place - first - along[..., None] * edges
    to_edge = np.sqrt(np.vecdot(away, away))
    distances = np.concatenate([low, high, to_edge], axis=1)
    best, row = np.argmin(distances, axis=1), np.arange(len(ends))
    faces = hull.normal.shape[1]
    on_face, distance = best < 2 * faces, distances[row, best]
    end, face = np.divmod(np.where(on_face, best, 0), faces)
    edge = np.where(on_face, 0, best - 2 * faces)
    divisor = np.where(on_face | (distance == 0), 1.0, distance)
    direction = away[row, edge] / divisor[:, None]
    over_face = Nearest(distance, hull.normal[row, face], ends[row, end])
    at_edge = Nearest(distance, direction, place[row, edge])
    return _where(on_face, over_face, at_edge)


def _way_out(hull: Hull, ends: Array, way: Array) -> Nearest:
    """The shortest way out of the hull across the core and one of its edges.

    The distance is −infinity if there is none.
    """
    starts, stops = (hull.vertices[:, end] for end in hull.edges.ends.T)
    edges = stops - starts
    along = way[:, None] @ hull.normal.mT
    left, right = (along[:, 0, side] for side in hull.edges.beside.T)
    # Of the planes that touch the hull along an edge, one is parallel to the
    # core if the core rises from one of the two faces and sinks into the
    # other.
    side = np.where(left > 0, -1.0, 1.0)[..., None]
    normal = side * cross(np.broadcast_to(way[:, None], edges.shape), edges)
    length = np.sqrt(np.vecdot(normal, normal))
    sizes = np.sqrt(np.vecdot(way, way)[:, None] * np.vecdot(edges, edges))
    real = (left * right < 0) & (length > EDGES_PARALLEL * sizes)
    normal /= np.where(real, length, 1.0)[..., None]
    distance = np.where(real, np.vecdot(normal, ends[:, :1] - starts), -np.inf)
    best, row = np.argmax(distance, axis=1), np.arange(len(ends))
    edge = starts[row, best], edges[row, best]
    share, _ = nearest_on_segments(ends[:, 0], way, *edge)
    core = ends[:, 0] + share[:, None] * way
    return Nearest(distance[row, best], normal[row, best], core)


def _where(chosen: Booleans, yes: Nearest, no: Nearest) -> Nearest:
    """One of two places of each pair."""
    return Nearest(
        np.where(chosen, yes.distance, no.distance),
        np.where(chosen[:, None], yes.normal, no.normal),
        np.where(chosen[:, None], yes.core, no.core),
    )
