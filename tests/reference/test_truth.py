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


@pytest.mark.parametrize(("height", "gravity"), [(1.0, G), (3.0, 1.62)])
def test_the_fall_takes_as_long_and_ends_as_fast_as_in_small_steps(height, gravity):
    (fall,), _ = bounced(height, 0.5, 1, gravity)
    assert truth.fall_time(height, gravity) == pytest.approx(fall, abs=2 * FINE)  # the step of the impact, and rounding
    assert truth.impact_speed(height, gravity) == pytest.approx(gravity * fall, abs=2 * FINE * gravity)


def test_a_bouncing_ball_meets_the_floor_and_tops_as_in_small_steps():
    impacts, apexes = bounced(1.0, 0.8, 4)
    # An impact is seen up to a step late, when the ball is v dt lower: 4.4 m/s × 1e-5 s, a little more at every bounce
    assert truth.bounce_times(1.0, 0.8, G, 4) == pytest.approx(impacts, abs=1e-4)
    assert [truth.apex_ratio(0.8, bounce) for bounce in (1, 2, 3, 4)] == pytest.approx(apexes, abs=1e-3)
    assert truth.apex_ratio(0.8) == truth.apex_ratio(0.8, 1)


def test_the_first_impact_comes_after_the_fall_and_the_next_after_twice_e_times_that():
    fall = math.sqrt(2 / G)
    assert truth.bounce_times(1.0, 0.5, G, 3) == pytest.approx([fall, 2 * fall, 2.5 * fall], rel=1e-15)
    assert truth.bounce_times(1.0, 0.5, G, 1) == pytest.approx([fall], rel=1e-15)
    assert truth.bounce_times(1.0, 0.0, G, 3) == pytest.approx([fall] * 3, rel=1e-15)  # it stays down


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.9])
def test_the_bounces_add_up_to_the_time_of_rest(restitution):
    fall = math.sqrt(2 / G)
    series = fall + sum(2 * restitution**bounce * fall for bounce in range(1, 400))
    assert truth.bounce_end(1.0, restitution, G) == pytest.approx(series, rel=1e-14)  # 0.9^400 is 5e-19
    assert truth.bounce_times(1.0, restitution, G, 400)[-1] == pytest.approx(series, rel=1e-14)


def test_an_elastic_ball_never_rests_and_one_that_is_nearly_so_does_late():
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
    expected = truth.at_step_apex_shift(1.0, restitution, G, dt, recovery)
    # A sawtooth of v dt = 4.4 mm over 200 phases is out by 1/200 of it at the most; the rest is of order g dt² = 1e-5 m
    assert shift == pytest.approx(expected, abs=4e-5)


def test_an_elastic_ball_or_one_whose_overlap_is_taken_back_is_not_shifted():
    assert truth.at_step_apex_shift(1.0, 1.0, G, 1e-3) == 0
    assert truth.at_step_apex_shift(1.0, 0.75, G, 1e-3, recovery=0.25) == 0
    assert truth.at_step_apex_shift(2.0, 0.25, 4.0, 0.5) == pytest.approx(-0.75 * 4.0 * 0.25, rel=1e-15)  # v = 4 m/s


def test_the_slides_t_is_early_by_no_more_than_stated_and_comes_close_to_it():
    gravity, speed, dt = 2.0, 10.0, 1e-3
    heights = np.linspace(0, speed * dt, 1001)[1:-1]
    end = heights - speed * dt - gravity * dt**2 / 2
    exact = np.array([min(root.real for root in np.roots([-gravity / 2, -speed, s]) if root.real > 0) for s in heights])
    early = exact - dt * heights / (heights - end)
    # g dt/v = 2e-4 is left out; roots of numbers near 1e-3 through eigenvalues are good to 1e-15
    assert early.max() == pytest.approx(truth.interpolated_earliness(gravity, dt, speed), rel=1e-3)
    assert early.max() <= truth.interpolated_earliness(gravity, dt, speed) + 1e-15


# Sliding


@pytest.mark.parametrize(("speed", "friction", "gravity"), [(3.0, 0.4, G), (1.0, 0.9, 1.62)])
def test_a_block_on_the_level_stops_where_and_when_it_does_in_small_steps(speed, friction, gravity):
    velocity, way, time = speed, 0.0, 0.0
    while velocity > 0:
        way += velocity * FINE - friction * gravity * FINE**2 / 2
        velocity -= friction * gravity * FINE
        time += FINE
    assert truth.stopping_time(speed, friction, gravity) == pytest.approx(time, abs=2 * FINE)
    assert truth.stopping_distance(speed, friction, gravity) == pytest.approx(way, abs=1e-9)  # μ g FINE² for the last


