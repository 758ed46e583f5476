from __future__ import annotations

import itertools
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


def test_an_impact_that_reverses_its_steps_gain_too_rises_higher():
    # (e (v + g dt))²/(2g) less (e v)²/(2g); the square of g dt is left out, a share g dt/(2v) of it.
    speed, gained = math.sqrt(2 * G), G * 1e-5
    exact = (0.6 * (speed + gained)) ** 2 / (2 * G) - (0.6 * speed) ** 2 / (2 * G)
    assert truth.rebound_shift_of_weighed_step(1.0, 0.6, G, 1e-5) == pytest.approx(exact, rel=gained / speed)


def test_the_slides_t_is_early_by_at_most_the_stated_bound():
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
def test_way_and_time_of_a_sliding_block_agree_with_small_steps(speed, friction, gravity):
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
def test_a_block_on_a_slope_is_pulled_by_its_weight_less_friction(friction, degrees):
    slope = math.radians(degrees)
    weight = np.array([0.0, 0.0, -G])
    downhill, normal = np.array([math.cos(slope), 0, -math.sin(slope)]), np.array([math.sin(slope), 0, math.cos(slope)])
    expected = weight @ downhill - friction * -(weight @ normal)
    assert truth.incline_acceleration(friction, slope, G) == pytest.approx(expected, rel=1e-14)


def test_a_step_method_from_rest_gains_half_a_step_of_its_last_speed():
    acceleration, dt, steps = 3.0, 1e-2, 200
    way = sum(acceleration * step * dt * dt for step in range(1, steps + 1))
    ahead = way - acceleration * (steps * dt) ** 2 / 2
    assert truth.semi_implicit_sliding_shift(acceleration, dt, steps * dt) == pytest.approx(ahead, rel=1e-11)


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


# Rolling


def rolled(speed, friction, slope, duration, surface_speed=0.0, gravity=G, dt=2e-5, soft=1e-4):
    """Way, speed and r ω of a solid ball down a slope, by Runge and Kutta's steps.

    Friction is −μ N u/√(u² + soft²) with the slip u = v − r ω: Coulomb's, but for slips near `soft` (m/s). The ball is
    1 kg; the torque r F turns it by r F/(2/5 m r²), so r ω grows with 5/2 F. `slope` in rad, all else in SI.
    """
    normal, pull = gravity * math.cos(slope), gravity * math.sin(slope)

    def rate(way, v, rw):
        slip = v - rw
        force = -friction * normal * slip / math.sqrt(slip * slip + soft * soft)
        return v, pull + force, -force / 0.4

    state, found = (0.0, speed, surface_speed), []
    for _ in range(round(duration / dt)):
        one = rate(*state)
        two = rate(*(s + dt / 2 * k for s, k in zip(state, one, strict=True)))
        three = rate(*(s + dt / 2 * k for s, k in zip(state, two, strict=True)))
        four = rate(*(s + dt * k for s, k in zip(state, three, strict=True)))
        state = tuple(
            s + dt / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, one, two, three, four, strict=True)
        )
        found.append(state)
    return np.array(found)


@pytest.mark.parametrize(("speed", "friction", "gravity"), [(1.0, 0.3, G), (2.0, 0.6, G), (0.5, 0.4, 1.62)])
def test_a_sliding_ball_begins_to_roll_as_integration_says(speed, friction, gravity):
    start = truth.rolling_start(speed, friction, gravity)
    way, v, rw = rolled(speed, friction, 0.0, 1.5 * start, gravity=gravity, dt=start / 5000).T
    # The soft friction ends slowly: what it leaves of the slip is below 1e-4 m/s after some e-foldings.
    assert v[-1] == pytest.approx(truth.rolling_speed(speed), abs=1e-4)
    assert rw[-1] == pytest.approx(v[-1], abs=1e-4)
    # Slip falls by 7/2 μ g: a line through two instants long before its end cuts zero when rolling begins.
    slip, times = v - rw, start / 5000 * np.arange(1, len(v) + 1)
    rate = (slip[999] - slip[1999]) / (times[1999] - times[999])
    assert times[1999] + slip[1999] / rate == pytest.approx(start, rel=1e-4)
    # 1e-4 m/s at the most for the time that is left after rolling begins.
    assert way[-1] == pytest.approx(truth.rolling_way(speed, friction, gravity, 1.5 * start), abs=1e-4 * start)


