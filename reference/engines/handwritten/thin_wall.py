"""Step loops for balls without weight that fly straight at a fixed wall, which they may pass unseen, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten.points import Points
from reference.engines.handwritten.scenario_bodies import ball_and_other, face_towards, in_own_axes
from reference.engines.handwritten.stepping import checked_impact_times, policy_of, record
from reference.engines.implementation import Implementation
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory


def shoot(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Balls that fly straight at a wall and are turned back by it, where it is noticed that they overlap it."""
    shots = _Shots(scenarios, settings, implementation)
    policies = {"exact_root": shots.step_through_first_overlap, "at_step": shots.respond_then_step}
    return record(engine, scenarios, settings, steps, shots.states, policy_of(policies, settings), shots.events)


class _Shots(Points):
    """The ball of each of N scenarios and the wall that it flies at: a continuous test over a step, and a discrete one.

    Nothing but the wall changes a velocity, so that a ball which was turned back never meets the wall again.
    """

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        both = [ball_and_other(scenario) for scenario in scenarios]
        self.radius = np.array([ball.shape.radius for ball, _ in both])  # type: ignore[union-attr]
        self.normal = np.array([face_towards(ball, wall) for ball, wall in both])
        half_extents = [
            np.abs(in_own_axes(wall, normal)) @ wall.shape.half_extents  # type: ignore[union-attr]
            for (_, wall), normal in zip(both, self.normal, strict=True)
        ]
        self.thickness = 2 * np.array(half_extents)
        middle = np.array([wall.position for _, wall in both])
        self.front = -np.vecdot(self.normal, middle) - self.thickness / 2
        self.restitution = np.array([scenario.pairs[0].restitution for scenario in scenarios])
        self.no_weight = np.zeros_like(self.position)

    def step_through_first_overlap(self, time: float) -> None:
        """Turn each ball back at the first instant of the step at which it overlaps the wall, if there is one."""
        impact = self.first_overlap(self.whole_step)
        after = self.function("respond_at_impact")(
            self.position, self.velocity, self.no_weight, self.normal, self.restitution, impact, self.whole_step
        )
        self.position, self.velocity = map(np.asarray, after)
        self.report(impact <= self.whole_step, time + impact, "impact")

    def respond_then_step(self, time: float) -> None:
        """Turn each ball back that overlaps the wall at the start of the step, and leave it where it is.

        The test is the continuous one over a time of 0: it sees this instant alone.
        """
        overlaps = self.first_overlap(0 * self.whole_step) <= self.whole_step
        after = self.function("respond_at_step")(
            self.position, self.velocity, self.no_weight, self.normal, overlaps, self.restitution, self.whole_step
        )
        self.position, self.velocity = map(np.asarray, after)
        self.report(overlaps, np.full(len(overlaps), time), "impact")

    def first_overlap(self, duration: Array) -> Array:
        """When within a while each ball overlaps the wall and approaches, (N,), s; infinity where it does not."""
        distance = self.function("signed_distance")(self.position, self.normal, self.front)
        closing = np.vecdot(self.velocity, self.normal)
        start, end = self.function("overlap_interval")(distance, closing, self.radius, self.thickness, duration)
        overlaps = (np.asarray(start) <= np.asarray(end)) & (closing < 0)
        return checked_impact_times("overlap_interval", np.where(overlaps, start, np.inf))
