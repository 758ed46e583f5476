"""A driven oscillator, against the integral of its forces, and resonance by hand."""

from __future__ import annotations

from decimal import Decimal, localcontext

import numpy as np
import pytest
from oracles import oracle

from solutions.forces import driven_oscillator


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


def in_fifty_digits(x, v, stiffness, damping, mass, force, omega, phase, time):
    """Displacement and velocity by power series, step by step; the phase is 0 or π/2, so that the drive is exact."""
    with localcontext() as context:
        context.prec = 50
        x, v, k, c, m, f, w, t = (Decimal(float(each)) for each in (x, v, stiffness, damping, mass, force, omega, time))
        cosine, sine = (Decimal(0), Decimal(1)) if phase else (Decimal(1), Decimal(0))
        steps = 1 + int(2 * t * max(w, (k / m).sqrt(), c / m))
        h = t / steps
        for _ in range(steps):
            a, drive = [x, v], [cosine, -w * sine]
            for j in range(45):
                both = Decimal((j + 1) * (j + 2))
                a.append((f * drive[j] - c * (j + 1) * a[j + 1] - k * a[j]) / (m * both))
                drive.append(-w * w * drive[j] / both)
            powers = [Decimal(1)]
            for _ in a:
                powers.append(powers[-1] * h)
            x, v, cosine, slope = (
                sum(p * each for p, each in zip(powers, series, strict=False))
                for series in (a, [j * n for j, n in enumerate(a)][1:], drive, [j * n for j, n in enumerate(drive)][1:])
            )
            sine = -slope / w
        return float(x), float(v)


RATIOS = (1e-13, 0.02, 0.6, 1.0, 1 + 1e-7, 3.0)
"""More ratios of the damping to the critical one."""


@pytest.mark.statement(29, oracle="power series in fifty digits")
@pytest.mark.parametrize(
    "ratio", [0.0, 1e-7, 1 - 1e-10, *(pytest.param(each, marks=pytest.mark.slow) for each in RATIOS)]
)
def test_a_driven_oscillator_has_all_its_digits_next_to_resonance_and_next_to_critical_damping(ratio):
    stiffness, mass, force = 3.7, 1.3, 2.1
    natural = np.sqrt(stiffness / mass)
    damping = 2 * ratio * np.sqrt(stiffness * mass)
    omega = natural * (1 + np.array([0.0, 1e-15, -1e-12, 1e-8, -1e-4, 0.3, -0.9]))[:, None]
    time, phase = np.array([1e-7, 0.4, 7.0]), np.pi / 2 * (ratio > 0.1)
    for x, v in ((0.0, 0.0), (0.7, -1.1)):
        found = driven_oscillator(x, v, stiffness, damping, mass, force, omega, phase, time)
        right = [
            [in_fifty_digits(x, v, stiffness, damping, mass, force, w, phase, t) for t in time] for w in omega[:, 0]
        ]
        size = np.hypot(*(np.moveaxis(right, -1, 0) * [[[1.0]], [[1 / natural]]]))
        for power, part, exact in zip((2, 1), found, np.moveaxis(right, -1, 0), strict=True):
            # Some roundings of an angle of 10, in either unit; and the cosine of π/2 is 6e-17 of the force, not zero
            rounding = 2e-13 * size * natural ** (2 - power) + 1e-16 * force / mass * time**power
            assert np.all(np.abs(part - exact) <= rounding)


def test_an_undamped_oscillator_driven_at_resonance_grows_evenly():
    # x = F t sin(ω t)/(2 m ω), also for a batch whose other members are far from it
    times = np.linspace(0, 9, 5)
    x, v = driven_oscillator(0, 0, [4.0, 9.0], 0.0, 1.0, 3.0, 2.0, 0.0, times[:, None])
    assert x[:, 0] == pytest.approx(3 * times * np.sin(2 * times) / 4, abs=1e-14)
    assert v[:, 0] == pytest.approx(3 * (np.sin(2 * times) + 2 * times * np.cos(2 * times)) / 4, abs=1e-13)
    assert x[:, 1] == pytest.approx(3 * (np.cos(2 * times) - np.cos(3 * times)) / 5, abs=1e-14)


@pytest.mark.statement(29, oracle="arithmetic on a 3-4-5 triangle")
def test_a_steady_oscillation_has_the_amplitude_and_the_lag_by_hand():
    # k − m Ω² = 7 − 4 = 3 and c Ω = 4: 10 N make 2 m, by the angle of that triangle too late
    times = 60 + np.linspace(0, 3, 7)
    x, _ = driven_oscillator(0.0, 0.0, 7.0, 2.0, 1.0, 10.0, 2.0, 0.0, times)
    assert x == pytest.approx(2 * np.cos(2 * times - np.arctan2(4, 3)), abs=1e-12)


def test_what_a_driven_oscillator_begins_with_is_forgotten():
    ends = [driven_oscillator(x, v, 4.0, 1.0, 1.0, 2.0, 3.0, 0.2, 60.0) for x, v in ((0.0, 0.0), (5.0, -3.0))]
    assert ends[0] == pytest.approx(ends[1], abs=1e-12)  # e^(−30) of 5 m


@pytest.mark.parametrize("name", ["stiffness", "damping", "mass", "force", "angular_frequency"])
def test_a_negative_number_is_refused_by_name(name):
    numbers = {"stiffness": 1.0, "damping": 1.0, "mass": 1.0, "force": 1.0, "angular_frequency": 1.0} | {name: -1.0}
    with pytest.raises(ValueError, match=name):
        driven_oscillator(0.0, 0.0, **numbers, phase=0.0, t=1.0)
