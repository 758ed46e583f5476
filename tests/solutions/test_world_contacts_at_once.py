"""Contacts that act together: what their impulses solve, and what they keep."""

from __future__ import annotations

import numpy as np
import pytest
from balls_and_rods import EXACT, FLOOR, IMPULSES, G, energy, once, rod, slope, spheres
from hypothesis import given, settings
from hypothesis import strategies as st

from solutions.world import contact_jacobian, inverse_mass_matrix, resting_problem, solve_by_sweeps
from solutions.world.bodies import make_bodies, make_state
from solutions.world.contacts import find_contacts
from solutions.world.rows import contact_rows
from solutions.world.rules import LAWS, Rules
from solutions.world.simultaneous import islands
from solutions.world.step import advance_world


def random_heap(seed, count=4, friction=True):
    """Unequal balls that touch one another and a wall nobody moves, with impacts at all contacts."""
    rng = np.random.default_rng(seed)
    position = [np.zeros(3)]
    radius = rng.uniform(0.2, 0.6, count)
    for i in range(1, count):
        way = rng.normal(size=3)
        way /= np.linalg.norm(way)
        j = int(rng.integers(i))
        position.append(position[j] + (radius[i] + radius[j]) * way)
    mass, mu = rng.uniform(0.3, 3, count), rng.uniform(0.1, 1) if friction else 0.0
    return spheres(
        position, rng.normal(size=(count, 3)), mass, rng.uniform(), mu, radius, spin=3 * rng.normal(size=(count, 3))
    )


def test_simultaneous_impulses_solve_the_problem_of_resting_contacts():
    bodies, state = random_heap(4, count=6, friction=False)
    contacts = find_contacts(bodies, state, 1e-9)
    arms = [contacts.point - state.position[each] for each in (contacts.body_a, contacts.body_b)]
    count = len(bodies.inverse_mass)
    jacobian = contact_jacobian(contacts.body_a, contacts.body_b, contacts.normal, *arms, count)
    shares = inverse_mass_matrix(bodies.inverse_mass, np.eye(3) / bodies.moments[:, :, None])
    velocities = np.concatenate([state.velocity, state.angular_velocity], axis=-1).ravel()
    matrix, apart = resting_problem(jacobian, shares, np.linalg.solve(shares, velocities))
    e = bodies.surfaces.restitution[0, 0]
    impulse = solve_by_sweeps(matrix, apart + e * np.minimum(apart, 0), 400)
    expected = velocities + shares @ jacobian.T @ impulse
    rules = Rules(response="simultaneous", rest_speed=0.0, margin=1e-9)
    velocity, spin = once(bodies, state, rules)
    assert np.count_nonzero(impulse) == 5  # of nine contacts
    # gaps of 1e-16 that rounding leaves may be closed in a step of 1e-9
    assert np.concatenate([velocity, spin], axis=-1).ravel() == pytest.approx(expected, abs=1e-6)


def test_a_thin_sheet_slides_with_coulombs_friction_all_at_once():
    half_thickness = 1e-5  # m
    # Its eight corners are four pairs that nearly coincide, and rounding spoils the first table of Lemke's method.
    shapes = [("box", (0.5, 0.3, half_thickness)), FLOOR]
    moments = [[0.03, 1 / 12, 0.34 / 3], [np.inf] * 3]
    bodies = make_bodies(shapes, [1.0, np.inf], moments, restitution=0.2, friction=0.5)
    state = make_state([(0.1, 0.0, half_thickness), (0, 0, 0)], velocity=[(0.3, 0.1, 0.0), (0, 0, 0)])
    rules = Rules(response="simultaneous", law="newton", slop=1.0)
    after, memory, _ = advance_world(bodies, state, (0.0, 0.0, -G), 1 / 120, rules)
    assert after.velocity[0, 2] == pytest.approx(0, abs=1e-7)  # m/s; what counts as rounding in Lemke's method
    # A polygon of 8 directions lies between the circle of Coulomb's cone and one that is smaller by cos 22.5°.
    push = np.hypot(*memory.impulse.sum(axis=0)[:2])
    assert np.cos(np.pi / 8) * 0.5 * G / 120 - 1e-7 <= push <= 0.5 * G / 120 + 1e-7


