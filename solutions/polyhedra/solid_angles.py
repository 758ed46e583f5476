"""Solid angles of triangles, and their sum around many points (slide 9).

In the sum, a part of the mesh that a point is well away from is replaced by
fewer faces with the same rim. The sum stays the same up to rounding (Jacobson
et al. 2013).
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import Vector, domain
from solutions.polyhedra.surface import Triangle, blocks, directed_edges

FEW_FACES = 8
FEW_POINTS = 150
"""Up to these numbers of faces, or of points, all solid angles are summed."""
MANY_POINTS = 1000
MANY_ANGLES = 5_000_000
"""A mesh is cut for this many points, or for fewer ones with this many angles
in all.

For less than that, the search for caps takes longer than the sum.
"""
SAVING = 0.7
"""Caps with more than this share of the faces would not repay the search for
them."""
MARGIN = 2.0**-10
"""How far beyond the box of a part a point must be, as a share of the box's
size."""
IN_CACHE = 4
"""By how much blocks are smaller here, so that a block's arrays fit in the
cache."""


@domain
def solid_angle(point: Vector, triangle: Triangle) -> Array:
    """The solid angle of a triangle as seen from a point (slide 9).

    It is the area of the triangle's image on a sphere of radius 1 around the
    point. The whole sphere has 4π.

    Parameters
    ----------
    point : (..., 3), m
    triangle : (..., 3, 3), its corners, m

    Returns
    -------
    (...), −2π to 2π, sr
        It is positive if the point sees the back of the triangle, and negative
        if the point sees its front: the side from which the corners run
        counter-clockwise. It is 0 where the point is in the triangle's plane,
        also on the triangle itself, and for a triangle without area.

    Notes
    -----
    Let a, b and c be the vectors from the point to the corners. The solid
    angle Ω follows from (van Oosterom and Strackee 1983)

        tan(Ω/2) = a·(b×c) / ((‖a‖‖b‖ + a·b)‖c‖ + (b·c)‖a‖ + (c·a)‖b‖)

    The numerator gives Ω its sign. It is computed as a·((b − a)×(c − a)),
    which is the same, because the normal of the triangle does not depend on
    the point: so the numerator is exactly zero wherever that plane goes
    through the point. The denominator is negative where Ω is more than π, and
    `arctan2` takes both with their signs.
    """
    corners = np.moveaxis(triangle, -2, 0)
    first, second, third = corners
    normal = np.moveaxis(np.cross(second - first, third - first), -1, 0)
    a, b, c = (np.moveaxis(corner - point, -1, 0) for corner in corners)
    la, lb, lc = (np.sqrt(_dot(x, x)) for x in (a, b, c))
    products = _dot(a, b), _dot(b, c), _dot(c, a)
    return 2 * _half_angle(_dot(a, normal), (la, lb, lc), products)


def winding_of_mesh(point: Array, vertices: Array, faces: Integers) -> Array:
    """How often the faces of a mesh go round points (..., 3).

    Notes
    -----
    It is the sum of all solid angles over 4π, up to rounding, which is some
    10⁻¹³ for a thousand faces. A part of the mesh is replaced by faces with
    the same rim, so a closed mesh saves most. Where a third of the faces is
    missing all over a mesh, every part has a long rim and nothing is saved.
    Then 1000 points and 7000 faces take about half a second, and the time
    grows with the product of both numbers. `fast_winding_number` of libigl
    takes distant faces together. It is some forty times as fast there, and
    right to a hundredth.
    """
    rows, shape = point.reshape(-1, 3), point.shape[:-1]
    few = len(rows) <= MANY_POINTS and len(rows) * len(faces) <= MANY_ANGLES
    if few or len(rows) <= FEW_POINTS:
        return sum_of_angles(rows, vertices, faces).reshape(shape)
    # Vertices at one place count as one, so that loose triangles have no rims.
    places, number = np.unique(vertices, axis=0, return_inverse=True)
    faces = number.reshape(-1)[faces]
    return winding_of_part(rows, places, faces).reshape(shape)


def winding_of_part(point: Array, vertices: Array, faces: Integers) -> Array:
    """How often faces go round points (p, 3); the faces are part of a mesh.

    Notes
    -----
    A part and its cap, turned over, make a closed surface. This surface lies
    in the box around the part, because a box is convex. It goes round no point
    outside the box. So such a point sees the part and its cap under the same
    solid angle, and the cap has fewer faces. A closed mesh has no rim, so its
    cap is empty.

    For the points in the box the function cuts the part in two, and asks the
    same of each half.
    """
    low = np.min(vertices[faces], axis=(0, 1))
    high = np.max(vertices[faces], axis=(0, 1))
    margin = MARGIN * np.max(high - low)
    near = np.all((point >= low - margin) & (point <= high + margin), axis=1)
    winding = np.empty(len(point))
    winding[near] = _winding_of_halves(point[near], vertices, faces)
    rim_only = cap(faces)
    seen = rim_only if len(rim_only) < len(faces) else faces
    winding[~near] = _sum_of_part(point[~near], vertices, seen)
    return winding


def _winding_of_halves(
    point: Array, vertices: Array, faces: Integers
) -> Array:
    if len(faces) > FEW_FACES and len(point) > FEW_POINTS:
        halves = _halves(vertices, faces)
        if sum(len(cap(half)) for half in halves) < SAVING * len(faces):
            first, second = (
                winding_of_part(point, vertices, half) for half in halves
            )
            return first + second
    return _sum_of_part(point, vertices, faces)


def _halves(vertices: Array, faces: Integers) -> tuple[Integers, Integers]:
    """The faces on either side of a cut across the mesh's longest side."""
    middle = np.mean(vertices[faces], axis=1)
    longest = np.argmax(np.ptp(middle, axis=0))
    order = np.argsort(middle[:, longest], kind="stable")
    half = len(faces) // 2
    return faces[order[:half]], faces[order[half:]]


