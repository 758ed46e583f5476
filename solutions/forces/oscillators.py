"""Oscillators in closed form: with a damper, and with dry friction (slides 24, 27 and 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive

Array = NDArray[np.float64]


def natural_frequency(stiffness: ArrayLike, mass: ArrayLike) -> Array:
    """Angular frequency of a mass on a spring: ω = √(k/m), rad/s.

    Parameters
    ----------
    stiffness : (...), k, N/m
    mass : (...), m, kg; infinite for a mass that stays where it is

    Returns
    -------
    (...), rad/s
    """
    return np.asarray(np.sqrt(not_negative("stiffness", stiffness) / positive("mass", mass)))


def damping_ratio(stiffness: ArrayLike, damping: ArrayLike, mass: ArrayLike) -> Array:
    """Damping over the least one that keeps a spring from oscillating: ζ = c/(2√(k m)).

    Parameters
    ----------
    stiffness : (...), k, N/m, above zero
    damping : (...), c, N s/m
    mass : (...), m, kg

    Returns
    -------
    (...), below 1 underdamped, 1 critical, above overdamped
    """
    k, m = positive("stiffness", stiffness), finite("mass", positive("mass", mass))
    return np.asarray(not_negative("damping", damping) / (2 * np.sqrt(k * m)))


def damped_oscillator(
    displacement: ArrayLike,
    velocity: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike,
    mass: ArrayLike,
    t: ArrayLike,
) -> tuple[Array, Array]:
    """State after a time t of a mass on a spring with a damper, m x″ + c x′ + k x = 0, exactly (slide 29).

    With β = c/(2m), ω² = k/m and s = √|β² − ω²|,

        x(t) = x0 C + (v0 + β x0) S,    v(t) = v0 C − (ω² x0 + β v0) S

    where C and S are e^(−βt) times cos(s t) and sin(s t)/s underdamped (β < ω), 1 and t critical, cosh(s t) and
    sinh(s t)/s overdamped. They pass into each other smoothly, and k = 0 or c = 0 are no exceptions.

    Parameters
    ----------
    displacement : (...), x − x_rest, m
    velocity : (...), m/s
    stiffness : (...), k, N/m, not negative
    damping : (...), c, N s/m, not negative
    mass : (...), m, kg
    t : (...), s, not negative, finite

    Returns
    -------
    displacement, velocity : (...) each
    """
    x, v = np.asarray(displacement, dtype=float), np.asarray(velocity, dtype=float)
    time = finite("t", not_negative("t", t))
    m = positive("mass", mass)
    beta, squared = not_negative("damping", damping) / (2 * m), not_negative("stiffness", stiffness) / m
    cosine, sine = _response(beta, squared, time)
    return x * cosine + (v + beta * x) * sine, v * cosine - (squared * x + beta * v) * sine


def _response(beta: Array, squared: Array, time: Array) -> tuple[Array, Array]:
    """C and S of the oscillator, written so that no large number is taken from another."""
    difference = beta**2 - squared
    s = np.sqrt(np.abs(difference))
    slow = squared / np.where(beta + s > 0, beta + s, 1.0)  # β − s, overdamped
    fast_share = np.expm1(-2 * s * time)  # e^(−(β+s)t) over e^(−(β−s)t), less 1
    over = np.exp(-slow * time) * (1 + fast_share / 2)
    over_sine = np.exp(-slow * time) * np.where(s > 0, -fast_share / np.where(s > 0, 2 * s, 1.0), time)
    decay = np.exp(-beta * time)
    under, under_sine = decay * np.cos(s * time), decay * time * np.sinc(s * time / np.pi)
    return np.where(difference < 0, under, over), np.where(difference < 0, under_sine, over_sine)


def friction_oscillator(
    displacement: ArrayLike,
    velocity: ArrayLike,
    stiffness: ArrayLike,
    friction: ArrayLike,
    mass: ArrayLike,
    t: ArrayLike,
) -> tuple[Array, Array]:
    """State after a time t of a mass on a spring with dry friction, m x″ = −k x − F sign(x′), exactly (slide 24).

    With f = F/k every half swing is half a cosine about −f (moving up) or +f (moving down) and takes π/ω. Its turning
    points therefore fall by 2 f each, along a straight line where a damper's fall along an exponential. The mass sticks
    at the first turning point with ‖x‖ ≤ f, where friction holds the spring; static and kinetic friction are alike.
    A start with a velocity is a later instant of a half swing from the turning point that it would have come from.

    Parameters
    ----------
    displacement : (...), x − x_rest, m
    velocity : (...), m/s
    stiffness : (...), k, N/m, above zero
    friction : (...), F = μ N, N, not negative
    mass : (...), kg, finite
    t : (...), s, not negative, finite

    Returns
    -------
    displacement, velocity : (...) each
    """
    x, v = np.asarray(displacement, dtype=float), np.asarray(velocity, dtype=float)
    time = finite("t", not_negative("t", t))
    k, m = positive("stiffness", stiffness), finite("mass", positive("mass", mass))
    omega, f = natural_frequency(k, m), not_negative("friction", friction) / k
    ahead = np.sign(v) * x + f  # of the centre of the swing, in the direction of motion
    turn = np.where(v == 0, x, -np.sign(v) * (np.hypot(ahead, v / omega) + f))
    phase = time * omega + np.where(v == 0, 0.0, np.arctan2(np.abs(v) / omega, -ahead))
    with np.errstate(all="ignore"):  # next to no friction: it never sticks, and infinity says so
        until_stuck = np.where(f > 0, np.ceil((np.abs(turn) - f) / (2 * f)), np.inf)
    swings = np.minimum(np.floor(phase / np.pi), until_stuck)
    angle = np.where(swings >= until_stuck, 0.0, phase - np.pi * swings)
    side = np.sign(turn) * (1 - 2 * (swings % 2))
    reach = np.abs(turn) - 2 * f * swings - f
    return side * (f + reach * np.cos(angle)), -side * omega * reach * np.sin(angle)
