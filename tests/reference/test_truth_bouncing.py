"""Closed forms of falling, bouncing and springs, against small steps and integration."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference import truth

G = 9.81
FINE = 1e-5
"""Step of the small steps that closed forms are held against, s."""


# Falling and bouncing


def bounced(height, restitution, count, gravity=G, dt=FINE):
    """Instants of the first impacts and the apexes after them, in small steps, each exact but for the impacts."""
    gap, velocity, time, impacts, apexes, top = height, 0.0, 0.0, [], [], 0.0
    while len(apexes) < count:
        gap += velocity * dt - gravity * dt * dt / 2
        velocity -= gravity * dt
        time += dt
        top = max(top, gap)
        if gap <= 0:
            if impacts:
                apexes.append(top)
            impacts.append(time)
            velocity, gap, top = -restitution * velocity, 0.0, 0.0
    return impacts[:count], apexes


@pytest.mark.parametrize(("height", "gravity"), [(1.0, G), (0.5, 1.62)])
def test_time_and_speed_of_a_fall_agree_with_small_steps(height, gravity):
    (fall,), _ = bounced(height, 0.5, 1, gravity)
    assert truth.fall_time(height, gravity) == pytest.approx(fall, abs=2 * FINE)  # the step of the impact, and rounding
    assert truth.impact_speed(height, gravity) == pytest.approx(gravity * fall, abs=2 * FINE * gravity)


def test_impacts_and_apexes_of_a_bouncing_ball_agree_with_small_steps():
    impacts, apexes = bounced(1.0, 0.8, 4)
    # An impact is seen up to a step late, when the ball is v dt lower: 4.4 m/s × 1e-5 s, a little more at every bounce
    assert truth.bounce_times(1.0, 0.8, G, 4) == pytest.approx(impacts, abs=1e-4)
    assert [truth.rebound_ratio(0.8, bounce) for bounce in (1, 2, 3, 4)] == pytest.approx(apexes, abs=1e-3)
    assert truth.rebound_ratio(0.8) == truth.rebound_ratio(0.8, 1)


def test_the_second_flight_lasts_twice_e_times_the_fall():
    fall = math.sqrt(2 / G)
    assert truth.bounce_times(1.0, 0.5, G, 3) == pytest.approx([fall, 2 * fall, 2.5 * fall], rel=1e-15)
    assert truth.bounce_times(1.0, 0.5, G, 1) == pytest.approx([fall], rel=1e-15)
    assert truth.bounce_times(1.0, 0.0, G, 3) == pytest.approx([fall] * 3, rel=1e-15)  # it stays down


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.9])
def test_the_flights_add_up_to_the_time_of_rest(restitution):
    fall = math.sqrt(2 / G)
    series = fall + sum(2 * restitution**bounce * fall for bounce in range(1, 400))
    assert truth.bounce_end(1.0, restitution, G) == pytest.approx(series, rel=1e-14)  # 0.9^400 is 5e-19
    assert truth.bounce_times(1.0, restitution, G, 400)[-1] == pytest.approx(series, rel=1e-14)


def test_an_elastic_ball_never_rests_and_a_nearly_elastic_one_does():
    assert truth.bounce_end(1.0, 1.0, G) == math.inf
    assert math.isfinite(truth.bounce_end(1.0, math.nextafter(1.0, 0.0), G))


# What a step method does to a bounce


def apexes_at_step(heights, restitution, recovery, dt):
    """Apexes of balls that answer at the first step that begins in overlap and then take back a share of it."""
    gap, velocity = heights.copy(), np.zeros_like(heights)
    answered = np.zeros(len(heights), dtype=bool)
    apex = np.zeros_like(heights)
    for _ in range(round(1.0 / dt)):
        now = (gap < 0) & ~answered
        gap[now] -= recovery * gap[now]
        velocity = np.where(now, -restitution * velocity, velocity - G * dt)
        gap = gap + velocity * dt
        answered |= now
        apex = np.where(answered, np.maximum(apex, gap), apex)
    return apex


@pytest.mark.parametrize(("restitution", "recovery"), [(0.2, 0.0), (0.5, 0.0), (0.8, 0.0), (0.5, 0.5), (0.8, 0.1)])
def test_the_mean_apex_of_a_step_method_is_shifted_as_derived(restitution, recovery):
    dt, drops = 1e-3, 200
    times = math.sqrt(2 / G) + dt * (np.arange(drops) + 0.5) / drops  # evenly spread over a step
    heights = G * times**2 / 2
    shift = np.mean(apexes_at_step(heights, restitution, recovery, dt) - restitution**2 * heights)
    expected = truth.rebound_shift_at_step(1.0, restitution, G, dt, recovery)
    # A sawtooth of v dt = 4.4 mm over 200 phases is out by 1/200 of it at the most; the rest is of order g dt² = 1e-5 m
    assert shift == pytest.approx(expected, abs=4e-5)


def test_an_apex_is_not_shifted_at_e_of_1_or_where_overlap_is_recovered():
    assert truth.rebound_shift_at_step(1.0, 1.0, G, 1e-3) == 0
    assert truth.rebound_shift_at_step(1.0, 0.75, G, 1e-3, recovery=0.25) == 0
    assert truth.rebound_shift_at_step(2.0, 0.25, 4.0, 0.5) == pytest.approx(-0.75 * 4.0 * 0.25, rel=1e-15)  # v = 4 m/s


# A spring and a dashpot that never pull


def let_go(ratio, speed=1.0, stiffness=1.0):
    """Depth and speed at which the force of m x″ = −k x − c x′ reaches zero, by Runge and Kutta's steps; m = 1 kg."""
    frequency = math.sqrt(stiffness)
    damping, dt = 2 * ratio * frequency, 1e-3 / (frequency * (1 + ratio))

    def force(x, v):
        return -stiffness * x - damping * v

    def step(x, v, dt):
        one = v, force(x, v)
        two = v + dt / 2 * one[1], force(x + dt / 2 * one[0], v + dt / 2 * one[1])
        three = v + dt / 2 * two[1], force(x + dt / 2 * two[0], v + dt / 2 * two[1])
        four = v + dt * three[1], force(x + dt * three[0], v + dt * three[1])
        dx, dv = (a + 2 * b + 2 * c + d for a, b, c, d in zip(one, two, three, four, strict=True))
        return x + dt / 6 * dx, v + dt / 6 * dv

    state = 0.0, -speed  # the surface lies at x = 0, the body comes in from above
    while force(*(ahead := step(*state, dt))) > 0:
        state = ahead
    early, late = 0.0, dt
    for _ in range(60):
        middle = (early + late) / 2
        early, late = (middle, late) if force(*step(*state, middle)) > 0 else (early, middle)
    depth, velocity = step(*state, late)
    return -depth, velocity


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.4, 0.7071067811865476, 0.95, 1.0, 1.05, 3.0])
def test_a_spring_and_dashpot_lets_go_as_integration_says(ratio):
    depth, speed = let_go(ratio)
    # Fourth-order steps of 1e-3 of the contact's own time: 1e-12 a step, a few thousand steps
    assert truth.spring_dashpot_restitution(ratio) == pytest.approx(speed, abs=1e-9)
    assert truth.spring_dashpot_exit_depth(ratio, 1.0, 1.0) == pytest.approx(depth, abs=1e-9)


