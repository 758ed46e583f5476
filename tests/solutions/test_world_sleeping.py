"""Sleeping: what lies still is left out, and wakes when it is struck."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.memory import NOTHING
from solutions.world.rules import Rules
from solutions.world.step import advance_world

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
        state, memory, contacts = advance_world(bodies, state, G, 4e-3, SLEEPY, memory)
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
        state, memory, _ = advance_world(frictionless, state, G, 1e-3, Rules(), memory)
    assert state.velocity[1, 0] == pytest.approx(1e-4, rel=1e-9)  # creeps on


def test_sleepers_that_are_struck_lose_no_momentum():
    count = 4
    bodies = make_bodies([("sphere", 0.1)] * count, 1.0, [[0.004] * 3] * count, restitution=0.4)
    place = [[0.2 * number, 0, 0] for number in range(3)] + [[-0.5, 0.03, 0.02]]
    state = make_state(place, velocity=[[0, 0, 0]] * 3 + [[1.5, 0, 0]])
    memory, slept = NOTHING, 0
    for _ in range(400):
        state, memory, _ = advance_world(bodies, state, (0, 0, 0), 1e-3, SLEEPY, memory)
        slept = max(slept, int(np.sum(memory.still >= SLEEPY.sleep_after)))
    assert slept == 3
    assert state.velocity[2, 0] > 0.1  # the blow has reached the last one
    # 1e-12: to rounding; no ball was so slow after the blow that it fell asleep
    np.testing.assert_allclose(state.velocity.sum(axis=0), [1.5, 0, 0], atol=1e-12)


@pytest.mark.parametrize("speed", [0.5, 0.01])
def test_a_driven_wall_does_not_fall_asleep_and_moves_sleepers(speed):
    # A wall that moves faster, or slower, than what may fall asleep, and a ball that lies in its way
    shapes, moments = [("sphere", 0.1), ("box", (0.1, 0.3, 0.3))], [[0.004] * 3, [np.inf] * 3]
    bodies = make_bodies(shapes, [1.0, np.inf], moments)
    place = [(0, 0, 0), (-0.2 - 0.01 * speed * 20.5, 0.1, 0)]
    state = make_state(place, velocity=[(0, 0, 0), (speed, 0, 0)])
    memory, asleep = NOTHING, []
    for _ in range(60):
        state, memory, _ = advance_world(bodies, state, (0, 0, 0), 0.01, SLEEPY, memory)
        asleep.append(bool(memory.still[0] >= SLEEPY.sleep_after))
    assert any(asleep[:20])
    assert not any(asleep[22:])
    # 20.5 steps to the ball, and then with it; what it goes in meanwhile is taken back, except for the slop of 0.1 mm
    way = 0.01 * speed * (60 - 20.5)
    assert state.position[0, 0] == pytest.approx(way, abs=1.1e-4)
    assert state.position[1, 0] == pytest.approx(way - 0.2, abs=1e-14)
    np.testing.assert_allclose(state.velocity[:, 0], speed, rtol=1e-9)


def test_an_awake_ball_rolls_while_another_body_sleeps():
    bodies, state = boxes([0.1], [[0, 0, 0]])
    both = make_bodies(
        [("half-space", (0, 0, 1)), ("box", (0.1, 0.1, 0.1)), ("sphere", 0.1)],
        [np.inf, 1.0, 2.0],
        [*bodies.moments, [0.008] * 3],
        friction=0.1,
    )
    start = make_state([*state.position, (3, 2, 0.1)], velocity=[(0, 0, 0), (0, 0, 0), (0.7, -0.2, 0)])
    state, memory = start, NOTHING
    for _ in range(30):
        state, memory, _ = advance_world(both, state, G, 0.01, SLEEPY, memory)
    assert memory.still[1] >= SLEEPY.sleep_after
    # The box sleeps from 0.1 s on. Until 0.21 s the ball slides and keeps 5/7 of its speed, and then it rolls.
    # The sweeps end at changes of 1e-6.
    np.testing.assert_allclose(state.velocity[2], 5 / 7 * start.velocity[2], atol=1e-5)
    np.testing.assert_allclose(state.angular_velocity[2], np.array([0.2, 0.7, 0]) * 5 / 7 / 0.1, atol=1e-4)


def test_a_blow_wakes_no_sleeper_that_it_does_not_reach():
    bodies = make_bodies([("sphere", 0.1)] * 3, 1.0, [[0.004] * 3] * 3)
    state, memory = (
        make_state([(0, 0, 0), (0, 3, 0), (-0.5, 0, 0)], velocity=[(0, 0, 0), (0, 0, 0), (1.5, 0, 0)]),
        NOTHING,
    )
    for _ in range(40):  # it strikes after 20 steps
        state, memory, _ = advance_world(bodies, state, (0, 0, 0), 0.01, SLEEPY, memory)
    assert state.velocity[0, 0] == pytest.approx(0.75)
    np.testing.assert_allclose(memory.still[:2], [0, 0.4], atol=1e-12)
