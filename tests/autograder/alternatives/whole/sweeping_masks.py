"""Right answers for many cases, with masks that pick out what is hit, and the quadratic formula as it is in books."""

import numpy as np


def dot(a, b):
    return np.sum(np.asarray(a) * np.asarray(b), axis=-1)


def column(number):
    return np.asarray(number, dtype=float)[..., np.newaxis]


def ray_sphere(origin, direction, radius):
    a, b = dot(direction, direction), 2 * dot(origin, direction)
    a, b, c = np.broadcast_arrays(a, b, dot(origin, origin) - np.square(radius))
    t = np.full(a.shape, np.inf)
    under = b**2 - 4 * a * c
    hit = (under >= 0) & (b < 0)
    t[hit] = (-b[hit] - np.sqrt(under[hit])) / (2 * a[hit])
    t[c <= 0] = 0.0
    return t


def sweep_sphere_sphere(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    x, u = np.subtract(position_a, position_b), np.subtract(velocity_a, velocity_b)
    t, dt = np.broadcast_arrays(ray_sphere(x, u, np.add(radius_a, radius_b)), dt)
    t = np.array(t)
    t[t > dt] = np.inf
    return t


def missed_share(speed, radius_a, radius_b, dt):
    step, chord = np.broadcast_arrays(np.multiply(speed, dt), 2 * np.add(radius_a, radius_b))
    share = np.zeros(step.shape)
    short, long = (step > 0) & (step <= chord), step > chord
    share[short] = (step[short] / chord[short]) ** 2 / 3
    share[long] = 1 - 2 * chord[long] / (3 * step[long])
    return share


def ray_box(origin, direction, half_extents):
    x, u, h = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (origin, direction, half_extents)))
    entry, leaving = np.zeros(x.shape[:-1]), np.full(x.shape[:-1], np.inf)
    for axis in range(3):
        p, v, half = x[..., axis], u[..., axis], h[..., axis]
        moves = v != 0
        speed = np.where(moves, v, 1)
        faces = np.stack([(-half - p) / speed, (half - p) / speed])
        entry = np.where(moves, np.maximum(entry, faces.min(axis=0)), entry)
        leaving = np.where(moves, np.minimum(leaving, faces.max(axis=0)), leaving)
        leaving = np.where(~moves & (np.abs(p) > half), -np.inf, leaving)
    miss = entry > leaving
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leaving)


def ray_capsule(origin, direction, start, end, radius):
    """With a projection of everything onto the plane across the segment."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    length = np.linalg.norm(b - a, axis=-1)
    e = (b - a) / column(np.where(length > 0, length, 1))
    across = np.eye(3) - e[..., :, None] * e[..., None, :]
    x = np.asarray(origin) - a
    side = ray_sphere(np.matvec(across, x), np.matvec(across, np.asarray(direction, dtype=float)), radius)
    hit = np.isfinite(side)
    place = dot(x, e) + np.where(hit, side, 0) * dot(direction, e)
    balls = np.minimum(ray_sphere(x, direction, radius), ray_sphere(origin - b, direction, radius))
    return np.where(hit & (length > 0) & (place >= 0) & (place <= length), np.minimum(side, balls), balls)


def motion_bound(velocity, angular_velocity, reach, normal):
    n, w = np.asarray(normal), np.asarray(angular_velocity)
    along_n = np.sum(n * w, axis=-1, keepdims=True) * n
    return dot(velocity, n) + np.asarray(reach) * np.linalg.norm(w - along_n, axis=-1)


def rotated(point, rotation):
    angle = np.linalg.norm(rotation)
    x, y, z = rotation / angle if angle else np.zeros(3)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return point @ (np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k).T


def triples(n):
    i, j, k = np.meshgrid(*[np.arange(n)] * 3, indexing="ij")
    return np.stack([i, j, k], axis=-1)[(i <= j) & (j <= k)]


def separation_of_hulls(points_a, points_b):
    """Of all triangles of differences, flat ones included, the nearest that has nothing before it."""
    difference = (np.asarray(points_a)[:, None] - np.asarray(points_b)[None]).reshape(-1, 3)
    a, b, c = np.moveaxis(difference[triples(len(difference))], 1, 0)
    places = np.concatenate([on_edge(a, b), on_edge(b, c), on_edge(a, c), on_face(a, b, c)])
    x = places[np.argmin(dot(places, places))]
    size = np.linalg.norm(x)
    if size < 1e-9 or np.min(difference @ x) < size**2 - 1e-9 * np.max(np.abs(difference)) ** 2:
        return 0.0, np.zeros(3)
    return size, x / size


def on_edge(a, b):
    """The points between a and b that are nearest to the origin."""
    way = b - a
    long = dot(way, way)
    return a + column(np.clip(-dot(a, way) / np.where(long > 0, long, 1), 0, 1)) * way


def on_face(a, b, c):
    """The feet of the origin that are within their triangles."""
    n = np.cross(b - a, c - a)
    size = dot(n, n)
    whole = size > 1e-18
    a, b, c, n, size = (each[whole] for each in (a, b, c, n, size))
    x = column(dot(a, n) / size) * n
    within = np.all([dot(np.cross(q - p, x - p), n) >= 0 for p, q in ((a, b), (b, c), (c, a))], axis=0)
    return x[within]


def advance(points_a, position_a, velocity_a, angular_velocity_a, points_b, dt, tolerance, looks):
    points, b = np.asarray(points_a, dtype=float), np.asarray(points_b, dtype=float)
    p, v, w = (np.asarray(each, dtype=float) for each in (position_a, velocity_a, angular_velocity_a))
    clock, reach = 0.0, np.linalg.norm(points, axis=1).max()
    for number in range(looks):
        distance, n = separation_of_hulls(p + v * clock + rotated(points, w * clock), b)
        if distance <= tolerance:
            return clock, number + 1
        rate = float(motion_bound(v, w, reach, -n))
        clock += distance / rate if rate > 0 else np.inf
        if clock > dt:
            return np.inf, number + 1
    return np.nan, looks
