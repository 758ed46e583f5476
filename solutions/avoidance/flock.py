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
        It is not a distance: `flock_step` multiplies it by a weight, which
        makes it an acceleration. Zero without neighbours. Neighbours at the
        same place have no direction from each other and do not count.

    Notes
    -----
    The sum runs over the neighbours j of i:

        Σ (p_i − p_j)/‖p_i − p_j‖²

    What i feels from j is the opposite of what j feels from i. Over the whole
    flock the pushes therefore add up to zero.
    """
    apart = position[first] - position[second]
    distance_squared = np.sum(apart * apart, axis=-1, keepdims=True)
    push = quotient(apart, distance_squared)
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
    With the values x and the sum over the neighbours j of i, it is

        (Σ (x_j − x_i))/count

    where count is the number of these neighbours. Each pair (i, j) adds
    x_j − x_i for i, and x_i − x_j for j. A sum of differences keeps its digits
    far from the origin, where a mean of positions loses them.
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
    max_speed : one number, v_max, m/s, not negative
    max_acceleration : one number, a_max, m/s², not negative

    Returns
    -------
    position, velocity : (n, d) each, m and m/s

    Raises
    ------
    ValueError
        If position and velocity do not have the same shape.

    Notes
    -----
    The step is

        a = w_s separation + w_a alignment + w_c cohesion
        v' = v + a dt
        p' = p + v' dt

    where a is shortened to a_max, and then v' to v_max, before they are used.
    Separation is in 1/m, alignment in m/s and cohesion in m. The units of the
    weights turn each of them into an acceleration.
    """
    shapes = f"{position.shape} of the positions, not {velocity.shape}"
    words = f"velocity must have the shape {shapes}"
    require(velocity.shape == position.shape, words)
    pairs = neighbour_pairs(position, radius)
    push_apart = separation(position, *pairs)
    alignment = towards_mean(velocity, *pairs)
    cohesion = towards_mean(position, *pairs)
    w_s, w_a, w_c = weights
    a = w_s * push_apart + w_a * alignment + w_c * cohesion
    a = limited(a, max_acceleration)
    v = limited(velocity + a * dt, max_speed)
    p = position + v * dt
    return p, v


def _sum_over_neighbours(
    n: int, i: Integers, j: Integers, on_i: Array, on_j: Array
) -> Array:
    """Sum (n, d) of what each pair (i, j) adds to i and to j."""
    axes = zip(on_i.T, on_j.T, strict=True)
    sums = [np.bincount(i, a, n) + np.bincount(j, b, n) for a, b in axes]
    return np.stack(sums, axis=-1)
