from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.catalogue import measure
from reference.errors import RunFailed
from reference.scene.scenario import Body, Box, HalfSpace, Pair, Scenario, Sphere
from reference.scene.settings import Settings
from reference.scene.trajectory import Event, Trajectory

G = 9.81
RADIUS = 0.1
HEIGHT = 1.0
EXACT = 1e-9
"""What a number read from a parabola may be off, SI: rounding of numbers near 1, over sample intervals down to 1e-4."""


def scenario(shape=None, normal=(0.0, 0.0, 1.0), gravity=(0.0, 0.0, -G), mass=1.0):
    body = Body("ball", shape or Sphere(RADIUS), mass=mass, position=(0.0, 0.0, HEIGHT + RADIUS))
    return Scenario("made up", (Body("floor", HalfSpace(normal)), body), (Pair("ball", "floor"),), 1.0, gravity)


def trajectory(times, position, velocity, events=(), made=None, orientation=(1.0, 0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0)):
    """A trajectory whose second body has the given states; whatever is given once holds at every sample."""
    made = made or scenario()
    count = len(times)
    columns = [
        np.stack((np.tile(still, (count, 1)), np.broadcast_to(moving, (count, len(still)))), axis=1)
        for still, moving in (
            ((0.0, 0.0, 0.0), position),
            ((1.0, 0.0, 0.0, 0.0), orientation),
            ((0.0, 0.0, 0.0), velocity),
            ((0.0, 0.0, 0.0), spin),
        )
    ]
    return Trajectory(made, Settings(1e-3), "made up", np.asarray(times, dtype=float), *columns, events=tuple(events))


def upright(gap, normal=(0.0, 0.0, 1.0)):
    """Positions of a ball with that gap, (n,), above a plane through the origin."""
    return (np.asarray(gap) + RADIUS)[:, None] * np.array(normal)


def bounce(times, restitution, gravity=G, count=40):
    """Gap and normal velocity of a ball dropped from 1 m at t = 0, and the instants of its first impacts."""
    fall = math.sqrt(2 * HEIGHT / gravity)
    launches = fall * np.cumsum([1, *(2 * restitution**n for n in range(1, count))])
    speeds = gravity * fall * restitution ** np.arange(1, count + 1)
    after = np.searchsorted(launches, times, side="right") - 1
    since = times - launches[after]
    gap = np.where(after < 0, HEIGHT - gravity * times**2 / 2, speeds[after] * since - gravity * since**2 / 2)
    velocity = np.where(after < 0, -gravity * times, speeds[after] - gravity * since)
    return gap, velocity, launches


def bouncing(times, restitution, normal=(0.0, 0.0, 1.0), gravity=G):
    gap, velocity, launches = bounce(times, restitution, gravity)
    made = scenario(normal=normal, gravity=tuple(-gravity * np.array(normal)))
    return trajectory(times, upright(gap, normal), velocity[:, None] * np.array(normal), made=made), launches


def sampled(end, interval, phase, jitter):
    """Sample times from 0 on: evenly spaced, the first interval cut to `phase`, each moved by a part of `jitter`."""
    times = np.concatenate(([0.0], np.arange(phase * interval, end, interval)))
    moved = np.random.default_rng(1).uniform(-0.5, 0.5, size=len(times)) * jitter * interval
    moved[0] = 0.0
    return np.unique(np.clip(times + moved, 0.0, None))


# Flights read from parabolas

SAMPLINGS = st.tuples(st.sampled_from([2e-4, 1e-3, 7e-3, 0.03]), st.floats(0.05, 1.0), st.sampled_from([0.0, 0.8]))
RESTITUTION = st.floats(0.6, 1.0)


def three_impacts(sampling, restitution):
    """A ball seen until 0.1 s after its third impact: at least three samples of each flight, none of a fifth one."""
    launches = bounce(np.zeros(1), restitution)[2][:3]
    return bouncing(sampled(launches[2] + 0.1, *sampling), restitution)[0], launches


@given(SAMPLINGS, RESTITUTION)
def test_the_apexes_of_a_bouncing_ball_are_exact_however_it_is_sampled(sampling, restitution):
    made, _ = three_impacts(sampling, restitution)
    heights = measure.apex_heights(made, "ball", "floor")
    assert heights == pytest.approx([restitution ** (2 * n) * HEIGHT for n in (1, 2, 3)], abs=EXACT)
    assert measure.first_apex(made, "ball", "floor") == heights[0]


