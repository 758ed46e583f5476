"""What the surveys of solids share: places on a solid by construction, and what is measured of the answers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation
from reference.checks import Quaternion, Vector
from reference.engines.base import ANSWERS_IN_SINGLE, Method
from reference.engines.surveying import DISTANCES_OF, HULL, RAYS_OF, TRIANGLES
from reference.errors import RunFailed, Undecided
from reference.scene import geometry
from reference.scene.polyhedron import Polyhedron, Triangle
from reference.scene.query import Ray, Segment
from reference.scene.scenario import Body, Box, Sphere
from reference.scene.settings import Settings
from reference.scene.survey import Survey
from reference.scene.trajectory import Trajectory

TURNED: Quaternion = (0.4, -0.2, 0.8, 0.4)
"""A unit quaternion: 0.16 + 0.04 + 0.64 + 0.16 = 1."""
UPRIGHT: Quaternion = (1.0, 0.0, 0.0, 0.0)
HAIR = 5e-4
"""How far beside a solid some points and rays are, m: half of the margin that Bullet adds to a hull."""
BY_ITSELF = "it tests each triangle by itself, and rounding may put a ray at a border beside both"
SHARE = 1e-3
"""Accepted share of a solid's size in a length, 0.1 %."""
ITERATED = 1e-6
"""At which length the search for nearest points ends, m: MuJoCo's (`ccd_tolerance`) and that of the Flexible Collision
Library."""
BEHIND = 1.05
"""A ray has slipped through a border that it should meet after one size if it goes so many. What an engine does to its
shapes, a margin and a grid, is less than that where a solid is 5 cm or larger."""


@dataclass(frozen=True)
class Placed:
    """A solid where it is, and places about it from those in its own axes, m."""

    body: Body

    @property
    def shape(self) -> Polyhedron:
        """The body's shape."""
        assert isinstance(self.body.shape, Polyhedron)
        return self.body.shape

    def at(self, place: Array) -> Vector:
        """A place of the solid's own axes in the world."""
        x, y, z = np.array(self.body.position) + geometry.rotate(np.array(self.body.orientation), place)
        return float(x), float(y), float(z)

    def along(self, way: Array) -> Vector:
        """A way of the solid's own axes in the world."""
        x, y, z = geometry.rotate(np.array(self.body.orientation), way)
        return float(x), float(y), float(z)

    def ray(self, start: Array, end: Array) -> Ray:
        """A ray from one place of the solid's own axes to another."""
        return Ray(self.body, self.at(start), self.along(end - start))

    def segment(self, start: Array, end: Array) -> Segment:
        """The same as a segment."""
        return Segment(self.body, self.at(start), self.at(end))


def ball(solid: Placed, name: str, place: Array, radius: float, way: Array | None = None) -> Body:
    """A ball at a place of the solid's own axes; one that flies has a mass, and goes the way in a second."""
    if way is None:
        return Body(name, Sphere(radius), position=solid.at(place))
    return Body(name, Sphere(radius), 1.0, solid.at(place), velocity=solid.along(way))


@dataclass(frozen=True)
class Touching:
    """A shape, a place on it, m, and a unit normal of a plane that has the shape behind it and goes through the place.

    Both in the shape's own axes.
    """

    shape: Polyhedron | Box
    place: Array
    normal: Array


def corner_of_a_box(size: float) -> Touching:
    """The corner of a box whose sides are all different, seen from a way that is not its diagonal."""
    half = size * np.array([0.1, 0.15, 0.2])
    return Touching(Box(tuple(half.tolist())), half, unit(np.array([4.0, 5.0, 6.0])))


def edge_of_a_box(size: float) -> Touching:
    """A place on the edge of the same box that is not its middle."""
    half = size * np.array([0.1, 0.15, 0.2])
    return Touching(Box(tuple(half.tolist())), half * (1, 1, 0.3), unit(np.array([3.0, 4.0, 0.0])))


def before(solid: Placed, name: str, touching: Touching, place: Array, out: Array, gap: float) -> Body:
    """A body so far from a place on a solid, m, along a unit vector from it; place and vector in the solid's own axes.

    The plane through the place and across the vector has the solid behind it. A plane of the body is opposite to it, so
    that the gap is the distance of the two.
    """
    away = np.array(solid.along(out))
    orientation = geometry.quaternion_between(touching.normal, -away)
    position = np.array(solid.at(place)) + gap * away - geometry.rotate(orientation, touching.place)
    return Body(name, touching.shape, position=tuple(position.tolist()), orientation=tuple(orientation.tolist()))


def faces(shape: Polyhedron) -> Iterator[tuple[Array, Array]]:
    """The corners of each face, (3, 3), m, and its unit normal."""
    for face in shape.faces:
        yield shape.points[list(face)], normal_of(shape, face)


def normal_of(shape: Polyhedron, face: Triangle) -> Array:
    """The unit normal of a face, outwards."""
    a, b, c = shape.points[list(face)]
    return unit(np.cross(b - a, c - a))


def edges(shape: Polyhedron) -> Iterator[tuple[Array, Array, Array]]:
    """Both ends of each edge, m, and the direction halfway between the normals of its two faces."""
    other = {(a, b): face for face in shape.faces for a, b in _sides(face)}
    for (a, b), face in other.items():
        if a < b:
            middle = unit(normal_of(shape, face) + normal_of(shape, other[b, a]))
            yield shape.points[a], shape.points[b], middle


