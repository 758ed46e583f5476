"""What an impact needs to know of a body, and what an impulse does to it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, matrix, not_negative, vector

ROUNDING = 1e-12
"""How far the diagonal of an inverse inertia may be below zero.

It is a share of the largest number of the matrix. The inverse inertia of a
thin rod can have such a diagonal once the rod has been turned.
"""


class Body(NamedTuple):
    """One body of an impact; a plain tuple in this order works as well.

    It is what an impact needs to know, at its instant. The lab's scenarios
    have a `Body` too, in `reference.scene.scenario`: a name, a shape and a
    mass, with the state at the start of a run. Neither can stand for the
    other.

    Attributes
    ----------
    velocity : (..., 3), v of the centre of mass, m/s
    angular_velocity : (..., 3), ω in the world frame, rad/s
    arm : (..., 3), r, m
        From the centre of mass to the contact, in the world frame.
    inverse_mass : (...), 1/M, 1/kg; 0 for an immovable body
    inverse_inertia : (..., 3, 3), I⁻¹(t), 1/(kg m²)
        In the world frame, symmetric; 0 for a body that cannot be turned.
    """

    velocity: ArrayLike
    angular_velocity: ArrayLike
    arm: ArrayLike
    inverse_mass: ArrayLike
    inverse_inertia: ArrayLike


AnyBody = tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike, ArrayLike]
"""A `Body`, or a plain tuple in its order."""
Arrays = tuple[Array, Array, Array, Array, Array]


def checked(body: AnyBody) -> Arrays:
    """Return v, ω, r, 1/M and I⁻¹ as arrays; refuse impossible values."""
    body = Body(*body)
    inverse_inertia = matrix("inverse_inertia", body.inverse_inertia)
    least = (
        ROUNDING * np.max(np.abs(inverse_inertia), axis=(-2, -1))[..., None]
    )
    not_negative(
        "diagonal of inverse_inertia",
        np.diagonal(inverse_inertia, axis1=-2, axis2=-1) + least,
    )
    return (
        finite("velocity", vector("velocity", body.velocity)),
        finite(
            "angular_velocity",
            vector("angular_velocity", body.angular_velocity),
        ),
        finite("arm", vector("arm", body.arm)),
        finite(
            "inverse_mass", not_negative("inverse_mass", body.inverse_mass)
        ),
        inverse_inertia,
    )


def moved(body: Arrays, impulse: Array) -> tuple[Array, Array]:
    """Changes Δv = J/M and Δω = I⁻¹(r × J) that an impulse (..., 3) makes."""
    _, _, r, inverse_mass, inverse_inertia = body
    turned = inverse_inertia @ np.cross(r, impulse)[..., None]
    return inverse_mass[..., None] * impulse, turned[..., 0]
