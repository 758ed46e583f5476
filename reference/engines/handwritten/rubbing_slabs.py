"""Step loops for boxes that lie flat on a level plane and swing on a spring, with friction against them, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reference.engines.handwritten.slabs import Slabs, run
from reference.engines.implementation import Implementation
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory


def swing(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Boxes flat on a plane that swing on springs along a line, until friction holds them."""
    # The exact motion is a function of time, and halts for an instant at each turning point.
    return run(_SwingingSlabs, engine, scenarios, settings, steps, implementation, steady=False)


class _SwingingSlabs(Slabs):
    """Boxes that lie flat on planes, each on one spring that is held in the world."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        springs = [scenario.springs[0] for scenario in scenarios]
        self.anchor = np.array([spring.point_b for spring in springs])
        self.stiffness = np.array([spring.stiffness for spring in springs])
        self.rest_length = np.array([spring.rest_length for spring in springs])
        away = self.position - self.anchor
        self.line = away / np.linalg.norm(away, axis=1, keepdims=True)
        self.balance = self.anchor + self.rest_length[:, None] * self.line
        self._stretched = np.sum((self.position - self.balance) * self.line, axis=1)
        self._speed = np.sum(self.velocity * self.line, axis=1)

    def step_exactly(self, time: float) -> None:
        """Take the state at the end of the step from that at the start of the run."""
        swing = self.function("friction_oscillator")
        friction = self.kinetic_friction * self.normal_force
        place, speed = swing(self._stretched, self._speed, self.stiffness, friction, self.mass, time + self.dt)
        self.position = self.balance + np.asarray(place)[:, None] * self.line
        self.velocity = np.asarray(speed)[:, None] * self.line

    def step_semi_implicitly(self, time: float) -> None:
        """Let the spring pull as it does at the start of the step."""
        pull = self.function("spring_force")
        self.push = pull(self.position, self.anchor, self.stiffness, self.rest_length)
        super().step_semi_implicitly(time)
