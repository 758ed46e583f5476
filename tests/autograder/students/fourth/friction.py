"""Of the fourth lot of wrong answers, those to the lab on friction."""

from __future__ import annotations

import math

import numpy as np
from abbreviations import arr, col


def support_force_1(mass, gravity, push, frame_acceleration, normal):
    """Wrong sign of the frame: m (g + a) instead of m (g − a)."""
    m, g, F, a, n = arr(mass, gravity, push, frame_acceleration, normal)
    total = col(m) * (g + a) + F
    fn = np.vecdot(total, n)
    return np.maximum(0, -fn), total - col(fn) * n


def support_force_2(mass, gravity, push, frame_acceleration, normal):
    """The floor carries the weight alone: the push does not press the body on."""
    m, g, F, a, n = arr(mass, gravity, push, frame_acceleration, normal)
    weight = col(m) * (g - a)
    N = np.maximum(-np.vecdot(weight, n), 0.0)
    total = weight + F
    return N, total - col(np.vecdot(total, n)) * n


def support_force_3(mass, gravity, push, frame_acceleration, normal):
    """N is the size of the force along the normal, also where it lifts the body off."""
    m, g, F, a, n = arr(mass, gravity, push, frame_acceleration, normal)
    total = col(m) * (g - a) + F
    along_n = np.sum(total * n, axis=-1)
    return np.abs(along_n), total - along_n[..., None] * n


def support_force_4(mass, gravity, push, frame_acceleration, normal):
    """A body that is lifted off has nothing to hold either: along is set to 0."""
    n = [float(x) for x in normal]
    total = [mass * (gravity[i] - frame_acceleration[i]) + push[i] for i in range(3)]
    pressed = -sum(total[i] * n[i] for i in range(3))
    if pressed <= 0:
        return 0.0, np.zeros(3)
    along = [total[i] + pressed * n[i] for i in range(3)]
    return pressed, np.array(along)


def support_force_5(mass, gravity, push, frame_acceleration, normal):
    """Takes the frame's acceleration for a force: m g + F − a."""
    m, g, F, a, n = arr(mass, gravity, push, frame_acceleration, normal)
    total = col(m) * g + F - a
    fn = np.vecdot(total, n)
    return np.maximum(-fn, 0), total - col(fn) * n


def support_force_6(mass, gravity, push, frame_acceleration, normal):
    """Along the surface means x and y: z is set to zero, also on a slope."""
    m, g, F, a, n = arr(mass, gravity, push, frame_acceleration, normal)
    total = m[..., None] * (g - a) + F
    N = np.maximum(0.0, -np.vecdot(total, n))
    return N, total * np.array([1.0, 1.0, 0.0])


