"""What a world keeps from step to step: the names of contacts, what its materials are, and arrays of its own."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.memory import Memory, remembered
from solutions.world.rows import contact_rows
from solutions.world.rules import Rules
from solutions.world.sleeping import with_neighbours
from solutions.world.step import advance_world

G = 9.81
DOWN = (0.0, 0.0, -G)
FLOOR = ("half-space", (0.0, 0.0, 1.0))
BALL = ("sphere", 0.1)


def balls(position, velocity, restitution=0.0, friction=0.0, static_friction=None):
    """Balls of 1 kg and radius 0.1 m over a floor, which comes first."""
    count = len(position)
    bodies = make_bodies(
        [FLOOR, *[BALL] * count], [np.inf, *[1.0] * count], 0.004 * np.ones(3), restitution, friction, static_friction
    )
    return bodies, make_state([(0, 0, 0), *position], velocity=[(0, 0, 0), *velocity])


def test_no_two_contacts_of_a_heap_have_the_same_name():
    # Compounds of two boxes on a floor and on each other, so that pieces, pairs and features all differ
    two = ("compound", [(("box", (0.3, 0.2, 0.1)), (x, 0, 0), (1, 0, 0, 0)) for x in (-0.25, 0.25)])
    bodies = make_bodies([FLOOR, *[two] * 4], [np.inf, 1, 1, 1, 1], np.ones(3))
    place = [(0, 0, 0), (0, 0, 0.0999), (0.2, 0.1, 0.2997), (0, 0.5, 0.0999), (0.1, 0.45, 0.2997)]
    angle = np.array([0, 0, 0.1, 0.2, 0.3])
    contacts = find_contacts(
        bodies, make_state(place, np.stack([np.cos(angle / 2), 0 * angle, 0 * angle, np.sin(angle / 2)], axis=-1))
    )
    assert len(contacts.key) > 40
    assert len(np.unique(contacts.key)) == len(contacts.key)


@pytest.mark.parametrize("decoupled", [True, False])
def test_a_remembered_impulse_is_the_same_vector_and_a_new_contact_has_none(decoupled):
    # The contacts have turned since, and come in another order; some are new, and some of the last step are gone
    rng, count = np.random.default_rng(6), 12
    kept, gone = rng.normal(size=(8, 3)), rng.normal(size=(3, 3))
    key = rng.permutation(1000)[: count + 3]
    memory = Memory(np.concatenate([key[:8], key[count:]]), np.concatenate([kept, gone]))
    order = rng.permutation(count)
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    a, b, point = np.arange(count), np.arange(count) + count, rng.normal(size=(count, 3))
    contacts = Contacts(a, b, point, normal, np.zeros(count), key[:count][order])
    inverse_inertia = np.tile(np.diag([1.0, 2.0, 5.0]), (2 * count, 1, 1))
    rows = contact_rows(contacts, rng.normal(size=(2 * count, 3)), np.ones(2 * count), inverse_inertia, decoupled)
    expected = np.concatenate([kept, np.zeros((4, 3))])[order]
    start = remembered(memory, contacts, rows)
    np.testing.assert_allclose(np.vecmat(start, rows.direction), expected, atol=1e-14)  # some roundings


def test_a_state_does_not_change_with_what_it_was_made_of():
    given = [np.ones((2, 3)), np.tile([1.0, 0, 0, 0], (2, 1)), np.ones((2, 3)), np.ones((2, 3))]
    state = make_state(*given)
    kept = [each.copy() for each in state]
    for each in given:
        each += 1
    for part, before in zip(state, kept, strict=True):
        np.testing.assert_array_equal(part, before)


def test_a_penalty_ball_slides_with_kinetic_friction():
    bodies, state = balls([(0, 0, 0.1 - G / 1e4)], [(3, 4, 0)], friction=0.2, static_friction=0.9)
    after, _, _ = advance_world(bodies, state, DOWN, 1e-3, Rules(response="penalty"))
    # In its balance the spring carries the weight; the force along the surface has no time to change
    lost = 5 - np.linalg.norm(after.velocity[1, :2])
    assert lost == pytest.approx(0.2 * G * 1e-3, rel=1e-9)


def test_a_spin_counts_as_the_speed_of_the_surface_when_bodies_fall_asleep():
    # At 0.1 m from the axis 0.15 rad/s are 15 mm/s and 0.25 rad/s are 25 mm/s; slower than 20 mm/s falls asleep
    bodies = make_bodies([BALL] * 2, 1.0, 0.004 * np.ones(3))
    state = make_state([(0, 0, 0), (1, 0, 0)], angular_velocity=[(0, 0.15, 0), (0, 0, 0.25)])
    memory: list = []
    rules = Rules(sleep_speed=0.02, sleep_after=0.05)
    for _ in range(8):
        state, *memory, _ = advance_world(bodies, state, (0, 0, 0), 0.01, rules, *memory)
    np.testing.assert_array_equal(state.angular_velocity, [(0, 0, 0), (0, 0, 0.25)])


def test_those_that_touch_a_body_are_its_only_neighbours():
    # Contacts 0–1, 2–1 and 2–3, the chosen body once as A and once as B
    contacts = Contacts(np.array([0, 2, 2]), np.array([1, 1, 3]), *np.zeros((3, 3, 3))[:2], np.zeros(3), np.arange(3))
    for chosen, reached in (([0], [0, 1]), ([2], [1, 2, 3]), ([3], [2, 3]), ([], [])):
        among = np.isin(np.arange(4), chosen)
        np.testing.assert_array_equal(np.flatnonzero(with_neighbours(among, contacts)), reached)
        np.testing.assert_array_equal(np.flatnonzero(among), chosen)  # which is left as it was


def test_one_pair_with_less_static_than_kinetic_friction_is_refused():
    kinetic, static = np.array([[0.2, 0.3], [0.3, 0.4]]), np.array([[0.2, 0.3], [0.3, 0.3]])
    with pytest.raises(ValueError, match="static_friction must not be below friction"):
        make_bodies([BALL] * 2, 1.0, np.ones(3), friction=kinetic, static_friction=static, material=[0, 1])
