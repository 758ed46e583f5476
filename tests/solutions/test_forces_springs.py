from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.forces import (
    damped_oscillator,
    damper_force,
    damping_ratio,
    friction_oscillator,
    natural_frequency,
    runge_kutta_4,
    semi_implicit_euler,
    spring_damper_force,
    spring_energy,
    spring_force,
)
from solutions.friction import friction_force

RNG_SEED = 13
ORIGIN = np.zeros(3)
COMPONENT = st.floats(-10, 10).map(lambda value: round(value, 6))  # no numbers that vanish when squared
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
STIFFNESS, LENGTH = st.floats(0, 100), st.floats(0, 10)
TIME = st.floats(0, 20)
POSITIVE = st.floats(0.1, 10)


# Springs


@pytest.mark.statement(27, oracle="arithmetic on a 2-3-6-7 triangle")
def test_a_stretched_spring_pulls_and_a_compressed_one_pushes():
    far, near = (2.0, 3.0, 6.0), (1.0, 1.5, 3.0)
    assert spring_force(far, ORIGIN, 14.0, 5.0) == pytest.approx([-8, -12, -24], rel=1e-15, abs=0)  # 14 × 2 N
    assert spring_force(near, ORIGIN, 14.0, 5.0) == pytest.approx([6, 9, 18], rel=1e-15, abs=0)  # 14 × 1.5 N


@pytest.mark.statement(27, oracle="the slide's own words")
def test_at_its_rest_length_a_spring_exerts_no_force():
    assert spring_force((2.0, 3.0, 6.0), ORIGIN, 100.0, 7.0).tolist() == [0, 0, 0]


@pytest.mark.parametrize("rest_length", [0.0, 1.0])
def test_a_spring_of_length_zero_exerts_no_force(rest_length):
    here = (1.0, 2.0, 3.0)
    assert spring_force(here, here, 5.0, rest_length).tolist() == [0, 0, 0]
    assert damper_force(here, here, (1.0, 0, 0), ORIGIN, 5.0).tolist() == [0, 0, 0]
    assert spring_damper_force(here, here, (1.0, 0, 0), ORIGIN, 5.0, rest_length, 1.0).tolist() == [0, 0, 0]
    assert spring_energy(here, here, 5.0, rest_length) == 2.5 * rest_length**2


def test_a_spring_with_an_end_at_nan_exerts_a_force_of_nan():
    assert np.isnan(spring_force((math.nan, 0, 0), ORIGIN, 1.0, 1.0)).all()


@given(VECTOR, VECTOR, VECTOR, VECTOR, STIFFNESS, LENGTH, STIFFNESS)
def test_both_ends_feel_opposite_forces_along_the_spring(x1, x2, v1, v2, stiffness, rest_length, damping):
    on_1 = spring_damper_force(x1, x2, v1, v2, stiffness, rest_length, damping)
    on_2 = spring_damper_force(x2, x1, v2, v1, stiffness, rest_length, damping)
    assert np.array_equal(on_1, -on_2)
    # Up to 100 N/m × 45 m at an arm of 35 m: no turning moment but by rounding
    assert np.cross(x1 - x2, on_1) == pytest.approx(np.zeros(3), abs=1e-9)


@given(VECTOR.filter(lambda place: np.linalg.norm(place) > 0.1), STIFFNESS, LENGTH)
def test_the_force_of_a_spring_is_the_slope_of_its_energy(place, stiffness, rest_length):
    step = 1e-4
    ahead, behind = (spring_energy(place + sign * step * np.eye(3), ORIGIN, stiffness, rest_length) for sign in (1, -1))
    slope = (ahead - behind) / (2 * step)
    # Central differences: k L0 (step/L)² L/6 at L > 0.1, and energies up to 3e4 J rounded over a step of 1e-4
    assert -slope == pytest.approx(spring_force(place, ORIGIN, stiffness, rest_length), abs=1e-3)


# Dampers


@pytest.mark.statement(29, oracle="arithmetic on a 2-3-6-7 triangle")
def test_a_damper_works_against_the_change_of_its_length_alone():
    along = np.array([2.0, 3.0, 6.0]) / 7
    across = np.array([3.0, -2.0, 0.0])
    force = damper_force((2.0, 3.0, 6.0), ORIGIN, 4 * along + across, along, 0.5)
    assert force == pytest.approx(-0.5 * 3 * along, abs=1e-15)


