"""Penalty response: a spring and a dashpot push the body out again (slide 8).

Throughout this module ω = √(k/m) and ζ = c/(2 √(k m)), with stiffness k,
damping c and mass m.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, unit, vector


def penalty_force(
    separation: ArrayLike,
    normal_velocity: ArrayLike,
    normal: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
    adhesive: bool = False,
) -> Array:
    """Force of a contact made of a spring beside a dashpot (slide 8).

    The spring has the rest length zero, and the force acts along the normal.

    Parameters
    ----------
    separation : (...), s, m, negative inside
    normal_velocity : (...), v_n, m/s, positive when moving away
        Relative to the plane.
    normal : (..., 3), unit, out of the plane
    stiffness : (...), k, N/m
    damping : (...), c, N s/m
    adhesive : whether the contact may pull

    Returns
    -------
    (..., 3), N
        0 where s ≥ 0. Never towards the plane, unless the contact is adhesive:
        a damping force that exceeds that of the spring then pulls.

    Raises
    ------
    ValueError
        If k or c is negative or infinite, a motion is not finite, or a normal
        does not have length 1.

    Notes
    -----
    With the depth d = −s while s < 0,

        F = max(0, k d − c v_n) N    and F = 0 while s ≥ 0

    The slide's F = k d has no direction. It has no damping, so that no impact
    loses energy, and nothing keeps it from pulling. `adhesive` leaves out the
    max, as LAMMPS does: the dashpot then holds the body back on its way out.
    """
    depth = -finite("separation", separation)
    k = finite("stiffness", not_negative("stiffness", stiffness))
    c = finite("damping", not_negative("damping", damping))
    push = k * depth - c * finite("normal_velocity", normal_velocity)
    push = push if adhesive else np.maximum(push, 0.0)
    push = np.where(depth > 0, push, 0.0)
    n = unit("normal", vector("normal", normal))
    return np.asarray(push[..., None] * n)


def penalty_rest_depth(
    mass: ArrayLike,
    gravity: ArrayLike,
    stiffness: ArrayLike,
) -> Array:
    """Depth at which a penalty floor carries the weight of a body (slide 8).

    Parameters
    ----------
    mass : (...), kg
    gravity : (...), along the normal into the floor, m/s², not negative
    stiffness : (...), k, N/m, positive

    Returns
    -------
    (...), m

    Raises
    ------
    ValueError
        If mass or gravity is negative, or k is not positive.

    Notes
    -----
    At rest the force k d of the spring equals the weight m g:

        d = m g/k
    """
    weight = not_negative("mass", mass) * not_negative("gravity", gravity)
    return np.asarray(weight / positive("stiffness", stiffness))


def penalty_step_limit(
    mass: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
) -> Array:
    """Timestep above which a penalty contact is shaken apart (slide 8).

    The steps are those of semi-implicit Euler. Below this limit the contact
    comes to rest.

    Parameters
    ----------
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m

    Returns
    -------
    (...), s
        It has all its digits, however strong the damping is.

    Raises
    ------
    ValueError
        If m or k is not positive, c is negative, or one of them is not finite.

    Notes
    -----
    A step of semi-implicit Euler multiplies (x, v) by the matrix

        [[1 − ω²Δt², Δt(1 − 2ζωΔt)], [−ω²Δt, 1 − 2ζωΔt]]

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
    return np.asarray(2 / (omega * (np.sqrt(1 + zeta**2) + zeta)))


def frequency_and_ratio(
    mass: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike,
) -> tuple[Array, Array]:
    """The undamped frequency ω, rad/s, and the damping ratio ζ."""
    m, k = mass_and_stiffness(mass, stiffness)
    c = finite("damping", not_negative("damping", damping))
    return np.sqrt(k / m), np.asarray(c / (2 * np.sqrt(k) * np.sqrt(m)))


def mass_and_stiffness(
    mass: ArrayLike,
    stiffness: ArrayLike,
) -> tuple[Array, Array]:
    """Mass and stiffness, kg and N/m, as arrays; positive and finite."""
    m, k = positive("mass", mass), positive("stiffness", stiffness)
    return finite("mass", m), finite("stiffness", k)
