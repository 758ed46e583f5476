"""Right answers for one body alone."""

import math

import numpy as np


def size(v):
    return math.sqrt(v @ v)


def support_force(mass, gravity, push, frame_acceleration, normal):
    lean = [push[i] + mass * gravity[i] - mass * frame_acceleration[i] for i in range(3)]
    out = sum(lean[i] * normal[i] for i in range(3))
    return (0.0 if out > 0 else -out), np.array([lean[i] - out * normal[i] for i in range(3)])


def holds(push, normal_force, static_friction):
    return size(push) <= static_friction * normal_force


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


def roll_step(velocity, spin, radius, friction, gravity, dt):
    slip = np.array([velocity[0] - radius * spin[1], velocity[1] + radius * spin[0]])
    speed = math.hypot(*slip)
    if speed == 0:
        return velocity, spin
    lost = min(friction * gravity * dt, 2 / 7 * speed)
    px, py = -lost * slip / speed
    turned = 2.5 * np.array([py, -px, 0.0]) / radius
    return velocity + np.array([px, py, 0.0]), spin + turned


def break_away_time(force, force_rate, normal, static_friction):
    press, press_rate = -(force @ normal), -(force_rate @ normal)
    f, rate = force + press * normal, force_rate + press_rate * normal
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
