"""The contacts that a step resolves, and their targets (slides 3 and 21)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.approach import closing, normal_speeds
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.memory import Memory
from solutions.world.rows import Rows
from solutions.world.rules import Rules
from solutions.world.sequential import Targets, in_groups
from solutions.world.shapes import TOUCH


def answered(
    bodies: Bodies,
    state: State,
    velocity: Array,
    spin: Array,
    dt: float,
    rules: Rules,
    memory: Memory,
) -> tuple[Contacts, list[slice], Targets, Array]:
    """The contacts of a step in their groups, and what they have to reach.

    Parameters
    ----------
    bodies, state : the world, where the step begins
    velocity, spin : (n, 3), m/s and rad/s
        With what the forces of the step add.
    dt : s
    rules : how the world responds
    memory : what the last step left

    Returns
    -------
    contacts : m contacts, group by group
    groups : where each group is in this order
    targets : what their impulses have to reach
    restitution : (m,), e

    Notes
    -----
    A contact that is to rebound does so in the step whose beginning is nearest
    to the touch. So it waits while the surfaces do not touch within half a
    step. All other contacts may close their gap. That of two bodies which pass
    each other is none, but a ball that rolls over another one keeps the
    contact which has carried it.
    """
    contacts = find_contacts(bodies, state, rules.margin)
    moving = (
        (velocity, spin)
        if rules.with_weight
        else (state.velocity, state.angular_velocity)
    )
    approach = -normal_speeds(contacts, state.position, *moving)
    surfaces = bodies.surfaces
    of_a = bodies.material[contacts.body_a]
    of_b = bodies.material[contacts.body_b]
    restitution = surfaces.restitution[of_a, of_b]
    collides = approach > rules.rest_speed
    rebound = np.where(collides, restitution * approach, 0.0)
    time = np.where(rebound > 0, dt / 2, dt)
    closes, touches = closing(bodies, state, contacts, velocity, spin, time)
    held = rebound == 0
    passes = held & closes & ~touches
    if np.any(passes):
        passes &= ~np.isin(contacts.key, memory.carried)
    chosen = np.flatnonzero(np.where(held, ~passes, touches))
    contacts, groups, order = grouped(bodies, contacts, chosen)
    rebound, of_a, of_b = rebound[order], of_a[order], of_b[order]
    closing_speed = -np.maximum(contacts.separation, 0.0) / dt
    targets = Targets(
        speed=np.where(rebound > 0, rebound, closing_speed),
        static_friction=surfaces.static_friction[of_a, of_b],
        kinetic_friction=surfaces.kinetic_friction[of_a, of_b],
        rebounds=rebound > 0,
    )
    return contacts, groups, targets, restitution[order]


def driven_together(
    contacts: Contacts,
    rows: Rows,
    targets: Targets,
    restitution: Array,
    impulse: Array,
    dt: float,
    rules: Rules,
) -> Booleans:
    """Which gaps other impulses close so fast that a rebound is due, (m,).

    Parameters
    ----------
    contacts, rows, targets : m contacts of a step, and what they had to reach
    restitution : (m,), e
    impulse : (m, 3), what they were given, N s
    dt : s
    rules : how the world responds

    Notes
    -----
    To stop such bodies before they touch would take the speed with which they
    are to part. So they go on, and rebound in the next step. A gap that is
    closed from rest within half a step counts as none.
    """
    if rules.response == "penalty":
        return np.zeros(len(impulse), dtype=bool)
    free = targets.speed - impulse[:, 0] * rows.softness[:, 0, 0]
    is_gap = contacts.separation > max(TOUCH, rules.rest_speed * dt / 2)
    is_stopped = ~targets.rebounds & (impulse[:, 0] > 0)
    would_rebound = (restitution > 0) & (free < -rules.rest_speed)
    return is_gap & is_stopped & would_rebound


def grouped(
    bodies: Bodies, contacts: Contacts, chosen: Integers
) -> tuple[Contacts, list[slice], Integers]:
    """The chosen contacts in groups that take turns together; their order."""
    body_a, body_b = contacts.body_a[chosen], contacts.body_b[chosen]
    order, groups = in_groups(body_a, body_b, bodies.inverse_mass > 0)
    order = chosen[order]
    return contacts.in_order(order), groups, order
