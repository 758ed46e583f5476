from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import forces
from solutions.forces import (
    ballistic_motion,
    explicit_euler,
    implicit_euler,
    runge_kutta_4,
    semi_implicit_euler,
    spring_step_limit,
    velocity_verlet,
)

RNG_SEED = 17
ALL = ["explicit_euler", "semi_implicit_euler", "velocity_verlet", "runge_kutta_4", "implicit_euler"]
ORDER = {"explicit_euler": 1, "semi_implicit_euler": 1, "velocity_verlet": 2, "runge_kutta_4": 4, "implicit_euler": 1}
COMPONENT = st.floats(-10, 10)
VECTOR = st.tuples(COMPONENT, COMPONENT, COMPONENT).map(np.array)
FREQUENCY, RATIO = st.floats(0.1, 1000), st.one_of(st.just(0.0), st.floats(0, 5))


def oscillator(frequency, ratio):
    return lambda p, v: -(frequency**2) * p - 2 * ratio * frequency * v


def run(integrator, p, v, acceleration, dt, steps):
    step = getattr(forces, integrator)
    path = [(p, v)]
    for _ in range(steps):
        p, v = step(p, v, acceleration, dt)
        path.append((p, v))
    return np.array(path)


def growth(integrator, frequency, ratio, dt):
    """Spectral radius of one step, whose matrix is read off from the two states (1, 0) and (0, 1)."""
    step, force = getattr(forces, integrator), oscillator(frequency, ratio)
    matrix = np.array([np.concatenate(step([1.0], [0.0], force, dt)), np.concatenate(step([0.0], [1.0], force, dt))]).T
    return np.abs(np.linalg.eigvals(matrix)).max()


# Under a constant force


@given(VECTOR, VECTOR, VECTOR, st.floats(-1, 1))
@pytest.mark.parametrize("integrator", ["velocity_verlet", "runge_kutta_4"])
def test_the_second_order_and_above_are_exact_on_a_parabola(integrator, p, v, a, dt):
    found = getattr(forces, integrator)(p, v, a, dt)
    for one, other in zip(found, ballistic_motion(p, v, a, dt), strict=True):
        assert one == pytest.approx(other, abs=1e-13)  # a few roundings of numbers up to 25


@given(VECTOR, VECTOR, VECTOR, st.floats(1e-3, 0.1), st.integers(1, 15))
def test_euler_is_half_a_step_behind_or_ahead_of_the_parabola(p, v, a, dt, count):
    true_p, true_v = ballistic_motion(p, v, a, count * dt)
    shift = a * count * dt * dt / 2
    for integrator, side in (("explicit_euler", -1), ("semi_implicit_euler", 1), ("implicit_euler", 1)):
        end_p, end_v = run(integrator, p, v, a, dt, count)[-1]
        assert end_p == pytest.approx(true_p + side * shift, abs=1e-11)  # fifteen steps of numbers up to 100
        assert end_v == pytest.approx(true_v, abs=1e-11)


@pytest.mark.parametrize("integrator", ALL)
def test_a_function_that_returns_a_constant_is_that_constant(integrator):
    step, a = getattr(forces, integrator), np.array([1.0, -2.0, 3.0])
    start = (np.array([4.0, 5.0, 6.0]), np.array([-1.0, 0.0, 2.0]))
    for one, other in zip(step(*start, a, 0.3), step(*start, lambda p, v: a, 0.3), strict=True):
        assert np.array_equal(one, other)


@pytest.mark.parametrize("integrator", ALL)
def test_in_no_time_nothing_moves(integrator):
    p, v = getattr(forces, integrator)((1.0, 2.0, 3.0), (4.0, 5.0, 6.0), oscillator(2.0, 0.5), 0.0)
    assert p.tolist() == [1, 2, 3]
    assert v == pytest.approx([4, 5, 6], abs=1e-15)  # implicit Euler solves for it


# One step, by hand: p″ = −4 p − 2 v from p = 1, v = 3 with dt = 1/2, so a = −10


@pytest.mark.parametrize(
    ("integrator", "expected"),
    [
        ("explicit_euler", (2.5, -2.0)),
        ("semi_implicit_euler", (0.0, -2.0)),
        ("velocity_verlet", (1.25, 3 + (-10 - 4 * 1.25 - 2 * -2) / 4)),
        # v' (1 + 2/2 + 4/4) = 3 − 4/2
        ("implicit_euler", (1 + 1 / 6, 1 / 3)),
    ],
)
def test_one_step_by_hand(integrator, expected):
    p, v = getattr(forces, integrator)([1.0], [3.0], lambda p, v: -4 * p - 2 * v, 0.5)
    assert (p[0], v[0]) == pytest.approx(expected, rel=1e-14, abs=0)


