"""A scenario: which bodies there are, how they start and how long they move, in SI units and in no engine's words.

Conventions of the whole lab: right-handed, z up, quaternions w x y z, the contact normal points from B to A,
and the coefficients of restitution and friction belong to a *pair* of bodies, never to one.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import UnionType

from reference import checks
from reference.checks import Quaternion, Vector
from reference.errors import InvalidInput, UnknownName
from reference.scene.forces import Attraction, Fluid, Force, Push, Spring
from reference.scene.polyhedron import Polyhedron
from reference.scene.steering import Steering

GRAVITY = 9.81
"""Acceleration of free fall in every scenario, m/s². The published cases that we compare with use this figure."""
_ROUNDING = 1e-12
"""Share by which a moment of inertia of a plate may exceed the sum of the two others, since all three are rounded."""


@dataclass(frozen=True)
class Sphere:
    """A solid sphere of the given radius, m."""

    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "radius", checks.positive("radius", self.radius))

    def inertia_per_mass(self) -> Vector:
        """Principal moments of inertia per unit mass, m²: 2/5 r² about every axis."""
        moment = 0.4 * self.radius**2
        return moment, moment, moment


@dataclass(frozen=True)
class Box:
    """A solid box; `half_extents` are its half lengths along its own x, y and z axes, m."""

    half_extents: Vector

    def __post_init__(self) -> None:
        extents = checks.vector("half_extents", self.half_extents)
        for axis, extent in zip("xyz", extents, strict=True):
            checks.positive(f"half extent {axis}", extent)
        object.__setattr__(self, "half_extents", extents)

    def inertia_per_mass(self) -> Vector:
        """Principal moments of inertia per unit mass, m²: (b² + c²)/3 for half lengths b and c."""
        a, b, c = self.half_extents
        return (b * b + c * c) / 3, (c * c + a * a) / 3, (a * a + b * b) / 3


@dataclass(frozen=True)
class HalfSpace:
    """Everything below a plane through the body's position; `normal` points out of the solid, world frame, unit."""

    normal: Vector = (0.0, 0.0, 1.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "normal", checks.unit_vector("normal", self.normal))


Shape = Sphere | Box | HalfSpace | Polyhedron


