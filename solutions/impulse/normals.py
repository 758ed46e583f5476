"""The direction of a contact: the plane's normal, or across two edges, always from B to A (slide 17)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, vector

Array = NDArray[np.float64]
PARALLEL = 1e-9
"""Sine of the angle of two edges up to which they count as parallel: of their normal rounding leaves seven digits."""


def point_plane_normal(plane_normal: ArrayLike, centre_a: ArrayLike, centre_b: ArrayLike) -> Array:
    """Normal of a contact of a corner of one body with a face of the other: the face's own (slide 17).

    It has unit length and points towards A, whichever of the two has the face: flipped if it points from A's centre to
    B's.

    Parameters
    ----------
    plane_normal : (..., 3), any length but zero
    centre_a, centre_b : (..., 3), m, centres of A and B; of ground that goes on for ever, any point of it

    Returns
    -------
    (..., 3), unit, from B to A; as given where the centres lie in one plane across it and cannot tell

    Raises
    ------
    ValueError
        If a normal is zero, or an argument is not finite or has not three components.
    """
    return _towards_a(_direction("plane_normal", plane_normal), centre_a, centre_b)


def edge_edge_normal(edge_a: ArrayLike, edge_b: ArrayLike, centre_a: ArrayLike, centre_b: ArrayLike) -> Array:
    """Normal of a contact of two edges: A × B, of unit length, towards A (slide 17).

    The slide's cross product has the length ‖A‖‖B‖ sin φ, and points to A or to B as the edges happen to run. Parallel
    edges touch along a line, and any direction across them is as good as another: none is made up for them.

    Parameters
    ----------
    edge_a, edge_b : (..., 3), from one end of the edge to the other, m, any length but zero
    centre_a, centre_b : (..., 3), m, centres of A and B

    Returns
    -------
    (..., 3), unit, from B to A; along A × B where the centres lie in one plane across it and cannot tell

    Raises
    ------
    ValueError
        If the edges are parallel, sin φ ≤ 1e-9, or one is zero; or an argument is not finite or has not three
        components.
    """
    a, b = _direction("edge_a", edge_a), _direction("edge_b", edge_b)
    across = np.cross(a, b)
    sine = np.linalg.norm(across, axis=-1, keepdims=True)
    parallel = sine[..., 0] <= PARALLEL
    if np.any(parallel):
        first, second = (np.broadcast_to(edge, across.shape)[parallel][0].tolist() for edge in (edge_a, edge_b))
        raise ValueError(f"edge_a {first} and edge_b {second} are parallel: they have no single normal")
    return _towards_a(across / sine, centre_a, centre_b)


def _direction(name: str, value: ArrayLike) -> Array:
    """The vector over its length; first over its largest component, so that no square over- or underflows."""
    given = finite(name, vector(name, value))
    largest = np.max(np.abs(given), axis=-1, keepdims=True)
    if np.any(largest == 0):
        raise ValueError(f"{name} is zero: it has no direction")
    scaled = given / largest
    return np.asarray(scaled / np.linalg.norm(scaled, axis=-1, keepdims=True))


def _towards_a(normal: Array, centre_a: ArrayLike, centre_b: ArrayLike) -> Array:
    b_to_a = finite("centre_a", vector("centre_a", centre_a)) - finite("centre_b", vector("centre_b", centre_b))
    return np.where(np.vecdot(normal, b_to_a)[..., None] < 0, -normal, normal)