@pytest.mark.statement(29, oracle="invariance under rigid motion")
@given(VECTOR, VECTOR, VECTOR, VECTOR, STIFFNESS)
def test_a_damper_leaves_any_rigid_motion_alone(x1, x2, v, spin, damping):
    v1, v2 = v + np.cross(spin, x1), v + np.cross(spin, x2)
    # ω × d is at right angles to d but by rounding of speeds up to 350 m/s
    assert damper_force(x1, x2, v1, v2, damping) == pytest.approx(np.zeros(3), abs=1e-8)


@given(VECTOR, VECTOR, VECTOR, VECTOR, STIFFNESS)
def test_a_damper_never_adds_energy(x1, x2, v1, v2, damping):
    force = damper_force(x1, x2, v1, v2, damping)
    assert force @ v1 - force @ v2 <= 1e-9  # rounding of powers up to 1e5 W


@given(VECTOR, VECTOR, VECTOR, VECTOR, st.integers(0, 99))
def test_turning_the_whole_scene_turns_spring_and_damper(x1, x2, v1, v2, seed):
    if 0 < np.linalg.norm(x1 - x2) < 1e-3:
        return  # turning them first would turn the direction between them by rounding
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    force = spring_damper_force(x1, x2, v1, v2, 3.0, 2.0, 1.0)
    same_place = np.array_equal(x1, x2)  # turned, it must stay the same place
    turned = spring_damper_force(turn @ x1, turn @ (x1 if same_place else x2), turn @ v1, turn @ v2, 3.0, 2.0, 1.0)
    assert turned == pytest.approx(turn @ force, abs=1e-9)  # 1e-15 of 35 m over 1e-3 m, on up to 50 m/s


