"""The normal of a face or of two edges in contact, from B to A (slide 17)."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from solutions.arrays import Array
from solutions.checks import finite, not_zero, vector
from solutions.domain import Vector, domain
from solutions.vectors import direction

PARALLEL = 1e-9
"""Sine of the angle between two edges up to which they count as parallel.

At this angle rounding leaves seven digits of their normal.
"""
FiniteDirection = Annotated[Array, vector, finite, not_zero]
"""(..., 3), finite, of any length but zero."""


@domain
def point_plane_normal(
    plane_normal: FiniteDirection, centre_a: Vector, centre_b: Vector
) -> Array:
    """Normal of a contact between a corner of a body and a face (slide 17).

    The normal is that of the face, with unit length.

    Parameters
    ----------
    plane_normal : (..., 3), any length but zero
    centre_a, centre_b : (..., 3), m, centres of A and B
        For ground that extends for ever, any point of it.

    Returns
    -------
    (..., 3), unit, from B to A
        As given where the line between the centres is parallel to the face, so
        that they cannot tell the direction.

    Notes
    -----
    Either body may have the face. A normal that points from A's centre to B's
    is reversed, so that the result points towards A in both cases.
    """
    return _towards_a(direction(plane_normal), centre_a, centre_b)


@domain
def edge_edge_normal(
    edge_a: FiniteDirection,
    edge_b: FiniteDirection,
    centre_a: Vector,
    centre_b: Vector,
) -> Array:
    """Normal of two edges in contact, unit length, towards A (slide 17).

    Parameters
    ----------
    edge_a, edge_b : (..., 3), m, any length but zero
        From one end of the edge to the other.
    centre_a, centre_b : (..., 3), m, centres of A and B

    Returns
    -------
    (..., 3), unit, from B to A
        Along A × B where the line between the centres is perpendicular to
        A × B, so that they cannot tell the direction.

    Raises
    ------
    ValueError
        If the edges are parallel, sin φ ≤ 1e-9.

    Notes
    -----
    The slide's cross product A × B of the two edges is perpendicular to both.
    It has the length ‖A‖‖B‖ sin φ, where φ is the angle between the edges, and
    it points to A or to B as the edges happen to run. The function divides it
    by its length, and reverses it if it points to B.

    Parallel edges touch along a line, and every direction across them is as
    good as any other. The function refuses them and does not choose one.
    """
    across = np.cross(direction(edge_a), direction(edge_b))
    sine = np.linalg.norm(across, axis=-1)
    _refuse_parallel(edge_a, edge_b, sine)
    return _towards_a(across / sine[..., None], centre_a, centre_b)


def _refuse_parallel(edge_a: Array, edge_b: Array, sine: Array) -> None:
    """Refuse edges without a single normal, and name the first two."""
    parallel = sine <= PARALLEL
    if np.any(parallel):
        edges, shape = (edge_a, edge_b), (*sine.shape, 3)
        a, b = (np.broadcast_to(edge, shape)[parallel][0] for edge in edges)
        pair = f"edge_a {a.tolist()} and edge_b {b.tolist()}"
        raise ValueError(f"{pair} are parallel: they have no single normal")


def _towards_a(normal: Array, centre_a: Array, centre_b: Array) -> Array:
    """The normal, turned round if it points from A's centre to B's."""
    towards_b = np.vecdot(normal, centre_a - centre_b) < 0
    return np.where(towards_b[..., None], -normal, normal)
