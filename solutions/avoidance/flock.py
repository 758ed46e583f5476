"""A flock after Reynolds: its rules and its step (slide 1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.avoidance.directions import limited
from solutions.avoidance.neighbours import neighbour_pairs
from solutions.checks import not_negative, positive


def separation(
    position: ArrayLike, first: ArrayLike, second: ArrayLike
) -> Array:
    """Push away from the neighbours, most of all from the near ones (slide 1).

    Each neighbour adds a push that points away from it and whose size is one
    over the distance.

    Parameters
    ----------
    position : (n, d), m
    first, second : (pairs,), indices of neighbours, each pair once

    Returns
    -------
    (n, d), 1/m
        Zero without neighbours. Neighbours at the same place have no direction
        from each other and do not count.

    Notes
    -----
    The sum runs over the neighbours j of i:

        Σ (p_i − p_j)/‖p_i − p_j‖²

    What i feels from j is the opposite of what j feels from i. Over the whole
    flock the pushes therefore add up to zero.
    """
    p, i, j = (
        np.asarray(position, dtype=float),
        np.asarray(first),
        np.asarray(second),
    )
    apart = p[i] - p[j]
    squared = np.sum(apart * apart, axis=-1, keepdims=True)
    push = apart / np.where(squared > 0, squared, 1.0)
    return _sum_over_neighbours(len(p), i, j, push, -push)


def towards_mean(
    value: ArrayLike, first: ArrayLike, second: ArrayLike
) -> Array:
    """Mean of the neighbours' values minus the own value (slide 1).

    Of the velocities it is *alignment*, and of the positions it is *cohesion*.

    Parameters
    ----------
    value : (n, d), positions in m or velocities in m/s
    first, second : (pairs,), indices of neighbours, each pair once

    Returns
    -------
    (n, d), in the unit of the values
        Zero without neighbours.

    Notes
    -----
    Each pair (i, j) adds x_j − x_i for i, and x_i − x_j for j. Divided by the
    number of neighbours, the sum is the mean of their values minus the own
    value. A sum of differences keeps its digits far from the origin, where a
    mean of positions loses them.
    """
    x, i, j = (
        np.asarray(value, dtype=float),
        np.asarray(first),
        np.asarray(second),
    )
    towards = x[j] - x[i]
    total = _sum_over_neighbours(len(x), i, j, towards, -towards)
    count = np.bincount(i, minlength=len(x)) + np.bincount(j, minlength=len(x))
    return np.asarray(total / np.maximum(count, 1)[:, None])


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

    The acceleration is the weighted sum of separation, alignment and cohesion,
    shortened to its limit. The new velocity is shortened to the speed limit,
    and the positions move with it.

    Parameters
    ----------
    position, velocity : (n, d), m, m/s, d = 2 or 3
    dt : s, positive
    radius : m, positive, the distance up to which a boid sees others
    weights : of separation, m²/s², of alignment, 1/s, and of cohesion, 1/s²
    max_speed, max_acceleration : m/s, m/s², not negative

    Returns
    -------
    position, velocity : (n, d) each, m and m/s

    Raises
    ------
    ValueError
        If the step or the radius is not positive, a limit is negative, a
        position is not finite, or the shapes do not fit.

    Notes
    -----
    With the weights w_s, w_a, w_c and the limits a_max and v_max, the step is

        a = w_s separation + w_a alignment + w_c cohesion, shortened to a_max
        v' = v + a dt, shortened to v_max;    p' = p + v' dt

    Separation is in 1/m, alignment in m/s and cohesion in m. The units of the
    weights turn each of them into an acceleration.
    """
    p, v, dt = (
        np.asarray(position, dtype=float),
        np.asarray(velocity, dtype=float),
        float(positive("dt", dt)),
    )
    max_speed = float(not_negative("max_speed", max_speed))
    max_acceleration = float(
        not_negative("max_acceleration", max_acceleration)
    )
    if v.shape != p.shape:
        raise ValueError(
            f"velocity must have the shape {p.shape} of the positions,"
            f" not {v.shape}"
        )
    pairs = neighbour_pairs(p, radius)
    apart, along, together = weights
    wanted = (
        apart * separation(p, *pairs)
        + along * towards_mean(v, *pairs)
        + together * towards_mean(p, *pairs)
    )
    v = limited(v + limited(wanted, max_acceleration) * dt, max_speed)
    return p + v * dt, v


def _sum_over_neighbours(
    n: int, i: Array, j: Array, on_i: Array, on_j: Array
) -> Array:
    axes = zip(on_i.T, on_j.T, strict=True)
    return np.stack(
        [np.bincount(i, a, n) + np.bincount(j, b, n) for a, b in axes], axis=-1
    )
