"""Penalty response: a spring and a dashpot push the body out again (slide 8).

In all that follows ω = √(k/m) and ζ = c/(2 √(k m)), with stiffness k, damping c and mass m; gravity is left out of an
impact, where it is small beside the spring.
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
    """Force of a contact that is a spring of rest length zero, with a dashpot beside it (slide 8).

        F = max(0, k d − c v_n) N    with the depth d = −s while s < 0, else F = 0

    The slide's F = k d has no direction and no damping, so nothing ever loses energy; and nothing that keeps it from
    pulling. `adhesive` leaves the clamp out, as LAMMPS does: the dashpot then holds the body back on its way out.

    Parameters
    ----------
    separation : (...), s, m, negative inside
    normal_velocity : (...), v_n, relative to the plane, m/s, positive when moving away
    normal : (..., 3), unit, out of the plane
    stiffness : (...), k, N/m
    damping : (...), c, N s/m
    adhesive : whether the contact may pull

    Returns
    -------
    (..., 3), N

    Raises
    ------
    ValueError
        If k or c is negative or infinite, a motion is not finite, or a normal has not length 1.
    """
    depth = -finite("separation", separation)
    k = finite("stiffness", not_negative("stiffness", stiffness))
    c = finite("damping", not_negative("damping", damping))
    push = k * depth - c * finite("normal_velocity", normal_velocity)
    push = np.where(depth > 0, push if adhesive else np.maximum(push, 0.0), 0.0)
    return np.asarray(push[..., None] * unit("normal", vector("normal", normal)))


def penalty_rest_depth(mass: ArrayLike, gravity: ArrayLike, stiffness: ArrayLike) -> Array:
    """Depth at which a body lies in a penalty floor: d = m g/k, where the spring carries its weight (slide 8).

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
    """
    weight = not_negative("mass", mass) * not_negative("gravity", gravity)
    return np.asarray(weight / positive("stiffness", stiffness))


def penalty_contact_time(
    mass: ArrayLike, stiffness: ArrayLike, damping: ArrayLike = 0.0, adhesive: bool = False
) -> Array:
    """How long an impact on a penalty contact lasts, whatever its speed (slide 8).

    m x″ + c x′ + k x = 0 from x = 0, x′ = −v. It ends where the force is zero, or with adhesion where x is. With
    s = √(1 − ζ²)

        t = (π − atan2(2ζs, 1 − 2ζ²))/(ω s) = 2 arccos(ζ)/(ω s)      t = π/(ω s) with adhesion

    Above ζ = 1 read arcosh(ζ)/√(ζ² − 1) for arccos(ζ)/s; at ζ = 1 both are 1.

    Parameters
    ----------
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m
    adhesive : whether the contact may pull

    Returns
    -------
    (...), s; with adhesion and ζ ≥ 1 it creeps out for ever: infinity

    Raises
    ------
    ValueError
        If m or k is not positive, c is negative, or one of them is not finite.
    """
    omega, zeta = _frequency_and_ratio(mass, stiffness, damping)
    return np.asarray(_swept_angle(zeta, adhesive) / omega)


def penalty_restitution(
    mass: ArrayLike, stiffness: ArrayLike, damping: ArrayLike = 0.0, adhesive: bool = False
) -> Array:
    """Speed after an impact on a penalty contact over the speed before it: e = exp(−ζ ω t) (slide 8).

    With t of `penalty_contact_time` and s = √(1 − ζ²)

        e = exp[−(ζ/s)(π − atan2(2ζs, 1 − 2ζ²))] = exp(−2ζ arccos(ζ)/s)      e = exp(−πζ/s) with adhesion

    At ζ = 1 that is e^−2 = .135; with adhesion e = 0 from there on.

    Parameters
    ----------
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    damping : (...), c, N s/m
    adhesive : whether the contact may pull

    Returns
    -------
    (...), 0 to 1

    Raises
    ------
    ValueError
        If m or k is not positive, c is negative, or one of them is not finite.
    """
    _, zeta = _frequency_and_ratio(mass, stiffness, damping)
    return np.asarray(np.exp(-zeta * _swept_angle(zeta, adhesive)))


def penalty_damping(restitution: ArrayLike, mass: ArrayLike, stiffness: ArrayLike, adhesive: bool = False) -> Array:
    """Damping c = 2 ζ √(k m) that gives a penalty contact the restitution e: `penalty_restitution` turned round.

    With adhesion ζ = −ln e/√(π² + ln² e), as in LAMMPS. Without, e falls steadily with ζ and bisection finds it.

    Parameters
    ----------
    restitution : (...), e, 0 to 1
    mass : (...), kg, positive
    stiffness : (...), k, N/m, positive
    adhesive : whether the contact may pull

    Returns
    -------
    (...), N s/m; 0 for e = 1. For e = 0 infinity: a contact that cannot pull never takes all the speed. With adhesion
    2 √(k m) does.

    Raises
    ------
    ValueError
        If e is not from 0 to 1, or m or k is not positive and finite.
    """
    e, (m, k) = in_unit_interval("restitution", restitution), _mass_and_stiffness(mass, stiffness)
    zeta = _ratio_adhesive(e) if adhesive else _ratio(e)
    return np.asarray(2 * zeta * np.sqrt(k * m))


def penalty_step_limit(mass: ArrayLike, stiffness: ArrayLike, damping: ArrayLike = 0.0) -> Array:
    """Step from which on semi-implicit Euler shakes a penalty contact instead of letting it rest (slide 8).

        Δt < (2/ω)(√(1 + ζ²) − ζ)

    The determinant of its step matrix [[1 − ω²Δt², Δt(1 − 2ζωΔt)], [−ω²Δt, 1 − 2ζωΔt]] is 1 − 2ζωΔt; at the limit
    one eigenvalue is −1. Damping shortens the step: 2/ω without, and 1/(ζω) = 2 m/c with a lot of it.

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
    """
    omega, zeta = _frequency_and_ratio(mass, stiffness, damping)
    return np.asarray(2 / (omega * (np.sqrt(1 + zeta**2) + zeta)))  # √(1 + ζ²) − ζ, where nothing cancels


def _frequency_and_ratio(mass: ArrayLike, stiffness: ArrayLike, damping: ArrayLike) -> tuple[Array, Array]:
    """The undamped frequency ω, rad/s, and the damping ratio ζ."""
    m, k = _mass_and_stiffness(mass, stiffness)
    return np.sqrt(k / m), np.asarray(finite("damping", not_negative("damping", damping)) / (2 * np.sqrt(k * m)))


def _mass_and_stiffness(mass: ArrayLike, stiffness: ArrayLike) -> tuple[Array, Array]:
    return finite("mass", positive("mass", mass)), finite("stiffness", positive("stiffness", stiffness))


def _swept_angle(zeta: Array, adhesive: bool = False) -> Array:
    """The length of a contact as ω t: 2 arccos(ζ)/√(1 − ζ²), its other forms from ζ = 1 on, or π/√(1 − ζ²)."""
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
    """Damping ratio ζ whose impact leaves e, halving the interval from 0 to 1/√e, where too little is left."""
    low, high = np.zeros_like(restitution), 1 / np.sqrt(np.where(restitution > 0, restitution, 1.0))
    for _ in range(60):
        middle = (low + high) / 2
        too_lively = np.exp(-middle * _swept_angle(middle)) > restitution
        low, high = np.where(too_lively, middle, low), np.where(too_lively, high, middle)
    return np.where(restitution > 0, np.where(restitution < 1, (low + high) / 2, 0.0), np.inf)
