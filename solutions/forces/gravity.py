"""Gravity near the ground and between bodies (slides 23 and 25)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FiniteNotNegative,
    NotNegative,
    Positive,
    Triple,
    domain,
)
from solutions.vectors import quotient

GRAVITATIONAL_CONSTANT = 6.67430e-11
"""G, m³/(kg s²), CODATA 2018; its relative uncertainty is 2.2e-5."""
STANDARD_GRAVITY = 9.80665
"""g₀, m/s², by definition.

The slide's 32 ft/s² is 9.7536 m/s², and its 9.8 m/s² is rounded.
"""


@domain
def uniform_gravity(mass: FiniteNotNegative, gravity: Triple) -> Array:
    """Weight of a body (slide 25).

    Parameters
    ----------
    mass : (...), m, kg, not negative and finite
    gravity : (..., 3), g, acceleration of free fall, m/s²

    Returns
    -------
    (..., 3), N

    Notes
    -----
    A body falls freely with the acceleration g. By Newton's second law the
    force that does this is

        F = m g
    """
    return mass[..., None] * gravity


@domain
def universal_gravity(
    mass_1: FiniteNotNegative,
    mass_2: FiniteNotNegative,
    position_1: Triple,
    position_2: Triple,
    softening: NotNegative = 0.0,
) -> Array:
    """Pull of body 2 on body 1 (slide 25).

    Body 1 pulls body 2 with the opposite force.

    Parameters
    ----------
    mass_1, mass_2 : (...), m1 and m2, kg, not negative and finite
    position_1, position_2 : (..., 3), x1 and x2, m
    softening : (...), ε, m, not negative
        At the distance d the energy of the two bodies is −G m1 m2/√(d² + ε²),
        which keeps the force finite when they come close. With 0 they are
        points.

    Returns
    -------
    (..., 3), on body 1, N
        Bodies at the same place pull in no direction. The force is then zero,
        with and without softening.

    Notes
    -----
    The slide gives the size of the force, G m1 m2/r². The force on body 1
    points to body 2, which is the direction of

        d = x2 − x1
        r = √(‖d‖² + ε²)
        F = (G m1 m2/r²) d/r

    Without softening r is the distance, d/r is the unit vector to body 2, and
    the size is the slide's. With a softening length ε the size is the slope of
    `universal_gravity_energy`.

    The function divides by r three times and never by r³, because the cube of
    an astronomical distance may be too large for a float.
    """
    d = position_2 - position_1
    r = np.hypot(np.linalg.norm(d, axis=-1), softening)
    r = np.where(r == 0, np.inf, r)  # no pull, however large the masses are
    pull = GRAVITATIONAL_CONSTANT * ((mass_1 / r) * (mass_2 / r))  # G m1 m2/r²
    return pull[..., None] * (d / r[..., None])


@domain
def surface_gravity(mass: FiniteNotNegative, distance: Positive) -> Array:
    """Acceleration of free fall at a distance from a body's centre (slide 25).

    Parameters
    ----------
    mass : (...), m, of the attracting body, kg, not negative and finite
    distance : (...), r, m, above zero

    Returns
    -------
    (...), m/s²

    Notes
    -----
    The slide divides the force F = G m1 m2/r² by the mass that falls. That
    mass cancels, so all bodies fall alike:

        a = G m/r²

    For the Earth this is 9.820 m/s² at the mean radius of 6371 km. The
    standard g₀ = 9.80665 m/s² contains the Earth's rotation as well, and the
    slide's 32 ft/s² is 9.7536 m/s².
    """
    return GRAVITATIONAL_CONSTANT * (mass / distance) / distance


@domain
def universal_gravity_energy(
    mass_1: FiniteNotNegative,
    mass_2: FiniteNotNegative,
    position_1: Triple,
    position_2: Triple,
    softening: NotNegative = 0.0,
) -> Array:
    """Potential energy of two bodies that attract each other.

    It is zero when they are infinitely far apart.

    Parameters
    ----------
    mass_1, mass_2 : (...), m1 and m2, kg, not negative and finite
    position_1, position_2 : (..., 3), x1 and x2, m
    softening : (...), ε, m, not negative; with 0 the bodies are points

    Returns
    -------
    (...), J
        It is minus infinity for points with mass at the same place.

    Notes
    -----
    The energy is

        d = x2 − x1
        r = √(‖d‖² + ε²)
        E = −G m1 m2/r

    Its slope along ‖d‖ is

        dE/d‖d‖ = G m1 m2 ‖d‖/r³

    This is the size of the force of `universal_gravity`, which points to where
    the energy is lower.
    """
    masses = mass_1 * mass_2
    distance = np.linalg.norm(position_2 - position_1, axis=-1)
    at_one_place = -np.where(masses > 0, np.inf, 0.0)
    return quotient(
        -GRAVITATIONAL_CONSTANT * masses,
        np.hypot(distance, softening),
        at_one_place,
    )


@domain
def mutual_gravity(
    mass: FiniteNotNegative,
    position: Triple,
    softening: NotNegative = 0.0,
) -> Array:
    """Pull on every body of a group by all the others.

    Parameters
    ----------
    mass : (..., N), kg, not negative and finite
    position : (..., N, 3), m
    softening : (...), m, not negative; one for each group

    Returns
    -------
    (..., N, 3), N
        Its sum over the group is zero. A body does not pull itself.

    Notes
    -----
    The pull on a body is the sum of the forces of `universal_gravity` by each
    of the others. All N² pairs are taken at once. This includes the pair of a
    body with itself, whose force is zero because the distance is zero.
    """
    on_1_by_2 = universal_gravity(
        mass[..., :, None],
        mass[..., None, :],
        position[..., :, None, :],
        position[..., None, :, :],
        softening[..., None, None],
    )
    return on_1_by_2.sum(axis=-2)