@pytest.mark.statement(30, oracle="the fourth-order Taylor series of the matrix exponential")
@given(st.floats(0.1, 3), st.floats(0, 3), st.floats(0.01, 1))
def test_a_runge_kutta_step_is_the_taylor_series_of_the_exponential(frequency, ratio, dt):
    matrix = dt * np.array([[0, 1], [-(frequency**2), -2 * ratio * frequency]])
    square = matrix @ matrix
    series = np.eye(2) + matrix + square / 2 + square @ matrix / 6 + square @ square / 24
    p, v = runge_kutta_4([1.0], [-2.0], oscillator(frequency, ratio), dt)
    size = np.abs(series).max()
    assert np.concatenate([p, v]) == pytest.approx(series @ [1, -2], abs=1e-12 * size)  # terms up to 1e4 cancel


# Orders


def bent(p, v):
    """A pendulum-like force with friction, in which nothing is linear."""
    return -np.sin(p) - 0.3 * v - 0.1 * v * np.sqrt(1 + v * v)


@pytest.mark.statement(30, oracle="scipy solve_ivp DOP853")
@pytest.mark.parametrize("integrator", ALL)
def test_halving_the_step_divides_the_error_by_two_to_the_order(integrator):
    integrate = oracle("scipy.integrate")

    def rate(_, state):
        return np.concatenate([state[3:], bent(state[:3], state[3:])])

    start = np.array([1.0, -2.0, 0.5, 0.3, 0.0, 1.5])
    true = integrate.solve_ivp(rate, (0, 2), start, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    steps = np.array([80, 160]) if ORDER[integrator] < 4 else np.array([20, 40])
    errors = [np.abs(run(integrator, start[:3], start[3:], bent, 2 / n, n)[-1].ravel() - true).max() for n in steps]
    # The next order is smaller by some dt, 1/40 or 1/20
    assert math.log2(errors[0] / errors[1]) == pytest.approx(ORDER[integrator], abs=0.15)


# Energy


@pytest.mark.statement(30, oracle="the energy each step multiplies or keeps, derived by hand")
def test_the_energy_of_an_undamped_spring_grows_falls_or_stays_as_derived():
    dt, steps = 0.1, 3_000
    energy = {
        name: np.sum(run(name, np.array([1.0]), np.array([0.0]), oscillator(1.0, 0.0), dt, steps) ** 2, axis=(1, 2))
        for name in ("explicit_euler", "semi_implicit_euler", "velocity_verlet", "runge_kutta_4")
    }
    # Explicit: 1 + dt² a step. RK4: ‖R(i dt)‖² = 1 − dt⁶/72 + dt⁸/576. Some thousand roundings
    assert energy["explicit_euler"][100] == pytest.approx(1.01**100, rel=1e-12, abs=0)
    assert energy["runge_kutta_4"][-1] == pytest.approx((1 - 1e-6 / 72 + 1e-8 / 576) ** steps, rel=1e-10, abs=0)
    # p² + v² − dt p v is kept: it swings by dt/2 at most. Verlet keeps p² (1 − dt²/4) + v²
    assert np.abs(energy["semi_implicit_euler"] - 1).max() <= 0.0527  # (1 + dt/2)/(1 − dt/2) − 1 over two, and up
    assert np.abs(energy["velocity_verlet"] - 1).max() <= 0.0026
    for name in ("semi_implicit_euler", "velocity_verlet"):
        early, late = energy[name][:1000], energy[name][-1000:]
        assert late.max() == pytest.approx(early.max(), abs=1e-4)  # how well 1000 samples hit the top of a swing
        assert late.min() == pytest.approx(early.min(), abs=1e-4)


def test_implicit_euler_damps_what_it_cannot_follow():
    path = run("implicit_euler", np.array([1.0]), np.array([0.0]), oscillator(1.0, 0.0), 100.0, 3)
    energy = np.sum(path**2, axis=(1, 2))
    # Each step divides the energy by 1 + (ω dt)²
    assert energy == pytest.approx(10_001.0 ** -np.arange(4), rel=1e-9, abs=0)


@pytest.mark.parametrize("integrator", ["semi_implicit_euler", "velocity_verlet"])
@given(st.floats(0.01, 1.5))
def test_symplectic_steps_keep_the_area_of_phase_space(integrator, dt):
    step, force = getattr(forces, integrator), oscillator(1.0, 0.0)
    matrix = np.array([np.concatenate(step([1.0], [0.0], force, dt)), np.concatenate(step([0.0], [1.0], force, dt))])
    assert np.linalg.det(matrix) == pytest.approx(1, abs=1e-14)


@given(VECTOR, VECTOR, st.floats(0.01, 0.3))
def test_verlet_runs_backwards_the_way_it_came(p, v, dt):
    def force(p, v):
        return -np.sin(p)

    forth = velocity_verlet(p, v, force, dt)
    back = velocity_verlet(*forth, force, -dt)
    assert back[0] == pytest.approx(p, abs=1e-14)
    assert back[1] == pytest.approx(v, abs=1e-14)


# How long a step may be


@pytest.mark.statement(29, oracle="spectral radius of the step's own matrix")
@pytest.mark.parametrize("integrator", ALL[:2])
@given(FREQUENCY, RATIO)
def test_a_motion_grows_above_the_stable_step_and_not_below(integrator, frequency, ratio):
    limit = float(spring_step_limit(frequency**2, 1.0, 2 * ratio * frequency)[ALL.index(integrator)])
    if integrator == "explicit_euler" and ratio < 1e-4:
        assert limit == pytest.approx(2 * ratio / frequency, rel=1e-12, abs=0)
        assert growth(integrator, frequency, ratio, 0.01 / frequency) > 1  # however short
        return
    # 1e-12: an undamped step has a radius of exactly 1; two eigenvalues that meet there differ by the root of rounding
    assert growth(integrator, frequency, ratio, 0.999 * limit) <= 1 + 1e-12
    assert growth(integrator, frequency, ratio, 0.5 * limit) <= 1 + 1e-12
    # By at least 0.002, as where a strong damper alone makes the factor 1 − 2c of a step c times the limit. An explicit
    # step of a spring that swings has |λ|² = 1 − 2ζx + x² with x = ω dt: at x = 2ζc it is 1 + 4ζ²c(c − 1)
    least = 0.0019 * min(ratio, 1.0) ** 2 if integrator == "explicit_euler" else 0.0019
    assert growth(integrator, frequency, ratio, 1.001 * limit) > 1 + least


@given(FREQUENCY, RATIO, st.floats(1e-3, 1e3))
def test_implicit_euler_is_stable_at_any_step(frequency, ratio, product):
    assert growth("implicit_euler", frequency, ratio, product / frequency) <= 1 + 1e-9


# Implicit Euler


def test_a_stiff_mesh_in_one_row_takes_a_long_step():
    # Three masses in a row between walls, k = 1e6: ω up to 1850 rad/s, and dt = 0.1
    matrix = -1e6 * np.array([[2, -1, 0], [-1, 2, -1], [0, -1, 2]])
    p, v = np.array([1.0, 0.0, -0.5]), np.zeros(3)
    found = implicit_euler(p, v, lambda p, v: p @ matrix.T, 0.1)[1]
    expected = np.linalg.solve(np.eye(3) - 0.01 * matrix, 0.1 * matrix @ p)
    assert found == pytest.approx(expected, rel=1e-9, abs=0)  # conditioned 4e4


def test_a_magnet_turns_a_charge_and_a_long_implicit_step_damps_it():
    # v′ = v × b: the matrix of its derivatives is not symmetric; 1.5 radians a step
    turn = 1.5 * np.array([[0, 0.8, 0], [-0.8, 0, 0.6], [0, -0.6, 0]])
    v = np.array([1.0, 2.0, -1.0])
    found = implicit_euler(np.zeros(3), v, lambda p, v: v @ turn.T, 1.0)[1]
    assert found == pytest.approx(np.linalg.solve(np.eye(3) - turn, v), rel=1e-9, abs=0)


@given(VECTOR, VECTOR, st.floats(0.01, 1))
def test_implicit_euler_ends_where_its_own_equation_holds(p, v, dt):
    after_p, after_v = implicit_euler(p, v, bent, dt)
    assert after_v == pytest.approx(v + dt * bent(after_p, after_v), abs=1e-10)  # Newton stops at 1e-12 of 50 m/s
    assert after_p == pytest.approx(p + dt * after_v, abs=1e-14)


def test_a_body_at_rest_where_nothing_pulls_stays_at_rest():
    assert implicit_euler(np.zeros(3), np.zeros(3), oscillator(1.0, 1.0), 0.1)[0].tolist() == [0, 0, 0]


def test_a_force_without_a_solution_is_reported_and_not_guessed():
    # p' = p + dt v', v' = v + dt p'²: with p = v = 1, dt = 1 it is p'² − p' + 2 = 0, without a real root
    with pytest.raises(ArithmeticError, match="implicit Euler found no velocity in 30 iterations: shorten dt"):
        implicit_euler([1.0], [1.0], lambda p, v: p**2, 1.0)


# One is many


@pytest.mark.parametrize("integrator", ALL)
def test_many_bodies_at_once_are_the_same_as_one_after_another(integrator):
    rng = np.random.default_rng(RNG_SEED)
    p, v = rng.normal(size=(2, 4, 5, 3))
    dt = rng.uniform(0.01, 0.2, size=(4, 5))
    for array in (p, v, dt):
        array.flags.writeable = False  # writing to one would raise
    step = getattr(forces, integrator)
    together = step(p, v, bent, dt)
    for at in np.ndindex(4, 5):
        for several, alone in zip(together, step(p[at], v[at], bent, dt[at]), strict=True):
            assert several[at] == pytest.approx(alone, abs=1e-11)  # where Newton stops depends on the batch
    assert not any(np.shares_memory(answer, array) for answer in together for array in (p, v))


@pytest.mark.parametrize("step", [explicit_euler, semi_implicit_euler, velocity_verlet, runge_kutta_4])
@given(VECTOR, VECTOR, VECTOR, st.floats(0.01, 0.5))
def test_a_moving_observer_sees_the_same_steps(step, p, v, boost, dt):
    seen = step(p, v + boost, lambda p, v: -0.5 * (v - boost), dt)
    at_rest = step(p, v, lambda p, v: -0.5 * v, dt)
    assert seen[0] - boost * dt == pytest.approx(at_rest[0], abs=1e-13)
    assert seen[1] - boost == pytest.approx(at_rest[1], abs=1e-13)
