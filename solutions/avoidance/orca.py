"""Reciprocal avoidance: each of two discs makes half of the change (beyond slide 1).

The method is ORCA (van den Berg, Guy, Lin and Manocha 2011, "Reciprocal n-body
collision avoidance"). All vectors lie in the plane, (..., 2).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans, Integers
from solutions.avoidance.directions import in_plane, turned_left, unit_or_zero
from solutions.avoidance.half_planes import permitted_velocity
from solutions.avoidance.neighbours import neighbour_pairs
from solutions.checks import not_negative, positive, whole
from solutions.scaling import length_of


def orca_half_plane(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    radius_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    radius_b: ArrayLike,
    horizon: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """Half-plane of velocities with which disc A does its half of avoiding B.

    This goes beyond slide 1. A velocity v of disc A is permitted if
    (v − point)·normal ≥ 0. If A and B both choose permitted velocities and keep them,
    discs that are apart do not collide within the horizon.

    The relative velocities v_A − v_B that lead to a collision within the horizon fill
    a cone towards B that is cut off by a disc. For discs that overlap already they fill
    a disc. The vector c leads from v_A − v_B to the nearest point of the border.
    A makes half of this change.

    Parameters
    ----------
    position_a, position_b : (..., 2), m
    velocity_a, velocity_b : (..., 2), m/s
    radius_a, radius_b : (...), m, not negative
    horizon : (...), τ, s, positive, the time for which collisions are avoided
    dt : (...), s, positive, the step
        Discs that touch or overlap are to part within one step: for them dt takes the
        place of the horizon.

    Returns
    -------
    point : (..., 2), v_A + c/2, m/s
    normal : (..., 2), n, unit
        Where both sides of the cone are equally near, each disc turns to its right.
        Where discs that overlap have their relative velocity at the centre of the
        forbidden disc, all points of its border are equally near, and the normal points
        away from B. If the centres of the discs coincide as well, it is +x. Nothing
        then distinguishes A from B, and a caller who also needs the half-plane of B
        must reverse the normal, as `crowd_step` does.

    Raises
    ------
    ValueError
        If a radius is negative, a horizon or step is not positive, or a vector is not
        finite or does not have two components.

    Notes
    -----
    Let x = p_B − p_A, R = r_A + r_B and u = v_A − v_B. The discs meet at the time t if
    u t lies within the distance R of x, that is, if u lies in the disc of radius R/t
    about x/t. For all times up to the horizon τ, these discs together fill a cone
    towards B, which is cut off by the disc of radius R/τ about x/τ. A relative velocity
    inside this obstacle leads to a collision within the horizon.

    Let c be the vector from u to the nearest point of the border of the obstacle, and n
    the outward normal there. If u changes by c, the discs just avoid the collision. A
    takes half of this change and leaves the other half to B:

        (v − (v_A + c/2))·n ≥ 0

    For discs that already touch or overlap there is no cone, only the disc, with dt
    instead of τ.
    """
    v, other = in_plane("velocity_a", velocity_a), in_plane("velocity_b", velocity_b)
    towards = in_plane("position_b", position_b) - in_plane("position_a", position_a)
    reach = not_negative("radius_a", radius_a) + not_negative("radius_b", radius_b)
    overlaps = length_of(towards) <= reach
    time = np.where(overlaps, positive("dt", dt), positive("horizon", horizon))
    change, normal = _to_the_border(v - other, towards, reach, time, overlaps)
    return v + change[..., None] * normal / 2, normal


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

    This goes beyond slide 1. Each disc takes the velocity nearest to its preferred one
    that all its half-planes permit, as `permitted_velocity` finds it, and moves with it
    for dt. How far a disc looks and how many neighbours it heeds may be limited, as by
    RVO2's neighborDist and maxNeighbors.

    Parameters
    ----------
    position, velocity, preferred : (n, 2), m, m/s, m/s
    radius, max_speed : (n,) or one for all, m, m/s, not negative
    horizon, dt : s, positive
    neighbour_distance : (n,) or one for all, m, not negative
        A disc heeds no other whose centre is farther from its own.
    max_neighbours : (n,) or one for all, a whole number or infinity, not negative
        A disc heeds at most that many others, the nearest ones. Of two that are equally
        near, the one with the lower index comes first.

    Returns
    -------
    position, velocity : (n, 2) each, m and m/s
        Discs that start from rest exactly head-on, two of them or a whole ring, stop in
        front of each other, because nothing names a side. A preferred velocity turned a
        little to the right sets them free.

    Raises
    ------
    ValueError
        If a radius, a speed or a limit of neighbours is negative, a number of
        neighbours is not whole, a horizon or step is not positive, a position is not
        finite, or the shapes do not fit.

    Notes
    -----
    Two discs need half-planes only if they could meet within the horizon when both fly
    straight at each other at full speed. The function leaves out all pairs that are too
    far apart for this, even with the largest radius and the highest speed of the crowd.
    The half-planes of A and B are mirror images: from `orca_half_plane` for A, the
    function derives the one for B with the same change in the opposite direction.

    With a limit, A may heed B while B does not heed A. Then only A makes its half of
    the change, and the two may collide: the promise of `orca_half_plane` is lost.
    """
    p, v = _states(position, velocity)
    r = np.broadcast_to(not_negative("radius", radius), len(p))
    speed = np.broadcast_to(not_negative("max_speed", max_speed), len(p))
    sight = np.broadcast_to(not_negative("neighbour_distance", neighbour_distance), len(p))
    most = np.broadcast_to(whole("max_neighbours", not_negative("max_neighbours", max_neighbours)), len(p))
    i, j = _who_may_meet(p, r, speed, horizon, sight)
    point, normal = orca_half_plane(p[i], v[i], r[i], p[j], v[j], r[j], horizon, dt)
    mirrored = v[j] - (point - v[i])  # the other half of the change, in reverse
    who, whom = np.r_[i, j], np.r_[j, i]
    heeded = _heeded(p, who, whom, sight, most)
    half_planes = np.r_[point, mirrored][heeded], np.r_[normal, -normal][heeded]
    points, normals = _in_rows(len(p), who[heeded], *half_planes)
    v = permitted_velocity(preferred, speed, points, normals)
    return p + v * dt, v


