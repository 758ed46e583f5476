"""A crowd of discs, each of which makes its half of every change.

This goes beyond slide 1. The method is ORCA (van den Berg, Guy, Lin and
Manocha 2011, "Reciprocal n-body collision avoidance"). All vectors lie in the
plane, (..., 2).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.avoidance.cones import orca_half_plane
from solutions.avoidance.directions import in_plane
from solutions.avoidance.half_planes import permitted_velocity
from solutions.avoidance.neighbours import neighbour_pairs
from solutions.checks import not_negative, of_shape, positive, whole


def crowd_step(
    position: ArrayLike,
    velocity: ArrayLike,
    preferred: ArrayLike,
    radius: ArrayLike,
    max_speed: ArrayLike,
    horizon: float,
    dt: float,
    neighbour_distance: ArrayLike = np.inf,
    max_neighbours: ArrayLike = np.inf,
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
    horizon, dt : s, positive
        The horizon is no shorter than the step, in which each disc keeps
        its velocity.
    neighbour_distance : (n,) or one for all, m, not negative
        A disc heeds no other whose centre is farther from its own.
    max_neighbours : (n,) or one for all, a whole number or infinity, not
    negative
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
        If a radius, a speed or a limit of neighbours is negative, a number of
        neighbours is not whole, a horizon or step is not positive, the horizon
        is shorter than the step, a position is not finite, or the shapes do
        not fit.

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
    p, v = _states(position, velocity)
    r = np.broadcast_to(not_negative("radius", radius), len(p))
    speed = np.broadcast_to(not_negative("max_speed", max_speed), len(p))
    sight = np.broadcast_to(
        not_negative("neighbour_distance", neighbour_distance), len(p)
    )
    most = np.broadcast_to(
        whole(
            "max_neighbours", not_negative("max_neighbours", max_neighbours)
        ),
        len(p),
    )
    horizon, dt = (
        float(of_shape(name, positive(name, time), ()))
        for name, time in (("horizon", horizon), ("dt", dt))
    )
    # Rounding may make equal times differ: 0.3 is less than 3 · 0.1.
    if horizon < (1 - 1e-12) * dt:
        raise ValueError(
            f"horizon must be no shorter than the step, {dt} s, not"
            f" {horizon} s: discs could meet within the step"
        )
    i, j = _who_may_meet(p, r, speed, horizon, sight)
    point, normal = orca_half_plane(
        p[i], v[i], r[i], p[j], v[j], r[j], horizon, dt
    )
    mirrored = v[j] - (point - v[i])  # the other half, in reverse
    who, whom = np.r_[i, j], np.r_[j, i]
    heeded = _heeded(p, who, whom, sight, most)
    half_planes = (
        np.r_[point, mirrored][heeded],
        np.r_[normal, -normal][heeded],
    )
    points, normals = _in_rows(len(p), who[heeded], *half_planes)
    v = permitted_velocity(preferred, speed, points, normals)
    return p + v * dt, v


def _states(position: ArrayLike, velocity: ArrayLike) -> tuple[Array, Array]:
    p, v = in_plane("position", position), in_plane("velocity", velocity)
    if p.ndim != 2:
        raise ValueError(f"position must have the shape (n, 2), not {p.shape}")
    if v.shape != p.shape:
        raise ValueError(
            f"velocity must have the shape {p.shape} of the positions,"
            f" not {v.shape}"
        )
    return p, v


def _who_may_meet(
    p: Array, radius: Array, speed: Array, horizon: float, sight: Array
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
    rank = np.empty(len(who), dtype=int)  # 0 for the nearest
    rank[order] = np.arange(len(who)) - np.repeat(
        np.cumsum(count) - count, count
    )
    return np.asarray((distance <= sight[who]) & (rank < most[who]))


def _in_rows(n: int, owner: Integers, *values: Array) -> list[Array]:
    """Spread values (m, 2) over rows (n, longest, 2) by their owner.

    The places in a row that are left over are zero.
    """
    order = np.argsort(owner, kind="stable")
    count = np.bincount(owner, minlength=n)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    rows = [np.zeros((n, count.max(initial=0), 2)) for _ in values]
    for row, value in zip(rows, values, strict=True):
        row[owner[order], place] = value[order]
    return rows
