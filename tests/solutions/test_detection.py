from __future__ import annotations

import math
from decimal import Decimal, localcontext
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.detection import (
    is_colliding,
    side_of_plane,
    signed_distance,
    time_of_impact_exact,
    time_of_impact_interpolated,
)

EPSILON = np.finfo(float).eps  # 2.2e-16, the spacing of floats at 1
RNG_SEED = 20
METRES = st.floats(-1e3, 1e3)
POINT = st.tuples(METRES, METRES, METRES)
DIRECTION = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda n: math.hypot(*n) > 1e-3)


def rotation(rng: np.random.Generator) -> np.ndarray:
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.linalg.det(q)  # a reflection becomes a rotation


# Signed distance


@pytest.mark.statement(4, oracle="a 3-4-5 triangle")
def test_distance_from_a_plane_is_measured_along_the_unit_normal():
    # 3-4-5: the normal has length 5 and the plane 3x + 4z = 10 stands 2 m from the origin.
    assert signed_distance((0.0, 0.0, 0.0), (3.0, 0.0, 4.0), -10.0) == -2.0
    assert signed_distance((3.0, 7.0, 4.0), (3.0, 0.0, 4.0), -10.0) == 3.0


@pytest.mark.statement(4, oracle="exact fractions")
@given(POINT, DIRECTION, METRES)
def test_the_signed_distance_is_what_exact_arithmetic_gives(point, normal, offset):
    exact = sum(Fraction(n) * Fraction(p) for n, p in zip(normal, point, strict=True)) + Fraction(offset)
    squared = sum(Fraction(n) ** 2 for n in normal)
    expected = float(exact) / math.sqrt(squared)
    # Four products and sums of numbers up to 1e3 × 1, rounded: a few spacings of the largest, over a length ≥ 1e-3.
    # 1e-300: products that hardly are there lose more.
    size = sum(abs(n * p) for n, p in zip(normal, point, strict=True)) + abs(offset)
    assert signed_distance(point, normal, offset) == pytest.approx(
        expected, rel=4 * EPSILON, abs=8 * EPSILON * size / math.sqrt(squared) + 1e-300
    )


@given(POINT, DIRECTION, METRES)
def test_going_back_by_the_signed_distance_ends_on_the_plane(point, normal, offset):
    unit = np.array(normal) / np.linalg.norm(normal)
    distance = signed_distance(point, normal, offset)
    foot = np.array(point) - distance * unit
    # A foot up to 1e6 m away (offset over a normal of length 1e-3) is known to some spacings of that.
    assert signed_distance(foot, normal, offset) == pytest.approx(0, abs=1e-9)


@pytest.mark.statement(4, oracle="points scattered over the plane")
def test_no_point_of_the_plane_is_nearer_than_the_distance():
    rng = np.random.default_rng(RNG_SEED)
    normal, offset, point = np.array([1.0, -2.0, 0.5]), 3.0, np.array([4.0, 1.0, -2.0])
    across = np.linalg.svd(normal[None])[2][1:]  # two directions in the plane
    on_plane = -offset * normal / (normal @ normal) + rng.normal(scale=5, size=(20000, 2)) @ across
    nearest = np.linalg.norm(on_plane - point, axis=1).min()
    distance = abs(signed_distance(point, normal, offset))
    # 20 000 points spread over some 300 m² come within 0.3 m of the foot, so within 0.3²/(2 · 2) m of the distance.
    assert distance <= nearest < distance + 0.03


@given(POINT, DIRECTION, METRES, st.floats(1e-2, 1e2))
def test_only_the_direction_of_the_normal_matters(point, normal, offset, factor):
    plane = np.array(normal)
    here = signed_distance(point, plane, offset)
    tolerance = 1e-12 * (1e3 / np.linalg.norm(normal) + abs(here))  # rounding of terms up to 1e3 over the length
    assert signed_distance(point, factor * plane, factor * offset) == pytest.approx(here, abs=tolerance)
    assert signed_distance(point, -plane, -offset) == -here


