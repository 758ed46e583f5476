"""Right answers for one body, one spring or one ball alone."""

import math


def explicit_euler(position, velocity, acceleration, dt):
    place = [position[i] + velocity[i] * dt for i in range(3)]
    return place, [velocity[i] + acceleration[i] * dt for i in range(3)]


def universal_gravity(mass_1, mass_2, position_1, position_2, softening=0.0):
    d = [position_2[i] - position_1[i] for i in range(3)]
    r = math.sqrt(d[0] ** 2 + d[1] ** 2 + d[2] ** 2 + softening**2)
    if r == 0:
        return [0.0, 0.0, 0.0]
    return [6.6743e-11 * mass_1 * mass_2 * d[i] / r**3 for i in range(3)]


def spring_damper_force(position_1, position_2, velocity_1, velocity_2, stiffness, rest_length, damping):
    d = position_2 - position_1
    length = math.sqrt(d @ d)
    if length == 0:
        return 0 * d
    lengthening = (velocity_2 - velocity_1) @ d / length
    return (stiffness * (length - rest_length) + damping * lengthening) * d / length


def spring_step_limit(stiffness, mass, damping):
    critical = 2 * math.sqrt(stiffness * mass)
    omega, zeta = math.sqrt(stiffness / mass), damping / critical
    if zeta > 1:
        explicit = 2 / omega * (zeta - math.sqrt(zeta**2 - 1))
    else:
        explicit = 2 * zeta / omega
    return explicit, 2 / omega * (math.sqrt(zeta**2 + 1) - zeta)


def stokes_drag(velocity, fluid_velocity, viscosity, radius):
    return 6 * math.pi * viscosity * radius * (fluid_velocity - velocity)


def terminal_velocity(radius, density, fluid_density, viscosity, gravity):
    volume = 4 / 3 * math.pi * radius**3
    pull = [(density - fluid_density) * volume * g for g in gravity]
    return [part / (6 * math.pi * viscosity * radius) for part in pull]


def wind_force(velocity, wind, area, drag_coefficient, density):
    past = [wind[i] - velocity[i] for i in range(3)]
    pressure = 0.5 * density * math.hypot(*past) * drag_coefficient * area
    return tuple(pressure * part for part in past)


def total_force(
    position, velocity, mass, radius, gravity, viscosity, fluid_velocity, ends, stiffness, rest_length, damping
):
    stream = fluid_velocity if fluid_velocity.ndim == 2 else [fluid_velocity] * len(mass)
    force = []
    for ball in range(len(mass)):
        own = mass[ball] * gravity + stokes_drag(velocity[ball], stream[ball], viscosity, radius[ball])
        for at, (a, b) in enumerate(ends):
            other = b if ball == a else a
            if ball in (a, b):
                own = own + spring_damper_force(
                    position[ball], position[other], velocity[ball], velocity[other],
                    stiffness[at], rest_length[at], damping[at],
                )  # fmt: skip
        force.append(own)
    return force
