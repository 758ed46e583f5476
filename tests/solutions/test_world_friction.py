"""Bodies that touch at several places: which contacts belong together, what holds, and what slips."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.world.bodies import make_bodies, make_state
from solutions.world.contacts import Contacts
from solutions.world.rows import contact_rows
from solutions.world.rules import Rules
from solutions.world.simultaneous import islands
from solutions.world.step import advance_world

G = 9.81


def on_slope(ratio, static, kinetic):
    """A box of unequal edges on a slope of tan θ = ratio, which descends across its corners."""
    angle, heading = np.arctan(ratio), 0.4
    down = np.array([np.cos(heading) * np.cos(angle), np.sin(heading) * np.cos(angle), -np.sin(angle)])
    normal = np.array([np.cos(heading) * np.sin(angle), np.sin(heading) * np.sin(angle), np.cos(angle)])
    axis = np.array([-np.sin(heading), np.cos(heading), 0]) * np.sin(angle / 2)
    half, mass = np.array([0.3, 0.2, 0.1]), 2.0
    moments = mass / 3 * (np.sum(half**2) - half**2)
    bodies = make_bodies([("box", half), ("half-space", normal)], [mass, np.inf], moments, 0.0, kinetic, static)
    return bodies, make_state([0.1 * normal, (0, 0, 0)], [(np.cos(angle / 2), *axis), (1, 0, 0, 0)]), down, angle


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_four_places_hold_a_box_together_up_to_static_friction(response):
    """The lower ones carry more than the upper ones; all of them slip with μ_k as soon as together they cannot hold."""
    dt, rules = 0.01, Rules(response=response, sweeps=400, tolerance=1e-10, directions=12)
    for ratio, holds in ((0.47, True), (0.53, False)):
        bodies, state, down, angle = on_slope(ratio, 0.5, 0.1)
        after, _, _ = advance_world(bodies, state, (0, 0, -G), dt, rules)
        gained = 0.0 if holds else dt * G * (np.sin(angle) - 0.1 * np.cos(angle))
        # Between two of twelve directions 1 − cos(π/12), 3.4 % of friction is lost
        limit = 1e-8 if response == "sequential" else 0.034 * 0.1 * dt * G
        assert after.velocity[0] @ down == pytest.approx(gained, abs=limit)


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_a_rough_floor_brakes_what_slides_along_a_smooth_wall(response):
    # A ball that cannot turn lies on a floor with μ = 0.4 and leans on a wall without friction, by 2 m/s² of weight
    shapes = [("sphere", 0.1), ("half-space", (0.0, 0.0, 1.0)), ("half-space", (1.0, 0.0, 0.0))]
    friction = np.array([[0, 0.4, 0], [0.4, 0, 0], [0, 0, 0]])
    bodies = make_bodies(shapes, [1.0, np.inf, np.inf], np.full(3, np.inf), 0.0, friction, material=[0, 1, 2])
    state = make_state([(0.1, 0, 0.1), (0, 0, 0), (0, 0, 0)], velocity=[(0, 3, 0), (0, 0, 0), (0, 0, 0)])
    after, _, _ = advance_world(bodies, state, (-2.0, 0, -G), 0.01, Rules(response=response))
    # one of the eight directions is along y; sweeps end at changes of 1e-6
    assert after.velocity[0] == pytest.approx(np.array([0, 3 - 0.4 * G * 0.01, 0]), abs=2e-6)


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_what_lies_on_a_braking_plate_is_held_by_static_friction(response):
    # The plate slides on the floor with μ = 0.3. To brake with it, the ball on it needs more than μ_k
    shapes = [("half-space", (0.0, 0.0, 1.0)), ("box", (1.0, 1.0, 0.1)), ("sphere", 0.1)]
    kinetic = np.array([[0, 0.3, 0], [0.3, 0, 0.1], [0, 0.1, 0]])
    static = np.array([[0, 0.4, 0], [0.4, 0, 0.5], [0, 0.5, 0]])
    bodies = make_bodies(shapes, [np.inf, 2.0, 1.0], np.full(3, np.inf), 0.0, kinetic, static, material=[0, 1, 2])
    state = make_state([(0, 0, 0), (0, 0, 0.1), (0.2, -0.1, 0.3)], velocity=[(0, 0, 0), (0, 1, 0), (0, 1, 0)])
    after, _, _ = advance_world(bodies, state, (0, 0, -G), 0.01, Rules(response=response, sweeps=500, tolerance=1e-12))
    # one of the eight directions is along y
    np.testing.assert_allclose(after.velocity[1:], [(0, 1 - 0.3 * G * 0.01, 0)] * 2, atol=1e-9)


def test_islands_are_what_the_contacts_of_movable_bodies_join():
    rng, count = np.random.default_rng(3), 14
    joined = 0
    for _ in range(20):
        inverse_mass = np.where(rng.uniform(size=count) < 0.7, 1.0, 0.0)
        a, b = rng.integers(0, count, (2, 12))
        kept = (a != b) & (inverse_mass[a] + inverse_mass[b] > 0)
        a, b, m = a[kept], b[kept], np.count_nonzero(kept)
        normal = np.tile([0.6, 0, 0.8], (m, 1))
        contacts = Contacts(a, b, rng.normal(size=(m, 3)), normal, np.zeros(m), np.arange(m))
        rows = contact_rows(
            contacts, rng.normal(size=(count, 3)), inverse_mass, inverse_mass[:, None, None] * np.eye(3)
        )
        moved = [{body for body in pair if inverse_mass[body]} for pair in zip(a.tolist(), b.tolist(), strict=True)]
        expected: list[tuple[set, set]] = []  # of bodies, and of contacts
        for contact, bodies in enumerate(moved):
            those = [each for each in expected if each[0] & bodies]
            expected = [each for each in expected if not each[0] & bodies]
            members = {contact}.union(*(each[1] for each in those))
            expected.append((bodies.union(*(each[0] for each in those)), members))
        found = islands(rows, count)
        assert sorted(each.tolist() for each in found) == sorted(sorted(members) for _, members in expected)
        joined += max((len(each) for each in found), default=0) > 3
    assert joined > 5
