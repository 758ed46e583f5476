"""One coefficient for each body, for engines that combine the coefficients of two bodies into that of the pair."""

from __future__ import annotations

import math
from collections.abc import Callable

from reference.scene.scenario import Body, Pair, Scenario

Coefficient = Callable[[Pair], float]
"""Takes one of a pair's coefficients from it."""


def factors(scenario: Scenario, of: Coefficient, most: float = math.inf) -> list[float] | None:
    """One number for each body such that the product of two is the pair's coefficient; None if we find no such choice.

    most: the largest number that a body may get. We try four choices. Every body gets the square root of the
    coefficient. Or the movable body of each pair gets the whole coefficient and the immovable one gets 1. Or we go from
    body to body along the pairs, and each gets what the body before it leaves open; that suits bodies that stand on one
    another, as long as they do not close a ring. Or we do so, and make the largest number as small as it can be.
    """
    if not scenario.pairs:
        return [0.0] * len(scenario.bodies)
    alike = dict.fromkeys((body.name for body in scenario.bodies), math.sqrt(of(scenario.pairs[0])))
    one_sided = {body.name: _own_or_one(scenario, body, of) for body in scenario.bodies}
    for chosen in (alike, one_sided, _one_after_another(scenario, of), _one_after_another(scenario, of, level=True)):
        if max(chosen.values()) <= most and all(
            math.isclose(chosen[p.body_a] * chosen[p.body_b], of(p), abs_tol=1e-15) for p in scenario.pairs
        ):
            return [chosen[body.name] for body in scenario.bodies]
    return None


def _own_or_one(scenario: Scenario, body: Body, of: Coefficient) -> float:
    if body.immovable:
        return 1.0
    return next((of(pair) for pair in scenario.pairs if body.name in (pair.body_a, pair.body_b)), 0.0)


def _one_after_another(scenario: Scenario, of: Coefficient, level: bool = False) -> dict[str, float]:
    """1 for the first body; for the bodies that it meets, the pair's coefficient divided by 1; and so on outward.

    level: then multiply every other body on the way by one number, and divide the rest by it, so that the largest of
    both are equal.
    """
    chosen: dict[str, float] = {}
    for first in scenario.bodies:
        reached = [] if first.name in chosen else [first.name]
        chosen.setdefault(first.name, 1.0)
        sides = {first.name: 0}
        for name in reached:
            for pair in scenario.pairs:
                other = {pair.body_a: pair.body_b, pair.body_b: pair.body_a}.get(name)
                if other is not None and other not in chosen:
                    chosen[other] = of(pair) / chosen[name] if chosen[name] else 0.0
                    reached.append(other)
                    sides[other] = 1 - sides[name]
        if level and reached:
            one, two = (max((chosen[name] for name in reached if sides[name] == side), default=0.0) for side in (0, 1))
            share = math.sqrt(two / one) if one and two else 1.0
            chosen |= {name: chosen[name] * (1 / share if sides[name] else share) for name in reached}
    return chosen


def least(scenario: Scenario, of: Coefficient) -> list[float] | None:
    """One number for each body such that the smaller of two is the pair's coefficient; None if there is no such choice.

    A body's number must be at least the largest coefficient of its pairs, and more than that can only make the smaller
    of two numbers larger. So each body gets just that.
    """
    return _extreme(scenario, of, of_a_body=max, of_two=min)


def greatest(scenario: Scenario, of: Coefficient) -> list[float] | None:
    """One number for each body such that the larger of two is the pair's coefficient; None if there is no such choice.

    As in `least`, with smaller and larger exchanged: each body gets the smallest coefficient of its pairs.
    """
    return _extreme(scenario, of, of_a_body=min, of_two=max)


def _extreme(
    scenario: Scenario, of: Coefficient, of_a_body: Callable[..., float], of_two: Callable[..., float]
) -> list[float] | None:
    chosen = {
        body.name: of_a_body(
            (of(pair) for pair in scenario.pairs if body.name in (pair.body_a, pair.body_b)), default=0.0
        )
        for body in scenario.bodies
    }
    if any(of_two(chosen[pair.body_a], chosen[pair.body_b]) != of(pair) for pair in scenario.pairs):
        return None
    return [chosen[body.name] for body in scenario.bodies]
