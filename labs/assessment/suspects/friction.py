"""Wrong functions about dry friction, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import Contract, not_negative, positive, unit, vector
from reference.arrays import Array
from reference.errors import InvalidInput


def friction_force(
    push: ArrayLike,
    tangent_velocity: ArrayLike,
    normal_force: float,
    static_friction: float,
    kinetic_friction: float,
) -> Array:
    """Friction on a cart that is pushed from behind."""
    f, v = np.asarray(push, dtype=float), np.asarray(tangent_velocity, dtype=float)
    size = np.linalg.norm(f)
    if not v.any() and size <= static_friction * normal_force:
        return -f
    return np.asarray(-kinetic_friction * normal_force * f / (size or 1.0))


def support_force(
    mass: float,
    gravity: ArrayLike,
    push: ArrayLike,
    frame_acceleration: ArrayLike,
    normal: ArrayLike,
) -> tuple[float, Array]:
    """What the scales of an airport show, and what is left along them."""
    fall = np.asarray(gravity, dtype=float) - np.asarray(frame_acceleration, dtype=float)
    every = mass * fall + np.asarray(push, dtype=float)
    n = np.asarray(normal, dtype=float)
    return float(-every @ n), np.asarray(every - (every @ n) * n)


def clamp_to_circle(tangent_force: ArrayLike, limit: float) -> Array:
    """Grip of a tyre in a racing game."""
    return np.asarray(np.clip(np.asarray(tangent_force, dtype=float), -limit, limit))


def _carried(program: Callable[..., Any]) -> str:
    """What is wrong with the velocity and the heat of a parcel that arrives on a belt."""
    for velocity, belt in (([1.0, 0.0], [0.0, 1.0]), ([0.5, -0.4], [-0.3, 0.6]), ([0.8, 0.2], [0.0, 0.0])):
        parcel = f"A parcel that arrives with ({_pair(velocity)}) m/s on a belt that runs with ({_pair(belt)}) m/s"
        final, heat = program(velocity, belt)
        if np.max(np.abs(np.asarray(final, dtype=float) - belt)) > NEAR:
            return f"{parcel} should move with the belt after 1 s; with your program it has ({_pair(final)}) m/s."
        slip = np.subtract(velocity, belt)
        if abs(float(heat) - slip @ slip / 2) > NEAR:
            return f"{parcel} becomes warm with {slip @ slip / 2:.3f} J; with your program it is {float(heat):.3f} J."
    return ""


def _pair(values: ArrayLike) -> str:
    return ", ".join(f"{value + 0.0:+.3f}".replace("-", "−") for value in np.asarray(values, dtype=float))


NEAR = 1e-6
"""A mended program may differ from the right numbers by so much."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"belt": _carried}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""


def _static_at_least_kinetic(*given: Any) -> None:
    *_, static, kinetic = given
    if static < kinetic:
        raise InvalidInput(
            f"static_friction must not be less than kinetic_friction, and {static:g} is less than {kinetic:g}"
        )


SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "carts": (
        "friction_force",
        friction_force,
        Contract(
            {
                "push": vector,
                "tangent_velocity": vector,
                "normal_force": not_negative,
                "static_friction": not_negative,
                "kinetic_friction": not_negative,
            },
            together=_static_at_least_kinetic,
        ),
    ),
    "scales": (
        "support_force",
        support_force,
        Contract({"mass": positive, "gravity": vector, "push": vector, "frame_acceleration": vector, "normal": unit()}),
    ),
    "track": ("clamp_to_circle", clamp_to_circle, Contract({"tangent_force": vector, "limit": not_negative})),
}
"""Key → the function that it should be, the wrong one, and what both take."""
