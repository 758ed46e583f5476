from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from solutions.friction import friction_force, holds, sliding_motion

RNG_SEED = 3
G = 9.81
EPSILON = np.finfo(float).eps
COMPONENT = st.floats(-10, 10).map(lambda value: round(value, 9))  # no numbers that vanish when squared
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
SLIDING = VECTOR.filter(lambda velocity: np.linalg.norm(velocity) > 1e-6)
NORMAL_FORCE = st.floats(0, 100)
COEFFICIENTS = st.tuples(st.floats(0, 2), st.floats(0, 2)).map(sorted).map(lambda pair: (pair[1], pair[0]))
"""Static and kinetic friction, the static one at least the kinetic one."""
ZERO = np.zeros(3)


# What static friction can hold


def test_a_push_exactly_at_the_limit_is_held():
    # 3-4-5, and 0.5 × 10: numbers without rounding
    assert holds((3.0, 4.0, 0.0), 10.0, 0.5)
    assert not holds((3.0, 4.0, 0.0), np.nextafter(10.0, 0.0), 0.5)
    assert not holds((3.0, 4.0, 0.0), 10.0, np.nextafter(0.5, 0.0))


def test_a_body_that_is_not_pushed_is_held_even_on_ice():
    assert holds(ZERO, 10.0, 0.0)
    assert holds(ZERO, 0.0, 0.5)


def test_nothing_is_held_on_ice_or_without_weight():
    assert holds((1e-9, 0.0, 0.0), [10.0, 0.0], [0.0, 0.5]).tolist() == [False, False]


@given(st.floats(0.01, 2), st.floats(0.01, 1.5))
def test_a_block_holds_on_a_slope_up_to_the_angle_of_friction(friction, slope):
    angle = math.atan(friction)
    assume(abs(slope - angle) > 1e-12)  # within rounding of the angle of friction
    weight = 5.0
    push = (weight * math.sin(slope), 0.0, 0.0)
    assert holds(push, weight * math.cos(slope), friction) == (slope < angle)


def test_values_that_are_not_finite_are_refused():
    nothing = (math.nan, 0.0, 0.0)
    for call, name in (
        (lambda: holds(nothing, 1.0, 0.5), "push"),
        (lambda: holds(ZERO, math.inf, 0.5), "normal_force"),
        (lambda: holds(ZERO, 0.0, math.inf), "static_friction"),
        (lambda: friction_force(ZERO, nothing, 1.0, 0.5, 0.3), "tangent_velocity"),
        (lambda: sliding_motion(ZERO, nothing, ZERO, 1.0, 0.5, 0.3, 1.0, 1.0), "tangent_velocity"),
        (lambda: sliding_motion(ZERO, ZERO, ZERO, 1.0, 0.5, 0.3, 1.0, math.inf), "dt"),
    ):
        with pytest.raises(ValueError, match=f"^{name} must be finite"):
            call()


def test_less_static_than_kinetic_friction_is_refused():
    # 3 N break it away from 0.2 × 10 N, and 0.5 × 10 N would win over them
    with pytest.raises(ValueError, match=r"^static_friction must not be less than kinetic_friction"):
        friction_force((3.0, 0.0, 0.0), ZERO, 10.0, 0.2, 0.5)
    assert friction_force((3.0, 0.0, 0.0), ZERO, 4.0, 0.5, 0.5).tolist() == [-2.0, 0.0, 0.0]


# The force


def test_kinetic_friction_is_mu_k_n_against_the_sliding_velocity():
    force = friction_force(ZERO, (3.0, -4.0, 0.0), 10.0, 0.75, 0.5)
    assert force == pytest.approx([-3, 4, 0], abs=1e-15)  # a quotient and a product of numbers near 1


@given(VECTOR, SLIDING, NORMAL_FORCE, COEFFICIENTS, st.floats(1e-3, 1e3))
def test_kinetic_friction_depends_on_neither_speed_nor_push(push, velocity, normal_force, coefficients, factor):
    force = friction_force(push, velocity, normal_force, *coefficients)
    assert friction_force(ZERO, factor * velocity, normal_force, *coefficients) == pytest.approx(force, abs=1e-12)


