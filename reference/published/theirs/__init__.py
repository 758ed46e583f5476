"""What other people published: citations, set-ups, numbers and tolerances, one module a topic, each with its `CASES`.

Nothing here says how a case is run; see `reference.published.drivers`.
"""

from __future__ import annotations

import functools
import importlib

from reference.errors import UnknownName
from reference.published.case import Published

MODULES = (
    "avoidance",
    "bounces",
    "detection",
    "forces",
    "friction",
    "impulse",
    "meshes",
    "polyhedra",
    "sliding",
    "springs",
    "sweeping",
    "world",
)
"""One for each topic; each has its `CASES`."""


@functools.cache
def published_cases() -> dict[str, Published]:
    """All published cases by name, in the order of their numbers."""
    topics = [importlib.import_module(f"{__name__}.{name}") for name in MODULES]
    cases = [case for topic in topics for case in topic.CASES]
    return {case.name: case for case in sorted(cases, key=lambda case: case.number)}


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
