"""Right answers for one case alone: bodies one at a time, rows of balls and contacts as they come."""

import math

import numpy as np


def size(v):
    return math.sqrt(v @ v)


def apparent_force(mass, gravity, push, frame_acceleration):
    return mass * (gravity - frame_acceleration) + push


def normal_force(force, normal):
    return max(0.0, -float(force @ normal))


def along_surface(force, normal):
    return force - (force @ normal) * normal


def holds(push, normal_force, static_friction):
    return size(push) <= static_friction * normal_force


def friction_angle(static_friction):
    return math.atan(static_friction)


def friction_force(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    if size(tangent_velocity) > 0:
        return -kinetic_friction * normal_force * tangent_velocity / size(tangent_velocity)
    if holds(push, normal_force, static_friction):
        return -push
    return -kinetic_friction * normal_force * push / size(push)


def sliding_motion(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    def acceleration(velocity):
        return (push + friction_force(push, velocity, normal_force, static_friction, kinetic_friction)) / mass

    p, v, a = position, tangent_velocity, acceleration(tangent_velocity)
    closing = -(v @ a)
    if v @ v > 0 and v @ v <= closing * dt:
        stop = (v @ v) / closing
        p = p + v * stop + a * stop**2 / 2
        a = acceleration(np.zeros(3))
        return p + a * (dt - stop) ** 2 / 2, a * (dt - stop), stop
    return p + v * dt + a * dt**2 / 2, v + a * dt, math.inf


def clamp_to_circle(tangent_force, limit):
    if size(tangent_force) > limit:
        return tangent_force * limit / size(tangent_force)
    return tangent_force


def clamp_to_square(tangent_force, limit, axis_x, axis_y):
    x, y = tangent_force @ axis_x, tangent_force @ axis_y
    return max(-limit, min(limit, x)) * axis_x + max(-limit, min(limit, y)) * axis_y


def break_away_time(force, force_rate, normal, static_friction):
    press, press_rate = -(force @ normal), -(force_rate @ normal)
    f, rate = along_surface(force, normal), along_surface(force_rate, normal)
    mu = static_friction
    if press < 0 or size(f) > mu * press:
        return 0.0
    a = rate @ rate - (mu * press_rate) ** 2
    b = f @ rate - mu**2 * press * press_rate
    c = min(0.0, f @ f - (mu * press) ** 2)
    under = max(0.0, b * b - a * c)
    leaves = math.inf
    if b > 0:
        leaves = -c / (b + math.sqrt(under))
    elif a > 0:
        leaves = (math.sqrt(under) - b) / a
    lifts = -press / press_rate if press_rate < 0 else math.inf
    return min(leaves, lifts)


def sphere_grips(slip, approach_speed, restitution, friction):
    return slip <= 3.5 * friction * (1 + restitution) * approach_speed


def friction_impulse(velocity, normal, inverse_mass, restitution, friction):
    approach = velocity @ normal
    if approach >= 0:
        return np.zeros(3)
    grip = np.linalg.inv(inverse_mass) @ (-velocity - restitution * approach * normal)
    across = along_surface(grip, normal)
    if size(across) <= friction * (grip @ normal):
        return grip
    edge = normal + friction * across / size(across)
    return -(1 + restitution) * approach / (normal @ inverse_mass @ edge) * edge


def sphere_impact(velocity, angular_velocity, normal, radius, restitution, friction, inertia_share=0.4):
    arm, inertia = -radius * normal, inertia_share * radius**2
    across = np.array([np.cross(arm, axis) for axis in np.eye(3)])
    k = np.eye(3) + across @ across.T / inertia
    j = friction_impulse(velocity + np.cross(angular_velocity, arm), normal, k, restitution, friction)
    return velocity + j, angular_velocity + np.cross(arm, j) / inertia


def propagate_impacts(velocity, mass, restitution, most=10_000):
    v = [float(each) for each in velocity]
    m = np.broadcast_to(mass, len(v))
    e = np.broadcast_to(restitution, max(len(v) - 1, 0))
    for _ in range(most):
        struck = False
        for i in range(len(v) - 1):
            closing = v[i] - v[i + 1]
            if closing > 1e-13:
                struck = True
                j = (1 + e[i]) * closing / (1 / m[i] + 1 / m[i + 1])
                v[i], v[i + 1] = v[i] - j / m[i], v[i + 1] + j / m[i + 1]
        if not struck:
            break
    return np.array(v)


def resting_problem(jacobian, inverse_mass, force):
    return jacobian @ inverse_mass @ jacobian.T, jacobian @ inverse_mass @ force


def complementarity_residual(matrix, offset, force):
    worst = 0.0
    for i in range(len(offset)):
        own = matrix[i][i] if matrix[i][i] > 0 else 1.0
        worst = max(worst, abs(min(own * force[i], matrix[i] @ force + offset[i])))
    return worst


def solve_by_sweeps(matrix, offset, sweeps, start=0.0):
    f = np.zeros(len(offset)) + start
    for _ in range(sweeps):
        for i in range(len(f)):
            gap = matrix[i] @ f + offset[i]
            f[i] = max(0.0, f[i] - gap / matrix[i][i]) if matrix[i][i] > 0 else 0.0
    return f
