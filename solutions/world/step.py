"""One step of the world: forces, contacts, velocities, positions (slides 3 to 29)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.impulse import world_inverse_inertia
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, collect_contacts
from solutions.world.pieces import tangents
from solutions.world.responses import RESPONSES, Question
from solutions.world.rotation import rotate_by_momentum, turned
from solutions.world.rows import Rows, contact_rows, speeds
from solutions.world.rules import Rules, known
from solutions.world.sequential import Wanted, colours, solve_sequentially
from solutions.world.time_order import step_in_time_order


class Memory(NamedTuple):
    """What a step leaves to the next one: the impulse of each contact, to begin with.

    Attributes
    ----------
    key : (m,), of the contacts, ascending
    impulse : (m, 3), on A, in the world frame, N s
    """

    key: Integers
    impulse: Array


NOTHING = Memory(np.zeros(0, dtype=np.int64), np.zeros((0, 3)))


def step_world(
    bodies: Bodies,
    state: State,
    acceleration: ArrayLike,
    dt: float,
    rules: Rules = Rules(),  # noqa: B008  (an immutable tuple)
    memory: Memory = NOTHING,
    force: ArrayLike = 0.0,
    torque: ArrayLike = 0.0,
) -> tuple[State, Memory, Contacts]:
    """One step of length dt: forces, contacts, velocities, positions.

    Parameters
    ----------
    bodies, state : the world
    acceleration : (3,) or (n, 3), g, of all bodies that can be moved, m/s²
    dt : s
    rules : how it responds
    memory : what the last step left
    force, torque : (n, 3), all others on each body, N and N m

    Returns
    -------
    state, memory : for the next step
    contacts : those that this step has answered
        Of a step in time order, those at its end.

    Raises
    ------
    ValueError
        If there is no such response, or it does not know the law.
    """
    known(rules)

    # Forces
    inverse_inertia = world_inverse_inertia(bodies.moments, state.orientation)
    pull = np.where(bodies.inverse_mass[:, None] > 0, acceleration, 0.0)
    gain = pull + bodies.inverse_mass[:, None] * np.asarray(force, dtype=float)
    turn = np.matvec(inverse_inertia, np.broadcast_to(torque, gain.shape))
    if rules.response == "in time order":
        return _step_in_time_order(bodies, state, gain, turn, dt, rules)
    velocity, spin = state.velocity + dt * gain, state.angular_velocity + dt * turn

    # Contacts
    contacts = collect_contacts(bodies, state, rules.margin)
    least_energy = rules.law == "dissipative" and rules.response != "penalty"
    rows = contact_rows(contacts, state.position, bodies.inverse_mass, inverse_inertia, decoupled=least_energy)
    groups = colours(contacts.body_a, contacts.body_b, bodies.inverse_mass > 0)

    # Velocities
    before = speeds(rows, state.velocity, state.angular_velocity)
    wanted, restitution = _wanted(bodies, contacts, -before[:, 0], dt, rules)
    start = _remembered(contacts, rows, memory)
    velocity, spin, impulse = RESPONSES[rules.response](
        Question(contacts, rows, groups, velocity, spin, before, wanted, restitution, start, dt, rules)
    )

    # Positions
    push = np.zeros((len(velocity), 6))
    if rules.response != "penalty":
        push = _push_apart(rows, groups, contacts, velocity, spin, dt, rules)
    position = state.position + dt * velocity + push[:, :3]
    orientation, spin = rotate_by_momentum(state.orientation, spin, bodies.moments, dt)
    orientation = turned(orientation, push[:, 3:])
    after = State(position, orientation, velocity, spin)
    return after, Memory(contacts.key, np.vecmat(impulse, rows.direction)), contacts


def _step_in_time_order(
    bodies: Bodies, state: State, acceleration: Array, angular_acceleration: Array, dt: float, rules: Rules
) -> tuple[State, Memory, Contacts]:
    """One step with each impact at its instant; it leaves no impulses to begin with."""
    after, _ = step_in_time_order(bodies, state, acceleration, angular_acceleration, dt, rules)
    contacts = collect_contacts(bodies, after, rules.margin)
    inverse_inertia = world_inverse_inertia(bodies.moments, after.orientation)
    rows = contact_rows(contacts, after.position, bodies.inverse_mass, inverse_inertia)
    groups = colours(contacts.body_a, contacts.body_b, bodies.inverse_mass > 0)
    push = _push_apart(rows, groups, contacts, after.velocity, after.angular_velocity, 0.0, rules)
    position, orientation = after.position + push[:, :3], turned(after.orientation, push[:, 3:])
    return after._replace(position=position, orientation=orientation), NOTHING, contacts


def _wanted(bodies: Bodies, contacts: Contacts, approach: Array, dt: float, rules: Rules) -> tuple[Wanted, Array]:
    """What the impulses have to reach, a rebound or no more than the gap; and e.

    Newton's law of restitution looks at the speed before the step. What gravity adds in
    the step is no part of the approach, and the contact carries it.
    """
    surfaces, of_a, of_b = bodies.surfaces, bodies.material[contacts.body_a], bodies.material[contacts.body_b]
    restitution = surfaces.restitution[of_a, of_b]
    rebound = np.where(approach > rules.rest_speed, restitution * approach, 0.0)
    wanted = Wanted(
        np.where(rebound > 0, rebound, -np.maximum(contacts.separation, 0.0) / dt),
        np.zeros(len(rebound)),
        surfaces.static_friction[of_a, of_b],
        surfaces.kinetic_friction[of_a, of_b],
        rebound > 0,
    )
    return wanted, restitution


def _remembered(contacts: Contacts, rows: Rows, memory: Memory) -> Array:
    """Impulses (m, 3) to begin with: those of the last step where the same features touch, N s."""
    if not len(memory.key):
        return np.zeros((len(contacts.key), 3))
    order = np.argsort(memory.key, kind="stable")
    place = order[np.minimum(np.searchsorted(memory.key, contacts.key, sorter=order), len(order) - 1)]
    had = np.where((memory.key[place] == contacts.key)[:, None], memory.impulse[place], 0.0)
    # Along t − a n friction takes a·λ_t from the normal impulse, so that λ_n is more than it.
    friction = np.stack([np.vecdot(had, tangent) for tangent in tangents(contacts.normal)], axis=-1)
    normal = np.vecdot(had, contacts.normal) + np.vecdot(rows.coupling, friction)
    return np.concatenate([normal[:, None], friction], axis=-1)


def _push_apart(
    rows: Rows, groups: list[Integers], contacts: Contacts, velocity: Array, spin: Array, dt: float, rules: Rules
) -> Array:
    """How far (n, 6) each body is moved and turned to take back a share of the overlaps, m and rad.

    It is a motion beside the velocities, and so it adds no kinetic energy.
    """
    ahead = contacts.separation + dt * speeds(rows, velocity, spin)[:, 0]
    deep = np.minimum(ahead, 0.0)
    nothing = np.zeros_like(velocity)
    if not np.any(deep < 0):
        return np.zeros((len(velocity), 6))
    none = np.zeros(len(deep))
    # Where a gap is left, the push may close it, and no more.
    wanted = Wanted(np.where(deep < 0, -rules.recovery * deep, -ahead), none, none, none, none > 0)
    moved, turn, _ = solve_sequentially(rows, groups, nothing, nothing, wanted, 0.0, rules.push_sweeps, rules.tolerance)
    return np.concatenate([moved, turn], axis=-1)
