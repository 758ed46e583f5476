"""A prediction: the trajectory that a method must give, and how near to it the implementation must come."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.prediction import bands
from reference.prediction.bands import Term
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.survey import Survey
from reference.scene.trajectory import Event, Trajectory

TITLE = "prediction"


@dataclass(frozen=True)
class Prediction:
    """trajectory: what the recurrence gives. terms: of the band, besides the rounding of the steps."""

    trajectory: Trajectory
    terms: tuple[Term, ...] = ()

    @property
    def near(self) -> float:
        """How near each number must be, as a share of it or of its size."""
        scenario = self.trajectory.scenario
        count = 0 if isinstance(scenario, Survey) else self.trajectory.settings.steps_for(scenario.duration)
        return sum((term.share for term in self.terms), bands.steps(count).share)

    def band(self, predicted: float, size: float = 1.0) -> float:
        """Accepted distance from a predicted number, in its unit. size: how large such a number is, if not one unit."""
        return self.near * max(size, abs(predicted))


@dataclass(frozen=True)
class Path:
    """How one body moves: position and velocity after each step, (steps + 1, 3), m and m/s, start included.

    spin: angular velocity, (steps + 1, 3), rad/s. orientation: (steps + 1, 4), w x y z. Those of the start where they
    are not given.
    """

    position: Array
    velocity: Array
    spin: Array | None = None
    orientation: Array | None = None


def trajectory_of(
    scenario: Scenario, settings: Settings, paths: Mapping[str, Path], events: tuple[Event, ...] = ()
) -> Trajectory:
    """The trajectory with a sample every so many steps as the settings say; bodies without a path stay as they are."""
    every = settings.sample_every
    count = 1 + settings.steps_for(scenario.duration) // every
    states = np.tile(np.array([body.state() for body in scenario.bodies]), (count, 1, 1))
    for name, path in paths.items():
        place = scenario.index(name)
        parts = {(0, 3): path.position, (3, 7): path.orientation, (7, 10): path.velocity, (10, 13): path.spin}
        for (first, end), values in parts.items():
            if values is not None:
                states[:, place, first:end] = values[::every]
    times: Array = np.arange(count, dtype=np.float64) * every * settings.timestep
    position, orientation, velocity, spin = np.split(states, (3, 7, 10), axis=-1)
    kept = tuple(event for event in events if event.time <= times[-1])
    return Trajectory(scenario, settings, TITLE, times, position, orientation, velocity, spin, events=kept)
