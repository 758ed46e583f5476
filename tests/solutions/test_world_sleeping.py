"""Sleeping: what lies still is left out, and wakes when it is struck."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.memory import NOTHING
from solutions.world.rules import Rules
from solutions.world.run import run_world
from solutions.world.step import step_world

G = (0.0, 0.0, -9.81)
SLEEPY = Rules(sleep_speed=0.02, sleep_after=0.1)


def boxes(heights, velocity):
    """Cubes of .2 m over the ground, one above another, and body 0 that is the ground."""
    half, count = 0.1, len(heights)
    bodies = make_bodies(
        [("half-space", (0, 0, 1))] + [("box", (half, half, half))] * count,
        [np.inf] + [1.0] * count,
        [[np.inf] * 3] + [[2 / 3 * half**2] * 3] * count,
        friction=0.5,
    )
    place = [[0, 0, 0], *([0.013 * number, -0.02 * number, height] for number, height in enumerate(heights))]
    return bodies, make_state(place, velocity=[[0, 0, 0], *velocity])


def test_a_stack_falls_asleep_and_a_blow_wakes_all_of_it():
    bodies, state = boxes([0.1, 0.3, 1.0], [[0, 0, 0], [0, 0, 0], [0, 0, 0]])
    memory, slept, woken = NOTHING, False, {}
    for count in range(110):
        state, memory, contacts = step_world(bodies, state, G, 4e-3, SLEEPY, memory)
        asleep = memory.still >= SLEEPY.sleep_after
        if slept and not woken and asleep[2]:
            assert not len(contacts.key)  # two sleepers make no contact
            assert not state.velocity[1:3].any()
        slept = slept or bool(asleep[1] and asleep[2])
        for body in (1, 2):
            if slept and not asleep[body]:
                woken.setdefault(body, count)
    assert slept
    assert woken[1] == woken[2]  # a blow goes through all that lie against one another
    # The box falls 0.5 m: √(2 h/g) takes 80 steps; Euler's lead, the margin and counting from 0, one or two
    assert woken[2] == pytest.approx(80, abs=2)


def test_nothing_sleeps_unless_it_is_asked_to():
    bodies, state = boxes([0.1], [[1e-4, 0, 0]])
    frictionless = bodies._replace(
        surfaces=bodies.surfaces._replace(static_friction=np.zeros((1, 1)), kinetic_friction=np.zeros((1, 1)))
    )
    memory = NOTHING
    for _ in range(120):
        state, memory, _ = step_world(frictionless, state, G, 1e-3, Rules(), memory)
    assert state.velocity[1, 0] == pytest.approx(1e-4, rel=1e-9)  # creeps on


def test_sleepers_that_are_struck_lose_no_momentum():
    count = 4
    bodies = make_bodies([("sphere", 0.1)] * count, 1.0, [[0.004] * 3] * count, restitution=0.4)
    place = [[0.2 * number, 0, 0] for number in range(3)] + [[-0.5, 0.03, 0.02]]
    state = make_state(place, velocity=[[0, 0, 0]] * 3 + [[1.5, 0, 0]])
    memory, slept = NOTHING, 0
    for _ in range(400):
        state, memory, _ = step_world(bodies, state, (0, 0, 0), 1e-3, SLEEPY, memory)
        slept = max(slept, int(np.sum(memory.still >= SLEEPY.sleep_after)))
    assert slept == 3
    assert state.velocity[2, 0] > 0.1  # the blow has reached the last one
    # 1e-12: to rounding; no ball was so slow after the blow that it fell asleep
    np.testing.assert_allclose(state.velocity.sum(axis=0), [1.5, 0, 0], atol=1e-12)


def test_a_driven_body_never_sleeps_and_wakes_what_it_meets():
    # A slider that is driven at 1 m/s meets a sleeping box of 1 kg after 0.5 s.
    shapes = [("box", (0.2, 0.3, 0.1)), ("box", (0.1, 0.2, 0.1)), ("half-space", (0.0, 0.0, 1.0))]
    moments = [[np.inf] * 3, [0.05 / 3, 0.02 / 3, 0.05 / 3], [np.inf] * 3]
    bodies = make_bodies(shapes, [np.inf, 1.0, np.inf], moments, friction=0.4)
    velocity = [(1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]
    state = make_state([(0.0, 0.0, 0.101), (0.8, 0.05, 0.1), (0.0, 0.0, 0.0)], velocity=velocity)
    states = run_world(bodies, state, G, 1 / 60, 45, SLEEPY)
    assert not states.velocity[25, 1].any()  # it sleeps: not even rounding moves it
    assert states.position[-1, 0] == pytest.approx((0.75, 0, 0.101), abs=1e-12)  # driven for 0.75 s
    assert states.position[-1, 1, 0] >= 0.75 + 0.3 - 1e-3  # m; pushed ahead, but for some slop
