"""Right answers by Möller and Trumbore's determinants, and by rays in a slanted direction, which meet no edges."""

import numpy as np

SLANTED = np.array([0.5773502691, 0.2764309127, 0.7683512893])
"""Along no axis, no diagonal, and no edge of any solid that a person would write down."""


def triple(a, b, c):
    return np.einsum("...i,...i->...", np.cross(a, b), c)


def face_planes(vertices, faces):
    a, b, c = (np.asarray(vertices, dtype=float)[np.asarray(faces)[:, k]] for k in range(3))
    normal = np.cross(c - b, a - b)
    normal = normal / np.sqrt((normal**2).sum(axis=1))[:, np.newaxis]
    return normal, -(normal * (a + b + c) / 3).sum(axis=1)


def convex_separation(point, vertices, faces):
    normals, offsets = face_planes(vertices, faces)
    heights = np.tensordot(np.asarray(point, dtype=float), normals, axes=(-1, 1)) + offsets
    return heights.max(axis=-1), heights.argmax(axis=-1)


def side_of_line(a, b, c):
    a, b, c = np.broadcast_arrays(np.asarray(a, float), np.asarray(b, float), np.asarray(c, float))
    rows = np.stack([b - a, c - a], axis=-2)
    determinant = rows[..., 0, 0] * rows[..., 1, 1] - rows[..., 0, 1] * rows[..., 1, 0]
    return (determinant > 0).astype(int) - (determinant < 0).astype(int)


def shares(start, way, triangle):
    """Möller and Trumbore (1997): the share of the way, and two weights; NaN where they are parallel."""
    a, b, c = (triangle[..., k, :] for k in range(3))
    with np.errstate(divide="ignore", invalid="ignore"):
        determinant = triple(b - a, way, c - a)
        v = triple(start - a, way, c - a) / determinant
        w = triple(b - a, way, start - a) / determinant
        t = triple(b - a, start - a, c - a) / -determinant
    return t, v, w


def segment_triangle(start, end, triangle):
    start, end, triangle = (np.asarray(each, dtype=float) for each in (start, end, triangle))
    t, v, w = shares(start, end - start, triangle)
    meets = (t >= 0) & (t <= 1) & (v >= 0) & (w >= 0) & (v + w <= 1)
    weights = np.stack([1 - v - w, v, w], axis=-1)
    return np.where(meets, t, np.inf), np.where(meets[..., np.newaxis], weights, np.nan)


def inside_by_parity(point, vertices, faces):
    point, corners = np.asarray(point, dtype=float), np.asarray(vertices, dtype=float)[faces]
    t, v, w = shares(point[..., np.newaxis, :], SLANTED, corners)
    crossings = np.count_nonzero((t > 0) & (v > 0) & (w > 0) & (v + w < 1), axis=-1)
    return crossings % 2 == 1


def winding_number(point, vertices, faces):
    to_corners = np.asarray(vertices, dtype=float)[faces] - np.asarray(point, dtype=float)[..., None, None, :]
    a, b, c = (to_corners[..., k, :] for k in range(3))
    la, lb, lc = (np.linalg.norm(each, axis=-1) for each in (a, b, c))
    ab, bc, ca = ((x * y).sum(axis=-1) for x, y in ((a, b), (b, c), (c, a)))
    volume = triple(a, b, c)
    flat = np.abs(volume) <= 1e-14 * la * lb * lc
    half = np.arctan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb)
    return np.where(flat, 0.0, half).sum(axis=-1) / (2 * np.pi)


def edges_of(faces):
    return sorted({tuple(sorted(pair)) for a, b, c in np.asarray(faces).tolist() for pair in ((a, b), (b, c), (c, a))})


def pierces(vertices_a, faces_a, vertices_b, faces_b):
    edges = np.array(edges_of(faces_a), dtype=int).reshape(-1, 2)
    ends = np.asarray(vertices_a, dtype=float)[edges]
    t, _ = segment_triangle(ends[:, None, 0], ends[:, None, 1], np.asarray(vertices_b, dtype=float)[faces_b])
    return np.isfinite(t).any()


def polyhedra_intersect(vertices_a, faces_a, vertices_b, faces_b):
    a, b = (vertices_a, faces_a), (vertices_b, faces_b)
    if pierces(*a, *b) or pierces(*b, *a):
        return True
    # No surface crosses the other: a part of a solid is wholly inside or wholly outside.
    return any(
        inside_by_parity(np.asarray(v, dtype=float)[corner], *other)
        for (v, f), other in ((a, b), (b, a))
        for corner in np.unique(f)
    )
