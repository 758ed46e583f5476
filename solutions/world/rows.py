"""What impulses do at contacts, and how points move (slides 14 to 18)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Integers
from solutions.world.contacts import Contacts
from solutions.world.vectors import cross, tangents


class Rows(NamedTuple):
    """Three directions at each of m contacts: the normal and two tangents.

    Attributes
    ----------
    body_a, body_b : (m,)
    direction : (m, 3, 3), of the impulse that each row gives A, and −it to B
    speed : (m, 3, 12), J
        Turns v_A, ω_A, v_B, ω_B into the three speeds.
    answer : (m, 3, 12), M⁻¹ Jᵀ
        How v_A, ω_A, v_B, ω_B change with a unit impulse of each row.
    softness : (m, 3, 3), J M⁻¹ Jᵀ, 1/kg
        How the speeds of one contact change with its own impulses.
    coupling : (m, 2), a = K_nt/K_nn
        How much friction would move the normal speed.
    """

    body_a: Integers
    body_b: Integers
    direction: Array
    speed: Array
    answer: Array
    softness: Array
    coupling: Array


def contact_rows(
    contacts: Contacts,
    position: Array,
    inverse_mass: Array,
    inverse_inertia: Array,
    decoupled: bool = True,
) -> Rows:
    """The rows of all contacts.

    Parameters
    ----------
    contacts : m contacts
    position : (n, 3), of the bodies' centres, m
    inverse_mass : (n,), 1/kg
    inverse_inertia : (n, 3, 3), in the world frame, 1/(kg m²)
    decoupled : whether friction leaves the normal speed alone
        If not, it acts along the tangents themselves, and the coupling a is 0.

    Returns
    -------
    Rows

    Notes
    -----
    The speed of the two points of a contact along a direction d is

        d·(v_A + ω_A × r_A − v_B − ω_B × r_B) = J (v_A, ω_A, v_B, ω_B)
        with J = (d, r_A × d, −d, −r_B × d)

    and the impulse d on A, −d on B, changes the velocities by M⁻¹ Jᵀ.

    An impulse along a tangent t changes the normal speed as well, by K_nt.
    Newton's law of restitution leaves the normal speed no choice. So friction
    here acts along t − a n with a = K_nt/K_nn: the impulse that moves the
    points along the surface and leaves their normal speed alone. Then the two
    do not disturb each other, and a contact is solved in one turn.
    Friction that opposes the slip itself needs the tangents, and so does a
    penalty contact.
    """
    a, b = contacts.body_a, contacts.body_b
    direction = np.stack([contacts.normal, *tangents(contacts.normal)], axis=1)
    arm_a, arm_b = (contacts.point - position[body] for body in (a, b))
    turn_a = cross(arm_a[:, None, :], direction)
    turn_b = cross(arm_b[:, None, :], direction)
    speed = np.concatenate([direction, turn_a, -direction, -turn_b], axis=-1)
    answer = np.concatenate(
        [
            inverse_mass[a][:, None, None] * direction,
            turn_a @ inverse_inertia[a],
            -inverse_mass[b][:, None, None] * direction,
            -turn_b @ inverse_inertia[b],
        ],
        axis=-1,
    )
    normal_softness = np.vecdot(speed[:, 0], answer[:, 0])[:, None]
    along = np.matvec(speed[:, 1:], answer[:, 0])
    coupling = along / normal_softness * decoupled
    for rows in (direction, speed, answer):
        rows[:, 1:] -= coupling[:, :, None] * rows[:, :1]
    softness = speed @ np.swapaxes(answer, -1, -2)
    return Rows(a, b, direction, speed, answer, softness, coupling)


def speeds(rows: Rows, velocity: Array, angular_velocity: Array) -> Array:
    """Speeds (m, 3) along the normal and the two tangents, m/s."""
    a, b = rows.body_a, rows.body_b
    of_both = np.concatenate(
        [velocity[a], angular_velocity[a], velocity[b], angular_velocity[b]],
        axis=-1,
    )
    return np.matvec(rows.speed, of_both)


def after_impulses(
    rows: Rows, velocity: Array, angular_velocity: Array, impulse: Array
) -> tuple[Array, Array]:
    """Velocities and spins (n, 3) after impulses (m, 3) along the rows."""
    velocities = np.concatenate([velocity, angular_velocity], axis=-1)
    given = np.vecmat(impulse, rows.answer)
    np.add.at(velocities, rows.body_a, given[:, :6])
    np.add.at(velocities, rows.body_b, given[:, 6:])
    return velocities[:, :3], velocities[:, 3:]
