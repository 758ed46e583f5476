"""Of the sixth lot of wrong answers, those to the lab on the world: turns, pairs and contacts."""

from __future__ import annotations

import numpy as np

from solutions.impulse import rotation_matrix
from solutions.world import candidate_pairs, inverse_inertias, manifolds, turned


def rotate_by_momentum_1(orientation, angular_velocity, moments, dt):
    """Keeps ω as it is (the friend's satellite)."""
    w = np.asarray(angular_velocity, dtype=float)
    inertia = np.asarray(moments, dtype=float)
    R = rotation_matrix(orientation)
    L = np.matvec(R, np.where(np.isfinite(inertia), inertia, 0.0) * np.vecmat(w, R))
    q = turned(orientation, w * dt)
    new = np.matvec(inverse_inertias(inertia, q), L)
    return q, w * np.ones_like(new)


def rotate_by_momentum_2(orientation, angular_velocity, moments, dt):
    """R and Rᵀ exchanged when L is formed."""
    w = np.asarray(angular_velocity, dtype=float)
    inertia = np.asarray(moments, dtype=float)
    R = rotation_matrix(orientation)
    L = np.vecmat(np.where(np.isfinite(inertia), inertia, 0.0) * np.matvec(R, w), R)
    q = turned(orientation, w * dt)
    new = np.matvec(inverse_inertias(inertia, q), L)
    return q, np.where(np.isfinite(inertia), new, w)


def rotate_by_momentum_3(orientation, angular_velocity, moments, dt):
    """Orientation is turned with the new ω instead of the old one."""
    w = np.asarray(angular_velocity, dtype=float)
    inertia = np.asarray(moments, dtype=float)
    R = rotation_matrix(orientation)
    L = np.matvec(R, np.where(np.isfinite(inertia), inertia, 0.0) * np.vecmat(w, R))
    q = turned(orientation, w * dt)
    new = np.matvec(inverse_inertias(inertia, q), L)
    q = turned(orientation, np.where(np.isfinite(inertia), new, w) * dt)
    return q, np.where(np.isfinite(inertia), new, w)


def rotate_by_momentum_4(orientation, angular_velocity, moments, dt):
    """Turns by −ω dt."""
    w = np.asarray(angular_velocity, dtype=float)
    inertia = np.asarray(moments, dtype=float)
    R = rotation_matrix(orientation)
    L = np.matvec(R, np.where(np.isfinite(inertia), inertia, 0.0) * np.vecmat(w, R))
    q = turned(orientation, -w * dt)
    new = np.matvec(inverse_inertias(inertia, q), L)
    return q, np.where(np.isfinite(inertia), new, w)


def rotate_by_momentum_5(orientation, angular_velocity, moments, dt):
    """Turns by ω along the body's axes, as if turned() wanted those."""
    w = np.asarray(angular_velocity, dtype=float)
    inertia = np.asarray(moments, dtype=float)
    R = rotation_matrix(orientation)
    L = np.matvec(R, np.where(np.isfinite(inertia), inertia, 0.0) * np.vecmat(w, R))
    q = turned(orientation, np.vecmat(w, R) * dt)
    new = np.matvec(inverse_inertias(inertia, q), L)
    return q, np.where(np.isfinite(inertia), new, w)


def rotate_by_momentum_6(orientation, angular_velocity, moments, dt):
    """Scales the new ω so that the energy stays; L is no longer kept."""
    w = np.asarray(angular_velocity, dtype=float)
    inertia = np.asarray(moments, dtype=float)
    R = rotation_matrix(orientation)
    L = np.matvec(R, np.where(np.isfinite(inertia), inertia, 0.0) * np.vecmat(w, R))
    q = turned(orientation, w * dt)
    new = np.matvec(inverse_inertias(inertia, q), L)
    E = np.sum(w * L, axis=-1, keepdims=True)
    E2 = np.sum(new * L, axis=-1, keepdims=True)
    new = new * np.sqrt(np.where(E2 > 0, E, 1.0) / np.where(E2 > 0, E2, 1.0))
    return q, np.where(np.isfinite(inertia), new, w)


def candidate_pairs_1(lower, upper):
    """Strict <: boxes that only touch are left out."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")
    t = np.all(low[:, None] < high[None], axis=-1)
    return np.argwhere(np.triu(t & t.T, 1))


def candidate_pairs_2(lower, upper):
    """Any axis instead of all axes."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")
    t = (low[:, None] <= high[None]) & (low[None] <= high[:, None])
    return np.argwhere(np.triu(np.any(t, axis=-1), 1))


