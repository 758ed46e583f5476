"""Boxes that move without turning, along the axes or turned (slide 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import in_space, not_negative
from solutions.sweeping.motion import extent, relative_motion
from solutions.sweeping.rays import in_all, ray_box, time_between

PARALLEL = 1e-6
"""Sine of the angle below which two edges count as parallel.

Rounding would decide about the direction of their cross product.
"""


def sweep_boxes(
    position_a: ArrayLike,
    velocity_a: ArrayLike,
    half_extents_a: ArrayLike,
    position_b: ArrayLike,
    velocity_b: ArrayLike,
    half_extents_b: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """From when to when two boxes along the axes overlap in a step (slide 10).

    Parameters
    ----------
    position_a, position_b : (..., 3), centres, m
    velocity_a, velocity_b : (..., 3), m/s
    half_extents_a, half_extents_b : (..., 3), half the edges, m
        An edge may be 0: the box is then a sheet, a segment or a point.
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    entry, exit : (...), s from now, 0 ≤ entry ≤ exit ≤ dt
        Touching counts. Boxes that overlap already have entry 0. Where the
        boxes do not meet within the step, entry is infinity and exit is
        −infinity.

    Raises
    ------
    ValueError
        If a half edge or dt is negative, or a vector is not finite or not of
        three components.

    Notes
    -----
    The Minkowski sum of the two boxes is again a box, whose half edges are h_A
    + h_B. The boxes overlap exactly when the centre of A is in this box around
    the centre of B. Seen from B, the centre of A moves along a straight line,
    so the question becomes one for `ray_box`.
    """
    position, velocity = relative_motion(
        position_a, velocity_a, position_b, velocity_b
    )
    half_a = extent(
        "half_extents_a", in_space("half_extents_a", half_extents_a)
    )
    half_b = extent(
        "half_extents_b", in_space("half_extents_b", half_extents_b)
    )
    return _in_step(*ray_box(position, velocity, half_a + half_b), dt)


def sweep_oriented_boxes(
    position: ArrayLike,
    velocity: ArrayLike,
    axes_a: ArrayLike,
    half_extents_a: ArrayLike,
    axes_b: ArrayLike,
    half_extents_b: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """From when to when two turned boxes that translate overlap (slide 10).

    This is the test of separating axes, carried out over time.

    Parameters
    ----------
    position : (..., 3), x, centre of A as seen from that of B, m
    velocity : (..., 3), u, of A relative to B, m/s
    axes_a, axes_b : (..., 3, 3), rotation matrices
        Their columns are the directions of the edges.
    half_extents_a, half_extents_b : (..., 3), half the edges, m
        They are in the order of the columns. An edge may be 0: the box is then
        a sheet or a segment.
    dt : (...), s, length of the step; infinity looks ahead without end

    Returns
    -------
    entry, exit : (...), s from now, 0 ≤ entry ≤ exit ≤ dt
        Touching counts. Boxes that overlap already have entry 0. Where the
        boxes do not meet within the step, entry is infinity and exit is
        −infinity. Two edges within a millionth of a radian of parallel have no
        cross product to look along, and then the other lines decide. Where
        that matters, the entry is early and never late.

    Raises
    ------
    ValueError
        If a half edge or dt is negative, an array is not finite or not of
        three components, or axes are not a rotation.

    Notes
    -----
    Two boxes are apart if and only if their shadows are apart on one of
    fifteen lines. These are the three axes of each box, and the nine cross
    products of an axis of A with an axis of B.

    Let L be the unit direction of such a line. After a time t, the middles of
    the two shadows are |L·x + L·u t| apart. A shadow of a box reaches from its
    middle as far as the sum of what its half edges contribute. The shadows
    therefore overlap while

        |L·x + L·u t| ≤ Σ h_A |L·a| + Σ h_B |L·b|

    where a and b run over the axes of A and B. Each line gives an interval of
    times. The boxes overlap while all fifteen shadows do, which is from the
    last beginning of an interval to the first end.
    """
    x, u = in_space("position", position), in_space("velocity", velocity)
    axes_a, axes_b = rotation("axes_a", axes_a), rotation("axes_b", axes_b)
    half_a = extent(
        "half_extents_a", in_space("half_extents_a", half_extents_a)
    )
    half_b = extent(
        "half_extents_b", in_space("half_extents_b", half_extents_b)
    )
    # From here on the rows are the directions of the edges.
    axes_a, axes_b = np.broadcast_arrays(axes_a.mT, axes_b.mT)
    lines, real = _lines(axes_a, axes_b)
    reach = _shadow(lines, axes_a, half_a) + _shadow(lines, axes_b, half_b)
    place = np.vecdot(lines, x[..., None, :])
    rate = np.vecdot(lines, u[..., None, :])
    first, last = time_between(*np.broadcast_arrays(place, rate, reach))
    return _in_step(
        *in_all(np.where(real, first, -np.inf), np.where(real, last, np.inf)),
        dt,
    )


def rotation(name: str, value: ArrayLike) -> Array:
    """Return matrices (..., 3, 3).

    Raises
    ------
    ValueError
        If a matrix has columns that are not at right angles or not of unit
        length.
    """
    matrix = in_space(name, value)
    if matrix.shape[-2:] != (3, 3):
        raise ValueError(
            f"{name} must have shape (..., 3, 3), not {matrix.shape}"
        )
    if np.any(np.abs(matrix.mT @ matrix - np.eye(3)) > PARALLEL):
        raise ValueError(
            f"{name} must be rotation matrices, their columns at right angles"
            " and of length 1"
        )
    return matrix


def _lines(axes_a: Array, axes_b: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Directions (..., 15, 3) that may separate boxes, and which are real."""
    crossed = np.cross(axes_a[..., :, None, :], axes_b[..., None, :, :])
    crossed = crossed.reshape(*axes_a.shape[:-2], 9, 3)
    length = np.linalg.norm(crossed, axis=-1)
    real = length > PARALLEL
    crossed = crossed / np.where(real, length, 1.0)[..., None]
    own = np.ones((*real.shape[:-1], 6), dtype=bool)
    return np.concatenate([axes_a, axes_b, crossed], axis=-2), np.concatenate(
        [own, real], axis=-1
    )


def _shadow(lines: Array, axes: Array, half: Array) -> Array:
    """Half the length of a box's shadow on each line, m."""
    return np.asarray((np.abs(lines @ axes.mT) @ half[..., None])[..., 0])


def _in_step(
    entry: Array, leaving: Array, dt: ArrayLike
) -> tuple[Array, Array]:
    end = not_negative("dt", dt)
    meets = entry <= end
    return np.where(meets, entry, np.inf), np.where(
        meets, np.minimum(leaving, end), -np.inf
    )
