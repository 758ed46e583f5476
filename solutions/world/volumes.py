"""Volumes of shapes."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import finite, not_negative, positive, with_shape
from solutions.polyhedra.inside import winding_number
from solutions.polyhedra.surface import (
    corners_of,
    directed_edges,
    face_array,
    same_places,
)
from solutions.world.shapes import Shape


def volume(shape: Shape) -> float:
    """Volume of a shape, m³.

    Parameters
    ----------
    shape : see `solutions.world.shapes`

    Returns
    -------
    float, m³
        That of a compound is the sum over its parts, even where they overlap.
        That of a half-space is infinite.

    Raises
    ------
    ValueError
        If a length is negative or not finite, the faces of a polyhedron look
        inwards, or there is no such kind of shape.
    """
    kind, *rest = shape
    if kind == "sphere":
        return 4 / 3 * np.pi * length("radius", rest[0]) ** 3
    if kind == "capsule":
        radius = length("radius", rest[0])
        half_length = length("half_length", rest[1])
        return volume(("sphere", radius)) + np.pi * radius**2 * 2 * half_length
    if kind == "box":
        half_extents = not_negative("half_extents", rest[0])
        return float(8 * np.prod(finite("half_extents", half_extents)))
    if kind == "polyhedron":
        return float(np.sum(tetrahedra(*rest)[0]))
    if kind == "half-space":
        return np.inf
    if kind == "compound":
        return sum(volume(part) for part, _, _ in rest[0])
    kinds = "sphere, capsule, box, polyhedron, half-space or compound"
    raise ValueError(f"the kind of a shape must be {kinds}, not {kind!r}")


def tetrahedra(
    vertices: ArrayLike, faces: Sequence[Sequence[int]]
) -> tuple[Array, Array, Array]:
    """A polyhedron cut into tetrahedra with their tips in its middle.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : f lists of vertices each, counterclockwise from outside
        They may have different lengths. A vertex that is repeated makes no
        difference.

    Returns
    -------
    volumes : (t,), m³
        Their sum is the volume of the polyhedron.
    corners : (t, 3, 3), the other three corners as seen from the tip, m
    tip : (3,), the middle of the vertices, m

    Raises
    ------
    ValueError
        If vertices are not finite or do not fit the faces, or the faces look
        inwards, or they do not close or not all look the same way: along each
        edge as many of them must run one way as the other. A part whose faces
        look inwards must lie within another one, as a cavity.

    Notes
    -----
    A face with the corners 0, 1, 2, 3 is cut into the triangles 0 1 2 and 0 2
    3. Each triangle a, b, c makes a tetrahedron with the tip, whose volume is
    a·(b × c)/6.
    """
    triangles = [
        (face[0], *side)
        for face in faces
        for side in itertools.pairwise(face[1:])
    ]
    v = finite("vertices", with_shape("v", 3)("vertices", vertices))
    f = face_array("faces", triangles)
    corners = corners_of(v, f)
    _refuse_open(v, f)
    middle = v.mean(axis=0)
    corners = corners - middle
    a, b, c = np.moveaxis(corners, 1, 0)
    volumes = np.vecdot(a, np.cross(b, c)) / 6
    positive("volume inside the faces", volumes.sum())
    _refuse_inside_out(v, f, volumes)
    return volumes, corners, middle


def _refuse_open(vertices: Array, faces: Integers) -> None:
    """Refuse faces of which more run one way along an edge than the other.

    The sums over tetrahedra would depend on where their tip is.
    """
    along = directed_edges(same_places(vertices, faces))
    _, which = np.unique(np.sort(along, axis=1), axis=0, return_inverse=True)
    ways = np.bincount(which.reshape(-1), np.sign(along[:, 1] - along[:, 0]))
    if np.any(ways):
        first = np.flatnonzero(ways[which.reshape(-1)])[0]
        start, end = directed_edges(faces)[first]
        raise ValueError(
            "faces must close, and all be counterclockwise from outside; at"
            f" the edge of the vertices {start} and {end} one is"
            " missing or turned over"
        )


def _refuse_inside_out(
    vertices: Array, faces: Integers, volumes: Array
) -> None:
    """Refuse a part whose faces look inwards, unless it is a cavity.

    Parts are those that share no vertex. Behind each face of a cavity there is
    the solid, so that the surface goes once round a point there.
    """
    places = same_places(vertices, faces)
    part = np.arange(len(vertices))
    while True:
        least = part.copy()
        np.minimum.at(least, places, part[places].min(axis=1)[:, None])
        if np.array_equal(least, part):
            break
        part = least
    of_face = part[places[:, 0]]
    sizes = np.bincount(of_face, volumes)
    for number in np.flatnonzero(sizes < 0):
        corners = vertices[faces[np.flatnonzero(of_face == number)]]
        sides = corners[:, 1:3] - corners[:, :1]
        normal = np.cross(sides[:, 0], sides[:, 1])
        largest = np.argmax(np.vecdot(normal, normal))
        area = np.linalg.norm(normal[largest])
        way_in = 1e-6 * normal[largest] / np.sqrt(area)
        behind = corners[largest].mean(axis=0) - way_in
        if not winding_number(behind, vertices, faces) > 0.5:
            raise ValueError(
                "faces of a polyhedron must look outwards, but those of a part"
                " of it look inwards, and nothing is around that part"
            )


def length(name: str, value: float) -> float:
    """Return a length, if it is finite and not negative."""
    return float(finite(name, not_negative(name, value)))
