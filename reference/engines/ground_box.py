"""The ground as an engine gets it: a large box for engines that do better on a box, or a little higher than it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace

EXTENT, DEPTH = 100.0, 1.0
"""Half extents of the box, m: far larger than any way in the catalogue."""


def ground_box(body: Body) -> Body:
    """The box whose upper face is the surface of a body that is a half-space."""
    assert isinstance(body.shape, HalfSpace)
    normal = np.array(body.shape.normal)
    centre = np.array(body.position) - DEPTH * normal
    orientation = geometry.upright_on(normal)
    return replace(body, shape=Box((EXTENT, EXTENT, DEPTH)), position=tuple(centre), orientation=tuple(orientation))


def raised(body: Body, margin: float) -> Body:
    """The half-space with its surface higher by `margin`, m, so that what stands on it overlaps with it that much.

    At a gap of exactly zero rounding would decide whether an engine sees a contact in its first step.
    """
    assert isinstance(body.shape, HalfSpace)
    return replace(body, position=tuple(np.array(body.position) + margin * np.array(body.shape.normal)))


def from_raised(
    bodies: Sequence[Body], pair: tuple[int, int], middle: Array, normal: Array, separation: float, margin: float
) -> tuple[list[float], float]:
    """Place and separation of a contact with the ground where it is, from those with ground `margin` higher.

    pair: places of A and B among the bodies. middle: midway between the surfaces. normal: from B to A.
    """
    on_a, on_b = (isinstance(bodies[place].shape, HalfSpace) for place in pair)
    up = (int(on_b) - int(on_a)) * margin
    return (middle - up / 2 * normal).tolist(), separation + abs(up)
