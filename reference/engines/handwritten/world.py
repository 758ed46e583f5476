"""The step loop of the hand-written world: bodies of many scenarios side by side, each scenario by itself.

All physics comes from the implementation's functions. Here is how a scenario is told to them, and how its part of the
states becomes a trajectory. An implementation has `advance_world`, which takes all bodies together, or the `step_world`
of the lab, which takes one scenario at a time (`small_world`).
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import fields
from itertools import accumulate
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten import small_world
from reference.engines.handwritten.loads import LoadsByHand
from reference.engines.handwritten.rigid_bodies import moments_of_inertia
from reference.engines.handwritten.world_settings import rules
from reference.engines.implementation import Implementation
from reference.errors import RunFailed
from reference.scene import geometry, surfaces
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Contacts, Trajectory

LOOKS_AFTER, LONGEST = 10.0, 200.0
"""From when on it is looked at how long a job will take in the world of the lab, and how long it may take.

Processor time, s. A job may take 300 s of the clock, and then it could only say that its process was stopped.
"""
TOO_SLOW = (
    "too slow: your step_world took {taken:.0f} s for {done:,} of {steps:,} steps, so that all would take {whole:.0f}"
    " s; run one case, or take a longer timestep"
)


def is_small(implementation: Implementation) -> bool:
    """Whether the world of an implementation is that of the lab."""
    return implementation.first_defined(("advance_world", "step_world")) == "step_world"


def run(
    engine: str, scenarios: Sequence[Scenario], settings: Settings, steps: list[int], implementation: Implementation
) -> list[Trajectory]:
    """Step scenarios in which contacts follow the same rules as one world; return the trajectories of all."""
    if is_small(implementation):
        return _run_one_by_one(engine, scenarios, steps, settings, implementation)
    told = [rules(scenario, settings) for scenario in scenarios]
    found: dict[int, Trajectory] = {}
    for alike in dict.fromkeys(told):
        places = [place for place, each in enumerate(told) if each == alike]
        own = [scenarios[place] for place in places], [steps[place] for place in places]
        found |= zip(places, _run_together(engine, *own, settings, alike, implementation), strict=True)
    return [found[place] for place in range(len(scenarios))]


def _run_one_by_one(
    engine: str, scenarios: Sequence[Scenario], steps: Sequence[int], settings: Settings, implementation: Implementation
) -> list[Trajectory]:
    """Step each scenario in the world of the lab; of a job that would take too long, say so early."""
    pace = _Pace(sum(steps))
    return [_run_small(engine, *each, settings, implementation, pace) for each in zip(scenarios, steps, strict=True)]


class _Pace:
    """Says after each step whether all of them would take too long."""

    def __init__(self, steps: int) -> None:
        self.steps, self.done, self.start = steps, 0, time.process_time()

    def stepped(self) -> None:
        self.done += 1
        taken = time.process_time() - self.start
        whole = taken / self.done * self.steps
        if taken > LOOKS_AFTER and whole > LONGEST:
            raise RunFailed(TOO_SLOW.format(taken=taken, done=self.done, steps=self.steps, whole=whole))


def _run_small(
    engine: str, scenario: Scenario, steps: int, settings: Settings, implementation: Implementation, pace: _Pace
) -> Trajectory:
    """Step one scenario in the world of the lab."""
    samples, met = small_world.run(scenario, steps, settings, implementation, pace.stepped)
    contacts = _contacts(met, len(samples), 0, len(scenario.bodies))
    return _trajectory(engine, scenario, settings, _times(len(samples), settings), np.array(samples), contacts)


def _run_together(
    engine: str,
    scenarios: Sequence[Scenario],
    steps: Sequence[int],
    settings: Settings,
    told: tuple[float | str, ...],
    implementation: Implementation,
) -> list[Trajectory]:
    """Step all scenarios as one world; return each one's own trajectory, cut after its own number of steps."""
    advance_world = implementation.function("advance_world")
    bodies = _bodies(scenarios, implementation)
    state = implementation.function("make_state")(*(_of_all(scenarios, part) for part in range(4)))
    acceleration = np.concatenate([np.tile(each.gravity, (len(each.bodies), 1)) for each in scenarios])
    loads, memory = LoadsByHand(scenarios, implementation), list[Any]()
    every, samples, met = settings.sample_every, [np.concatenate(state, axis=-1)], list[tuple[int, Any]]()
    for number in range(1, max(steps) + 1):
        force, torque = loads.on_bodies((number - 1) * settings.timestep, state)
        state, *memory, contacts = advance_world(
            bodies, state, acceleration, settings.timestep, told, *memory, force=force, torque=torque
        )
        if number % every == 0:
            samples.append(np.concatenate(state, axis=-1))
            met.append((number // every, contacts))
    times = _times(len(samples), settings)
    ends = [0, *accumulate(len(each.bodies) for each in scenarios)]
    states = np.array(samples)  # (samples, bodies, 13)
    return [
        _trajectory(
            engine, scenario, settings, times[:count], states[:count, first:end], _contacts(met, count, first, end)
        )
        for scenario, taken, first, end in zip(scenarios, steps, ends, ends[1:], strict=False)
        for count in [1 + taken // every]
    ]


def _times(count: int, settings: Settings) -> Array:
    """The instants of the first samples, s."""
    return np.arange(count, dtype=np.float64) * settings.sample_every * settings.timestep


def _of_all(scenarios: Sequence[Scenario], part: int) -> Array:
    """Position, orientation, velocity or angular velocity of all bodies at the start."""
    states = np.array([body.state() for scenario in scenarios for body in scenario.bodies])
    return np.split(states, (3, 7, 10), axis=-1)[part]


def _bodies(scenarios: Sequence[Scenario], implementation: Implementation) -> Any:
    """What `make_bodies` makes of all bodies.

    Coefficients belong to pairs. So each body of a scenario has a material of its own, which it shares with the bodies
    in its place of the scenarios with the same pairs, and no two materials collide whose bodies are not listed.
    """
    every = [body for scenario in scenarios for body in scenario.bodies]
    group = [number for number, scenario in enumerate(scenarios) for _ in scenario.bodies]
    material, coefficients = _surfaces(scenarios)
    moments = [moments_of_inertia(body, implementation) for body in every]
    return implementation.function("make_bodies")(
        [_shape(body) for body in every], [body.mass for body in every], moments, **coefficients,
        material=material, group=group,
    )  # fmt: skip


def _surfaces(scenarios: Sequence[Scenario]) -> tuple[list[int], dict[str, Array]]:
    """The material of each body, and the coefficients of each two materials."""
    kinds: dict[tuple[tuple[float, ...], ...], int] = {}
    material, tables, count = list[int](), list[tuple[int, tuple[tuple[float, ...], ...]]](), 0
    for scenario in scenarios:
        told = tuple(_told(scenario, pair) for pair in scenario.pairs)
        if told not in kinds:
            kinds[told] = count
            tables.append((count, told))
            count += len(scenario.bodies)
        material += [kinds[told] + place for place in range(len(scenario.bodies))]
    names = "restitution", "friction", "static_friction", "collide"
    found = {name: np.zeros((count, count), dtype=bool if name == "collide" else np.float64) for name in names}
    for first, told in tables:
        for a, b, *numbers in told:
            for name, number in zip(names, (*numbers, True), strict=True):
                found[name][first + int(a), first + int(b)] = found[name][first + int(b), first + int(a)] = number
    return material, found


def _told(scenario: Scenario, pair: Pair) -> tuple[float, ...]:
    """The places of the two bodies, and restitution, kinetic and static friction."""
    places = scenario.index(pair.body_a), scenario.index(pair.body_b)
    return *places, pair.restitution, pair.kinetic_friction, pair.static_friction or 0.0


def _shape(body: Body) -> tuple[Any, ...]:
    """The shape as a plain tuple: its kind, and then what that kind needs."""
    if isinstance(body.shape, Sphere):
        return "sphere", body.shape.radius
    if isinstance(body.shape, Box):
        return "box", body.shape.half_extents
    if isinstance(body.shape, Polyhedron):
        return "compound", [_piece(body.shape.points[list(group)]) for group in body.shape.convex_pieces]
    assert isinstance(body.shape, HalfSpace)
    # A scenario has this normal in the world's axes, and a shape in the body's own.
    return "half-space", geometry.rotate(geometry.opposite(np.array(body.orientation)), np.array(body.shape.normal))


def _piece(points: Array) -> tuple[Any, ...]:
    """A convex piece of a solid, where it is in the solid's own axes."""
    return ("polyhedron", points, surfaces.hull_faces(points)), np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])


def _contacts(met: Sequence[tuple[int, Any]], count: int, first: int, end: int) -> Contacts:
    """The contacts of one scenario's bodies, those from `first` to `end`, in its first samples."""
    found = [Contacts()]
    for sample, (body_a, body_b, point, normal, separation, *_) in met[: count - 1]:
        own = np.flatnonzero((body_a >= first) & (body_a < end))
        if len(own):
            bodies = body_a[own] - first, body_b[own] - first
            found.append(Contacts(np.full(len(own), sample), *bodies, point[own], normal[own], separation[own]))
    columns = ([getattr(each, entry.name) for each in found] for entry in fields(Contacts))
    return Contacts(*(np.concatenate(column) for column in columns))


def _trajectory(
    engine: str, scenario: Scenario, settings: Settings, times: Array, states: Array, contacts: Contacts
) -> Trajectory:
    position, orientation, velocity, spin = np.split(states, (3, 7, 10), axis=-1)
    return Trajectory(scenario, settings, engine, times, position, orientation, velocity, spin, contacts)
