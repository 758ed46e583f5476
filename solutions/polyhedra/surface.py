"""Vertices (v, 3) and triangles (f, 3) of a polyhedron (slide 9)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import finite, matrix, with_shape
from solutions.domain import domain

PAIRS = 1 << 16
"""How many pairs, as of points and faces, are looked at in one go.

This bounds the memory, whatever the input.
"""


def face_array(name: str, value: ArrayLike) -> Integers:
    """Return faces (f, 3); refuse other shapes and what is not whole."""
    array = np.asarray(value)
    of_three = array.ndim == 2 and array.shape[1] == 3
    if not of_three or not np.issubdtype(array.dtype, np.integer):
        raise ValueError(
            f"{name} must be whole numbers of the shape (f, 3),"
            f" not {array.dtype} of {array.shape}"
        )
    return array.astype(np.int64, copy=False)


Vertices = Annotated[Array, with_shape("v", 3), finite]
"""(v, 3), finite."""
Faces = Annotated[Integers, face_array]
"""(f, 3), the numbers of each face's corners among the vertices."""
Triangle = Annotated[Array, matrix]
"""(..., 3, 3), finite: three corners."""


@domain
def face_planes(vertices: Vertices, faces: Faces) -> tuple[Array, Array]:
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
        If a face has no area and hence no plane.

    Notes
    -----
    For a face with the corners a, b and c,

        n = (b − a)×(c − a) / ‖(b − a)×(c − a)‖
        d = −n·a

    The cross product of two sides is at right angles to both, and so to the
    face. Dividing it by its length makes it a unit normal. The corner a is on
    the plane, so n·a + d = 0, which gives d.
    """
    a, b, c = np.moveaxis(corners_of(vertices, faces), 1, 0)
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=-1)
    flat = length == 0
    if np.any(flat):
        face = np.argmax(flat)
        raise ValueError(f"faces must have an area: face {face} has none")
    normal = normal / length[..., None]
    return normal, -np.vecdot(normal, a)


@domain
def signed_volume(vertices: Vertices, faces: Faces) -> float:
    """Volume of a closed polyhedron, m³.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners a, b, c

    Returns
    -------
    float, m³
        It is negative where the faces look inwards, and 0 without faces.

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
    corners = corners_of(vertices, faces)
    if not len(corners):
        return 0.0
    middle = (np.min(corners, axis=(0, 1)) + np.max(corners, axis=(0, 1))) / 2
    a, b, c = np.moveaxis(corners - middle, 1, 0)
    return float(np.sum(np.vecdot(a, np.cross(b, c))) / 6)


@domain
def mesh_edges(vertices: Vertices, faces: Faces) -> Integers:
    """Every edge of a mesh once.

    Parameters
    ----------
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners

    Returns
    -------
    (e, 2), indices of the vertices at its ends, the smaller first
        Without faces, there are no edges: (0, 2).
    """
    corners_of(vertices, faces)  # refuses faces of vertices not there
    edges = np.sort(directed_edges(faces), axis=1)
    return np.unique(edges, axis=0)


def corners_of(vertices: Array, faces: Integers) -> Array:
    """The places of the corners a, b, c of each face, (f, 3, 3).

    A face that names a vertex that is not there is refused.
    """
    wrong = (faces < 0) | (faces >= len(vertices))
    if np.any(wrong):
        names = f"vertices 0 to {len(vertices) - 1}, not {faces[wrong][0]}"
        raise ValueError(f"faces must name {names}")
    return vertices[faces]


def directed_edges(faces: Integers) -> Integers:
    """The edges of each face in the sense in which it runs round, (3 f, 2).

    These are a b, b c, c a of the first face, then those of the second, and so
    on.
    """
    following = np.roll(faces, -1, axis=1)
    return np.stack([faces, following], axis=-1).reshape(-1, 2)


def same_places(vertices: Array, faces: Integers) -> Integers:
    """The faces with one number for each place instead of one for each vertex.

    Vertices that coincide get the same number, as in a heap of separate
    triangles.
    """
    _, place = np.unique(vertices, axis=0, return_inverse=True)
    return place.reshape(-1)[faces]


def blocks(count: int, partners: int) -> Iterator[slice]:
    """Cut `count` rows into slices, small enough to pair with all partners.

    A slice times its partners is `PAIRS` pairs at most, or it is one row.
    """
    rows = max(1, PAIRS // max(1, partners))
    return (slice(start, start + rows) for start in range(0, count, rows))


def size_of(vertices: Array) -> float:
    """The longest side of the box around the vertices, m; 0 without any."""
    return float(np.max(np.ptp(vertices, axis=0))) if len(vertices) else 0.0