def test_contacts_of_islands_share_no_body_that_moves():
    # Two rows of balls on one floor, and a ball alone; in each row the contacts of the balls join those with the floor
    place = [(0, 0, 0.1), (0.2, 0, 0.1), (0.4, 0, 0.1), (5, 0, 0.1), (9, 0, 0.1), (9.2, 0, 0.1), (0, 0, 0)]
    bodies = make_bodies([*[("sphere", 0.1)] * 6, FLOOR], [1.0] * 6 + [np.inf], [[0.004] * 3] * 6 + [[np.inf] * 3])
    state = make_state(place)
    contacts = find_contacts(bodies, state, 1e-6)
    inertia = np.where(np.isinf(bodies.moments), 0, 1 / bodies.moments)[:, :, None] * np.eye(3)
    found = islands(contact_rows(contacts, state.position, bodies.inverse_mass, inertia), 7)
    pairs = np.stack([contacts.body_a, contacts.body_b])
    members = sorted(np.unique(pairs[:, each]).tolist() for each in found)
    assert members == [[0, 1, 2, 6], [3, 6], [4, 5, 6]]
    assert sorted(np.concatenate(found)) == list(range(len(contacts.key)))


def test_walls_that_both_close_on_a_ball_leave_no_impulses():
    walls = [("half-space", (1.0, 0.0, 0.0)), ("half-space", (-1.0, 0.0, 0.0))]
    bodies = make_bodies([("sphere", 0.1), *walls], [1.0, np.inf, np.inf], [[0.004] * 3, *[[np.inf] * 3] * 2], 0.5)
    place, velocity = [(0, 0, 0), (-0.1, 0, 0), (0.1, 0, 0)], [(0, 0, 0), (1, 0, 0), (-1, 0, 0)]
    with pytest.raises(ValueError, match="no forces solve"):
        once(bodies, make_state(place, velocity=velocity), Rules(response="simultaneous"))


@pytest.mark.parametrize(("response", "share"), [("sequential", 1.0), ("simultaneous", np.cos(np.pi / 8))])
def test_polygon_of_eight_directions_is_weaker_between_two(response, share):
    # A ball that cannot be turned slides between two of the directions: g Δt μ is taken from its speed
    floor = ("half-space", (0.0, 0.0, 1.0))
    bodies = make_bodies([("sphere", 0.1), floor], [1.0, np.inf], [[np.inf] * 3] * 2, 0.0, 0.4)
    for angle, expected in ((0.0, 1.0), (np.pi / 8, share)):
        start = [(3 * np.cos(angle), 3 * np.sin(angle), 0), (0, 0, 0)]
        state = make_state([(0, 0, 0.1), (0, 0, 0)], velocity=start)
        after, _, _ = advance_world(bodies, state, (0, 0, -G), 0.01, Rules(response=response))
        lost = (state.velocity[0] - after.velocity[0]) @ start[0] / 3
        assert lost == pytest.approx(0.4 * G * 0.01 * expected, rel=1e-9)


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_slip_uses_kinetic_friction_and_rest_the_static_one(response):
    down, normal = slope(20)  # tan 20° = 0.364 lies between the two
    shapes = [("sphere", 0.1), ("half-space", normal)]
    bodies = make_bodies(shapes, [1.0, np.inf], [[np.inf] * 3] * 2, 0.0, 0.2, static_friction=0.5)
    dt, angle = 0.01, np.radians(20)
    for start, gained in ((0.0, 0.0), (1.0, dt * G * (np.sin(angle) - 0.2 * np.cos(angle)))):
        state = make_state([0.1 * normal, (0, 0, 0)], velocity=[start * down, (0, 0, 0)])
        after, _, _ = advance_world(bodies, state, (0, 0, -G), dt, Rules(response=response, directions=64))
        # of 64 directions one lies near enough: 0.12 %
        assert after.velocity[0] @ down - start == pytest.approx(gained, abs=2e-3 * G * dt)


def test_impact_in_time_order_slips_with_kinetic_friction():
    shapes = [("sphere", 0.1), FLOOR]
    bodies = make_bodies(shapes, [1.0, np.inf], [[0.004] * 3, [np.inf] * 3], 0.5, 0.1, static_friction=0.9)
    state = make_state([(0, 0, 0.1), (0, 0, 0)], velocity=[(4.0, 3.0, -2.0), (0, 0, 0)])
    velocity, _ = once(bodies, state, Rules(response="in time order"))
    # it takes 0.1 · (1 + e) · 2 m/s from a slip of 5 m/s; to end it would take 2/7 of 5 m/s
    assert velocity[0] == pytest.approx(np.array([4.0 * 0.94, 3.0 * 0.94, 1.0]), abs=1e-13)


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_friction_without_rebound_opposes_the_slip_that_is_left(response):
    u = np.array([2.0, 1.5, -1.0])
    velocity, spin = once(*rod(u, 0.0, 0.3), Rules(response=response, directions=64, **EXACT))
    left = velocity[0] + np.cross(spin[0], (-0.4, 0, -0.3))
    push = (velocity[0] - u)[:2]
    assert left[2] == pytest.approx(0.0, abs=1e-12)
    # the nearest of 64 directions lies within π/64 = 0.049
    off = 0.05 if response == "simultaneous" else 1e-9
    assert push @ left[:2] / np.linalg.norm(push) / np.linalg.norm(left[:2]) <= -np.cos(off) + 1e-12