@dataclass(frozen=True)
class Body:
    """One rigid body and its state at the start.

    mass: kg, `math.inf` for an immovable one. position: centre of mass, m. orientation: unit quaternion w x y z,
    body to world. velocity: m/s. angular_velocity: rad/s, world frame. inertia: principal moments about the body's own
    x, y and z axes, kg m², where they are not those of a solid body of this shape and mass.

    The impulse topic has a `Body` too, in `solutions.impulse`: what one impact needs to know of a body at its instant,
    with the arm to the contact and inverses of mass and inertia. Neither can stand for the other.
    """

    name: str
    shape: Shape
    mass: float = math.inf
    position: Vector = (0.0, 0.0, 0.0)
    orientation: Quaternion = (1.0, 0.0, 0.0, 0.0)
    velocity: Vector = (0.0, 0.0, 0.0)
    angular_velocity: Vector = (0.0, 0.0, 0.0)
    inertia: Vector | tuple[()] = ()

    def __post_init__(self) -> None:
        if not self.name:
            raise InvalidInput("a body's name is empty; rows and plots need one")
        label = f"{self.name}:"
        if self.mass != math.inf:
            object.__setattr__(self, "mass", checks.positive(f"{label} mass", self.mass))
        if isinstance(self.shape, HalfSpace) and not self.immovable:
            raise InvalidInput(f"{label} a half-space has mass {self.mass}; only inf makes sense")
        if isinstance(self.shape, Polyhedron) and not self.immovable:
            raise InvalidInput(f"{label} a polyhedron has mass {self.mass}; so far only inf is known")
        for name in ("position", "velocity", "angular_velocity"):
            object.__setattr__(self, name, checks.vector(f"{label} {name}", getattr(self, name)))
        for name in ("velocity", "angular_velocity"):
            value = getattr(self, name)
            if self.immovable and any(value):
                raise InvalidInput(f"{label} an immovable body (mass inf) has {name} {value}; only 0 makes sense")
        orientation = checks.unit_quaternion(f"{label} orientation", self.orientation)
        object.__setattr__(self, "orientation", orientation)
        if not isinstance(self.inertia, tuple) or self.inertia:
            object.__setattr__(self, "inertia", self._checked_inertia(f"{label} inertia"))

    def _checked_inertia(self, name: str) -> Vector:
        if self.immovable:
            raise InvalidInput(f"{name} is {self.inertia!r}, and the body is immovable (mass inf): nothing turns it")
        moments = checks.vector(name, self.inertia)
        for place, moment in enumerate(moments):
            checks.positive(f"{name}[{place}]", moment)
        # I_x + I_y − I_z = 2 ∫ z² dm, which no distribution of mass makes negative; a flat plate makes it zero.
        if 2 * max(moments) > sum(moments) * (1 + _ROUNDING):
            raise InvalidInput(f"{name} is {moments}; no moment may exceed the sum of the two others")
        return moments

    @property
    def immovable(self) -> bool:
        """Whether nothing can move this body."""
        return self.mass == math.inf

    @property
    def inverse_mass(self) -> float:
        """1/mass, 1/kg; zero for an immovable body."""
        return 0.0 if self.immovable else 1 / self.mass

    def moments_of_inertia(self) -> Vector:
        """Principal moments of inertia about its own axes, kg m², its own or its shape's; infinite if immovable."""
        if self.inertia:
            return self.inertia
        if self.immovable or isinstance(self.shape, HalfSpace | Polyhedron):
            return math.inf, math.inf, math.inf
        x, y, z = self.shape.inertia_per_mass()
        return self.mass * x, self.mass * y, self.mass * z

    def state(self) -> tuple[float, ...]:
        """The 13 numbers that a sample of a trajectory has: position, orientation, velocity, angular velocity."""
        return (*self.position, *self.orientation, *self.velocity, *self.angular_velocity)


@dataclass(frozen=True)
class Pair:
    """The coefficients of one pair of bodies, none with a unit.

    restitution: 0 to 1. static_friction: at least kinetic_friction; the same as it where it is not given.
    """

    body_a: str
    body_b: str
    restitution: float = 0.0
    kinetic_friction: float = 0.0
    static_friction: float | None = None

    def __post_init__(self) -> None:
        label = f"pair {self.body_a}–{self.body_b}:"
        if self.body_a == self.body_b:
            raise InvalidInput(f"{label} a body cannot be paired with itself")
        kinetic = checks.not_negative(f"{label} kinetic_friction", self.kinetic_friction)
        static = kinetic if self.static_friction is None else self.static_friction
        static = checks.not_negative(f"{label} static_friction", static)
        if static < kinetic:
            raise InvalidInput(f"{label} static_friction {static} is below kinetic_friction {kinetic}")
        object.__setattr__(self, "restitution", checks.fraction(f"{label} restitution", self.restitution))
        object.__setattr__(self, "kinetic_friction", kinetic)
        object.__setattr__(self, "static_friction", static)


_PARTS: Mapping[str, type | UnionType] = {
    "bodies": Body, "pairs": Pair, "forces": Push, "springs": Spring, "attractions": Attraction, "steering": Steering,
}  # fmt: skip
"""Fields of a scenario that hold several things, and of which kind these are."""