def test_turning_or_shifting_the_whole_scene_leaves_the_distance_alone():
    rng = np.random.default_rng(RNG_SEED)
    for _ in range(50):
        point, normal, shift = rng.normal(size=(3, 3))
        offset, turn = rng.normal(), rotation(rng)
        here = signed_distance(point, normal, offset)
        # 1e-13: some ten roundings of numbers of order one, over normals not much shorter than 0.1
        assert signed_distance(turn @ point, turn @ normal, offset) == pytest.approx(here, abs=1e-13)
        assert signed_distance(point + shift, normal, offset - normal @ shift) == pytest.approx(here, abs=1e-13)


def test_a_plane_whose_normal_is_zero_is_refused_even_as_one_of_many():
    with pytest.raises(ValueError, match="normal is zero"):
        signed_distance((1.0, 2.0, 3.0), (0.0, 0.0, 0.0), 1.0)
    with pytest.raises(ValueError, match="normal is zero"):
        signed_distance(np.zeros((2, 3)), [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]], 1.0)


# Colliding


def test_a_point_exactly_on_the_plane_is_not_colliding():
    behind = -np.finfo(float).smallest_subnormal
    assert is_colliding([1.0, 0.0, -0.0, behind, -1.0]).tolist() == [False, False, False, True, True]


def test_overlap_up_to_the_tolerance_is_not_a_collision():
    separation = np.array([-0.25, np.nextafter(-0.25, -1.0), -0.125, 0.5])
    assert is_colliding(separation, 0.25).tolist() == [False, True, False, False]
    assert is_colliding(-0.5, [0.25, 0.5, 0.75]).tolist() == [True, False, False]


def test_a_point_behind_the_plane_collides_but_not_its_mirror_image():
    normal, offset = (0.0, 0.6, 0.8), 1.0
    point = np.array([5.0, -3.0, -1.0])  # 1.6 m behind
    mirrored = point - 2 * signed_distance(point, normal, offset) * np.array(normal)
    assert is_colliding(signed_distance([point, mirrored], normal, offset)).tolist() == [True, False]


# The slide's T

STEP_START, STEP = st.floats(-1e3, 1e3), st.floats(1e-6, 1e2)
ABOVE, BEHIND = st.floats(0, 1e3), st.floats(-1e3, -1e-6)


@pytest.mark.statement(5, oracle="exact fractions")
@given(ABOVE, BEHIND, STEP_START, STEP)
def test_at_constant_velocity_the_slides_t_is_exact(before, after, t, dt):
    exact = Fraction(t) + Fraction(dt) * Fraction(before) / (Fraction(before) - Fraction(after))
    found = float(time_of_impact_interpolated(before, after, t, dt))
    # One difference, one quotient, one product and one sum are rounded, each by half a spacing.
    assert abs(found - exact) <= 2 * EPSILON * (abs(t) + dt)
    assert t <= found <= t + dt


def test_halfway_down_is_half_the_step():
    assert time_of_impact_interpolated(0.25, -0.25, 3.0, 0.5) == 3.25
    assert time_of_impact_interpolated(3.0, -1.0, 0.0, 1.0) == 0.75


@pytest.mark.statement(5, oracle="the definition, on the plane")
@given(BEHIND, STEP_START, STEP)
def test_a_point_that_starts_on_the_plane_and_goes_through_meets_it_at_once(after, t, dt):
    assert time_of_impact_interpolated(0.0, after, t, dt) == t


def test_a_step_that_does_not_end_behind_the_plane_has_no_time_of_impact():
    before, after = [1.0, 1.0, 0.0, 0.0, 0.0], [2.0, 1.0, 1.0, 0.0, -0.0]  # away, along, leaving, resting, resting
    assert np.all(np.isinf(time_of_impact_interpolated(before, after, 0.0, 0.1)))


def test_a_point_that_ends_exactly_on_the_plane_has_not_gone_through():
    assert time_of_impact_interpolated(1.0, 0.0, 0.0, 0.1) == math.inf


def test_a_point_that_starts_behind_the_plane_has_no_time_of_impact():
    assert np.all(np.isinf(time_of_impact_interpolated([-1.0, -1.0, -1e-60], [-2.0, 1.0, -1.0], 0.0, 0.1)))


