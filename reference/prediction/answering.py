"""What an implementation must answer in a survey, given how it represents a solid.

For the hand-written code a solid is its surface and everything that the surface encloses. An engine's settings say how
the engine represents it: as triangles, which have no inside, as its convex hull, or as convex pieces. Bullet makes a
hull thicker by its margin, and puts the vertices of a hull on a grid: between the least and the largest coordinate
along each axis there are 10216 steps, and a vertex moves to the next step towards the middle (`btConvexHullComputer`).
A ray of Bullet's at a hull advances by what is surely free, and ends within 1 mm of the hull (`btGjkConvexCast`).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from reference.arrays import Array
from reference.engines import pybullet_settings, surveying
from reference.engines.base import ANSWERS_EXACT, ANSWERS_IN_SINGLE, ANSWERS_OF_BULLET, Method
from reference.engines.surveying import (
    BALL,
    DISTANCES_OF,
    HULL,
    INSIDE_BY,
    MESH_MARGIN,
    PIECES,
    RAYS_OF,
    TINY,
    TRIANGLES,
)
from reference.prediction import solids
from reference.prediction.bands import BULLETS_ACCURACY, IN_SINGLE, ULP, Term
from reference.prediction.predicted import TITLE, Prediction
from reference.scene.polyhedron import Polyhedron
from reference.scene.query import Distance, Inside, Query, Ray, Segment
from reference.scene.scenario import Body, Box, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.surfaces import winding_number
from reference.scene.survey import Survey, at_time

BULLETS_NEAR = 1e-3
"""As near to a hull Bullet's ray has to come, m (`radius` in `btGjkConvexCast`)."""
BULLETS_STEPS = 10216
"""Of the grid on which Bullet puts the vertices of a hull, along each axis."""
DOUBLE, SINGLE = 64 * ULP, 16 * IN_SINGLE
"""Some roundings of a coordinate, as a share of it: a place is a vertex, turned and moved, less another one, and a ray
that meets a face at 60° from its normal doubles the error."""


@dataclass(frozen=True)
class View:
    """What a solid is to an implementation."""

    rays_of: str
    distances_of: str
    inside_by: str
    margin: float
    on_a_grid: bool

    @classmethod
    def of(cls, settings: Settings, method: Method) -> View:
        """By hand there are no such settings: the solid is what its triangles enclose."""
        rays_of, distances_of, inside_by = (str(settings.options.get(key, "")) for key in _KEYS)
        bullets = method.rule == ANSWERS_OF_BULLET
        margin = float(settings.options.get(MESH_MARGIN, pybullet_settings.MARGIN)) if bullets else 0.0
        return cls(rays_of, distances_of, inside_by, margin, bullets)

    def answer(self, query: Query) -> float:
        """What must be answered to a question; not a number where rounding decides."""
        match query:
            case Distance():
                return self.gap(query.body_a, query.body_b)
            case Ray():
                return self._ray(query)
            case Segment():
                return self._within(query)
            case Inside():
                return self._inside(query.body, np.array(query.point))

    def gap(self, body_a: Body, body_b: Body) -> float:
        """From a ball, or between two solids, as far as they are solid; less the margins."""
        for solid, ball in ((body_a, body_b), (body_b, body_a)):
            if isinstance(ball.shape, Sphere):
                return self._from_ball(solid, ball, ball.shape.radius)
        one, other = self._in_the_world(body_a), self._in_the_world(body_b)
        if self.distances_of not in (HULL, PIECES):
            return solids.apart(*one, *other)
        return min(solids.separation(*pair) for pair in itertools.product(one, other)) - 2 * self.margin

    def _in_the_world(self, body: Body) -> list[Array]:
        """The surface of a solid, or of each of its parts, where it is."""
        surfaces = [_surface(body)]
        if self.distances_of in (HULL, PIECES):
            surfaces = [solids.hull(part) for part in self._parts(body, self.distances_of)]
        return [solids.placed(body, surface) for surface in surfaces]

    def _from_ball(self, solid: Body, ball: Body, radius: float) -> float:
        """From the ball's centre to the solid, as far as it is one, less the radius and the margin."""
        centre = solids.in_own_axes(solid, np.array(ball.position))
        corners = _surface(solid)
        if self.distances_of in (HULL, PIECES):
            parts = [solids.hull(part) for part in self._parts(solid, self.distances_of)]
            return min(solids.depth_or_gap(centre, part) for part in parts) - self.margin - radius
        nearest = float(np.min(solids.distances(centre, corners)))
        if self.distances_of == TRIANGLES:
            return max(0.0, nearest - radius)  # a surface has no depth
        return (-nearest if winding_number(centre, corners) > 0.5 else nearest) - radius

    def _parts(self, solid: Body, form: str) -> list[Array]:
        if isinstance(solid.shape, Box):  # Bullet's margin rounds a box off, and leaves its size as it is
            return [_corners(solid.shape, self.margin)]
        shape = _shape(solid)
        groups = shape.convex_pieces if form == PIECES else (tuple(range(len(shape.vertices))),)
        parts = [shape.points[list(group)] for group in groups]
        return [on_a_grid(part) for part in parts] if self.on_a_grid else parts

    def _ray(self, query: Ray) -> float:
        start, way = self._seen_from(query.body, query.start, np.add(query.start, query.way))
        if (self.rays_of != HULL or not self.margin) and solids.lies_in_a_face(start, way, _surface(query.body)):
            return math.nan
        return min(self._crossings(query.body, start, way), default=math.inf)

    def _within(self, query: Segment) -> float:
        start, way = self._seen_from(query.body, query.start, query.end)
        found = self._crossings(query.body, start, way)
        return float(np.linalg.norm(way)) * sum(after - before for before, after in list(pairwise(found))[::2])

    def _crossings(self, solid: Body, start: Array, way: Array) -> Sequence[float]:
        if self.rays_of != HULL:
            return list(map(float, solids.crossings(start, way, _surface(solid))))
        (part,) = self._parts(solid, HULL)
        corners = solids.hull(part)
        there = solids.advanced(start, way, corners, self.margin, BULLETS_NEAR)
        back = solids.advanced(start + way, -way, corners, self.margin, BULLETS_NEAR)
        return [there, 1 - back] if math.isfinite(there) and math.isfinite(back) else []

    def _inside(self, solid: Body, point: Array) -> float:
        if self.inside_by == BALL:
            return float(self.gap(solid, Body("probe", Sphere(TINY), position=tuple(point.tolist()))) < 0)
        return float(winding_number(solids.in_own_axes(solid, point), _surface(solid)) > 0.5)

    @staticmethod
    def _seen_from(solid: Body, start: Sequence[float], end: Sequence[float] | Array) -> tuple[Array, Array]:
        seen = [solids.in_own_axes(solid, np.array(place)) for place in (start, end)]
        return seen[0], seen[1] - seen[0]


