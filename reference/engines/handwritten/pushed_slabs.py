"""Step loops for boxes that lie flat and at rest on a level plane until a growing push breaks them away, batch first.

All physics comes from the implementation's functions; the loops only decide when to call them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten.slabs import Slabs, run
from reference.engines.implementation import Implementation
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory


def break_away(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Boxes flat on a plane that hold at first, break away, and then slide along the push."""
    return run(_PushedSlabs, engine, scenarios, settings, steps, implementation, steady=False)


class _PushedSlabs(Slabs):
    """Boxes that lie flat on planes, under forces that grow from nothing."""

    def __init__(self, scenarios: Sequence[Scenario], settings: Settings, implementation: Implementation) -> None:
        super().__init__(scenarios, settings, implementation)
        rates = [[each.at(1.0) for each in scenario.forces] for scenario in scenarios]
        self.rate = np.array([np.sum(each, axis=0) for each in rates])
        self.line = self.rate / np.linalg.norm(self.rate, axis=1, keepdims=True)
        weight = self.function("uniform_gravity")(self.mass, self.gravity)
        when = self.function("break_away_time")(weight, self.rate, self.normals[:, 0], self.static_friction)
        self.breaks_away = np.asarray(when)
        self.report(np.isfinite(self.breaks_away), self.breaks_away, "break-away")

    def step_exactly(self, time: float) -> None:
        """Rest until the instant of break-away, and slide from there on.

        The push F + F' t changes the velocity as its value in the middle of the time does, F + F' dt/2, and the way as
        F + F' dt/3: the integral of F dt + F' dt²/2 is F dt²/2 + F' dt³/6. So a slide under a constant push, computed
        once with each, is exact.
        """
        begin = np.clip(self.breaks_away - time, 0.0, self.dt)
        left = self.dt - begin
        self.position, _ = self._slid(time + begin, left, 1 / 3)
        _, self.velocity = self._slid(time + begin, left, 1 / 2)
        self.stay_on_line()

    def _slid(self, time: Array, duration: Array, share: float) -> tuple[Array, Array]:
        """Position and velocity after a duration, s, with the push that acts when this share of it is over."""
        moves = duration > 0
        self.push = np.where(moves, time + share * duration, 0.0)[:, None] * self.rate
        friction = self.static_friction, self.kinetic_friction
        position, velocity, _ = self._sliding_motion(
            self.position, self.velocity, self.push, self.normal_force, *friction, self.mass, duration
        )
        return position, velocity

    def step_semi_implicitly(self, time: float) -> None:
        """Let the push of the start of the step act in it."""
        self.push = time * self.rate
        super().step_semi_implicitly(time)
