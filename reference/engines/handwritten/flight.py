"""Balls that meet nothing, under all kinds of forces: their closed form, or steps of semi-implicit Euler.

All physics comes from the implementation's functions; this module decides which of them a scenario needs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten.closed_forms import Form, form_of, with_constant_forces
from reference.engines.handwritten.loads import LoadsByHand
from reference.engines.handwritten.stepping import start
from reference.engines.implementation import Implementation
from reference.errors import InvalidInput
from reference.scene import geometry
from reference.scene.scenario import Body, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.straight_spring import drive_of, ends_of, reduced_mass
from reference.scene.trajectory import Trajectory

INTEGRATORS = {
    "semi_implicit": "semi_implicit_euler",
    "explicit": "explicit_euler",
    "verlet": "velocity_verlet",
    "runge_kutta": "runge_kutta_4",
}
"""The functions of the policies that step."""
FROM_THE_START = ("semi_implicit_euler", "explicit_euler")
"""Those that need the acceleration at the start of the step alone, and get it as numbers."""


def fly(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Run each scenario by itself."""
    policies = dict.fromkeys(INTEGRATORS, _stepped) | {"closed_form": _solved}
    name = str(settings["policy"])
    if name not in policies:
        raise InvalidInput(f"policy is {name!r}; here it is one of {', '.join(policies)}")
    found = []
    for scenario, count in zip(scenarios, steps, strict=True):
        times: Array = np.arange(0, count + 1, settings.sample_every, dtype=np.float64) * settings.timestep
        states = policies[name](scenario, settings, times, implementation)
        position, orientation, velocity, spin = np.split(states, (3, 7, 10), axis=-1)
        found.append(Trajectory(scenario, settings, engine, times, position, orientation, velocity, spin))
    return found


def _movable(scenario: Scenario) -> list[int]:
    return [place for place, body in enumerate(scenario.bodies) if not body.immovable]


# Steps


def _stepped(scenario: Scenario, settings: Settings, times: Array, implementation: Implementation) -> Array:
    """The state at each sample, (n, bodies, 13): forces of the start of each step change velocities and spins."""
    dt, every, movable = settings.timestep, settings.sample_every, _movable(scenario)
    name = INTEGRATORS[str(settings["policy"])]
    step = implementation.function(name)
    loads = LoadsByHand([scenario], implementation)
    bodies = [scenario.bodies[place] for place in movable]
    mass, moments = np.array([body.mass for body in bodies]), np.array([body.moments_of_inertia() for body in bodies])
    weight = implementation.function("uniform_gravity")(mass, np.array(scenario.gravity))
    state = start([scenario])[0]
    samples = [state]
    for number in range(every * (len(times) - 1)):
        torque = np.zeros((len(state), 3))

        def acceleration(
            place: Array, moving: Array, time: float = number * dt, now: Array = state, twist: Array = torque
        ) -> Array:
            then = now.copy()
            then[movable, :3], then[movable, 7:10] = place, moving
            force, twist[:] = loads.on_bodies(time, (then[:, :3], then[:, 3:7], then[:, 7:10], then[:, 10:]))
            return np.asarray((weight + force[movable]) / mass[:, None])

        now = state[movable]
        position, orientation, velocity, spin = now[:, :3], now[:, 3:7], now[:, 7:10], now[:, 10:]
        pushed = acceleration(position, velocity) if name in FROM_THE_START else acceleration
        position, velocity = step(position, velocity, pushed, dt)
        spin = spin + dt * torque[movable] / moments
        state = state.copy()
        state[movable, :3], state[movable, 7:10] = position, velocity
        if np.any(spin):
            state[movable, 3:7], state[movable, 10:] = geometry.turned(orientation, dt * spin), spin
        if (number + 1) % every == 0:
            samples.append(state)
    return np.array(samples)


# Closed forms


def _solved(scenario: Scenario, settings: Settings, times: Array, implementation: Implementation) -> Array:
    """The state at each sample, (n, bodies, 13), each from the start alone."""
    form = form_of(scenario)
    assert form
    states = np.tile(start([scenario])[0], (len(times), 1, 1))
    turn = times[:, None, None] * states[:, :, 10:]
    states[:, :, 3:7] = geometry.turned(states[:, :, 3:7], turn)  # nothing changes a spin here
    _FORMS[form](scenario, states, times, implementation)
    return states


