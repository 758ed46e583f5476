"""Of the fourth lot of wrong answers, those to the lab on polyhedra."""

from __future__ import annotations

import math

import numpy as np
from abbreviations import arr

from solutions.polyhedra import edges_through_faces, orient2d, orient3d, solid_angle


def _corners(vertices, faces):
    v = np.asarray(vertices, dtype=float)
    f = np.asarray(faces, dtype=int).reshape(-1, 3)
    return v[f[:, 0]], v[f[:, 1]], v[f[:, 2]]


def _planes(vertices, faces):
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    return n, -np.vecdot(n, a)


def face_planes_1(vertices, faces):
    """Crosses the two sides in the wrong order: the normals point inwards."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(c - a, b - a)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    return n, -np.vecdot(n, a)


def face_planes_2(vertices, faces):
    """Normalises n only after d was worked out with the long one."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    d = -np.vecdot(n, a)
    return n / np.linalg.norm(n, axis=1)[:, None], d


def face_planes_3(vertices, faces):
    """Wrong sign of d: takes the plane for n·p = d."""
    normals, offsets = [], []
    for i, j, k in faces:
        a, b, c = (np.asarray(vertices[x], dtype=float) for x in (i, j, k))
        n = np.cross(b - a, c - a)
        n = n / math.sqrt(n @ n)
        normals.append(n)
        offsets.append(float(n @ a))
    return np.array(normals).reshape(-1, 3), np.array(offsets)


def face_planes_4(vertices, faces):
    """Outwards is away from the middle of the vertices: turns normals that do not point so."""
    v = np.asarray(vertices, dtype=float)
    middle = v.mean(axis=0)
    a, b, c = _corners(v, faces)
    n = np.cross(b - a, c - a)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    outwards = np.vecdot(n, (a + b + c) / 3 - middle)
    n = np.where(outwards[:, None] < 0, -n, n)
    return n, -np.vecdot(n, a)


def face_planes_5(vertices, faces):
    """The offset d is minus the plane's distance from the origin, as if the origin were always inside."""
    n, d = _planes(vertices, faces)
    return n, -np.abs(d)


def face_planes_6(vertices, faces):
    """Divides by the norm of the whole array of normals and not of each one."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    n = n / max(np.linalg.norm(n), 1e-300)
    return n, -np.sum(n * a, axis=1)


def _heights(point, vertices, faces):
    n, d = _planes(vertices, faces)
    return np.asarray(point, dtype=float) @ n.T + d


def convex_separation_1(point, vertices, faces):
    """The face that decides is the one whose plane is nearest, in front or behind."""
    h = _heights(point, vertices, faces)
    face = np.argmin(np.abs(h), axis=-1)
    return np.take_along_axis(h, face[..., None], axis=-1)[..., 0], face


def convex_separation_2(point, vertices, faces):
    """A point outside does not touch, so its separation is 0."""
    h = _heights(point, vertices, faces)
    return np.minimum(h.max(axis=-1), 0.0), h.argmax(axis=-1)


def convex_separation_3(point, vertices, faces):
    """Outside, takes the distance to the nearest corner for the separation."""
    v = np.asarray(vertices, dtype=float)
    h = _heights(point, vertices, faces)
    s, face = h.max(axis=-1), h.argmax(axis=-1)
    used = np.unique(np.asarray(faces))
    p = np.asarray(point, dtype=float)
    away = np.linalg.norm(p[..., None, :] - v[used], axis=-1).min(axis=-1)
    return np.where(s > 0, away, s), face


def convex_separation_4(point, vertices, faces):
    """The face that decides is the one whose middle is nearest to the point."""
    p = np.asarray(point, dtype=float)
    middles = np.asarray(vertices, dtype=float)[np.asarray(faces)].mean(axis=1)
    h = _heights(point, vertices, faces)
    face = np.linalg.norm(p[..., None, :] - middles, axis=-1).argmin(axis=-1)
    return np.take_along_axis(h, face[..., None], axis=-1)[..., 0], face


def convex_separation_5(point, vertices, faces):
    """Of equal faces takes the last one: ≥ instead of >."""
    best, deciding = -math.inf, -1
    for number, (i, j, k) in enumerate(faces):
        a, b, c = (np.asarray(vertices[x], dtype=float) for x in (i, j, k))
        n = np.cross(b - a, c - a)
        height = np.dot(n, np.asarray(point) - a) / np.linalg.norm(n)
        if height >= best:
            best, deciding = height, number
    return best, deciding


def convex_separation_6(point, vertices, faces):
    """Forgets to give the normals unit length: heights are multiplied by twice the area."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    p = np.asarray(point, dtype=float)[..., None, :]
    h = np.sum((p - a) * n, axis=-1)
    return np.max(h, axis=-1), np.argmax(h, axis=-1)