@given(SAMPLINGS, RESTITUTION)
def test_the_instants_of_impact_are_exact_however_the_ball_is_sampled(sampling, restitution):
    made, launches = three_impacts(sampling, restitution)
    assert measure.impact_times(made, "ball", "floor") == pytest.approx(launches, abs=EXACT)


@given(SAMPLINGS, RESTITUTION)
def test_restitution_is_read_from_the_flights_on_both_sides(sampling, restitution):
    made, _ = three_impacts(sampling, restitution)
    assert measure.restitution_coefficients(made, "ball", "floor") == pytest.approx([restitution] * 3, abs=EXACT)


@pytest.mark.parametrize(("phase", "left_out"), [(0.05, 1), (0.25, 1), (0.5, 0), (0.75, 0), (0.95, 1)])
def test_two_impacts_with_an_unseen_flight_between_are_not_one(phase, left_out):
    # The last flight that is seen lasts little more than a sample interval. Whether the one before it, longer by 1/e,
    # holds two samples or only one hangs on the phase.
    made, _ = bouncing(sampled(4.0, 0.02, phase, 0.0), 0.8)
    found = measure.restitution_coefficients(made, "ball", "floor")
    assert len(measure.flights(made, "ball", "floor")) - 1 - len(found) == left_out
    assert found == pytest.approx([0.8] * len(found), abs=EXACT)


def test_flights_are_skipped_only_if_the_body_leaves_the_plane_between():
    # Two samples before, one or none inside a hop of 0.1 s, and two after it, of a ball that keeps its speed
    times = np.array([0.3, 0.35, 0.5, 0.6, 0.7])
    hop = np.array([0.4, 0.55])  # when it leaves the plane and when it is back
    gap = np.select(
        [times < hop[0], times < hop[1]],
        [G / 2 * (hop[0] - times) * (times + 0.6), G / 2 * (times - hop[0]) * (hop[1] - times)],
        G / 2 * (times - hop[1]) * (1.55 - times),
    )
    velocity = np.select(
        [times < hop[0], times < hop[1]], [-G * (times + 0.1), G * (hop.mean() - times)], G * (1.05 - times)
    )
    seen = trajectory(times, upright(gap), velocity[:, None] * (0.0, 0.0, 1.0))
    assert len(measure.flights(seen, "ball", "floor")) == 2
    assert len(measure.restitution_coefficients(seen, "ball", "floor")) == 0
    resting = np.where(times == 0.5, -1e-3, gap)  # pressed in, as by a contact that takes its time
    pressed = trajectory(times, upright(resting), velocity[:, None] * (0.0, 0.0, 1.0))
    assert measure.restitution_coefficients(pressed, "ball", "floor") == pytest.approx([1.0], abs=EXACT)


def test_a_flight_knows_when_and_how_fast_it_began_topped_and_ended():
    made, launches = bouncing(np.arange(0, 1.5, 0.01), 0.8)
    first, second = measure.flights(made, "ball", "floor")[:2]
    speed = math.sqrt(2 * G * HEIGHT)
    assert first.apex_time == pytest.approx(0, abs=EXACT)  # it was let go at rest
    assert first.apex_height == pytest.approx(HEIGHT, abs=EXACT)
    assert first.landing_speed == pytest.approx(speed, abs=EXACT)
    assert first.launch_speed == pytest.approx(speed, abs=EXACT)  # had it come up from the floor
    assert first.launch_time == pytest.approx(-launches[0], abs=EXACT)
    assert second.launch_time == pytest.approx(launches[0], abs=EXACT)
    assert second.landing_time == pytest.approx(launches[1], abs=EXACT)
    assert second.apex_time == pytest.approx((launches[0] + launches[1]) / 2, abs=EXACT)
    assert second.launch_speed == pytest.approx(0.8 * speed, abs=EXACT)
    assert second.landing_speed == pytest.approx(0.8 * speed, abs=EXACT)


