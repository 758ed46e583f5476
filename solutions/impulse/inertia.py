"""How hard a body is to turn: its moments of inertia, and their inverse in the world frame (slide 18)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, unit, vector

Array = NDArray[np.float64]


def sphere_inertia(mass: ArrayLike, radius: ArrayLike) -> Array:
    """Moments of inertia of a solid ball: 2/5 m r² about every axis through its centre.

    Parameters
    ----------
    mass : (...), kg, positive; infinity for an immovable one
    radius : (...), m, not negative; 0 for a point mass, which nothing can spin

    Returns
    -------
    (..., 3), kg m², about x, y and z of the body

    Raises
    ------
    ValueError
        If the mass is not positive, or the radius is negative or not finite.
    """
    squared = finite("radius", not_negative("radius", radius)) ** 2
    return _moments(mass, 2 / 5 * squared[..., None] * np.ones(3))


def box_inertia(mass: ArrayLike, size: ArrayLike) -> Array:
    """Moments of inertia of a solid box: m (b² + c²)/12 about its axis along a, and likewise about the others.

    Parameters
    ----------
    mass : (...), kg, positive; infinity for an immovable one
    size : (..., 3), whole edges a, b, c along x, y, z of the body, m, not negative

    Returns
    -------
    (..., 3), kg m²

    Raises
    ------
    ValueError
        If the mass is not positive, or a size is negative, not finite or has not three components.
    """
    squared = finite("size", not_negative("size", vector("size", size))) ** 2
    return _moments(mass, (squared[..., [1, 0, 0]] + squared[..., [2, 2, 1]]) / 12)


def rod_inertia(mass: ArrayLike, length: ArrayLike) -> Array:
    """Moments of inertia of a thin rod along z of the body: m L²/12 about x and y, and none about itself.

    Parameters
    ----------
    mass : (...), kg, positive; infinity for an immovable one
    length : (...), L, m, not negative

    Returns
    -------
    (..., 3), kg m²

    Raises
    ------
    ValueError
        If the mass is not positive, or the length is negative or not finite.
    """
    squared = finite("length", not_negative("length", length)) ** 2
    return _moments(mass, squared[..., None] * np.array([1.0, 1.0, 0.0]) / 12)


def rotation_matrix(orientation: ArrayLike) -> Array:
    """Matrix R that turns vectors of the body's axes into the world (slide 18).

    Of the unit quaternion w + x i + y j + z k it is

        R = 1 + 2 w [q×] + 2 [q×]²,    q = (x, y, z), [q×] p = q × p

    Parameters
    ----------
    orientation : (..., 4), unit quaternion w, x, y, z; q and −q are the same orientation

    Returns
    -------
    (..., 3, 3); its columns are the body's axes as seen in the world

    Raises
    ------
    ValueError
        If a quaternion has not four components or not length 1.
    """
    q = np.asarray(orientation, dtype=float)
    if q.shape[-1:] != (4,):
        raise ValueError(f"orientation must have shape (..., 4), not {q.shape}")
    q = unit("orientation", q) / np.linalg.norm(q, axis=-1, keepdims=True)  # single precision passes, and is put right
    across = np.swapaxes(np.cross(q[..., None, 1:], np.eye(3)), -1, -2)  # q × of each axis, in the columns
    return np.asarray(np.eye(3) + 2 * q[..., :1, None] * across + 2 * across @ across)


def world_inertia(inertia: ArrayLike, orientation: ArrayLike) -> Array:
    """Inertia of a turned body about its centre: I(t) = R I_body Rᵀ, for L = I ω.

    Parameters
    ----------
    inertia : (..., 3), moments about the body's own axes, kg m², not negative and finite
    orientation : (..., 4), unit quaternion w, x, y, z

    Returns
    -------
    (..., 3, 3), kg m²

    Raises
    ------
    ValueError
        If a moment is infinite (what is immovable has no angular momentum to speak of), or as world_inverse_inertia.
    """
    return _turned(finite("inertia", not_negative("inertia", vector("inertia", inertia))), orientation)


def world_inverse_inertia(inertia: ArrayLike, orientation: ArrayLike) -> Array:
    """Inverse inertia of a turned body: I⁻¹(t) = R I_body⁻¹ Rᵀ (slide 18).

    I_body is constant, and diagonal in the body's own axes; only R changes as it turns. Read from the right: into the
    body's axes, there divided by its moments, and back into the world.

    Parameters
    ----------
    inertia : (..., 3), moments about the body's own axes, kg m², not negative; infinite where it cannot be turned
    orientation : (..., 4), unit quaternion w, x, y, z

    Returns
    -------
    (..., 3, 3), 1/(kg m²). About an axis with an infinite moment it is 0, and so it is about one with none: all mass
    lies on that axis, as in a thin rod, and no impulse on the body has a lever arm about it.

    Raises
    ------
    ValueError
        If a moment is negative or not a number, or a quaternion has not four components or not length 1.
    """
    moments = not_negative("inertia", vector("inertia", inertia))
    return _turned(np.where(moments > 0, 1 / np.where(moments > 0, moments, 1.0), 0.0), orientation)


def _turned(diagonal: Array, orientation: ArrayLike) -> Array:
    """R diag Rᵀ."""
    to_world = rotation_matrix(orientation)
    return np.asarray((to_world * diagonal[..., None, :]) @ np.swapaxes(to_world, -1, -2))


def _moments(mass: ArrayLike, per_mass: Array) -> Array:
    """Of an immovable body all of them are infinite, also of a point and of a rod about itself."""
    mass = positive("mass", mass)[..., None]
    immovable = np.isinf(mass)
    return np.where(immovable, np.inf, np.where(immovable, 0.0, mass) * per_mass)
