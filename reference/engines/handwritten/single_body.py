"""Step loops for single bodies, batch first: N scenarios of one kind run side by side in arrays (N, 3).

All physics is asked of the implementation's functions; the loops only say when.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence

import numpy as np

from reference.engines.handwritten.stepping import Array, Mask, policy_of, record, start, until
from reference.engines.implementation import Implementation
from reference.scene.scenario import Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory


class _Batch:
    """The single movable body of each scenario and the plane below it, as arrays over the scenarios."""

    def __init__(self, scenarios: Sequence[Scenario]) -> None:
        self.bodies = [next(body for body in scenario.bodies if not body.immovable) for scenario in scenarios]
        planes = [next(body for body in scenario.bodies if body.immovable) for scenario in scenarios]
        self.position = np.array([body.position for body in self.bodies])
        self.velocity = np.array([body.velocity for body in self.bodies])
        self.mass = np.array([body.mass for body in self.bodies])
        self.gravity = np.array([scenario.gravity for scenario in scenarios])
        self.normal = np.array([plane.shape.normal for plane in planes])  # type: ignore[union-attr]
        self.offset = -np.sum(self.normal * np.array([plane.position for plane in planes]), axis=1)
        self.pairs: list[Pair] = [scenario.pairs[0] for scenario in scenarios]
        self.events: list[list[Event]] = [[] for _ in scenarios]
        self._start = start(scenarios)
        self._moving = [scenario.bodies.index(body) for scenario, body in zip(scenarios, self.bodies, strict=True)]

    def states(self) -> Array:
        """Of all bodies the 13 numbers that a sample keeps, (N, 2, 13)."""
        states, every = self._start.copy(), np.arange(len(self._moving))
        states[every, self._moving, :3], states[every, self._moving, 7:10] = self.position, self.velocity
        return states

    def report(self, mask: Mask, time: Array, kind: str) -> None:
        """Note an event at `time` (N,) for the members in the mask."""
        for member in np.flatnonzero(mask):
            self.events[member].append(Event(float(time[member]), kind, self.bodies[member].name))


def bounce(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Balls that fall on a plane, bounce and come to rest; no friction. What a policy has no use for is not asked."""
    function = functools.cache(implementation.function)
    signed_distance, respond = function("signed_distance"), function("kinematic_response")
    weight, fly = function("uniform_gravity"), function("ballistic_motion")

    batch, dt = _Batch(scenarios), settings.timestep
    every_dt = np.full(len(scenarios), dt)
    radius = np.array([body.shape.radius for body in batch.bodies])  # type: ignore[union-attr]
    restitution = np.array([pair.restitution for pair in batch.pairs])
    acceleration = weight(batch.mass, batch.gravity) / batch.mass[:, None]
    normal_acceleration = np.sum(acceleration * batch.normal, axis=1)
    along_plane = acceleration - normal_acceleration[:, None] * batch.normal  # what is left to a ball on the plane
    rest_speed = settings.number("shortest_flight") * dt * -normal_acceleration / 2
    resting = np.zeros(len(scenarios), dtype=bool)

    def separation(position: Array) -> Array:
        return np.asarray(signed_distance(position, batch.normal, batch.offset - radius))

    def after(move: Callable[..., tuple[Array, Array]], duration: Array) -> tuple[Array, Array]:
        return move(batch.position, batch.velocity, np.where(resting[:, None], along_plane, acceleration), duration)

    def answer(struck: Mask, time: Array) -> None:
        answered = respond(batch.velocity, batch.normal, restitution)
        batch.velocity = np.where(struck[:, None], answered, batch.velocity)
        leaving = np.sum(batch.velocity * batch.normal, axis=1)
        to_rest = struck & (leaving <= rest_speed)
        batch.velocity = np.where(to_rest[:, None], batch.velocity - leaving[:, None] * batch.normal, batch.velocity)
        resting[to_rest] = True
        batch.report(struck, time, "impact")
        batch.report(to_rest, time, "rest")

    def until_exact_root(remaining: Array) -> Array:
        normal_velocity = np.sum(batch.velocity * batch.normal, axis=1)
        exact = function("time_of_impact_exact")
        time = exact(separation(batch.position), normal_velocity, normal_acceleration)
        return until("time_of_impact_exact", np.asarray(time))

    def until_slides_t(remaining: Array) -> Array:
        start = np.maximum(separation(batch.position), 0.0)  # left on the plane, it may be behind it by rounding
        end = separation(after(fly, remaining)[0])
        interpolated = function("time_of_impact_interpolated")
        time = until("time_of_impact_interpolated", np.asarray(interpolated(start, end, 0.0, remaining)))
        moves_away = np.sum(batch.velocity * batch.normal, axis=1) > 0  # and back within the step: a chord cannot tell
        return np.where((start == 0) & moves_away, np.inf, time)

    def step_through_impacts(time: float, until_impact: Callable[[Array], Array]) -> None:
        remaining = every_dt
        while True:
            impact = np.where(resting, np.inf, until_impact(remaining))
            struck = impact <= remaining
            passed = np.minimum(impact, remaining)
            batch.position, batch.velocity = after(fly, passed)
            remaining = remaining - passed
            if not struck.any():
                return
            answer(struck, time + dt - remaining)

    def respond_or_step(time: float) -> None:
        approaching = np.sum(batch.velocity * batch.normal, axis=1) < 0
        behind = function("is_colliding")(separation(batch.position)) & approaching & ~resting
        answer(behind, np.full(len(scenarios), time))
        supported = np.where((behind | resting)[:, None], along_plane, acceleration)
        euler = function("semi_implicit_euler")
        batch.position, batch.velocity = euler(batch.position, batch.velocity, supported, every_dt)

    policies: dict[str, Callable[[float], None]] = {
        "exact_root": lambda time: step_through_impacts(time, until_exact_root),
        "interpolated": lambda time: step_through_impacts(time, until_slides_t),
        "at_step": respond_or_step,
    }
    return record(engine, scenarios, settings, steps, batch.states, policy_of(policies, settings), batch.events)


def slide(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Boxes flat on a plane that slide in a straight line and stop, or hold."""
    weight = implementation.function("uniform_gravity")
    friction_force = implementation.function("friction_force")
    sliding_motion = implementation.function("sliding_motion")

    batch, dt = _Batch(scenarios), settings.timestep
    pull = weight(batch.mass, batch.gravity)
    normal_force = -np.sum(pull * batch.normal, axis=1)
    push = pull + normal_force[:, None] * batch.normal
    friction = [
        np.array(values) for values in zip(*((p.static_friction, p.kinetic_friction) for p in batch.pairs), strict=True)
    ]

    def step_exactly(time: float) -> None:
        batch.position, batch.velocity, stop = sliding_motion(
            batch.position, batch.velocity, push, normal_force, *friction, batch.mass, dt
        )
        batch.report(np.isfinite(stop), time + stop, "stop")

    def step_semi_implicitly(time: float) -> None:
        force = push + friction_force(push, batch.velocity, normal_force, *friction)
        velocity = batch.velocity + force / batch.mass[:, None] * dt
        reversed_ = (np.sum(velocity * batch.velocity, axis=1) <= 0) & np.any(batch.velocity != 0, axis=1)
        batch.velocity = np.where(reversed_[:, None], 0.0, velocity)  # friction stops a body; it cannot push it back
        batch.position = batch.position + batch.velocity * dt

    policies: dict[str, Callable[[float], None]] = {"exact_root": step_exactly, "at_step": step_semi_implicitly}
    return record(engine, scenarios, settings, steps, batch.states, policy_of(policies, settings), batch.events)
