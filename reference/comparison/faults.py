"""Faults that are injected on purpose, to see which of them a verdict notices.

An engine is run in another world than the one that the lab believes in: with a restitution that is 0.1 % too large,
say. It builds that world faithfully, so what is read back from it is consistent. Its trajectory is then handed over as
one of the true scenario and settings, so only the numbers can give the fault away.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from reference.engines.base import EXACT, Engine, Method
from reference.scene import geometry
from reference.scene.forces import OscillatingForce
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Contacts, Event, Trajectory

World = tuple[Scenario, Settings]
"""The scenario and the settings that an engine runs instead of the true ones."""
Change = Callable[[Scenario, Settings, float], World]
"""Makes that world for a size: a share of a quantity, or an angle in degrees."""


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
    world: Change = _same_world
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


# Another world


def _scaled(entry: Any, size: float, *names: str) -> Any:
    """The same pair, spring or force, with these numbers or vectors of it larger by a share."""
    found = {name: getattr(entry, name) for name in names}
    return replace(entry, **{name: _larger(value, size) for name, value in found.items()})


def _larger(value: Any, size: float) -> Any:
    return tuple((1 + size) * each for each in value) if isinstance(value, tuple) else value * (1 + size)


def _of_each(kind: str, *names: str) -> Change:
    """Change these quantities of all pairs, springs or other entries of the scenario by the same share."""

    def world(scenario: Scenario, settings: Settings, size: float) -> World:
        changed: dict[str, Any] = {kind: tuple(_scaled(each, size, *names) for each in getattr(scenario, kind))}
        return replace(scenario, **changed), settings

    return world


def _of_fluid(name: str) -> Change:
    return lambda scenario, settings, size: (replace(scenario, fluid=_scaled(scenario.fluid, size, name)), settings)


def _static_for_kinetic(scenario: Scenario, settings: Settings, _: float) -> World:
    """Each pair has its static coefficient in place of the kinetic one."""
    pairs = tuple(
        replace(pair, kinetic_friction=pair.static_friction or pair.kinetic_friction) for pair in scenario.pairs
    )
    return replace(scenario, pairs=pairs), settings


def _other_gravity(scenario: Scenario, settings: Settings, size: float) -> World:
    return _scaled(scenario, size, "gravity"), settings


def _other_timestep(scenario: Scenario, settings: Settings, size: float) -> World:
    """Steps of another length, as many as the simulated time then takes; each sample has its true time."""
    return scenario, _scaled(settings, size, "timestep")


def _other_amplitude(scenario: Scenario, settings: Settings, size: float) -> World:
    forces = (_scaled(each, size, "amplitude") if _oscillates(each) else each for each in scenario.forces)
    return replace(scenario, forces=tuple(forces)), settings


def _oscillates(force: object) -> bool:
    return isinstance(force, OscillatingForce)


# Other bodies


def _movable(scenario: Scenario) -> list[Body]:
    return [body for body in scenario.bodies if not body.immovable]


def _something_moves(scenario: Scenario, _: Method) -> bool:
    return bool(_movable(scenario))


def _something_turns(scenario: Scenario, _: Method) -> bool:
    """Whether it can be seen how a movable body is turned."""
    return any(not isinstance(body.shape, Sphere) for body in _movable(scenario))


def _with_bodies(scenario: Scenario, settings: Settings, *changed: Body) -> World:
    new = {body.name: body for body in changed}
    return replace(scenario, bodies=tuple(new.get(body.name, body) for body in scenario.bodies)), settings


def _other_mass(scenario: Scenario, settings: Settings, size: float) -> World:
    """The first movable body has another mass, and still its own inertia."""
    body = _movable(scenario)[0]
    other = replace(body, mass=body.mass * (1 + size), inertia=body.moments_of_inertia())
    return _with_bodies(scenario, settings, other)


def _other_inertia(scenario: Scenario, settings: Settings, size: float) -> World:
    """All movable bodies have other moments of inertia, and still their own mass."""
    changed = (replace(body, inertia=_larger(body.moments_of_inertia(), size)) for body in _movable(scenario))
    return _with_bodies(scenario, settings, *changed)


def _solid(scenario: Scenario) -> Body | None:
    """The first polyhedron."""
    return next((body for body in scenario.bodies if isinstance(body.shape, Polyhedron)), None)


def _moved_vertex(scenario: Scenario, settings: Settings, size: float) -> World:
    """The first vertex of a solid is farther from the middle of all by a share of its distance."""
    body = _solid(scenario)
    assert body is not None
    assert isinstance(body.shape, Polyhedron)
    points = body.shape.points
    points[0] += size * (points[0] - points.mean(axis=0))
    other = replace(body, shape=replace(body.shape, vertices=tuple(map(tuple, points.tolist()))))
    return _with_bodies(scenario, settings, other)


def _turnable(scenario: Scenario) -> Body | None:
    """The first half-space; without any, a box in a pair, one that cannot move before one that can; or a solid."""
    met = {name for pair in scenario.pairs for name in (pair.body_a, pair.body_b)}
    planes = [body for body in scenario.bodies if isinstance(body.shape, HalfSpace)]
    boxes = [body for body in scenario.bodies if isinstance(body.shape, Box) and body.name in met]
    return next(iter([*planes, *sorted(boxes, key=lambda body: not body.immovable)]), _solid(scenario))


def _turned_normal(scenario: Scenario, settings: Settings, degrees: float) -> World:
    """What is struck is turned about the y axis, across which most motions here lie; or about z, if it faces y."""
    body = _turnable(scenario)
    assert body is not None
    about_y = not (isinstance(body.shape, HalfSpace) and abs(body.shape.normal[1]) > 0.5)
    turn = np.radians(degrees) * (np.array([0.0, 1.0, 0.0]) if about_y else np.array([0.0, 0.0, 1.0]))
    if isinstance(body.shape, HalfSpace):
        quaternion = geometry.turned(np.array([1.0, 0.0, 0.0, 0.0]), turn)
        x, y, z = (float(each) for each in geometry.rotate(quaternion, np.array(body.shape.normal)))
        return _with_bodies(scenario, settings, replace(body, shape=HalfSpace((x, y, z))))
    w, x, y, z = (float(each) for each in geometry.turned(np.array(body.orientation), turn))
    return _with_bodies(scenario, settings, replace(body, orientation=(w, x, y, z)))


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


# All faults


def _by_a_share(
    name: str, title: str, named: Callable[[Scenario, Method], bool], world: Change, of_a_pair: bool = False
) -> Fault:
    """A fault that makes a quantity larger by a share.

    The first run has a share far above rounding, and so small that hardly a contact falls into another step.
    """
    return Fault(name, title, named, world, unit="%", first=1e-5, most=0.05, of_a_pair=of_a_pair)


FAULTS = (
    _by_a_share(
        "restitution",
        "restitution",
        lambda scenario, _: any(pair.restitution > 0 for pair in scenario.pairs),
        _of_each("pairs", "restitution"),
        of_a_pair=True,
    ),
    _by_a_share(
        "friction",
        "friction",
        lambda scenario, _: any(pair.kinetic_friction > 0 for pair in scenario.pairs),
        _of_each("pairs", "kinetic_friction", "static_friction"),
        of_a_pair=True,
    ),
    Fault(
        "static",
        "static friction for kinetic",
        lambda scenario, _: any(pair.static_friction != pair.kinetic_friction for pair in scenario.pairs),
        _static_for_kinetic,
        of_a_pair=True,
    ),
    _by_a_share("gravity", "gravity", lambda scenario, _: any(scenario.gravity), _other_gravity),
    _by_a_share("mass", "mass", _something_moves, _other_mass),
    _by_a_share("inertia", "inertia", _something_moves, _other_inertia),
    _by_a_share("vertex", "a vertex of a solid", lambda scenario, _: _solid(scenario) is not None, _moved_vertex),
    _by_a_share("timestep", "timestep", lambda _, method: method.kind != EXACT, _other_timestep),
    Fault("sample", "a sample early", lambda *_: True, report=_one_sample_early),
    Fault("sign", "sign of the deviation", lambda *_: True, mirrored=True),
    Fault("quaternion", "order of a quaternion", _something_turns, report=_quaternions_in_another_order),
    Fault("bodies", "bodies of a contact swapped", lambda *_: True, report=_bodies_swapped, of_contacts=True),
    Fault("overlap", "sign of an overlap", lambda *_: True, report=_gap_for_overlap, of_contacts=True),
    Fault(
        "normal",
        "direction of a normal",
        lambda scenario, _: _turnable(scenario) is not None,
        _turned_normal,
        unit="°",
        first=0.01,
        most=10.0,
    ),
    _by_a_share(
        "stiffness",
        "stiffness of the springs",
        lambda scenario, _: any(each.stiffness for each in scenario.springs),
        _of_each("springs", "stiffness"),
    ),
    _by_a_share(
        "damping",
        "damping of the springs",
        lambda scenario, _: any(each.damping for each in scenario.springs),
        _of_each("springs", "damping"),
    ),
    _by_a_share(
        "drive",
        "amplitude of an oscillating force",
        lambda scenario, _: any(map(_oscillates, scenario.forces)),
        _other_amplitude,
    ),
    _by_a_share(
        "viscosity",
        "viscosity of the fluid",
        lambda scenario, _: bool(scenario.fluid and scenario.fluid.viscosity),
        _of_fluid("viscosity"),
    ),
    _by_a_share(
        "density",
        "density of the fluid",
        lambda scenario, _: bool(scenario.fluid and scenario.fluid.density),
        _of_fluid("density"),
    ),
    _by_a_share(
        "attraction",
        "constant of attraction",
        lambda scenario, _: bool(scenario.attractions),
        _of_each("attractions", "constant"),
    ),
)
