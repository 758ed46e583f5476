"""Reynolds' seek, flee and arrive, and the force that they ask for."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.avoidance import arrive, flee, limited, seek, steering_force

METRES = st.floats(-1e3, 1e3).map(lambda x: round(x, 6))
SPACE = st.tuples(METRES, METRES, METRES).map(np.array)
PLANE = st.tuples(METRES, METRES).map(np.array)
RNG_SEED = 1


def flight(wanted, start, velocity, duration, mass=1.0, response_time=0.2, max_force=math.inf):
    """Steer a body by a wish (position → wanted velocity) with an integrator that is not ours; (2 d, times)."""
    integrate = oracle("scipy.integrate")
    d = len(start)

    def rate(_, state):
        force = steering_force(state[d:], wanted(state[:d]), mass, response_time, max_force)
        return np.r_[state[d:], force / mass]

    times, state = np.linspace(0, duration, 2001), np.r_[start, velocity]
    return integrate.solve_ivp(rate, (0, duration), state, "DOP853", t_eval=times, rtol=1e-10, atol=1e-12).y


@given(SPACE, st.floats(0, 1e3))
def test_a_limit_shortens_what_is_longer_and_keeps_its_direction(vector, largest):
    short, length = limited(vector, largest), np.linalg.norm(vector)
    assert np.linalg.norm(short) == pytest.approx(min(length, largest), rel=1e-15, abs=1e-15)
    assert np.linalg.norm(np.cross(short, vector)) <= 1e-15 * length * largest
    assert short @ vector >= 0
    if length <= largest:
        assert np.array_equal(short, vector)


def test_a_limit_of_zero_stops_and_an_infinite_one_lets_pass():
    assert limited([(3.0, 4.0), (0.0, 0.0)], 0.0).tolist() == [[0.0, 0.0], [0.0, 0.0]]
    assert limited((3.0, 4.0), math.inf).tolist() == [3.0, 4.0]
    assert limited((3.0, 4.0), 2.5).tolist() == [1.5, 2.0]


@pytest.mark.statement(1, oracle="a 3-4-5 triangle, and the angle to the target")
def test_a_body_that_seeks_wants_full_speed_towards_the_target():
    assert seek((1.0, 1.0), (4.0, 5.0), 2.0) == pytest.approx([1.2, 1.6], abs=1e-15)
    assert seek((0.0, 0.0, 0.0), (0.0, 0.0, -0.1), 2.0).tolist() == [0.0, 0.0, -2.0]
    rng = np.random.default_rng(RNG_SEED)
    for position, target in rng.normal(size=(100, 2, 2)):
        wanted = seek(position, target, 3.0)
        heading, bearing = math.atan2(*wanted[::-1]), math.atan2(*(target - position)[::-1])
        assert heading == pytest.approx(bearing, abs=1e-14)
        assert math.hypot(*wanted) == pytest.approx(3.0, rel=1e-15)


@given(st.one_of(st.tuples(SPACE, SPACE), st.tuples(PLANE, PLANE)), st.floats(0, 100))
def test_a_body_that_flees_wants_the_opposite_and_gets_farther_away(places, speed):
    position, target = places
    assert np.array_equal(flee(position, target, speed), -seek(position, target, speed))
    before = np.linalg.norm(position - target)
    after = np.linalg.norm(position + flee(position, target, speed) - target)
    # straight away by the speed times 1 s, up to rounding of 1e3 m; at the target nowhere
    assert after == pytest.approx(before + speed if before > 0 else 0, abs=1e-12)


def test_at_the_target_neither_seeking_nor_fleeing_has_a_direction():
    assert seek((1.0, 2.0), (1.0, 2.0), 5.0).tolist() == [0.0, 0.0]
    assert np.abs(flee((1.0, 2.0, 3.0), (1.0, 2.0, 3.0), 5.0)).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.erratum(1)
def test_as_widely_copied_a_body_that_seeks_flees():
    position, target = np.array([0.0, 0.0]), np.array([3.0, 4.0])
    assert as_printed.seek(position, target, 5.0) == pytest.approx([-3.0, -4.0], abs=1e-15)
    assert as_printed.seek(position, target, 5.0) == pytest.approx(flee(position, target, 5.0), abs=1e-15)

    def distance_after(wish):
        end = flight(lambda p: wish(p, target, 1.0), position, (0.0, 0.0), 2.0)[:2, -1]
        return np.linalg.norm(end - target)

    # v = 1 − exp(−t/τ) from rest with τ = 0.2: after 2 s it has gone 2 − 0.2 (1 − e⁻¹⁰) = 1.800 m
    way = 2 - 0.2 * (1 - math.exp(-10))
    assert distance_after(as_printed.seek) == pytest.approx(5 + way, abs=1e-8)  # the integrator's 1e-10, over 2 s
    assert distance_after(seek) == pytest.approx(5 - way, abs=1e-8)


# The force


def test_the_force_reaches_the_wanted_velocity_in_the_response_time():
    force = steering_force((1.0, 0.0), (3.0, -1.0), 2.0, 0.5, 100.0)
    assert force.tolist() == [8.0, -4.0]
    assert (np.array([1.0, 0.0]) + force / 2.0 * 0.5).tolist() == [3.0, -1.0]


def test_the_force_is_no_larger_than_the_body_can_make_it():
    assert steering_force((0.0, 0.0), (30.0, 40.0), 1.0, 1.0, 5.0) == pytest.approx([3.0, 4.0], rel=1e-15)
    assert steering_force((1.0, 2.0), (1.0, 2.0), 1.0, 1.0, 0.0).tolist() == [0.0, 0.0]


@pytest.mark.statement(1, oracle="the exponential approach v = v_wanted (1 − exp(−t/τ))")
def test_a_velocity_approaches_the_wanted_one_exponentially():
    mass, tau = 3.0, 0.4
    end = flight(lambda _: np.array([2.0, 0.0]), (0.0, 0.0), (0.0, 0.0), 1.0, mass, tau)
    assert end[2, -1] == pytest.approx(2 * (1 - math.exp(-1 / tau)), abs=1e-8)  # the integrator's tolerance, summed


# Arriving


def test_a_body_that_arrives_slows_in_proportion_to_the_distance():
    at = np.array([[8.0, 0.0], [4.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 0.0]])
    wanted = arrive(at, (0.0, 0.0), 3.0, 4.0)
    assert np.abs(wanted[:, 0]) == pytest.approx([3.0, 3.0, 1.5, 0.75, 0.0], rel=1e-15, abs=0)
    assert np.all(wanted[:4, 0] < 0)


@given(SPACE, SPACE, st.floats(0.1, 10), st.floats(0.1, 100))
def test_beyond_the_slowing_radius_arriving_is_seeking(position, target, speed, radius):
    wanted = arrive(position, target, speed, radius)
    distance = np.linalg.norm(target - position)
    share = min(1.0, distance / radius)
    assert wanted == pytest.approx(share * seek(position, target, speed), abs=1e-13 * speed)


@pytest.mark.statement(1, oracle="solve_ivp; the oscillator x″ + x′/τ + v_max x/(R τ) = 0 is critical at R = 4 v_max τ")
@pytest.mark.parametrize("share", [1.0, 1.5, 4.0])
def test_a_slowing_radius_of_four_response_lengths_avoids_overshoot(share):
    speed, tau = 2.0, 0.25
    radius = share * 4 * speed * tau
    path = flight(
        lambda p: arrive(p, (0.0, 0.0, 0.0), speed, radius), (-12.0, 0.0, 0.0), (speed, 0.0, 0.0), 40.0, 1.0, tau
    )
    assert path[0].max() <= 1e-9  # never beyond the target but for the integrator's error
    # slowest for R = 8 m, whose roots are −2 ± √3 per second: after the last 38 s some 8 exp(−10.2) = 3e-4 m are left
    assert abs(path[0, -1]) < 1e-3
    assert np.all(np.diff(path[0]) >= -1e-9)


@pytest.mark.statement(1, oracle="solve_ivp, and the overshoot exp(−π ζ/√(1 − ζ²)) of a damped oscillator")
def test_with_a_shorter_slowing_radius_it_overshoots():
    speed, tau, share = 1.0, 0.5, 0.25
    radius = share * 4 * speed * tau
    start = -radius / 4  # at rest, where all stays linear
    path = flight(lambda p: arrive(p, (0.0, 0.0), speed, radius), (start, 0.0), (0.0, 0.0), 12.0, 1.0, tau)
    damping = math.sqrt(share)  # ζ² = R/(4 v_max τ)
    overshoot = -start * math.exp(-math.pi * damping / math.sqrt(1 - damping**2))
    # 1e-5 of it: 2001 samples of 6 ms miss the top by up to ω² dt²/8 = 2 · 36e-6/8
    assert path[0].max() == pytest.approx(overshoot, rel=2e-5)


@pytest.mark.statement(1, oracle="solve_ivp; braking from v_max within R takes m v_max²/R")
def test_a_body_overshoots_only_if_its_force_is_too_weak_to_brake():
    speed, tau, radius, mass = 4.0, 0.05, 8.0, 3.0

    def farthest(force):
        wish = flight(
            lambda p: arrive(p, (0.0, 0.0), speed, radius), (-20.0, 0.0), (speed, 0.0), 30.0, mass, tau, force
        )
        return wish[0].max()

    needed = mass * speed**2 / radius
    assert farthest(needed) <= 1e-9
    assert farthest(0.3 * needed) > 0.5  # v²/(2 · 0.3 v²/R) = 1.67 R: it cannot but run past the target


def test_a_body_already_at_its_target_stays():
    path = flight(lambda p: arrive(p, (1.0, 2.0), 3.0, 1.0), (1.0, 2.0), (0.0, 0.0), 5.0)
    assert np.all(path[:2] == [[1.0], [2.0]])


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: limited((1.0, 0.0), -1.0), "largest must be zero or positive, not -1"),
        (lambda: seek((0.0, 0.0), (1.0, 0.0), -1.0), "max_speed must be zero or positive, not -1"),
        (lambda: flee((0.0, 0.0), (1.0, 0.0), math.nan), "max_speed must be zero or positive, not nan"),
        (lambda: arrive((0.0, 0.0), (1.0, 0.0), -1.0, 1.0), "max_speed must be zero or positive, not -1"),
        (lambda: arrive((0.0, 0.0), (1.0, 0.0), 1.0, 0.0), "slowing_radius must be positive, not 0"),
        (lambda: steering_force((0.0, 0.0), (1.0, 0.0), 0.0, 1.0, 1.0), "mass must be positive, not 0"),
        (lambda: steering_force((0.0, 0.0), (1.0, 0.0), 1.0, 0.0, 1.0), "response_time must be positive, not 0"),
        (lambda: steering_force((0.0, 0.0), (1.0, 0.0), 1.0, 1.0, -2.0), "max_force must be zero or positive, not -2"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name_and_value(call, complaint):
    with pytest.raises(ValueError, match=complaint):
        call()


def test_many_bodies_steer_as_each_of_them_alone():
    rng = np.random.default_rng(RNG_SEED)
    position, target, velocity = rng.normal(size=(3, 4, 6, 2))
    speed, radius = rng.uniform(0.1, 2, size=(2, 6))
    wanted, force = arrive(position, target, speed, radius), steering_force(velocity, target, speed, radius, 1.0)
    for i, j in np.ndindex(4, 6):
        assert np.array_equal(wanted[i, j], arrive(position[i, j], target[i, j], speed[j], radius[j]))
        assert np.array_equal(force[i, j], steering_force(velocity[i, j], target[i, j], speed[j], radius[j], 1.0))
