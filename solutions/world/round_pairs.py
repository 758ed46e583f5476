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
"""Sine of the angle up to which two capsules may touch at two points, side by side.

Capsules that cross at such an angle are nearest in between. For a length L and
a distance d of the cores the two points miss at most (0.01 L)²/8d of the
overlap there.
"""
LEAST_OVERLAP = 1e-3
"""Share of the shorter core along which capsules with two points lie side by side."""


def sphere_sphere(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch spheres; along z where their centres coincide."""
    return _between_balls(
        a.position[:, None],
        b.position[:, None],
        a,
        b,
        np.array([[0.0, 0.0, 1.0]]),
        margin,
    )


def sphere_capsule(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch capsules; along their x where a centre is on the core."""
    axis = b.rotation[:, :, 2]
    along = np.clip(
        np.vecdot(a.position - b.position, axis), -b.size[:, 1], b.size[:, 1]
    )
    nearest = b.position + along[:, None] * axis
    return _between_balls(
        a.position[:, None],
        nearest[:, None],
        a,
        b,
        b.rotation[:, :, 0],
        margin,
    )


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
    share_a, share_b = nearest_on_segments(
        ends_a[:, 0], way_a, ends_b[:, 0], way_b
    )
    # Where the ends of B are along the core of A, which reaches from −half to
    # half.
    places, half = (
        np.vecdot(ends_b - a.position[:, None], axis_a[:, None]),
        a.size[:, 1],
    )
    low, high = (
        np.maximum(np.min(places, axis=1), -half),
        np.minimum(np.max(places, axis=1), half),
    )
    across = cross(axis_a, axis_b)
    parallel = np.vecdot(across, across) <= NEARLY_PARALLEL**2
    parallel &= high - low > LEAST_OVERLAP * 2 * np.minimum(half, b.size[:, 1])
    stretch = (
        a.position[:, None]
        + np.stack([low, high], axis=1)[..., None] * axis_a[:, None]
    )
    along_b = np.vecdot(stretch - b.position[:, None], axis_b[:, None])
    opposite = (
        b.position[:, None]
        + np.clip(along_b, -b.size[:, 1:2], b.size[:, 1:2])[..., None]
        * axis_b[:, None]
    )
    places_a = np.concatenate(
        [(ends_a[:, 0] + share_a[:, None] * way_a)[:, None], stretch], axis=1
    )
    places_b = np.concatenate(
        [(ends_b[:, 0] + share_b[:, None] * way_b)[:, None], opposite], axis=1
    )
    touches = parallel[:, None] == np.array([False, True, True])
    length = np.sqrt(np.vecdot(across, across))[:, None]
    aside = np.where(
        length > COINCIDENT,
        across / np.where(length > COINCIDENT, length, 1.0),
        a.rotation[:, :, 0],
    )
    return _between_balls(places_a, places_b, a, b, aside, margin, touches)


def sphere_box(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch boxes.

    A sphere whose centre is inside is pushed out of the nearest face.
    """
    centre, half = np.vecmat(a.position - b.position, b.rotation), b.size
    beyond = centre - np.clip(centre, -half, half)
    distance = np.sqrt(np.vecdot(beyond, beyond))
    outside = distance > COINCIDENT * np.max(half, axis=1)
    depth = half - np.abs(centre)
    nearest = np.argmin(depth, axis=1)
    out_of_face = np.eye(3)[nearest] * np.where(centre < 0, -1.0, 1.0)
    core = np.where(outside, distance, -np.min(depth, axis=1))
    separation = core - a.size[:, 0]
    pair = np.flatnonzero(separation <= margin)
    beyond, outside, distance = (
        beyond[pair],
        outside[pair, None],
        distance[pair, None],
    )
    way = np.where(
        outside, beyond / np.where(outside, distance, 1.0), out_of_face[pair]
    )
    normal = np.matvec(b.rotation[pair], way)
    point = (
        a.position[pair]
        - normal * ((core[pair] + a.size[pair, 0]) / 2)[:, None]
    )
    return Touching(pair, point, normal, separation[pair], np.zeros_like(pair))


def sphere_half_space(a: Placed, b: Placed, margin: float) -> Touching:
    """Where spheres touch half-spaces."""
    return above_half_space(a.position[:, None], a.size[:, 0], b, margin)


def capsule_half_space(a: Placed, b: Placed, margin: float) -> Touching:
    """Where capsules touch half-spaces: feature 0 is the end at −z, 1 that at +z."""
    return above_half_space(ends_of(a), a.size[:, 0], b, margin)


def above_half_space(
    centres: Array, radius: Array, b: Placed, margin: float
) -> Touching:
    """Which balls around some points of each A touch the half-space B.

    Parameters
    ----------
    centres : (n, k, 3), m
    radius : (n,), m
    """
    out = b.rotation[:, :, 2]
    separation = (
        np.vecdot(centres - b.position[:, None], out[:, None])
        - radius[:, None]
    )
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
    instead = np.broadcast_to(aside, (len(away), 3))[pair]
    normal = np.where(
        apart, away[pair, feature] / np.where(apart, distance, 1.0), instead
    )
    point = (
        centres_b[pair, feature]
        + normal * (b.size[pair, 0] + gap / 2)[:, None]
    )
    return Touching(pair, point, normal, gap, feature)
