"""Right answers by other formulas: complex numbers, angles, projections, matrices of neighbours."""

import numpy as np


def dot(a, b):
    return np.einsum("...i,...i", np.asarray(a, dtype=float), np.asarray(b, dtype=float))


def size(a):
    return np.sqrt(dot(a, a))


def column(a):
    return np.asarray(a, dtype=float)[..., None]


def seek(position, target, max_speed):
    way = np.asarray(target, dtype=float) - position
    far = size(way)
    return way * column(np.where(far > 0, max_speed / np.where(far > 0, far, 1), 0.0))


def arrive(position, target, max_speed, slowing_radius):
    """The way over the larger of its length and the radius."""
    way = np.asarray(target, dtype=float) - position
    return way * column(max_speed / np.maximum(size(way), slowing_radius))


def repelling_force(separation, normal, strength, reach):
    outside = np.minimum(np.maximum(separation, 0), reach)
    share = (1 - outside / reach) ** 2
    return np.asarray(normal) * column(strength * share)


def side_of(towards, *wishes):
    towards = np.asarray(towards, dtype=float)
    x, y = towards[..., 0], towards[..., 1]
    far = np.hypot(x, y)
    safe = np.where(far > 0, far, 1)
    side = np.stack([np.where(far > 0, -y / safe, 1.0), np.where(far > 0, x / safe, 0.0), 0 * x], axis=-1)
    for wish in wishes[::-1]:
        across = wish - column(dot(wish, towards)) * towards
        across = across - column(dot(across, towards)) * towards
        length = size(across)
        named = length > 1e-9 * size(wish)
        side = np.where(column(named) > 0, across / column(np.where(length > 0, length, 1)), side)
    return side


def tangent_point(position, heading, centre, radius):
    """By the sine and the cosine of the angle at the centre."""
    away = np.asarray(position, dtype=float) - centre
    far = size(away)
    back = away / column(np.where(far > 0, far, 1))
    cosine = np.minimum(radius / np.where(far > 0, far, 1), 1.0)
    cosine = np.where(far > radius, cosine, 1.0)
    sine = np.sqrt((1 - cosine) * (1 + cosine))
    out = column(cosine) * back + column(sine) * side_of(-back, heading)
    out = np.where(column(far) > 0, out, [0.0, 0.0, 1.0])
    return centre + column(radius) * out


def nearest_approach(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    """Seen from A."""
    x = np.asarray(position_b, dtype=float) - position_a
    u = np.asarray(velocity_b, dtype=float) - velocity_a
    with np.errstate(all="ignore"):
        speed = size(u)
        along = -dot(x, u / column(speed)) / speed
    time = np.where((speed > 0) & (along > 0), along, 0.0)
    return time, size(x + column(time) * u) - (np.asarray(radius_a) + radius_b)


def separation(position, first, second):
    """By a matrix with a 1 for each pair."""
    p = np.asarray(position, dtype=float)
    near = np.zeros((len(p), len(p)))
    near[first, second] = near[second, first] = 1
    apart = p[:, None] - p
    squared = np.sum(apart**2, axis=-1)
    return np.einsum("ij,ijk->ik", near / np.where(squared > 0, squared, 1), apart)


def towards_mean(value, first, second):
    x = np.asarray(value, dtype=float)
    near = np.zeros((len(x), len(x)))
    near[first, second] = near[second, first] = 1
    count = near.sum(axis=1, keepdims=True)
    return np.where(count > 0, near @ x / np.maximum(count, 1) - x, 0.0)


def cap_of_cone(relative_velocity, towards, reach, horizon, dt):
    u, x = np.asarray(relative_velocity, dtype=float), np.asarray(towards, dtype=float)
    overlaps = size(x) <= reach
    time = np.where(overlaps, dt, horizon)
    w = u - x / column(time)
    length = size(w)
    against = -dot(w, x)
    capped = overlaps | ((against > 0) & (against**2 > (reach * length) ** 2))
    back = np.where(column(size(x)) > 0, -x / column(np.where(size(x) > 0, size(x), 1)), [1.0, 0.0])
    normal = np.where(column(length) > 0, w / column(np.where(length > 0, length, 1)), back)
    return capped, reach / time - length, normal


def orca_half_plane(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    """With complex numbers: a side of the cone is the way to B, turned by the angle whose sine is R/L."""
    u = np.asarray(velocity_a, dtype=float) - velocity_b
    x = np.asarray(position_b, dtype=float) - position_a
    reach = np.asarray(radius_a, dtype=float) + radius_b
    capped, depth, out = cap_of_cone(u, x, reach, horizon, dt)
    place, relative = x[..., 0] + 1j * x[..., 1], u[..., 0] + 1j * u[..., 1]
    far = np.abs(place)
    half = np.arcsin(np.where(capped, 0.0, reach) / np.where(far > 0, far, 1))
    sign = np.where((place.conjugate() * relative).imag > 0, 1, -1)
    normal = 1j * sign * np.where(far > 0, place, 1) / np.where(far > 0, far, 1) * np.exp(1j * sign * half)
    change = -(normal.conjugate() * relative).real
    normal = np.where(column(capped) > 0, out, np.stack([normal.real, normal.imag], axis=-1))
    return velocity_a + column(np.where(capped, depth, change) / 2) * normal, normal