@given(ABOVE, BEHIND, STEP_START, STEP, st.floats(-1e3, 1e3))
def test_the_slides_t_moves_with_the_clock_and_not_with_the_unit_of_length(before, after, t, dt, later):
    here = time_of_impact_interpolated(before, after, t, dt)
    shifted = time_of_impact_interpolated(before, after, t + later, dt)
    assert shifted - later == pytest.approx(here, abs=1e-11)  # times up to 2e3 s, rounded some ten times
    assert time_of_impact_interpolated(1024 * before, 1024 * after, t, dt) == here  # a power of two: no rounding


@given(st.floats(0.1, 20), st.floats(0.5, 20), st.floats(1e-4, 2e-2), st.floats(1e-3, 0.999))
def test_under_gravity_the_slides_t_is_early_by_up_to_g_dt_squared_over_8_v(gravity, speed, dt, share):
    height = share * speed * dt
    end = height - speed * dt - gravity * dt**2 / 2
    early = time_of_impact_exact(height, -speed, -gravity) - time_of_impact_interpolated(height, end, 0.0, dt)
    rounding = 1e-15  # times of at most 0.02 s, after a few roundings of numbers of order 1
    assert -rounding <= early <= gravity * dt**2 / (8 * speed) + rounding


@pytest.mark.statement(5, oracle="g Δt²/(8 v), the chord of a parabola")
def test_the_bound_on_how_early_the_slides_t_is_cannot_be_made_smaller():
    gravity, speed, dt = 9.81, 50.0, 1e-3  # g dt/v = 2e-4: the chord is as steep as the path to that share
    height = speed * dt * np.linspace(0.01, 0.99, 99)
    end = height - speed * dt - gravity * dt**2 / 2
    early = time_of_impact_exact(height, -speed, -gravity) - time_of_impact_interpolated(height, end, 0.0, dt)
    assert early.max() == pytest.approx(gravity * dt**2 / (8 * speed), rel=2e-4)


# The exact root


def exact_time(s: float, u: float, a: float) -> Decimal | None:
    """First time at which s + u t + a t²/2 is zero on the way down, in 60 digits; None where there is none."""
    with localcontext() as context:
        context.prec = 60
        s_, u_, a_ = Decimal(s), Decimal(u), Decimal(a)
        if s == 0 and u < 0:
            return Decimal(0)  # it is there; sixty digits of √u² might say a little earlier
        if a == 0:
            return s_ / -u_ if u < 0 else None
        discriminant = u_ * u_ - 2 * a_ * s_
        if discriminant < 0:
            return None
        falling = (-u_ - discriminant.sqrt()) / a_  # where the speed u + a t is −√(u² − 2 a s), so downwards
        return falling if falling >= 0 and (a < 0 or u < 0) else None


HEIGHT = st.one_of(st.just(0.0), st.floats(1e-12, 1e6))
SPEED = st.one_of(st.just(0.0), st.floats(1e-9, 1e6), st.floats(-1e6, -1e-9))
DOWNWARDS, UPWARDS = st.floats(-1e4, -1e-6), st.floats(1e-6, 1e4)


@pytest.mark.statement(5, oracle="sixty digits")
@given(HEIGHT, SPEED, DOWNWARDS)
def test_the_fall_onto_a_plane_takes_the_time_that_sixty_digits_give(s, u, a):
    expected = exact_time(s, u, a)
    assert expected is not None
    # u² and −2 a s have one sign, so nothing cancels: some five roundings of half a spacing each.
    assert float(time_of_impact_exact(s, u, a)) == pytest.approx(float(expected), rel=4 * EPSILON, abs=0)


@given(st.floats(1e-12, 1e6), st.floats(-1e6, -1e-9), UPWARDS)
def test_a_body_that_is_braked_meets_the_plane_only_if_fast_enough(s, u, a):
    discriminant = Fraction(u) ** 2 - 2 * Fraction(a) * Fraction(s)
    # Within rounding of u² from grazing, float arithmetic cannot tell a touch from a miss.
    assume(abs(discriminant) > 4 * EPSILON * Fraction(u) ** 2)
    found, expected = float(time_of_impact_exact(s, u, a)), exact_time(s, u, a)
    if expected is None:
        assert found == math.inf
    else:
        # The discriminant is known to ε u², so the root r to ε u²/(2r), and the time to ε |u|/r as a share of it.
        sharpness = abs(u) / math.sqrt(discriminant)
        assert found == pytest.approx(float(expected), rel=(4 + 2 * sharpness) * EPSILON, abs=0)


