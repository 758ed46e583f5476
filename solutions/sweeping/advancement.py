"""Conservative advancement: go on by a time in which nothing can happen, look again (slide 10).

Each round finds a direction along which the bodies are apart, and how long they surely stay so. Whatever direction it
is, no contact is skipped: a poor one costs rounds and never an impact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import positive
from solutions.sweeping.motion import extent, in_space, motion_bound, rotated
from solutions.sweeping.nearest import point_set, separation_of_hulls

Array = NDArray[np.float64]
Pairs = NDArray[np.int64]
Look = Callable[[Pairs, Array], tuple[Array, Array]]
"""Of the pairs with these numbers at these times: how far apart at least, m, and how long they surely keep half the
tolerance, s."""
TOLERANCE = 1e-6
"""How near is a touch, m."""
STEPS = 1000
"""After these the time that was reached is the answer: early, never late."""


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
    """Time at which two convex bodies that move and turn first touch within a step (slide 10).

    A body is the hull of some points, grown by a radius: a ball is one point, a capsule two, a box eight. Its swept
    volume has no simple shape once it turns; a bound on its motion is enough. Apart by s along n, with μ the fastest
    approach along n (`motion_bound`), they stay apart for s/μ.

    Parameters
    ----------
    points_a, points_b : (..., n, 3), from the point about which the body turns, in the world's directions now, m
    position_a, position_b : (..., 3), that point, m
    velocity_a, velocity_b : (..., 3), m/s
    angular_velocity_a, angular_velocity_b : (..., 3), rad/s, constant over the step
    radius_a, radius_b : (...), m; 0 for sharp corners
    dt : (...), s, length of the step
    tolerance : (...), how near is a touch, m. Below 1e-7 of the bodies' size and coordinates rounding may call a touch
        what is farther apart (`separation_of_hulls`): the time stays early

    Returns
    -------
    (...), s from now, 0 to dt; infinity where they stay apart. Never later than the true contact; at the time given
    they are at most the tolerance apart (after 1000 rounds it is earlier still). 0 if they overlap or touch now.

    Raises
    ------
    ValueError
        If a radius or dt is negative, tolerance is not positive, a body has no points, or an array is not finite or
        not in space.
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
        """Points of some of them at a time, m."""
        turn = self.angular_velocity[pairs] * time[:, None]
        place = self.position[pairs] + self.velocity[pairs] * time[:, None]
        return place[:, None, :] + rotated(self.points[pairs], turn[:, None, :])

    def bound(self, pairs: Pairs, normal: Array) -> Array:
        """Fastest that any point of some of them moves along a direction, m/s."""
        reach = np.linalg.norm(self.points[pairs], axis=-1).max(axis=-1)
        apart = np.vecdot(normal, normal) > 0.5  # a zero normal: they overlap, and no bound is asked for
        along = np.where(apart[:, None], normal, np.array([0.0, 0.0, 1.0]))
        return motion_bound(self.velocity[pairs], self.angular_velocity[pairs], reach, along)


def free_time(separation: Array, closing: Array) -> Array:
    """Time until a separation that shrinks at most this fast is used up; infinity if it does not shrink."""
    shrinks = closing > 0
    with np.errstate(over="ignore"):  # at a crawl that is after any number of seconds: infinity will do
        return np.where(shrinks, separation / np.where(shrinks, closing, 1.0), np.inf)


def advance(look: Look, dt: Array, tolerance: Array) -> Array:
    """Go on from look to look until the pair touches or the step is over."""
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
