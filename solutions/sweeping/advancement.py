"""Conservative advancement to the first contact of two moving bodies (slide 10).

Each round finds a direction along which the bodies are apart, and a time for which they
surely stay apart along it. Nothing can happen within that time, so the clock advances
by it, and the next round looks again. No contact is skipped, whichever direction is
found. A poor direction costs more rounds, but never an impact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import in_space, positive
from solutions.scaling import length_of
from solutions.sweeping.motion import extent, motion_bound, rotated
from solutions.sweeping.nearest import point_set, separation_of_hulls

Pairs = NDArray[np.int64]
Look = Callable[[Pairs, Array], tuple[Array, Array]]
"""A function of the numbers of some pairs, and of a time for each of them.

It returns how far each pair is apart at least, m. It also returns for how long the pair
surely stays at least half the tolerance apart, s.
"""
TOLERANCE = 1e-6
"""Distance at which two bodies count as touching, m."""
STEPS = 1000
"""Largest number of rounds.

After them, the time that was reached is the result: it is early, never late.
"""


def sweep_convex(
    points_a: ArrayLike,
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    angular_velocity_a: ArrayLike,
    radius_a: ArrayLike,
    points_b: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    angular_velocity_b: ArrayLike,
    radius_b: ArrayLike,
    dt: ArrayLike,
    tolerance: ArrayLike = TOLERANCE,
) -> Array:
    """Time at which two convex bodies first touch within a step (slide 10).

    The bodies move and turn. A body is the convex hull of some points, grown by a
    radius. A ball is one point, a capsule two points, and a box eight.

    Parameters
    ----------
    points_a, points_b : (..., n, 3), m
        They are measured from the point about which the body turns, along the axes of
        the world, at the start of the step.
    position_a, position_b : (..., 3), the point about which the body turns, m
    velocity_a, velocity_b : (..., 3), of that point, m/s, constant over the step
    angular_velocity_a, angular_velocity_b : (..., 3), rad/s, constant over the step
    radius_a, radius_b : (...), m; 0 for sharp corners
    dt : (...), s, length of the step
    tolerance : (...), distance at which two bodies count as touching, m
        If it is below 1e-7 of the bodies' size and coordinates, rounding may call
        bodies touching that are farther apart than the tolerance
        (`separation_of_hulls`). The time is then early, but still never late.

    Returns
    -------
    (...), s from now, 0 to dt
        It is never later than the true contact. At this time the bodies are at most the
        tolerance apart. If 1000 rounds are not enough, the time is earlier still. It is
        infinity where the bodies stay apart over the step, and 0 if they overlap or
        touch now.

    Raises
    ------
    ValueError
        If a radius or dt is negative or not finite, tolerance is not positive, a body
        has no points, or an array is not finite or not of three components.

    Notes
    -----
    The swept volume of a body has no simple shape once the body turns. A bound on its
    motion is enough instead. Suppose that the bodies are apart by s along a direction
    n. Let μ be the fastest speed at which they can approach each other along n, which
    is the sum of both bodies' `motion_bound`. The gap along n then shrinks by at most
    μ t in a time t, so that the bodies stay apart for at least

        s/μ

    Each round advances the clock by a little less, so that half the tolerance is left.
    This keeps the bodies apart, and it makes every round advance by a time above zero.
    The rounds end when the gap is at most the tolerance, or when the step is over.
    """
    shapes = [np.shape(points_a)[:-2], np.shape(points_b)[:-2]]
    motions = (position_a, velocity_a, angular_velocity_a, position_b, velocity_b, angular_velocity_b)
    shapes += [np.shape(value)[:-1] for value in motions]
    shape = np.broadcast_shapes(*shapes, *(np.shape(value) for value in (radius_a, radius_b, dt, tolerance)))
    a = _Body.of("a", shape, points_a, position_a, velocity_a, angular_velocity_a, radius_a)
    b = _Body.of("b", shape, points_b, position_b, velocity_b, angular_velocity_b, radius_b)
    end, near = flat(extent("dt", dt), shape), flat(positive("tolerance", tolerance), shape)

    def look(pairs: Pairs, time: Array) -> tuple[Array, Array]:
        separation, normal = separation_of_hulls(a.at(pairs, time), b.at(pairs, time))
        separation = separation - a.radius[pairs] - b.radius[pairs]
        closing = a.bound(pairs, -normal) + b.bound(pairs, normal)
        return separation, free_time(separation - near[pairs] / 2, closing)

    return advance(look, end, near).reshape(shape)


@dataclass(frozen=True)
class _Body:
    """Many bodies in one row: arrays (N, n, 3), (N, 3) and (N,)."""

    points: Array
    position: Array
    velocity: Array
    angular_velocity: Array
    radius: Array

    @classmethod
    def of(
        cls,
        name: str,
        shape: tuple[int, ...],
        points: ArrayLike,
        position: ArrayLike,
        velocity: ArrayLike,
        angular_velocity: ArrayLike,
        radius: ArrayLike,
    ) -> _Body:
        corners = point_set(f"points_{name}", points)
        return cls(
            flat(corners, shape, corners.shape[-2:]),
            flat(in_space(f"position_{name}", position), shape, (3,)),
            flat(in_space(f"velocity_{name}", velocity), shape, (3,)),
            flat(in_space(f"angular_velocity_{name}", angular_velocity), shape, (3,)),
            flat(extent(f"radius_{name}", radius), shape),
        )

    def at(self, pairs: Pairs, time: Array) -> Array:
        """Points of some of the bodies at a time, m."""
        turn = self.angular_velocity[pairs] * time[:, None]
        place = self.position[pairs] + self.velocity[pairs] * time[:, None]
        return place[:, None, :] + rotated(self.points[pairs], turn[:, None, :])

    def bound(self, pairs: Pairs, normal: Array) -> Array:
        """Fastest that any point of some of the bodies moves along a direction, m/s."""
        reach = length_of(self.points[pairs]).max(axis=-1)
        # Where the normal is zero the bodies overlap, and nobody needs a bound.
        apart = np.vecdot(normal, normal) > 0.5
        along = np.where(apart[:, None], normal, np.array([0.0, 0.0, 1.0]))
        return motion_bound(self.velocity[pairs], self.angular_velocity[pairs], reach, along)


def free_time(separation: Array, closing: Array) -> Array:
    """Time until a separation that shrinks at most this fast is used up.

    It is infinity if the separation does not shrink.
    """
    shrinks = closing > 0
    # At a crawl the time may be longer than any float: infinity stands for it.
    with np.errstate(over="ignore"):
        return np.where(shrinks, separation / np.where(shrinks, closing, 1.0), np.inf)


def advance(look: Look, dt: Array, tolerance: Array) -> Array:
    """Advance from one look to the next until the pair touches or the step is over."""
    time, pairs = np.zeros(dt.shape), np.arange(dt.size)
    for _ in range(STEPS):
        separation, free = look(pairs, time[pairs])
        apart = separation > tolerance[pairs]
        pairs, free = pairs[apart], free[apart]
        time[pairs] += free
        over = time[pairs] > dt[pairs]
        time[pairs[over]] = np.inf
        pairs = pairs[~over]
        if not pairs.size:
            break
    return time


def flat(value: Array, shape: tuple[int, ...], core: tuple[int, ...] = ()) -> Array:
    """Broadcast over the leading axes and lay these in one row."""
    return np.broadcast_to(value, shape + core).reshape(-1, *core)
