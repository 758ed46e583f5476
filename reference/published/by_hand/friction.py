"""Friction by hand: sliding into rolling, measured oblique impacts, rolling down a slope, a spinning ball."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, UP, X, Y
from reference.published.case import Published
from reference.published.rigid_law import against_rigid_law
from reference.published.solid_sphere import inertia_of, mass_of

ROLLING_STEP = 0.01
"""Timestep of P13, s. All forces are constant, so that the speed at the end is the same with any."""
IMPACTS = 30
"""How many impacts of P17 are followed; the ball rolls from the first one on."""
ROUNDING = 1e-9
"""How near an impact by hand comes to the law of a rigid sphere, as a share."""


def begins_to_roll(case: Published, code: Implementation) -> Answers:
    """P4: velocity Verlet as in LAMMPS, with no friction in the very first evaluation of the force."""
    radius, mu, dt, gravity = case.values("radius", "friction", "timestep", "gravity")
    mass = mass_of(radius, case.value("density"))
    inertia = inertia_of(mass, radius)
    rub = code.function("friction_force")
    press, _ = code.function("support_force")(mass, -gravity * UP, STILL, STILL, UP)
    x, v, spin, force, step, found = 0.0, case.value("speed"), 0.0, 0.0, 0, (0.0, 0.0, 0.0)

    def after_half_a_step(v: float, spin: float, force: float) -> tuple[float, float]:
        """Speed and spin after dt/2 in which a force acts where the sphere touches."""
        return v + force / mass * dt / 2, spin - force * radius / inertia * dt / 2

    while force <= 0:  # until the slip turns round, and friction with it: within a step of rolling
        v, spin = after_half_a_step(v, spin, force)
        x += v * dt
        force = float(rub(STILL, (v - radius * spin) * X, press, mu, mu)[0])
        v, spin = after_half_a_step(v, spin, force)
        step += 1
        if step == case.value("steps"):
            found = x, v, spin
    return as_answers(position=found[0], velocity=found[1], spin=found[2], rolls_at=step * dt, rolls_with=v)


def oblique_impacts(case: Published, code: Implementation) -> Answers:
    """P11: one impact for each angle."""
    after, _ = _struck(case, code, "angle")
    _, spin = _struck(case, code, "angle_of_spin")
    before = case.value("speed") * np.sin(np.radians(case.numbers("angle")))
    kept = tuple((after[:, 0] / before).tolist())
    return against_rigid_law(case, kept, tuple(spin[:, 1].tolist()), ROUNDING)


def _struck(case: Published, code: Implementation, angles: str) -> tuple[Array, Array]:
    """Velocity, m/s, and spin, rad/s, after the impacts at the angles of that name, (n, 3) each."""
    turned = np.radians(case.numbers(angles))
    before = case.value("speed") * (np.outer(np.sin(turned), X) - np.outer(np.cos(turned), UP))
    radius, e, mu = case.values("radius", "restitution", "friction")
    velocity, spin = code.function("sphere_impact")(before, STILL, UP, radius, e, mu)
    return velocity, spin


def rolls_down(case: Published, code: Implementation) -> Answers:
    """P13: sequential impulses of the one contact."""
    radius, mass, gravity = case.values("radius", "mass", "gravity")
    slope, duration, dt = math.radians(case.value("slope")), case.value("duration"), ROLLING_STEP
    jacobian, solve = code.function("contact_jacobian"), code.function("sequential_impulses")
    arm = -radius * UP[None]
    rows = np.stack([jacobian(0, -1, direction[None], arm, arm, 1) for direction in (UP, X, Y)], axis=1)
    weights = code.function("inverse_mass_matrix")([1 / mass], np.eye(3)[None] / inertia_of(mass, radius))
    gained = gravity * dt * np.array([math.sin(slope), 0, -math.cos(slope), 0, 0, 0])
    velocity, impulse = np.zeros(6), np.zeros((1, 3))
    for _ in range(round(duration / dt)):
        velocity, impulse = solve(velocity + gained, rows, weights, case.value("friction"))
    return as_answers(speed=float(velocity[0]), friction=float(-impulse[0, 1] / dt))


def spinning_ball(case: Published, code: Implementation) -> Answers:
    """P17: impact after impact, with the parabola between them."""
    radius, e, mu = case.values("radius", "restitution", "friction")
    strike = code.function("sphere_impact")
    velocity = -math.sqrt(2 * case.value("gravity") * (case.value("height") - radius)) * UP
    spin = case.value("spin") * Y
    for _ in range(IMPACTS):
        velocity, spin = strike(velocity, spin, UP, radius, e, mu)
        velocity = velocity * [1, 1, -1]  # the parabola brings it back as fast as it left
    return as_answers(spin=float(spin[1]), speed=float(velocity[0]))
