"""A point is in a convex solid if it is behind all its planes (slide 9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array, Integers
from solutions.checks import finite, not_negative, vector
from solutions.polyhedra.surface import (
    blocks,
    checked_mesh,
    face_planes,
    size_of,
)

FLAT = 1e-9
"""How far a vertex of a convex solid may be in front of a face, as a share of
its size.

Rounding puts a vertex there, and so do coordinates that are given with few
digits.
"""


def convex_separation(
    point: ArrayLike,
    vertices: ArrayLike,
    faces: ArrayLike,
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
        If the solid is not convex or is turned inside out, because the slide's
        test is wrong for such a solid. If a face has no area, there is no
        face, vertices are not finite or do not fit the faces, or a point is
        not finite or does not have three components.

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
    p = finite("point", vector("point", point))
    normal, offset = _convex_planes(vertices, faces)
    rows = p.reshape(-1, 3)
    separation, face = np.empty(len(rows)), np.empty(len(rows), dtype=np.int64)
    for block in blocks(len(rows), len(normal)):
        heights = rows[block] @ normal.T + offset
        face[block] = np.argmax(heights, axis=1)
        separation[block] = np.max(heights, axis=1)
    return separation.reshape(p.shape[:-1]), face.reshape(p.shape[:-1])


def inside_convex(
    point: ArrayLike,
    vertices: ArrayLike,
    faces: ArrayLike,
    tolerance: ArrayLike = 0.0,
) -> NDArray[np.bool_]:
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
        In every case in which `convex_separation` raises it, and if a
        tolerance is negative.

    Notes
    -----
    The `convex_separation` s of the point is its largest height above the
    planes of the faces. The function returns s ≤ tolerance.
    """
    return np.asarray(
        convex_separation(point, vertices, faces)[0]
        <= not_negative("tolerance", tolerance)
    )


def _convex_planes(
    vertices: ArrayLike, faces: ArrayLike
) -> tuple[Array, Array]:
    v, f = checked_mesh(vertices, faces)
    if not len(f):
        raise ValueError(
            "faces must not be empty: a polyhedron without faces has no inside"
        )
    normal, offset = face_planes(v, f)
    _refuse_concave(
        v[np.unique(f)], normal, offset
    )  # vertices of no face do not count
    return normal, offset


def _refuse_concave(corners: Array, normal: Array, offset: Array) -> None:
    height, face = _most_in_front(corners, normal, offset)
    if height > FLAT * size_of(corners):
        raise ValueError(
            "faces must bound a convex solid and look outwards:"
            f" a vertex is {height:g} m before face {face}"
        )


def _most_in_front(
    corners: Array, normal: Array, offset: Array
) -> tuple[float, int]:
    """Largest height of a corner above a plane, m, and the plane's face."""
    highest = np.array(
        [np.max(corners @ n + d) for n, d in zip(normal, offset, strict=True)]
    )
    return float(np.max(highest)), int(np.argmax(highest))