def cap(faces: Integers) -> Integers:
    """Faces with the same rim: triangles from one vertex to all edges of it.

    The rim consists of the edges through which more faces run one way than the
    other.
    """
    edges = directed_edges(faces)
    # One whole number for both ends of an edge is sorted faster than the two.
    count = np.max(edges, initial=0) + 1
    codes = edges.min(axis=1) * count + edges.max(axis=1)
    code, number = np.unique(codes, return_inverse=True)
    edge = np.column_stack(np.divmod(code, count))
    sense = np.sign(edges[:, 1] - edges[:, 0])  # 0 for an edge without length
    excess = np.bincount(number.reshape(-1), sense, len(edge)).astype(np.int64)
    along = np.where(excess[:, None] > 0, edge, edge[:, ::-1])
    rim = np.repeat(along, np.abs(excess), axis=0)
    if not len(rim):
        return np.empty((0, 3), dtype=np.int64)
    top = np.argmax(np.bincount(rim.reshape(-1)))
    rim = rim[np.all(rim != top, axis=1)]
    return np.column_stack([np.full(len(rim), top), rim])


def sum_of_angles(point: Array, vertices: Array, faces: Integers) -> Array:
    """The sum of the solid angles of all faces from points (p, 3), over 4π."""
    first, second, third = np.moveaxis(vertices[faces], 1, 0)
    normal = np.cross(second - first, third - first)
    winding = np.zeros(len(point))
    for block in blocks(len(point), IN_CACHE * len(faces)):
        halves = _half_solid_angles(point[block], vertices, faces, normal)
        winding[block] = np.sum(halves, axis=1) / (2 * np.pi)
    return winding


def _sum_of_part(point: Array, vertices: Array, faces: Integers) -> Array:
    """The same, without the vertices of the rest of the mesh."""
    needed, number = np.unique(faces, return_inverse=True)
    return sum_of_angles(point, vertices[needed], number.reshape(-1, 3))


def _half_solid_angles(
    point: Array, vertices: Array, faces: Integers, normal: Array
) -> Array:
    """Ω/2 of every face, (points, f); its normal is twice its area long."""
    # With x, y, z along the first axis, sums of three are faster.
    to_vertex = vertices.T[:, None] - point.T[..., None]
    length = np.sqrt(_dot(to_vertex, to_vertex))
    a, b, c = (np.take(to_vertex, corner, axis=2) for corner in faces.T)
    la, lb, lc = (np.take(length, corner, axis=1) for corner in faces.T)
    # a·(b×c), with b − a and c − a for b and c
    volume = _dot(a, normal.T[:, None])
    products = _dot(a, b), _dot(b, c), _dot(c, a)
    return _half_angle(volume, (la, lb, lc), products)


def _half_angle(
    volume: Array,
    lengths: tuple[Array, Array, Array],
    products: tuple[Array, Array, Array],
) -> Array:
    """Ω/2 from a·(b×c), ‖a‖, ‖b‖ and ‖c‖, and from a·b, b·c and c·a."""
    (la, lb, lc), (ab, bc, ca) = lengths, products
    denominator = (la * lb + ab) * lc + bc * la + ca * lb
    return np.where(volume == 0, 0.0, np.arctan2(volume, denominator))


def _dot(a: Array, b: Array) -> Array:
    """Scalar product (...) of vectors (3, ...)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
