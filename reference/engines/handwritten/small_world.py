"""The world of the lab: one scenario at a time, told to a student's `step_world` in plain arrays.

The student's world knows balls, boxes and planes, and one coefficient of friction for each two bodies.
"""

from __future__ import annotations

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

SWEEPS = 20
"""How often the contacts have a turn in a step, at most: impulses are kept from step to step, so that few will do."""
BALL, BOX, PLANE = range(3)
OTHER_SHAPES = "needs a world with other shapes: that of the lab has balls, boxes and planes"
TWO_FRICTIONS = "needs a world with static friction: that of the lab has one coefficient for each pair"


Met = tuple[int, tuple[Array, ...]]
"""The number of a sample, and the contacts that were found in the step that leads to it."""


def run(
    scenario: Scenario, steps: int, settings: Settings, implementation: Implementation
) -> tuple[list[Array], list[Met]]:
    """Step one scenario; return the states of its samples, (bodies, 13) each, and the contacts."""
    step_world = implementation.function("step_world")
    bodies = _bodies(scenario, implementation)
    state: Any = tuple(np.split(np.array([body.state() for body in scenario.bodies]), (3, 7, 10), axis=-1))
    rules = rest_speed(scenario, settings), reach(scenario, settings), SWEEPS
    loads, memory = LoadsByHand([scenario], implementation), None
    samples, met = [np.concatenate(state, axis=-1)], list[Met]()
    for number in range(1, steps + 1):
        pushes = loads.on_bodies((number - 1) * settings.timestep, state)
        result = step_world(bodies, state, np.array(scenario.gravity), settings.timestep, rules, memory, *pushes)
        state, memory, contacts = _checked(result, len(scenario.bodies))
        if number % settings.sample_every == 0:
            samples.append(np.concatenate(state, axis=-1))
            if contacts is not None and len(contacts[0]):  # a first version of `step_world` may know of none
                met.append((len(samples) - 1, tuple(np.asarray(each) for each in contacts)))
    return samples, met


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


def _checked(result: Any, count: int) -> tuple[tuple[Array, ...], Any, Any]:
    """State, memory and contacts; an error in words if `step_world` returns something else."""
    try:
        state, memory, contacts = result
        position, orientation, velocity, spin = (np.asarray(each, dtype=float) for each in state)
    except (TypeError, ValueError):
        raise RunFailed(
            "step_world must return state, memory and contacts, and a state is position, orientation, velocity and"
            " angular_velocity"
        ) from None
    found = position, orientation, velocity, spin
    for each, width in zip(found, (3, 4, 3, 3), strict=True):
        if each.shape != (count, width):
            raise RunFailed(
                f"step_world returned a state with the shape {each.shape} where it must be {(count, width)}"
            )
    return found, memory, contacts
