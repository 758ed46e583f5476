"""An oscillator that a force drives, in closed form (for slides 27 and 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    NotNegative,
    Number,
    Positive,
    domain,
)
from solutions.forces.oscillators import damped_oscillator, free_response
from solutions.vectors import quotient

Complex = NDArray[np.complex128]
LITTLE = 2.0
"""The largest angle at which the motion is summed as a power series."""
TERMS = 32
"""How many terms of this series are summed."""


@domain
def driven_oscillator(
    displacement: Number,
    velocity: Number,
    stiffness: NotNegative,
    damping: NotNegative,
    mass: FinitePositive,
    force: NotNegative,
    angular_frequency: Positive,
    phase: Number,
    t: FiniteNotNegative,
) -> tuple[Array, Array]:
    """State after a time t of a driven oscillator, exactly.

    The equation of motion is m x″ + c x′ + k x = F cos(Ωt + φ).

    Parameters
    ----------
    displacement : (...), x0 = x − x_rest, m
    velocity : (...), v0, m/s
    stiffness : (...), k, N/m, not negative
    damping : (...), c, N s/m, not negative
    mass : (...), m, kg, above zero and finite
    force : (...), F, N, not negative
    angular_frequency : (...), Ω, rad/s, above zero
    phase : (...), φ, rad
    t : (...), s, not negative, finite

    Returns
    -------
    displacement, velocity : (...) each, m, m/s

    Notes
    -----
    The equation is linear. So the motion is that of `damped_oscillator` from
    the same start, plus the motion of a mass that starts at rest at x = 0 and
    is driven. With β = c/(2m) and ω² = k/m, the latter is the real part of
    F/m e^(iφ) D, where

        D″ + 2 β D′ + ω² D = e^(iΩt)
        D = D′ = 0 at t = 0

    Far from resonance, D is the steady oscillation less the free motion that
    starts like it. With C and S of `damped_oscillator` this is

        D = (e^(iΩt) − C − (β + iΩ) S)/(ω² − Ω² + 2iβΩ)

    Near resonance both grow without bound, and their difference does not.
    There the function takes other forms of D, in which no two large numbers
    are subtracted. The velocity needs no other form, because

        D′ = iΩ D + S
    """
    beta = damping / (2 * mass)
    omega_squared = stiffness / mass
    cosine, sine = free_response(beta, omega_squared, t)
    driven = _driven_from_rest(
        beta, omega_squared, angular_frequency, t, cosine, sine
    )
    drive = force / mass * np.exp(1j * phase)
    x, v = damped_oscillator(
        displacement, velocity, stiffness, damping, mass, t
    )
    x = x + (drive * driven).real
    v = v + (drive * (1j * angular_frequency * driven + sine)).real
    return x, v


def _driven_from_rest(
    beta: Array,
    omega_squared: Array,
    driving: Array,
    time: Array,
    cosine: Array,
    sine: Array,
) -> Complex:
    """D of `driven_oscillator`, from β, ω², Ω, the time, C and S.

    It is a divided difference of e^(zt) at z = λ₁, λ₂ and iΩ, computed in the
    form that suits the numbers. Far from resonance it is the form given there.
    Near it, where λ₁ is next to iΩ,

        D = (d(λ₁) − d(λ₂))/(λ₁ − λ₂)
        d(λ) = (e^(λt) − e^(iΩt))/(λ − iΩ)

    Where all three are small, D is t² Σ h_k/(k + 2)!, with the sums h_k of all
    products of k of the three z t.
    """
    spin = np.exp(1j * driving * time)
    resistance = omega_squared - driving**2 + 2j * beta * driving
    far = quotient(spin - cosine - (beta + 1j * driving) * sine, resistance)

    fast = -(beta + np.sqrt(beta**2 - omega_squared + 0j))
    slow = np.where(fast.imag == 0, quotient(omega_squared, fast), fast.conj())
    from_slow, from_fast = (
        spin * quotient(np.expm1(apart * time), apart, time)
        for apart in (slow - 1j * driving, fast - 1j * driving)
    )
    near = quotient(from_slow - from_fast, slow - fast)

    little = np.maximum(np.abs(fast), driving) * time <= LITTLE
    b = np.where(little, beta * time, 0.0)
    w = np.where(little, np.sqrt(omega_squared) * time, 0.0)
    o = np.where(little, driving * time, 0.0)
    sums = _sums_of_products(-2 * b + 1j * o, w**2 - 2j * b * o, 1j * o * w**2)

    resonant = np.abs(slow - 1j * driving) * time < 1
    return np.where(little, time**2 * sums, np.where(resonant, near, far))


def _sums_of_products(one: Complex, two: Complex, three: Complex) -> Complex:
    """Σ h_k/(k + 2)! of three numbers, from the sums of their products.

    one, two and three are the sums of the products of so many of them. With
    these, every sum h_k follows from the three before it:

        h_k = one h_(k−1) − two h_(k−2) + three h_(k−3)
    """
    h = [np.ones_like(one), np.zeros_like(one), np.zeros_like(one)]
    total = np.zeros_like(one)
    share = 0.5
    for k in range(TERMS):
        total = total + share * h[0]
        h = [one * h[0] - two * h[1] + three * h[2], h[0], h[1]]
        share /= k + 3
    return total
