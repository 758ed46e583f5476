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

from solutions.arrays import Array, Booleans
from solutions.domain import FiniteNotNegative, Positive, Vector, domain
from solutions.sweeping.domain import Points
from solutions.sweeping.motion import motion_bound, rotated
from solutions.sweeping.nearest import separation_of_hulls
from solutions.sweeping.rounds import (
    Look,
    Pairs,
    advance_all,
    flat,
    free_time,
    or_undecided,
    touching,
)
from solutions.vectors import quotient

LOOKS = 1000
"""Number of looks at a pair. If it needs more, it is undecided or goes on."""
PATIENCE = 4
"""How many times as many looks a pair may take that keeps a steady pace."""
HALVINGS = 16
"""How often the interval is halved in which a free time is searched."""


@domain
def sweep_convex(
    points_a: Points,
    position_a: Vector,
    velocity_a: Vector,
    angular_velocity_a: Vector,
    radius_a: FiniteNotNegative,
    points_b: Points,
    position_b: Vector,
    velocity_b: Vector,
    angular_velocity_b: Vector,
    radius_b: FiniteNotNegative,
    dt: FiniteNotNegative,
    tolerance: Positive | None = None,
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
    velocity_a, velocity_b : (..., 3), of that point, m/s
        It is constant over the step.
    angular_velocity_a, angular_velocity_b : (..., 3), rad/s
        It is constant over the step.
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

        u t + H_A(t) − H_A(0) + H_B(t) − H_B(0) < s

    with 0 in place of u if these points move apart. The left side never falls,
    so that halving an interval finds how long that is. A rod that spins beside
    a wall and never reaches it is then free for ever, at once.

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
    a = _Body(points_a, position_a, velocity_a, angular_velocity_a, radius_a)
    b = _Body(points_b, position_b, velocity_b, angular_velocity_b, radius_b)
    of_tolerance = () if tolerance is None else tolerance.shape
    shape = np.broadcast_shapes(a.shape, b.shape, dt.shape, of_tolerance)
    a, b = a.in_a_row(shape), b.in_a_row(shape)
    end = flat(dt, shape)
    near = touching(tolerance, shape, a.size, b.size, a.far_from(b))

    def look(pairs: Pairs, time: Array) -> tuple[Array, Array]:
        corners_a, corners_b = a.corners(pairs, time), b.corners(pairs, time)
        separation, normal = separation_of_hulls(
            corners_a + a.place(pairs, time), corners_b + b.place(pairs, time)
        )
        separation = separation - a.radius[pairs] - b.radius[pairs]
        room, left = separation - near[pairs] / 2, end[pairs] - time
        fastest = a.bound(pairs, -normal) + b.bound(pairs, normal)
        free = free_time(room, fastest)
        approach = np.vecdot(normal, b.velocity[pairs] - a.velocity[pairs])
        turning = [
            _Turning.of(corners_a, a.angular_velocity[pairs], -normal),
            _Turning.of(corners_b, b.angular_velocity[pairs], normal),
        ]
        longer = _time_within(room, approach, turning, free, left)
        return separation, np.maximum(free, longer)

    time, undecided = _advance_patiently(look, end, near)
    return or_undecided(time, undecided).reshape(shape)


@dataclass(frozen=True)
class _Body:
    """Many bodies: arrays (..., n, 3), (..., 3) and (...)."""

    points: Array
    position: Array
    velocity: Array
    angular_velocity: Array
    radius: Array

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape (...) of all arrays together."""
        return np.broadcast_shapes(
            self.points.shape[:-2],
            self.position.shape[:-1],
            self.velocity.shape[:-1],
            self.angular_velocity.shape[:-1],
            self.radius.shape,
        )

    def in_a_row(self, shape: tuple[int, ...]) -> _Body:
        """As many bodies as the shape has places: (N, n, 3), (N, 3), (N,)."""
        return _Body(
            flat(self.points, shape, self.points.shape[-2:]),
            flat(self.position, shape, (3,)),
            flat(self.velocity, shape, (3,)),
            flat(self.angular_velocity, shape, (3,)),
            flat(self.radius, shape),
        )

    @property
    def size(self) -> Array:
        """Longest edge of the box along the axes around each body (N,), m."""
        edges = np.ptp(self.points, axis=-2)
        return edges.max(axis=-1) + 2 * self.radius

    def far_from(self, other: _Body) -> Array:
        """Distances (N,) between the first corners of two bodies, m."""
        corner = self.position + self.points[:, 0]
        apart = corner - other.position - other.points[:, 0]
        return np.linalg.norm(apart, axis=-1)

    def place(self, pairs: Pairs, time: Array) -> Array:
        """Points (N, 1, 3) about which some bodies turn, at a time, m."""
        flown = self.velocity[pairs] * time[:, None]
        return (self.position[pairs] + flown)[:, None, :]

    def corners(self, pairs: Pairs, time: Array) -> Array:
        """Points of some bodies at a time, from where they turn about, m."""
        turn = self.angular_velocity[pairs] * time[:, None]
        return rotated(self.points[pairs], turn[:, None, :])

    def bound(self, pairs: Pairs, normal: Array) -> Array:
        """Fastest that any point of some bodies moves along a direction."""
        reach = np.linalg.norm(self.points[pairs], axis=-1).max(axis=-1)
        # Where the normal is zero the bodies overlap, and no bound is needed.
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
        axis = quotient(angular_velocity, speed)[:, None, :]
        n = direction[:, None, :]
        along = np.vecdot(corners, axis) * np.vecdot(axis, n)
        now = np.vecdot(corners, n) - along
        quarter = np.vecdot(corners, np.cross(n, axis))
        peak = np.arctan2(quarter, now)
        peak = np.where(peak < 0, peak + 2 * np.pi, peak)
        return cls(along, np.hypot(now, quarter), peak, speed)

    def highest(self, time: Array) -> Array:
        """Largest height (N,) of any corner from now until a time (N,), m."""
        angle = self.speed * time[:, None]
        # Before its peak, a corner may fall and rise. It is highest now or in
        # the end.
        ends = np.maximum(np.cos(self.peak), np.cos(self.peak - angle))
        cosine = np.where(angle >= self.peak, 1.0, ends)
        return (self.along + self.amplitude * cosine).max(axis=-1)


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
        flown = np.maximum(approach, 0.0) * time
        return flown + sum(body.highest(time) for body in turning) - start

    fits = used_up(left) < room
    low, high = np.minimum(least, left), left
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        safe = used_up(middle) < room
        low = np.where(safe, middle, low)
        high = np.where(safe, high, middle)
    return np.where(fits, np.inf, low)


def _advance_patiently(
    look: Look, dt: Array, tolerance: Array
) -> tuple[Array, Booleans]:
    """Advance, with more rounds for pairs whose pace ends the step."""
    began = np.zeros(dt.shape)
    time, undecided = advance_all(look, dt, tolerance, began, LOOKS)
    for more in range(PATIENCE - 1, 0, -1):
        pairs = np.flatnonzero(undecided)
        left, covered = dt[pairs] - time[pairs], time[pairs] - began[pairs]
        pairs = pairs[left < more * covered]
        if not pairs.size:
            break
        began = time
        time, still_open = advance_all(
            look, dt, tolerance, began, LOOKS, pairs
        )
        undecided[pairs] = still_open[pairs]
    return time, undecided
