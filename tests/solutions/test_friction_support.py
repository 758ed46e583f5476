"""The normal force, breaking away, sticking and slipping, the cone and the pyramid; and the slide as printed."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.friction import (
    break_away_time,
    clamp_to_circle,
    clamp_to_square,
    friction_force,
    friction_impulse,
    holds,
    sliding_motion,
    sphere_impact,
    support_force,
)

G = 9.81
UP, X, Y = np.eye(3)[2], np.eye(3)[0], np.eye(3)[1]
DOWN, STILL = -G * UP, np.zeros(3)
COMPONENT = st.floats(-10, 10).map(lambda value: round(value, 6))
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
ANGLE = st.floats(0.0, 1.5)


# The normal force is not the weight


@pytest.mark.statement(24, oracle="the balance of forces on an incline")
@given(ANGLE, st.floats(0.1, 100))
def test_an_incline_supports_m_g_cos_theta_and_friction_m_g_sin_theta(slope, mass):
    n = np.array([math.sin(slope), 0.0, math.cos(slope)])
    press, along = support_force(mass, DOWN, STILL, STILL, n)
    # a handful of roundings of the weight
    assert press == pytest.approx(mass * G * math.cos(slope), abs=1e-14 * mass * G)
    assert np.linalg.norm(along) == pytest.approx(mass * G * math.sin(slope), abs=1e-14 * mass * G)


@pytest.mark.statement(24, oracle="the balance of forces, by hand")
def test_pushing_down_on_a_crate_adds_to_its_support_force():
    # 3-4-5: 10 N at 6 N down and 8 N along, on 2 kg in 10 m/s²
    press, along = support_force(2.0, (0.0, 0.0, -10.0), [[8.0, 0.0, -6.0], [8.0, 0.0, 6.0]], STILL, UP)
    assert press.tolist() == [26.0, 14.0]
    assert along.tolist() == [[8.0, 0.0, 0.0], [8.0, 0.0, 0.0]]
    # the same push holds or breaks away as its vertical part says, for 0.4 × 26 = 10.4 and 0.4 × 14 = 5.6
    assert holds(along, press, 0.4).tolist() == [True, False]


def test_a_crate_slides_when_its_lorry_brakes_harder_than_mu_g():
    for braking, held in ((0.49 * G, True), (0.51 * G, False)):
        press, along = support_force(3.0, DOWN, STILL, -braking * X, UP)
        assert along == pytest.approx(3 * braking * X, abs=1e-14)
        assert holds(along, press, 0.5) == held


def test_in_a_lift_the_normal_force_is_m_times_g_plus_a():
    lifts = np.outer([2.0, -2.0, -G, -2 * G], UP)
    pressed, _ = support_force(3.0, DOWN, STILL, lifts, UP)
    assert pressed == pytest.approx([3 * (G + 2), 3 * (G - 2), 0.0, 0.0], abs=1e-14)  # rounding of 35 N


def test_a_body_that_is_lifted_off_is_not_pulled_back():
    press, along = support_force(1.0, DOWN, (1.0, 0.0, 15.0), STILL, UP)
    assert press == 0
    assert not holds(along, press, 10.0)


@given(VECTOR, st.integers(0, 99))
def test_normal_and_tangential_parts_add_up_to_the_force(force, seed):
    n = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0][0]
    press, across = support_force(1.0, STILL, force, STILL, n)
    assert press == pytest.approx(max(0.0, -(force @ n)), abs=1e-14)
    assert across @ n == pytest.approx(0, abs=1e-14)  # rounding of 17 N
    assert across + (force @ n) * n == pytest.approx(force, abs=1e-14)
    assert np.hypot(np.linalg.norm(across), force @ n) == pytest.approx(np.linalg.norm(force), abs=1e-13)


@pytest.mark.statement(24, oracle="MuJoCo's contact forces")
def test_mujoco_finds_the_same_normal_force_under_a_pushed_block(installed):
    mujoco = installed("mujoco").module()
    slope = math.radians(20)
    gravity = (G * math.sin(slope), 0.0, -G * math.cos(slope))
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco><option timestep="0.001" gravity="{gravity[0]} 0 {gravity[2]}" cone="elliptic"/><worldbody>
        <geom type="plane" size="5 5 1" friction="1 0 0"/>
        <body pos="0 0 .05"><freejoint/><geom type="box" size=".2 .2 .05" mass="2" friction="1 0 0"/></body>
        </worldbody></mujoco>"""
    )
    data, push = mujoco.MjData(model), np.array([-3.0, 1.0, -5.0])
    data.xfrc_applied[1, :3] = push
    mujoco.mj_step(model, data, 3000)
    total, one = np.zeros(2), np.zeros(6)
    for contact in range(data.ncon):
        mujoco.mj_contactForce(model, data, contact, one)
        total += [one[0], 0]
    # MuJoCo creeps: what is left of the acceleration is below 1e-5 of the weight
    assert total[0] == pytest.approx(float(support_force(2.0, gravity, push, STILL, UP)[0]), rel=1e-4)