def test_flights_above_a_slope_are_read_along_its_normal():
    normal = (0.6, 0.0, 0.8)
    made, launches = bouncing(np.arange(0, 1.5, 0.004), 0.7, normal, gravity=3.0)
    assert measure.first_apex(made, "ball", "floor") == pytest.approx(0.49 * HEIGHT, abs=EXACT)
    assert measure.impact_times(made, "ball", "floor")[0] == pytest.approx(launches[0], abs=EXACT)


def test_gravity_along_the_plane_does_not_affect_the_flights():
    times = np.arange(0, 1.0, 0.01)
    gap, velocity, _ = bounce(times, 0.8)
    across = np.stack((times**2, 0 * times, upright(gap)[:, 2]), axis=1)
    moving = np.stack((2 * times, 0 * times, velocity), axis=1)
    made = trajectory(times, across, moving, made=scenario(gravity=(2.0, 0.0, -G)))
    assert measure.first_apex(made, "ball", "floor") == pytest.approx(0.64, abs=EXACT)


@pytest.mark.parametrize("dt", [1e-4, 1e-3, 4e-3])
@pytest.mark.parametrize("every", [1, 7])
@pytest.mark.parametrize("height", [1.0, 1.0013, 0.9971])
def test_flights_of_semi_implicit_euler_are_read_exactly(dt, every, height):
    # The ball answers at the first step that begins behind the floor. A flight from s with speed u then follows
    # s + (u − g dt/2) t − g t²/2 exactly, so its apex and the end of it are known.
    restitution, gap, velocity = 0.7, height, 0.0
    gaps, velocities, starts = [gap], [velocity], [(0.0, gap, velocity)]
    for step in range(1, round(1.0 / dt)):
        if gap < 0 and velocity < 0:
            velocity *= -restitution
            starts.append(((step - 1) * dt + dt, gap + velocity * dt, velocity))  # the flight's first sample
        else:
            velocity -= G * dt
        gap += velocity * dt
        gaps.append(gap)
        velocities.append(velocity)
    times = np.arange(len(gaps)) * dt
    made = trajectory(times[::every], upright(gaps)[::every], np.array(velocities)[::every, None] * (0.0, 0.0, 1.0))
    flights = measure.flights(made, "ball", "floor")
    assert len(flights) == len(starts) == 2
    for flight, (start, low, speed) in zip(flights, starts, strict=True):
        rise = speed - G * dt / 2
        assert flight.apex_time == pytest.approx(start + rise / G, abs=EXACT)
        assert flight.apex_height == pytest.approx(low + rise**2 / (2 * G), abs=EXACT)
        fall = math.sqrt(2 * (low + rise**2 / (2 * G)) / G)
        assert flight.landing_time == pytest.approx(start + rise / G + fall, abs=EXACT)
        assert flight.landing_speed == pytest.approx(G * fall, abs=EXACT)


def test_two_samples_in_free_fall_make_a_flight():
    made, launches = bouncing(np.array([0.0, 0.1, 0.5, 0.6, 1.15]), 0.8)
    first, second = measure.flights(made, "ball", "floor")
    assert first.landing_time == pytest.approx(launches[0], abs=EXACT)
    assert second.apex_height == pytest.approx(0.64, abs=EXACT)


def test_a_landing_after_the_last_sample_is_no_impact_yet():
    fall = math.sqrt(2 * HEIGHT / G)
    before, _ = bouncing(np.linspace(0, fall - 1e-6, 50), 0.8)
    assert len(measure.impact_times(before, "ball", "floor")) == 0
    between, _ = bouncing(np.append(np.linspace(0, fall - 0.1, 50), fall + 0.1), 0.8)
    assert measure.impact_times(between, "ball", "floor") == pytest.approx([fall], abs=EXACT)
    after, _ = bouncing(np.linspace(0, fall + 0.1, 50), 0.8)
    assert measure.impact_times(after, "ball", "floor") == pytest.approx([fall], abs=EXACT)


def test_a_body_that_lies_on_the_plane_makes_no_flight():
    made = trajectory(np.arange(0, 1, 0.01), upright(np.zeros(100)), np.zeros((100, 3)))
    assert measure.flights(made, "ball", "floor") == []
    assert len(measure.apex_heights(made, "ball", "floor")) == 0
    assert len(measure.impact_times(made, "ball", "floor")) == 0
    assert len(measure.restitution_coefficients(made, "ball", "floor")) == 0


