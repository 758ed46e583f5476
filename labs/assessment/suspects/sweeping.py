"""Wrong functions about swept volumes, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import Contract, every, not_negative, vector
from reference.arrays import Array


def ray_sphere(origin: ArrayLike, direction: ArrayLike, radius: float) -> float:
    """When a drone flies into a round zone."""
    x, u = np.asarray(origin, dtype=float), np.asarray(direction, dtype=float)
    a, b, c = float(u @ u), float(x @ u), float(x @ x) - radius**2
    if a == 0 or b * b < a * c:
        return float("inf")
    root = np.sqrt(b * b - a * c)
    return float(min((t for t in ((-b - root) / a, (-b + root) / a) if t >= 0), default=np.inf))


def ray_box(origin: ArrayLike, direction: ArrayLike, half_extents: ArrayLike) -> tuple[float, float]:
    """From when to when a ray is in a box."""
    entry, leaving = 0.0, float("inf")
    for x, u, half in zip(
        *(np.asarray(value, dtype=float) for value in (origin, direction, half_extents)), strict=True
    ):
        if u != 0:
            times = (-half - x) / u, (half - x) / u
            entry, leaving = max(entry, min(times)), min(leaving, max(times))
    return (entry, leaving) if entry <= leaving else (float("inf"), float("-inf"))


def ray_capsule(origin: ArrayLike, direction: ArrayLike, start: ArrayLike, end: ArrayLike, radius: float) -> float:
    """When the arm of a robot comes too near to a pipe."""
    x, u, a, b = (np.asarray(value, dtype=float) for value in (origin, direction, start, end))
    d = b - a
    q = float(d @ d) or 1.0
    place, rate = float((x - a) @ d) / q, float(u @ d) / q
    time = _entered(x - a - place * d, u - rate * d, radius)
    return time if np.isfinite(time) and 0 <= place + rate * time <= 1 else float("inf")


def _entered(x: Array, u: Array, radius: float) -> float:
    """When a ray enters a ball around the origin, or 0 from within."""
    a, b, c = float(u @ u), float(x @ u), float(x @ x) - radius**2
    if c <= 0:
        return 0.0
    return float((-b - np.sqrt(b * b - a * c)) / a) if b < 0 and b * b >= a * c else float("inf")


def _first_of_several(program: Callable[..., Any]) -> str:
    """What is wrong with the ball that a cue ball hits first, whatever the order of the list."""
    tables = (
        ((0.0, 0.0), (2.0, 0.0), [(0.8, 0.0), (1.4, 0.02), (0.5, 0.03)]),
        ((0.1, -0.2), (1.0, 1.0), [(0.9, 0.6), (0.4, 0.11), (0.6, 0.3)]),
        ((0.0, 0.0), (0.0, -1.5), [(0.5, 0.5), (0.01, -0.4)]),
        ((0.0, 0.0), (0.5, 0.0), [(0.5, 0.4), (3.0, 0.0)]),
    )
    for place, velocity, balls in tables:
        times = {ball: _entered(np.subtract(place, ball), np.asarray(velocity), 0.06) for ball in balls}
        first = min(times, key=lambda ball: times[ball])
        needed, time = (first, times[first]) if times[first] <= 1.0 else (None, 1.0)
        for order in (balls, balls[::-1], balls[1:] + balls[:1]):
            ball, when = program(place, velocity, order)
            if ball != needed or (needed is not None and abs(float(when) - time) > NEAR):
                listed = ", ".join(f"({x:g}, {y:g})" for x, y in order)
                said = f"({needed[0]:g}, {needed[1]:g}) after {time:.4f} s" if needed else "none"
                given = f"({ball[0]:g}, {ball[1]:g}) after {float(when):.4f} s" if ball else "none"
                return (
                    f"From ({place[0]:g}, {place[1]:g}) with ({velocity[0]:g}, {velocity[1]:g}) m/s and the balls "
                    f"{listed} the first hit is {said}, and your program says {given}."
                ).replace("-", "−")
    return ""


NEAR = 1e-6
"""A mended program may differ from the right time by so much, s."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"cue": _first_of_several}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "zone": ("ray_sphere", ray_sphere, Contract({"origin": vector, "direction": vector, "radius": not_negative})),
    "viewer": (
        "ray_box",
        ray_box,
        Contract({"origin": vector, "direction": vector, "half_extents": every(not_negative, vector)}),
    ),
    "pipes": (
        "ray_capsule",
        ray_capsule,
        Contract({"origin": vector, "direction": vector, "start": vector, "end": vector, "radius": not_negative}),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
