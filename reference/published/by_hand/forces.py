"""Motion under forces by hand: free flight, dry friction, viscosity, drag beyond Stokes."""

from __future__ import annotations

import math
import warnings

import numpy as np

from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, UP, X
from reference.published.case import Published
from reference.published.solid_sphere import volume

EIGHT_STEPS = 450
"""Steps for the period of P39: the error is of fourth order, 1e-6 with 300 of them and a fifth of that with 450."""
LONG_AFTER = 100.0
"""Phase ω t at which the oscillator of P16 has long stopped: its seven half swings end at a phase of 22."""


def free_flight(case: Published, code: Implementation) -> Answers:
    """P14: how far steps of semi-implicit Euler end from the parabola."""
    velocity, gravity = np.array(case.numbers("velocity")), np.array(case.numbers("gravity"))
    dt, duration = case.values("timestep", "duration")
    step, place, moving = code.function("semi_implicit_euler"), STILL, velocity
    for _ in range(round(duration / dt)):
        place, moving = step(place, moving, gravity, dt)
    exact, _ = code.function("ballistic_motion")(STILL, velocity, gravity, duration)
    return as_answers(position_error=float(np.linalg.norm(place - exact)))


def dry_oscillator(case: Published, code: Implementation) -> Answers:
    """P16: the first two turning points, and where it is when it has stopped."""
    start, velocity = case.values("displacement", "velocity")
    stiffness, friction, mass = case.values("stiffness", "friction", "mass")
    frequency = math.sqrt(stiffness / mass)
    # Moving up, it swings about −F/k. Seen from there, it starts at this angle before the first turning point.
    first = math.atan2(velocity / frequency, start + friction / stiffness)
    phases = (first, first + math.pi, LONG_AFTER)
    instants = tuple(phase / frequency for phase in phases)
    places, _ = code.function("friction_oscillator")(start, velocity, stiffness, friction, mass, instants)
    one, two, end = map(float, places)
    return as_answers(turning_point=one, fall=abs(one) - abs(two), sticks_at=end)


def glycerol(case: Published, code: Implementation) -> Answers:
    """P20: the viscosity for which drag balances weight, with buoyancy and as on the slide without."""
    mass, radius, fluid, speed = case.values("mass", "radius", "fluid_density", "speed")
    gravity = -case.value("gravity") * UP
    weight = code.function("uniform_gravity")(mass, gravity)
    lift = code.function("buoyancy")(volume(radius), fluid, gravity)
    drag_at_one = code.function("stokes_drag")(-speed * UP, STILL, 1.0, radius)
    with_lift, without = (-float(force[2] / drag_at_one[2]) for force in (weight + lift, weight))
    return as_answers(viscosity=with_lift, viscosity_without_buoyancy=without)


def sand_grain(case: Published, code: Implementation) -> Answers:
    """P25: terminal speeds, by Stokes' law and with the drag beyond it."""
    arguments = (*case.values("radius", "density", "fluid_density", "viscosity"), -case.value("gravity") * UP)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the case is about a speed outside Stokes' regime
        stokes = code.function("terminal_velocity")(*arguments)
    corrected = code.function("terminal_velocity_corrected")(*arguments)
    return as_answers(speed=float(-corrected[2]), speed_by_stokes=float(-stokes[2]))


def three_bodies(case: Published, code: Implementation) -> Answers:
    """P39: Runge-Kutta steps, with masses so large that G m is 1."""
    pull, step = code.function("mutual_gravity"), code.function("runge_kutta_4")
    mass = np.full(3, 1 / abs(float(code.function("universal_gravity")(1.0, 1.0, STILL, X)[0])))
    place, velocity = (
        np.pad(np.reshape(case.numbers(name), (3, 2)), ((0, 0), (0, 1))) for name in ("places", "velocities")
    )
    ways = [place]
    for _ in range(EIGHT_STEPS):
        place, velocity = step(
            place, velocity, lambda there, _: pull(mass, there) / mass[:, None], case.value("period") / EIGHT_STEPS
        )
        ways.append(place)
    third, whole = (tuple(ways[at][:, :2].ravel().tolist()) for at in (EIGHT_STEPS // 3, EIGHT_STEPS))
    return as_answers(after_a_third=third, after_a_period=whole)


def block_on_spring(case: Published, code: Implementation) -> Answers:
    """P40: the frequency, and the exact motion a quarter of a period after the start."""
    mass, stiffness, start = case.values("mass", "stiffness", "displacement")
    frequency = float(code.function("natural_frequency")(stiffness, mass))
    period = 2 * math.pi / frequency
    _, velocity = code.function("damped_oscillator")(start, 0.0, stiffness, 0.0, mass, period / 4)
    force = code.function("spring_damper_force")((1 + start) * X, STILL, STILL, STILL, stiffness, 1.0, 0.0)
    return as_answers(
        angular_frequency=frequency,
        period=period,
        fastest=abs(float(velocity)),
        acceleration=float(np.linalg.norm(force)) / mass,
    )
