"""Step loops for single bodies that move as points do, batch first: N scenarios of one kind run side by side.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from reference.arrays import Array, Mask
from reference.engines.handwritten.scenario_kind import planes_met
from reference.engines.handwritten.stepping import checked_impact_times, policy_of, record, start
from reference.engines.implementation import Implementation
from reference.errors import RunFailed
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

Motion = Callable[..., tuple[Array, Array]]
"""Takes positions and velocities (N, 3), accelerations and durations; returns the positions and velocities after."""
_ONE_INSTANT = 1e-9  # share of a step: a ball that meets two planes within so short a time meets both at once
_ROUNDING = 1e-12  # share of the ball's speed
_MOST_IMPACTS = 10_000  # of one ball between several planes within one step


def bounce(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Balls without friction: over one plane they bounce and come to rest; between several they have no weight."""
    balls = _Balls(scenarios, settings, implementation)
    policies = {
        "exact_root": balls.step_to_exact_roots,
        "interpolated": balls.step_to_slides_times,
        "at_step": balls.respond_then_step,
    }
    return record(engine, scenarios, settings, steps, balls.states, policy_of(policies, settings), balls.events)


def slide(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Boxes flat on a plane that slide in a straight line and stop, or hold."""
    slabs = _Slabs(scenarios, settings, implementation)
    policies = {"exact_root": slabs.step_exactly, "at_step": slabs.step_semi_implicitly}
    return record(engine, scenarios, settings, steps, slabs.states, policy_of(policies, settings), slabs.events)


class _Points:
    """The single movable body of each of N scenarios and the P planes that it may meet, as arrays."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        self.dt = settings.timestep
        self.function = functools.cache(implementation.function)  # looked up when a step first needs it
        self.bodies = [next(body for body in scenario.bodies if not body.immovable) for scenario in scenarios]
        planes = [planes_met(scenario) for scenario in scenarios]
        self.position = np.array([body.position for body in self.bodies])
        self.velocity = np.array([body.velocity for body in self.bodies])
        self.mass = np.array([body.mass for body in self.bodies])
        self.gravity = np.array([scenario.gravity for scenario in scenarios])
        self.normal = np.array([[plane.shape.normal for plane in each] for each in planes])  # type: ignore[union-attr]
        self.offset = -np.sum(self.normal * np.array([[plane.position for plane in each] for each in planes]), axis=-1)
        self.events: list[list[Event]] = [[] for _ in scenarios]
        self._start = start(scenarios)
        self._moving = [scenario.bodies.index(body) for scenario, body in zip(scenarios, self.bodies, strict=True)]

    def states(self) -> Array:
        """The 13 numbers of every body that a sample keeps, (N, 2, 13)."""
        states, every = self._start.copy(), np.arange(len(self._moving))
        states[every, self._moving, :3], states[every, self._moving, 7:10] = self.position, self.velocity
        return states

    def report(self, mask: Mask, time: Array, kind: str) -> None:
        """Note an event at `time` (N,) for the members in the mask."""
        for member in np.flatnonzero(mask):
            self.events[member].append(Event(float(time[member]), kind, self.bodies[member].name))


class _Balls(_Points):
    """N balls and P planes for each: three ways to step them, and what the three share.

    What belongs to a ball and one of its planes is an array (N, P).
    """

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        self._signed_distance = self.function("signed_distance")
        self._kinematic_response = self.function("kinematic_response")
        self.radius = np.array([body.shape.radius for body in self.bodies])  # type: ignore[union-attr]
        self.restitution = np.array([[pair.restitution for pair in scenario.pairs] for scenario in scenarios])
        self.free_acceleration = self.function("uniform_gravity")(self.mass, self.gravity) / self.mass[:, None]
        self.normal_acceleration = np.sum(self.free_acceleration[:, None] * self.normal, axis=-1)
        self.along_plane = self.free_acceleration[:, None] - self.normal_acceleration[..., None] * self.normal
        # A ball that leaves the plane at w is back after 2 w/g: below this w the flight is too short to be followed.
        self.rest_speed = settings.number("shortest_flight") * self.dt * -self.normal_acceleration / 2
        self.resting = np.zeros(self.restitution.shape, dtype=bool)
        self.whole_step = np.full(len(scenarios), self.dt)

    # The three policies

    def step_to_exact_roots(self, time: float) -> None:
        """Fly each ball to the first root of its parabola, let it bounce there, and fly on until the step is over."""
        fly, time_of_impact = self.function("ballistic_motion"), self.function("time_of_impact_exact")
        remaining = self.whole_step
        for _ in self.rounds():
            roots = time_of_impact(self.separation(self.position), self.normal_velocity(), self.normal_acceleration)
            impact = np.where(self.resting, np.inf, checked_impact_times("time_of_impact_exact", roots))
            struck, remaining = self.move_to_impact(fly, impact, remaining)
            if not struck.any():
                return
            self.respond(struck, time + self.dt - remaining)

    def step_to_slides_times(self, time: float) -> None:
        """The same with the slide's T: where the chord between the separations now and after the rest of the step is 0.

        A ball that leaves the plane and is back within the step starts and ends on it; a chord cannot see that flight.
        """
        fly = self.function("ballistic_motion")
        remaining = self.whole_step
        for _ in self.rounds():
            before = np.maximum(
                self.separation(self.position), 0.0
            )  # left on the plane, it may be behind it by rounding
            after = self.separation(self.moved(fly, self.resting, remaining)[0])
            chords = self.function("time_of_impact_interpolated")(before, after, 0.0, remaining[:, None])
            impact = checked_impact_times("time_of_impact_interpolated", chords)
            leaves = (before == 0) & (self.normal_velocity() > 0)
            impact = np.where(self.resting | leaves, np.inf, impact)
            struck, remaining = self.move_to_impact(fly, impact, remaining)
            if not struck.any():
                return
            self.respond(struck, time + self.dt - remaining)

    def respond_then_step(self, time: float) -> None:
        """Let every ball bounce off the planes that it is behind and approaches, then take a semi-implicit step."""
        behind = self.function("is_colliding")(self.separation(self.position))
        struck = behind & (self.normal_velocity() < 0) & ~self.resting
        self.respond(struck, np.full(len(struck), time))
        euler, supported = self.function("semi_implicit_euler"), struck | self.resting
        self.position, self.velocity = self.moved(euler, supported, self.whole_step)

    # What they share

    def rounds(self) -> Iterator[int]:
        """Count the rounds of impacts within a step, and give up on a ball that will not get away from its planes."""
        if self.normal.shape[1] == 1:
            yield from itertools.count()
        yield from range(_MOST_IMPACTS)
        raise RunFailed(f"more than {_MOST_IMPACTS} impacts in one step: the planes leave the ball no way out")

    def separation(self, position: Array) -> Array:
        """Gap between each plane and its ball at a position (N, 3): (N, P), m; negative behind the plane."""
        return np.asarray(self._signed_distance(position[:, None], self.normal, self.offset - self.radius[:, None]))

    def normal_velocity(self) -> Array:
        """Velocity along each plane's normal, (N, P), m/s; negative when approaching."""
        return np.asarray(np.sum(self.velocity[:, None] * self.normal, axis=-1))

    def moved(self, motion: Motion, supported: Mask, duration: Array) -> tuple[Array, Array]:
        """Positions and velocities after a while; to a ball that a plane supports, weight along the plane is left."""
        acceleration = self.free_acceleration
        for plane in range(self.normal.shape[1]):  # where there are several, there is no weight
            acceleration = np.where(supported[:, plane, None], self.along_plane[:, plane], acceleration)
        return motion(self.position, self.velocity, acceleration, duration)

    def move_to_impact(self, fly: Motion, impact: Array, remaining: Array) -> tuple[Mask, Array]:
        """Move each ball to its first impact, or to the end of the step; return what it strikes and what remains, s."""
        first = np.min(impact, axis=1)
        passed = np.minimum(first, remaining)
        self.position, self.velocity = self.moved(fly, self.resting, passed)
        return impact <= np.minimum(first + _ONE_INSTANT * self.dt, remaining)[:, None], remaining - passed

    def respond(self, struck: Mask, time: Array) -> None:
        """Let each ball bounce off the planes that it strikes (N, P), one after another.

        The plane that it approaches fastest comes first. Where planes are not perpendicular, an impact changes how the
        ball approaches the next one: if it then moves away, that impact does not happen.
        """
        every, left = np.arange(len(struck)), struck.copy()
        while left.any():
            plane = np.argmin(np.where(left, self.normal_velocity(), np.inf), axis=1)
            self.bounce_off(plane, left[every, plane], time)
            left[every, plane] = False
            left &= self.normal_velocity() < 0

    def bounce_off(self, plane: NDArray[np.intp], struck: Mask, time: Array) -> None:
        """Give the balls that strike (N,) their velocities after it; one that leaves too slowly comes to rest."""
        every = np.arange(len(struck))
        normal, restitution = self.normal[every, plane], self.restitution[every, plane]
        rebound = self._kinematic_response(self.velocity, normal, restitution)
        self.velocity = np.where(struck[:, None], rebound, self.velocity)
        leaving, speed = self.normal_velocity(), np.linalg.norm(self.velocity, axis=1, keepdims=True)
        # An impact may drive a ball back into a plane that it rested on and that is not perpendicular.
        self.resting &= (
            (leaving >= -_ROUNDING * speed) | ~struck[:, None] | (np.arange(leaving.shape[1]) == plane[:, None])
        )
        leaving = leaving[every, plane]
        to_rest = struck & (leaving <= self.rest_speed[every, plane])
        self.velocity = np.where(to_rest[:, None], self.velocity - leaving[:, None] * normal, self.velocity)
        self.resting[every, plane] |= to_rest
        self.report(struck, time, "impact")
        self.report(to_rest, time, "rest")


class _Slabs(_Points):
    """Boxes that lie flat on planes: two ways to step them."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        weight = self.function("uniform_gravity")
        self._friction_force, self._sliding_motion = self.function("friction_force"), self.function("sliding_motion")
        others = [
            np.sum([(0.0, 0.0, 0.0), *(each.force for each in scenario.forces)], axis=0) for scenario in scenarios
        ]
        pull, normal = weight(self.mass, self.gravity) + np.array(others), self.normal[:, 0]
        self.normal_force = -np.sum(pull * normal, axis=1)
        self.push = pull + self.normal_force[:, None] * normal
        # A box sets out along its velocity, or along the push if it has none.
        way = np.where(np.any(self.velocity, axis=1, keepdims=True), self.velocity, self.push)
        length = np.linalg.norm(way, axis=1, keepdims=True)
        self.line = way / np.where(length > 0, length, 1.0)
        self.static_friction = np.array([scenario.pairs[0].static_friction for scenario in scenarios])
        self.kinetic_friction = np.array([scenario.pairs[0].kinetic_friction for scenario in scenarios])

    def step_exactly(self, time: float) -> None:
        """Slide through the step, and stop within it where friction has taken all speed."""
        friction = self.static_friction, self.kinetic_friction
        self.position, self.velocity, stop = self._sliding_motion(
            self.position, self.velocity, self.push, self.normal_force, *friction, self.mass, self.dt
        )
        self.stay_on_line()
        self.report(np.isfinite(stop), time + stop, "stop")

    def step_semi_implicitly(self, time: float) -> None:
        """Change the velocity by the force at the start of the step, then move with the new velocity."""
        friction = self.static_friction, self.kinetic_friction
        force = self.push + self._friction_force(self.push, self.velocity, self.normal_force, *friction)
        velocity = self.velocity + force / self.mass[:, None] * self.dt
        turns_back = (np.sum(velocity * self.velocity, axis=1) <= 0) & np.any(self.velocity != 0, axis=1)
        self.velocity = np.where(turns_back[:, None], 0.0, velocity)  # friction stops a body; it cannot push it back
        self.stay_on_line()
        self.position = self.position + self.velocity * self.dt

    def stay_on_line(self) -> None:
        """Take from slow velocities what rounding has put across the line that the box slides on.

        Friction that takes f dt from a speed v in a step also multiplies what lies across the line by 1 − f dt/v. Where
        the speed is small, as it is for long just above the critical slope, that makes rounding grow from step to step.
        """
        taken = self.kinetic_friction * self.normal_force / self.mass * self.dt
        speed = np.linalg.norm(self.velocity, axis=1)
        slow = (speed > 0) & (speed < taken)
        along = np.sum(self.velocity * self.line, axis=1, keepdims=True) * self.line
        self.velocity = np.where(slow[:, None], along, self.velocity)
