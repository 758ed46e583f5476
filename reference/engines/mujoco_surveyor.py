"""Surveys in MuJoCo: its rays meet the triangles of a mesh, and its distances are those of the convex hull.

MuJoCo keeps a mesh in single precision, about its own centre of mass. Where distances have to be right, a concave solid
is described as convex pieces, one geom each.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.engines import surveying
from reference.engines.surveying import BALL, DISTANCES_OF, HULL, INSIDE_BY, PIECES, RAYS, RAYS_OF, TRIANGLES
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, Shape, Sphere
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
PARTS = 1
"""The group of the geoms that distances are measured between."""


class Surveyor:
    """Questions to models of one solid, or of a solid and another body, each built once."""

    def __init__(self, mujoco: Any, settings: Settings) -> None:
        self._mujoco, self._distances_of = mujoco, str(settings[DISTANCES_OF])
        self._built = functools.cache(self._build)

    def crossings(self, body: Body, start: tuple[float, ...], end: tuple[float, ...]) -> list[float]:
        """MuJoCo gives the first hit of a ray."""
        model, state = self._at(body)
        way = np.subtract(end, start)

        def first(place: Array) -> float:
            return float(self._mujoco.mj_ray(model, state, place, way, SEEN, 1, -1, None))

        return surveying.marched(first, start, end)

    def gap(self, body_a: Body, body_b: Body) -> float:
        """The smallest distance between a part of one body and a part of the other."""
        model, state = self._at(body_a, body_b)
        parts = [np.flatnonzero((model.geom_bodyid == place) & (model.geom_group == PARTS)) for place in (1, 2)]
        pairs = itertools.product(*parts)
        return float(min(self._mujoco.mj_geomDistance(model, state, *pair, FARTHEST, None) for pair in pairs))

    def _at(self, *bodies: Body) -> tuple[Any, Any]:
        """The model with its bodies where they are now."""
        model, state = self._built(*(body.shape for body in bodies))
        for place, body in enumerate(bodies, 1):  # body 0 is the world
            model.body_pos[place], model.body_quat[place] = body.position, body.orientation
        self._mujoco.mj_kinematics(model, state)
        return model, state

    def _build(self, *shapes: Shape) -> tuple[Any, Any]:
        spec = self._mujoco.MjSpec()
        for number, shape in enumerate(shapes):
            self._add(spec, spec.worldbody.add_body(name=f"body {number}"), shape)
        model = spec.compile()
        return model, self._mujoco.MjData(model)

    def _add(self, spec: Any, frame: Any, shape: Shape) -> None:
        """The geoms of a shape: of a polyhedron one for rays, and its parts for distances."""
        kinds = self._mujoco.mjtGeom
        if isinstance(shape, Sphere):
            frame.add_geom(type=kinds.mjGEOM_SPHERE, size=[shape.radius, 0, 0], group=PARTS)
        elif isinstance(shape, Box):
            frame.add_geom(type=kinds.mjGEOM_BOX, size=shape.half_extents, group=PARTS)
        else:
            assert isinstance(shape, Polyhedron)
            whole, everything = np.array(shape.faces).ravel(), tuple(range(len(shape.vertices)))
            spec.add_mesh(name=f"{frame.name}, whole", uservert=shape.points.ravel(), userface=whole)
            frame.add_geom(type=kinds.mjGEOM_MESH, meshname=f"{frame.name}, whole")
            groups = shape.convex_pieces if self._distances_of == PIECES else (everything,)
            for number, group in enumerate(groups):
                name = f"{frame.name}, part {number}"
                spec.add_mesh(name=name, uservert=shape.points[list(group)].ravel())
                frame.add_geom(type=kinds.mjGEOM_MESH, meshname=name, group=PARTS)
