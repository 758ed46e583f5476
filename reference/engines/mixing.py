"""One coefficient a body, for engines that make a pair's of two bodies': such that each pair gets what it asks for."""

from __future__ import annotations

import math
from collections.abc import Callable

from reference.scene.scenario import Body, Pair, Scenario

Coefficient = Callable[[Pair], float]
"""Which coefficient of a pair is meant."""


def factors(scenario: Scenario, of: Coefficient) -> list[float] | None:
    """One number a body such that each pair's product is its coefficient; None where no way of ours gives it.

    All get the same square root; or the movable body gets all of it and the immovable one 1; or each body gets what
    the one that leads to it leaves open, which suits whatever stands on one another without closing a ring.
    """
    if not scenario.pairs:
        return [0.0] * len(scenario.bodies)
    alike = dict.fromkeys((body.name for body in scenario.bodies), math.sqrt(of(scenario.pairs[0])))
    one_sided = {body.name: _own_or_one(scenario, body, of) for body in scenario.bodies}
    for chosen in (alike, one_sided, _one_after_another(scenario, of)):
        if all(math.isclose(chosen[p.body_a] * chosen[p.body_b], of(p), abs_tol=1e-15) for p in scenario.pairs):
            return [chosen[body.name] for body in scenario.bodies]
    return None


def _own_or_one(scenario: Scenario, body: Body, of: Coefficient) -> float:
    if body.immovable:
        return 1.0
    return next((of(pair) for pair in scenario.pairs if body.name in (pair.body_a, pair.body_b)), 0.0)


def _one_after_another(scenario: Scenario, of: Coefficient) -> dict[str, float]:
    """1 for the first body, for those that it meets their pair's coefficient, and so on outward."""
    chosen: dict[str, float] = {}
    for first in scenario.bodies:
        reached = [] if first.name in chosen else [first.name]
        chosen.setdefault(first.name, 1.0)
        for name in reached:
            for pair in scenario.pairs:
                other = {pair.body_a: pair.body_b, pair.body_b: pair.body_a}.get(name)
                if other is not None and other not in chosen:
                    chosen[other] = of(pair) / chosen[name] if chosen[name] else 0.0
                    reached.append(other)
    return chosen


def least(scenario: Scenario, of: Coefficient) -> list[float] | None:
    """One number a body such that the smaller one of each pair is its coefficient; None where there is no such choice.

    A body's number is at least the largest of its pairs', and anything above that only raises what pairs get.
    """
    chosen = {
        body.name: max((of(pair) for pair in scenario.pairs if body.name in (pair.body_a, pair.body_b)), default=0.0)
        for body in scenario.bodies
    }
    if any(min(chosen[pair.body_a], chosen[pair.body_b]) != of(pair) for pair in scenario.pairs):
        return None
    return [chosen[body.name] for body in scenario.bodies]
