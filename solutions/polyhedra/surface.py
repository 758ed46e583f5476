"""Vertices (v, 3) and triangles (f, 3) of a polyhedron (slide 9)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import finite

PAIRS = 1 << 16
"""How many pairs, as of points and faces, are looked at in one go.

This bounds the memory, whatever the input.
"""


def checked_mesh(
    vertices: ArrayLike, faces: ArrayLike
) -> tuple[Array, Integers]:
    """Return vertices (v, 3) as floats and faces (f, 3) as indices.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners

    Returns
    -------
    vertices : (v, 3), float
    faces : (f, 3), int

    Raises
    ------
    ValueError
        If a shape does not fit, a vertex is not finite, or a face names a
        vertex that is not there.
    """
    v, f = finite("vertices", vertices), np.asarray(faces)
    if v.ndim != 2 or v.shape[1] != 3:
        raise ValueError(f"vertices must have the shape (v, 3), not {v.shape}")
    if (
        f.ndim != 2
        or f.shape[1] != 3
        or not np.issubdtype(f.dtype, np.integer)
    ):
        raise ValueError(
            "faces must be whole numbers of the shape (f, 3),"
            f" not {f.dtype} of {f.shape}"
        )
    wrong = (f < 0) | (f >= len(v))
    if np.any(wrong):
        raise ValueError(
            f"faces must name vertices 0 to {len(v) - 1}, not {f[wrong][0]}"
        )
    return v, f.astype(np.int64)


def face_planes(vertices: ArrayLike, faces: ArrayLike) -> tuple[Array, Array]:
    """Plane n·p + d = 0 of every face, with its normal pointing outwards.

    Outwards is the side from which the corners a, b, c of a face are seen to
    run counter-clockwise.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners a, b, c

    Returns
    -------
    normal : (f, 3), n, of unit length
    offset : (f,), d, m
        For a mesh without faces the shapes are (0, 3) and (0,).

    Raises
    ------
    ValueError
        If a face has no area and hence no plane, or vertices are not finite or
        do not fit the faces.

    Notes
    -----
    For a face with the corners a, b and c,

        n = (b − a)×(c − a) / ‖(b − a)×(c − a)‖,    d = −n·a

    The cross product of two sides is at right angles to both, and so to the
    face. Dividing it by its length makes it a unit normal. The corner a is on
    the plane, so n·a + d = 0, which gives d.
    """
    v, f = checked_mesh(vertices, faces)
    a, b, c = v[f[:, 0]], v[f[:, 1]], v[f[:, 2]]
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=-1)
    if np.any(length == 0):
        raise ValueError(
            f"faces must have an area: face {np.argmin(length)} has none,"
            " hence no plane"
        )
    normal = normal / length[..., None]
    return normal, -np.vecdot(normal, a)


def signed_volume(vertices: ArrayLike, faces: ArrayLike) -> float:
    """Volume of a closed polyhedron, m³.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners a, b, c

    Returns
    -------
    float, m³
        It is negative where the faces look inwards, and 0 without faces.

    Raises
    ------
    ValueError
        If vertices are not finite or do not fit the faces.

    Notes
    -----
    The volume is a sum over the faces,

        V = Σ a·(b×c)/6

    Each face makes a tetrahedron with the middle of the box around the solid.
    The corners a, b and c are measured from that middle, so the volume of the
    tetrahedron is a·(b×c)/6. It is negative where the face turns its front to
    the middle. The space between such a face and the middle is outside the
    solid, at least next to the face. The negative volume takes away what the
    other tetrahedra have counted too much there.
    """
    v, f = checked_mesh(vertices, faces)
    if not len(f):
        return 0.0
    corners = v[f]
    middle = (np.min(corners, axis=(0, 1)) + np.max(corners, axis=(0, 1))) / 2
    a, b, c = np.moveaxis(corners - middle, 1, 0)
    return float(np.sum(np.vecdot(a, np.cross(b, c))) / 6)


def mesh_edges(vertices: ArrayLike, faces: ArrayLike) -> Integers:
    """Every edge of a mesh once.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners

    Returns
    -------
    (e, 2), indices of the vertices at its ends, the smaller first
        Without faces, there are no edges: (0, 2).

    Raises
    ------
    ValueError
        If vertices are not finite or do not fit the faces.
    """
    _, f = checked_mesh(vertices, faces)
    return np.unique(np.sort(directed_edges(f), axis=1), axis=0)


def directed_edges(faces: Integers) -> Integers:
    """The edges of each face in the sense in which it runs round, (3 f, 2).

    These are a b, b c, c a of the first face, then those of the second, and so
    on.
    """
    return np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(
        -1, 2
    )


def same_places(vertices: Array, faces: Integers) -> Integers:
    """The faces with one number for each place instead of one for each vertex.

    Vertices that coincide get the same number, as in a heap of separate
    triangles.
    """
    _, place = np.unique(vertices, axis=0, return_inverse=True)
    return np.asarray(place.reshape(-1)[faces], dtype=np.int64)


def blocks(count: int, partners: int) -> Iterator[slice]:
    """Cut `count` rows into slices, small enough to pair with all partners.

    A slice times its partners is `PAIRS` pairs at most, or it is one row.
    """
    rows = max(1, PAIRS // max(1, partners))
    return (slice(start, start + rows) for start in range(0, count, rows))


def size_of(vertices: Array) -> float:
    """The longest side of the box around the vertices, m; 0 without any."""
    return float(np.max(np.ptp(vertices, axis=0))) if len(vertices) else 0.0
