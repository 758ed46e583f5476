"""A case: one setting of a family's parameters, as the scenarios that it is run in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from reference.scene.scenario import Scenario


@dataclass(frozen=True)
class Case:
    """One setting of the parameters. Several scenarios make an ensemble: the result is the mean over them."""

    name: str
    scenarios: tuple[Scenario, ...]
    parameters: Mapping[str, float]