def _plane_share(start, end, triangle):
    """Share of the way to the plane, normal (not unit) and the corners."""
    p, q, tri = arr(start, end, triangle)
    a, b, c = tri[..., 0, :], tri[..., 1, :], tri[..., 2, :]
    n = np.cross(b - a, c - a)
    s0, s1 = np.vecdot(p - a, n), np.vecdot(q - a, n)
    crosses = s0 != s1
    t = np.where(crosses, s0 / np.where(crosses, s0 - s1, 1.0), np.inf)
    x = p + np.where(crosses, t, 0.0)[..., None] * (q - p)
    return t, x, n, (a, b, c), (s0, s1)


def _weights(x, n, a, b, c):
    area = np.vecdot(n, n)
    parts = [
        np.vecdot(np.cross(c - b, x - b), n),
        np.vecdot(np.cross(a - c, x - c), n),
        np.vecdot(np.cross(b - a, x - a), n),
    ]
    return np.stack(parts, axis=-1) / area[..., None]


def _answer(hit, t, w):
    return np.where(hit, t, np.inf), np.where(np.asarray(hit)[..., None], w, np.nan)


def segment_triangle_1(start, end, triangle):
    """Takes the segment for a ray: does not ask whether t is at most 1."""
    t, x, n, (a, b, c), _ = _plane_share(start, end, triangle)
    w = _weights(x, n, a, b, c)
    return _answer((t >= 0) & np.isfinite(t) & np.all(w >= 0, axis=-1), t, w)


def segment_triangle_2(start, end, triangle):
    """Areas without a sign: every place in the plane is on the triangle."""
    t, x, _, (a, b, c), _ = _plane_share(start, end, triangle)
    parts = np.stack(
        [
            np.linalg.norm(np.cross(b - x, c - x), axis=-1),
            np.linalg.norm(np.cross(c - x, a - x), axis=-1),
            np.linalg.norm(np.cross(a - x, b - x), axis=-1),
        ],
        axis=-1,
    )
    w = parts / parts.sum(axis=-1, keepdims=True)
    return _answer((t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1), t, w)


def segment_triangle_3(start, end, triangle):
    """Meets the triangle from its front alone."""
    t, x, n, (a, b, c), (s0, s1) = _plane_share(start, end, triangle)
    w = _weights(x, n, a, b, c)
    return _answer((s0 > 0) & (s1 < 0) & np.all(w >= 0, axis=-1), t, w)


def segment_triangle_4(start, end, triangle):
    """Gives each weight to the next corner, not to the corner opposite to its area."""
    p, q = (np.asarray(x, dtype=float) for x in (start, end))
    a, b, c = (np.asarray(x, dtype=float) for x in triangle)
    nothing = math.inf, np.full(3, np.nan)
    n = np.cross(b - a, c - a)
    if n @ (q - p) == 0:
        return nothing
    t = n @ (a - p) / (n @ (q - p))
    if not 0 <= t <= 1:
        return nothing
    x = p + t * (q - p)
    w_a = np.cross(b - a, x - a) @ n / (n @ n)
    w_b = np.cross(c - b, x - b) @ n / (n @ n)
    w_c = np.cross(a - c, x - c) @ n / (n @ n)
    if min(w_a, w_b, w_c) < 0:
        return nothing
    return t, np.array([w_a, w_b, w_c])


def segment_triangle_5(start, end, triangle):
    """Returns the way to the meeting point in metres and not the share."""
    t, x, n, (a, b, c), _ = _plane_share(start, end, triangle)
    w = _weights(x, n, a, b, c)
    p, q = arr(start, end)
    hit = (t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1)
    length = np.linalg.norm(q - p, axis=-1)
    return _answer(hit, np.where(hit, t, 0.0) * length, w)


def segment_triangle_6(start, end, triangle):
    """Finds the weights from above, by x and y: an upright triangle is never met."""
    t, x, _, (a, b, c), _ = _plane_share(start, end, triangle)

    def area(u, v, w):
        return (v[..., 0] - u[..., 0]) * (w[..., 1] - u[..., 1]) - (v[..., 1] - u[..., 1]) * (w[..., 0] - u[..., 0])

    whole = area(a, b, c)
    seen = whole != 0
    parts = np.stack([area(x, b, c), area(x, c, a), area(x, a, b)], axis=-1)
    w = parts / np.where(seen, whole, 1.0)[..., None]
    return _answer(seen & (t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1), t, w)


def side_of_line_1(a, b, c):
    """The sign of the other order, (c − a) × (b − a): right is +1."""
    a, b, c = arr(a, b, c)
    u, v = b - a, c - a
    return np.sign(v[..., 0] * u[..., 1] - v[..., 1] * u[..., 0]).astype(int)


