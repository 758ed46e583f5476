"""A penalty contact with Hertz's law: it stiffens as it is pressed (beyond slide 8).

The spring of `penalty_force` is linear. Two elastic spheres, or a sphere and a plane,
push with F = k d^{3/2} instead, because the area on which they touch grows with the
depth d (Hertz 1881). Here k is in N/m^{3/2}.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, unit, vector
from solutions.response.penalty_impact import (
    penalty_damping,
    penalty_restitution,
)

ROUND_TRIP = 0.8 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9)
"""∫ 2 dx/√(1 − x^{5/2}) from 0 to 1, which is 2.943."""


def hertz_stiffness(radius: ArrayLike, modulus: ArrayLike) -> Array:
    """Stiffness k of the contact of two elastic spheres, or of one with a plane.

    Parameters
    ----------
    radius : (...), R, m, positive; 1/R = 1/R_A + 1/R_B, and R_A against a plane
    modulus : (...), E*, Pa, positive
        1/E* = (1 − ν_A²)/E_A + (1 − ν_B²)/E_B, with Young's moduli and Poisson's
        ratios.

    Returns
    -------
    (...), N/m^{3/2}

    Raises
    ------
    ValueError
        If an argument is not positive and finite.

    Notes
    -----
    Hertz's result for a small depth is

        k = (4/3) E* √R
    """
    r, e = (
        finite("radius", positive("radius", radius)),
        finite("modulus", positive("modulus", modulus)),
    )
    return np.asarray(4 / 3 * e * np.sqrt(r))


def hertz_force(
    separation: ArrayLike,
    normal_velocity: ArrayLike,
    normal: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
    adhesive: bool = False,
) -> Array:
    """Force of a contact with Hertz's spring and Tsuji's dashpot (beyond slide 8).

    Parameters
    ----------
    separation : (...), s, m, negative inside
    normal_velocity : (...), v_n, m/s, positive when moving away
        Relative to the other body.
    normal : (..., 3), unit, out of the other body
    stiffness : (...), k, N/m^{3/2}
    damping : (...), c, N s/m^{5/4}, as from `hertz_damping`
    adhesive : whether the contact may pull

    Returns
    -------
    (..., 3), N
        0 where s ≥ 0. Never a pull, unless the contact is adhesive.

    Raises
    ------
    ValueError
        If k or c is negative or infinite, a motion is not finite, or a normal does not
        have length 1.

    Notes
    -----
    With the depth d = −s while s < 0,

        F = max(0, k d^{3/2} − c d^{1/4} v_n) N    and F = 0 while s ≥ 0

    A dashpot whose damping is constant would push with c v at the very first touch,
    where the spring does not push at all. The factor d^{1/4} is the one for which the
    restitution does not depend on the speed (Tsuji, Tanaka and Ishida 1992).
    """
    depth = np.maximum(-finite("separation", separation), 0.0)
    k = finite("stiffness", not_negative("stiffness", stiffness))
    c = finite("damping", not_negative("damping", damping))
    push = k * depth**1.5 - c * depth**0.25 * finite(
        "normal_velocity", normal_velocity
    )
    push = push if adhesive else np.maximum(push, 0.0)
    return np.asarray(
        push[..., None] * unit("normal", vector("normal", normal))
    )


def hertz_largest_depth(
    mass: ArrayLike, stiffness: ArrayLike, speed: ArrayLike
) -> Array:
    """Depth at which an impact on an undamped Hertz contact turns round.

    Parameters
    ----------
    mass : (...), m, kg, positive; for two spheres 1/m = 1/m_A + 1/m_B
    stiffness : (...), k, N/m^{3/2}, positive
    speed : (...), v at the first touch, m/s, not negative

    Returns
    -------
    (...), m

    Raises
    ------
    ValueError
        If m or k is not positive, v is negative, or one of them is not finite.

    Notes
    -----
    The energy of the motion, m v²/2, becomes that of the spring, which is the integral
    (2/5) k d^{5/2} of its force. So

        d = (5 m v²/(4 k))^{2/5}
    """
    m, k = (
        finite("mass", positive("mass", mass)),
        finite("stiffness", positive("stiffness", stiffness)),
    )
    v = finite("speed", not_negative("speed", speed))
    return np.asarray((1.25 * (m / k) * v**2) ** 0.4)


def hertz_contact_time(
    mass: ArrayLike, stiffness: ArrayLike, speed: ArrayLike
) -> Array:
    """How long an impact on an undamped Hertz contact lasts.

    Parameters
    ----------
    mass : (...), m, kg, positive; for two spheres 1/m = 1/m_A + 1/m_B
    stiffness : (...), k, N/m^{3/2}, positive
    speed : (...), v at the first touch, m/s, positive

    Returns
    -------
    (...), s
        A fast impact is shorter than a slow one, while that on a linear spring lasts
        equally long at any speed.

    Raises
    ------
    ValueError
        If m, k or v is not positive and finite.

    Notes
    -----
    At the depth x the energy leaves the speed √(v² − (4 k/(5 m)) x^{5/2}). In units of
    the largest depth d, and there and back, the time is

        t = (2 d/v) ∫ dx/√(1 − x^{5/2}) = 2.943 d/v = 3.218 (m²/(k² v))^{1/5}

    The 2.94 (m²/(k² v))^{1/5} of Landau and Lifshitz (*Theory of Elasticity*, § 9) has
    another k: theirs is 4/5 of the one here, so that k d^{5/2} = m v².
    """
    v = positive("speed", speed)
    return np.asarray(ROUND_TRIP * hertz_largest_depth(mass, stiffness, v) / v)


def hertz_restitution(
    mass: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
    adhesive: bool = False,
) -> Array:
    """Speed after an impact on a Hertz contact over the speed before it, at any speed.

    Parameters
    ----------
    mass : (...), m, kg, positive
    stiffness : (...), k, N/m^{3/2}, positive
    damping : (...), c, N s/m^{5/4}, not negative
    adhesive : whether the contact may pull

    Returns
    -------
    (...), 0 to 1
        That of a linear contact with the damping ratio ζ = c/(√5 √(k m)).

    Raises
    ------
    ValueError
        If m or k is not positive, c is negative, or one of them is not finite.

    Notes
    -----
    Count the depth as z = d^{5/4} and the time as τ with dτ = (5/4) d^{1/4} dt. Then
    dz/dτ is the velocity d′, and m d″ + c d^{1/4} d′ + k d^{3/2} = 0, divided by
    (5/4) d^{1/4}, becomes

        m z″ + (4/5) c z′ + (4/5) k z = 0

    This is a linear spring with a dashpot, whose damping ratio is
    (4/5) c/(2 √((4/5) k m)) = c/(√5 √(k m)). Its velocities are those of the Hertz
    contact, and so is its restitution (Antypov and Elliott 2011). The force is zero at
    the same instant too, because it is d^{1/4} times the linear one.
    """
    return penalty_restitution(
        mass,
        stiffness,
        2 / math.sqrt(5) * not_negative("damping", damping),
        adhesive,
    )


def hertz_damping(
    restitution: ArrayLike,
    mass: ArrayLike,
    stiffness: ArrayLike,
    adhesive: bool = False,
) -> Array:
    """Damping that gives a Hertz contact the restitution e at every speed.

    This function is the inverse of `hertz_restitution`.

    Parameters
    ----------
    restitution : (...), e, 0 to 1
    mass : (...), m, kg, positive
    stiffness : (...), k, N/m^{3/2}, positive
    adhesive : whether the contact may pull

    Returns
    -------
    (...), c, N s/m^{5/4}
        0 for e = 1. For e = 0 infinity, or √5 √(k m) with adhesion, as
        `penalty_damping` says.

    Raises
    ------
    ValueError
        If e is not from 0 to 1, or m or k is not positive and finite.

    Notes
    -----
    The linear contact with the same m and k needs 2 ζ √(k m), and this one

        c = √5 ζ √(k m)

    With adhesion ζ = −ln e/√(π² + ln² e).
    """
    return np.asarray(
        math.sqrt(5)
        / 2
        * penalty_damping(restitution, mass, stiffness, adhesive)
    )
