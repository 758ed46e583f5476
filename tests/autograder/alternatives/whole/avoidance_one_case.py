"""Right answers for one case alone: one body, one sphere and one pair at a time, with plain loops."""

import math

import numpy as np


def dot(a, b):
    total = 0.0
    for x, y in zip(a, b, strict=True):
        total += float(x) * float(y)
    return total


def minus(a, b):
    return [float(x) - float(y) for x, y in zip(a, b, strict=True)]


def plus(a, factor, b):
    return [float(x) + factor * float(y) for x, y in zip(a, b, strict=True)]


def size(a):
    return math.hypot(*map(float, a))


def seek(position, target, max_speed):
    way = minus(target, position)
    far = size(way)
    if far == 0:
        return [0.0] * len(way)
    return [max_speed * x / far for x in way]


def arrive(position, target, max_speed, slowing_radius):
    far = size(minus(target, position))
    speed = max_speed if far > slowing_radius else max_speed * far / slowing_radius
    return seek(position, target, speed)


def repelling_force(separation, normal, strength, reach):
    if separation >= reach:
        return [0.0, 0.0, 0.0]
    share = 1.0 if separation <= 0 else 1 - separation / reach
    return [strength * share * share * float(x) for x in normal]


def side_of(towards, *wishes):
    for wish in wishes:
        part = plus(wish, -dot(wish, towards), towards)
        part = plus(part, -dot(part, towards), towards)
        if size(part) > 1e-9 * size(wish):
            return [x / size(part) for x in part]
    flat = math.hypot(towards[0], towards[1])
    return [-towards[1] / flat, towards[0] / flat, 0.0] if flat > 0 else [1.0, 0.0, 0.0]


def tangent_point(position, heading, centre, radius):
    way = minus(centre, position)
    far = size(way)
    if far == 0:
        return plus(centre, radius, [0, 0, 1])
    towards = [x / far for x in way]
    if far <= radius:
        return plus(centre, -radius, towards)
    t = radius * radius / far
    s = math.sqrt((radius - t) * (radius + t))
    return plus(plus(centre, -t, towards), s, side_of(towards, heading))


def nearest_approach(position_a, velocity_a, position_b, velocity_b, radius_a=0.0, radius_b=0.0):
    x, u = minus(position_a, position_b), minus(velocity_a, velocity_b)
    time = 0.0
    if dot(u, u) > 0 and dot(x, u) < 0:
        time = -dot(x, u) / dot(u, u)
    return time, size(plus(x, time, u)) - radius_a - radius_b


def neighbours(which, first, second):
    return [j for i, j in zip(first, second, strict=True) if i == which] + [
        i for i, j in zip(first, second, strict=True) if j == which
    ]


def separation(position, first, second):
    found = []
    for which, place in enumerate(position):
        push = [0.0] * len(place)
        for other in neighbours(which, first, second):
            apart = minus(place, position[other])
            if size(apart) > 0:
                push = plus(push, 1 / size(apart) / size(apart), apart)
        found.append(push)
    return found


def towards_mean(value, first, second):
    found = []
    for which, own in enumerate(value):
        others = neighbours(which, first, second)
        total = [0.0] * len(own)
        for other in others:
            total = plus(total, 1 / len(others), minus(value[other], own))
        found.append(total)
    return found


def cap_of_cone(relative_velocity, towards, reach, horizon, dt):
    far = size(towards)
    time = dt if far <= reach else horizon
    outwards = plus(relative_velocity, -1 / time, towards)
    length = size(outwards)
    if length > 0:
        normal = [x / length for x in outwards]
    else:
        normal = [-x / far for x in towards] if far > 0 else [1.0, 0.0]
    capped = far <= reach or -dot(outwards, towards) > reach * length
    return capped, reach / time - length, normal


def orca_half_plane(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, horizon, dt):
    u, x = minus(velocity_a, velocity_b), minus(position_b, position_a)
    reach = radius_a + radius_b
    capped, change, normal = cap_of_cone(u, x, reach, horizon, dt)
    if not capped:
        far = size(x)
        side = 1 if x[0] * u[1] > x[1] * u[0] else -1
        k = math.sqrt(far * far - reach * reach)
        normal = [(-side * k * x[1] - reach * x[0]) / far**2, (side * k * x[0] - reach * x[1]) / far**2]
        change = -dot(u, normal)
    return np.array(plus(velocity_a, change / 2, normal)), np.array(normal)
