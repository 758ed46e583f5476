"""An oscillator that a force drives, in closed form (slides 27 and 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive
from solutions.forces.oscillators import damped_oscillator


def steady_oscillation(
    stiffness: ArrayLike,
    damping: ArrayLike,
    mass: ArrayLike,
    force: ArrayLike,
    angular_frequency: ArrayLike,
) -> tuple[Array, Array]:
    """Amplitude of an oscillator that a force has driven for long, and its phase lag.

    The force is F cos Ωt, and the displacement tends to A cos(Ωt − δ).

    Parameters
    ----------
    stiffness : (...), k, N/m, not negative
    damping : (...), c, N s/m, not negative
    mass : (...), m, kg, above zero and finite
    force : (...), F, N, not negative
    angular_frequency : (...), Ω, rad/s, above zero

    Returns
    -------
    amplitude : (...), A, m
    lag : (...), δ, rad, from 0 to π
        It is small far below resonance, π/2 at Ω = √(k/m), and near π far above.

    Raises
    ------
    ValueError
        If an argument is out of its range, or if an oscillator without damping is
        driven at resonance, where the amplitude grows without end.

    Notes
    -----
    Put A cos(Ωt − δ) into m x″ + c x′ + k x = F cos Ωt. At Ωt = δ and a quarter of a
    swing later this says

        (k − m Ω²) A = F cos δ,    c Ω A = F sin δ

    The sum of the squares gives the amplitude, and the quotient gives the lag:

        A = F/√((k − m Ω²)² + (c Ω)²),    tan δ = c Ω/(k − m Ω²)
    """
    omega = positive("angular_frequency", angular_frequency)
    along = not_negative("stiffness", stiffness) - finite("mass", positive("mass", mass)) * omega**2
    across = not_negative("damping", damping) * omega
    resistance = np.hypot(along, across)
    if np.any(resistance == 0):
        raise ValueError("damping is 0 at resonance, where the amplitude grows without end")
    return np.asarray(not_negative("force", force) / resistance), np.asarray(np.arctan2(across, along))


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
    stiffness, damping, mass, force, angular_frequency : (...), as `steady_oscillation`
        takes them
    phase : (...), φ, rad
    t : (...), s, not negative, finite

    Returns
    -------
    displacement, velocity : (...) each, m, m/s

    Raises
    ------
    ValueError
        As `steady_oscillation` does, and if t is negative or not finite.

    Notes
    -----
    The equation is linear. So the difference between the motion and the steady
    oscillation, which solves it too, moves as if nothing drove it. At t = 0 it is what
    the start differs from the steady oscillation. A damper takes it away.
    """
    amplitude, lag = steady_oscillation(stiffness, damping, mass, force, angular_frequency)
    omega = positive("angular_frequency", angular_frequency)
    start, now = (np.asarray(phase) - lag + omega * time for time in (0.0, np.asarray(t, dtype=float)))
    x = np.asarray(displacement, dtype=float) - amplitude * np.cos(start)
    v = np.asarray(velocity, dtype=float) + amplitude * omega * np.sin(start)
    left, leaving = damped_oscillator(x, v, stiffness, damping, mass, t)
    return left + amplitude * np.cos(now), leaving - amplitude * omega * np.sin(now)
