"""Flights between impacts: how far they reach, how long they last, and what the materials say of the next impact."""

from __future__ import annotations

import numpy as np
import pytest

from solutions.impulse import rotation_matrix
from solutions.world.bodies import make_bodies, make_state
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.flights import TOUCH, TURN, Flight, backed_up, flown, reach, until_next
from solutions.world.rows import contact_rows
from solutions.world.rules import Rules
from solutions.world.step import advance_world
from solutions.world.time_order import step_in_time_order

UP = np.array([0.0, 0.0, 1.0])


@pytest.mark.parametrize(
    ("velocity", "acceleration", "spin"),
    [((1.0, -2, 2), (0, 0, 0), (0, 0, 0)), ((0, 0, 0), (3.0, 0, -4), (0, 0, 0)), ((0, 0, 0), (0, 0, 0), (0.6, 0, 0.8)),
     ((0.3, 0.1, -0.2), (0, 0.4, -0.5), (0, 0.2, 0.3)), ((0, 0, 0), (0, 0, 0), (0, 9.0, 0))],
)  # fmt: skip
def test_two_bodies_close_no_more_than_the_reach_and_not_far_less(velocity, acceleration, spin):
    # Two rods, held near one end, that fly apart as mirror images would: their far ends move by the most
    left = 0.2
    rod = ("compound", [(("capsule", 0.05, 1.5), (0, 0, 1.0), (1, 0, 0, 0))])
    bodies = make_bodies([rod] * 2, 1.0, [[0.4, 0.4, 0.01]] * 2)
    lying = (np.sqrt(0.5), 0, -np.sqrt(0.5), 0)
    both = np.array([[1.0], [-1.0]])
    state = make_state([(3, 1, 2), (3, 8, 2)], lying, both * velocity, both * spin)
    far = reach(bodies, state, both * acceleration, np.full(2, left))
    fastest = np.linalg.norm(spin)
    time = min(left, TURN / fastest) if fastest else left  # no flight turns farther
    after = flown(bodies, state, Flight(*state[2:], both * acceleration, np.zeros((2, 3))), np.full(2, time))
    ends = [rotation_matrix(each.orientation) @ (0, 0, 2.5) for each in (state, after)]
    moved = after.position - state.position + ends[1] - ends[0]
    farthest = 2 * np.max(np.linalg.norm(moved, axis=-1))
    assert farthest <= far <= 2 * farthest + TOUCH


def test_a_gap_closes_at_the_first_root_of_its_parabola():
    """Of bodies that fall alike or not, approach or part, touch or overlap a little, each pair with its own clock."""
    rng, count = np.random.default_rng(1), 60
    a, b = np.arange(count), np.arange(count, 2 * count)
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    gap = rng.uniform(0, 0.3, count) * rng.choice([0, 1], count)
    position, velocity, acceleration = rng.normal(size=(3, 2 * count, 3))
    acceleration[30:45] = acceleration[90:105] = (0, 0, -9.81)
    acceleration[45:60] = 5 * normal[45:]  # most of these turn back before they meet
    near = Contacts(a, b, rng.normal(size=(count, 3)), normal, gap - 1e-12 * (gap == 0), a)
    rows = contact_rows(near, position, np.ones(2 * count), np.tile(np.eye(3), (2 * count, 1, 1)))
    flight = Flight(velocity, np.zeros((2 * count, 3)), acceleration, np.zeros((2 * count, 3)))
    watched = np.flatnonzero(rng.uniform(size=count) < 0.9)
    found = until_next(near, rows, watched, flight, np.tile(a, 2), np.full(count, 5.0))
    compared = 0
    for i in range(count):
        apart, bend = (normal[i] @ (each[i] - each[count + i]) for each in (velocity, acceleration))
        roots = np.roots([bend / 2, apart, gap[i]])
        if gap[i] == 0:
            roots = [0.0] if apart < 0 else [-2 * apart / bend] if bend < 0 else []  # it parts, and may come back
        real = [root.real for root in np.atleast_1d(roots) if abs(np.imag(root)) < 1e-12 and np.real(root) >= 0]
        expected = min([5.0, *real]) if i in watched else 5.0
        compared += expected < 5
        # of a double root some half of the digits would be left; there is none here
        assert found[i] == pytest.approx(expected, rel=1e-9, abs=1e-12), i
    assert compared > 20


