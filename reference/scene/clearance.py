"""How near bodies come to each other in a run: the least gap, between samples too, from the poses alone."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace

import numpy as np

from reference.arrays import Array
from reference.scene import geometry
from reference.scene.query import Distance
from reference.scene.scenario import Body, Box, Scenario, Sphere

HALVINGS = 60
"""Times by which a stretch in which a gap has its minimum is shortened by a third: down to rounding."""


@dataclass(frozen=True)
class Nearest:
    """Where two bodies are nearest. gap: m, negative in overlap. position_a, position_b: of their centres there, m."""

    gap: float
    body_a: Body
    body_b: Body
    position_a: Array
    position_b: Array

    def question(self) -> Distance:
        """The question that an implementation has to answer with the same gap."""
        (x, y, z), (u, v, w) = self.position_a.tolist(), self.position_b.tolist()
        return Distance(replace(self.body_a, position=(x, y, z)), replace(self.body_b, position=(u, v, w)))


def nearest(scenario: Scenario, positions: Array) -> Nearest | None:
    """Where two bodies come nearest of all, positions being those of all bodies at some samples, (n, bodies, 3), m.

    Between two samples each body goes straight ahead. Counted are a ball and another one, and a ball and a fixed box,
    whether they collide or pass through each other; two bodies that cannot move do not count. None where nothing is
    left.
    """
    found = []
    for a, b in itertools.combinations(range(len(scenario.bodies)), 2):
        bodies = scenario.bodies[a], scenario.bodies[b]
        if all(body.immovable for body in bodies) or not _is_known(*bodies):
            continue
        gap, stretch, share = _least_gap(*bodies, positions[:, a], positions[:, b])
        there = positions[stretch] + share * (positions[stretch + 1] - positions[stretch])
        found.append(Nearest(gap, *bodies, there[a], there[b]))
    return min(found, key=lambda each: each.gap, default=None)


def _is_known(body_a: Body, body_b: Body) -> bool:
    shapes = [body.shape for body in (body_a, body_b)]
    fixed_box = any(isinstance(body.shape, Box) and body.immovable for body in (body_a, body_b))
    balls = sum(isinstance(shape, Sphere) for shape in shapes)
    return balls == 2 or (balls == 1 and fixed_box)


def _least_gap(body_a: Body, body_b: Body, positions_a: Array, positions_b: Array) -> tuple[float, int, float]:
    """The least gap, the stretch between two samples in which it is, and at which share of the stretch."""
    between = positions_b - positions_a
    start, way = between[:-1], np.diff(between, axis=0)
    if isinstance(body_a.shape, Sphere) and isinstance(body_b.shape, Sphere):
        squared = np.sum(way * way, axis=-1)
        share = np.clip(-np.sum(start * way, axis=-1) / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    else:
        share = _least_share(body_a, body_b, start, way)
    gaps = _gaps(body_a, body_b, start + share[:, None] * way)
    stretch = int(np.argmin(gaps))
    return float(gaps[stretch]), stretch, float(share[stretch])


def _least_share(body_a: Body, body_b: Body, start: Array, way: Array) -> Array:
    """Where on each stretch the gap is least. Along a line, the distance from a convex body has one minimum."""
    low, high = np.zeros(len(start)), np.ones(len(start))
    for _ in range(HALVINGS):
        first, second = low + (high - low) / 3, high - (high - low) / 3
        at_first, at_second = (_gaps(body_a, body_b, start + each[:, None] * way) for each in (first, second))
        low, high = np.where(at_first > at_second, first, low), np.where(at_first > at_second, high, second)
    return np.asarray((low + high) / 2)


def _gaps(body_a: Body, body_b: Body, between: Array) -> Array:
    """Gaps of two bodies whose centres are apart by these vectors, from A to B, (n, 3)."""
    radius = sum(body.shape.radius for body in (body_a, body_b) if isinstance(body.shape, Sphere))
    box = next((body for body in (body_a, body_b) if isinstance(body.shape, Box)), None)
    if box is None:
        return np.asarray(np.linalg.norm(between, axis=-1) - radius)
    assert isinstance(box.shape, Box)
    out = geometry.out_of_box(between, np.array(box.orientation), np.array(box.shape.half_extents))
    return np.asarray(out - radius)
