"""Faults that are injected on purpose, to see which of them a verdict notices.

An engine is run in another world than the one that the lab believes in: with a restitution that is 0.1 % too large,
say. It builds that world faithfully, so what is read back from it is consistent. Its trajectory is then handed over as
one of the true scenario and settings, so only the numbers can give the fault away.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from reference.engines.base import EXACT, Engine, Method
from reference.scene import geometry
from reference.scene.forces import OscillatingForce
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario
from reference.scene.settings import Settings
from reference.scene.trajectory import Contacts, Event, Trajectory

World = tuple[Scenario, Settings]


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


def run_with_fault(
    engine: Engine, fault: Fault, size: float, scenarios: Sequence[Scenario], settings: Settings
) -> list[Trajectory]:
    """What an engine with this fault reports of some scenarios, as trajectories of the true scenarios and settings."""
    worlds = [fault.world(scenario, settings, size) for scenario in scenarios]
    found = engine.run_many([scenario for scenario, _ in worlds], worlds[0][1])
    told = zip(scenarios, found, strict=True)
    return [fault.report(replace(trajectory, scenario=scenario, settings=settings)) for scenario, trajectory in told]


# The pairs


def _with_pairs(change: Callable[[Pair, float], Pair]) -> Callable[[Scenario, Settings, float], World]:
    def world(scenario: Scenario, settings: Settings, size: float) -> World:
        return replace(scenario, pairs=tuple(change(pair, size) for pair in scenario.pairs)), settings

    return world


def _other_restitution(pair: Pair, size: float) -> Pair:
    return replace(pair, restitution=pair.restitution * (1 + size))


def _other_friction(pair: Pair, size: float) -> Pair:
    static = pair.kinetic_friction if pair.static_friction is None else pair.static_friction
    return replace(pair, kinetic_friction=pair.kinetic_friction * (1 + size), static_friction=static * (1 + size))


def _static_for_kinetic(pair: Pair, _: float) -> Pair:
    return replace(pair, kinetic_friction=pair.static_friction or pair.kinetic_friction)


def _has_two_coefficients(pair: Pair) -> bool:
    return pair.static_friction != pair.kinetic_friction


# The bodies, gravity and time


def _movable(scenario: Scenario) -> list[Body]:
    return [body for body in scenario.bodies if not body.immovable]


def _something_moves(scenario: Scenario, _: Method) -> bool:
    return bool(_movable(scenario))


def _with_bodies(scenario: Scenario, settings: Settings, changed: dict[str, Body]) -> World:
    return replace(scenario, bodies=tuple(changed.get(body.name, body) for body in scenario.bodies)), settings


def _other_mass(scenario: Scenario, settings: Settings, size: float) -> World:
    """The first movable body has another mass, and still its own inertia."""
    body = _movable(scenario)[0]
    other = replace(body, mass=body.mass * (1 + size), inertia=body.moments_of_inertia())
    return _with_bodies(scenario, settings, {body.name: other})


def _other_inertia(scenario: Scenario, settings: Settings, size: float) -> World:
    """All movable bodies have other moments of inertia, and still their own mass."""
    changed = {}
    for body in _movable(scenario):
        x, y, z = ((1 + size) * moment for moment in body.moments_of_inertia())
        changed[body.name] = replace(body, inertia=(x, y, z))
    return _with_bodies(scenario, settings, changed)


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
    return _with_bodies(scenario, settings, {body.name: other})


def _other_gravity(scenario: Scenario, settings: Settings, size: float) -> World:
    x, y, z = ((1 + size) * each for each in scenario.gravity)
    return replace(scenario, gravity=(x, y, z)), settings


def _other_timestep(scenario: Scenario, settings: Settings, size: float) -> World:
    """Steps of another length, as many as the simulated time then takes; each sample has its true time."""
    return scenario, replace(settings, timestep=settings.timestep * (1 + size))


# Forces besides weight


def _with_springs(name: str) -> Callable[[Scenario, Settings, float], World]:
    def world(scenario: Scenario, settings: Settings, size: float) -> World:
        springs = tuple(replace(each, **{name: getattr(each, name) * (1 + size)}) for each in scenario.springs)
        return replace(scenario, springs=springs), settings

    return world


def _with_fluid(name: str) -> Callable[[Scenario, Settings, float], World]:
    def world(scenario: Scenario, settings: Settings, size: float) -> World:
        fluid = scenario.fluid
        assert fluid
        return replace(scenario, fluid=replace(fluid, **{name: getattr(fluid, name) * (1 + size)})), settings

    return world


def _other_attraction(scenario: Scenario, settings: Settings, size: float) -> World:
    pulls = tuple(replace(each, constant=each.constant * (1 + size)) for each in scenario.attractions)
    return replace(scenario, attractions=pulls), settings


def _oscillating(scenario: Scenario) -> bool:
    return any(isinstance(each, OscillatingForce) for each in scenario.forces)


def _other_amplitude(scenario: Scenario, settings: Settings, size: float) -> World:
    pushes = []
    for each in scenario.forces:
        if isinstance(each, OscillatingForce):
            x, y, z = ((1 + size) * part for part in each.amplitude)
            each = replace(each, amplitude=(x, y, z))
        pushes.append(each)
    return replace(scenario, forces=tuple(pushes)), settings


# Directions


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
        other = replace(body, shape=HalfSpace((x, y, z)))
    else:
        w, x, y, z = (float(each) for each in geometry.turned(np.array(body.orientation), turn))
        other = replace(body, orientation=(w, x, y, z))
    return _with_bodies(scenario, settings, {body.name: other})


# What is reported


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
        _with_pairs(_other_restitution), of_a_pair=True, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "friction", "friction",
        lambda scenario, _: any(pair.kinetic_friction > 0 for pair in scenario.pairs),
        _with_pairs(_other_friction), of_a_pair=True, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "static", "static friction for kinetic",
        lambda scenario, _: any(_has_two_coefficients(pair) for pair in scenario.pairs),
        _with_pairs(_static_for_kinetic), of_a_pair=True,
    ),
    Fault(
        "gravity", "gravity",
        lambda scenario, _: any(scenario.gravity),
        _other_gravity, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault("mass", "mass", _something_moves, _other_mass, unit="%", first=_FIRST, most=_MOST),
    Fault("inertia", "inertia", _something_moves, _other_inertia, unit="%", first=_FIRST, most=_MOST),
    Fault(
        "vertex", "a vertex of a solid",
        lambda scenario, _: _solid(scenario) is not None,
        _moved_vertex, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "timestep", "timestep",
        lambda _, method: method.kind != EXACT,
        _other_timestep, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault("sample", "a sample early", lambda *_: True, report=_one_sample_early),
    Fault("sign", "sign of the deviation", lambda *_: True, mirrored=True),
    Fault(
        "normal", "direction of a normal",
        lambda scenario, _: _turnable(scenario) is not None,
        _turned_normal, unit="°", first=0.01, most=10.0,
    ),
    Fault(
        "stiffness", "stiffness of the springs",
        lambda scenario, _: any(each.stiffness for each in scenario.springs),
        _with_springs("stiffness"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "damping", "damping of the springs",
        lambda scenario, _: any(each.damping for each in scenario.springs),
        _with_springs("damping"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "drive", "amplitude of an oscillating force",
        lambda scenario, _: _oscillating(scenario),
        _other_amplitude, unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "viscosity", "viscosity of the fluid",
        lambda scenario, _: bool(scenario.fluid and scenario.fluid.viscosity),
        _with_fluid("viscosity"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "density", "density of the fluid",
        lambda scenario, _: bool(scenario.fluid and scenario.fluid.density),
        _with_fluid("density"), unit="%", first=_FIRST, most=_MOST,
    ),
    Fault(
        "attraction", "constant of attraction",
        lambda scenario, _: bool(scenario.attractions),
        _other_attraction, unit="%", first=_FIRST, most=_MOST,
    ),
)  # fmt: skip
