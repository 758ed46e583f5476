from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from reference import truth
from solutions.detection import signed_distance, time_of_impact_exact, time_of_impact_interpolated
from solutions.forces import ballistic_motion
from solutions.response import (
    bounce_along_normal,
    bounce_through_step,
    respond_at_impact,
    respond_at_step,
    time_until_rest,
)

G = 9.81
UP = (0.0, 0.0, 1.0)
PULL = (0.0, 0.0, -G)
HEIGHT, SPEED, GRAVITY = st.floats(0, 20), st.floats(-20, 20), st.floats(0.1, 30)
RESTITUTION, DURATION = st.floats(0, 0.95), st.floats(0, 5)


def solved(s, u, a, e, duration):
    """Separation and velocity after a bouncing motion, by a solver of differential equations that stops at impacts."""
    integrate = oracle("scipy.integrate")

    def plane(_, state):
        return state[0]

    plane.terminal, plane.direction = True, -1
    t, state, impacts = 0.0, (s, u), 0
    while True:
        found = integrate.solve_ivp(
            lambda _, state: (state[1], a), (t, duration), state, method="DOP853", events=plane, rtol=1e-13, atol=1e-14
        )
        if found.status == 0:
            return found.y[0, -1], found.y[1, -1], impacts
        t, impacts = found.t[-1], impacts + 1
        state = (1e-15, -e * found.y[1, -1])  # a hair above, or the event would fire again


# One impact in a step: two policies


@pytest.mark.statement(6, oracle="scipy's solve_ivp, DOP853 with an event at the plane")
@pytest.mark.statement(3, oracle="scipy's solve_ivp, DOP853 with an event at the plane")
def test_backing_up_to_the_impact_ends_in_the_state_of_solve_ivp():
    rng = np.random.default_rng(1)
    for _ in range(20):
        s, u, e, dt = rng.uniform(0.01, 0.2), rng.uniform(-4, -2), rng.uniform(0.2, 1), 0.15
        time = time_of_impact_exact(s, u, -G)
        position, velocity = respond_at_impact((1.0, 2.0, s), (3.0, 0.0, u), PULL, UP, e, time, dt)
        expected = solved(s, u, -G, e, dt)
        assert (position[2], velocity[2]) == pytest.approx(expected[:2], abs=1e-12)  # the solver's own tolerance
        assert (position[0], position[1], velocity[0]) == pytest.approx((1.45, 2.0, 3.0), abs=1e-15)


def test_halfway_through_the_step_the_ball_turns_round():
    # 2 m/s without weight: 0.5 s down, then 0.5 s up at half the speed
    position, velocity = respond_at_impact((0, 0, 1), (1, 0, -2), (0, 0, 0), UP, 0.5, 0.5, 1.0)
    assert position.tolist() == [1.0, 0.0, 0.5]
    assert velocity.tolist() == [1.0, 0.0, 1.0]


@pytest.mark.parametrize("time", [1.5, math.inf])
def test_a_step_that_ends_before_the_impact_is_free_flight(time):
    state = respond_at_impact((0, 0, 8), (1, 0, -2), (0, 0, -2), UP, 0.5, time, 1.0)
    assert [part.tolist() for part in state] == [[1.0, 0.0, 5.0], [1.0, 0.0, -4.0]]


def test_an_impact_at_either_end_of_the_step_is_resolved_in_it():
    at_first = respond_at_impact((0, 0, 0), (0, 0, -2), (0, 0, 0), UP, 0.5, 0.0, 1.0)
    at_last = respond_at_impact((0, 0, 2), (0, 0, -2), (0, 0, 0), UP, 0.5, 1.0, 1.0)
    assert [part[2] for part in at_first] == [1.0, 1.0]
    assert [part[2] for part in at_last] == [0.0, 1.0]


def test_a_ball_that_moves_away_at_the_time_of_impact_is_left_alone():
    assert respond_at_impact((0, 0, 1), (0, 0, 2), (0, 0, 0), UP, 0.5, 0.25, 1.0)[1].tolist() == [0.0, 0.0, 2.0]


