"""A flock after Reynolds: its rules and its step (slide 1)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.avoidance.directions import limited
from solutions.avoidance.domain import (
    Flock,
    Indices,
    OneNotNegative,
    OnePositive,
)
from solutions.avoidance.neighbours import neighbour_pairs
from solutions.domain import Number, domain, require
from solutions.vectors import quotient


@domain
def separation(position: Number, first: Indices, second: Indices) -> Array:
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
    apart = position[first] - position[second]
    squared = np.sum(apart * apart, axis=-1, keepdims=True)
    push = quotient(apart, squared)
    return _sum_over_neighbours(len(position), first, second, push, -push)


@domain
def towards_mean(value: Number, first: Indices, second: Indices) -> Array:
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
    n = len(value)
    towards = value[second] - value[first]
    total = _sum_over_neighbours(n, first, second, towards, -towards)
    count = np.bincount(first, minlength=n) + np.bincount(second, minlength=n)
    return total / np.maximum(count, 1)[:, None]


@domain
def flock_step(
    position: Flock,
    velocity: Number,
    dt: OnePositive,
    radius: OnePositive,
    weights: tuple[float, float, float],
    max_speed: OneNotNegative,
    max_acceleration: OneNotNegative,
) -> tuple[Array, Array]:
    """State of a flock after one step of semi-implicit Euler (slide 1).

    The acceleration is the weighted sum of separation, alignment and cohesion,
    shortened to its limit. The new velocity is shortened to the speed limit,
    and the positions move with it.

    Parameters
    ----------
    position, velocity : (n, d), m, m/s, d = 2 or 3
    dt : one number, s, positive
    radius : one number, m, positive
        It is the distance up to which a boid sees others.
    weights : three numbers
        They are w_s of separation, in m²/s², w_a of alignment, in 1/s, and w_c
        of cohesion, in 1/s².
    max_speed, max_acceleration : one number, m/s, m/s², not negative

    Returns
    -------
    position, velocity : (n, d) each, m and m/s

    Raises
    ------
    ValueError
        If position and velocity do not have the same shape.

    Notes
    -----
    With the weights w_s, w_a, w_c and the limits a_max and v_max, the step is

        a = w_s separation + w_a alignment + w_c cohesion, shortened to a_max
        v' = v + a dt, shortened to v_max
        p' = p + v' dt

    Separation is in 1/m, alignment in m/s and cohesion in m. The units of the
    weights turn each of them into an acceleration.
    """
    of_positions, shape = position.shape, velocity.shape
    shapes = f"the shape {of_positions} of the positions, not {shape}"
    require(shape == of_positions, f"velocity must have {shapes}")
    pairs = neighbour_pairs(position, radius)
    w_s, w_a, w_c = weights
    a = (
        w_s * separation(position, *pairs)
        + w_a * towards_mean(velocity, *pairs)
        + w_c * towards_mean(position, *pairs)
    )
    v = velocity + limited(a, max_acceleration) * dt
    v = limited(v, max_speed)
    return position + v * dt, v


def _sum_over_neighbours(
    n: int, i: Integers, j: Integers, on_i: Array, on_j: Array
) -> Array:
    """Sum (n, d) of what each pair (i, j) adds to i and to j."""
    axes = zip(on_i.T, on_j.T, strict=True)
    sums = [np.bincount(i, a, n) + np.bincount(j, b, n) for a, b in axes]
    return np.stack(sums, axis=-1)
