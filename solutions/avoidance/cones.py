"""Reciprocal avoidance of two discs: the cone of velocities that collide.

This goes beyond slide 1. The method is ORCA (van den Berg, Guy, Lin and
Manocha 2011, "Reciprocal n-body collision avoidance"). All vectors lie in the
plane, (..., 2).
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans
from solutions.avoidance.directions import turned_left
from solutions.avoidance.domain import Planar
from solutions.domain import NotNegative, Positive, domain
from solutions.vectors import direction, quotient


@domain
def orca_half_plane(
    position_a: Planar,
    velocity_a: Planar,
    radius_a: NotNegative,
    position_b: Planar,
    velocity_b: Planar,
    radius_b: NotNegative,
    horizon: Positive,
    dt: Positive,
) -> tuple[Array, Array]:
    """Half-plane of velocities with which disc A does its half of avoiding B.

    This goes beyond slide 1. A velocity v of disc A is permitted if

        (v − point)·normal ≥ 0

    If A and B both choose permitted velocities and keep them, discs that are
    apart do not collide within the horizon.

    The relative velocities v_A − v_B that lead to a collision within the
    horizon fill a cone towards B, whose near end is round. The vector c leads
    from v_A − v_B to the nearest point of its border, from inside or from
    outside, and A makes half of this change. `cap_of_cone` says whether that
    point is on the round end, and where; otherwise it is on a side of the
    cone. Discs that overlap have the round end alone.

    Parameters
    ----------
    position_a, position_b : (..., 2), m
    velocity_a, velocity_b : (..., 2), m/s
    radius_a, radius_b : (...), m, not negative
    horizon : (...), τ, s, positive, the time for which collisions are avoided
    dt : (...), s, positive, the step
        Discs that touch or overlap are to part within one step: for them dt
        takes the place of the horizon.

    Returns
    -------
    point : (..., 2), v_A + c/2, m/s
    normal : (..., 2), n, unit
        It points out of the cone. Where both sides of the cone are equally
        near, each disc turns to its right.

    Notes
    -----
    Let

        x = p_B − p_A
        R = r_A + r_B
        u = v_A − v_B

    The discs meet at the time t if u t lies within the distance R of x, that
    is, if u lies in the disc of radius R/t about x/t. For all times up to the
    horizon τ, these discs together fill a cone towards B, which is cut off by
    the disc of radius R/τ about x/τ. A relative velocity inside this obstacle
    leads to a collision within the horizon.

    Let c be the vector from u to the nearest point of the border of the
    obstacle, and n the outward normal there. If u changes by c, the discs just
    avoid the collision. A takes half of this change and leaves the other half
    to B:

        (v − (v_A + c/2))·n ≥ 0

    A side of the cone touches all these discs, and half the angle of the cone
    has the sine R/L, with L = ‖x‖. So the outward normal of a side has the
    component −R/L along x and ±√(L² − R²)/L across it. Because the side passes
    through zero, the change from u to it is

        c = −(u·n) n

    For discs that already touch or overlap there is no cone, only the disc,
    with dt instead of τ. Where such discs have the same centre, nothing
    distinguishes A from B. A caller who also needs the half-plane of B must
    then reverse the normal, as `crowd_step` does.
    """
    u = velocity_a - velocity_b
    x = position_b - position_a
    reach = radius_a + radius_b
    capped, depth, outwards = cap_of_cone(u, x, reach, horizon, dt)
    ahead = direction(x)
    left = turned_left(ahead)
    sine = quotient(np.where(capped, 0.0, reach), np.linalg.norm(x, axis=-1))
    cosine = np.sqrt((1 - sine) * (1 + sine))
    side = np.where(np.vecdot(u, left) > 0, 1.0, -1.0)
    leg = (side * cosine)[..., None] * left - sine[..., None] * ahead
    normal = np.where(capped[..., None], outwards, leg)
    change = np.where(capped, depth, -np.vecdot(u, leg))
    return velocity_a + change[..., None] / 2 * normal, normal


@domain
def cap_of_cone(
    relative_velocity: Planar,
    towards: Planar,
    reach: NotNegative,
    horizon: Positive,
    dt: Positive,
) -> tuple[Booleans, Array, Array]:
    """The round end of the cone of velocities that lead to a collision.

    It is the disc of the velocities with which A would overlap B exactly when
    the horizon is over. For discs that overlap already it is all there is.

    Parameters
    ----------
    relative_velocity : (..., 2), u = v_A − v_B, m/s
    towards : (..., 2), x, from the centre of A to that of B, m
    reach : (...), R, the sum of the radii, m, not negative
    horizon, dt : (...), s, positive
        For discs that touch or overlap, dt takes the place of the horizon.

    Returns
    -------
    capped : (...), bool
        Whether the border of the disc, and not a side of the cone, is what is
        nearest to the relative velocity. True for discs that touch or overlap.
    depth : (...), m/s
        How deep the relative velocity is in the disc, negative outside.
    normal : (..., 2), unit, outwards at the nearest point of the disc's border
        At the centre of the disc it points away from B, or along +x where the
        centres of A and B coincide.
    """
    distance = np.linalg.norm(towards, axis=-1)
    overlaps = distance <= reach
    time = np.where(overlaps, dt, horizon)
    ahead = direction(towards)
    from_centre = relative_velocity - towards / time[..., None]
    length = np.linalg.norm(from_centre, axis=-1)
    sine = np.minimum(quotient(reach, distance), 1.0)
    before = -np.vecdot(from_centre, ahead)
    # The sides of the cone begin where they touch the disc.
    capped = overlaps | (before > sine * length)
    has_side = np.any(ahead != 0, axis=-1, keepdims=True)
    at_centre = np.where(has_side, -ahead, np.array([1.0, 0.0]))
    outwards = direction(from_centre)
    off_centre = np.any(outwards != 0, axis=-1, keepdims=True)
    normal = np.where(off_centre, outwards, at_centre)
    return capped, reach / time - length, normal
