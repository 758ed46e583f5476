"""Of the fourth lot of wrong answers, those to the lab on responses."""

from __future__ import annotations

import math

import numpy as np
from abbreviations import arr, col

from solutions.response import penalty_damping


def _bounced(v, n, e):
    """Velocity after a plane at rest; a body on its way out keeps it."""
    towards = np.minimum(np.vecdot(v, n), 0.0)
    return v - col((1 + e) * towards) * n


def kinematic_response_15(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Forgets the way back: returns the velocity as seen from the racket."""
    v, n, e, w = arr(velocity, normal, restitution, plane_velocity)
    seen = v - w
    vn = np.vecdot(seen, n)
    return np.where(col(vn) < 0, seen - col((1 + e) * vn) * n, v)


def kinematic_response_16(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Turns the whole relative velocity around, also its part along the plane."""
    v, n, w = list(velocity), list(normal), list(plane_velocity)
    seen = [v[i] - w[i] for i in range(3)]
    approach = sum(seen[i] * n[i] for i in range(3))
    if approach >= 0:
        return np.array(v, dtype=float)
    return np.array([w[i] - restitution * seen[i] for i in range(3)])


def kinematic_response_17(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Takes e for the share of the energy that is kept, so that √e is left of the speed."""
    v, n, e, w = arr(velocity, normal, restitution, plane_velocity)
    vn = np.vecdot(v - w, n)
    return v - col((1 + np.sqrt(e)) * np.minimum(vn, 0)) * n


def kinematic_response_18(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Asks the ball's own velocity, not the relative one, whether it approaches."""
    v, n, w = arr(velocity, normal, plane_velocity)
    if v @ n >= 0:
        return v
    relative = (v - w) @ n
    return v - (1 + restitution) * relative * n


def kinematic_response_19(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Bounces as off a plane at rest and adds the plane's speed once: −e v + w."""
    v, n, e, w = arr(velocity, normal, restitution, plane_velocity)
    vn, wn = np.vecdot(v, n), np.vecdot(w, n)
    after = v - col((1 + e) * vn) * n + col(wn) * n
    return np.where(col(vn - wn) < 0, after, v)


def kinematic_response_20(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Mirrors as on the slide and then multiplies the whole vector by e."""
    v, n, e, w = arr(velocity, normal, restitution, plane_velocity)
    u = v - w
    un = np.sum(u * n, axis=-1, keepdims=True)
    mirrored = u - 2 * un * n
    return np.where(un < 0, w + e[..., None] * mirrored, v)


def respond_at_step_4(position, velocity, acceleration, normal, behind, restitution, dt):
    """The plane takes the whole acceleration, also the pull along a slope."""
    p, v, a, n, e = arr(position, velocity, acceleration, normal, restitution)
    hits = (np.asarray(behind) & (np.vecdot(v, n) < 0))[..., None]
    v = np.where(hits, _bounced(v, n, e), v)
    a = np.where(hits, 0.0, a)
    v = v + a * col(dt)
    return p + v * col(dt), v


def respond_at_step_5(position, velocity, acceleration, normal, behind, restitution, dt):
    """Moves with the velocity from before gravity's change: explicit Euler."""
    p, v, a, n, e = arr(position, velocity, acceleration, normal, restitution)
    hits = (np.asarray(behind) & (np.vecdot(v, n) < 0))[..., None]
    start = np.where(hits, _bounced(v, n, e), v)
    carried = a - col(np.minimum(np.vecdot(a, n), 0)) * n
    a = np.where(hits, carried, a)
    return p + start * col(dt), start + a * col(dt)


def respond_at_step_6(position, velocity, acceleration, normal, behind, restitution, dt):
    """The plane carries every body that is behind it, also one on its way out."""
    p, v, a, n, e = arr(position, velocity, acceleration, normal, restitution)
    b = np.asarray(behind)[..., None]
    v = np.where(b, _bounced(v, n, e), v)
    a = np.where(b, a - col(np.minimum(np.vecdot(a, n), 0)) * n, a)
    v = v + col(dt) * a
    p = p + col(dt) * v
    return p, v


def respond_at_step_7(position, velocity, acceleration, normal, behind, restitution, dt):
    """Takes away the acceleration along N also where it lifts the body off."""
    p, v, a, n = arr(position, velocity, acceleration, normal)
    if behind and v @ n < 0:
        v = v - (1 + restitution) * (v @ n) * n
        a = a - (a @ n) * n
    v = v + a * dt
    p = p + v * dt
    return p, v


def respond_at_step_8(position, velocity, acceleration, normal, behind, restitution, dt):
    """The friend's order: moves first and responds at the end of the step."""
    p, v, a, n, e = arr(position, velocity, acceleration, normal, restitution)
    v = v + a * col(dt)
    p = p + v * col(dt)
    v = np.where(np.asarray(behind)[..., None], _bounced(v, n, e), v)
    return p, v


def respond_at_step_9(position, velocity, acceleration, normal, behind, restitution, dt):
    """Moves along a parabola, p + v dt + a dt²/2, instead of semi-implicitly."""
    p, v, a, n, e = arr(position, velocity, acceleration, normal, restitution)
    hits = np.logical_and(behind, np.vecdot(v, n) < 0)[..., None]
    v = np.where(hits, _bounced(v, n, e), v)
    pressed = np.minimum(np.vecdot(a, n), 0)
    a = np.where(hits, a - col(pressed) * n, a)
    t = col(dt)
    return p + v * t + a * t**2 / 2, v + a * t


def _step(p, v, a, n, behind, e, dt):
    """The step of respond_at_step, as it should be."""
    hits = (behind & (np.vecdot(v, n) < 0))[..., None]
    v = np.where(hits, _bounced(v, n, e), v)
    a = np.where(hits, a - col(np.minimum(np.vecdot(a, n), 0)) * n, a)
    v = v + a * col(dt)
    return p + v * col(dt), v


def _of_one_shape(p, v, a, n, d, e, dt):
    p, v, a, n = np.broadcast_arrays(*arr(p, v, a, n))
    numbers = np.broadcast_shapes(p.shape[:-1], *(np.shape(x) for x in (d, e, dt)))
    p, v, a, n = (np.broadcast_to(x, (*numbers, 3)) for x in (p, v, a, n))
    return p, v, a, n, *(np.broadcast_to(x, numbers) for x in arr(d, e, dt))


def bounce_1(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    """Takes the plane for n·p = d: the sign of the offset is wrong."""
    p, v, a, n, d, e, h = _of_one_shape(position, velocity, acceleration, normal, offset, restitution, dt)
    ps, vs = [p], [v]
    for _ in range(steps):
        behind = np.vecdot(n, p) < d
        p, v = _step(p, v, a, n, behind, e, h)
        ps.append(p)
        vs.append(v)
    return np.stack(ps), np.stack(vs)


def bounce_2(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    """Looks at the end of the step, after the move, and responds there."""
    p, v, a, n, d, e, h = _of_one_shape(position, velocity, acceleration, normal, offset, restitution, dt)
    ps, vs = [p], [v]
    for _ in range(steps):
        v = v + a * h[..., None]
        p = p + v * h[..., None]
        behind = np.vecdot(n, p) + d < 0
        v = np.where(behind[..., None], _bounced(v, n, e), v)
        ps.append(p)
        vs.append(v)
    return np.array(ps), np.array(vs)


def bounce_3(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    """A ball that touches the plane counts as behind it: ≤ instead of <."""
    p, v, a, n, d, e, h = _of_one_shape(position, velocity, acceleration, normal, offset, restitution, dt)
    places, speeds = np.empty((steps + 1, *p.shape)), np.empty((steps + 1, *p.shape))
    places[0], speeds[0] = p, v
    for k in range(steps):
        behind = np.vecdot(n, places[k]) + d <= 0
        places[k + 1], speeds[k + 1] = _step(places[k], speeds[k], a, n, behind, e, h)
    return places, speeds


def bounce_4(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    """Keeps the same array in every row (p += …), so that all rows are the last state."""
    p = np.array(position, dtype=float)
    v = np.array(velocity, dtype=float)
    a, n = arr(acceleration, normal)
    ps, vs = [p], [v]
    for _ in range(steps):
        pull = a
        if p @ n + offset < 0 and v @ n < 0:
            v -= (1 + restitution) * (v @ n) * n
            pull = a - min(a @ n, 0.0) * n
        v += pull * dt
        p += v * dt
        ps.append(p)
        vs.append(v)
    return np.array(ps), np.array(vs)


def bounce_5(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    """Leaves the start out: as many rows as steps."""
    p, v, a, n, d, e, h = _of_one_shape(position, velocity, acceleration, normal, offset, restitution, dt)
    ps, vs = np.zeros((steps, *p.shape)), np.zeros((steps, *p.shape))
    for k in range(steps):
        p, v = _step(p, v, a, n, np.vecdot(n, p) + d < 0, e, h)
        ps[k], vs[k] = p, v
    return ps, vs


def bounce_6(position, velocity, acceleration, normal, offset, restitution, dt, steps):
    """Puts a ball that is behind back onto the plane before it responds."""
    p, v, a, n, d, e, h = _of_one_shape(position, velocity, acceleration, normal, offset, restitution, dt)
    ps, vs = [p], [v]
    for _ in range(steps):
        height = np.vecdot(n, p) + d
        behind = height < 0
        p = p - col(np.minimum(height, 0.0)) * n
        p, v = _step(p, v, a, n, behind, e, h)
        ps.append(p)
        vs.append(v)
    return np.stack(ps), np.stack(vs)


def _fly(p, v, a, t):
    return p + v * t + a * t * t / 2, v + a * t


def respond_at_impact_5(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Flies for the whole dt after the impact, not for what is left of the step."""
    p, v, a, n, e, T, h = arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    hits = (h >= T)[..., None]
    at, there = _fly(p, v, a, col(np.minimum(T, h)))
    after = _fly(at, _bounced(there, n, e), a, col(h))
    free = _fly(p, v, a, col(h))
    return np.where(hits, after[0], free[0]), np.where(hits, after[1], free[1])


def respond_at_impact_6(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Turns the velocity of the start around, not the velocity at the impact."""
    p, v, a, n = arr(position, velocity, acceleration, normal)
    if time_of_impact > dt:
        return p + v * dt + a * dt**2 / 2, v + a * dt
    T = time_of_impact
    p = p + v * T + a * T**2 / 2
    vn = v @ n
    if vn < 0:
        v = v - (1 + restitution) * vn * n
    left = dt - T
    return p + v * left + a * left**2 / 2, v + a * left


def respond_at_impact_7(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Flies in straight lines: the places lack a t²/2."""
    p, v, a, n, e, T, h = arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    t = col(np.minimum(T, h))
    hits = col(T) <= col(h)
    p, v = p + v * t, v + a * t
    v = np.where(hits, _bounced(v, n, e), v)
    left = col(h) - t
    return p + v * left, v + a * left


def respond_at_impact_8(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Clips T to the step and responds at its end even if the impact comes later."""
    p, v, a, n, e, T, h = arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    t = np.minimum(T, h)
    p, v = _fly(p, v, a, col(t))
    v = _bounced(v, n, e)
    return _fly(p, v, a, col(h - t))


def respond_at_impact_9(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Lets the plane carry the weight after the impact, as the step response does."""
    p, v, a, n, e, T, h = arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    t = np.minimum(T, h)
    p, v = _fly(p, v, a, col(t))
    hits = col(h >= T)
    v = np.where(hits, _bounced(v, n, e), v)
    carried = a - col(np.minimum(np.vecdot(a, n), 0)) * n
    a = np.where(hits, carried, a)
    return _fly(p, v, a, col(h - t))


def respond_at_impact_10(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Takes T for a share of the step, 0 to 1."""
    p, v, a, n = arr(position, velocity, acceleration, normal)
    if time_of_impact > 1:
        return _fly(p, v, a, dt)
    t = time_of_impact * dt
    p, v = _fly(p, v, a, t)
    v = _bounced(v, n, restitution)
    return _fly(p, v, a, dt - t)


def penalty_force_4(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """Wrong sign of the damper: it pushes with the velocity."""
    s, vn, n, k, c = arr(separation, normal_velocity, normal, stiffness, damping)
    f = np.where(s < 0, -k * s + c * vn, 0.0)
    if not adhesive:
        f = np.maximum(f, 0.0)
    return f[..., None] * n


def penalty_force_5(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """The damper works on the way in alone and takes nothing away on the way out."""
    s, u, n, k, c = arr(separation, normal_velocity, normal, stiffness, damping)
    damper = -c * u if adhesive else np.maximum(-c * u, 0.0)
    return col(np.where(s < 0, -k * s + damper, 0.0)) * n


def penalty_force_6(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """The damper weakens the push in both directions, as if damping were always less force."""
    n = np.asarray(normal, dtype=float)
    if separation >= 0:
        return 0.0 * n
    size = -stiffness * separation - damping * abs(normal_velocity)
    if not adhesive and size < 0:
        size = 0.0
    return size * n


def penalty_force_7(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """The damper works outside as well: only the spring knows where the surface is."""
    s, vn, n, k, c = arr(separation, normal_velocity, normal, stiffness, damping)
    depth = np.maximum(-s, 0)
    f = k * depth - c * vn
    if not adhesive:
        f = np.maximum(f, 0)
    return col(f) * n


def penalty_force_8(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """An adhesive contact pulls a body back also after it has come off."""
    s, vn, n, k, c = arr(separation, normal_velocity, normal, stiffness, damping)
    f = -k * s - c * vn
    if adhesive:
        return col(f) * n
    return col(np.where(s < 0, np.maximum(f, 0), 0)) * n


def penalty_force_9(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """Clamps the components of the force and not its size along the normal."""
    s, vn, n, k, c = arr(separation, normal_velocity, normal, stiffness, damping)
    inside = (s < 0)[..., None]
    force = (-k * s - c * vn)[..., None] * n
    if not adhesive:
        force = np.maximum(force, 0.0)
    return np.where(inside, force, 0.0)


def penalty_step_limit_3(mass, stiffness, damping=0.0):
    """2 √(m/k): the damper does not matter."""
    m, k, c = arr(mass, stiffness, damping)
    return 2 * np.sqrt(m / k) + 0 * c


def penalty_step_limit_4(mass, stiffness, damping=0.0):
    """A damper calms, so it makes the step longer: + c in the solution."""
    m, k, c = arr(mass, stiffness, damping)
    return (c + np.sqrt(c * c + 4 * m * k)) / k


def penalty_step_limit_5(mass, stiffness, damping=0.0):
    """2/ω with the frequency of the damped swing, and no limit if it does not swing."""
    m, k, c = arr(mass, stiffness, damping)
    squared = k / m - (c / (2 * m)) ** 2
    swings = squared > 0
    return np.where(swings, 2 / np.sqrt(np.where(swings, squared, 1.0)), np.inf)


def penalty_step_limit_6(mass, stiffness, damping=0.0):
    """The smaller of the spring's limit and the damper's, each by itself."""
    spring = 2 * math.sqrt(mass / stiffness)
    if damping == 0:
        return spring
    return min(spring, 2 * mass / damping)


def penalty_step_limit_7(mass, stiffness, damping=0.0):
    """Loses the 2 of the middle term: solves k dt² + c dt − 4 m = 0."""
    m, k, c = arr(mass, stiffness, damping)
    return 8 * m / (c + np.sqrt(c**2 + 16 * k * m))


def penalty_step_limit_8(mass, stiffness, damping=0.0):
    """Subtracts two nearly equal numbers: a strong damper gives rubbish or 0."""
    m, k, c = arr(mass, stiffness, damping)
    return (np.sqrt(c**2 + 4 * m * k) - c) / k


def design_contact_1(mass, speed, depth, restitution, steps_per_contact):
    """Forgets one of the two halves: m v²/2 = k d²."""
    m, v, d, e, N = arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * v**2 / (2 * d**2)
    c = penalty_damping(e, m, k)
    return k, c, np.pi * np.sqrt(m / k) / N


def design_contact_2(mass, speed, depth, restitution, steps_per_contact):
    """Takes the depth at which the body would lie at rest: k = m g/d."""
    m, v, d, e, N = arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * 9.81 / d + 0 * v
    c = penalty_damping(e, m, k)
    dt = np.pi * np.sqrt(m / k) / N
    return k, c, dt


def design_contact_3(mass, speed, depth, restitution, steps_per_contact):
    """Damping in proportion to what is lost: (1 − e) of the critical damping."""
    k = mass * speed**2 / depth**2
    c = (1 - restitution) * 2 * math.sqrt(k * mass)
    dt = math.pi * depth / speed / steps_per_contact
    return k, c, dt


def design_contact_4(mass, speed, depth, restitution, steps_per_contact):
    """Damping by the formula of a contact that pulls, ζ = −ln e/√(π² + ln² e)."""
    m, v, d, e, N = arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * (v / d) ** 2
    loss = -np.log(e)
    zeta = loss / np.sqrt(np.pi**2 + loss**2)
    return k, 2 * zeta * np.sqrt(k * m), np.pi * d / (v * N)


def design_contact_5(mass, speed, depth, restitution, steps_per_contact):
    """Takes a contact for a whole swing, 2π √(m/k)."""
    m, v, d, e, N = arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * v * v / (d * d)
    return k, penalty_damping(e, m, k), 2 * np.pi * np.sqrt(m / k) / N


def design_contact_6(mass, speed, depth, restitution, steps_per_contact):
    """Divides the limit of stability, 2 √(m/k), by the number of steps."""
    m, v, d, e, N = arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * v * v / (d * d)
    return k, penalty_damping(e, m, k), 2 * np.sqrt(m / k) / N
