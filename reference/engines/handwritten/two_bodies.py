"""Step loops for a ball that strikes another ball, a plane or the face of a box, batch first.

As in `drivers`, all physics is asked of the implementation's functions; the loops only say when.
"""

from __future__ import annotations

import functools
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence

import numpy as np

from reference.engines.handwritten.stepping import Array, Mask, policy_of, record, start
from reference.engines.handwritten.supported import ball_and_other, face_towards, in_own_axes
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction, RunFailed
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

NEEDS_A_WORLD = "needs a rigid-body world (world)"
_MEETS_AGAIN = f"{NEEDS_A_WORLD}: the two meet again after their impact, unless what was answered to it is wrong"
_ROUNDING = 1e-9  # a gap or a speed below this, m or m/s, is none
_MOST_IMPACTS = 100  # of one pair within one step; what falls back so fast comes to rest, and that is told apart


class _Side:
    """One of the two bodies of each scenario, as arrays over the N scenarios."""

    def __init__(self, scenarios: Sequence[Scenario], bodies: Sequence[Body], implementation: Implementation) -> None:
        self.bodies = bodies
        self.place = [scenario.bodies.index(body) for scenario, body in zip(scenarios, bodies, strict=True)]
        self.position = np.array([body.position for body in bodies])
        self.orientation = np.array([body.orientation for body in bodies])
        self.velocity = np.array([body.velocity for body in bodies])
        self.spin = np.array([body.angular_velocity for body in bodies])
        self.inverse_mass = np.array([body.inverse_mass for body in bodies])
        self.inertia = np.array([_moments(body, implementation) for body in bodies])
        falls = self.inverse_mass[:, None] > 0
        self.acceleration = np.where(falls, [scenario.gravity for scenario in scenarios], 0.0)
        self._world_inverse_inertia = implementation.function("world_inverse_inertia")

    def at(self, arm: Array) -> tuple[Array, Array, Array, Array, Array]:
        """What an impact needs to know: velocity, angular velocity, arm, inverse mass, inverse inertia."""
        inverse_inertia = np.asarray(self._world_inverse_inertia(self.inertia, self.orientation))
        return self.velocity, self.spin, arm, self.inverse_mass, inverse_inertia

    def move(self, how: Callable[..., tuple[Array, Array]], duration: Array) -> None:
        """Fly on, spinning about an axis that keeps its direction."""
        self.position, self.velocity = map(np.asarray, how(self.position, self.velocity, self.acceleration, duration))
        self.orientation = geometry.turned(self.orientation, self.spin * duration[:, None])

    def take(self, struck: Mask, velocity: Array, spin: Array) -> None:
        """Take new velocities where struck."""
        self.velocity = np.where(struck[:, None], velocity, self.velocity)
        self.spin = np.where(struck[:, None], spin, self.spin)

    def state(self) -> Array:
        """The 13 numbers that a sample keeps, (N, 13)."""
        return np.concatenate([self.position, self.orientation, self.velocity, self.spin], axis=-1)


def _moments(body: Body, implementation: Implementation) -> Array:
    """Moments of inertia about the body's own axes, (3,), kg m²; infinite for what cannot be turned."""
    if isinstance(body.shape, Sphere):
        return np.asarray(implementation.function("sphere_inertia")(body.mass, body.shape.radius))
    if isinstance(body.shape, Box):
        return np.asarray(implementation.function("box_inertia")(body.mass, 2 * np.array(body.shape.half_extents)))
    return np.full(3, np.inf)