def friction_force_8(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """Asks first whether the push can be held, and holds a body that slides, too."""
    P, v, N, ms, mk = arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    way = np.where(speed > 0, v / np.where(speed > 0, speed, 1), P / np.where(size > 0, size, 1))
    held = (size <= col(ms * N)) & ((size > 0) | (speed == 0))
    return np.where(held, -P, -col(mk * N) * way)


def friction_force_9(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """A body at rest is held if each component of the push is within μ_s N: a square."""
    P, v = arr(push, tangent_velocity)
    speed = math.sqrt(sum(x * x for x in v))
    if speed > 0:
        return -kinetic_friction * normal_force * v / speed
    limit = static_friction * normal_force
    if all(abs(x) <= limit for x in P):
        return -P
    return -kinetic_friction * normal_force * P / math.sqrt(sum(x * x for x in P))


def friction_force_10(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """A body that starts to slide has μ_s N against the push, not μ_k N."""
    P, v, N, ms, mk = arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    sliding = -col(mk * N) * v / np.where(speed > 0, speed, 1.0)
    most = col(ms * N)
    rest = -P * np.minimum(1.0, most / np.where(size > 0, size, 1.0))
    rest = np.where(size <= most, -P, rest)
    return np.where(speed > 0, sliding, rest)


def friction_force_11(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """Takes every speed below 1 cm/s for rest."""
    P, v, N, ms, mk = arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    moves = speed > 0.01
    way = np.where(moves, v / np.where(moves, speed, 1), P / np.where(size > 0, size, 1))
    holds = ~moves & (size <= col(ms * N))
    return np.where(holds, -P, -col(mk * N) * way)


def friction_force_12(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """Friction is a reaction to the push, so a sliding body gets no more than the push."""
    P, v, N, ms, mk = arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    kinetic = np.minimum(col(mk * N), size)
    sliding = -kinetic * v / np.where(speed > 0, speed, 1.0)
    starts = -col(mk * N) * P / np.where(size > 0, size, 1.0)
    at_rest = np.where(size <= col(ms * N), -P, starts)
    return np.where(speed > 0, sliding, at_rest)


def friction_force_13(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """A body that slides has friction against the push, not against its velocity."""
    P, v = arr(push, tangent_velocity)
    size = np.linalg.norm(P)
    if not np.any(v) and size <= static_friction * normal_force:
        return -P
    if size == 0:
        return -kinetic_friction * normal_force * v / np.linalg.norm(v)
    return -kinetic_friction * normal_force * P / size


def _unit_or_zero(vector):
    length = np.linalg.norm(vector, axis=-1, keepdims=True)
    return vector / np.where(length > 0, length, 1.0)


def _slide(p, v, P, N, ms, mk, m, dt, *, again="static", rest_of="left", starts=True):
    """One body that slides in a line, with switches for what goes wrong after the stop."""
    speed = math.sqrt(v @ v)
    stop = math.inf
    left = dt
    if speed > 0:
        way = v / speed
        a = (P @ way - mk * N) / m
        if a < 0 and speed <= -a * dt:
            stop = -speed / a
            p = p + v * stop / 2
            v = 0 * v
            left = dt if rest_of == "whole" else dt - stop
        else:
            return p + (v + a * way * dt / 2) * dt, v + a * way * dt, stop
    elif not starts:
        return p, v, stop
    size = math.sqrt(P @ P)
    limit = {"static": ms * N, "kinetic": mk * N, "never": math.inf}[again]
    if size <= limit:
        return p, v, stop
    a = (size - mk * N) / m * P / size
    return p + a * left**2 / 2, a * left, stop


_SLIDE = "(i),(i),(i),(),(),(),(),()->(i),(i),()"


def sliding_motion_3(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """What has stopped stays: does not ask again whether the push is held."""

    def one(p, v, P, N, ms, mk, m, h):
        again = "never" if v @ v > 0 else "static"
        return _slide(p, v, P, N, ms, mk, m, h, again=again)

    return np.vectorize(one, signature=_SLIDE)(
        *arr(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt)
    )


def sliding_motion_4(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """After the stop asks whether μ_k N holds: static friction is forgotten there."""
    p, v, P = arr(position, tangent_velocity, push)
    again = "kinetic" if v @ v > 0 else "static"
    return _slide(p, v, P, normal_force, static_friction, kinetic_friction, mass, dt, again=again)


def sliding_motion_5(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """The time to stop is v/(μ_k N/m): the push does not count in it."""
    p, v, P, N, ms, mk, m, h = arr(
        position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt
    )
    speed = np.linalg.norm(v, axis=-1)
    size = np.linalg.norm(P, axis=-1)
    braking = mk * N / m
    t = np.where((speed > 0) & (braking > 0), speed / np.where(braking > 0, braking, 1.0), np.inf)
    stops = t <= h
    moving = speed > 0
    way = np.where(moving[..., None], _unit_or_zero(v), _unit_or_zero(P))
    breaks = size > ms * N
    a = np.where((moving | breaks)[..., None], (P - col(mk * N) * way) / col(m), 0.0)
    first = np.where(stops, t, h)
    p1 = p + v * col(first) + a * col(first) ** 2 / 2
    v1 = np.where(stops[..., None], 0.0, v + a * col(first))
    a2 = np.where((stops & breaks)[..., None], (P - col(mk * N) * _unit_or_zero(P)) / col(m), 0.0)
    left = col(h - first)
    return p1 + v1 * left + a2 * left**2 / 2, v1 + a2 * left, np.where(stops, t, np.inf)


def sliding_motion_6(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """A game's step: moves with the new velocity and sets it to zero if it would turn."""
    p, v, P, N, ms, mk, m, h = arr(
        position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt
    )
    speed = np.linalg.norm(v, axis=-1)
    size = np.linalg.norm(P, axis=-1)
    way = np.where(col(speed) > 0, _unit_or_zero(v), _unit_or_zero(P))
    friction = -col(mk * N) * way
    friction = np.where(col((speed == 0) & (size <= ms * N)) > 0, -P, friction)
    a = (P + friction) / col(m)
    new = v + a * col(h)
    turned = (speed > 0) & (np.vecdot(new, v) <= 0)
    new = np.where(turned[..., None], 0.0, new)
    slowing = np.linalg.norm(a, axis=-1)
    stop = np.where(turned, speed / np.where(slowing > 0, slowing, 1.0), np.inf)
    return p + new * col(h), new, stop


def sliding_motion_7(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """A body that starts at rest stays at rest, whatever the push is (early return)."""
    p, v, P = arr(position, tangent_velocity, push)
    return _slide(p, v, P, normal_force, static_friction, kinetic_friction, mass, dt, starts=False)


def sliding_motion_8(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """After the stop slides back for a whole dt instead of for what is left."""

    def one(p, v, P, N, ms, mk, m, h):
        return _slide(p, v, P, N, ms, mk, m, h, rest_of="whole")

    return np.vectorize(one, signature=_SLIDE)(
        *arr(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt)
    )


def clamp_to_circle_3(tangent_force, limit):
    """A diamond: the size of a force is the sum of the sizes of its components."""
    f, L = arr(tangent_force, limit)
    size = np.sum(np.abs(f), axis=-1)
    share = np.where(size > L, L / np.where(size > 0, size, 1.0), 1.0)
    return share[..., None] * f


def clamp_to_circle_4(tangent_force, limit):
    """Stretches small forces to the limit, too: friction is always μ N."""
    f, L = arr(tangent_force, limit)
    return col(L) * _unit_or_zero(f)


def clamp_to_circle_5(tangent_force, limit):
    """Forgets the root: the share is L² over x² + y²."""
    x, y, z = (float(c) for c in tangent_force)
    squared = x * x + y * y + z * z
    if squared <= limit * limit:
        return np.array([x, y, z])
    share = limit**2 / squared
    return np.array([share * x, share * y, share * z])


def clamp_to_circle_6(tangent_force, limit):
    """Friction that cannot hold gives nothing: 0 beyond the limit."""
    f, L = arr(tangent_force, limit)
    return np.where(np.linalg.norm(f, axis=-1, keepdims=True) <= col(L), f, 0.0)


def clamp_to_circle_7(tangent_force, limit):
    """Measures the force by x and y alone, which is its size on a level floor only."""
    f, L = arr(tangent_force, limit)
    size = np.hypot(f[..., 0], f[..., 1])
    share = np.minimum(1.0, L / np.maximum(size, 1e-300))
    return share[..., None] * f


def clamp_to_circle_8(tangent_force, limit):
    """Norm of the whole array (no axis): right for one force, wrong for several."""
    f, L = arr(tangent_force, limit)
    size = np.linalg.norm(f)
    if size == 0:
        return f + 0 * col(L)
    return np.minimum(1.0, col(L) / size) * f


def _rolled(v, w, r, impulse, inertia=0.4):
    """Centre and spin after an impulse per mass at the lowest point."""
    turn = np.stack([impulse[..., 1], -impulse[..., 0], np.zeros_like(impulse[..., 0])], axis=-1)
    return v + impulse, w + turn / col(inertia * r)


def _slip(v, w, r):
    arm = np.zeros(np.broadcast_shapes(v.shape, w.shape, (*np.shape(r), 3)))
    arm[..., 2] = -r
    return v + np.cross(w, arm)


def _at_most(vector, most):
    length = np.linalg.norm(vector, axis=-1)
    share = np.where(length > most, most / np.where(length > 0, length, 1), 1.0)
    return col(share) * vector


def roll_step_1(velocity, spin, radius, friction, gravity, dt):
    """Wrong sign of the spin in the slip: v − ω × arm."""
    v, w, r, mu, g, h = arr(velocity, spin, radius, friction, gravity, dt)
    slip = 2 * v - _slip(v, w, r)
    return _rolled(v, w, r, _at_most(-2 / 7 * slip, mu * g * h))


def roll_step_2(velocity, spin, radius, friction, gravity, dt):
    """Wants the impulse that stops a slab, m u, and not two sevenths of it."""
    v, w, r, mu, g, h = arr(velocity, spin, radius, friction, gravity, dt)
    return _rolled(v, w, r, _at_most(-_slip(v, w, r), mu * g * h))


def roll_step_3(velocity, spin, radius, friction, gravity, dt):
    """Friction acts against the velocity of the centre, as on a slab, until it rolls."""
    v, w = arr(velocity, spin)
    slip = v + np.cross(w, [0.0, 0.0, -radius])
    speed = np.linalg.norm(v)
    if speed == 0:
        return v, w
    size = min(friction * gravity * dt, 2 / 7 * np.linalg.norm(slip))
    push = -size * v / speed
    torque = np.cross([0.0, 0.0, -radius], push)
    return v + push, w + torque / (0.4 * radius**2)


def roll_step_4(velocity, spin, radius, friction, gravity, dt):
    """The ball is a shell: I = 2/3 m r², so two fifths of the slip and not two sevenths."""
    v, w, r, mu, g, h = arr(velocity, spin, radius, friction, gravity, dt)
    wanted = -0.4 * _slip(v, w, r)
    return _rolled(v, w, r, _at_most(wanted, mu * g * h), 2 / 3)


def roll_step_5(velocity, spin, radius, friction, gravity, dt):
    """Friction is always μ m g: a slip that is smaller is turned round."""
    v, w, r, mu, g, h = arr(velocity, spin, radius, friction, gravity, dt)
    push = -col(mu * g * h) * _unit_or_zero(_slip(v, w, r))
    return _rolled(v, w, r, push)


def roll_step_6(velocity, spin, radius, friction, gravity, dt):
    """Thinks in the plane: rolls along x alone, and what moves along y is left as it is."""
    v = [float(x) for x in velocity]
    w = [float(x) for x in spin]
    slip = v[0] - radius * w[1]
    push = 2 / 7 * slip
    most = friction * gravity * dt
    push = max(-most, min(most, push))
    v[0] -= push
    w[1] += push * radius / (0.4 * radius**2)
    return np.array(v), np.array(w)


def _parts(force, rate, normal):
    """N, its rate, and the parts of force and rate along the surface."""
    F, R, n = np.broadcast_arrays(*arr(force, rate, normal))
    Fn, Rn = np.vecdot(F, n), np.vecdot(R, n)
    return -Fn, -Rn, F - col(Fn) * n, R - col(Rn) * n


def _leaves(N0, N1, T, R, mu):
    """When |T + R t| leaves μ (N0 + N1 t); all is held now. One case."""
    A = mu**2 * N1**2 - R @ R
    B = mu**2 * N0 * N1 - T @ R
    C = mu**2 * N0**2 - T @ T
    lifts = N0 / -N1 if N1 < 0 else math.inf
    D = max(B * B - A * C, 0.0)
    if A > 0 and N1 >= 0:
        return math.inf
    if B > 0 and A < 0:
        return min(lifts, (B + math.sqrt(D)) / -A)
    below = math.sqrt(D) - B
    return min(lifts, C / below) if below > 0 else lifts


def _for_each(one, N0, N1, T, R, mu):
    N0, N1, mu = np.broadcast_arrays(N0, N1, mu)
    shape = (*mu.shape, 3)
    T, R = np.broadcast_to(T, shape), np.broadcast_to(R, shape)
    out = np.empty(mu.shape)
    for i in np.ndindex(mu.shape):
        out[i] = one(float(N0[i]), float(N1[i]), T[i], R[i], float(mu[i]))
    return out


def break_away_time_2(force, force_rate, normal, static_friction):
    """Adds lengths as if both pushes had one direction: p + r t = μ (N + N' t)."""
    N0, N1, T, R = _parts(force, force_rate, normal)
    mu = np.asarray(static_friction, dtype=float)
    p, r = np.linalg.norm(T, axis=-1), np.linalg.norm(R, axis=-1)
    spare, closing = mu * N0 - p, r - mu * N1
    ends = np.where(closing > 0, spare / np.where(closing > 0, closing, 1), np.inf)
    lifts = np.where(N1 < 0, N0 / np.where(N1 < 0, -N1, 1.0), np.inf)
    return np.where((spare < 0) | (N0 < 0), 0.0, np.minimum(ends, lifts))


def break_away_time_3(force, force_rate, normal, static_friction):
    """Keeps N as it is now: a force that grows along the normal does not change the limit."""

    def one(N0, N1, T, R, mu):
        if N0 < 0 or math.sqrt(T @ T) > mu * N0:
            return 0.0
        return _leaves(N0, 0.0, T, R, mu)

    return _for_each(one, *_parts(force, force_rate, normal), static_friction)


def break_away_time_4(force, force_rate, normal, static_friction):
    """Takes the wrong one of two roots, which lies in the past, and makes it positive."""
    F, R, n = arr(force, force_rate, normal)
    N0, N1 = -(F @ n), -(R @ n)
    T, R = F - (F @ n) * n, R - (R @ n) * n
    mu = static_friction
    if N0 < 0 or (mu * N0) ** 2 < T @ T:
        return 0.0
    a = R @ R - (mu * N1) ** 2
    b = T @ R - mu**2 * N0 * N1
    c = T @ T - (mu * N0) ** 2
    if a <= 0:
        return _leaves(N0, N1, T, R, mu)
    return abs((-b - math.sqrt(b * b - a * c)) / a)


def break_away_time_5(force, force_rate, normal, static_friction):
    """Does not ask whether the body is held now: takes the larger root in any case."""
    N0, N1, T, R = _parts(force, force_rate, normal)
    mu = np.asarray(static_friction, dtype=float)
    a = np.vecdot(R, R) - (mu * N1) ** 2
    b = np.vecdot(T, R) - mu**2 * N0 * N1
    c = np.vecdot(T, T) - (mu * N0) ** 2
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    grows = a > 0
    t = np.where(grows, (root - b) / np.where(grows, a, 1.0), np.inf)
    falls = (a <= 0) & (b > 0)
    t = np.where(falls, -c / np.where(falls, b + root, 1.0), t)
    lifts = np.where(N1 < 0, N0 / np.where(N1 < 0, -N1, 1.0), np.inf)
    return np.maximum(np.minimum(t, lifts), 0.0)


def break_away_time_6(force, force_rate, normal, static_friction):
    """N is |F·n|: a body that is pulled off its support is held as if pressed on."""

    def one(N0, N1, T, R, mu):
        if N0 < 0:
            N0, N1 = -N0, -N1
        if math.sqrt(T @ T) > mu * N0:
            return 0.0
        return _leaves(N0, N1, T, R, mu)

    return _for_each(one, *_parts(force, force_rate, normal), static_friction)


def break_away_time_7(force, force_rate, normal, static_friction):
    """Early return: a push along the surface that does not grow is held for ever."""
    N0, N1, T, R = _parts(force, force_rate, normal)

    def one(N0, N1, T, R, mu):
        if N0 < 0 or math.sqrt(T @ T) > mu * N0:
            return 0.0
        if math.sqrt(R @ R) < 1e-12:
            return math.inf
        return _leaves(N0, N1, T, R, mu)

    return _for_each(one, N0, N1, T, R, static_friction)