@pytest.mark.parametrize("ratio", [0.3, 2.0])
def test_a_faster_body_and_a_softer_spring_let_go_deeper(ratio):
    depth, speed = let_go(ratio, speed=4.0, stiffness=25.0)
    assert truth.spring_dashpot_restitution(ratio) == pytest.approx(speed / 4.0, abs=1e-9)
    assert truth.spring_dashpot_exit_depth(ratio, 4.0, 25.0) == pytest.approx(depth, abs=1e-9)


def test_restitution_changes_smoothly_through_critical_damping():
    assert truth.spring_dashpot_restitution(1.0) == math.exp(-2)
    for near in (1 - 1e-7, 1 - 1e-12, 1 + 1e-12, 1 + 1e-7):
        # The slope at ζ = 1 is −(4/3) e⁻²; s = √|1 − ζ²| is known to 1e-16/s, 1e-9 as a share for the nearest
        expected = math.exp(-2) * (1 - 4 / 3 * (near - 1))
        assert truth.spring_dashpot_restitution(near) == pytest.approx(expected, abs=1e-9)


def test_a_strongly_damped_contact_keeps_one_part_in_four_zeta_squared():
    for ratio in (1e3, 1e4, 1e6, 1e9):
        # The next term is a share of ln(2ζ)/ζ²
        share = 2 * math.log(2 * ratio) / ratio**2 + 1e-13
        assert truth.spring_dashpot_restitution(ratio) == pytest.approx(1 / (4 * ratio**2), rel=share)


@pytest.mark.parametrize(
    ("restitution", "ratio"),
    [
        (0.95, 0.016498),
        (0.9, 0.034265),
        (0.8, 0.074355),
        (0.7, 0.122215),
        (0.5, 0.255276),
        (0.3, 0.497239),
        (0.2, 0.731247),
    ],
)
def test_the_damping_ratio_of_a_restitution_is_the_known_one(restitution, ratio):
    assert truth.damping_ratio(restitution) == pytest.approx(ratio, abs=5e-7)  # half of the last digit given


@given(st.floats(1e-12, 0.999))
def test_the_damping_ratio_and_the_restitution_are_inverse(restitution):
    # Bisection ends at neighbouring floats; s = √(1 − ζ²) has half the digits only within 1e-9 of ζ = 1
    assert truth.spring_dashpot_restitution(truth.damping_ratio(restitution)) == pytest.approx(restitution, rel=1e-8)


def test_no_damping_bounces_fully_and_only_infinite_damping_not_at_all():
    assert truth.damping_ratio(1.0) == 0
    assert truth.spring_dashpot_restitution(0.0) == 1
    assert 0 <= truth.damping_ratio(math.nextafter(1.0, 0.0)) < 1e-15  # e is 1 − π ζ there
    assert truth.damping_ratio(0.0) == math.inf
    assert truth.damping_ratio(1e-300) > 1e100


# Walls


@pytest.mark.parametrize("restitution", [0.5, 0.8, 1.0])
def test_impacts_between_two_walls_agree_with_small_steps(restitution):
    gap, speed, dt, found = 0.8, 2.0, 1e-4, []
    place, velocity, time = 0.0, speed, 0.0
    while len(found) < 4:
        place, time = place + velocity * dt, time + dt
        if not 0 <= place <= gap:
            beyond = place - (gap if place > gap else 0.0)
            found.append(time - beyond / velocity)
            velocity = -restitution * velocity
            place = place - beyond - restitution * beyond  # the rest of the step, at the new speed
    # Straight flights, each impact within its step: rounding of some 1e-16 in each of 40 000 steps.
    assert truth.wall_impacts(gap, speed, restitution, 4) == pytest.approx(found, abs=1e-11)
