"""Of the fifth lot of wrong answers, those to the lab on forces."""

from __future__ import annotations

import numpy as np

from solutions.forces import spring_damper_force, stokes_drag, uniform_gravity
from solutions.forces.gravity import GRAVITATIONAL_CONSTANT


def universal_gravity_1(mass_1, mass_2, position_1, position_2, softening=0.0):
    """The softening length is simply added to the distance: G m1 m2/(r + eps)^2."""
    d = np.asarray(position_2, dtype=float) - np.asarray(position_1, dtype=float)
    r = np.linalg.norm(d, axis=-1)
    safe = np.where(r > 0, r, 1.0)
    size = GRAVITATIONAL_CONSTANT * np.asarray(mass_1) * np.asarray(mass_2) / (safe + softening) ** 2
    size = np.where(r > 0, size, 0.0)
    return size[..., None] * d / safe[..., None]


def universal_gravity_2(mass_1, mass_2, position_1, position_2, softening=0.0):
    """Softening replaces r^2 by r^2 + eps^2 in the size, and the direction stays d/r."""
    d = np.asarray(position_2, dtype=float) - np.asarray(position_1, dtype=float)
    eps = np.asarray(softening, dtype=float)
    r = np.linalg.norm(d, axis=-1)
    direction = d / np.where(r == 0, 1.0, r)[..., None]
    r2 = r**2 + eps**2
    size = GRAVITATIONAL_CONSTANT * np.multiply(mass_1, mass_2) / np.where(r2 == 0, 1.0, r2)
    return size[..., None] * direction


def universal_gravity_3(mass_1, mass_2, position_1, position_2, softening=0.0):
    """Bodies nearer than a millimetre are at the same place, so no force."""
    d = np.asarray(position_2, dtype=float) - np.asarray(position_1, dtype=float)
    r = np.linalg.norm(d, axis=-1)
    same = r < 1e-3
    s = np.sqrt(r**2 + np.asarray(softening, dtype=float) ** 2)
    s = np.where(same, 1.0, s)
    size = GRAVITATIONAL_CONSTANT * np.asarray(mass_1, dtype=float) * mass_2 / s**3
    return np.where(same[..., None], 0.0, size[..., None] * d)


def universal_gravity_4(mass_1, mass_2, position_1, position_2, softening=0.0):
    """The falling mass cancels, so it is left out: G m2 d/r^3."""
    d = np.asarray(position_2, dtype=float) - np.asarray(position_1, dtype=float)
    s = np.sqrt(np.sum(d**2, axis=-1) + np.asarray(softening, dtype=float) ** 2)
    size = GRAVITATIONAL_CONSTANT * np.asarray(mass_2, dtype=float) / np.where(s > 0, s, 1.0) ** 3
    return size[..., None] * d


def universal_gravity_5(mass_1, mass_2, position_1, position_2, softening=0.0):
    """The softening stands beside r^2 without a square: (r^2 + eps)^1.5."""
    d = np.asarray(position_2, dtype=float) - np.asarray(position_1, dtype=float)
    s2 = np.sum(d**2, axis=-1) + softening
    size = GRAVITATIONAL_CONSTANT * np.asarray(mass_1, dtype=float) * mass_2 / np.where(s2 > 0, s2, 1.0) ** 1.5
    return size[..., None] * d


def universal_gravity_6(mass_1, mass_2, position_1, position_2, softening=0.0):
    """Believes that G is 6.67e-11 and 9.8 is good enough for everybody: a rounded constant."""
    G = 6.67e-11
    d = np.asarray(position_2, dtype=float) - np.asarray(position_1, dtype=float)
    s = np.sqrt(np.sum(d**2, axis=-1) + np.asarray(softening, dtype=float) ** 2)
    size = G * np.asarray(mass_1, dtype=float) * mass_2 / np.where(s > 0, s, 1.0) ** 3
    return size[..., None] * d


