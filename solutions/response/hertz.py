"""A penalty contact with Hertz's law, which stiffens as it is pressed.

This goes beyond slide 8. The spring of `penalty_force` is linear. Two elastic
spheres, or a sphere and a plane, push with F = k d^{3/2} instead, because the
area on which they touch grows with the depth d (Hertz 1881). Here k is in
N/m^{3/2}.
"""

from __future__ import annotations

import math

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    Finite,
    FiniteNotNegative,
    FinitePositive,
    Share,
    Unit,
    domain,
)
from solutions.response.penalty_impact import (
    penalty_damping,
    penalty_restitution,
)

ROUND_TRIP = 0.8 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9)
"""∫ 2 dx/√(1 − x^{5/2}) from 0 to 1, which is 2.943."""


@domain
def hertz_force(
    separation: Finite,
    normal_velocity: Finite,
    normal: Unit,
    stiffness: FiniteNotNegative,
    damping: FiniteNotNegative = 0.0,
    adhesive: bool = False,
) -> Array:
    """Force of a contact with Hertz's spring and Tsuji's dashpot.

    Parameters
    ----------
    separation : (...), s, m, negative inside
    normal_velocity : (...), v_n, m/s, positive when moving away
        Relative to the other body.
    normal : (..., 3), n, unit, out of the other body
    stiffness : (...), k, N/m^{3/2}, not negative
    damping : (...), c, N s/m^{5/4}, not negative; see `hertz_damping`
    adhesive : bool, whether the contact may pull

    Returns
    -------
    (..., 3), N
        0 where s ≥ 0. Never a pull, unless the contact is adhesive.

    Notes
    -----
    The depth is d = −s. The force is

        F = max(0, k d^{3/2} − c d^{1/4} v_n) n    while s < 0
        F = 0                                      while s ≥ 0

    A dashpot whose damping is constant would push with c v at the very first
    touch, where the spring does not push at all. The factor d^{1/4} is the one
    for which the restitution does not depend on the speed (Tsuji, Tanaka and
    Ishida 1992).
    """
    depth = np.maximum(-separation, 0.0)
    push = stiffness * depth**1.5 - damping * depth**0.25 * normal_velocity
    push = push if adhesive else np.maximum(push, 0.0)
    return push[..., None] * normal


@domain
def hertz_stiffness(radius: FinitePositive, modulus: FinitePositive) -> Array:
    """Stiffness k of the contact of two elastic spheres, or of one on a plane.

    Parameters
    ----------
    radius : (...), R, m, positive
        1/R = 1/R_A + 1/R_B, and R = R_A against a plane.
    modulus : (...), E*, Pa, positive
        1/E* = (1 − ν_A²)/E_A + (1 − ν_B²)/E_B, with Young's moduli E and
        Poisson's ratios ν.

    Returns
    -------
    (...), k, N/m^{3/2}

    Notes
    -----
    Hertz's result for a small depth is

        k = (4/3) E* √R
    """
    return 4 / 3 * modulus * np.sqrt(radius)


@domain
def hertz_largest_depth(
    mass: FinitePositive, stiffness: FinitePositive, speed: FiniteNotNegative
) -> Array:
    """Depth at which an impact on an undamped Hertz contact turns round.

    Parameters
    ----------
    mass : (...), m, kg, positive; for two spheres 1/m = 1/m_A + 1/m_B
    stiffness : (...), k, N/m^{3/2}, positive
    speed : (...), v at the first touch, m/s, not negative

    Returns
    -------
    (...), d, m

    Notes
    -----
    The energy of the motion, m v²/2, becomes that of the spring, which is the
    integral (2/5) k d^{5/2} of its force. So

        d = (5 m v²/(4 k))^{2/5}
    """
    return (1.25 * (mass / stiffness) * speed**2) ** 0.4


@domain
def hertz_contact_time(
    mass: FinitePositive, stiffness: FinitePositive, speed: FinitePositive
) -> Array:
    """How long an impact on an undamped Hertz contact lasts.

    Parameters
    ----------
    mass : (...), m, kg, positive; for two spheres 1/m = 1/m_A + 1/m_B
    stiffness : (...), k, N/m^{3/2}, positive
    speed : (...), v at the first touch, m/s, positive

    Returns
    -------
    (...), t, s
        A fast impact is shorter than a slow one, while that on a linear spring
        lasts equally long at any speed.

    Notes
    -----
    At the depth x the energy leaves the speed √(v² − (4 k/(5 m)) x^{5/2}). The
    body goes to the largest depth d and back. With x in units of d, the time
    is

        t = (2 d/v) ∫ dx/√(1 − x^{5/2})    from 0 to 1
          = 2.943 d/v
          = 3.218 (m²/(k² v))^{1/5}

    The 2.94 (m²/(k² v))^{1/5} of Landau and Lifshitz (*Theory of Elasticity*,
    § 9) has another k: theirs is 4/5 of the one here, so that
    k d^{5/2} = m v².
    """
    return ROUND_TRIP * hertz_largest_depth(mass, stiffness, speed) / speed


@domain
def hertz_restitution(
    mass: FinitePositive,
    stiffness: FinitePositive,
    damping: FiniteNotNegative = 0.0,
    adhesive: bool = False,
) -> Array:
    """Speed after an impact on a Hertz contact, as a share of that before.

    The share is the same at every speed.

    Parameters
    ----------
    mass : (...), m, kg, positive
    stiffness : (...), k, N/m^{3/2}, positive
    damping : (...), c, N s/m^{5/4}, not negative
    adhesive : bool, whether the contact may pull

    Returns
    -------
    (...), e, 0 to 1
        That of a linear contact with the damping ratio ζ = c/(√5 √(k m)).

    Notes
    -----
    Count the depth as z = d^{5/4} and the time as τ with
    dτ = (5/4) d^{1/4} dt. Then dz/dτ is the velocity d′, and the equation of
    motion

        m d″ + c d^{1/4} d′ + k d^{3/2} = 0

    becomes, divided by (5/4) d^{1/4},

        m z″ + (4/5) c z′ + (4/5) k z = 0

    This is a linear spring with a dashpot, whose damping ratio is

        ζ = (4/5) c/(2 √((4/5) k m)) = c/(√5 √(k m))

    Its velocities are those of the Hertz contact, and so is its restitution
    (Antypov and Elliott 2011). The force is zero at the same instant too,
    because it is d^{1/4} times the linear one.
    """
    linear_damping = 2 / math.sqrt(5) * damping
    return penalty_restitution(mass, stiffness, linear_damping, adhesive)


@domain
def hertz_damping(
    restitution: Share,
    mass: FinitePositive,
    stiffness: FinitePositive,
    adhesive: bool = False,
) -> Array:
    """Damping that gives a Hertz contact the restitution e at every speed.

    This function is the inverse of `hertz_restitution`.

    Parameters
    ----------
    restitution : (...), e, 0 to 1
    mass : (...), m, kg, positive
    stiffness : (...), k, N/m^{3/2}, positive
    adhesive : bool, whether the contact may pull

    Returns
    -------
    (...), c, N s/m^{5/4}
        0 for e = 1. For e = 0 infinity, or √5 √(k m) with adhesion, as
        `penalty_damping` says.

    Notes
    -----
    The linear contact with the same m and k needs the damping 2 ζ √(k m), and
    this one needs

        c = √5 ζ √(k m)

    With adhesion ζ = −ln e/√(π² + ln² e).
    """
    linear_damping = penalty_damping(restitution, mass, stiffness, adhesive)
    return math.sqrt(5) / 2 * linear_damping
