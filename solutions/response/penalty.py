"""Penalty response: a spring and a dashpot push the body out again (slide 8).

Throughout this module ω = √(k/m) and ζ = c/(2 √(k m)), with stiffness k, damping c and
mass m. An impact is computed without gravity, which is small beside the spring.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, in_unit_interval, not_negative, positive, unit, vector

Array = NDArray[np.float64]


def penalty_force(
    separation: ArrayLike,
    normal_velocity: ArrayLike,
    normal: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
    adhesive: bool = False,
) -> Array:
    """Force of a contact made of a spring and a dashpot side by side (slide 8).

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
        0 where s ≥ 0. Never towards the plane, unless the contact is adhesive: a
        damping force that exceeds that of the spring then pulls.

    Raises
    ------
    ValueError
        If k or c is negative or infinite, a motion is not finite, or a normal does not
        have length 1.

    Notes
    -----
    With the depth d = −s while s < 0,

        F = max(0, k d − c v_n) N    and F = 0 while s ≥ 0

    The slide's F = k d has no direction. It has no damping, so that no impact loses
    energy, and nothing keeps it from pulling. `adhesive` leaves out the max, as LAMMPS
    does: the dashpot then holds the body back on its way out.
    """
    depth = -finite("separation", separation)
    k = finite("stiffness", not_negative("stiffness", stiffness))
    c = finite("damping", not_negative("damping", damping))
    push = k * depth - c * finite("normal_velocity", normal_velocity)
    push = np.where(depth > 0, push if adhesive else np.maximum(push, 0.0), 0.0)
    return np.asarray(push[..., None] * unit("normal", vector("normal", normal)))


def penalty_rest_depth(
    mass: ArrayLike,
    gravity: ArrayLike,
    stiffness: ArrayLike,
) -> Array:
    """Depth at which a body lies in a penalty floor that carries its weight (slide 8).

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


def penalty_contact_time(
    mass: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
    adhesive: bool = False,
) -> Array:
    """How long an impact on a penalty contact lasts, at any speed (slide 8).

    Parameters
    ----------
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m
    adhesive : whether the contact may pull

    Returns
    -------
    (...), s
        Until the force is zero, or with adhesion until the body is back at the surface.
        Infinity with adhesion and ζ ≥ 1, where the body creeps out for ever.

    Raises
    ------
    ValueError
        If m or k is not positive, c is negative, or one of them is not finite.

    Notes
    -----
    The body starts at the surface, x = 0, with x′ = −v, and obeys
    m x″ + c x′ + k x = 0. With s = √(1 − ζ²) its path is

        x = −v/(ω s) exp(−ζ ω t) sin(ω s t)

    With adhesion the contact ends where x is zero again:

        t = π/(ω s)

    Without adhesion it ends earlier, where the force k x + c x′ is zero. Put x and x′
    into that condition and divide by cos(ω s t): tan(ω s t) = −2ζs/(1 − 2ζ²). The first
    positive solution is

        t = (π − atan2(2ζs, 1 − 2ζ²))/(ω s) = 2 arccos(ζ)/(ω s)

    The second form follows with ζ = cos φ and s = sin φ, because 2ζs = sin 2φ and
    1 − 2ζ² = −cos 2φ. Above ζ = 1 read arcosh(ζ)/√(ζ² − 1) for arccos(ζ)/s; at ζ = 1
    both are 1.
    """
    omega, zeta = _frequency_and_ratio(mass, stiffness, damping)
    return np.asarray(_swept_angle(zeta, adhesive) / omega)


def penalty_restitution(
    mass: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
    adhesive: bool = False,
) -> Array:
    """Speed after an impact on a penalty contact over the speed before it (slide 8).

    Parameters
    ----------
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m
    adhesive : whether the contact may pull

    Returns
    -------
    (...), 0 to 1
        At ζ = 1 it is e^−2 = .135 without adhesion. With adhesion it is 0 from ζ = 1
        on.

    Raises
    ------
    ValueError
        If m or k is not positive, c is negative, or one of them is not finite.

    Notes
    -----
    At the end of the contact, at the time t of `penalty_contact_time`, the velocity x′
    of the body has the size v exp(−ζ ω t). So e = exp(−ζ ω t), and with s = √(1 − ζ²)

        e = exp[−(ζ/s)(π − atan2(2ζs, 1 − 2ζ²))] = exp(−2ζ arccos(ζ)/s)
        e = exp(−πζ/s)    with adhesion
    """
    _, zeta = _frequency_and_ratio(mass, stiffness, damping)
    return np.asarray(np.exp(-zeta * _swept_angle(zeta, adhesive)))


