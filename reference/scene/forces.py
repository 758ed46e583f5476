"""Forces besides weight and contact: pushes, springs, attractions and a fluid, in SI units, for any engine."""

from __future__ import annotations

import math
from dataclasses import dataclass

from reference import checks
from reference.checks import Vector
from reference.errors import InvalidInput

NOWHERE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Force:
    """A constant force on a body, N, in the world frame. It acts at the centre of mass and turns nothing."""

    body: str
    force: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "force", checks.vector(f"force on {self.body}", self.force))

    def at(self, time: float) -> Vector:
        """The force at a time, N: always the same."""
        return self.force


@dataclass(frozen=True)
class GrowingForce:
    """A force on a body that grows evenly from nothing, at `rate` N/s, in the world frame, at the centre of mass."""

    body: str
    rate: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "rate", checks.vector(f"rate of the force on {self.body}", self.rate))

    def at(self, time: float) -> Vector:
        """The force at a time, N."""
        x, y, z = self.rate
        return x * time, y * time, z * time


@dataclass(frozen=True)
class OscillatingForce:
    """A force `amplitude` · cos(`angular_frequency` t + `phase`) at a body's centre; N, rad/s, rad, world frame."""

    body: str
    amplitude: Vector
    angular_frequency: float
    phase: float = 0.0

    def __post_init__(self) -> None:
        on = f"force on {self.body}:"
        object.__setattr__(self, "amplitude", checks.vector(f"{on} amplitude", self.amplitude))
        frequency = checks.positive(f"{on} angular_frequency", self.angular_frequency)
        object.__setattr__(self, "angular_frequency", frequency)
        object.__setattr__(self, "phase", checks.finite(f"{on} phase", self.phase))

    def at(self, time: float) -> Vector:
        """The force at a time, N."""
        (x, y, z), share = self.amplitude, math.cos(self.angular_frequency * time + self.phase)
        return x * share, y * share, z * share


Push = Force | GrowingForce | OscillatingForce


@dataclass(frozen=True)
class Spring:
    """A spring with a damper beside it, between a point of a body and one of another body, or of the world.

    body_b: "" for the world. point_a, point_b: from the centre of the body, in its own axes, m; of the world, the place
    itself. stiffness: N/m. rest_length: m. damping: N s/m, along the spring. It has no mass, and at length zero no
    direction and no force.
    """

    body_a: str
    body_b: str
    stiffness: float
    rest_length: float = 0.0
    damping: float = 0.0
    point_a: Vector = NOWHERE
    point_b: Vector = NOWHERE

    def __post_init__(self) -> None:
        label = f"spring {self.body_a}–{self.body_b or 'world'}:"
        if self.body_a == self.body_b:
            raise InvalidInput(f"{label} a spring between two points of one body does nothing")
        for name in ("stiffness", "rest_length", "damping"):
            object.__setattr__(self, name, checks.not_negative(f"{label} {name}", getattr(self, name)))
        for name in ("point_a", "point_b"):
            object.__setattr__(self, name, checks.vector(f"{label} {name}", getattr(self, name)))


@dataclass(frozen=True)
class Attraction:
    """Newton's gravitation between two bodies, along the line of their centres: F = constant · m_a m_b/r².

    constant: in place of G, N m²/kg². With the real one nothing that fits into a laboratory would move.
    """

    body_a: str
    body_b: str
    constant: float

    def __post_init__(self) -> None:
        label = f"attraction {self.body_a}–{self.body_b}:"
        if self.body_a == self.body_b:
            raise InvalidInput(f"{label} a body does not attract itself")
        object.__setattr__(self, "constant", checks.positive(f"{label} constant", self.constant))


@dataclass(frozen=True)
class Fluid:
    """A fluid that fills all space: thick enough, or the balls in it slow enough, for Stokes' law to hold.

    density: kg/m³. viscosity: Pa s. velocity: of the fluid, m/s, the same everywhere: a stream, or wind. It lifts a
    ball by the weight that it displaces, slows it by 6πηr (v − u) and its spin by 8πηr³ ω.
    """

    density: float = 0.0
    viscosity: float = 0.0
    velocity: Vector = NOWHERE

    def __post_init__(self) -> None:
        for name in ("density", "viscosity"):
            object.__setattr__(self, name, checks.not_negative(f"fluid: {name}", getattr(self, name)))
        object.__setattr__(self, "velocity", checks.vector("fluid: velocity", self.velocity))
