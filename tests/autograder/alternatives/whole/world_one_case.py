"""Right answers for one case alone: body by body, contact by contact, and without a matrix for all of them.

The functions that the lab gives, such as `manifolds` and `turned`, stand before these in what is handed in.
"""
# ruff: noqa: F821

import math

import numpy as np


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


def solve_by_sweeps(matrix, offset, sweeps, start=0.0):
    f = np.zeros(len(offset)) + start
    for _ in range(sweeps):
        for i in range(len(f)):
            gap = matrix[i] @ f + offset[i]
            f[i] = max(0.0, f[i] - gap / matrix[i][i]) if matrix[i][i] > 0 else 0.0
    return f


def rotate_by_momentum(orientation, angular_velocity, moments, dt):
    q, w, inertia = (np.array(each, dtype=float) for each in (orientation, angular_velocity, moments))
    if q.ndim == 2:
        both = [rotate_by_momentum(*each, dt) for each in zip(q, w, inertia, strict=True)]
        return np.array([each[0] for each in both]), np.array([each[1] for each in both])
    after = turned(q, w * dt)
    if math.isinf(inertia[0]):
        return after, w
    old, new = rotation_matrix(q), rotation_matrix(after)
    momentum = sum(inertia[k] * (old[:, k] @ w) * old[:, k] for k in range(3))
    return after, sum((new[:, k] @ momentum) / inertia[k] * new[:, k] for k in range(3))


def candidate_pairs(lower, upper):
    found = []
    for i in range(len(lower)):
        for j in range(i + 1, len(lower)):
            if all(lower[i][k] <= upper[j][k] and lower[j][k] <= upper[i][k] for k in range(3)):
                found.append((i, j))
    return np.array(found, dtype=int).reshape(-1, 2)


def collect_contacts(bodies, state, margin):
    inverse_mass, _, _, _, meet, kind, size = bodies
    low, high = [], []
    for x, q, k, s in zip(state[0], state[1], kind, size, strict=True):
        if k == 0:
            reach = [s[0]] * 3
        elif k == 2:
            reach = [math.inf] * 3
        else:
            corners = [rotation_matrix(q) @ (s * c) for c in np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T]
            reach = np.max(corners, axis=0)
        low.append([x[a] - reach[a] - margin / 2 for a in range(3)])
        high.append([x[a] + reach[a] + margin / 2 for a in range(3)])
    pairs = [(i, j) for i, j in candidate_pairs(low, high) if meet[i, j] and (inverse_mass[i] or inverse_mass[j])]
    return manifolds(bodies, state, np.array(pairs, dtype=int).reshape(-1, 2), margin)


def respond(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    share, moments, e, mu = bodies[:4]
    position, orientation = state[:2]
    v, w = np.array(state[2], dtype=float), np.array(state[3], dtype=float)
    turning = [inverse_inertias(m, q) for m, q in zip(moments, orientation, strict=True)]
    a, b, point, normal, gap, _ = contacts
    each = range(len(a))
    frames = contact_frames(contacts, position).reshape(len(a), 3, len(share), 6)

    def along(c, d=0):
        i, j = a[c], b[c]
        n = frames[c, d, i, :3]
        here = v[i] + np.cross(w[i], point[c] - position[i])
        there = v[j] + np.cross(w[j], point[c] - position[j])
        return n @ (here - there)

    def push(c, impulse, place):
        for k, sign in ((a[c], 1), (b[c], -1)):
            v[k] += sign * share[k] * impulse
            w[k] += sign * turning[k] @ np.cross(place - position[k], impulse)

    def body(k, place):
        return v[k].copy(), w[k].copy(), place - position[k], share[k], turning[k]

    struck = set()
    for _ in range(100):
        again = False
        for i, j in dict.fromkeys(zip(a.tolist(), b.tolist(), strict=True)):
            own = [c for c in each if (a[c], b[c]) == (i, j)]
            closing = [c for c in own if along(c) < -rest_speed and gap[c] + along(c) * dt < 0]
            if closing:
                place = sum(point[c] for c in closing) / len(closing)
                hit = collide_with_friction(body(i, place), body(j, place), normal[own[0]], e[i, j], mu[i, j])
                v[i], w[i], v[j], w[j] = hit
                struck.update(own)
                again = True
        if not again:
            break
    floor = [max(along(c), 0.0) if c in struck else -max(gap[c], 0.0) / dt for c in each]
    for k in range(len(share)):
        v[k] += dt * share[k] * load[k, :3]
        w[k] += dt * turning[k] @ load[k, 3:]
    soft = []
    for c in each:
        unit = [np.cross(point[c] - position[k], normal[c]) for k in (a[c], b[c])]
        soft.append(share[a[c]] + share[b[c]] + unit[0] @ turning[a[c]] @ unit[0] + unit[1] @ turning[b[c]] @ unit[1])
    motion = np.concatenate([v, w], axis=1).ravel()
    total = [float(start[c][0]) for c in each]
    for c in each:
        push(c, total[c] * normal[c], point[c])
    for _ in range(sweeps):
        for c in each:
            new = max(0.0, total[c] + (floor[c] - along(c)) / soft[c])
            push(c, (new - total[c]) * normal[c], point[c])
            total[c] = new
    impulse = np.array([[j, 0.0, 0.0] for j in total]).reshape(-1, 3)
    if any(mu[a[c], b[c]] > 0 for c in each):
        impulse[:, 1:] = np.asarray(start)[:, 1:]
        rows, masses = contact_frames(contacts, position), inverse_mass_matrix(share, np.array(turning))
        motion, impulse = sequential_impulses(motion, rows, masses, mu[a, b], sweeps, impulse, floor)
        v, w = np.split(motion.reshape(-1, 6), 2, axis=1)
    return v, w, impulse


def step_world(bodies, state, acceleration, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    x, q = state[0], state[1]
    contacts = collect_contacts(bodies, state, rules[1])
    count = len(x)
    force, torque = np.broadcast_to(force, (count, 3)), np.broadcast_to(torque, (count, 3))
    load = np.zeros((count, 6))
    for k in range(count):
        if bodies[0][k] > 0:
            load[k, :3] = np.asarray(acceleration) / bodies[0][k] + force[k]
            load[k, 3:] = torque[k]
    v, w, impulse = respond(bodies, state, contacts, load, dt, rules[0], rules[2], kept_impulses(memory, contacts))
    way = out_of_overlap(bodies, (x, q, v, w), contacts, dt)
    q, w = rotate_by_momentum(turned(q, way[:, 3:]), w, bodies[1], dt)
    return x + dt * v + way[:, :3], q, v, w, contacts[5], impulse