def test_a_flight_ends_when_its_fastest_body_has_turned_far():
    nothing = Contacts(*np.zeros((2, 0), dtype=int), *np.zeros((2, 0, 3)), np.zeros(0), np.zeros(0, dtype=int))
    rows = contact_rows(nothing, np.zeros((4, 3)), np.ones(4), np.tile(np.eye(3), (4, 1, 1)))
    spin = np.array([(0, 3.0, 4.0), (1.0, 0, 0), (0, 0, 0.5), (0, 0, 0)])
    flight = Flight(np.zeros((4, 3)), spin, np.zeros((4, 3)), np.zeros((4, 3)))
    found = until_next(nothing, rows, np.zeros(0, dtype=int), flight, np.array([0, 0, 1, 2]), np.array([2.0, 0.4, 2.0]))
    # A quarter of a radian at 5 rad/s; at 0.5 rad/s it would take longer than what is left, and the last does not turn
    np.testing.assert_allclose(found, [TURN / 5, 0.4, 2.0], rtol=1e-15)


def test_coefficients_in_time_order_are_those_of_the_two_materials():
    # Balls of three materials, each over a floor of a fourth in a group of its own, are struck at once and slide on
    e, mu = np.full((2, 4, 4), 0.9)
    e[3, :3] = e[:3, 3] = 0.6, 0.4, 0.5
    mu[3, :3] = mu[:3, 3] = 0.05, 0.1, 0.0
    count, floor = 3, ("half-space", UP)
    bodies = make_bodies(
        [floor, ("sphere", 0.1)] * count,
        [np.inf, 1] * count,
        0.004 * np.ones(3),
        e,
        mu,
        material=[3, 0, 3, 1, 3, 2],
        group=[0, 0, 1, 1, 2, 2],
    )
    state = make_state([(0, 0, 0), (0, 0, 0.1)] * count, velocity=[(0, 0, 0), (4, 3, -1)] * count)
    after, _, _ = advance_world(bodies, state, (0, 0, 0), 1e-9, Rules(response="in time order"))
    for material in range(count):
        kept = 1 - mu[material, 3] * (1 + e[material, 3]) / 5  # of a slip of 5 m/s
        # a few roundings
        expected = np.array([4 * kept, 3 * kept, e[material, 3]])
        assert after.velocity[2 * material + 1] == pytest.approx(expected, abs=1e-14)


def test_what_does_not_touch_flies_on_when_no_look_is_left():
    bodies = make_bodies([("sphere", 0.1)] * 3, 1.0, 0.004 * np.ones(3), 0.5)
    state = make_state([(0, 0, 0), (0.25, 0, 0), (0.45, 0, 0)], velocity=[(1, 0, 0), (0, 0.2, 0), (-3, 0, 0)])
    nothing = np.zeros((3, 3))
    after, impacts = step_in_time_order(bodies, state, nothing, nothing, 0.1, Rules(response="in time order", looks=0))
    assert impacts == 0
    # The other two touch, and lose their approach without rebound; rounding
    np.testing.assert_allclose(after.velocity, [(1, 0, 0), (-1.5, 0.2, 0), (-1.5, 0, 0)], atol=1e-15)
    np.testing.assert_allclose(after.position, state.position + 0.1 * after.velocity, atol=1e-15)


@pytest.mark.parametrize("response", ["sequential", "simultaneous", "in time order"])
def test_a_torque_rolls_a_ball_with_what_its_contact_point_feels(response):
    # About the point that touches, I + m r² = 7/5 m r²
    bodies = make_bodies([("sphere", 0.1), ("half-space", UP)], [2.0, np.inf], 0.008 * np.ones(3), 0.0, 0.5)
    state, dt, torque = make_state([(0, 0, 0.1), (0, 0, 0)]), 0.02, np.array([0.03, -0.05, 0])
    after, _, _ = advance_world(
        bodies, state, -9.81 * UP, dt, Rules(response=response, directions=64), torque=[torque, (0, 0, 0)]
    )
    spin = dt * torque / (7 / 5 * 2 * 0.1**2)
    # sweeps end at changes of 1e-6; one of 64 directions is within 0.12 % of friction
    tolerance = 2e-3 if response == "simultaneous" else 1e-5
    np.testing.assert_allclose(after.angular_velocity[0], spin, atol=tolerance * np.linalg.norm(spin))
    np.testing.assert_allclose(after.velocity[0], np.cross(spin, 0.1 * UP), atol=tolerance * 0.1 * np.linalg.norm(spin))