class _Pairs(ABC):
    """A ball A and what it strikes, B, in each of the N scenarios."""

    def __init__(self, scenarios: Sequence[Scenario], implementation: Implementation) -> None:
        self.scenarios, self.function = scenarios, implementation.function
        both = [ball_and_other(scenario) for scenario in scenarios]
        self.a, self.b = (_Side(scenarios, bodies, implementation) for bodies in zip(*both, strict=True))
        self.radius = np.array([ball.shape.radius for ball, _ in both])  # type: ignore[union-attr]
        self.events: list[list[Event]] = [[] for _ in scenarios]
        self._start = start(scenarios)

    @abstractmethod
    def normal(self) -> Array:
        """Unit normals from B to A, (N, 3)."""

    @abstractmethod
    def gap(self) -> Array:
        """Distance between the surfaces, (N,), m, negative when overlapping."""

    @abstractmethod
    def until_impact(self, remaining: Array) -> Array:
        """Time until they next touch and approach, (N,), s; infinity where that is not within the remaining time."""

    def approach(self) -> tuple[Array, Array]:
        """Velocity and acceleration of A relative to B, along the normal, (N,) each; negative when approaching."""
        normal, a, b = self.normal(), self.a, self.b
        return np.vecdot(a.velocity - b.velocity, normal), np.vecdot(a.acceleration - b.acceleration, normal)

    def answer(self, struck: Mask, time: Array) -> None:
        """Give the bodies that strike each other their velocities after the impact."""
        normal = self.normal()
        arm = -self.radius[:, None] * normal  # to the point of the ball that touches, or is deepest inside
        side_a, side_b = self.a.at(arm), self.b.at(self.a.position + arm - self.b.position)
        velocity_a, spin_a, velocity_b, spin_b = self._answered(side_a, side_b, normal)
        self.a.take(struck, velocity_a, spin_a)
        self.b.take(struck, velocity_b, spin_b)
        for member in np.flatnonzero(struck).tolist():
            self.events[member].append(Event(float(time[member]), "impact", self.a.bodies[member].name))

    def _answered(self, side_a: tuple[Array, ...], side_b: tuple[Array, ...], normal: Array) -> tuple[Array, ...]:
        restitution = np.array([scenario.pairs[0].restitution for scenario in self.scenarios])
        friction = np.array([scenario.pairs[0].kinetic_friction for scenario in self.scenarios])
        if not friction.any():
            smooth: tuple[Array, ...] = self.function("collide")(side_a, side_b, normal, restitution)
            return smooth
        point_velocity, point_inverse_mass = self.function("point_velocity"), self.function("point_inverse_mass")
        slip = self.function("relative_velocity")(point_velocity(*side_a[:3]), point_velocity(*side_b[:3]))
        softness = sum(
            point_inverse_mass(inverse_mass, inverse_inertia, arm)
            for _, _, arm, inverse_mass, inverse_inertia in (side_a, side_b)
        )
        impulse = self.function("friction_impulse")(slip, normal, softness, restitution, friction)
        rough: tuple[Array, ...] = self.function("apply_impulse")(side_a, side_b, impulse)
        return rough

    def states(self) -> Array:
        """The states of all bodies as a sample keeps them, (N, 2, 13)."""
        states, every = self._start.copy(), np.arange(len(self._start))
        for side in (self.a, self.b):
            states[every, side.place] = side.state()
        return states


class _Balls(_Pairs):
    """Two balls."""

    def normal(self) -> Array:
        between = self.a.position - self.b.position
        return np.asarray(between / np.linalg.norm(between, axis=1, keepdims=True))

    def gap(self) -> Array:
        between = np.linalg.norm(self.a.position - self.b.position, axis=1)
        return np.asarray(between - self.radius - self._other_radius())

    def until_impact(self, remaining: Array) -> Array:
        a, b = self.a, self.b
        sweep = self.function("sweep_sphere_sphere")
        time = sweep(a.position, a.velocity, self.radius, b.position, b.velocity, self._other_radius(), remaining)
        return np.where(
            self.approach()[0] < -_ROUNDING, time, np.inf
        )  # to a sweep, what touches and parts is touching now

    def _other_radius(self) -> Array:
        return np.array([body.shape.radius for body in self.b.bodies])  # type: ignore[union-attr]


class _Faces(_Pairs):
    """A ball over a plane, or over a face of a box, which it strikes once: then the box turns."""

    def __init__(self, scenarios: Sequence[Scenario], implementation: Implementation) -> None:
        super().__init__(scenarios, implementation)
        faces = [_face(*ball_and_other(scenario)) for scenario in scenarios]
        self._normal = np.array([normal for normal, _ in faces])
        self._height = np.array([height for _, height in faces])
        self._middle = np.where([isinstance(body.shape, HalfSpace) for body in self.b.bodies], np.inf, self._height)

    def normal(self) -> Array:
        return self._normal

    def gap(self) -> Array:
        surface = self.b.position + self._height[:, None] * self._normal
        offset = -np.vecdot(self._normal, surface) - self.radius
        return np.asarray(self.function("signed_distance")(self.a.position, self._normal, offset))

    def until_impact(self, remaining: Array) -> Array:
        velocity, acceleration = super().approach()
        velocity = np.where(np.abs(velocity) < _ROUNDING, 0.0, velocity)
        time = self.function("time_of_impact_exact")(self.gap(), velocity, acceleration)
        return np.where(self._lost(), np.inf, time)

    def approach(self) -> tuple[Array, Array]:
        """As of any pair; a face that is lost nothing approaches any more."""
        velocity, acceleration = super().approach()
        return np.where(self._lost(), np.inf, velocity), acceleration

    def _lost(self) -> Mask:
        """Whether the face is no longer the nearest: the box turns, or a step has carried the ball past its middle."""
        return np.asarray(self.b.spin.any(axis=1) | (self.gap() + self.radius < -self._middle))


