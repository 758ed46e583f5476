"""Surveys by hand: which functions of the lecture answer a question about a polyhedron."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.scene import geometry
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Inside
from reference.scene.scenario import Body, Sphere


class Surveyor:
    """Questions to hand-written functions."""

    def __init__(self, implementation: Implementation) -> None:
        self._function = implementation.function

    def crossings(self, body: Body, start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
        """Every face that the segment meets says at which share of the way."""
        triangles = posed(body)[np.array(_solid(body).faces)]
        shares, _ = self._function("segment_triangle")(np.array(start), np.array(end), triangles)
        return [float(share) for share in shares if np.isfinite(share)]

    def inside(self, query: Inside) -> float:
        """The slide's planes for a convex solid, the winding number for any other."""
        vertices, faces = posed(query.body), np.array(_solid(query.body).faces)
        convex = self._function("is_convex")(vertices, faces)
        return float(self._function("inside_convex" if convex else "inside_by_winding")(query.point, vertices, faces))

    def gap(self, body_a: Body, body_b: Body) -> float:
        """From a ball's centre to the nearest point of any face, negative for a centre inside, less the radius."""
        solid, ball = (body_a, body_b) if isinstance(body_a.shape, Polyhedron) else (body_b, body_a)
        assert isinstance(ball.shape, Sphere)
        centre, triangles = np.array(ball.position), posed(solid)[np.array(_solid(solid).faces)]
        weights = self._function("nearest_on_triangle")(centre, triangles)
        nearest = np.einsum("fc,fcx->fx", weights, triangles)
        distance = float(np.min(np.linalg.norm(nearest - centre, axis=-1)))
        return (-distance if self.inside(Inside(solid, ball.position)) else distance) - ball.shape.radius


def posed(body: Body) -> Array:
    """The vertices where the body has them, (v, 3), m."""
    return np.asarray(np.array(body.position) + geometry.rotate(np.array(body.orientation), _solid(body).points))


def _solid(body: Body) -> Polyhedron:
    assert isinstance(body.shape, Polyhedron)
    return body.shape
