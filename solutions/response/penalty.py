"""Penalty response: a spring and a dashpot push the body out again (slide 8).

Throughout this module ω = √(k/m) and ζ = c/(2 √(k m)), with stiffness k,
damping c and mass m.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    Finite,
    FiniteNotNegative,
    FinitePositive,
    NotNegative,
    Positive,
    Unit,
    domain,
)


@domain
def penalty_force(
    separation: Finite,
    normal_velocity: Finite,
    normal: Unit,
    stiffness: FiniteNotNegative,
    damping: FiniteNotNegative = 0.0,
    adhesive: bool = False,
) -> Array:
    """Force of a contact made of a spring beside a dashpot (slide 8).

    The spring has the rest length zero, and the force acts along the normal.

    Parameters
    ----------
    separation : (...), s, m, negative inside
    normal_velocity : (...), v_n, m/s, positive when moving away
        Relative to the plane.
    normal : (..., 3), n, unit, out of the plane
    stiffness : (...), k, N/m, not negative
    damping : (...), c, N s/m, not negative
    adhesive : bool, whether the contact may pull

    Returns
    -------
    (..., 3), N
        0 where s ≥ 0. Never towards the plane, unless the contact is adhesive:
        a damping force that exceeds that of the spring then pulls.

    Notes
    -----
    The depth is d = −s. The force is

        F = max(0, k d − c v_n) n    while s < 0
        F = 0                        while s ≥ 0

    The slide's F = k d has no direction. It has no damping, so that no impact
    loses energy, and nothing keeps it from pulling. `adhesive` leaves out the
    max, as LAMMPS does: the dashpot then holds the body back on its way out.
    """
    depth = -separation
    push = stiffness * depth - damping * normal_velocity
    push = push if adhesive else np.maximum(push, 0.0)
    push = np.where(depth > 0, push, 0.0)
    return push[..., None] * normal


@domain
def penalty_rest_depth(
    mass: NotNegative,
    gravity: NotNegative,
    stiffness: Positive,
) -> Array:
    """Depth at which a penalty floor carries the weight of a body (slide 8).

    Parameters
    ----------
    mass : (...), m, kg, not negative
    gravity : (...), g, along the normal into the floor, m/s², not negative
    stiffness : (...), k, N/m, positive

    Returns
    -------
    (...), m

    Notes
    -----
    At rest the force k d of the spring equals the weight m g:

        d = m g/k
    """
    return mass * gravity / stiffness


@domain
def penalty_step_limit(
    mass: FinitePositive,
    stiffness: FinitePositive,
    damping: FiniteNotNegative = 0.0,
) -> Array:
    """Timestep above which a penalty contact is shaken apart (slide 8).

    The steps are those of semi-implicit Euler. Below this limit the contact
    comes to rest.

    Parameters
    ----------
    mass : (...), m, kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m, not negative

    Returns
    -------
    (...), s
        It has all its digits, however strong the damping is.

    Notes
    -----
    A step of semi-implicit Euler multiplies (x, v) by the matrix

        [ 1 − ω²Δt²    Δt(1 − 2ζωΔt) ]
        [ −ω²Δt        1 − 2ζωΔt     ]

    Its determinant is 1 − 2ζωΔt and its trace is 2 − ω²Δt² − 2ζωΔt. As Δt
    grows, one eigenvalue reaches −1, and from there on the motion changes its
    sign at every step and does not die out. An eigenvalue is −1 where
    1 + trace + determinant = 0, that is where ω²Δt² + 4ζωΔt − 4 = 0. The
    positive solution is the limit:

        Δt < (2/ω)(√(1 + ζ²) − ζ)

    Damping shortens the step: the limit is 2/ω without damping and approaches
    1/(ζω) = 2 m/c with a lot of it.
    """
    omega, zeta = frequency_and_ratio(mass, stiffness, damping)
    # √(1 + ζ²) − ζ, as 1/(√(1 + ζ²) + ζ), so that no difference loses digits
    return 2 / (omega * (np.sqrt(1 + zeta**2) + zeta))


def frequency_and_ratio(
    mass: Array, stiffness: Array, damping: Array
) -> tuple[Array, Array]:
    """The undamped frequency ω, rad/s, and the damping ratio ζ."""
    ratio = damping / (2 * np.sqrt(stiffness) * np.sqrt(mass))
    return np.sqrt(stiffness / mass), ratio