def test_a_block_stays_on_the_steepest_slope_and_on_none_steeper():
    for friction in (0.1, 0.5, 2.0):
        critical = math.atan(friction)
        for slope, held in ((critical - 1e-12, True), (critical + 1e-12, False)):  # some roundings aside
            n = np.array([math.sin(slope), 0.0, math.cos(slope)])
            press, along = support_force(1.0, DOWN, STILL, STILL, n)
            assert holds(along, press, friction) == held


def test_at_exactly_the_angle_of_friction_a_block_rests():
    # 3-4-5: sin 0.6, cos 0.8, so that 6 N pull at a weight of 10 N and 8 N press it on, without rounding
    n = np.array([0.6, 0.0, 0.8])
    force = np.array([0.0, 0.0, -10.0])
    press, push = support_force(1.0, force, STILL, STILL, n)
    assert holds(push, press, 0.75)
    assert friction_force(push, STILL, press, 0.75, 0.5).tolist() == (-push).tolist()
    assert np.linalg.norm(friction_force(push, STILL, press, 0.75, 0.5)) == 0.75 * press
    assert break_away_time(force, STILL, n, 0.75) == np.inf
    assert sliding_motion(STILL, STILL, push, press, 0.75, 0.5, 1.0, 9.0)[1].tolist() == [0, 0, 0]
    assert not holds(push, press, np.nextafter(0.75, 0))


# Breaking away


@pytest.mark.statement(24, oracle="arithmetic by hand")
def test_a_growing_push_breaks_a_crate_away_when_it_reaches_mu_n():
    assert break_away_time((0, 0, -20.0), (2.0, 0, 0), UP, 0.5) == 5.0  # 2 t = 0.5 × 20
    assert break_away_time((4.0, 0, -20.0), (2.0, 0, 0), UP, 0.5) == 3.0
    assert break_away_time((-4.0, 0, -20.0), (2.0, 0, 0), UP, 0.5) == 7.0  # first it lets go, then it turns round
    assert break_away_time((0, 0, -20.0), (-2.0, -0.0, -0.0), UP, 0.5) == 5.0  # N stays, with either sign of zero


@pytest.mark.statement(24, oracle="arithmetic by hand")
def test_a_lifting_push_breaks_away_sooner_and_a_steep_press_never():
    # 2 t = 0.5 (20 − t), and 2 t = 0.5 (20 + t); from above at 0.5 × 4 t = 2 t + …: never
    times = break_away_time((0, 0, -20.0), [[2.0, 0, 1.0], [2.0, 0, -1.0], [2.0, 0, -4.0]], UP, 0.5)
    assert times == pytest.approx([4.0, 20 / 3, np.inf], rel=1e-14)


@given(VECTOR, VECTOR, st.floats(0.05, 2), st.integers(-20, 20), st.integers(-20, 20))
def test_units_of_force_and_time_do_not_change_when_it_breaks_away(force, rate, friction, newtons, seconds):
    # Powers of two, up to 1e6 and down to 1e-6, round nothing
    force = force * [0.1, 0.1, 1]
    time = break_away_time(force, rate, UP, friction)
    there = break_away_time(force * 2.0**newtons, rate * 2.0 ** (newtons - seconds), UP, friction)
    assert there == time * 2.0**seconds


