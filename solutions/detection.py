"""Detecting a collision with a plane: where a point stands, and when it gets there (slides 4 and 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def signed_distance(point: ArrayLike, normal: ArrayLike, offset: ArrayLike) -> Array:
    """Distance of a point from the plane n·p + d = 0, negative behind it (slide 4).

    The slide's a x + b y + c z + d is this distance only when ‖n‖ = 1; dividing by ‖n‖ makes it one for any n.

    Parameters
    ----------
    point : (..., 3), m
    normal : (..., 3), any length but zero
    offset : (...), d in n·p + d = 0; m when the normal has unit length

    Returns
    -------
    (...), m

    Raises
    ------
    ValueError
        If a normal is zero: a plane without a direction has no sides.
    """
    normal = np.asarray(normal, dtype=float)
    length = np.linalg.norm(normal, axis=-1)
    if np.any(length == 0):
        raise ValueError("normal is zero: the plane has no direction")
    return np.asarray((np.sum(normal * np.asarray(point, dtype=float), axis=-1) + offset) / length)


def is_colliding(separation: ArrayLike, tolerance: ArrayLike = 0.0) -> NDArray[np.bool_]:
    """Whether a point is on the wrong side of the plane by more than a tolerance (slide 4).

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative; with 0 a point exactly on the plane is not colliding, as on the slide

    Returns
    -------
    (...), bool
    """
    return np.asarray(np.asarray(separation) < -np.asarray(tolerance))


def time_of_impact_interpolated(separation_0: ArrayLike, separation_1: ArrayLike, t: ArrayLike, dt: ArrayLike) -> Array:
    """Time at which the separation reaches zero if it changes at a steady rate over the step (slide 5).

    The slide writes T = t + Δt d1/(d1 + d2) with magnitudes d1, d2. With signed distances d1 = s0 and d2 = −s1:

        T = t + Δt s0/(s0 − s1)

    Under gravity the true path is curved and T is early, by up to g Δt²/(8 v).

    Parameters
    ----------
    separation_0 : (...), m, at the start of the step, not negative
    separation_1 : (...), m, at its end
    t : (...), s, start of the step
    dt : (...), s, its length

    Returns
    -------
    (...), s; infinity where the step does not end behind the plane. A point that starts on the plane and goes
    through has T = t.
    """
    s0, s1 = np.asarray(separation_0, dtype=float), np.asarray(separation_1, dtype=float)
    t, dt = np.asarray(t, dtype=float), np.asarray(dt, dtype=float)
    crosses = (s0 >= 0) & (s1 < 0)
    fraction = s0 / np.where(crosses, s0 - s1, 1.0)
    return np.where(crosses, t + dt * fraction, np.inf)


def time_of_impact_exact(separation: ArrayLike, normal_velocity: ArrayLike, normal_acceleration: ArrayLike) -> Array:
    """Time until the separation s + u t + a t²/2 next falls through zero, with a constant acceleration.

    The root is written so that no two nearly equal numbers are subtracted:

        t = (u + √(u² − 2 a s))/(−a)   when u ≥ 0 (a < 0: it rises, then falls)
        t = 2 s/(√(u² − 2 a s) − u)    when u < 0

    Parameters
    ----------
    separation : (...), s, m; a body on the plane or by rounding just behind it counts as on it
    normal_velocity : (...), u, m/s, positive when moving away
    normal_acceleration : (...), a, m/s², negative towards the plane

    Returns
    -------
    (...), s from now; infinity where the body never comes down to the plane. A body on the plane that moves away
    gets the time of its return, one that moves in gets 0.
    """
    s = np.maximum(np.asarray(separation, dtype=float), 0.0)
    u, a = np.asarray(normal_velocity, dtype=float), np.asarray(normal_acceleration, dtype=float)
    discriminant = u * u - 2 * a * s
    root = np.sqrt(np.maximum(discriminant, 0.0))
    rising = u >= 0
    denominator = np.where(rising, -a, root - u)
    arrives = (discriminant >= 0) & (denominator > 0)
    return np.where(arrives, np.where(rising, u + root, 2 * s) / np.where(arrives, denominator, 1.0), np.inf)
