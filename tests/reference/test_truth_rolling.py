"""Closed forms of sliding, rolling, spinning and tipping, against small steps and integration."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from reference import truth

G = 9.81
FINE = 1e-5
"""Step of the small steps that closed forms are held against, s."""


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