def explicit_euler_1(position, velocity, acceleration, dt):
    """The position also gets a dt^2/2, as for every fall."""
    p = np.asarray(position, dtype=float)
    v = np.asarray(velocity, dtype=float)
    a = np.asarray(acceleration, dtype=float)
    h = np.asarray(dt, dtype=float)[..., None]
    return p + v * h + 0.5 * a * h**2, v + a * h


def explicit_euler_2(position, velocity, acceleration, dt):
    """Believes that += is the same as = ... + ..., so the caller's arrays are overwritten."""
    position = np.asarray(position, dtype=float)
    velocity = np.asarray(velocity, dtype=float)
    h = np.asarray(dt, dtype=float)[..., None]
    position += velocity * h
    velocity += np.asarray(acceleration, dtype=float) * h
    return position, velocity


def explicit_euler_3(position, velocity, acceleration, dt):
    """Believes that dt is one number (no [..., None] for several bodies with a dt each)."""
    position = np.array(position, dtype=float)
    velocity = np.array(velocity, dtype=float)
    new_position = position + velocity * dt
    new_velocity = velocity + np.asarray(acceleration) * dt
    return new_position, new_velocity


def explicit_euler_4(position, velocity, acceleration, dt):
    """The result has the type of what came in (empty_like: whole numbers stay whole)."""
    position, velocity, acceleration = np.broadcast_arrays(position, velocity, acceleration)
    new_position, new_velocity = np.empty_like(position), np.empty_like(velocity)
    new_position[...] = position + velocity * np.asarray(dt)[..., None]
    new_velocity[...] = velocity + acceleration * np.asarray(dt)[..., None]
    return new_position, new_velocity


