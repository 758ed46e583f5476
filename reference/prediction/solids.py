"""Geometry of polyhedra for predictions: plain, slow, and independent of the code that it judges.

Corners of triangles are arrays (f, 3, 3), m. The hull is found by trying every triple of vertices.
"""

from __future__ import annotations

import functools
import itertools

import numpy as np

from reference.arrays import Array, Mask
from reference.scene.scenario import Body

FLAT = 1e-9
"""Share of a length that counts as zero."""


def matrix(body: Body) -> Array:
    """The body's own axes as columns, in the world."""
    w, x, y, z = body.orientation
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def in_own_axes(body: Body, point: Array) -> Array:
    """A point of the world, seen from the body, in its own axes."""
    return np.asarray((point - np.array(body.position)) @ matrix(body))


def hull(points: Array) -> Array:
    """All triangles of points with every other point behind them: they cover the convex hull, some of it twice."""
    return _hull(tuple(map(tuple, points.tolist())))


@functools.lru_cache(256)
def _hull(vertices: tuple[tuple[float, ...], ...]) -> Array:
    points = np.array(vertices)
    a, b, c = np.moveaxis(points[np.array(list(itertools.combinations(range(len(points)), 3)))], 1, 0)
    normal = np.cross(b - a, c - a)
    size = np.ptp(points, axis=0).max()
    heights = normal @ points.T - np.sum(normal * a, axis=-1, keepdims=True)
    near = FLAT * size**3
    behind, before = np.all(heights <= near, axis=1), np.all(heights >= -near, axis=1)
    found = [np.stack([a, b, c], 1)[behind], np.stack([a, c, b], 1)[before & ~behind]]
    corners = np.concatenate(found)
    return np.asarray(corners[np.linalg.norm(_normals(corners), axis=-1) > FLAT * size**2])


def _normals(corners: Array) -> Array:
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def distances(point: Array, corners: Array) -> Array:
    """From a point to each triangle, (f,), m: to its nearest edge, or to the foot in its plane if that is within."""
    a = corners - point
    edge = np.roll(a, -1, axis=1) - a
    share = np.clip(-np.sum(a * edge, -1) / np.sum(edge * edge, -1), 0, 1)
    to_edges = np.min(np.linalg.norm(a + share[..., None] * edge, axis=-1), axis=1)
    normal = _normals(corners)
    inwards = np.cross(normal[:, None], edge)
    over: Mask = np.all(np.sum(inwards * a, -1) <= 0, axis=1)  # the foot is on the inner side of all three edges
    to_planes = np.abs(np.sum(normal * a[:, 0], -1)) / np.linalg.norm(normal, axis=-1)
    return np.asarray(np.where(over, to_planes, to_edges))


def in_convex(point: Array, corners: Array) -> bool:
    """Whether a point is behind all planes."""
    return bool(np.all(np.sum(_normals(corners) * (point - corners[:, 0]), -1) <= 0))


def depth_or_gap(point: Array, corners: Array) -> float:
    """From a point to a convex solid, m; within it minus the way to the nearest face."""
    nearest = float(np.min(distances(point, corners)))
    return -nearest if in_convex(point, corners) else nearest


def crossings(start: Array, way: Array, corners: Array) -> Array:
    """The shares of the way at which it goes through triangles, each once, (k,); borders count."""
    a, edge_b, edge_c = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = np.cross(edge_b, edge_c)
    slant = across @ way
    steep = np.abs(slant) > FLAT * np.linalg.norm(across, axis=-1) * np.linalg.norm(way)
    safe = np.where(steep, slant, 1.0)
    share = np.sum((a - start) * across, -1) / safe
    place = start + share[:, None] * way - a
    squared = np.sum(across * across, -1)
    u = np.sum(np.cross(place, edge_c) * across, -1) / squared
    v = np.sum(np.cross(edge_b, place) * across, -1) / squared
    met: Mask = steep & (u >= -FLAT) & (v >= -FLAT) & (u + v <= 1 + FLAT) & (share >= 0) & (share <= 1)
    found = np.sort(share[met])
    return np.asarray(found[np.diff(found, prepend=-1.0) > FLAT])


def lies_in_a_face(start: Array, way: Array, corners: Array) -> bool:
    """Whether a line lies in the plane of a triangle, so that rounding decides whether the two meet."""
    normal = _normals(corners)
    heights = np.stack([np.sum(normal * (place - corners[:, 0]), -1) for place in (start, start + way)])
    near = FLAT * np.linalg.norm(normal, axis=-1) * np.linalg.norm(way)
    return bool(np.any(np.all(np.abs(heights) <= near, axis=0)))


