"""Right answers with the matrix of ends: a row for each edge, 1 at its first node and −1 at its second."""

import numpy as np


def incidence(edges, nodes):
    edges = np.asarray(edges)
    b = np.zeros((len(edges), nodes))
    b[np.arange(len(edges)), edges[:, 0]] = 1
    b[np.arange(len(edges)), edges[:, 1]] = -1
    return b


def directions(b, position):
    way = b @ position
    length = np.sqrt(np.einsum("ij,ij->i", way, way))
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.nan_to_num(way / length[:, None]), length


def mesh_forces(mesh, position, velocity):
    edges, rest_length, stiffness, damping, mass, _ = mesh
    b = incidence(edges, len(mass))
    u, length = directions(b, np.asarray(position))
    tension = stiffness * (length - rest_length) + damping * np.einsum("ij,ij->i", b @ velocity, u)
    return -b.T @ (tension[:, None] * u)


def mesh_step(mesh, position, velocity, acceleration, dt):
    *_, mass, pinned = mesh
    free = np.where(pinned, 0.0, 1.0)[:, None]
    start = free * velocity
    change = mesh_forces(mesh, position, start) / np.reshape(mass, (-1, 1)) + np.asarray(acceleration)
    after = start + dt * free * change
    return np.stack([position + dt * after, after])


def diagonals(position, edges, candidates):
    """By the smallest singular value that is not zero any longer: the number of motions that are left."""
    pairs = np.concatenate([np.asarray(edges).reshape(-1, 2), np.asarray(candidates).reshape(-1, 2)])
    b = incidence(pairs, len(position))
    u, _ = directions(b, np.asarray(position))
    rows = (b[:, :, None] * u[:, None, :]).reshape(len(pairs), 3 * len(position))
    keep = list(range(len(edges)))
    for number in range(len(edges), len(pairs)):
        tried = rows[[*keep, number]]
        grows = np.sum(np.linalg.eigvalsh(tried @ tried.T) > 1e-9) > (
            np.sum(np.linalg.eigvalsh(rows[keep] @ rows[keep].T) > 1e-9) if keep else 0
        )
        if grows:
            keep.append(number)
    return np.isin(np.arange(len(edges), len(pairs)), keep)


def timestep_bound(mesh):
    edges, _, stiffness, damping, mass, pinned = mesh
    at = np.abs(incidence(edges, len(mass))).T
    light = np.where(pinned, 0.0, 1 / mass)
    k, c = 2 * light * (at @ stiffness), 2 * light * (at @ damping)
    with np.errstate(divide="ignore"):
        return np.min(4 / (c + np.sqrt(c**2 + 4 * k)))


def mesh_sphere_contact(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    away = np.asarray(position) - centre
    distance = np.linalg.norm(away, axis=1, keepdims=True)
    n = np.where(distance > 0, away / np.where(distance > 0, distance, 1), np.eye(3)[2])
    inside = (distance < radius) & ~np.asarray(mesh[5])[:, None]
    across = np.einsum("ij,ij->i", velocity, n)[:, None]
    along = velocity - across * n
    push = np.clip(-(1 + restitution) * across, 0, None)
    speed = np.linalg.norm(along, axis=1, keepdims=True)
    rub = np.minimum(friction * push, speed)
    after = velocity + push * n - rub * along / np.where(speed > 0, speed, 1)
    return [np.where(inside, centre + radius * n, position), np.where(inside, after, velocity)]


def limit_strain(mesh, position, limit=0.1, iterations=1000):
    edges, rest, _, _, mass, pinned = mesh
    light = np.where(pinned, 0.0, 1 / np.asarray(mass))
    places = np.array(position, dtype=float)
    allowed = np.where(rest > 0, rest * (1 + limit), np.inf)
    for _ in range(iterations):
        before = places.copy()
        for pair, most in zip(edges, allowed, strict=True):
            way = places[pair[1]] - places[pair[0]]
            over = max(0.0, 1 - most / np.linalg.norm(way)) if np.any(way) else 0.0
            shares = light[pair]
            if shares.sum() > 0:
                places[pair] += over * (shares / shares.sum())[:, None] * np.array([way, -way])
        if np.array_equal(before, places):
            break
    return places
