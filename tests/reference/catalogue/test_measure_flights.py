"""Apexes, impacts and flights, read from trajectories that are parabolas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from made_up import EXACT, HEIGHT, G, bounce, bouncing, sampled, scenario, trajectory, upright

from reference.catalogue import measure
from reference.errors import RunFailed

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