def side_of_line_2(a, b, c):
    """Left means above the line: compares heights and forgets which way the line runs."""
    ax, ay, bx, by = float(a[0]), float(a[1]), float(b[0]), float(b[1])
    cx, cy = float(c[0]), float(c[1])
    if bx == ax:
        if by == ay:
            return 0
        return int(np.sign(ax - cx) * np.sign(by - ay))
    slope = (by - ay) / (bx - ax)
    return int(np.sign((cy - ay) - slope * (cx - ax)))


def side_of_line_3(a, b, c):
    """Takes every point whose determinant is below 1e-9 for a point on the line."""
    a, b, c = arr(a, b, c)
    D = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
    return np.where(np.abs(D) < 1e-9, 0, np.sign(D)).astype(int)


def side_of_line_4(a, b, c):
    """The wrong one of two products: the dot product says ahead or behind."""
    a, b, c = arr(a, b, c)
    return np.sign(np.sum((b - a) * (c - a), axis=-1)).astype(int)


def side_of_line_5(a, b, c):
    """Forgets to subtract a from c: compares the way b − a with the place c."""
    a, b, c = arr(a, b, c)
    u = b - a
    return np.sign(u[..., 0] * c[..., 1] - u[..., 1] * c[..., 0]).astype(int)


def side_of_line_6(a, b, c):
    """Two sides and no line: a point on the line counts as right of it."""
    a, b, c = arr(a, b, c)
    u, v = b - a, c - a
    left = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0] > 0
    return np.where(left, 1, -1)


def _parity(point, vertices, faces, moves=2, above=True):
    """Parity along +z with the moved point; `moves` tells how many powers of ε count."""
    p = np.asarray(point, dtype=float)[..., None, :]
    corners = _corners(vertices, faces)
    turns = []
    for i in range(3):
        a, b = corners[i], corners[(i + 1) % 3]
        turn = orient2d(a[:, :2], b[:, :2], p[..., :2])
        for k, factor in enumerate((a[:, 1] - b[:, 1], b[:, 0] - a[:, 0])):
            if k < moves:
                turn = np.where(turn == 0, np.sign(factor).astype(int), turn)
        turns.append(turn)
    up = np.all(np.stack(turns) > 0, axis=0)
    down = np.all(np.stack(turns) < 0, axis=0)
    turn = up.astype(int) - down.astype(int)
    side = orient3d(*corners, p)
    for i, j in ((1, 2), (2, 0), (0, 1)):
        tilt = orient2d(*(c[:, [i, j]] for c in corners))
        side = np.where(side == 0, tilt, side)
    crossed = turn != 0
    if above:
        crossed = crossed & (side == -turn)
    return crossed.sum(axis=-1) % 2 == 1


def inside_by_parity_1(point, vertices, faces):
    """The slide's test for convex solids: inside is behind the planes of all faces."""
    return np.all(_heights(point, vertices, faces) < 0, axis=-1)


def _met(start, end, vertices, faces):
    corners = np.asarray(vertices, dtype=float)[np.asarray(faces)]
    t, x, n, (a, b, c), _ = _plane_share(start[..., None, :], end[..., None, :], corners)
    with np.errstate(all="ignore"):
        w = _weights(x, n, a, b, c)
    return (t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1)


def inside_by_parity_2(point, vertices, faces):
    """Counts the faces that a segment straight up meets; an edge counts for both faces."""
    p = np.asarray(point, dtype=float)
    up = np.array([0.0, 0.0, 1e4])
    return _met(p, p + up, vertices, faces).sum(axis=-1) % 2 == 1


def inside_by_parity_3(point, vertices, faces):
    """Walks 10 m in a slanted direction and takes that for far away."""
    p = np.asarray(point, dtype=float)
    way = np.array([0.3713, 0.5279, 0.7639])
    way = 10.0 * way / np.linalg.norm(way)
    return _met(p, p + way, vertices, faces).sum(axis=-1) % 2 == 1


def inside_by_parity_4(point, vertices, faces):
    """Does not ask whether a face is above or below: counts along the whole line."""
    return _parity(point, vertices, faces, above=False)


def inside_by_parity_5(point, vertices, faces):
    """Inside as soon as there is a face both above and below, odd or not."""
    p = np.asarray(point, dtype=float)
    way = np.array([1.13e-3, 1.71e-3, 1.0]) * 1e4
    above = _met(p, p + way, vertices, faces).any(axis=-1)
    below = _met(p, p - way, vertices, faces).any(axis=-1)
    return above & below


def inside_by_parity_6(point, vertices, faces):
    """Moves the point along x alone, by ε: edges parallel to x are still hit."""
    return _parity(point, vertices, faces, moves=1)


def _solid_angles(point, vertices, faces):
    p = np.asarray(point, dtype=float)[..., None, :]
    f = np.asarray(faces, dtype=int).reshape(-1, 3)
    return solid_angle(p, np.asarray(vertices, dtype=float)[f])