def test_a_body_that_is_not_held_breaks_away_now():
    assert break_away_time((11.0, 0, -20.0), STILL, UP, 0.5) == 0
    assert break_away_time((0, 0, 1.0), STILL, UP, 0.5) == 0  # no longer on the ground
    assert break_away_time((0, 0, -20.0), (0, 0, 4.0), UP, [0.0, 0.5]).tolist() == [5.0, 5.0]
    assert break_away_time((0, 0, -20.0), STILL, UP, [0.0, 0.5]).tolist() == [np.inf, np.inf]
    assert break_away_time((10.0, 0, -20.0), STILL, UP, 0.5) == np.inf  # exactly at the limit, for ever
    assert break_away_time((10.0, 0, -20.0), X, UP, 0.5) == 0  # at the limit and growing
    assert break_away_time((0, 0, -20.0), X, UP, 0.0) == 0  # on ice
    # what merely touches, and is pressed on from now: within the cone, outside it, and lifted
    assert break_away_time(STILL, [(0.5, 0, -1.0), (0.6, 0, -1.0), (0, 0, 1.0)], UP, 0.5).tolist() == [np.inf, 0, 0]


def test_the_instant_of_breaking_away_keeps_its_digits():
    # N = 20 − t, and the push along x is 3 + rate t, which ends nearly when N does; b² − a c cancels to half its digits
    for friction, rate in ((0.5, -3 / 20 + 1e-9), (0.3, -3 / 20 - 1e-8), (1.5, -3 / 20 + 1e-12), (0.7, -3 / 20)):
        mu, exact = Fraction(friction), Fraction(rate)
        leaves = min((20 * mu - 3) / (exact + mu), (20 * mu + 3) / (mu - exact))  # forwards, or backwards
        time = break_away_time((3.0, 0, -20.0), (rate, 0, 1.0), UP, friction)
        assert time == pytest.approx(float(leaves), rel=1e-14)  # some ten roundings, none of them enlarged


@given(VECTOR, st.floats(0.05, 2), st.integers(0, 99))
def test_at_the_limit_breaking_away_and_holding_agree(force, friction, seed):
    # Scaled to the limit as well as rounding allows: F_t² − μ²N² is then a rounding of either sign
    n = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0][0]
    _, across = support_force(1.0, STILL, force, STILL, n)
    assume(np.linalg.norm(across) > 1e-3)
    force = across - np.linalg.norm(across) / friction * n
    press, along = support_force(1.0, STILL, force, STILL, n)
    held = holds(along, press, friction)
    time = break_away_time(force, n * [0.0, 0.0, 0.0], n, friction)
    assert time == (np.inf if held else 0)
    assert 0 <= break_away_time(force, across, n, friction) <= 1e-14  # grows from there: at once, but for rounding


@pytest.mark.statement(24, oracle="scipy's brentq on the cone")
@given(VECTOR, VECTOR, st.floats(0.05, 2), st.integers(0, 99))
def test_a_body_is_held_until_it_breaks_away_and_not_after(force, rate, friction, seed):
    optimize = oracle("scipy.optimize")
    n = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0][0]
    assume(np.linalg.norm(rate) > 0.1)

    def beyond(t):  # positive outside the cone, and off the ground
        f = force + t * rate
        return np.linalg.norm(f - (f @ n) * n) + friction * (f @ n)

    time = float(break_away_time(force, rate, n, friction))
    assume(abs(beyond(0.0)) > 1e-6)
    if beyond(0.0) > 0:
        assert time == 0
    elif np.isinf(time):
        assert beyond(1e3) <= 0
    else:
        # the function is convex, so that it has one root here; brentq is asked for 1e-12 of it
        assume(time < 1e4)
        there = optimize.brentq(beyond, 0.0, 2 * time + 1, xtol=1e-12, rtol=1e-12)
        slope = (beyond(there + 1e-4) - beyond(there)) / 1e-4
        assert time == pytest.approx(there, abs=1e-11 * (1 + time) / min(1.0, slope))  # flat where it grazes the cone


