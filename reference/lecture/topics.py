"""The topics of the lecture in the order of teaching, one lab each."""

from __future__ import annotations

from dataclasses import dataclass

from reference.errors import UnknownName


@dataclass(frozen=True)
class Topic:
    """One lab: `name` is its module and its notebook, `title` its heading."""

    name: str
    title: str


TOPICS: tuple[Topic, ...] = (
    Topic("detection", "Detecting a collision"),
    Topic("response", "Bouncing off a plane"),
    Topic("friction", "Friction, sticking and sliding"),
    Topic("impulse", "Impulses between rigid bodies"),
    Topic("polyhedra", "Points, edges and polyhedra"),
    Topic("sweeping", "Swept volumes"),
    Topic("forces", "Gravity, viscosity and springs"),
    Topic("meshes", "Spring meshes"),
    Topic("avoidance", "Avoiding a collision"),
    Topic("world", "Everything in one world"),
)
"""The topics in the order of teaching."""


def topic(name: str) -> Topic:
    """Return the topic of that name.

    Raises
    ------
    UnknownName
        If the lecture has no such topic.
    """
    for entry in TOPICS:
        if entry.name == name:
            return entry
    raise UnknownName("topic", name, (entry.name for entry in TOPICS))
