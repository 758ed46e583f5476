"""Sequential impulses: one impact, friction at rest and sliding, groups, and what a step remembers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.friction import dissipative_impulse
from solutions.world import solve_by_pivots
from solutions.world.bodies import make_bodies
from solutions.world.contacts import Contacts
from solutions.world.rows import contact_rows, speeds
from solutions.world.sequential import Targets, in_groups, solve_sequentially

UP = np.array([0.0, 0.0, 1.0])


def some_impacts(seed, count, immovable=0):
    """Contacts of two bodies each, turned and off their centres, all approaching; some B's immovable."""
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    a, b = np.arange(count), np.arange(count, 2 * count)
    point, position = rng.normal(size=(count, 3)), rng.normal(size=(2 * count, 3))
    axes = np.linalg.qr(rng.normal(size=(2 * count, 3, 3)))[0]
    inverse_inertia = axes @ (rng.uniform(0.5, 5, (2 * count, 3, 1)) * np.swapaxes(axes, -1, -2))
    inverse_mass, movable = rng.uniform(0.2, 4, 2 * count), np.ones(2 * count)
    movable[count : count + immovable] = 0
    rows = contact_rows(
        Contacts(a, b, point, normal, np.zeros(count), a),
        position,
        inverse_mass * movable,
        inverse_inertia * movable[:, None, None],
    )
    velocity, spin = rng.normal(size=(2, 2 * count, 3)) * movable[:, None]
    away = np.sign(speeds(rows, velocity, spin)[:, 0])
    velocity, spin = (-np.tile(away, 2)[:, None] * each for each in (velocity, spin))
    return rng, rows, velocity, spin


def along_axes(rows, velocity, spin):
    """Velocity (m, 3) of each A's point from its B's, and K (m, 3, 3), both along the world's axes."""
    across = np.concatenate([rows.direction[:, :1], rows.direction[:, 1:]], axis=1)
    back = np.linalg.inv(across)
    return np.matvec(back, speeds(rows, velocity, spin)), back @ rows.softness @ np.swapaxes(back, -1, -2)


def test_one_impact_takes_the_most_energy_that_newtons_rule_leaves():
    rng, rows, velocity, spin = some_impacts(1, 60, immovable=20)
    restitution, friction = rng.uniform(0, 1, 60), rng.uniform(0, 1.5, 60)
    slip, softness = along_axes(rows, velocity, spin)
    approach = speeds(rows, velocity, spin)[:, 0]
    wanted = Targets(-restitution * approach, friction, friction, restitution > 0)
    _, groups = in_groups(rows.body_a, rows.body_b, np.ones(120, dtype=bool))
    *_, impulse = solve_sequentially(rows, [slice(0, 60)] * len(groups), velocity, spin, wanted, sweeps=300)
    expected = dissipative_impulse(slip, rows.direction[:, 0], softness, restitution, friction)
    # 1e-9: the least is found by halving an angle there, and step by step here, to some 1e-12
    np.testing.assert_allclose(np.vecmat(impulse, rows.direction), expected, atol=1e-9 * np.abs(expected).max())


def test_a_contact_without_rebound_obeys_coulombs_law():
    rng, rows, velocity, spin = some_impacts(2, 80, immovable=30)
    kinetic = rng.uniform(0, 1, 80)
    static = kinetic * rng.uniform(1, 1.5, 80)
    wanted = Targets(np.zeros(80), static, kinetic, np.zeros(80, dtype=bool))
    *moved, impulse = solve_sequentially(rows, [slice(0, 80)], velocity, spin, wanted, sweeps=400)
    speed, normal = speeds(rows, *moved), rows.direction[:, 0]
    given_impulse = np.vecmat(impulse, rows.direction)
    along = np.vecdot(given_impulse, normal)
    across = given_impulse - along[:, None] * normal
    slip = np.vecmat(speed[:, 1:], rows.direction[:, 1:] + rows.coupling[:, :, None] * normal[:, None])
    slips = np.linalg.norm(slip, axis=-1) > 1e-9
    assert 20 < np.sum(slips) < 70
    np.testing.assert_allclose(speed[:, 0], 0, atol=1e-11)  # of speeds of order 1, in 400 sweeps
    opposing = -slip[slips] / np.linalg.norm(slip[slips], axis=-1, keepdims=True)
    edge = (kinetic * along)[slips, None]
    np.testing.assert_allclose(across[slips], edge * opposing, atol=1e-8)  # slow slips lose digits
    assert np.all(np.linalg.norm(across, axis=-1)[~slips] <= (static * along)[~slips] * (1 + 1e-9))


