"""Force fields that repel a body from fixed obstacles (slide 1)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.avoidance.domain import Direction
from solutions.domain import NotNegative, Number, Positive, Vector, domain
from solutions.vectors import direction


@domain
def repelling_force(
    separation: Number,
    normal: Direction,
    strength: NotNegative,
    reach: Positive,
) -> Array:
    """Force of a repelling field around an obstacle of any shape (slide 1).

    The force points away from the obstacle. Its size falls from F0 at the
    surface to zero at the reach, with the square of the share of the reach
    that is left.

    Parameters
    ----------
    separation : (...), s, m, from the obstacle's surface, negative inside
    normal : (..., d), n, unit, away from the obstacle, d = 2 or 3
    strength : (...), F0, N, the force at the surface, not negative
    reach : (...), R, m, positive

    Returns
    -------
    (..., d), N
        Inside the obstacle it is F0 n, as at the surface. At the reach and
        beyond it is zero.

    Notes
    -----
    The slide only says "force fields". The field chosen here is

        F = F0 n                for s < 0, inside
        F = F0 (1 − s/R)² n     for 0 ≤ s < R
        F = 0                   beyond

    Because of the square, both the force and its slope are zero at the reach,
    so that the force sets in smoothly.

    There are three things that no such field can do. It lets no body fly along
    a wall, because within its reach it pushes the body off. A body that meets
    it head-on is pushed straight back, with no part to the side: if the body
    is drawn to a goal behind the obstacle, it stops where the two forces
    balance. And the forces of two obstacles cancel somewhere between them.
    """
    # It is 1 inside, 1 − s/R within the reach, and 0 beyond.
    nearness = np.clip(1 - separation / reach, 0.0, 1.0)
    return (strength * nearness**2)[..., None] * normal


@domain
def sphere_force(
    position: Vector,
    centre: Vector,
    radius: NotNegative,
    strength: NotNegative,
    reach: Positive,
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

    Notes
    -----
    For a body at p, a centre c and a radius r, the separation is

        s = ‖p − c‖ − r

    and the normal is the direction of p − c. In `repelling_force` they give

        F = F0 (1 − s/R)² n
    """
    away = position - centre
    separation = np.linalg.norm(away, axis=-1) - radius
    # Not by `repelling_force`: it refuses the zero direction at the centre.
    nearness = np.clip(1 - separation / reach, 0.0, 1.0)
    return (strength * nearness**2)[..., None] * direction(away)