def test_a_fall_behind_the_plane_is_no_flight_above_it():
    times = np.arange(0, 0.5, 0.01)
    made = trajectory(times, upright(-0.5 - G * times**2 / 2), (-G * times)[:, None] * (0.0, 0.0, 1.0))
    assert measure.flights(made, "ball", "floor") == []


@pytest.mark.parametrize(("drag", "counts"), [(0.09, True), (0.11, False), (-0.09, True), (-0.11, False)])
def test_a_flight_may_have_a_little_drag_but_not_much(drag, counts):
    times = np.arange(0, 0.4, 0.01)
    pull = G * (1 - drag)
    made = trajectory(times, upright(HEIGHT - pull * times**2 / 2), (-pull * times)[:, None] * (0.0, 0.0, 1.0))
    assert (len(measure.flights(made, "ball", "floor")) == 1) is counts


def hop(times, launch, rise_pull, fall_pull, top):
    """A flight from gap zero at `launch`, up with one pull and down with another, m/s²: gap and velocity."""
    since = times - launch - math.sqrt(2 * top / rise_pull)  # from the apex
    pull = np.where(since < 0, rise_pull, fall_pull)
    return top - pull * since**2 / 2, -pull * since


def test_under_drag_a_flight_is_read_from_the_nearest_samples():
    # 5 % off gravity on the way up, 3 % on the way down. The parabola of two samples 9 and 19 ms away from an instant
    # is out by 0.03 g · 9 ms · 19 ms/2 = 3e-5 m there; one from the other end of the flight is out by centimetres.
    launch, times = 0.2, 0.2 + np.arange(0.003, 1.0, 0.01)
    gap, velocity = hop(times, launch, 0.95 * G, 0.97 * G, HEIGHT)
    kept = gap > 0
    made = trajectory(times[kept], upright(gap[kept]), velocity[kept, None] * (0.0, 0.0, 1.0))
    (flight,) = measure.flights(made, "ball", "floor")
    apex, fall = launch + math.sqrt(2 * HEIGHT / (0.95 * G)), math.sqrt(2 * HEIGHT / (0.97 * G))
    assert flight.apex_height == pytest.approx(HEIGHT, abs=1e-5)
    assert flight.apex_time == pytest.approx(apex, abs=0.05 * 0.01)  # 5 % of the way to the sample
    assert flight.launch_time == pytest.approx(launch, abs=7e-6)  # 3e-5 m at 4.3 m/s
    assert flight.landing_time == pytest.approx(apex + fall, abs=7e-6)
    assert flight.launch_speed == pytest.approx(math.sqrt(2 * 0.95 * G * HEIGHT), rel=0.03)  # gravity is taken as whole
    assert flight.landing_speed == pytest.approx(math.sqrt(2 * 0.97 * G * HEIGHT), rel=0.02)
    assert flight.landing_speed > 1.005 * flight.launch_speed  # √(0.97/0.95) is 1.01


@pytest.mark.parametrize("backwards", [False, True])
def test_a_hop_whose_parabola_lies_below_the_surface_is_no_flight(backwards):
    # The parabola of a pair of samples τ from the apex tops 0.05 · 0.95 g τ²/2 below the true apex: 2 cm for 0.3 s
    times = np.arange(0, 0.301, 0.01)
    gap, velocity = 0.01 - 0.95 * G * times**2 / 2, -0.95 * G * times
    if backwards:
        gap, velocity = gap[::-1], -velocity[::-1]
    made = trajectory(times, upright(gap), velocity[:, None] * (0.0, 0.0, 1.0))
    assert measure.flights(made, "ball", "floor") == []


def test_a_ball_that_does_not_rebound_has_an_apex_of_zero():
    fall = math.sqrt(2 * HEIGHT / G)
    times = np.linspace(0, 1, 200)
    gap = np.where(times < fall, HEIGHT - G * times**2 / 2, 0.0)
    velocity = np.where(times < fall, -G * times, 0.0)
    made = trajectory(times, upright(gap), velocity[:, None] * (0.0, 0.0, 1.0))
    assert measure.first_apex(made, "ball", "floor") == 0.0


