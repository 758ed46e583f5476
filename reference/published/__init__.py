"""Cases that other people set up and solved, with their numbers and where these stand.

Three kinds are kept apart. *Verification*: a closed form, or a number of a method that can be repeated digit by digit.
*Validation*: a measurement. *Cross-engine*: what another simulator said. One module a topic, each with its `CASES`.
"""

from __future__ import annotations

import functools
import importlib
import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from reference.engines.base import Engine
from reference.engines.implementation import Implementation
from reference.errors import UnknownName

Kind = Literal["verification", "validation", "cross-engine"]
Figure = float | tuple[float, ...]


@dataclass(frozen=True)
class Answer:
    """What one implementation says of one published figure.

    value: None where it has none, and `reason` says why. tolerance: absolute, with its reason, where the method at hand
    allows less than what was printed; None for the case's own. shift: what this implementation is known to do to the
    figure, with its reason and its own tolerance.
    """

    value: Figure | None
    tolerance: Figure | None = None
    reason: str = ""
    shift: Figure = 0.0
    shift_reason: str = ""
    shift_tolerance: Figure = 0.0


Answers = Mapping[str, Answer]
"""By the names of the figures that are expected."""


def said(**figures: Figure) -> Answers:
    """Answers that need no more than the number itself."""
    return {name: Answer(value) for name, value in figures.items()}


@dataclass(frozen=True)
class Published:
    """One published case.

    number: as in P15. statement: of the lecture, the one it bears on. setup: what to run, by name, SI units unless the
    source has none. expected: the published numbers by name. tolerance: for each of them, absolute, with `reason`: how
    many digits were printed, or what the method may be off by. source: who published it. note: what a reader must know.
    origin: the engine here whose own number it is, if any. by_hand: how an implementation's functions answer it.
    in_engine: how an engine runs it. why_not: of an engine by name, or `engines` or `by hand`, why it is not run there.
    units: of the expected figures, none where they are pure numbers. labels: of a figure with several numbers, what
    each belongs to.
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
    note: str = field(default="")
    origin: str = ""
    by_hand: Callable[[Published, Implementation], Answers] | None = field(default=None, compare=False)
    in_engine: Callable[[Published, Engine], Answers] | None = field(default=None, compare=False)
    why_not: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    labels: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """As it is cited: P15."""
        return f"P{self.number}"

    def value(self, name: str) -> float:
        """A number of the set-up."""
        found = self.setup[name]
        assert not isinstance(found, tuple), f"{self.name} has several numbers as {name}"
        return found

    def expected_value(self, name: str) -> float:
        """A figure that is a single number."""
        found = self.expected[name]
        assert not isinstance(found, tuple), f"{self.name} expects several numbers as {name}"
        return found

    def values(self, *names: str) -> tuple[float, ...]:
        """Several single numbers of the set-up, or all numbers of one that has several."""
        if len(names) == 1 and isinstance(found := self.setup[names[0]], tuple):
            return found
        return tuple(map(self.value, names))


@functools.cache
def published_cases() -> dict[str, Published]:
    """All published cases by name, in the order of their numbers: the `CASES` of this folder's modules."""
    modules = [importlib.import_module(f"{__name__}.{info.name}") for info in pkgutil.iter_modules(__path__)]
    found = [case for module in modules for case in getattr(module, "CASES", ())]
    cases = sorted(found, key=lambda case: case.number)
    return {case.name: case for case in cases}


def published(name: str) -> Published:
    """Return the case of that name.

    Raises
    ------
    UnknownName
        If there is none.
    """
    try:
        return published_cases()[name]
    except KeyError:
        raise UnknownName("published case", name, published_cases()) from None
