"""The normal of a contact, always from B to A (slide 17).

It is the normal of a face, or the direction across two edges.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, vector

PARALLEL = 1e-9
"""Sine of the angle between two edges up to which they count as parallel.

At this angle rounding leaves seven digits of their normal.
"""


def point_plane_normal(
    plane_normal: ArrayLike,
    centre_a: ArrayLike,
    centre_b: ArrayLike,
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

    Raises
    ------
    ValueError
        If a normal is zero, or an argument is not finite or does not have
        three components.

    Notes
    -----
    Either body may have the face. A normal that points from A's centre to B's
    is reversed, so that the result points towards A in both cases.
    """
    return _towards_a(
        _direction("plane_normal", plane_normal), centre_a, centre_b
    )


def edge_edge_normal(
    edge_a: ArrayLike,
    edge_b: ArrayLike,
    centre_a: ArrayLike,
    centre_b: ArrayLike,
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
        Along A × B where the line between the centres is perpendicular to A ×
        B, so that they cannot tell the direction.

    Raises
    ------
    ValueError
        If the edges are parallel, sin φ ≤ 1e-9, or one is zero; or an argument
        is not finite or does not have three components.

    Notes
    -----
    The slide's cross product A × B of the two edges is perpendicular to both.
    It has the length ‖A‖‖B‖ sin φ, where φ is the angle between the edges, and
    it points to A or to B as the edges happen to run. The function divides it
    by its length, and reverses it if it points to B.

    Parallel edges touch along a line, and every direction across them is as
    good as any other. The function refuses them and does not choose one.
    """
    a, b = _direction("edge_a", edge_a), _direction("edge_b", edge_b)
    across = np.cross(a, b)
    sine = np.linalg.norm(across, axis=-1, keepdims=True)
    parallel = sine[..., 0] <= PARALLEL
    if np.any(parallel):
        first, second = (
            np.broadcast_to(edge, across.shape)[parallel][0].tolist()
            for edge in (edge_a, edge_b)
        )
        raise ValueError(
            f"edge_a {first} and edge_b {second} are parallel:"
            " they have no single normal"
        )
    return _towards_a(across / sine, centre_a, centre_b)


def _direction(name: str, value: ArrayLike) -> Array:
    """The vector over its length."""
    given = finite(name, vector(name, value))
    length = np.linalg.norm(given, axis=-1, keepdims=True)
    if np.any(length == 0):
        raise ValueError(f"{name} is zero: it has no direction")
    return np.asarray(given / length)


def _towards_a(
    normal: Array, centre_a: ArrayLike, centre_b: ArrayLike
) -> Array:
    b_to_a = finite("centre_a", vector("centre_a", centre_a)) - finite(
        "centre_b", vector("centre_b", centre_b)
    )
    return np.where(np.vecdot(normal, b_to_a)[..., None] < 0, -normal, normal)
