"""A fourth lot of wrong answers, to the functions of the labs on response, friction, polyhedra and sweeping.

Six to each of the 27 functions, each with one mistake, as by third-year students with the slides and the description of
the function. They were written by somebody who had seen none of the 480 entries that the bank had for these functions,
and who wrote down for each which mistake a person would name. 105 of the 162 were named then: 29 of 42 in response, 18
of 36 in friction, 28 of 42 in polyhedra and 30 of 42 in sweeping. Six passed for right on every probe.
"""

from __future__ import annotations

import math

import numpy as np

from solutions.polyhedra import edges_through_faces, orient2d, orient3d, solid_angle
from solutions.response import penalty_damping
from solutions.sweeping import rotated, separation_of_hulls

# ---------------------------------------------------------------- response


def _arr(*values):
    return [np.asarray(value, dtype=float) for value in values]


def _col(value):
    """One number for each vector, to multiply the vectors by."""
    return np.asarray(value, dtype=float)[..., None]


def _bounced(v, n, e):
    """Velocity after a plane at rest; a body on its way out keeps it."""
    towards = np.minimum(np.vecdot(v, n), 0.0)
    return v - _col((1 + e) * towards) * n


def kinematic_response_15(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Forgets the way back: returns the velocity as seen from the racket."""
    v, n, e, w = _arr(velocity, normal, restitution, plane_velocity)
    seen = v - w
    vn = np.vecdot(seen, n)
    return np.where(_col(vn) < 0, seen - _col((1 + e) * vn) * n, v)


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
    v, n, e, w = _arr(velocity, normal, restitution, plane_velocity)
    vn = np.vecdot(v - w, n)
    return v - _col((1 + np.sqrt(e)) * np.minimum(vn, 0)) * n


def kinematic_response_18(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Asks the ball's own velocity, not the relative one, whether it approaches."""
    v, n, w = _arr(velocity, normal, plane_velocity)
    if v @ n >= 0:
        return v
    relative = (v - w) @ n
    return v - (1 + restitution) * relative * n


def kinematic_response_19(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Bounces as off a plane at rest and adds the plane's speed once: −e v + w."""
    v, n, e, w = _arr(velocity, normal, restitution, plane_velocity)
    vn, wn = np.vecdot(v, n), np.vecdot(w, n)
    after = v - _col((1 + e) * vn) * n + _col(wn) * n
    return np.where(_col(vn - wn) < 0, after, v)


def kinematic_response_20(velocity, normal, restitution, plane_velocity=(0, 0, 0)):
    """Mirrors as on the slide and then multiplies the whole vector by e."""
    v, n, e, w = _arr(velocity, normal, restitution, plane_velocity)
    u = v - w
    un = np.sum(u * n, axis=-1, keepdims=True)
    mirrored = u - 2 * un * n
    return np.where(un < 0, w + e[..., None] * mirrored, v)


def respond_at_step_4(position, velocity, acceleration, normal, behind, restitution, dt):
    """The plane takes the whole acceleration, also the pull along a slope."""
    p, v, a, n, e = _arr(position, velocity, acceleration, normal, restitution)
    hits = (np.asarray(behind) & (np.vecdot(v, n) < 0))[..., None]
    v = np.where(hits, _bounced(v, n, e), v)
    a = np.where(hits, 0.0, a)
    v = v + a * _col(dt)
    return p + v * _col(dt), v


def respond_at_step_5(position, velocity, acceleration, normal, behind, restitution, dt):
    """Moves with the velocity from before gravity's change: explicit Euler."""
    p, v, a, n, e = _arr(position, velocity, acceleration, normal, restitution)
    hits = (np.asarray(behind) & (np.vecdot(v, n) < 0))[..., None]
    start = np.where(hits, _bounced(v, n, e), v)
    carried = a - _col(np.minimum(np.vecdot(a, n), 0)) * n
    a = np.where(hits, carried, a)
    return p + start * _col(dt), start + a * _col(dt)


def respond_at_step_6(position, velocity, acceleration, normal, behind, restitution, dt):
    """The plane carries every body that is behind it, also one on its way out."""
    p, v, a, n, e = _arr(position, velocity, acceleration, normal, restitution)
    b = np.asarray(behind)[..., None]
    v = np.where(b, _bounced(v, n, e), v)
    a = np.where(b, a - _col(np.minimum(np.vecdot(a, n), 0)) * n, a)
    v = v + _col(dt) * a
    p = p + _col(dt) * v
    return p, v


def respond_at_step_7(position, velocity, acceleration, normal, behind, restitution, dt):
    """Takes away the acceleration along N also where it lifts the body off."""
    p, v, a, n = _arr(position, velocity, acceleration, normal)
    if behind and v @ n < 0:
        v = v - (1 + restitution) * (v @ n) * n
        a = a - (a @ n) * n
    v = v + a * dt
    p = p + v * dt
    return p, v


def respond_at_step_8(position, velocity, acceleration, normal, behind, restitution, dt):
    """The friend's order: moves first and responds at the end of the step."""
    p, v, a, n, e = _arr(position, velocity, acceleration, normal, restitution)
    v = v + a * _col(dt)
    p = p + v * _col(dt)
    v = np.where(np.asarray(behind)[..., None], _bounced(v, n, e), v)
    return p, v


def respond_at_step_9(position, velocity, acceleration, normal, behind, restitution, dt):
    """Moves along a parabola, p + v dt + a dt²/2, instead of semi-implicitly."""
    p, v, a, n, e = _arr(position, velocity, acceleration, normal, restitution)
    hits = np.logical_and(behind, np.vecdot(v, n) < 0)[..., None]
    v = np.where(hits, _bounced(v, n, e), v)
    pressed = np.minimum(np.vecdot(a, n), 0)
    a = np.where(hits, a - _col(pressed) * n, a)
    t = _col(dt)
    return p + v * t + a * t**2 / 2, v + a * t


def _step(p, v, a, n, behind, e, dt):
    """The step of respond_at_step, as it should be."""
    hits = (behind & (np.vecdot(v, n) < 0))[..., None]
    v = np.where(hits, _bounced(v, n, e), v)
    a = np.where(hits, a - _col(np.minimum(np.vecdot(a, n), 0)) * n, a)
    v = v + a * _col(dt)
    return p + v * _col(dt), v


def _of_one_shape(p, v, a, n, d, e, dt):
    p, v, a, n = np.broadcast_arrays(*_arr(p, v, a, n))
    numbers = np.broadcast_shapes(p.shape[:-1], *(np.shape(x) for x in (d, e, dt)))
    p, v, a, n = (np.broadcast_to(x, (*numbers, 3)) for x in (p, v, a, n))
    return p, v, a, n, *(np.broadcast_to(x, numbers) for x in _arr(d, e, dt))


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
    a, n = _arr(acceleration, normal)
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
        p = p - _col(np.minimum(height, 0.0)) * n
        p, v = _step(p, v, a, n, behind, e, h)
        ps.append(p)
        vs.append(v)
    return np.stack(ps), np.stack(vs)


def _fly(p, v, a, t):
    return p + v * t + a * t * t / 2, v + a * t


def respond_at_impact_5(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Flies for the whole dt after the impact, not for what is left of the step."""
    p, v, a, n, e, T, h = _arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    hits = (h >= T)[..., None]
    at, there = _fly(p, v, a, _col(np.minimum(T, h)))
    after = _fly(at, _bounced(there, n, e), a, _col(h))
    free = _fly(p, v, a, _col(h))
    return np.where(hits, after[0], free[0]), np.where(hits, after[1], free[1])


def respond_at_impact_6(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Turns the velocity of the start around, not the velocity at the impact."""
    p, v, a, n = _arr(position, velocity, acceleration, normal)
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
    p, v, a, n, e, T, h = _arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    t = _col(np.minimum(T, h))
    hits = _col(T) <= _col(h)
    p, v = p + v * t, v + a * t
    v = np.where(hits, _bounced(v, n, e), v)
    left = _col(h) - t
    return p + v * left, v + a * left


def respond_at_impact_8(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Clips T to the step and responds at its end even if the impact comes later."""
    p, v, a, n, e, T, h = _arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    t = np.minimum(T, h)
    p, v = _fly(p, v, a, _col(t))
    v = _bounced(v, n, e)
    return _fly(p, v, a, _col(h - t))


def respond_at_impact_9(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Lets the plane carry the weight after the impact, as the step response does."""
    p, v, a, n, e, T, h = _arr(position, velocity, acceleration, normal, restitution, time_of_impact, dt)
    t = np.minimum(T, h)
    p, v = _fly(p, v, a, _col(t))
    hits = _col(h >= T)
    v = np.where(hits, _bounced(v, n, e), v)
    carried = a - _col(np.minimum(np.vecdot(a, n), 0)) * n
    a = np.where(hits, carried, a)
    return _fly(p, v, a, _col(h - t))


def respond_at_impact_10(position, velocity, acceleration, normal, restitution, time_of_impact, dt):
    """Takes T for a share of the step, 0 to 1."""
    p, v, a, n = _arr(position, velocity, acceleration, normal)
    if time_of_impact > 1:
        return _fly(p, v, a, dt)
    t = time_of_impact * dt
    p, v = _fly(p, v, a, t)
    v = _bounced(v, n, restitution)
    return _fly(p, v, a, dt - t)


def penalty_force_4(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """Wrong sign of the damper: it pushes with the velocity."""
    s, vn, n, k, c = _arr(separation, normal_velocity, normal, stiffness, damping)
    f = np.where(s < 0, -k * s + c * vn, 0.0)
    if not adhesive:
        f = np.maximum(f, 0.0)
    return f[..., None] * n


def penalty_force_5(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """The damper works on the way in alone and takes nothing away on the way out."""
    s, u, n, k, c = _arr(separation, normal_velocity, normal, stiffness, damping)
    damper = -c * u if adhesive else np.maximum(-c * u, 0.0)
    return _col(np.where(s < 0, -k * s + damper, 0.0)) * n


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
    s, vn, n, k, c = _arr(separation, normal_velocity, normal, stiffness, damping)
    depth = np.maximum(-s, 0)
    f = k * depth - c * vn
    if not adhesive:
        f = np.maximum(f, 0)
    return _col(f) * n


def penalty_force_8(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """An adhesive contact pulls a body back also after it has come off."""
    s, vn, n, k, c = _arr(separation, normal_velocity, normal, stiffness, damping)
    f = -k * s - c * vn
    if adhesive:
        return _col(f) * n
    return _col(np.where(s < 0, np.maximum(f, 0), 0)) * n


def penalty_force_9(separation, normal_velocity, normal, stiffness, damping=0.0, adhesive=False):
    """Clamps the components of the force and not its size along the normal."""
    s, vn, n, k, c = _arr(separation, normal_velocity, normal, stiffness, damping)
    inside = (s < 0)[..., None]
    force = (-k * s - c * vn)[..., None] * n
    if not adhesive:
        force = np.maximum(force, 0.0)
    return np.where(inside, force, 0.0)


def penalty_step_limit_3(mass, stiffness, damping=0.0):
    """2 √(m/k): the damper does not matter."""
    m, k, c = _arr(mass, stiffness, damping)
    return 2 * np.sqrt(m / k) + 0 * c


def penalty_step_limit_4(mass, stiffness, damping=0.0):
    """A damper calms, so it makes the step longer: + c in the solution."""
    m, k, c = _arr(mass, stiffness, damping)
    return (c + np.sqrt(c * c + 4 * m * k)) / k


def penalty_step_limit_5(mass, stiffness, damping=0.0):
    """2/ω with the frequency of the damped swing, and no limit if it does not swing."""
    m, k, c = _arr(mass, stiffness, damping)
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
    m, k, c = _arr(mass, stiffness, damping)
    return 8 * m / (c + np.sqrt(c**2 + 16 * k * m))


def penalty_step_limit_8(mass, stiffness, damping=0.0):
    """Subtracts two nearly equal numbers: a strong damper gives rubbish or 0."""
    m, k, c = _arr(mass, stiffness, damping)
    return (np.sqrt(c**2 + 4 * m * k) - c) / k


def design_contact_1(mass, speed, depth, restitution, steps_per_contact):
    """Forgets one of the two halves: m v²/2 = k d²."""
    m, v, d, e, N = _arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * v**2 / (2 * d**2)
    c = penalty_damping(e, m, k)
    return k, c, np.pi * np.sqrt(m / k) / N


def design_contact_2(mass, speed, depth, restitution, steps_per_contact):
    """Takes the depth at which the body would lie at rest: k = m g/d."""
    m, v, d, e, N = _arr(mass, speed, depth, restitution, steps_per_contact)
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
    m, v, d, e, N = _arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * (v / d) ** 2
    loss = -np.log(e)
    zeta = loss / np.sqrt(np.pi**2 + loss**2)
    return k, 2 * zeta * np.sqrt(k * m), np.pi * d / (v * N)


def design_contact_5(mass, speed, depth, restitution, steps_per_contact):
    """Takes a contact for a whole swing, 2π √(m/k)."""
    m, v, d, e, N = _arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * v * v / (d * d)
    return k, penalty_damping(e, m, k), 2 * np.pi * np.sqrt(m / k) / N


def design_contact_6(mass, speed, depth, restitution, steps_per_contact):
    """Divides the limit of stability, 2 √(m/k), by the number of steps."""
    m, v, d, e, N = _arr(mass, speed, depth, restitution, steps_per_contact)
    k = m * v * v / (d * d)
    return k, penalty_damping(e, m, k), 2 * np.sqrt(m / k) / N


# ---------------------------------------------------------------- friction


def support_force_1(mass, gravity, push, frame_acceleration, normal):
    """Wrong sign of the frame: m (g + a) instead of m (g − a)."""
    m, g, F, a, n = _arr(mass, gravity, push, frame_acceleration, normal)
    total = _col(m) * (g + a) + F
    fn = np.vecdot(total, n)
    return np.maximum(0, -fn), total - _col(fn) * n


def support_force_2(mass, gravity, push, frame_acceleration, normal):
    """The floor carries the weight alone: the push does not press the body on."""
    m, g, F, a, n = _arr(mass, gravity, push, frame_acceleration, normal)
    weight = _col(m) * (g - a)
    N = np.maximum(-np.vecdot(weight, n), 0.0)
    total = weight + F
    return N, total - _col(np.vecdot(total, n)) * n


def support_force_3(mass, gravity, push, frame_acceleration, normal):
    """N is the size of the force along the normal, also where it lifts the body off."""
    m, g, F, a, n = _arr(mass, gravity, push, frame_acceleration, normal)
    total = _col(m) * (g - a) + F
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
    m, g, F, a, n = _arr(mass, gravity, push, frame_acceleration, normal)
    total = _col(m) * g + F - a
    fn = np.vecdot(total, n)
    return np.maximum(-fn, 0), total - _col(fn) * n


def support_force_6(mass, gravity, push, frame_acceleration, normal):
    """Along the surface means x and y: z is set to zero, also on a slope."""
    m, g, F, a, n = _arr(mass, gravity, push, frame_acceleration, normal)
    total = m[..., None] * (g - a) + F
    N = np.maximum(0.0, -np.vecdot(total, n))
    return N, total * np.array([1.0, 1.0, 0.0])


def friction_force_8(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """Asks first whether the push can be held, and holds a body that slides, too."""
    P, v, N, ms, mk = _arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    way = np.where(speed > 0, v / np.where(speed > 0, speed, 1), P / np.where(size > 0, size, 1))
    held = (size <= _col(ms * N)) & ((size > 0) | (speed == 0))
    return np.where(held, -P, -_col(mk * N) * way)


def friction_force_9(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """A body at rest is held if each component of the push is within μ_s N: a square."""
    P, v = _arr(push, tangent_velocity)
    speed = math.sqrt(sum(x * x for x in v))
    if speed > 0:
        return -kinetic_friction * normal_force * v / speed
    limit = static_friction * normal_force
    if all(abs(x) <= limit for x in P):
        return -P
    return -kinetic_friction * normal_force * P / math.sqrt(sum(x * x for x in P))


def friction_force_10(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """A body that starts to slide has μ_s N against the push, not μ_k N."""
    P, v, N, ms, mk = _arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    sliding = -_col(mk * N) * v / np.where(speed > 0, speed, 1.0)
    most = _col(ms * N)
    rest = -P * np.minimum(1.0, most / np.where(size > 0, size, 1.0))
    rest = np.where(size <= most, -P, rest)
    return np.where(speed > 0, sliding, rest)


def friction_force_11(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """Takes every speed below 1 cm/s for rest."""
    P, v, N, ms, mk = _arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    moves = speed > 0.01
    way = np.where(moves, v / np.where(moves, speed, 1), P / np.where(size > 0, size, 1))
    holds = ~moves & (size <= _col(ms * N))
    return np.where(holds, -P, -_col(mk * N) * way)


def friction_force_12(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """Friction is a reaction to the push, so a sliding body gets no more than the push."""
    P, v, N, ms, mk = _arr(push, tangent_velocity, normal_force, static_friction, kinetic_friction)
    size = np.linalg.norm(P, axis=-1, keepdims=True)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    kinetic = np.minimum(_col(mk * N), size)
    sliding = -kinetic * v / np.where(speed > 0, speed, 1.0)
    starts = -_col(mk * N) * P / np.where(size > 0, size, 1.0)
    at_rest = np.where(size <= _col(ms * N), -P, starts)
    return np.where(speed > 0, sliding, at_rest)


def friction_force_13(push, tangent_velocity, normal_force, static_friction, kinetic_friction):
    """A body that slides has friction against the push, not against its velocity."""
    P, v = _arr(push, tangent_velocity)
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
        *_arr(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt)
    )


def sliding_motion_4(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """After the stop asks whether μ_k N holds: static friction is forgotten there."""
    p, v, P = _arr(position, tangent_velocity, push)
    again = "kinetic" if v @ v > 0 else "static"
    return _slide(p, v, P, normal_force, static_friction, kinetic_friction, mass, dt, again=again)


def sliding_motion_5(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """The time to stop is v/(μ_k N/m): the push does not count in it."""
    p, v, P, N, ms, mk, m, h = _arr(
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
    a = np.where((moving | breaks)[..., None], (P - _col(mk * N) * way) / _col(m), 0.0)
    first = np.where(stops, t, h)
    p1 = p + v * _col(first) + a * _col(first) ** 2 / 2
    v1 = np.where(stops[..., None], 0.0, v + a * _col(first))
    a2 = np.where((stops & breaks)[..., None], (P - _col(mk * N) * _unit_or_zero(P)) / _col(m), 0.0)
    left = _col(h - first)
    return p1 + v1 * left + a2 * left**2 / 2, v1 + a2 * left, np.where(stops, t, np.inf)


def sliding_motion_6(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """A game's step: moves with the new velocity and sets it to zero if it would turn."""
    p, v, P, N, ms, mk, m, h = _arr(
        position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt
    )
    speed = np.linalg.norm(v, axis=-1)
    size = np.linalg.norm(P, axis=-1)
    way = np.where(_col(speed) > 0, _unit_or_zero(v), _unit_or_zero(P))
    friction = -_col(mk * N) * way
    friction = np.where(_col((speed == 0) & (size <= ms * N)) > 0, -P, friction)
    a = (P + friction) / _col(m)
    new = v + a * _col(h)
    turned = (speed > 0) & (np.vecdot(new, v) <= 0)
    new = np.where(turned[..., None], 0.0, new)
    slowing = np.linalg.norm(a, axis=-1)
    stop = np.where(turned, speed / np.where(slowing > 0, slowing, 1.0), np.inf)
    return p + new * _col(h), new, stop


def sliding_motion_7(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """A body that starts at rest stays at rest, whatever the push is (early return)."""
    p, v, P = _arr(position, tangent_velocity, push)
    return _slide(p, v, P, normal_force, static_friction, kinetic_friction, mass, dt, starts=False)


def sliding_motion_8(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt):
    """After the stop slides back for a whole dt instead of for what is left."""

    def one(p, v, P, N, ms, mk, m, h):
        return _slide(p, v, P, N, ms, mk, m, h, rest_of="whole")

    return np.vectorize(one, signature=_SLIDE)(
        *_arr(position, tangent_velocity, push, normal_force, static_friction, kinetic_friction, mass, dt)
    )


def clamp_to_circle_3(tangent_force, limit):
    """A diamond: the size of a force is the sum of the sizes of its components."""
    f, L = _arr(tangent_force, limit)
    size = np.sum(np.abs(f), axis=-1)
    share = np.where(size > L, L / np.where(size > 0, size, 1.0), 1.0)
    return share[..., None] * f


def clamp_to_circle_4(tangent_force, limit):
    """Stretches small forces to the limit, too: friction is always μ N."""
    f, L = _arr(tangent_force, limit)
    return _col(L) * _unit_or_zero(f)


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
    f, L = _arr(tangent_force, limit)
    return np.where(np.linalg.norm(f, axis=-1, keepdims=True) <= _col(L), f, 0.0)


def clamp_to_circle_7(tangent_force, limit):
    """Measures the force by x and y alone, which is its size on a level floor only."""
    f, L = _arr(tangent_force, limit)
    size = np.hypot(f[..., 0], f[..., 1])
    share = np.minimum(1.0, L / np.maximum(size, 1e-300))
    return share[..., None] * f


def clamp_to_circle_8(tangent_force, limit):
    """Norm of the whole array (no axis): right for one force, wrong for several."""
    f, L = _arr(tangent_force, limit)
    size = np.linalg.norm(f)
    if size == 0:
        return f + 0 * _col(L)
    return np.minimum(1.0, _col(L) / size) * f


def _rolled(v, w, r, impulse, inertia=0.4):
    """Centre and spin after an impulse per mass at the lowest point."""
    turn = np.stack([impulse[..., 1], -impulse[..., 0], np.zeros_like(impulse[..., 0])], axis=-1)
    return v + impulse, w + turn / _col(inertia * r)


def _slip(v, w, r):
    arm = np.zeros(np.broadcast_shapes(v.shape, w.shape, (*np.shape(r), 3)))
    arm[..., 2] = -r
    return v + np.cross(w, arm)


def _at_most(vector, most):
    length = np.linalg.norm(vector, axis=-1)
    share = np.where(length > most, most / np.where(length > 0, length, 1), 1.0)
    return _col(share) * vector


def roll_step_1(velocity, spin, radius, friction, gravity, dt):
    """Wrong sign of the spin in the slip: v − ω × arm."""
    v, w, r, mu, g, h = _arr(velocity, spin, radius, friction, gravity, dt)
    slip = 2 * v - _slip(v, w, r)
    return _rolled(v, w, r, _at_most(-2 / 7 * slip, mu * g * h))


def roll_step_2(velocity, spin, radius, friction, gravity, dt):
    """Wants the impulse that stops a slab, m u, and not two sevenths of it."""
    v, w, r, mu, g, h = _arr(velocity, spin, radius, friction, gravity, dt)
    return _rolled(v, w, r, _at_most(-_slip(v, w, r), mu * g * h))


def roll_step_3(velocity, spin, radius, friction, gravity, dt):
    """Friction acts against the velocity of the centre, as on a slab, until it rolls."""
    v, w = _arr(velocity, spin)
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
    v, w, r, mu, g, h = _arr(velocity, spin, radius, friction, gravity, dt)
    wanted = -0.4 * _slip(v, w, r)
    return _rolled(v, w, r, _at_most(wanted, mu * g * h), 2 / 3)


def roll_step_5(velocity, spin, radius, friction, gravity, dt):
    """Friction is always μ m g: a slip that is smaller is turned round."""
    v, w, r, mu, g, h = _arr(velocity, spin, radius, friction, gravity, dt)
    push = -_col(mu * g * h) * _unit_or_zero(_slip(v, w, r))
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
    F, R, n = np.broadcast_arrays(*_arr(force, rate, normal))
    Fn, Rn = np.vecdot(F, n), np.vecdot(R, n)
    return -Fn, -Rn, F - _col(Fn) * n, R - _col(Rn) * n


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
    F, R, n = _arr(force, force_rate, normal)
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


# --------------------------------------------------------------- polyhedra


def _corners(vertices, faces):
    v = np.asarray(vertices, dtype=float)
    f = np.asarray(faces, dtype=int).reshape(-1, 3)
    return v[f[:, 0]], v[f[:, 1]], v[f[:, 2]]


def _planes(vertices, faces):
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    return n, -np.vecdot(n, a)


def face_planes_1(vertices, faces):
    """Crosses the two sides in the wrong order: the normals point inwards."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(c - a, b - a)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    return n, -np.vecdot(n, a)


def face_planes_2(vertices, faces):
    """Normalises n only after d was worked out with the long one."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    d = -np.vecdot(n, a)
    return n / np.linalg.norm(n, axis=1)[:, None], d


def face_planes_3(vertices, faces):
    """Wrong sign of d: takes the plane for n·p = d."""
    normals, offsets = [], []
    for i, j, k in faces:
        a, b, c = (np.asarray(vertices[x], dtype=float) for x in (i, j, k))
        n = np.cross(b - a, c - a)
        n = n / math.sqrt(n @ n)
        normals.append(n)
        offsets.append(float(n @ a))
    return np.array(normals).reshape(-1, 3), np.array(offsets)


def face_planes_4(vertices, faces):
    """Outwards is away from the middle of the vertices: turns normals that do not point so."""
    v = np.asarray(vertices, dtype=float)
    middle = v.mean(axis=0)
    a, b, c = _corners(v, faces)
    n = np.cross(b - a, c - a)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    outwards = np.vecdot(n, (a + b + c) / 3 - middle)
    n = np.where(outwards[:, None] < 0, -n, n)
    return n, -np.vecdot(n, a)


def face_planes_5(vertices, faces):
    """The offset d is minus the plane's distance from the origin, as if the origin were always inside."""
    n, d = _planes(vertices, faces)
    return n, -np.abs(d)


def face_planes_6(vertices, faces):
    """Divides by the norm of the whole array of normals and not of each one."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    n = n / max(np.linalg.norm(n), 1e-300)
    return n, -np.sum(n * a, axis=1)


def _heights(point, vertices, faces):
    n, d = _planes(vertices, faces)
    return np.asarray(point, dtype=float) @ n.T + d


def convex_separation_1(point, vertices, faces):
    """The face that decides is the one whose plane is nearest, in front or behind."""
    h = _heights(point, vertices, faces)
    face = np.argmin(np.abs(h), axis=-1)
    return np.take_along_axis(h, face[..., None], axis=-1)[..., 0], face


def convex_separation_2(point, vertices, faces):
    """A point outside does not touch, so its separation is 0."""
    h = _heights(point, vertices, faces)
    return np.minimum(h.max(axis=-1), 0.0), h.argmax(axis=-1)


def convex_separation_3(point, vertices, faces):
    """Outside, takes the distance to the nearest corner for the separation."""
    v = np.asarray(vertices, dtype=float)
    h = _heights(point, vertices, faces)
    s, face = h.max(axis=-1), h.argmax(axis=-1)
    used = np.unique(np.asarray(faces))
    p = np.asarray(point, dtype=float)
    away = np.linalg.norm(p[..., None, :] - v[used], axis=-1).min(axis=-1)
    return np.where(s > 0, away, s), face


def convex_separation_4(point, vertices, faces):
    """The face that decides is the one whose middle is nearest to the point."""
    p = np.asarray(point, dtype=float)
    middles = np.asarray(vertices, dtype=float)[np.asarray(faces)].mean(axis=1)
    h = _heights(point, vertices, faces)
    face = np.linalg.norm(p[..., None, :] - middles, axis=-1).argmin(axis=-1)
    return np.take_along_axis(h, face[..., None], axis=-1)[..., 0], face


def convex_separation_5(point, vertices, faces):
    """Of equal faces takes the last one: ≥ instead of >."""
    best, deciding = -math.inf, -1
    for number, (i, j, k) in enumerate(faces):
        a, b, c = (np.asarray(vertices[x], dtype=float) for x in (i, j, k))
        n = np.cross(b - a, c - a)
        height = np.dot(n, np.asarray(point) - a) / np.linalg.norm(n)
        if height >= best:
            best, deciding = height, number
    return best, deciding


def convex_separation_6(point, vertices, faces):
    """Forgets to give the normals unit length: heights are multiplied by twice the area."""
    a, b, c = _corners(vertices, faces)
    n = np.cross(b - a, c - a)
    p = np.asarray(point, dtype=float)[..., None, :]
    h = np.sum((p - a) * n, axis=-1)
    return np.max(h, axis=-1), np.argmax(h, axis=-1)


def _plane_share(start, end, triangle):
    """Share of the way to the plane, normal (not unit) and the corners."""
    p, q, tri = _arr(start, end, triangle)
    a, b, c = tri[..., 0, :], tri[..., 1, :], tri[..., 2, :]
    n = np.cross(b - a, c - a)
    s0, s1 = np.vecdot(p - a, n), np.vecdot(q - a, n)
    crosses = s0 != s1
    t = np.where(crosses, s0 / np.where(crosses, s0 - s1, 1.0), np.inf)
    x = p + np.where(crosses, t, 0.0)[..., None] * (q - p)
    return t, x, n, (a, b, c), (s0, s1)


def _weights(x, n, a, b, c):
    area = np.vecdot(n, n)
    parts = [
        np.vecdot(np.cross(c - b, x - b), n),
        np.vecdot(np.cross(a - c, x - c), n),
        np.vecdot(np.cross(b - a, x - a), n),
    ]
    return np.stack(parts, axis=-1) / area[..., None]


def _answer(hit, t, w):
    return np.where(hit, t, np.inf), np.where(np.asarray(hit)[..., None], w, np.nan)


def segment_triangle_1(start, end, triangle):
    """Takes the segment for a ray: does not ask whether t is at most 1."""
    t, x, n, (a, b, c), _ = _plane_share(start, end, triangle)
    w = _weights(x, n, a, b, c)
    return _answer((t >= 0) & np.isfinite(t) & np.all(w >= 0, axis=-1), t, w)


def segment_triangle_2(start, end, triangle):
    """Areas without a sign: every place in the plane is on the triangle."""
    t, x, _, (a, b, c), _ = _plane_share(start, end, triangle)
    parts = np.stack(
        [
            np.linalg.norm(np.cross(b - x, c - x), axis=-1),
            np.linalg.norm(np.cross(c - x, a - x), axis=-1),
            np.linalg.norm(np.cross(a - x, b - x), axis=-1),
        ],
        axis=-1,
    )
    w = parts / parts.sum(axis=-1, keepdims=True)
    return _answer((t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1), t, w)


def segment_triangle_3(start, end, triangle):
    """Meets the triangle from its front alone."""
    t, x, n, (a, b, c), (s0, s1) = _plane_share(start, end, triangle)
    w = _weights(x, n, a, b, c)
    return _answer((s0 > 0) & (s1 < 0) & np.all(w >= 0, axis=-1), t, w)


def segment_triangle_4(start, end, triangle):
    """Gives each weight to the next corner, not to the corner opposite to its area."""
    p, q = (np.asarray(x, dtype=float) for x in (start, end))
    a, b, c = (np.asarray(x, dtype=float) for x in triangle)
    nothing = math.inf, np.full(3, np.nan)
    n = np.cross(b - a, c - a)
    if n @ (q - p) == 0:
        return nothing
    t = n @ (a - p) / (n @ (q - p))
    if not 0 <= t <= 1:
        return nothing
    x = p + t * (q - p)
    w_a = np.cross(b - a, x - a) @ n / (n @ n)
    w_b = np.cross(c - b, x - b) @ n / (n @ n)
    w_c = np.cross(a - c, x - c) @ n / (n @ n)
    if min(w_a, w_b, w_c) < 0:
        return nothing
    return t, np.array([w_a, w_b, w_c])


def segment_triangle_5(start, end, triangle):
    """Returns the way to the meeting point in metres and not the share."""
    t, x, n, (a, b, c), _ = _plane_share(start, end, triangle)
    w = _weights(x, n, a, b, c)
    p, q = _arr(start, end)
    hit = (t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1)
    length = np.linalg.norm(q - p, axis=-1)
    return _answer(hit, np.where(hit, t, 0.0) * length, w)


def segment_triangle_6(start, end, triangle):
    """Finds the weights from above, by x and y: an upright triangle is never met."""
    t, x, _, (a, b, c), _ = _plane_share(start, end, triangle)

    def area(u, v, w):
        return (v[..., 0] - u[..., 0]) * (w[..., 1] - u[..., 1]) - (v[..., 1] - u[..., 1]) * (w[..., 0] - u[..., 0])

    whole = area(a, b, c)
    seen = whole != 0
    parts = np.stack([area(x, b, c), area(x, c, a), area(x, a, b)], axis=-1)
    w = parts / np.where(seen, whole, 1.0)[..., None]
    return _answer(seen & (t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1), t, w)


def side_of_line_1(a, b, c):
    """The sign of the other order, (c − a) × (b − a): right is +1."""
    a, b, c = _arr(a, b, c)
    u, v = b - a, c - a
    return np.sign(v[..., 0] * u[..., 1] - v[..., 1] * u[..., 0]).astype(int)


def side_of_line_2(a, b, c):
    """Left means above the line: compares heights and forgets which way the line runs."""
    ax, ay, bx, by = float(a[0]), float(a[1]), float(b[0]), float(b[1])
    cx, cy = float(c[0]), float(c[1])
    if bx == ax:
        if by == ay:
            return 0
        return int(np.sign(ax - cx) * np.sign(by - ay))
    slope = (by - ay) / (bx - ax)
    return int(np.sign((cy - ay) - slope * (cx - ax)))


def side_of_line_3(a, b, c):
    """Takes every point whose determinant is below 1e-9 for a point on the line."""
    a, b, c = _arr(a, b, c)
    D = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (c[..., 0] - a[..., 0])
    return np.where(np.abs(D) < 1e-9, 0, np.sign(D)).astype(int)


def side_of_line_4(a, b, c):
    """The wrong one of two products: the dot product says ahead or behind."""
    a, b, c = _arr(a, b, c)
    return np.sign(np.sum((b - a) * (c - a), axis=-1)).astype(int)


def side_of_line_5(a, b, c):
    """Forgets to subtract a from c: compares the way b − a with the place c."""
    a, b, c = _arr(a, b, c)
    u = b - a
    return np.sign(u[..., 0] * c[..., 1] - u[..., 1] * c[..., 0]).astype(int)


def side_of_line_6(a, b, c):
    """Two sides and no line: a point on the line counts as right of it."""
    a, b, c = _arr(a, b, c)
    u, v = b - a, c - a
    left = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0] > 0
    return np.where(left, 1, -1)


def _parity(point, vertices, faces, moves=2, above=True):
    """Parity along +z with the moved point; `moves` tells how many powers of ε count."""
    p = np.asarray(point, dtype=float)[..., None, :]
    corners = _corners(vertices, faces)
    turns = []
    for i in range(3):
        a, b = corners[i], corners[(i + 1) % 3]
        turn = orient2d(a[:, :2], b[:, :2], p[..., :2])
        for k, factor in enumerate((a[:, 1] - b[:, 1], b[:, 0] - a[:, 0])):
            if k < moves:
                turn = np.where(turn == 0, np.sign(factor).astype(int), turn)
        turns.append(turn)
    up = np.all(np.stack(turns) > 0, axis=0)
    down = np.all(np.stack(turns) < 0, axis=0)
    turn = up.astype(int) - down.astype(int)
    side = orient3d(*corners, p)
    for i, j in ((1, 2), (2, 0), (0, 1)):
        tilt = orient2d(*(c[:, [i, j]] for c in corners))
        side = np.where(side == 0, tilt, side)
    crossed = turn != 0
    if above:
        crossed = crossed & (side == -turn)
    return crossed.sum(axis=-1) % 2 == 1


def inside_by_parity_1(point, vertices, faces):
    """The slide's test for convex solids: inside is behind the planes of all faces."""
    return np.all(_heights(point, vertices, faces) < 0, axis=-1)


def _met(start, end, vertices, faces):
    corners = np.asarray(vertices, dtype=float)[np.asarray(faces)]
    t, x, n, (a, b, c), _ = _plane_share(start[..., None, :], end[..., None, :], corners)
    with np.errstate(all="ignore"):
        w = _weights(x, n, a, b, c)
    return (t >= 0) & (t <= 1) & np.all(w >= 0, axis=-1)


def inside_by_parity_2(point, vertices, faces):
    """Counts the faces that a segment straight up meets; an edge counts for both faces."""
    p = np.asarray(point, dtype=float)
    up = np.array([0.0, 0.0, 1e4])
    return _met(p, p + up, vertices, faces).sum(axis=-1) % 2 == 1


def inside_by_parity_3(point, vertices, faces):
    """Walks 10 m in a slanted direction and takes that for far away."""
    p = np.asarray(point, dtype=float)
    way = np.array([0.3713, 0.5279, 0.7639])
    way = 10.0 * way / np.linalg.norm(way)
    return _met(p, p + way, vertices, faces).sum(axis=-1) % 2 == 1


def inside_by_parity_4(point, vertices, faces):
    """Does not ask whether a face is above or below: counts along the whole line."""
    return _parity(point, vertices, faces, above=False)


def inside_by_parity_5(point, vertices, faces):
    """Inside as soon as there is a face both above and below, odd or not."""
    p = np.asarray(point, dtype=float)
    way = np.array([1.13e-3, 1.71e-3, 1.0]) * 1e4
    above = _met(p, p + way, vertices, faces).any(axis=-1)
    below = _met(p, p - way, vertices, faces).any(axis=-1)
    return above & below


def inside_by_parity_6(point, vertices, faces):
    """Moves the point along x alone, by ε: edges parallel to x are still hit."""
    return _parity(point, vertices, faces, moves=1)


def _solid_angles(point, vertices, faces):
    p = np.asarray(point, dtype=float)[..., None, :]
    f = np.asarray(faces, dtype=int).reshape(-1, 3)
    return solid_angle(p, np.asarray(vertices, dtype=float)[f])


def winding_number_1(point, vertices, faces):
    """Wrong sign: −1 inside faces that look outwards."""
    return -np.sum(_solid_angles(point, vertices, faces), axis=-1) / (4 * np.pi)


def winding_number_2(point, vertices, faces):
    """A number of turns is whole: rounds it, also for a surface with holes."""
    w = np.sum(_solid_angles(point, vertices, faces), axis=-1) / (4 * np.pi)
    return np.round(w)


def winding_number_3(point, vertices, faces):
    """Adds sizes: a front that is seen counts like a back."""
    return np.abs(_solid_angles(point, vertices, faces)).sum(axis=-1) / (4 * np.pi)


def winding_number_4(point, vertices, faces):
    """Divides by 2π, as for a curve in the plane."""
    total = 0.0
    for i, j, k in faces:
        total = total + solid_angle(point, [vertices[i], vertices[j], vertices[k]])
    return total / (2 * np.pi)


def winding_number_5(point, vertices, faces):
    """A number of turns cannot be negative: takes the size of the sum."""
    return np.abs(np.sum(_solid_angles(point, vertices, faces), axis=-1)) / (4 * np.pi)


def winding_number_6(point, vertices, faces):
    """Takes area times cosine over distance squared for a face's solid angle, near or far."""
    p = np.asarray(point, dtype=float)[..., None, :]
    a, b, c = _corners(vertices, faces)
    area = np.cross(b - a, c - a) / 2
    way = (a + b + c) / 3 - p
    distance = np.linalg.norm(way, axis=-1)
    angle = np.vecdot(way, area) / np.where(distance > 0, distance, np.inf) ** 3
    return np.sum(angle, axis=-1) / (4 * np.pi)


def _used(vertices, faces):
    f = np.asarray(faces, dtype=int).reshape(-1, 3)
    return np.asarray(vertices, dtype=float)[np.unique(f)]


def _edges_meet(vertices_a, faces_a, vertices_b, faces_b):
    there = edges_through_faces(vertices_a, faces_a, vertices_b, faces_b)[1]
    back = edges_through_faces(vertices_b, faces_b, vertices_a, faces_a)[1]
    return len(there) > 0 or len(back) > 0


def polyhedra_intersect_1(vertices_a, faces_a, vertices_b, faces_b):
    """Tests the corners of each solid against the other and no edges."""
    if not len(faces_a) or not len(faces_b):
        return False
    ours = _parity(_used(vertices_a, faces_a), vertices_b, faces_b)
    theirs = _parity(_used(vertices_b, faces_b), vertices_a, faces_a)
    return bool(ours.any() or theirs.any())


def polyhedra_intersect_2(vertices_a, faces_a, vertices_b, faces_b):
    """Tests edges against faces only: a stone in a plum is not noticed."""
    return _edges_meet(vertices_a, faces_a, vertices_b, faces_b)


def polyhedra_intersect_3(vertices_a, faces_a, vertices_b, faces_b):
    """Looks only from A: edges of A through faces of B, and corners of A in B."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    edges, _ = edges_through_faces(vertices_a, faces_a, vertices_b, faces_b)
    if len(edges):
        return True
    return bool(_parity(_used(vertices_a, faces_a), vertices_b, faces_b).any())


def polyhedra_intersect_4(vertices_a, faces_a, vertices_b, faces_b):
    """Two solids meet if their boxes along the axes overlap."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    a, b = _used(vertices_a, faces_a), _used(vertices_b, faces_b)
    low, high = np.maximum(a.min(axis=0), b.min(axis=0)), np.minimum(a.max(axis=0), b.max(axis=0))
    return bool(np.all(low <= high))


def polyhedra_intersect_5(vertices_a, faces_a, vertices_b, faces_b):
    """Tests one corner of each for lying within: a solid of two parts may hide the other."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    if _edges_meet(vertices_a, faces_a, vertices_b, faces_b):
        return True
    first_a = np.asarray(vertices_a, dtype=float)[faces_a[0][0]]
    first_b = np.asarray(vertices_b, dtype=float)[faces_b[0][0]]
    return bool(_parity(first_a, vertices_b, faces_b) or _parity(first_b, vertices_a, faces_a))


def polyhedra_intersect_6(vertices_a, faces_a, vertices_b, faces_b):
    """Within means within the box around the other: a solid in a hollow counts as inside."""
    if len(faces_a) == 0 or len(faces_b) == 0:
        return False
    if _edges_meet(vertices_a, faces_a, vertices_b, faces_b):
        return True
    a, b = _used(vertices_a, faces_a), _used(vertices_b, faces_b)

    def within(these, those):
        low, high = those.min(axis=0), those.max(axis=0)
        return bool(np.all((these >= low) & (these <= high)))

    return within(a, b) or within(b, a)


# ---------------------------------------------------------------- sweeping


def _over(top, bottom, otherwise):
    """A quotient, and something else where the divisor is 0."""
    good = bottom != 0
    return np.where(good, top / np.where(good, bottom, 1.0), otherwise)


def ray_sphere_1(origin, direction, radius):
    """Takes the direction for a unit vector: t = −b − √(b² − c), without u·u."""
    o, u, r = _arr(origin, direction, radius)
    b = np.vecdot(o, u)
    c = np.vecdot(o, o) - r**2
    root = b**2 - c
    t = -b - np.sqrt(np.maximum(root, 0.0))
    hit = (root >= 0) & (t >= 0) & (np.vecdot(u, u) > 0)
    return np.where(c <= 0, 0.0, np.where(hit, t, np.inf))


def ray_sphere_2(origin, direction, radius):
    """From within returns where the ray comes out: the first root that is not negative."""
    o, u = _arr(origin, direction)
    a, b, c = u @ u, o @ u, o @ o - radius**2
    if a == 0:
        return 0.0 if c <= 0 else math.inf
    D = b * b - a * c
    if D < 0:
        return math.inf
    for t in ((-b - math.sqrt(D)) / a, (-b + math.sqrt(D)) / a):
        if t >= 0:
            return t
    return math.inf


def ray_sphere_3(origin, direction, radius):
    """Does not ask whether t is in the future: spheres behind the ray are hit at t < 0."""
    o, u, r = _arr(origin, direction, radius)
    a, b = np.vecdot(u, u), np.vecdot(o, u)
    c = np.vecdot(o, o) - r * r
    D = b * b - a * c
    t = _over(-b - np.sqrt(np.maximum(D, 0)), a, np.inf)
    return np.where(c <= 0, 0.0, np.where(D >= 0, t, np.inf))


def ray_sphere_4(origin, direction, radius):
    """Normalises the direction and returns metres instead of t."""
    o, u, r = _arr(origin, direction, radius)
    length = np.linalg.norm(u, axis=-1)
    u = u / np.where(length > 0, length, 1.0)[..., None]
    b, c = np.vecdot(o, u), np.vecdot(o, o) - r**2
    D = b**2 - c
    hit = (length > 0) & (D >= 0) & (b < 0)
    t = np.where(hit, -b - np.sqrt(np.maximum(D, 0)), np.inf)
    return np.where(c <= 0, 0.0, t)


def ray_sphere_5(origin, direction, radius):
    """Returns when the ray is nearest to the centre, not when it meets the sphere."""
    o, u, r = _arr(origin, direction, radius)
    a, b = np.vecdot(u, u), np.vecdot(o, u)
    t = np.maximum(_over(-b, a, 0.0), 0.0)
    near = o + t[..., None] * u
    t = np.where(np.vecdot(near, near) <= r * r, t, np.inf)
    return np.where(np.vecdot(o, o) <= r * r, 0.0, t)


def ray_sphere_6(origin, direction, radius):
    """Early return: a ray that moves away from the centre misses, also from within."""
    o, u = _arr(origin, direction)
    b = o @ u
    if b >= 0:
        return math.inf
    a, c = u @ u, o @ o - radius**2
    if c <= 0:
        return 0.0
    D = b * b - a * c
    return math.inf if D < 0 else (-b - math.sqrt(D)) / a


def _first_touch(o, u, r):
    """ray_sphere, as it should be."""
    a, b = np.vecdot(u, u), np.vecdot(o, u)
    c = np.vecdot(o, o) - r * r
    D = b * b - a * c
    hit = (b < 0) & (D >= 0)
    root = np.sqrt(np.maximum(D, 0))
    t = np.where(hit, c / np.where(hit, root - b, 1.0), np.inf)
    return np.where(c <= 0, 0.0, t)


def sweep_sphere_sphere_1(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Place of A from B, but velocity of B from A: approach and parting are swapped."""
    pa, va, ra, pb, vb, rb, h = _arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    t = _first_touch(pa - pb, vb - va, ra + rb)
    return np.where(t <= h, t, np.inf)


def sweep_sphere_sphere_2(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Forgets the end of the step: reports a touch that comes later than dt."""
    pa, va, ra, pb, vb, rb = _arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b)
    return _first_touch(pa - pb, va - vb, ra + rb) + 0 * np.where(np.isinf(dt), 0.0, dt)


def sweep_sphere_sphere_3(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Balls that overlap and part do not collide: infinity instead of 0."""
    d = [x - y for x, y in zip(position_a, position_b, strict=True)]
    u = [x - y for x, y in zip(velocity_a, velocity_b, strict=True)]
    r = radius_a + radius_b
    b = sum(x * y for x, y in zip(d, u, strict=True))
    if b >= 0:
        return math.inf
    a = sum(x * x for x in u)
    c = sum(x * x for x in d) - r * r
    if c <= 0:
        return 0.0
    D = b * b - a * c
    if D < 0:
        return math.inf
    t = (-b - math.sqrt(D)) / a
    return t if t <= dt else math.inf


def sweep_sphere_sphere_4(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Looks only at balls that overlap at the end of the step; those passed through are missed."""
    pa, va, ra, pb, vb, rb, h = _arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    d, u, r = pa - pb, va - vb, ra + rb
    t = _first_touch(d, u, r)
    long = np.where(np.isfinite(h), h, 0.0)
    end = d + u * long[..., None]
    ends_in = (np.linalg.norm(end, axis=-1) <= r) | ~np.isfinite(h)
    return np.where((t == 0) | ((t <= h) & ends_in), t, np.inf)


def sweep_sphere_sphere_5(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Squares the radii one by one: r_A² + r_B² instead of (r_A + r_B)²."""
    pa, va, ra, pb, vb, rb, h = _arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    t = _first_touch(pa - pb, va - vb, np.sqrt(ra**2 + rb**2))
    return np.where(t <= h, t, np.inf)


def sweep_sphere_sphere_6(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt):
    """Lets A fly against a B that rests: B's velocity is not used."""
    pa, va, ra, pb, vb, rb, h = _arr(position_a, velocity_a, radius_a, position_b, velocity_b, radius_b, dt)
    t = _first_touch(pa - pb, va + 0 * vb, ra + rb)
    return np.where(t <= h, t, np.inf)


def missed_share_1(speed, radius_a, radius_b, dt):
    """All collisions are head-on: 1 − 2 (r_A + r_B)/(v dt), or 0."""
    v, ra, rb, h = _arr(speed, radius_a, radius_b, dt)
    way = v * h
    return np.maximum(1 - 2 * (ra + rb) / np.where(way > 0, way, 1.0), 0) * (way > 0)


def missed_share_2(speed, radius_a, radius_b, dt):
    """A step shorter than the diameter misses nothing: leaves grazing balls out."""
    way = speed * dt
    diameter = 2 * (radius_a + radius_b)
    if way <= diameter:
        return 0.0
    return 1 - 2 / 3 * diameter / way


def missed_share_3(speed, radius_a, radius_b, dt):
    """Offsets as in the plane: every distance from the middle is equally frequent."""
    v, ra, rb, h = _arr(speed, radius_a, radius_b, dt)
    way = v * h
    k = 2 * (ra + rb) / np.where(way > 0, way, 1.0)
    x = np.sqrt(np.maximum(1 - 1 / np.maximum(k, 1.0) ** 2, 0.0))
    area = (np.arccos(x) - x * np.sqrt(1 - x * x)) / 2
    return np.where(way > 0, (1 - x) - k * area, 0.0)


def missed_share_4(speed, radius_a, radius_b, dt):
    """Takes the mean chord for every chord: 1 − 4 R/(3 v dt), or 0 if that is negative."""
    v, ra, rb, h = _arr(speed, radius_a, radius_b, dt)
    way = v * h
    mean = 4 / 3 * (ra + rb)
    share = 1 - mean / np.where(way > 0, way, 1.0)
    return np.where(way > 0, np.clip(share, 0.0, 1.0), 0.0)


def _missed(k):
    return np.where(k <= 1, 1 - 2 * k / 3, 1 / (3 * np.maximum(k, 1.0) ** 2))


def missed_share_5(speed, radius_a, radius_b, dt):
    """Takes the sum of the radii for the way through the middle, not twice of it."""
    v, ra, rb, h = _arr(speed, radius_a, radius_b, dt)
    way = v * h
    k = (ra + rb) / np.where(way > 0, way, 1.0)
    return np.where(way > 0, _missed(k), 0.0)


def missed_share_6(speed, radius_a, radius_b, dt):
    """Returns the share that is noticed."""
    v, ra, rb, h = _arr(speed, radius_a, radius_b, dt)
    way = v * h
    k = 2 * (ra + rb) / np.where(way > 0, way, 1.0)
    return np.where(way > 0, 1 - _missed(k), 1.0)


def _slabs(o, u, h):
    """When each slab is entered and left, and which axes the ray does not move along."""
    still = u == 0
    safe = np.where(still, 1.0, u)
    one, other = (-h - o) / safe, (h - o) / safe
    first, last = np.minimum(one, other), np.maximum(one, other)
    within = np.abs(o) <= h
    first = np.where(still, np.where(within, -np.inf, np.inf), first)
    last = np.where(still, np.where(within, np.inf, -np.inf), last)
    return first, last


def ray_box_1(origin, direction, half_extents):
    """Leaves an axis out along which the ray does not move, without asking where it is."""
    o, u, h = (list(map(float, x)) for x in (origin, direction, half_extents))
    entry, leave = 0.0, math.inf
    for i in range(3):
        if u[i] == 0:
            continue
        one, other = (-h[i] - o[i]) / u[i], (h[i] - o[i]) / u[i]
        entry = max(entry, min(one, other))
        leave = min(leave, max(one, other))
    if entry > leave:
        return math.inf, -math.inf
    return entry, leave


def ray_box_2(origin, direction, half_extents):
    """Enters by −h and leaves by +h, whichever way the ray goes."""
    o, u, h = np.broadcast_arrays(*_arr(origin, direction, half_extents))
    still = u == 0
    safe = np.where(still, 1.0, u)
    within = np.abs(o) <= h
    first = np.where(still, np.where(within, -np.inf, np.inf), (-h - o) / safe)
    last = np.where(still, np.where(within, np.inf, -np.inf), (h - o) / safe)
    entry, leave = np.maximum(first.max(axis=-1), 0.0), last.min(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_3(origin, direction, half_extents):
    """Lets the ray run backwards: entry may be negative, and boxes behind it are hit."""
    o, u, h = np.broadcast_arrays(*_arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h)
    entry, leave = first.max(axis=-1), last.min(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_4(origin, direction, half_extents):
    """Min and max swapped: in the box as long as the ray is in any one slab."""
    o, u, h = np.broadcast_arrays(*_arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h)
    entry = np.maximum(first.min(axis=-1), 0.0)
    leave = last.max(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_5(origin, direction, half_extents):
    """Takes the half extents for whole edges and halves them again."""
    o, u, h = np.broadcast_arrays(*_arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h / 2)
    entry, leave = np.maximum(first.max(axis=-1), 0.0), last.min(axis=-1)
    miss = entry > leave
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def ray_box_6(origin, direction, half_extents):
    """The box is open: grazing, gliding along a face and a box of thickness 0 are misses."""
    o, u, h = np.broadcast_arrays(*_arr(origin, direction, half_extents))
    first, last = _slabs(o, u, h)
    outside = np.any((u == 0) & (np.abs(o) >= h), axis=-1)
    entry, leave = np.maximum(first.max(axis=-1), 0.0), last.min(axis=-1)
    miss = outside | (entry >= leave)
    return np.where(miss, np.inf, entry), np.where(miss, -np.inf, leave)


def _to_segment(x, a, b):
    """Distance of a place from a segment."""
    s = b - a
    length = np.vecdot(s, s)
    share = np.clip(_over(np.vecdot(x - a, s), length, 0.0), 0, 1)
    return np.linalg.norm(x - a - share[..., None] * s, axis=-1)


def _cylinder(o, u, a, b, r):
    """Both times at which the ray is on the endless cylinder around a b, or NaN."""
    s = b - a
    length = np.vecdot(s, s)
    across_u = u - _over(np.vecdot(u, s), length, 0.0)[..., None] * s
    d = o - a
    across_d = d - _over(np.vecdot(d, s), length, 0.0)[..., None] * s
    A = np.vecdot(across_u, across_u)
    B = np.vecdot(across_u, across_d)
    C = np.vecdot(across_d, across_d) - r * r
    D = B * B - A * C
    good = (1e-24 * np.vecdot(u, u) < A) & (D >= 0) & (length > 0)
    root = np.sqrt(np.where(good, D, 0.0))
    first = np.where(good, _over(-B - root, A, np.nan), np.nan)
    last = np.where(good, _over(-B + root, A, np.nan), np.nan)
    return first, last


def _side_hit(o, u, a, b, r):
    """First t ≥ 0 on the side of the cylinder between its ends."""
    t, _ = _cylinder(o, u, a, b, r)
    s = b - a
    x = o + np.where(np.isfinite(t), t, 0.0)[..., None] * u
    along = _over(np.vecdot(x - a, s), np.vecdot(s, s), -1.0)
    return np.where(np.isfinite(t) & (t >= 0) & (along >= 0) & (along <= 1), t, np.inf)


def ray_capsule_1(origin, direction, start, end, radius):
    """A cylinder without the half balls: what comes in beyond the ends misses."""
    o, u, a, b, r = _arr(origin, direction, start, end, radius)
    side = _side_hit(o, u, a, b, r)
    return np.where(_to_segment(o, a, b) <= r, 0.0, side)


def ray_capsule_2(origin, direction, start, end, radius):
    """Takes the segment for an endless line: the cylinder does not end."""
    o, u, a, b, r = _arr(origin, direction, start, end, radius)
    s = b - a
    length = np.vecdot(s, s)
    d = o - a
    across = d - _over(np.vecdot(d, s), length, 0.0)[..., None] * s
    t, _ = _cylinder(o, u, a, b, r)
    t = np.where(np.isfinite(t) & (t >= 0), t, np.inf)
    t = np.where(length > 0, t, _first_touch(d, u, r))
    return np.where(np.linalg.norm(across, axis=-1) <= r, 0.0, t)


def ray_capsule_3(origin, direction, start, end, radius):
    """Tests the two balls at the ends and forgets the cylinder between them."""
    o, u, a, b, r = _arr(origin, direction, start, end, radius)
    return np.minimum(_first_touch(o - a, u, r), _first_touch(o - b, u, r))


def ray_capsule_4(origin, direction, start, end, radius):
    """Early return for a ray along the segment: a cylinder's side is never met by it."""
    o, u, a, b, r = _arr(origin, direction, start, end, radius)
    if _to_segment(o, a, b) <= r:
        return 0.0
    s = b - a
    if np.any(s) and np.linalg.norm(np.cross(u, s)) <= 1e-12 * np.linalg.norm(u) * np.linalg.norm(s):
        return math.inf
    return min(float(_side_hit(o, u, a, b, r)), float(_first_touch(o - a, u, r)), float(_first_touch(o - b, u, r)))


def ray_capsule_5(origin, direction, start, end, radius):
    """From within returns where the ray leaves the cylinder or a ball."""
    o, u, a, b, r = _arr(origin, direction, start, end, radius)
    hit = np.minimum(_side_hit(o, u, a, b, r), np.minimum(_first_touch(o - a, u, r), _first_touch(o - b, u, r)))
    _, leaves = _cylinder(o, u, a, b, r)
    within = _to_segment(o, a, b) <= r
    for centre in (a, b):
        d = o - centre
        A, B = np.vecdot(u, u), np.vecdot(d, u)
        D = np.maximum(B * B - A * (np.vecdot(d, d) - r * r), 0.0)
        ball = _over(-B + np.sqrt(D), A, 0.0)
        leaves = np.where(np.isfinite(leaves), leaves, ball)
    return np.where(within, np.maximum(leaves, 0.0), hit)


def ray_capsule_6(origin, direction, start, end, radius):
    """Prolongs the segment by r at both ends and takes the flat cylinder for the capsule."""
    o, u, a, b, r = np.broadcast_arrays(*_arr(origin, direction, start, end), _col(radius))
    r = r[..., 0]
    s = b - a
    length = np.linalg.norm(s, axis=-1)
    axis = np.where((length > 0)[..., None], s / np.where(length > 0, length, 1.0)[..., None], [0.0, 0.0, 1.0])
    a, b = a - r[..., None] * axis, b + r[..., None] * axis
    half = np.vecdot(b - a, axis) / 2
    d = o - (a + b) / 2
    z, w = np.vecdot(d, axis), np.vecdot(u, axis)
    across, sideways = d - z[..., None] * axis, u - w[..., None] * axis
    A, B = np.vecdot(sideways, sideways), np.vecdot(across, sideways)
    C = np.vecdot(across, across) - r * r
    D = B * B - A * C
    root = np.sqrt(np.maximum(D, 0))
    steep = A > 0
    first = np.where(steep, _over(-B - root, A, 0.0), np.where(C <= 0, -np.inf, np.inf))
    last = np.where(steep, _over(-B + root, A, 0.0), np.where(C <= 0, np.inf, -np.inf))
    bad = steep & (D < 0)
    moving = w != 0
    one, other = _over(-half - z, w, -np.inf), _over(half - z, w, np.inf)
    low = np.where(moving, np.minimum(one, other), np.where(np.abs(z) <= half, -np.inf, np.inf))
    high = np.where(moving, np.maximum(one, other), np.where(np.abs(z) <= half, np.inf, -np.inf))
    enter = np.maximum(np.maximum(first, low), 0.0)
    return np.where(bad | (enter > np.minimum(last, high)), np.inf, enter)


def motion_bound_1(velocity, angular_velocity, reach, normal):
    """Takes |v·n|: a bound is never negative, so moving away counts like approaching."""
    v, w, r, n = _arr(velocity, angular_velocity, reach, normal)
    return np.abs(np.vecdot(v, n)) + np.linalg.norm(np.cross(w, n), axis=-1) * r


def motion_bound_2(velocity, angular_velocity, reach, normal):
    """All of the spin counts, |ω| r, also the part that turns about n itself."""
    v, w, r, n = _arr(velocity, angular_velocity, reach, normal)
    return np.vecdot(v, n) + np.linalg.norm(w, axis=-1) * r


def motion_bound_3(velocity, angular_velocity, reach, normal):
    """The wrong one of two products: |ω·n| r, the part of the spin that does not count."""
    v, w, r, n = _arr(velocity, angular_velocity, reach, normal)
    return np.vecdot(v, n) + np.abs(np.vecdot(w, n)) * r


def motion_bound_4(velocity, angular_velocity, reach, normal):
    """Takes the whole speed of the centre, |v|, instead of its component along n."""
    speed = math.sqrt(sum(x * x for x in velocity))
    turning = np.cross(angular_velocity, normal)
    return speed + reach * math.sqrt(sum(x * x for x in turning))


def motion_bound_5(velocity, angular_velocity, reach, normal):
    """Looks at the farthest point along n, v + ω × (r n): it does not move along n at all."""
    v, w, r, n = _arr(velocity, angular_velocity, reach, normal)
    point = v + np.cross(w, r[..., None] * n)
    return np.vecdot(point, n)


def motion_bound_6(velocity, angular_velocity, reach, normal):
    """Forgets the arm: adds |ω × n| without the reach."""
    v, w, r, n = _arr(velocity, angular_velocity, reach, normal)
    return np.vecdot(v, n) + np.linalg.norm(np.cross(w, n), axis=-1) + 0 * r


def _looks(given, place=None, speed=None, undecided=math.nan):
    """Conservative advancement, with what may be wrong about it."""
    points, x, v, w, target = _arr(*given[:5])
    dt, tolerance, looks = given[5:]
    reach = np.linalg.norm(points, axis=1).max()
    t, first = 0.0, None
    for look in range(1, looks + 1):
        corners = place(points, x, v, w, t) if place else rotated(points, w * t) + x + v * t
        gap, n = separation_of_hulls(corners, target)
        if gap <= tolerance:
            return t, look
        first = n if first is None else first
        way = -first if speed == "first" else -n
        closing = v @ way if speed == "centre" else v @ way + np.linalg.norm(np.cross(w, way)) * reach
        if closing <= 0:
            return math.inf, look
        t += gap / closing
        if t > dt:
            return math.inf, look
    return undecided, looks


def advance_1(*given):
    """The bound is the speed of the centre alone: a corner that turns arrives unnoticed."""
    return _looks(given, speed="centre")


def advance_2(*given):
    """Moves the hull without turning it; only the bound knows of ω."""
    return _looks(given, place=lambda points, x, v, w, t: points + x + v * t)


def advance_3(*given):
    """Bounds the speed once, along the first normal, and uses it for all looks."""
    return _looks(given, speed="first")


def advance_4(*given):
    """No contact found within the looks counts as no contact: infinity instead of NaN."""
    return _looks(given, undecided=math.inf)


def advance_5(*given):
    """Turns the hull about the origin of the world and not about its own point."""
    return _looks(given, place=lambda points, x, v, w, t: rotated(points + x, w * t) + v * t)


def advance_6(*given):
    """Turns by p + ω × p t: the corners fly off along tangents."""
    return _looks(given, place=lambda points, x, v, w, t: points + np.cross(w, points) * t + x + v * t)