def test_a_ball_that_has_not_come_down_has_no_rebound():
    made, _ = bouncing(np.linspace(0, 0.4, 50), 0.8)  # 0.215 m are left
    with pytest.raises(RunFailed, match="ball never reached floor: there is no rebound to measure"):
        measure.first_apex(made, "ball", "floor")


@pytest.mark.parametrize(("lowest", "came_down"), [(0.15, True), (0.25, False)])
def test_a_body_has_come_down_after_nine_tenths_of_its_gap(lowest, came_down):
    made = trajectory([0.0, 0.5, 0.6], upright([2.0, 1.2, lowest]), (0.0, 0.0, 0.0))
    if came_down:
        assert measure.first_apex(made, "ball", "floor") == 0.0
    else:
        with pytest.raises(RunFailed, match="never reached"):
            measure.first_apex(made, "ball", "floor")


def test_a_rebound_between_two_samples_is_not_overlooked():
    times = np.array([0.0, 0.1, 0.2, 0.3, 0.6, 0.7, 0.8])  # never sampled below half a metre
    made, _ = bouncing(times, 1.0)
    assert measure.separation(made, "ball", "floor").min() > 0.5
    assert measure.first_apex(made, "ball", "floor") == pytest.approx(HEIGHT, abs=EXACT)


# Rest


def slowing(times, stop=0.6, speed=3.0):
    """A body that slides along x and stops at `stop` s: positions and velocities."""
    moving = np.minimum(times, stop)
    way = speed * (moving - moving**2 / (2 * stop))
    velocity = np.where(times < stop, speed * (1 - times / stop), 0.0)
    return np.stack((way, 0 * way, 0 * way + RADIUS), axis=1), velocity[:, None] * (1.0, 0.0, 0.0)


TIMES = np.arange(0, 1.001, 0.01)


def test_the_time_of_rest_is_the_first_sample_that_stays_still():
    assert measure.rest_time(trajectory(TIMES, *slowing(TIMES, stop=0.605)), "ball") == pytest.approx(0.61, abs=1e-12)


def test_a_body_slower_than_a_millimetre_a_second_rests():
    position, velocity = slowing(TIMES, stop=0.6)
    velocity[70, 1] = 0.999e-3
    assert measure.rest_time(trajectory(TIMES, position, velocity), "ball") == pytest.approx(0.6, abs=1e-12)
    velocity[70, 1] = 1.001e-3
    assert measure.rest_time(trajectory(TIMES, position, velocity), "ball") == pytest.approx(0.71, abs=1e-12)
    assert measure.rest_time(trajectory(TIMES, position, velocity), "ball", speed=0.5) == pytest.approx(0.5, abs=1e-12)


def test_a_body_that_is_slow_for_a_moment_does_not_rest():
    velocity = np.cos(np.pi * TIMES)[:, None] * (1.0, 0.0, 0.0)  # it turns round at 0.5 s
    made = trajectory(TIMES, np.sin(np.pi * TIMES)[:, None] * (1.0, 0.0, 0.0), velocity)
    assert measure.rest_time(made, "ball") == math.inf


def test_a_body_that_never_moved_rests_from_the_start():
    assert measure.rest_time(trajectory(TIMES + 0.5, upright(0 * TIMES), (0.0, 0.0, 0.0)), "ball") == 0.5


@pytest.mark.parametrize("kind", ["rest", "stop"])
def test_an_instant_of_rest_that_was_solved_for_is_used_unchanged(kind):
    events = [Event(0.1, "impact", "ball"), Event(0.2, kind, "other"), Event(0.605, kind, "ball")]
    made = trajectory(TIMES, *slowing(TIMES, stop=0.605), events=events)
    assert measure.rest_time(made, "ball") == 0.605


def test_an_event_of_rest_counts_though_its_sample_still_moves():
    velocity = np.where(np.arange(len(TIMES)) <= 40, 1.0, 0.0)[:, None] * (1.0, 0.0, 0.0)
    made = trajectory(TIMES, upright(0 * TIMES), velocity, events=[Event(float(TIMES[40]), "rest", "ball")])
    assert measure.rest_time(made, "ball") == TIMES[40]


