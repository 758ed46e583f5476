"""Right answers for one case alone: one point, segment or pair of solids at a time, with exact fractions for signs."""

import math
from fractions import Fraction

import numpy as np


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def area(a, b, c):
    (ux, uy), (vx, vy) = minus(b, a), minus(c, a)
    return ux * vy - uy * vx


def sign(number):
    return int(number > 0) - int(number < 0)


def exact(point):
    return [Fraction(float(x)) for x in point]


def face_planes(vertices, faces):
    planes = []
    for i, j, k in faces:
        a, b, c = vertices[i], vertices[j], vertices[k]
        n = np.array(cross(minus(b, a), minus(c, a)))
        n = n / math.sqrt(dot(n, n))
        planes.append((n, -dot(n, a)))
    return np.array([n for n, _ in planes]), np.array([d for _, d in planes])


def convex_separation(point, vertices, faces):
    best, number = -math.inf, 0
    for k, (n, d) in enumerate(zip(*face_planes(vertices, faces), strict=True)):
        if dot(n, point) + d > best:
            best, number = dot(n, point) + d, k
    return best, number


def segment_triangle(start, end, triangle):
    a, b, c = triangle
    n = cross(minus(b, a), minus(c, a))
    before, after = dot(n, minus(start, a)), dot(n, minus(end, a))
    nowhere = math.inf, np.full(3, math.nan)
    if before * after > 0 or before == after:
        return nowhere
    t = before / (before - after)
    x = [p + t * (q - p) for p, q in zip(start, end, strict=True)]
    weights = [dot(n, cross(minus(u, x), minus(v, x))) / dot(n, n) for u, v in ((b, c), (c, a), (a, b))]
    return (t, np.array(weights)) if min(weights) >= 0 else nowhere


def side_of_line(a, b, c):
    return sign(area(a, b, c))


def beside(a, b, p):
    """Of the point moved by tiny steps."""
    a, b, p = exact(a)[:2], exact(b)[:2], exact(p)[:2]
    return sign(area(a, b, p)) or sign(a[1] - b[1]) or sign(b[0] - a[0])


def is_above(a, b, c, p):
    turns = {beside(*edge, p) for edge in ((a, b), (b, c), (c, a))}
    if len(turns) > 1 or turns == {0}:
        return False
    a, b, c, p = map(exact, (a, b, c, p))
    return sign(dot(cross(minus(b, a), minus(c, a)), minus(p, a))) == -turns.pop()


def inside_by_parity(point, vertices, faces):
    inside = False
    for face in faces:
        corners = vertices[face]
        low, high = corners.min(axis=0), corners.max(axis=0)
        near = low[0] <= point[0] <= high[0] and low[1] <= point[1] <= high[1] and point[2] <= high[2]
        inside ^= bool(near and is_above(*corners, point))
    return inside


def solid_angle(point, triangle):
    a, b, c = (minus(corner, point) for corner in triangle)
    la, lb, lc = (math.sqrt(dot(v, v)) for v in (a, b, c))
    volume = dot(a, cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0])))
    if volume == 0:
        return 0.0
    return 2 * math.atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)


def winding_number(point, vertices, faces):
    return math.fsum(solid_angle(point, vertices[face]) for face in faces) / (4 * math.pi)


def crosses(a, b):
    (v, f), (w, g) = a, b
    pairs = {frozenset((face[k - 1], face[k])) for face in f.tolist() for k in range(3)}
    for pair in pairs:
        start, end = (v[k] for k in pair)
        for face in g:
            corners = w[face]
            ends = np.array([start, end])
            apart = np.any(ends.max(axis=0) < corners.min(axis=0)) or np.any(corners.max(axis=0) < ends.min(axis=0))
            if not apart and math.isfinite(segment_triangle(start, end, corners)[0]):
                return True
    return False


def polyhedra_intersect(vertices_a, faces_a, vertices_b, faces_b):
    a, b = (np.asarray(vertices_a), np.asarray(faces_a)), (np.asarray(vertices_b), np.asarray(faces_b))
    if crosses(a, b) or crosses(b, a):
        return True
    return any(inside_by_parity(v[k], *other) for (v, f), other in ((a, b), (b, a)) for k in set(f.ravel().tolist()))
