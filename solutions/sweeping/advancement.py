"""Conservative advancement to the first contact of two bodies (slide 10).

Each round finds a direction along which the bodies are apart, and a time for
which they surely stay apart along it. Nothing can happen within that time, so
the clock advances by it, and the next round looks again. No contact is
skipped, whichever direction is found. A poor direction costs more rounds, but
never an impact.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import in_space
from solutions.sweeping.motion import extent, motion_bound, rotated
from solutions.sweeping.nearest import point_set, separation_of_hulls
from solutions.sweeping.rounds import (
    Look,
    Pairs,
    advance_all,
    flat,
    free_time,
    or_undecided,
    touching,
)

LOOKS = 1000
"""Number of looks at a pair. If it needs more, it is undecided or goes on."""
PATIENCE = 4
"""How many times as many looks a pair may take that keeps a steady pace."""
HALVINGS = 16
"""How often the interval is halved in which a free time is searched."""


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
    tolerance: ArrayLike | None = None,
) -> Array:
    """Time at which two convex bodies first touch within a step (slide 10).

    The bodies move and turn. A body is the convex hull of some points, grown
    by a radius. A ball is one point, a capsule two points, and a box eight.

    Parameters
    ----------
    points_a, points_b : (..., n, 3), m
        They are measured from the point about which the body turns, along the
        axes of the world, at the start of the step.
    position_a, position_b : (..., 3), the point about which the body turns, m
    velocity_a, velocity_b : (..., 3), of that point, m/s, constant over the
        step
    angular_velocity_a, angular_velocity_b : (..., 3), rad/s, constant over the
        step
    radius_a, radius_b : (...), m; 0 for sharp corners
    dt : (...), s, length of the step
    tolerance : (...), distance at which two bodies count as touching, m
        Without it, it is a millionth of the size of the smaller body, which is
        the longest edge of the box along the axes around it. If it is below
        1e-7 of the larger body's size or of the coordinates, rounding may call
        bodies touching that are farther apart than the tolerance
        (`separation_of_hulls`). The time is then early, but still never late.

    Returns
    -------
    (...), s from now, 0 to dt
        It is never later than the true contact. At this time the bodies are at
        most the tolerance apart. It is infinity where the bodies stay apart
        over the step, and 0 if they overlap or touch now. It is NaN where the
        rounds were used up before it was decided whether the bodies touch.
        They move or turn too fast then for how near to each other they are:
        two rods that spin side by side, or bodies that pass each other at
        hardly more than the tolerance.

    Warns
    -----
    UndecidedWarning
        If a time is NaN. The warning says until when these bodies surely stay
        apart.

    Raises
    ------
    ValueError
        If a radius or dt is negative or not finite, tolerance is not positive,
        a body has no points, or an array is not finite or not of three
        components.

    Notes
    -----
    The swept volume of a body has no simple shape once the body turns. A bound
    on its motion is enough instead. Suppose that the bodies are apart by s
    along a direction n. Let μ be the fastest speed at which they can approach
    each other along n, which is the sum of both bodies' `motion_bound`. The
    gap along n then shrinks by at most μ t in a time t, so that the bodies
    stay apart for at least

        s/μ

    A body that turns does not keep up this speed. Each of its corners moves on
    a circle, so that its height along n rises and falls like a cosine. After a
    time t, no corner has risen above H(t), the largest height that any corner
    has had until then. H is known exactly (`_Turning.highest`). With u, the
    speed at which the points about which the bodies turn approach each other
    along n, the bodies therefore stay apart as long as

        u t + H_A(t) − H_A(0) + H_B(t) − H_B(0) < s    (0 for u, if they move
        apart)

    The left side never falls, so that halving an interval finds how long that
    is. A rod that spins beside a wall and never reaches it is then free for
    ever, at once.

    Each round advances the clock by the longer one of these two times, or by a
    little less, so that half the tolerance is left. This keeps the bodies
    apart, and it makes every round advance by a time above zero. The rounds
    end when the gap is at most the tolerance, or when the step is over.

    Neither time knows that two bodies keep in step with each other. Two rods
    that spin alike, side by side, may never meet. Yet each bound lets one of
    them point at the other soon, so that every turn takes some twenty rounds.
    After 1000 rounds only those pairs are continued that reach the end of the
    step within 4000 rounds at their pace so far.
    """
    shapes = [np.shape(points_a)[:-2], np.shape(points_b)[:-2]]
    motions = (
        position_a,
        velocity_a,
        angular_velocity_a,
        position_b,
        velocity_b,
        angular_velocity_b,
    )
    shapes += [np.shape(value)[:-1] for value in motions]
    shapes += [
        np.shape(value)
        for value in (
            radius_a,
            radius_b,
            dt,
            0.0 if tolerance is None else tolerance,
        )
    ]
    shape = np.broadcast_shapes(*shapes)
    a = _Body.of(
        "a",
        shape,
        points_a,
        position_a,
        velocity_a,
        angular_velocity_a,
        radius_a,
    )
    b = _Body.of(
        "b",
        shape,
        points_b,
        position_b,
        velocity_b,
        angular_velocity_b,
        radius_b,
    )
    end = flat(extent("dt", dt), shape)
    near = touching(tolerance, shape, a.size, b.size, a.far_from(b))

    def look(pairs: Pairs, time: Array) -> tuple[Array, Array]:
        corners_a, corners_b = a.corners(pairs, time), b.corners(pairs, time)
        place_a, place_b = a.place(pairs, time), b.place(pairs, time)
        separation, normal = separation_of_hulls(
            corners_a + place_a, corners_b + place_b
        )
        separation = separation - a.radius[pairs] - b.radius[pairs]
        room, left = separation - near[pairs] / 2, end[pairs] - time
        least = free_time(
            room, a.bound(pairs, -normal) + b.bound(pairs, normal)
        )
        approach = np.vecdot(normal, b.velocity[pairs] - a.velocity[pairs])
        turning = [
            _Turning.of(corners_a, a.angular_velocity[pairs], -normal),
            _Turning.of(corners_b, b.angular_velocity[pairs], normal),
        ]
        return separation, np.maximum(
            least, _time_within(room, approach, turning, least, left)
        )

    time, undecided = _advance_patiently(look, end, near)
    return or_undecided(time, undecided).reshape(shape)


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
            flat(
                in_space(f"angular_velocity_{name}", angular_velocity),
                shape,
                (3,),
            ),
            flat(extent(f"radius_{name}", radius), shape),
        )

    @property
    def size(self) -> Array:
        """Longest edge of the box along the axes around each body (N,), m."""
        return np.asarray(
            np.ptp(self.points, axis=-2).max(axis=-1) + 2 * self.radius
        )

    def far_from(self, other: _Body) -> Array:
        """Distances (N,) between the first corners of two bodies, m."""
        ways = (
            self.position
            + self.points[:, 0]
            - other.position
            - other.points[:, 0]
        )
        return np.asarray(np.linalg.norm(ways, axis=-1))

    def place(self, pairs: Pairs, time: Array) -> Array:
        """Points (N, 1, 3) about which some bodies turn, at a time, m."""
        return np.asarray(
            self.position[pairs] + self.velocity[pairs] * time[:, None]
        )[:, None, :]

    def corners(self, pairs: Pairs, time: Array) -> Array:
        """Points of some bodies at a time, from where they turn about, m."""
        turn = self.angular_velocity[pairs] * time[:, None]
        return rotated(self.points[pairs], turn[:, None, :])

    def bound(self, pairs: Pairs, normal: Array) -> Array:
        """Fastest that any point of some bodies moves along a direction."""
        reach = np.linalg.norm(self.points[pairs], axis=-1).max(axis=-1)
        # Where the normal is zero the bodies overlap, and nobody needs a
        # bound.
        apart = np.vecdot(normal, normal) > 0.5
        along = np.where(apart[:, None], normal, np.array([0.0, 0.0, 1.0]))
        return motion_bound(
            self.velocity[pairs], self.angular_velocity[pairs], reach, along
        )


@dataclass(frozen=True)
class _Turning:
    """How high the corners of turning bodies rise along a direction.

    A corner at r has the height n·r. While it turns by an angle θ, its height
    is

        along + amplitude · cos(θ − peak)

    along : (N, n), height of the centre of the corner's circle, m
    amplitude : (N, n), m
    peak : (N, n), angle until the corner is highest, 0 to 2π
    speed : (N, 1), of the turn, rad/s
    """

    along: Array
    amplitude: Array
    peak: Array
    speed: Array

    @classmethod
    def of(
        cls, corners: Array, angular_velocity: Array, direction: Array
    ) -> _Turning:
        """Corners (N, n, 3) that turn at (N, 3), seen along (N, 3)."""
        speed = np.linalg.norm(angular_velocity, axis=-1, keepdims=True)
        axis = (angular_velocity / np.where(speed > 0, speed, 1.0))[:, None, :]
        n = direction[:, None, :]
        along = np.vecdot(corners, axis) * np.vecdot(axis, n)
        now = np.vecdot(corners, n) - along
        quarter = np.vecdot(corners, np.cross(n, axis))
        peak = np.arctan2(quarter, now)
        return cls(
            along,
            np.hypot(now, quarter),
            np.where(peak < 0, peak + 2 * np.pi, peak),
            speed,
        )

    def highest(self, time: Array) -> Array:
        """Largest height (N,) of any corner from now until a time (N,), m."""
        angle = self.speed * time[:, None]
        # Before its peak, a corner may fall and rise. It is highest now or in
        # the end.
        ends = np.maximum(np.cos(self.peak), np.cos(self.peak - angle))
        return np.asarray(
            (
                self.along
                + self.amplitude * np.where(angle >= self.peak, 1.0, ends)
            ).max(axis=-1)
        )


def _time_within(
    room: Array,
    approach: Array,
    turning: Sequence[_Turning],
    least: Array,
    left: Array,
) -> Array:
    """How long two bodies surely keep some room along a direction, by halving.

    It is infinity if that is longer than what is left of the step.
    """
    start = sum(body.highest(np.zeros(room.shape)) for body in turning)

    def used_up(time: Array) -> Array:
        return np.asarray(
            np.maximum(approach, 0.0) * time
            + sum(body.highest(time) for body in turning)
            - start
        )

    fits = used_up(left) < room
    low, high = np.minimum(least, left), left
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        safe = used_up(middle) < room
        low, high = np.where(safe, middle, low), np.where(safe, high, middle)
    return np.where(fits, np.inf, low)


def _advance_patiently(
    look: Look, dt: Array, tolerance: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Advance, with more rounds for pairs whose pace ends the step."""
    began = np.zeros(dt.shape)
    time, undecided = advance_all(look, dt, tolerance, began, LOOKS)
    for more in range(PATIENCE - 1, 0, -1):
        pairs = np.flatnonzero(undecided)
        pairs = pairs[
            dt[pairs] - time[pairs] < more * (time[pairs] - began[pairs])
        ]
        if not pairs.size:
            break
        began = time
        time, still_open = advance_all(
            look, dt, tolerance, began, LOOKS, pairs
        )
        undecided[pairs] = still_open[pairs]
    return time, undecided