_KEYS = (RAYS_OF, DISTANCES_OF, INSIDE_BY)


def predict(scenario: Scenario, settings: Settings, method: Method) -> Prediction | None:
    """The answers to a survey, and those that are watched at its samples."""
    if not isinstance(scenario, Survey) or method.rule not in (ANSWERS_EXACT, ANSWERS_OF_BULLET, ANSWERS_IN_SINGLE):
        return None
    view = View.of(settings, method)
    every = settings.sample_every
    count = 1 + settings.steps_for(scenario.duration) // every
    times = np.arange(count, dtype=np.float64) * every * settings.timestep
    answers = [view.answer(query) for _, query in scenario.questions]
    watched = [
        [view.gap(at_time(each.body_a, time), at_time(each.body_b, time)) for each in scenario.watched]
        for time in times.tolist()
    ]
    trajectory = surveying.trajectory_of(TITLE, scenario, settings, answers, watched)
    return Prediction(trajectory, (Term("rounding of vertices", _rounding(scenario, method)),))


def on_a_grid(points: Array) -> Array:
    """Vertices of a hull as Bullet has them, (v, 3), m; in its own order of operations, on which the outermost hang."""
    middle = (points.min(axis=0) + points.max(axis=0)) * 0.5
    step = (points.max(axis=0) - points.min(axis=0)) * (1 / BULLETS_STEPS)
    return np.asarray(np.trunc((points - middle) * (1 / step)) * step + middle)


def _rounding(scenario: Survey, method: Method) -> float:
    """Share of a solid's size that rounding may take, of the largest coordinate in the world in double precision."""
    sizes = [np.max(np.linalg.norm(_shape(body).points, axis=-1)) for body in scenario.bodies if _is_solid(body)]
    far = max(float(np.linalg.norm(body.position)) for body in scenario.bodies)
    more = {ANSWERS_IN_SINGLE: SINGLE, ANSWERS_OF_BULLET: BULLETS_ACCURACY / min(sizes)}
    return float(DOUBLE * (1 + far / min(sizes)) + more.get(method.rule, 0.0))


def _is_solid(body: Body) -> bool:
    return isinstance(body.shape, Polyhedron)


def _shape(body: Body) -> Polyhedron:
    assert isinstance(body.shape, Polyhedron)
    return body.shape


def _corners(box: Box, margin: float = 0.0) -> Array:
    """Of a box that is smaller by a margin on each side, (8, 3), m, in its own axes."""
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    return np.asarray(signs * (np.array(box.half_extents) - margin))


def _surface(body: Body) -> Array:
    """The triangles of a solid in its own axes, (f, 3, 3), m."""
    if isinstance(body.shape, Box):
        return solids.hull(_corners(body.shape))
    return np.asarray(_shape(body).points[np.array(_shape(body).faces)])