def _face(ball: Body, other: Body) -> tuple[Array, float]:
    """Normal of the surface that the ball will strike, (3,), and its distance from the body's position, m."""
    if isinstance(other.shape, HalfSpace):
        return np.array(other.shape.normal), 0.0
    assert isinstance(other.shape, Box)
    normal = face_towards(ball, other)
    return normal, float(np.abs(in_own_axes(other, normal)) @ np.array(other.shape.half_extents))


def strike_ball(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Two balls that strike each other, with friction and spin, and fly on."""
    return _strike(engine, _Balls(scenarios, implementation), settings, steps)


def strike_face(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """A ball that strikes a plane or straight on a face of a box, with friction and spin, and flies on.

    Where a ball meets a box again that turns by then, or comes to rest on a plane, it takes a rigid-body world.
    """
    made = _strike(engine, _Faces(scenarios, implementation), settings, steps)
    for trajectory in made:
        _check_that_they_part(trajectory)
    return made


def _strike(engine: str, pairs: _Pairs, settings: Settings, steps: list[int]) -> list[Trajectory]:
    function = functools.cache(pairs.function)  # what a policy has no use for is not asked
    dt, every_dt = settings.timestep, np.full(len(pairs.scenarios), settings.timestep)

    def answer(struck: Mask, time: Array) -> None:
        pairs.answer(struck, time)
        leaving, pressing = pairs.approach()
        if np.any(struck & (pressing < 0) & (leaving <= -pressing * dt)):
            raise NeedsFunction(NEEDS_A_WORLD)  # a flight of two steps at most: it comes to rest, and may roll

    def move(how: Callable[..., tuple[Array, Array]], duration: Array) -> None:
        pairs.a.move(how, duration)
        pairs.b.move(how, duration)

    def step_through_impacts(time: float) -> None:
        remaining = every_dt
        for _ in range(_MOST_IMPACTS):
            impact = pairs.until_impact(remaining)
            struck = impact <= remaining
            passed = np.minimum(impact, remaining)
            move(function("ballistic_motion"), passed)
            remaining = remaining - passed
            if not struck.any():
                return
            answer(struck, time + dt - remaining)
        raise RunFailed(f"{_MOST_IMPACTS} impacts within one step of {dt:g} s: what was answered does not part the two")

    def respond_or_step(time: float) -> None:
        struck = function("is_colliding")(pairs.gap()) & (pairs.approach()[0] < 0)
        if struck.any():
            answer(struck, np.full(len(struck), time))
        move(function("semi_implicit_euler"), every_dt)

    policies = {"exact_root": step_through_impacts, "at_step": respond_or_step}
    return record(engine, pairs.scenarios, settings, steps, pairs.states, policy_of(policies, settings), pairs.events)


def _check_that_they_part(trajectory: Trajectory) -> None:
    """Refuse a run in which a ball goes into a box that it has struck before and parted from."""
    ball, other = ball_and_other(trajectory.scenario)
    if not isinstance(other.shape, Box) or not trajectory.events:
        return
    place = trajectory.position(ball.name) - trajectory.position(other.name)
    half_extents = np.array(other.shape.half_extents)
    gap = geometry.out_of_box(place, trajectory.orientation(other.name), half_extents) - ball.shape.radius  # type: ignore[union-attr]
    parted = (trajectory.times > trajectory.events[0].time) & (gap > 0)
    if np.any(gap[np.argmax(parted) :] < -_ROUNDING) or not parted.any():
        raise NeedsFunction(_MEETS_AGAIN)
