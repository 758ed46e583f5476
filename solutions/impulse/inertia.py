"""How hard a body is to turn: moments of inertia and I⁻¹(t) (slide 18)."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from solutions.arrays import Array
from solutions.checks import finite, not_negative, vector
from solutions.domain import (
    FiniteNotNegative,
    Matrix,
    Positive,
    Quaternion,
    domain,
)
from solutions.vectors import direction, quotient

NO_INVERSE = 1e-12
"""Share of the largest inverse moment up to which another one counts as 0.

Turned to the world frame and back, an inverse moment of 0 is a rounding of
this matrix.
"""
Lengths = Annotated[Array, vector, not_negative, finite]
"""(..., 3), not negative and finite, one for each axis of a body."""
Moments = Annotated[Array, vector, not_negative]
"""(..., 3), not negative, about the axes of a body; infinite for no turn."""


@domain
def sphere_inertia(mass: Positive, radius: FiniteNotNegative) -> Array:
    """Moments of inertia of a solid ball about its centre.

    Parameters
    ----------
    mass : (...), kg, positive; infinity for an immovable ball
    radius : (...), m, not negative
        0 for a point mass, which nothing can spin.

    Returns
    -------
    (..., 3), kg m², about x, y and z of the body
        All infinite for an immovable ball, also for an immovable point.

    Notes
    -----
    A ball is the same about every axis through its centre:

        I = 2/5 m r²
    """
    per_mass = 2 / 5 * radius[..., None] ** 2 * np.ones(3)
    return _moments(mass, per_mass)


@domain
def box_inertia(mass: Positive, size: Lengths) -> Array:
    """Moments of inertia of a solid box about its centre.

    Parameters
    ----------
    mass : (...), kg, positive; infinity for an immovable box
    size : (..., 3), m, not negative
        Whole edges a, b, c along x, y, z of the body.

    Returns
    -------
    (..., 3), kg m², about x, y and z of the body
        All infinite for an immovable box.

    Notes
    -----
    About the axis along a, only the other two edges count, and likewise about
    the others:

        I_a = m (b² + c²)/12
    """
    # The two edges across each axis: b and c across a, and so on.
    second, third = size[..., [1, 0, 0]], size[..., [2, 2, 1]]
    return _moments(mass, (second**2 + third**2) / 12)


@domain
def rod_inertia(mass: Positive, length: FiniteNotNegative) -> Array:
    """Moments of inertia of a thin rod along z of the body, about its centre.

    Parameters
    ----------
    mass : (...), kg, positive; infinity for an immovable rod
    length : (...), L, m, not negative

    Returns
    -------
    (..., 3), kg m², about x, y and z of the body
        0 about z, the rod itself. All infinite for an immovable rod, also
        about z.

    Notes
    -----
    About x and y, with no thickness:

        I = m L²/12
    """
    per_mass = length[..., None] ** 2 * np.array([1.0, 1.0, 0.0]) / 12
    return _moments(mass, per_mass)


@domain
def rotation_matrix(orientation: Quaternion) -> Array:
    """Matrix R that turns vectors of the body into the world (slide 18).

    Parameters
    ----------
    orientation : (..., 4), unit quaternion w, x, y, z
        The opposite quaternion is the same orientation.

    Returns
    -------
    (..., 3, 3)
        Its columns are the body's axes as seen in the world.

    Notes
    -----
    For the unit quaternion w + x i + y j + z k, with q = (x, y, z) for its
    vector part and [q×] for the matrix of the cross product, [q×] p = q × p:

        R = 1 + 2 w [q×] + 2 [q×]²
    """
    # Single precision may leave a length that is not quite 1: correct it.
    quaternion = direction(orientation)
    w, q = quaternion[..., 0], quaternion[..., 1:]
    # The columns of [q×] are q × each axis.
    columns = np.cross(q[..., None, :], np.eye(3))
    cross = np.swapaxes(columns, -1, -2)
    return np.eye(3) + 2 * w[..., None, None] * cross + 2 * cross @ cross


@domain
def world_inertia(inertia: Lengths, orientation: Quaternion) -> Array:
    """Inertia of a turned body about its centre, in the world frame.

    Parameters
    ----------
    inertia : (..., 3), kg m², not negative and finite
        Moments about the body's own axes.
    orientation : (..., 4), unit quaternion w, x, y, z

    Returns
    -------
    (..., 3, 3), kg m²

    Notes
    -----
    This is the I(t) of L = I ω. Read the product from the right: Rᵀ turns ω
    into the body's axes, I_body multiplies it by the moments, and R turns the
    result back into the world.

        I(t) = R I_body Rᵀ
    """
    return _turned(inertia, orientation)


@domain
def world_inverse_inertia(inertia: Moments, orientation: Quaternion) -> Array:
    """Inverse inertia of a turned body, in the world frame (slide 18).

    Parameters
    ----------
    inertia : (..., 3), kg m², not negative
        Moments about the body's own axes; infinite where the body cannot be
        turned.
    orientation : (..., 4), unit quaternion w, x, y, z

    Returns
    -------
    (..., 3, 3), 1/(kg m²)
        0 about an axis with an infinite moment. Also 0 about an axis with
        none: all mass lies on that axis, as in a thin rod, and no impulse on
        the body has a lever arm about it.

    Notes
    -----
    I_body is constant, and it is diagonal in the body's own axes. Only R
    changes as the body turns:

        I⁻¹(t) = R I_body⁻¹ Rᵀ

    Read the product from the right: Rᵀ turns a vector into the body's axes,
    I_body⁻¹ divides it by the moments there, and R turns the result back into
    the world.
    """
    return _turned(quotient(1.0, inertia), orientation)


@domain
def mass_and_inertia(
    inverse_mass: FiniteNotNegative, inverse_inertia: Matrix
) -> tuple[Array, Array]:
    """Mass and inertia of what can be moved; 0 for what cannot.

    Parameters
    ----------
    inverse_mass : (...), 1/M, 1/kg, not negative
    inverse_inertia : (..., 3, 3), I⁻¹, 1/(kg m²)
        In any axes, symmetric.

    Returns
    -------
    mass : (...), M, kg
        0 for an immovable body, 1/M = 0, so that it adds nothing to a sum.
    inertia : (..., 3, 3), I, kg m²
        0 about an axis without an inverse inertia, for the same reason.

    Notes
    -----
    An inverse moment is 0 in two cases: nothing turns the body about this
    axis, or, as for a thin rod, all mass lies on the axis. No impact changes
    the spin of the first. The spin of the second has neither angular momentum
    nor energy. So neither may count in an account of an impact, and I is the
    pseudo-inverse of I⁻¹: inverted about all other axes, 0 about these.
    """
    mass = quotient(1.0, inverse_mass)
    inertia: Array = np.linalg.pinv(
        inverse_inertia, rcond=NO_INVERSE, hermitian=True
    )
    return mass, inertia


def _turned(diagonal: Array, orientation: Array) -> Array:
    """R diag Rᵀ."""
    to_world = rotation_matrix(orientation)
    to_body = np.swapaxes(to_world, -1, -2)
    return (to_world * diagonal[..., None, :]) @ to_body


def _moments(mass: Array, per_mass: Array) -> Array:
    """Moments of a body.

    Of an immovable body all of them are infinite, also those of a point and of
    a rod about itself.
    """
    immovable = np.isinf(mass)[..., None]
    finite_mass = np.where(immovable, 0.0, mass[..., None])
    return np.where(immovable, np.inf, finite_mass * per_mass)