# A circle, not a square


@pytest.mark.statement(24, oracle="the nearest point of the circle")
@given(VECTOR, st.floats(0, 20))
def test_the_circle_gives_the_nearest_force_within_it(force, limit):
    force = force * [1, 1, 0]
    given_ = clamp_to_circle(force, limit)
    assert np.linalg.norm(given_) <= limit * (1 + 1e-15)
    angles = np.linspace(0, 2 * np.pi, 721)
    rim = limit * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=-1)
    nearest = min(np.linalg.norm(force - rim, axis=-1).min(), np.inf if np.linalg.norm(force) > limit else 0.0)
    assert np.linalg.norm(force - given_) <= nearest + 1e-12
    assert np.cross(force, given_) == pytest.approx(np.zeros(3), abs=1e-12)  # the direction stays


def test_friction_is_complete_without_a_limit_and_zero_without_weight():
    assert clamp_to_circle((3.0, 4.0, 0.0), [np.inf, 5.0, 2.5, 0.0]).tolist() == [
        [3.0, 4.0, 0.0],
        [3.0, 4.0, 0.0],
        [1.5, 2.0, 0.0],
        [0.0, 0.0, 0.0],
    ]
    assert clamp_to_circle(STILL, 0.0).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.statement(24, oracle="geometry of the square")
def test_a_pyramid_is_root_two_too_strong_along_its_diagonal():
    assert clamp_to_square((9.0, 0.0, 0.0), 2.0, X, Y).tolist() == [2.0, 0.0, 0.0]
    assert clamp_to_square((9.0, -9.0, 0.0), 2.0, X, Y).tolist() == [2.0, -2.0, 0.0]
    assert clamp_to_square((1.0, -1.5, 0.0), 2.0, X, Y).tolist() == [1.0, -1.5, 0.0]
    # size: from 1 to √2; direction: far beyond the limit always the diagonal, up to 45° off
    for angle in np.radians([1.0, 20.0, 30.0, 44.0]):
        direction = np.array([math.cos(angle), math.sin(angle), 0.0])
        force = clamp_to_square(1e6 * direction, 2.0, X, Y)
        assert np.linalg.norm(force) == pytest.approx(2 * math.sqrt(2), rel=1e-15)
        assert math.atan2(force[1], force[0]) == pytest.approx(math.pi / 4, abs=1e-15)
        round_ = clamp_to_circle(1e6 * direction, 2.0)
        assert math.atan2(round_[1], round_[0]) == pytest.approx(angle, abs=1e-15)


@given(VECTOR, st.floats(0.1, 10), st.floats(0, 6))
def test_turning_the_axes_changes_the_pyramid_by_at_most_root_two(force, limit, angle):
    force = force * [1, 1, 0]
    x = np.array([math.cos(angle), math.sin(angle), 0.0])
    size = np.linalg.norm(clamp_to_square(force, limit, x, np.cross(UP, x)))
    assert np.linalg.norm(clamp_to_circle(force, limit)) - 1e-12 <= size <= math.sqrt(2) * limit * (1 + 1e-14)


def test_under_a_pyramid_an_oblique_slide_curves_and_stops_short():
    path = {}
    for name in ("circle", "square"):
        p, v, dt = np.zeros(3), np.array([3.0, 1.0, 0.0]), 1e-3
        for _ in range(1200):
            stop = -v / dt  # the force per mass that would end it within the step
            limit = 0.3 * G
            v = v + dt * (clamp_to_circle(stop, limit) if name == "circle" else clamp_to_square(stop, limit, X, Y))
            p = p + dt * v
        path[name] = p
    way = 10 / (2 * 0.3 * G)
    assert np.linalg.norm(path["circle"]) == pytest.approx(way, abs=2e-3)  # v dt/2 of a first-order step
    assert path["circle"][1] / path["circle"][0] == pytest.approx(1 / 3, rel=1e-10)
    # each component stops for itself: 9 and 1 over 2 μ g
    assert path["square"][:2] == pytest.approx([9 / (0.6 * G), 1 / (0.6 * G)], abs=2e-3)


