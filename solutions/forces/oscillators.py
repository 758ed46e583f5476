"""Oscillators in closed form, with a damper or dry friction.

They are the exact motions of what is on slides 24, 27 and 29. The slides do
not solve them.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    NotNegative,
    Number,
    Positive,
    domain,
)
from solutions.vectors import quotient


@domain
def natural_frequency(stiffness: NotNegative, mass: Positive) -> Array:
    """Angular frequency of a mass on a spring.

    Parameters
    ----------
    stiffness : (...), k, N/m, not negative
    mass : (...), m, kg, above zero
        It is infinite for a mass that stays where it is.

    Returns
    -------
    (...), ω, rad/s
        It is 0 without stiffness and for an infinite mass.

    Notes
    -----
    The equation of motion m x″ = −k x says that the acceleration is −k/m times
    the displacement. For x = cos ω t it is −ω² times the displacement, so that

        ω = √(k/m)
    """
    return np.sqrt(stiffness / mass)


@domain
def damping_ratio(
    stiffness: Positive, damping: NotNegative, mass: FinitePositive
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
        It is below 1 for an underdamped oscillator, 1 for a critical one, and
        above 1 for an overdamped one.

    Notes
    -----
    The motion e^(λt) solves m x″ + c x′ + k x = 0 if m λ² + c λ + k = 0. Its
    roots are complex, which is an oscillation, as long as c² < 4 k m. The
    least damping without oscillation is therefore 2√(k m), and

        ζ = c/(2√(k m))
    """
    return damping / (2 * np.sqrt(stiffness * mass))


@domain
def damped_oscillator(
    displacement: Number,
    velocity: Number,
    stiffness: NotNegative,
    damping: NotNegative,
    mass: Positive,
    t: FiniteNotNegative,
) -> tuple[Array, Array]:
    """State of a mass on a spring with a damper, exactly (slide 29).

    The equation of motion is m x″ + c x′ + k x = 0, and the state is that
    after a time t.

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

    Notes
    -----
    With β = c/(2m), ω² = k/m and s = √|β² − ω²|, the motion e^(λt) solves the
    equation for λ = −β ± √(β² − ω²). The sum of two such motions that begins
    with x0 and v0 is

        x(t) = x0 C + (v0 + β x0) S
        v(t) = v0 C − (ω² x0 + β v0) S

    where C and S are e^(−βt) times

        cos(s t)     and  sin(s t)/s     underdamped, β < ω
        1            and  t              critical, β = ω
        cosh(s t)    and  sinh(s t)/s    overdamped, β > ω

    At t = 0, C is 1 and S is 0, which gives x0 and v0. The three cases pass
    into each other smoothly.
    """
    beta = damping / (2 * mass)
    omega_squared = stiffness / mass
    cosine, sine = free_response(beta, omega_squared, t)
    x = displacement * cosine + (velocity + beta * displacement) * sine
    v = (
        velocity * cosine
        - (omega_squared * displacement + beta * velocity) * sine
    )
    return x, v


def free_response(
    beta: Array, omega_squared: Array, time: Array
) -> tuple[Array, Array]:
    """C and S of `damped_oscillator`, from β, ω² and the time.

    They are written so that no two large numbers are subtracted: of the two
    rates of an overdamped motion, β − s is ω²/(β + s), and the faster part is
    e^(−2st) times the slower one.
    """
    difference = beta**2 - omega_squared
    s = np.sqrt(np.abs(difference))

    decay = np.exp(-beta * time)
    under_cosine = decay * np.cos(s * time)
    under_sine = decay * time * np.sinc(s * time / np.pi)

    slow_decay = np.exp(-quotient(omega_squared, beta + s) * time)
    less_than_slow = np.expm1(-2 * s * time)  # e^(−2st) − 1
    over_cosine = slow_decay * (1 + less_than_slow / 2)
    over_sine = slow_decay * quotient(-less_than_slow, 2 * s, time)

    cosine = np.where(difference < 0, under_cosine, over_cosine)
    sine = np.where(difference < 0, under_sine, over_sine)
    return cosine, sine


@domain
def friction_oscillator(
    displacement: Number,
    velocity: Number,
    stiffness: Positive,
    friction: NotNegative,
    mass: FinitePositive,
    t: FiniteNotNegative,
) -> tuple[Array, Array]:
    """State of a mass on a spring with dry friction, exactly (slide 24).

    The equation of motion is m x″ = −k x − F sign(x′), and the state is that
    after a time t. Static and kinetic friction are alike.

    Parameters
    ----------
    displacement : (...), x − x_rest, m
    velocity : (...), v, m/s
    stiffness : (...), k, N/m, above zero
    friction : (...), F = μ N, N, not negative
    mass : (...), m, kg, above zero and finite
    t : (...), s, not negative, finite

    Returns
    -------
    displacement, velocity : (...) each, m, m/s
        The mass sticks at the first turning point with |x| ≤ F/k, where
        friction holds the spring. A mass that starts at rest there stays
        there. Without friction it never sticks.

    Notes
    -----
    Between two turning points friction is a constant force. It shifts the
    point of balance by f = F/k, to −f while the mass moves up, and to +f while
    it moves down. So every half swing is half a cosine about the shifted
    point, and it takes π/ω with ω = √(k/m).

    A half swing that begins at the distance X from the rest position moves by
    X − f to the point of balance, and by as much beyond it. So it ends at the
    distance X − 2f on the other side. The turning points therefore fall by 2f
    each, along a straight line, where a damper's fall along an exponential.

    A start with a velocity is a later instant of a half swing. The function
    computes the turning point that this half swing would have come from, and
    begins there.
    """
    omega = natural_frequency(stiffness, mass)
    f = friction / stiffness
    sign = np.sign(velocity)

    # How far the mass has moved beyond the point of balance.
    ahead = sign * displacement + f
    amplitude = np.hypot(ahead, velocity / omega)
    turn = np.where(velocity == 0, displacement, -sign * (amplitude + f))
    since_turn = np.arctan2(np.abs(velocity) / omega, -ahead)
    phase = t * omega + np.where(velocity == 0, 0.0, since_turn)

    # With next to no friction the number of swings is too large for a float.
    with np.errstate(all="ignore"):
        until_stuck = np.ceil(quotient(np.abs(turn) - f, 2 * f, np.inf))
    swings = np.minimum(np.floor(phase / np.pi), until_stuck)
    angle = np.where(swings >= until_stuck, 0.0, phase - np.pi * swings)
    side = np.sign(turn) * (1 - 2 * (swings % 2))
    reach = np.abs(turn) - 2 * f * swings - f
    x = side * (f + reach * np.cos(angle))
    v = -side * omega * reach * np.sin(angle)
    return x, v