@given(VECTOR, NORMAL_FORCE, COEFFICIENTS)
def test_a_body_at_rest_is_held_or_breaks_away_along_the_push(push, normal_force, coefficients):
    static, kinetic = coefficients
    size = math.sqrt(push @ push)
    assume(abs(size - static * normal_force) > 1e-12)  # within rounding of the limit
    force = friction_force(push, ZERO, normal_force, static, kinetic)
    if size < static * normal_force or size == 0:
        assert np.array_equal(force, -push)
    else:
        assert force == pytest.approx(-kinetic * normal_force * push / size, abs=1e-12)  # up to 200 N


def test_at_the_limit_friction_drops_from_the_push_to_the_kinetic_value():
    assert friction_force((3.0, 4.0, 0.0), ZERO, 10.0, 0.5, 0.25).tolist() == [-3.0, -4.0, 0.0]
    above = friction_force((3.0, 4.0, 0.0), ZERO, 9.999999, 0.5, 0.25)
    assert above == pytest.approx([-1.5, -2.0, 0.0], abs=1e-6)  # N is 1e-6 short of 10


@given(VECTOR, st.one_of(st.just(ZERO), SLIDING), NORMAL_FORCE, COEFFICIENTS, st.integers(-20, 20))
def test_friction_scales_with_all_the_forces(push, velocity, press, coefficients, power):
    force, factor = friction_force(push, velocity, press, *coefficients), 2.0**power
    found = friction_force(factor * push, velocity, factor * press, *coefficients)
    # A power of two, up to 1e6 and down to 1e-6, rounds nothing that is not next to zero
    assert found == pytest.approx(factor * force, rel=1e-15, abs=1e-300)


def test_a_body_that_neither_moves_nor_is_pushed_feels_no_friction():
    assert np.array_equal(friction_force(ZERO, ZERO, 10.0, 0.5, 0.25), ZERO)
    assert np.array_equal(friction_force(ZERO, ZERO, 0.0, 0.0, 0.0), ZERO)


@given(VECTOR, st.one_of(st.just(ZERO), SLIDING), NORMAL_FORCE, COEFFICIENTS)
def test_friction_never_leaves_its_cone_and_never_drives_the_body(push, velocity, normal_force, coefficients):
    force = friction_force(push, velocity, normal_force, *coefficients)
    limit = coefficients[0] * normal_force
    assert np.linalg.norm(force) <= limit * (1 + 4 * EPSILON)  # a direction is a unit vector to rounding
    assert force @ velocity <= 0
    speed = np.linalg.norm(velocity)
    assert force @ velocity == pytest.approx(-coefficients[1] * normal_force * speed, abs=1e-10)  # up to 3e3 W


@given(VECTOR, st.one_of(st.just(ZERO), SLIDING), NORMAL_FORCE, COEFFICIENTS, st.integers(0, 99))
def test_turning_the_whole_scene_turns_friction(push, velocity, normal_force, coefficients, seed):
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    assume(abs(np.linalg.norm(push) - coefficients[0] * normal_force) > 1e-12)  # rounding decides at the limit
    force = friction_force(push, velocity, normal_force, *coefficients)
    turned = friction_force(turn @ push, turn @ velocity, normal_force, *coefficients)
    assert turned == pytest.approx(turn @ force, abs=1e-12)


# Motion of a body that slides and stops


def slide(velocity, push, normal_force, static, kinetic, mass, dt):
    """The motion from x = 0 along the x axis: place, velocity, time of the stop."""
    along = np.array([1.0, 0.0, 0.0])
    x, v, stop = sliding_motion(0 * along, velocity * along, push * along, normal_force, static, kinetic, mass, dt)
    assert np.all(x[1:] == 0)
    assert np.all(v[1:] == 0)
    return float(x[0]), float(v[0]), float(stop)


