"""Largest stable steps of the integrators for a damped spring (slides 29 and 30)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive


def spring_step_limit(
    stiffness: ArrayLike,
    mass: ArrayLike,
    damping: ArrayLike,
) -> tuple[Array, Array]:
    """Largest stable steps of both Eulers for a mass on a damped spring.

    Both take the forces of the spring and of the damper as they are at the
    start of the step. Beyond its limit the motion grows without end.

    Parameters
    ----------
    stiffness : (...), k, of the spring, N/m, above zero
    mass : (...), m, kg, above zero
    damping : (...), c, of the damper, N s/m, not negative

    Returns
    -------
    explicit, semi_implicit : (...) each, s
        The limit of explicit Euler is 0 without a damper.

    Raises
    ------
    ValueError
        If stiffness or mass is not positive and finite, or damping is negative
        or not finite.

    Notes
    -----
    A step makes new numbers of the position and the velocity by a matrix. Its
    trace T and its determinant D decide: the motion stays bounded as long as
    ‖T‖ ≤ 1 + D and D ≤ 1. With K = k dt²/m and C = c dt/m, both Eulers have
    the trace 2 − C or less:

        explicit         T = 2 − C        D = 1 − C + K
        semi-implicit    T = 2 − C − K    D = 1 − C

    For semi-implicit Euler the condition −T ≤ 1 + D is K + 2 C ≤ 4. This is a
    quadratic in dt, with the root

        dt = 4 m/(c + √(c² + 4 k m))

    For explicit Euler there are two conditions. D ≤ 1 is dt ≤ c/k, and −T ≤ 1
    + D is 2 C − K ≤ 4. The second decides where c² > 4 k m, when the motion
    does not swing:

        dt = c/k underdamped,    dt = 4 m/(c + √(c² − 4 k m)) overdamped

    `stable_step` has the same limits in units of the frequency, and those of
    other integrators.
    """
    k, m = finite("stiffness", positive("stiffness", stiffness)), finite("mass", positive("mass", mass))
    c = finite("damping", not_negative("damping", damping))
    squared, critical = c * c, 4 * k * m
    overdamped = squared > critical
    root = np.sqrt(np.where(overdamped, squared - critical, 0.0))
    explicit = np.where(overdamped, 4 * m / np.where(overdamped, c + root, 1.0), c / k)
    return explicit, np.asarray(4 * m / (c + np.sqrt(squared + critical)))


def stable_step(
    integrator: str,
    frequency: ArrayLike,
    damping_ratio: ArrayLike = 0.0,
) -> Array:
    """Largest stable step of an integrator for a damped oscillator (slides 29 and 30).

    Beyond this step the motion x″ + 2 ζ ω x′ + ω² x = 0 grows without end. Stable is
    not accurate: at the limit a period has three steps.

    Parameters
    ----------
    integrator : name of the integrator
        It is "explicit_euler", "semi_implicit_euler", "velocity_verlet",
        "runge_kutta_4" or "implicit_euler".
    frequency : (...), ω, rad/s, above zero
        For a structure of several springs it is the highest frequency of the structure,
        not that of one spring.
    damping_ratio : (...), ζ = c/(2√(k m)), not negative and finite

    Returns
    -------
    (...), s
        It is 0 for explicit Euler without a damper, and infinity for implicit Euler.

    Raises
    ------
    ValueError
        If there is no such integrator, frequency is not positive, or damping_ratio is
        negative or not finite.

    Notes
    -----
    In units of 1/ω the limits are

        explicit_euler         2 ζ underdamped, 2/(ζ + √(ζ² − 1)) overdamped
        semi_implicit_euler    2 (√(1 + ζ²) − ζ)
        velocity_verlet        2/(ζ + √(1 − 3ζ²)) up to ζ = 1/2, then 1/ζ
        runge_kutta_4          2 √2 undamped, 2.785/(ζ + √(ζ² − 1)) overdamped,
                               between them a root of ‖R(λ dt)‖ = 1
        implicit_euler         no limit

    A step multiplies a motion e^(λt) by some factor, and the motion grows if the factor
    is larger than 1 in size. Explicit Euler multiplies by 1 + λ dt, where λ = −ζω ±
    iω √(1 − ζ²) underdamped. The square of its size is 1 − 2ζω dt + ω² dt², which is at
    most 1 up to ω dt = 2ζ. Overdamped, the faster of the two real rates is
    λ = −ω (ζ + √(ζ² − 1)), and 1 + λ dt reaches −1 at the limit given. Runge–Kutta
    multiplies by R(z) = 1 + z + z²/2 + z³/6 + z⁴/24 with z = λ dt.
    """
    if integrator not in _LIMITS:
        raise ValueError(f"integrator must be one of {', '.join(_LIMITS)}, not {integrator!r}")
    zeta = finite("damping_ratio", not_negative("damping_ratio", damping_ratio))
    return np.asarray(_LIMITS[integrator](zeta) / positive("frequency", frequency))


def _fastest(zeta: Array) -> Array:
    """ζ + √(ζ² − 1), the faster of the two rates of an overdamped oscillator over ω.

    It is 1 if the oscillator is underdamped.
    """
    return np.asarray(np.maximum(zeta, 1.0) + np.sqrt((np.maximum(zeta, 1.0) - 1) * (np.maximum(zeta, 1.0) + 1)))


def _explicit(zeta: Array) -> Array:
    return np.where(zeta <= 1, 2 * zeta, 2 / _fastest(zeta))


def _semi_implicit(zeta: Array) -> Array:
    # This equals the slide's 2 (√(1 + ζ²) − ζ), without a difference that loses digits.
    return np.asarray(2 / (np.hypot(1.0, zeta) + zeta))


def _verlet(zeta: Array) -> Array:
    little = np.minimum(zeta, 0.5)
    return np.where(zeta <= 0.5, 2 / (little + np.sqrt(1 - 3 * little**2)), 1 / np.maximum(zeta, 0.5))


def _runge_kutta(zeta: Array) -> Array:
    """Step at which the factor of a step reaches the size 1.

    It is found by halving, between 2 and 4, along the ray of λ = −ζ + i√(1 − ζ²).
    """
    little = np.minimum(zeta, 1.0)
    ray = -little + 1j * np.sqrt(1 - little**2)
    low, high = np.full(zeta.shape, 2.0), np.full(zeta.shape, 4.0)
    for _ in range(60):
        middle = (low + high) / 2
        z = middle * ray
        stable = np.abs(1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)))) < 1
        low, high = np.where(stable, middle, low), np.where(stable, high, middle)
    return np.asarray(low / _fastest(zeta))


def _implicit(zeta: Array) -> Array:
    return np.full(zeta.shape, np.inf)


_LIMITS: dict[str, Callable[[Array], Array]] = {
    "explicit_euler": _explicit,
    "semi_implicit_euler": _semi_implicit,
    "velocity_verlet": _verlet,
    "runge_kutta_4": _runge_kutta,
    "implicit_euler": _implicit,
}
