"""An impact on a penalty contact: what speed it leaves (slide 8).

Throughout this module ω = √(k/m) and ζ = c/(2 √(k m)), with stiffness k,
damping c and mass m. The impact is computed without gravity, which is small
beside the spring.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    Share,
    domain,
)
from solutions.response.penalty import frequency_and_ratio
from solutions.vectors import quotient


@domain
def penalty_restitution(
    mass: FinitePositive,
    stiffness: FinitePositive,
    damping: FiniteNotNegative = 0.0,
    adhesive: bool = False,
) -> Array:
    """Speed after an impact on a penalty contact, as a share of that before.

    On slide 8 the contact has no damping, and the share is 1.

    Parameters
    ----------
    mass : (...), m, kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m, not negative
    adhesive : bool, whether the contact may pull

    Returns
    -------
    (...), e, 0 to 1
        At ζ = 1 it is exp(−2) = 0.135 without adhesion. With adhesion it is 0
        from ζ = 1 on.

    Notes
    -----
    The body starts at the surface, x = 0, with x′ = −v, and obeys
    m x″ + c x′ + k x = 0. With s = √(1 − ζ²) its path is

        x = −v/(ω s) exp(−ζ ω t) sin(ω s t)

    With adhesion the contact ends where x is zero again, at t = π/(ω s).
    Without adhesion it ends earlier, where the force k x + c x′ is zero. Put x
    and x′ into that condition and divide by cos(ω s t):

        tan(ω s t) = −2ζs/(1 − 2ζ²)

    The first positive solution is

        t = (π − atan2(2ζs, 1 − 2ζ²))/(ω s)
          = 2 arccos(ζ)/(ω s)

    The second form follows with ζ = cos φ and s = sin φ, because 2ζs = sin 2φ
    and 1 − 2ζ² = −cos 2φ. Above ζ = 1 read arcosh(ζ)/√(ζ² − 1) for
    arccos(ζ)/s; at ζ = 1 both are 1.

    In both cases the velocity x′ of the body has the size v exp(−ζ ω t) at the
    end of the contact, so that

        e = exp(−ζ ω t)

    with the swept angle

        ω t = 2 arccos(ζ)/s
        ω t = π/s              with adhesion

    Put in, this gives

        e = exp(−2ζ arccos(ζ)/s)
        e = exp(−πζ/s)           with adhesion
    """
    _, zeta = frequency_and_ratio(mass, stiffness, damping)
    return np.exp(-zeta * _swept_angle(zeta, adhesive))


@domain
def penalty_damping(
    restitution: Share,
    mass: FinitePositive,
    stiffness: FinitePositive,
    adhesive: bool = False,
) -> Array:
    """Damping that gives a penalty contact the restitution e.

    The impact is one without gravity.

    Parameters
    ----------
    restitution : (...), e, 0 to 1
    mass : (...), m, kg, positive
    stiffness : (...), k, N/m, positive
    adhesive : bool, whether the contact may pull

    Returns
    -------
    (...), c, N s/m
        0 for e = 1. For e = 0 it is infinity, because a contact that cannot
        pull never takes all the speed; with adhesion it is 2 √(k m), which
        does.

    Notes
    -----
    The damping follows from the damping ratio ζ:

        c = 2 ζ √(k m)

    With adhesion e = exp(−πζ/√(1 − ζ²)) can be solved for ζ, as LAMMPS does:

        ζ = −ln e/√(π² + ln² e)

    Without adhesion there is no such formula. But e falls steadily as ζ
    grows, so that bisection finds ζ.
    """
    zeta = _ratio_adhesive(restitution) if adhesive else _ratio(restitution)
    return 2 * zeta * np.sqrt(stiffness) * np.sqrt(mass)


def _swept_angle(zeta: Array, adhesive: bool = False) -> Array:
    """The length of a contact as the angle ω t.

    It is 2 arccos(ζ)/√(1 − ζ²), or the other forms of this from ζ = 1 on; with
    adhesion it is π/√(1 − ζ²).
    """
    swings = zeta < 1
    sine = np.sqrt(np.abs((1 - zeta) * (1 + zeta)))
    over_sine = quotient(1.0, sine)
    if adhesive:
        return np.where(swings, np.pi * over_sine, np.inf)
    below = np.arccos(np.minimum(zeta, 1.0))
    angle = np.where(swings, below, np.arccosh(np.maximum(zeta, 1.0)))
    return 2 * np.where(sine > 0, angle * over_sine, 1.0)


def _ratio_adhesive(restitution: Array) -> Array:
    """Damping ratio ζ = −ln e/√(π² + ln² e); 1 for e = 0, its limit."""
    loss = -np.log(np.where(restitution > 0, restitution, 1.0))
    return np.where(restitution > 0, loss / np.hypot(np.pi, loss), 1.0)


def _ratio(restitution: Array) -> Array:
    """Damping ratio ζ whose impact leaves e, by halving an interval.

    With L = −ln e, ζ is L over the angle of `_swept_angle`. This angle is at
    most π, and at least 2 up to ζ = 1, that is up to L = 2. So ζ is between
    L/π and L/2; for a larger L it is below 1/√e.
    """
    some = np.where(restitution > 0, restitution, 1.0)
    loss = np.abs(np.log(some))
    low = loss / np.pi
    high = np.where(loss <= 2, loss / 2, 1 / np.sqrt(some))
    for _ in range(60):
        middle = (low + high) / 2
        too_lively = middle * _swept_angle(middle) < loss
        low = np.where(too_lively, middle, low)
        high = np.where(too_lively, high, middle)
    return np.where(restitution > 0, (low + high) / 2, np.inf)
