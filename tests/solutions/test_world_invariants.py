"""What no scene may change: momentum, the energy of an impact, and the result of the same run seen from elsewhere."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from world_scenes import DOWN, FLOOR, Thing, energy, momentum, scene, turn

from solutions.impulse import rotation_matrix
from solutions.world.bodies import State
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.rotation import quaternion_product
from solutions.world.rows import contact_rows, speeds
from solutions.world.rules import Rules
from solutions.world.run import run_world
from solutions.world.sequential import Targets, in_groups, solve_sequentially
from solutions.world.step import advance_world

NO_WEIGHT = (0.0, 0.0, 0.0)


def some_shape(rng, kind):
    """A ball, a capsule or a box."""
    size = rng.uniform(0.1, 0.3, 3)
    return [("sphere", size[0]), ("capsule", size[0] / 2, size[1]), ("box", size)][kind]


def crowd(seed, groups, count):
    """Groups of bodies of all kinds that overlap or nearly do, all moving and spinning."""
    rng, things = np.random.default_rng(seed), []
    for group in range(groups):
        for kind in rng.integers(0, 3, count):
            pose = rng.normal(size=4)
            velocity, spin = rng.normal(size=(2, 3))
            place = np.array([1.0, -2.0, 0.5]) + rng.normal(scale=0.22, size=3)
            mass = rng.uniform(0.2, 5)
            things.append(
                Thing(some_shape(rng, kind), mass, place, pose / np.linalg.norm(pose), velocity, 2 * spin, group)
            )
    return things


def of_groups(bodies, state, groups):
    """Momentum, and angular momentum about the origin, of each group, (groups, 3) each."""
    each = []
    for group in range(groups):
        mine = bodies.group == group
        part = bodies._replace(inverse_mass=bodies.inverse_mass[mine], moments=bodies.moments[mine])
        each.append(momentum(part, State(*(of_all[mine] for of_all in state))))
    return np.moveaxis(np.array(each), 1, 0)


@settings(max_examples=6)
@given(st.integers(0, 10_000), st.floats(0, 1), st.floats(0, 1.5))
def test_free_bodies_of_all_shapes_keep_both_momenta(seed, restitution, friction):
    """Without position correction both stay. With it, the linear one and the path of the common centre still do.

    Position correction moves bodies beside their velocities. The moments of their momenta about the origin then change,
    because the momenta act elsewhere.
    """
    bodies, start = scene(crowd(seed, 8, 4), restitution=restitution, friction=friction)
    before = of_groups(bodies, start, 8)
    for recovery in (0.0, 0.5):
        end = run_world(bodies, start, NO_WEIGHT, 0.01, 4, Rules(recovery=recovery), every=4)
        last = State(*(each[-1] for each in end))
        assert np.max(np.abs(last.velocity - start.velocity)) > 0.1  # they have collided
        after = of_groups(bodies, last, 8)
        # Fifty sweeps over some ten contacts, each a rounding of impulses of order 10.
        np.testing.assert_allclose(after[0], before[0], atol=1e-11)
        if recovery == 0:
            np.testing.assert_allclose(after[1], before[1], atol=1e-11)
        for group in range(8):
            mass = 1 / bodies.inverse_mass[bodies.group == group]
            moved = mass @ (last.position - start.position)[bodies.group == group]
            np.testing.assert_allclose(moved, 0.04 * before[0, group], atol=1e-11)


@settings(max_examples=6)
@given(st.integers(0, 10_000), st.floats(0, 1), st.floats(0, 2))
def test_one_contact_of_any_two_shapes_never_gains_energy(seed, restitution, friction):
    bodies, start = scene(crowd(seed, 60, 2), restitution=restitution, friction=friction)
    contacts = find_contacts(bodies, start)
    single = np.flatnonzero(np.bincount(bodies.group[contacts.body_a], minlength=60) == 1)
    assert len(single) > 10
    # So short a step turns nothing, and the impact alone changes the energy.
    end, _, _ = advance_world(bodies, start, NO_WEIGHT, 1e-9, Rules(rest_speed=0.0, recovery=0.0, margin=0.0))
    of_group = [np.bincount(bodies.group, energy(bodies, state)) for state in (start, end)]
    assert np.all(of_group[1][single] <= of_group[0][single] * (1 + 1e-9))
    assert np.any(of_group[1][single] < of_group[0][single] * 0.999) or restitution > 0.99


def heap(seed=3):
    """Six bodies, two of each kind, that fall on the ground and on each other."""
    rng, things = np.random.default_rng(seed), [FLOOR]
    for number in range(6):
        pose = rng.normal(size=4)
        place = (*rng.uniform(-0.2, 0.2, 2), 0.3 + 0.3 * number)
        shape = some_shape(rng, number % 3)
        things.append(Thing(shape, rng.uniform(0.5, 2), place, pose / np.linalg.norm(pose), spin=rng.normal(size=3)))
    return things


def test_a_run_repeats_bit_for_bit():
    bodies, start = scene(heap(), friction=0.5, restitution=0.3)
    first, second = (run_world(bodies, start, DOWN, 1 / 60, 30) for _ in range(2))
    assert all(np.array_equal(one, other) for one, other in zip(first, second, strict=True))
    assert np.max(np.abs(first.angular_velocity[-1] - start.angular_velocity)) > 1  # they have met


def moved_scene(things, pose, shift):
    """The same scene, turned and then shifted."""
    to_there = rotation_matrix(pose)

    def there(thing):
        return thing._replace(
            position=to_there @ thing.position + shift,
            orientation=quaternion_product(pose, thing.orientation),
            velocity=to_there @ thing.velocity,
            spin=to_there @ thing.spin,
        )

    return [there(each) for each in things]


@pytest.mark.parametrize(
    ("angle", "shift"),
    [(np.pi / 2, (3.0, -7.0, 0.0)), pytest.param(1.1, (-2.0, 1.0, 0.0), marks=pytest.mark.slow)],
)
def test_a_scene_seen_from_elsewhere_gives_the_same_run(angle, shift):
    """Contacts get other tangents and may take their turns in another order; enough sweeps make that no difference."""
    pose, rules = turn((0, 0, 1), angle), Rules(sweeps=500, tolerance=1e-13)
    runs = []
    for things in (heap(), moved_scene(heap(), pose, np.array(shift))):
        bodies, start = scene(things, friction=0.5, restitution=0.3)
        runs.append(run_world(bodies, start, DOWN, 1 / 60, 24, rules))
    here, there = runs
    to_there = rotation_matrix(pose)
    assert np.max(np.abs(here.angular_velocity[-1] - here.angular_velocity[0])) > 1  # they have met
    # Roundings grow from contact to contact, and the sweeps leave 1e-13 of an impulse; measured 1e-13.
    np.testing.assert_allclose(there.position, here.position @ to_there.T + shift, atol=1e-10)
    np.testing.assert_allclose(there.velocity, here.velocity @ to_there.T, atol=1e-9)


@given(st.integers(0, 10_000), st.integers(1, 12), st.floats(0, 3))
def test_impulses_lie_within_the_cone_after_any_number_of_sweeps(seed, sweeps, friction):
    """Also from impulses of the last step that no longer fit, and where friction adds to the pressure."""
    rng = np.random.default_rng(seed)
    count, number = 9, 4
    a, b = rng.integers(1, number, count), np.zeros(count, dtype=int)
    b[::2] = (a[::2] + 1) % number
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    contacts = Contacts(a, b, rng.normal(size=(count, 3)), normal, np.zeros(count), np.arange(count))
    inverse_mass = np.array([0.0, *rng.uniform(0.2, 3, number - 1)])
    order, groups = in_groups(a, b, inverse_mass > 0)
    inverse_inertia = inverse_mass[:, None, None] * np.diag([0.5, 3, 20])
    rows = contact_rows(contacts.in_order(order), rng.normal(size=(number, 3)), inverse_mass, inverse_inertia)
    velocity, spin = rng.normal(size=(2, number, 3)) * (inverse_mass > 0)[:, None]
    none = np.zeros(count)
    wanted = Targets(none, none + friction, none + friction, none > 0)
    begun = rng.normal(size=(count, 3))
    *moved, impulse = solve_sequentially(rows, groups, velocity, spin, wanted, begun, sweeps)
    normal_impulse = impulse[:, 0] - np.vecdot(rows.coupling, impulse[:, 1:])
    assert np.min(normal_impulse) >= -1e-12 * np.max(np.abs(impulse))
    excess = np.linalg.norm(impulse[:, 1:], axis=-1) - friction * normal_impulse
    assert np.max(excess) <= 1e-9 * np.max(np.abs(impulse))
    assert np.all(np.isfinite(speeds(rows, *moved)))
