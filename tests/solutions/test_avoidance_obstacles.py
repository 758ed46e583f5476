"""Force fields, tangent points and meetings: what keeps one body off another."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.avoidance import (
    is_in_the_way,
    nearest_approach,
    repelling_force,
    sphere_force,
    steer_around,
    tangent_point,
)
from solutions.detection import signed_distance

RNG_SEED = 1
METRES = st.floats(-100, 100).map(lambda x: round(x, 6))  # no lengths so small that their squares vanish
POINT = st.tuples(METRES, METRES, METRES).map(np.array)
RADIUS = st.floats(0.01, 20)
EAST, NORTH, UP = np.eye(3)


def rotation(rng: np.random.Generator) -> np.ndarray:
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.linalg.det(q)  # a reflection becomes a rotation


def motion(force, start, duration, mass=1.0, drag=0.0, velocity=(0.0, 0.0, 0.0), rtol=1e-10):
    """Flight under a force field from a start, by an integrator that is not ours."""
    integrate = oracle("scipy.integrate")

    def rate(_, state):
        return np.r_[state[3:], (force(state[:3]) - drag * state[3:]) / mass]

    return integrate.solve_ivp(rate, (0, duration), np.r_[start, velocity], method="DOP853", rtol=rtol, atol=1e-10).y


# The force field


@pytest.mark.statement(1, oracle="the work that it does, by quadrature")
def test_reaching_the_surface_costs_a_third_of_strength_times_reach():
    quad = oracle("scipy.integrate").quad
    work = quad(lambda s: repelling_force(s, UP, 6.0, 0.5)[2], 0.0, 2.0, points=[0.5])[0]
    # ∫ F0 (1 − s/R)² ds = F0 R/3; 1e-12: the quadrature of a parabola is exact but for rounding
    assert work == pytest.approx(6.0 * 0.5 / 3, abs=1e-12)


@given(st.floats(-5, 10), st.floats(0, 50), st.floats(0.1, 5))
def test_the_field_falls_from_full_strength_inside_to_zero_at_its_reach(separation, strength, reach):
    force = repelling_force(separation, UP, strength, reach)
    assert force[0] == force[1] == 0
    assert 0 <= force[2] <= strength
    if separation <= 0:
        assert force[2] == strength
    if separation >= reach:
        assert force[2] == 0
    assert force[2] >= repelling_force(separation + 0.01, UP, strength, reach)[2]


def test_at_half_its_reach_the_field_has_a_quarter_of_its_strength():
    assert repelling_force(0.5, EAST, 8.0, 1.0).tolist() == [2.0, 0.0, 0.0]
    assert sphere_force((0.0, 0.0, 3.5), (0.0, 0.0, 1.0), 2.0, 8.0, 1.0).tolist() == [0.0, 0.0, 2.0]


def test_the_field_begins_without_a_jump_and_without_a_kink():
    strength, reach, step = 3.0, 2.0, 1e-4
    just_inside = repelling_force(reach - step, UP, strength, reach)[2]
    # quadratic in the depth below the reach: no term that is linear in the step; 1e-8: rounding of 1 − s/R at 1e-4
    assert just_inside == pytest.approx(strength * (step / reach) ** 2, rel=1e-8)


def test_the_field_of_a_sphere_points_away_from_its_centre():
    rng = np.random.default_rng(RNG_SEED)
    position, centre, shift = rng.normal(size=(3, 40, 3))
    turn = rotation(rng)
    force = sphere_force(position, centre, 0.8, 5.0, 3.0)
    away = position - centre
    # 1e-14: a few roundings of forces up to 5 N and directions of length 1
    assert np.abs(np.cross(force, away)).max() < 1e-14 * 5 * np.abs(away).max()
    assert np.all(np.sum(force * away, axis=1) >= 0)
    moved = sphere_force(position @ turn.T + shift, centre @ turn.T + shift, 0.8, 5.0, 3.0)
    assert np.abs(moved - force @ turn.T).max() < 1e-13  # shifted coordinates are rounded once more


def test_at_the_centre_of_a_sphere_the_force_is_zero():
    assert sphere_force(EAST, EAST, 1.0, 5.0, 1.0).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.statement(1, oracle="energy: F0 R/3 (1 − s/R)³ of the field becomes motion away from the wall")
def test_a_field_pushes_away_a_body_that_flies_along_a_wall():
    strength, reach, start = 2.0, 1.0, 0.4
    wall = (0.0, 1.0, 0.0)

    def force(position):
        return repelling_force(signed_distance(position, wall, 0.0), wall, strength, reach)

    end = motion(force, (0.0, start, 0.0), 10.0, velocity=(1.0, 0.0, 0.0))[:, -1]
    drift = math.sqrt(2 * strength * reach / 3 * (1 - start / reach) ** 3)
    # The flight along the wall is not touched, that across it ends at the drift. 1e-7: ten steps of the integrator
    # at 1e-10, and one across the reach, where the field's second derivative jumps
    assert end[[0, 3]] == pytest.approx([10.0, 1.0], abs=1e-9)
    assert end[4] == pytest.approx(drift, abs=1e-7)
    assert end[1] > reach


@pytest.mark.statement(1, oracle="balance of the two forces, solved by hand")
def test_head_on_a_flier_stops_short_of_its_goal():
    strength, reach, pull = 4.0, 2.0, 1.0
    centre, radius = np.zeros(3), 1.0

    def force(position):
        return sphere_force(position, centre, radius, strength, reach) + pull * EAST  # the goal is far in the east

    path = motion(force, (-6.0, 0.0, 0.0), 60.0, drag=1.0)
    assert np.all(path[[1, 2, 4, 5]] == 0.0)
    balance = reach * (1 - math.sqrt(pull / strength))  # F0 (1 − s/R)² = pull
    assert path[0, -1] == pytest.approx(-radius - balance, abs=1e-7)  # 60 time constants of the drag: only the
    assert abs(path[3, -1]) < 1e-7  # integrator's error is left


def test_half_a_millimetre_aside_the_deadlock_of_one_obstacle_dissolves():
    def force(position):
        return sphere_force(position, np.zeros(3), 1.0, 4.0, 2.0) + EAST

    assert motion(force, (-6.0, 5e-4, 0.0), 60.0, drag=1.0)[0, -1] > 5.0


@pytest.mark.statement(1, oracle="brentq for the place where the pull balances two fields")
def test_two_obstacles_trap_a_flier_before_a_gap_that_is_wide_enough():
    brentq = oracle("scipy.optimize").brentq
    posts = np.array([[0.0, 1.5, 0.0], [0.0, -1.5, 0.0]])  # radius 1: the gap is 1 m wide

    def force(position):
        return sphere_force(position, posts, 1.0, 4.0, 2.0).sum(axis=0) + EAST

    def axial(x):
        distance = math.hypot(x, 1.5)
        return 1 + 2 * 4 * max(0, 1 - (distance - 1) / 2) ** 2 * x / distance

    trap = brentq(axial, -2.5, -1.0)
    for aside in (0.0, 0.3, -0.5):
        path = motion(force, (-6.0, aside, 0.0), 60.0, drag=1.0)
        assert path[:2, -1] == pytest.approx([trap, 0.0], abs=1e-6)  # at rest but for the integrator's error


@pytest.mark.statement(1, oracle="symmetry")
def test_halfway_between_two_obstacles_their_forces_cancel():
    for gap in (2.0, 0.2, 0.0, -0.5):  # the last two leave no way through at all
        posts = np.array([[0.0, 1.0 + gap / 2, 0.0], [0.0, -1.0 - gap / 2, 0.0]])
        each = sphere_force(np.zeros(3), posts, 1.0, 4.0, 2.0)
        assert np.all(np.abs(each[:, 1]) >= 1.0)  # each pushes with a quarter of its strength or more
        assert each.sum(axis=0).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.erratum(1)
def test_only_a_field_without_a_range_moves_the_goal():
    goal, obstacle = np.zeros(3), 3.0 * EAST

    def at_rest(field):
        path = motion(lambda p: (goal - p) + field(p), (-1.0, 0.0, 0.0), 60.0, drag=2.0)
        return path[0, -1]

    # A spring of 1 N/m to the goal and 4 N m²/r² from 3 m away balance where x (3 − x)² = −4: x = −0.35530…
    (balance,) = (root.real for root in np.roots([1, -6, 9, 4]) if abs(root.imag) < 1e-12)
    assert at_rest(lambda p: as_printed.force_field(p, obstacle, 4.0)) == pytest.approx(balance, abs=1e-6)
    assert balance == pytest.approx(-0.3553, abs=5e-5)  # as the lesson prints it
    assert at_rest(lambda p: sphere_force(p, obstacle, 1.0, 4.0, 1.5)) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: repelling_force(1.0, (0.0, 0.0, 2.0), 1.0, 1.0), "normal must have length 1, not 2"),
        (lambda: repelling_force(1.0, UP, -1.0, 1.0), "strength must be zero or positive, not -1"),
        (lambda: repelling_force(1.0, UP, 1.0, 0.0), "reach must be positive, not 0"),
        (lambda: sphere_force(UP, EAST, -0.5, 1.0, 1.0), "radius must be zero or positive, not -0.5"),
        (lambda: tangent_point(UP, EAST, EAST, 0.0), "radius must be positive, not 0"),
        (lambda: is_in_the_way(UP, EAST, EAST, [1.0, math.nan]), "radius must be positive, not nan"),
        (lambda: steer_around(UP, EAST, EAST, NORTH, -1.0), "radius must be positive, not -1"),
        (lambda: nearest_approach(UP, EAST, EAST, NORTH, -1.0), "radius_a must be zero or positive, not -1"),
        (lambda: nearest_approach(UP, EAST, EAST, NORTH, 1.0, -1.0), "radius_b must be zero or positive, not -1"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, complaint):
    with pytest.raises(ValueError, match=complaint):
        call()


@pytest.mark.parametrize(
    ("call", "names"),
    [
        (lambda p, c: sphere_force(p, c, 1.0, 1.0, 1.0), ["position", "centre"]),
        (lambda p, h, c: tangent_point(p, h, c, 1.0), ["position", "heading", "centre"]),
        (lambda p, g, c: is_in_the_way(p, g, c, 1.0), ["position", "goal", "centre"]),
        (lambda p, v, g, c: steer_around(p, v, g, c, 1.0), ["position", "velocity", "goal", "centre"]),
        (nearest_approach, ["position_a", "velocity_a", "position_b", "velocity_b"]),
    ],
)
def test_vectors_without_three_numbers_are_refused_by_name(call, names):
    for place, name in enumerate(names):
        for wrong, complaint in (
            ((1.0, math.nan, 0.0), f"{name} must be finite, not nan"),
            ((1.0, 2.0), rf"{name} must have shape \(..., 3\), not \(2,\)"),
        ):
            vectors = [np.array([1.0, 2.0, float(k)]) for k in range(len(names))]
            vectors[place] = wrong
            with pytest.raises(ValueError, match=complaint):
                call(*vectors)


# The tangent point


@pytest.mark.statement(1, oracle="a tangent touches the sphere at a right angle to its radius")
@given(POINT, POINT, POINT, RADIUS)
def test_the_line_to_the_tangent_point_meets_its_radius_at_a_right_angle(position, heading, centre, radius):
    distance = np.linalg.norm(centre - position)
    assume(distance > radius)
    point = tangent_point(position, heading, centre, radius)
    rounding = 1e-13 * (1 + distance + np.abs(centre).max())  # some hundred roundings of the largest coordinate
    assert np.linalg.norm(point - centre) == pytest.approx(radius, abs=rounding)
    assert (point - centre) @ (point - position) == pytest.approx(0, abs=rounding * (radius + distance))


@pytest.mark.statement(1, oracle="the lecture's k, t and s, worked out for a 3-4-5 triangle")
def test_from_five_metres_a_sphere_of_three_is_touched_after_four():
    point = tangent_point((0.0, 0.0, 0.0), (1.0, 0.1, 0.0), (5.0, 0.0, 0.0), 3.0)
    # L = 5, r = 3: k = 4, t = 9/5 short of the centre, s = 12/5 to the side
    assert point == pytest.approx([3.2, 2.4, 0.0], abs=1e-15)
    assert np.linalg.norm(point) == pytest.approx(4.0, abs=1e-15)


@pytest.mark.statement(1, oracle="the other points of the circle of tangent points, sampled")
@given(POINT, POINT, POINT, RADIUS)
def test_the_tangent_point_is_the_one_with_the_smallest_turn(position, heading, centre, radius):
    towards = centre - position
    distance, size = np.linalg.norm(towards), np.linalg.norm(heading)
    assume(distance > 1.001 * radius)
    assume(size > 1e-3)
    assume(np.linalg.norm(np.cross(heading, towards)) > 1e-6 * size * distance)  # a side is named
    way = tangent_point(position, heading, centre, radius) - position
    ahead = towards / distance
    across = np.linalg.svd(ahead[None])[2][1:]  # two directions across the line to the centre
    angle = np.linspace(0, 2 * np.pi, 721)
    sine = radius / distance
    others = math.sqrt(1 - sine**2) * ahead + sine * (np.c_[np.cos(angle), np.sin(angle)] @ across)
    best = (others @ heading).max() / size
    # 1e-9: rounding where the ring of tangents is seen almost edge-on
    assert way @ heading / np.linalg.norm(way) / size >= best - 1e-9


def test_the_tangent_point_turns_and_moves_with_the_scene():
    rng = np.random.default_rng(RNG_SEED)
    position, heading, centre, shift = rng.normal(size=(4, 50, 3))
    turn = rotation(rng)
    here = tangent_point(position, heading, centre, 0.2)
    there = tangent_point(position @ turn.T + shift, heading @ turn.T, centre @ turn.T + shift, 0.2)
    assert np.abs(there - (here @ turn.T + shift)).max() < 1e-12  # metres, rounded some hundred times


def test_a_heading_that_favours_no_side_gives_the_left_seen_from_above():
    ahead = np.array([5.0, 0.0, 0.0])
    for heading in (EAST, -EAST, np.zeros(3), EAST + 1e-12 * UP):  # at it, away from it, at rest, all but at it
        assert tangent_point(np.zeros(3), heading, ahead, 3.0) == pytest.approx([3.2, 2.4, 0.0], abs=1e-15)


def test_a_sphere_straight_above_or_below_is_passed_on_the_side_of_x():
    for vertical in (UP, -UP):
        point = tangent_point(np.zeros(3), vertical, 5 * vertical, 3.0)
        assert point == pytest.approx(3.2 * vertical + 2.4 * EAST, abs=1e-15)


def test_from_inside_the_tangent_point_is_the_nearest_surface_point():
    centre = np.array([1.0, 2.0, 3.0])
    assert tangent_point(centre + 0.5 * NORTH, EAST, centre, 2.0) == pytest.approx(centre + 2 * NORTH, abs=1e-15)
    assert tangent_point(centre, EAST, centre, 2.0) == pytest.approx(centre + 2 * UP, abs=1e-15)
    on_the_surface = centre - 2 * EAST
    assert tangent_point(on_the_surface, NORTH, centre, 2.0) == pytest.approx(on_the_surface, abs=1e-15)


def test_the_tangent_point_keeps_its_digits_next_to_the_sphere():
    gap = 2.0**-40
    point = tangent_point(np.zeros(3), NORTH, (1 + gap) * EAST, 1.0)
    with localcontext() as context:
        context.prec = 60
        distance = Decimal(1) + Decimal(gap)
        aside = (1 - 1 / distance**2).sqrt()
    # √(r² − t²) from doubles would keep four digits here: 1 − t² is 1.8e-12
    assert point[1] == pytest.approx(float(aside), rel=1e-15)


# In the way, and around it


def test_a_sphere_is_in_the_way_only_between_position_and_goal():
    start, goal = np.zeros(3), 10 * EAST
    centres = np.array([5 * EAST, -2 * EAST, 12 * EAST, 5 * EAST + 1.5 * UP, -0.5 * EAST, 10.5 * EAST])
    # between; behind; beyond the goal; beside the way; around the start; around the goal
    assert is_in_the_way(start, goal, centres, 1.0).tolist() == [True, False, False, False, True, True]


def test_a_way_that_only_touches_the_sphere_is_free():
    assert not is_in_the_way(np.zeros(3), 10 * EAST, 5 * EAST + UP, 1.0)
    assert is_in_the_way(np.zeros(3), 10 * EAST, 5 * EAST + UP, np.nextafter(1.0, 2.0))


def test_whether_the_way_is_blocked_does_not_depend_on_the_scale():
    for scale in (1e-3, 0.5, 1.0, 1e3):
        assert is_in_the_way(np.zeros(3), scale * EAST, 0.5 * scale * EAST, 0.1 * scale)
        assert not is_in_the_way(np.zeros(3), scale * EAST, scale * (0.5 * EAST + 0.2 * UP), 0.1 * scale)


def test_at_the_goal_only_a_sphere_around_it_is_in_the_way():
    assert is_in_the_way(EAST, EAST, [EAST, 3 * EAST], 1.0).tolist() == [True, False]


@given(POINT, POINT, POINT, RADIUS)
def test_a_sphere_is_in_the_way_if_a_walk_along_it_runs_into_it(position, goal, centre, radius):
    walk = position + np.linspace(0, 1, 2001)[:, None] * (goal - position)
    nearest = np.linalg.norm(walk - centre, axis=1).min()
    stride = np.linalg.norm(goal - position) / 2000
    assume(not radius < nearest <= radius + stride)  # the walk might step over the edge
    assume(abs(nearest - radius) > 1e-9)  # or the answer hang on rounding
    assert is_in_the_way(position, goal, centre, radius) == (nearest < radius)


@pytest.mark.statement(1, oracle="tangent_point, whose formula is another")
@given(POINT, POINT, POINT, POINT, RADIUS)
def test_the_direction_around_a_sphere_leads_to_its_tangent_point(position, velocity, goal, centre, radius):
    to_goal, towards = goal - position, centre - position
    direction = steer_around(position, velocity, goal, centre, radius)
    if not is_in_the_way(position, goal, centre, radius):
        size = np.linalg.norm(to_goal)
        assert direction == pytest.approx(to_goal / size if size > 0 else np.zeros(3), abs=1e-15)
        return
    distance = np.linalg.norm(towards)
    assume(distance > 1.001 * radius)
    lateral = np.linalg.norm(np.cross(velocity, towards)) / distance
    assume(lateral > 1e-6 * np.linalg.norm(velocity))
    way = tangent_point(position, velocity, centre, radius) - position
    assert direction == pytest.approx(way / np.linalg.norm(way), abs=1e-10)  # k as small as 4 % of r: some digits go


def test_at_rest_or_head_on_it_takes_the_side_of_the_goal():
    centre = 5 * EAST
    below = (10.0, 0.0, -1.0)
    for velocity in (np.zeros(3), EAST, -EAST):
        assert steer_around(np.zeros(3), velocity, below, centre, 3.0) == pytest.approx([0.8, 0.0, -0.6], abs=1e-15)
        behind = steer_around(np.zeros(3), velocity, 10 * EAST, centre, 3.0)
        assert behind == pytest.approx([0.8, 0.6, 0.0], abs=1e-15)
    # a velocity that names a side goes before the goal
    assert steer_around(np.zeros(3), -NORTH, below, centre, 3.0) == pytest.approx([0.8, -0.6, 0.0], abs=1e-15)


def test_obstacles_behind_and_beyond_the_goal_do_not_turn_the_flier():
    for centre in (-3 * EAST, 8 * EAST, 2 * EAST + 5 * UP):
        assert steer_around(np.zeros(3), NORTH, 4 * EAST, centre, 2.0).tolist() == [1.0, 0.0, 0.0]


def test_inside_the_sphere_the_way_leads_straight_out():
    assert steer_around(0.5 * NORTH, EAST, 9 * EAST, np.zeros(3), 2.0).tolist() == [0.0, 1.0, 0.0]
    assert steer_around(np.zeros(3), NORTH, 9 * EAST, np.zeros(3), 2.0).tolist() == [1.0, 0.0, 0.0]
    assert steer_around(np.zeros(3), NORTH, np.zeros(3), np.zeros(3), 2.0).tolist() == [0.0, 0.0, 0.0]


def test_on_the_surface_the_way_around_is_along_it():
    assert steer_around(-EAST, UP, 9 * EAST, np.zeros(3), 1.0).tolist() == [0.0, 0.0, 1.0]


def test_at_the_goal_the_direction_is_zero():
    assert steer_around(EAST, NORTH, EAST, 9 * EAST, 1.0).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.statement(1, oracle="the shortest way around a ball: two tangents and an arc")
@pytest.mark.parametrize("stride", [1e-2, pytest.param(2e-3, marks=pytest.mark.weekly)])
def test_steering_by_tangent_points_flies_the_shortest_way_around(stride):
    radius, goal = 1.0, np.array([4.0, 0.0, 0.0])
    position = np.array([-3.0, 0.0, 0.0])
    direction, flown, nearest = EAST, 0.0, math.inf
    while np.linalg.norm(goal - position) > stride:
        direction = steer_around(position, direction, goal, np.zeros(3), radius)
        position = position + stride * direction
        flown += stride
        nearest = min(nearest, np.linalg.norm(position))
    flown += np.linalg.norm(goal - position)
    tangents = math.sqrt(3**2 - 1) + math.sqrt(4**2 - 1)
    arc = math.pi - math.acos(1 / 3) - math.acos(1 / 4)
    # Each stride of h along the arc leaves it by h²/2, less than the next takes back: the way is longer by a part h.
    assert flown == pytest.approx(tangents + arc, abs=2 * stride)
    assert nearest >= 1 - 1e-12  # a stride along a tangent never goes inside; rounding only


# Moving spheres


@pytest.mark.statement(1, oracle="minimize_scalar on the distance")
def test_the_nearest_approach_is_where_the_distance_is_least():
    minimise = oracle("scipy.optimize").minimize_scalar
    rng = np.random.default_rng(RNG_SEED)
    for position_a, velocity_a, position_b, velocity_b in rng.normal(size=(60, 4, 3)):
        time, separation = nearest_approach(position_a, velocity_a, position_b, velocity_b, 0.1, 0.2)

        def squared(t, x=position_a - position_b, u=velocity_a - velocity_b):
            return np.sum((x + u * t) ** 2)

        found = minimise(squared, bounds=(0, 100), method="bounded", options={"xatol": 1e-9})
        assert separation == pytest.approx(math.sqrt(found.fun) - 0.3, abs=1e-7)  # its xatol, 1e-9 s at its floor
        assert time == pytest.approx(found.x, abs=1e-5)  # the least of a parabola is flat: half the digits


def test_bodies_that_part_or_move_together_are_nearest_now():
    assert [float(x) for x in nearest_approach(np.zeros(3), -EAST, 3 * EAST, EAST, 1.0, 0.5)] == [0.0, 1.5]
    assert [float(x) for x in nearest_approach(np.zeros(3), UP, 3 * EAST, UP)] == [0.0, 3.0]
    assert [float(x) for x in nearest_approach(EAST, UP, EAST, UP, 1.0)] == [0.0, -1.0]
    assert [float(x) for x in nearest_approach(np.zeros(3), EAST, 4 * EAST + 3 * UP, -EAST)] == [2.0, 3.0]


@given(POINT, POINT, POINT, POINT, RADIUS, RADIUS)
def test_exchanging_two_bodies_changes_no_nearest_approach(xa, va, xb, vb, ra, rb):
    assert nearest_approach(xa, va, xb, vb, ra, rb)[0] == nearest_approach(xb, vb, xa, va, rb, ra)[0]


def test_a_batch_of_pairs_matches_single_results_and_keeps_its_inputs():
    rng = np.random.default_rng(RNG_SEED)
    arrays = rng.normal(size=(4, 3, 5, 3))
    before = arrays.copy()
    radius = rng.uniform(0.1, 1.0, size=(3, 1))
    together = [
        tangent_point(arrays[0], arrays[1], arrays[2], radius),
        steer_around(*arrays, radius),
        sphere_force(arrays[0], arrays[1], radius, 2.0, 1.0),
        nearest_approach(*arrays, radius)[1],
    ]
    assert np.array_equal(arrays, before)
    for i, j in np.ndindex(3, 5):
        a, b, c, d = arrays[:, i, j]
        r = radius[i, 0]
        alone = [
            tangent_point(a, b, c, r),
            steer_around(a, b, c, d, r),
            sphere_force(a, b, r, 2.0, 1.0),
            nearest_approach(a, b, c, d, r)[1],
        ]
        for many, one in zip(together, alone, strict=True):
            assert np.allclose(many[i, j], one, rtol=1e-14, atol=0)  # sums may be taken in another order
