"""Of the fifth lot of wrong answers, those to the lab on meshes."""

from __future__ import annotations

import numpy as np

from solutions.meshes import mesh_forces


def mesh_forces_1(mesh, position, velocity):
    """Believes that np.bincount gives one number for each node (no minlength: the last nodes may have no spring)."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    first, second = mesh.edges.T
    d = p[first] - p[second]
    length = np.linalg.norm(d, axis=1)
    u = d / np.where(length > 0, length, 1.0)[:, None]
    rate = np.sum((v[first] - v[second]) * u, axis=1)
    pull = -(mesh.stiffness * (length - mesh.rest_length) + mesh.damping * rate)[:, None] * u
    nodes = np.concatenate([first, second])
    both = np.concatenate([pull, -pull])
    return np.stack([np.bincount(nodes, both[:, i]) for i in range(3)], axis=1)


def mesh_forces_2(mesh, position, velocity):
    """The damper takes the size of the rate: it always pulls."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    first, second = mesh.edges.T
    d = p[first] - p[second]
    length = np.linalg.norm(d, axis=1)
    u = d / np.where(length > 0, length, 1.0)[:, None]
    rate = np.abs(np.sum((v[first] - v[second]) * u, axis=1))
    pull = -(mesh.stiffness * (length - mesh.rest_length) + mesh.damping * rate)[:, None] * u
    force = np.zeros_like(p)
    np.add.at(force, first, pull)
    np.add.at(force, second, -pull)
    return force


def mesh_forces_3(mesh, position, velocity):
    """A spring resists its strain: k (L - L0)/L0."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    first, second = mesh.edges.T
    d = p[first] - p[second]
    length = np.linalg.norm(d, axis=1)
    u = d / np.where(length > 0, length, 1.0)[:, None]
    rest = np.where(mesh.rest_length > 0, mesh.rest_length, 1.0)
    strain = (length - mesh.rest_length) / rest
    rate = np.sum((v[first] - v[second]) * u, axis=1)
    pull = -(mesh.stiffness * strain + mesh.damping * rate)[:, None] * u
    force = np.zeros_like(p)
    np.add.at(force, first, pull)
    np.add.at(force, second, -pull)
    return force


def mesh_forces_4(mesh, position, velocity):
    """A pinned node does not move, so the force on it is zero."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    first, second = mesh.edges.T
    d = p[first] - p[second]
    length = np.linalg.norm(d, axis=1)
    u = d / np.where(length > 0, length, 1.0)[:, None]
    rate = np.sum((v[first] - v[second]) * u, axis=1)
    pull = -(mesh.stiffness * (length - mesh.rest_length) + mesh.damping * rate)[:, None] * u
    force = np.zeros_like(p)
    np.add.at(force, first, pull)
    np.add.at(force, second, -pull)
    force[mesh.pinned] = 0.0
    return force


def mesh_forces_5(mesh, position, velocity):
    """An edge of zero length has no force, tested for the whole mesh at once."""
    position = np.asarray(position, dtype=float)
    velocity = np.asarray(velocity, dtype=float)
    force = np.zeros_like(position)
    first, second = mesh.edges.T
    between = position[first] - position[second]
    length = np.linalg.norm(between, axis=1, keepdims=True)
    if np.any(length == 0):
        return force
    u = between / length
    rate = np.sum((velocity[first] - velocity[second]) * u, axis=1, keepdims=True)
    pull = -(mesh.stiffness[:, None] * (length - mesh.rest_length[:, None]) + mesh.damping[:, None] * rate) * u
    np.add.at(force, first, pull)
    np.add.at(force, second, -pull)
    return force


def mesh_forces_6(mesh, position, velocity):
    """The direction is the edge over its rest length."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    first, second = mesh.edges.T
    d = p[first] - p[second]
    length = np.linalg.norm(d, axis=1)
    u = d / np.where(mesh.rest_length > 0, mesh.rest_length, 1.0)[:, None]
    rate = np.sum((v[first] - v[second]) * u, axis=1)
    pull = -(mesh.stiffness * (length - mesh.rest_length) + mesh.damping * rate)[:, None] * u
    force = np.zeros_like(p)
    np.add.at(force, first, pull)
    np.add.at(force, second, -pull)
    return force


def mesh_forces_7(mesh, position, velocity):
    """The damper brakes end 1 only; the spring pulls both."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    force = np.zeros_like(p)
    for (a, b), rest, k, c in zip(mesh.edges, mesh.rest_length, mesh.stiffness, mesh.damping, strict=True):
        d = p[a] - p[b]
        length = np.linalg.norm(d)
        if length == 0:
            continue
        u = d / length
        spring = -k * (length - rest) * u
        damper = -c * ((v[a] - v[b]) @ u) * u
        force[a] += spring + damper
        force[b] -= spring
    return force


