"""What contacts do to velocities: impacts, then rest (slides 21 and 22)."""

from __future__ import annotations

import warnings

import numpy as np

from solutions.arrays import Array, Integers
from solutions.friction import dissipative_impulse, point_inverse_mass
from solutions.impulse import Body, point_velocity, relative_velocity
from solutions.world.complementarity import NotConverged, solve_by_sweeps
from solutions.world.resting import (
    contact_jacobian,
    inverse_mass_matrix,
    resting_problem,
    sequential_impulses,
)
from solutions.world.simple_contacts import (
    SimpleBodies,
    SimpleContacts,
    SimpleState,
)
from solutions.world.simple_turning import inverse_inertias
from solutions.world.vectors import tangents

ROUNDS = 100
"""How often the impacts of a step may have a turn.

With e < 1 they may have no end.
"""
SLOP, RECOVERY, PUSHES = 1e-6, 0.2, 20
"""How overlaps are moved away.

The depth that is left alone, m; the share of the rest that a step takes; its
sweeps.
"""


def contact_frames(contacts: SimpleContacts, position: Array) -> Array:
    """Rows of the normal and of two tangents for each contact, (m, 3, 6 n)."""
    a, b, point, normal, *_ = contacts
    if not len(a):
        return np.zeros((0, 3, 6 * len(position)))
    arms = point - position[a], point - position[b]
    rows = [
        contact_jacobian(a, b, direction, *arms, len(position))
        for direction in (normal, *tangents(normal))
    ]
    return np.stack(rows, axis=1)


def contacts_by_pair(contacts: SimpleContacts) -> list[Integers]:
    """The numbers of the contacts of each two bodies in touch, in order."""
    pairs = np.stack(contacts[:2], axis=-1)
    starts = np.flatnonzero(np.any(pairs[1:] != pairs[:-1], axis=-1)) + 1
    groups = np.split(np.arange(len(pairs)), starts)
    return [group for group in groups if len(group)]


def collide_with_friction(
    body_a: Body,
    body_b: Body,
    normal: Array,
    restitution: float,
    friction: float,
) -> tuple[Array, Array, Array, Array]:
    """Velocities v_A, ω_A, v_B, ω_B after an impact, also with friction.

    Parameters
    ----------
    body_a, body_b : a `Body` each, at the instant of the impact
    normal : (3,), unit, from B to A
    restitution : e, 0 to 1
    friction : μ, a number
    """
    u_a, u_b = (point_velocity(*body[:3]) for body in (body_a, body_b))
    u = relative_velocity(u_a, u_b)
    k_a, k_b = (
        point_inverse_mass(inverse_mass, inverse_inertia, arm)
        for _, _, arm, inverse_mass, inverse_inertia in (body_a, body_b)
    )
    impulse = dissipative_impulse(u, normal, k_a + k_b, restitution, friction)
    return (*_pushed(body_a, impulse), *_pushed(body_b, -impulse))


def _pushed(body: Body, impulse: Array) -> tuple[Array, Array]:
    """Velocity and spin of a body after an impulse at its contact."""
    v, w, arm, inverse_mass, inverse_inertia = map(np.asarray, body)
    turned = np.matvec(inverse_inertia, np.cross(arm, impulse))
    return v + inverse_mass * impulse, w + turned


def kept_impulses(
    memory: tuple[Integers, Array] | None, contacts: SimpleContacts
) -> Array:
    """Impulses (m, 3) of the last step where a place still touches, N s."""
    *_, key = contacts
    kept = np.zeros((len(key), 3))
    if memory is not None:
        old_key, old_impulse = memory
        _, here, there = np.intersect1d(key, old_key, return_indices=True)
        kept[here] = old_impulse[there]
    return kept


def out_of_overlap(
    bodies: SimpleBodies,
    state: SimpleState,
    contacts: SimpleContacts,
    dt: float,
) -> Array:
    """How far each body moves and turns out of overlaps, (n, 6), m and rad.

    A share of what will overlap at the end of the step is moved away. No
    velocity changes, so that no kinetic energy is gained.
    """
    inverse_mass, moments, *_ = bodies
    position, orientation, velocity, spin = state
    rows = contact_frames(contacts, position)
    motion = np.concatenate([velocity, spin], axis=-1).ravel()
    ahead = contacts[4] + dt * (rows[:, 0] @ motion) + SLOP
    if not np.any(ahead < 0):
        return np.zeros((len(position), 6))
    inverse_inertia = inverse_inertias(moments, orientation)
    share = inverse_mass_matrix(inverse_mass, inverse_inertia)
    least = np.where(ahead < 0, -RECOVERY * ahead, -ahead)
    push, _ = sequential_impulses(
        np.zeros_like(motion), rows, share, 0.0, PUSHES, least=least
    )
    return push.reshape(-1, 6)


