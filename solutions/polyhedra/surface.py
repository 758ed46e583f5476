"""What a polyhedron is made of: vertices (v, 3) and triangles (f, 3), and what follows from them (slide 9)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
PAIRS = 1 << 16
"""How many pairs, as of points and faces, are looked at at once: this bounds the memory, whatever the input."""


def checked_mesh(vertices: ArrayLike, faces: ArrayLike) -> tuple[Array, Integers]:
    """Return vertices (v, 3) as floats and faces (f, 3) as indices.

    Raises
    ------
    ValueError
        If a shape does not fit, a vertex is not finite, or a face names a vertex that is not there.
    """
    v, f = finite("vertices", vertices), np.asarray(faces)
    if v.ndim != 2 or v.shape[1] != 3:
        raise ValueError(f"vertices must have the shape (v, 3), not {v.shape}")
    if f.ndim != 2 or f.shape[1] != 3 or not np.issubdtype(f.dtype, np.integer):
        raise ValueError(f"faces must be whole numbers of the shape (f, 3), not {f.dtype} of {f.shape}")
    wrong = (f < 0) | (f >= len(v))
    if np.any(wrong):
        raise ValueError(f"faces must name vertices 0 to {len(v) - 1}, not {f[wrong][0]}")
    return v, f.astype(np.int64)


def face_planes(vertices: ArrayLike, faces: ArrayLike) -> tuple[Array, Array]:
    """Plane n·p + d = 0 of every face, its normal towards where the corners are seen counter-clockwise: outwards.

        n = (b − a)×(c − a) / ‖(b − a)×(c − a)‖,    d = −n·a

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners a, b, c

    Returns
    -------
    normal : (f, 3), unit
    offset : (f,), d, m

    Raises
    ------
    ValueError
        If a face has no area, hence no plane; or the mesh does not fit together.
    """
    v, f = checked_mesh(vertices, faces)
    a, b, c = v[f[:, 0]], v[f[:, 1]], v[f[:, 2]]
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    if np.any(length == 0):
        raise ValueError(f"faces must have an area: face {np.argmin(length)} has none, hence no plane")
    normal = normal / length
    return normal, -np.vecdot(normal, a)


def signed_volume(vertices: ArrayLike, faces: ArrayLike) -> float:
    """Volume of a closed polyhedron, m³: Σ a·(b×c)/6 over its faces; negative where the faces look inwards.

    Each face makes a tetrahedron with the middle of the box around the solid; those that are outside count negative.

    Raises
    ------
    ValueError
        If the mesh does not fit together.
    """
    v, f = checked_mesh(vertices, faces)
    if not len(f):
        return 0.0
    corners = v[f]
    middle = (np.min(corners, axis=(0, 1)) + np.max(corners, axis=(0, 1))) / 2
    a, b, c = np.moveaxis(corners - middle, 1, 0)
    return float(np.sum(np.vecdot(a, np.cross(b, c))) / 6)


def mesh_edges(vertices: ArrayLike, faces: ArrayLike) -> Integers:
    """Every edge once, (e, 2), as indices of its ends, the smaller first.

    Raises
    ------
    ValueError
        If the mesh does not fit together.
    """
    _, f = checked_mesh(vertices, faces)
    return np.unique(np.sort(directed_edges(f), axis=1), axis=0)


def directed_edges(faces: Integers) -> Integers:
    """The edges of each face in the sense in which it runs round, (3 f, 2): a b, b c, c a of the first, and so on."""
    return np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)


def same_places(vertices: Array, faces: Integers) -> Integers:
    """The faces with one number for each place: vertices that coincide get the same, as in a heap of triangles."""
    _, place = np.unique(vertices, axis=0, return_inverse=True)
    return np.asarray(place.reshape(-1)[faces], dtype=np.int64)


def blocks(count: int, partners: int) -> Iterator[slice]:
    """Cut `count` rows into slices, so that a slice times its partners is `PAIRS` pairs at most, or one row."""
    rows = max(1, PAIRS // max(1, partners))
    return (slice(start, start + rows) for start in range(0, count, rows))


def size_of(vertices: Array) -> float:
    """The longest side of the box around the vertices, m."""
    return float(np.max(np.ptp(vertices, axis=0))) if len(vertices) else 0.0