@pytest.mark.statement(29, oracle="mujoco: the passive forces of a spatial tendon")
def test_spring_and_damper_are_mujocos_tendon(installed):
    mujoco = installed("mujoco").module()
    joints = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
    body = '<body>{0}<geom size=".1" mass="1"/><site name="{1}"/></body>'
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco><option gravity="0 0 0"/><worldbody>{body.format(joints, "a")}{body.format(joints, "b")}</worldbody>
        <tendon><spatial stiffness="14" damping="3" springlength="2.5"><site site="a"/><site site="b"/></spatial>
        </tendon></mujoco>"""
    )
    state, rng = mujoco.MjData(model), np.random.default_rng(RNG_SEED)
    for _ in range(20):
        x, v = rng.normal(size=(2, 2, 3))
        state.qpos[:], state.qvel[:] = x.ravel(), v.ravel()
        mujoco.mj_forward(model, state)
        ours = spring_damper_force(x[0], x[1], v[0], v[1], 14.0, 2.5, 3.0)
        # Some dozens of roundings of forces up to 40 N
        assert state.qfrc_passive.reshape(2, 3) == pytest.approx(np.array([ours, -ours]), abs=1e-12)


# What the slides print


@pytest.mark.erratum(27)
def test_the_slides_spring_throws_the_mass_away_from_rest():
    assert as_printed.spring_force(1.5, 1.0, 10.0) == 5.0  # stretched by 0.5 m, and pushed on
    assert spring_force((1.5, 0, 0), ORIGIN, 10.0, 1.0).tolist() == [-5, 0, 0]
    x, v = np.array([1.01]), np.zeros(1)
    for _ in range(1000):
        x, v = semi_implicit_euler(x, v, as_printed.spring_force(x, 1.0, 10.0), 1e-3)
    # x″ = ω² x: cosh(√10 × 1 s) = 11.8; semi-implicit Euler is off by some ω dt/2 = 0.2 %
    assert x[0] - 1 == pytest.approx(0.01 * math.cosh(math.sqrt(10)), rel=5e-3, abs=0)


@pytest.mark.erratum(29)
@pytest.mark.parametrize("damping", [0.0, 1.0, 20.0])
def test_the_slides_damped_spring_runs_away_with_any_damping(damping):
    def printed(x, v):
        return as_printed.spring_damper_force(x, 1.0, 10.0, v, damping)

    x, v = np.array([1.01]), np.zeros(1)
    growth = -damping / 2 + math.sqrt(damping**2 / 4 + 10)
    decay = -damping / 2 - math.sqrt(damping**2 / 4 + 10)
    assert growth > 0
    duration = 8 / growth
    for _ in range(2000):
        x, v = runge_kutta_4(x, v, printed, duration / 2000)
    expected = 0.01 * (growth * math.exp(decay * duration) - decay * math.exp(8)) / (growth - decay)
    assert x[0] - 1 == pytest.approx(
        expected, rel=1e-6, abs=0
    )  # fourth order, 2000 steps: at most (0.34)⁴/120 of 600 e-folds
    assert x[0] - 1 > 10  # from a centimetre; by the right law it would have come to rest or swung on
    right, _ = damped_oscillator(0.01, 0.0, 10.0, damping, 1.0, duration)
    assert abs(right) <= 0.01


@pytest.mark.erratum(29)
def test_the_slides_damper_brakes_a_spring_that_flies_as_a_whole():
    v = np.array([5.0, 0.0, 0.0])
    assert as_printed.spring_damper_force(1.0, 1.0, 10.0, 5.0, 2.0) == -10
    assert damper_force((1.0, 0, 0), ORIGIN, v, v, 2.0).tolist() == [0, 0, 0]


# The oscillator with a damper


def test_frequency_and_damping_ratio_by_hand():
    assert natural_frequency([8.0, 0.0], 2.0).tolist() == [2, 0]
    assert natural_frequency(8.0, math.inf) == 0
    assert damping_ratio(8.0, [0.0, 4.0, 8.0, 16.0], 2.0).tolist() == [0, 0.5, 1, 2]


@pytest.mark.statement(29, oracle="scipy expm")
@given(COMPONENT, COMPONENT, STIFFNESS, STIFFNESS, POSITIVE, TIME)
def test_the_oscillator_is_the_exponential_of_its_matrix(x, v, stiffness, damping, mass, t):
    linalg = oracle("scipy.linalg")
    matrix = np.array([[0, 1], [-stiffness / mass, -damping / mass]])
    ours = damped_oscillator(x, v, stiffness, damping, mass, t)
    # expm squares a small step up to fourteen times; numbers up to 10 m/s × 20 s or 32 rad/s × 10 m, over 2e4 radians
    assert ours == pytest.approx(tuple(linalg.expm(matrix * t) @ [x, v]), rel=1e-9, abs=1e-9)


@pytest.mark.statement(29, oracle="scipy solve_ivp DOP853")
@pytest.mark.parametrize("damping", [0.0, 0.5, 3.999999, 4.0, 4.000001, 30.0])
def test_the_oscillator_is_the_integral_of_its_forces_in_all_regimes(damping):
    integrate = oracle("scipy.integrate")

    def rate(_, state):
        x, v = np.array([1 + state[0], 0, 0]), np.array([state[1], 0, 0])
        return [state[1], spring_damper_force(x, ORIGIN, v, ORIGIN, 4.0, 1.0, damping)[0]]

    times = np.linspace(0, 6, 7)
    # The solver leaves up to 1e-12 in each of some hundred steps
    found = integrate.solve_ivp(rate, (0, 6), [0.3, -0.4], method="DOP853", t_eval=times, rtol=1e-12, atol=1e-14)
    assert found.y == pytest.approx(np.array(damped_oscillator(0.3, -0.4, 4.0, damping, 1.0, times)), abs=1e-10)


@pytest.mark.statement(29, oracle="mujoco: a slide joint with stiffness and damping, RK4")
@pytest.mark.parametrize("damping", [0.0, 0.5, 4.0, 8.0])
def test_the_oscillator_is_mujocos_slide_joint(installed, damping):
    mujoco = installed("mujoco").module()
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco><option gravity="0 0 0" integrator="RK4" timestep="1e-3"/><worldbody><body>
        <joint type="slide" axis="1 0 0" stiffness="8" damping="{damping}" springref="1"/><geom size=".1" mass="2"/>
        </body></worldbody></mujoco>"""
    )
    state = mujoco.MjData(model)
    state.qpos[0], state.qvel[0] = 1.3, -0.4
    for _ in range(3000):
        mujoco.mj_step(model, state)
    x, v = damped_oscillator(0.3, -0.4, 8.0, damping, 2.0, 3.0)
    # RK4 of dt = 1e-3 at rates up to 3.7/s: (3.7e-3)⁴/120 a radian, over 11
    assert (state.qpos[0] - 1, state.qvel[0]) == pytest.approx((float(x), float(v)), abs=2e-11)


