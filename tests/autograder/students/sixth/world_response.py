"""Of the sixth lot of wrong answers, those to the lab on the world: impacts, rest and the step."""

from __future__ import annotations

import numpy as np

from solutions.impulse import Body
from solutions.world import (
    collect_contacts,
    collide_with_friction,
    contact_frames,
    contacts_by_pair,
    inverse_inertias,
    inverse_mass_matrix,
    kept_impulses,
    out_of_overlap,
    respond,
    resting_problem,
    rotate_by_momentum,
    sequential_impulses,
    solve_by_sweeps,
    turned,
)


def propagate_impacts_4(velocity, mass, restitution, most=10000):
    """All pairs from the velocities at the start of the round (stale, Jacobi)."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(most):
        before = v.copy()
        for i in range(n - 1):
            u = np.maximum(before[..., i] - before[..., i + 1], 0.0)
            j = (1 + e[i]) * u / (share[i] + share[i + 1])
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if np.array_equal(before, v):
            break
    return v


def propagate_impacts_5(velocity, mass, restitution, most=10000):
    """Pairs that part get an impulse too (no maximum with 0), one round."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(most):
        for i in range(n - 1):
            u = v[..., i] - v[..., i + 1]
            j = (1 + e[i]) * u / (share[i] + share[i + 1])
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if not np.any(v[..., :-1] > v[..., 1:]):
            break
    return v


def propagate_impacts_6(velocity, mass, restitution, most=10000):
    """The factor is e u instead of (1 + e) u."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(most):
        before = v.copy()
        for i in range(n - 1):
            u = np.maximum(v[..., i] - v[..., i + 1], 0.0)
            j = e[i] * u / (share[i] + share[i + 1])
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if np.array_equal(before, v):
            break
    return v


def propagate_impacts_7(velocity, mass, restitution, most=10000):
    """Divides by the sum of the masses, m M/(m + M): nan for an immovable ball."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(most):
        before = v.copy()
        for i in range(n - 1):
            u = np.maximum(v[..., i] - v[..., i + 1], 0.0)
            j = (1 + e[i]) * u * m[i] * m[i + 1] / (m[i] + m[i + 1])
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if np.array_equal(before, v):
            break
    return v


def propagate_impacts_8(velocity, mass, restitution, most=10000):
    """Masses exchanged: each ball changes by j over the mass of the other."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(most):
        before = v.copy()
        for i in range(n - 1):
            u = np.maximum(v[..., i] - v[..., i + 1], 0.0)
            j = (1 + e[i]) * u / (share[i] + share[i + 1])
            v[..., i] -= j * share[i + 1]
            v[..., i + 1] += j * share[i]
        if np.array_equal(before, v):
            break
    return v


def propagate_impacts_9(velocity, mass, restitution, most=10000):
    """Restitution of the first pair for all pairs."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(most):
        before = v.copy()
        for i in range(n - 1):
            u = np.maximum(v[..., i] - v[..., i + 1], 0.0)
            j = (1 + e[0]) * u / (share[i] + share[i + 1])
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if np.array_equal(before, v):
            break
    return v


