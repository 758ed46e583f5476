"""What an engine says of its own world, compared with what it was told.

An adapter asks its engine once, after the world is built and before the first step. If the engine says something else
than it was told, the run is refused: the lab would judge another experiment than the one that the scenario describes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from reference.errors import NotAsTold
from reference.scene.scenario import Pair, Scenario

NEAR = 1e-9
"""Share by which two numbers may differ. A square root that is squared again, or the inverse of an inverse mass, is off
in its sixteenth digit."""

Value = float | str | Sequence[float]


def check(title: str, name: str, told: Value, found: Value, unit: str = "") -> None:
    """Refuse the run if the engine of that title says `found` of a quantity, and was told something else."""
    if not _same(told, found):
        raise NotAsTold(f"{title} says {name} {_shown(found, unit)}, and was told {_shown(told, unit)}")


def check_bodies(title: str, scenario: Scenario, masses: Sequence[float], moments: Sequence[Sequence[float]]) -> None:
    """Check all masses, kg, infinite where nothing moves a body, and the principal moments of inertia of the others."""
    for body, mass, inertia in zip(scenario.bodies, masses, moments, strict=True):
        check(title, f"mass of {body.name}", body.mass, mass, "kg")
        if not body.immovable:
            check(title, f"inertia of {body.name}", body.moments_of_inertia(), inertia, "kg m²")


def check_pair(title: str, name: str, pair: Pair, told: float, found: float) -> None:
    """Check a coefficient of a pair of bodies."""
    check(title, f"{name} of {pair.body_a} and {pair.body_b}", told, found)


def _same(told: Value, found: Value) -> bool:
    if isinstance(told, str) or isinstance(found, str):
        return told == found
    said, heard = _numbers(told), _numbers(found)
    largest = max(map(abs, said))
    near = 0.0 if math.isinf(largest) else NEAR * largest
    return len(said) == len(heard) and all(a == b or abs(a - b) <= near for a, b in zip(said, heard, strict=True))


def _numbers(value: float | Sequence[float]) -> list[float]:
    return [float(value)] if isinstance(value, int | float) else [float(number) for number in value]


def _shown(value: Value, unit: str) -> str:
    if isinstance(value, str):
        return value
    words = [f"{number:.12g}" for number in _numbers(value)]
    return " ".join(filter(None, [words[0] if len(words) == 1 else f"({', '.join(words)})", unit]))
