"""A trajectory: the result of a run, in the lab's units and conventions, the same for every implementation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reference.arrays import Array
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.scenario import Scenario
from reference.scene.settings import ROUNDING, Settings


def _read_only(values: NDArray[Any]) -> NDArray[Any]:
    """A view that cannot be written through; the array itself stays as it was."""
    view = values.view()
    view.flags.writeable = False
    return view


@dataclass(frozen=True)
class Event:
    """An instant that an event-driven implementation solved for: `impact`, `rest` or `stop`, at `time` in s."""

    time: float
    kind: str
    body: str


@dataclass(frozen=True, eq=False)  # == of two arrays is not one truth value
class Contacts:
    """The contacts that the implementation itself reported, one row each, n rows in all.

    sample: (n,) index into the trajectory's times. body_a, body_b: (n,) indices into the scenario's bodies.
    position: (n, 3), midpoint between the two surfaces, m. normal: (n, 3), unit, from B to A. separation: (n,), m,
    negative when overlapping. Arrays are read-only.
    """

    sample: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    body_a: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    body_b: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    position: Array = field(default_factory=lambda: np.zeros((0, 3)))
    normal: Array = field(default_factory=lambda: np.zeros((0, 3)))
    separation: Array = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        for entry in fields(self):
            object.__setattr__(self, entry.name, _read_only(getattr(self, entry.name)))

    def __reduce__(self) -> tuple[object, ...]:
        return Contacts, tuple(getattr(self, entry.name) for entry in fields(self))  # read-only on the other side too


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The states of all bodies at the sample times.

    times: (n,), s, increasing. positions: (n, b, 3), centres of mass, m. orientations: (n, b, 4), w x y z.
    velocities: (n, b, 3), m/s. angular_velocities: (n, b, 3), rad/s, world frame. The bodies are in the scenario's
    order. answers: (k,), to the k questions of a survey, and watched: (n, w), to the w that it asks at every sample;
    empty for any other scenario. Arrays are read-only. What an engine hands over in another shape, or with times that
    do not increase, is a failed run.
    """

    scenario: Scenario
    settings: Settings
    engine: str
    times: Array
    positions: Array
    orientations: Array
    velocities: Array
    angular_velocities: Array
    contacts: Contacts = field(default_factory=Contacts)
    events: tuple[Event, ...] = ()
    answers: Array = field(default_factory=lambda: np.zeros(0))
    watched: Array = field(default_factory=lambda: np.zeros((0, 0)))

    def __post_init__(self) -> None:
        for name in ("answers", "watched"):
            object.__setattr__(self, name, _read_only(np.asarray(getattr(self, name), dtype=np.float64)))
        count, bodies = len(self.times), len(self.scenario.bodies)
        if count < 2:
            raise RunFailed(f"{self.engine}: a trajectory needs two or more samples; it has {count}")
        shapes = {
            "times": (count,),
            "positions": (count, bodies, 3),
            "orientations": (count, bodies, 4),
            "velocities": (count, bodies, 3),
            "angular_velocities": (count, bodies, 3),
        }
        for name, shape in shapes.items():
            values = np.asarray(getattr(self, name), dtype=np.float64)
            if values.shape != shape:
                raise RunFailed(f"{self.engine}: {name} has shape {values.shape}; expected {shape}")
            finite = np.isfinite(values).reshape(count, -1).all(axis=1)
            if not finite.all():
                first = int(np.argmin(finite))
                raise RunFailed(f"{self.engine}: {name} are not finite from t = {self.times[first]:.6g} s on")
            object.__setattr__(self, name, _read_only(values))
        if np.any(np.diff(self.times) <= 0):
            raise RunFailed(f"{self.engine}: the times of a trajectory must increase")

    def __reduce__(self) -> tuple[object, ...]:
        return Trajectory, tuple(getattr(self, entry.name) for entry in fields(self))  # read-only on the other side too

    def check_whole(self) -> None:
        """Refuse a run that does not begin at zero, or that ends before its scenario does."""
        first, last, duration = self.times[0], self.times[-1], self.scenario.duration
        if first != 0 or last < duration - ROUNDING * self.settings.timestep * self.settings.sample_every:
            lasts = f"{self.scenario.name} lasts from 0 to {duration:g} s"
            raise RunFailed(f"{self.engine}: {lasts}, and the samples are from {first:g} to {last:g} s")

    def position(self, body: str) -> Array:
        """Positions of one body, (n, 3), m."""
        return self.positions[:, self.scenario.index(body)]

    def velocity(self, body: str) -> Array:
        """Velocities of one body, (n, 3), m/s."""
        return self.velocities[:, self.scenario.index(body)]

    def orientation(self, body: str) -> Array:
        """Orientations of one body, (n, 4), w x y z."""
        return self.orientations[:, self.scenario.index(body)]

    def angular_velocity(self, body: str) -> Array:
        """Angular velocities of one body, (n, 3), rad/s, world frame."""
        return self.angular_velocities[:, self.scenario.index(body)]


def held(scenario: Scenario, settings: Settings, speed: float = 1.0) -> Trajectory:
    """The run in which no body ever leaves its start: the first state at every sample, without contacts and events.

    speed: as what share of the first velocities it reports those of all samples.
    """
    count = 1 + settings.steps_for(scenario.duration) // settings.sample_every
    start = np.array([body.state() for body in scenario.bodies])
    start[:, 7:] *= speed
    states = np.broadcast_to(start, (count, *start.shape))
    times: Array = np.arange(count, dtype=np.float64) * settings.sample_every * settings.timestep
    position, orientation, velocity, spin = np.split(states, (3, 7, 10), axis=-1)
    return Trajectory(scenario, settings, "held", times, position, orientation, velocity, spin)


class Recorder:
    """Collects samples while an engine steps, and makes the trajectory of them."""

    def __init__(self, engine: str, scenario: Scenario, settings: Settings) -> None:
        self._engine, self._scenario, self._settings = engine, scenario, settings
        self._states: list[Sequence[float]] = []
        self._contacts: list[Sequence[float]] = []

    def sample(self, state: Sequence[float]) -> None:
        """Keep the next sample: 13 numbers a body, its position, orientation, velocity and angular velocity."""
        self._states.append(state)

    def contact(
        self, body_a: int, body_b: int, position: Sequence[float], normal: Sequence[float], separation: float
    ) -> None:
        """Keep a contact, as found in the step that led to the latest sample; `normal` from B to A."""
        self._contacts.append((len(self._states) - 1, body_a, body_b, *position, *normal, separation))

    def trajectory(self, spin_in_body_frame: bool = False) -> Trajectory:
        """Make the trajectory of what was kept; turn angular velocities into the world frame where they are not."""
        bodies, settings = len(self._scenario.bodies), self._settings
        states = np.array(self._states, dtype=np.float64).reshape(len(self._states), bodies, 13)
        spin = states[..., 10:13]
        table = np.array(self._contacts, dtype=np.float64).reshape(-1, 10)
        sample, body_a, body_b = table[:, :3].T.astype(np.int64)
        return Trajectory(
            self._scenario,
            settings,
            self._engine,
            np.arange(len(states), dtype=np.float64) * settings.sample_every * settings.timestep,
            states[..., 0:3],
            states[..., 3:7],
            states[..., 7:10],
            geometry.rotate(states[..., 3:7], spin) if spin_in_body_frame else spin,
            Contacts(sample, body_a, body_b, table[:, 3:6], table[:, 6:9], table[:, 9]),
        )