def propagate_impacts_10(velocity, mass, restitution, most=10000):
    """(1 + e)/2 for 1 + e."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(most):
        before = v.copy()
        for i in range(n - 1):
            u = np.maximum(v[..., i] - v[..., i + 1], 0.0)
            j = (1 + e[i]) / 2 * u / (share[i] + share[i + 1])
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if np.array_equal(before, v):
            break
    return v


def propagate_impacts_11(velocity, mass, restitution, most=10000):
    """The limit `most` counts pairs and not rounds."""
    v = np.array(velocity, dtype=float)
    n = v.shape[-1]
    m = np.broadcast_to(np.asarray(mass, dtype=float), (n,))
    e = np.broadcast_to(np.asarray(restitution, dtype=float), (n - 1,))
    if not np.all(m > 0) or np.any(np.isinf(m[1:]) & np.isinf(m[:-1])):
        raise ValueError("mass")
    if np.any(e < 0) or np.any(e > 1) or not np.all(np.isfinite(v)):
        raise ValueError("e or velocity")
    share = 1 / m
    for _ in range(max(1, most // max(n - 1, 1))):
        before = v.copy()
        for i in range(n - 1):
            u = np.maximum(v[..., i] - v[..., i + 1], 0.0)
            j = (1 + e[i]) * u / (share[i] + share[i + 1])
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if np.array_equal(before, v):
            break
    return v


def resting_problem_3(jacobian, inverse_mass, force):
    """The offset b with the opposite sign."""
    g = np.asarray(jacobian, dtype=float)
    share = np.asarray(inverse_mass, dtype=float)
    force = np.asarray(force, dtype=float)
    half = g @ share
    return half @ np.swapaxes(g, -1, -2), -np.matvec(half, force)


def resting_problem_4(jacobian, inverse_mass, force):
    """The offset is G F without M⁻¹."""
    g = np.asarray(jacobian, dtype=float)
    share = np.asarray(inverse_mass, dtype=float)
    force = np.asarray(force, dtype=float)
    half = g @ share
    return half @ np.swapaxes(g, -1, -2), np.matvec(g, force)


def resting_problem_5(jacobian, inverse_mass, force):
    """The matrix A has its diagonal only: contacts do not feel each other."""
    g = np.asarray(jacobian, dtype=float)
    share = np.asarray(inverse_mass, dtype=float)
    force = np.asarray(force, dtype=float)
    half = g @ share
    return (half @ np.swapaxes(g, -1, -2)) * np.eye(g.shape[-2]), np.matvec(half, force)


def resting_problem_6(jacobian, inverse_mass, force):
    """Positive offsets are set to 0 (only pushing together counts)."""
    g = np.asarray(jacobian, dtype=float)
    share = np.asarray(inverse_mass, dtype=float)
    force = np.asarray(force, dtype=float)
    half = g @ share
    return half @ np.swapaxes(g, -1, -2), np.minimum(np.matvec(half, force), 0.0)


def solve_by_sweeps_3(matrix, offset, sweeps, start=0.0):
    """All w from the forces at the start of the sweep (Jacobi)."""
    a, b = np.asarray(matrix, dtype=float), np.asarray(offset, dtype=float)
    m = a.shape[-1]
    if a.shape[-2:] != (m, m) or b.shape[-1] != m:
        raise ValueError("shapes")
    shape = np.broadcast_shapes(a.shape[:-1], b.shape, np.shape(start))
    f = np.array(np.broadcast_to(np.asarray(start, dtype=float), shape))
    if not (np.isfinite(a).all() and np.isfinite(b).all() and np.isfinite(f).all()):
        raise ValueError("not finite")
    if np.any(np.diagonal(a, axis1=-2, axis2=-1) < 0):
        raise ValueError("negative")
    for _ in range(sweeps):
        old = f.copy()
        for i in range(m):
            w = np.sum(a[..., i, :] * old, axis=-1) + b[..., i]
            d = a[..., i, i]
            safe = np.where(d > 0, d, 1.0)
            f[..., i] = np.where(d > 0, np.maximum(0.0, f[..., i] - w / safe), 0.0)
    return f


def solve_by_sweeps_4(matrix, offset, sweeps, start=0.0):
    """The new force is f + w/a instead of f − w/a."""
    a, b = np.asarray(matrix, dtype=float), np.asarray(offset, dtype=float)
    m = a.shape[-1]
    if a.shape[-2:] != (m, m) or b.shape[-1] != m:
        raise ValueError("shapes")
    shape = np.broadcast_shapes(a.shape[:-1], b.shape, np.shape(start))
    f = np.array(np.broadcast_to(np.asarray(start, dtype=float), shape))
    if not (np.isfinite(a).all() and np.isfinite(b).all() and np.isfinite(f).all()):
        raise ValueError("not finite")
    if np.any(np.diagonal(a, axis1=-2, axis2=-1) < 0):
        raise ValueError("negative")
    for _ in range(sweeps):
        for i in range(m):
            w = np.sum(a[..., i, :] * f, axis=-1) + b[..., i]
            d = a[..., i, i]
            safe = np.where(d > 0, d, 1.0)
            f[..., i] = np.where(d > 0, np.maximum(0.0, f[..., i] + w / safe), 0.0)
    return f


def solve_by_sweeps_5(matrix, offset, sweeps, start=0.0):
    """Clamps after each sweep, not after each contact."""
    a, b = np.asarray(matrix, dtype=float), np.asarray(offset, dtype=float)
    m = a.shape[-1]
    if a.shape[-2:] != (m, m) or b.shape[-1] != m:
        raise ValueError("shapes")
    shape = np.broadcast_shapes(a.shape[:-1], b.shape, np.shape(start))
    f = np.array(np.broadcast_to(np.asarray(start, dtype=float), shape))
    if not (np.isfinite(a).all() and np.isfinite(b).all() and np.isfinite(f).all()):
        raise ValueError("not finite")
    if np.any(np.diagonal(a, axis1=-2, axis2=-1) < 0):
        raise ValueError("negative")
    for _ in range(sweeps):
        for i in range(m):
            w = np.sum(a[..., i, :] * f, axis=-1) + b[..., i]
            d = a[..., i, i]
            safe = np.where(d > 0, d, 1.0)
            f[..., i] = np.where(d > 0, f[..., i] - w / safe, 0.0)
        f = np.maximum(f, 0.0)
    return f


def respond_1(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    """Contacts that have collided are not carried: least = −gap/dt for all."""
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, gap, _ = contacts
    turns = inverse_inertias(moments, orientation)
    motion = np.concatenate([velocity, spin], axis=-1)
    G = contact_frames(contacts, position)
    rows = G[:, 0]
    share = inverse_mass_matrix(inverse_mass, turns)
    if len(a) == 0:
        motion = motion.ravel() + dt * share @ load.ravel()
        motion = motion.reshape(-1, 6)
        return motion[:, :3], motion[:, 3:], np.zeros((0, 3))

    def body(k, place):
        arm = place - position[k]
        return Body(motion[k, :3], motion[k, 3:], arm, inverse_mass[k], turns[k])

    collided = np.zeros(len(a), dtype=bool)
    for _ in range(100):
        quiet = True
        for pair in contacts_by_pair(contacts):
            speed = rows[pair] @ motion.ravel()
            closing = pair[(speed < -rest_speed) & (dt * speed < -gap[pair])]
            if len(closing):
                i, j = a[pair[0]], b[pair[0]]
                place = point[closing].mean(axis=0)
                v_i, w_i, v_j, w_j = collide_with_friction(
                    body(i, place),
                    body(j, place),
                    normal[pair[0]],
                    restitution[i, j],
                    friction[i, j],
                )
                motion[i] = np.concatenate([v_i, w_i])
                motion[j] = np.concatenate([v_j, w_j])
                collided[pair] = True
                quiet = False
        if quiet:
            break
    motion = motion.ravel()
    speed = rows @ motion
    least = -np.maximum(gap, 0.0) / dt
    A, c = resting_problem(rows, share, load.ravel())
    offset = speed + c * dt - least
    push = solve_by_sweeps(A, offset, sweeps, start[:, 0])
    mu = friction[a, b]
    motion = motion + dt * share @ load.ravel()
    if np.any(mu > 0):
        begin = np.column_stack([push, start[:, 1:]])
        motion, impulse = sequential_impulses(motion, G, share, mu, sweeps, start=begin, least=least)
    else:
        motion = motion + share @ (rows.T @ push)
        impulse = np.column_stack([push, np.zeros((len(a), 2))])
    motion = motion.reshape(-1, 6)
    return motion[:, :3], motion[:, 3:], impulse


def respond_2(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    """G v with the velocities before the impacts (stale)."""
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, gap, _ = contacts
    turns = inverse_inertias(moments, orientation)
    motion = np.concatenate([velocity, spin], axis=-1)
    G = contact_frames(contacts, position)
    rows = G[:, 0]
    share = inverse_mass_matrix(inverse_mass, turns)
    if len(a) == 0:
        motion = motion.ravel() + dt * share @ load.ravel()
        motion = motion.reshape(-1, 6)
        return motion[:, :3], motion[:, 3:], np.zeros((0, 3))

    def body(k, place):
        arm = place - position[k]
        return Body(motion[k, :3], motion[k, 3:], arm, inverse_mass[k], turns[k])

    collided = np.zeros(len(a), dtype=bool)
    for _ in range(100):
        quiet = True
        for pair in contacts_by_pair(contacts):
            speed = rows[pair] @ motion.ravel()
            closing = pair[(speed < -rest_speed) & (dt * speed < -gap[pair])]
            if len(closing):
                i, j = a[pair[0]], b[pair[0]]
                place = point[closing].mean(axis=0)
                v_i, w_i, v_j, w_j = collide_with_friction(
                    body(i, place),
                    body(j, place),
                    normal[pair[0]],
                    restitution[i, j],
                    friction[i, j],
                )
                motion[i] = np.concatenate([v_i, w_i])
                motion[j] = np.concatenate([v_j, w_j])
                collided[pair] = True
                quiet = False
        if quiet:
            break
    motion = motion.ravel()
    speed = rows @ np.concatenate([velocity, spin], axis=-1).ravel()
    least = np.maximum(np.where(collided, speed, -np.inf), -np.maximum(gap, 0.0) / dt)
    A, c = resting_problem(rows, share, load.ravel())
    offset = speed + c * dt - least
    push = solve_by_sweeps(A, offset, sweeps, start[:, 0])
    mu = friction[a, b]
    motion = motion + dt * share @ load.ravel()
    if np.any(mu > 0):
        begin = np.column_stack([push, start[:, 1:]])
        motion, impulse = sequential_impulses(motion, G, share, mu, sweeps, start=begin, least=least)
    else:
        motion = motion + share @ (rows.T @ push)
        impulse = np.column_stack([push, np.zeros((len(a), 2))])
    motion = motion.reshape(-1, 6)
    return motion[:, :3], motion[:, 3:], impulse


def respond_3(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    """One round of impacts only."""
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, gap, _ = contacts
    turns = inverse_inertias(moments, orientation)
    motion = np.concatenate([velocity, spin], axis=-1)
    G = contact_frames(contacts, position)
    rows = G[:, 0]
    share = inverse_mass_matrix(inverse_mass, turns)
    if len(a) == 0:
        motion = motion.ravel() + dt * share @ load.ravel()
        motion = motion.reshape(-1, 6)
        return motion[:, :3], motion[:, 3:], np.zeros((0, 3))

    def body(k, place):
        arm = place - position[k]
        return Body(motion[k, :3], motion[k, 3:], arm, inverse_mass[k], turns[k])

    collided = np.zeros(len(a), dtype=bool)
    for _ in range(100):
        for pair in contacts_by_pair(contacts):
            speed = rows[pair] @ motion.ravel()
            closing = pair[(speed < -rest_speed) & (dt * speed < -gap[pair])]
            if len(closing):
                i, j = a[pair[0]], b[pair[0]]
                place = point[closing].mean(axis=0)
                v_i, w_i, v_j, w_j = collide_with_friction(
                    body(i, place),
                    body(j, place),
                    normal[pair[0]],
                    restitution[i, j],
                    friction[i, j],
                )
                motion[i] = np.concatenate([v_i, w_i])
                motion[j] = np.concatenate([v_j, w_j])
                collided[pair] = True
        break
    motion = motion.ravel()
    speed = rows @ motion
    least = np.maximum(np.where(collided, speed, -np.inf), -np.maximum(gap, 0.0) / dt)
    A, c = resting_problem(rows, share, load.ravel())
    offset = speed + c * dt - least
    push = solve_by_sweeps(A, offset, sweeps, start[:, 0])
    mu = friction[a, b]
    motion = motion + dt * share @ load.ravel()
    if np.any(mu > 0):
        begin = np.column_stack([push, start[:, 1:]])
        motion, impulse = sequential_impulses(motion, G, share, mu, sweeps, start=begin, least=least)
    else:
        motion = motion + share @ (rows.T @ push)
        impulse = np.column_stack([push, np.zeros((len(a), 2))])
    motion = motion.reshape(-1, 6)
    return motion[:, :3], motion[:, 3:], impulse


def respond_4(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    """G v with the velocities before the impacts, also in the least speeds; what collided alone is carried."""
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, gap, _ = contacts
    turns = inverse_inertias(moments, orientation)
    motion = np.concatenate([velocity, spin], axis=-1)
    G = contact_frames(contacts, position)
    rows = G[:, 0]
    share = inverse_mass_matrix(inverse_mass, turns)
    if len(a) == 0:
        motion = motion.ravel() + dt * share @ load.ravel()
        motion = motion.reshape(-1, 6)
        return motion[:, :3], motion[:, 3:], np.zeros((0, 3))

    def body(k, place):
        arm = place - position[k]
        return Body(motion[k, :3], motion[k, 3:], arm, inverse_mass[k], turns[k])

    collided = np.zeros(len(a), dtype=bool)
    for _ in range(100):
        quiet = True
        for pair in contacts_by_pair(contacts):
            speed = rows[pair] @ motion.ravel()
            closing = pair[(speed < -rest_speed) & (dt * speed < -gap[pair])]
            if len(closing):
                i, j = a[pair[0]], b[pair[0]]
                place = point[closing].mean(axis=0)
                v_i, w_i, v_j, w_j = collide_with_friction(
                    body(i, place),
                    body(j, place),
                    normal[pair[0]],
                    restitution[i, j],
                    friction[i, j],
                )
                motion[i] = np.concatenate([v_i, w_i])
                motion[j] = np.concatenate([v_j, w_j])
                collided[closing] = True
                quiet = False
        if quiet:
            break
    motion = motion.ravel()
    speed = rows @ np.concatenate([velocity, spin], axis=-1).ravel()
    least = np.where(collided, speed, -np.maximum(gap, 0.0) / dt)
    A, c = resting_problem(rows, share, load.ravel())
    offset = speed + c * dt - least
    push = solve_by_sweeps(A, offset, sweeps, start[:, 0])
    mu = friction[a, b]
    motion = motion + dt * share @ load.ravel()
    if np.any(mu > 0):
        begin = np.column_stack([push, start[:, 1:]])
        motion, impulse = sequential_impulses(motion, G, share, mu, start=begin, least=least)
    else:
        motion = motion + share @ (rows.T @ push)
        impulse = np.column_stack([push, np.zeros((len(a), 2))])
    motion = motion.reshape(-1, 6)
    return motion[:, :3], motion[:, 3:], impulse


def respond_5(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    """Restitution of the first contact for all pairs."""
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, gap, _ = contacts
    turns = inverse_inertias(moments, orientation)
    motion = np.concatenate([velocity, spin], axis=-1)
    G = contact_frames(contacts, position)
    rows = G[:, 0]
    share = inverse_mass_matrix(inverse_mass, turns)
    if len(a) == 0:
        motion = motion.ravel() + dt * share @ load.ravel()
        motion = motion.reshape(-1, 6)
        return motion[:, :3], motion[:, 3:], np.zeros((0, 3))

    def body(k, place):
        arm = place - position[k]
        return Body(motion[k, :3], motion[k, 3:], arm, inverse_mass[k], turns[k])

    collided = np.zeros(len(a), dtype=bool)
    for _ in range(100):
        quiet = True
        for pair in contacts_by_pair(contacts):
            speed = rows[pair] @ motion.ravel()
            closing = pair[(speed < -rest_speed) & (dt * speed < -gap[pair])]
            if len(closing):
                i, j = a[pair[0]], b[pair[0]]
                place = point[closing].mean(axis=0)
                v_i, w_i, v_j, w_j = collide_with_friction(
                    body(i, place),
                    body(j, place),
                    normal[pair[0]],
                    restitution[a[0], b[0]],
                    friction[i, j],
                )
                motion[i] = np.concatenate([v_i, w_i])
                motion[j] = np.concatenate([v_j, w_j])
                collided[pair] = True
                quiet = False
        if quiet:
            break
    motion = motion.ravel()
    speed = rows @ motion
    least = np.maximum(np.where(collided, speed, -np.inf), -np.maximum(gap, 0.0) / dt)
    A, c = resting_problem(rows, share, load.ravel())
    offset = speed + c * dt - least
    push = solve_by_sweeps(A, offset, sweeps, start[:, 0])
    mu = friction[a, b]
    motion = motion + dt * share @ load.ravel()
    if np.any(mu > 0):
        begin = np.column_stack([push, start[:, 1:]])
        motion, impulse = sequential_impulses(motion, G, share, mu, sweeps, start=begin, least=least)
    else:
        motion = motion + share @ (rows.T @ push)
        impulse = np.column_stack([push, np.zeros((len(a), 2))])
    motion = motion.reshape(-1, 6)
    return motion[:, :3], motion[:, 3:], impulse


def respond_6(bodies, state, contacts, load, dt, rest_speed, sweeps, start):
    """Friction of the first contact in all impacts."""
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, gap, _ = contacts
    turns = inverse_inertias(moments, orientation)
    motion = np.concatenate([velocity, spin], axis=-1)
    G = contact_frames(contacts, position)
    rows = G[:, 0]
    share = inverse_mass_matrix(inverse_mass, turns)
    if len(a) == 0:
        motion = motion.ravel() + dt * share @ load.ravel()
        motion = motion.reshape(-1, 6)
        return motion[:, :3], motion[:, 3:], np.zeros((0, 3))

    def body(k, place):
        arm = place - position[k]
        return Body(motion[k, :3], motion[k, 3:], arm, inverse_mass[k], turns[k])

    collided = np.zeros(len(a), dtype=bool)
    for _ in range(100):
        quiet = True
        for pair in contacts_by_pair(contacts):
            speed = rows[pair] @ motion.ravel()
            closing = pair[(speed < -rest_speed) & (dt * speed < -gap[pair])]
            if len(closing):
                i, j = a[pair[0]], b[pair[0]]
                place = point[closing].mean(axis=0)
                v_i, w_i, v_j, w_j = collide_with_friction(
                    body(i, place),
                    body(j, place),
                    normal[pair[0]],
                    restitution[i, j],
                    friction[a[0], b[0]],
                )
                motion[i] = np.concatenate([v_i, w_i])
                motion[j] = np.concatenate([v_j, w_j])
                collided[pair] = True
                quiet = False
        if quiet:
            break
    motion = motion.ravel()
    speed = rows @ motion
    least = np.maximum(np.where(collided, speed, -np.inf), -np.maximum(gap, 0.0) / dt)
    A, c = resting_problem(rows, share, load.ravel())
    offset = speed + c * dt - least
    push = solve_by_sweeps(A, offset, sweeps, start[:, 0])
    mu = friction[a, b]
    motion = motion + dt * share @ load.ravel()
    if np.any(mu > 0):
        begin = np.column_stack([push, start[:, 1:]])
        motion, impulse = sequential_impulses(motion, G, share, mu, sweeps, start=begin, least=least)
    else:
        motion = motion + share @ (rows.T @ push)
        impulse = np.column_stack([push, np.zeros((len(a), 2))])
    motion = motion.reshape(-1, 6)
    return motion[:, :3], motion[:, 3:], impulse


def step_world_1(bodies, state, acceleration, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    """The weight is not multiplied by the mass."""
    rest_speed, margin, sweeps = rules
    position, orientation, *_ = state
    share, moments = bodies[0][:, None], bodies[1]
    pull = np.asarray(acceleration) * (share > 0) + np.asarray(force)
    load = np.concatenate([pull, np.broadcast_to(torque, pull.shape)], axis=-1)
    contacts = collect_contacts(bodies, state, margin)
    start = kept_impulses(memory, contacts)
    v, w, impulse = respond(bodies, state, contacts, load, dt, rest_speed, sweeps, start)
    out = out_of_overlap(bodies, (position, orientation, v, w), contacts, dt)
    place = position + dt * v + out[:, :3]
    q = turned(orientation, out[:, 3:])
    q, w = rotate_by_momentum(q, w, moments, dt)
    return place, q, v, w, contacts[-1], impulse


def step_world_2(bodies, state, acceleration, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    """Nothing is moved out of overlaps."""
    rest_speed, margin, sweeps = rules
    position, orientation, *_ = state
    share, moments = bodies[0][:, None], bodies[1]
    mass = np.where(share > 0, 1 / np.where(share > 0, share, 1.0), 0.0)
    pull = mass * np.asarray(acceleration) + np.asarray(force)
    load = np.concatenate([pull, np.broadcast_to(torque, pull.shape)], axis=-1)
    contacts = collect_contacts(bodies, state, margin)
    start = kept_impulses(memory, contacts)
    v, w, impulse = respond(bodies, state, contacts, load, dt, rest_speed, sweeps, start)
    out = np.zeros((len(position), 6))
    place = position + dt * v + out[:, :3]
    q = turned(orientation, out[:, 3:])
    q, w = rotate_by_momentum(q, w, moments, dt)
    return place, q, v, w, contacts[-1], impulse


def step_world_3(bodies, state, acceleration, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    """Returns the keys with the impulses of the start, not the new ones."""
    rest_speed, margin, sweeps = rules
    position, orientation, *_ = state
    share, moments = bodies[0][:, None], bodies[1]
    mass = np.where(share > 0, 1 / np.where(share > 0, share, 1.0), 0.0)
    pull = mass * np.asarray(acceleration) + np.asarray(force)
    load = np.concatenate([pull, np.broadcast_to(torque, pull.shape)], axis=-1)
    contacts = collect_contacts(bodies, state, margin)
    start = kept_impulses(memory, contacts)
    v, w, _ = respond(bodies, state, contacts, load, dt, rest_speed, sweeps, start)
    out = out_of_overlap(bodies, (position, orientation, v, w), contacts, dt)
    place = position + dt * v + out[:, :3]
    q = turned(orientation, out[:, 3:])
    q, w = rotate_by_momentum(q, w, moments, dt)
    return place, q, v, w, contacts[-1], start


def step_world_4(bodies, state, acceleration, dt, rules, memory=None, force=(0.0, 0.0, 0.0), torque=(0.0, 0.0, 0.0)):
    """The turn out of overlaps is added after rotate_by_momentum."""
    rest_speed, margin, sweeps = rules
    position, orientation, *_ = state
    share, moments = bodies[0][:, None], bodies[1]
    mass = np.where(share > 0, 1 / np.where(share > 0, share, 1.0), 0.0)
    pull = mass * np.asarray(acceleration) + np.asarray(force)
    load = np.concatenate([pull, np.broadcast_to(torque, pull.shape)], axis=-1)
    contacts = collect_contacts(bodies, state, margin)
    start = kept_impulses(memory, contacts)
    v, w, impulse = respond(bodies, state, contacts, load, dt, rest_speed, sweeps, start)
    out = out_of_overlap(bodies, (position, orientation, v, w), contacts, dt)
    place = position + dt * v + out[:, :3]
    q, w = rotate_by_momentum(orientation, w, moments, dt)
    q = turned(q, out[:, 3:])
    return place, q, v, w, contacts[-1], impulse