@pytest.mark.parametrize(("s", "u", "a"), [(1e-9, -100.0, -9.81), (1e-12, -1e3, -9.81), (1e-9, -100.0, 9.81)])
def test_a_small_gap_closed_at_high_speed_keeps_its_digits(s, u, a):
    expected = float(exact_time(s, u, a))
    school = (-u - math.sqrt(u * u - 2 * a * s)) / a
    assert abs(school / expected - 1) > 1e-5  # u and the root agree in all but the last few digits
    assert float(time_of_impact_exact(s, u, a)) == pytest.approx(expected, rel=4 * EPSILON, abs=0)


@pytest.mark.statement(5, oracle="numpy.roots")
def test_the_exact_root_is_the_first_positive_root_of_the_parabola():
    rng = np.random.default_rng(RNG_SEED)
    for s, u, a in zip(rng.uniform(0.1, 5, 200), rng.normal(size=200) * 5, rng.normal(size=200) * 5, strict=True):
        roots = np.roots([a / 2, u, s])
        ahead = [root.real for root in roots if abs(root.imag) < 1e-9 and root.real > 0]
        expected = min(ahead, default=math.inf)
        # numpy.roots goes through eigenvalues: good to about √ε where two roots nearly meet
        assert float(time_of_impact_exact(s, u, a)) == pytest.approx(expected, rel=1e-6)


def test_a_fall_from_rest_takes_the_root_of_two_h_over_g():
    assert time_of_impact_exact(2.0, 0.0, -4.0) == 1.0
    assert time_of_impact_exact(1.0, 0.0, -9.81) == pytest.approx(math.sqrt(2 / 9.81), rel=2 * EPSILON)


def test_a_ball_thrown_up_from_the_plane_returns_after_two_u_over_g():
    assert time_of_impact_exact(0.0, 3.0, -2.0) == 3.0


def test_a_body_on_the_plane_that_moves_in_or_is_pressed_on_meets_it_now():
    assert np.array_equal(time_of_impact_exact(0.0, [-1.0, -1.0, -1.0, 0.0], [-9.81, 0.0, 9.81, -9.81]), np.zeros(4))


def test_a_body_just_behind_the_plane_by_rounding_counts_as_on_it():
    assert time_of_impact_exact(-1e-17, -2.0, -9.81) == 0.0
    assert time_of_impact_exact(-1e-17, 3.0, -2.0) == 3.0


@pytest.mark.parametrize(
    ("s", "u", "a"),
    [(1.0, 0.0, 0.0), (1.0, 2.0, 0.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 2.0, 3.0), (0.0, 0.0, 3.0)],
    ids=["hovers", "coasts away", "lies without weight", "drifts off", "is driven off", "is lifted off"],
)
def test_a_body_that_never_comes_down_has_no_time_of_impact(s, u, a):
    assert time_of_impact_exact(s, u, a) == math.inf


def test_without_acceleration_the_gap_closes_at_a_steady_rate():
    assert time_of_impact_exact(3.0, -4.0, 0.0) == 0.75


def test_a_body_that_turns_round_exactly_on_the_plane_touches_it():
    assert time_of_impact_exact(1.0, -2.0, 2.0) == 1.0  # u² = 2 a s exactly
    assert time_of_impact_exact(1.0, -2.0, 2.0 + 1e-9) == math.inf


@given(st.floats(1e-3, 1e3), st.floats(-1e2, 1e2), st.floats(-1e2, -1e-2), st.floats(0.01, 0.99))
def test_starting_later_on_the_way_brings_the_impact_that_much_nearer(s, u, a, share):
    whole = float(time_of_impact_exact(s, u, a))
    past = share * whole
    rest = time_of_impact_exact(s + u * past + a * past**2 / 2, u + a * past, a)
    # The state on the way is a sum of terms up to s, u t and a t²; their rounding is made up for at the arrival speed.
    terms, arrival = s + abs(u) * whole + abs(a) * whole**2, math.sqrt(u * u - 2 * a * s)
    assert past + rest == pytest.approx(whole, abs=8 * EPSILON * (terms / arrival + whole))