def dropped(policy, e, dt, height, steps):
    """Apex heights after one impact, from the energy at the end: a ball let fall from rest, many heights at once."""
    position, velocity = np.zeros((len(height), 3)), np.zeros((len(height), 3))
    position[:, 2] = height
    for _ in range(steps):
        if policy == "at the step":
            position, velocity = respond_at_step(position, velocity, PULL, UP, position[:, 2] < 0, e, dt)
            continue
        u = velocity[:, 2]
        if policy == "exact":
            time = time_of_impact_exact(position[:, 2], u, -G)
        else:
            end = ballistic_motion(position, velocity, PULL, dt)[0][:, 2]
            time = time_of_impact_interpolated(np.maximum(position[:, 2], 0), end, 0.0, dt)
        position, velocity = respond_at_impact(position, velocity, PULL, UP, e, time, dt)
    # The steps of semi-implicit Euler lie on a parabola whose slope is that of a velocity half a step ago.
    slope = velocity[:, 2] - G * dt / 2 * (policy == "at the step")
    return position[:, 2] + slope**2 / (2 * G)


@pytest.mark.statement(3, oracle="e² h, and the order of convergence")
def test_the_exact_root_has_no_error_and_the_other_policies_have_orders():
    e, h, errors = 0.7, np.linspace(0.45, 0.55, 101), {}
    for policy in ("exact", "slide", "at the step"):
        sizes = []
        for dt in (2e-3, 1e-3):
            apex = dropped(policy, e, dt, h, round(0.5 / dt))
            sizes.append(np.sqrt(np.mean((apex - e**2 * h) ** 2)))
        errors[policy] = sizes
    assert max(errors["exact"]) < 1e-13  # rounding of 500 steps
    for policy, order in (("slide", 2), ("at the step", 1)):
        coarse, fine = errors[policy]
        assert math.log2(coarse / fine) == pytest.approx(order, abs=0.1)  # 101 phases are no continuum


@pytest.mark.statement(3, oracle="the closed form of the instants of impact")
@pytest.mark.erratum(3)
def test_dropping_the_rest_of_the_step_delays_bounces_by_half_a_step():
    dt, e = 0.01, 0.9
    s = np.linspace(0.9, 1.1, 200)
    expected = np.array([truth.bounce_times(height, e, G, 2)[1] for height in s])
    u, steps = np.zeros(200), np.zeros(200)
    while np.any(falling := u <= 0):  # up to the first impact, and then the step is cut off, as on the slide
        time = time_of_impact_exact(s, u, -G)
        past = np.where(falling, np.minimum(time, dt), 0.0)
        s, u, steps = s + u * past - G * past**2 / 2, u - G * past, steps + falling
        u = np.where(falling & (time <= dt), -e * u, u)
    late = steps * dt + time_of_impact_exact(0.0, u, -G) - expected
    assert min(late) > -1e-12  # never early
    assert max(late) < dt
    # Phases spread over some 2 steps by 200 heights: their mean is known to 0.4 %
    assert np.mean(late) == pytest.approx(dt / 2, rel=0.05)


# The end of bouncing


@pytest.mark.statement(3, oracle="t1 (1 + e)/(1 − e), and the sum of the flights in fractions")
@pytest.mark.parametrize("e", [0.0, 0.2, 0.5, 0.9, 0.99])
def test_all_the_flights_together_last_as_long_as_their_sum(e):
    # √(2 h/g) = 1 s: every flight is a fraction
    flights = [Fraction(1)] + [2 * Fraction(e) ** n for n in range(1, 60)]
    left_out = 2 * Fraction(e) ** 60 / (1 - Fraction(e))
    assert time_until_rest(0.5, 0.0, -1.0, e) == pytest.approx(float(sum(flights) + left_out), rel=1e-14)
    assert time_until_rest(1.3, 0.0, -G, e) == pytest.approx(truth.bounce_end(1.3, e, G), rel=1e-14)


@given(HEIGHT, SPEED, GRAVITY, RESTITUTION)
def test_bouncing_ends_as_for_a_ball_dropped_from_its_highest_point(s, u, g, e):
    # Back in time to the apex, which lies at s + u²/(2g), and was u/g ago
    from_apex = truth.bounce_end(s + u * u / (2 * g), e, g)
    # Sums and a root of terms up to s + u²/g, over a speed; where all is tiny, √ of the smallest doubles
    tolerance = 1e-14 * (from_apex + abs(u) / g) + 1e-150
    assert time_until_rest(s, u, -g, e) == pytest.approx(from_apex + u / g, abs=tolerance)


