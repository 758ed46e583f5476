"""Closed forms of motions under forces, against sums over steps and dense samples."""

from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle

from reference import forces_truth

VELOCITY, PULL = np.array([5.0, -3.0, 8.0]), np.array([0.5, 1.2, -9.0])


def test_a_thrown_body_is_back_at_its_height_where_dense_samples_have_it():
    times = np.linspace(0, 2.5, 200_001)[:, None]
    places = VELOCITY * times + PULL * times**2 / 2
    back = int(np.flatnonzero(places[:, 2] > 0)[-1])
    top = int(np.argmax(places[:, 2]))
    # Samples lie 12.5 µs apart, in which the body moves 0.13 mm; around the apex it moves next to nothing.
    assert forces_truth.flight_time(VELOCITY, PULL) == pytest.approx(times[back, 0], abs=2e-5)
    np.testing.assert_allclose(forces_truth.landing(VELOCITY, PULL), places[back], atol=2e-4)
    assert forces_truth.apex_time(VELOCITY, PULL) == pytest.approx(times[top, 0], abs=2e-5)
    assert forces_truth.apex_height(VELOCITY, PULL) == pytest.approx(places[top, 2], abs=1e-8)


@pytest.mark.parametrize("damping", [0.0, 1.2, 12.8, 12.8 * (1 + 1e-13), 40.0])
def test_a_swing_is_the_exponential_of_its_matrix_in_every_regime(damping):
    linalg = oracle("scipy.linalg")
    mass, stiffness, start = 0.64, 64.0, np.array([0.12, 1.0])
    matrix = np.array([[0.0, 1.0], [-stiffness / mass, -damping / mass]])
    for time in (0.0, 0.05, 0.7):
        found = forces_truth.swing(*start, stiffness, damping, mass, time)
        # Next to the critical damping the exponential loses half of its digits.
        np.testing.assert_allclose(found, linalg.expm(matrix * time) @ start, atol=1e-9)
    turn = forces_truth.turning(*start, stiffness, damping, mass)
    assert turn > 0
    assert abs((linalg.expm(matrix * turn) @ start)[1]) < 1e-9


@pytest.mark.parametrize("damping", [3.84, 12.8, 25.6])
def test_a_swing_that_has_settled_stays_within_its_limit(damping):
    numbers = 0.12, 1.0, 64.0, damping, 0.64
    settled = forces_truth.settling(*numbers, 0.006, 2.0)
    assert abs(forces_truth.swing(*numbers, settled)[0]) == pytest.approx(0.006, rel=1e-9)
    later = [abs(forces_truth.swing(*numbers, time)[0]) for time in np.linspace(settled + 1e-6, 3.0, 3000)]
    assert max(later) < 0.006


def test_a_ball_in_a_fluid_gathers_the_last_speed_that_its_equation_has():
    integrate = oracle("scipy.integrate")
    mass, displaced, radius, viscosity = 4.3, 3.0, 0.08, 200.0
    drag = 6 * np.pi * viscosity * radius
    run = integrate.solve_ivp(
        lambda _, v: (9.81 * (mass - displaced) - drag * v) / mass, (0, 1), [0.0], rtol=1e-11, atol=1e-13
    )
    last = forces_truth.stokes_fall(mass, displaced, radius, viscosity, 9.81)
    assert run.y[0, -1] == pytest.approx(last, rel=1e-9)
    tau = forces_truth.relaxation(mass, radius, viscosity)
    missing = integrate.solve_ivp(lambda _, v: -drag * v / mass, (0, tau), [1.0], rtol=1e-11, atol=1e-13).y[0, -1]
    assert missing == pytest.approx(np.exp(-1), rel=1e-9)


def test_a_body_on_its_orbit_obeys_newtons_law_and_comes_back_after_a_period():
    integrate = oracle("scipy.integrate")
    half_axis, eccentricity, parameter = 1.3, 0.4, 7.0
    place, velocity = forces_truth.on_the_orbit(half_axis, eccentricity, parameter, 2.0)
    period = forces_truth.orbit_period(half_axis, parameter)

    def rate(_, state):
        away = np.hypot(*state[:2])
        return [*state[2:], *(-parameter * state[:2] / away**3)]

    times = np.linspace(0, period, 20_001)
    run = integrate.solve_ivp(rate, (0, period), [*place, *velocity], t_eval=times, rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(run.y[:, -1], run.y[:, 0], atol=1e-8)
    away = np.hypot(*run.y[:2])
    # Samples lie 1/20,000 of a revolution apart: the apsides are met to 10⁻⁷.
    assert away.min() == pytest.approx(half_axis * (1 - eccentricity), abs=1e-6)
    assert away.max() == pytest.approx(half_axis * (1 + eccentricity), abs=1e-6)
    near = run.y[:2, np.argmin(away)]
    np.testing.assert_allclose(near / np.hypot(*near), [1.0, 0.0], atol=1e-3)


@pytest.mark.parametrize("frequency", [5.0, 10.0, 20.0])
def test_steps_end_in_the_steady_swing_of_their_recurrence(frequency):
    stiffness, damping, mass, force, dt = 64.0, 12.8, 0.64, 1.2, 2e-3
    place, speed, places = 0.0, 0.0, []
    for number in range(4000):
        places.append(place)
        drive = force * np.cos(frequency * number * dt)
        speed += dt * (drive - stiffness * place - damping * speed) / mass
        place += dt * speed
    amplitude, lag = forces_truth.stepped_steady_swing(stiffness, damping, mass, force, frequency, dt)
    late = np.arange(3000, 4000)
    np.testing.assert_allclose(places[3000:], amplitude * np.cos(frequency * dt * late - lag), atol=1e-13)
    exact = forces_truth.steady_swing(stiffness, damping, mass, force, frequency)
    tiny = forces_truth.stepped_steady_swing(stiffness, damping, mass, force, frequency, 1e-7)
    # The damper feels the speed of half a step ago. The next terms are some (Ω dt)², 1e-12
    late = force / (stiffness - mass * frequency**2 + 1j * damping * frequency * np.exp(-0.5j * frequency * 1e-7))
    assert tiny == pytest.approx((abs(late), -np.angle(late)), rel=1e-11)
    along, across = stiffness - mass * frequency**2, damping * frequency
    assert exact == pytest.approx((force / np.hypot(along, across), np.arctan2(across, along)))
