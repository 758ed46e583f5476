"""Surfaces of triangles, and the flat faces of a convex solid, from their corners alone.

Corners of triangles are arrays (f, 3, 3), m.
"""

from __future__ import annotations

import functools
import itertools

import numpy as np

from reference.arrays import Array

FLAT = 1e-9
"""Share of a length that counts as zero."""


def nearest_points(points: Array, corners: Array) -> Array:
    """For each of some points (n, 3), m, the nearest point of a surface, (n, 3).

    Of a triangle that is the foot in its plane, if it lies within, and else the nearest point of an edge.
    """
    edge = np.roll(corners, -1, axis=1) - corners
    normal = np.cross(edge[:, 0], edge[:, 1])
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    from_corners = points[:, None, None] - corners
    share = np.clip(np.sum(from_corners * edge, -1) / np.sum(edge * edge, -1), 0, 1)
    on_edges = corners + share[..., None] * edge  # (n, f, 3 edges, 3)
    height = np.sum(from_corners[:, :, 0] * normal, -1)
    feet = points[:, None] - height[..., None] * normal
    within = np.all(np.sum(np.cross(normal[:, None], edge) * from_corners, -1) >= 0, axis=-1)
    feet = np.where(within[..., None], feet, on_edges[:, :, 0])
    found = np.concatenate([feet[:, :, None], on_edges], axis=2).reshape(len(points), -1, 3)
    away = np.linalg.norm(found - points[:, None], axis=-1)
    return np.asarray(found[np.arange(len(points)), np.argmin(away, axis=1)])


def winding_number(point: Array, corners: Array) -> float:
    """How often the surface goes round the point: its solid angle, by van Oosterom and Strackee (1983), over 4π."""
    a, b, c = np.moveaxis(corners - point, 1, 0)
    x, y, z = (np.linalg.norm(each, axis=-1) for each in (a, b, c))
    above = np.sum(a * np.cross(b, c), -1)
    below = x * y * z + np.sum(a * b, -1) * z + np.sum(b * c, -1) * x + np.sum(c * a, -1) * y
    return float(np.sum(np.arctan2(above, below)) / (2 * np.pi))


def hull_faces(points: Array) -> tuple[tuple[int, ...], ...]:
    """The flat faces of a convex solid with these corners (v, 3), m, anticlockwise as seen from outside.

    All triples of points are tried for planes that have every other point behind them.
    """
    return _hull_faces(tuple(map(tuple, points.tolist())))


@functools.lru_cache(256)
def _hull_faces(vertices: tuple[tuple[float, ...], ...]) -> tuple[tuple[int, ...], ...]:
    points, found = np.array(vertices), dict[frozenset[int], tuple[int, ...]]()
    size = float(np.ptp(points, axis=0).max())
    for a, b, c in itertools.permutations(range(len(points)), 3):
        normal = np.cross(points[b] - points[a], points[c] - points[a])
        length = float(np.linalg.norm(normal))
        if a > min(b, c) or length <= FLAT * size**2:
            continue
        heights = (points - points[a]) @ (normal / length)
        if np.all(heights <= FLAT * size):
            flat = np.flatnonzero(heights >= -FLAT * size)
            found.setdefault(frozenset(flat.tolist()), _in_turn(points[flat], flat.tolist(), normal / length))
    return tuple(found.values())


def _in_turn(points: Array, numbers: list[int], normal: Array) -> tuple[int, ...]:
    """The corners of a face, (k, 3), m, by their angle about the face's normal."""
    spokes = points - points.mean(axis=0)
    angle = np.arctan2(np.cross(spokes[0], spokes) @ normal, spokes @ spokes[0])
    return tuple(numbers[place] for place in np.argsort(angle))