@given(st.integers(0, 10_000), st.integers(1, 40))
def test_no_two_contacts_of_a_group_move_the_same_body(seed, count):
    rng = np.random.default_rng(seed)
    movable = rng.uniform(size=12) < 0.8
    a, b = rng.integers(0, 12, size=(2, count))
    b = np.where(a == b, (b + 1) % 12, b)
    order, groups = in_groups(a, b, movable)
    assert sorted(order) == list(range(count))
    assert [each.start for each in groups[1:]] == [each.stop for each in groups[:-1]]
    for group in groups:
        moved = [body for body in (*a[order[group]], *b[order[group]]) if movable[body]]
        assert len(set(moved)) == len(moved)


def chain(count, masses, restitution=0.0):
    """Balls one upon another over the ground, body 0, each with the speed that weight adds in a step."""
    a, b = np.arange(1, count + 1), np.arange(count)
    inverse_mass = np.concatenate([[0.0], 1 / np.asarray(masses)])
    position = np.stack([0 * inverse_mass, 0 * inverse_mass, np.arange(count + 1.0)], axis=-1)
    contacts = Contacts(a, b, position[1:] - 0.5 * UP, np.tile(UP, (count, 1)), np.zeros(count), a)
    order, groups = in_groups(a, b, inverse_mass > 0)
    inverse_inertia = np.where(inverse_mass > 0, 2.5, 0.0)[:, None, None] * np.eye(3)
    rows = contact_rows(contacts.in_order(order), position, inverse_mass, inverse_inertia)
    velocity = np.where(inverse_mass > 0, -0.01, 0.0)[:, None] * UP
    return order, groups, rows, velocity


def test_resting_contacts_solve_the_complementarity_problem():
    rng = np.random.default_rng(3)
    _, groups, rows, velocity = chain(6, rng.uniform(1, 3, 6))
    velocity[1:] += rng.uniform(-0.02, 0.02, (6, 1)) * UP
    none = np.zeros(6)
    wanted = Targets(none, none, none, none > 0)
    *_, impulse = solve_sequentially(rows, groups, velocity, 0 * velocity, wanted, sweeps=2000)
    columns = np.zeros((6, 7, 6))
    columns[np.arange(6), rows.body_a] = rows.speed[:, 0, :6]
    columns[np.arange(6), rows.body_b] = rows.speed[:, 0, 6:]
    answers = np.zeros((6, 7, 6))
    answers[np.arange(6), rows.body_a] = rows.answer[:, 0, :6]
    answers[np.arange(6), rows.body_b] = rows.answer[:, 0, 6:]
    matrix = columns.reshape(6, -1) @ answers.reshape(6, -1).T
    offset = speeds(rows, velocity, 0 * velocity)[:, 0]
    np.testing.assert_allclose(impulse[:, 0], solve_by_pivots(matrix, offset), atol=1e-13)  # of impulses up to 0.1


def test_the_lowest_of_ten_balls_carries_all_of_them():
    masses = np.linspace(1, 2, 10)
    order, groups, rows, velocity = chain(10, masses)
    none = np.zeros(10)
    wanted, start = Targets(none, none, none, none > 0), np.zeros((10, 3))
    carried = []
    for _ in range(40):  # each from the last, as a step remembers
        *_, start = solve_sequentially(rows, groups, velocity, 0 * velocity, wanted, start, sweeps=10)
        carried.append(start[np.argmin(order), 0] / (0.01 * masses.sum()))
    assert carried[0] < 0.7  # ten sweeps alone leave the rest to the steps that follow
    assert carried[-1] == pytest.approx(1, abs=1e-3)


def test_what_is_immovable_is_not_turned_either():
    bodies = make_bodies([("half-space", UP), ("box", (1, 1, 1))], [np.inf, np.inf], [[1, 2, 3], [1, 1, 1]])
    assert np.all(np.isinf(bodies.moments))  # or two contacts of a group would turn the same body