@pytest.mark.parametrize("friction", [0.1, 0.5, 1.2])
@pytest.mark.parametrize("speed", [0.1, 3.0])
def test_a_block_on_the_level_stops_after_v_squared_over_two_mu_g(friction, speed):
    mass = 2.5
    x, v, stop = slide(speed, 0.0, mass * G, friction, friction, mass, 10.0)
    assert v == 0
    # Some ten roundings
    assert x == pytest.approx(speed**2 / (2 * friction * G), rel=1e-14)
    assert stop == pytest.approx(speed / (friction * G), rel=1e-14)


def test_a_stop_at_the_very_end_of_the_step_belongs_to_it():
    # v = 2 m/s and 4 m/s² against it: the stop comes after 0.5 s and 0.5 m
    assert slide(2.0, 0.0, 8.0, 1.0, 0.5, 1.0, 0.5) == (0.5, 0.0, 0.5)
    x, v, stop = slide(2.0, 0.0, 8.0, 1.0, 0.5, 1.0, np.nextafter(0.5, 0.0))
    assert x == pytest.approx(0.5, abs=1e-15)
    assert 0 < v < 1e-15
    assert stop == math.inf


def test_a_block_that_does_not_stop_within_the_step_follows_the_parabola():
    assert slide(2.0, 0.0, 8.0, 1.0, 0.5, 1.0, 0.25) == (0.375, 1.0, math.inf)


def test_a_block_at_rest_that_is_held_stays_where_it_is():
    assert slide(0.0, 5.0, 10.0, 0.5, 0.25, 2.0, 3.0) == (0.0, 0.0, math.inf)
    assert slide(0.0, 0.0, 10.0, 0.5, 0.25, 2.0, 3.0) == (0.0, 0.0, math.inf)


def test_a_block_at_rest_that_is_pushed_harder_breaks_away():
    # 6 N are more than 0.5 × 10 N; then 0.25 × 10 N are left against them: (6 − 2.5)/2 = 1.75 m/s²
    assert slide(0.0, 6.0, 10.0, 0.5, 0.25, 2.0, 2.0) == (3.5, 3.5, math.inf)
    assert slide(0.0, -6.0, 10.0, 0.5, 0.25, 2.0, 2.0) == (-3.5, -3.5, math.inf)


def test_a_block_that_slides_up_a_steep_slope_slides_back_more_slowly():
    # Up: (−6 − 2)/1 = −8 m/s² from 4 m/s, so 0.5 s and 1 m. Down: (−6 + 2)/1 = −4 m/s² for the other 0.5 s.
    assert slide(4.0, -6.0, 4.0, 0.5, 0.5, 1.0, 1.0) == (0.5, -2.0, 0.5)


def test_a_block_that_slides_up_a_gentle_slope_stops_and_stays():
    assert slide(4.0, -6.0, 4.0, 1.5, 0.5, 1.0, 1.0) == (1.0, 0.0, 0.5)


def test_without_friction_it_is_free_motion_through_the_turning_point():
    x, v, stop = slide(4.0, -8.0, 10.0, 0.0, 0.0, 1.0, 1.5)
    assert (x, v, stop) == (4 * 1.5 - 4 * 1.5**2, 4 - 8 * 1.5, 0.5)


def small_steps(velocity, push, normal_force, static, kinetic, mass, dt, count=20_000):
    """The same motion in small steps of the mean velocity; out by no more than one step in time."""
    x, v, h = 0.0, velocity, dt / count
    for _ in range(count):
        if v == 0 and abs(push) <= static * normal_force:
            break
        towards = math.copysign(1.0, v if v else push)
        after = v + (push - towards * kinetic * normal_force) / mass * h
        if v and after * v <= 0:
            after = 0.0
        x, v = x + (v + after) / 2 * h, after
    return x, v


