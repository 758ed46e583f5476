"""How light a body is between heavier ones: what slows down a solver that goes from contact to contact."""

from __future__ import annotations

import math

from reference.scene.scenario import Scenario

SWEEPS_PER_RATIO = 20
"""So many sweeps for each unit of the ratio of masses. With a mass m between two of M, a sweep carries at least the
share m/M of what is missing from one to the other by each of its two contacts, and leaves 1 − 2 m/M of it: exp(−40)
after 20 M/m sweeps, which is rounding."""


def sweeps_needed(scenario: Scenario) -> int:
    """How many sweeps carry an impulse through the lightest body that others press on; 20 for bodies that are alike."""
    return math.ceil(SWEEPS_PER_RATIO * _heaviest_ratio(scenario))


def _heaviest_ratio(scenario: Scenario) -> float:
    """Greatest mass of a neighbour in units of the mass of a body that has two of them or more; at least 1."""
    neighbours: dict[str, list[float]] = {body.name: [] for body in scenario.bodies if not body.immovable}
    for pair in scenario.pairs:
        for one, other in ((pair.body_a, pair.body_b), (pair.body_b, pair.body_a)):
            if one in neighbours and other in neighbours:
                neighbours[one].append(scenario.body(other).mass)
    ratios = [max(of) / scenario.body(name).mass for name, of in neighbours.items() if len(of) > 1]
    return max([1.0, *ratios])