def mesh_forces_8(mesh, position, velocity):
    """A table of stiffnesses by pairs of nodes (a second spring between two nodes overwrites the first)."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    n = len(mesh.mass)
    first, second = mesh.edges.T
    K, C, R = np.zeros((n, n)), np.zeros((n, n)), np.zeros((n, n))
    for table, values in ((K, mesh.stiffness), (C, mesh.damping), (R, mesh.rest_length)):
        table[first, second] = values
        table[second, first] = values
    d = p[:, None] - p[None]
    w = v[:, None] - v[None]
    length = np.linalg.norm(d, axis=-1)
    u = d / np.where(length > 0, length, 1.0)[..., None]
    tension = K * (length - R) + C * np.sum(w * u, axis=-1)
    return -np.sum(tension[..., None] * u, axis=1)


def mesh_forces_9(mesh, position, velocity):
    """The damper resists the whole relative velocity of the ends, and pinned ends count as they are."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    first, second = mesh.edges.T
    d = p[first] - p[second]
    length = np.linalg.norm(d, axis=1)
    u = d / np.where(length > 0, length, 1.0)[:, None]
    pull = -(mesh.stiffness * (length - mesh.rest_length))[:, None] * u - mesh.damping[:, None] * (v[first] - v[second])
    force = np.zeros_like(p)
    np.add.at(force, first, pull)
    np.add.at(force, second, -pull)
    return force


