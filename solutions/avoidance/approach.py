"""Moving obstacles: how near two spheres will come, and when they meet (slide 1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.avoidance.directions import in_space
from solutions.checks import not_negative

Array = NDArray[np.float64]


def nearest_approach(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    radius_a: ArrayLike = 0.0,
    radius_b: ArrayLike = 0.0,
) -> tuple[Array, Array]:
    """When two points or spheres at constant velocities will be nearest, and how far apart then (slide 1).

    With x = p_A − p_B and u = ṗ_A − ṗ_B the squared distance (x + u t)² is least at t = −x·u/u².

    Parameters
    ----------
    position_a, position_b : (..., 3), m
    velocity_a, velocity_b : (..., 3), m/s
    radius_a, radius_b : (...), m, not negative; 0 for points

    Returns
    -------
    time : (...), s from now, never negative: if they already part, and if they keep their distance because the
        velocities are equal, the answer is now, 0
    separation : (...), m, between the surfaces then, negative where they will overlap

    Raises
    ------
    ValueError
        If a radius is negative, or a vector is not finite or not in space.
    """
    x = in_space("position_a", position_a) - in_space("position_b", position_b)
    u = in_space("velocity_a", velocity_a) - in_space("velocity_b", velocity_b)
    closing, squared = -np.sum(x * u, axis=-1), np.sum(u * u, axis=-1)
    time = np.where(squared > 0, np.maximum(closing, 0.0) / np.where(squared > 0, squared, 1.0), 0.0)
    distance = np.linalg.norm(x + u * time[..., None], axis=-1)
    return time, np.asarray(distance - not_negative("radius_a", radius_a) - not_negative("radius_b", radius_b))


def time_to_collision(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    radius_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    radius_b: ArrayLike,
) -> Array:
    """Time until two spheres at constant velocities touch: the first root of ‖x + u t‖ = R, R = r_A + r_B (slide 1).

        t = (x² − R²)/(−x·u + √(R² u² − (x × u)²))    if x·u < 0

    The root is written so that no two nearly equal numbers are subtracted.

    Parameters
    ----------
    position_a, position_b : (..., 3), m
    velocity_a, velocity_b : (..., 3), m/s
    radius_a, radius_b : (...), m, not negative

    Returns
    -------
    (...), s from now. 0 if they overlap, and if they touch and approach; infinity if they never meet. Spheres that
    will just graze each other do meet.

    Raises
    ------
    ValueError
        If a radius is negative, or a vector is not finite or not in space.
    """
    x = in_space("position_a", position_a) - in_space("position_b", position_b)
    u = in_space("velocity_a", velocity_a) - in_space("velocity_b", velocity_b)
    reach = not_negative("radius_a", radius_a) + not_negative("radius_b", radius_b)
    distance, closing = np.linalg.norm(x, axis=-1), -np.sum(x * u, axis=-1)
    across = np.sum(np.cross(x, u) ** 2, axis=-1)
    discriminant = reach**2 * np.sum(u * u, axis=-1) - across
    meets = (closing > 0) & (discriminant >= 0)
    root = np.sqrt(np.where(meets, discriminant, 0.0))
    time = (distance - reach) * (distance + reach) / np.where(meets, closing + root, 1.0)
    return np.where(distance < reach, 0.0, np.where(meets, np.maximum(time, 0.0), np.inf))