def _states(position: ArrayLike, velocity: ArrayLike) -> tuple[Array, Array]:
    p, v = in_plane("position", position), in_plane("velocity", velocity)
    if p.ndim != 2:
        raise ValueError(f"position must have the shape (n, 2), not {p.shape}")
    if v.shape != p.shape:
        raise ValueError(f"velocity must have the shape {p.shape} of the positions, not {v.shape}")
    return p, v


def _who_may_meet(p: Array, radius: Array, speed: Array, horizon: float, sight: Array) -> tuple[Integers, Integers]:
    """Pairs near enough to touch within the horizon and to be seen by one of the two.

    The largest radius and the highest speed decide, for two discs that fly straight at
    each other, and the farthest sight.
    """
    reach = 2 * (radius.max(initial=0.0) + speed.max(initial=0.0) * horizon)
    reach = min(reach, sight.max(initial=0.0))
    return neighbour_pairs(p, reach if reach > 0 else 1.0)


def _heeded(p: Array, who: Integers, whom: Integers, sight: Array, most: Array) -> Booleans:
    """Which entries remain if each disc heeds only the nearest others in its sight."""
    if np.all(np.isinf(sight)) and np.all(np.isinf(most)):
        return np.ones(len(who), dtype=bool)
    distance = length_of(p[whom] - p[who])
    order = np.lexsort((whom, distance, who))
    count = np.bincount(who, minlength=len(p))
    rank = np.empty(len(who), dtype=int)  # 0 for the nearest
    rank[order] = np.arange(len(who)) - np.repeat(np.cumsum(count) - count, count)
    return np.asarray((distance <= sight[who]) & (rank < most[who]))


def _to_the_border(u: Array, towards: Array, reach: Array, time: Array, overlaps: Booleans) -> tuple[Array, Array]:
    """How far u is inside the obstacle, and the normal of the nearest border.

    The distance is negative for a relative velocity u outside.
    """
    from_centre = u - towards / time[..., None]
    length = length_of(from_centre)
    distance = length_of(towards)
    ahead = towards / np.where(distance > 0, distance, 1.0)[..., None]
    sine = np.minimum(reach / np.where(distance > 0, distance, 1.0), 1.0)
    on_disc = overlaps | (-np.sum(from_centre * ahead, axis=-1) > sine * length)
    disc, leg = _disc_normal(from_centre, ahead), _leg_normal(from_centre, ahead, sine)
    normal = np.where(on_disc[..., None], disc, leg)
    return np.where(on_disc, reach / time - length, -np.sum(u * normal, axis=-1)), normal


def _disc_normal(from_centre: Array, ahead: Array) -> Array:
    """Outward normal of the disc, in the radial direction.

    At the centre of the disc it points against `ahead`, the direction of the other
    disc, or along +x where that is zero as well.
    """
    for_none = np.where(np.any(ahead != 0, axis=-1, keepdims=True), -ahead, np.array([1.0, 0.0]))
    return np.where(np.any(from_centre != 0, axis=-1, keepdims=True), unit_or_zero(from_centre), for_none)


def _leg_normal(from_centre: Array, ahead: Array, sine: Array) -> Array:
    """Outward normal of the cone, at the nearer of its two sides.

    Half the angle of the cone has the sine R/L, so n = ±(k/L) left − (R/L) ahead with
    k = √(L² − R²).
    """
    left = turned_left(ahead)
    cosine = np.sqrt((1 - sine) * (1 + sine))
    side = np.where(np.sum(from_centre * left, axis=-1) > 0, 1.0, -1.0)
    return np.asarray((side * cosine)[..., None] * left - sine[..., None] * ahead)


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
