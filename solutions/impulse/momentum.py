"""Impulses and the momenta P and L they change (slides 13, 16 and 21)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.checks import not_negative
from solutions.domain import (
    Finite,
    FiniteNotNegative,
    Matrix,
    Number,
    Positive,
    Triple,
    Unit,
    Vector,
    domain,
    require,
)


@domain
def impulse_of_force(force: Vector, time: Finite) -> Array:
    """Impulse J = ∫F dt of a force that was sampled (slide 13).

    Parameters
    ----------
    force : (..., n, 3), N, n samples
    time : (..., n), s, in order
        It may repeat where the force jumps.

    Returns
    -------
    (..., 3), N s
        It is 0 for a single sample, and exact where the force changes at a
        steady rate between the samples.

    Raises
    ------
    ValueError
        If the times go backwards, or their number is not that of the samples.

    Notes
    -----
    Between two samples the function takes the mean of the two forces times the
    time between them, which is the area of a trapezoid. For a constant force
    the sum is the slide's F Δt. With F = M a it is Δ(M v) = ΔP.

    The slides call J a force applied over a short time, but J is not a force.
    A harder ball has the same J, a shorter Δt and a larger F.
    """
    fits = force.ndim > 1 and time.shape[-1:] == force.shape[-2:-1]
    require(fits, "time must have a value for each of the samples of force")
    steps = not_negative("steps of time", np.diff(time))
    means = (force[..., 1:, :] + force[..., :-1, :]) / 2
    return np.sum(means * steps[..., None], axis=-2)


@domain
def mean_force(
    momentum_change: Triple,
    duration: Positive,
    other_force: Triple = (0.0, 0.0, 0.0),
) -> Array:
    """Mean force over a contact of known length.

    Parameters
    ----------
    momentum_change : (..., 3), ΔP, N s
    duration : (...), Δt, s, positive
    other_force : (..., 3), N
        What else acts meanwhile, such as the weight. With zero the result is
        the net force.

    Returns
    -------
    (..., 3), N

    Notes
    -----
    ΔP/Δt is the net force, the sum of the contact force and all others. The
    contact provides what the others do not:

        F = ΔP/Δt − F_other

    For a ball on the floor, the net force is the contact force less the
    weight. In an impact Δt is short, so that ΔP/Δt is large and the weight
    does not matter. This is what slide 20 drops.
    """
    return momentum_change / duration[..., None] - other_force


@domain
def contact_impulses(magnitude: Number, normal: Unit) -> tuple[Array, Array]:
    """Impulses at a contact: J = j n on A and −J on B (slide 16).

    Parameters
    ----------
    magnitude : (...), j, N s
    normal : (..., 3), n, unit, from B to A

    Returns
    -------
    on A, on B : (..., 3) each, N s

    Notes
    -----
    The slide's forces along the normal are those of an impact without
    friction. For every j the two impulses add up to zero, so that P is
    conserved. They also act at one point, so that L about any point is
    conserved.
    """
    impulse = magnitude[..., None] * normal
    return impulse, -impulse


@domain
def apply_impulse_to_momenta(
    momentum: Triple, angular_momentum: Triple, arm: Triple, impulse: Triple
) -> tuple[Array, Array]:
    """Momenta of one body after an impulse at the end of its arm (slide 21).

    Parameters
    ----------
    momentum : (..., 3), P, kg m/s
    angular_momentum : (..., 3), L about the centre of mass, kg m²/s
    arm : (..., 3), r from the centre of mass to the contact, m
    impulse : (..., 3), J, N s, on this body

    Returns
    -------
    momentum, angular_momentum : (..., 3) each, kg m/s and kg m²/s

    Notes
    -----
        P += J
        L += r × J

    For B, whose impulse is −J, this is the slide's P_B −= J, L_B −= r_B × J.
    The step needs no mass and no inertia. These come back in with
    `velocities_from_momenta`, which must follow.
    """
    return momentum + impulse, angular_momentum + np.cross(arm, impulse)


@domain
def velocities_from_momenta(
    momentum: Triple,
    angular_momentum: Triple,
    inverse_mass: FiniteNotNegative,
    inverse_inertia: Matrix,
) -> tuple[Array, Array]:
    """Velocities that belong to the momenta of a body (slide 21).

    Parameters
    ----------
    momentum : (..., 3), P, kg m/s
    angular_momentum : (..., 3), L about the centre of mass, kg m²/s
    inverse_mass : (...), 1/M, 1/kg, not negative
    inverse_inertia : (..., 3, 3), I⁻¹(t) in the world frame, 1/(kg m²)

    Returns
    -------
    velocity, angular_velocity : (..., 3) each, m/s and rad/s
        An immovable body, 1/M = 0, is at rest in the result, and a rod does
        not spin about itself: its momenta cannot describe such a motion, its
        velocities can.

    Notes
    -----
    The momenta are P = M v and L = I(t) ω. Solved for the velocities:

        v = P/M
        ω = I⁻¹(t) L

    The slide's pseudo-code stops at P and L. A program that keeps v and ω
    beside them must recompute both.
    """
    velocity = inverse_mass[..., None] * momentum
    angular_velocity = (inverse_inertia @ angular_momentum[..., None])[..., 0]
    return velocity, angular_velocity