def mesh_step_1(mesh, position, velocity, acceleration, dt):
    """Pins are dealt with at the end: the dampers feel the velocity given for a pinned node."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    f = mesh_forces(mesh, p, v)
    v = v + (mesh.inverse_mass[:, None] * f + acceleration) * dt
    v[mesh.pinned] = 0.0
    return p + v * dt, v


def mesh_step_2(mesh, position, velocity, acceleration, dt):
    """The other acceleration is one more force: (f + a)/m."""
    free = ~mesh.pinned[:, None]
    p = np.asarray(position, dtype=float)
    v = np.asarray(velocity, dtype=float) * free
    f = mesh_forces(mesh, p, v) + acceleration
    v = v + mesh.inverse_mass[:, None] * f * dt
    return p + v * dt, v


def mesh_step_3(mesh, position, velocity, acceleration, dt):
    """A pinned node keeps its place, but its velocity is whatever comes out."""
    p = np.asarray(position, dtype=float)
    v = np.where(mesh.pinned[:, None], 0.0, velocity)
    a = mesh.inverse_mass[:, None] * mesh_forces(mesh, p, v) + acceleration
    v = v + a * dt
    moved = p + v * dt
    moved[mesh.pinned] = p[mesh.pinned]
    return moved, v


def mesh_step_4(mesh, position, velocity, acceleration, dt):
    """Believes that velocity[pinned] = 0 changes only what I have (it writes into the caller's array)."""
    velocity = np.asarray(velocity, dtype=float)
    velocity[mesh.pinned] = 0.0
    a = mesh.inverse_mass[:, None] * mesh_forces(mesh, position, velocity)
    a = a + np.where(mesh.pinned[:, None], 0.0, acceleration)
    velocity = velocity + a * dt
    return position + velocity * dt, velocity


def mesh_step_5(mesh, position, velocity, acceleration, dt):
    """The node moves by v dt + a dt^2/2, with its old velocity."""
    free = ~mesh.pinned[:, None]
    p = np.asarray(position, dtype=float)
    v = np.asarray(velocity, dtype=float) * free
    a = mesh.inverse_mass[:, None] * mesh_forces(mesh, p, v) + free * acceleration
    return p + v * dt + 0.5 * a * dt**2, v + a * dt


def mesh_step_6(mesh, position, velocity, acceleration, dt):
    """First move with the old velocity, then ask for the forces there."""
    free = ~mesh.pinned[:, None]
    v = np.asarray(velocity, dtype=float) * free
    p = np.asarray(position, dtype=float) + v * dt
    a = mesh.inverse_mass[:, None] * mesh_forces(mesh, p, v) + free * acceleration
    return p, v + a * dt


def mesh_step_7(mesh, position, velocity, acceleration, dt):
    """Inverse mass zero holds the pins, also against gravity (they fall)."""
    v = np.where(mesh.pinned[:, None], 0.0, velocity)
    a = mesh.inverse_mass[:, None] * mesh_forces(mesh, position, v) + acceleration
    v = v + a * dt
    return position + v * dt, v


def diagonals_1(position, edges, candidates):
    """Every candidate is compared with the edges alone."""
    p = np.asarray(position, dtype=float)

    def rows(pairs):
        pairs = np.asarray(pairs, dtype=int).reshape(-1, 2)
        out = np.zeros((len(pairs), len(p), 3))
        for k, (a, b) in enumerate(pairs):
            d = p[a] - p[b]
            length = np.linalg.norm(d)
            if length > 0:
                out[k, a], out[k, b] = d / length, -d / length
        return out.reshape(len(pairs), 3 * len(p))

    def rank(matrix):
        return np.linalg.matrix_rank(matrix) if len(matrix) else 0

    have = rows(edges)
    base = rank(have)
    return np.array([rank(np.vstack([have, row])) > base for row in rows(candidates)], dtype=bool)


def diagonals_2(position, edges, candidates):
    """Once 3n - 6 springs resist something the shape is rigid, so stop there."""
    p = np.asarray(position, dtype=float)
    n = len(p)

    def row(a, b):
        r = np.zeros((n, 3))
        d = p[a] - p[b]
        length = np.linalg.norm(d)
        if length > 0:
            r[a], r[b] = d / length, -d / length
        return r.ravel()

    have = [row(a, b) for a, b in edges]
    rank = np.linalg.matrix_rank(np.array(have)) if have else 0
    needed = np.zeros(len(candidates), dtype=bool)
    for k, (a, b) in enumerate(candidates):
        if rank >= 3 * n - 6:
            break
        new = np.linalg.matrix_rank(np.array([*have, row(a, b)]))
        if new > rank:
            needed[k] = True
            have.append(row(a, b))
            rank = new
    return needed


def diagonals_3(position, edges, candidates):
    """No need to normalise the rows, and whatever is below 1e-3 is zero."""
    p = np.asarray(position, dtype=float)

    def row(a, b):
        r = np.zeros((len(p), 3))
        r[a], r[b] = p[a] - p[b], p[b] - p[a]
        return r.ravel()

    have = [row(a, b) for a, b in edges]
    rank = np.linalg.matrix_rank(np.array(have), tol=1e-3) if have else 0
    needed = []
    for a, b in candidates:
        more = [*have, row(a, b)]
        new = np.linalg.matrix_rank(np.array(more), tol=1e-3)
        needed.append(bool(new > rank))
        if new > rank:
            have, rank = more, new
    return np.array(needed, dtype=bool)


def diagonals_4(position, edges, candidates):
    """The row of a spring has u at both ends."""
    p = np.asarray(position, dtype=float)

    def row(a, b):
        r = np.zeros((len(p), 3))
        d = p[a] - p[b]
        length = np.linalg.norm(d)
        r[[a, b]] = d / length if length > 0 else 0.0
        return r.ravel()

    have = [row(a, b) for a, b in edges]
    rank = np.linalg.matrix_rank(np.array(have)) if have else 0
    needed = []
    for a, b in candidates:
        more = [*have, row(a, b)]
        new = np.linalg.matrix_rank(np.array(more))
        needed.append(bool(new > rank))
        if new > rank:
            have, rank = more, new
    return np.array(needed, dtype=bool)


def diagonals_5(position, edges, candidates):
    """The shortest candidates are tried first."""
    p = np.asarray(position, dtype=float)

    def row(a, b):
        r = np.zeros((len(p), 3))
        d = p[a] - p[b]
        length = np.linalg.norm(d)
        if length > 0:
            r[a], r[b] = d / length, -d / length
        return r.ravel()

    have = [row(a, b) for a, b in edges]
    rank = np.linalg.matrix_rank(np.array(have)) if have else 0
    needed = np.zeros(len(candidates), dtype=bool)
    for k in np.argsort([np.linalg.norm(p[a] - p[b]) for a, b in candidates], kind="stable"):
        more = [*have, row(*candidates[k])]
        new = np.linalg.matrix_rank(np.array(more))
        if new > rank:
            needed[k], have, rank = True, more, new
    return needed


def diagonals_6(position, edges, candidates):
    """A candidate is needed as long as more than six motions are left (whichever it resists)."""
    p = np.asarray(position, dtype=float)

    def row(a, b):
        r = np.zeros((len(p), 3))
        d = p[a] - p[b]
        length = np.linalg.norm(d)
        if length > 0:
            r[a], r[b] = d / length, -d / length
        return r.ravel()

    have = [row(a, b) for a, b in edges]
    needed = []
    for a, b in candidates:
        rank = np.linalg.matrix_rank(np.array(have)) if have else 0
        needed.append(bool(3 * len(p) - rank > 6))
        if needed[-1]:
            have.append(row(a, b))
    return np.array(needed, dtype=bool)


def timestep_bound_1(mesh):
    """The 2 belongs to the springs alone: C is the plain sum of the dampers over m."""
    S, D = np.zeros(len(mesh.mass)), np.zeros(len(mesh.mass))
    for (a, b), k, c in zip(mesh.edges, mesh.stiffness, mesh.damping, strict=True):
        S[[a, b]] += k
        D[[a, b]] += c
    K, C = 2 * S * mesh.inverse_mass, D * mesh.inverse_mass
    with np.errstate(divide="ignore"):
        return float(np.min(4 / (C + np.sqrt(C**2 + 4 * K)), initial=np.inf))


def timestep_bound_2(mesh):
    """The worst case: the largest sums of all nodes on the lightest free node."""
    S, D = np.zeros(len(mesh.mass)), np.zeros(len(mesh.mass))
    for (a, b), k, c in zip(mesh.edges, mesh.stiffness, mesh.damping, strict=True):
        S[[a, b]] += k
        D[[a, b]] += c
    free = ~mesh.pinned
    if not np.any(free):
        return np.inf
    m = mesh.mass[free].min()
    K, C = 2 * S[free].max() / m, 2 * D[free].max() / m
    if K == 0 and C == 0:
        return np.inf
    return float(4 / (C + np.sqrt(C**2 + 4 * K)))


def timestep_bound_3(mesh):
    """All nodes count, the pinned ones too."""
    S, D = np.zeros(len(mesh.mass)), np.zeros(len(mesh.mass))
    for end in mesh.edges.T:
        np.add.at(S, end, mesh.stiffness)
        np.add.at(D, end, mesh.damping)
    K, C = 2 * S / mesh.mass, 2 * D / mesh.mass
    with np.errstate(divide="ignore"):
        return float(np.min(4 / (C + np.sqrt(C * C + 4 * K)), initial=np.inf))


def timestep_bound_4(mesh):
    """A pinned neighbour does not move against the node, so its spring counts once and not twice."""
    S, D = np.zeros(len(mesh.mass)), np.zeros(len(mesh.mass))
    for (a, b), k, c in zip(mesh.edges, mesh.stiffness, mesh.damping, strict=True):
        for me, other in ((a, b), (b, a)):
            factor = 1.0 if mesh.pinned[other] else 2.0
            S[me] += factor * k
            D[me] += factor * c
    K, C = S * mesh.inverse_mass, D * mesh.inverse_mass
    with np.errstate(divide="ignore"):
        return float(np.min(4 / (C + np.sqrt(C**2 + 4 * K)), initial=np.inf))


def timestep_bound_5(mesh):
    """A damper makes the step longer: C with the other sign."""
    S, D = np.zeros(len(mesh.mass)), np.zeros(len(mesh.mass))
    for end in mesh.edges.T:
        np.add.at(S, end, mesh.stiffness)
        np.add.at(D, end, mesh.damping)
    K, C = 2 * S * mesh.inverse_mass, 2 * D * mesh.inverse_mass
    with np.errstate(divide="ignore", invalid="ignore"):
        steps = 4 / (np.sqrt(C * C + 4 * K) - C)
    steps = np.where(K + C > 0, steps, np.inf)
    return float(np.min(steps, initial=np.inf))


def timestep_bound_6(mesh):
    """Spring by spring, with both masses: K = k (1/m1 + 1/m2)."""
    first, second = mesh.edges.T
    w = mesh.inverse_mass[first] + mesh.inverse_mass[second]
    K, C = mesh.stiffness * w, mesh.damping * w
    with np.errstate(divide="ignore"):
        return float(np.min(4 / (C + np.sqrt(C * C + 4 * K)), initial=np.inf))


def mesh_sphere_contact_1(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """Friction takes at most mu |v_n| (the bounce counts for nothing)."""
    p, v = np.array(position, dtype=float), np.array(velocity, dtype=float)
    for i in range(len(p)):
        away = p[i] - centre
        distance = np.linalg.norm(away)
        if mesh.pinned[i] or distance >= radius:
            continue
        n = away / distance if distance > 0 else np.array([0.0, 0.0, 1.0])
        p[i] = centre + radius * n
        vn = v[i] @ n
        if vn < 0:
            vt = v[i] - vn * n
            speed = np.linalg.norm(vt)
            if speed > 0:
                vt = vt * max(0.0, 1 - friction * abs(vn) / speed)
            v[i] = vt - restitution * vn * n
    return p, v


def mesh_sphere_contact_2(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """Friction takes mu (1+e)|v_n| from the sliding, always all of it."""
    p, v = np.array(position, dtype=float), np.array(velocity, dtype=float)
    for i in range(len(p)):
        away = p[i] - centre
        distance = np.linalg.norm(away)
        if mesh.pinned[i] or distance >= radius:
            continue
        n = away / distance if distance > 0 else np.array([0.0, 0.0, 1.0])
        p[i] = centre + radius * n
        vn = v[i] @ n
        if vn < 0:
            vt = v[i] - vn * n
            speed = np.linalg.norm(vt)
            if speed > 0:
                vt = vt - friction * (1 + restitution) * abs(vn) * vt / speed
            v[i] = vt - restitution * vn * n
    return p, v


def mesh_sphere_contact_3(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """A node at the centre is put on top, and its velocity is left alone."""
    p, v = np.array(position, dtype=float), np.array(velocity, dtype=float)
    away = p - np.asarray(centre, dtype=float)
    distance = np.linalg.norm(away, axis=1)
    n = away / np.where(distance > 0, distance, 1.0)[:, None]
    inside = (distance < radius) & ~mesh.pinned
    vn = np.sum(v * n, axis=1)
    hit = inside & (vn < 0)
    vt = v - vn[:, None] * n
    speed = np.linalg.norm(vt, axis=1)
    keep = np.maximum(0.0, 1 - friction * (1 + restitution) * np.abs(vn) / np.where(speed > 0, speed, 1.0))
    v[hit] = (keep[:, None] * vt - restitution * vn[:, None] * n)[hit]
    p[inside] = (np.asarray(centre) + radius * n)[inside]
    p[inside & (distance == 0)] = np.asarray(centre) + np.array([0.0, 0.0, radius])
    return p, v


def mesh_sphere_contact_4(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """A node that touches the surface is hit as well (<=)."""
    p, v = np.array(position, dtype=float), np.array(velocity, dtype=float)
    for i in range(len(p)):
        away = p[i] - centre
        distance = np.linalg.norm(away)
        if mesh.pinned[i] or distance > radius:
            continue
        n = away / distance if distance > 0 else np.array([0.0, 0.0, 1.0])
        p[i] = p[i] + (radius - distance) * n
        vn = v[i] @ n
        if vn < 0:
            vt = v[i] - vn * n
            speed = np.linalg.norm(vt)
            if speed > 0:
                vt = vt * max(0.0, 1 - friction * (1 + restitution) * abs(vn) / speed)
            v[i] = vt - restitution * vn * n
    return p, v


def mesh_sphere_contact_5(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """Friction takes its part of the whole speed after the bounce."""
    p, v = np.array(position, dtype=float), np.array(velocity, dtype=float)
    for i in range(len(p)):
        away = p[i] - centre
        distance = np.linalg.norm(away)
        if mesh.pinned[i] or distance >= radius:
            continue
        n = away / distance if distance > 0 else np.array([0.0, 0.0, 1.0])
        p[i] = centre + radius * n
        vn = v[i] @ n
        if vn < 0:
            after = v[i] - (1 + restitution) * vn * n
            speed = np.linalg.norm(after)
            if speed > 0:
                after = after * max(0.0, 1 - friction * (1 + restitution) * abs(vn) / speed)
            v[i] = after
    return p, v


def mesh_sphere_contact_6(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    """The surface is at radius times the normal (the centre forgotten)."""
    p, v = np.array(position, dtype=float), np.array(velocity, dtype=float)
    for i in range(len(p)):
        away = p[i] - centre
        distance = np.linalg.norm(away)
        if mesh.pinned[i] or distance >= radius:
            continue
        n = away / distance if distance > 0 else np.array([0.0, 0.0, 1.0])
        p[i] = radius * n
        vn = v[i] @ n
        if vn < 0:
            vt = v[i] - vn * n
            speed = np.linalg.norm(vt)
            if speed > 0:
                vt = vt * max(0.0, 1 - friction * (1 + restitution) * abs(vn) / speed)
            v[i] = vt - restitution * vn * n
    return p, v


def limit_strain_1(mesh, position, limit=0.1, iterations=1000):
    """All springs of a round are corrected from the same positions."""
    p = np.array(position, dtype=float)
    for _ in range(iterations):
        move = np.zeros_like(p)
        for (a, b), rest in zip(mesh.edges, mesh.rest_length, strict=True):
            d = p[a] - p[b]
            length = np.linalg.norm(d)
            longest = (1 + limit) * rest
            w1, w2 = mesh.inverse_mass[a], mesh.inverse_mass[b]
            if rest > 0 and length > longest and w1 + w2 > 0:
                x = (length - longest) * d / length
                move[a] -= w1 / (w1 + w2) * x
                move[b] += w2 / (w1 + w2) * x
        if not np.any(move):
            break
        p = p + move
    return p


def limit_strain_2(mesh, position, limit=0.1, iterations=1000):
    """A spring may not be too short either: the strain is limited in both directions."""
    p = np.array(position, dtype=float)
    for _ in range(iterations):
        moved = False
        for (a, b), rest in zip(mesh.edges, mesh.rest_length, strict=True):
            d = p[a] - p[b]
            length = np.linalg.norm(d)
            w1, w2 = mesh.inverse_mass[a], mesh.inverse_mass[b]
            if rest == 0 or length == 0 or w1 + w2 == 0:
                continue
            wanted = np.clip(length, (1 - limit) * rest, (1 + limit) * rest)
            if abs(length - wanted) > 1e-12 * wanted:
                x = (length - wanted) * d / length
                p[a] -= w1 / (w1 + w2) * x
                p[b] += w2 / (w1 + w2) * x
                moved = True
        if not moved:
            break
    return p


def limit_strain_3(mesh, position, limit=0.1, iterations=1000):
    """Believes that np.asarray makes an array of my own (it moves the caller's nodes)."""
    p = np.asarray(position, dtype=float)
    for _ in range(iterations):
        for (a, b), rest in zip(mesh.edges, mesh.rest_length, strict=True):
            d = p[a] - p[b]
            length = np.linalg.norm(d)
            longest = (1 + limit) * rest
            w1, w2 = mesh.inverse_mass[a], mesh.inverse_mass[b]
            if rest > 0 and length > longest and w1 + w2 > 0:
                x = (length - longest) * d / length
                p[a] -= w1 / (w1 + w2) * x
                p[b] += w2 / (w1 + w2) * x
    return p


def limit_strain_4(mesh, position, limit=0.1, iterations=1000):
    """The strain is the stretch over the present length."""
    p = np.array(position, dtype=float)
    for _ in range(iterations):
        for (a, b), rest in zip(mesh.edges, mesh.rest_length, strict=True):
            d = p[a] - p[b]
            length = np.linalg.norm(d)
            w1, w2 = mesh.inverse_mass[a], mesh.inverse_mass[b]
            if rest == 0 or length == 0 or w1 + w2 == 0:
                continue
            if (length - rest) / length > limit:
                x = (length - rest / (1 - limit) if limit < 1 else 0.0) * d / length
                p[a] -= w1 / (w1 + w2) * x
                p[b] += w2 / (w1 + w2) * x
    return p


def limit_strain_5(mesh, position, limit=0.1, iterations=1000):
    """Each end makes half of the way, and pinned nodes are put back."""
    start = np.array(position, dtype=float)
    p = start.copy()
    for _ in range(iterations):
        for (a, b), rest in zip(mesh.edges, mesh.rest_length, strict=True):
            d = p[a] - p[b]
            length = np.linalg.norm(d)
            longest = (1 + limit) * rest
            if rest > 0 and length > longest:
                x = (length - longest) * d / length
                p[a] -= x / 2
                p[b] += x / 2
        p[mesh.pinned] = start[mesh.pinned]
    return p
