"""A published case: what somebody set up, the numbers that were found, and how near is near enough; plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

Kind = Literal["verification", "validation", "cross-engine"]
"""*Verification*: a closed form, or a number of a method that can be repeated digit by digit. *Validation*: a
measurement. *Cross-engine*: the number that another simulator gave. The three are kept apart."""
Figure = float | tuple[float, ...]
"""One published number, or several that belong together."""


@dataclass(frozen=True, kw_only=True)
class Published:
    """One published case.

    number: 15 for P15. statement: the lecture's statement that the case tests. source: who published it. setup: what
    to run, by name, in SI units and degrees unless the source has no units; an engine's recorded answers carry a
    fingerprint of it. expected: the published figures by name. tolerance: of each figure, absolute, with its `reason`:
    how many digits were printed, or how far off the method may be. note: what a reader must know. origin: the engine
    here that gave the numbers itself, if any. units: of the figures, none where they are pure numbers. labels: what
    each number of a figure belongs to, where it has several.
    """

    number: int
    title: str
    statement: int
    kind: Kind
    source: str
    setup: Mapping[str, Figure]
    expected: Mapping[str, Figure]
    tolerance: Mapping[str, Figure]
    reason: str
    note: str = ""
    origin: str = ""
    units: Mapping[str, str] = field(default_factory=dict)
    labels: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """As it is cited: P15."""
        return f"P{self.number}"

    def value(self, name: str) -> float:
        """An entry of the set-up that is a single number."""
        return self._single(name, self.setup[name])

    def values(self, *names: str) -> tuple[float, ...]:
        """Several entries of the set-up, each a single number."""
        return tuple(map(self.value, names))

    def numbers(self, name: str) -> tuple[float, ...]:
        """All numbers of one entry of the set-up, be it one or several."""
        return numbers_of(self.setup[name])

    def expected_value(self, name: str) -> float:
        """A figure that is a single number."""
        return self._single(name, self.expected[name])

    def expected_numbers(self, name: str) -> tuple[float, ...]:
        """All numbers of one figure, be it one or several."""
        return numbers_of(self.expected[name])

    def _single(self, name: str, found: Figure) -> float:
        assert not isinstance(found, tuple), f"{self.name} has several numbers as {name}"
        return found


def numbers_of(figure: Figure) -> tuple[float, ...]:
    """The numbers of a figure, one or several, as plain floats."""
    return tuple(np.ravel(figure).tolist())
