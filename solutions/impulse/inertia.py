"""Moments of inertia, and their inverse in the world frame (slide 18).

They say how hard a body is to turn.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import (
    finite,
    matrix,
    not_negative,
    positive,
    unit,
    vector,
)

NO_INVERSE = 1e-12
"""Share of the largest inverse moment up to which another one counts as 0.

Turned to the world frame and back, an inverse moment of 0 is a rounding of
this matrix.
"""


def sphere_inertia(mass: ArrayLike, radius: ArrayLike) -> Array:
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

    Raises
    ------
    ValueError
        If the mass is not positive, or the radius is negative or not finite.

    Notes
    -----
    A ball is the same about every axis through its centre:

        I = 2/5 m r²
    """
    squared = finite("radius", not_negative("radius", radius)) ** 2
    return _moments(mass, 2 / 5 * squared[..., None] * np.ones(3))


def box_inertia(mass: ArrayLike, size: ArrayLike) -> Array:
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

    Raises
    ------
    ValueError
        If the mass is not positive, or a size is negative, is not finite or
        does not have three components.

    Notes
    -----
    About the axis along a, only the other two edges count, and likewise about
    the others:

        I_a = m (b² + c²)/12
    """
    squared = finite("size", not_negative("size", vector("size", size))) ** 2
    return _moments(
        mass, (squared[..., [1, 0, 0]] + squared[..., [2, 2, 1]]) / 12
    )


def rod_inertia(mass: ArrayLike, length: ArrayLike) -> Array:
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

    Raises
    ------
    ValueError
        If the mass is not positive, or the length is negative or not finite.

    Notes
    -----
    About x and y, with no thickness:

        I = m L²/12
    """
    squared = finite("length", not_negative("length", length)) ** 2
    return _moments(mass, squared[..., None] * np.array([1.0, 1.0, 0.0]) / 12)


def rotation_matrix(orientation: ArrayLike) -> Array:
    """Matrix R that turns vectors of the body into the world (slide 18).

    Parameters
    ----------
    orientation : (..., 4), unit quaternion w, x, y, z
        q and −q are the same orientation.

    Returns
    -------
    (..., 3, 3)
        Its columns are the body's axes as seen in the world.

    Raises
    ------
    ValueError
        If a quaternion does not have four components or does not have length
        1.

    Notes
    -----
    For the unit quaternion w + x i + y j + z k, with q = (x, y, z) and [q×] p
    = q × p:

        R = 1 + 2 w [q×] + 2 [q×]²
    """
    q = np.asarray(orientation, dtype=float)
    if q.shape[-1:] != (4,):
        raise ValueError(
            f"orientation must have shape (..., 4), not {q.shape}"
        )
    # A quaternion in single precision passes `unit`: correct its length.
    q = unit("orientation", q) / np.linalg.norm(q, axis=-1, keepdims=True)
    # The columns are q × each axis.
    across = np.swapaxes(np.cross(q[..., None, 1:], np.eye(3)), -1, -2)
    return np.asarray(
        np.eye(3) + 2 * q[..., :1, None] * across + 2 * across @ across
    )


def world_inertia(inertia: ArrayLike, orientation: ArrayLike) -> Array:
    """Inertia of a turned body about its centre, in the world frame.

    Parameters
    ----------
    inertia : (..., 3), kg m², not negative and finite
        Moments about the body's own axes.
    orientation : (..., 4), unit quaternion w, x, y, z

    Returns
    -------
    (..., 3, 3), kg m²

    Raises
    ------
    ValueError
        If a moment is infinite (an immovable body has no angular momentum that
        could be computed), or as world_inverse_inertia.

    Notes
    -----
    This is the I(t) of L = I ω. Read the product from the right: Rᵀ turns ω
    into the body's axes, I_body multiplies it by the moments, and R turns the
    result back into the world.

        I(t) = R I_body Rᵀ
    """
    return _turned(
        finite("inertia", not_negative("inertia", vector("inertia", inertia))),
        orientation,
    )


def world_inverse_inertia(inertia: ArrayLike, orientation: ArrayLike) -> Array:
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

    Raises
    ------
    ValueError
        If a moment is negative or not a number, or a quaternion does not have
        four components or does not have length 1.

    Notes
    -----
    I_body is constant, and it is diagonal in the body's own axes. Only R
    changes as the body turns:

        I⁻¹(t) = R I_body⁻¹ Rᵀ

    Read the product from the right: Rᵀ turns a vector into the body's axes,
    I_body⁻¹ divides it by the moments there, and R turns the result back into
    the world.
    """
    moments = not_negative("inertia", vector("inertia", inertia))
    return _turned(
        np.where(moments > 0, 1 / np.where(moments > 0, moments, 1.0), 0.0),
        orientation,
    )


def mass_and_inertia(
    inverse_mass: ArrayLike, inverse_inertia: ArrayLike
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

    Raises
    ------
    ValueError
        If an inverse mass is negative, or something is not finite or does not
        fit.

    Notes
    -----
    An inverse moment is 0 in two cases: nothing turns the body about this
    axis, or, as for a thin rod, all mass lies on the axis. No impact changes
    the spin of the first. The spin of the second has neither angular momentum
    nor energy. So neither may count in an account of an impact, and I is the
    pseudo-inverse of I⁻¹: inverted about all other axes, 0 about these.
    """
    per_mass = finite(
        "inverse_mass", not_negative("inverse_mass", inverse_mass)
    )
    mass = np.where(
        per_mass > 0, 1 / np.where(per_mass > 0, per_mass, 1.0), 0.0
    )
    inertia = np.linalg.pinv(
        matrix("inverse_inertia", inverse_inertia),
        rcond=NO_INVERSE,
        hermitian=True,
    )
    return mass, np.asarray(inertia)


def _turned(diagonal: Array, orientation: ArrayLike) -> Array:
    """R diag Rᵀ."""
    to_world = rotation_matrix(orientation)
    return np.asarray(
        (to_world * diagonal[..., None, :]) @ np.swapaxes(to_world, -1, -2)
    )


def _moments(mass: ArrayLike, per_mass: Array) -> Array:
    """Moments of a body.

    Of an immovable body all of them are infinite, also those of a point and of
    a rod about itself.
    """
    mass = positive("mass", mass)[..., None]
    immovable = np.isinf(mass)
    return np.where(
        immovable, np.inf, np.where(immovable, 0.0, mass) * per_mass
    )
