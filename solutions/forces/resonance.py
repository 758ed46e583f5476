"""An oscillator that a force drives, in closed form (slides 27 and 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive
from solutions.forces.oscillators import damped_oscillator, free_response

Complex = NDArray[np.complex128]
LITTLE, TERMS = 2.0, 32
"""The largest angle at which the motion is summed as a power series, and its terms."""


def driven_oscillator(
    displacement: ArrayLike,
    velocity: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike,
    mass: ArrayLike,
    force: ArrayLike,
    angular_frequency: ArrayLike,
    phase: ArrayLike,
    t: ArrayLike,
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

    Raises
    ------
    ValueError
        If an argument is out of its range.

    Notes
    -----
    The equation is linear. So the motion is that of `damped_oscillator` from the same
    start, plus the motion of a mass that starts at rest at x = 0 and is driven. With
    β = c/(2m) and ω² = k/m, the latter is the real part of F/m e^(iφ) D, where

        D″ + 2 β D′ + ω² D = e^(iΩt)    and    D = D′ = 0 at t = 0

    Far from resonance, D is the steady oscillation less the free motion that starts
    like it. With C and S of `damped_oscillator` this is

        D = (e^(iΩt) − C − (β + iΩ) S)/(ω² − Ω² + 2iβΩ)

    Near resonance both grow without bound, and their difference does not. There the
    function takes other forms of D, in which no two large numbers are subtracted. The
    velocity needs no other form, because D′ = iΩ D + S.
    """
    k, c, m = (
        not_negative("stiffness", stiffness),
        not_negative("damping", damping),
        positive("mass", mass),
    )
    push, omega = (
        not_negative("force", force) / finite("mass", m),
        positive("angular_frequency", angular_frequency),
    )
    left, leaving = damped_oscillator(displacement, velocity, k, c, m, t)
    beta, squared, omega, time = np.broadcast_arrays(
        c / (2 * m), k / m, omega, np.asarray(t, dtype=float)
    )
    cosine, sine = free_response(beta, squared, time)
    driven = _driven_from_rest(beta, squared, omega, time, cosine, sine)
    drive = push * np.exp(1j * np.asarray(phase, dtype=float))
    return left + (drive * driven).real, leaving + (
        drive * (1j * omega * driven + sine)
    ).real


def _driven_from_rest(
    beta: Array,
    squared: Array,
    omega: Array,
    time: Array,
    cosine: Array,
    sine: Array,
) -> Complex:
    """D of `driven_oscillator`: a divided difference of e^(zt) at z = λ₁, λ₂ and iΩ.

    Far from resonance it is the form given there. Near it, where λ₁ is next to iΩ,

        D = (d(λ₁) − d(λ₂))/(λ₁ − λ₂),    d(λ) = (e^(λt) − e^(iΩt))/(λ − iΩ)

    Where all three are small, D is t² Σ h_k/(k + 2)!, with the sums h_k of all products
    of k of the three z t.
    """
    spin, resistance = (
        np.exp(1j * omega * time),
        squared - omega**2 + 2j * beta * omega,
    )
    far = (spin - cosine - (beta + 1j * omega) * sine) / np.where(
        resistance == 0, 1.0, resistance
    )

    fast = -(beta + np.sqrt(beta**2 - squared + 0j))
    slow = np.where(
        fast.imag == 0, squared / np.where(fast == 0, 1.0, fast), fast.conj()
    )
    ways = []
    for rate in (slow, fast):
        apart = rate - 1j * omega
        ways.append(
            spin
            * np.where(
                apart == 0,
                time,
                np.expm1(apart * time) / np.where(apart == 0, 1.0, apart),
            )
        )
    near = (ways[0] - ways[1]) / np.where(slow == fast, 1.0, slow - fast)

    little = np.maximum(np.abs(fast), omega) * time <= LITTLE
    b, w, o = (
        np.where(little, each * time, 0.0)
        for each in (beta, np.sqrt(squared), omega)
    )
    sums = [-2 * b + 1j * o, w**2 - 2j * b * o, 1j * o * w**2]
    last, total, share = (
        [np.ones_like(far), np.zeros_like(far), np.zeros_like(far)],
        np.zeros_like(far),
        0.5,
    )
    for k in range(TERMS):
        total = total + share * last[0]
        last = [
            sums[0] * last[0] - sums[1] * last[1] + sums[2] * last[2],
            *last[:2],
        ]
        share /= k + 3
    resonant = np.abs(slow - 1j * omega) * time < 1
    return np.asarray(
        np.where(little, time**2 * total, np.where(resonant, near, far))
    )
