"""Is a point in a convex polyhedron? It is behind the planes of all faces (slide 9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, vector
from solutions.polyhedra.surface import Array, Integers, blocks, checked_mesh, face_planes, size_of

FLAT = 1e-9
"""How far, as a share of its size, a vertex of a convex solid may be in front of a face: rounding, or few digits."""


def convex_separation(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> tuple[Array, Integers]:
    """How far a point is in front of a convex polyhedron, negative within it, and the face that says so (slide 9).

        s = max over the faces of n·p + d

    Within, −s is the depth: the way out through the nearest face. Outside s is the distance where a face is nearest;
    where an edge or a vertex is, the point is further away than s.

    Parameters
    ----------
    point : (..., 3), m
    vertices, faces : (v, 3), m, and (f, 3), of a convex solid whose faces look outwards

    Returns
    -------
    separation : (...), m
    face : (...), index of the face; of equals the first

    Raises
    ------
    ValueError
        If the solid is not convex, or turned inside out: the slide's test is wrong then. If a face has no area, there
        is no face, or a point is not finite.
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
    point: ArrayLike, vertices: ArrayLike, faces: ArrayLike, tolerance: ArrayLike = 0.0
) -> NDArray[np.bool_]:
    """Whether a point is in a convex polyhedron: in front of no face by more than the tolerance (slide 9).

    The surface belongs to the solid. On a slanted face rounding decides, unless there is a tolerance.

    Parameters
    ----------
    point : (..., 3), m
    vertices, faces : as for `convex_separation`
    tolerance : (...), m, not negative

    Returns
    -------
    (...), bool

    Raises
    ------
    ValueError
        As `convex_separation` does, and if a tolerance is negative.
    """
    return np.asarray(convex_separation(point, vertices, faces)[0] <= not_negative("tolerance", tolerance))


def is_convex(vertices: ArrayLike, faces: ArrayLike) -> bool:
    """Whether no vertex is in front of the plane of any face, but for rounding; false for a solid inside out.

    Of a closed surface that goes round once; of an open one, or a star that winds twice, it does not tell. True of no
    faces at all.

    Raises
    ------
    ValueError
        If a face has no area, or the mesh does not fit together.
    """
    v, f = checked_mesh(vertices, faces)
    corners = v[np.unique(f)]
    return _most_in_front(corners, *face_planes(v, f))[0] <= FLAT * size_of(corners)


def _convex_planes(vertices: ArrayLike, faces: ArrayLike) -> tuple[Array, Array]:
    v, f = checked_mesh(vertices, faces)
    if not len(f):
        raise ValueError("faces must not be empty: a polyhedron without faces has no inside")
    normal, offset = face_planes(v, f)
    corners = v[np.unique(f)]  # vertices of no face have no say
    height, face = _most_in_front(corners, normal, offset)
    if height > FLAT * size_of(corners):
        raise ValueError(
            f"faces must bound a convex solid and look outwards: a vertex is {height:g} m before face {face}"
        )
    return normal, offset


def _most_in_front(corners: Array, normal: Array, offset: Array) -> tuple[float, int]:
    """How far the corner is in front that is so most, and of which face."""
    highest = np.array([np.max(corners @ n + d) for n, d in zip(normal, offset, strict=True)])
    return (float(np.max(highest)), int(np.argmax(highest))) if len(highest) else (0.0, 0)
