"""Surveys in DART: rays of its own detector, and distances of the Flexible Collision Library, both of triangles.

DART reads a mesh from a file, in single precision. Triangles have no inside: a ball that touches no triangle has a
positive distance from them, within the solid as well as outside.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.engines import dart_bodies, surveying
from reference.engines.surveying import DISTANCES_OF, INSIDE_BY, RAYS, RAYS_OF, TRIANGLES
from reference.errors import CannotExpress
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body
from reference.scene.settings import Option

SETTINGS: Mapping[str, Option] = {RAYS_OF: TRIANGLES, DISTANCES_OF: TRIANGLES, INSIDE_BY: RAYS}
"""In both profiles: nothing else can be chosen."""
ALLOWED = surveying.allowed((TRIANGLES,), (TRIANGLES,))


class Surveyor:
    """Questions to collision groups of DART's."""

    def __init__(self, dart: Any) -> None:
        self._dart = dart
        self._shape_of = functools.cache(functools.partial(dart_bodies.mesh, dart))

    def crossings(self, body: Body, start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
        """The hits of rays of DART's own detector, which gives one for each body; the others know no rays of meshes."""
        group, _kept = self._group(self._dart.collision.DARTCollisionDetector(), body)
        way = np.subtract(end, start)

        def first(place: Array) -> float:
            result = self._dart.collision.RaycastResult()
            group.raycast(place, place + way, self._dart.collision.RaycastOption(), result)
            return min((float(hit.mFraction) for hit in result.mRayHits), default=math.inf)

        return surveying.marched(first, start, end)

    def gap(self, body_a: Body, body_b: Body) -> float:
        """The distance that the Flexible Collision Library finds."""
        group, _kept = self._group(self._dart.collision.FCLCollisionDetector(), body_a, body_b)
        found = self._dart.collision.DistanceResult()
        group.distance(self._dart.collision.DistanceOption(False, 0.0), found)
        if not found.found():
            raise CannotExpress(f"DART finds no distance of {body_a.name} and {body_b.name}")
        return float(found.minDistance)

    def _group(self, detector: Any, *bodies: Body) -> tuple[Any, Any]:
        """A group of bodies where they are now, and what it does not keep alive by itself."""
        group, kept = detector.createCollisionGroup(), []
        for body in bodies:
            shape = self._shape_of(body.shape) if isinstance(body.shape, Polyhedron) else None
            skeleton, frame = dart_bodies.stand(self._dart, body, shape)
            group.addShapeFrame(frame)
            kept.append((skeleton, frame))
        return group, kept
