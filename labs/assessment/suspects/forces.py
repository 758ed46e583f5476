"""Wrong functions about springs and wind, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import Contract, not_negative, positive, vector
from reference.arrays import Array


def spring_damper_force(
    position_1: ArrayLike,
    position_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    stiffness: float,
    rest_length: float,
    damping: float,
) -> Array:
    """Force of a bungee rope on somebody who jumps off a balloon."""
    d = np.asarray(position_1, dtype=float) - np.asarray(position_2, dtype=float)
    length = float(np.linalg.norm(d))
    if length == 0:
        return np.zeros(3)
    faster = float(np.linalg.norm(velocity_1) - np.linalg.norm(velocity_2))
    return np.asarray(-(stiffness * (length - rest_length) + damping * faster) * d / length)


def wind_force(velocity: ArrayLike, wind: ArrayLike, area: float, drag_coefficient: float, density: float) -> Array:
    """Force of the air on the sail of a boat."""
    own, blows = (np.asarray(each, dtype=float) for each in (velocity, wind))
    pressure = density * drag_coefficient * area / 2
    return np.asarray(pressure * (np.linalg.norm(blows) * blows - np.linalg.norm(own) * own))


def spring_step_limit(stiffness: float, mass: float, damping: float) -> tuple[float, float]:
    """Longest steps for the buffers of a railway in a game."""
    return damping / stiffness, 4 * mass / (damping + float(np.sqrt(damping**2 + 4 * stiffness * mass)))


STIFFNESS, REST_LENGTH, STEP, STEPS = 40.0, 0.5, 0.01, 1000
"""The spring between the pucks, N/m and m, and the steps of the program, s."""


def _on_ice(program: Callable[..., Any]) -> str:
    """What is wrong with the motion of two pucks on a spring."""
    for places, velocities, mass in (
        ([0.0, 0.6], [0.0, 0.0], [1.0, 2.0]),
        ([0.0, 0.4], [0.5, -0.3], [3.0, 0.5]),
    ):
        x, v = (np.asarray(each, dtype=float) for each in program(list(places), list(velocities), list(mass)))
        m = np.array(mass)
        before, after = float(m @ velocities), float(m @ v)
        pucks = f"Pucks of {mass[0]:g} and {mass[1]:g} kg on the spring"
        if abs(after - before) > NEAR:
            return f"{pucks} have a momentum of {before:+.3f} kg m/s; with your program they end with {after:+.3f}."
        ends = [_motion(np.array(places), np.array(velocities), m, old) for old in (False, True)]
        if all(np.max(np.abs(x - end)) > NEAR for end in ends):
            wanted = f"{ends[0][0]:.3f} and {ends[0][1]:.3f} m"
            return f"{pucks} should be at {wanted} after 10 s, not {x[0]:.3f} and {x[1]:.3f} m."
    return ""


def _motion(x: Array, v: Array, mass: Array, old: bool) -> Array:
    """Where the pucks are in the end. old: whether the old velocity moves them, as in explicit Euler."""
    for _ in range(STEPS):
        away = x[0] - x[1]
        pull = -STIFFNESS * (abs(away) - REST_LENGTH) * np.sign(away)
        after = v + np.array([pull, -pull]) / mass * STEP
        x, v = x + (v if old else after) * STEP, after
    return x


NEAR = 1e-6
"""A mended program may differ from the right numbers by so much."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"pucks": _on_ice}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "bungee": (
        "spring_damper_force",
        spring_damper_force,
        Contract(
            {
                "position_1": vector,
                "position_2": vector,
                "velocity_1": vector,
                "velocity_2": vector,
                "stiffness": not_negative,
                "rest_length": not_negative,
                "damping": not_negative,
            }
        ),
    ),
    "sail": (
        "wind_force",
        wind_force,
        Contract(
            {
                "velocity": vector,
                "wind": vector,
                "area": not_negative,
                "drag_coefficient": not_negative,
                "density": not_negative,
            }
        ),
    ),
    "buffers": (
        "spring_step_limit",
        spring_step_limit,
        Contract({"stiffness": positive, "mass": positive, "damping": not_negative}),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