def test_a_slow_ball_that_is_held_comes_nearer_but_not_too_near():
    # Free, it would fall by 2 mm. Held by a constant force it gains gap/Δt, and so it goes half of its gap of 0.5 mm
    bodies = make_bodies([("sphere", 0.1), ("half-space", UP)], [2.0, np.inf], 0.008 * np.ones(3), 0.5)
    state, rules = make_state([(0, 0, 0.1005), (0, 0, 0)]), Rules(response="in time order")
    after, *_ = advance_world(bodies, state, -9.81 * UP, 0.02, rules)
    assert after.position[0, 2] - 0.1 == pytest.approx(0.00025, abs=1e-12)


def test_balls_one_upon_another_are_held_in_time_order():
    # Each takes what the next one above it leaves; no two contacts of one ball take their turn at once
    shapes, heights = [("half-space", UP), *[("sphere", 0.1)] * 6], np.array([0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.1])
    bodies = make_bodies(shapes, [np.inf, 1.0, 3.0, 2.0, 0.5, 1.5, 1.0], 0.01 * np.ones(3), 0.5)
    start = make_state(heights[:, None] * UP)
    state, rules = start, Rules(response="in time order", sweeps=2000, tolerance=1e-13)
    for _ in range(2):
        state, *_ = advance_world(bodies, state, -9.81 * UP, 0.02, rules)
    # without what holds them, they would fall by 8 mm
    np.testing.assert_allclose(state.position, start.position, atol=1e-9)
    np.testing.assert_allclose(state.velocity, 0, atol=1e-9)


@pytest.mark.parametrize("speed", [0.0, 1.0])
def test_a_box_on_a_rough_slope_is_held_or_slides_in_time_order(speed):
    # Its four places share the box, and each takes what the others leave; tan 0.3 lies between μ_k and μ_s
    angle, half, dt = 0.3, np.array([0.3, 0.2, 0.1]), 0.01
    lean = (np.cos(angle / 2), 0, np.sin(angle / 2), 0)
    normal, down = np.array([np.sin(angle), 0, np.cos(angle)]), np.array([np.cos(angle), 0, -np.sin(angle)])
    between = np.array([[0, 1], [1, 0]])  # of the two materials; there is no friction between two of a kind
    shapes, moments = [("box", half), ("half-space", normal)], np.array([0.033, 0.067, 0.087])
    bodies = make_bodies(shapes, [2.0, np.inf], moments, 0.5, 0.2 * between, 0.5 * between, material=[0, 1])
    state = make_state([0.1 * normal, (0, 0, 0)], [lean, (1, 0, 0, 0)], velocity=[speed * down, (0, 0, 0)])
    rules = Rules(response="in time order", sweeps=500, tolerance=1e-12)
    gained = dt * 9.81 * (np.sin(angle) - 0.2 * np.cos(angle)) if speed else 0.0
    place = state.position[0]
    for count in (1, 2):
        state, *_ = advance_world(bodies, state, -9.81 * UP, dt, rules)
        place = place + dt * (speed + gained * (count - 0.5)) * down
        # the sweeps leave 1e-12 of the weight
        np.testing.assert_allclose(state.velocity[0], (speed + count * gained) * down, atol=1e-9)
        np.testing.assert_allclose(state.position[0], place, atol=1e-9)


