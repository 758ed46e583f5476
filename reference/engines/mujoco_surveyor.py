"""Surveys in MuJoCo: its rays meet the triangles of a mesh, and its distances are those of the convex hull.

MuJoCo keeps a mesh in single precision, about its own centre of mass. Where distances have to be right, a concave solid
is described as convex pieces, one geom each.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.engines import surveying
from reference.engines.surveying import BALL, DISTANCES_OF, HULL, INSIDE_BY, PIECES, RAYS, RAYS_OF, TRIANGLES
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Sphere
from reference.scene.settings import Option, Settings

SETTINGS: Mapping[str, Mapping[str, Option]] = {
    "tuned": {RAYS_OF: TRIANGLES, DISTANCES_OF: PIECES, INSIDE_BY: RAYS},
    "stock": {RAYS_OF: TRIANGLES, DISTANCES_OF: HULL, INSIDE_BY: BALL},
}
ALLOWED = surveying.allowed((TRIANGLES,), (HULL, PIECES))
FARTHEST = 1e6
"""m; MuJoCo searches for closest points up to it."""
SEEN = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)
"""The groups of geoms that a ray meets."""


class Surveyor:
    """Questions to models of one solid, or of a solid and a ball, each built once."""

    def __init__(self, mujoco: Any, settings: Settings) -> None:
        self._mujoco, self._distances_of = mujoco, str(settings[DISTANCES_OF])
        self._built = functools.cache(self._build)

    def crossings(self, body: Body, start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
        """MuJoCo gives the first hit of a ray."""
        model, state = self._at(body, None)
        way = np.subtract(end, start)

        def first(place: Array) -> float:
            return float(self._mujoco.mj_ray(model, state, place, way, SEEN, 1, -1, None))

        return surveying.marched(first, start, end)

    def gap(self, body_a: Body, body_b: Body) -> float:
        """The smallest distance between the ball and a part of the solid."""
        solid, ball = (body_a, body_b) if isinstance(body_a.shape, Polyhedron) else (body_b, body_a)
        model, state = self._at(solid, ball)
        last = model.ngeom - 1
        parts = range(1, last)  # the first geom is for rays alone
        return float(min(self._mujoco.mj_geomDistance(model, state, part, last, FARTHEST, None) for part in parts))

    def _at(self, solid: Body, ball: Body | None) -> tuple[Any, Any]:
        """The model with its bodies where they are now."""
        model, state = self._built(solid.shape, ball.shape if ball else None)
        for place, body in enumerate(filter(None, (solid, ball)), 1):  # body 0 is the world
            model.body_pos[place], model.body_quat[place] = body.position, body.orientation
        self._mujoco.mj_kinematics(model, state)
        return model, state

    def _build(self, solid: Polyhedron, ball: Sphere | None) -> tuple[Any, Any]:
        spec, kinds = self._mujoco.MjSpec(), self._mujoco.mjtGeom
        frame = spec.worldbody.add_body(name="solid")
        whole, everything = np.array(solid.faces).ravel(), tuple(range(len(solid.vertices)))
        spec.add_mesh(name="whole", uservert=solid.points.ravel(), userface=whole)
        frame.add_geom(type=kinds.mjGEOM_MESH, meshname="whole")
        groups = solid.convex_pieces if self._distances_of == PIECES else (everything,)
        for number, group in enumerate(groups):
            spec.add_mesh(name=f"part {number}", uservert=solid.points[list(group)].ravel())
            frame.add_geom(type=kinds.mjGEOM_MESH, meshname=f"part {number}", group=1)
        if ball is not None:
            other = spec.worldbody.add_body(name="ball")
            other.add_geom(type=kinds.mjGEOM_SPHERE, size=[ball.radius, 0, 0], group=1)
        model = spec.compile()
        return model, self._mujoco.MjData(model)
