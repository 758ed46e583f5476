"""Wrong functions about detecting a collision."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from labs.assessment.contracts import Contract, nonzero, not_negative, number, vector


def signed_distance(point: Sequence[float], normal: Sequence[float], offset: float) -> float:
    """Distance of a point from the plane n·p + d = 0."""
    length = math.sqrt(sum(part**2 for part in normal))
    return sum(p * n for p, n in zip(point, normal, strict=True)) / length + offset


def time_of_impact_exact(separation: float, normal_velocity: float, normal_acceleration: float) -> float:
    """When a body in free motion next falls through the plane."""
    s, u, a = max(separation, 0.0), normal_velocity, normal_acceleration
    inside = u**2 - 2 * a * s
    if inside < 0 or u > 0 or (u == 0 and a >= 0):
        return math.inf
    return 2 * s / (math.sqrt(inside) - u) if s > 0 else 0.0


def overlap_interval(
    distance: float, normal_velocity: float, radius: float, thickness: float, dt: float
) -> tuple[float, float]:
    """When within a step a ball overlaps a slab."""
    x, u, r, w = distance, normal_velocity, radius, thickness
    if u == 0:
        return (0.0, dt) if -(w + r) <= x <= r else (math.inf, -math.inf)
    start, end = max((r - x) / u, 0.0), min((-(w + r) - x) / u, dt)
    return (start, end) if start <= end else (math.inf, -math.inf)


SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "distance": ("signed_distance", signed_distance, Contract({"point": vector, "normal": nonzero, "offset": number})),
    "hail": (
        "time_of_impact_exact",
        time_of_impact_exact,
        Contract({"separation": number, "normal_velocity": number, "normal_acceleration": number}),
    ),
    "gallery": (
        "overlap_interval",
        overlap_interval,
        Contract(
            {
                "distance": number,
                "normal_velocity": number,
                "radius": not_negative,
                "thickness": not_negative,
                "dt": not_negative,
            }
        ),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
