"""Where spheres and capsules touch each other, boxes and half-spaces.

A sphere is all that is within its radius of a point, and a capsule is all that
is within its radius of a segment, its core. A pair touches where the cores, or
a core and a surface, are nearest to each other.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans
from solutions.world.segments import ends_of, nearest_on_segments
from solutions.world.shapes import Placed, Touching
from solutions.world.vectors import cross

COINCIDENT = 1e-12
"""Share of a size up to which a distance is rounding, without direction."""
NEARLY_PARALLEL = 0.01
"""Sine of the angle up to which two capsules may lie side by side.

They then touch at two points. Capsules that cross at such an angle are nearest
in between. For a length L and a distance d of the cores the two points miss at
most (0.01 L)²/8d of the overlap there.
"""
LEAST_OVERLAP = 1e-3
"""Share of the shorter core that must be side by side for two points."""


def sphere_sphere(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch spheres; along z where their centres coincide."""
    centre_a, centre_b = a.position[:, None], b.position[:, None]
    up = np.array([[0.0, 0.0, 1.0]])
    return _between_balls(centre_a, centre_b, a, b, up, margin)


def sphere_capsule(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch capsules.

    Where a centre is on the core, the normal is the x axis of the capsule.
    """
    axis, half = b.rotation[:, :, 2], b.size[:, 1]
    along = np.clip(np.vecdot(a.position - b.position, axis), -half, half)
    nearest = b.position + along[:, None] * axis
    aside = b.rotation[:, :, 0]
    centres = a.position[:, None], nearest[:, None]
    return _between_balls(*centres, a, b, aside, margin)


def capsule_capsule(a: Placed, b: Placed, margin: float) -> Touching:
    """Where capsules touch capsules.

    Feature 0 is the place where the cores are nearest to each other. Capsules
    that lie side by side touch at the two ends of the stretch that they share
    instead. These are the features 1 and 2, in the sense of A's axis.

    Notes
    -----
    Where two cores cross, the way out is across both of them, so that is the
    normal.
    """
    axis_a, axis_b = a.rotation[:, :, 2], b.rotation[:, :, 2]
    ends_a, ends_b = ends_of(a), ends_of(b)
    way_a, way_b = ends_a[:, 1] - ends_a[:, 0], ends_b[:, 1] - ends_b[:, 0]
    centre_a, centre_b = a.position[:, None], b.position[:, None]
    half_a, half_b = a.size[:, 1:2], b.size[:, 1:2]

    # Feature 0: where the cores are nearest to each other
    share_a, share_b = nearest_on_segments(
        ends_a[:, 0], way_a, ends_b[:, 0], way_b
    )
    nearest_a = ends_a[:, 0] + share_a[:, None] * way_a
    nearest_b = ends_b[:, 0] + share_b[:, None] * way_b

    # Features 1 and 2: the stretch of A's core along which B's core lies
    along_a = np.vecdot(ends_b - centre_a, axis_a[:, None])
    low = np.maximum(np.min(along_a, axis=1), -half_a[:, 0])
    high = np.minimum(np.max(along_a, axis=1), half_a[:, 0])
    stretch = np.stack([low, high], axis=1)[..., None] * axis_a[:, None]
    stretch_a = centre_a + stretch
    along_b = np.vecdot(stretch_a - centre_b, axis_b[:, None])
    along_b = np.clip(along_b, -half_b, half_b)
    stretch_b = centre_b + along_b[..., None] * axis_b[:, None]

    across = cross(axis_a, axis_b)
    least = LEAST_OVERLAP * 2 * np.minimum(half_a, half_b)[:, 0]
    parallel = np.vecdot(across, across) <= NEARLY_PARALLEL**2
    parallel &= high - low > least
    touches = parallel[:, None] == np.array([False, True, True])
    places_a = np.concatenate([nearest_a[:, None], stretch_a], axis=1)
    places_b = np.concatenate([nearest_b[:, None], stretch_b], axis=1)
    length = np.sqrt(np.vecdot(across, across))[:, None]
    crosses = length > COINCIDENT
    way_out = across / np.where(crosses, length, 1.0)
    aside = np.where(crosses, way_out, a.rotation[:, :, 0])
    return _between_balls(places_a, places_b, a, b, aside, margin, touches)


def sphere_box(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch boxes.

    A sphere whose centre is inside is pushed out of the nearest face.
    """
    centre = np.vecmat(a.position - b.position, b.rotation)
    half = b.size
    beyond = centre - np.clip(centre, -half, half)
    distance = np.sqrt(np.vecdot(beyond, beyond))
    outside = distance > COINCIDENT * np.max(half, axis=1)
    depth = half - np.abs(centre)
    nearest = np.argmin(depth, axis=1)
    out_of_face = np.eye(3)[nearest] * np.where(centre < 0, -1.0, 1.0)
    core = np.where(outside, distance, -np.min(depth, axis=1))
    separation = core - a.size[:, 0]
    pair = np.flatnonzero(separation <= margin)
    beyond, outside = beyond[pair], outside[pair, None]
    out_of_box = beyond / np.where(outside, distance[pair, None], 1.0)
    way = np.where(outside, out_of_box, out_of_face[pair])
    normal = np.matvec(b.rotation[pair], way)
    to_middle = (core[pair] + a.size[pair, 0]) / 2
    point = a.position[pair] - normal * to_middle[:, None]
    return Touching(pair, point, normal, separation[pair], np.zeros_like(pair))


def sphere_half_space(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch half-spaces."""
    return above_half_space(a.position[:, None], a.size[:, 0], b, margin)


def capsule_half_space(a: Placed, b: Placed, margin: float) -> Touching:
    """Where capsules touch half-spaces: features 0 at −z and 1 at +z."""
    return above_half_space(ends_of(a), a.size[:, 0], b, margin)


def above_half_space(
    centres: Array, radius: Array, b: Placed, margin: float
) -> Touching:
    """Which balls around some points of each A touch the half-space B.

    Parameters
    ----------
    centres : (n, k, 3), m
    radius : (n,), m
    b : the half-spaces
    margin : the gap up to which a ball counts as touching, m
    """
    out = b.rotation[:, :, 2]
    height = np.vecdot(centres - b.position[:, None], out[:, None])
    separation = height - radius[:, None]
    pair, feature = np.nonzero(separation <= margin)
    normal, gap = out[pair], separation[pair, feature]
    point = centres[pair, feature] - normal * (radius[pair] + gap / 2)[:, None]
    return Touching(pair, point, normal, gap, feature)


def _between_balls(
    centres_a: Array,
    centres_b: Array,
    a: Placed,
    b: Placed,
    aside: Array,
    margin: float,
    touches: Booleans | None = None,
) -> Touching:
    """Where balls around points (n, k, 3) of A and B touch their partners.

    Where two centres coincide, the normal is `aside`, (n, 3). Only those that
    `touches`, (n, k), count.
    """
    away = centres_a - centres_b
    distance = np.sqrt(np.vecdot(away, away))
    radii = a.size[:, 0] + b.size[:, 0]
    separation = distance - radii[:, None]
    near = separation <= margin
    pair, feature = np.nonzero(near if touches is None else near & touches)
    distance, gap = distance[pair, feature, None], separation[pair, feature]
    apart = distance > COINCIDENT * radii[pair, None]
    direction = away[pair, feature] / np.where(apart, distance, 1.0)
    instead = np.broadcast_to(aside, (len(away), 3))[pair]
    normal = np.where(apart, direction, instead)
    to_middle = (b.size[pair, 0] + gap / 2)[:, None]
    point = centres_b[pair, feature] + normal * to_middle
    return Touching(pair, point, normal, gap, feature)
