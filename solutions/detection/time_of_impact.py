"""When a point meets a plane, by interpolation and exactly (slide 5)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import Finite, NotNegative, domain
from solutions.vectors import quotient


@domain
def time_of_impact_interpolated(
    separation_0: Finite, separation_1: Finite, t: Finite, dt: NotNegative
) -> Array:
    """Time at which a separation with a steady rate is zero (slide 5).

    Parameters
    ----------
    separation_0 : (...), s0, m, at the start of the step, not negative
        For a body that was left on the plane and that rounding put just behind
        it, pass 0.
    separation_1 : (...), s1, m, at the end of the step
    t : (...), s, start of the step
    dt : (...), Δt, s, length of the step, not negative

    Returns
    -------
    (...), T, s
        Infinity where the step does not end behind the plane. A point that
        starts on the plane and goes through it has T = t. A point that starts
        behind the plane met it in an earlier step and gets infinity.

    Notes
    -----
    At a steady rate, the separation at a time τ after the start of the step is
    s0 + (s1 − s0) τ/Δt. It is zero at τ = Δt s0/(s0 − s1), so that

        T = t + Δt s0/(s0 − s1)

    The slide writes T = t + Δt d1/(d1 + d2) with the magnitudes d1 and d2.
    With signed distances, d1 = s0 and d2 = −s1, which gives the same formula.
    A point crosses the plane if s0 ≥ 0 and s1 < 0. Here s0 = 0 counts as in
    front, so that a point left exactly on the plane does not tunnel.

    Under gravity the true path is a parabola, and the straight line between
    its two ends lies below it by up to g Δt²/8. The line therefore meets the
    plane too early: T is early by up to g Δt²/(8 v), where v is the speed at
    which the body arrives.
    """
    crosses = (separation_0 >= 0) & (separation_1 < 0)
    fraction = quotient(separation_0, separation_0 - separation_1)
    return np.where(crosses, t + dt * fraction, np.inf)


@domain
def time_of_impact_exact(
    separation: Finite, normal_velocity: Finite, normal_acceleration: Finite
) -> Array:
    """Time until a separation next falls through zero (slide 5).

    This is the exact root. The acceleration is constant, and the separation is
    s + u t + a t²/2, with t counted from now.

    Parameters
    ----------
    separation : (...), s, m
        A body on the plane, or by rounding just behind it, counts as on it.
    normal_velocity : (...), u, m/s, positive when moving away
    normal_acceleration : (...), a, m/s², negative towards the plane

    Returns
    -------
    (...), s from now
        Infinity where the body never comes down to the plane. A body on the
        plane that moves away gets the time of its return. A body on the plane
        that moves in gets 0, and so does one that lies there and is pressed
        on. A body that turns round exactly on the plane touches it; within
        rounding of this case, rounding decides.

    Notes
    -----
    At each root of s + u t + a t²/2 = 0 the velocity u + a t is +√(u² − 2 a s)
    or −√(u² − 2 a s). A body that falls through zero moves in, so that the
    minus sign holds:

        u + a t = −√(u² − 2 a s)

    When u ≥ 0 the body rises first, and only a < 0 brings it back. Solving for
    t gives

        t = (u + √(u² − 2 a s))/(−a)

    When u < 0, u and the root have opposite signs, and their sum would lose
    digits where they are nearly equal. Multiply the numerator and the
    denominator by √(u² − 2 a s) − u; the numerator becomes −2 a s, and

        t = 2 s/(√(u² − 2 a s) − u)

    In both forms no two nearly equal numbers are subtracted outside the root.
    """
    s = np.maximum(separation, 0.0)
    u, a = normal_velocity, normal_acceleration
    # The square of the speed of arrival. Where it is below zero, the body
    # turns round before it reaches the plane.
    arrival_squared = u * u - 2 * a * s
    root = np.sqrt(np.maximum(arrival_squared, 0.0))
    rising = u >= 0
    numerator = np.where(rising, u + root, 2 * s)
    denominator = np.where(rising, -a, root - u)
    arrives = (arrival_squared >= 0) & (denominator > 0)
    # Where it never arrives, a divisor of 0 makes the time infinite.
    return quotient(numerator, np.where(arrives, denominator, 0.0), np.inf)
