"""Signed distance of a point from a plane, and the side it is on (slide 4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import finite, not_negative, vector


def signed_distance(
    point: ArrayLike,
    normal: ArrayLike,
    offset: ArrayLike,
) -> Array:
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

    Raises
    ------
    ValueError
        If a normal is zero: a plane without a direction has no sides. If a
        point or a normal does not have three components.

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
    point, normal = vector("point", point), vector("normal", normal)
    offset, length = np.asarray(offset, float), np.linalg.norm(normal, axis=-1)
    if np.any(length == 0):
        raise ValueError("normal is zero: the plane has no direction")
    return np.asarray((np.vecdot(normal, point) + offset) / length)


def side_of_plane(
    separation: ArrayLike,
    tolerance: ArrayLike = 0.0,
) -> NDArray[np.int64]:
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

    Raises
    ------
    ValueError
        If a separation is not finite (a NaN would be on no side), or a
        tolerance is negative.

    Notes
    -----
    The slide knows two sides, and its strict < puts a point that touches the
    plane among those in front.
    """
    s = finite("separation", separation)
    tolerance = not_negative("tolerance", tolerance)
    return np.asarray((s > tolerance).astype(np.int64) - (s < -tolerance))


def is_colliding(
    separation: ArrayLike,
    tolerance: ArrayLike = 0.0,
) -> NDArray[np.bool_]:
    """Whether a point is behind the plane by more than a tolerance (slide 4).

    Parameters
    ----------
    separation : (...), signed distance, m
    tolerance : (...), m, not negative
        With 0 a point exactly on the plane is not colliding, as on the slide.

    Returns
    -------
    (...), bool

    Raises
    ------
    ValueError
        If a separation is not finite, or a tolerance is negative.
    """
    return np.asarray(side_of_plane(separation, tolerance) < 0)
