"""How near two spheres will come, and when they meet (slide 1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import in_space, not_negative


def nearest_approach(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    radius_a: ArrayLike = 0.0,
    radius_b: ArrayLike = 0.0,
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

    Raises
    ------
    ValueError
        If a radius is negative, or a vector is not finite or does not have
        three components.

    Notes
    -----
    Let x = p_A − p_B be the relative position now, and u = ṗ_A − ṗ_B the
    relative velocity. After the time t the relative position is x + u t, and
    its square is

        (x + u t)² = x² + 2 x·u t + u² t²

    This is a parabola in t. Its derivative 2 x·u + 2 u² t vanishes at t =
    −x·u/u², and there the distance is smallest. If this time is negative, it
    has passed: the spheres move apart, and of all times from now on they are
    nearest at once.
    """
    x = in_space("position_a", position_a) - in_space("position_b", position_b)
    u = in_space("velocity_a", velocity_a) - in_space("velocity_b", velocity_b)
    closing, squared = -np.vecdot(x, u), np.vecdot(u, u)
    time = np.where(
        squared > 0,
        np.maximum(closing, 0.0) / np.where(squared > 0, squared, 1.0),
        0.0,
    )
    distance = np.linalg.norm(x + u * time[..., None], axis=-1)
    return time, np.asarray(
        distance
        - not_negative("radius_a", radius_a)
        - not_negative("radius_b", radius_b)
    )
