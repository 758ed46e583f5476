"""Surveys by hand: which functions of the lecture answer a question about a polyhedron."""

from __future__ import annotations

import itertools

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten.queries import core
from reference.engines.implementation import Implementation
from reference.errors import CannotExpress
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
        """The slide's planes for a convex solid, which has no pieces, and the winding number for any other.

        Decided as `inside_convex` and `inside_by_winding` do it, but with the functions that a student writes.
        """
        solid = _solid(query.body)
        vertices, faces = posed(query.body), np.array(solid.faces)
        if solid.pieces:
            return float(np.abs(self._function("winding_number")(query.point, vertices, faces)) > 0.5)
        return float(self._function("convex_separation")(query.point, vertices, faces)[0] <= 0)

    def gap(self, body_a: Body, body_b: Body) -> float:
        """By the distance of two hulls, or of a ball's centre from faces."""
        for solid, ball in ((body_a, body_b), (body_b, body_a)):
            if isinstance(ball.shape, Sphere):
                return self._from_ball(solid, ball, ball.shape.radius)
        hulls = itertools.product(_pieces(body_a), _pieces(body_b))
        separation = min(float(self._function("separation_of_hulls")(*pair)[0]) for pair in hulls)
        if separation <= 0:
            raise CannotExpress("separation_of_hulls cannot tell how deep two bodies overlap")
        return separation

    def _from_ball(self, solid: Body, ball: Body, radius: float) -> float:
        """From the centre to the nearest point of any face, negative for a centre inside, less the radius."""
        centre, triangles = np.array(ball.position), posed(solid)[np.array(_solid(solid).faces)]
        weights = self._function("nearest_on_triangle")(centre, triangles)
        nearest = np.einsum("fc,fcx->fx", weights, triangles)
        distance = float(np.min(np.linalg.norm(nearest - centre, axis=-1)))
        return (-distance if self.inside(Inside(solid, ball.position)) else distance) - radius


def posed(body: Body) -> Array:
    """The vertices where the body has them, (v, 3), m."""
    return np.asarray(np.array(body.position) + geometry.rotate(np.array(body.orientation), _solid(body).points))


def _pieces(body: Body) -> list[Array]:
    """The corners of each convex piece of a polyhedron, or of a box, (n, 3), m."""
    if not isinstance(body.shape, Polyhedron):
        return [core(body)]
    return [posed(body)[list(piece)] for piece in body.shape.convex_pieces]


def _solid(body: Body) -> Polyhedron:
    assert isinstance(body.shape, Polyhedron)
    return body.shape