def test_a_stop_after_which_the_body_moves_again_is_no_rest():
    velocity = (0.6 - TIMES)[:, None] * (1.0, 0.0, 0.0)  # up a slope and back down
    made = trajectory(TIMES, upright(0 * TIMES), velocity, events=[Event(0.6, "stop", "ball")])
    assert measure.rest_time(made, "ball") == math.inf
    position, velocity = slowing(TIMES, stop=0.8)
    made = trajectory(TIMES, position, velocity, events=[Event(0.3, "rest", "ball"), Event(0.8, "stop", "ball")])
    assert measure.rest_time(made, "ball") == 0.8


def test_the_height_at_rest_is_the_last_gap_above_or_below_the_plane():
    for last in (0.0, 0.25, -0.125):
        gap = np.append(np.linspace(1.0, 0.5, len(TIMES) - 1), last)
        made = trajectory(TIMES, upright(gap), (0.0, 0.0, 0.0))
        assert measure.rest_height(made, "ball", "floor") == pytest.approx(last, abs=1e-15)


def test_the_residual_speed_is_the_largest_within_the_window():
    times = np.arange(11) / 10
    velocity = np.zeros((11, 3))
    velocity[[3, 5, 8]] = (0.0, 7.0, 0.0), (3.0, 4.0, 0.0), (0.0, 0.0, -2.0)
    made = trajectory(times, upright(0 * times), velocity)
    assert measure.residual_speed(made, "ball", 0.5) == 5.0  # the window's first sample belongs to it, rounded or not
    assert measure.residual_speed(made, "ball", 0.45) == 2.0
    assert measure.residual_speed(made, "ball", 0.15) == 0.0
    assert measure.residual_speed(made, "ball", 9.0) == 7.0


def test_the_drift_is_the_largest_distance_from_the_windows_start():
    times = np.arange(11) / 10
    position = np.zeros((11, 3))
    position[:, 0] = [0, 9, 1, 1, 1, 1, 2, 4, 0, 1, 1]
    made = trajectory(times, position, (0.0, 0.0, 0.0))
    assert measure.drift(made, "ball", 0.5) == 3.0  # from 1 to 4, though it comes back
    assert measure.drift(made, "ball", 0.3) == 4.0  # from 4 to 0
    assert measure.drift(made, "ball", 0.1) == 0.0


def test_the_displacement_is_the_straight_line_from_start_to_end():
    position = np.array([[1.0, 1.0, 1.0], [9.0, 9.0, 9.0], [3.0, 2.0, -1.0]])
    assert measure.displacement(trajectory([0, 1, 2], position, (1.0, 0.0, 0.0)), "ball") == 3.0


def test_the_stopping_distance_is_measured_along_the_plane():
    position, velocity = slowing(TIMES)
    made = trajectory(TIMES, position, velocity)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(3.0 * 0.6 / 2, abs=1e-14)
    creeping = position.copy()
    creeping[-1, 0] += 1e-3
    made = trajectory(TIMES, creeping, velocity)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(0.901, abs=1e-14)
    sinking = position - np.linspace(0, 0.1, len(TIMES))[:, None] * (0.0, 0.0, 1.0)
    made = trajectory(TIMES, sinking, velocity)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(0.9, abs=1e-14)
    slope = scenario(normal=(0.6, 0.0, 0.8))
    made = trajectory(TIMES, position, velocity, made=slope)
    assert measure.stopping_distance(made, "ball", "floor") == pytest.approx(0.9 * 0.8, abs=1e-14)


def test_a_body_still_moving_at_the_end_has_no_stopping_distance():
    made = trajectory(TIMES, *slowing(TIMES, stop=1.5))
    with pytest.raises(RunFailed, match="ball still moves at the end: it has no stopping distance"):
        measure.stopping_distance(made, "ball", "floor")


def test_the_deepest_penetration_is_the_largest_overlap_and_never_negative():
    made = trajectory([0, 1, 2, 3], upright([0.5, -0.25, -0.125, 0.5]), (0.0, 0.0, 0.0))
    assert measure.deepest_penetration(made, "ball", "floor") == pytest.approx(0.25, abs=1e-15)
    made = trajectory([0, 1], upright([0.5, 0.25]), (0.0, 0.0, 0.0))
    assert measure.deepest_penetration(made, "ball", "floor") == 0.0