def winding_number_1(point, vertices, faces):
    """Wrong sign: −1 inside faces that look outwards."""
    return -np.sum(_solid_angles(point, vertices, faces), axis=-1) / (4 * np.pi)


def winding_number_2(point, vertices, faces):
    """A number of turns is whole: rounds it, also for a surface with holes."""
    w = np.sum(_solid_angles(point, vertices, faces), axis=-1) / (4 * np.pi)
    return np.round(w)


def winding_number_3(point, vertices, faces):
    """Adds sizes: a front that is seen counts like a back."""
    return np.abs(_solid_angles(point, vertices, faces)).sum(axis=-1) / (4 * np.pi)


def winding_number_4(point, vertices, faces):
    """Divides by 2π, as for a curve in the plane."""
    total = 0.0
    for i, j, k in faces:
        total = total + solid_angle(point, [vertices[i], vertices[j], vertices[k]])
    return total / (2 * np.pi)


def winding_number_5(point, vertices, faces):
    """A number of turns cannot be negative: takes the size of the sum."""
    return np.abs(np.sum(_solid_angles(point, vertices, faces), axis=-1)) / (4 * np.pi)


def winding_number_6(point, vertices, faces):
    """Takes area times cosine over distance squared for a face's solid angle, near or far."""
    p = np.asarray(point, dtype=float)[..., None, :]
    a, b, c = _corners(vertices, faces)
    area = np.cross(b - a, c - a) / 2
    way = (a + b + c) / 3 - p
    distance = np.linalg.norm(way, axis=-1)
    angle = np.vecdot(way, area) / np.where(distance > 0, distance, np.inf) ** 3
    return np.sum(angle, axis=-1) / (4 * np.pi)


def _used(vertices, faces):
    f = np.asarray(faces, dtype=int).reshape(-1, 3)
    return np.asarray(vertices, dtype=float)[np.unique(f)]


def _edges_meet(vertices_a, faces_a, vertices_b, faces_b):
    there = edges_through_faces(vertices_a, faces_a, vertices_b, faces_b)[1]
    back = edges_through_faces(vertices_b, faces_b, vertices_a, faces_a)[1]
    return len(there) > 0 or len(back) > 0


def polyhedra_intersect_1(vertices_a, faces_a, vertices_b, faces_b):
    """Tests the corners of each solid against the other and no edges."""
    if not len(faces_a) or not len(faces_b):
        return False
    ours = _parity(_used(vertices_a, faces_a), vertices_b, faces_b)
    theirs = _parity(_used(vertices_b, faces_b), vertices_a, faces_a)
    return bool(ours.any() or theirs.any())


def polyhedra_intersect_2(vertices_a, faces_a, vertices_b, faces_b):
    """Tests edges against faces only: a stone in a plum is not noticed."""
    return _edges_meet(vertices_a, faces_a, vertices_b, faces_b)


def polyhedra_intersect_3(vertices_a, faces_a, vertices_b, faces_b):
    """Looks only from A: edges of A through faces of B, and corners of A in B."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    edges, _ = edges_through_faces(vertices_a, faces_a, vertices_b, faces_b)
    if len(edges):
        return True
    return bool(_parity(_used(vertices_a, faces_a), vertices_b, faces_b).any())


def polyhedra_intersect_4(vertices_a, faces_a, vertices_b, faces_b):
    """Two solids meet if their boxes along the axes overlap."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    a, b = _used(vertices_a, faces_a), _used(vertices_b, faces_b)
    low, high = np.maximum(a.min(axis=0), b.min(axis=0)), np.minimum(a.max(axis=0), b.max(axis=0))
    return bool(np.all(low <= high))


def polyhedra_intersect_5(vertices_a, faces_a, vertices_b, faces_b):
    """Tests one corner of each for lying within: a solid of two parts may hide the other."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    if _edges_meet(vertices_a, faces_a, vertices_b, faces_b):
        return True
    first_a = np.asarray(vertices_a, dtype=float)[faces_a[0][0]]
    first_b = np.asarray(vertices_b, dtype=float)[faces_b[0][0]]
    return bool(_parity(first_a, vertices_b, faces_b) or _parity(first_b, vertices_a, faces_a))


def polyhedra_intersect_6(vertices_a, faces_a, vertices_b, faces_b):
    """Within means within the box around the other: a solid in a hollow counts as inside."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    if _edges_meet(vertices_a, faces_a, vertices_b, faces_b):
        return True
    a, b = _used(vertices_a, faces_a), _used(vertices_b, faces_b)

    def within(these, those):
        low, high = those.min(axis=0), those.max(axis=0)
        return bool(np.all((these >= low) & (these <= high)))

    return within(a, b) or within(b, a)