def _throw(scenario: Scenario, states: Array, times: Array, implementation: Implementation) -> None:
    """Constant forces: every ball flies along a parabola."""
    motion, accelerations = implementation.function("ballistic_motion"), _constant(scenario, implementation)
    for place in _movable(scenario):
        body = scenario.bodies[place]
        states[:, place, :3], states[:, place, 7:10] = motion(
            np.array(body.position), np.array(body.velocity), accelerations[place], times
        )


def _drag(scenario: Scenario, states: Array, times: Array, implementation: Implementation) -> None:
    """A fluid that slows each ball: its velocity tends to the terminal one."""
    fluid, motion = scenario.fluid, implementation.function("drag_motion")
    assert fluid
    pushes = LoadsByHand([_without_fluid(scenario)], implementation).on_bodies(0.0, _start_of(scenario))[0]
    for place in _movable(scenario):
        body, radius = scenario.bodies[place], _radius(scenario.bodies[place])
        factor = implementation.function("sphere_shape_factor")(radius)
        relaxation = implementation.function("relaxation_time")(body.mass, factor, fluid.viscosity)
        density = body.mass / (4 / 3 * math.pi * radius**3)
        falls = implementation.function("terminal_velocity")(
            radius, density, fluid.density, fluid.viscosity, np.array(scenario.gravity)
        )
        terminal = np.array(fluid.velocity) + falls + pushes[place] * relaxation / body.mass
        states[:, place, :3], states[:, place, 7:10] = motion(
            np.array(body.position), np.array(body.velocity), terminal, relaxation, times
        )


def _spring(scenario: Scenario, states: Array, times: Array, implementation: Implementation) -> None:
    """One spring along a line: its length swings, and the centre of its two ends flies along a parabola."""
    spring, ends = scenario.springs[0], ends_of(scenario)
    assert ends
    accelerations = _constant(with_constant_forces(scenario), implementation)
    both = [place for place in (ends.first, ends.second) if place is not None]
    mass = np.array([scenario.bodies[place].mass for place in both])
    pull = accelerations[ends.first] - (accelerations[ends.second] if ends.second is not None else 0.0)
    reduced = reduced_mass(scenario, ends)
    rest = spring.rest_length + reduced * float(pull @ ends.direction) / spring.stiffness
    start, numbers = (ends.length - rest, ends.rate), (spring.stiffness, spring.damping, reduced)
    if drive := drive_of(scenario):
        along = float(np.array(drive.amplitude) @ ends.direction)
        force = abs(along), drive.angular_frequency, drive.phase + (math.pi if along < 0 else 0.0)
        off, rate = implementation.function("driven_oscillator")(*start, *numbers, *force, times)
    else:
        off, rate = implementation.function("damped_oscillator")(*start, *numbers, times)
    between, moving = (rest + off)[:, None] * ends.direction, rate[:, None] * ends.direction
    if ends.second is None:
        states[:, ends.first, :3], states[:, ends.first, 7:10] = ends.fixed + between, moving
        return
    share = mass / mass.sum()
    middle = [share @ states[0, both, first : first + 3] for first in (0, 7)]
    centre, velocity = implementation.function("ballistic_motion")(*middle, share @ accelerations[both], times)
    for place, part in ((ends.first, share[1]), (ends.second, -share[0])):
        states[:, place, :3], states[:, place, 7:10] = centre + part * between, velocity + part * moving


def _constant(scenario: Scenario, implementation: Implementation) -> Array:
    """The acceleration of each body where all forces are constant, (bodies, 3), m/s²; zero of one that cannot move."""
    found, movable = np.zeros((len(scenario.bodies), 3)), _movable(scenario)
    mass = np.array([scenario.bodies[place].mass for place in movable])
    weight = implementation.function("uniform_gravity")(mass, np.array(scenario.gravity))
    force = LoadsByHand([scenario], implementation).on_bodies(0.0, _start_of(scenario))[0]
    found[movable] = (weight + force[movable]) / mass[:, None]
    return found


def _start_of(scenario: Scenario) -> list[Array]:
    """Position, orientation, velocity and spin of all bodies at the start."""
    return np.split(start([scenario])[0], (3, 7, 10), axis=-1)


def _without_fluid(scenario: Scenario) -> Scenario:
    return replace(scenario, fluid=())


def _radius(body: Body) -> float:
    assert isinstance(body.shape, Sphere)
    return body.shape.radius


_FORMS: Mapping[Form, Callable[[Scenario, Array, Array, Implementation], None]] = {
    Form.THROW: _throw,
    Form.DRAG: _drag,
    Form.SPRING: _spring,
}