def test_a_corner_that_slides_in_time_order_is_braked_against_its_slip():
    # Friction turns the body too, and changes how hard it presses; Coulomb's law holds between the two all the same
    corners = np.array([(-0.4, 0.0, -0.3), (0.4, 0.05, 0.3), (0.4, -0.05, 0.3), (0.35, 0.0, 0.35)])
    faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    loaded = ("compound", [(("polyhedron", corners, faces), (0, 0, 0), (1, 0, 0, 0))])
    bodies = make_bodies([loaded, ("half-space", UP)], [2.0, np.inf], np.full(3, 1 / 6), 0.0, 0.3)
    state, dt = make_state([(0, 0, 0.3), (0, 0, 0)], velocity=[(2.0, 1.5, 0), (0, 0, 0)]), 1e-5
    after, *_ = advance_world(
        bodies, state, -9.81 * UP, dt, Rules(response="in time order", sweeps=500, tolerance=1e-13)
    )
    force = 2.0 * ((after.velocity[0] - state.velocity[0]) / dt + 9.81 * UP)
    assert force[2] > 1
    # in such a step the slip changes by 1e-4 of itself
    np.testing.assert_allclose(force[:2], -0.3 * force[2] * np.array([0.8, 0.6]), rtol=1e-3)


def test_a_flight_that_ends_in_an_overlap_is_backed_up_to_its_start():
    # Arms that turn into fixed balls, each in a group of its own: early, late and not at all; the last one rests on its
    # ball, a little too deep, which is no reason to back up
    spin, first, share = 0.2, 2 * np.arcsin(0.1), np.array([0.3, 0.7, 1.2, -1e-5])
    arm, count = ("compound", [(("sphere", 0.1), (1.0, 0, 0), (1.0, 0, 0, 0))]), 4
    group = np.repeat(np.arange(count), 2)
    bodies = make_bodies([arm, ("sphere", 0.1)] * count, [1.0, np.inf] * count, np.ones(3), group=group)
    angle = first + spin * share  # from the arm to the fixed ball
    place = np.zeros((2 * count, 3))
    place[1::2] = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    state, none = make_state(place), np.zeros((2 * count, 3))
    turning = none.copy()
    turning[:6:2, 2] = spin
    flight, touching = Flight(none, turning, none, none), find_contacts(bodies, state)
    assert touching.body_b.tolist() == [7]
    # What was near before is this contact, alone or after one that is gone; or only that one, and the overlap is new
    gone = Contacts(np.array([4]), np.array([5]), np.zeros((1, 3)), UP[None], np.ones(1), np.zeros(1, dtype=int))
    both = Contacts(*(np.concatenate(parts) for parts in zip(gone, touching, strict=True)))
    for near, last in ((touching, 1.0), (both, 1.0), (gone, 0.0)):
        found = backed_up(bodies, state, near, np.ones(len(near.key), dtype=bool), flight, group, np.ones(count))
        # An overlap of 1e-10 m counts as touch, at 0.2 m/s
        np.testing.assert_allclose(found, [0.3, 0.7, 1.0, last], atol=1e-9)


def test_a_spike_that_grazes_the_floor_once_in_a_turn_is_met():
    # At 0.8 rad/s its tip is below the floor for no more than 0.4 rad of the 6 rad of one step
    corners = np.array([(-0.5, 0, 0), (0.02, 0.02, 0), (0.02, -0.02, 0.02), (0.02, -0.02, -0.02)])
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    loaded = ("compound", [(("polyhedron", corners, faces), (0, 0, 0), (1, 0, 0, 0))])
    bodies = make_bodies([loaded, ("half-space", UP)], [1.0, np.inf], np.full(3, 0.1), 1.0)
    state = make_state([(0, 0, 0.49), (0, 0, 0)], angular_velocity=[(0, 0.8, 0), (0, 0, 0)])
    after, *_ = advance_world(bodies, state, (0, 0, 0), 7.5, Rules(response="in time order", rest_speed=1e-3))
    arm = np.sqrt(0.5**2 - 0.49**2)
    impulse = 2 * 0.8 * arm / (1 + arm**2 / 0.1)
    # a touch of 1e-10 m, which moves the place of the tip by five times as much
    assert after.velocity[0, 2] == pytest.approx(impulse, abs=1e-8)
    assert after.angular_velocity[0, 1] == pytest.approx(0.8 - arm * impulse / 0.1, abs=1e-8)