@given(COMPONENT, COMPONENT, STIFFNESS, STIFFNESS, POSITIVE, st.floats(0, 5), st.floats(0, 5))
def test_two_stretches_of_the_oscillation_are_one_long_one(x, v, stiffness, damping, mass, first, second):
    halfway = damped_oscillator(x, v, stiffness, damping, mass, first)
    then = damped_oscillator(*halfway, stiffness, damping, mass, second)
    assert then == pytest.approx(damped_oscillator(x, v, stiffness, damping, mass, first + second), abs=1e-9)


@given(COMPONENT, COMPONENT, POSITIVE, st.floats(0, 1e6), POSITIVE, TIME)
def test_the_oscillator_never_gains_energy(x, v, stiffness, damping, mass, t):
    x1, v1 = damped_oscillator(x, v, stiffness, damping, mass, t)
    before, after = (stiffness * x * x + mass * v * v) / 2, (stiffness * x1 * x1 + mass * v1 * v1) / 2
    assert after <= before * (1 + 1e-9) + 1e-12  # rounding; with c = 1e6, that of β x by 1e-16 of 1e7


def test_without_a_spring_the_mass_is_braked_or_flies_free():
    x, v = damped_oscillator(1.0, 2.0, 0.0, 4.0, 2.0, 3.0)  # τ = m/c = 0.5 s
    assert (x, v) == pytest.approx(
        (1 + 2 * 0.5 * (1 - math.exp(-6)), 2 * math.exp(-6)), abs=1e-15
    )  # of numbers up to 2
    assert damped_oscillator(1.0, 2.0, 0.0, 0.0, 2.0, 3.0) == (7.0, 2.0)


def test_an_oscillator_of_infinite_mass_keeps_its_velocity():
    assert damped_oscillator(1.0, 2.0, 8.0, 4.0, math.inf, 3.0) == (7.0, 2.0)


def test_a_very_stiff_damper_creeps_at_the_slow_rate():
    # Slow rate k/c = 1e-6; the fast one, 1e6, is over at once
    x, v = damped_oscillator(1.0, 0.0, 1.0, 1e6, 1.0, 1e6)
    assert (x, v) == pytest.approx(
        (math.exp(-1), -1e-6 * math.exp(-1)), rel=1e-9, abs=0
    )  # (k/c²)-th corrections, 1e-12


# The oscillator with friction


@pytest.mark.statement(23, oracle="turning points in exact arithmetic")
def test_the_turning_points_of_dry_friction_fall_by_two_mu_n_over_k():
    # ω = 2, f = 3/8·... k = 8, F = 4: f = 1/2; released at 3.25 the swings turn at −2.25, 1.25, −0.25, where it sticks
    half = math.pi / 2
    x, v = friction_oscillator(3.25, 0.0, 8.0, 4.0, 2.0, [0, half, 2 * half, 3 * half * (1 + 1e-12), 20.0])
    assert x == pytest.approx([3.25, -2.25, 1.25, -0.25, -0.25], abs=1e-12)
    assert v == pytest.approx(np.zeros(5), abs=1e-11)
    assert v[-1] == 0


@given(st.floats(0.01, 20), st.floats(-20, 20), POSITIVE, st.floats(0, 5), POSITIVE, TIME, st.booleans())
def test_the_friction_oscillator_seen_in_a_mirror_is_the_same(x, v, stiffness, friction, mass, t, still):
    v = 0.0 if still else v
    x1, v1 = friction_oscillator(x, v, stiffness, friction, mass, t)
    mirrored = friction_oscillator(-x, -v, stiffness, friction, mass, t)
    assert mirrored == (-x1, -v1)


