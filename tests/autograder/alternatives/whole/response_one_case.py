"""Right answers for one case alone."""

import math

import numpy as np


def kinematic_response(velocity, normal, restitution, plane_velocity=(0.0, 0.0, 0.0)):
    speed = float(np.dot(velocity - np.asarray(plane_velocity), normal))
    if speed >= 0:
        return velocity
    return velocity - (1 + restitution) * speed * normal


def _flown(position, velocity, acceleration, time):
    return position + velocity * time + acceleration * time**2 / 2, velocity + acceleration * time


def respond_at_step(position, velocity, acceleration, normal, behind, restitution, dt):
    if behind and velocity @ normal < 0:
        velocity = kinematic_response(velocity, normal, restitution)
        acceleration = acceleration - min(acceleration @ normal, 0.0) * normal
    velocity = velocity + dt * acceleration
    return position + dt * velocity, velocity


def bounce(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    rows = [(position, velocity)]
    while len(rows) <= steps:
        position, velocity = rows[-1]
        behind = position @ normal + offset < 0
        rows.append(respond_at_step(position, velocity, acceleration, normal, behind, restitution, dt))
    return [row[0] for row in rows], [row[1] for row in rows]


def respond_at_impact(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    if time_of_impact > dt:
        return _flown(position, velocity, acceleration, dt)
    position, velocity = _flown(position, velocity, acceleration, time_of_impact)
    return _flown(position, kinematic_response(velocity, normal, restitution), acceleration, dt - time_of_impact)


def penalty_force(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    if separation >= 0:
        return 0 * normal
    size = -stiffness * separation - damping * normal_velocity
    if size < 0 and not adhesive:
        size = 0.0
    return size * normal


def penalty_step_limit(mass, stiffness, damping=0.0):
    w = math.sqrt(stiffness / mass)
    z = damping / (2 * math.sqrt(stiffness * mass))
    return 2 / w / (math.sqrt(1 + z * z) + z)


def _kept(zeta):
    if zeta == 1:
        return math.exp(-2)
    if zeta > 1:
        return math.exp(-2 * zeta * math.acosh(zeta) / math.sqrt(zeta**2 - 1))
    return math.exp(-2 * zeta * math.acos(zeta) / math.sqrt(1 - zeta**2))


def design_contact(mass, speed, depth, restitution, steps_per_contact):
    k = 2 * (mass * speed**2 / 2) / depth**2
    low, high = 0.0, 1e3
    while high - low > 1e-12 * high:
        middle = (low + high) / 2
        if _kept(middle) > restitution:
            low = middle
        else:
            high = middle
    zeta = 0.0 if restitution == 1 else high
    return k, 2 * zeta * math.sqrt(k * mass), math.pi / math.sqrt(k / mass) / steps_per_contact