def penalty_damping(
    restitution: ArrayLike,
    mass: ArrayLike,
    stiffness: ArrayLike,
    adhesive: bool = False,
) -> Array:
    """Damping that gives a penalty contact the restitution e.

    This function is the inverse of `penalty_restitution`.

    Parameters
    ----------
    restitution : (...), e, 0 to 1
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    adhesive : whether the contact may pull

    Returns
    -------
    (...), N s/m
        0 for e = 1. For e = 0 it is infinity, because a contact that cannot pull never
        takes all the speed; with adhesion it is 2 √(k m), which does.

    Raises
    ------
    ValueError
        If e is not from 0 to 1, or m or k is not positive and finite.

    Notes
    -----
    The damping follows from the damping ratio ζ:

        c = 2 ζ √(k m)

    With adhesion e = exp(−πζ/√(1 − ζ²)) can be solved for ζ, as LAMMPS does:

        ζ = −ln e/√(π² + ln² e)

    Without adhesion there is no such formula. But e falls steadily as ζ grows, so that
    bisection finds ζ.
    """
    e, (m, k) = in_unit_interval("restitution", restitution), _mass_and_stiffness(mass, stiffness)
    zeta = _ratio_adhesive(e) if adhesive else _ratio(e)
    return np.asarray(2 * zeta * np.sqrt(k * m))


def penalty_step_limit(
    mass: ArrayLike,
    stiffness: ArrayLike,
    damping: ArrayLike = 0.0,
) -> Array:
    """Timestep above which semi-implicit Euler shakes a penalty contact (slide 8).

    Below this limit the contact comes to rest.

    Parameters
    ----------
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m

    Returns
    -------
    (...), s

    Raises
    ------
    ValueError
        If m or k is not positive, c is negative, or one of them is not finite.

    Notes
    -----
    A step of semi-implicit Euler multiplies (x, v) by the matrix

        [[1 − ω²Δt², Δt(1 − 2ζωΔt)], [−ω²Δt, 1 − 2ζωΔt]]

    Its determinant is 1 − 2ζωΔt and its trace is 2 − ω²Δt² − 2ζωΔt. As Δt grows, one
    eigenvalue reaches −1, and from there on the motion changes its sign at every step
    and does not die out. An eigenvalue is −1 where 1 + trace + determinant = 0, that is
    where ω²Δt² + 4ζωΔt − 4 = 0. The positive solution is the limit:

        Δt < (2/ω)(√(1 + ζ²) − ζ)

    Damping shortens the step: the limit is 2/ω without damping and approaches
    1/(ζω) = 2 m/c with a lot of it.
    """
    omega, zeta = _frequency_and_ratio(mass, stiffness, damping)
    # 1/(√(1 + ζ²) + ζ) is √(1 + ζ²) − ζ without a difference that loses digits.
    return np.asarray(2 / (omega * (np.sqrt(1 + zeta**2) + zeta)))


def _frequency_and_ratio(mass: ArrayLike, stiffness: ArrayLike, damping: ArrayLike) -> tuple[Array, Array]:
    """The undamped frequency ω, rad/s, and the damping ratio ζ."""
    m, k = _mass_and_stiffness(mass, stiffness)
    return np.sqrt(k / m), np.asarray(finite("damping", not_negative("damping", damping)) / (2 * np.sqrt(k * m)))


def _mass_and_stiffness(mass: ArrayLike, stiffness: ArrayLike) -> tuple[Array, Array]:
    return finite("mass", positive("mass", mass)), finite("stiffness", positive("stiffness", stiffness))


def _swept_angle(zeta: Array, adhesive: bool = False) -> Array:
    """The length of a contact as the angle ω t.

    It is 2 arccos(ζ)/√(1 − ζ²), or the other forms of this from ζ = 1 on; with adhesion
    it is π/√(1 − ζ²).
    """
    swings = zeta < 1
    sine = np.sqrt(np.abs((1 - zeta) * (1 + zeta)))
    over_sine = 1 / np.where(sine > 0, sine, 1.0)
    if adhesive:
        return np.where(swings, np.pi * over_sine, np.inf)
    angle = np.where(swings, np.arccos(np.minimum(zeta, 1.0)), np.arccosh(np.maximum(zeta, 1.0)))
    return 2 * np.where(sine > 0, angle * over_sine, 1.0)


def _ratio_adhesive(restitution: Array) -> Array:
    """Damping ratio ζ = −ln e/√(π² + ln² e); 1 for e = 0, its limit."""
    loss = -np.log(np.where(restitution > 0, restitution, 1.0))
    return np.where(restitution > 0, loss / np.hypot(np.pi, loss), 1.0)


def _ratio(restitution: Array) -> Array:
    """Damping ratio ζ whose impact leaves e, by halving an interval.

    The interval is from 0 to 1/√e. At its upper end an impact leaves less than e.
    """
    low, high = np.zeros_like(restitution), 1 / np.sqrt(np.where(restitution > 0, restitution, 1.0))
    for _ in range(60):
        middle = (low + high) / 2
        too_lively = np.exp(-middle * _swept_angle(middle)) > restitution
        low, high = np.where(too_lively, middle, low), np.where(too_lively, high, middle)
    return np.where(restitution > 0, np.where(restitution < 1, (low + high) / 2, 0.0), np.inf)
