"""A flock: Reynolds' separation, alignment and cohesion among neighbours, and a step of them together (slide 1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.avoidance.directions import limited
from solutions.avoidance.neighbours import neighbour_pairs
from solutions.checks import not_negative, positive

Array = NDArray[np.float64]


def separation(position: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Away from the neighbours, from the near ones most: Σ (p_i − p_j)/‖p_i − p_j‖² (slide 1).

    What i feels from j is the opposite of what j feels from i, so over the whole flock it adds up to zero.

    Parameters
    ----------
    position : (n, d), m
    first, second : (pairs,), indices of neighbours, each pair once

    Returns
    -------
    (n, d), 1/m; neighbours at the same place have no direction from each other and do not count
    """
    p, i, j = np.asarray(position, dtype=float), np.asarray(first), np.asarray(second)
    apart = p[i] - p[j]
    squared = np.sum(apart * apart, axis=-1, keepdims=True)
    push = apart / np.where(squared > 0, squared, 1.0)
    return _sum_over_neighbours(len(p), i, j, push, -push)


def alignment(velocity: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """From the own velocity to the mean one of the neighbours (slide 1).

    Parameters
    ----------
    velocity : (n, d), m/s
    first, second : (pairs,), indices of neighbours, each pair once

    Returns
    -------
    (n, d), m/s; zero without neighbours
    """
    return _to_the_mean(velocity, first, second)


def cohesion(position: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """From the own position to the mean one of the neighbours (slide 1).

    Parameters
    ----------
    position : (n, d), m
    first, second : (pairs,), indices of neighbours, each pair once

    Returns
    -------
    (n, d), m; zero without neighbours
    """
    return _to_the_mean(position, first, second)


def flock_step(
    position: ArrayLike,
    velocity: ArrayLike,
    dt: float,
    radius: float,
    weights: tuple[float, float, float],
    max_speed: float,
    max_acceleration: float,
) -> tuple[Array, Array]:
    """State of a flock after one step of semi-implicit Euler (slide 1).

        a = w_s separation + w_a alignment + w_c cohesion, shortened to a_max
        v' = v + a dt, shortened to v_max;    p' = p + v' dt

    Parameters
    ----------
    position, velocity : (n, d), m, m/s, d = 2 or 3
    dt : s, positive
    radius : m, how far a boid sees, positive
    weights : of separation, m²/s², of alignment, 1/s, and of cohesion, 1/s²
    max_speed, max_acceleration : m/s, m/s², not negative

    Returns
    -------
    position, velocity : (n, d) each

    Raises
    ------
    ValueError
        If the step or the radius is not positive, a limit is negative, a position is not finite, or the
        shapes do not fit.
    """
    p, v, dt = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float), float(positive("dt", dt))
    max_speed = float(not_negative("max_speed", max_speed))
    max_acceleration = float(not_negative("max_acceleration", max_acceleration))
    if v.shape != p.shape:
        raise ValueError(f"velocity must have the shape {p.shape} of the positions, not {v.shape}")
    pairs = neighbour_pairs(p, radius)
    apart, along, together = weights
    wanted = apart * separation(p, *pairs) + along * alignment(v, *pairs) + together * cohesion(p, *pairs)
    v = limited(v + limited(wanted, max_acceleration) * dt, max_speed)
    return p + v * dt, v


def _to_the_mean(value: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Mean difference to the neighbours: the same as their mean less the own, but exact far from the origin."""
    x, i, j = np.asarray(value, dtype=float), np.asarray(first), np.asarray(second)
    towards = x[j] - x[i]
    count = np.bincount(i, minlength=len(x)) + np.bincount(j, minlength=len(x))
    return np.asarray(_sum_over_neighbours(len(x), i, j, towards, -towards) / np.maximum(count, 1)[:, None])


def _sum_over_neighbours(n: int, i: Array, j: Array, on_i: Array, on_j: Array) -> Array:
    axes = zip(on_i.T, on_j.T, strict=True)
    return np.stack([np.bincount(i, a, n) + np.bincount(j, b, n) for a, b in axes], axis=-1)