def candidate_pairs_3(lower, upper):
    """X and y only, z forgotten."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")
    t = np.all(low[:, None, :2] <= high[None, :, :2], axis=-1)
    return np.argwhere(np.triu(t & t.T, 1))


def candidate_pairs_4(lower, upper):
    """One condition only (i begins before j ends)."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")
    t = np.all(low[:, None] <= high[None], axis=-1)
    return np.argwhere(np.triu(t, 1))


def candidate_pairs_5(lower, upper):
    """Each pair twice, in both orders."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")
    t = np.all(low[:, None] <= high[None], axis=-1)
    return np.argwhere(t & t.T & ~np.eye(len(low), dtype=bool))


def candidate_pairs_6(lower, upper):
    """Loops, the last box never is the second one (range(i + 1, n − 1))."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")
    found = []
    n = len(low)
    for i in range(n):
        for j in range(i + 1, n - 1):
            if np.all(low[i] <= high[j]) and np.all(low[j] <= high[i]):
                found.append((i, j))
    return np.array(found, dtype=int).reshape(-1, 2)


def candidate_pairs_7(lower, upper):
    """Asks whether a corner (lower or upper) of one box lies in the other: misses boxes that cross."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")

    def inside(p, i):
        return np.all(low[i] <= p) and np.all(p <= high[i])

    found = []
    for i in range(len(low)):
        for j in range(i + 1, len(low)):
            if inside(low[j], i) or inside(high[j], i) or inside(low[i], j) or inside(high[i], j):
                found.append((i, j))
    return np.array(found, dtype=int).reshape(-1, 2)


def candidate_pairs_8(lower, upper):
    """The comparison is < on one side and ≤ on the other."""
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    if not np.all(low <= high):
        raise ValueError("a lower corner is above an upper one")
    t = np.all(low[:, None] <= high[None], axis=-1)
    u = np.all(low[:, None] < high[None], axis=-1)
    return np.argwhere(np.triu(t & u.T, 1))


def collect_contacts_1(bodies, state, margin):
    """|R h| instead of |R| h."""
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.abs(np.matvec(R, size))
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = meet[i, j] & ~fixed
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_2(bodies, state, margin):
    """Boxes are not turned: reach = half extents."""
    inverse_mass, *_, meet, kind, size = bodies
    position = state[0]
    reach = 1.0 * size
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = meet[i, j] & ~fixed
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_3(bodies, state, margin):
    """The ball reaches r along x only (size as it is)."""
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.matvec(np.abs(R), size)
    reach = np.where(kind[:, None] == 0, size, reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = meet[i, j] & ~fixed
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_4(bodies, state, margin):
    """Margin not added to the boxes."""
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.matvec(np.abs(R), size)
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + 0.0
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = meet[i, j] & ~fixed
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_5(bodies, state, margin):
    """Drops pairs of which one body is immovable (or instead of and)."""
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.matvec(np.abs(R), size)
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) | (inverse_mass[j] == 0)
    keep = meet[i, j] & ~fixed
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_6(bodies, state, margin):
    """Meet is ignored."""
    inverse_mass, *_, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.matvec(np.abs(R), size)
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = ~fixed
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_7(bodies, state, margin):
    """Pairs of two immovable bodies are kept."""
    *_, meet, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.matvec(np.abs(R), size)
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    keep = meet[i, j]
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_8(bodies, state, margin):
    """Only the first place of each pair is kept (one contact per pair)."""
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.matvec(np.abs(R), size)
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = meet[i, j] & ~fixed
    found = manifolds(bodies, state, pairs[keep], margin)
    _, first = np.unique(np.stack(found[:2], axis=-1), axis=0, return_index=True)
    first = np.sort(first)
    return tuple(part[first] for part in found)


def collect_contacts_9(bodies, state, margin):
    """The box reaches as far as its longest half edge along all axes."""
    inverse_mass, *_, meet, kind, size = bodies
    position = state[0]
    reach = np.max(size, axis=1)[:, None] * np.ones(3)
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = meet[i, j] & ~fixed
    return manifolds(bodies, state, pairs[keep], margin)


def collect_contacts_10(bodies, state, margin):
    """A pair meets if each of the two meets itself."""
    inverse_mass, *_, meet, kind, size = bodies
    position, orientation, *_ = state
    R = rotation_matrix(orientation)
    reach = np.matvec(np.abs(R), size)
    reach = np.where(kind[:, None] == 0, size[:, :1], reach)
    reach = np.where(kind[:, None] == 2, np.inf, reach)
    reach = reach + margin / 2
    pairs = candidate_pairs(position - reach, position + reach)
    i, j = pairs[:, 0], pairs[:, 1]
    fixed = (inverse_mass[i] == 0) & (inverse_mass[j] == 0)
    keep = meet[i, i] & meet[j, j] & ~fixed
    return manifolds(bodies, state, pairs[keep], margin)
