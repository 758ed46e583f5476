"""Cases that other people set up and solved, with their numbers and where these stand.

Three kinds are kept apart. *Verification*: a closed form, or a number of a method that can be repeated digit by digit.
*Validation*: a measurement. *Cross-engine*: what another simulator said. One module a topic, each with its `CASES`.
"""

from __future__ import annotations

import functools
import importlib
import pkgutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from reference.errors import UnknownName

Kind = Literal["verification", "validation", "cross-engine"]
Figure = float | tuple[float, ...]


@dataclass(frozen=True)
class Published:
    """One published case.

    number: as in P15. statement: of the lecture, the one it bears on. setup: what to run, by name, SI units unless the
    source has none. expected: the published numbers by name. tolerance: for each of them, absolute, with `reason`: how
    many digits were printed, or what the method may be off by. source: who published it. note: what a reader must know.
    """

    number: int
    title: str
    statement: int
    kind: Kind
    source: str
    setup: Mapping[str, Figure]
    expected: Mapping[str, Figure]
    tolerance: Mapping[str, float]
    reason: str
    note: str = field(default="")

    @property
    def name(self) -> str:
        """As it is cited: P15."""
        return f"P{self.number}"


@functools.cache
def published_cases() -> dict[str, Published]:
    """All published cases by name, in the order of their numbers."""
    modules = [importlib.import_module(f"{__name__}.{info.name}") for info in pkgutil.iter_modules(__path__)]
    cases = sorted((case for module in modules for case in module.CASES), key=lambda case: case.number)
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
