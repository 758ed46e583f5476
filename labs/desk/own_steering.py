"""The bodies of a case whose rules steer them, for a notebook's own formulas."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from labs.desk.own_motion import first_scenario
from reference.arrays import Array
from reference.errors import InvalidInput
from reference.scene.scenario import Sphere


@dataclass(frozen=True, eq=False)
class Walkers:
    """Those whom a rule steers, at the start. positions, velocities: (n, 3), m and m/s. radii: (n,), m."""

    positions: Array
    velocities: Array
    radii: Array


def walkers(case: str) -> Walkers:
    """The walkers of a case such as `crossing-streams/θ=70°`.

    Raises
    ------
    InvalidInput, UnknownName
        If there is no such case, or no rule steers balls in it.
    """
    scenario = first_scenario(case)
    bodies = [scenario.body(name) for rule in scenario.steering for name in rule.bodies]
    radii = [body.shape.radius for body in bodies if isinstance(body.shape, Sphere)]
    if not bodies or len(radii) < len(bodies):
        raise InvalidInput(f"in {case} no rule steers balls")
    return Walkers(
        np.array([body.position for body in bodies]), np.array([body.velocity for body in bodies]), np.array(radii)
    )
