"""Questions of geometry: how far a ray gets, how far two bodies are apart. Plain data; `Engine.query` answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from reference import checks
from reference.checks import Vector
from reference.errors import InvalidInput
from reference.scene.scenario import Body


@dataclass(frozen=True)
class Ray:
    """Which share of the way from `start` along `way`, both in m, a ray goes until it meets the body; infinity if none.

    The ray ends where the way does. Its result is not defined if it starts inside the body.
    """

    body: Body
    start: Vector
    way: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", checks.vector("start", self.start))
        object.__setattr__(self, "way", checks.vector("way", self.way))
        if not any(self.way):
            raise InvalidInput("way is (0, 0, 0); a ray needs a direction")


@dataclass(frozen=True)
class Distance:
    """How far the surfaces of two bodies are apart where they are nearest, m; negative where they overlap."""

    body_a: Body
    body_b: Body

    def __post_init__(self) -> None:
        if self.body_a.name == self.body_b.name:
            raise InvalidInput(f"two bodies share the name {self.body_a.name!r}")


@dataclass(frozen=True)
class Inside:
    """Whether a point, m, lies within a body: 1 or 0. On the surface it is not defined."""

    body: Body
    point: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", checks.vector("point", self.point))


@dataclass(frozen=True)
class Segment:
    """What length, m, of the segment from `start` to `end`, both in m and outside of the body, lies within it."""

    body: Body
    start: Vector
    end: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", checks.vector("start", self.start))
        object.__setattr__(self, "end", checks.vector("end", self.end))
        if self.start == self.end:
            raise InvalidInput(f"the segment starts and ends at {self.start}; it needs a length")


Query = Ray | Distance | Inside | Segment


def bodies_of(query: Query) -> tuple[Body, ...]:
    """The bodies that a question is about."""
    return (query.body_a, query.body_b) if isinstance(query, Distance) else (query.body,)


def asked_of(query: Query, bodies: Mapping[str, Body]) -> Query:
    """The same question, about the bodies of the same names."""
    if isinstance(query, Distance):
        return replace(query, body_a=bodies[query.body_a.name], body_b=bodies[query.body_b.name])
    return replace(query, body=bodies[query.body.name])
