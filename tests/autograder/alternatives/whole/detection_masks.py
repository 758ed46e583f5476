"""Right answers by masks and comprehensions, written into arrays made for them; one number is a case of its own."""

import numpy as np

FOREVER = float("inf")


def spread(*values):
    return [np.array(each, dtype=float) for each in np.broadcast_arrays(*values)]


def signed_distance(point, normal, offset):
    point, normal = np.asarray(point, float), np.asarray(normal, float)
    product = point * normal
    return (product[..., 0] + product[..., 1] + product[..., 2] + offset) / (normal**2).sum(-1) ** 0.5


def side_of_plane(separation, tolerance=0.0):
    s, near = spread(separation, tolerance)
    side = np.asarray(np.sign(s))
    side[abs(s) <= near] = 0
    return side.astype(int) if side.ndim else int(side)


def time_of_impact_interpolated(separation_0, separation_1, t, dt):
    before, after, t, dt = spread(separation_0, separation_1, t, dt)
    found = np.full_like(before, FOREVER)
    hit = (before >= 0) & (after < 0)
    found[hit] = t[hit] + dt[hit] * (before[hit] / (before[hit] + abs(after[hit])))
    return found


def count_impacts(position, velocity, length, dt, duration):
    x, v, length, dt, duration = spread(position, velocity, length, dt, duration)
    left, count = np.round(duration / dt) * dt, np.zeros_like(x)
    while True:
        wall = np.where(v > 0, length, 0.0)
        arrives = np.divide(wall - x, v, out=np.full_like(x, FOREVER), where=v != 0)
        hits = (arrives <= left) & (left > 0)
        if not hits.any():
            return count.astype(int), x + v * left
        x, v, left = np.where(hits, wall, x), np.where(hits, -v, v), np.where(hits, left - arrives, left)
        count = count + hits


def time_of_impact_exact(separation, normal_velocity, normal_acceleration):
    s, u, a = spread(separation, normal_velocity, normal_acceleration)
    s[s < 0] = 0
    found = np.full_like(s, FOREVER)
    with np.errstate(all="ignore"):
        root = np.sqrt(u**2 - 2 * a * s)
        towards = (u < 0) & (u**2 >= 2 * a * s)
        back = (u >= 0) & (a < 0)
        found[towards] = (2 * s / (root - u))[towards]
        found[back] = ((u + root) / -a)[back]
    return found


def overlap_interval(distance, normal_velocity, radius, thickness, dt):
    x, u, r, w, dt = spread(distance, normal_velocity, radius, thickness, dt)
    start, end = np.zeros_like(x), dt.copy()
    for face, outward in ((r, 1), (-(w + r), -1)):  # within: outward * (x + u t) <= outward * face
        with np.errstate(all="ignore"):
            at = (face - x) / u
        rate, inside = outward * u, outward * x <= outward * face
        start = np.where(rate < 0, np.maximum(start, at), start)
        end = np.where(rate > 0, np.minimum(end, at), end)
        end = np.where((rate == 0) & ~inside, -FOREVER, end)
    none = start > end
    start[none], end[none] = FOREVER, -FOREVER
    return start, end


def missing_probability(speed, thickness, radius, dt):
    speed, thickness, radius, dt = spread(speed, thickness, radius, dt)
    way = speed * dt
    ratio = np.ones_like(way)
    np.divide(thickness + 2 * radius, way, out=ratio, where=way > 0)
    return 1 - ratio.clip(max=1)
