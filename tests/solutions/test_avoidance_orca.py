"""Reciprocal avoidance: half-planes of permitted velocities, the programme that picks one, and a crowd."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles import oracle

from solutions.avoidance import crowd_step, orca_half_plane, permitted_velocity
from solutions.sweeping import sweep_sphere_sphere

RNG_SEED = 1
SMALL = st.floats(-3, 3).map(lambda x: round(x, 6))
VECTOR = st.tuples(SMALL, SMALL).map(np.array)
RADIUS = st.floats(0.05, 0.8)
ANGLE = st.floats(0, 2 * math.pi)


def turned(vectors, angle):
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray(vectors) @ np.array([[c, s], [-s, c]])


def meets_within(towards, reach, u, horizon):
    """Whether two discs meet within the horizon: by `sweep_sphere_sphere`, judged elsewhere. u: (…, 2)."""
    origin, flat = np.zeros(3), np.zeros((*np.shape(u)[:-1], 1))
    disc = origin, np.append(u, flat, axis=-1), reach
    return np.isfinite(sweep_sphere_sphere(*disc, np.append(towards, 0.0), origin, 0.0, horizon))


# The half-plane


@pytest.mark.statement(1, oracle="the definition: discs meet within the horizon just inside the border, not outside")
@given(VECTOR, VECTOR, VECTOR, RADIUS, RADIUS, st.floats(0.5, 8))
def test_a_takes_half_the_way_to_the_nearest_velocity_without_collision(va, vb, towards, ra, rb, tau):
    reach, distance = ra + rb, np.linalg.norm(towards)
    assume(distance > 1.01 * reach)
    point, normal = orca_half_plane((0, 0), va, ra, towards, vb, rb, tau, 0.1)
    assert np.linalg.norm(normal) == pytest.approx(1, abs=1e-14)
    change, u = 2 * (point - va), va - vb
    border = u + change
    step = 1e-4
    assert not meets_within(towards, reach, border + step * normal, tau)
    assert meets_within(towards, reach, border - step * normal, tau)
    size = np.linalg.norm(change)
    assume(size > 1e-2)
    assert abs(change @ normal) == pytest.approx(size, rel=1e-12)  # the change is along the normal
    inside = meets_within(towards, reach, u, tau)
    assert inside == (change @ normal > 0)
    ring = np.linspace(0, 2 * np.pi, 73)
    nearer = u + 0.999 * size * np.c_[np.cos(ring), np.sin(ring)]  # no border is crossed any nearer
    assert np.all(meets_within(towards, reach, nearer, tau) == inside)


@pytest.mark.statement(1, oracle="navground 0.7, which runs RVO2, in single precision")
def test_the_half_planes_are_those_of_navground():
    core = oracle("navground.core")
    rng = np.random.default_rng(RNG_SEED)
    checked = 0
    for pa, va, vb, offset in rng.normal(size=(300, 4, 2)):
        ra, rb = rng.uniform(0.05, 0.6, 2)
        pb = pa + 2 * offset
        if np.linalg.norm(pb - pa) < 1.01 * (ra + rb):
            continue  # navground treats an overlap in a way of its own
        (line,) = navground(core, pa, va, ra, [(pb, rb, vb)], 4.0).lines
        point, normal = orca_half_plane(pa, va, ra, pb, vb, rb, 4.0, 0.1)
        # 1e-5: single precision, 6e-8, over legs k that may be a seventh of the distance, k² = L² − R², and more
        assert point == pytest.approx(line.point, abs=1e-5)
        assert (normal[1], -normal[0]) == pytest.approx(line.direction, abs=1e-5)
        checked += 1
    assert checked > 200


def navground(core, position, velocity, radius, neighbours, horizon, wish=(1.5, 0.0), most=100):
    """A behaviour of navground that has just been asked for its command."""
    speed = float(np.linalg.norm(wish))
    kinematics = core.kinematics.OmnidirectionalKinematics(max_speed=speed, max_angular_speed=1.0)
    behavior = core.behaviors.ORCABehavior(kinematics, radius)
    behavior.time_horizon, behavior.horizon, behavior.safety_margin = horizon, 1e3, 0.0
    behavior.max_number_of_neighbors = most
    behavior.position, behavior.velocity, behavior.optimal_speed = position, velocity, speed
    behavior.target = core.Target.Direction(np.asarray(wish) / speed)
    behavior.environment_state.neighbors = [
        core.Neighbor(place, size, moving, index) for index, (place, size, moving) in enumerate(neighbours)
    ]
    behavior.chosen = behavior.compute_cmd(0.1).velocity
    return behavior


@given(VECTOR, VECTOR, VECTOR, VECTOR, RADIUS, RADIUS)
def test_b_does_the_other_half_of_the_same_change(pa, va, pb, vb, ra, rb):
    assume(np.linalg.norm(pb - pa) > 1e-3)
    assume(abs(np.cross(np.append(pb - pa, 0), np.append(va - vb, 0))[2]) > 1e-9)  # head-on rounding picks the side
    point_a, normal_a = orca_half_plane(pa, va, ra, pb, vb, rb, 3.0, 0.1)
    point_b, normal_b = orca_half_plane(pb, vb, rb, pa, va, ra, 3.0, 0.1)
    # 1e-7: next to the axis of the cone rounding of 1e-16 is divided by as little as 1e-9
    assert normal_b == pytest.approx(-normal_a, abs=1e-7)
    assert point_b - vb == pytest.approx(-(point_a - va), abs=1e-7)


@given(VECTOR, VECTOR, VECTOR, VECTOR, RADIUS, RADIUS, ANGLE)
def test_the_half_plane_turns_and_moves_with_the_scene(pa, va, pb, vb, ra, rb, angle):
    assume(np.linalg.norm(pb - pa) > 1e-3)
    w = va - vb - (pb - pa) / 3.0
    assume(abs(w[0] * (pb - pa)[1] - w[1] * (pb - pa)[0]) > 1e-6)  # rounding must not pick the side of the cone
    assume(abs(np.linalg.norm(pb - pa) - ra - rb) > 1e-6)  # nor whether they overlap
    point, normal = orca_half_plane(pa, va, ra, pb, vb, rb, 3.0, 0.1)
    drift = np.array([0.3, -0.7])
    args = (turned(pa, angle) + 5, turned(va, angle) + drift, ra, turned(pb, angle) + 5, turned(vb, angle) + drift, rb)
    there, across = orca_half_plane(*args, 3.0, 0.1)
    here = np.sum(normal * point)
    assert across == pytest.approx(turned(normal, angle), abs=1e-6)
    # where disc and leg meet rounding may pick either: their half-planes are the same there
    assert across @ (there - drift) == pytest.approx(here, abs=1e-6 * (1 + abs(here)))


@pytest.mark.statement(1, oracle="a 3-4-5 triangle: sine 3/5 and cosine 4/5 of the cone's half-angle")
def test_head_on_each_turns_to_its_right_by_the_angle_of_the_cone():
    point, normal = orca_half_plane((0, 0), (1, 0), 1.5, (5, 0), (-1, 0), 1.5, 5.0, 0.1)
    assert normal == pytest.approx([-0.6, -0.8], abs=1e-15)
    # u = (2, 0) is 1.2 inside the leg: half of it is A's
    assert point == pytest.approx(np.array([1.0, 0.0]) + 0.6 * normal, abs=1e-15)


def test_the_round_end_of_the_cone_judges_a_slow_relative_velocity():
    # u = (1/2, 0): they would meet after 8 s, beyond the horizon of 4 s. Centre of the disc 5/4, its radius 1/4.
    point, normal = orca_half_plane((0, 0), (0.5, 0), 0.5, (5, 0), (0, 0), 0.5, 4.0, 0.1)
    assert normal == pytest.approx([-1.0, 0.0], abs=1e-15)
    assert point == pytest.approx([0.5 + 0.5 / 2, 0.0], abs=1e-15)  # 1 − 1/2 is left until the border: half of it


@given(VECTOR, VECTOR, st.floats(1e-3, 1), ANGLE, RADIUS, RADIUS, st.floats(0.02, 0.5))
def test_overlapping_discs_just_touch_after_one_step_of_both_halves(va, vb, share, angle, ra, rb, dt):
    reach = ra + rb
    towards = share * reach * np.array([math.cos(angle), math.sin(angle)])
    assume(np.linalg.norm(towards) <= reach)
    point_a, normal = orca_half_plane((0, 0), va, ra, towards, vb, rb, 5.0, dt)
    point_b = vb - (point_a - va)
    after = towards + (point_b - point_a) * dt
    # 1e-12: velocities up to R/dt = 80 m/s, rounded some ten times, for up to half a second
    assert np.linalg.norm(after) == pytest.approx(reach, abs=1e-12)
    assert abs(normal @ after) == pytest.approx(reach, abs=1e-12)


def test_discs_that_touch_may_not_approach_further():
    point, normal = orca_half_plane((0, 0), (1, 0), 0.5, (1, 0), (-1, 0), 0.5, 5.0, 0.1)
    assert normal == pytest.approx([-1.0, 0.0], abs=1e-15)
    assert point == pytest.approx([0.0, 0.0], abs=1e-15)
    # sliding by: the disc about x/dt = (10, 0) counts, as if they overlapped, and lets them part a little on the way
    point, normal = orca_half_plane((0, 0), (0, 1), 0.5, (1, 0), (0, 0), 0.5, 5.0, 0.1)
    assert normal == pytest.approx(np.array([-10.0, 1.0]) / math.sqrt(101), abs=1e-15)
    assert (point - (0, 1)) @ normal == pytest.approx((10 - math.sqrt(101)) / 2, abs=1e-14)


def test_discs_at_one_place_leave_it_in_opposite_directions():
    point, normal = orca_half_plane((2, 3), (0, 0), 0.5, (2, 3), (0, 0), 0.5, 5.0, 0.5)
    assert normal.tolist() == [1.0, 0.0]
    assert point.tolist() == [1.0, 0.0]
    point, normal = orca_half_plane((2, 3), (0, 1), 0.5, (2, 3), (0, 0), 0.5, 5.0, 0.5)
    assert normal.tolist() == [0.0, 1.0]  # apart along the relative velocity, where there is one
    position, _ = crowd_step([[2, 3], [2, 3]], np.zeros((2, 2)), np.zeros((2, 2)), 0.5, 10.0, 5.0, 0.5)
    assert position.tolist() == [[2.5, 3.0], [1.5, 3.0]]


def test_overlapping_discs_whose_velocities_would_exchange_them_are_parted():
    # u = x/dt: the centre of B would be reached in one step, the centre of the disc of velocities
    point, normal = orca_half_plane((0, 0), (8, 0), 0.5, (0.8, 0), (0, 0), 0.5, 5.0, 0.1)
    assert normal.tolist() == [-1.0, 0.0]
    assert point == pytest.approx([3.0, 0.0], abs=1e-15)  # R/dt = 10, half of it back


def test_two_points_at_one_place_have_a_finite_half_plane():
    for va in ((0.0, 0.0), (1.0, 2.0)):
        for plane in orca_half_plane((1, 1), va, 0.0, (1, 1), (0, 0), 0.0, 2.0, 0.1):
            assert np.all(np.isfinite(plane))


@pytest.mark.parametrize(
    ("args", "complaint"),
    [
        (((0, 0), (1, 0), -1.0, (5, 0), (0, 0), 1.0, 2.0, 0.1), "radius_a must be zero or positive, not -1"),
        (((0, 0), (1, 0), 1.0, (5, 0), (0, 0), math.nan, 2.0, 0.1), "radius_b must be zero or positive, not nan"),
        (((0, 0), (1, 0), 1.0, (5, 0), (0, 0), 1.0, 0.0, 0.1), "horizon must be positive, not 0"),
        (((0, 0), (1, 0), 1.0, (5, 0), (0, 0), 1.0, 2.0, -0.1), "dt must be positive, not -0.1"),
        (((0, 0, 0), (1, 0), 1.0, (5, 0), (0, 0), 1.0, 2.0, 0.1), "position_a must have shape"),
        (((0, 0), (1, math.inf), 1.0, (5, 0), (0, 0), 1.0, 2.0, 0.1), "velocity_a must be finite, not inf"),
        (((0, 0), (1, 0), 1.0, (math.nan, 0), (0, 0), 1.0, 2.0, 0.1), "position_b must be finite, not nan"),
        (((0, 0), (1, 0), 1.0, (5, 0), (0, 0, 1), 1.0, 2.0, 0.1), "velocity_b must have shape"),
    ],
)
def test_a_half_plane_that_makes_no_sense_is_refused(args, complaint):
    with pytest.raises(ValueError, match=complaint):
        orca_half_plane(*args)


# The programme


def scene(rng, count, room):
    """Half-planes at random; their points at most `room` from the origin: a large room leaves little permitted."""
    angle = rng.uniform(0, 2 * np.pi, count)
    normal = np.c_[np.cos(angle), np.sin(angle)]
    return rng.uniform(-1, 1, (count, 2)) * room, normal


def worst_violation(v, point, normal):
    return max(0.0, float(np.max(np.sum((point - v) * normal, axis=-1), initial=0.0)))


def candidates(wish, speed, point, normal):
    """All places where a convex programme of half-planes and a disc can have its optimum: an oracle without order."""
    offset, across = np.sum(normal * point, axis=1), np.c_[-normal[:, 1], normal[:, 0]]
    size = np.linalg.norm(wish)
    yield wish * min(1.0, speed / size) if size > 0 else wish
    for n, b, d in zip(normal, offset, across, strict=True):
        yield b * n + (wish @ d) * d
        if abs(b) <= speed:
            yield from (b * n + sign * math.sqrt(speed**2 - b**2) * d for sign in (-1, 1))
    for i in range(len(normal)):
        for j in range(i):
            pair = normal[[i, j]]
            if abs(np.linalg.det(pair)) > 1e-9:
                yield np.linalg.solve(pair, offset[[i, j]])


@pytest.mark.statement(1, oracle="every vertex, foot and rim point tried")
def test_the_permitted_velocity_is_the_nearest_of_all_candidates():
    rng = np.random.default_rng(RNG_SEED)
    solved = 0
    for _ in range(400):
        count, speed = int(rng.integers(0, 9)), 1.5
        point, normal = scene(rng, count, 0.8)
        wish = rng.normal(size=2)
        # 1e-9: a candidate lies on borders and on the rim but for rounding
        good = [
            c
            for c in candidates(wish, speed, point, normal)
            if np.linalg.norm(c) <= speed + 1e-9 and worst_violation(c, point, normal) <= 1e-9
        ]
        if not good:
            continue
        solved += 1
        best = min(good, key=lambda c: np.linalg.norm(c - wish))
        assert permitted_velocity(wish, speed, point, normal) == pytest.approx(best, abs=1e-12)  # rounding at a corner
    assert solved > 100


@pytest.mark.statement(1, oracle="scipy's SLSQP")
def test_the_permitted_velocity_is_the_one_that_slsqp_finds():
    minimise = oracle("scipy.optimize").minimize
    rng = np.random.default_rng(RNG_SEED)
    for _ in range(60):
        point, normal = scene(rng, 5, 0.3)
        wish, speed = rng.normal(size=2), 1.2
        found = permitted_velocity(wish, speed, point, normal)
        if worst_violation(found, point, normal) > 1e-9:
            continue
        constraints = [
            {"type": "ineq", "fun": lambda v, n=normal, p=point: np.sum((v - p) * n, axis=1)},
            {"type": "ineq", "fun": lambda v, s=speed: s**2 - v @ v},
        ]
        theirs = minimise(lambda v, w=wish: np.sum((v - w) ** 2), np.zeros(2), constraints=constraints, tol=1e-14)
        if theirs.success:
            assert found == pytest.approx(theirs.x, abs=1e-6)  # its tolerance of 1e-14 on a square: a root, and more


@pytest.mark.statement(1, oracle="scipy's linear programme, with the speed limit as a polygon around the disc")
@pytest.mark.parametrize("scenes", [20, pytest.param(60, marks=pytest.mark.weekly)])
def test_where_nothing_is_permitted_the_worst_violation_is_least(scenes):
    linprog = oracle("scipy.optimize").linprog
    rng = np.random.default_rng(RNG_SEED)
    corner = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    rim = np.c_[np.cos(corner), np.sin(corner)]
    infeasible = 0
    for _ in range(scenes):
        point, normal = scene(rng, int(rng.integers(2, 9)), 1.5)
        speed = 1.0
        found = permitted_velocity(rng.normal(size=2), speed, point, normal)
        ours = worst_violation(found, point, normal)
        if ours < 1e-9:
            continue
        infeasible += 1
        # minimise d: n_k·v + d ≥ n_k·p_k, and v within the polygon
        table = np.r_[np.c_[-normal, -np.ones(len(normal))], np.c_[rim, np.zeros(len(rim))]]
        bound = np.r_[-np.sum(normal * point, axis=1), np.full(len(rim), speed)]
        theirs = linprog([0, 0, 1], table, bound, bounds=[(None, None)] * 3)
        # A polygon of 2000 sides reaches out of the disc by 1 − cos(π/2000) = 1.2e-6 of its radius.
        assert theirs.fun - 1e-8 <= ours <= theirs.fun + 2e-6
        assert np.linalg.norm(found) <= speed + 1e-12
    assert infeasible > scenes / 3


@pytest.mark.statement(1, oracle="navground 0.7, which runs RVO2's programme, in single precision")
def test_among_many_neighbours_navground_chooses_the_same_velocity():
    core = oracle("navground.core")
    rng = np.random.default_rng(RNG_SEED)
    feasible = blocked = 0
    for _ in range(200):
        count, angle = int(rng.integers(1, 12)), rng.uniform(0, 2 * np.pi)
        velocity, wish = rng.normal(size=2) * 0.5, 1.5 * np.array([math.cos(angle), math.sin(angle)])
        place, moving = rng.normal(size=(2, count, 2)) * (2.0, 2.0)
        place *= np.maximum(1.0, 0.7 / np.linalg.norm(place, axis=1))[:, None]
        theirs = navground(
            core, (0, 0), velocity, 0.3, [(p, 0.3, v) for p, v in zip(place, moving, strict=True)], 3.0, wish
        )
        point, normal = orca_half_plane((0, 0), velocity, 0.3, place, moving, 0.3, 3.0, 0.1)
        ours = permitted_velocity(wish, 1.5, point, normal)
        if worst_violation(ours, point, normal) < 1e-9:
            feasible += 1
            assert ours == pytest.approx(theirs.chosen, abs=2e-5)  # single precision at borders almost parallel
        else:
            blocked += 1
            worst = worst_violation(np.array(theirs.chosen, dtype=float), point, normal)
            assert worst_violation(ours, point, normal) <= worst + 1e-6  # theirs is in single precision
    assert feasible > 50
    assert blocked > 20


def test_without_half_planes_only_the_speed_limit_counts():
    empty = np.zeros((0, 2))
    assert permitted_velocity((3.0, 4.0), 2.5, empty, empty).tolist() == [1.5, 2.0]
    assert permitted_velocity((0.3, 0.4), 2.5, empty, empty).tolist() == [0.3, 0.4]
    assert permitted_velocity((0.3, 0.4), 0.0, empty, empty).tolist() == [0.0, 0.0]


def test_a_half_plane_that_the_wish_obeys_changes_nothing():
    assert permitted_velocity((1.0, 0.0), 2.0, [(0.0, 0.0)], [(1.0, 0.0)]).tolist() == [1.0, 0.0]
    assert permitted_velocity((0.0, 1.0), 2.0, [(0.0, 0.0)], [(1.0, 0.0)]).tolist() == [0.0, 1.0]


def test_a_wish_behind_borders_moves_to_the_foot_or_to_the_corner():
    down, left = (0.0, -1.0), (-1.0, 0.0)
    assert permitted_velocity((0.5, 1.0), 5.0, [(0.0, 0.25)], [down]).tolist() == [0.5, 0.25]
    assert permitted_velocity((2.0, 1.0), 5.0, [(0.0, 0.25), (0.5, 0.0)], [down, left]).tolist() == [0.5, 0.25]


def test_between_two_opposite_borders_without_room_it_takes_the_middle():
    # v_x ≥ 1 and v_x ≤ −0.5: whoever breaks both alike stands at 0.25
    found = permitted_velocity((0.0, 0.7), 5.0, [(1.0, 0.0), (-0.5, 0.0)], [(1.0, 0.0), (-1.0, 0.0)])
    assert found[0] == pytest.approx(0.25, abs=1e-15)


def test_a_border_beyond_the_speed_limit_is_approached_at_the_limit():
    assert permitted_velocity((0.0, 1.0), 1.0, [(3.0, 0.0)], [(1.0, 0.0)]) == pytest.approx([1.0, 0.0], abs=1e-15)


def test_the_same_half_plane_twice_is_as_good_as_once():
    rng = np.random.default_rng(RNG_SEED)
    point, normal = np.stack([scene(rng, 2, 0.5) for _ in range(300)], axis=1)
    wish, slip = rng.normal(size=(300, 2)), rng.uniform(-3, 3, (300, 2, 1))
    once = permitted_velocity(wish, 1.5, point, normal)
    along = np.stack([-normal[..., 1], normal[..., 0]], axis=-1)
    # the same borders, given by other points on them: rounding may put the copies on either side of them
    again = np.concatenate([point, point + slip * along], axis=1), np.concatenate([normal, normal], axis=1)
    assert permitted_velocity(wish, 1.5, *again) == pytest.approx(once, abs=1e-12)


def test_two_half_planes_that_share_a_border_leave_the_border():
    rng = np.random.default_rng(RNG_SEED)
    for _ in range(100):
        point, normal = scene(rng, 1, 0.5)
        wish, along = rng.normal(size=2) * 0.5, np.array([-normal[0, 1], normal[0, 0]])
        both = np.r_[point, point + 0.7 * along], np.r_[normal, -normal]
        foot = point[0] + ((wish - point[0]) @ along) * along
        if np.linalg.norm(foot) < 1.5:
            assert permitted_velocity(wish, 1.5, *both) == pytest.approx(foot, abs=1e-12)


def test_of_parallel_half_planes_out_of_reach_the_farthest_counts():
    blocked = [(3.0, 0.0), (3.0, 0.0), (2.0, 0.0)], [(1.0, 0.0), (1.0, 0.0), (1.0, 0.0)]
    assert permitted_velocity((0.0, 1.0), 1.0, *blocked) == pytest.approx([1.0, 0.0], abs=1e-15)


@given(st.integers(0, 500), ANGLE)
def test_the_permitted_velocity_turns_with_the_scene_in_any_order(seed, angle):
    rng = np.random.default_rng(seed)
    point, normal = scene(rng, 6, 0.5)
    wish = rng.normal(size=2)
    here = permitted_velocity(wish, 1.3, point, normal)
    order = rng.permutation(6)
    there = permitted_velocity(turned(wish, angle), 1.3, turned(point, angle)[order], turned(normal, angle)[order])
    if worst_violation(here, point, normal) < 1e-12:
        assert there == pytest.approx(turned(here, angle), abs=1e-8)  # corners of borders almost parallel
    else:  # the least violation is one number, though several velocities may have it
        worst = worst_violation(there, turned(point, angle), turned(normal, angle))
        assert worst == pytest.approx(worst_violation(here, point, normal), abs=1e-8)


def test_many_programmes_at_once_are_as_many_one_by_one():
    rng = np.random.default_rng(RNG_SEED)
    wish = rng.normal(size=(3, 20, 2))
    planes = [scene(rng, 7, 1.0) for _ in range(20)]
    point, normal = (np.stack(side) for side in zip(*planes, strict=True))
    together = permitted_velocity(wish, 1.5, point, normal)
    for i, j in np.ndindex(3, 20):
        assert np.allclose(together[i, j], permitted_velocity(wish[i, j], 1.5, *planes[j]), rtol=0, atol=1e-12)


def test_a_programme_that_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="max_speed must be zero or positive, not -1"):
        permitted_velocity((1.0, 0.0), -1.0, [(0.0, 0.0)], [(1.0, 0.0)])
    for point, complaint in (((0.0, math.nan), "point must be finite"), ((0.0, 0.0, 0.0), "point must have shape")):
        with pytest.raises(ValueError, match=complaint):
            permitted_velocity((1.0, 0.0), 1.0, [point], [(1.0, 0.0)])
    with pytest.raises(ValueError, match="normal must have length 1 or 0, not 2"):
        permitted_velocity((1.0, 0.0), 1.0, [(0.0, 0.0)], [(2.0, 0.0)])


# The crowd


def walk(position, goal, seconds, turn=0.0, horizon=4.0, dt=0.1, radius=0.5, speed=1.5):
    """Path of a crowd whose wishes are at most 1 m/s to the goal, turned to the right by an angle; (steps, n, 2)."""
    velocity, path = np.zeros_like(position), [position]
    for _ in range(round(seconds / dt)):
        way = goal - path[-1]
        wish = turned(way / np.maximum(1.0, np.linalg.norm(way, axis=1))[:, None], -turn)
        after, velocity = crowd_step(path[-1], velocity, wish, radius, speed, horizon, dt)
        path.append(after)
    return np.array(path)


def least_gap(path, radius=0.5):
    distance = np.linalg.norm(path[:, :, None] - path[:, None], axis=-1)
    return (distance[:, ~np.eye(path.shape[1], dtype=bool)] - 2 * radius).min()


def ring(count, radius):
    angle = 2 * np.pi * np.arange(count) / count
    return radius * np.c_[np.cos(angle), np.sin(angle)]


@pytest.mark.parametrize("count", [2, 8, pytest.param(16, marks=pytest.mark.weekly)])
def test_a_crowd_that_crosses_a_circle_arrives_without_a_collision(count):
    start = ring(count, 8.0)
    path = walk(start, -start, 30.0, turn=0.2)
    assert least_gap(path) >= -1e-9  # permitted velocities never lead to an overlap; rounding only
    assert np.linalg.norm(path[-1] + start, axis=1).max() < 0.2


def test_a_symmetric_ring_jams_at_its_centre_without_a_collision():
    start = ring(3, 4.0)
    path = walk(start, -start, 20.0)
    assert least_gap(path) >= -1e-9
    creep = np.linalg.norm(path[-1] - path[-11], axis=1).max()  # within a second
    assert creep < 0.02  # they wish for 1 m/s and share out a gap that closes exponentially
    assert np.linalg.norm(path[-1] + start, axis=1).min() > 3.0


def test_two_discs_almost_head_on_pass_on_mirrored_paths():
    start = np.array([[-5.0, 0.0], [5.0, 1e-3]])
    path = walk(start, -start[:, :1] * [1.0, 0.0], 20.0)
    middle = start.mean(axis=0)
    assert path[:80, 1] - middle == pytest.approx(middle - path[:80, 0], abs=5e-3)  # their goals are not mirrored
    assert path[:, 0, 1].min() < -0.4
    assert path[:, 1, 1].max() > 0.4
    assert least_gap(path) >= -1e-9
    assert np.linalg.norm(path[-1] + start, axis=1).max() < 0.1


def test_two_discs_exactly_head_on_stop_in_front_of_each_other():
    start = np.array([[-5.0, 0.0], [5.0, 0.0]])
    path = walk(start, -start, 30.0)
    assert np.all(path[:, :, 1] == 0.0)  # nothing names a side
    assert 0 <= least_gap(path) < 0.1
    assert np.abs(path[-1, :, 0]).max() < 0.6


def test_a_crowd_that_overlaps_comes_apart():
    position = np.random.default_rng(RNG_SEED).uniform(-1, 1, (12, 2))
    velocity = still = np.zeros_like(position)
    assert least_gap(position[None]) < -0.5
    for _ in range(60):
        position, velocity = crowd_step(position, velocity, still, 0.5, 1.5, 4.0, 0.1)
    assert least_gap(position[None]) >= -1e-9


def test_a_disc_alone_or_out_of_reach_follows_its_wish():
    position, velocity = np.array([[0.0, 0.0], [100.0, 0.0]]), np.zeros((2, 2))
    wish = np.array([[1.0, 0.0], [0.0, -0.5]])
    after, moving = crowd_step(position, velocity, wish, 0.5, 1.5, 4.0, 0.1)
    assert np.array_equal(moving, wish)
    assert np.array_equal(after, position + 0.1 * wish)
    assert crowd_step(position[:0], velocity[:0], wish[:0], 0.5, 1.5, 4.0, 0.1)[0].shape == (0, 2)


@given(st.integers(0, 200), ANGLE)
def test_a_crowd_turns_and_renumbers_with_the_scene(seed, angle):
    rng = np.random.default_rng(seed)
    position = 1.2 * np.argwhere(np.ones((4, 4))) + rng.uniform(-0.05, 0.05, (16, 2))  # none overlaps
    velocity, wish = rng.normal(size=(2, 16, 2)) * 0.1
    order = rng.permutation(16)
    here, _ = crowd_step(position, velocity, wish, 0.5, 1.5, 2.0, 0.1)
    there, _ = crowd_step(
        turned(position, angle)[order], turned(velocity, angle)[order], turned(wish, angle)[order], 0.5, 1.5, 2.0, 0.1
    )
    assert there == pytest.approx(turned(here, angle)[order], abs=1e-8)  # corners of borders almost parallel


def test_discs_of_different_sizes_and_speeds_keep_clear_of_each_other():
    rng = np.random.default_rng(RNG_SEED)
    position = 3.0 * np.argwhere(np.ones((4, 4))) + rng.uniform(-0.3, 0.3, (16, 2))
    radius, speed = rng.uniform(0.2, 0.8, 16), rng.uniform(0.5, 2.0, 16)
    velocity, goal = np.zeros((16, 2)), position[rng.permutation(16)]
    for _ in range(150):
        wish = goal - position
        position, velocity = crowd_step(position, velocity, wish, radius, speed, 3.0, 0.1)
        assert np.all(np.linalg.norm(velocity, axis=1) <= speed * (1 + 1e-12))
        distance = np.linalg.norm(position[:, None] - position[None], axis=-1) - radius[:, None] - radius[None]
        assert distance[~np.eye(16, dtype=bool)].min() >= -1e-9


def test_a_crowd_step_changes_no_input_and_refuses_nonsense():
    position, velocity, wish = np.random.default_rng(RNG_SEED).normal(size=(3, 6, 2))
    before = [array.copy() for array in (position, velocity, wish)]
    crowd_step(position, velocity, wish, 0.5, 0.7, 2.0, 0.1)
    assert all(np.array_equal(a, b) for a, b in zip((position, velocity, wish), before, strict=True))
    for change, complaint in (
        ({3: -0.5}, "radius must be zero or positive, not -0.5"),
        ({4: -1.0}, "max_speed must be zero or positive, not -1"),
        ({5: 0.0}, "horizon must be positive, not 0"),
        ({6: 0.0}, "dt must be positive, not 0"),
        ({5: [2.0] * 6}, r"horizon must have shape \(\), not \(6,\)"),
        ({6: [0.1] * 6}, r"dt must have shape \(\), not \(6,\)"),
        ({5: 0.05}, r"horizon must be no shorter than the step, 0.1 s, not 0.05 s"),
        ({1: velocity[:4]}, r"velocity must have the shape \(6, 2\) of the positions, not \(4, 2\)"),
        ({0: np.zeros((6, 3))}, r"position must have shape \(n, 2\), not \(6, 3\)"),
        ({0: np.zeros(2)}, r"position must have shape \(n, 2\), not \(2,\)"),
        ({2: wish * math.nan}, "preferred must be finite, not nan"),
    ):
        args = [position, velocity, wish, 0.5, 0.7, 2.0, 0.1]
        for place, value in change.items():
            args[place] = value
        with pytest.raises(ValueError, match=complaint):
            crowd_step(*args)


def test_many_wishes_speeds_or_borders_are_each_solved_as_if_alone():
    wishes, speeds = np.array([(0.5, 1.0), (2.0, 0.0), (-1.0, -1.0)]), np.array([0.4, 1.0, 3.0])
    point, normal = [(0.0, 0.25), (0.5, 0.0)], [(0.0, -1.0), (-1.0, 0.0)]
    moved = np.array([(0.0, 0.0), (0.1, 0.2), (-0.3, 0.4)])[:, None] + point
    for chosen in ((wishes, 3.0, point), ((0.5, 1.0), speeds, point), ((0.5, 1.0), 3.0, moved)):
        wish, speed, points = (
            np.broadcast_to(value, (3, *shape)) for value, shape in zip(chosen, ((2,), (), (2, 2)), strict=True)
        )
        alone = [permitted_velocity(*each, normal) for each in zip(wish, speed, points, strict=True)]
        np.testing.assert_array_equal(permitted_velocity(*chosen, normal), alone)


def test_large_slow_discs_see_each_other_before_they_touch():
    # 0.15 m between their rims, and 0.2 m to lose within the horizon of 1 s: each may come 0.075 m nearer, no more.
    position, wish = [(-2.075, 0.0), (2.075, 0.0)], np.array([(0.1, 0.0), (-0.1, 0.0)])
    _, velocity = crowd_step(position, wish, wish, 2.0, 0.1, 1.0, 0.1)
    np.testing.assert_allclose(velocity, 0.75 * wish, atol=1e-12)  # rounding of 4 m in a difference of 0.15 m


# Limits of neighbours


def by_brute_force(position, velocity, wish, radius, speed, sight, most, horizon=3.0, dt=0.1):
    """The step of a crowd in which each disc sorts all others by distance."""
    found = np.empty_like(velocity)
    for a, here in enumerate(position):
        away = np.linalg.norm(position - here, axis=1)
        others = sorted((d, b) for b, d in enumerate(away) if b != a and d <= sight[a])
        near = sorted(b for _, b in others[: most[a]])
        planes = orca_half_plane(
            here, velocity[a], radius[a], position[near], velocity[near], radius[near], horizon, dt
        )
        found[a] = permitted_velocity(wish[a], speed[a], *planes)
    return found


@pytest.mark.statement(1, oracle="brute force over all pairs")
def test_a_disc_heeds_only_its_nearest_neighbours_within_its_sight():
    rng = np.random.default_rng(RNG_SEED)
    position, velocity, wish = rng.normal(size=(3, 40, 2)) * np.array([3.0, 0.6, 1.0])[:, None, None]
    radius, speed = rng.uniform(0.05, 0.2, 40), rng.uniform(0.5, 1.5, 40)
    sight, most = rng.uniform(0.5, 4.0, 40), rng.integers(0, 6, 40)
    _, ours = crowd_step(position, velocity, wish, radius, speed, 3.0, 0.1, sight, most)
    assert ours == pytest.approx(by_brute_force(position, velocity, wish, radius, speed, sight, most), abs=1e-9)
    few = crowd_step(position, velocity, wish, radius, speed, 3.0, 0.1, max_neighbours=2)[1]
    all_of_it = by_brute_force(position, velocity, wish, radius, speed, np.full(40, 1e9), np.full(40, 2))
    assert few == pytest.approx(all_of_it, abs=1e-9)
    assert np.linalg.norm(few - ours, axis=1).max() > 0.1


def test_without_limits_of_neighbours_a_crowd_moves_as_before():
    rng = np.random.default_rng(RNG_SEED)
    position, velocity, wish = rng.normal(size=(3, 60, 2))
    plain = crowd_step(position, velocity, wish, 0.1, 1.5, 3.0, 0.1)
    wide = crowd_step(position, velocity, wish, 0.1, 1.5, 3.0, 0.1, neighbour_distance=1e6, max_neighbours=59)
    assert [each.tobytes() for each in plain] == [each.tobytes() for each in wide]
    for blind in ({"max_neighbours": 0}, {"neighbour_distance": 0.0}):
        _, alone = crowd_step(position, velocity, 0.1 * wish, 0.1, 1.5, 3.0, 0.1, **blind)
        assert np.array_equal(alone, 0.1 * wish)
    with pytest.raises(ValueError, match=r"^max_neighbours must be a whole number, not 2\.5$"):
        crowd_step(position, velocity, wish, 0.1, 1.5, 3.0, 0.1, max_neighbours=2.5)
    for name in ("neighbour_distance", "max_neighbours"):
        with pytest.raises(ValueError, match=f"^{name} must be zero or positive, not -1"):
            crowd_step(position, velocity, wish, 0.1, 1.5, 3.0, 0.1, **{name: -1})


def test_of_two_equally_near_neighbours_the_lower_index_counts():
    # Both block the way straight ahead, each from its side
    position = np.array([(0.0, 0.0), (2.0, 0.5), (2.0, -0.5)])
    velocity = np.array([(1.0, 0.0), (0.0, 0.0), (0.0, 0.0)])
    _, found = crowd_step(position, velocity, velocity, 0.4, 1.0, 4.0, 0.1, max_neighbours=1)
    assert found[0, 1] < -0.01  # away from the first
    swapped = position[[0, 2, 1]]
    assert crowd_step(swapped, velocity, velocity, 0.4, 1.0, 4.0, 0.1, max_neighbours=1)[1][0, 1] > 0.01


@pytest.mark.statement(1, oracle="navground 0.7, with RVO2's limit of neighbours, in single precision")
def test_with_a_limit_the_first_disc_chooses_as_navground_does():
    core = oracle("navground.core")
    rng = np.random.default_rng(RNG_SEED)
    compared = differs = 0
    for _ in range(60):
        place, moving = rng.normal(size=(2, 8, 2)) * 2.0
        place *= np.maximum(1.0, 0.7 / np.linalg.norm(place, axis=1))[:, None]
        velocity, angle = rng.normal(size=2) * 0.5, rng.uniform(0, 2 * np.pi)
        wish = 1.5 * np.array([math.cos(angle), math.sin(angle)])
        seen = [(p, 0.3, v) for p, v in zip(place, moving, strict=True)]
        theirs = navground(core, (0, 0), velocity, 0.3, seen, 3.0, wish, most=2)
        crowd = np.r_[[(0.0, 0.0)], place], np.r_[[velocity], moving], np.r_[[wish], moving]
        ours = crowd_step(*crowd, 0.3, [1.5] + 8 * [9.0], 3.0, 0.1, max_neighbours=2)[1][0]
        near = np.argsort(np.linalg.norm(place, axis=1))[:2]
        planes = orca_half_plane((0, 0), velocity, 0.3, place[near], moving[near], 0.3, 3.0, 0.1)
        if worst_violation(ours, *planes) < 1e-9:
            compared += 1
            assert ours == pytest.approx(theirs.chosen, abs=2e-5)  # single precision
            free = crowd_step(*crowd, 0.3, [1.5] + 8 * [9.0], 3.0, 0.1)[1][0]
            differs += np.linalg.norm(free - ours) > 0.05
    assert compared > 30
    assert differs > 10  # the limit matters