@dataclass(frozen=True)
class Scenario:
    """A complete set-up. duration: s. gravity: acceleration, m/s². Pairs that are not listed do not collide.

    forces: pushes on bodies, besides weight and contact. springs, attractions: between bodies. fluid: what they move
    in, () for none. steering: rules by which bodies move themselves. All of them act from start to end.
    """

    name: str
    bodies: tuple[Body, ...]
    pairs: tuple[Pair, ...]
    duration: float
    gravity: Vector = field(default=(0.0, 0.0, -GRAVITY))
    forces: tuple[Push, ...] = ()
    springs: tuple[Spring, ...] = ()
    attractions: tuple[Attraction, ...] = ()
    fluid: Fluid | tuple[()] = ()
    steering: tuple[Steering, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "duration", checks.positive(f"{self.name}: duration", self.duration))
        object.__setattr__(self, "gravity", checks.vector(f"{self.name}: gravity", self.gravity))
        for name, kind in _PARTS.items():
            object.__setattr__(self, name, checks.all_of(f"{self.name}: {name}", getattr(self, name), kind))
        if self.fluid != () and not isinstance(self.fluid, Fluid):
            raise InvalidInput(f"{self.name}: fluid is {self.fluid!r}; it must be a Fluid, or () for none")
        names = [body.name for body in self.bodies]
        if len(set(names)) != len(names):
            raise InvalidInput(f"{self.name}: two bodies share a name in {names}")
        seen = set()
        for pair in self.pairs:
            for name in (pair.body_a, pair.body_b):
                self.body(name)
            key = frozenset((pair.body_a, pair.body_b))
            if key in seen:
                raise InvalidInput(f"{self.name}: the pair {sorted(key)} is given twice")
            seen.add(key)
        self._check_forces()
        self._check_steering()

    def _check_forces(self) -> None:
        for force in self.forces:
            if self.body(force.body).immovable:
                raise InvalidInput(
                    f"{self.name}: a force of {force.at(0.0)} N acts on {force.body}, which is immovable"
                )
        for spring in self.springs:
            ends = [self.body(name) for name in (spring.body_a, spring.body_b) if name]
            if all(body.immovable for body in ends):
                raise InvalidInput(
                    f"{self.name}: the spring {spring.body_a}–{spring.body_b or 'world'} can move nothing"
                )
        for attraction in self.attractions:
            for name in (attraction.body_a, attraction.body_b):
                if self.body(name).immovable:
                    raise InvalidInput(f"{self.name}: {name} attracts, and needs a finite mass for it")
        if self.fluid:
            for body in self.bodies:
                if not body.immovable and not isinstance(body.shape, Sphere):
                    raise InvalidInput(f"{self.name}: {body.name} is no ball, and Stokes' law is for balls in a fluid")

    def _check_steering(self) -> None:
        steered = [name for steering in self.steering for name in steering.bodies]
        if len(set(steered)) != len(steered):
            raise InvalidInput(f"{self.name}: two rules steer one body of {steered}")
        for name in steered:
            if self.body(name).immovable:
                raise InvalidInput(f"{self.name}: {name} is steered, and is immovable")
        for name in (name for steering in self.steering for name in steering.obstacles):
            if not self.body(name).immovable:
                raise InvalidInput(f"{self.name}: {name} is an obstacle of a steering rule, and is not immovable")

    @property
    def pushes_change(self) -> bool:
        """Whether forces besides weight and contact change in time, or with what the bodies do."""
        steady = all(isinstance(force, Force) for force in self.forces)
        return not steady or bool(self.springs or self.attractions or self.fluid or self.steering)

    @property
    def in_flight(self) -> bool:
        """Whether nothing touches anything or steers itself, and all that moves are balls: forces say what happens."""
        return not (self.pairs or self.steering) and all(
            body.immovable or isinstance(body.shape, Sphere) for body in self.bodies
        )

    @property
    def meets_a_solid(self) -> bool:
        """Whether a polyhedron is in the way of a body, as it is not in a survey."""
        met = (self.body(name) for pair in self.pairs for name in (pair.body_a, pair.body_b))
        return any(isinstance(body.shape, Polyhedron) for body in met)

    def body(self, name: str) -> Body:
        """Return the body of that name."""
        return self.bodies[self.index(name)]

    def unlisted_pairs(self) -> list[tuple[str, str]]:
        """Names of every two bodies that do not collide; an engine that lets all bodies collide has to exclude them."""
        listed = {frozenset((pair.body_a, pair.body_b)) for pair in self.pairs}
        names = [body.name for body in self.bodies]
        return [two for two in itertools.combinations(names, 2) if frozenset(two) not in listed]

    def index(self, name: str) -> int:
        """Return the body's place in `bodies`, and so in a trajectory's arrays."""
        for place, body in enumerate(self.bodies):
            if body.name == name:
                return place
        raise UnknownName("body", name, (body.name for body in self.bodies))
