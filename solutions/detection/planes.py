"""Signed distance of a point from a plane, and the side it is on (slide 4)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.domain import (
    Direction,
    Finite,
    NotNegative,
    Number,
    Triple,
    domain,
)


@domain
def signed_distance(point: Triple, normal: Direction, offset: Number) -> Array:
    """Signed distance of a point from the plane n·p + d = 0 (slide 4).

    The distance is negative behind the plane. The normal points to the front
    of the plane, and it may have any length: the result is a distance in
    metres in any case.

    Parameters
    ----------
    point : (..., 3), m
    normal : (..., 3), any length but zero
    offset : (...), d in n·p + d = 0; m when the normal has unit length

    Returns
    -------
    (...), m

    Notes
    -----
    From the point, go the distance s against the unit normal n/‖n‖. You arrive
    on the plane if the new point satisfies the plane's equation:

        n·(p − s n/‖n‖) + d = 0

    Because n·n = ‖n‖², this is n·p − s ‖n‖ + d = 0, and so

        s = (n·p + d)/‖n‖

    The slide's a x + b y + c z + d is the numerator. It is the distance only
    when ‖n‖ = 1; the division by ‖n‖ makes it one for every n.
    """
    length = np.linalg.norm(normal, axis=-1)
    return (np.vecdot(normal, point) + offset) / length


@domain
def side_of_plane(
    separation: Finite, tolerance: NotNegative = 0.0
) -> Integers:
    """Side of a plane on which a point is (slide 4).

    It is 1 in front, 0 on the plane, and −1 behind it, where a point collides.

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative
        A point is on the plane up to and including this distance, on either
        side. With 0 only a point exactly on the plane is on it, which does not
        collide, as on the slide.

    Returns
    -------
    (...), 1, 0 or −1

    Notes
    -----
    The slide knows two sides, and its strict < puts a point that touches the
    plane among those in front.
    """
    in_front = separation > tolerance
    behind = separation < -tolerance
    return np.where(in_front, 1, np.where(behind, -1, 0))


@domain
def is_colliding(separation: Finite, tolerance: NotNegative = 0.0) -> Booleans:
    """Whether a point is behind the plane by more than a tolerance (slide 4).

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative
        With 0 a point exactly on the plane is not colliding, as on the slide.

    Returns
    -------
    (...), bool
    """
    return side_of_plane(separation, tolerance) < 0
