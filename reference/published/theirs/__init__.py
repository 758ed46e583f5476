"""What other people published: citations, set-ups, numbers and tolerances, one module a topic, each with its `CASES`.

Nothing here says how a case is run; see `reference.published.drivers`.
"""

from __future__ import annotations

import functools

from reference.errors import UnknownName
from reference.published.case import Published
from reference.published.theirs import (
    avoidance,
    bounces,
    detection,
    forces,
    friction,
    impulse,
    meshes,
    polyhedra,
    sliding,
    springs,
    sweeping,
    world,
)

_TOPICS = (
    avoidance,
    bounces,
    detection,
    forces,
    friction,
    impulse,
    meshes,
    polyhedra,
    sliding,
    springs,
    sweeping,
    world,
)


@functools.cache
def published_cases() -> dict[str, Published]:
    """All published cases by name, in the order of their numbers."""
    cases = [case for topic in _TOPICS for case in topic.CASES]
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
