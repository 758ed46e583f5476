"""Right answers by other formulas: eigenvalues, energies, matrices of who is at which end."""

import numpy as np

G = 6.6743e-11


def explicit_euler(position, velocity, acceleration, dt):
    """Both at once: a row of three vectors times a matrix."""
    p, v, a = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (position, velocity, acceleration)))
    dt = np.asarray(dt, dtype=float)
    p, v, a, dt = np.broadcast_arrays(p, v, a, dt[..., None])
    step = np.stack([np.stack([p, v], -1)[..., 0] + dt * v, v + dt * a])
    return step[0], step[1]


def universal_gravity(mass_1, mass_2, position_1, position_2, softening=0.0):
    """Minus the slope of the energy."""
    d = np.subtract(position_2, position_1, dtype=float)
    squared = np.einsum("...i,...i", d, d) + np.square(softening, dtype=float)
    with np.errstate(all="ignore"):
        slope = G * np.multiply(mass_1, mass_2) * np.power(squared, -1.5)
    return np.where(squared > 0, slope, 0.0)[..., None] * d


def spring_damper_force(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    """With the square of the length and its rate of change."""
    d = np.subtract(position_1, position_2, dtype=float)
    w = np.subtract(velocity_1, velocity_2, dtype=float)
    squared = np.sum(d * d, axis=-1)
    length = np.sqrt(squared)
    safe = np.where(squared > 0, squared, 1.0)
    share = np.asarray(stiffness) * (1 - np.asarray(rest_length) / np.sqrt(safe))
    share = share + np.asarray(damping) * np.sum(d * w, axis=-1) / safe
    return -np.where(length > 0, share, 0.0)[..., None] * d


def spring_step_limit(stiffness, mass, damping):
    """From the rates of the motion: complex numbers, and one root that is rationalised."""
    k, m, c = np.broadcast_arrays(*(np.asarray(each, dtype=float) for each in (stiffness, mass, damping)))
    root = np.sqrt((c * c - 4 * k * m).astype(complex))
    fast = (-c - root) / (2 * m)
    explicit = -2 * fast.real / np.abs(fast) ** 2
    return explicit, (np.sqrt(c * c + 4 * k * m) - c) / k


def stokes_drag(velocity, fluid_velocity, viscosity, radius):
    size = 6 * np.pi * np.asarray(viscosity) * np.asarray(radius)
    return np.einsum("...,...i->...i", size, np.subtract(fluid_velocity, velocity))


def terminal_velocity(radius, density, fluid_density, viscosity, gravity):
    """The weight that is left, over the drag at 1 m/s."""
    r = np.asarray(radius, dtype=float)
    weight = 4 / 3 * np.pi * r**3 * np.subtract(density, fluid_density)
    unit_drag = -stokes_drag([1.0, 0.0, 0.0], [0.0, 0.0, 0.0], viscosity, r)[..., 0]
    return np.asarray(gravity) * (weight / unit_drag)[..., np.newaxis]


def wind_force(velocity, wind, area, drag_coefficient, density):
    past = np.subtract(wind, velocity, dtype=float)
    pressure = np.asarray(density) / 2 * np.sqrt(np.sum(past**2, -1))
    return (pressure * drag_coefficient * area)[..., None] * past


def total_force(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    """All springs at once, and a matrix that gives each ball the pulls of its ends."""
    count, (a, b) = len(mass), np.asarray(ends).reshape(-1, 2).T
    pulls = spring_damper_force(position[a], position[b], velocity[a], velocity[b], stiffness, rest_length, damping)
    at = np.eye(count)[a] - np.eye(count)[b]
    force = at.T @ np.reshape(pulls, (-1, 3))
    force += np.outer(mass, gravity)
    return force + stokes_drag(velocity, fluid_velocity, viscosity, radius)
