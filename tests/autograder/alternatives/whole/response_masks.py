"""Right answers for many cases, with masks and sums in place of np.where and np.vecdot."""

import numpy as np


def along(vector, normal):
    return np.sum(np.asarray(vector) * normal, axis=-1, keepdims=True)


def column(number):
    return np.asarray(number, dtype=float)[..., np.newaxis]


def kinematic_response(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    seen = np.asarray(velocity) - plane_velocity
    u = along(seen, normal)
    return seen - (u < 0) * (1 + column(restitution)) * u * normal + plane_velocity


def respond_at_step(position, velocity, acceleration, normal, behind, restitution, dt):
    u = along(velocity, normal)
    struck = np.asarray(behind)[..., np.newaxis] & (u < 0)
    pressed = along(acceleration, normal)
    pressed = pressed * (pressed < 0) * struck
    after = velocity - struck * (1 + column(restitution)) * u * normal
    after = after + column(dt) * (acceleration - pressed * normal)
    return position + column(dt) * after, after


def bounce(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    cases = np.broadcast_shapes(
        np.shape(position), np.shape(velocity), np.shape(acceleration), np.shape(normal),
        np.shape(column(offset)), np.shape(column(restitution)), np.shape(column(dt)),
    )  # fmt: skip
    run = np.zeros((2, steps + 1, *cases))
    run[0, 0], run[1, 0] = position, velocity
    for i in range(steps):
        separation = along(run[0, i], normal)[..., 0] + offset
        run[:, i + 1] = respond_at_step(*run[:, i], acceleration, normal, separation < 0, restitution, dt)
    return run


def respond_at_impact(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    meets = column(time_of_impact) <= column(dt)
    t = column(np.minimum(time_of_impact, dt))
    left = column(dt) - t
    arrived = velocity + acceleration * t
    leaves = arrived + meets * (kinematic_response(arrived, normal, restitution) - arrived)
    place = position + t * (velocity + arrived) / 2
    return place + left * leaves + left**2 * acceleration / 2, leaves + left * acceleration


def penalty_force(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    depth = -np.minimum(separation, 0.0)
    size = (stiffness * depth - damping * np.asarray(normal_velocity)) * (depth > 0)
    if not adhesive:
        size = (size + abs(size)) / 2
    return column(size) * normal


def penalty_step_limit(mass, stiffness, damping=0.0):
    zeta = np.asarray(damping) / np.sqrt(4 * np.asarray(stiffness) * mass)
    return np.sqrt(4 * np.asarray(mass) / stiffness) / (np.hypot(1, zeta) + zeta)


def design_contact(mass, speed, depth, restitution, steps_per_contact):
    stiffness = np.asarray(mass) * np.square(speed) / np.square(depth)
    zeta = np.zeros(np.broadcast(stiffness, restitution).shape)
    part = np.full_like(zeta, 16.0)
    for _ in range(70):  # from the largest digit to the smallest
        tried = zeta + part
        turn = np.where(tried < 1, np.arccos(np.minimum(tried, 1)), np.arccosh(np.maximum(tried, 1)))
        apart = np.sqrt(abs(1 - tried**2))
        turn = np.where(apart > 0, turn / np.where(apart > 0, apart, 1), 1)
        zeta = zeta + part * (-2 * tried * turn > np.log(restitution))
        part = part / 2
    zeta = zeta * (np.asarray(restitution) < 1)
    steps = np.asarray(steps_per_contact)
    return stiffness, 2 * zeta * np.sqrt(stiffness * mass), np.pi * np.asarray(depth) / (speed * steps)