def advanced(start: Array, way: Array, corners: Array, margin: float, near: float) -> float:
    """The share of the way, from outside, at which a search by conservative advancement ends at a convex solid.

    The solid is rounded off by a margin, m. Each turn takes the nearest point and goes as far as the plane through it,
    across the shortest way, allows. So the search never goes too far, meets a face in one turn and stays before an
    edge. It ends as soon as the solid is at most `near` away, m. Infinite where the way does not get there.
    """
    share = 0.0
    while share <= 1:
        place = start + share * way
        apart = place - nearest_point(place, corners)
        distance = float(np.linalg.norm(apart))
        if distance - margin <= near:
            return share
        closing = -float(way @ apart) / distance
        if closing <= 0:
            break
        share += (distance - margin) / closing
    return np.inf


def nearest_point(point: Array, corners: Array) -> Array:
    """The point of all triangles that is nearest to another one, (3,), m."""
    a, b, c = corners[int(np.argmin(distances(point, corners)))]
    normal = np.cross(b - a, c - a)
    foot = point - ((point - a) @ normal) / (normal @ normal) * normal
    if all(np.cross(end - begin, foot - begin) @ normal >= 0 for begin, end in ((a, b), (b, c), (c, a))):
        return np.asarray(foot)
    found = []
    for begin, end in ((a, b), (b, c), (c, a)):
        edge = end - begin
        found.append(begin + np.clip((point - begin) @ edge / (edge @ edge), 0.0, 1.0) * edge)
    return min(found, key=lambda place: float(np.linalg.norm(point - place)))


def placed(body: Body, corners: Array) -> Array:
    """Triangles of the body's own axes in the world."""
    return np.asarray(np.array(body.position) + corners @ matrix(body).T)


def separation(first: Array, second: Array) -> float:
    """Between two convex solids, m; where they overlap minus the shortest way out.

    A plane that is parallel to a face of one of them, or to an edge of each, parts them if any plane does.
    """
    one, other = (np.unique(corners.reshape(-1, 3), axis=0) for corners in (first, second))
    normals = _normals_of_planes(first, second)
    shadows, others = normals @ one.T, normals @ other.T
    gaps = np.maximum(others.min(axis=1) - shadows.max(axis=1), shadows.min(axis=1) - others.max(axis=1))
    highest = float(np.max(gaps))
    return highest if highest < 0 else apart(first, second)


def _normals_of_planes(first: Array, second: Array) -> Array:
    """Unit normals of the faces, and across each two edges, (n, 3)."""
    edges = [(np.roll(corners, -1, axis=1) - corners).reshape(-1, 3) for corners in (first, second)]
    across = np.cross(edges[0][:, None], edges[1]).reshape(-1, 3)
    normals = np.concatenate([_normals(first), _normals(second), across])
    length = np.linalg.norm(normals, axis=-1)
    return np.asarray(normals[length > FLAT * length.max()] / length[length > FLAT * length.max(), None])


def apart(first: Array, second: Array) -> float:
    """Between two surfaces that do not cross, m: from a corner to a triangle, or between two edges."""
    to_faces = [
        float(np.min(distances(corner, surface)))
        for surface, other in ((first, second), (second, first))
        for corner in np.unique(other.reshape(-1, 3), axis=0)
    ]
    return min(*to_faces, _between_edges(first, second))


def _between_edges(first: Array, second: Array) -> float:
    """Where the shortest way between the lines of two edges ends on both; elsewhere a corner is nearest."""
    a, b = first.reshape(-1, 1, 3), second.reshape(1, -1, 3)
    along = (np.roll(first, -1, axis=1) - first).reshape(-1, 1, 3)
    beside = (np.roll(second, -1, axis=1) - second).reshape(1, -1, 3)
    across, way = np.cross(along, beside), b - a
    squared = np.sum(across * across, -1)
    skew: Mask = squared > FLAT**2 * np.sum(along * along, -1) * np.sum(beside * beside, -1)
    safe = np.where(skew, squared, 1.0)
    share_a = np.sum(np.cross(way, beside) * across, -1) / safe
    share_b = np.sum(np.cross(way, along) * across, -1) / safe
    on_both = skew & (share_a >= 0) & (share_a <= 1) & (share_b >= 0) & (share_b <= 1)
    length = np.abs(np.sum(way * across, -1)) / np.sqrt(safe)
    return float(np.min(length, where=on_both, initial=np.inf))
