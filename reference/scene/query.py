"""Questions of geometry: how far a ray gets, how far two bodies are apart. Plain data; `Engine.query` answers."""

from __future__ import annotations

from dataclasses import dataclass

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


Query = Ray | Distance
