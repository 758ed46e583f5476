"""Right answers for many cases, with masks that pick out what is special, and np.add.at for the neighbours."""

import numpy as np


def norm(a):
    return np.linalg.norm(np.asarray(a, dtype=float), axis=-1)


def seek(position, target, max_speed):
    way = np.array(np.subtract(target, position), dtype=float)
    length = norm(way)
    moves = length > 0
    way[moves] /= length[moves][..., np.newaxis]
    return np.asarray(max_speed)[..., np.newaxis] * way


def arrive(position, target, max_speed, slowing_radius):
    speed, share = np.broadcast_arrays(max_speed, norm(np.subtract(target, position)) / slowing_radius)
    speed = np.array(speed, dtype=float)
    speed[share < 1] *= share[share < 1]
    return seek(position, target, speed)


def repelling_force(separation, normal, strength, reach):
    s, strength, reach = (np.array(each, dtype=float) for each in np.broadcast_arrays(separation, strength, reach))
    s[s < 0] = 0.0
    size = np.asarray(strength * (1 - s / reach) ** 2)
    size[s >= reach] = 0.0
    return size[..., np.newaxis] * np.asarray(normal)


def across(wish, towards):
    part = wish - np.sum(wish * towards, axis=-1, keepdims=True) * towards
    return part - np.sum(part * towards, axis=-1, keepdims=True) * towards


def side_of(towards, *wishes):
    towards = np.asarray(towards, dtype=float)
    side = np.cross([0.0, 0.0, 1.0], towards)
    flat = norm(side) == 0
    side[flat] = [1.0, 0.0, 0.0]
    side = side / norm(side)[..., np.newaxis]
    for wish in reversed(wishes):
        part = across(np.asarray(wish, dtype=float), towards)
        named = norm(part) > 1e-9 * norm(wish)
        part = part / np.where(named, norm(part), 1.0)[..., np.newaxis]
        side = np.where(named[..., np.newaxis], part, side)
    return side


def tangent_point(position, heading, centre, radius):
    to_centre = np.subtract(centre, position).astype(float)
    far, r = np.broadcast_arrays(norm(to_centre), np.asarray(radius, dtype=float))
    r = np.array(r)
    towards = to_centre / np.where(norm(to_centre) > 0, norm(to_centre), 1.0)[..., np.newaxis]
    t, s = r.copy(), np.zeros(r.shape)
    outside = far > r
    t[outside] = r[outside] ** 2 / far[outside]
    s[outside] = r[outside] * np.sqrt(1 - (r[outside] / far[outside]) ** 2)
    found = centre - t[..., np.newaxis] * towards + s[..., np.newaxis] * side_of(towards, heading)
    top = centre + r[..., np.newaxis] * np.array([0.0, 0.0, 1.0])
    return np.where((far == 0)[..., np.newaxis], top, found)


def nearest_approach(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    x, u = np.subtract(position_a, position_b), np.subtract(velocity_a, velocity_b)
    closing, squared = -np.sum(x * u, axis=-1), np.sum(u * u, axis=-1)
    closing, squared = np.broadcast_arrays(closing, squared)
    time = np.zeros(closing.shape)
    comes = (closing > 0) & (squared > 0)
    time[comes] = closing[comes] / squared[comes]
    gap = norm(x + u * time[..., np.newaxis])
    return time, gap - radius_a - radius_b


def separation(position, first, second):
    p = np.array(position, dtype=float)
    apart = p[first] - p[second]
    distance = norm(apart)
    keep = distance > 0
    push = apart[keep] / distance[keep, None] / distance[keep, None]
    total = np.zeros_like(p)
    np.add.at(total, first[keep], push)
    np.subtract.at(total, second[keep], push)
    return total


def towards_mean(value, first, second):
    x = np.array(value, dtype=float)
    total, count = np.zeros_like(x), np.zeros(len(x))
    for one, other in ((first, second), (second, first)):
        np.add.at(total, one, x[other])
        np.add.at(count, one, 1)
    total[count > 0] = total[count > 0] / count[count > 0][:, None] - x[count > 0]
    return total


def cap_of_cone(relative_velocity, towards, reach, horizon, dt):
    u, x = np.broadcast_arrays(np.asarray(relative_velocity, dtype=float), np.asarray(towards, dtype=float))
    far = norm(x)
    overlaps = far <= reach
    time = np.where(overlaps, dt, horizon)
    outwards = u - x / time[..., None]
    length, sine = norm(outwards), np.minimum(reach / np.where(far > 0, far, 1), 1)
    ahead = x / np.where(far > 0, far, 1)[..., None]
    none = np.where((far > 0)[..., None], -ahead, [1.0, 0.0])
    normal = np.where((length > 0)[..., None], outwards / np.where(length > 0, length, 1)[..., None], none)
    return overlaps | (-np.sum(outwards * ahead, axis=-1) > sine * length), reach / time - length, normal


def orca_half_plane(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    """By the direction of the nearer side of the cone: the normal is at right angles to it."""
    u, x = np.subtract(velocity_a, velocity_b), np.subtract(position_b, position_a)
    reach = np.add(radius_a, radius_b)
    on_cap, deep, cap_normal = cap_of_cone(u, x, reach, horizon, dt)
    u, x = np.broadcast_arrays(u, x)
    with np.errstate(all="ignore"):
        squared = np.sum(x * x, axis=-1)
        leg = np.sqrt(squared - np.square(reach))
        turn = x[..., 0] * u[..., 1] - x[..., 1] * u[..., 0]
        s = np.where(turn > 0, 1.0, -1.0)
        along = (
            np.stack([x[..., 0] * leg - s * x[..., 1] * reach, s * x[..., 0] * reach + x[..., 1] * leg], axis=-1)
            / squared[..., None]
        )
        n = np.stack([-s * along[..., 1], s * along[..., 0]], axis=-1)
        foot = np.sum(u * along, axis=-1)[..., None] * along
        change = foot - u
    change = np.where(on_cap[..., None], deep[..., None] * cap_normal, change)
    return velocity_a + change / 2, np.where(on_cap[..., None], cap_normal, n)