def test_a_sliding_ball_rolls_with_five_sevenths_of_its_speed():
    # In closed form, as angular momentum about a point of the floor: m v r + 2/5 m r² ω, before and after.
    for speed in (0.3, 1.0, 7.0):
        assert truth.rolling_speed(speed) * (1 + 0.4) == pytest.approx(speed, rel=1e-15)
        for friction in (0.1, 1.0):  # and the same from v0 − μ g t at the instant when rolling begins
            start = truth.rolling_start(speed, friction, G)
            assert speed - friction * G * start == pytest.approx(truth.rolling_speed(speed), rel=1e-14)


@pytest.mark.parametrize("steps", [7, 70, 700])
def test_a_step_method_rolls_a_seventh_of_a_step_too_short(steps):
    dt, friction = 1e-3, 0.2
    speed = steps * 3.5 * friction * G * dt  # it begins to roll at the end of a step
    sliding = speed - friction * G * dt * np.arange(1, steps + 1)
    assert sliding[-1] == pytest.approx(truth.rolling_speed(speed), rel=1e-12)
    way = dt * (sliding.sum() + 50 * sliding[-1])
    short = way - truth.rolling_way(speed, friction, G, (steps + 50) * dt)
    assert truth.semi_implicit_rolling_shift(speed, dt) == pytest.approx(short, rel=1e-9)  # a small difference
    assert truth.semi_implicit_rolling_shift(speed, dt) == pytest.approx(-speed * dt / 7, rel=1e-14)


@pytest.mark.parametrize("friction", [0.1, 0.3])
@pytest.mark.parametrize("degrees", [5.0, 18.0, 20.0, 40.0])
def test_a_ball_let_go_on_a_slope_rolls_or_slips_as_integration_says(friction, degrees):
    slope, duration, soft = math.radians(degrees), 0.5, 1e-3
    _, v, rw = rolled(0.0, friction, slope, duration, dt=1e-4, soft=soft)[-1]
    share = 2 / 7 * math.tan(slope) / friction  # of the friction that there is
    assert truth.incline_rolls(friction, slope) is (share <= 1)
    # A soft friction gives its share of the whole at the slip soft · share/√(1 − share²): within 3.7 of `soft` for 19°.
    near = soft * (share / math.sqrt(1 - share**2) if share < 1 else 10)
    assert v == pytest.approx(truth.rolling_acceleration(friction, slope, G) * duration, abs=near + 1e-4)
    assert rw / v == pytest.approx(truth.rolling_ratio(friction, slope, G), abs=2 * near / v)


@pytest.mark.parametrize("friction", [0.1, 0.3, 0.6])
def test_a_ball_rolls_up_to_the_slope_whose_tangent_is_seven_halves_mu(friction):
    angle = math.atan(3.5 * friction)
    assert truth.incline_rolls(friction, angle - 1e-9)
    assert not truth.incline_rolls(friction, angle + 1e-9)
    for quantity in (truth.rolling_acceleration, truth.rolling_ratio):
        below, above = quantity(friction, angle - 1e-9, G), quantity(friction, angle + 1e-9, G)
        assert below == pytest.approx(above, rel=1e-7)  # 1e-9 rad of a slope of order one


# A spinning ball that strikes the floor


def struck(velocity, spin, restitution, friction, radius=0.1, mass=1.3, steps=1000, arm=1.0):
    """Velocities and spins (…, 3) after impacts of a solid ball on the floor, their impulses added in small parts.

    As Routh and Stronge do: the normal impulse grows by dp, friction adds up to μ dp against the slip, and never more
    than what ends it; compression ends where the approach does, and restitution adds e times as much impulse. arm: how
    far below the centre it acts, as a share of the radius.
    """
    arm = np.array([0.0, 0.0, -arm * radius])
    inverse = 1 / (0.4 * mass * radius**2)
    velocity, spin = np.array(velocity, dtype=float), np.array(spin, dtype=float)
    # The ball's own, since the normal passes through its centre.
    whole = np.asarray(-mass * velocity[..., 2] * (1 + restitution))[..., None]
    up, limit = whole * [0.0, 0.0, 1.0], np.asarray(friction)[..., None] * whole
    # What the slip changes by for one unit of impulse, straight from Newton's and Euler's laws.
    unit = np.array([1.0, 0.0, 0.0])
    yields = (unit / mass + np.cross(inverse * np.cross(arm, unit), arm))[0]
    for _ in range(steps):
        slip = (velocity + np.cross(spin, arm)) * [1, 1, 0]
        size = np.linalg.norm(slip, axis=-1, keepdims=True)
        part = np.minimum(limit / steps, size / yields)
        impulse = up / steps - part * slip / np.where(size > 0, size, 1.0)
        velocity = velocity + impulse / mass
        spin = spin + inverse * np.cross(arm, impulse)
    return velocity, spin