@pytest.mark.parametrize(
    ("velocity", "push", "static", "kinetic"),
    [
        (3.0, 0.0, 0.4, 0.3),
        (30.0, 0.0, 0.4, 0.3),
        (3.0, -5.0, 0.4, 0.3),
        (3.0, -12.0, 0.4, 0.3),
        (-3.0, 12.0, 0.4, 0.3),
        (3.0, 12.0, 0.4, 0.3),
        (3.0, 2.0, 0.4, 0.3),
        (0.0, 12.0, 0.4, 0.3),
        (0.0, 7.0, 0.4, 0.3),
        (3.0, -12.0, 1.0, 0.3),
    ],
)
def test_the_motion_is_what_many_small_steps_come_to(velocity, push, static, kinetic):
    mass, normal_force, dt = 2.0, 2 * G, 1.3
    x, v, _ = slide(velocity, push, normal_force, static, kinetic, mass, dt)
    near_x, near_v = small_steps(velocity, push, normal_force, static, kinetic, mass, dt)
    # One small step late at the stop: 65 µs, at up to (12 + 6)/2 m/s² and 30 m/s
    step = dt / 20_000
    assert v == pytest.approx(near_v, abs=9 * step)
    assert x == pytest.approx(near_x, abs=9 * dt * step)


LINE = st.floats(-1, 1).map(lambda value: round(value, 6))
MASS, DURATION = st.floats(0.1, 10), st.floats(0, 3)


@given(SLIDING, LINE, LINE, NORMAL_FORCE, COEFFICIENTS, MASS, DURATION)
def test_friction_never_adds_energy(direction, speed, push, normal_force, coefficients, mass, dt):
    velocity, force = speed * direction, 50 * push * direction
    x, v, _ = sliding_motion(ZERO, velocity, force, normal_force, *coefficients, mass, dt)
    before, after, work = mass * velocity @ velocity / 2, mass * v @ v / 2, force @ x
    # The push may come to 900 N over kilometres: rounding of the work and of the two energies
    assert after <= before + work + 1e-12 * (before + after + abs(work) + 1)


@given(SLIDING, st.floats(0.01, 1), st.floats(0, 1), NORMAL_FORCE, COEFFICIENTS, MASS, DURATION)
def test_what_slides_without_turning_back_loses_mu_k_n_over_its_way(
    direction, speed, push, normal_force, coefficients, mass, dt
):
    velocity, force = speed * direction, push * direction  # pushed on from behind
    x, v, _ = sliding_motion(ZERO, velocity, force, normal_force, *coefficients, mass, dt)
    gained = mass * (v @ v - velocity @ velocity) / 2
    rubbed = coefficients[1] * normal_force * np.linalg.norm(x)
    # It moves along the push or not at all, so its way is its displacement, before a stop and after it. Rounding only.
    assert gained == pytest.approx(force @ x - rubbed, abs=1e-11 * (rubbed + force @ x + mass * velocity @ velocity))


@given(SLIDING, LINE, LINE, NORMAL_FORCE, COEFFICIENTS, MASS, DURATION, st.floats(0, 1))
def test_two_steps_one_after_the_other_are_one_long_step(
    direction, speed, push, normal_force, coefficients, mass, dt, share
):
    velocity, force = speed * direction, 10 * push * direction
    assume(abs(np.linalg.norm(force) - coefficients[0] * normal_force) > 1e-9)  # rounding decides at the limit
    whole = sliding_motion(ZERO, velocity, force, normal_force, *coefficients, mass, dt)
    first = sliding_motion(ZERO, velocity, force, normal_force, *coefficients, mass, share * dt)
    then = sliding_motion(first[0], first[1], force, normal_force, *coefficients, mass, dt - share * dt)
    # A stop within rounding of the seam is seen on either side of it: up to 1e-15 s at up to 4e3 m/s²
    assert then[0] == pytest.approx(whole[0], rel=1e-9, abs=1e-9)
    assert then[1] == pytest.approx(whole[1], rel=1e-9, abs=1e-9)


