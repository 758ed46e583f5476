"""Impacts in time order that lie within a step: backed up to the contact, none overlooked."""

from __future__ import annotations

import numpy as np
import pytest
from balls_and_rods import FLOOR, G, drops, energy, run, spheres

from solutions.world.bodies import make_bodies, make_state
from solutions.world.contacts import find_contacts
from solutions.world.rules import Rules
from solutions.world.step import advance_world
from solutions.world.time_order import step_in_time_order


def test_elastic_tumbling_cube_keeps_its_energy_over_many_impacts():
    rng = np.random.default_rng(5)
    bodies = make_bodies([("box", (0.1, 0.1, 0.1)), FLOOR], [1.0, np.inf], [[0.04 / 6] * 3, [np.inf] * 3], 1.0)
    orientation = rng.normal(size=4)
    state = make_state(
        [(0, 0, 0.4), (0, 0, 0)],
        [orientation / np.linalg.norm(orientation), (1, 0, 0, 0)],
        angular_velocity=[(3.0, -4.0, 5.0), (0, 0, 0)],
    )
    rules, gravity = Rules(response="in time order", rest_speed=1e-6), np.array([(0, 0, -G), (0, 0, 0)])
    start, total, deepest = energy(bodies, state, G), 0, 0.0
    for _ in range(30):
        state, impacts = step_in_time_order(bodies, state, gravity, 0 * gravity, 0.05, rules)
        total += impacts
        deepest = min(deepest, np.min(find_contacts(bodies, state).separation, initial=0.0))
    assert total >= 5
    assert deepest > -1e-9
    assert energy(bodies, state, G) == pytest.approx(start, rel=1e-8)


def test_spike_that_turns_over_the_top_is_met_when_it_comes_down():
    # In one step it turns by 6 rad and would be clear of the floor before and after
    corners = np.array([(-0.5, 0, 0), (0.02, 0.02, 0), (0.02, -0.02, 0.02), (0.02, -0.02, -0.02)])
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    loaded = ("compound", [(("polyhedron", corners, faces), (0, 0, 0), (1, 0, 0, 0))])
    bodies = make_bodies([loaded, FLOOR], [1.0, np.inf], [[0.1] * 3, [np.inf] * 3], 1.0)
    state = make_state([(0, 0, 0.3), (0, 0, 0)], angular_velocity=[(0, 10.0, 0), (0, 0, 0)])
    after, _, _ = advance_world(bodies, state, (0, 0, 0), 0.6, Rules(response="in time order"))
    time = (np.pi + np.arcsin(0.6)) / 10  # 0.3 m down on the other side, at x = 0.4 m
    j = 2 * 10 * 0.4 / (1 + 0.4**2 / 0.1)
    assert after.velocity[0, 2] == pytest.approx(j, abs=1e-7)  # a touch of 1e-10 m moves the point by as much
    assert after.angular_velocity[0, 1] == pytest.approx(10 - 0.4 * j / 0.1, abs=1e-6)
    assert after.position[0, 2] == pytest.approx(0.3 + j * (0.6 - time), abs=1e-8)


def test_arm_that_swings_into_a_ball_is_backed_up_to_the_contact():
    # The end of the arm curves towards the ball and meets it earlier than its velocity before says
    ends = [(("sphere", 0.05), (along, 0, 0), (1.0, 0, 0, 0)) for along in (1.0, -1.0)]
    place = np.array([np.cos(1.5), np.sin(1.5), 0])
    bodies = make_bodies([("compound", ends), ("sphere", 1.15)], [2.0, np.inf], [[2.0] * 3, [np.inf] * 3], 0.5)
    state = make_state([(0, 0, 0), place], angular_velocity=[(0, 0, 10.0), (0, 0, 0)])
    after, _, _ = advance_world(bodies, state, (0, 0, 0), 0.05, Rules(response="in time order"))
    angle = 1.5 - np.arccos(1 - 1.2**2 / 2)  # 0.213; the velocity at the start says 0.223
    end = np.array([np.cos(angle), np.sin(angle), 0])
    normal = (end - place) / 1.2
    lever = np.cross(end - 0.05 * normal, normal)[2]
    j = -1.5 * 10 * lever / (1 / 2 + lever**2 / 2)
    # a touch of 1e-10 m, and a speed of 7 m/s
    assert after.position[0] == pytest.approx(j / 2 * normal * (0.05 - angle / 10), abs=1e-9)
    assert after.angular_velocity[0, 2] == pytest.approx(10 + lever * j / 2, abs=1e-8)


def test_fast_ball_does_not_pass_through_a_small_one_in_a_step():
    # 100 m/s in a step of 0.1 s; the small ball is struck off its centre, and the two part at a right angle
    bodies, state = spheres([(0, 0, 0), (6.0, 0.03, 0)], [(100.0, 0, 0), (0, 0, 0)], radius=0.05)
    for response, meets in (("in time order", True), ("sequential", False)):
        after, _, _ = advance_world(bodies, state, (0, 0, 0), 0.1, Rules(response=response))
        assert (after.velocity[1, 0] > 1) == meets
        assert after.velocity[0] @ after.velocity[1] == pytest.approx(0.0, abs=1e-6)
        if meets:  # along the line of centres, sin of whose angle is 0.3; the gap that counts as touch is 1e-10 m
            assert after.velocity[1, 0] == pytest.approx(100 * (1 - 0.3**2), abs=1e-5)


def test_groups_of_a_batch_have_clocks_of_their_own():
    heights, rules = [0.3, 0.5, 0.801], Rules(response="in time order")
    together = run(*drops(heights, 0.6), 0.05, 14, rules)[-1]
    for i, height in enumerate(heights):
        alone = run(*drops([height], 0.6), 0.05, 14, rules)[-1]
        # The reach of the look differs with the fastest ball; what is found does not
        assert together.position[2 * i] == pytest.approx(alone.position[0], abs=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize(("rest_speed", "stalls"), [(0.0, True), (0.1, False)])
def test_impacts_of_falling_discs_stall_unless_slow_contacts_are_held(rest_speed, stalls):
    # Twenty-five discs of 0.1 m fall in a box 1.3 m wide; without a threshold their bounces have no end
    rng = np.random.default_rng(0)
    i, j = np.divmod(np.arange(25), 5)
    x, z = (j - 2) * 0.25 + rng.uniform(-0.02, 0.02, 25), 0.2 + i * 0.25 + rng.uniform(-0.02, 0.02, 25)
    walls = [FLOOR, ("half-space", (1.0, 0, 0)), ("half-space", (-1.0, 0, 0))]
    shapes, masses = [("sphere", 0.1)] * 25 + walls, [1.0] * 25 + [np.inf] * 3
    bodies = make_bodies(shapes, masses, [[0.004] * 3] * 25 + [[np.inf] * 3] * 3, 0.5)
    state = make_state([*np.stack([x, 0 * x, z], axis=-1), (0, 0, 0), (-0.65, 0, 0), (0.65, 0, 0)])
    gravity = np.where(bodies.inverse_mass[:, None] > 0, (0, 0, -G), 0.0)
    rules, most = Rules(response="in time order", rest_speed=rest_speed), 0
    step = 0
    while step < 108 and most <= 300:
        state, impacts = step_in_time_order(bodies, state, gravity, 0 * gravity, 1 / 240, rules)
        step, most = step + 1, max(most, impacts)
    if stalls:  # soon after the lowest discs have met the floor, at √(2 · 0.08 m/g) = 0.13 s
        assert most > 300
        assert 0.2 < step / 240 < 0.35
    else:
        assert most < 100
        assert np.min(find_contacts(bodies, state).separation) > -1e-4
