"""Two boxes that meet edge on edge: when and where they touch, along which normal, and the impulse of a smooth impact.

While neither box turns, their edges keep their directions a and b, and so does the normal n = a × b (slide 17). Along n
the two lines approach with a constant rate; they touch where n·(p_A − p_B) = 0 for any two points on them.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.scenario import Body, Box

PARALLEL = 1e-6
"""Sine of an angle below which two edges have no common normal."""


@dataclass(frozen=True)
class Meeting:
    """Two edges that meet. time: s. normal: unit, from B to A. edges: of A and of B, a point and a unit direction each.

    rate: of the gap along the normal before the impact, m/s, negative.
    """

    body_a: Body
    body_b: Body
    time: float
    normal: Array
    rate: float
    edges: tuple[tuple[Array, Array], tuple[Array, Array]]

    def softness(self, time: float) -> float:
        """What a unit impulse along the normal changes of the gap's rate, 1/kg, at a time: 1/M_A + 1/M_B + turns."""
        return sum(
            body.inverse_mass + float(turn @ np.cross(arm, self.normal))
            for body, arm, turn in zip((self.body_a, self.body_b), self.arms(time), self.turns(time), strict=True)
        )

    def turns(self, time: float) -> tuple[Array, Array]:
        """I⁻¹ (r × n) of A and of B, 1/(kg m)."""
        found = [
            _inverse_inertia(body) @ np.cross(arm, self.normal)
            for body, arm in zip((self.body_a, self.body_b), self.arms(time), strict=True)
        ]
        return found[0], found[1]

    def arms(self, time: float) -> tuple[Array, Array]:
        """From the two centres to the points of the edges that are nearest to each other, (3,) each, m."""
        (p, a), (q, b) = self.edges
        p = p + time * np.array(self.body_a.velocity)
        q = q + time * np.array(self.body_b.velocity)
        # p + s a − q − t b is along a × b
        s, t, _ = np.linalg.solve(np.column_stack([a, -b, np.cross(a, b)]), q - p)
        centres = (np.add(body.position, time * np.array(body.velocity)) for body in (self.body_a, self.body_b))
        of_a, of_b = centres
        return p + s * a - of_a, q + t * b - of_b


def meeting(body_a: Body, body_b: Body) -> Meeting:
    """The first two edges that cross, of two boxes that fly straight and do not turn."""
    way = np.subtract(body_a.velocity, body_b.velocity)
    found: Meeting | None = None
    for edge_a, edge_b in itertools.product(_edges(body_a), _edges(body_b)):
        (p, a, half_a), (q, b, half_b) = edge_a, edge_b
        normal = np.cross(a, b)
        length = float(np.linalg.norm(normal))
        if length < PARALLEL:
            continue
        normal = normal / length * (-1.0 if normal @ way > 0 else 1.0)
        rate = float(normal @ way)
        if rate == 0:
            continue
        time = float(normal @ (q - p)) / rate
        if not 0 < time < (found.time if found else math.inf):
            continue
        s, t, _ = np.linalg.solve(np.column_stack([a, -b, np.cross(a, b)]), q - p - time * way)
        if abs(s) <= half_a and abs(t) <= half_b:
            found = Meeting(body_a, body_b, time, normal, rate, ((p, a), (q, b)))
    if found is None:
        raise RunFailed(f"no edge of {body_a.name} meets an edge of {body_b.name}")
    return found


def _edges(body: Body) -> list[tuple[Array, Array, float]]:
    """The twelve edges at the start: middle, unit direction and half length."""
    assert isinstance(body.shape, Box)
    half, found = np.array(body.shape.half_extents), []
    for axis in range(3):
        for signs in itertools.product((-1.0, 1.0), repeat=2):
            corner = np.insert(np.array(signs), axis, 0.0) * half
            turn = np.array(body.orientation)
            middle = np.array(body.position) + geometry.rotate(turn, corner)
            found.append((middle, geometry.rotate(turn, np.eye(3)[axis]), float(half[axis])))
    return found


def _inverse_inertia(body: Body) -> Array:
    """About the world's axes: R I⁻¹ Rᵀ, (3, 3), 1/(kg m²)."""
    turn = np.array(body.orientation)
    axes = np.column_stack([geometry.rotate(turn, axis) for axis in np.eye(3)])
    return np.asarray(axes / np.array(body.moments_of_inertia()) @ axes.T)
