"""Of the fifth lot of wrong answers, those to the lab on avoidance."""

from __future__ import annotations

import numpy as np

from solutions.avoidance import cap_of_cone, limited, side_of
from solutions.avoidance.directions import turned_left
from solutions.vectors import direction


def seek_1(position, target, max_speed):
    """Full speed along each axis: max_speed times the sign of the difference."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    return np.asarray(max_speed, dtype=float)[..., None] * np.sign(way)


def seek_2(position, target, max_speed):
    """The difference is already a direction: not normalised."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    return np.asarray(max_speed, dtype=float)[..., None] * way


def seek_3(position, target, max_speed):
    """The way itself, shortened to max_speed where it is longer."""
    return limited(np.subtract(target, position), max_speed)


def seek_4(position, target, max_speed):
    """Believes that np.linalg.norm(way) is the distance (of all bodies together)."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    distance = np.linalg.norm(way)
    if distance == 0:
        return np.zeros_like(way)
    return np.asarray(max_speed, dtype=float)[..., None] * way / distance


def seek_5(position, target, max_speed):
    """A body nearer than a centimetre is at its target."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    distance = np.linalg.norm(way, axis=-1, keepdims=True)
    there = distance < 0.01
    return np.where(there, 0.0, np.asarray(max_speed, dtype=float)[..., None] * way / np.where(there, 1.0, distance))


def arrive_1(position, target, max_speed, slowing_radius):
    """Brake evenly: the speed inside falls with the square root of the distance."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    distance = np.linalg.norm(way, axis=-1)
    share = np.minimum(1.0, np.sqrt(distance / slowing_radius))
    speed = max_speed * share
    return (speed / np.where(distance > 0, distance, 1.0))[..., None] * way


def arrive_2(position, target, max_speed, slowing_radius):
    """Inside, the speed is max_speed (1 - distance/R)."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    distance = np.linalg.norm(way, axis=-1)
    speed = np.where(distance > slowing_radius, max_speed, max_speed * (1 - distance / slowing_radius))
    return (speed / np.where(distance > 0, distance, 1.0))[..., None] * way


def arrive_3(position, target, max_speed, slowing_radius):
    """One body at a time, with if."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    distance = np.linalg.norm(way)
    if distance == 0:
        return np.zeros_like(way)
    if distance > slowing_radius:
        return max_speed * way / distance
    return max_speed * way / slowing_radius


def arrive_4(position, target, max_speed, slowing_radius):
    """The speed is the share distance/R, at most max_speed."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    distance = np.linalg.norm(way, axis=-1)
    speed = np.minimum(max_speed, distance / slowing_radius)
    return (speed / np.where(distance > 0, distance, 1.0))[..., None] * way


def arrive_5(position, target, max_speed, slowing_radius):
    """The speed falls with the square of the share, as the field does."""
    way = np.asarray(target, dtype=float) - np.asarray(position, dtype=float)
    distance = np.linalg.norm(way, axis=-1)
    speed = max_speed * np.minimum(1.0, distance / slowing_radius) ** 2
    return (speed / np.where(distance > 0, distance, 1.0))[..., None] * way


def repelling_force_1(separation, normal, strength, reach):
    """Takes 1 - (s/R)^2 in place of (1 - s/R)^2."""
    share = np.clip(np.asarray(separation, dtype=float) / reach, 0.0, 1.0)
    size = strength * (1 - share**2)
    return size[..., None] * np.asarray(normal, dtype=float)


def repelling_force_2(separation, normal, strength, reach):
    """The distance from the surface has no sign: inside the force falls again."""
    s = np.abs(np.asarray(separation, dtype=float))
    size = np.where(s < reach, strength * (1 - s / reach) ** 2, 0.0)
    return size[..., None] * np.asarray(normal, dtype=float)


def repelling_force_3(separation, normal, strength, reach):
    """At the reach the square is zero, so nothing more has to be done beyond it."""
    s = np.maximum(np.asarray(separation, dtype=float), 0.0)
    size = np.asarray(strength, dtype=float) * (1 - s / reach) ** 2
    return size[..., None] * np.asarray(normal, dtype=float)


