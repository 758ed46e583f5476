"""One step of the lab's own world (slide 3)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Integers
from solutions.vectors import quotient
from solutions.world.rotation import turned
from solutions.world.simple_contacts import (
    SimpleBodies,
    SimpleState,
    collect_contacts,
)
from solutions.world.simple_response import (
    kept_impulses,
    out_of_overlap,
    respond,
)
from solutions.world.simple_turning import rotate_by_momentum


def step_world(
    bodies: SimpleBodies,
    state: SimpleState,
    acceleration: Array,
    dt: float,
    rules: tuple[float, float, int],
    memory: tuple[Integers, Array] | None = None,
    force: Array = (0.0, 0.0, 0.0),
    torque: Array = (0.0, 0.0, 0.0),
) -> tuple[Array, Array, Array, Array, Integers, Array]:
    """One step of length dt: forces, contacts, velocities, positions.

    Parameters
    ----------
    bodies : inverse_mass, moments, restitution, friction, meet, kind, size
    state : position, orientation, velocity, angular_velocity
    acceleration : (3,), g, of all bodies that can be moved, m/s²
    dt : s
    rules : rest_speed, margin, sweeps, in m/s and m
    memory : key (m,) and impulse (m, 3) of the contacts of the last step
    force, torque : (n, 3) or (3,), all others on each body, N and N m

    Returns
    -------
    position, orientation, velocity, angular_velocity : the state at the end
    key, impulse : (m,) and (m, 3), the memory for the next step
        What `respond` says of the contacts where the step begins.

    Notes
    -----
    The order is that of semi-implicit Euler: the velocities first, and then
    the positions with the new velocities. Contacts are looked for once, at the
    places where the step begins, so a fast body may be in overlap before
    anybody notices: this is slide 3's "after the fact".
    """
    inverse_mass, moments, *_ = bodies
    position, orientation = state[:2]
    rest_speed, margin, sweeps = rules
    mass = quotient(1.0, inverse_mass)
    push = mass[:, None] * acceleration + force
    load = np.concatenate([push, np.broadcast_to(torque, push.shape)], axis=-1)

    contacts = collect_contacts(bodies, state, margin)
    kept = kept_impulses(memory, contacts)
    velocity, spin, impulse = respond(
        bodies, state, contacts, load, dt, rest_speed, sweeps, kept
    )

    moving = position, orientation, velocity, spin
    way = out_of_overlap(bodies, moving, contacts, dt)
    position = position + dt * velocity + way[:, :3]
    orientation = turned(orientation, way[:, 3:])
    orientation, spin = rotate_by_momentum(orientation, spin, moments, dt)
    return position, orientation, velocity, spin, contacts[-1], impulse
