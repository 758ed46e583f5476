"""The world of the lab: one scenario at a time, told to a student's `step_world` in plain arrays.

The student's world knows balls, boxes and planes, and one coefficient of friction for each two bodies.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from reference.arrays import Array
from reference.engines.handwritten.loads import LoadsByHand
from reference.engines.handwritten.rigid_bodies import moments_of_inertia
from reference.engines.handwritten.world_settings import reach, rest_speed
from reference.engines.implementation import Implementation
from reference.errors import NeedsFunction, RunFailed
from reference.scene import geometry
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere
from reference.scene.settings import Settings

SWEEPS, SWEEPS_PER_SECOND, SWEEPS_OF_A_CHANGE = 20, 3_000, 200
"""How often the contacts have a turn in a step: impulses are kept from step to step, so that few will do.

What the sweeps miss of a weight moves a body by that share of g dt². So a longer step has more of them: 60 at 20 ms,
and 20 up to 7 ms. With 20 sweeps at 20 ms a stack of five boxes would drift by 2 mm within ten seconds, and with 60 it
drifts by 0.08 mm.

Where an outer force changes, the impulses of the last step are never right. With 20 sweeps, a slab that a growing push
breaks away does so 9 µs early, forty millionths of the time, and with 200 it does so 0.4 µs early.
"""
BALL, BOX, PLANE = range(3)
OTHER_SHAPES = "needs a world with other shapes: that of the lab has balls, boxes and planes"
WRONG_RESULT = (
    "step_world must return position, orientation, velocity and angular_velocity of {count} bodies, and then the key"
    " and the impulse of each contact"
)
TWO_FRICTIONS = "needs a world with static friction: that of the lab has one coefficient for each pair"


Met = tuple[int, tuple[Array, ...]]
"""The number of a sample, and the contacts there."""


def run(
    scenario: Scenario, steps: int, settings: Settings, implementation: Implementation, stepped: Callable[[], None]
) -> tuple[list[Array], list[Met]]:
    """Step one scenario; return the states of its samples, (bodies, 13) each, and the contacts.

    stepped: called after each step, such as to stop a run that is too slow.
    """
    step_world = implementation.function("step_world")
    bodies = _bodies(scenario, implementation)
    state: Any = tuple(np.split(np.array([body.state() for body in scenario.bodies]), (3, 7, 10), axis=-1))
    rules = rest_speed(scenario, settings), reach(scenario, settings), _sweeps(scenario, settings.timestep)
    loads, memory = LoadsByHand([scenario], implementation), None
    samples, met = [np.concatenate(state, axis=-1)], list[Met]()
    for number in range(1, steps + 1):
        sampled = number % settings.sample_every == 0
        if sampled:
            met += [(len(samples), each) for each in _contacts(bodies, state, rules[1], implementation)]
        pushes = loads.on_bodies((number - 1) * settings.timestep, state)
        result = step_world(bodies, state, np.array(scenario.gravity), settings.timestep, rules, memory, *pushes)
        state, memory = _checked(result, len(scenario.bodies))
        if sampled:
            samples.append(np.concatenate(state, axis=-1))
        stepped()
    return samples, met


def _sweeps(scenario: Scenario, timestep: float) -> int:
    changes = any(force.at(0.0) != force.at(scenario.duration) for force in scenario.forces)
    return max(SWEEPS_OF_A_CHANGE if changes else SWEEPS, round(SWEEPS_PER_SECOND * timestep))


def _contacts(
    bodies: tuple[Array, ...], state: tuple[Array, ...], margin: float, implementation: Implementation
) -> list[tuple[Array, ...]]:
    """What touches where a step begins; nothing as long as no function says so."""
    try:
        found = implementation.function("collect_contacts")(bodies, state, margin)
    except NeedsFunction:
        return []
    return [tuple(np.asarray(each) for each in found)]


def _bodies(scenario: Scenario, implementation: Implementation) -> tuple[Array, ...]:
    """Inverse mass, moments, restitution, friction, meet, kind and size, as the lab's world takes them."""
    bodies, count = scenario.bodies, len(scenario.bodies)
    restitution, friction, meet = (np.zeros((count, count), dtype=kind) for kind in (float, float, bool))
    for pair in scenario.pairs:
        if pair.static_friction != pair.kinetic_friction:
            raise NeedsFunction(TWO_FRICTIONS)
        for a, b in ((pair.body_a, pair.body_b), (pair.body_b, pair.body_a)):
            place = scenario.index(a), scenario.index(b)
            restitution[place], friction[place], meet[place] = pair.restitution, pair.kinetic_friction, True
    shapes = [_shape(body) for body in bodies]
    moments = [np.full(3, np.inf) if body.immovable else moments_of_inertia(body, implementation) for body in bodies]
    return (
        np.array([body.inverse_mass for body in bodies]),
        np.array(moments),
        restitution,
        friction,
        meet,
        np.array([kind for kind, _ in shapes]),
        np.array([size for _, size in shapes], dtype=float),
    )


def _shape(body: Body) -> tuple[int, Any]:
    """The kind of a body, and its size."""
    if isinstance(body.shape, Sphere):
        return BALL, (body.shape.radius, 0.0, 0.0)
    if isinstance(body.shape, Box):
        return BOX, body.shape.half_extents
    if isinstance(body.shape, HalfSpace):
        # A scenario has this normal in the world's axes, and a size is in the body's own.
        return PLANE, geometry.rotate(geometry.opposite(np.array(body.orientation)), np.array(body.shape.normal))
    raise NeedsFunction(OTHER_SHAPES)


def _checked(result: Any, count: int) -> tuple[tuple[Array, ...], Any]:
    """State and memory; an error in words if `step_world` returns something else."""
    try:
        *parts, key, impulse = result
        state = tuple(np.asarray(each, dtype=float) for each in parts)
        impulse = np.reshape(np.asarray(impulse, dtype=float), (-1, 3))  # a list without contacts has no rows
        right = [each.shape for each in state] == [(count, width) for width in (3, 4, 3, 3)]
    except (TypeError, ValueError):
        right = False
    if not right:
        raise RunFailed(WRONG_RESULT.format(count=count))
    return state, (key, impulse)
