"""Is a point in any polyhedron, concave or not? By the parity of a ray, and by the winding number (slide 9)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, vector
from solutions.polyhedra.orientation import LOOKS, Sign, orient2d, orient3d
from solutions.polyhedra.surface import Array, Integers, blocks, checked_mesh, directed_edges, same_places


def inside_by_parity(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> NDArray[np.bool_]:
    """Whether a ray from the point crosses the surface an odd number of times: then the point is inside (slide 9).

    The ray goes up, along +z. One through a vertex or an edge would be counted once for each face there, and one along
    a face not at all. So think of the point as moved by (ε, ε², ε³), with ε smaller than any float: such a ray meets
    neither vertex nor edge, and moves no point that is off the surface to its other side. All signs are exact
    (`orient2d`, `orient3d`), so the answer is right at any distance from the surface.

    Parameters
    ----------
    point : (..., 3), m
    vertices, faces : (v, 3), m, and (f, 3), of a closed surface; which way its faces look does not matter

    Returns
    -------
    (...), bool. A point on the surface is inside when that small move takes it in: of solids that fill space face to
    face, exactly one has it. Where a surface goes through itself, what it encloses twice is outside.

    Raises
    ------
    ValueError
        If the surface is open: then it has no inside, and the ray's answer depends on its direction. If a point is not
        finite or the mesh does not fit together.
    """
    p = finite("point", vector("point", point))
    v, f = checked_mesh(vertices, faces)
    _refuse_open(v, f)
    rows, corners = p.reshape(-1, 3), v[f]
    inside = np.zeros(len(rows), dtype=bool)
    for block in blocks(len(rows), len(f)):
        which, face = _faces_above(rows[block], corners)
        crossed = _ray_crosses(rows[block][which], corners[face])
        inside[block] = np.bincount(which[crossed], minlength=len(rows[block])) % 2 == 1
    return inside.reshape(p.shape[:-1])


def winding_number(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> Array:
    """How often the surface goes round the point: the solid angles of all faces, over 4π (Jacobson et al. 2013).

    With a, b, c from the point to a face's corners, its solid angle Ω is (van Oosterom and Strackee 1983)

        tan(Ω/2) = a·(b×c) / (‖a‖‖b‖‖c‖ + (a·b)‖c‖ + (b·c)‖a‖ + (c·a)‖b‖)

    Parameters
    ----------
    point : (..., 3), m
    vertices, faces : (v, 3), m, and (f, 3), faces that look outwards

    Returns
    -------
    (...). 1 inside and 0 outside a closed surface, −1 inside when its faces look inwards, 2 where it encloses a point
    twice. On it the part of a small ball that is inside: 1/2 on a face, 1/8 at the corner of a cube, where the face's
    plane goes through the point but for rounding; else a whole number. With holes it is a fraction.

    Raises
    ------
    ValueError
        If a point is not finite, or the mesh does not fit together.
    """
    p = finite("point", vector("point", point))
    v, f = checked_mesh(vertices, faces)
    rows = p.reshape(-1, 3)
    winding = np.zeros(len(rows))
    for block in blocks(len(rows), len(f)):
        winding[block] = np.sum(_half_solid_angles(rows[block], v, f), axis=1) / (2 * np.pi)
    return winding.reshape(p.shape[:-1])


def inside_by_winding(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> NDArray[np.bool_]:
    """Whether the surface goes round the point by more than half: |w| > 1/2, with the `winding_number` w (slide 9).

    Slower than parity, and it asks for faces that are turned alike. In return it also answers for a surface with small
    holes, and counts as inside what a surface that goes through itself encloses twice.

    Parameters
    ----------
    point, vertices, faces : as for `winding_number`

    Returns
    -------
    (...), bool; on the surface rounding decides

    Raises
    ------
    ValueError
        As `winding_number` does.
    """
    return np.asarray(np.abs(winding_number(point, vertices, faces)) > 0.5)


def _refuse_open(vertices: Array, faces: Integers) -> None:
    edges, count = np.unique(np.sort(directed_edges(same_places(vertices, faces)), axis=1), axis=0, return_counts=True)
    odd = (count % 2 == 1) & (edges[:, 0] != edges[:, 1])
    if np.any(odd):
        raise ValueError(f"faces must bound a closed surface: {np.sum(odd)} edges belong to an odd number of faces")


def _faces_above(point: Array, corners: Array) -> tuple[Integers, Integers]:
    """Pairs of a point and a face (f, 3, 3) whose box the ray up from the point can meet."""
    (x, y, z), low, high = point.T[..., None], np.min(corners, axis=1).T, np.max(corners, axis=1).T
    beside = (low[0] <= x) & (x <= high[0]) & (low[1] <= y) & (y <= high[1])
    which, face = np.nonzero(beside & (z <= high[2]))
    return which, face


def _ray_crosses(p: Array, corners: Array) -> NDArray[np.bool_]:
    """Whether the ray up from each point p (k, 3), moved by (ε, ε², ε³), goes through its face (k, 3, 3)."""
    a, b, c = np.moveaxis(corners, 1, 0)
    turn = _beside_edge(a, b, p)
    for start, end in ((b, c), (c, a)):  # seen from above, the point is on the same side of all three edges
        same = turn != 0
        turn[same] *= _beside_edge(start[same], end[same], p[same]) == turn[same]
    crossed = np.asarray(turn != 0)
    side = _before_face(a[crossed], b[crossed], c[crossed], p[crossed])
    crossed[crossed] = side != turn[crossed]  # behind a face that looks up, or in front of one that looks down
    return crossed


def _beside_edge(a: Array, b: Array, p: Array) -> Sign:
    """Seen from above: +1 where the moved p is to the left of the edge, −1 to its right, 0 if the edge is upright."""
    by_epsilon, by_its_square = np.sign(a[:, 1] - b[:, 1]), np.sign(b[:, 0] - a[:, 0])
    return _first_sign(orient2d(a[:, :2], b[:, :2], p[:, :2]), by_epsilon, by_its_square)


def _before_face(a: Array, b: Array, c: Array, p: Array) -> Sign:
    """+1 where the moved p is in front of the face, −1 behind it: if p is in its plane, the normal's signs decide."""
    side = orient3d(a, b, c, p)
    on = side == 0
    if np.any(on):
        side[on] = _first_sign(*(orient2d(a[on][:, look], b[on][:, look], c[on][:, look]) for look in LOOKS))
    return side


def _first_sign(*signs: NDArray[np.generic]) -> Sign:
    """Of several signs the first that is not 0."""
    first, *others = (np.asarray(sign, dtype=np.int64) for sign in signs)
    for other in others:
        first = np.where(first == 0, other, first)
    return first


def _half_solid_angles(point: Array, vertices: Array, faces: Integers) -> Array:
    """Ω/2 of every face, (points, f)."""
    to_vertex = vertices.T[:, None] - point.T[..., None]  # x, y, z first: sums of three go faster so
    length = np.sqrt(_dot(to_vertex, to_vertex))
    a, b, c = (np.take(to_vertex, corner, axis=2) for corner in faces.T)
    la, lb, lc = (np.take(length, corner, axis=1) for corner in faces.T)
    first, second, third = np.moveaxis(vertices[faces], 1, 0)
    area = np.cross(second - first, third - first).T[:, None]
    volume = _dot(a, area)  # a·(b×c), with b − a and c − a for b and c
    below = (la * lb + _dot(a, b)) * lc + _dot(b, c) * la + _dot(c, a) * lb
    return np.where(volume == 0, 0.0, np.arctan2(volume, below))


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