@pytest.mark.statement(23, oracle="scipy solve_ivp with an event at every turning point, friction_force in between")
@pytest.mark.parametrize(
    ("x", "v"),
    [
        *((5.0, 0.0), (2.0, 3.0), (2.0, -3.0), (-0.2, 1e-3)),
        *(pytest.param(*start, marks=pytest.mark.weekly) for start in ((-5.0, 0.0), (0.0, 4.0))),
    ],
)
def test_the_friction_oscillator_is_what_the_forces_integrate_to(x, v):
    integrate = oracle("scipy.integrate")
    stiffness, normal_force, friction, mass = 3.0, 2.0, 0.4, 1.5

    def force(state, towards):
        pull = np.array([-stiffness * state[0], 0, 0])
        return (pull + friction_force(pull, np.array([towards, 0, 0]), normal_force, friction, friction))[0]

    def turns(_, state):
        return state[1]

    turns.terminal = True
    t, state, end = 0.0, np.array([x, v]), 9.3
    while t < end:
        towards = np.sign(state[1]) if abs(state[1]) > 1e-9 else np.sign(force(state, 0.0))
        if towards == 0:  # held
            state[1] = 0.0
            break

        def rate(_, now, towards=towards):
            return [now[1], force(now, towards) / mass]

        # A first small stride, so that the start is not taken for a turning point
        first = 1e-6 if abs(state[1]) <= 1e-9 else 0.0
        acceleration = force(state, towards) / mass
        if first:
            state = np.array([state[0] + acceleration * first**2 / 2, acceleration * first])
        found = integrate.solve_ivp(
            rate, (t + first, end), state, method="DOP853", rtol=1e-12, atol=1e-13, events=turns
        )
        t, state = found.t[-1], found.y[:, -1]
    ours = friction_oscillator(x, v, stiffness, friction * normal_force, mass, end)
    assert ours == pytest.approx(tuple(state), abs=1e-8)  # every stride leaves some 1e-12 s², and the events 1e-12


@given(COMPONENT, COMPONENT, POSITIVE, st.floats(0, 5), POSITIVE, st.floats(0, 5), st.floats(0, 5))
def test_two_stretches_with_friction_are_one_long_one(x, v, stiffness, friction, mass, first, second):
    halfway = friction_oscillator(x, v, stiffness, friction, mass, first)
    then = friction_oscillator(*halfway, stiffness, friction, mass, second)
    whole = friction_oscillator(x, v, stiffness, friction, mass, first + second)
    # A half swing whose turning point is by rounding at the limit of sticking may end on either side of it
    assert then[0] == pytest.approx(whole[0], abs=1e-5)
    assert then[1] == pytest.approx(whole[1], abs=1e-4)


@given(COMPONENT, COMPONENT, POSITIVE, st.floats(0, 5), POSITIVE, TIME)
def test_friction_adds_no_energy_and_holds_a_body_only_within_its_limit(x, v, stiffness, friction, mass, t):
    x1, v1 = friction_oscillator(x, v, stiffness, friction, mass, t)
    before, after = (stiffness * x * x + mass * v * v) / 2, (stiffness * x1 * x1 + mass * v1 * v1) / 2
    assert after <= before * (1 + 1e-12) + 1e-12
    later = friction_oscillator(x, v, stiffness, friction, mass, 1e5)
    if friction > 0.1:
        assert later[1] == 0
        assert stiffness * abs(later[0]) <= friction * (1 + 1e-9)


def test_what_friction_can_hold_from_the_start_never_moves():
    assert friction_oscillator([0.5, -0.5, 0.0], 0.0, 8.0, 4.0, 2.0, 7.0)[0].tolist() == [0.5, -0.5, 0]


@given(COMPONENT, COMPONENT, POSITIVE, POSITIVE, TIME)
def test_without_friction_it_is_the_undamped_oscillator(x, v, stiffness, mass, t):
    ours = friction_oscillator(x, v, stiffness, 0.0, mass, t)
    assert ours == pytest.approx(damped_oscillator(x, v, stiffness, 0.0, mass, t), abs=1e-11)


