"""The direction around a fixed sphere, by its tangent point (slide 1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Booleans
from solutions.avoidance.directions import to_the_left
from solutions.domain import Positive, Triple, Vector, domain
from solutions.vectors import direction, quotient

HEAD_ON = 1e-9
"""Share of a wish below which its part across `towards` names no side.

Without this threshold rounding would choose the side.
"""


@domain
def tangent_point(
    position: Vector,
    heading: Vector,
    centre: Vector,
    radius: Positive,
) -> Array:
    """Point where a line from a position touches a bounding sphere (slide 1).

    Of all such points, it is the one on the side of the heading.

    Parameters
    ----------
    position, centre : (..., 3), m
    heading : (..., 3), of any length
        Its part across the line to the centre chooses the side.
    radius : (...), r, m, positive

    Returns
    -------
    (..., 3), m
        `side_of` says on which side it lies, also where the heading names
        none. From a position inside the sphere there is no tangent. The result
        is then the nearest point of the surface, and for a position exactly at
        the centre the top of the sphere: the point with the largest z.

    Notes
    -----
    Let L be the distance from the position to the centre. The tangent meets
    the radius at a right angle, so position, centre and tangent point form a
    right triangle with the longest side L. By Pythagoras the distance to the
    tangent point is

        k = √(L² − r²)

    Drop the perpendicular from the tangent point onto the line to the centre.
    It divides the triangle into two triangles of the same shape as the whole.
    From them, the tangent point lies t short of the centre and s to the side:

        t = r²/L
        s = r k/L

    By Pythagoras s is √(r² − t²) as well. That is the same number, but it
    loses its digits near the sphere, where r² and t² are nearly equal.
    """
    to_centre = centre - position
    towards = direction(to_centre)
    distance, tangent_length = _distance_and_tangent(to_centre, radius)  # L, k
    # Inside the sphere L is taken as r: the result is then on the surface.
    hypotenuse = np.maximum(distance, radius)
    short = radius * (radius / hypotenuse)  # t = r²/L
    aside = radius * (tangent_length / hypotenuse)  # s = r k/L
    side = side_of(towards, heading)
    tangent = centre - short[..., None] * towards + aside[..., None] * side
    top = centre + radius[..., None] * np.array([0.0, 0.0, 1.0])
    return np.where((distance == 0)[..., None], top, tangent)


@domain
def is_in_the_way(
    position: Vector,
    goal: Vector,
    centre: Vector,
    radius: Positive,
) -> Booleans:
    """Whether the straight path to a goal enters a sphere (slide 1).

    The path ends at the goal, so a sphere behind the position or beyond the
    goal is not in the way. Neither is a sphere that the path only touches.

    Parameters
    ----------
    position, goal, centre : (..., 3), m
    radius : (...), m, positive

    Returns
    -------
    (...), bool
        At the goal it says whether the goal is inside the sphere.

    Notes
    -----
    The path consists of the points p + λ (g − p) with λ from 0 to 1, from the
    position p to the goal g. The point of the whole line nearest to the centre
    c has

        λ = ((c − p)·(g − p))/(g − p)²

    Limited to the range from 0 to 1, it gives the point of the path that is
    nearest to the centre. The sphere is in the way if this point lies inside
    it.
    """
    to_goal = goal - position
    to_centre = centre - position
    length_squared = np.vecdot(to_goal, to_goal)
    share = quotient(np.vecdot(to_centre, to_goal), length_squared)  # λ
    nearest = position + np.clip(share, 0.0, 1.0)[..., None] * to_goal
    return np.linalg.norm(nearest - centre, axis=-1) < radius


@domain
def steer_around(
    position: Vector,
    velocity: Vector,
    goal: Vector,
    centre: Vector,
    radius: Positive,
) -> Array:
    """Direction to a goal, or around a sphere that is in the way (slide 1).

    If a bounding sphere is in the way, the direction leads to its tangent
    point. Of the two sides, the body takes the one nearer to its velocity. If
    the velocity names no side (head-on, or at rest), it takes the side nearer
    to the goal. If the goal names none either, it takes the left as seen from
    above, or +x if the centre is straight above or below.

    Parameters
    ----------
    position, goal, centre : (..., 3), m
    velocity : (..., 3), m/s
    radius : (...), r, m, positive: of the obstacle together with the flier

    Returns
    -------
    (..., 3), unit
        Inside the sphere it points straight out, and exactly at its centre to
        the goal. At the goal, outside the sphere, it is zero. A goal inside
        the sphere is never reached: the flier circles it.

    Notes
    -----
    Position, centre and tangent point form a right triangle with the sides L,
    r and k = √(L² − r²), as in `tangent_point`. So the angle θ between the
    tangent and the line to the centre has

        cos θ = k/L
        sin θ = r/L

    The direction of the tangent is cos θ times the unit vector to the centre,
    plus sin θ times the unit vector to the side.
    """
    to_goal = goal - position
    to_centre = centre - position
    towards = direction(to_centre)
    distance, tangent_length = _distance_and_tangent(to_centre, radius)  # L, k
    hypotenuse = np.maximum(distance, radius)
    cosine = (tangent_length / hypotenuse)[..., None]
    sine = (radius / hypotenuse)[..., None]
    side = side_of(towards, velocity, to_goal)
    tangent = cosine * towards + sine * side

    at_centre = distance == 0
    inside = (distance < radius) & ~at_centre
    blocked = is_in_the_way(position, goal, centre, radius) & ~at_centre
    onward = np.where(blocked[..., None], tangent, direction(to_goal))
    return np.where(inside[..., None], -towards, onward)


@domain
def side_of(towards: Triple, *wishes: ArrayLike) -> Array:
    """Side on which to pass what lies straight ahead (slide 1).

    Parameters
    ----------
    towards : (..., 3), unit
        The direction of what lies ahead; zero at its centre.
    wishes : (..., 3) each, of any length, such as headings
        The first wish counts that has a part across `towards`.

    Returns
    -------
    (..., 3), unit, at right angles to `towards`
        The direction of that part. A wish names no side if it is zero, or if
        its part across is at most 1e-9 of it, head-on or straight away:
        otherwise rounding would choose. If no wish names a side, it is the
        left as seen from above, or +x where `towards` is vertical or zero.
    """
    side = to_the_left(towards)
    for wish in map(np.asarray, reversed(wishes)):
        # Twice, because the first time leaves the rounding of a long wish.
        across = _across(_across(wish, towards), towards)
        aside = np.linalg.norm(across, axis=-1)
        named = aside > HEAD_ON * np.linalg.norm(wish, axis=-1)
        side = np.where(named[..., None], direction(across), side)
    return side


def _distance_and_tangent(
    to_centre: Array, radius: Array
) -> tuple[Array, Array]:
    """L and k = √(L² − r²); k is 0 inside the sphere.

    The root is computed from a product, so that no two nearly equal squares
    are subtracted.
    """
    distance = np.linalg.norm(to_centre, axis=-1)
    outside = np.maximum(distance - radius, 0.0)
    return distance, np.sqrt(outside * (distance + radius))


def _across(vector: Array, direction: Array) -> Array:
    """Part of a vector across a direction (..., 3) that is unit or zero."""
    along = np.sum(vector * direction, axis=-1, keepdims=True)
    return vector - along * direction
