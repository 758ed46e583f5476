"""How near two spheres will come, and when they meet (slide 1)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Vector, domain
from solutions.vectors import quotient


@domain
def nearest_approach(
    position_a: Vector,
    velocity_a: Vector,
    position_b: Vector,
    velocity_b: Vector,
    radius_a: NotNegative = 0.0,
    radius_b: NotNegative = 0.0,
) -> tuple[Array, Array]:
    """When two spheres are nearest, and how near, at constant velocities.

    Two points are spheres of radius 0.

    Parameters
    ----------
    position_a, position_b : (..., 3), m
    velocity_a, velocity_b : (..., 3), m/s
    radius_a, radius_b : (...), m, not negative; 0 for points

    Returns
    -------
    time : (...), s from now, never negative
        It is 0, which means now, if the spheres already move apart. It is also
        0 if they keep their distance because their velocities are equal.
    separation : (...), m, between the surfaces at that time
        Negative where the spheres will overlap.

    Notes
    -----
    Let x = p_A − p_B be the relative position now, and u = ṗ_A − ṗ_B the
    relative velocity. After the time t the relative position is x + u t, and
    its square is

        (x + u t)² = x² + 2 (x·u) t + u² t²

    This is a parabola in t. Its derivative 2 (x·u) + 2 u² t vanishes at

        t = −(x·u)/u²

    and there the distance is smallest. If this time is negative, it has
    passed: the spheres move apart, and of all times from now on they are
    nearest at once.
    """
    x = position_a - position_b
    u = velocity_a - velocity_b
    time = quotient(np.maximum(-np.vecdot(x, u), 0.0), np.vecdot(u, u))
    distance = np.linalg.norm(x + u * time[..., None], axis=-1)
    return time, distance - radius_a - radius_b
