"""Right answers for one case alone."""

import math

import numpy as np


def kinematic_response(velocity, normal, restitution):
    speed = float(np.dot(velocity, normal))
    if speed >= 0:
        return velocity
    return velocity - (1 + restitution) * speed * normal


def moving_plane_response(velocity, plane_velocity, normal, restitution):
    return kinematic_response(velocity - plane_velocity, normal, restitution) + plane_velocity


def _flown(position, velocity, acceleration, time):
    return position + velocity * time + acceleration * time**2 / 2, velocity + acceleration * time


def respond_at_step(position, velocity, acceleration, normal, behind, restitution, dt):
    if behind and velocity @ normal < 0:
        velocity = kinematic_response(velocity, normal, restitution)
        acceleration = acceleration - min(acceleration @ normal, 0.0) * normal
    velocity = velocity + dt * acceleration
    return position + dt * velocity, velocity


def respond_at_impact(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    if time_of_impact > dt:
        return _flown(position, velocity, acceleration, dt)
    position, velocity = _flown(position, velocity, acceleration, time_of_impact)
    return _flown(position, kinematic_response(velocity, normal, restitution), acceleration, dt - time_of_impact)


def time_until_rest(separation, normal_velocity, normal_acceleration, restitution):
    s, u, a, e = max(separation, 0.0), normal_velocity, normal_acceleration, restitution
    if s == 0 and u == 0 and a <= 0:
        return 0.0
    if a > 0:
        return math.inf
    if a == 0:
        return s / -u if u < 0 and e == 0 else math.inf
    arrives = math.sqrt(u * u - 2 * a * s)
    if e == 1:
        return math.inf
    return (arrives + u) / -a + 2 * e * arrives / (-a * (1 - e))


def penalty_force(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    if separation >= 0:
        return 0 * normal
    size = -stiffness * separation - damping * normal_velocity
    if size < 0 and not adhesive:
        size = 0.0
    return size * normal


def penalty_rest_depth(mass, gravity, stiffness):
    return mass * gravity / stiffness


def penalty_step_limit(mass, stiffness, damping=0.0):
    w = math.sqrt(stiffness / mass)
    z = damping / (2 * math.sqrt(stiffness * mass))
    return 2 / w * (math.sqrt(1 + z * z) - z)