def spring_damper_force_1(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """The damper feels the whole speed of end 1 relative to end 2, and acts along the spring."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    L = np.linalg.norm(d, axis=-1)
    u = d / np.where(L > 0, L, 1.0)[..., None]
    w = np.asarray(velocity_1, dtype=float) - np.asarray(velocity_2, dtype=float)
    rate = np.linalg.norm(w, axis=-1)
    size = np.asarray(stiffness) * (L - rest_length) + np.asarray(damping) * rate
    return -size[..., None] * u


def spring_damper_force_2(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """The rate of the length is w . d (the vector between the ends, not normalised)."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    L = np.linalg.norm(d, axis=-1)
    u = d / np.where(L > 0, L, 1.0)[..., None]
    w = np.asarray(velocity_1, dtype=float) - np.asarray(velocity_2, dtype=float)
    rate = np.sum(w * d, axis=-1)
    size = np.asarray(stiffness) * (L - rest_length) + np.asarray(damping) * rate
    return -size[..., None] * u


def spring_damper_force_3(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """A damper brakes only while the spring gets longer."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    L = np.linalg.norm(d, axis=-1)
    u = d / np.where(L > 0, L, 1.0)[..., None]
    w = np.asarray(velocity_1, dtype=float) - np.asarray(velocity_2, dtype=float)
    rate = np.maximum(np.sum(w * u, axis=-1), 0.0)
    size = np.asarray(stiffness) * (L - rest_length) + np.asarray(damping) * rate
    return -size[..., None] * u


def spring_damper_force_4(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """A tiny number in the denominator (1e-6) avoids 0/0 and changes nothing."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    L = np.linalg.norm(d, axis=-1)
    u = d / (L + 1e-6)[..., None]
    w = np.asarray(velocity_1, dtype=float) - np.asarray(velocity_2, dtype=float)
    rate = np.sum(w * u, axis=-1)
    size = np.asarray(stiffness) * (L - rest_length) + np.asarray(damping) * rate
    return -size[..., None] * u


def spring_damper_force_5(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """The spring pulls back; the damper is added with a plus (it drives)."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    L = np.linalg.norm(d, axis=-1)
    u = d / np.where(L > 0, L, 1.0)[..., None]
    w = np.asarray(velocity_1, dtype=float) - np.asarray(velocity_2, dtype=float)
    rate = np.sum(w * u, axis=-1)
    return (-np.asarray(stiffness) * (L - rest_length) + np.asarray(damping) * rate)[..., None] * u


def spring_damper_force_6(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """Together spring and damper cannot push: the tension is at least zero."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    L = np.linalg.norm(d, axis=-1)
    u = d / np.where(L > 0, L, 1.0)[..., None]
    w = np.asarray(velocity_1, dtype=float) - np.asarray(velocity_2, dtype=float)
    tension = np.asarray(stiffness) * (L - rest_length) + np.asarray(damping) * np.sum(w * u, axis=-1)
    return -np.maximum(tension, 0.0)[..., None] * u


def spring_damper_force_7(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """Believes that np.linalg.norm(d) is the length (of all springs together)."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    L = np.linalg.norm(d)
    if L == 0:
        return np.zeros_like(d)
    u = d / L
    w = np.asarray(velocity_1, dtype=float) - np.asarray(velocity_2, dtype=float)
    rate = np.sum(w * u, axis=-1)
    return -(np.asarray(stiffness) * (L - rest_length) + np.asarray(damping) * rate)[..., None] * u


def spring_step_limit_1(stiffness, mass, damping):
    """Takes zeta = c/sqrt(k m), the 2 forgotten."""
    k, m, c = (np.asarray(each, dtype=float) for each in (stiffness, mass, damping))
    w = np.sqrt(k / m)
    z = c / np.sqrt(k * m)
    root = np.sqrt(np.maximum(z**2 - 1, 0.0))
    explicit = np.where(z < 1, 2 * z / w, 2 / (w * (np.maximum(z, 1.0) + root)))
    return explicit, 2 * (np.sqrt(1 + z**2) - z) / w


def spring_step_limit_2(stiffness, mass, damping):
    """The two limits in the order of the derivation: semi-implicit first."""
    k, m, c = (np.asarray(each, dtype=float) for each in (stiffness, mass, damping))
    w = np.sqrt(k / m)
    z = c / (2 * np.sqrt(k * m))
    root = np.sqrt(np.maximum(z**2 - 1, 0.0))
    explicit = np.where(z < 1, 2 * z / w, 2 / (w * (np.maximum(z, 1.0) + root)))
    semi = 2 * (np.sqrt(1 + z**2) - z) / w
    return semi, explicit


def spring_step_limit_3(stiffness, mass, damping):
    """Overdamped: the slower of the two rates decides, zeta - sqrt(zeta^2 - 1)."""
    k, m, c = (np.asarray(each, dtype=float) for each in (stiffness, mass, damping))
    w = np.sqrt(k / m)
    z = c / (2 * np.sqrt(k * m))
    root = np.sqrt(np.maximum(z**2 - 1, 0.0))
    explicit = np.where(z <= 1, 2 * z / w, 2 / (w * (np.maximum(z, 1.0) - root)))
    semi = 4 * m / (c + np.sqrt(c**2 + 4 * k * m))
    return explicit, semi


def spring_step_limit_4(stiffness, mass, damping):
    """The damper has no say in semi-implicit Euler: 2/omega."""
    k, m, c = (np.asarray(each, dtype=float) for each in (stiffness, mass, damping))
    w = np.sqrt(k / m)
    z = c / (2 * np.sqrt(k * m))
    root = np.sqrt(np.maximum(z**2 - 1, 0.0))
    explicit = np.where(z < 1, 2 * z / w, 2 / (w * (np.maximum(z, 1.0) + root)))
    return explicit, 2 / w + 0 * c


def spring_step_limit_5(stiffness, mass, damping):
    """A damper makes the step longer: the other sign before zeta."""
    k, m, c = (np.asarray(each, dtype=float) for each in (stiffness, mass, damping))
    w = np.sqrt(k / m)
    z = c / (2 * np.sqrt(k * m))
    root = np.sqrt(np.maximum(z**2 - 1, 0.0))
    explicit = np.where(z < 1, 2 * z / w, 2 / (w * (np.maximum(z, 1.0) + root)))
    return explicit, 2 * (np.sqrt(1 + z**2) + z) / w


def stokes_drag_1(velocity, fluid_velocity, viscosity, radius):
    """Relative velocity is fluid minus ball, and the slide's minus sign stays."""
    relative = np.asarray(fluid_velocity, dtype=float) - np.asarray(velocity, dtype=float)
    K = 6 * np.pi * np.asarray(radius, dtype=float)
    return -(K * viscosity)[..., None] * relative


def stokes_drag_2(velocity, fluid_velocity, viscosity, radius):
    """Drag grows with the square of the speed."""
    w = np.asarray(velocity, dtype=float) - np.asarray(fluid_velocity, dtype=float)
    speed = np.linalg.norm(w, axis=-1)
    size = 6 * np.pi * np.asarray(radius, dtype=float) * viscosity * speed
    return -size[..., None] * w


def stokes_drag_3(velocity, fluid_velocity, viscosity, radius):
    """The speeds are subtracted, and the drag is against the ball's own motion."""
    v = np.asarray(velocity, dtype=float)
    speed = np.linalg.norm(v, axis=-1)
    stream = np.linalg.norm(np.asarray(fluid_velocity, dtype=float), axis=-1)
    direction = v / np.where(speed > 0, speed, 1.0)[..., None]
    size = 6 * np.pi * np.asarray(radius, dtype=float) * viscosity * (speed - stream)
    return -size[..., None] * direction


def stokes_drag_4(velocity, fluid_velocity, viscosity, radius):
    """Numbers times vectors need nothing special (no [..., None])."""
    v, u = np.asarray(velocity, dtype=float), np.asarray(fluid_velocity, dtype=float)
    return 6 * np.pi * viscosity * radius * (u - v)


def terminal_velocity_1(radius, density, fluid_density, viscosity, gravity):
    """Only the size of the difference of the densities counts."""
    r = np.asarray(radius, dtype=float)
    excess = np.abs(np.asarray(density, dtype=float) - np.asarray(fluid_density, dtype=float))
    speed = 2 * excess * r**2 / (9 * np.asarray(viscosity, dtype=float))
    return speed[..., None] * np.asarray(gravity, dtype=float)


def terminal_velocity_2(radius, density, fluid_density, viscosity, gravity):
    """Gravity is along -z, only its size is taken from the argument."""
    r = np.asarray(radius, dtype=float)
    g = np.linalg.norm(np.asarray(gravity, dtype=float), axis=-1)
    v = 2 * (np.asarray(density, dtype=float) - fluid_density) * r**2 * g / (9 * np.asarray(viscosity, dtype=float))
    return v[..., None] * np.array([0.0, 0.0, -1.0])


def terminal_velocity_3(radius, density, fluid_density, viscosity, gravity):
    """The textbook's d^2/18 with the radius put in for d."""
    r = np.asarray(radius, dtype=float)
    factor = (np.asarray(density, dtype=float) - fluid_density) * r**2 / (18 * np.asarray(viscosity, dtype=float))
    return factor[..., None] * np.asarray(gravity, dtype=float)


def terminal_velocity_4(radius, density, fluid_density, viscosity, gravity):
    """What counts is the relative excess of density, (rho_s - rho_f)/rho_f."""
    rho = np.asarray(fluid_density, dtype=float)
    excess = (np.asarray(density, dtype=float) - rho) / np.where(rho > 0, rho, 1.0)
    v = 2 * excess * np.asarray(radius, dtype=float) ** 2 / (9 * np.asarray(viscosity, dtype=float))
    return v[..., None] * np.asarray(gravity, dtype=float)


def wind_force_1(velocity, wind, area, drag_coefficient, density):
    """Each axis by itself: the square of each component with its sign."""
    w = np.asarray(velocity, dtype=float) - np.asarray(wind, dtype=float)
    size = 0.5 * np.asarray(density, dtype=float) * drag_coefficient * area
    return -size[..., None] * np.sign(w) * w**2


def wind_force_2(velocity, wind, area, drag_coefficient, density):
    """A wind pushes along the wind; v - w only says how hard (still air: against v)."""
    v, w = np.asarray(velocity, dtype=float), np.asarray(wind, dtype=float)
    v, w = np.broadcast_arrays(v, w)
    blows = np.linalg.norm(w, axis=-1, keepdims=True)
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    along = np.where(blows > 0, w / np.where(blows > 0, blows, 1.0), -v / np.where(speed > 0, speed, 1.0))
    pressure = 0.5 * np.asarray(density, dtype=float) * np.sum((v - w) ** 2, axis=-1)
    return (pressure * drag_coefficient * area)[..., None] * along


def wind_force_3(velocity, wind, area, drag_coefficient, density):
    """Two forces: the drag of my own speed, and the push of the wind: -|v| v + |w| w."""
    v, w = np.asarray(velocity, dtype=float), np.asarray(wind, dtype=float)
    size = 0.5 * np.asarray(density, dtype=float) * drag_coefficient * area
    own = np.linalg.norm(v, axis=-1, keepdims=True) * v
    push = np.linalg.norm(w, axis=-1, keepdims=True) * w
    return size[..., None] * (push - own)


def total_force_1(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    """Believes that force[first] += pull adds all springs at once."""
    x, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    force = uniform_gravity(mass, gravity) + stokes_drag(v, fluid_velocity, viscosity, radius)
    first, second = np.asarray(ends).T
    pull = spring_damper_force(x[first], x[second], v[first], v[second], stiffness, rest_length, damping)
    force[first] += pull
    force[second] -= pull
    return force


def total_force_2(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    """A loop over the springs that ends one too early."""
    x, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    force = uniform_gravity(mass, gravity) + stokes_drag(v, fluid_velocity, viscosity, radius)
    for s in range(len(ends) - 1):
        a, b = ends[s]
        pull = spring_damper_force(x[a], x[b], v[a], v[b], stiffness[s], rest_length[s], damping[s])
        force[a] += pull
        force[b] -= pull
    return force


def total_force_3(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    """A ball that hangs on springs feels only the last of them, in place of its weight (= for +=)."""
    x, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    weight = np.asarray(mass, dtype=float)[:, None] * np.asarray(gravity, dtype=float)
    springs = np.zeros_like(x)
    for (a, b), k, rest, c in zip(ends, stiffness, rest_length, damping, strict=True):
        pull = spring_damper_force(x[a], x[b], v[a], v[b], k, rest, c)
        springs[a] = pull
        springs[b] = -pull
    return weight + springs + stokes_drag(v, fluid_velocity, viscosity, radius)


def total_force_4(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    """Each spring only once: only if its first ball has the smaller number."""
    x, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    force = uniform_gravity(mass, gravity) + stokes_drag(v, fluid_velocity, viscosity, radius)
    for s, (a, b) in enumerate(ends):
        if a < b:
            pull = spring_damper_force(x[a], x[b], v[a], v[b], stiffness[s], rest_length[s], damping[s])
            force[a] += pull
            force[b] -= pull
    return force


def total_force_5(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    """Believes that stiffness[a] is the stiffness of this spring (index of the ball, not of the spring)."""
    x, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    force = uniform_gravity(mass, gravity) + stokes_drag(v, fluid_velocity, viscosity, radius)
    for s, (a, b) in enumerate(ends):
        k = stiffness[a] if a < len(stiffness) else stiffness[-1]
        pull = spring_damper_force(x[a], x[b], v[a], v[b], k, rest_length[s], damping[s])
        force[a] += pull
        force[b] -= pull
    return force


def total_force_6(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    """Weight and drag are added in the loop over the springs (once for each spring, never for a lone ball)."""
    x, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    outer = uniform_gravity(mass, gravity) + stokes_drag(v, fluid_velocity, viscosity, radius)
    force = np.zeros_like(x)
    for s, (a, b) in enumerate(ends):
        pull = spring_damper_force(x[a], x[b], v[a], v[b], stiffness[s], rest_length[s], damping[s])
        force[a] += pull + outer[a]
        force[b] += -pull + outer[b]
    return force
