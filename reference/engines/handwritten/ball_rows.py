"""Step loops for balls in a line, as in Newton's cradle: the order of the impacts is a choice, and the result shows."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from reference.arrays import Array, Mask
from reference.engines.handwritten.stepping import policy_of, record, start
from reference.engines.implementation import Implementation
from reference.errors import RunFailed
from reference.scene.scenario import Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

_ROUNDING = 1e-12  # a gap below this, m, is rounding
_MOST_IMPACTS = 2_000  # of a whole row within one step
_NO_APPROACH = 1e-14  # share of the fastest ball's speed: what rounding leaves after ever smaller impacts in no time


def cradle(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Balls in a line: with `exact_root` two collide at a time, with `at_step` all at once that touch."""
    return [
        _Row(scenario, settings, implementation).run(engine, settings, count)
        for scenario, count in zip(scenarios, steps, strict=True)
    ]


class _Row:
    """n balls in order along a line; places and velocities along it, (n,)."""

    def __init__(self, scenario: Scenario, settings: Settings, implementation: Implementation) -> None:
        self.scenario, self.dt, self.function = scenario, settings.timestep, implementation.function
        self._start = start([scenario])
        centres, velocities = self._start[0, :, :3], self._start[0, :, 7:10]
        self._along = (centres[-1] - centres[0]) / np.linalg.norm(centres[-1] - centres[0])
        self.place, self.velocity = centres @ self._along, velocities @ self._along
        self._first = self.place.copy()
        self.radius = np.array([body.shape.radius for body in scenario.bodies if isinstance(body.shape, Sphere)])
        self.mass = np.array([body.mass for body in scenario.bodies])
        restitution = {frozenset((pair.body_a, pair.body_b)): pair.restitution for pair in scenario.pairs}
        names = [body.name for body in scenario.bodies]
        self.restitution = np.array([restitution[frozenset(two)] for two in pairwise(names)])
        self.events: list[Event] = []

    def run(self, engine: str, settings: Settings, count: int) -> Trajectory:
        """Step with the policy of the settings."""
        policies = {"exact_root": self.step_two_at_a_time, "at_step": self.step_all_at_once}
        step = policy_of(policies, settings)
        return record(engine, [self.scenario], settings, [count], self._states, step, [self.events])[0]

    def step_two_at_a_time(self, time: float) -> None:
        """Fly to the next impact of two neighbours, pass it on along the row, and fly on until the step is over."""
        remaining = self.dt
        for _ in range(_MOST_IMPACTS):
            impact = self._until_impact(remaining)
            self._fly(min(impact, remaining))
            remaining -= min(impact, remaining)
            if impact == np.inf:
                return
            self._respond("propagate_impacts", self._gaps() < _ROUNDING, time + self.dt - remaining)
        raise RunFailed(f"{_MOST_IMPACTS} impacts within one step of {self.dt:g} s")

    def step_all_at_once(self, time: float) -> None:
        """Resolve the impacts of all balls that touch together, then fly through the step."""
        self._respond("simultaneous_impacts", self._gaps() < _ROUNDING, time)
        self._fly(self.dt)

    def _gaps(self) -> Array:
        """Gaps between neighbours, (n − 1,), m."""
        return np.asarray(np.diff(self.place) - self.radius[:-1] - self.radius[1:])

    def _until_impact(self, remaining: float) -> float:
        """Time until two neighbours that approach next touch, s; infinity if none do in the remaining time."""
        place, velocity = self.place[:, None] * self._along, self.velocity[:, None] * self._along
        left, right = (place[:-1], velocity[:-1], self.radius[:-1]), (place[1:], velocity[1:], self.radius[1:])
        time = self.function("sweep_sphere_sphere")(*left, *right, remaining)
        approaching = np.diff(self.velocity) < -_NO_APPROACH * np.max(np.abs(self.velocity))
        return float(np.min(np.where(approaching, time, np.inf)))

    def _fly(self, duration: float) -> None:
        self.place = self.place + self.velocity * duration

    def _respond(self, rule: str, touching: Mask, time: float) -> None:
        """Give each group of balls that touch the velocities that the implementation's function `rule` returns."""
        velocity = self.velocity.copy()
        for group in np.split(np.arange(len(velocity)), 1 + np.flatnonzero(~touching)):
            if len(group) > 1:
                velocity[group] = self.function(rule)(velocity[group], self.mass[group], self.restitution[group[:-1]])
        for ball in np.flatnonzero(velocity != self.velocity):
            self.events.append(Event(time, "impact", self.scenario.bodies[ball].name))
        self.velocity = velocity

    def _states(self) -> Array:
        """The states of all balls as a sample keeps them, (1, n, 13)."""
        states = self._start.copy()
        states[0, :, :3] += (self.place - self._first)[:, None] * self._along
        states[0, :, 7:10] = self.velocity[:, None] * self._along
        return states
