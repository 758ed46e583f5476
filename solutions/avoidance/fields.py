"""Force fields that repel a body from fixed obstacles (slide 1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.avoidance.directions import unit_or_zero
from solutions.checks import in_space, not_negative, positive, unit


def repelling_force(
    separation: ArrayLike,
    normal: ArrayLike,
    strength: ArrayLike,
    reach: ArrayLike,
) -> Array:
    """Force of a repelling field around an obstacle of any shape (slide 1).

    The force points away from the obstacle. Its size falls from F0 at the
    surface to zero at the reach, with the square of the share of the reach
    that is left.

    Parameters
    ----------
    separation : (...), s, m, from the obstacle's surface, negative inside
    normal : (..., 3), n, unit, away from the obstacle
    strength : (...), F0, N, the force at the surface, not negative
    reach : (...), R, m, positive

    Returns
    -------
    (..., 3), N
        Inside the obstacle it is F0 n, as at the surface. At the reach and
        beyond it is zero.

    Raises
    ------
    ValueError
        If a normal does not have length 1, a strength is negative, or a reach
        is not positive.

    Notes
    -----
    The slide only says "force fields". The field chosen here is

        F = F0 (1 − s/R)² n    for 0 ≤ s < R,    zero beyond,    F0 n inside

    Because of the square, both the force and its slope are zero at the reach,
    so that the force sets in smoothly.

    There are three things that no such field can do. It lets no body fly along
    a wall, because within its reach it pushes the body off. A body that meets
    it head-on is pushed straight back, with no part to the side: if the body
    is drawn to a goal behind the obstacle, it stops where the two forces
    balance. And the forces of two obstacles cancel somewhere between them.
    """
    return _field(separation, unit("normal", normal), strength, reach)


def sphere_force(
    position: ArrayLike,
    centre: ArrayLike,
    radius: ArrayLike,
    strength: ArrayLike,
    reach: ArrayLike,
) -> Array:
    """Force of the repelling field around a sphere (slide 1).

    It is the force of `repelling_force`, at the separation from the surface of
    the sphere.

    Parameters
    ----------
    position, centre : (..., 3), m
    radius : (...), m, not negative
    strength : (...), N, at the surface and inside, not negative
    reach : (...), m, from the surface, positive

    Returns
    -------
    (..., 3), N
        Zero exactly at the centre, where no direction leads away.

    Raises
    ------
    ValueError
        If a radius or a strength is negative, a reach is not positive, or a
        place is not finite or does not have three components.

    Notes
    -----
    For a body at p, a centre c and a radius r, the separation is

        s = ‖p − c‖ − r

    and the normal is the direction of p − c.
    """
    away = in_space("position", position) - in_space("centre", centre)
    separation = np.linalg.norm(away, axis=-1) - not_negative("radius", radius)
    return _field(separation, unit_or_zero(away), strength, reach)


def _field(
    separation: ArrayLike, normal: Array, strength: ArrayLike, reach: ArrayLike
) -> Array:
    s, limit = np.asarray(separation, dtype=float), positive("reach", reach)
    nearness = np.clip(1 - s / limit, 0.0, 1.0)
    return np.asarray(
        (not_negative("strength", strength) * nearness**2)[..., None] * normal
    )
