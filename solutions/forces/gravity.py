"""Gravity near the ground and between bodies (slides 23 and 25)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive, vector

GRAVITATIONAL_CONSTANT = 6.67430e-11
"""G, m³/(kg s²), CODATA 2018; its relative uncertainty is 2.2e-5."""
STANDARD_GRAVITY = 9.80665
"""g₀, m/s², by definition; the slide's 32 ft/s² is 9.7536 and its 9.8 is rounded."""


def uniform_gravity(mass: ArrayLike, gravity: ArrayLike) -> Array:
    """Weight of a body (slide 25).

    Parameters
    ----------
    mass : (...), m, kg, not negative and finite
    gravity : (..., 3), g, acceleration of free fall, m/s²

    Returns
    -------
    (..., 3), N

    Raises
    ------
    ValueError
        If mass is negative or not finite, or gravity does not have three
        components.

    Notes
    -----
    A body falls freely with the acceleration g. By Newton's second law the
    force that does this is

        F = m g
    """
    m = finite("mass", not_negative("mass", mass))
    return np.asarray(m[..., None] * vector("gravity", gravity))


def surface_gravity(mass: ArrayLike, distance: ArrayLike) -> Array:
    """Acceleration of free fall at a distance from the centre of a body (slide 25).

    Parameters
    ----------
    mass : (...), m, of the attracting body, kg, not negative and finite
    distance : (...), r, m, above zero

    Returns
    -------
    (...), m/s²

    Raises
    ------
    ValueError
        If mass is negative or not finite, or distance is not positive.

    Notes
    -----
    The slide divides the force F = G m1 m2/r² by the mass that falls. That mass
    cancels, so all bodies fall alike:

        a = G m/r²

    For the Earth this is 9.820 m/s² at the mean radius of 6371 km. The standard
    g₀ = 9.80665 m/s² contains the Earth's rotation as well, and the slide's 32 ft/s² is
    9.7536 m/s².
    """
    m = finite("mass", not_negative("mass", mass))
    r = positive("distance", distance)
    return np.asarray(GRAVITATIONAL_CONSTANT * (m / r) / r)


def universal_gravity(
    mass_1: ArrayLike,
    mass_2: ArrayLike,
    position_1: ArrayLike,
    position_2: ArrayLike,
    softening: ArrayLike = 0.0,
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

    Raises
    ------
    ValueError
        If a mass is negative or not finite, softening is negative, or a
        position does not have three components.

    Notes
    -----
    The slide gives the size of the force, G m1 m2/r². The force on body 1
    points to body 2, which is the direction of d = x2 − x1, and d/‖d‖³ has
    both this direction and the size 1/r². With a softening length ε the size
    is the slope of the energy, which is that of `universal_gravity_energy`:

        F = G m1 m2 d/(‖d‖² + ε²)^(3/2),    d = x2 − x1
    """
    m_1, m_2 = _masses(mass_1, mass_2)
    d, r = _apart(position_1, position_2, softening)
    r = np.where(r == 0, np.inf, r)  # no pull, however large the masses are
    size = GRAVITATIONAL_CONSTANT * ((m_1 / r) * (m_2 / r))
    return np.asarray(size[..., None] * (d / r[..., None]))


def universal_gravity_energy(
    mass_1: ArrayLike,
    mass_2: ArrayLike,
    position_1: ArrayLike,
    position_2: ArrayLike,
    softening: ArrayLike = 0.0,
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

    Raises
    ------
    ValueError
        If a mass is negative or not finite, softening is negative, or a position does
        not have three components.

    Notes
    -----
    The energy is

        −G m1 m2/√(‖d‖² + ε²),    d = x2 − x1

    Its slope along ‖d‖ is G m1 m2 ‖d‖/(‖d‖² + ε²)^(3/2). This is the size of the force
    of `universal_gravity`, which points to where the energy is lower.
    """
    m_1, m_2 = _masses(mass_1, mass_2)
    masses = m_1 * m_2
    _, r = _apart(position_1, position_2, softening)
    energy = -GRAVITATIONAL_CONSTANT * masses / np.where(r == 0, 1.0, r)
    return np.where((r == 0) & (masses > 0), -np.inf, energy)


def mutual_gravity(
    mass: ArrayLike,
    position: ArrayLike,
    softening: ArrayLike = 0.0,
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

    Raises
    ------
    ValueError
        If a mass is negative or not finite, softening is negative, or a position does
        not have three components.

    Notes
    -----
    The pull on a body is the sum of the forces of `universal_gravity` by each of the
    others. All N² pairs are taken at once. This includes the pair of a body with
    itself, whose force is zero because the distance is zero.
    """
    m, x = np.asarray(mass, dtype=float), vector("position", position)
    softening = np.asarray(softening, dtype=float)[..., None, None]
    on_1_by_2 = universal_gravity(
        m[..., :, None],
        m[..., None, :],
        x[..., :, None, :],
        x[..., None, :, :],
        softening,
    )
    return np.asarray(on_1_by_2.sum(axis=-2))


def _masses(mass_1: ArrayLike, mass_2: ArrayLike) -> tuple[Array, Array]:
    return finite("mass_1", not_negative("mass_1", mass_1)), finite(
        "mass_2", not_negative("mass_2", mass_2)
    )


def _apart(
    position_1: ArrayLike, position_2: ArrayLike, softening: ArrayLike
) -> tuple[Array, Array]:
    """Vector from body 1 to body 2, and √(‖d‖² + ε²)."""
    d = np.asarray(
        vector("position_2", position_2) - vector("position_1", position_1)
    )
    return d, np.hypot(
        np.linalg.norm(d, axis=-1), not_negative("softening", softening)
    )