@given(st.floats(1e-3, 1e3), st.floats(-1e2, -1e-3), st.floats(1e-3, 1e3))
def test_without_acceleration_both_times_of_impact_agree(s, u, dt):
    end = s + u * dt
    assume(end < -1e-3)
    # The end of the step is a difference: its rounding, as a share of s − s1 = −u dt, is that of s + |u| dt
    tolerance = 4 * EPSILON * (s - u * dt) / (-u * dt)
    assert time_of_impact_interpolated(s, end, 0.0, dt) == pytest.approx(time_of_impact_exact(s, u, 0.0), rel=tolerance)


@pytest.mark.statement(5, oracle="scipy's solve_ivp, DOP853 with an event at the plane")
def test_solve_ivp_with_an_event_at_the_plane_stops_at_the_same_time():
    integrate = oracle("scipy.integrate")

    def plane(_, state):
        return state[0]

    plane.terminal, plane.direction = True, -1
    rng = np.random.default_rng(RNG_SEED)
    for s, u, a in zip(rng.uniform(0.1, 5, 40), rng.normal(size=40) * 5, -rng.uniform(0.5, 20, 40), strict=True):
        found = integrate.solve_ivp(
            lambda _, state, a=a: (state[1], a), (0, 60), (s, u), method="DOP853", events=plane, rtol=1e-13, atol=1e-13
        )
        # The solver's own tolerance, 1e-13 of paths up to 10 m, at an arrival of 0.3 m/s or more
        assert time_of_impact_exact(s, u, a) == pytest.approx(found.t_events[0][0], abs=1e-12)


# What is refused


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: signed_distance(1.0, (0, 0, 1), 0.0), r"point must have shape \(..., 3\), not \(\)"),
        (lambda: signed_distance((0, 1), (0, 1), 0.0), r"point must have shape \(..., 3\), not \(2,\)"),
        (lambda: signed_distance((0, 0, 1), 1.0, 0.0), r"normal must have shape \(..., 3\), not \(\)"),
        (lambda: time_of_impact_interpolated(math.nan, -1.0, 0.0, 1.0), "separation_0 must be finite, not nan"),
        (lambda: time_of_impact_interpolated(1.0, math.nan, 0.0, 1.0), "separation_1 must be finite, not nan"),
        (lambda: time_of_impact_interpolated(1.0, -1.0, math.nan, 1.0), "t must be finite, not nan"),
        (lambda: time_of_impact_interpolated(1.0, -1.0, 0.0, -2.0), "dt must be zero or positive, not -2"),
        (lambda: time_of_impact_exact(math.nan, -1.0, 0.0), "separation must be finite, not nan"),
        (lambda: time_of_impact_exact([1.0, math.inf], -1.0, 0.0), "separation must be finite, not inf"),
        (lambda: time_of_impact_exact(1.0, math.nan, 0.0), "normal_velocity must be finite, not nan"),
        (lambda: time_of_impact_exact(1.0, -1.0, math.nan), "normal_acceleration must be finite, not nan"),
    ],
)
def test_a_motion_that_is_not_finite_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


# The slides as printed


@pytest.mark.erratum(4)
def test_as_printed_the_left_side_of_the_plane_equation_is_no_distance():
    plane = (0.0, 0.0, 2.0, -4.0)  # z = 2, written with a normal of length 2
    touching, inside = (7.0, -3.0, 2.0), (0.0, 0.0, 1.5)
    assert not as_printed.point_plane_collision(touching, plane)
    assert side_of_plane(signed_distance(touching, plane[:3], plane[3])) == 0
    assert as_printed.point_plane_collision(inside, plane)
    left_side = np.dot(plane[:3], inside) + plane[3]
    assert left_side == -1.0  # twice as deep as it is
    assert signed_distance(inside, plane[:3], plane[3]) == -0.5


@pytest.mark.erratum(4)
def test_as_printed_a_point_beyond_the_edge_of_a_table_collides_with_it():
    table_top = (0.0, 0.0, 1.0, -0.75)  # a table of 1 m × 1 m; the point hangs beside it, 5 m away
    assert as_printed.point_plane_collision((5.0, 0.0, 0.5), table_top)  # a half-space has no edge