def test_a_body_on_the_plane_rests_now_and_an_elastic_one_never():
    assert time_until_rest(0.0, 0.0, [-G, 0.0, 0.0], [0.5, 0.5, 1.0]).tolist() == [0.0, 0.0, 0.0]
    assert time_until_rest(0.0, 0.0, -G, 1.0) == 0.0
    never = [(1.0, 0.0, -G, 1.0), (0.0, 1.0, -G, 1.0), (1.0, -1.0, 0.0, 0.5), (1.0, 1.0, 0.0, 0.5)]
    never += [(1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (1.0, -5.0, 1.0, 0.0), (1.0, 0.0, 1.0, 0.5)]
    assert all(time_until_rest(*motion) == math.inf for motion in never)


def test_a_dull_ball_rests_with_its_first_impact():
    assert time_until_rest(2.0, 0.0, -4.0, 0.0) == 1.0
    assert time_until_rest(3.0, -4.0, 0.0, 0.0) == 0.75  # without weight too


def test_a_ball_behind_the_plane_by_rounding_counts_as_on_it():
    assert time_until_rest(-1e-17, 0.0, -G, 0.5) == 0.0
    assert time_until_rest(-1e-17, 2.0, -2.0, 0.5) == 4.0  # 2 s up and down, then 1, 0.5 …
    assert time_until_rest(-0.5, 2.0, -2.0, 0.5) == 4.0  # far behind as well: below zero counts as zero


# Any number of impacts in a step


@pytest.mark.statement(3, oracle="scipy's solve_ivp, DOP853, started again after every impact")
def test_a_step_with_many_impacts_ends_in_the_state_of_solve_ivp():
    rng = np.random.default_rng(2)
    for _ in range(15):
        s, u, e, dt = rng.uniform(0.1, 1), rng.uniform(-3, 3), rng.uniform(0.75, 1), rng.uniform(1, 2)
        ours = bounce_along_normal(s, u, -G, e, dt)
        expected = solved(s, u, -G, e, dt)
        assert ours[2] == expected[2]
        # The solver stops an impact at some 1e-14 m, and starts the next flight 1e-15 m off: 1e-14 s at 0.3 m/s each
        assert (ours[0], ours[1]) == pytest.approx(expected[:2], abs=1e-11)


@given(st.floats(0.01, 20), st.floats(0.1, 30), st.floats(0.3, 1), st.integers(1, 12))
def test_an_instant_of_impact_adds_one_bounce(h, g, e, number):
    time = truth.bounce_times(h, e, g, number)[-1]
    gap = 1e-9 * time
    early, late = (bounce_along_normal(h, 0.0, -g, e, time + shift) for shift in (-gap, gap))
    assert (early[2], late[2]) == (number - 1, number)
    w = math.sqrt(2 * g * h)
    # within a billionth of the time to either side, at up to w and with g on top
    assert early[1] == pytest.approx(-w * e ** (number - 1), abs=2 * g * gap)
    assert late[1] == pytest.approx(w * e**number, abs=2 * g * gap)
    assert max(early[0], late[0]) <= 2 * w * gap


@given(HEIGHT, SPEED, GRAVITY, RESTITUTION)
def test_a_step_longer_than_all_its_bounces_ends_at_rest_exactly(s, u, g, e):
    dt = 1.001 * float(time_until_rest(s, u, -g, e))
    after = bounce_along_normal(s, u, -g, e, dt)
    assert (after[0], after[1], after[3]) == (0.0, 0.0, 0.0)
    moved = s > 0 or u != 0
    assert after[2] == (0 if not moved else 1 if e == 0 else math.inf)


@given(HEIGHT, SPEED, GRAVITY, RESTITUTION, DURATION)
def test_a_bouncing_ball_never_gains_energy_or_ends_behind_the_plane(s, u, g, e, dt):
    after, speed, impacts, left = bounce_along_normal(s, u, -g, e, dt)
    assert after >= 0
    assert 0 <= left <= dt
    start, end = u * u / 2 + g * s, speed * speed / 2 + g * after
    assert end <= start * (1 + 1e-12) + 1e-15  # rounding of positions up to 500 m, and of g s
    if impacts == 0 and (s, u) != (0, 0):
        assert end == pytest.approx(start, rel=1e-12, abs=1e-15)


@given(st.floats(0.1, 20), SPEED, GRAVITY, st.floats(0.3, 1), st.floats(0, 3), st.floats(0, 1))
def test_two_steps_one_after_the_other_are_one_long_step(s, u, g, e, dt, share):
    whole = bounce_along_normal(s, u, -g, e, dt)
    first = bounce_along_normal(s, u, -g, e, share * dt)
    then = bounce_along_normal(first[0], first[1], -g, e, dt - share * dt)
    # An impact within rounding of the seam or the end is seen on either side of it, and a ball that rests within
    # rounding too: then the states differ by an impact. Elsewhere by rounding, more so after many impacts.
    if whole[2] == first[2] + then[2] and whole[2] < 100:
        scale = 1e-10 * (s + abs(u) + g)
        assert (then[0], then[1]) == pytest.approx((whole[0], whole[1]), abs=max(scale, 1e-10) * (1 + dt))


def test_a_step_cut_short_reports_the_rest_and_can_be_continued():
    whole = bounce_along_normal(1.0, 0.0, -G, 0.8, 2.5)
    part = bounce_along_normal(1.0, 0.0, -G, 0.8, 2.5, most_impacts=2)
    assert whole[2] > 3
    assert part[2] == 2
    assert part[0] == 0
    times = truth.bounce_times(1.0, 0.8, G, 2)
    assert part[3] == pytest.approx(2.5 - times[-1], rel=1e-14)
    rest = bounce_along_normal(part[0], part[1], -G, 0.8, part[3])
    assert rest[2] == whole[2] - 2
    assert (rest[0], rest[1]) == pytest.approx((whole[0], whole[1]), abs=1e-14)
    assert bounce_along_normal(1.0, 0.0, -G, 0.8, 2.5, most_impacts=0)[3] == 2.5
    enough = bounce_along_normal(1.0, 0.0, -G, 0.8, 2.5, most_impacts=int(whole[2]))
    assert enough[3] == 0


def test_a_body_at_rest_on_the_plane_stays_and_has_no_impact():
    assert [float(part) for part in bounce_along_normal(0.0, 0.0, -G, 0.5, 1.0)] == [0.0, 0.0, 0.0, 0.0]
    assert [float(part) for part in bounce_along_normal(0.0, 0.0, -G, 1.0, 1.0)] == [0.0, 0.0, 0.0, 0.0]
    assert [float(part) for part in bounce_along_normal(-1e-17, 0.0, -G, 0.5, 1.0)] == [0.0, 0.0, 0.0, 0.0]


def test_a_body_without_weight_bounces_once_and_a_lifted_one_rises():
    assert [float(part) for part in bounce_along_normal(1.0, -2.0, 0.0, 0.5, 2.5)] == [2.0, 1.0, 1.0, 0.0]
    assert [float(part) for part in bounce_along_normal(0.0, 0.0, 2.0, 0.5, 3.0)] == [9.0, 6.0, 0.0, 0.0]
    # dull and weightless: stuck at its first impact
    assert [float(part) for part in bounce_along_normal(1.0, -2.0, 0.0, 0.0, 2.5)] == [0.0, 0.0, 1.0, 0.0]
    # driven in against a lift: it slows from 2.5 to 1.5 m/s, rebounds with 0.75 and is lifted off
    assert [float(part) for part in bounce_along_normal(1.0, -2.5, 2.0, 0.5, 1.5)] == [1.75, 2.75, 1.0, 0.0]


def test_an_impact_at_the_last_instant_of_a_step_belongs_to_it():
    assert [float(part) for part in bounce_along_normal(1.0, 0.0, -8.0, 0.5, 0.5)] == [0.0, 2.0, 1.0, 0.0]


def test_a_step_that_ends_one_float_before_an_impact_stays_in_front():
    # Rounding alone would put it 1e-16 m behind
    assert [float(part) for part in bounce_along_normal(1.99, -2.3, -9.81, 0.5, 0.4442775904403033)][::2] == [0.0, 0.0]


def test_an_elastic_ball_bounces_a_thousand_times_to_its_first_height():
    # Flights of exactly 1 s, and a step that ends at the top of one
    after = bounce_along_normal(1.0, 0.0, -8.0, 1.0, 1000.0)
    assert [float(part) for part in after] == [1.0, 0.0, 1000.0, 0.0]


# In space


@pytest.mark.statement(6, oracle="one dimension and free motion beside it")
def test_along_the_plane_a_bouncing_body_moves_as_if_there_were_no_plane():
    rng = np.random.default_rng(3)
    normal = rng.normal(size=3)
    normal /= np.linalg.norm(normal)
    along = np.cross(normal, (0.3, -0.4, 0.2))
    pull = -G * normal + 0.7 * along
    position, velocity = 0.8 * normal + (0.5 * normal), 2.0 * along - 1.0 * normal
    after, speed, impacts, left = bounce_through_step(position, velocity, pull, normal, -0.5, 0.8, 1.7)
    height, rise, count, _ = bounce_along_normal(0.8, -1.0, -G, 0.8, 1.7)
    assert (impacts, left) == (count, 0)
    assert signed_distance(after, normal, -0.5) == pytest.approx(height, abs=1e-14)
    free = 2.0 * along * 1.7 + 0.7 * along * 1.7**2 / 2
    # Some ten roundings of numbers up to 15 m, 30 m/s
    assert after == pytest.approx(0.5 * normal + height * normal + free, abs=1e-13)
    assert speed == pytest.approx(rise * normal + (2.0 + 0.7 * 1.7) * along, abs=1e-13)


def test_a_body_that_came_to_rest_within_the_step_slides_on_over_the_plane():
    position, velocity, impacts, left = bounce_through_step(
        (0, 0, 6), (1, 0, 0), (0, 0, -10), UP, -5.0, 0.5, [1.0, 2.0]
    )
    assert position[1] == pytest.approx((2, 0, 5), abs=1e-15)
    assert velocity[1].tolist() == [1.0, 0.0, 0.0]
    assert impacts[1] == math.inf
    assert np.all(left == 0)
    assert position[0, 2] > 5  # 1 s is not enough


def test_a_step_cut_short_is_cut_short_along_the_plane_too():
    position, velocity, impacts, left = bounce_through_step((0, 0, 2), (1, 0, 0), (0, 0, -4), UP, 0.0, 0.5, 2.0, 1)
    assert position.tolist() == [1.0, 0.0, 0.0]
    assert velocity.tolist() == [1.0, 0.0, 2.0]
    assert (impacts, left) == (1, 1.0)


def test_a_body_just_behind_the_plane_is_put_on_it():
    position, *_ = bounce_through_step((0, 0, -1e-9), (0, 0, 0), PULL, UP, 0.0, 0.5, 1.0)
    assert position[2] == 0.0


# What is refused, and one is many

STATE = ((0, 0, 1), (0, 0, -1), PULL)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: respond_at_impact(*STATE, UP, 0.5, -1.0, 1.0), "time_of_impact must be zero or positive, not -1"),
        (lambda: respond_at_impact(*STATE, UP, 0.5, math.nan, 1.0), "time_of_impact must be zero or positive, not nan"),
        (lambda: respond_at_impact(*STATE, UP, 0.5, 1.0, -1.0), "dt must be zero or positive, not -1"),
        (lambda: respond_at_impact(*STATE, UP, 1.5, 1.0, 1.0), "restitution must be from 0 to 1, not 1.5"),
        (lambda: respond_at_impact(*STATE, (0, 0, 2), 0.5, 1.0, 1.0), "normal must have length 1, not 2"),
        (lambda: respond_at_step(*STATE, UP, True, 0.5, -1.0), "dt must be zero or positive, not -1"),
        (lambda: respond_at_step(*STATE, (0, 0, 2), True, 0.5, 1.0), "normal must have length 1, not 2"),
        (lambda: respond_at_step(*STATE, UP, True, -0.5, 1.0), "restitution must be from 0 to 1, not -0.5"),
        (lambda: time_until_rest(math.nan, 0.0, -1.0, 0.5), "separation must be finite, not nan"),
        (lambda: time_until_rest(1.0, math.inf, -1.0, 0.5), "normal_velocity must be finite, not inf"),
        (lambda: time_until_rest(1.0, 0.0, math.nan, 0.5), "normal_acceleration must be finite, not nan"),
        (lambda: time_until_rest(1.0, 0.0, -1.0, 1.01), "restitution must be from 0 to 1, not 1.01"),
        (lambda: bounce_along_normal(math.nan, 0.0, -1.0, 0.5, 1.0), "separation must be finite, not nan"),
        (lambda: bounce_along_normal(1.0, math.nan, -1.0, 0.5, 1.0), "normal_velocity must be finite, not nan"),
        (lambda: bounce_along_normal(1.0, 0.0, math.nan, 0.5, 1.0), "normal_acceleration must be finite, not nan"),
        (lambda: bounce_along_normal(1.0, 0.0, -1.0, 2.0, 1.0), "restitution must be from 0 to 1, not 2"),
        (lambda: bounce_along_normal(1.0, 0.0, -1.0, 0.5, -1.0), "dt must be zero or positive, not -1"),
        (lambda: bounce_through_step(*STATE, (0, 0, 2), 0.0, 0.5, 1.0), "normal must have length 1, not 2"),
        (lambda: bounce_through_step((0, 0), *STATE[1:], UP, 0.0, 0.5, 1.0), r"position must have shape \(..., 3\)"),
        (lambda: bounce_through_step(STATE[0], 1.0, PULL, UP, 0.0, 0.5, 1.0), r"velocity must have shape \(..., 3\)"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def scenes(rng, shape):
    position, velocity, acceleration, normal = rng.normal(size=(4, *shape, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    e, dt, time = rng.uniform(0, 1, size=(3, *shape))
    return position, velocity, 10 * acceleration, normal, rng.normal(size=shape), e, dt + 1, 2 * time


def everything(position, velocity, acceleration, normal, offset, e, dt, time):
    s, u, a = offset, velocity[..., 0], acceleration[..., 0]
    return (
        *respond_at_impact(position, velocity, acceleration, normal, e, time, dt),
        *respond_at_step(position, velocity, acceleration, normal, offset < 0, e, dt),
        time_until_rest(s, u, a, e),
        *bounce_along_normal(s, u, a, e, dt),
        *bounce_through_step(position, velocity, acceleration, normal, offset, e, dt),
    )


def test_many_bodies_at_once_are_the_same_as_one_after_another():
    scene = scenes(np.random.default_rng(4), (4, 5))
    together = everything(*scene)
    assert {values.shape for values in together} == {(4, 5, 3), (4, 5)}
    for at in np.ndindex(4, 5):
        for values, one in zip(together, everything(*(part[at] for part in scene)), strict=True):
            # Sums over the last axis may be grouped differently in a batch; a flight after many impacts feels it more
            assert values[at] == pytest.approx(one, rel=1e-9, abs=1e-11)


def test_one_ball_is_dropped_on_many_floors():
    after = bounce_along_normal(1.0, 0.0, -8.0, [0.0, 0.5, 1.0], 0.75)
    assert [part.shape for part in after] == [(3,)] * 4
    assert after[0].tolist() == [0.0, 0.25, 0.75]
    position, velocity = respond_at_impact((0, 0, 1), (0, 0, -2), (0, 0, 0), UP, [0.0, 0.5, 1.0], 0.5, 1.0)
    assert position[:, 2].tolist() == [0.0, 0.5, 1.0]
    assert velocity[:, 2].tolist() == [0.0, 1.0, 2.0]


def test_following_bouncing_bodies_changes_none_of_the_inputs():
    scene = scenes(np.random.default_rng(4), (6,))
    kept = [array.copy() for array in scene]
    for array in scene:
        array.flags.writeable = False  # writing to one would raise
    answers = everything(*scene)
    assert all(np.array_equal(array, copy) for array, copy in zip(scene, kept, strict=True))
    assert not any(np.shares_memory(answer, array) for answer in answers for array in scene)
