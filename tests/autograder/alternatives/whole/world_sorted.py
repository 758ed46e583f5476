"""Right answers in other words: sort and sweep for the pairs, moments in place of matrices, and lists of results.

The functions that the lab gives, such as `manifolds` and `turned`, stand before these in what is handed in.
"""
# ruff: noqa: F821

import numpy as np


def propagate_impacts(velocity, mass, restitution, most=10_000):
    v = np.array(velocity, dtype=np.float64)
    count = v.shape[-1]
    share = np.ones(count) / mass
    e = np.ones(max(count - 1, 0)) * restitution
    for _ in range(most):
        quiet = True
        for left in range(count - 1):
            right = left + 1
            closing = np.clip(v[..., left] - v[..., right], 0.0, None)
            if np.any(closing > 1e-14 * np.max(np.abs(v), initial=1e-300)):
                quiet = False
                both = share[left] + share[right]
                v[..., left] -= (1 + e[left]) * closing * share[left] / both
                v[..., right] += (1 + e[left]) * closing * share[right] / both
        if quiet:
            break
    return v


def resting_problem(jacobian, inverse_mass, force):
    g, w, f = (np.asarray(each, dtype=np.float64) for each in (jacobian, inverse_mass, force))
    answers = np.einsum("...ij,...kj->...ki", w, g)
    return np.einsum("...ik,...jk->...ij", g, answers), np.einsum("...ik,...k->...i", answers, f)


def solve_by_sweeps(matrix, offset, sweeps, start=0.0):
    a, b = np.asarray(matrix, dtype=np.float64), np.asarray(offset, dtype=np.float64)
    shape = np.broadcast_shapes(a.shape[:-1], b.shape, np.shape(start))
    f = np.zeros(shape) + start
    own = np.einsum("...ii->...i", a)
    for i in range(shape[-1]):
        f[..., i] = np.where(own[..., i] > 0, f[..., i], 0.0)
    for _ in range(sweeps):
        for i in range(shape[-1]):
            others = np.sum(np.delete(a[..., i, :] * f, i, axis=-1), axis=-1)
            wanted = -(others + b[..., i]) / np.where(own[..., i] > 0, own[..., i], 1.0)
            f[..., i] = np.where((own[..., i] > 0) & (wanted > 0), wanted, 0.0)
    return f


def rotate_by_momentum(orientation, angular_velocity, moments, dt):
    q, w, i = (np.asarray(each, dtype=np.float64) for each in (orientation, angular_velocity, moments))
    angle = np.linalg.norm(w, axis=-1, keepdims=True) * dt
    half = np.where(angle != 0, np.sin(angle / 2) / np.where(angle != 0, angle, 1.0), 0.5) * w * dt
    s, u = q[..., :1], q[..., 1:]
    c = np.cos(angle / 2)
    after = np.concatenate(
        [c * s - np.sum(half * u, axis=-1, keepdims=True), c * u + s * half + np.cross(half, u)], axis=-1
    )
    after = after / np.linalg.norm(after, axis=-1, keepdims=True)
    held = np.isinf(i)
    i = np.where(held, 1.0, i)
    old, new = rotation_matrix(q), rotation_matrix(after)
    momentum = np.einsum("...ij,...j,...kj,...k->...i", old, i, old, w)
    return [after, np.where(held, w, np.einsum("...ij,...j,...kj,...k->...i", new, 1 / i, new, momentum))]


def candidate_pairs(lower, upper):
    low, high = np.asarray(lower, dtype=np.float64), np.asarray(upper, dtype=np.float64)
    open_boxes, found = [], []
    for i in np.argsort(low[:, 0], kind="stable"):
        open_boxes = [j for j in open_boxes if high[j, 0] >= low[i, 0]]
        for j in open_boxes:
            if np.all(low[i, 1:] <= high[j, 1:]) and np.all(low[j, 1:] <= high[i, 1:]):
                found.append(tuple(sorted((int(i), int(j)))))
        open_boxes.append(i)
    return np.array(sorted(found), dtype=np.int64).reshape(-1, 2)


def collect_contacts(bodies, state, margin):
    share, *_, meet, kind, size = bodies
    position, orientation, *_ = state
    r = rotation_matrix(orientation)
    reach = np.sqrt(np.square(r)) @ np.asarray(size, dtype=np.float64)[:, :, None]
    reach = reach[:, :, 0]
    reach[kind == 0] = size[kind == 0, 0][:, None]
    reach[kind == 2] = np.inf
    pairs = candidate_pairs(position - reach - margin / 2, position + reach + margin / 2)
    kept = [k for k, (i, j) in enumerate(pairs) if meet[i, j] and not (share[i] == 0 and share[j] == 0)]
    return manifolds(bodies, state, pairs[kept], margin)


def respond(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    share, moments, e, mu, *_ = bodies
    x, q, v, w = state
    a, b, point, normal, gap, _ = contacts
    turning = inverse_inertias(moments, q)
    u = np.hstack([v, w]).astype(np.float64)
    rows = contact_frames(contacts, x)
    hit = np.zeros(len(a), dtype=bool)
    rounds, again = 0, True
    while again and rounds < 100:
        rounds, again = rounds + 1, False
        for pair in contacts_by_pair(contacts):
            speeds = rows[pair, 0] @ u.reshape(-1)
            fast = (speeds < -rest_speed) & (dt * speeds < -gap[pair])
            if not fast.any():
                continue
            i, j, spot = a[pair[0]], b[pair[0]], point[pair][fast].mean(axis=0)
            one = (u[i, :3], u[i, 3:], spot - x[i], share[i], turning[i])
            two = (u[j, :3], u[j, 3:], spot - x[j], share[j], turning[j])
            vi, wi, vj, wj = collide_with_friction(one, two, normal[pair[0]], e[i, j], mu[i, j])
            u[i], u[j] = np.hstack([vi, wi]), np.hstack([vj, wj])
            hit[pair[fast]], again = True, True  # the places that collided, and not all of the two bodies
    m = inverse_mass_matrix(share, turning)
    n = rows[:, 0]
    least = [s if h else -max(g, 0.0) / dt for s, h, g in zip(n @ u.ravel(), hit, gap, strict=True)]
    loaded = u.ravel() + m @ load.ravel() * dt
    j = solve_by_sweeps(n @ m @ n.T, n @ loaded - np.array(least), sweeps, start[:, 0])
    if np.max(mu[a, b], initial=0.0) > 0:  # with the sweeps that `sequential_impulses` has by itself
        begin = np.column_stack([j, start[:, 1:]])
        loaded, impulses = sequential_impulses(loaded, rows, m, mu[a, b], start=begin, least=np.array(least))
    else:
        loaded, impulses = loaded + m @ (n.T @ j), np.column_stack([j, 0 * j, 0 * j])
    u = loaded.reshape(-1, 6)
    return u[:, :3], u[:, 3:], impulses


def step_world(bodies, state, acceleration, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    x, q, *_ = state
    mass = np.array([1 / s if s > 0 else 0.0 for s in bodies[0]])
    load = np.zeros((len(x), 6))
    load[:, :3] = np.outer(mass, acceleration) + force
    load[:, 3:] = torque
    found = collect_contacts(bodies, state, rules[1])
    begin = kept_impulses(memory, found)
    v, w, impulse = respond(bodies, state, found, load, dt, rules[0], rules[2], begin)
    out = out_of_overlap(bodies, (x, q, v, w), found, dt)
    q, w = rotate_by_momentum(turned(q, out[:, 3:]), w, bodies[1], dt)
    return [x + v * dt + out[:, :3], q, v, w, found[5], impulse]