# The slide


@pytest.mark.erratum(24)
def test_as_printed_static_friction_sets_an_unpushed_block_in_motion():
    printed = as_printed.static_friction_force(20.0, 0.5)
    assert printed == 10.0  # N, though nothing pushes
    assert friction_force(STILL, STILL, 20.0, 0.5, 0.3).tolist() == [0.0, 0.0, 0.0]
    pushed = friction_force((4.0, 0, 0), STILL, 20.0, 0.5, 0.3)
    assert pushed.tolist() == [-4.0, 0.0, 0.0]
    assert (4.0 - printed) / 2 == -3.0  # m/s² backwards, for a block of 2 kg that is pushed forwards
    assert np.linalg.norm(friction_force((10.0, 0, 0), STILL, 20.0, 0.5, 0.3)) == printed  # right at the limit alone


# What is refused


@pytest.mark.parametrize(
    "call",
    [
        lambda mu: holds(X, 1.0, mu),
        lambda mu: friction_force(X, X, 1.0, mu, 0.5),
        lambda mu: sliding_motion(X, X, STILL, 1.0, mu, 0.5, 1.0, 1.0),
        lambda mu: break_away_time(DOWN, X, UP, mu),
        lambda mu: sphere_impact(DOWN, X, UP, 0.1, 0.5, mu),
        lambda mu: friction_impulse(DOWN, UP, np.eye(3), 0.5, mu),
    ],
)
def test_every_law_of_friction_refuses_an_infinite_coefficient(call):
    # A wall presses nothing on: 0 N times infinity says neither that it holds a body nor that it does not.
    with pytest.raises(ValueError, match=r"friction.* must be finite, not inf$"):
        call(math.inf)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda: support_force(-1.0, DOWN, STILL, STILL, UP), "mass"),
        (lambda: support_force(0.0, DOWN, STILL, STILL, UP), "mass must be positive, not 0"),
        (lambda: support_force(1.0, DOWN[:2], STILL, STILL, UP), "gravity"),
        (lambda: support_force(1.0, DOWN, STILL, STILL, 2 * UP), "normal"),
        (lambda: support_force(1.0, DOWN, DOWN[:2], STILL, UP), "push"),
        (lambda: break_away_time(DOWN, X, UP, math.nan), "static_friction"),
        (lambda: break_away_time(DOWN, X, 2 * UP, 0.1), "normal"),
        (lambda: clamp_to_circle(X, -1.0), "limit"),
        (lambda: clamp_to_square(X, -1.0, X, Y), "limit"),
        (lambda: clamp_to_square(X, 1.0, 2 * X, Y), "axis_x"),
        (lambda: clamp_to_square(X, 1.0, X, 2 * Y), "axis_y"),
        (lambda: clamp_to_square(X, 1.0, X, 0.6 * X + 0.8 * Y), "axis_x and axis_y must be at right angles"),
        (lambda: support_force(np.inf, DOWN, STILL, STILL, UP), "mass must be finite"),
        (lambda: break_away_time(DOWN, np.nan * X, UP, 0.1), "force_rate must be"),
        (lambda: break_away_time(DOWN + np.nan, X, UP, 0.1), "force must be finite"),
        (lambda: break_away_time(DOWN, X, UP, np.inf), "static_friction must be finite"),
        (lambda: holds(X, -1.0, 0.5), "normal_force"),
        (lambda: holds(X, 1.0, -0.5), "static_friction"),
        (lambda: holds(X[:2], 1.0, 0.5), "push"),
        (lambda: friction_force(X, STILL, 1.0, 0.5, -0.1), "kinetic_friction"),
        (lambda: sliding_motion(X, X, X, 1.0, 0.5, 0.1, 0.0, 1.0), "mass"),
        (lambda: sliding_motion(X, X, X, 1.0, 0.5, 0.1, 1.0, -1.0), "dt"),
    ],
)
def test_an_invalid_support_is_refused_by_name(call, name):
    with pytest.raises(ValueError, match=f"^{name}"):
        call()
