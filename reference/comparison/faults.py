"""Faults that are injected on purpose, to see which of them a verdict notices.

An engine is run in another world than the one that the lab believes in: with a restitution that is 0.1 % too large,
say. It builds that world faithfully, so what is read back from it is consistent. Its trajectory is then handed over as
one of the true scenario and settings, so only the numbers can give the fault away.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from reference.comparison import faulty_worlds as worlds
from reference.comparison.faulty_worlds import World
from reference.engines.base import EXACT, Engine, Method
from reference.scene.scenario import Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Contacts, Event, Trajectory


def _same_world(scenario: Scenario, settings: Settings, _: float) -> World:
    return scenario, settings


def _as_it_is(trajectory: Trajectory) -> Trajectory:
    return trajectory


@dataclass(frozen=True)
class Fault:
    """One thing that an implementation may get wrong.

    named: whether a scenario has the quantity at all, under this method. world: the scenario and the settings that the
    engine runs instead, for a size. report: what is made of its trajectory. unit: of the size; a share where it is
    `%`, an angle where it is `°`, and "" for a fault that has no size. first: the size of the first run, from which the
    slope of each number is taken. most: the largest size that is tried. mirrored: whether each number deviates from
    theory to the other side. of_a_pair: whether the quantity is a coefficient, which some cases of a family may lack.
    of_contacts: whether it is in the contacts that are reported, so that it is tried where a number is read from them.
    """

    name: str
    title: str
    named: Callable[[Scenario, Method], bool]
    world: Callable[[Scenario, Settings, float], World] = _same_world
    report: Callable[[Trajectory], Trajectory] = _as_it_is
    unit: str = ""
    first: float = 0.0
    most: float = 0.0
    mirrored: bool = False
    of_a_pair: bool = False
    of_contacts: bool = False


def run_with_fault(
    engine: Engine, fault: Fault, size: float, scenarios: Sequence[Scenario], settings: Settings
) -> list[Trajectory]:
    """What an engine with this fault reports of some scenarios, as trajectories of the true scenarios and settings."""
    others = [fault.world(scenario, settings, size) for scenario in scenarios]
    found = engine.run_many([scenario for scenario, _ in others], others[0][1])
    told = zip(scenarios, found, strict=True)
    return [fault.report(replace(trajectory, scenario=scenario, settings=settings)) for scenario, trajectory in told]


# What is reported


def _quaternions_in_another_order(trajectory: Trajectory) -> Trajectory:
    """Each quaternion is written as x y z w, and read as w x y z."""
    return replace(trajectory, orientations=np.roll(trajectory.orientations, -1, axis=-1))


def _bodies_swapped(trajectory: Trajectory) -> Trajectory:
    """Each contact has its second body for the first, and still the same normal."""
    contacts = trajectory.contacts
    return replace(trajectory, contacts=replace(contacts, body_a=contacts.body_b, body_b=contacts.body_a))


def _gap_for_overlap(trajectory: Trajectory) -> Trajectory:
    """Each contact has an overlap where there is a gap, and the other way round."""
    contacts = trajectory.contacts
    return replace(trajectory, contacts=replace(contacts, separation=-contacts.separation))


def _one_sample_early(trajectory: Trajectory) -> Trajectory:
    """Each state has the time of the sample before it, and so have the instants that were solved for."""
    earlier = float(trajectory.times[1] - trajectory.times[0])
    contacts = trajectory.contacts
    later = contacts.sample > 0
    kept = Contacts(**{entry.name: getattr(contacts, entry.name)[later] for entry in fields(contacts)})
    return replace(
        trajectory,
        times=trajectory.times[:-1],
        positions=trajectory.positions[1:],
        orientations=trajectory.orientations[1:],
        velocities=trajectory.velocities[1:],
        angular_velocities=trajectory.angular_velocities[1:],
        contacts=replace(kept, sample=kept.sample - 1),
        watched=trajectory.watched[1:],
        events=tuple(Event(max(0.0, each.time - earlier), each.kind, each.body) for each in trajectory.events),
    )


_FIRST = 1e-5
"""A share that is far above rounding, and so small that hardly a contact falls into another step than without it."""
_MOST = 0.05
FAULTS = (
    Fault(
        "restitution", "restitution",
        lambda scenario, _: any(pair.restitution > 0 for pair in scenario.pairs),
        worlds.with_pairs(worlds.other_restitution), of_a_pair=True, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "friction", "friction",
        lambda scenario, _: any(pair.kinetic_friction > 0 for pair in scenario.pairs),
        worlds.with_pairs(worlds.other_friction), of_a_pair=True, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "static", "static friction for kinetic",
        lambda scenario, _: any(worlds.has_two_coefficients(pair) for pair in scenario.pairs),
        worlds.with_pairs(worlds.static_for_kinetic), of_a_pair=True,
    ),
    Fault(
        "gravity", "gravity",
        lambda scenario, _: any(scenario.gravity),
        worlds.other_gravity, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault("mass", "mass", worlds.something_moves, worlds.other_mass, unit="%", first=_FIRST, most=_MOST),
    Fault("inertia", "inertia", worlds.something_moves, worlds.other_inertia, unit="%", first=_FIRST, most=_MOST),
    Fault(
        "vertex", "a vertex of a solid",
        lambda scenario, _: worlds.solid(scenario) is not None,
        worlds.moved_vertex, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "timestep", "timestep",
        lambda _, method: method.kind != EXACT,
        worlds.other_timestep, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault("sample", "a sample early", lambda *_: True, report=_one_sample_early),
    Fault("sign", "sign of the deviation", lambda *_: True, mirrored=True),
    Fault(
        "quaternion", "order of a quaternion",
        worlds.something_turns, report=_quaternions_in_another_order,
    ),
    Fault("bodies", "bodies of a contact swapped", lambda *_: True, report=_bodies_swapped, of_contacts=True),
    Fault("overlap", "sign of an overlap", lambda *_: True, report=_gap_for_overlap, of_contacts=True),
    Fault(
        "normal", "direction of a normal",
        lambda scenario, _: worlds.turnable(scenario) is not None,
        worlds.turned_normal, unit="°", first=0.01, most=10.0,
    ),
    Fault(
        "stiffness", "stiffness of the springs",
        lambda scenario, _: any(each.stiffness for each in scenario.springs),
        worlds.with_springs("stiffness"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "damping", "damping of the springs",
        lambda scenario, _: any(each.damping for each in scenario.springs),
        worlds.with_springs("damping"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "drive", "amplitude of an oscillating force",
        lambda scenario, _: worlds.oscillating(scenario),
        worlds.other_amplitude, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "viscosity", "viscosity of the fluid",
        lambda scenario, _: bool(scenario.fluid and scenario.fluid.viscosity),
        worlds.with_fluid("viscosity"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "density", "density of the fluid",
        lambda scenario, _: bool(scenario.fluid and scenario.fluid.density),
        worlds.with_fluid("density"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "attraction", "constant of attraction",
        lambda scenario, _: bool(scenario.attractions),
        worlds.other_attraction, unit="%", first=_FIRST, most=_MOST,
    ),
)  # fmt: skip
