"""A driven oscillator, against the integral of its forces, and resonance by hand."""

from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle

from solutions.forces import driven_oscillator, steady_oscillation


@pytest.mark.statement(29, oracle="scipy solve_ivp DOP853")
@pytest.mark.parametrize("damping", [0.0, 0.5, 4.0, 30.0])
@pytest.mark.parametrize("omega", [0.3, 2.5])
def test_a_driven_oscillator_is_the_integral_of_its_forces(damping, omega):
    integrate = oracle("scipy.integrate")
    stiffness, mass, force, phase = 4.0, 1.3, 2.0, 0.7

    def rate(time, state):
        drive = force * np.cos(omega * time + phase)
        return [state[1], (drive - damping * state[1] - stiffness * state[0]) / mass]

    times = np.linspace(0, 6, 7)
    found = integrate.solve_ivp(rate, (0, 6), [0.3, -0.4], method="DOP853", t_eval=times, rtol=1e-12, atol=1e-14)
    ours = driven_oscillator(0.3, -0.4, stiffness, damping, mass, force, omega, phase, times)
    assert found.y == pytest.approx(np.array(ours), abs=1e-10)


@pytest.mark.statement(29, oracle="arithmetic on a 3-4-5 triangle")
def test_amplitude_and_lag_of_a_steady_oscillation_by_hand():
    # k − m Ω² = 7 − 4 = 3 and c Ω = 4; at resonance k = m Ω², and far above the spring hardly matters
    amplitude, lag = steady_oscillation([7.0, 4.0, 4.0], [2.0, 2.0, 0.0], 1.0, 10.0, [2.0, 2.0, 6.0])
    assert amplitude == pytest.approx([2.0, 2.5, 10 / 32])
    assert lag == pytest.approx([np.arctan2(4, 3), np.pi / 2, np.pi])


def test_what_a_driven_oscillator_begins_with_is_forgotten():
    ends = [driven_oscillator(x, v, 4.0, 1.0, 1.0, 2.0, 3.0, 0.2, 60.0) for x, v in ((0.0, 0.0), (5.0, -3.0))]
    assert ends[0] == pytest.approx(ends[1], abs=1e-12)  # e^(−30) of 5 m


def test_a_drive_at_the_resonance_of_an_undamped_oscillator_is_refused():
    with pytest.raises(ValueError, match="damping is 0 at resonance"):
        steady_oscillation(4.0, 0.0, 1.0, 1.0, 2.0)


@pytest.mark.parametrize("name", ["stiffness", "damping", "mass", "force", "angular_frequency"])
def test_a_negative_number_is_refused_by_name(name):
    numbers = {"stiffness": 1.0, "damping": 1.0, "mass": 1.0, "force": 1.0, "angular_frequency": 1.0} | {name: -1.0}
    with pytest.raises(ValueError, match=name):
        steady_oscillation(**numbers)