def test_a_spinning_impact_agrees_with_an_impulse_in_small_parts():
    speed, radius = 4.4, 0.1
    spins, frictions, restitutions = (-60.0, 0.0, 5.0, 20.0, 60.0), (0.0, 0.1, 0.3, 1.0), (0.0, 0.5, 0.8)
    cases = np.array([*itertools.product(spins, frictions, restitutions)])
    still = np.zeros(len(cases))
    velocities, left = struck(
        np.stack([still, still, still - speed], axis=-1), np.outer(cases[:, 0], [0, 1, 0]), cases[:, 2], cases[:, 1]
    )
    for (spin, friction, restitution), velocity, rest in zip(cases, velocities, left, strict=True):
        along, surface = truth.spinning_impact(speed, radius * spin, restitution, friction)
        # The last part that grips is less than a whole one, and is so to rounding: 1000 sums of numbers of order one.
        assert along == pytest.approx(velocity[0], abs=1e-11)
        assert surface == pytest.approx(radius * rest[1], abs=1e-11)
        assert velocity[2] == pytest.approx(restitution * speed, abs=1e-11)


@pytest.mark.parametrize("friction", [0.1, 0.5])
@pytest.mark.parametrize("arm", [0.9, 0.998])
def test_friction_with_a_shorter_arm_leaves_more_speed_and_more_spin(arm, friction):
    speed, spin, restitution = 4.4, 60.0, 0.5
    velocity, left = struck((0.0, 0.0, -speed), (0.0, spin, 0.0), restitution, friction, arm=arm)
    along, surface = truth.spinning_impact(speed, 0.1 * spin, restitution, friction, arm)
    assert along == pytest.approx(velocity[0], abs=1e-11)  # rounding of a thousand sums
    assert surface == pytest.approx(0.1 * left[1], abs=1e-11)
    outside = truth.spinning_impact(speed, 0.1 * spin, restitution, friction)
    assert surface > outside[1]
    grips = friction == 0.5
    assert (along > outside[0]) is grips  # what slips through gets the same push
    if grips and arm == 0.998:  # to first order of 1 − a: 3/7 and 10/7 of it
        assert along / outside[0] - 1 == pytest.approx(3 / 7 * 0.002, rel=0.01)
        assert surface / outside[1] - 1 == pytest.approx(10 / 7 * 0.002, rel=0.01)


def test_gripping_and_slipping_impacts_meet_where_friction_just_grips():
    speed, restitution, friction = 4.4, 0.5, 0.1
    just = 3.5 * friction * (1 + restitution) * speed  # r ω of a ball that grips at the very end
    for off, gripped in ((-1e-6, True), (1e-6, False)):
        along, surface = truth.spinning_impact(speed, just + off, restitution, friction)
        assert (along == pytest.approx(surface, abs=1e-12)) is gripped  # rolling, or not yet
        assert along == pytest.approx(2 / 7 * just, abs=1e-6)


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


# A box that may tip


