"""Points of bodies, at which springs are tied and forces act (slides 14 and 18)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import in_space, vector
from solutions.impulse import point_velocity, rotation_matrix

WORLD = -1
"""The number of no body: what is tied to it is tied to a place in the world."""

AnyState = tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike]
"""Where n bodies are and how they move.

position : (..., n, 3), of the centres of mass, m
orientation : (..., n, 4), unit quaternions w, x, y, z
velocity : (..., n, 3), m/s
angular_velocity : (..., n, 3), in the world frame, rad/s
"""
ForceAndTorque = tuple[Array, Array]
"""On each body, (..., n, 3) each, N and N m; the torque is about its centre of mass."""


def point_motion(
    state: AnyState, body: ArrayLike, point: ArrayLike
) -> tuple[Array, Array]:
    """Where points of bodies are in the world, and how they move (slide 14).

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    body : (m,), number of each point's body, or −1 for the world
    point : (m, 3), in the body's own frame, m; in the world frame for −1

    Returns
    -------
    position, velocity : (..., m, 3) each, m and m/s
        A point of the world stays where it is.

    Raises
    ------
    ValueError
        If there is no such body, or a point is not finite or does not have three
        components.
    """
    position, orientation, velocity, spin = arrays_of(state)
    number, own = (
        body_numbers("body", body, position.shape[-2]),
        in_space("point", point),
    )
    of_body = (number != WORLD)[:, None]
    arm = (rotation_matrix(orientation[..., number, :]) @ own[..., None])[
        ..., 0
    ]
    moving = point_velocity(
        velocity[..., number, :], spin[..., number, :], arm
    )
    return np.where(of_body, position[..., number, :] + arm, own), np.where(
        of_body, moving, 0.0
    )


def forces_at_points(
    state: AnyState, body: ArrayLike, place: ArrayLike, force: ArrayLike
) -> ForceAndTorque:
    """What m forces at points of bodies add up to on each body.

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    body : (m,), number of the body on which each force acts, or −1 for the world
    place : (..., m, 3), where it acts, in the world frame, m
    force : (..., m, 3), N

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        A force on the world is left out.

    Raises
    ------
    ValueError
        If there is no such body, or a vector does not have three components.

    Notes
    -----
    A force F at p has the torque (p − x) × F about the centre of mass x.
    """
    position = arrays_of(state)[0]
    number = body_numbers("body", body, position.shape[-2])
    pulled = number != WORLD
    number, f = number[pulled], vector("force", force)[..., pulled, :]
    arm = vector("place", place)[..., pulled, :] - position[..., number, :]
    total, torque = np.zeros_like(position), np.zeros_like(position)
    # total[number] += f would keep only one of several forces on the same body.
    np.add.at(
        np.moveaxis(total, -2, 0),
        number,
        np.moveaxis(np.broadcast_to(f, arm.shape), -2, 0),
    )
    np.add.at(
        np.moveaxis(torque, -2, 0),
        number,
        np.moveaxis(np.cross(arm, f), -2, 0),
    )
    return total, torque


def arrays_of(state: AnyState) -> tuple[Array, Array, Array, Array]:
    """Position, orientation, velocity and spin as arrays."""
    position, orientation, velocity, spin = (
        np.asarray(part, dtype=float) for part in state
    )
    return (
        vector("position", position),
        orientation,
        vector("velocity", velocity),
        vector("angular_velocity", spin),
    )


def body_numbers(
    name: str, number: ArrayLike, count: int, least: int = WORLD
) -> Integers:
    """Numbers (m,) of bodies; refuse others than `least` to count − 1."""
    found = np.asarray(number)
    if found.ndim != 1 or found.dtype.kind not in "iu":
        raise ValueError(
            f"{name} must be whole numbers of the shape (m,), not"
            f" {found.dtype} of {found.shape}"
        )
    if np.any((found < least) | (found >= count)):
        raise ValueError(
            f"{name} must be from {least} to {count - 1}, not {found.tolist()}"
        )
    return found.astype(np.int64)
