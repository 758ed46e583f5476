"""A point is in a convex solid if it is behind all its planes (slide 9)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.domain import NotNegative, Vector, domain, require
from solutions.polyhedra.surface import (
    Faces,
    Vertices,
    blocks,
    face_planes,
    size_of,
)

FLAT = 1e-9
"""How far a vertex of a convex solid may be in front of a face, as a share of
its size.

Rounding puts a vertex there, and so do coordinates that are given with few
digits.
"""


@domain
def convex_separation(
    point: Vector, vertices: Vertices, faces: Faces
) -> tuple[Array, Integers]:
    """How far a point is in front of a convex polyhedron (slide 9).

    The separation is the signed height of the point above the plane of one
    face: the face that decides whether the point is inside. The separation is
    negative within the solid, zero on its surface and positive outside.

    Parameters
    ----------
    point : (..., 3), m
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners
        The solid must be convex, and its faces must look outwards.

    Returns
    -------
    separation : (...), m
        Within the solid, −separation is the depth: the length of the way out
        through the nearest face. Outside, the separation is the distance to
        the solid where the nearest point of the solid is on a face. Where that
        nearest point is on an edge or at a vertex, the point is farther away
        than the separation.
    face : (...), index of the face that decides
        If several heights are equal, this is the first of their faces. Where
        they differ by rounding alone, rounding decides.

    Raises
    ------
    ValueError
        If there is no face, a face has no area, or the solid is not convex or
        is turned inside out, because the slide's test is wrong for it.

    Notes
    -----
    The separation is

        s = max over the faces of n·p + d

    The plane of a face is n·x + d = 0, and its unit normal n points outwards.
    So n·p + d is the height of the point p above that plane, and it is
    negative behind the plane. A convex solid is what lies behind all of these
    planes at once. The point is therefore within the solid exactly when even
    the largest height s is negative.

    Within the solid, the largest height belongs to the nearest plane, because
    all heights are negative. The ball of radius −s around the point goes
    through no plane, so it stays within the solid and touches it where it
    touches the nearest plane. The way out is therefore −s long.

    Outside, the whole solid is behind the plane of the face found, so it is at
    least s away. It is exactly s away where the perpendicular from the point
    to that plane ends on the face itself.
    """
    require(len(faces) > 0, "faces must not be empty: there is no inside")
    normal, offset = face_planes(vertices, faces)
    _refuse_concave(vertices[np.unique(faces)], normal, offset)
    points, shape = point.reshape(-1, 3), point.shape[:-1]
    separation = np.empty(len(points))
    face = np.empty(len(points), dtype=np.int64)
    for block in blocks(len(points), len(normal)):
        heights = points[block] @ normal.T + offset
        face[block] = np.argmax(heights, axis=1)
        separation[block] = np.max(heights, axis=1)
    return separation.reshape(shape), face.reshape(shape)


@domain
def inside_convex(
    point: Vector,
    vertices: Vertices,
    faces: Faces,
    tolerance: NotNegative = 0.0,
) -> Booleans:
    """Whether a point is in a convex polyhedron (slide 9).

    The point is inside if it is in front of no face by more than the
    tolerance.

    Parameters
    ----------
    point : (..., 3), m
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners
        The solid must be convex, and its faces must look outwards.
    tolerance : (...), m, not negative

    Returns
    -------
    (...), bool
        The surface belongs to the solid. Rounding decides about a point on a
        slanted face, unless there is a tolerance.

    Raises
    ------
    ValueError
        If there is no face, a face has no area, or the solid is not convex or
        is turned inside out, because the slide's test is wrong for it.

    Notes
    -----
    The `convex_separation` s of the point is its largest height above the
    planes of the faces. The function returns s ≤ tolerance.
    """
    separation, _ = convex_separation(point, vertices, faces)
    return separation <= tolerance


def _refuse_concave(corners: Array, normal: Array, offset: Array) -> None:
    """Refuse a solid with a corner in front of the plane of a face."""
    planes = zip(normal, offset, strict=True)
    highest = np.array([np.max(corners @ n + d) for n, d in planes])
    height, face = np.max(highest), np.argmax(highest)
    require(
        height <= FLAT * size_of(corners),
        "faces must bound a convex solid and look outwards:"
        f" a vertex is {height:g} m before face {face}",
    )
