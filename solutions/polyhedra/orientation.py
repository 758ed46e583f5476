"""Signs that say on which side a point is: in floats, and exact (slide 9)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from solutions.arrays import Array, Integers
from solutions.checks import finite, with_shape
from solutions.domain import Vector, domain

Point2d = Annotated[Array, with_shape(..., 2), finite]
"""(..., 2), finite."""
Sign = Integers
"""(...), 1, 0 or −1."""
Numbers = NDArray[Any]
"""Floats, or Python's integers, which have as many digits as it takes."""

HALF_EPSILON = 2.0**-53
BOUND_2D = (3 + 16 * HALF_EPSILON) * HALF_EPSILON
BOUND_3D = (7 + 56 * HALF_EPSILON) * HALF_EPSILON
"""How far rounding may move the determinant, as a share of the sizes of its
terms.

The bound in space and the one in the plane are those of Shewchuk (1997).
"""
UNDERFLOW = 1e-200
"""Products this small may have lost digits at the lower end of the floats."""
LOOKS = ([1, 2], [2, 0], [0, 1])
"""The two coordinates that are left when looking along x, y and z."""


@domain
def side_of_line(a: Point2d, b: Point2d, c: Point2d) -> Sign:
    """Whether c is left of the line from a to b (+1), on it (0) or right (−1).

    It is the sign of a number that is calculated in floats as it comes. Close
    to the line, rounding may turn the sign; `orient2d` gives the exact one.

    Parameters
    ----------
    a, b, c : (..., 2), m, up to 1e100
        Left is where you have it when you stand at a and look towards b, with
        x to the right and y up on the page.

    Returns
    -------
    (...), 1, 0 or −1
        It is also 0 where a = b.

    Notes
    -----
    The result is the sign of

        (b − a)×(c − a) = (bₓ − aₓ)(c_y − a_y) − (b_y − a_y)(cₓ − aₓ)

    This is twice the signed area of the triangle a, b, c: ‖b − a‖ times the
    height of c above the line, positive on the left. The same number is the
    determinant of the matrix whose rows are b − a and c − a.

    Each difference and each product is rounded. The two products are nearly
    equal where c is close to the line, and then the rounding of one of them
    decides the sign of their difference. Of 256 × 256 neighbouring points
    beside a diagonal, 11 972 get the wrong sign when the differences are taken
    from the first corner (Kettner et al. 2008). The count is another one for
    another corner.
    """
    u, w = b - a, c - a
    cross_product = u[..., 0] * w[..., 1] - u[..., 1] * w[..., 0]
    return np.sign(cross_product).astype(np.int64)


@domain
def orient2d(a: Point2d, b: Point2d, c: Point2d) -> Sign:
    """Whether c is left of the line from a to b (+1), on it (0) or right (−1).

    The sign is exact.

    Parameters
    ----------
    a, b, c : (..., 2), m, up to 1e100

    Returns
    -------
    (...), 1, 0 or −1
        It is also 0 where a = b.

    Notes
    -----
    The result is the sign of

        (b − a)×(c − a)

    This cross product is twice the signed area of the triangle a, b, c. It is
    positive where the corners run counter-clockwise, which means that c is on
    the left.

    The function first computes the cross product in floats. Where rounding
    could have changed its sign, the function computes it again in whole
    numbers, which are exact. The sign is therefore antisymmetric too: if two
    points are swapped, it is exactly reversed. So two faces at an edge never
    both claim a point beside that edge, nor do they both refuse it.
    """
    return _exact_sign(_area, BOUND_2D, a, b, c)


@domain
def orient3d(a: Vector, b: Vector, c: Vector, d: Vector) -> Sign:
    """Whether d is before face a, b, c (+1), in its plane (0) or behind (−1).

    The sign is exact. The front is the side from which a, b, c are seen to run
    counter-clockwise.

    Parameters
    ----------
    a, b, c, d : (..., 3), m, up to 1e100

    Returns
    -------
    (...), 1, 0 or −1
        It is also 0 where a, b and c are on one line.

    Notes
    -----
    The result is the sign of

        ((b − a)×(c − a))·(d − a)

    The cross product is a normal of the face that points to its front. Its dot
    product with d − a is therefore positive when d is in front. As in
    `orient2d`, the function first computes the sign in floats. Where rounding
    could have changed the sign, it computes it again in whole numbers.
    """
    return _exact_sign(_volume, BOUND_3D, a, b, c, d)


def _exact_sign(
    determinant: Callable[[Numbers], tuple[Numbers, Numbers]],
    bound: float,
    *corners: Array,
) -> Sign:
    """Sign of a determinant, in whole numbers where floats leave it open."""
    points = np.stack(np.broadcast_arrays(*corners))
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        value, size = determinant(points)
        # This is true for NaN, so that a value that overflows is unsure too.
        unsure = ~(np.abs(value) > bound * size + UNDERFLOW)
    sign = np.where(unsure, 0, np.sign(value)).astype(np.int64)
    if np.any(unsure):
        exact, _ = determinant(_whole(points[:, unsure]))
        sign[unsure] = (exact > 0).astype(np.int64) - (exact < 0)
    return sign


def _area(points: Numbers) -> tuple[Numbers, Numbers]:
    """The cross product, and the sum of the sizes of its two terms."""
    a, b, c = points
    u, v = b - a, c - a
    first, second = u[..., 0] * v[..., 1], u[..., 1] * v[..., 0]
    return first - second, abs(first) + abs(second)


def _volume(points: Numbers) -> tuple[Numbers, Numbers]:
    """The triple product, and the sum of the sizes of its six terms."""
    a, b, c, d = points
    u, v, w = b - a, c - a, d - a
    value, size = 0, 0
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        first, second = u[..., i] * v[..., j], u[..., j] * v[..., i]
        value = value + w[..., k] * (first - second)
        size = size + abs(w[..., k]) * (abs(first) + abs(second))
    return np.asarray(value), np.asarray(size)


def _whole(points: Array) -> Numbers:
    """The same points in a unit of length in which all coordinates are whole.

    The unit is a power of two, so that changing to it does not round.
    """
    mantissa, exponent = np.frexp(points)
    digits = (mantissa * 2.0**53).astype(np.int64).astype(object)
    return np.asarray(digits << (exponent - np.min(exponent)).astype(object))
