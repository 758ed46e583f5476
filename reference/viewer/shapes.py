"""What a replay can show: the shapes of scenarios, and those that no scenario has yet."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from reference import checks
from reference.arrays import Array
from reference.checks import Vector
from reference.errors import InvalidInput
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Box, HalfSpace, Sphere


@dataclass(frozen=True)
class Capsule:
    """A cylinder of the given radius with half spheres on its ends, about its own z axis, m."""

    radius: float
    half_length: float
    """From the middle to the centre of an end."""

    def __post_init__(self) -> None:
        checks.positive("radius", self.radius)
        checks.not_negative("half_length", self.half_length)


@dataclass(frozen=True)
class Convex:
    """A convex polyhedron. vertices: m, about the centre of mass. faces: indices of vertices, anticlockwise outside."""

    vertices: tuple[Vector, ...]
    faces: tuple[tuple[int, ...], ...]

    def __post_init__(self) -> None:
        for face in self.faces:
            if len(face) < 3 or not all(0 <= vertex < len(self.vertices) for vertex in face):
                raise InvalidInput(f"face {face} is none of {len(self.vertices)} vertices, three or more")


Shape = Sphere | Box | HalfSpace | Capsule | Convex | Polyhedron
BOX_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
"""Of the vertices in `vertices_of`, anticlockwise from outside."""


def vertices_of(shape: Shape) -> tuple[Array, float]:
    """Points (p, 3), m, and a radius about each, which together are as large as the shape; none for a half-space."""
    match shape:
        case Sphere():
            return np.zeros((1, 3)), shape.radius
        case Capsule():
            return np.array([[0.0, 0.0, -shape.half_length], [0.0, 0.0, shape.half_length]]), shape.radius
        case Box():
            return np.array(list(itertools.product((-1.0, 1.0), repeat=3))) * shape.half_extents, 0.0
        case Convex() | Polyhedron():
            return np.array(shape.vertices, dtype=np.float64), 0.0
    return np.zeros((0, 3)), 0.0


def faces_of(shape: Shape) -> tuple[tuple[int, ...], ...]:
    """The flat faces of a shape, as indices of its points."""
    match shape:
        case Box():
            return BOX_FACES
        case Convex() | Polyhedron():
            return shape.faces
    return ()


def written(shape: Shape) -> dict[str, Any]:
    """A shape as the script reads it."""
    match shape:
        case Sphere():
            return {"sphere": shape.radius}
        case Capsule():
            return {"capsule": [shape.radius, shape.half_length]}
        case HalfSpace():
            return {"plane": list(shape.normal)}
    points, _ = vertices_of(shape)
    return {"points": np.round(points, 5).tolist(), "faces": [list(face) for face in faces_of(shape)]}