def standing_or_tipping(b, h, friction, slope):
    """Which motions a box at rest on a slope can begin, by Newton's laws with two edges that push and rub.

    x points downhill, z out of the slope, m = 1, g = 1; edges at (±b, −h). A turn α > 0 takes z to x and so lifts the
    upper edge. Each motion names which edges stay down and whether they slip, which fixes all forces; it counts where
    no edge pulls, friction is within μ N and against the slip, and no edge goes into the slope.
    """
    pull, press, inertia = math.sin(slope), math.cos(slope), (b * b + h * h) / 3
    found = set()
    # On both edges, no turn: N₁ + N₂ = press and the moment about the centre, b (N₁ − N₂) = h F with F uphill.
    for name, force in (("holds", pull), ("slides", friction * press)):
        upper = (press - h * force / b) / 2
        within = force <= friction * press if name == "holds" else pull > force
        if upper >= 0 and within:
            found.add(name)
    # On the lower edge alone. Unknown: N, F uphill, α; a_x = pull − F, a_z = N − press, I α = h F − b N.
    down = [1.0, 0.0, -b], press  # the edge's a_z = N − press − b α is zero
    turn = [-b, h, -inertia], 0.0
    sticks = [0.0, -1.0, -h], -pull  # the edge's a_x = pull − F − h α is zero
    slips = [-friction, 1.0, 0.0], 0.0
    for name, last in (("sticks", sticks), ("slips", slips)):
        rows = (down, turn, last)
        normal, force, alpha = np.linalg.solve([row for row, _ in rows], [value for _, value in rows])
        within = abs(force) <= friction * normal if name == "sticks" else pull - force - h * alpha > 0
        if alpha > 0 and normal >= 0 and within:
            found.add("tips")
    return found


def test_a_box_tips_where_newtons_laws_at_its_edges_allow_nothing_else():
    rng = np.random.default_rng(4)
    seen = set()
    for _ in range(3000):
        b, h = 0.1, float(rng.uniform(0.05, 0.4))
        friction, slope = float(rng.uniform(0.05, 2.0)), float(rng.uniform(0.02, 1.2))
        if min(abs(math.tan(slope) * h / b - 1), abs(friction * h / b - 1), abs(friction / math.tan(slope) - 1)) < 1e-6:
            continue  # at a threshold two motions begin alike
        motions = standing_or_tipping(b, h, friction, slope)
        expected = "tips" if truth.tips(b, h, friction, slope) else None
        expected = expected or ("holds" if truth.incline_holds(friction, slope) else "slides")
        assert motions == {expected}
        seen |= motions
    assert seen == {"holds", "slides", "tips"}


def test_a_box_tips_where_its_weight_acts_outside_its_face():
    b, h = 0.1, 0.2
    for friction, degrees, expected in ((0.7, 26.0, False), (0.7, 27.0, True), (0.3, 27.0, False), (0.49, 60.0, False)):
        assert truth.tips(b, h, friction, math.radians(degrees)) is expected  # arctan ½ = 26.57°


# Impacts of two bodies


def test_the_softness_of_a_rod_agrees_with_the_sum_of_its_parts():
    # A bar of 2 kg, cut into 2000 × 80 cells; its moment about the centre by adding them up, to 1e-6 of it.
    x, z = np.meshgrid((np.arange(2000) + 0.5) / 2000 - 0.5, 0.04 * ((np.arange(80) + 0.5) / 80 - 0.5))
    moment = 2.0 * np.mean(x**2 + z**2)
    for arm in (0.0, 0.2, 0.5):
        softness = 1 / 2.0 + arm**2 / moment  # what a unit impulse does to the centre, and the spin adds at the arm
        assert truth.rod_softness(2.0, arm, 0.5, 0.02) == pytest.approx(softness, rel=1e-6)
    assert truth.rod_softness(1.0, 0.5, 0.5, 0.0) == pytest.approx(4.0, rel=1e-15)  # the end of a thin rod


@given(
    offset=st.floats(0, 1),
    e=st.floats(0, 1),
    mass=st.floats(0.1, 10),
    other=st.floats(0.1, 1e6),
    speed=st.floats(0.1, 9),
)
def test_two_balls_keep_momentum_and_part_with_e_times_the_closing_speed(offset, e, mass, other, speed):
    after, other_after = truth.balls_after(speed, offset, e, mass, other)
    before = np.array([speed, 0.0])
    normal = np.array([-math.sqrt((1 - offset) * (1 + offset)), offset])
    across = np.array([normal[1], -normal[0]])
    near = 1e-12 * speed  # rounding of numbers up to the speed
    assert mass * after + other * other_after == pytest.approx(mass * before, abs=near * (mass + other))
    assert (after - other_after) @ normal == pytest.approx(-e * (before @ normal), abs=near)
    assert after @ across == pytest.approx(before @ across, abs=near)
    assert other_after @ across == pytest.approx(0.0, abs=near)