def respond(
    bodies: SimpleBodies,
    state: SimpleState,
    contacts: SimpleContacts,
    load: Array,
    dt: float,
    rest_speed: float,
    sweeps: int,
    start: Array,
) -> tuple[Array, Array, Array]:
    """Velocities at the end of a step, after its forces and contacts.

    Parameters
    ----------
    bodies : inverse_mass, moments, restitution, friction, meet, kind, size
    state : position, orientation, velocity, angular_velocity
        Where the step begins.
    contacts : body_a, body_b, point, normal, separation, key, with m contacts
        Those of two bodies follow one another.
    load : (n, 6), force and torque on each body, N and N m
        Its weight is included.
    dt : s
    rest_speed : m/s
        A contact whose points close no faster than this rests (slide 21).
        So does one whose gap would still be open after dt at this speed.
    sweeps : how often to go through the contacts
        In `solve_by_sweeps`, and in `sequential_impulses` as well.
    start : (m, 3), impulses to begin with, N s
        Along the normal and the two directions of `contact_frames`.

    Returns
    -------
    velocity, angular_velocity : (n, 3) each, m/s and rad/s
    impulse : (m, 3), of all that rests or is carried, N s
        Along the same directions as start; without those of the impacts.

    Notes
    -----
    **Impacts.** They come first, with the velocities as they are, because an
    impact is too short for a load to matter. Slide 21 decides about each
    contact: it collides if it closes faster than rest_speed, and fast enough
    to touch within the step. Two bodies that collide at several places get one
    impulse, in the middle of these places. The pairs have their turns one
    after another, and again, as in `propagate_impacts`, until none of them
    collides or `ROUNDS` are over.

    **Rest.** The load would change the speeds of the contacts to

        G (v + M⁻¹ F dt)

    Two bodies that have just collided are carried in this step, at all of
    their contacts. The points of each part as fast as after the impacts, and
    where they still close, the least speed is 0. All other contacts may close
    their gap and no more. So each contact has a least speed, and with A and b
    of `resting_problem` the impulses solve the problem of A and

        G v + b dt − least

    Where there is friction, `sequential_impulses` continues from these
    impulses, with as many sweeps and the same least speeds.
    """
    inverse_mass, moments, restitution, friction, *_ = bodies
    position, orientation, velocity, spin = state
    a, b, point, normal, separation, _ = contacts
    inverse_inertia = inverse_inertias(moments, orientation)
    motion = np.concatenate([velocity, spin], axis=-1)
    rows = contact_frames(contacts, position)

    def body(number: int, place: Array) -> Body:
        arm = place - position[number]
        return Body(
            motion[number, :3],
            motion[number, 3:],
            arm,
            inverse_mass[number],
            inverse_inertia[number],
        )

    within_step = -np.maximum(separation, 0.0) / dt
    fast = np.minimum(-rest_speed, within_step)
    collided = np.zeros(len(a), dtype=bool)
    for _ in range(ROUNDS):
        quiet = True
        for pair in contacts_by_pair(contacts):
            closing = pair[rows[pair, 0] @ motion.ravel() < fast[pair]]
            if len(closing):
                i, j, n = a[pair[0]], b[pair[0]], normal[pair[0]]
                place = np.mean(point[closing], axis=0)
                v_a, w_a, v_b, w_b = collide_with_friction(
                    body(i, place),
                    body(j, place),
                    n,
                    restitution[i, j],
                    friction[i, j],
                )
                motion[i] = np.concatenate([v_a, w_a])
                motion[j] = np.concatenate([v_b, w_b])
                collided[pair] = True
                quiet = False
        if quiet:
            break

    share = inverse_mass_matrix(inverse_mass, inverse_inertia)
    normals = rows[:, 0]
    matrix, gained = resting_problem(normals, share, load.ravel())
    parting = normals @ motion.ravel()
    least = np.where(collided, np.maximum(parting, 0.0), within_step)
    with warnings.catch_warnings():
        # The next step continues from the impulses that these sweeps leave.
        warnings.simplefilter("ignore", NotConverged)
        pressed = solve_by_sweeps(
            matrix, parting + dt * gained - least, sweeps, start[:, 0]
        )
    loaded = motion.ravel() + dt * share @ load.ravel()
    ended = loaded + share @ normals.T @ pressed
    impulse = pressed[:, None] * np.array([1.0, 0.0, 0.0])
    if np.any(friction[a, b]):
        begin = np.concatenate([pressed[:, None], start[:, 1:]], axis=-1)
        ended, impulse = sequential_impulses(
            loaded, rows, share, friction[a, b], sweeps, begin, least
        )
    velocity, spin = np.split(ended.reshape(-1, 6), 2, axis=-1)
    return velocity, spin, impulse
