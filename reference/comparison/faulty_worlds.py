"""Worlds that differ in one quantity from the one that the lab believes in, for `reference.comparison.faults`.

Each function takes a scenario, its settings and a size, and returns the scenario and the settings that an engine runs
instead. A size is a share of the quantity, or an angle in degrees.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from reference.engines.base import Method
from reference.scene import geometry
from reference.scene.forces import OscillatingForce
from reference.scene.polyhedron import Polyhedron
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings

World = tuple[Scenario, Settings]


# The pairs


def with_pairs(change: Callable[[Pair, float], Pair]) -> Callable[[Scenario, Settings, float], World]:
    """Change every pair of the scenario."""

    def world(scenario: Scenario, settings: Settings, size: float) -> World:
        return replace(scenario, pairs=tuple(change(pair, size) for pair in scenario.pairs)), settings

    return world


def other_restitution(pair: Pair, size: float) -> Pair:
    """The pair has another restitution."""
    return replace(pair, restitution=pair.restitution * (1 + size))


def other_friction(pair: Pair, size: float) -> Pair:
    """Both coefficients of friction of the pair are changed by the same share."""
    static = pair.kinetic_friction if pair.static_friction is None else pair.static_friction
    return replace(pair, kinetic_friction=pair.kinetic_friction * (1 + size), static_friction=static * (1 + size))


def static_for_kinetic(pair: Pair, _: float) -> Pair:
    """The pair has its static coefficient in place of the kinetic one."""
    return replace(pair, kinetic_friction=pair.static_friction or pair.kinetic_friction)


def has_two_coefficients(pair: Pair) -> bool:
    """Whether static and kinetic friction of the pair differ."""
    return pair.static_friction != pair.kinetic_friction


# The bodies, gravity and time


def _movable(scenario: Scenario) -> list[Body]:
    return [body for body in scenario.bodies if not body.immovable]


def something_moves(scenario: Scenario, _: Method) -> bool:
    """Whether any body can move."""
    return bool(_movable(scenario))


def something_turns(scenario: Scenario, _: Method) -> bool:
    """Whether it can be seen how a movable body is turned."""
    return any(not isinstance(body.shape, Sphere) for body in _movable(scenario))


def _with_bodies(scenario: Scenario, settings: Settings, changed: dict[str, Body]) -> World:
    return replace(scenario, bodies=tuple(changed.get(body.name, body) for body in scenario.bodies)), settings


def other_mass(scenario: Scenario, settings: Settings, size: float) -> World:
    """The first movable body has another mass, and still its own inertia."""
    body = _movable(scenario)[0]
    other = replace(body, mass=body.mass * (1 + size), inertia=body.moments_of_inertia())
    return _with_bodies(scenario, settings, {body.name: other})


def other_inertia(scenario: Scenario, settings: Settings, size: float) -> World:
    """All movable bodies have other moments of inertia, and still their own mass."""
    changed = {}
    for body in _movable(scenario):
        x, y, z = ((1 + size) * moment for moment in body.moments_of_inertia())
        changed[body.name] = replace(body, inertia=(x, y, z))
    return _with_bodies(scenario, settings, changed)


def solid(scenario: Scenario) -> Body | None:
    """The first polyhedron."""
    return next((body for body in scenario.bodies if isinstance(body.shape, Polyhedron)), None)


def moved_vertex(scenario: Scenario, settings: Settings, size: float) -> World:
    """The first vertex of a solid is farther from the middle of all by a share of its distance."""
    body = solid(scenario)
    assert body is not None
    assert isinstance(body.shape, Polyhedron)
    points = body.shape.points
    points[0] += size * (points[0] - points.mean(axis=0))
    other = replace(body, shape=replace(body.shape, vertices=tuple(map(tuple, points.tolist()))))
    return _with_bodies(scenario, settings, {body.name: other})


def other_gravity(scenario: Scenario, settings: Settings, size: float) -> World:
    """Gravity is stronger, in the same direction."""
    x, y, z = ((1 + size) * each for each in scenario.gravity)
    return replace(scenario, gravity=(x, y, z)), settings


def other_timestep(scenario: Scenario, settings: Settings, size: float) -> World:
    """Steps of another length, as many as the simulated time then takes; each sample has its true time."""
    return scenario, replace(settings, timestep=settings.timestep * (1 + size))


# Forces besides weight


def with_springs(name: str) -> Callable[[Scenario, Settings, float], World]:
    """Change this quantity of every spring."""

    def world(scenario: Scenario, settings: Settings, size: float) -> World:
        springs = tuple(replace(each, **{name: getattr(each, name) * (1 + size)}) for each in scenario.springs)
        return replace(scenario, springs=springs), settings

    return world


def with_fluid(name: str) -> Callable[[Scenario, Settings, float], World]:
    """Change this quantity of the fluid."""

    def world(scenario: Scenario, settings: Settings, size: float) -> World:
        fluid = scenario.fluid
        assert fluid
        return replace(scenario, fluid=replace(fluid, **{name: getattr(fluid, name) * (1 + size)})), settings

    return world


def other_attraction(scenario: Scenario, settings: Settings, size: float) -> World:
    """Every attraction has another constant."""
    pulls = tuple(replace(each, constant=each.constant * (1 + size)) for each in scenario.attractions)
    return replace(scenario, attractions=pulls), settings


def oscillating(scenario: Scenario) -> bool:
    """Whether an oscillating force acts."""
    return any(isinstance(each, OscillatingForce) for each in scenario.forces)


def other_amplitude(scenario: Scenario, settings: Settings, size: float) -> World:
    """Every oscillating force has another amplitude."""
    pushes = []
    for each in scenario.forces:
        if isinstance(each, OscillatingForce):
            x, y, z = ((1 + size) * part for part in each.amplitude)
            each = replace(each, amplitude=(x, y, z))
        pushes.append(each)
    return replace(scenario, forces=tuple(pushes)), settings


# Directions


def turnable(scenario: Scenario) -> Body | None:
    """The first half-space; without any, a box in a pair, one that cannot move before one that can; or a solid."""
    met = {name for pair in scenario.pairs for name in (pair.body_a, pair.body_b)}
    planes = [body for body in scenario.bodies if isinstance(body.shape, HalfSpace)]
    boxes = [body for body in scenario.bodies if isinstance(body.shape, Box) and body.name in met]
    return next(iter([*planes, *sorted(boxes, key=lambda body: not body.immovable)]), solid(scenario))


def turned_normal(scenario: Scenario, settings: Settings, degrees: float) -> World:
    """What is struck is turned about the y axis, across which most motions here lie; or about z, if it faces y."""
    body = turnable(scenario)
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
