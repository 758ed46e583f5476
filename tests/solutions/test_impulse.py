"""Impulses, first part: velocities at the contact, its normal, its kind, and what a short force leaves behind."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.impulse import (
    COLLIDING,
    RESTING,
    SEPARATING,
    Body,
    apply_impulse_to_momenta,
    classify_contact,
    contact_impulses,
    edge_edge_normal,
    impulse_of_force,
    mean_force,
    normal_velocity,
    point_plane_normal,
    point_velocity,
    rebound_velocity,
    relative_velocity,
    velocities_from_momenta,
)

COMPONENT = st.floats(-10, 10)
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
LONG = VECTOR.filter(lambda vector: np.linalg.norm(vector) > 1e-3)
NORMAL = LONG.map(lambda vector: vector / np.linalg.norm(vector))
RESTITUTION = st.floats(0, 1)
UP = (0.0, 0.0, 1.0)
STILL = (0.0, 0.0, 0.0)


def flying(velocity, spin=STILL, arm=STILL):
    """A body of which only the motion matters."""
    return Body(velocity, spin, arm, 1.0, np.eye(3))


# The velocity of a point


@pytest.mark.statement(14, oracle="arithmetic by hand")
def test_the_rim_of_a_rolling_wheel_is_still_below_and_twice_as_fast_above():
    # 3 m/s along x, radius 0.5 m: it turns about y, towards +x at the top, with 6 rad/s.
    below, hub, above, front = ((0, 0, -0.5), (0, 0, 0), (0, 0, 0.5), (0.5, 0, 0))
    found = point_velocity((3, 0, 0), (0, 6, 0), (below, hub, above, front))
    assert found.tolist() == [[0, 0, 0], [3, 0, 0], [6, 0, 0], [3, 0, -3]]


@pytest.mark.statement(14, oracle="the places of a point a moment before and after")
@given(VECTOR, VECTOR, VECTOR)
def test_the_velocity_of_a_point_is_the_rate_of_its_place(velocity, omega, arm):
    rotation = oracle("scipy.spatial.transform").Rotation
    h = 1e-5
    after, before = (t * velocity + rotation.from_rotvec(t * omega).apply(arm) for t in (h, -h))
    # What central differences leave out is ω³ r h²/6 < 1e-5 × 17³ × 17 × 1e-5/6; rounding is 1e-15 × 17/h
    assert point_velocity(velocity, omega, arm) == pytest.approx((after - before) / (2 * h), abs=5e-6)


@pytest.mark.erratum(14)
def test_as_printed_the_place_of_a_point_ignores_where_the_body_is():
    # p_A = v_A + ω_A × r_A: of a wheel's hub that rolled 30 m in 10 s, 3 "m" for ever. It is the rate of the place.
    printed = point_velocity((3, 0, 0), (0, 6, 0), (0, 0, 0))
    places = [np.array([3.0 * time, 0, 0]) for time in (0, 10)]
    assert printed[0] == (places[1] - places[0])[0] / 10
    assert printed[0] != places[1][0]


@pytest.mark.statement(15, oracle="arithmetic by hand")
def test_a_car_that_catches_up_sees_the_other_come_towards_it():
    behind, ahead = (30.0, 0, 0), (20.0, 0, 0)
    assert relative_velocity(behind, ahead).tolist() == [10, 0, 0]
    assert (
        normal_velocity(flying(behind), flying(ahead), (-1, 0, 0)) == -10
    )  # A is behind: from B to A is backwards; they close


@pytest.mark.erratum(15)
def test_the_reversed_difference_calls_an_approach_a_separation():
    behind, ahead, normal = (30.0, 0, 0), (20.0, 0, 0), np.array([-1.0, 0, 0])
    assert classify_contact(normal @ relative_velocity(behind, ahead)) == COLLIDING
    assert classify_contact(normal @ relative_velocity(ahead, behind)) == SEPARATING


BODY = st.tuples(VECTOR, VECTOR, VECTOR).map(lambda parts: flying(*parts))


@pytest.mark.statement(15, oracle="an observer who moves along")
@given(BODY, BODY, VECTOR, NORMAL)
def test_exchanging_the_bodies_or_the_observer_changes_no_normal_velocity(first, second, observer, normal):
    seen = normal_velocity(*(body._replace(velocity=body.velocity - observer) for body in (first, second)), normal)
    assert seen == pytest.approx(normal_velocity(first, second, normal), abs=1e-12)  # roundings of numbers up to 400
    assert normal_velocity(second, first, -normal) == normal_velocity(first, second, normal)


@pytest.mark.statement(19, oracle="how fast their distance along the normal grows")
@given(BODY, BODY, NORMAL)
def test_the_normal_velocity_is_the_rate_at_which_the_gap_opens(a, b, normal):
    rotation = oracle("scipy.spatial.transform").Rotation
    h = 1e-5

    def gap(time):
        place_a, place_b = (
            time * body.velocity + rotation.from_rotvec(time * body.angular_velocity).apply(body.arm) for body in (a, b)
        )
        return normal @ (place_a - place_b)

    # As for the velocity of a point, for two of them
    assert normal_velocity(a, b, normal) == pytest.approx((gap(h) - gap(-h)) / (2 * h), abs=1e-5)


def test_masses_and_inertias_have_no_part_in_the_normal_velocity():
    spinning, wall = flying(STILL, (0, 2, 0), (0.5, 0, 0)), Body((0, 0, 3), STILL, STILL, 0.0, np.zeros((3, 3)))
    assert normal_velocity(spinning, wall, UP) == -4
    heavy = spinning._replace(inverse_mass=0.0, inverse_inertia=7 * np.eye(3))
    assert normal_velocity(heavy, tuple(wall), UP) == -4


# Restitution and the kinds of contact


@pytest.mark.statement(12, oracle="arithmetic by hand")
def test_bodies_that_close_at_four_metres_per_second_part_at_e_times_that():
    assert rebound_velocity(-4.0, (0, 0.25, 1)).tolist() == [0, 1, 4]


def test_separating_or_grazing_bodies_keep_their_velocity():
    assert rebound_velocity((3.0, 1e-3, 0.0), 0.5).tolist() == [3, 1e-3, 0]


@pytest.mark.erratum(12)
def test_as_printed_a_fraction_of_the_velocity_lets_bodies_interpenetrate():
    assert as_printed.velocity_after_restitution(-4.0, 0.25) == -1.0
    assert classify_contact(as_printed.velocity_after_restitution(-4.0, 0.25)) == COLLIDING
    assert classify_contact(rebound_velocity(-4.0, 0.25)) == SEPARATING


@pytest.mark.statement(21, oracle="the three cases, one by one")
@pytest.mark.parametrize(
    ("u_n", "kind"),
    [(-0.2, COLLIDING), (-0.1, RESTING), (-0.05, RESTING), (0.0, RESTING), (0.1, RESTING), (0.2, SEPARATING)],
)
def test_the_normal_velocity_decides_the_kind_of_a_contact(u_n, kind):
    assert classify_contact(u_n, 0.1) == kind


def test_without_a_threshold_only_a_grazing_contact_rests():
    assert classify_contact((-1e-60, -0.0, 0.0, 1e-60)).tolist() == [COLLIDING, RESTING, RESTING, SEPARATING]


@given(st.floats(-10, 10), st.floats(0, 1))
def test_run_backwards_colliding_bodies_separate_and_resting_ones_rest(u_n, threshold):
    assert classify_contact(-u_n, threshold) == -classify_contact(u_n, threshold)


@pytest.mark.erratum(21)
def test_as_printed_resting_and_separating_are_exchanged():
    approaching, still, leaving = 2.0, 0.0, -2.0  # V_rel of the slide, with n from A to B
    printed = as_printed.contact_kind((approaching, still, leaving), 0.1).tolist()
    assert printed == ["colliding", "separating", "resting"]
    ours = classify_contact((-approaching, -still, -leaving), 0.1).tolist()
    assert ours == [COLLIDING, RESTING, SEPARATING]


@pytest.mark.erratum(21)
def test_as_printed_with_the_normal_from_b_to_a_an_approach_is_resting():
    assert as_printed.contact_kind(-2.0, 0.1) == "resting"
    assert classify_contact(-2.0, 0.1) == COLLIDING


# The contact normal


@pytest.mark.statement(17, oracle="a corner on a table, by hand")
def test_the_normal_of_a_table_points_to_the_cube_whichever_is_body_a():
    table, cube = (0.0, 0, 0), (5.0, 1, 0.7)
    for printed in ((0, 0, 2), (0, 0, -0.5)):
        assert point_plane_normal(printed, cube, table).tolist() == [0, 0, 1]
        assert point_plane_normal(printed, table, cube).tolist() == [0, 0, -1]


@pytest.mark.statement(17, oracle="two crossed bars, by hand")
def test_two_crossed_bars_push_each_other_apart_across_both():
    assert edge_edge_normal((3, 0, 0), (0, 0.5, 0), (0, 0, 1), (0, 0, 0)).tolist() == [0, 0, 1]
    assert edge_edge_normal((3, 0, 0), (0, -0.5, 0), (0, 0, 1), (0, 0, 0)).tolist() == [0, 0, 1]
    assert edge_edge_normal((3, 0, 0), (0, 0.5, 0), (0, 0, 0), (0, 0, 1)).tolist() == [0, 0, -1]


def test_a_centre_in_the_plane_across_the_normal_cannot_turn_it():
    assert point_plane_normal((0, 0, -2), (1, 0, 0), (0, 0, 0)).tolist() == [0, 0, -1]
    assert edge_edge_normal((1, 0, 0), (0, 1, 0), (1, 2, 0), (0, 0, 0)).tolist() == [0, 0, 1]


@pytest.mark.statement(17, oracle="right angles with both edges")
@given(LONG, LONG, VECTOR, VECTOR)
def test_the_normal_of_two_edges_is_perpendicular_to_both_and_points_to_a(edge_a, edge_b, a, b):
    sine = np.linalg.norm(np.cross(edge_a, edge_b)) / np.linalg.norm(edge_a) / np.linalg.norm(edge_b)
    if sine < 1e-6:
        return  # (nearly) parallel: the next test
    n = edge_edge_normal(edge_a, edge_b, a, b)
    assert np.linalg.norm(n) == pytest.approx(1, abs=1e-15)
    rounding = 1e-15 / sine  # the cross product of unit vectors is right to 1e-16 of them, not of itself
    assert n @ edge_a == pytest.approx(0, abs=rounding * np.linalg.norm(edge_a))
    assert n @ edge_b == pytest.approx(0, abs=rounding * np.linalg.norm(edge_b))
    assert n @ (a - b) >= -1e-14  # rounding of vectors up to 35 long
    if n @ (a - b) > 1e-14:
        assert edge_edge_normal(edge_b, -2 * edge_a, b, a) == pytest.approx(-n, abs=2 * rounding)


@pytest.mark.parametrize("size", [2.0**-199, 2.0**-20, 2.0**20, 2.0**199])
def test_a_normal_does_not_depend_on_how_long_the_vectors_are(size):
    assert point_plane_normal((0, 3 * size, -4 * size), UP, (0, 0, 0)).tolist() == [0, -0.6, 0.8]
    assert edge_edge_normal((size, 0, 0), (0, 3 * size, 4 * size), UP, (0, 0, 0)).tolist() == [0, -0.8, 0.6]
    assert edge_edge_normal((0, 3.0, 4.0), (size, 0, 0), (0, 0, 0), UP).tolist() == [0, 0.8, -0.6]


def test_one_plane_has_its_normal_for_every_pair_of_bodies_on_it():
    above_and_below = [[0.0, 0, 1], [0.0, 0, -1]]
    assert point_plane_normal(UP, above_and_below, (0, 0, 0)).tolist() == above_and_below
    assert edge_edge_normal((1, 0, 0), (0, 1, 0), above_and_below, (0, 0, 0)).tolist() == above_and_below
    assert point_plane_normal(np.zeros((0, 3)), UP, (0, 0, 0)).shape == (0, 3)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: edge_edge_normal((1, 2, 0), (-2, -4, 0), UP, (0, 0, 0)), r"edge_a \[1.*edge_b \[-2.* are parallel"),
        (lambda: edge_edge_normal([(1, 0, 0), (0, 0, 3)], (0, 0, 1), UP, (0, 0, 0)), r"edge_a \[0.*3.*are parallel"),
        (lambda: edge_edge_normal((1, 0, 0), (1, 1e-10, 0), UP, (0, 0, 0)), "are parallel"),
        (lambda: edge_edge_normal((0, 0, 0), (1, 0, 0), UP, (0, 0, 0)), "edge_a is zero"),
        (lambda: edge_edge_normal((1, 0, 0), (0, 0, 0), UP, (0, 0, 0)), "edge_b is zero"),
        (lambda: edge_edge_normal((math.nan, 0, 0), (0, 1, 0), UP, (0, 0, 0)), "edge_a must be finite"),
        (lambda: edge_edge_normal((1, 0), (0, 1, 0), UP, (0, 0, 0)), r"edge_a must have shape \(..., 3\)"),
        (lambda: point_plane_normal((0, 0, 0), UP, (0, 0, 0)), "plane_normal is zero"),
        (lambda: point_plane_normal(UP, (math.inf, 0, 0), (0, 0, 0)), "centre_a must be finite"),
        (lambda: point_plane_normal(UP, UP, (math.nan, 0, 0)), "centre_b must be finite"),
        (lambda: point_velocity((0, 0), UP, UP), r"velocity must have shape \(..., 3\)"),
        (lambda: point_velocity(UP, 1.0, UP), "angular_velocity must have shape"),
        (lambda: point_velocity(UP, UP, 1.0), "arm must have shape"),
        (lambda: relative_velocity(1.0, UP), "point_velocity_a must have shape"),
        (lambda: relative_velocity(UP, 1.0), "point_velocity_b must have shape"),
        (lambda: normal_velocity(flying(UP), flying(UP), (0, 0, 2)), "normal must have length 1, not 2"),
        (lambda: normal_velocity(flying(UP), flying(UP), 1.0), "normal must have shape"),
        (lambda: normal_velocity(flying((0, 0, math.nan)), flying(UP), UP), "velocity must be finite"),
        (lambda: normal_velocity(flying(UP), flying((0, 0, math.inf)), UP), "velocity must be finite"),
        (lambda: normal_velocity(flying(UP), flying(UP, arm=1.0), UP), "arm must have shape"),
        (lambda: rebound_velocity(-1.0, 1.5), "restitution must be from 0 to 1, not 1.5"),
        (lambda: rebound_velocity(math.nan, 0.5), "normal_velocity must be finite, not nan"),
        (lambda: classify_contact(math.nan), "normal_velocity must be finite, not nan"),
        (lambda: classify_contact(0.0, -1.0), "threshold must be zero or positive, not -1"),
        (lambda: impulse_of_force([UP, UP], [0, 1, 2]), "time must have a value for each of the samples"),
        (lambda: impulse_of_force(UP, [0]), "time must have a value for each of the samples"),
        (lambda: impulse_of_force([UP, UP], [1, 0]), "steps of time must be zero or positive, not -1"),
        (lambda: impulse_of_force([UP, (math.nan, 0, 0)], [0, 1]), "force must be finite"),
        (lambda: impulse_of_force([UP, UP], [0, math.inf]), "time must be finite"),
        (lambda: mean_force(UP, 0.0), "duration must be positive, not 0"),
        (lambda: mean_force(1.0, 1.0), "momentum_change must have shape"),
        (lambda: mean_force(UP, 1.0, 9.8), "other_force must have shape"),
        (lambda: contact_impulses(1.0, (0, 0, 2)), "normal must have length 1, not 2"),
        (lambda: apply_impulse_to_momenta(1.0, UP, UP, UP), "momentum must have shape"),
        (lambda: apply_impulse_to_momenta(UP, 1.0, UP, UP), "angular_momentum must have shape"),
        (lambda: apply_impulse_to_momenta(UP, UP, 1.0, UP), "arm must have shape"),
        (lambda: apply_impulse_to_momenta(UP, UP, UP, 1.0), "impulse must have shape"),
        (lambda: velocities_from_momenta(UP, UP, -1.0, np.eye(3)), "inverse_mass must be zero or positive, not -1"),
        (lambda: velocities_from_momenta(UP, UP, math.inf, np.eye(3)), "inverse_mass must be finite"),
        (
            lambda: velocities_from_momenta(UP, UP, 1.0, UP),
            r"inverse_inertia must have shape \(..., 3, 3\), not \(3,\)",
        ),
        (lambda: velocities_from_momenta(UP, UP, 1.0, np.full((3, 3), math.nan)), "inverse_inertia must be finite"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()


# Impulse and momentum


@pytest.mark.statement(13, oracle="the area of half a sine wave")
def test_the_impulse_of_half_a_sine_wave_is_two_over_pi_of_its_peak():
    time = np.linspace(0, 0.01, 1001)
    force = np.outer(1000 * np.sin(np.pi * time / 0.01), (0.0, 0.6, 0.8))
    exact = 1000 * 0.01 * 2 / np.pi * np.array([0.0, 0.6, 0.8])
    # The trapezoids of a sine are short by (π/n)²/12 of it: 8e-7 for 1000 steps
    assert impulse_of_force(force, time) == pytest.approx(exact, rel=1e-6)


@pytest.mark.statement(13, oracle="F Δt, and the change of m v")
@given(VECTOR, st.floats(1e-4, 1), st.floats(0.1, 10), VECTOR)
def test_a_constant_force_changes_m_v_by_f_times_t(force, duration, mass, velocity):
    later = velocity + force / mass * duration
    impulse = impulse_of_force([force, force, force], [0, duration / 3, duration])
    assert impulse == pytest.approx(mass * (later - velocity), abs=1e-13)  # roundings of numbers up to 100
    assert mean_force(impulse, duration) == pytest.approx(force, abs=1e-11)  # the same, over 1e-4 s at least


@pytest.mark.statement(13, oracle="numpy.trapezoid")
@given(st.integers(0, 99), st.integers(1, 6))
def test_uneven_samples_in_any_batch_are_added_up_by_trapezoids(seed, samples):
    rng = np.random.default_rng(seed)
    force, time = rng.normal(size=(4, 2, samples, 3)), np.sort(rng.uniform(size=(2, samples)))
    expected = np.trapezoid(force, time[..., None], axis=-2)
    assert impulse_of_force(force, time) == pytest.approx(expected, abs=1e-14)  # the same sum, in another order


def test_a_force_that_jumps_is_sampled_twice_at_that_time():
    steps = impulse_of_force([(2, 0, 0), (2, 0, 0), (5, 0, 0), (5, 0, 0)], [0, 1, 1, 3])
    assert steps.tolist() == [12, 0, 0]


@pytest.mark.erratum(13)
def test_forces_a_hundred_times_apart_give_the_same_impulse():
    change = (0.0, 0.0, 0.5)
    soft, hard = mean_force(change, 0.05), mean_force(change, 0.0005)
    assert hard == pytest.approx(100 * soft, rel=1e-14)
    for force, duration in ((soft, 0.05), (hard, 0.0005)):
        assert impulse_of_force([force, force], [0, duration]) == pytest.approx(change, rel=1e-14)


def test_a_ball_on_the_floor_has_a_contact_force_of_its_weight():
    assert mean_force((0, 0, 0), 2.0).tolist() == [0, 0, 0]
    assert mean_force((0, 0, 0), 2.0, (0, 0, -9.81)).tolist() == [0, 0, 9.81]


@pytest.mark.statement(16, oracle="Newton's third law")
@given(st.floats(-10, 10), NORMAL)
def test_a_receives_the_impulse_along_the_normal_and_b_its_opposite(j, normal):
    on_a, on_b = contact_impulses(j, normal)
    assert (on_a + on_b).tolist() == [0, 0, 0]
    assert on_a @ normal == pytest.approx(j, abs=1e-14)  # a unit vector to a few 1e-16, times 10
    assert np.cross(on_a, normal) == pytest.approx(0, abs=1e-14)


@pytest.mark.statement(21, oracle="arithmetic by hand")
def test_an_impulse_at_the_end_of_an_arm_is_added_to_both_momenta():
    momentum, angular = apply_impulse_to_momenta((1, 2, 3), (0, 0, 1), (2, 0, 0), (0, 5, 0))
    assert momentum.tolist() == [1, 7, 3]
    assert angular.tolist() == [0, 0, 11]
    velocity, spin = velocities_from_momenta(momentum, angular, 0.5, np.diag([1, 1, 0.25]))
    assert velocity.tolist() == [0.5, 3.5, 1.5]
    assert spin.tolist() == [0, 0, 2.75]


@pytest.mark.erratum(21)
def test_as_printed_velocities_beside_p_and_l_never_rebound():
    mass, velocity = 2.0, np.array([0.0, 0.0, -3.0])
    momentum, angular = apply_impulse_to_momenta(mass * velocity, (0, 0, 0), (0, 0, -1), (0, 0, 2 * 3 * mass))
    assert normal_velocity(flying(velocity), flying(STILL), UP) == -3  # P has changed, v has not
    recomputed, _ = velocities_from_momenta(momentum, angular, 1 / mass, np.eye(3))
    assert normal_velocity(flying(recomputed), flying(STILL), UP) == 3


def test_momenta_do_not_describe_the_motion_of_an_immovable_body():
    velocity, spin = velocities_from_momenta((1, 2, 3), (1, 2, 3), 0.0, np.zeros((3, 3)))
    assert velocity.tolist() == [0, 0, 0]
    assert spin.tolist() == [0, 0, 0]
