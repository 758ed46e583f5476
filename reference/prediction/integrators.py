"""One step of each integrator, for an acceleration that depends on positions and velocities, (bodies, 3) each."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from reference.arrays import Array
from reference.engines.base import EXPLICIT, RUNGE_KUTTA, VERLET

Pull = Callable[[Array, Array], Array]
"""Place, m, and velocity, m/s → acceleration, m/s²."""
Step = Callable[[Pull, Array, Array, float], tuple[Array, Array]]
"""Acceleration, place, velocity and timestep, s → place and velocity after the step."""


def semi_implicit_euler(pull: Pull, place: Array, velocity: Array, dt: float) -> tuple[Array, Array]:
    """v⁺ = v + a dt, x⁺ = x + v⁺ dt."""
    after = velocity + dt * pull(place, velocity)
    return place + dt * after, after


def explicit_euler(pull: Pull, place: Array, velocity: Array, dt: float) -> tuple[Array, Array]:
    """x⁺ = x + v dt, v⁺ = v + a dt."""
    return place + dt * velocity, velocity + dt * pull(place, velocity)


def velocity_verlet(pull: Pull, place: Array, velocity: Array, dt: float) -> tuple[Array, Array]:
    """Half of a step's change of velocity before the move, and half after it."""
    middle = velocity + dt / 2 * pull(place, velocity)
    after = place + dt * middle
    return after, middle + dt / 2 * pull(after, middle)


def runge_kutta(pull: Pull, place: Array, velocity: Array, dt: float) -> tuple[Array, Array]:
    """Four slopes, weighted 1 : 2 : 2 : 1."""
    slopes = [(velocity, pull(place, velocity))]
    for share in (0.5, 0.5, 1.0):
        way, gain = slopes[-1]
        there, then = place + share * dt * way, velocity + share * dt * gain
        slopes.append((then, pull(there, then)))
    (w1, a1), (w2, a2), (w3, a3), (w4, a4) = slopes
    return place + dt / 6 * (w1 + 2 * w2 + 2 * w3 + w4), velocity + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


STEPS: Mapping[str, Step] = {EXPLICIT: explicit_euler, VERLET: velocity_verlet, RUNGE_KUTTA: runge_kutta}
"""By the rule of a method; every other rule is semi-implicit Euler where nothing touches."""
