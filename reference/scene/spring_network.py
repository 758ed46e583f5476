"""The bodies and springs of a scenario as nodes and edges, for what treats all of them together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.arrays import Array, Integers
from reference.scene.scenario import Scenario


@dataclass(frozen=True, eq=False)
class Network:
    """Point masses joined by springs.

    place: (n, 3), m, where the nodes start: the bodies in the scenario's order, then the points of the world at which
    springs end. mass: (n,), kg, infinite for a node that nothing moves. edges: (m, 2), the two nodes of each spring.
    stiffness, rest_length, damping: (m,), N/m, m and N s/m. load: (n, 3), N, weights and constant pushes.
    """

    place: Array
    mass: Array
    edges: Integers
    stiffness: Array
    rest_length: Array
    damping: Array
    load: Array

    @property
    def free(self) -> Integers:
        """The numbers of the nodes that move."""
        return np.flatnonzero(np.isfinite(self.mass))


def network(scenario: Scenario) -> Network:
    """The network of a scenario whose springs end at the centres of bodies or in the world."""
    places = [body.position for body in scenario.bodies]
    edges = []
    for spring in scenario.springs:
        ends = []
        for name, point in ((spring.body_a, spring.point_a), (spring.body_b, spring.point_b)):
            ends.append(scenario.index(name) if name else len(places))
            places += [] if name else [point]
        edges.append(ends)
    bodies = scenario.bodies
    mass = np.array([*(body.mass for body in bodies), *(np.inf for _ in places[len(bodies) :])])
    load = np.where(np.isfinite(mass), mass, 0.0)[:, None] * np.array(scenario.gravity)
    for push in scenario.forces:
        load[scenario.index(push.body)] += push.at(0.0)
    stiffness, rest_length, damping = (
        np.array([getattr(each, name) for each in scenario.springs]) for name in ("stiffness", "rest_length", "damping")
    )
    place = np.array(places, dtype=np.float64)
    return Network(place, mass, np.array(edges, dtype=np.int64), stiffness, rest_length, damping, load)
