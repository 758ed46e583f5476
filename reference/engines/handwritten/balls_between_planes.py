"""Step loops for balls without friction and weight that fly between several planes, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from reference.arrays import Array, Mask
from reference.engines.handwritten.points import Motion, PointsAndPlanes
from reference.engines.handwritten.stepping import checked_impact_times, policy_of, record
from reference.engines.implementation import Implementation
from reference.errors import RunFailed
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

_ONE_INSTANT = 1e-9  # share of a step: a ball that meets two planes within so short a time meets both at once
_ROUNDING = 1e-12  # share of the ball's speed
_MOST_IMPACTS = 10_000  # of one ball between several planes within one step


def fly(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Balls without friction and weight between several planes, off which they bounce."""
    balls = _Balls(scenarios, settings, implementation)
    policies = {
        "exact_root": balls.step_to_exact_roots,
        "interpolated": balls.step_to_slides_times,
        "at_step": balls.respond_then_step,
    }
    return record(engine, scenarios, settings, steps, balls.states, policy_of(policies, settings), balls.events)


class _Balls(PointsAndPlanes):
    """N balls and P planes for each: three ways to step them, and what the three share.

    `respond_at_impact` and `respond_at_step` know one plane, and go to the end of the step with it. A ball may meet two
    planes at one instant, or one after another within a step. So these loops call `kinematic_response` themselves. What
    belongs to a ball and one of its planes is an array (N, P).
    """

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        self._signed_distance = self.function("signed_distance")
        self._kinematic_response = self.function("kinematic_response")
        self.radius = np.array([body.shape.radius for body in self.bodies])  # type: ignore[union-attr]
        self.restitution = np.array([[pair.restitution for pair in scenario.pairs] for scenario in scenarios])
        self.acceleration = self.function("uniform_gravity")(self.mass, self.gravity) / self.mass[:, None]
        self.resting = np.zeros(self.restitution.shape, dtype=bool)

    # The three policies

    def step_to_exact_roots(self, time: float) -> None:
        """Fly each ball to its first impact, let it bounce there, and fly on until the step is over."""
        fly, time_of_impact = self.function("ballistic_motion"), self.function("time_of_impact_exact")
        remaining = self.whole_step
        for _ in self.rounds():
            roots = time_of_impact(self.separation(self.position), self.normal_velocity(), self.normal_acceleration())
            impact = np.where(self.resting, np.inf, checked_impact_times("time_of_impact_exact", roots))
            struck, remaining = self.move_to_impact(fly, impact, remaining)
            if not struck.any():
                return
            self.respond(struck, time + self.dt - remaining)

    def step_to_slides_times(self, time: float) -> None:
        """The same with the slide's T: where the chord between the separations now and after the rest of the step is 0.

        A ball that leaves a plane is not taken to meet it: at its start the chord is 0 as well.
        """
        fly = self.function("ballistic_motion")
        remaining = self.whole_step
        for _ in self.rounds():
            before = np.maximum(
                self.separation(self.position), 0.0
            )  # left on the plane, it may be behind it by rounding
            after = self.separation(self.moved(fly, remaining)[0])
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
        behind = self.function("side_of_plane")(self.separation(self.position)) < 0
        self.respond(behind & (self.normal_velocity() < 0) & ~self.resting, np.full(len(behind), time))
        self.position, self.velocity = self.moved(self.function("semi_implicit_euler"), self.whole_step)

    # What they share

    def rounds(self) -> Iterator[int]:
        """Count the rounds of impacts within a step, and give up on a ball that will not get away from its planes."""
        yield from range(_MOST_IMPACTS)
        raise RunFailed(f"more than {_MOST_IMPACTS} impacts in one step: the planes leave the ball no way out")

    def separation(self, position: Array) -> Array:
        """Gap between each plane and its ball at a position (N, 3): (N, P), m; negative behind the plane."""
        return np.asarray(self._signed_distance(position[:, None], self.normals, self.offsets - self.radius[:, None]))

    def normal_velocity(self) -> Array:
        """Velocity along each plane's normal, (N, P), m/s; negative when approaching."""
        return np.asarray(np.sum(self.velocity[:, None] * self.normals, axis=-1))

    def normal_acceleration(self) -> Array:
        """Acceleration along each plane's normal, (N, P), m/s²: none, since the balls have no weight."""
        return np.asarray(np.sum(self.acceleration[:, None] * self.normals, axis=-1))

    def moved(self, motion: Motion, duration: Array) -> tuple[Array, Array]:
        """Positions and velocities after a while."""
        return motion(self.position, self.velocity, self.acceleration, duration)

    def move_to_impact(self, fly: Motion, impact: Array, remaining: Array) -> tuple[Mask, Array]:
        """Move each ball to its first impact, or to the end of the step; return what it strikes and what remains, s."""
        first = np.min(impact, axis=1)
        passed = np.minimum(first, remaining)
        self.position, self.velocity = self.moved(fly, passed)
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
        """Give the balls that strike (N,) their velocities after it; one that does not leave rests on the plane."""
        every = np.arange(len(struck))
        normal, restitution = self.normals[every, plane], self.restitution[every, plane]
        rebound = self._kinematic_response(self.velocity, normal, restitution)
        self.velocity = np.where(struck[:, None], rebound, self.velocity)
        leaving, speed = self.normal_velocity(), np.linalg.norm(self.velocity, axis=1, keepdims=True)
        # An impact may drive a ball back into a plane that it rested on and that is not perpendicular.
        self.resting &= (
            (leaving >= -_ROUNDING * speed) | ~struck[:, None] | (np.arange(leaving.shape[1]) == plane[:, None])
        )
        leaving = leaving[every, plane]
        to_rest = struck & (leaving <= 0)
        self.velocity = np.where(to_rest[:, None], self.velocity - leaving[:, None] * normal, self.velocity)
        self.resting[every, plane] |= to_rest
        self.report(struck, time, "impact")
        self.report(to_rest, time, "rest")
