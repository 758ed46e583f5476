"""Points of bodies: where springs are tied and forces act (slides 14, 18)."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.checks import real, vector
from solutions.domain import Triple, Vector, domain
from solutions.impulse import point_velocity, rotation_matrix

WORLD = -1
"""The number of no body: what is tied to it is tied to the world."""

AnyState = Annotated[
    tuple[Array, Array, Array, Array], lambda _, state: arrays_of(state)
]
"""Where n bodies are and how they move.

position : (..., n, 3), of the centres of mass, m
orientation : (..., n, 4), unit quaternions w, x, y, z
velocity : (..., n, 3), m/s
angular_velocity : (..., n, 3), in the world frame, rad/s
"""
ForceAndTorque = tuple[Array, Array]
"""On each body, (..., n, 3) each, N and N m.

The torque is about the body's centre of mass.
"""


@domain
def point_motion(
    state: AnyState, body: ArrayLike, point: Vector
) -> tuple[Array, Array]:
    """Where points of bodies are in the world, and how they move (slide 14).

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    body : (m,), number of each point's body, or −1 for the world
    point : (m, 3), in the body's own frame, m
        In the world frame for −1.

    Returns
    -------
    position, velocity : (..., m, 3) each, m and m/s
        A point of the world stays where it is.

    Raises
    ------
    ValueError
        If there is no such body.
    """
    number = body_numbers("body", body, state[0].shape[-2])
    x, orientation, v, w = (part[..., number, :] for part in state)
    of_body = (number != WORLD)[:, None]
    arm = (rotation_matrix(orientation) @ point[..., None])[..., 0]
    place = np.where(of_body, x + arm, point)
    return place, np.where(of_body, point_velocity(v, w, arm), 0.0)


@domain
def forces_at_points(
    state: AnyState, body: ArrayLike, place: Triple, force: Triple
) -> ForceAndTorque:
    """What m forces at points of bodies add up to on each body.

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    body : (m,), number of the body on which each force acts
        Or −1 for the world.
    place : (..., m, 3), where it acts, in the world frame, m
    force : (..., m, 3), N

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        A force on the world is left out.

    Raises
    ------
    ValueError
        If there is no such body.

    Notes
    -----
    A force F at p has the torque (p − x) × F about the centre of mass x.
    """
    position = state[0]
    number = body_numbers("body", body, position.shape[-2])
    pulled = number != WORLD
    number, f = number[pulled], force[..., pulled, :]
    arm = place[..., pulled, :] - position[..., number, :]
    total, torque = np.zeros_like(position), np.zeros_like(position)
    for of_bodies, of_points in (
        (total, np.broadcast_to(f, arm.shape)),
        (torque, np.cross(arm, f)),
    ):
        # With += a body would get only one of several forces that act on it.
        places, pulls = (np.moveaxis(a, -2, 0) for a in (of_bodies, of_points))
        np.add.at(places, number, pulls)
    return total, torque


def arrays_of(
    state: tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike],
) -> tuple[Array, Array, Array, Array]:
    """Position, orientation, velocity and spin as arrays."""
    position, orientation, velocity, spin = state
    return (
        vector("position", position),
        real("orientation", orientation),
        vector("velocity", velocity),
        vector("angular_velocity", spin),
    )


def body_numbers(
    name: str, number: ArrayLike, count: int, least: int = WORLD
) -> Integers:
    """Numbers (m,) of bodies; refuse others than `least` to count − 1."""
    given = np.asarray(number)
    if given.ndim != 1 or given.dtype.kind not in "iu":
        raise ValueError(
            f"{name} must be whole numbers of the shape (m,), not"
            f" {given.dtype} of {given.shape}"
        )
    if np.any((given < least) | (given >= count)):
        raise ValueError(
            f"{name} must be from {least} to {count - 1}, not {given.tolist()}"
        )
    return given.astype(np.int64)
