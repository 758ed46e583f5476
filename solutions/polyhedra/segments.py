"""Where a segment meets a plane or a triangle: edge against face (slide 9)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans
from solutions.detection import signed_distance
from solutions.domain import Direction, Number, Vector, domain, require
from solutions.polyhedra.orientation import LOOKS, Sign, orient2d, orient3d
from solutions.polyhedra.surface import Triangle
from solutions.vectors import quotient

ROUNDING = 1e-15
"""Share of the largest coordinate within which a point counts as on a side.

It is used to find where a segment enters a triangle's sides.
"""


@domain
def segment_plane(
    start: Vector, end: Vector, normal: Direction, offset: Number
) -> Array:
    """Share of a segment at which it meets the plane n·p + d = 0 (slide 9).

    Parameters
    ----------
    start, end : (..., 3), m
    normal : (..., 3), n, any length but zero
    offset : (...), d, m when n has unit length

    Returns
    -------
    (...), t, 0 to 1
        The point where they meet is start + t (end − start). An end on the
        plane counts. A segment that lies in the plane meets it all along, and
        first at t = 0. If both ends are on the same side, t is infinity.

    Notes
    -----
    With s₀ and s₁ for the signed distances of start and end from the plane,
    the share is

        t = s₀/(s₀ − s₁)

    Along the segment the signed distance changes at a steady rate, so that it
    is s₀ + t (s₁ − s₀) at the share t. The segment meets the plane where this
    is zero, which gives t.
    """
    s0 = signed_distance(start, normal, offset)
    s1 = signed_distance(end, normal, offset)
    meets = (np.minimum(s0, s1) <= 0) & (np.maximum(s0, s1) >= 0)
    return np.where(meets, _crossing_share(s0, s1), np.inf)


@domain
def segment_triangle(
    start: Vector, end: Vector, triangle: Triangle
) -> tuple[Array, Array]:
    """Where along a segment, and where on a triangle, the two first meet.

    This is the test of an edge against a face (slide 9).

    Parameters
    ----------
    start, end : (..., 3), m
    triangle : (..., 3, 3), its corners, m
        The segment meets it from both sides.

    Returns
    -------
    fraction : (...), t, 0 to 1 along the segment
        The point where they meet is start + t (end − start). The fraction is
        infinity where they do not meet, as for a segment that runs beside the
        triangle's plane.
    barycentric : (..., 3), weights of the triangle's corners at that point
        Each is from 0 to 1, and their sum is 1. The weights times the corners
        add up to the same point. They are NaN where the two do not meet.

        The lab asks for general position alone, and tests nothing else: the
        ends of the segment are off the triangle's plane, and the segment
        passes the triangle's sides at a distance. In all other cases any
        answer will do. The solution decides them too, and exactly
        (`segment_meets_triangle`): borders and ends count, and a segment in
        the triangle's plane meets it first where the stretch that they share
        begins.

    Raises
    ------
    ValueError
        If a triangle's area is too small for floats to tell it from zero.

    Notes
    -----
    With s₀ and s₁ for the heights of start and end above the plane of the
    triangle, the segment goes through the plane at the share t = s₀/(s₀ − s₁)
    (`segment_plane`), if s₀ and s₁ do not have the same sign. The point x
    found there makes a triangle with each side of the triangle a, b, c. The
    weights are the shares of the areas of these three. With A_a for the area
    that x makes with the side b c, times 2‖n‖, which drops out,

        n = (b − a)×(c − a)
        A_a = n·((b − x)×(c − x))
        w_a = A_a/(A_a + A_b + A_c)

    and so on round the triangle. An area is negative where x is beyond that
    side, so x is on the triangle if no weight is negative. Weights give the
    same point as x does, because each is linear in x, and it is 1 at its own
    corner and 0 at the other two.

    Rounding can move t far along a segment that is nearly in the plane. So
    there is a second candidate for t: the same t, kept between where the
    segment enters the triangle's sides and where it leaves them. If the
    segment is in the plane, both candidates are where it enters. The weights
    of a candidate are the areas, none below 0, over their sum, and they give a
    point of the triangle. The function takes the candidate whose point on the
    triangle is nearest to its point on the segment.
    """
    start, end, corners = _side_by_side(start, end, triangle)
    a, b, c = (corners[..., k, :] for k in range(3))
    normal = np.cross(b - a, c - a)
    has_area = np.any(normal != 0, axis=-1)
    require(has_area, "triangle must have an area: one has none")
    shares = _candidates(start, end, corners, normal)
    steps = shares[..., None] * (end - start)[..., None, :]
    places = start[..., None, :] + steps
    weights = _weights(places, corners[..., None, :, :], normal[..., None, :])
    distance = np.linalg.norm(weights @ corners - places, axis=-1)
    nearest = np.argmin(distance, axis=-1)[..., None]
    t = np.take_along_axis(shares, nearest, axis=-1)[..., 0]
    w = np.take_along_axis(weights, nearest[..., None], axis=-2)[..., 0, :]
    meets = segment_meets_triangle(start, end, corners)
    fraction = np.where(meets, t, np.inf)
    return fraction, np.where(meets[..., None], w, np.nan)


@domain
def segment_meets_triangle(
    start: Vector, end: Vector, triangle: Triangle
) -> Booleans:
    """Whether a segment and a triangle have a point in common, exactly.

    Parameters
    ----------
    start, end : (..., 3), m
    triangle : (..., 3, 3), its corners, m

    Returns
    -------
    (...), bool
        The triangle's borders and the segment's ends count, and so does a
        segment that lies in the triangle's plane. Nothing meets a triangle
        without area.

    Notes
    -----
    A segment meets a triangle if its ends are not on the same side of the
    triangle's plane and its line passes all three sides with the same turn.
    `orient3d` gives both signs exactly.

    If both ends are in the plane, all five points are. They are then looked at
    along x, y and z, and the segment and the triangle must meet in every view.
    In a view they are apart if a line along one of the triangle's sides, or
    along the segment, separates them.
    """
    start, end, corners = _side_by_side(start, end, triangle)
    shape = start.shape[:-1]
    start, end = start.reshape(-1, 3), end.reshape(-1, 3)
    a, b, c = np.moveaxis(corners.reshape(-1, 3, 3), 1, 0)
    side_of_start = orient3d(a, b, c, start)
    side_of_end = orient3d(a, b, c, end)
    meets = side_of_start * side_of_end <= 0
    in_plane = (side_of_start == 0) & (side_of_end == 0)
    steep = meets & ~in_plane
    points = start, end, a, b, c
    meets[steep] = _passes_through(*(x[steep] for x in points))
    meets[in_plane] = _meets_in_plane(*(x[in_plane] for x in points))
    return meets.reshape(shape)


def _side_by_side(
    start: Array, end: Array, triangle: Array
) -> tuple[Array, Array, Array]:
    """Segments and triangles, one beside the other, broadcast together."""
    shape = np.broadcast_shapes(
        start.shape[:-1], end.shape[:-1], triangle.shape[:-2]
    )
    return (
        np.broadcast_to(start, (*shape, 3)),
        np.broadcast_to(end, (*shape, 3)),
        np.broadcast_to(triangle, (*shape, 3, 3)),
    )


def _passes_through(
    start: Array, end: Array, a: Array, b: Array, c: Array
) -> Booleans:
    """Whether a line passes the three sides of a triangle with one turn."""
    turns = np.stack(
        [
            orient3d(start, end, a, b),
            orient3d(start, end, b, c),
            orient3d(start, end, c, a),
        ]
    )
    return np.all(turns >= 0, axis=0) | np.all(turns <= 0, axis=0)


def _meets_in_plane(
    start: Array, end: Array, a: Array, b: Array, c: Array
) -> Booleans:
    """Whether they meet when all five points are in one plane.

    Seen along x, y and z they must meet, and one view at least must not be
    edge-on.
    """
    meets = np.ones(len(start), dtype=bool)
    has_area = np.zeros(len(start), dtype=bool)
    for look in LOOKS:
        start_2d, end_2d, *corners = (
            x[:, look] for x in (start, end, a, b, c)
        )
        turn = orient2d(*corners)
        has_area |= turn != 0
        meets &= ~_apart_in_view(start_2d, end_2d, corners, turn)
    return meets & has_area


def _apart_in_view(
    start: Array, end: Array, corners: list[Array], turn: Sign
) -> Booleans:
    """Whether a line has the segment and the triangle on its two sides.

    The line is along a side of the triangle or along the segment, and it may
    touch only the one that it is along.
    """
    a, b, c = corners
    sides = np.stack([orient2d(start, end, corner) for corner in corners])
    apart = np.all(sides > 0, axis=0) | np.all(sides < 0, axis=0)
    for first, second in ((a, b), (b, c), (c, a)):
        start_beyond = orient2d(first, second, start) * turn < 0
        end_beyond = orient2d(first, second, end) * turn < 0
        apart |= start_beyond & end_beyond
    return apart


def _crossing_share(s0: Array, s1: Array) -> Array:
    """Share s₀/(s₀ − s₁), 0 to 1, of a segment at which its height is 0."""
    # It is 0 where both ends are on the plane: there s₀ is 0 itself.
    return np.clip(quotient(s0, s0 - s1, s0), 0.0, 1.0)


def _candidates(
    start: Array, end: Array, corners: Array, normal: Array
) -> Array:
    """Two shares of a segment, (..., 2), at which it may meet a triangle.

    The first is where the segment goes through the plane. The second is the
    same, kept between the triangle's sides. They are the same up to rounding,
    unless the segment is so nearly in the plane that rounding decides about
    the first. If the segment is in the plane, both are where it enters.
    """
    a, b, c = (corners[..., k, :] for k in range(3))
    in_plane = (orient3d(a, b, c, start) == 0) & (orient3d(a, b, c, end) == 0)
    first, last = _stretch(start, end, corners, normal)
    s0 = np.vecdot(normal, start - a)
    s1 = np.vecdot(normal, end - a)
    through = _crossing_share(s0, s1)
    within = np.clip(through, first, last)
    enters = np.minimum(first, last)[..., None]
    both = np.stack([through, within], axis=-1)
    return np.where(in_plane[..., None], enters, both)


def _stretch(
    start: Array, end: Array, corners: Array, normal: Array
) -> tuple[Array, Array]:
    """Shares of a segment between which it is within all sides.

    At the first it has passed the last of the sides that it starts outside of.
    At the second it passes the first of the sides that it ends outside of.
    """
    sides = np.roll(corners, -1, axis=-2) - corners
    inward = np.cross(normal[..., None, :], sides)
    start, end = start[..., None, :], end[..., None, :]
    s0 = np.vecdot(inward, start - corners)
    s1 = np.vecdot(inward, end - corners)
    places = np.concatenate([start, end, corners], axis=-2)
    size = np.max(np.abs(places), axis=(-2, -1))
    # A segment along a side does not cross it, although rounding may say so.
    # The normal is at right angles to the sides, so their lengths multiply.
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    length = length * np.linalg.norm(sides, axis=-1)
    on = -ROUNDING * length * size[..., None]
    share = _crossing_share(s0, s1)
    first = np.where((s0 < on) & (s1 >= on), share, 0.0)
    last = np.where((s1 < on) & (s0 >= on), share, 1.0)
    return np.max(first, axis=-1), np.min(last, axis=-1)


def _weights(x: Array, corners: Array, normal: Array) -> Array:
    """Barycentric weights of a point of the triangle.

    They are the areas of the three triangles that the point makes with the
    sides.
    """
    to_second = np.roll(corners, -1, axis=-2) - x[..., None, :]
    to_third = np.roll(corners, -2, axis=-2) - x[..., None, :]
    areas = np.vecdot(normal[..., None, :], np.cross(to_second, to_third))
    areas = np.maximum(areas, 0.0)
    return quotient(areas, np.sum(areas, axis=-1, keepdims=True))
