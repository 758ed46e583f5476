"""One step: forces, contacts, velocities, positions (slides 3 to 29)."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, of_shape, positive
from solutions.domain import domain
from solutions.impulse import world_inverse_inertia
from solutions.world.answered import answered, driven_together, grouped
from solutions.world.bodies import Bodies, State, fitting
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.memory import NOTHING, Memory, remembered
from solutions.world.moving import moved_on, pushed_apart
from solutions.world.responses import RESPONSES, Question
from solutions.world.rows import contact_rows, speeds
from solutions.world.rules import Rules, known
from solutions.world.sleeping import (
    is_awake,
    is_fast,
    with_neighbours,
    with_sleepers,
)
from solutions.world.time_order import step_in_time_order


def one_number(name: str, value: ArrayLike) -> float:
    """Return the value as a number; refuse several."""
    return float(of_shape(name, value, ()))


Timestep = Annotated[float, positive, finite, one_number]
"""One number, positive and finite, s."""


@domain
def advance_world(
    bodies: Bodies,
    state: State,
    acceleration: ArrayLike,
    dt: Timestep,
    # Rules is an immutable tuple.
    rules: Rules | tuple[float | str, ...] = Rules(),  # noqa: B008
    memory: Memory = NOTHING,
    force: ArrayLike = (0.0, 0.0, 0.0),
    torque: ArrayLike = (0.0, 0.0, 0.0),
) -> tuple[State, Memory, Contacts]:
    """One step of length dt: forces, contacts, velocities, positions.

    Parameters
    ----------
    bodies, state : the world
    acceleration : (3,) or (n, 3), g, of all bodies that can be moved, m/s²
    dt : s, positive
    rules : how it responds
        A plain tuple will do, with defaults for what it does not reach.
    memory : what the last step left
    force, torque : (n, 3) or (3,), all others on each body, N and N m

    Returns
    -------
    state, memory : for the next step
    contacts : those that this step has resolved
        Of a step in time order, those at its end.

    Raises
    ------
    ValueError
        If there is no such response, it does not know the law, a number of the
        rules is out of its range, the memory is none, or knows sleepers of
        another number of bodies, or an array is not finite or does not fit.
    """
    rules = known(Rules(*rules))
    if not isinstance(memory, Memory):
        raise ValueError(
            "memory must be what another step left, or a run in its attribute"
            f" memory, or left out, not {type(memory).__name__}"
        )
    state, acceleration, force, torque = fitting(
        bodies, state, acceleration, force, torque
    )
    if rules.sleep_speed > 0:
        return _step_with_sleepers(
            bodies, state, acceleration, dt, rules, memory, force, torque
        )

    # Forces: they change velocities at once. The gyroscopic term, by which a
    # free body changes its spin without a torque, acts at the end, in
    # `moved_on`.
    inverse_inertia = world_inverse_inertia(bodies.moments, state.orientation)
    inverse_mass = bodies.inverse_mass[:, None]
    weight = np.where(inverse_mass > 0, acceleration, 0.0)
    linear = weight + inverse_mass * force
    angular = np.matvec(inverse_inertia, torque)
    if rules.response == "in time order":
        return _step_to_each_impact(bodies, state, linear, angular, dt, rules)
    velocity = state.velocity + dt * linear
    spin = state.angular_velocity + dt * angular

    # Contacts: each has a row for its normal and two for friction. In rows
    # that are decoupled, friction leaves the normal speed alone, and so it can
    # leave the least energy that an impact may leave.
    contacts, groups, targets, restitution = answered(
        bodies, state, velocity, spin, dt, rules, memory
    )
    least_energy = rules.law == "dissipative" and rules.response != "penalty"
    while True:
        rows = contact_rows(
            contacts,
            state.position,
            bodies.inverse_mass,
            inverse_inertia,
            decoupled=least_energy,
        )

        # Velocities: impulses change them. Sequential impulses begin with
        # those of the last step.
        before = speeds(rows, state.velocity, state.angular_velocity)
        start = remembered(memory, contacts, rows)
        after_velocity, after_spin, impulse = RESPONSES[rules.response](
            Question(
                contacts,
                rows,
                groups,
                velocity,
                spin,
                before,
                targets,
                restitution,
                start,
                memory.unsettled > 0,
                dt,
                rules,
            )
        )
        driven = driven_together(
            contacts, rows, targets, restitution, impulse, dt, rules
        )
        if not np.any(driven):
            break
        kept = np.flatnonzero(~driven)
        contacts, groups, order = grouped(bodies, contacts, kept)
        targets, restitution = targets.rows(order), restitution[order]
    velocity, spin = after_velocity, after_spin

    # Positions: bodies move with the new velocities, and beside them out of
    # overlaps.
    push = np.zeros((len(velocity), 6))
    if rules.response != "penalty":
        push = pushed_apart(
            rows, groups, contacts.separation, velocity, spin, dt, rules
        )
    after = moved_on(bodies, state, velocity, spin, push, dt)
    left = Memory(
        contacts.key,
        np.vecmat(impulse, rows.direction),
        unsettled=max(memory.unsettled - 1, 0),
    )
    return after, left, contacts


def _step_to_each_impact(
    bodies: Bodies,
    state: State,
    acceleration: Array,
    angular_acceleration: Array,
    dt: float,
    rules: Rules,
) -> tuple[State, Memory, Contacts]:
    """One step with each impact at its instant; it leaves no impulses."""
    after, _ = step_in_time_order(
        bodies, state, acceleration, angular_acceleration, dt, rules
    )
    contacts = find_contacts(bodies, after, rules.margin)
    every = np.arange(len(contacts.key))
    contacts, groups, _ = grouped(bodies, contacts, every)
    inverse_inertia = world_inverse_inertia(bodies.moments, after.orientation)
    rows = contact_rows(
        contacts, after.position, bodies.inverse_mass, inverse_inertia
    )
    motion = after.velocity, after.angular_velocity
    push = pushed_apart(rows, groups, contacts.separation, *motion, 0.0, rules)
    after = moved_on(bodies, after, *motion, push, 0.0)
    return after, NOTHING, contacts


def _step_with_sleepers(
    bodies: Bodies,
    state: State,
    acceleration: ArrayLike,
    dt: float,
    rules: Rules,
    memory: Memory,
    force: ArrayLike,
    torque: ArrayLike,
) -> tuple[State, Memory, Contacts]:
    """One step without the bodies that sleep, unless one of them is struck.

    A struck sleeper wakes with all that lie against it, and the step is taken
    again: what it receives, it has to pass on.
    """
    awake_rules = rules._replace(sleep_speed=0.0)
    fast = is_awake(bodies, state, rules)
    still = of_shape("memory.still", memory.still, fast.shape)
    still[fast] = 0.0
    while True:
        asleep = still >= rules.sleep_after
        lying = with_sleepers(bodies, state, asleep)
        after, left, contacts = advance_world(
            *lying, acceleration, dt, awake_rules, memory, force, torque
        )
        woken = with_neighbours(fast, contacts) & asleep
        if not np.any(woken):
            break
        fast = fast | woken
        still = np.where(woken, 0.0, still)
    restless = with_neighbours(is_fast(bodies, after, rules), contacts)
    left = left._replace(still=np.where(restless, 0.0, still + dt))
    return after, left, contacts
