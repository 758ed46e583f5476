"""The velocity nearest to a wish that half-planes and a speed limit permit.

This goes beyond slide 1. It is the programme of the library RVO2 (van den
Berg, Guy, Snape, Lin and Manocha), for many bodies at once. The half-planes
are taken one after the other, in the order given. Where one of them is broken,
the new velocity is looked for on its border. In the private functions a
half-plane is n·v ≥ b, with its unit normal n and b = n·point.
"""

from __future__ import annotations

import math

import numpy as np

from solutions.arrays import Array, Integers
from solutions.avoidance.directions import limited, turned_left
from solutions.avoidance.domain import Planar, PlanarNormal
from solutions.domain import NotNegative, domain
from solutions.vectors import quotient

PARALLEL = 1e-12
"""Sine of the angle below which two borders count as parallel.

The crossing point of such borders has no correct digits left.
"""


@domain
def permitted_velocity(
    preferred: Planar,
    max_speed: NotNegative,
    point: Planar,
    normal: PlanarNormal,
) -> Array:
    """Velocity nearest to the preferred one that all limits permit.

    This goes beyond slide 1.

    The limits are the largest speed and the half-planes. A half-plane permits
    the velocities on the side of its border to which its normal points.

    Parameters
    ----------
    preferred : (..., 2), m/s
    max_speed : (...), m/s, not negative
    point : (..., m, 2), m/s, any velocity on the border of each half-plane
    normal : (..., m, 2), of length 1; a normal of zero permits everything

    Returns
    -------
    (..., 2), m/s
        Where no velocity keeps to all half-planes, it keeps to the speed
        limit, and its worst violation of a half-plane is as small as possible.
        Borders that enclose an angle whose sine is below 1e-12 count as
        parallel.

    Notes
    -----
    The function solves the programme

        minimise ‖v − v_preferred‖
        with (v − point_k)·n_k ≥ 0 for all k
        and ‖v‖ ≤ v_max

    It starts with the preferred velocity, shortened to v_max, and takes the
    half-planes one after the other. If the velocity so far keeps to the next
    half-plane, it remains the nearest. If it does not, the nearest permitted
    velocity lies on the border of this half-plane: any permitted velocity
    beyond the border can be moved towards the velocity so far until it reaches
    the border, and on this way it comes nearer to the preferred velocity. The
    border is a line. The speed limit and the earlier half-planes leave a
    stretch of it, and the function takes the point of this stretch that is
    nearest to the preferred velocity.

    If nothing is left of the line, no velocity keeps to all half-planes. The
    function then minimises the worst violation, again with one half-plane
    after the other.
    """
    bound = np.sum(normal * point, axis=-1)
    m = bound.shape[-1]
    shape = np.broadcast_shapes(
        preferred.shape[:-1], max_speed.shape, bound.shape[:-1]
    )
    rows = math.prod(shape)
    wish = np.broadcast_to(preferred, (*shape, 2)).reshape(rows, 2)
    speed = np.broadcast_to(max_speed, shape).reshape(rows)
    n = np.broadcast_to(normal, (*shape, m, 2)).reshape(rows, m, 2)
    bound = np.broadcast_to(bound, (*shape, m)).reshape(rows, m)
    v, failed = _nearest(wish, speed, n, bound)
    lost = np.flatnonzero(failed < m)
    v[lost] = _least_broken(
        v[lost], speed[lost], n[lost], bound[lost], failed[lost]
    )
    return v.reshape(*shape, 2)


def _nearest(
    wish: Array, speed: Array, normal: Array, bound: Array, far: bool = False
) -> tuple[Array, Integers]:
    """Velocity nearest to the wish, and the first half-plane it must break.

    That half-plane, k of m, cannot be kept together with those before it; the
    index is m if all can be kept. If `far` is true, the wish is a direction,
    and the velocity goes as far along it as the limits permit.
    """
    m = normal.shape[1]
    v = wish * speed[:, None] if far else limited(wish, speed)
    failed = np.full(len(wish), m)
    for k in range(m):
        beyond = np.sum(normal[:, k] * v, axis=-1) < bound[:, k]
        broken = np.flatnonzero(beyond & (failed == m))
        if len(broken) == 0:
            continue
        along = turned_left(normal[broken, k])
        low, high = _stretch(
            normal[broken], bound[broken], speed[broken], along, k
        )
        goal = np.sum(wish[broken] * along, axis=-1)
        place = np.clip(np.copysign(np.inf, goal) if far else goal, low, high)
        kept = low <= high
        rows = broken[kept]
        foot = normal[rows, k] * bound[rows, k, None]
        v[rows] = foot + along[kept] * place[kept, None]
        failed[broken[~kept]] = k
    return v, failed


def _stretch(
    normal: Array, bound: Array, speed: Array, along: Array, k: int
) -> tuple[Array, Array]:
    """Part of the border of half-plane k that the other limits leave.

    These limits are the speed limit and the half-planes before k. The points
    of the border are n_k b_k + t along, so t is measured from the foot of the
    border. Half-plane j requires t (n_j·along) ≥ b_j − b_k n_j·n_k.
    """
    before, b = normal[:, :k], bound[:, k, None]
    slope = np.sum(before * along[:, None], axis=-1)
    least = bound[:, :k] - b * np.sum(before * normal[:, k, None], axis=-1)
    parallel = np.abs(slope) <= PARALLEL
    place = least / np.where(parallel, 1.0, slope)
    own = bound[:, k]
    # The room is √(speed² − b²). Beyond the speed limit there is none.
    half_squared = (speed - own) * (speed + own)
    root = np.sqrt(np.maximum(half_squared, 0.0))
    half = np.where(half_squared >= 0, root, -np.inf)
    low = np.max(place, axis=-1, where=slope > PARALLEL, initial=-np.inf)
    high = np.min(place, axis=-1, where=slope < -PARALLEL, initial=np.inf)
    # A parallel border counts only if it lies beyond this one by more than
    # rounding. A half-plane that is given twice must not exclude itself.
    too_far = parallel & (least > PARALLEL * (speed[:, None] + np.abs(b)))
    nothing_left = np.any(too_far, axis=-1)
    high = np.where(nothing_left, -np.inf, np.minimum(high, half))
    return np.maximum(low, -half), high


def _least_broken(
    v: Array, speed: Array, normal: Array, bound: Array, failed: Integers
) -> Array:
    """Velocity whose worst violation b_k − n_k·v is as small as possible.

    It starts from a velocity that keeps to all half-planes before `failed`,
    and takes half-plane k in turn. Where k is broken worse than any before it,
    the velocity goes as far along the normal of k as it can while k remains
    the worst. The condition that j is not broken worse than k,

        b_j − n_j·v ≤ b_k − n_k·v

    is a half-plane too: its normal is n_j − n_k.
    """
    worst = np.zeros(len(v))
    for k in range(normal.shape[1]):
        violation = bound[:, k] - np.sum(normal[:, k] * v, axis=-1)
        rows = np.flatnonzero((k >= failed) & (violation > worst))
        difference = normal[rows, :k] - normal[rows, k, None]
        size = np.linalg.norm(difference, axis=-1)
        size = np.where(size > PARALLEL, size, 0.0)  # 0: permits everything
        normals = quotient(difference, size[..., None])
        bounds = quotient(bound[rows, :k] - bound[rows, k, None], size)
        farthest, stuck = _nearest(
            normal[rows, k], speed[rows], normals, bounds, far=True
        )
        v[rows] = np.where((stuck == k)[:, None], farthest, v[rows])
        worst[rows] = bound[rows, k] - np.sum(
            normal[rows, k] * v[rows], axis=-1
        )
    return v