# Input


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: spring_force((1, 2), ORIGIN, 1.0), "position_1 must have shape"),
        (lambda: spring_force(ORIGIN, (1, 2), 1.0), "position_2 must have shape"),
        (lambda: spring_force(ORIGIN, ORIGIN, -1.0), "stiffness must be zero or positive, not -1"),
        (lambda: spring_force(ORIGIN, ORIGIN, 1.0, -1.0), "rest_length must be zero or positive, not -1"),
        (lambda: spring_energy(ORIGIN, ORIGIN, -1.0), "stiffness must be"),
        (lambda: spring_energy(ORIGIN, ORIGIN, 1.0, math.nan), "rest_length must be zero or positive, not nan"),
        (lambda: damper_force(ORIGIN, ORIGIN, ORIGIN, ORIGIN, -1.0), "damping must be"),
        (lambda: damper_force(ORIGIN, ORIGIN, (1, 2), ORIGIN, 1.0), "velocity_1 must have shape"),
        (lambda: damper_force(ORIGIN, ORIGIN, ORIGIN, (1, 2), 1.0), "velocity_2 must have shape"),
        (lambda: natural_frequency(-1.0, 1.0), "stiffness must be"),
        (lambda: natural_frequency(1.0, 0.0), "mass must be positive, not 0"),
        (lambda: damping_ratio(0.0, 1.0, 1.0), "stiffness must be positive"),
        (lambda: damping_ratio(1.0, -1.0, 1.0), "damping must be"),
        (lambda: damping_ratio(1.0, 1.0, 0.0), "mass must be positive"),
        (lambda: damping_ratio(1.0, 1.0, math.inf), "mass must be finite"),
        (lambda: damped_oscillator(1.0, 0.0, -1.0, 0.0, 1.0, 1.0), "stiffness must be"),
        (lambda: damped_oscillator(1.0, 0.0, 1.0, -1.0, 1.0, 1.0), "damping must be"),
        (lambda: damped_oscillator(1.0, 0.0, 1.0, 1.0, 0.0, 1.0), "mass must be positive"),
        (lambda: damped_oscillator(1.0, 0.0, 1.0, 1.0, 1.0, -1.0), "t must be"),
        (lambda: damped_oscillator(1.0, 0.0, 1.0, 1.0, 1.0, math.inf), "t must be finite"),
        (lambda: friction_oscillator(1.0, 0.0, 0.0, 1.0, 1.0, 1.0), "stiffness must be positive"),
        (lambda: friction_oscillator(1.0, 0.0, 1.0, -1.0, 1.0, 1.0), "friction must be"),
        (lambda: friction_oscillator(1.0, 0.0, 1.0, 1.0, 0.0, 1.0), "mass must be positive"),
        (lambda: friction_oscillator(1.0, 0.0, 1.0, 1.0, math.inf, 1.0), "mass must be finite"),
        (lambda: friction_oscillator(1.0, 0.0, 1.0, 1.0, 1.0, -1.0), "t must be"),
        (lambda: friction_oscillator(1.0, 0.0, 1.0, 1.0, 1.0, math.inf), "t must be finite"),
    ],
)
def test_numbers_without_meaning_are_refused_by_name(call, named):
    with pytest.raises(ValueError, match=named):
        call()


def test_many_springs_at_once_are_the_same_as_one_after_another():
    rng = np.random.default_rng(RNG_SEED)
    x1, x2, v1, v2 = rng.normal(size=(4, 4, 5, 3))
    one, two, three, four, x, v = rng.uniform(0.5, 2, size=(6, 4, 5))
    x1[0, 0] = x2[0, 0]  # one has no length
    v[0] = 0.0  # some start at rest
    for array in (x1, x2, v1, v2, one, two, three, four, x, v):
        array.flags.writeable = False  # writing to one would raise
    calls = [
        (spring_force, (x1, x2, one, two)),
        (spring_energy, (x1, x2, one, two)),
        (damper_force, (x1, x2, v1, v2, one)),
        (spring_damper_force, (x1, x2, v1, v2, one, two, three)),
        (damped_oscillator, (x, v, one, 4 * two, three, four)),
        (friction_oscillator, (x, v, one, two, three, four)),
    ]
    for function, arguments in calls:
        together = function(*arguments)
        for at in np.ndindex(4, 5):
            alone = function(*(argument[at] for argument in arguments))
            pairs = zip(together, alone, strict=True) if isinstance(together, tuple) else [(together, alone)]
            for several, single in pairs:
                # Sums over the last axis may be grouped differently in a batch
                assert several[at] == pytest.approx(np.asarray(single), rel=1e-13, abs=1e-14)
