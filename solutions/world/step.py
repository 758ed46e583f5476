"""One step of the world: forces, contacts, velocities, positions (slides 3 to 29)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array, Integers
from solutions.impulse import world_inverse_inertia
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, collect_contacts
from solutions.world.rotation import rotate_by_momentum, turned
from solutions.world.rows import Rows, contact_rows, speeds
from solutions.world.sequential import Wanted, in_groups, solve_sequentially
from solutions.world.vectors import tangents


class Rules(NamedTuple):
    """How a world responds to its contacts.

    Attributes
    ----------
    rest_speed : m/s
        A slower approach is answered without rebound. Two steps' gain of weight is a
        good choice, 2 g Δt: what is slower has fallen for two steps at most.
    margin : m
        A gap up to which a contact is kept, so that resting bodies keep theirs.
    with_weight : whether the speed that is turned back includes the gain of this step
        Newton's law speaks of the speed of approach. At a step one may take it before
        the forces of the step act, or after; engines of both kinds exist.
    slop : m
        An overlap that is left alone, so that resting bodies are not moved about.
    recovery : share of a deeper overlap that each step moves away, 0 to 1
    sweeps : how often all contacts take their turn in a step, at most
    tolerance : share of the largest impulse; smaller changes end the sweeps
    push_sweeps : how often they do so to move overlaps away
    """

    rest_speed: float = 0.1
    margin: float = 1e-3
    with_weight: bool = False
    slop: float = 1e-4
    recovery: float = 0.2
    sweeps: int = 50
    tolerance: float = 1e-6
    push_sweeps: int = 10


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
    rules: Rules | tuple[float, ...] = Rules(),  # noqa: B008  (an immutable tuple)
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
    """
    rules = Rules(*rules)

    # Forces
    inverse_inertia = world_inverse_inertia(bodies.moments, state.orientation)
    pull = np.where(bodies.inverse_mass[:, None] > 0, acceleration, 0.0)
    velocity = state.velocity + dt * (pull + bodies.inverse_mass[:, None] * np.asarray(force))
    spin = state.angular_velocity + dt * np.matvec(inverse_inertia, np.broadcast_to(torque, velocity.shape))

    # Contacts
    contacts = collect_contacts(bodies, state, rules.margin)
    order, groups = in_groups(contacts.body_a, contacts.body_b, bodies.inverse_mass > 0)
    contacts = contacts.in_order(order)
    rows = contact_rows(contacts, state.position, bodies.inverse_mass, inverse_inertia)

    # Velocities
    approaching = (velocity, spin) if rules.with_weight else (state.velocity, state.angular_velocity)
    wanted = _wanted(bodies, contacts, -speeds(rows, *approaching)[:, 0], dt, rules)
    start = _remembered(contacts, rows, memory)
    velocity, spin, impulse = solve_sequentially(
        rows, groups, velocity, spin, wanted, start, rules.sweeps, rules.tolerance
    )

    # Positions
    push = _push_apart(rows, groups, contacts, velocity, spin, dt, rules)
    position = state.position + dt * velocity + push[:, :3]
    orientation, spin = rotate_by_momentum(state.orientation, spin, bodies.moments, dt)
    orientation = turned(orientation, push[:, 3:])
    after = State(position, orientation, velocity, spin)
    return after, Memory(contacts.key, np.vecmat(impulse, rows.direction)), contacts


def _wanted(bodies: Bodies, contacts: Contacts, approach: Array, dt: float, rules: Rules) -> Wanted:
    """What the impulses have to reach: a rebound, or to come no nearer than the gap."""
    surfaces, of_a, of_b = bodies.surfaces, bodies.material[contacts.body_a], bodies.material[contacts.body_b]
    rebound = np.where(approach > rules.rest_speed, surfaces.restitution[of_a, of_b] * approach, 0.0)
    return Wanted(
        np.where(rebound > 0, rebound, -np.maximum(contacts.separation, 0.0) / dt),
        np.zeros(len(rebound)),
        surfaces.static_friction[of_a, of_b],
        surfaces.kinetic_friction[of_a, of_b],
        rebound > 0,
    )


def _remembered(contacts: Contacts, rows: Rows, memory: Memory) -> Array:
    """Impulses (m, 3) to begin with, N s: of the last step, where features stay."""
    if not len(memory.key):
        return np.zeros((len(contacts.key), 3))
    order = np.argsort(memory.key, kind="stable")
    place = order[np.minimum(np.searchsorted(memory.key, contacts.key, sorter=order), len(order) - 1)]
    had = np.where((memory.key[place] == contacts.key)[:, None], memory.impulse[place], 0.0)
    # Along t − a n friction takes a·λ_t from the normal impulse; λ_n is that much more.
    friction = np.stack([np.vecdot(had, tangent) for tangent in tangents(contacts.normal)], axis=-1)
    normal = np.vecdot(had, contacts.normal) + np.vecdot(rows.coupling, friction)
    return np.concatenate([normal[:, None], friction], axis=-1)


def _push_apart(
    rows: Rows, groups: list[slice], contacts: Contacts, velocity: Array, spin: Array, dt: float, rules: Rules
) -> Array:
    """How far each body is moved and turned (n, 6) out of the overlaps, m and rad.

    It takes back a share of each. It is a motion beside the velocities, and so it adds
    no kinetic energy.
    """
    ahead = contacts.separation + dt * speeds(rows, velocity, spin)[:, 0] + rules.slop
    nothing, none = np.zeros_like(velocity), np.zeros(len(ahead))
    if not np.any(ahead < 0):
        return np.zeros((len(velocity), 6))
    # Where a gap is left, the push may close it, and no more.
    wanted = Wanted(np.where(ahead < 0, -rules.recovery * ahead, -ahead), none, none, none, none > 0)
    moved, turn, _ = solve_sequentially(rows, groups, nothing, nothing, wanted, 0.0, rules.push_sweeps, rules.tolerance)
    return np.concatenate([moved, turn], axis=-1)
