"""Shapes of bodies, and the convex pieces that they are made of.

A shape is a plain tuple: its kind, and then what that kind needs.

    ("sphere", radius)
    ("capsule", radius, half_length)   about z; the round ends lie beyond
    ("box", half_extents)              (3,), along its own axes
    ("polyhedron", vertices, faces)    convex; faces counterclockwise
    ("half-space", normal)             all below the plane through its origin
    ("compound", parts)                of (shape, position, orientation) each

Lengths are in m. The faces of a polyhedron are seen from outside. The origin
of a body is its centre of mass.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from solutions.arrays import Array, Integers

Shape = tuple[Any, ...]

SPHERE, CAPSULE, BOX, POLYHEDRON, HALF_SPACE = range(5)
"""The kinds of convex pieces. In a pair, A has the lower kind."""
TOUCH = 1e-10
"""A gap up to which two surfaces touch, m; far above rounding."""


class Placed(NamedTuple):
    """Pieces of one kind where they are at an instant.

    Attributes
    ----------
    position : (n, 3), of the piece's own origin, m
    rotation : (n, 3, 3), from the piece's own axes to the world's
        The third column of a half-space is the normal out of it.
    size : (n, 3), m
        Of a sphere: radius, 0, 0. Of a capsule: radius, half length, 0. Of a
        box: its half extents. Of all others 0.
    vertices : (n, v, 3), in the world frame, m
        Of boxes and polyhedra; (n, 0, 3) for all others.
    faces : (f, s), numbers of vertices, counterclockwise from outside
        The same for all of these pieces. A face with fewer than s vertices
        repeats its last one.
    """

    position: Array
    rotation: Array
    size: Array
    vertices: Array
    faces: Integers


class Touching(NamedTuple):
    """Places where pairs of pieces touch, or nearly do.

    Attributes
    ----------
    pair : (k,), which of the pairs, ascending
    point : (k, 3), halfway between the two surfaces, m
    normal : (k, 3), unit, from B to A
    separation : (k,), distance of the surfaces along the normal, m
        It is negative in overlap.
    feature : (k,), a number that names the place on the two pieces, 0 to 65535
        It stays the same from one step to the next while the same features
        touch.
    """

    pair: Integers
    point: Array
    normal: Array
    separation: Array
    feature: Integers