def repelling_force_4(separation, normal, strength, reach):
    """Inside the obstacle there is no field."""
    s = np.asarray(separation, dtype=float)
    size = np.where((s >= 0) & (s < reach), strength * (1 - s / reach) ** 2, 0.0)
    return size[..., None] * np.asarray(normal, dtype=float)


def repelling_force_5(separation, normal, strength, reach):
    """The field is strongest at the reach's end: (s/R)^2."""
    share = np.clip(np.asarray(separation, dtype=float) / reach, 0.0, 1.0)
    size = np.where(share < 1, strength * share**2, 0.0)
    return size[..., None] * np.asarray(normal, dtype=float)


def tangent_point_1(position, heading, centre, radius):
    """Believes that r^2/L is how far the foot is from the flier."""
    p, c, r = np.asarray(position, dtype=float), np.asarray(centre, dtype=float), np.asarray(radius, dtype=float)
    L = np.linalg.norm(c - p, axis=-1)
    towards = (c - p) / np.where(L > 0, L, 1.0)[..., None]
    side = side_of(towards, heading)
    safe = np.maximum(L, r)
    t, s = r**2 / safe, r * np.sqrt(safe**2 - r**2) / safe
    outside = p + t[..., None] * towards + s[..., None] * side
    top = c + r[..., None] * np.array([0.0, 0.0, 1.0])
    inside = np.where((L > 0)[..., None], c - r[..., None] * towards, top)
    return np.where((r <= L)[..., None], outside, inside)


def tangent_point_2(position, heading, centre, radius):
    """The side is the heading's part across, and that is all (head-on: no side at all)."""
    p, c, h = (np.asarray(each, dtype=float) for each in (position, centre, heading))
    r = np.asarray(radius, dtype=float)
    L = np.linalg.norm(c - p, axis=-1)
    towards = (c - p) / np.where(L > 0, L, 1.0)[..., None]
    side = direction(h - np.sum(h * towards, axis=-1, keepdims=True) * towards)
    safe = np.maximum(L, r)
    t, s = r**2 / safe, r * np.sqrt(safe**2 - r**2) / safe
    found = c - t[..., None] * towards + s[..., None] * side
    top = c + r[..., None] * np.array([0.0, 0.0, 1.0])
    return np.where((L > 0)[..., None], found, top)


def tangent_point_3(position, heading, centre, radius):
    """Inside, the root is set to zero and the rest of the formula stays as it is (r^2/L)."""
    p, c, r = np.asarray(position, dtype=float), np.asarray(centre, dtype=float), np.asarray(radius, dtype=float)
    L = np.linalg.norm(c - p, axis=-1)
    safe = np.where(L > 0, L, 1.0)
    towards = (c - p) / safe[..., None]
    side = side_of(towards, heading)
    k = np.sqrt(np.maximum(L**2 - r**2, 0.0))
    point = c - (r**2 / safe)[..., None] * towards + (r * k / safe)[..., None] * side
    top = c + r[..., None] * np.array([0.0, 0.0, 1.0])
    return np.where((L > 0)[..., None], point, top)


def tangent_point_4(position, heading, centre, radius):
    """Goes r^2/L short of the centre, and to the side by the whole radius."""
    p, c, r = np.asarray(position, dtype=float), np.asarray(centre, dtype=float), np.asarray(radius, dtype=float)
    L = np.linalg.norm(c - p, axis=-1)
    towards = direction(c - p)
    side = side_of(towards, heading)
    safe = np.maximum(L, r)
    outside = c - (r**2 / safe)[..., None] * towards + r[..., None] * side
    top = c + r[..., None] * np.array([0.0, 0.0, 1.0])
    inside = np.where((L > 0)[..., None], c - r[..., None] * towards, top)
    return np.where((r < L)[..., None], outside, inside)


def tangent_point_5(position, heading, centre, radius):
    """The heading is a place: what counts is heading - position."""
    p, c, r = np.asarray(position, dtype=float), np.asarray(centre, dtype=float), np.asarray(radius, dtype=float)
    L = np.linalg.norm(c - p, axis=-1)
    towards = direction(c - p)
    side = side_of(towards, np.asarray(heading, dtype=float) - p)
    safe = np.maximum(L, r)
    t, s = r**2 / safe, r * np.sqrt(safe**2 - r**2) / safe
    outside = c - t[..., None] * towards + s[..., None] * side
    top = c + r[..., None] * np.array([0.0, 0.0, 1.0])
    inside = np.where((L > 0)[..., None], c - r[..., None] * towards, top)
    return np.where((r < L)[..., None], outside, inside)


