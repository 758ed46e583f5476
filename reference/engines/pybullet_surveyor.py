"""Surveys in PyBullet: a solid of triangles where it is given its faces, a convex hull where only its vertices.

Bullet adds a margin to a hull, 1 mm unless it is told otherwise, and none to triangles. A box keeps its size, and the
margin rounds off its edges and corners. Without any margin many rays
miss a hull, so tuned rays meet the triangles. Triangles have no inside: the gap of a ball is its distance from the
nearest triangle, wherever the ball is.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np

from reference.engines import surveying
from reference.engines.ranges import NOT_NEGATIVE, Allowed
from reference.engines.surveying import (
    BALL,
    DISTANCES_OF,
    HULL,
    INSIDE_BY,
    MESH_MARGIN,
    PIECES,
    RAYS,
    RAYS_OF,
    TRIANGLES,
)
from reference.errors import CannotExpress
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, Sphere
from reference.scene.settings import Option, Settings

SETTINGS: Mapping[str, Mapping[str, Option]] = {
    # Triangles alone have no depth and no inside, and many rays miss a hull that has no margin.
    "tuned": {RAYS_OF: TRIANGLES, DISTANCES_OF: PIECES, MESH_MARGIN: 0.0, INSIDE_BY: RAYS},
    # A mesh of which Bullet is told the vertices alone is their convex hull.
    "stock": {RAYS_OF: HULL, DISTANCES_OF: HULL, INSIDE_BY: BALL},
}
ALLOWED: Mapping[str, Allowed] = {
    **surveying.allowed((TRIANGLES, HULL), (TRIANGLES, HULL, PIECES)),
    MESH_MARGIN: NOT_NEGATIVE,
}
FARTHEST = 1e6
"""m; Bullet searches for closest points up to it."""
DISTANCE = 8
"""Field of a closest point of Bullet's."""
BODY, SHARE = 0, 2
"""Fields of a ray's hit: the body, −1 if none, and the share of the way."""


class Surveyor:
    """Questions to one client, in which every body and each of its forms is made once."""

    def __init__(self, bullet: Any, settings: Settings, here: dict[str, int]) -> None:
        self._bullet, self._here = bullet, here
        self._rays_of = str(settings[RAYS_OF])
        self._distances_of = str(settings[DISTANCES_OF])
        self._margin = settings.number(MESH_MARGIN) if MESH_MARGIN in settings.options else None
        self._made: dict[tuple[object, str, int], list[int]] = {}

    def crossings(self, body: Body, start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
        """Of triangles all hits; of a hull the first from either end, which are all that it can have."""
        (number,) = self._numbers(body, self._rays_of)
        if self._rays_of == TRIANGLES:
            return self._hits(number, start, end)
        there, back = self._hits(number, start, end)[:1], self._hits(number, end, start)[:1]
        return there + [1 - share for share in back]

    def gap(self, body_a: Body, body_b: Body) -> float:
        """The smallest distance of any two parts."""
        parts = [self._numbers(body, self._distances_of, place) for place, body in enumerate((body_a, body_b))]
        pairs = itertools.product(*parts)
        found = [point for pair in pairs for point in self._bullet.getClosestPoints(*pair, FARTHEST, **self._here)]
        if not found:
            raise CannotExpress(f"Bullet finds no distance of {body_a.name} and {body_b.name}: both are triangles")
        return float(min(point[DISTANCE] for point in found))

    def _hits(self, number: int, start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
        """The shares of all hits of one body; Bullet gives the n-th of all bodies, until there is none."""
        found: list[float] = []
        for place in range(10_000):
            asked = {"reportHitNumber": place, "fractionEpsilon": 1e-9}
            ((body, _, share, *_),) = self._bullet.rayTestBatch([start], [end], **asked, **self._here)
            if body < 0:
                break
            if body == number:
                found.append(float(share))
        return sorted(found)

    def _numbers(self, body: Body, form: str, place: int = 0) -> list[int]:
        """The bodies that stand for a body in this form, where it is now; place: of the two that a question is about.

        Two bodies of one question may have the same shape.
        """
        key = (body.shape, form, place)
        if key not in self._made:
            self._made[key] = [self._make(shape, body) for shape in self._shapes(body, form)]
        orientation = (*body.orientation[1:], body.orientation[0])  # x y z w
        for number in self._made[key]:
            self._bullet.resetBasePositionAndOrientation(number, body.position, orientation, **self._here)
        return self._made[key]

    def _make(self, shape: int, body: Body) -> int:
        number = int(self._bullet.createMultiBody(0.0, shape, **self._here))
        if self._margin is not None and isinstance(body.shape, Polyhedron | Box):
            self._bullet.changeDynamics(number, -1, collisionMargin=self._margin, **self._here)
        return number

    def _shapes(self, body: Body, form: str) -> list[int]:
        shape, create = body.shape, self._bullet.createCollisionShape
        if isinstance(shape, Sphere):
            return [int(create(self._bullet.GEOM_SPHERE, radius=shape.radius, **self._here))]
        if isinstance(shape, Box):
            return [int(create(self._bullet.GEOM_BOX, halfExtents=shape.half_extents, **self._here))]
        assert isinstance(shape, Polyhedron)
        mesh = self._bullet.GEOM_MESH
        if form == TRIANGLES:
            corners = np.array(shape.faces).ravel().tolist()
            return [int(create(mesh, vertices=shape.points.tolist(), indices=corners, **self._here))]
        assert form in (HULL, PIECES)
        groups = shape.convex_pieces if form == PIECES else (tuple(range(len(shape.vertices))),)
        return [int(create(mesh, vertices=shape.points[list(group)].tolist(), **self._here)) for group in groups]
