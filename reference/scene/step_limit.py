"""The longest timestep with which the springs, dampers and drag of a scenario can be stepped."""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.checks import Vector
from reference.scene import geometry
from reference.scene.scenario import Scenario, Sphere


def step_limit(scenario: Scenario) -> float:
    """The timestep, s, beyond which motions grow without end in steps of semi-implicit Euler; infinity without any.

    A motion changes its sign at every step where (4 M − 2 dt C − dt² K) x = 0, with the masses M, the dampers C and the
    stiffness K of all bodies. With the largest eigenvalues c of M⁻¹ C and k of M⁻¹ K this needs
    dt ≥ 4/(c + √(c² + 4 k)), which is the limit itself for one spring. Springs pull along their direction at the start,
    and on centres of mass: turning is left out.
    """
    free = [body for body in scenario.bodies if not body.immovable]
    places = {body.name: 3 * place for place, body in enumerate(free)}
    rows = np.zeros((len(scenario.springs), 3 * len(free)))
    for row, spring in zip(rows, scenario.springs, strict=True):
        along = _end(scenario, spring.body_a, spring.point_a) - _end(scenario, spring.body_b, spring.point_b)
        for name, sign in ((spring.body_a, 1.0), (spring.body_b, -1.0)):
            if name in places and np.any(along):
                own = slice(places[name], places[name] + 3)
                row[own] = sign * along / np.linalg.norm(along) / math.sqrt(scenario.body(name).mass)
    damping, stiffness = (
        rows.T @ (np.array([getattr(spring, name) for spring in scenario.springs])[:, None] * rows)
        for name in ("damping", "stiffness")
    )
    viscosity = scenario.fluid.viscosity if scenario.fluid else 0.0
    radius = [body.shape.radius if isinstance(body.shape, Sphere) else 0.0 for body in free]
    drag = 6 * math.pi * viscosity * np.array(radius) / [body.mass for body in free]
    damping += np.diag(np.repeat(drag, 3))
    if not np.any(damping) and not np.any(stiffness):
        return math.inf
    c, k = (float(np.linalg.eigvalsh(each)[-1]) for each in (damping, stiffness))
    return 4 / (c + math.sqrt(c**2 + 4 * k))


def _end(scenario: Scenario, body: str, point: Vector) -> Array:
    """Where an end of a spring is at the start, (3,), m."""
    if not body:
        return np.array(point)
    tied = scenario.body(body)
    return np.array(tied.position) + geometry.rotate(np.array(tied.orientation), np.array(point))