def nearest_approach_1(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    """The time is never negative, so take the absolute value."""
    x = np.asarray(position_a, dtype=float) - np.asarray(position_b, dtype=float)
    u = np.asarray(velocity_a, dtype=float) - np.asarray(velocity_b, dtype=float)
    a, b = np.sum(u * u, axis=-1), np.sum(x * u, axis=-1)
    t = np.where(a > 0, np.abs(b) / np.where(a > 0, a, 1.0), 0.0)
    return t, np.linalg.norm(x + t[..., None] * u, axis=-1) - radius_a - radius_b


def nearest_approach_2(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    """A distance between surfaces cannot be below zero."""
    x = np.asarray(position_a, dtype=float) - np.asarray(position_b, dtype=float)
    u = np.asarray(velocity_a, dtype=float) - np.asarray(velocity_b, dtype=float)
    a, b = np.sum(u * u, axis=-1), np.sum(x * u, axis=-1)
    t = np.maximum(np.where(a > 0, -b / np.where(a > 0, a, 1.0), 0.0), 0.0)
    gap = np.linalg.norm(x + t[..., None] * u, axis=-1) - radius_a - radius_b
    return t, np.maximum(gap, 0.0)


def nearest_approach_3(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    """The time is the way along u over the speed, with x.u as that way: -x.u/|u|."""
    x = np.asarray(position_a, dtype=float) - np.asarray(position_b, dtype=float)
    u = np.asarray(velocity_a, dtype=float) - np.asarray(velocity_b, dtype=float)
    speed = np.linalg.norm(u, axis=-1)
    t = np.where(speed > 0, -np.sum(x * u, axis=-1) / np.where(speed > 0, speed, 1.0), 0.0)
    t = np.maximum(t, 0.0)
    return t, np.linalg.norm(x + t[..., None] * u, axis=-1) - radius_a - radius_b


def nearest_approach_4(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    """At equal velocities they are never nearest: infinity."""
    x = np.asarray(position_a, dtype=float) - np.asarray(position_b, dtype=float)
    u = np.asarray(velocity_a, dtype=float) - np.asarray(velocity_b, dtype=float)
    a, b = np.sum(u * u, axis=-1), np.sum(x * u, axis=-1)
    t = np.maximum(-b / np.where(a > 0, a, 1.0), 0.0)
    gap = np.linalg.norm(x + t[..., None] * u, axis=-1) - radius_a - radius_b
    return np.where(a > 0, t, np.inf), gap


def nearest_approach_5(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    """The separation is that of now."""
    x = np.asarray(position_a, dtype=float) - np.asarray(position_b, dtype=float)
    u = np.asarray(velocity_a, dtype=float) - np.asarray(velocity_b, dtype=float)
    x, u = np.broadcast_arrays(x, u)
    a, b = np.sum(u * u, axis=-1), np.sum(x * u, axis=-1)
    t = np.maximum(np.where(a > 0, -b / np.where(a > 0, a, 1.0), 0.0), 0.0)
    return t, np.linalg.norm(x, axis=-1) - radius_a - radius_b


def separation_1(position, first, second):
    """A push has the size 1: the unit vector away from the neighbour."""
    p = np.asarray(position, dtype=float)
    apart = p[first] - p[second]
    distance = np.linalg.norm(apart, axis=-1, keepdims=True)
    push = apart / np.where(distance > 0, distance, 1.0)
    total = np.zeros_like(p)
    np.add.at(total, first, push)
    np.add.at(total, second, -push)
    return total


def separation_2(position, first, second):
    """Each pair is there twice, so only the first one is pushed."""
    p = np.asarray(position, dtype=float)
    total = np.zeros_like(p)
    for i, j in zip(first, second, strict=True):
        apart = p[i] - p[j]
        squared = apart @ apart
        if squared > 0:
            total[i] += apart / squared
    return total


def separation_3(position, first, second):
    """The mean of the pushes, over the number of neighbours."""
    p = np.asarray(position, dtype=float)
    total, count = np.zeros_like(p), np.zeros(len(p))
    for i, j in zip(first, second, strict=True):
        apart = p[i] - p[j]
        squared = apart @ apart
        if squared == 0:
            continue
        total[i] += apart / squared
        total[j] -= apart / squared
        count[i] += 1
        count[j] += 1
    return total / np.maximum(count, 1)[:, None]


def separation_4(position, first, second):
    """The push has the size 1/d^2, like gravity."""
    p = np.asarray(position, dtype=float)
    total = np.zeros_like(p)
    for i, j in zip(first, second, strict=True):
        apart = p[i] - p[j]
        d = np.linalg.norm(apart)
        if d > 0:
            total[i] += apart / d**3
            total[j] -= apart / d**3
    return total


def separation_5(position, first, second):
    """A little in the denominator (1e-6) is enough for neighbours at the same place."""
    p = np.asarray(position, dtype=float)
    apart = p[first] - p[second]
    push = apart / (np.sum(apart**2, axis=-1, keepdims=True) + 1e-6)
    total = np.zeros_like(p)
    np.add.at(total, first, push)
    np.add.at(total, second, -push)
    return total


def towards_mean_1(value, first, second):
    """A boid belongs to its own neighbourhood: the mean includes itself."""
    x = np.asarray(value, dtype=float)
    total, count = x.copy(), np.ones(len(x))
    for i, j in zip(first, second, strict=True):
        total[i] += x[j]
        total[j] += x[i]
        count[i] += 1
        count[j] += 1
    return total / count[:, None] - x


def towards_mean_2(value, first, second):
    """The number of neighbours is how often a boid is in first."""
    x = np.asarray(value, dtype=float)
    total = np.zeros_like(x)
    np.add.at(total, first, x[second] - x[first])
    np.add.at(total, second, x[first] - x[second])
    count = np.bincount(np.asarray(first, dtype=int), minlength=len(x))
    return total / np.maximum(count, 1)[:, None]


def towards_mean_3(value, first, second):
    """Without neighbours the mean is zero (so it returns minus the own value)."""
    x = np.asarray(value, dtype=float)
    total, count = np.zeros_like(x), np.zeros(len(x))
    np.add.at(total, first, x[second])
    np.add.at(total, second, x[first])
    np.add.at(count, first, 1)
    np.add.at(count, second, 1)
    mean = total / np.maximum(count, 1)[:, None]
    return mean - x


def towards_mean_4(value, first, second):
    """Only those that come second in a pair are neighbours (of those that come first)."""
    x = np.asarray(value, dtype=float)
    first, second = np.asarray(first, dtype=int), np.asarray(second, dtype=int)
    out = np.zeros_like(x)
    for i in range(len(x)):
        who = second[first == i]
        if len(who):
            out[i] = x[who].mean(axis=0) - x[i]
    return out


def orca_half_plane_1(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    """Believes that np.sign names the side (exactly head-on it is 0: a normal without a side)."""
    v = np.asarray(velocity_a, dtype=float)
    u = v - np.asarray(velocity_b, dtype=float)
    x = np.asarray(position_b, dtype=float) - np.asarray(position_a, dtype=float)
    R = np.asarray(radius_a, dtype=float) + np.asarray(radius_b, dtype=float)
    capped, depth, cap_normal = cap_of_cone(u, x, R, horizon, dt)
    L = np.linalg.norm(x, axis=-1)
    ahead = x / np.where(L > 0, L, 1.0)[..., None]
    left = turned_left(ahead)
    sine = np.minimum(R / np.where(L > 0, L, 1.0), 1.0)
    cosine = np.sqrt(1 - sine**2)
    side = np.sign(np.sum(u * left, axis=-1))
    leg = -sine[..., None] * ahead + (side * cosine)[..., None] * left
    normal = np.where(capped[..., None], cap_normal, leg)
    c = np.where(capped, depth, -np.sum(u * leg, axis=-1))
    return v + c[..., None] / 2 * normal, normal


def orca_half_plane_2(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    """The horizon holds for discs that overlap as well."""
    v = np.asarray(velocity_a, dtype=float)
    u = v - np.asarray(velocity_b, dtype=float)
    x = np.asarray(position_b, dtype=float) - np.asarray(position_a, dtype=float)
    R = np.asarray(radius_a, dtype=float) + np.asarray(radius_b, dtype=float)
    capped, depth, cap_normal = cap_of_cone(u, x, R, horizon, horizon)
    L = np.linalg.norm(x, axis=-1)
    ahead = x / np.where(L > 0, L, 1.0)[..., None]
    left = turned_left(ahead)
    sine = np.minimum(R / np.where(L > 0, L, 1.0), 1.0)
    cosine = np.sqrt(1 - sine**2)
    side = np.where(np.sum(u * left, axis=-1) > 0, 1.0, -1.0)
    leg = -sine[..., None] * ahead + (side * cosine)[..., None] * left
    normal = np.where(capped[..., None], cap_normal, leg)
    c = np.where(capped, depth, -np.sum(u * leg, axis=-1))
    return v + c[..., None] / 2 * normal, normal


def orca_half_plane_3(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    """The point is half of the change (A's own velocity forgotten)."""
    u = np.asarray(velocity_a, dtype=float) - np.asarray(velocity_b, dtype=float)
    x = np.asarray(position_b, dtype=float) - np.asarray(position_a, dtype=float)
    R = np.asarray(radius_a, dtype=float) + np.asarray(radius_b, dtype=float)
    capped, depth, cap_normal = cap_of_cone(u, x, R, horizon, dt)
    L = np.linalg.norm(x, axis=-1)
    ahead = x / np.where(L > 0, L, 1.0)[..., None]
    left = turned_left(ahead)
    sine = np.minimum(R / np.where(L > 0, L, 1.0), 1.0)
    cosine = np.sqrt(1 - sine**2)
    side = np.where(np.sum(u * left, axis=-1) > 0, 1.0, -1.0)
    leg = -sine[..., None] * ahead + (side * cosine)[..., None] * left
    normal = np.where(capped[..., None], cap_normal, leg)
    c = np.where(capped, depth, -np.sum(u * leg, axis=-1))
    return c[..., None] / 2 * normal, normal


def orca_half_plane_4(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    """Each turns to its right, always."""
    v = np.asarray(velocity_a, dtype=float)
    u = v - np.asarray(velocity_b, dtype=float)
    x = np.asarray(position_b, dtype=float) - np.asarray(position_a, dtype=float)
    R = np.asarray(radius_a, dtype=float) + np.asarray(radius_b, dtype=float)
    capped, depth, cap_normal = cap_of_cone(u, x, R, horizon, dt)
    L = np.linalg.norm(x, axis=-1)
    ahead = x / np.where(L > 0, L, 1.0)[..., None]
    sine = np.minimum(R / np.where(L > 0, L, 1.0), 1.0)
    cosine = np.sqrt(1 - sine**2)
    leg = -sine[..., None] * ahead - cosine[..., None] * turned_left(ahead)
    normal = np.where(capped[..., None], cap_normal, leg)
    c = np.where(capped, depth, -np.sum(u * leg, axis=-1))
    return v + c[..., None] / 2 * normal, normal


def orca_half_plane_5(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    """Outside the cone nothing has to change: the point is A's own velocity."""
    v = np.asarray(velocity_a, dtype=float)
    u = v - np.asarray(velocity_b, dtype=float)
    x = np.asarray(position_b, dtype=float) - np.asarray(position_a, dtype=float)
    R = np.asarray(radius_a, dtype=float) + np.asarray(radius_b, dtype=float)
    capped, depth, cap_normal = cap_of_cone(u, x, R, horizon, dt)
    L = np.linalg.norm(x, axis=-1)
    ahead = x / np.where(L > 0, L, 1.0)[..., None]
    left = turned_left(ahead)
    sine = np.minimum(R / np.where(L > 0, L, 1.0), 1.0)
    cosine = np.sqrt(1 - sine**2)
    side = np.where(np.sum(u * left, axis=-1) > 0, 1.0, -1.0)
    leg = -sine[..., None] * ahead + (side * cosine)[..., None] * left
    normal = np.where(capped[..., None], cap_normal, leg)
    c = np.maximum(np.where(capped, depth, -np.sum(u * leg, axis=-1)), 0.0)
    return v + c[..., None] / 2 * normal, normal