def corners(shape: Polyhedron) -> Iterator[tuple[Array, Array]]:
    """Each vertex, m, and a direction from it from which it is the nearest point: the normals' sum."""
    for place, vertex in enumerate(shape.points):
        yield vertex, unit(np.sum([normal_of(shape, face) for face in shape.faces if place in face], axis=0))


def _sides(face: Triangle) -> tuple[tuple[int, int], ...]:
    a, b, c = face
    return (a, b), (b, c), (c, a)


def unit(vector: Array) -> Array:
    """The vector with length 1."""
    return np.asarray(vector / np.linalg.norm(vector))


# What is measured


def answers(trajectory: Trajectory, kind: str) -> Array:
    """The answers to the questions of a kind, `ray 1`, `ray 2` …; of a ray the share of its way."""
    scenario = trajectory.scenario
    if not isinstance(scenario, Survey) or len(trajectory.answers) != len(scenario.questions):
        raise RunFailed(f"{trajectory.engine}: {scenario.name} has no answers")
    names = [name.rpartition(" ")[0] for name, _ in scenario.questions]
    return np.asarray(trajectory.answers[np.array(names) == kind])


def share_of(kind: str) -> Callable[[Trajectory], float]:
    """The share of points that are said to be inside."""
    return lambda trajectory: float(np.mean(answers(trajectory, kind)))


def share_met(kind: str) -> Callable[[Trajectory], float]:
    """The share of rays that meet the solid."""

    def measure(trajectory: Trajectory) -> float:
        found = answers(trajectory, kind)
        if np.any(np.isnan(found)):
            raise Undecided("rounding decides whether a ray along an edge meets it")
        return float(np.mean(np.isfinite(found)))

    return measure


def misjudged(trajectory: Trajectory) -> float:
    """The share of points on whose side the answer is wrong."""
    return float(np.mean([*(1 - answers(trajectory, "inside")), *answers(trajectory, "outside")]))


def slipped(trajectory: Trajectory) -> float:
    """The share of rays to an edge or a vertex, which is halfway, that go on behind it or meet nothing."""
    return float(np.mean(answers(trajectory, "border") > BEHIND / 2))


def mean_way(kind: str) -> Callable[[Trajectory], float]:
    """The mean way of rays that all go to halfway, m; a ray that meets nothing has none."""

    def measure(trajectory: Trajectory) -> float:
        scenario = trajectory.scenario
        assert isinstance(scenario, Survey)
        query = next(query for name, query in scenario.questions if name.startswith(f"{kind} "))
        assert isinstance(query, Ray)
        return float(np.linalg.norm(query.way) * np.mean(answers(trajectory, kind)))

    return measure


def mean_of(kind: str) -> Callable[[Trajectory], float]:
    """The mean of lengths, m."""
    return lambda trajectory: float(np.mean(answers(trajectory, kind)))


def watched(trajectory: Trajectory) -> Array:
    """The distance that is asked at every sample, m."""
    return trajectory.watched[:, 0]


# What is expected

Expect = Callable[[Case, Settings, Method], Expectation]


def none(of: int, why: str = "") -> Expect:
    """Expect that it happens to none of so many. why: it does, in a few words; else what a solid is to an engine."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        return Expectation(0.0, 0.5 / of, "not one of them all", shift_reason=why or _why(settings), size=1.0)

    return expect


def length(of: Callable[[Case], float]) -> Expect:
    """Expect a length, m, to a thousandth of the solid's size."""

    def expect(case: Case, settings: Settings, method: Method) -> Expectation:
        size = case.parameters["size"]
        reason = "0.1 % of the solid's size"
        return Expectation(of(case), SHARE * size, reason, shift_reason=_why(settings), size=size)

    return expect


def left_by_iteration(case: Case, settings: Settings, method: Method) -> float:
    """What the search for nearest points may leave, m."""
    return ITERATED if method.rule == ANSWERS_IN_SINGLE else 0.0


def left_to_rounding(case: Case, settings: Settings, method: Method) -> float:
    """Share of the rays at a border of two triangles that rounding may let through.

    Where an implementation tests each triangle by itself, a ray at their border may be outside of all of them. If
    rounding decides each test by a coin, the ray slips through an edge, where two triangles meet, in one case of four,
    and through a vertex of four triangles in one of sixteen. Of the rays to 12 edges and 6 vertices that makes 3.4 on
    average with a standard deviation of 1.6; half of them, 9, is 3.5 of these above. At most one of 18 was measured.
    """
    return 0.5 if method.rule == ANSWERS_IN_SINGLE else 0.0


def size_of(case: Case) -> float:
    """Of the solid, m."""
    return case.parameters["size"]


def _why(settings: Settings) -> str:
    """What a solid is to an implementation whose answers are away from theory."""
    told = settings.options
    if told.get(RAYS_OF) == HULL:
        return "it takes the convex hull for the solid, adds a margin of 1 mm, and ends a ray within 1 mm of that"
    if told.get(DISTANCES_OF) == HULL:
        return "it takes the convex hull for the solid"
    if told.get(DISTANCES_OF) == TRIANGLES:
        return "triangles have no inside: a ball among them is as far from them as it is"
    return "it puts the vertices of a hull on a grid"


def placed(shape: Polyhedron, position: Vector, orientation: Quaternion) -> Placed:
    """A solid that nothing moves."""
    return Placed(Body("solid", shape, position=position, orientation=orientation))


def scaled(shape: Polyhedron, size: float) -> Polyhedron:
    """The solid so many times as large."""
    return replace(shape, vertices=tuple(map(tuple, (size * shape.points).tolist())))
