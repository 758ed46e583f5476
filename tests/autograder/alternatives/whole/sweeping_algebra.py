"""Right answers by other formulas: half chords, faces cut off in turn, one equation for a shape, Lawson and Hanson."""

import numpy as np


def dot(a, b):
    return np.einsum("...i,...i", np.asarray(a, dtype=float), np.asarray(b, dtype=float))


def size(a):
    return np.sqrt(dot(a, a))


def ray_sphere(origin, direction, radius):
    """Half a chord before the nearest point of the ray."""
    x, u = np.asarray(origin, dtype=float), np.asarray(direction, dtype=float)
    squared, speed = np.square(radius), size(u)
    way = u / np.where(speed > 0, speed, 1)[..., None]
    ahead = -dot(x, way)
    half = squared - dot(x + ahead[..., None] * way, x + ahead[..., None] * way)
    with np.errstate(all="ignore"):
        time = (ahead - np.sqrt(half)) / speed
    time = np.where((speed > 0) & (ahead > 0) & (half >= 0), time, np.inf)
    return np.where(dot(x, x) <= squared, 0.0, time)


def sweep_sphere_sphere(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Seen from A."""
    x = np.asarray(position_b, dtype=float) - position_a
    u = np.asarray(velocity_b, dtype=float) - velocity_a
    time = ray_sphere(x, u, np.asarray(radius_a) + radius_b)
    return np.where(time > dt, np.inf, time)


def missed_share(speed, radius_a, radius_b, dt):
    """From the way as a share of the longest chord."""
    chord = 2 * (np.asarray(radius_a) + radius_b)
    with np.errstate(all="ignore"):
        q = np.asarray(speed * np.asarray(dt) / chord)
        share = np.where(q <= 1, q * q / 3, 1 - 2 / (3 * q))
    return np.where(np.asarray(speed) * dt > 0, share, 0.0)


def ray_box(origin, direction, half_extents):
    """Cuts off what is beyond each of the six faces."""
    x, u, h = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (origin, direction, half_extents)))
    room, rate = np.concatenate([h - x, h + x], axis=-1), np.concatenate([u, -u], axis=-1)
    with np.errstate(all="ignore"):
        times = room / rate
    entry = np.max(np.where(rate < 0, times, 0.0), axis=-1).clip(0)
    leaving = np.min(np.where(rate > 0, times, np.inf), axis=-1)
    outside = np.any((rate == 0) & (room < 0), axis=-1)
    good = (entry <= leaving) & ~outside
    return np.where(good, entry, np.inf), np.where(good, leaving, -np.inf)


def ray_capsule(origin, direction, start, end, radius):
    """One quadratic equation for the cylinder, multiplied by the square of its length."""
    x, u = np.asarray(origin, dtype=float) - start, np.asarray(direction, dtype=float)
    e = np.asarray(end, dtype=float) - start
    ee, eu, ex = dot(e, e), dot(e, u), dot(e, x)
    a = ee * dot(u, u) - eu**2
    b = ee * dot(u, x) - eu * ex
    c = ee * (dot(x, x) - np.square(radius)) - ex**2
    with np.errstate(all="ignore"):
        side = np.where(c <= 0, 0.0, (-b - np.sqrt(b * b - a * c)) / a)
        place = ex + side * eu
    side = np.where((side >= 0) & (place >= 0) & (place <= ee) & (ee > 0), side, np.inf)
    balls = np.minimum(ray_sphere(x, u, radius), ray_sphere(x - e, u, radius))
    return np.fmin(side, balls)


def motion_bound(velocity, angular_velocity, reach, normal):
    """With the sine of the angle between ω and n."""
    w = np.asarray(angular_velocity, dtype=float)
    return dot(velocity, normal) + np.sqrt(np.maximum(dot(w, w) - dot(w, normal) ** 2, 0)) * reach


def rotated(point, rotation):
    """By a quaternion."""
    angle = size(rotation)
    s, v = np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) / 2 * np.asarray(rotation)
    return point + 2 * np.cross(v, np.cross(v, point) + s * np.asarray(point))


def separation_of_hulls(points_a, points_b):
    """Least squares without negative weights: Lawson and Hanson."""
    difference = (np.asarray(points_a)[:, None] - np.asarray(points_b)[None]).reshape(-1, 3)
    metre = np.max(np.abs(difference)) or 1.0
    e = np.column_stack([difference / metre, np.ones(len(difference))]).T
    f = np.array([0.0, 0, 0, 1])
    weights, free = np.zeros(len(difference)), np.zeros(len(difference), dtype=bool)
    for _ in range(100):
        gain = np.where(free, -np.inf, e.T @ (f - e @ weights))
        if np.max(gain) <= 1e-14:
            break
        free[np.argmax(gain)] = True
        while True:
            wanted = np.zeros(len(weights))
            wanted[free] = np.linalg.lstsq(e[:, free], f, rcond=None)[0]
            down = free & (wanted <= 0)
            if not np.any(down):
                break
            part = np.min(weights[down] / (weights[down] - wanted[down]))
            weights = weights + part * (wanted - weights)
            free &= weights > 1e-15
            weights[~free] = 0
        weights = wanted
    x = weights @ difference / np.sum(weights)
    far = size(x)
    return (far, x / far) if far > 1e-8 * metre else (0.0, 0 * x)


def advance(points_a, position_a, velocity_a, angular_velocity_a, points_b, dt, tolerance, looks):
    a, p, v, w = (np.asarray(each, dtype=float) for each in (points_a, position_a, velocity_a, angular_velocity_a))
    reach = np.sqrt(np.max(np.sum(a**2, axis=1)))
    t = 0.0
    for used in range(1, looks + 1):
        s, n = separation_of_hulls(rotated(a, w * t) + (p + t * v), points_b)
        if s <= tolerance:
            return t, used
        nearing = motion_bound(-v, w, reach, n)
        t = t + s / nearing if nearing > 0 else np.inf
        if t > dt:
            return np.inf, used
    return np.nan, looks
