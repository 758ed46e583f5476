"""A polyhedron as the shape of a body: a closed surface of triangles, convex or not."""

from __future__ import annotations

import operator
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from reference import checks
from reference.arrays import Array
from reference.checks import Vector
from reference.errors import InvalidInput

Triangle = tuple[int, int, int]
_FLAT = 1e-9
"""How far in front of a face, as a share of the size, a vertex may be in rounding."""


@dataclass(frozen=True)
class Polyhedron:
    """What a closed surface of triangles encloses.

    vertices: in the body's own axes, m, from the body's position, which may be anywhere. faces: three vertices each,
    anticlockwise as seen from outside. pieces: sets of vertices whose convex hulls together are the solid, for engines
    that know convex shapes alone; none for a solid that is convex itself.
    """

    vertices: tuple[Vector, ...]
    faces: tuple[Triangle, ...]
    pieces: tuple[tuple[int, ...], ...] = ()

    def __post_init__(self) -> None:
        vertices = tuple(checks.vector(f"vertices[{place}]", each) for place, each in enumerate(self.vertices))
        object.__setattr__(self, "vertices", vertices)
        for name, least in (("faces", 3), ("pieces", 4)):
            groups = tuple(_numbers_in(name, group) for group in checks.all_of(name, getattr(self, name), Iterable))
            for group in groups:
                self._check_group(name, group, least)
            object.__setattr__(self, name, groups)
        edges = Counter(edge for a, b, c in self.faces for edge in ((a, b), (b, c), (c, a)))
        open_edges = [(a, b) for (a, b), count in edges.items() if count != 1 or edges[b, a] != 1]
        if open_edges or not self.faces:
            raise InvalidInput(
                f"the faces of a polyhedron must close and look one way; they do not at {open_edges[:1]}"
            )
        if self.volume <= 0:
            raise InvalidInput(f"the faces of a polyhedron must look outwards; its volume comes out as {self.volume:g}")
        if not self.pieces:
            self._check_convex()

    def _check_convex(self) -> None:
        """Refuse a solid that is told without pieces and is not convex: engines would take its hull for it."""
        corners = self.points[np.array(self.faces)]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        heights = np.einsum("fk,fvk->fv", normals, self.points - corners[:, :1])
        sizes = np.linalg.norm(normals, axis=-1, keepdims=True) * float(np.max(np.ptp(self.points, axis=0)))
        face, vertex = np.unravel_index(np.argmax(heights - _FLAT * sizes), heights.shape)
        if heights[face, vertex] > _FLAT * sizes[face, 0]:
            raise InvalidInput(
                f"a polyhedron without pieces must be convex; vertex {vertex} is in front of face {self.faces[face]}"
            )

    def _check_group(self, name: str, group: tuple[int, ...], least: int) -> None:
        known = all(0 <= vertex < len(self.vertices) for vertex in group)
        if not known or len(set(group)) != len(group) or len(group) < least or (name == "faces" and len(group) != 3):
            raise InvalidInput(f"{name} has {group}; it takes different ones of {len(self.vertices)} vertices")

    @property
    def points(self) -> Array:
        """The vertices as an array (v, 3), m."""
        return np.array(self.vertices, dtype=np.float64)

    @property
    def triangles(self) -> Array:
        """The corners of each face as an array (f, 3, 3), m."""
        return np.asarray(self.points[np.array(self.faces)])

    @property
    def volume(self) -> float:
        """m³: a sixth of the triple products of the faces' corners, added up."""
        a, b, c = np.moveaxis(self.triangles, 1, 0)
        return float(np.sum(np.cross(a, b) * c) / 6)

    @property
    def convex_pieces(self) -> tuple[tuple[int, ...], ...]:
        """The vertices of each convex piece: all of them where the solid has no others."""
        return self.pieces or (tuple(range(len(self.vertices))),)


def _numbers_in(name: str, group: Iterable[int]) -> tuple[int, ...]:
    """The numbers of vertices that make a face or a piece."""
    try:
        return tuple(operator.index(vertex) for vertex in group)
    except TypeError:
        raise InvalidInput(f"{name} has {group!r}; it takes whole numbers of vertices") from None
