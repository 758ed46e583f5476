"""Right answers for one case alone: one ray, one pair of balls and one pair of hulls at a time, with plain loops."""

import math

import numpy as np


def dot(a, b):
    total = 0.0
    for x, y in zip(a, b, strict=True):
        total += float(x) * float(y)
    return total


def minus(a, b):
    return [float(x) - float(y) for x, y in zip(a, b, strict=True)]


def moved(a, along, t):
    return [float(x) + float(y) * t for x, y in zip(a, along, strict=True)]


def ray_sphere(origin, direction, radius):
    a, b, c = dot(direction, direction), 2 * dot(origin, direction), dot(origin, origin) - radius**2
    if c <= 0:
        return 0.0
    if a == 0 or b * b < 4 * a * c:
        return math.inf
    t = (-b - math.sqrt(b * b - 4 * a * c)) / (2 * a)
    return t if t >= 0 else math.inf


def sweep_sphere_sphere(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    t = ray_sphere(minus(position_a, position_b), minus(velocity_a, velocity_b), radius_a + radius_b)
    return t if t <= dt else math.inf


def missed_share(speed, radius_a, radius_b, dt):
    step, reach = speed * dt, radius_a + radius_b
    if step == 0:
        return 0.0
    if step > 2 * reach:
        return 1 - 4 * reach / (3 * step)
    return step**2 / (12 * reach**2)


def ray_box(origin, direction, half_extents):
    entry, leaving = 0.0, math.inf
    for x, u, h in zip(origin, direction, half_extents, strict=True):
        if u == 0:
            if abs(x) > h:
                return math.inf, -math.inf
            continue
        first, last = sorted([(-h - x) / u, (h - x) / u])
        entry, leaving = max(entry, first), min(leaving, last)
    return (entry, leaving) if entry <= leaving else (math.inf, -math.inf)


def ray_capsule(origin, direction, start, end, radius):
    ends = min(ray_sphere(minus(origin, each), direction, radius) for each in (start, end))
    axis, x = minus(end, start), minus(origin, start)
    long = dot(axis, axis)
    if long == 0:
        return ends
    place, rate = dot(x, axis) / long, dot(direction, axis) / long
    side = ray_sphere(moved(x, axis, -place), moved(direction, axis, -rate), radius)
    if side < math.inf and 0 <= place + rate * side <= 1:
        return min(side, ends)
    return ends


def motion_bound(velocity, angular_velocity, reach, normal):
    (a, b, c), (p, q, r) = normal, angular_velocity
    across = [b * r - c * q, c * p - a * r, a * q - b * p]
    return dot(velocity, normal) + reach * math.sqrt(dot(across, across))


def rotated(point, rotation):
    angle = math.sqrt(dot(rotation, rotation))
    if angle == 0:
        return np.asarray(point, dtype=float)
    axis = np.asarray(rotation) / angle
    along = dot(point, axis) * axis
    return along + (point - along) * math.cos(angle) + np.cross(axis, point) * math.sin(angle)


def nearest_to_origin(points):
    """Wolfe's algorithm: a corner more, and the nearest point of what the chosen corners span, until none is nearer."""
    chosen = [int(np.argmin([dot(p, p) for p in points]))]
    weights = np.array([1.0])
    while True:
        x = weights @ points[chosen]
        next_one = int(np.argmin(points @ x))
        if next_one in chosen or points[next_one] @ x >= x @ x - 1e-13 * np.max(np.abs(points)) ** 2:
            return x
        chosen, weights = [*chosen, next_one], np.append(weights, 0.0)
        while True:
            corners = points[chosen]
            ways = corners[1:] - corners[0]
            shares = np.linalg.lstsq(ways @ ways.T, -ways @ corners[0], rcond=None)[0]
            wanted = np.array([1 - shares.sum(), *shares])
            if np.all(wanted > 0):
                weights = wanted
                break
            part = min(w / (w - v) for w, v in zip(weights, wanted, strict=True) if v <= 0)
            weights = weights + part * (wanted - weights)
            keep = weights > 1e-14
            chosen, weights = [k for k, kept in zip(chosen, keep, strict=True) if kept], weights[keep]


def separation_of_hulls(points_a, points_b):
    ways = np.array([a - b for a in points_a for b in points_b])
    x = nearest_to_origin(ways)
    size = math.sqrt(dot(x, x))
    return (size, x / size) if size > 1e-9 * np.max(np.abs(ways)) else (0.0, 0 * x)


def advance(points_a, position_a, velocity_a, angular_velocity_a, points_b, dt, tolerance, looks):
    points, spin = np.asarray(points_a, dtype=float), np.asarray(angular_velocity_a, dtype=float)
    reach = max(math.sqrt(dot(p, p)) for p in points)
    t, used = 0.0, 0
    while used < looks:
        used += 1
        place = np.array(moved(position_a, velocity_a, t))
        apart, normal = separation_of_hulls([place + rotated(p, spin * t) for p in points], points_b)
        if apart <= tolerance:
            return t, used
        fastest = motion_bound(velocity_a, spin, reach, -normal)
        if fastest <= 0:
            return math.inf, used
        t += apart / fastest
        if t > dt:
            return math.inf, used
    return math.nan, looks
