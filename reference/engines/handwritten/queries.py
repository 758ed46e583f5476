"""Questions of geometry, answered by hand-written code: which function is called for which shapes."""

from __future__ import annotations

import itertools
import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.errors import CannotExpress
from reference.scene import geometry
from reference.scene.query import Distance, Query, Ray
from reference.scene.scenario import Body, Box, HalfSpace, Sphere


def answer(query: Query, implementation: Implementation) -> float:
    """Answer with the implementation's functions."""
    assert isinstance(query, Ray | Distance), "a survey answers the others"
    return _ray(query, implementation) if isinstance(query, Ray) else _distance(query, implementation)


def _ray(query: Ray, implementation: Implementation) -> float:
    body, start = query.body, np.subtract(query.start, query.body.position)
    way = np.array(query.way)
    if isinstance(body.shape, Sphere):
        share = implementation.function("ray_sphere")(start, way, body.shape.radius)
    elif isinstance(body.shape, Box):
        back = geometry.opposite(np.array(body.orientation))
        own = [geometry.rotate(back, vector) for vector in (start, way)]
        share, _ = implementation.function("ray_box")(*own, np.array(body.shape.half_extents))
    else:
        assert isinstance(body.shape, HalfSpace)
        normal = np.array(body.shape.normal)
        gap = implementation.function("signed_distance")(start, normal, 0.0)
        share = implementation.function("time_of_impact_exact")(gap, way @ normal, 0.0)
    return float(share) if share <= 1 else math.inf


def _distance(query: Distance, implementation: Implementation) -> float:
    """The distance between the cores, less the radii. For cores that overlap these functions have no distance."""
    a, b = query.body_a, query.body_b
    radius = sum(body.shape.radius for body in (a, b) if isinstance(body.shape, Sphere))
    if isinstance(a.shape, HalfSpace) or isinstance(b.shape, HalfSpace):
        plane, body = (a, b) if isinstance(a.shape, HalfSpace) else (b, a)
        if isinstance(body.shape, HalfSpace):
            raise CannotExpress("the distance of two half-spaces has no function")
        normal = np.array(plane.shape.normal)  # type: ignore[union-attr]
        offset = -float(normal @ np.array(plane.position))
        return float(np.min(implementation.function("signed_distance")(core(body), normal, offset))) - radius
    gap, _ = implementation.function("separation_of_hulls")(core(a), core(b))
    if gap <= 0:
        raise CannotExpress("separation_of_hulls cannot tell how deep two bodies overlap")
    return float(gap) - radius


def core(body: Body) -> Array:
    """The corners of a box, or the centre of a ball, (n, 3), m."""
    if isinstance(body.shape, Sphere):
        return np.array([body.position], dtype=np.float64)
    corners = np.array(list(itertools.product((-1, 1), repeat=3))) * np.array(body.shape.half_extents)  # type: ignore[union-attr]
    return np.asarray(np.array(body.position) + geometry.rotate(np.array(body.orientation), corners))
