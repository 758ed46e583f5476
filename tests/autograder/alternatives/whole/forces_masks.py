"""Right answers with masks and results that are written in place, and sums without a loop."""

import numpy as np


def explicit_euler(position, velocity, acceleration, dt):
    dt = np.expand_dims(dt, -1)
    new_position = np.array(position + dt * velocity)
    new_velocity = np.array(velocity, dtype=float) + 0 * new_position
    new_velocity += acceleration * dt
    return new_position, new_velocity


def universal_gravity(mass_1, mass_2, position_1, position_2, softening=0.0):
    d = np.asarray(position_2) - np.asarray(position_1)
    r = np.linalg.norm(d, axis=-1)
    far = np.sqrt(r**2 + np.asarray(softening) ** 2)
    apart = far > 0
    size = np.zeros_like(far)
    np.divide(1.0, far**3, out=size, where=apart)
    return d * (6.67430e-11 * mass_1 * mass_2 * size)[..., None]


def unit(vectors):
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors, dtype=float), where=length != 0)


def spring_damper_force(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    d = np.asarray(position_1, dtype=float) - position_2
    u = unit(d)
    stretch = np.linalg.norm(d, axis=-1) - rest_length
    rate = np.vecdot(np.asarray(velocity_1, dtype=float) - velocity_2, u)
    return -u * np.asarray(stiffness * stretch + damping * rate)[..., None]


def spring_step_limit(stiffness, mass, damping):
    k, m, c = (np.array(each, dtype=float) for each in np.broadcast_arrays(stiffness, mass, damping))
    omega = np.sqrt(k / m)
    zeta = c / (2 * m * omega)
    explicit = np.array(2 * zeta / omega)
    strong = zeta > 1
    explicit[strong] = 2 / (omega[strong] * (zeta[strong] + np.sqrt(zeta[strong] ** 2 - 1)))
    semi_implicit = 2 * (np.sqrt(1 + zeta**2) - zeta) / omega
    return explicit, semi_implicit


def stokes_drag(velocity, fluid_velocity, viscosity, radius):
    drag = np.array(velocity, dtype=float) - fluid_velocity
    drag = drag * np.asarray(6 * np.pi * viscosity * radius)[..., None]
    return np.negative(drag)


def terminal_velocity(radius, density, fluid_density, viscosity, gravity):
    lighter = np.asarray(density) - fluid_density
    speed = lighter * np.asarray(radius) ** 2 / viscosity * (2 / 9)
    return np.asarray(speed)[..., None] * gravity


def wind_force(velocity, wind, area, drag_coefficient, density):
    blows = np.asarray(wind, dtype=float) - velocity
    strength = np.linalg.norm(blows, axis=-1) ** 2 * density * drag_coefficient * area / 2
    return unit(blows) * np.asarray(strength)[..., None]


def total_force(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    force = np.outer(mass, gravity)
    force += stokes_drag(velocity, fluid_velocity, viscosity, radius)
    a, b = ends[:, 0], ends[:, 1]
    pull = spring_damper_force(position[a], position[b], velocity[a], velocity[b], stiffness, rest_length, damping)
    np.add.at(force, a, pull)
    np.subtract.at(force, b, pull)
    return force
