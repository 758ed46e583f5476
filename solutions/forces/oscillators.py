"""Oscillators in closed form, with a damper or dry friction (slides 24, 27 and 29)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive


def natural_frequency(stiffness: ArrayLike, mass: ArrayLike) -> Array:
    """Angular frequency of a mass on a spring.

    Parameters
    ----------
    stiffness : (...), k, N/m, not negative
    mass : (...), m, kg, above zero; infinite for a mass that stays where it is

    Returns
    -------
    (...), ω, rad/s
        It is 0 without stiffness and for an infinite mass.

    Raises
    ------
    ValueError
        If stiffness is negative or mass is not positive.

    Notes
    -----
    The equation of motion m x″ = −k x says that the acceleration is −k/m times the
    displacement. For x = cos ω t it is −ω² times the displacement, so that

        ω = √(k/m)
    """
    return np.asarray(
        np.sqrt(not_negative("stiffness", stiffness) / positive("mass", mass))
    )


def damping_ratio(
    stiffness: ArrayLike, damping: ArrayLike, mass: ArrayLike
) -> Array:
    """Damping, over the least damping that keeps a spring from oscillating.

    Parameters
    ----------
    stiffness : (...), k, N/m, above zero
    damping : (...), c, N s/m, not negative
    mass : (...), m, kg, above zero and finite

    Returns
    -------
    (...), ζ, without a unit
        It is below 1 for an underdamped oscillator, 1 for a critical one, and above 1
        for an overdamped one.

    Raises
    ------
    ValueError
        If stiffness is not positive, damping is negative, or mass is not positive or
        not finite.

    Notes
    -----
    The motion e^(λt) solves m x″ + c x′ + k x = 0 if m λ² + c λ + k = 0. Its roots are
    complex, which is an oscillation, as long as c² < 4 k m. The least damping without
    oscillation is therefore 2√(k m), and

        ζ = c/(2√(k m))
    """
    k, m = (
        positive("stiffness", stiffness),
        finite("mass", positive("mass", mass)),
    )
    return np.asarray(not_negative("damping", damping) / (2 * np.sqrt(k * m)))


def damped_oscillator(
    displacement: ArrayLike,
    velocity: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike,
    mass: ArrayLike,
    t: ArrayLike,
) -> tuple[Array, Array]:
    """State after a time t of a mass on a spring with a damper, exactly (slide 29).

    The equation of motion is m x″ + c x′ + k x = 0.

    Parameters
    ----------
    displacement : (...), x0 = x − x_rest, m
    velocity : (...), v0, m/s
    stiffness : (...), k, N/m, not negative
    damping : (...), c, N s/m, not negative
    mass : (...), m, kg, above zero
    t : (...), s, not negative, finite

    Returns
    -------
    displacement, velocity : (...) each, m, m/s
        The cases k = 0 and c = 0 are no exceptions.

    Raises
    ------
    ValueError
        If stiffness or damping is negative, mass is not positive, or t is negative or
        not finite.

    Notes
    -----
    With β = c/(2m), ω² = k/m and s = √|β² − ω²|, the motion e^(λt) solves the equation
    for λ = −β ± √(β² − ω²). The sum of two such motions that begins with x0 and v0 is

        x(t) = x0 C + (v0 + β x0) S
        v(t) = v0 C − (ω² x0 + β v0) S

    where C and S are e^(−βt) times

        cos(s t)     and  sin(s t)/s     underdamped, β < ω
        1            and  t              critical, β = ω
        cosh(s t)    and  sinh(s t)/s    overdamped, β > ω

    At t = 0, C is 1 and S is 0, which gives x0 and v0. The three cases pass into each
    other smoothly.
    """
    x, v = (
        np.asarray(displacement, dtype=float),
        np.asarray(velocity, dtype=float),
    )
    time = finite("t", not_negative("t", t))
    m = positive("mass", mass)
    beta, squared = (
        not_negative("damping", damping) / (2 * m),
        not_negative("stiffness", stiffness) / m,
    )
    cosine, sine = free_response(beta, squared, time)
    return x * cosine + (v + beta * x) * sine, v * cosine - (
        squared * x + beta * v
    ) * sine


def free_response(
    beta: Array, squared: Array, time: Array
) -> tuple[Array, Array]:
    """C and S of `damped_oscillator`, from β, ω² and the time.

    They are written so that no two large numbers are subtracted.
    """
    difference = beta**2 - squared
    s = np.sqrt(np.abs(difference))
    slow = squared / np.where(beta + s > 0, beta + s, 1.0)  # β − s, overdamped
    fast_share = np.expm1(
        -2 * s * time
    )  # e^(−(β+s)t) over e^(−(β−s)t), less 1
    over = np.exp(-slow * time) * (1 + fast_share / 2)
    over_sine = np.exp(-slow * time) * np.where(
        s > 0, -fast_share / np.where(s > 0, 2 * s, 1.0), time
    )
    decay = np.exp(-beta * time)
    under, under_sine = (
        decay * np.cos(s * time),
        decay * time * np.sinc(s * time / np.pi),
    )
    return np.where(difference < 0, under, over), np.where(
        difference < 0, under_sine, over_sine
    )


def friction_oscillator(
    displacement: ArrayLike,
    velocity: ArrayLike,
    stiffness: ArrayLike,
    friction: ArrayLike,
    mass: ArrayLike,
    t: ArrayLike,
) -> tuple[Array, Array]:
    """State after a time t of a mass on a spring with dry friction, exactly (slide 24).

    The equation of motion is m x″ = −k x − F sign(x′). Static and kinetic friction are
    alike.

    Parameters
    ----------
    displacement : (...), x − x_rest, m
    velocity : (...), m/s
    stiffness : (...), k, N/m, above zero
    friction : (...), F = μ N, N, not negative
    mass : (...), m, kg, above zero and finite
    t : (...), s, not negative, finite

    Returns
    -------
    displacement, velocity : (...) each, m, m/s
        The mass sticks at the first turning point with ‖x‖ ≤ F/k, where friction holds
        the spring. A mass that starts at rest there stays there. Without friction it
        never sticks.

    Raises
    ------
    ValueError
        If stiffness is not positive, friction is negative, mass is not positive or not
        finite, or t is negative or not finite.

    Notes
    -----
    While the mass moves one way, friction is a constant force. It shifts the point of
    balance by f = F/k, to −f while the mass moves up, and to +f while it moves down. So
    every half swing is half a cosine about the shifted point, and it takes π/ω with
    ω = √(k/m).

    A half swing that begins at the distance X from the rest position moves by X − f to
    the point of balance, and by as much beyond it. So it ends at the distance X − 2f on
    the other side. The turning points therefore fall by 2 f each, along a straight
    line, where a damper's fall along an exponential.

    A start with a velocity is a later instant of a half swing. The function computes
    the turning point that this half swing would have come from, and begins there.
    """
    x, v = (
        np.asarray(displacement, dtype=float),
        np.asarray(velocity, dtype=float),
    )
    time = finite("t", not_negative("t", t))
    k, m = (
        positive("stiffness", stiffness),
        finite("mass", positive("mass", mass)),
    )
    omega, f = natural_frequency(k, m), not_negative("friction", friction) / k
    ahead = (
        np.sign(v) * x + f
    )  # of the centre of the swing, in the direction of motion
    turn = np.where(v == 0, x, -np.sign(v) * (np.hypot(ahead, v / omega) + f))
    phase = time * omega + np.where(
        v == 0, 0.0, np.arctan2(np.abs(v) / omega, -ahead)
    )
    # With next to no friction the mass never sticks: the number of swings is infinite.
    with np.errstate(all="ignore"):
        until_stuck = np.where(
            f > 0, np.ceil((np.abs(turn) - f) / (2 * f)), np.inf
        )
    swings = np.minimum(np.floor(phase / np.pi), until_stuck)
    angle = np.where(swings >= until_stuck, 0.0, phase - np.pi * swings)
    side = np.sign(turn) * (1 - 2 * (swings % 2))
    reach = np.abs(turn) - 2 * f * swings - f
    return side * (f + reach * np.cos(angle)), -side * omega * reach * np.sin(
        angle
    )
