"""Decides which scenarios the functions of the mesh topic can run: spring meshes that settle, vibrate or drape."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.scene.draping import ball_under, reach
from reference.scene.forces import Force
from reference.scene.scenario import Scenario, Sphere
from reference.scene.spring_network import network

FEWEST = 3
"""Fewer masses than these are one spring with two ends, and no mesh."""
SMALL = 1e-4
"""Largest strain of a spring in a vibration that counts as small."""
_ROUNDING = 1e-9


def settles(scenario: Scenario) -> bool:
    """Whether it is a mesh that hangs on something immovable, in a viscous fluid that brings it to rest."""
    return bool(scenario.fluid and scenario.fluid.viscosity > 0) and _is_mesh(scenario) and _all_hang(scenario)


def vibrates(scenario: Scenario) -> bool:
    """Whether it is a mesh without weight and load, hardly strained, whose vibrations do not mix.

    They do not if the damping of each spring is the same share of its stiffness.
    """
    if scenario.fluid or scenario.forces or any(scenario.gravity) or not _is_mesh(scenario):
        return False
    net = network(scenario)
    length = np.linalg.norm(net.place[net.edges[:, 0]] - net.place[net.edges[:, 1]], axis=-1)
    slight = np.abs(length - net.rest_length) <= SMALL * net.rest_length
    shares = net.damping * net.stiffness[0] - net.damping[0] * net.stiffness
    alike = np.abs(shares) <= _ROUNDING * net.damping[0] * net.stiffness[0]
    return bool(np.all(slight) and np.all(alike))


def drapes(scenario: Scenario) -> bool:
    """Whether it is a mesh of alike balls that a viscous fluid brings to rest on a fixed ball, on pins and springs."""
    ball = ball_under(scenario)
    if ball is None or not (scenario.fluid and scenario.fluid.viscosity > 0):
        return False
    movable = [body for body in scenario.bodies if not body.immovable]
    all_met = len(scenario.pairs) == len(movable)
    alike = len({reach(ball, body) for body in movable}) == 1
    return all_met and alike and _is_mesh(replace(scenario, pairs=())) and _all_hang(scenario)


def _is_mesh(scenario: Scenario) -> bool:
    """Whether all that moves is balls without spin, on which springs act at the centres, and constant forces."""
    movable = [body for body in scenario.bodies if not body.immovable]
    still = all(isinstance(body.shape, Sphere) and not any(body.angular_velocity) for body in movable)
    central = all(
        not any(point)
        for each in scenario.springs
        for name, point in ((each.body_a, each.point_a), (each.body_b, each.point_b))
        if name
    )
    steady = all(isinstance(push, Force) for push in scenario.forces) and not scenario.attractions
    enough = len(movable) >= FEWEST and bool(scenario.springs)
    return enough and still and central and steady and not scenario.pairs


def _all_hang(scenario: Scenario) -> bool:
    """Whether springs lead from every ball to something that nothing moves."""
    net = network(scenario)
    held = ~np.isfinite(net.mass)
    for _ in net.mass:
        reached = held[net.edges].any(axis=-1)
        held[net.edges[reached]] = True
    return bool(np.all(held))
