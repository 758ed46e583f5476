"""Wrong functions about responses to a plane, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import Contract, not_negative, number, share, unit, vector
from reference.arrays import Array


def kinematic_response(
    velocity: ArrayLike, normal: ArrayLike, restitution: float, plane_velocity: ArrayLike = (0.0, 0.0, 0.0)
) -> Array:
    """Velocity after the collision with a plane that may move."""
    v, n = np.asarray(velocity, dtype=float), np.asarray(normal, dtype=float)
    approach = (v - np.asarray(plane_velocity, dtype=float)) @ n
    return np.asarray(v - (1 + restitution) * approach * n if v @ n < 0 and approach < 0 else v)


def penalty_force(
    separation: float,
    normal_velocity: float,
    normal: ArrayLike,
    stiffness: float,
    damping: float = 0.0,
    adhesive: bool = False,
) -> Array:
    """Force of a contact made of a spring and a dashpot."""
    push = stiffness * max(0.0, -separation) - damping * normal_velocity
    return (push if adhesive else max(0.0, push)) * np.asarray(normal, dtype=float)


def respond_at_impact(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: ArrayLike,
    normal: ArrayLike,
    restitution: float,
    time_of_impact: float,
    dt: float,
) -> tuple[Array, Array]:
    """State after a step that backs up to a collision in it."""
    a, n, time = np.asarray(acceleration, dtype=float), np.asarray(normal, dtype=float), min(time_of_impact, dt)
    v = np.asarray(velocity, dtype=float)
    p, v = np.asarray(position, dtype=float) + v * time + a * time**2 / 2, v + a * time
    if time_of_impact <= dt:
        v = v - (1 + restitution) * min(v @ n, 0.0) * n
    return p, v


def _rebounds(program: Callable[..., Any]) -> str:
    """What is wrong with the rebounds above the floors of lifts that rise, sink and stand."""
    for lift, e, height in ((0.0, 0.8, 1.0), (1.5, 0.8, 1.0), (-1.0, 0.5, 0.6)):
        found, right = float(program(lift, e, height)), e**2 * height
        if abs(found - right) > NEAR * height:
            return (
                f"In a lift at {lift:+g} m/s, e = {e:g}, a ball is dropped from {height:g} m. It rises to "
                f"{found:.3f} m above the floor, and it should be {right:.3f} m in every lift of steady speed."
            ).replace("-", "−")
    return ""


NEAR = 0.01
"""A mended program may miss the rebound by this share of the height, because of its steps."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"lift": _rebounds}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "flipper": (
        "kinematic_response",
        kinematic_response,
        Contract({"velocity": vector, "normal": unit(), "restitution": share, "plane_velocity": vector}, optional=1),
    ),
    "trampoline": (
        "penalty_force",
        penalty_force,
        Contract(
            {
                "separation": number,
                "normal_velocity": number,
                "normal": unit(),
                "stiffness": not_negative,
                "damping": not_negative,
                "adhesive": number,
            },
            optional=2,
        ),
    ),
    "film": (
        "respond_at_impact",
        respond_at_impact,
        Contract(
            {
                "position": vector,
                "velocity": vector,
                "acceleration": vector,
                "normal": unit(),
                "restitution": share,
                "time_of_impact": not_negative,
                "dt": not_negative,
            }
        ),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
