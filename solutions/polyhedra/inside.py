"""Whether a point is in a polyhedron, by parity or winding number (slide 9).

The polyhedron may be concave. Parity counts the faces that a ray from the
point crosses. The winding number adds up the solid angles of the faces.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solutions.arrays import Array, Booleans, Integers
from solutions.domain import Vector, domain, require
from solutions.polyhedra.orientation import LOOKS, Sign, orient2d, orient3d
from solutions.polyhedra.solid_angles import solid_angle, winding_of_mesh
from solutions.polyhedra.surface import (
    Faces,
    Vertices,
    blocks,
    corners_of,
    directed_edges,
    same_places,
)

FEW = 10_000
"""Up to so many coordinates times faces, all solid angles are summed."""


@domain
def inside_by_parity(
    point: Vector, vertices: Vertices, faces: Faces
) -> Booleans:
    """Whether a point is in a closed polyhedron, convex or not (slide 9).

    A ray from the point, in any one direction, decides. It may meet faces, but
    also edges and vertices, and it may run along a face.

    Parameters
    ----------
    point : (..., 3), m
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners
        The surface must be closed. It does not matter which way its faces
        look.

    Returns
    -------
    (...), bool
        The result is right at any distance from the surface, because all signs
        are exact (`orient2d`, `orient3d`). Where a surface goes through
        itself, what it encloses twice is outside.

        The lab asks for points off the surface alone, where every direction of
        the ray gives the same answer. The solution also decides about a point
        on the surface: it is inside when a move by (ε, ε², ε³), with an ε
        smaller than any float, takes it inside. So if solids fill space face
        to face, exactly one of them has the point.

    Raises
    ------
    ValueError
        If the surface is open, so that an edge has an odd number of faces. An
        open surface has no inside, and the answer of a ray would depend on its
        direction.

    Notes
    -----
    The ray goes up, along +z. Far up it is outside, and each time it crosses
    the surface it changes from one side to the other. So it starts inside
    exactly when it crosses the surface an odd number of times.

    Counting faces goes wrong where the ray meets an edge or a vertex, because
    it would be counted once for each face there. A ray along a face would not
    be counted at all. So think of the point as moved by (ε, ε², ε³), with an ε
    smaller than any float. The ray from the moved point meets neither an edge
    nor a vertex. The move is also too small to take a point that is off the
    surface to the other side of the surface.

    Seen from above, the moved point is left of the edge from a to b where

        (b − a)×(p + (ε, ε²) − a) > 0

    To the cross product of the point itself the move adds

        ε (a_y − b_y) + ε² (bₓ − aₓ)

    The largest term that is not zero decides: first the sign of `orient2d`,
    then that of a_y − b_y, then that of bₓ − aₓ. The ray's line goes through
    the face if the moved point is on the same side of all three edges. The
    ray itself does if the face is above its start, as `orient3d` says.
    """
    corners = corners_of(vertices, faces)
    _refuse_open(vertices, faces)
    points = point.reshape(-1, 3)
    inside = np.zeros(len(points), dtype=bool)
    for block in blocks(len(points), len(faces)):
        starts = points[block]
        ray, face = _faces_above(starts, corners)  # numbers of both, in pairs
        crossed = _ray_crosses(starts[ray], corners[face])
        crossings = np.bincount(ray[crossed], minlength=len(starts))
        inside[block] = crossings % 2 == 1
    return inside.reshape(point.shape[:-1])


@domain
def winding_number(point: Vector, vertices: Vertices, faces: Faces) -> Array:
    """How often a surface goes round a point (slide 9).

    Where `inside_by_parity` needs a closed surface, this number has a meaning
    for any triangles (Jacobson et al. 2013).

    Parameters
    ----------
    point : (..., 3), m
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners
        The faces must look outwards.

    Returns
    -------
    (...)
        For a closed surface it is 1 inside and 0 outside. It is −1 inside a
        surface whose faces look inwards, and 2 where a surface encloses the
        point twice. A surface with holes gives a fraction, and a mesh without
        faces gives 0. On a closed surface it is the part of a small ball
        around the point that is inside: 1/2 on a face, 1/8 at the corner of a
        cube. This holds where the computed plane of the face goes through the
        point exactly; where rounding moves the plane off the point, the result
        is a whole number.

    Notes
    -----
    It is the sum of the solid angles Ω of all faces, as seen from the point
    (`solid_angle`), over that of the whole sphere:

        w = Σ Ω/(4π)

    From inside a closed surface, every direction meets one back more than it
    meets fronts. The solid angles therefore add up to the whole sphere, which
    is 4π. From outside, every direction meets as many fronts as backs, and the
    sum is zero.

    For many points or faces the same sum is taken over fewer faces
    (`winding_of_mesh`).
    """
    corners = corners_of(vertices, faces)  # refuses vertices not there
    if point.size * len(faces) <= FEW:
        angles = solid_angle(point[..., None, :], corners)
        return np.sum(angles, axis=-1) / (4 * np.pi)
    return winding_of_mesh(point, vertices, faces)


@domain
def inside_by_winding(
    point: Vector, vertices: Vertices, faces: Faces
) -> Booleans:
    """Whether a surface goes round a point more than half a time (slide 9).

    It does where |w| > 1/2, with the `winding_number` w. This test is slower
    than parity, and all faces must be turned alike. In return it also works
    for a surface with small holes, and it counts as inside what a surface that
    goes through itself encloses twice.

    Parameters
    ----------
    point : (..., 3), m
    vertices : (v, 3), m
    faces : (f, 3), indices of the corners
        The faces must all look outwards, or all inwards.

    Returns
    -------
    (...), bool
        On the surface rounding decides.
    """
    w = winding_number(point, vertices, faces)
    return np.abs(w) > 0.5


def _refuse_open(vertices: Array, faces: Integers) -> None:
    """Refuse faces with an edge that belongs to an odd number of them."""
    edges = np.sort(directed_edges(same_places(vertices, faces)), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    odd = (count % 2 == 1) & (edges[:, 0] != edges[:, 1])
    require(
        ~odd,
        f"faces must bound a closed surface: {np.sum(odd)} edges belong to"
        " an odd number of faces",
    )


def _faces_above(point: Array, corners: Array) -> tuple[Integers, Integers]:
    """Pairs of a point and a face whose box the point's ray up can meet."""
    x, y, z = point.T[..., None]
    low = np.min(corners, axis=1).T
    high = np.max(corners, axis=1).T
    beside = (low[0] <= x) & (x <= high[0]) & (low[1] <= y) & (y <= high[1])
    ray, face = np.nonzero(beside & (z <= high[2]))
    return ray, face


