"""What is measured of a spring mesh that has come to rest, and what theory expects of it."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from reference import drape_truth, mesh_truth
from reference.arrays import Array
from reference.catalogue.case import Case
from reference.catalogue.family import Expectation
from reference.engines.base import EXACT, Method
from reference.errors import RunFailed
from reference.scene.draping import ball_under, reach
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.spring_network import network
from reference.scene.trajectory import Trajectory

SHARE = 1e-3
"""Accepted share of a length or a force: 0.1 %."""
SOLVED = 1e-7
"""What solving for the balance leaves at most, as a share: 10⁻¹⁰ of the largest weight, over a hundred times as much
where the mesh is soft."""
Number = Callable[[Scenario, Array], float]
"""The scenario and the places of its nodes, (n, 3), m → a number."""


@functools.lru_cache(maxsize=256)
def at_rest(scenario: Scenario) -> Array:
    """Where theory has the nodes of a mesh at rest, (n, 3), m."""
    net = network(scenario)
    told = net.place, net.free, net.edges, net.stiffness, net.rest_length, net.load
    ball = ball_of(scenario)
    return drape_truth.draped(*told, ball) if ball else mesh_truth.equilibrium(*told)


def ball_of(scenario: Scenario) -> drape_truth.Ball | None:
    """The fixed ball on which a mesh may lie, as theory is told it; None where there is none."""
    under = ball_under(scenario)
    if under is None:
        return None
    met = {name for pair in scenario.pairs for name in (pair.body_a, pair.body_b)} - {under.name}
    reaches = [reach(under, body) if body.name in met else 0.0 for body in scenario.bodies]
    world = np.zeros(len(network(scenario).place) - len(reaches))
    return drape_truth.Ball(np.array(under.position), np.concatenate([reaches, world]))


def at_end(number: Number) -> Callable[[Trajectory], float]:
    """Measure a number of the last shape."""
    return lambda trajectory: number(trajectory.scenario, trajectory.positions[-1])


def early(number: Number, time: float) -> Callable[[Trajectory], float]:
    """Measure a number of the shape at a time, s, at which the mesh is on its way; theory has no figure for it."""

    def measure(trajectory: Trajectory) -> float:
        if not np.any(trajectory.velocities):
            raise RunFailed("it is in its shape at rest at once, and has no way there")
        return number(trajectory.scenario, trajectory.positions[int(np.argmin(np.abs(trajectory.times - time)))])

    return measure


def expect(number: Number, what: str, left: str) -> Callable[[Case, Settings, Method], Expectation]:
    """Expect the number of the shape at rest, within 0.1 %. left: what is left of the motion at the end, in words."""

    def expectation(case: Case, settings: Settings, method: Method) -> Expectation:
        scenario = case.scenarios[0]
        value = number(scenario, at_rest(scenario))
        if method.kind == EXACT:
            return Expectation(value, SOLVED * abs(value), "10⁻⁷ of it: how nearly the forces balance")
        return Expectation(value, SHARE * abs(value), f"0.1 % of the {what}; {left}")

    return expectation


def off(trajectory: Trajectory) -> float:
    """Largest distance of a node from where it rests in theory, m."""
    return float(np.max(np.linalg.norm(trajectory.positions[-1] - at_rest(trajectory.scenario), axis=-1)))
