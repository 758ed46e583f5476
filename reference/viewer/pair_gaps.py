"""Pairs of bodies through a run: their gap, where they are nearest, and along which normal, from the poses alone.

Two boxes that meet edge on edge are not found: corners are tried against faces.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.arrays import Array, Mask
from reference.scene import geometry, surfaces
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.viewer.shapes import vertices_of

Places = dict[str, tuple[Array, Array]]
"""Positions (n, 3) and orientations (n, 4) by the names of the bodies that move."""
CLOSE = 0.02
"""Gap of bodies that are said to touch, as a share of the smaller one's size; engines keep some of it."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """A pair through time; body_a moves.

    gap: (n,), m. point: (n, 3), m, on B's surface. normal: (n, 3), unit, from B to A. close: gap below which they
    touch, m.
    """

    pair: Pair
    body_a: Body
    body_b: Body
    gap: Array
    point: Array
    normal: Array
    close: float

    @property
    def frictionless(self) -> bool:
        """Whether the pair has no friction: then it pushes along its normal alone."""
        return (self.pair.static_friction or 0.0) == 0


def meeting_of(scenario: Scenario, pair: Pair, places: Places) -> Meeting | None:
    """A pair's geometry through time; None where neither moves, or nobody knows the shapes' contact."""
    order = (Sphere, Box, Polyhedron, HalfSpace)
    body_a, body_b = sorted(
        map(scenario.body, (pair.body_a, pair.body_b)), key=lambda body: order.index(type(body.shape))
    )
    geometry_of = _GEOMETRY.get((type(body_a.shape), type(body_b.shape)))
    if geometry_of is None or not {body_a.name, body_b.name} & set(places):
        return None
    poses = [places.get(body.name) or _still(body, places) for body in (body_a, body_b)]
    gap, point, normal = geometry_of(body_a, body_b, *poses)
    if body_a.name not in places:
        body_a, body_b, normal = body_b, body_a, -normal
    return Meeting(pair, body_a, body_b, gap, point, normal, CLOSE * min(size_of(body_a), size_of(body_b)))


def _still(body: Body, places: Places) -> tuple[Array, Array]:
    count = len(next(iter(places.values()))[0])
    return np.tile(body.position, (count, 1)), np.tile(body.orientation, (count, 1))


def size_of(body: Body) -> float:
    """Smallest width of a body, m."""
    if isinstance(body.shape, HalfSpace):
        return np.inf
    if isinstance(body.shape, Polyhedron):
        return float(min(np.ptp(body.shape.points, axis=0)))
    return 2 * (body.shape.radius if isinstance(body.shape, Sphere) else min(body.shape.half_extents))


# Geometry: gap (n,), point (n, 3), normal (n, 3) from B to A

_Pose = tuple[Array, Array]


def _on_plane(body: Body, plane: Body, pose: _Pose, _: _Pose) -> tuple[Array, Array, Array]:
    """Where the lowest point of a body is above the plane, or the middle of those that are as low."""
    assert isinstance(plane.shape, HalfSpace)
    normal = np.array(plane.shape.normal)
    points, radius = vertices_of(body.shape)
    corners = pose[0][:, None] + geometry.rotate(pose[1][:, None], points)
    heights = (corners - plane.position) @ normal - radius
    gap = heights.min(axis=1)
    lowest = _middle(corners, heights - gap[:, None] < CLOSE * size_of(body))
    point = lowest - (radius + gap[:, None]) * normal
    return gap, point, np.tile(normal, (len(gap), 1))


def _middle(points: Array, chosen: Mask) -> Array:
    """Mean (n, 3) of the chosen (n, p) of points (n, p, 3)."""
    weights = chosen / np.maximum(chosen.sum(axis=1, keepdims=True), 1)
    return np.asarray(np.einsum("np,npk->nk", weights, points))


def _two_spheres(body_a: Body, body_b: Body, pose_a: _Pose, pose_b: _Pose) -> tuple[Array, Array, Array]:
    assert isinstance(body_a.shape, Sphere)
    assert isinstance(body_b.shape, Sphere)
    between = pose_a[0] - pose_b[0]
    distance = np.linalg.norm(between, axis=-1)
    normal = between / np.maximum(distance, 1e-12)[:, None]
    gap = distance - body_a.shape.radius - body_b.shape.radius
    return gap, pose_b[0] + body_b.shape.radius * normal, normal


def _sphere_box(sphere: Body, box: Body, pose_a: _Pose, pose_b: _Pose) -> tuple[Array, Array, Array]:
    assert isinstance(sphere.shape, Sphere)
    assert isinstance(box.shape, Box)
    half = np.array(box.shape.half_extents)
    own = geometry.rotate(geometry.opposite(pose_b[1]), pose_a[0] - pose_b[0])
    distance = geometry.out_of_box(pose_a[0] - pose_b[0], pose_b[1], half)
    nearest = np.clip(own, -half, half)
    away = own - nearest
    outside = np.linalg.norm(away, axis=-1, keepdims=True)
    away = np.where(outside > 1e-12, away / np.maximum(outside, 1e-12), _outward(own, half))
    point = pose_b[0] + geometry.rotate(pose_b[1], nearest)
    return distance - sphere.shape.radius, point, geometry.rotate(pose_b[1], away)


def _sphere_polyhedron(sphere: Body, solid: Body, pose_a: _Pose, pose_b: _Pose) -> tuple[Array, Array, Array]:
    """Where a ball whose centre is outside is nearest to a mesh; a centre inside gets the normal of the way out."""
    assert isinstance(sphere.shape, Sphere)
    assert isinstance(solid.shape, Polyhedron)
    triangles = solid.shape.triangles
    own = geometry.rotate(geometry.opposite(pose_b[1]), pose_a[0] - pose_b[0])
    nearest = surfaces.nearest_points(own, triangles)
    inside = np.array([surfaces.winding_number(place, triangles) > 0.5 for place in own])
    side = np.where(inside, -1.0, 1.0)
    away = (own - nearest) * side[:, None]
    distance = np.linalg.norm(away, axis=-1)
    normal = geometry.rotate(pose_b[1], away / np.maximum(distance, 1e-12)[:, None])
    return side * distance - sphere.shape.radius, pose_b[0] + geometry.rotate(pose_b[1], nearest), normal


def _outward(own: Array, half: Array) -> Array:
    """Unit normals (n, 3) of the face of a box that is nearest to places (n, 3), box axes."""
    nearest = np.argmax(np.abs(own) - half, axis=-1)[:, None]
    return np.where(np.arange(3) == nearest, np.where(own < 0, -1.0, 1.0), 0.0)


def _two_boxes(body_a: Body, body_b: Body, pose_a: _Pose, pose_b: _Pose) -> tuple[Array, Array, Array]:
    """Corners of either box against the faces of the other."""
    boxes = ((body_a, pose_a), (body_b, pose_b))
    close = CLOSE * min(size_of(body_a), size_of(body_b))
    corners, gaps = [], []
    for (body, pose), (other, frame) in (boxes, boxes[::-1]):
        points = pose[0][:, None] + geometry.rotate(pose[1][:, None], vertices_of(body.shape)[0])
        half = np.array(other.shape.half_extents)  # type: ignore[union-attr]
        gaps.append(geometry.out_of_box(points - frame[0][:, None], frame[1][:, None], half))
        corners.append(points)
    points, distances = np.concatenate(corners, axis=1), np.concatenate(gaps, axis=1)
    gap = distances.min(axis=1)
    point = _middle(points, distances - gap[:, None] < close)
    half = np.array(body_b.shape.half_extents)  # type: ignore[union-attr]
    own = geometry.rotate(geometry.opposite(pose_b[1]), point - pose_b[0])
    normal = geometry.rotate(pose_b[1], _outward(own, half))
    towards_a = np.sum(normal * (pose_a[0] - pose_b[0]), axis=-1, keepdims=True) >= 0
    return gap, point, np.where(towards_a, normal, -normal)


_GEOMETRY = {
    (Sphere, HalfSpace): _on_plane,
    (Box, HalfSpace): _on_plane,
    (Sphere, Sphere): _two_spheres,
    (Sphere, Box): _sphere_box,
    (Sphere, Polyhedron): _sphere_polyhedron,
    (Box, Box): _two_boxes,
}
