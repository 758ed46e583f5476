"""A crowd of discs, each of which makes its half of every change.

This goes beyond slide 1. The method is ORCA (van den Berg, Guy, Lin and
Manocha 2011, "Reciprocal n-body collision avoidance"). All vectors lie in the
plane, (..., 2).
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.avoidance.cones import orca_half_plane
from solutions.avoidance.domain import Count, Crowd, OnePositive, Planar
from solutions.avoidance.half_planes import permitted_velocity
from solutions.avoidance.neighbours import neighbour_pairs
from solutions.domain import NotNegative, domain, require


@domain
def crowd_step(
    position: Crowd,
    velocity: Crowd,
    preferred: Planar,
    radius: NotNegative,
    max_speed: NotNegative,
    horizon: OnePositive,
    dt: OnePositive,
    neighbour_distance: NotNegative = np.inf,
    max_neighbours: Count = np.inf,
) -> tuple[Array, Array]:
    """State of a crowd of discs after a step in which they avoid each other.

    This goes beyond slide 1. Each disc takes the velocity nearest to its
    preferred one that all its half-planes permit, as `permitted_velocity`
    finds it, and moves with it for dt. How far a disc looks and how many
    neighbours it heeds may be limited, as by RVO2's neighborDist and
    maxNeighbors.

    Parameters
    ----------
    position, velocity, preferred : (n, 2), m, m/s, m/s
    radius, max_speed : (n,) or one for all, m, m/s, not negative
    horizon, dt : one number, s, positive
        The horizon is no shorter than the step, in which each disc keeps
        its velocity.
    neighbour_distance : (n,) or one for all, m, not negative
        A disc heeds no other whose centre is farther from its own.
    max_neighbours : (n,) or one for all, whole and not negative, or infinity
        A disc heeds at most that many others, the nearest ones. Of two that
        are equally near, the one with the lower index comes first.

    Returns
    -------
    position, velocity : (n, 2) each, m and m/s
        Discs that start from rest exactly head-on, two of them or a whole
        ring, stop in front of each other, because nothing names a side. A
        preferred velocity turned a little to the right sets them free.

    Raises
    ------
    ValueError
        If the horizon is shorter than the step, or the shapes do not fit.

    Notes
    -----
    Two discs need half-planes only if they could meet within the horizon when
    both fly straight at each other at full speed. The function leaves out all
    pairs that are too far apart for this, even with the largest radius and the
    highest speed of the crowd. The half-planes of A and B are mirror images:
    from `orca_half_plane` for A, the function derives the one for B with the
    same change in the opposite direction.

    With a limit, A may heed B while B does not heed A. Then only A makes its
    half of the change, and the two may collide: the promise of
    `orca_half_plane` is lost.
    """
    p, v, n = position, velocity, len(position)
    shapes = f"the shape {p.shape} of the positions, not {v.shape}"
    require(v.shape == p.shape, f"velocity must have {shapes}")
    # Else discs could meet within the step. Rounding may make equal times
    # differ: 0.3 is less than 3 · 0.1.
    times = f"no shorter than the step, {dt} s, not {horizon} s"
    require(horizon >= (1 - 1e-12) * dt, f"horizon must be {times}")
    r = np.broadcast_to(radius, n)
    speed = np.broadcast_to(max_speed, n)
    sight = np.broadcast_to(neighbour_distance, n)
    most = np.broadcast_to(max_neighbours, n)
    i, j = _who_may_meet(p, r, speed, horizon, sight)
    point, normal = orca_half_plane(
        p[i], v[i], r[i], p[j], v[j], r[j], horizon, dt
    )
    mirrored = v[j] - (point - v[i])  # the other half, in reverse
    who, whom = np.r_[i, j], np.r_[j, i]
    heeded = _heeded(p, who, whom, sight, most)
    points = np.r_[point, mirrored][heeded]
    normals = np.r_[normal, -normal][heeded]
    points, normals = _in_rows(n, who[heeded], points, normals)
    v = permitted_velocity(preferred, speed, points, normals)
    return p + v * dt, v


def _who_may_meet(
    p: Array, radius: Array, speed: Array, horizon: Array, sight: Array
) -> tuple[Integers, Integers]:
    """Pairs that may touch within the horizon, if one sees the other.

    The largest radius and the highest speed decide, for two discs that fly
    straight at each other, and the farthest sight.
    """
    reach = 2 * (radius.max(initial=0.0) + speed.max(initial=0.0) * horizon)
    reach = min(reach, sight.max(initial=0.0))
    return neighbour_pairs(p, reach if reach > 0 else 1.0)


def _heeded(
    p: Array, who: Integers, whom: Integers, sight: Array, most: Array
) -> Booleans:
    """Which entries remain if each disc heeds the nearest in its sight."""
    if np.all(np.isinf(sight)) and np.all(np.isinf(most)):
        return np.ones(len(who), dtype=bool)
    distance = np.linalg.norm(p[whom] - p[who], axis=-1)
    order = np.lexsort((whom, distance, who))
    count = np.bincount(who, minlength=len(p))
    first = np.repeat(np.cumsum(count) - count, count)
    rank = np.empty(len(who), dtype=int)  # 0 for the nearest
    rank[order] = np.arange(len(who)) - first
    return (distance <= sight[who]) & (rank < most[who])


def _in_rows(n: int, owner: Integers, *values: Array) -> list[Array]:
    """Spread values (m, 2) over rows (n, longest, 2) by their owner.

    The places in a row that are left over are zero.
    """
    order = np.argsort(owner, kind="stable")
    count = np.bincount(owner, minlength=n)
    first = np.repeat(np.cumsum(count) - count, count)
    place = np.arange(len(owner)) - first
    rows = [np.zeros((n, count.max(initial=0), 2)) for _ in values]
    for row, value in zip(rows, values, strict=True):
        row[owner[order], place] = value[order]
    return rows