@pytest.mark.parametrize("steps", [1, 10, 1000])
def test_a_step_method_stops_half_a_step_of_its_first_speed_short(steps):
    dt, friction = 1e-3, 0.5
    speed = steps * friction * G * dt  # it stops at the end of a step
    velocities = speed * (1 - np.arange(1, steps + 1) / steps)
    short = np.sum(velocities) * dt - speed**2 / (2 * friction * G)
    assert truth.semi_implicit_stopping_shift(speed, dt) == pytest.approx(short, rel=1e-9)  # a small difference


@pytest.mark.parametrize("friction", [0.1, 0.5, 1.0, 2.0])
def test_a_block_holds_up_to_the_angle_whose_tangent_is_mu(friction):
    angle = math.atan(friction)
    assert truth.incline_holds(friction, angle - 1e-9)
    assert not truth.incline_holds(friction, angle + 1e-9)
    assert truth.incline_acceleration(friction, angle - 1e-9, G) == 0
    assert 0 < truth.incline_acceleration(friction, angle + 1e-9, G) < 1e-7  # it starts gently


def test_at_its_limit_friction_still_holds():
    assert truth.incline_holds(1.0, math.pi / 4)  # tan is 1 − 1e-16 there
    assert truth.incline_holds(0.0, 0.0)


@pytest.mark.parametrize(("friction", "degrees"), [(0.1, 10.0), (0.3, 40.0), (0.0, 30.0)])
def test_a_block_slides_with_its_weight_along_the_slope_less_mu_times_that_across(friction, degrees):
    slope = math.radians(degrees)
    weight = np.array([0.0, 0.0, -G])
    downhill, normal = np.array([math.cos(slope), 0, -math.sin(slope)]), np.array([math.sin(slope), 0, math.cos(slope)])
    expected = weight @ downhill - friction * -(weight @ normal)
    assert truth.incline_acceleration(friction, slope, G) == pytest.approx(expected, rel=1e-14)


def test_a_step_method_that_starts_from_rest_gains_half_a_step_of_its_last_speed():
    acceleration, dt, steps = 3.0, 1e-2, 200
    way = sum(acceleration * step * dt * dt for step in range(1, steps + 1))
    ahead = way - acceleration * (steps * dt) ** 2 / 2
    assert truth.semi_implicit_sliding_shift(acceleration, dt, steps * dt) == pytest.approx(ahead, rel=1e-11)


# A spring and a dashpot that never pull


def let_go(ratio, speed=1.0, stiffness=1.0):
    """Depth and speed at which the force of m x″ = −k x − c x′ reaches zero, by Runge and Kutta's steps; m = 1 kg."""
    frequency = math.sqrt(stiffness)
    system = np.array([[0.0, 1.0], [-stiffness, -2 * ratio * frequency]])
    dt = 1e-3 / (frequency * (1 + ratio))

    def step(state, dt):
        slopes = [system @ state]
        for part in (dt / 2, dt / 2, dt):
            slopes.append(system @ (state + part * slopes[-1]))
        return state + dt / 6 * (slopes[0] + 2 * slopes[1] + 2 * slopes[2] + slopes[3])

    def force(state):
        return float(system[1] @ state)

    state = np.array([0.0, -speed])  # the surface lies at x = 0, the body comes in from above
    while force(ahead := step(state, dt)) > 0:
        state = ahead
    early, late = 0.0, dt
    for _ in range(60):
        middle = (early + late) / 2
        early, late = (middle, late) if force(step(state, middle)) > 0 else (early, middle)
    depth, velocity = step(state, late)
    return -depth, velocity


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.4, 0.7071067811865476, 0.95, 1.0, 1.05, 3.0])
def test_a_spring_and_dashpot_lets_go_with_the_share_of_the_speed_that_integration_gives(ratio):
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


def test_a_contact_that_is_damped_very_strongly_keeps_one_part_in_four_zeta_squared():
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


def test_no_damping_bounces_fully_and_no_finite_one_not_at_all():
    assert truth.damping_ratio(1.0) == 0
    assert truth.spring_dashpot_restitution(0.0) == 1
    assert 0 <= truth.damping_ratio(math.nextafter(1.0, 0.0)) < 1e-15  # e is 1 − π ζ there
    assert truth.damping_ratio(0.0) == math.inf
    assert truth.damping_ratio(1e-300) > 1e100
