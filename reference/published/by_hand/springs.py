"""Contacts that give way, by hand: springs, dashpots, and how deep a body rests in them."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import UP
from reference.published.case import Published
from reference.published.solid_sphere import mass_of

SPRING_STEP, SPRING_TIME = 2e-4, 0.7
"""Timestep and duration of P18, s: the ball falls for 0.43 s and turns after a good quarter of its period of 0.63 s."""


def spring_and_dashpot(case: Published, code: Implementation) -> Answers:
    """P3: positions at the published steps, and velocities at the last two, by velocity Verlet."""
    found = granular(case, code, adhesive=True)
    return as_answers(position=tuple(found[:, 0].tolist()), velocity=tuple(found[1:, 1].tolist()))


def granular(case: Published, code: Implementation, adhesive: bool) -> Array:
    """Position, m, and velocity, m/s, at each of the published steps, (n, 2); adhesive: the dashpot may pull."""
    stiffness, dt, gravity = case.values("stiffness", "timestep", "gravity")
    radius = case.value("diameter") / 2
    mass = mass_of(radius, case.value("density"))
    damping = code.function("penalty_damping")(case.value("restitution"), mass, stiffness, adhesive=True)
    penalty = code.function("penalty_force")

    def acceleration(z: float, v: float) -> float:
        return float(penalty(z - radius, v, UP, stiffness, damping, adhesive)[2]) / mass - gravity

    z, v, found = case.value("height"), 0.0, []
    a = acceleration(z, v)
    for step in range(1, int(max(case.numbers("steps"))) + 1):
        middle = v + a * dt / 2
        z += middle * dt
        a = acceleration(z, middle)
        v = middle + a * dt / 2
        if step in case.numbers("steps"):
            found.append((z, v))
    return np.array(found)


def rest_depths(case: Published, code: Implementation) -> Answers:
    """P9: how deep a body of 1 kg rests in a spring that is 1/(1 − d) as stiff."""
    stiffness, impedance = np.array(case.numbers("stiffness")), np.array(case.numbers("impedance"))
    depths = code.function("penalty_rest_depth")(1.0, case.value("gravity"), stiffness / (1 - impedance))
    return as_answers(depth=tuple(depths.tolist()))


def undamped_spring(case: Published, code: Implementation) -> Answers:
    """P18: the lowest position and the largest speed of a drop on a spring, by velocity Verlet."""
    mass, stiffness, contact, gravity = case.values("mass", "stiffness", "contact", "gravity")
    penalty, verlet = code.function("penalty_force"), code.function("velocity_verlet")

    def acceleration(position: Array, velocity: Array) -> Array:
        force: Array = penalty(position[2] - contact, velocity[2], UP, stiffness)
        return force / mass - gravity * UP

    position, velocity, lowest, fastest = case.value("height") * UP, 0 * UP, math.inf, 0.0
    for _ in range(round(SPRING_TIME / SPRING_STEP)):
        position, velocity = verlet(position, velocity, acceleration, SPRING_STEP)
        lowest, fastest = min(lowest, float(position[2])), max(fastest, abs(float(velocity[2])))
    return as_answers(lowest=lowest, fastest=fastest)
