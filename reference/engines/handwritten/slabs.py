"""Step loops for boxes that lie flat on a plane and slide as points do, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reference.engines.handwritten.points import PointsAndPlanes
from reference.engines.handwritten.stepping import policy_of, record
from reference.engines.implementation import Implementation
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory


def slide(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Boxes flat on a plane that slide in a straight line and stop, or hold."""
    return run(Slabs, engine, scenarios, settings, steps, implementation)


def run(
    kind: type[Slabs],
    engine: str,
    scenarios: Sequence[Scenario],
    settings: Settings,
    steps: list[int],
    implementation: Implementation,
    steady: bool = True,
) -> list[Trajectory]:
    """Step slabs of one kind together. steady: whether the forces on them depend on their state alone."""
    slabs = kind(scenarios, settings, implementation)
    policy = policy_of({"exact_root": slabs.step_exactly, "at_step": slabs.step_semi_implicitly}, settings)
    return record(engine, scenarios, settings, steps, slabs.states, policy, slabs.events, steady)


class Slabs(PointsAndPlanes):
    """Boxes that lie flat on planes: two ways to step them."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        weight = self.function("uniform_gravity")
        self._friction_force, self._sliding_motion = self.function("friction_force"), self.function("sliding_motion")
        others = [
            np.sum([(0.0, 0.0, 0.0), *(each.at(0.0) for each in scenario.forces)], axis=0) for scenario in scenarios
        ]
        pull, normal = weight(self.mass, self.gravity) + np.array(others), self.normals[:, 0]
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