@given(SLIDING, LINE, LINE, NORMAL_FORCE, COEFFICIENTS, MASS, DURATION, st.integers(0, 99))
def test_turning_and_shifting_the_scene_turns_and_shifts_the_motion(
    direction, speed, push, normal_force, coefficients, mass, dt, seed
):
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    shift = rng.normal(size=3)
    velocity, force = speed * direction, 10 * push * direction
    assume(abs(np.linalg.norm(force) - coefficients[0] * normal_force) > 1e-9)  # rounding decides at the limit
    x, v, _ = sliding_motion(ZERO, velocity, force, normal_force, *coefficients, mass, dt)
    turned = sliding_motion(shift, turn @ velocity, turn @ force, normal_force, *coefficients, mass, dt)
    assert turned[0] - shift == pytest.approx(turn @ x, rel=1e-9, abs=1e-9)  # up to 1e4 m, rounded a dozen times
    assert turned[1] == pytest.approx(turn @ v, rel=1e-9, abs=1e-9)


def test_twice_the_mass_under_twice_the_forces_moves_alike():
    light = sliding_motion(ZERO, (3.0, 0.0, 0.0), (-6.0, 0.0, 0.0), 10.0, 0.4, 0.3, 1.0, 1.0)
    heavy = sliding_motion(ZERO, (3.0, 0.0, 0.0), (-12.0, 0.0, 0.0), 20.0, 0.4, 0.3, 2.0, 1.0)
    for one, other in zip(light, heavy, strict=True):
        assert np.array_equal(one, other)  # factors of two: no rounding


# One is many


def scenes(rng, shape):
    direction = rng.normal(size=(*shape, 3))
    speed, push = rng.normal(size=(2, *shape, 1))
    speed[0] = 0  # some start at rest
    kinetic = rng.uniform(0, 0.5, size=shape)
    normal_force, mass, dt = rng.uniform(0.5, 2, size=(3, *shape))
    position = rng.normal(size=(*shape, 3))
    return position, speed * direction, push * direction, normal_force, kinetic + 0.2, kinetic, mass, dt


def test_many_bodies_at_once_are_the_same_as_one_after_another():
    scene = scenes(np.random.default_rng(RNG_SEED), (4, 25))
    _, velocity, push, normal_force, static, kinetic, _, _ = scene
    held = holds(push, normal_force, static)
    force = friction_force(push, velocity, normal_force, static, kinetic)
    position, after, stop = sliding_motion(*scene)
    assert held.shape == stop.shape == (4, 25)
    assert force.shape == position.shape == after.shape == (4, 25, 3)
    assert 0 < np.isfinite(stop).sum() < 100  # some stop, some do not
    for at in np.ndindex(4, 25):
        assert held[at] == holds(push[at], normal_force[at], static[at])
        one = friction_force(push[at], velocity[at], normal_force[at], static[at], kinetic[at])
        # Sums over the last axis may be grouped differently in a batch
        assert force[at] == pytest.approx(one, abs=1e-14)
        alone = sliding_motion(*(values[at] for values in scene))
        for value, expected in zip((position[at], after[at], stop[at]), alone, strict=True):
            assert value == pytest.approx(expected, rel=1e-13, abs=1e-13)


def test_one_push_is_tried_on_many_floors():
    assert holds((3.0, 4.0, 0.0), 10.0, [0.25, 0.5, 0.75]).tolist() == [False, True, True]
    stops = sliding_motion(ZERO, (2.0, 0.0, 0.0), ZERO, 8.0, [0.5, 1.0], [0.5, 1.0], 1.0, 1.0)
    assert stops[2].tolist() == [0.5, 0.25]
    assert stops[0][:, 0].tolist() == [0.5, 0.25]


def test_following_a_sliding_body_changes_none_of_the_inputs():
    scene = scenes(np.random.default_rng(RNG_SEED), (6,))
    kept = [array.copy() for array in scene]
    for array in scene:
        array.flags.writeable = False  # writing to one would raise
    _, velocity, push, normal_force, static, kinetic, _, _ = scene
    answers = (friction_force(push, velocity, normal_force, static, kinetic), *sliding_motion(*scene))
    holds(push, normal_force, static)
    assert all(np.array_equal(array, copy) for array, copy in zip(scene, kept, strict=True))
    assert not any(np.shares_memory(answer, array) for answer in answers for array in scene)