def _ray_crosses(p: Array, corners: Array) -> Booleans:
    """Whether the ray up from each p (k, 3) goes through its face (k, 3, 3).

    The ray starts at the point moved by (ε, ε², ε³).
    """
    a, b, c = np.moveaxis(corners, 1, 0)
    # Seen from above, p must be on the same side of all three edges. Where it
    # is not, the side becomes 0.
    side = _beside_edge(a, b, p)
    for start, end in ((b, c), (c, a)):
        same = side != 0
        beside = _beside_edge(start[same], end[same], p[same])
        side[same] = np.where(beside == side[same], beside, 0)
    on_line = side != 0  # the upright line through p goes through the face
    before = _before_face(a[on_line], b[on_line], c[on_line], p[on_line])
    # Left of all edges, +1: the face looks up. It is above p if p is behind
    # it, −1. Right of all edges, −1: the face looks down. It is above p if p
    # is in front of it, +1.
    crossed = on_line.copy()
    crossed[on_line] = before != side[on_line]
    return crossed


def _beside_edge(a: Array, b: Array, p: Array) -> Sign:
    """Side of an edge on which the moved p is, seen from above.

    It is +1 to the left of the edge, −1 to its right, and 0 if the edge is
    upright.
    """
    side = orient2d(a[:, :2], b[:, :2], p[:, :2])
    by_epsilon = np.sign(a[:, 1] - b[:, 1])
    by_its_square = np.sign(b[:, 0] - a[:, 0])
    return _first_sign(side, by_epsilon, by_its_square)


def _before_face(a: Array, b: Array, c: Array, p: Array) -> Sign:
    """Side of a face on which the moved p is: +1 in front of it, −1 behind it.

    If p is in the plane of the face, the signs of the face's normal decide.
    """
    side = orient3d(a, b, c, p)
    on = side == 0
    if np.any(on):
        a, b, c = a[on], b[on], c[on]
        views = (orient2d(a[:, i], b[:, i], c[:, i]) for i in LOOKS)
        side[on] = _first_sign(*views)
    return side


def _first_sign(*signs: NDArray[np.generic]) -> Sign:
    """The first of several signs that is not 0."""
    first, *others = (np.asarray(sign, dtype=np.int64) for sign in signs)
    for other in others:
        first = np.where(first == 0, other, first)
    return first
