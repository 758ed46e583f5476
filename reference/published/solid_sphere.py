"""Volume, mass and inertia of a solid sphere: set-ups give its radius with a density or a mass."""

from __future__ import annotations

import math


def volume(radius: float) -> float:
    """Volume, m³."""
    return 4 / 3 * math.pi * radius**3


def mass_of(radius: float, density: float) -> float:
    """Mass, kg."""
    return density * volume(radius)


def inertia_of(mass: float, radius: float) -> float:
    """Moment of inertia about any axis through the centre, 2/5 m r², kg m²."""
    return 0.4 * mass * radius**2