@pytest.mark.erratum(5)
def test_as_printed_signed_distances_put_the_impact_outside_the_step():
    t, dt, before, after = 2.0, 0.1, 0.3, -0.1
    assert as_printed.time_of_impact(t, dt, before, after) == pytest.approx(2.15)  # the step ends at 2.1
    assert as_printed.time_of_impact(t, dt, before, -after) == pytest.approx(2.075)  # magnitudes: what is meant
    assert time_of_impact_interpolated(before, after, t, dt) == pytest.approx(2.075)
    assert np.isinf(as_printed.time_of_impact(t, dt, 0.25, -0.25))  # half the way down: d1 + d2 = 0
    assert time_of_impact_interpolated(0.25, -0.25, t, dt) == pytest.approx(2.05)


@pytest.mark.erratum(5)
def test_as_printed_a_point_that_stays_in_front_has_a_time_of_impact():
    assert as_printed.time_of_impact(0.0, 0.1, 0.3, 0.1) == pytest.approx(0.075)
    assert time_of_impact_interpolated(0.3, 0.1, 0.0, 0.1) == math.inf


# One is many


def test_many_contacts_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(RNG_SEED)
    points, normals = rng.normal(size=(2, 4, 5, 3))
    s, u, a, end, t = rng.normal(size=(5, 4, 5))
    dt = rng.uniform(0.1, 1, size=(4, 5))
    together = (
        signed_distance(points, normals, s),
        is_colliding(s, dt),
        time_of_impact_interpolated(s, end, t, dt),
        time_of_impact_exact(s, u, a),
    )
    assert [values.shape for values in together] == [(4, 5)] * 4
    for at in np.ndindex(4, 5):
        one = (
            signed_distance(points[at], normals[at], s[at]),
            is_colliding(s[at], dt[at]),
            time_of_impact_interpolated(s[at], end[at], t[at], dt[at]),
            time_of_impact_exact(s[at], u[at], a[at]),
        )
        # Sums over the last axis may be grouped differently in a batch: 1e-14 for numbers of order one
        assert np.allclose([values[at] for values in together], one, rtol=1e-14, atol=1e-14)


def test_one_plane_serves_many_points_and_one_point_many_planes():
    heights = signed_distance([(0.0, 0.0, 1.0), (0.0, 0.0, 2.0)], (0.0, 0.0, 1.0), 0.0)
    assert heights.tolist() == [1.0, 2.0]
    from_planes = signed_distance((0.0, 0.0, 1.0), (0.0, 0.0, 1.0), [0.0, -1.0, -2.0])
    assert from_planes.tolist() == [1.0, 0.0, -1.0]
    assert time_of_impact_exact([1.0, 4.0], 0.0, -2.0).tolist() == [1.0, 2.0]
    assert time_of_impact_interpolated(1.0, [-1.0, 1.0], [1.0, 2.0], 1.0).tolist() == [1.5, math.inf]


def test_whole_numbers_are_accepted():
    assert signed_distance([1, 2, 3], [0, 0, 2], -2) == 2.0
    assert is_colliding(-1)
    assert time_of_impact_interpolated(1, -3, 0, 1) == 0.25
    assert time_of_impact_exact(1, -3, -4) == pytest.approx((-3 + math.sqrt(17)) / 4, rel=1e-14)


def test_looking_for_a_collision_changes_none_of_its_inputs():
    rng = np.random.default_rng(RNG_SEED)
    arrays = [rng.normal(size=(6, 3)), rng.normal(size=(6, 3)), *rng.uniform(size=(4, 6))]
    kept = [array.copy() for array in arrays]
    point, normal, s, u, a, dt = arrays
    for array in arrays:
        array.flags.writeable = False  # writing to one would raise
    signed_distance(point, normal, s)
    is_colliding(s, dt)
    time_of_impact_interpolated(s, u, a, dt)
    time_of_impact_exact(s, u, a)
    assert all(np.array_equal(array, copy) for array, copy in zip(arrays, kept, strict=True))