@pytest.mark.parametrize("response", ["sequential", "simultaneous"])
def test_ball_in_a_groove_presses_on_both_sides_with_the_same_force(response):
    # Sides at 30° and 50°: by Lami's theorem m g sin 50°/sin 80° and m g sin 30°/sin 80°
    sides = [(np.sin(a), 0.0, np.cos(a)) for a in np.radians([30, -50])]
    shapes = [("sphere", 0.1), *(("half-space", side) for side in sides)]
    bodies = make_bodies(shapes, [2.0, np.inf, np.inf], [[0.008] * 3, [np.inf] * 3, [np.inf] * 3])
    corner = np.linalg.solve([sides[0], (0, 1, 0), sides[1]], [0.1, 0, 0.1])
    state = make_state([corner, (0, 0, 0), (0, 0, 0)])
    rules = Rules(response=response, sweeps=500, tolerance=0.0)
    _, memory, _ = advance_world(bodies, state, (0, 0, -G), 0.01, rules)
    press = np.linalg.norm(memory.impulse, axis=-1) / 0.01
    weight = 2 * G / np.sin(np.radians(80))
    # the corner is placed to rounding, and a gap of 1e-17 counts with 1/Δt
    assert press == pytest.approx(weight * np.sin(np.radians([50, 30])), rel=1e-9)


def momenta(bodies, state, place):
    mass = 1 / bodies.inverse_mass[:, None]
    turning = np.cross(place, mass * state.velocity) + bodies.moments * state.angular_velocity
    return np.concatenate([np.sum(mass * state.velocity, axis=0), np.sum(turning, axis=0)])


@given(st.integers(0, 10_000))
@settings(max_examples=5)
@pytest.mark.parametrize("response", list(LAWS))
def test_free_balls_keep_momentum_and_angular_momentum(response, seed):
    bodies, state = random_heap(seed)
    # In time order what rests is held by constant forces for a whole flight Δt, while its two points slide apart by
    # s Δt. A force that the sweeps leave over, a share of the impulse J over Δt, so changes the angular momentum by
    # that share of J s Δt/2. With a share of 1e-14 this is far below rounding
    rules = Rules(response=response, recovery=0.0, sweeps=500, tolerance=1e-14)
    after, _, _ = advance_world(bodies, state, (0, 0, 0), 1e-3, rules)
    before = momenta(bodies, state, state.position)
    # Nothing is pushed apart. Impulses act where the bodies are before the step, in time order where they are then
    place = after.position if response == "in time order" else state.position
    scale = np.sum(np.abs(state.velocity)) + np.sum(np.abs(state.angular_velocity))
    assert momenta(bodies, after, place) == pytest.approx(before, abs=1e-13 * scale)


@given(st.integers(0, 10_000))
@settings(max_examples=4)
@pytest.mark.parametrize("law", ["dissipative", "poisson", "stronge"])
def test_energy_never_rises_in_time_order(law, seed):
    bodies, state = random_heap(seed)
    rules = Rules(response="in time order", law=law, rest_speed=1e-3, looks=60)
    for _ in range(3):
        before = energy(bodies, state)
        state, _, _ = advance_world(bodies, state, (0, 0, 0), 0.05, rules)
        assert energy(bodies, state) <= before * (1 + 1e-12)


@given(st.integers(0, 10_000))
@settings(max_examples=3)
@pytest.mark.parametrize("response", IMPULSES)
def test_one_contact_never_gains_energy_but_by_newtons_law(response, seed):
    rng = np.random.default_rng(seed)
    u, spin = rng.normal(size=(2, 3))
    bodies, state = rod(u, rng.uniform(), rng.uniform(0, 1.5), spin)
    for law in LAWS[response]:
        if law != "newton":
            velocity, w = once(bodies, state, Rules(response=response, law=law, **EXACT))
            after = energy(bodies, state._replace(velocity=velocity, angular_velocity=w))
            assert after <= energy(bodies, state) * (1 + 1e-9)