def test_equal_elastic_balls_part_at_a_right_angle_or_the_striker_stops():
    for offset in (0.1, 0.5, 0.9):
        after, other_after = truth.balls_after(2.0, offset, 1.0, 1.5, 1.5)
        assert after @ other_after == pytest.approx(0.0, abs=1e-15)
    assert truth.balls_after(2.0, 0.0, 1.0, 1.5, 1.5)[0] == pytest.approx([0.0, 0.0], abs=1e-15)


@pytest.mark.parametrize("velocities", [(1, 0, 0, 0, 0), (1, 1, 0, 0, 0), (1, 0, 0.1), (3, -1, 2, 0.5)])
def test_balls_that_swap_velocities_two_at_a_time_end_up_in_order(velocities):
    swapped = list(velocities)
    while any(a > b for a, b in itertools.pairwise(swapped)):
        i = next(i for i in range(len(swapped) - 1) if swapped[i] > swapped[i + 1])
        swapped[i], swapped[i + 1] = swapped[i + 1], swapped[i]
    assert truth.cradle_in_turn(np.array(velocities, dtype=float)).tolist() == swapped


@pytest.mark.parametrize(
    ("velocities", "struck"),
    [((1, 0, 0), 0), ((1, 0, 0, 0, 0), 0), ((1, 1, 0, 0, 0), 1), ((1, 0, 0.1), 0), ((1, 0, 0.5), 0)],
)
def test_simultaneous_impacts_keep_momentum_and_obey_newton_everywhere(velocities, struck):
    before = np.array(velocities, dtype=float)
    after = truth.cradle_at_once(before, struck)
    pushes = np.cumsum(before - after)  # what ball i gives to the next: all that the balls up to i have lost
    parting, closing = np.diff(after), np.maximum(-np.diff(before), 0.0)
    assert pushes[-1] == pytest.approx(0, abs=1e-15)  # momentum
    assert np.all(pushes[:-1] > 0)
    assert parting == pytest.approx(closing, abs=1e-15)  # every contact pushes, so that none parts faster than it must


def test_five_simultaneous_balls_agree_with_the_lecture():
    assert truth.cradle_at_once(np.array([1.0, 0, 0, 0, 0]), 0) == pytest.approx([-0.6, 0.4, 0.4, 0.4, 0.4], abs=1e-15)
    made = truth.cradle_at_once(np.array([1.0, 0.0, 0.1]), 0)
    assert made == pytest.approx([-0.3, 0.7, 0.7], abs=1e-15)
    assert float(made @ made) / 2 == pytest.approx(0.535, abs=1e-15)  # of 0.505


@given(closing=st.floats(0.01, 5), parting=st.floats(0.01, 5))
def test_reversing_every_contact_keeps_momentum_and_energy(closing, parting):
    before = np.array([closing, 0.0, parting])
    after = truth.cradle_turned_back(before)
    assert after.sum() == pytest.approx(before.sum(), rel=1e-14)
    assert float(after @ after) == pytest.approx(float(before @ before), rel=1e-13)


@pytest.mark.parametrize("e", [0.2, 0.5, 0.9, 1.0])
def test_a_contact_noticed_late_misses_e_by_less_than_its_bound(e):
    stiffness, speed = 1e6, 2.0
    ratio = truth.damping_ratio(e)
    for late in (5e-5, 1e-4, 2e-4):
        depth, velocity, dt = speed * late, speed, 1e-7
        while True:
            pull = stiffness * depth + 2 * ratio * math.sqrt(stiffness) * velocity
            if pull <= 0 or depth < 0:
                break
            velocity -= pull * dt
            depth += velocity * dt
        # The little steps: √k dt is 1e-4.
        assert abs(-velocity - e * speed) < truth.coarse_contact(e, stiffness, late) * speed + 1e-3 * speed
    assert truth.coarse_contact(e, math.inf, 1e-3) == 0.0
    assert truth.coarse_contact(0.0, stiffness, 1e-4) == pytest.approx(0.005, rel=1e-12)
