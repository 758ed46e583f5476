"""Step loops for a ball that strikes another ball, a plane or the face of a box, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

import functools
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.handwritten.impact_response import (
    MEETS_AGAIN,
    NEEDS_A_WORLD,
    after_impact,
    impulse_function,
)
from reference.engines.handwritten.rigid_bodies import RigidBodies
from reference.engines.handwritten.scenario_bodies import ball_and_other, face_towards, in_own_axes
from reference.engines.handwritten.stepping import policy_of, record, start
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction, RunFailed
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

_ROUNDING = 1e-9  # a gap or a speed below this, m or m/s, is rounding
_MOST_IMPACTS = 100  # of one pair within one step; a ball that falls back so fast comes to rest, and is refused before


def strike_ball(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Two balls that strike each other, with friction and spin, and fly on."""
    return _run(engine, _TwoBalls(scenarios, settings, implementation), settings, steps)


def strike_face(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """A ball that strikes a plane or straight on a face of a box, with friction and spin, and flies on.

    A ball that meets a box again after the box has begun to turn, or that comes to rest on a plane, needs a rigid-body
    world.
    """
    made = _run(engine, _BallAndFace(scenarios, settings, implementation), settings, steps)
    for trajectory in made:
        _check_that_they_part(trajectory)
    return made


def _run(engine: str, pairs: Pairs, settings: Settings, steps: list[int]) -> list[Trajectory]:
    policies = {"exact_root": pairs.step_through_impacts, "at_step": pairs.respond_then_step}
    return record(engine, pairs.scenarios, settings, steps, pairs.states, policy_of(policies, settings), pairs.events)


class Pairs(ABC):
    """A ball A and what it strikes, B, in each of N scenarios: two ways to step them, and what the two share."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        self.scenarios, self.dt = scenarios, settings.timestep
        self.function = functools.cache(implementation.function)  # looked up when a step first needs it
        both = [ball_and_other(scenario) for scenario in scenarios]
        self.a, self.b = (RigidBodies(scenarios, bodies, implementation) for bodies in zip(*both, strict=True))
        self.radius = np.array([ball.shape.radius for ball, _ in both])  # type: ignore[union-attr]
        self.law = impulse_function(settings)
        self.whole_step = np.full(len(scenarios), self.dt)
        self.events: list[list[Event]] = [[] for _ in scenarios]
        self._start = start(scenarios)

    # The two policies

    def step_through_impacts(self, time: float) -> None:
        """Fly each pair to its next impact, resolve it there, and fly on until the step is over."""
        remaining = self.whole_step
        for _ in range(_MOST_IMPACTS):
            impact = self.until_impact(remaining)
            struck, passed = impact <= remaining, np.minimum(impact, remaining)
            self.move(self.function("ballistic_motion"), passed)
            remaining = remaining - passed
            if not struck.any():
                return
            self.respond(struck, time + self.dt - remaining)
        raise RunFailed(f"{_MOST_IMPACTS} impacts within one step of {self.dt:g} s: the response does not part the two")

    def respond_then_step(self, time: float) -> None:
        """Resolve the impact of every pair that overlaps and approaches, then take a step of semi-implicit Euler."""
        struck = (self.function("side_of_plane")(self.gap()) < 0) & (self.normal_velocity() < 0) & ~self.out_of_reach()
        if struck.any():
            self.respond(struck, np.full(len(struck), time))
        self.move(self.function("semi_implicit_euler"), self.whole_step)

    # What depends on the shapes

    @abstractmethod
    def normal(self) -> Array:
        """Unit normals from B to A, (N, 3)."""

    @abstractmethod
    def gap(self) -> Array:
        """Distance between the surfaces, (N,), m, negative when overlapping."""

    @abstractmethod
    def until_impact(self, remaining: Array) -> Array:
        """Time until they next touch and approach, (N,), s; infinity where that is not within the remaining time."""

    @abstractmethod
    def out_of_reach(self) -> Mask:
        """Whether A can no longer strike the surface of B that it flew at, (N,)."""

    # What they share

    def normal_velocity(self) -> Array:
        """Velocity of A relative to B along the normal, (N,), m/s; negative when approaching."""
        return np.asarray(np.vecdot(self.a.velocity - self.b.velocity, self.normal()))

    def normal_acceleration(self) -> Array:
        """Acceleration of A relative to B along the normal, (N,), m/s²; negative when it pulls the two together."""
        return np.asarray(np.vecdot(self.a.acceleration - self.b.acceleration, self.normal()))

    def move(self, motion: Callable[..., tuple[Array, Array]], duration: Array) -> None:
        """Move both bodies for a while (N,), s."""
        self.a.move(motion, duration)
        self.b.move(motion, duration)

    def respond(self, struck: Mask, time: Array) -> None:
        """Give the bodies that strike each other their velocities after the impact."""
        normal = self.normal()
        arm = -self.radius[:, None] * normal  # to the point of the ball that touches, or is deepest inside
        at_a, at_b = self.a.struck_at(arm), self.b.struck_at(self.a.position + arm - self.b.position)
        after = after_impact(self.function, self.law, self.scenarios, at_a, at_b, normal)
        velocity_a, spin_a, velocity_b, spin_b = after
        self.a.set_velocities(struck, velocity_a, spin_a)
        self.b.set_velocities(struck, velocity_b, spin_b)
        for member in np.flatnonzero(struck).tolist():
            self.events[member].append(Event(float(time[member]), "impact", self.a.bodies[member].name))
        self._refuse_rest(struck)

    def _refuse_rest(self, struck: Mask) -> None:
        """Refuse a ball that leaves so slowly that it is back within two steps: it comes to rest, and may roll."""
        pull = -self.normal_acceleration()
        falls_back = struck & ~self.out_of_reach() & (pull > 0)
        if np.any(falls_back & (self.normal_velocity() <= pull * self.dt)):
            raise NeedsFunction(NEEDS_A_WORLD)

    def states(self) -> Array:
        """The states of all bodies as a sample keeps them, (N, 2, 13)."""
        states, every = self._start.copy(), np.arange(len(self._start))
        for bodies in (self.a, self.b):
            states[every, bodies.place] = bodies.states()
        return states


class _TwoBalls(Pairs):
    """Two balls."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        self.other_radius = np.array([body.shape.radius for body in self.b.bodies])  # type: ignore[union-attr]

    def normal(self) -> Array:
        between = self.a.position - self.b.position
        return np.asarray(between / np.linalg.norm(between, axis=1, keepdims=True))

    def gap(self) -> Array:
        between = np.linalg.norm(self.a.position - self.b.position, axis=1)
        return np.asarray(between - self.radius - self.other_radius)

    def until_impact(self, remaining: Array) -> Array:
        a, b = self.a, self.b
        sweep = self.function("sweep_sphere_sphere")
        time = sweep(a.position, a.velocity, self.radius, b.position, b.velocity, self.other_radius, remaining)
        approaching = self.normal_velocity() < -_ROUNDING  # a sweep also gives 0 for two that touch and part
        return np.where(approaching, time, np.inf)

    def out_of_reach(self) -> Mask:
        return np.zeros(len(self.scenarios), dtype=bool)


class _BallAndFace(Pairs):
    """A ball over a plane, or over a face of a box, which it can strike only once: after that the box turns."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
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
        velocity = self.normal_velocity()
        velocity = np.where(np.abs(velocity) < _ROUNDING, 0.0, velocity)
        time = self.function("time_of_impact_exact")(self.gap(), velocity, self.normal_acceleration())
        return np.where(self.out_of_reach(), np.inf, time)

    def out_of_reach(self) -> Mask:
        """Whether the face is no longer the nearest: the box turns, or a step has carried the ball past its middle."""
        return np.asarray(self.b.spin.any(axis=1) | (self.gap() + self.radius < -self._middle))


def _face(ball: Body, other: Body) -> tuple[Array, float]:
    """Normal of the surface that the ball will strike, (3,), and its distance from the body's position, m."""
    if isinstance(other.shape, HalfSpace):
        return np.array(other.shape.normal), 0.0
    assert isinstance(other.shape, Box)
    normal = face_towards(ball, other)
    return normal, float(np.abs(in_own_axes(other, normal)) @ np.array(other.shape.half_extents))


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
        raise NeedsFunction(MEETS_AGAIN)
