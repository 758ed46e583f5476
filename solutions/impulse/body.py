"""What an impact needs to know of a body, and what an impulse does to it."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np

from solutions.arrays import Array
from solutions.checks import finite, in_space, matrix, not_negative

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

    velocity: Array
    angular_velocity: Array
    arm: Array
    inverse_mass: Array
    inverse_inertia: Array


class CheckedBody(Body):
    """A body that is not checked again, by the functions that others call."""


def checked(body: Any) -> Body:
    """Return a body of arrays; refuse values that no body has."""
    if isinstance(body, CheckedBody):
        return body
    v, w, r, inverse_mass, inverse_inertia = body
    inverse_inertia = matrix("inverse_inertia", inverse_inertia)
    diagonal = np.diagonal(inverse_inertia, axis1=-2, axis2=-1)
    largest = np.max(np.abs(inverse_inertia), axis=(-2, -1))[..., None]
    not_negative("diagonal of inverse_inertia", diagonal + ROUNDING * largest)
    return CheckedBody(
        in_space("velocity", v),
        in_space("angular_velocity", w),
        in_space("arm", r),
        finite("inverse_mass", not_negative("inverse_mass", inverse_mass)),
        inverse_inertia,
    )


AnyBody = Annotated[Body, lambda _, body: checked(body)]
"""A `Body`, or a tuple in its order; its parts may be lists and numbers."""

Velocities = Annotated[
    tuple[Array, Array, Array, Array],
    lambda name, four: tuple(in_space(name, each) for each in four),
]
"""v_A, ω_A, v_B, ω_B, (..., 3) each, m/s and rad/s, finite."""


def velocity_changes(body: Body, impulse: Array) -> tuple[Array, Array]:
    """Changes Δv = J/M and Δω = I⁻¹(r × J) that an impulse (..., 3) makes."""
    _, _, r, inverse_mass, inverse_inertia = body
    dv = inverse_mass[..., None] * impulse
    dw = (inverse_inertia @ np.cross(r, impulse)[..., None])[..., 0]
    return dv, dw
