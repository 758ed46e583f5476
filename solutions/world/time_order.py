"""Impacts in time order: the world is backed up to each (slides 3 and 21)."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.friction import (
    dissipative_impulse,
    friction_impulse,
    point_inverse_mass,
    poisson_impulse,
    stronge_impulse,
)
from solutions.impulse import (
    Body,
    apply_impulse,
    collide,
    point_velocity,
    relative_velocity,
    world_inverse_inertia,
)
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, collect_contacts
from solutions.world.pieces import bounding_boxes, place_pieces
from solutions.world.rotation import rotate_by_momentum
from solutions.world.rows import Rows, contact_rows, speeds
from solutions.world.rules import Rules
from solutions.world.sequential import Wanted, in_groups, solve_sequentially

TOUCH = 1e-10
"""A gap up to which two surfaces touch, m; far above rounding."""
TURN = 0.25
"""The largest angle of one flight, rad; a longer turn could hide a contact."""
HALVINGS = 40
"""How often a flight that ends in an overlap is halved; 10 ms become 10 fs."""

IMPULSES: dict[str, Callable[..., Array]] = {
    "dissipative": dissipative_impulse,
    "newton": friction_impulse,
    "poisson": poisson_impulse,
    "stronge": stronge_impulse,
}
"""The impulse of one impact with friction, under the name of its law."""


class Flight(NamedTuple):
    """How the bodies move until the next impact.

    Attributes
    ----------
    velocity, angular_velocity : (n, 3), at the beginning, m/s and rad/s
    acceleration, angular_acceleration : (n, 3), constant, m/s² and rad/s²
    """

    velocity: Array
    angular_velocity: Array
    acceleration: Array
    angular_acceleration: Array


def step_in_time_order(
    bodies: Bodies, state: State, acceleration: Array, angular_acceleration: Array, dt: float, rules: Rules
) -> tuple[State, int]:
    """One step in which the impacts happen one after another, each at its instant.

    Parameters
    ----------
    bodies, state : the world
    acceleration, angular_acceleration : (n, 3), of all forces but those of the contacts
    dt : s
    rules : how the world responds

    Returns
    -------
    state : at the end of the step
    impacts : how many there were

    Notes
    -----
    Every group of bodies has a clock of its own. In each round it does one of two
    things.

    1. **Impact.** Where two surfaces touch and approach by more than `rest_speed`, the
       first such contact, in the order of the contacts, gets its impulse, alone, as if
       no other touched. So a cradle passes the impulse on from ball to ball. The others
       have their turn in the next rounds, if they still approach.
    2. **Flight.** Otherwise the bodies fly until the next impact. Slide 21's resting
       contacts are slower, and their gap is at most `margin`. They lose their approach
       without rebound, and constant forces, those of sequential impulses, hold them to
       the end of the step. All others are watched. The gap of a contact is
       s + u t + a t²/2, as long as its normal stays what it is, and the flight lasts to
       the first of all roots. For a ball over a plane this is the instant of the
       impact. Two balls come no nearer than by this formula, so that the flight ends
       before their impact, and the rounds close in on it as Newton's method does. Where
       turning bodies overlap at the end of the flight, it is halved until they do not:
       the world is backed up.

    The bodies fly on parabolas, without error. So the result depends on the timestep
    only through contacts that rest and through bodies that turn.

    **Zeno.** The impacts of a step may have no end, as when balls come to rest upon
    each other. After `looks` rounds the rest of the step is answered after the fact.
    All surfaces that touch lose their approach without rebound, together, and the
    bodies fly to the end of the step without another look. The world then goes on, and
    the overlaps are pushed apart. An error instead would end every run in which a pile
    comes to rest.
    """
    _, clock = np.unique(bodies.group, return_inverse=True)
    left, impacts = np.full(np.max(clock, initial=-1) + 1, dt), 0
    for look in range(rules.looks + 1):
        if not np.any(left > 0):
            break
        near = collect_contacts(bodies, state, _reach(bodies, state, acceleration, left[clock]))
        rows = contact_rows(near, state.position, bodies.inverse_mass, _inverse_inertia(bodies, state))
        apart = speeds(rows, state.velocity, state.angular_velocity)[:, 0]
        touching, of = near.separation <= TOUCH, clock[near.body_a]
        open_ended = look == rules.looks
        slow = (near.separation <= rules.margin) & (np.abs(apart) <= rules.rest_speed)
        resting = slow | touching & open_ended
        striking = np.flatnonzero(touching & (apart < -rules.rest_speed) & ~resting & (left[of] > 0))
        first = striking[np.unique(of[striking], return_index=True)[1]]
        impacts += len(first)
        time = np.where(np.isin(np.arange(len(left)), of[first]), 0.0, left)
        kept = np.flatnonzero(resting & (time[of] > 0))
        flight = _held(bodies, state, near, rows, kept, acceleration, angular_acceleration, left[clock], rules)
        if not open_ended:
            watched = np.flatnonzero(~resting & (time[of] > 0))
            time = _until_next(near, rows, watched, flight, clock, time)
            time = _backed_up(bodies, state, near, resting, flight, clock, time)
        state = _flown(bodies, state, flight, time[clock])
        state = _struck(bodies, state, near, first, rules.law)
        left = left - time
    return state, impacts


def _reach(bodies: Bodies, state: State, acceleration: Array, left: Array) -> float:
    """A gap that no two surfaces close in the time that is left, m."""
    pieces = bodies.pieces
    lower, upper = bounding_boxes(pieces, *place_pieces(pieces, state.position, state.orientation))
    centre = state.position[pieces.body]
    size = np.linalg.norm(np.maximum(np.abs(lower - centre), np.abs(upper - centre)), axis=-1)
    angle = np.minimum(np.linalg.norm(state.angular_velocity, axis=-1) * left, TURN)
    path = np.linalg.norm(state.velocity, axis=-1) * left + np.linalg.norm(acceleration, axis=-1) * left**2 / 2
    arc = angle[pieces.body] * np.where(np.isfinite(size), size, 0.0)
    return float(2 * np.max(path[pieces.body] + arc, initial=0.0)) + TOUCH


def _held(
    bodies: Bodies,
    state: State,
    near: Contacts,
    rows: Rows,
    kept: Integers,
    acceleration: Array,
    angular_acceleration: Array,
    left: Array,
    rules: Rules,
) -> Flight:
    """How the bodies move if these contacts close no more than their gaps."""
    order, groups = in_groups(rows.body_a[kept], rows.body_b[kept], bodies.inverse_mass > 0)
    kept = kept[order]
    some = Rows._make(each[kept] for each in rows)
    of_a, of_b, none = bodies.material[some.body_a], bodies.material[some.body_b], np.zeros(len(kept))
    static, kinetic = bodies.surfaces.static_friction[of_a, of_b], bodies.surfaces.kinetic_friction[of_a, of_b]
    seconds = np.where(left > 0, left, 1.0)[:, None]
    closing = np.maximum(near.separation[kept], 0.0) / seconds[some.body_a, 0]
    wanted = Wanted(-closing, none, static, kinetic, none > 0)

    def held(velocity: Array, spin: Array) -> tuple[Array, Array]:
        return solve_sequentially(some, groups, velocity, spin, wanted, 0.0, rules.sweeps, rules.tolerance)[:2]

    velocity, spin = held(state.velocity, state.angular_velocity)
    fast, turning = velocity + seconds * acceleration, spin + seconds * angular_acceleration
    fast_held, turning_held = held(fast, turning)
    # The difference is exactly 0 for a body that nothing touches.
    return Flight(
        velocity,
        spin,
        acceleration + (fast_held - fast) / seconds,
        angular_acceleration + (turning_held - turning) / seconds,
    )


def _until_next(near: Contacts, rows: Rows, watched: Integers, flight: Flight, clock: Integers, time: Array) -> Array:
    """How long each group flies: until a gap closes or a body has turned far, s."""
    a, b = near.body_a[watched], near.body_b[watched]
    gap = np.maximum(near.separation[watched], 0.0)
    apart = speeds(rows, flight.velocity, flight.angular_velocity)[watched, 0]
    bend = np.vecdot(near.normal[watched], flight.acceleration[a] - flight.acceleration[b])
    inside = apart**2 - 2 * bend * gap
    root = np.sqrt(np.maximum(inside, 0.0))
    # Of the two forms of the root, the one in which nothing cancels.
    over, under = np.where(apart > 0, apart + root, 2 * gap), np.where(apart > 0, -bend, root - apart)
    closes = (inside >= 0) & (under > 0)
    until = np.where(closes, over / np.where(closes, under, 1.0), np.inf)
    spin = np.linalg.norm(flight.angular_velocity, axis=-1)
    first = time.copy()
    np.minimum.at(first, clock[a], until)
    np.minimum.at(first, clock, np.where(spin > 0, TURN / np.where(spin > 0, spin, 1.0), np.inf))
    return first


def _backed_up(
    bodies: Bodies,
    state: State,
    near: Contacts,
    resting: Booleans,
    flight: Flight,
    clock: Integers,
    time: Array,
) -> Array:
    """The same times; for a flight that ends in an overlap, when that begins, s."""
    order = np.argsort(near.key)
    allowed = (np.where(resting, -np.inf, np.minimum(near.separation, 0.0)) - TOUCH)[order]

    def overlaps(time: Array) -> Booleans:
        there = collect_contacts(bodies, _flown(bodies, state, flight, time[clock]))
        found = np.zeros(len(time), dtype=bool)
        limit = np.full(len(there.key), -TOUCH)
        if len(order):
            place = np.minimum(np.searchsorted(near.key[order], there.key), len(order) - 1)
            limit = np.where(near.key[order][place] == there.key, allowed[place], limit)
        found[clock[there.body_a[there.separation < limit]]] = True
        return found

    late = overlaps(time)
    if not np.any(late):
        return time
    before, after = np.zeros_like(time), time
    for _ in range(HALVINGS):
        middle = np.where(late, (before + after) / 2, time)
        deep = overlaps(middle)
        before, after = np.where(deep, before, middle), np.where(deep, middle, after)
    return np.where(late, after, time)


def _flown(bodies: Bodies, state: State, flight: Flight, time: Array) -> State:
    """The world after a flight; the time (n,) of each body, s."""
    seconds = time[:, None]
    half = seconds / 2 * flight.angular_acceleration
    # A free rotation by ω over a time t is the same as one by t ω over 1 s.
    orientation, angle = rotate_by_momentum(
        state.orientation, seconds * (flight.angular_velocity + half), bodies.moments, 1.0
    )
    flies = seconds > 0
    spin = np.where(flies, angle / np.where(flies, seconds, 1.0) + half, flight.angular_velocity)
    middle = flight.velocity + seconds / 2 * flight.acceleration
    velocity = flight.velocity + seconds * flight.acceleration
    return State(state.position + seconds * middle, orientation, velocity, spin)


def _struck(bodies: Bodies, state: State, near: Contacts, first: Integers, law: str) -> State:
    """The world after an impact at each of these contacts; no two share a body."""
    if not len(first):
        return state
    a, b, normal = near.body_a[first], near.body_b[first], near.normal[first]
    inverse_inertia = _inverse_inertia(bodies, state)
    body_a, body_b = (
        Body(
            state.velocity[each],
            state.angular_velocity[each],
            near.point[first] - state.position[each],
            bodies.inverse_mass[each],
            inverse_inertia[each],
        )
        for each in (a, b)
    )
    of_a, of_b = bodies.material[a], bodies.material[b]
    restitution, friction = bodies.surfaces.restitution[of_a, of_b], bodies.surfaces.kinetic_friction[of_a, of_b]
    if not np.any(friction):
        after = collide(body_a, body_b, normal, restitution)
    else:
        u = relative_velocity(point_velocity(*body_a[:3]), point_velocity(*body_b[:3]))
        k_a, k_b = (point_inverse_mass(each[3], each[4], each[2]) for each in (body_a, body_b))
        after = apply_impulse(body_a, body_b, IMPULSES[law](u, normal, k_a + k_b, restitution, friction))
    velocity, spin = state.velocity.copy(), state.angular_velocity.copy()
    velocity[a], spin[a], velocity[b], spin[b] = after
    return state._replace(velocity=velocity, angular_velocity=spin)


def _inverse_inertia(bodies: Bodies, state: State) -> Array:
    return world_inverse_inertia(bodies.moments, state.orientation)
