"""What every hand-written driver does around its step: choose the policy, take samples and make trajectories."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from reference.arrays import Array
from reference.errors import InvalidInput, RunFailed
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

Step = Callable[[float], None]
"""Takes the time at which the step begins, s."""


def policy_of(policies: Mapping[str, Step], settings: Settings) -> Step:
    """Return the step that the settings ask for; refuse one that this driver does not have."""
    name = str(settings["policy"])
    if name not in policies:
        raise InvalidInput(f"policy is {name!r}; here it is one of {', '.join(policies)}")
    return policies[name]


def checked_impact_times(name: str, times: Array) -> Array:
    """Return times of impact, s, as the function of that name gave them; refuse those in the past and NaN."""
    found = np.asarray(times)
    wrong = found[~(found >= 0)]
    if wrong.size:
        raise RunFailed(
            f"{name} answered {wrong.flat[0]:.6g} s: a time of impact is 0 or later, infinity where there is no impact"
        )
    return found


def start(scenarios: Sequence[Scenario]) -> Array:
    """Return the states in which all bodies start, (N, bodies, 13); the scenarios have equally many bodies."""
    return np.array([[body.state() for body in scenario.bodies] for scenario in scenarios])


def record(
    engine: str,
    scenarios: Sequence[Scenario],
    settings: Settings,
    steps: list[int],
    states: Callable[[], Array],
    step: Step,
    events: Sequence[Sequence[Event]],
    steady: bool = True,
) -> list[Trajectory]:
    """Step all scenarios together, and return each one's own trajectory, cut after its own number of steps.

    states: returns position, orientation, velocity and angular velocity of every body, (N, bodies, 13). events: one
    list for each scenario, to which the step adds. steady: whether forces depend on the state alone.
    """
    every, now = settings.sample_every, states()
    samples = [now]
    for number in range(max(steps)):
        before, known = now, sum(map(len, events))
        step(number * settings.timestep)
        now = states()
        if (number + 1) % every == 0:
            samples.append(now)
        if steady and np.array_equal(now, before) and sum(map(len, events)) == known:
            break  # where one step changes nothing, no later one will
    samples += [now] * (1 + max(steps) // every - len(samples))
    times: Array = np.arange(len(samples), dtype=np.float64) * every * settings.timestep
    all_states = np.array(samples, dtype=np.float64)  # (samples, N, bodies, 13)
    return [
        _trajectory(engine, scenario, settings, times[:count], all_states[:count, member], events[member])
        for member, scenario in enumerate(scenarios)
        for count in [1 + steps[member] // every]
    ]


def _trajectory(
    engine: str, scenario: Scenario, settings: Settings, times: Array, states: Array, events: Sequence[Event]
) -> Trajectory:
    position, orientation, velocity, spin = np.split(states, (3, 7, 10), axis=-1)
    kept = tuple(event for event in events if event.time <= times[-1])
    return Trajectory(scenario, settings, engine, times, position, orientation, velocity, spin, events=kept)