def test_the_gap_of_a_turned_box_is_read_from_its_poses():
    turns = [(1.0, 0.0, 0.0, 0.0), (math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0)]  # lying, then on its side
    made = scenario(Box((0.1, 0.2, 0.3)))
    gaps = measure.separation(trajectory([0, 1], (0, 0, 1), (0, 0, 0), made=made, orientation=turns), "ball", "floor")
    assert gaps == pytest.approx([0.7, 0.8], abs=1e-15)


# Energy and momentum


def points_of(half_extents):
    """Eight points that a box of the same mass cannot be told from by its inertia: at its half lengths over √3."""
    return np.array(list(itertools.product((-1, 1), repeat=3))) * np.array(half_extents) / math.sqrt(3)


def test_the_energy_of_a_spinning_box_is_that_of_its_points():
    rng = np.random.default_rng(4)
    half, mass, gravity = (0.1, 0.2, 0.4), 3.0, (1.0, -2.0, -G)
    count = 20
    position, velocity, spin = rng.normal(size=(3, count, 3))
    turn = rng.normal(size=(count, 4))
    turn /= np.linalg.norm(turn, axis=1, keepdims=True)
    made = scenario(Box(half), gravity=gravity, mass=mass)
    energies = measure.energy(trajectory(np.arange(count), position, velocity, (), made, turn, spin), "ball")
    for at in range(count):
        w, x, y, z = turn[at]
        columns = [
            [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
            [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
        ]
        arms = points_of(half) @ np.array(columns)
        speeds = velocity[at] + np.cross(spin[at], arms)
        kinetic = np.sum(speeds**2) * mass / 8 / 2
        potential = -np.sum((position[at] + arms) @ np.array(gravity)) * mass / 8
        assert energies[at] == pytest.approx(kinetic + potential, abs=1e-12)  # some 30 J, rounded a few dozen times


def test_a_spinning_ball_has_two_fifths_of_its_rims_kinetic_energy():
    made = scenario(Sphere(0.5), mass=2.0, gravity=(0.0, 0.0, 0.0))
    spinning = trajectory([0, 1], (0, 0, 1), (0, 0, 0), made=made, spin=(0.0, 6.0, 0.0))
    moving = trajectory([0, 1], (0, 0, 1), (3, 0, 0), made=made)
    assert measure.energy(moving, "ball").tolist() == [9.0, 9.0]
    assert measure.energy(spinning, "ball") == pytest.approx([3.6, 3.6], abs=1e-15)


def test_a_falling_ball_keeps_its_energy():
    made, _ = bouncing(np.linspace(0, 1, 100), 1.0)
    # m g (h + r) above the origin, rounded a few times
    assert measure.energy(made, "ball") == pytest.approx(np.full(100, G * (HEIGHT + RADIUS)), abs=1e-13)


def test_immovable_bodies_have_no_energy():
    made = trajectory([0, 1], (0, 0, 1), (0, 0, 0))
    with pytest.raises(RunFailed, match="floor is immovable: it has no energy to measure"):
        measure.energy(made, "floor")
    pillar = Scenario("pillar", (Body("floor", HalfSpace()), Body("pillar", Sphere(1.0))), (), 1.0)
    with pytest.raises(RunFailed, match="pillar is immovable: it has no energy to measure"):
        measure.energy(trajectory([0, 1], (0, 0, 1), (0, 0, 0), made=pillar), "pillar")


def test_momentum_adds_up_over_the_bodies_that_can_move():
    bodies = (
        Body("floor", HalfSpace()),
        Body("light", Sphere(0.1), mass=2.0),
        Body("heavy", Sphere(0.1), mass=3.0),
    )
    made = Scenario("two", bodies, (), 1.0)
    velocity = np.zeros((2, 3, 3))
    velocity[:, 1] = (1.0, 0.0, -1.0), (2.0, 0.0, 0.0)
    velocity[:, 2] = (0.0, 1.0, 1.0), (-1.0, 0.0, 0.0)
    still, identity = np.zeros((2, 3, 3)), np.tile([1.0, 0, 0, 0], (2, 3, 1))
    run = Trajectory(made, Settings(1e-3), "made up", np.array([0.0, 1.0]), still, identity, velocity, still)
    assert measure.momentum(run).tolist() == [[2.0, 3.0, 1.0], [1.0, 0.0, 0.0]]
