"""Flights from one impact to the next (slides 3 and 21)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.vectors import quotient
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.pieces import bounding_boxes, place_pieces
from solutions.world.rotation import turn_freely
from solutions.world.rows import Rows, speeds
from solutions.world.rules import Rules
from solutions.world.sequential import Targets, in_groups, solve_sequentially
from solutions.world.shapes import TOUCH

TURN = 0.25
"""The largest angle of one flight, rad; a longer turn could hide a contact."""
FLIGHT_HALVINGS = 40
"""How often a flight that ends in an overlap is halved; 10 ms become 10 fs."""


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


def reach(
    bodies: Bodies, state: State, acceleration: Array, left: Array
) -> float:
    """A gap that no two surfaces close in the time that is left, m.

    Parameters
    ----------
    bodies, state : the world
    acceleration : (n, 3), m/s²
    left : (n,), the time that each body has, s
    """
    pieces = bodies.pieces
    places = place_pieces(pieces, state.position, state.orientation)
    lower, upper = bounding_boxes(pieces, *places)
    centre = state.position[pieces.body]
    farthest = np.maximum(np.abs(lower - centre), np.abs(upper - centre))
    size = np.linalg.norm(farthest, axis=-1)
    spin = np.linalg.norm(state.angular_velocity, axis=-1)
    angle = np.minimum(spin * left, TURN)
    speed = np.linalg.norm(state.velocity, axis=-1)
    gain = np.linalg.norm(acceleration, axis=-1)
    path = speed * left + gain * left**2 / 2
    arc = angle[pieces.body] * np.where(np.isfinite(size), size, 0.0)
    return float(2 * np.max(path[pieces.body] + arc, initial=0.0)) + TOUCH


def held(
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
    """How the bodies move if these contacts close no more than their gaps.

    Parameters
    ----------
    bodies, state : the world
    near, rows : all contacts near enough to matter, and their rows
    kept : (k,), numbers of the contacts that are held
    acceleration, angular_acceleration : (n, 3), m/s² and rad/s²
        Of all forces except those of the contacts.
    left : (n,), the time that each body has, s
    rules : how the world responds
    """
    order, groups = in_groups(
        rows.body_a[kept], rows.body_b[kept], bodies.inverse_mass > 0
    )
    kept = kept[order]
    some = Rows._make(array[kept] for array in rows)
    of_a, of_b = bodies.material[some.body_a], bodies.material[some.body_b]
    seconds = np.where(left > 0, left, 1.0)[:, None]
    closing = np.maximum(near.separation[kept], 0.0) / seconds[some.body_a, 0]
    targets = Targets(
        -closing,
        bodies.surfaces.static_friction[of_a, of_b],
        bodies.surfaces.kinetic_friction[of_a, of_b],
        np.zeros(len(kept), dtype=bool),
    )

    def stopped(velocity: Array, spin: Array) -> tuple[Array, Array]:
        sweeps, least = rules.sweeps, rules.tolerance
        velocity, spin, _ = solve_sequentially(
            some, groups, velocity, spin, targets, 0.0, sweeps, least
        )
        return velocity, spin

    velocity, spin = stopped(state.velocity, state.angular_velocity)
    fast = velocity + seconds * acceleration
    turning = spin + seconds * angular_acceleration
    fast_held, turning_held = stopped(fast, turning)
    # The difference is exactly 0 for a body that nothing touches.
    return Flight(
        velocity,
        spin,
        acceleration + (fast_held - fast) / seconds,
        angular_acceleration + (turning_held - turning) / seconds,
    )


def until_next(
    near: Contacts,
    rows: Rows,
    watched: Integers,
    flight: Flight,
    clock: Integers,
    time: Array,
) -> Array:
    """How long each group flies, until a gap closes or a body turns far, s.

    Parameters
    ----------
    near, rows : all contacts near enough to matter, and their rows
    watched : (k,), numbers of the contacts whose gap may close
    flight : how the bodies move
    clock : (n,), number of each body's group
    time : (g,), the longest time, s

    Notes
    -----
    The gap s closes where s + u t + a t²/2 is 0.
    """
    a, b = near.body_a[watched], near.body_b[watched]
    gap = np.maximum(near.separation[watched], 0.0)
    apart = speeds(rows, flight.velocity, flight.angular_velocity)[watched, 0]
    relative = flight.acceleration[a] - flight.acceleration[b]
    bend = np.vecdot(near.normal[watched], relative)
    inside = apart**2 - 2 * bend * gap
    root = np.sqrt(np.maximum(inside, 0.0))
    # Of the two forms of the root, the one in which nothing cancels.
    over = np.where(apart > 0, apart + root, 2 * gap)
    under = np.where(apart > 0, -bend, root - apart)
    closes = (inside >= 0) & (under > 0)
    until = np.where(closes, over / np.where(closes, under, 1.0), np.inf)
    spin = np.linalg.norm(flight.angular_velocity, axis=-1)
    first = time.copy()
    np.minimum.at(first, clock[a], until)
    np.minimum.at(first, clock, quotient(TURN, spin, np.inf))
    return first


def backed_up(
    bodies: Bodies,
    state: State,
    near: Contacts,
    resting: Booleans,
    flight: Flight,
    clock: Integers,
    time: Array,
) -> Array:
    """The same times, (g,), s; where a flight ends in overlap, when it begins.

    Parameters
    ----------
    bodies, state : the world
    near : all contacts where the flight begins
    resting : (m,), which of them rest, and may overlap
    flight : how the bodies move
    clock : (n,), number of each body's group
    time : (g,), how long each group would fly, s
    """
    order = np.argsort(near.key)
    known = near.key[order]
    now = np.where(resting, -np.inf, np.minimum(near.separation, 0.0))
    allowed = (now - TOUCH)[order]

    def overlaps(time: Array) -> Booleans:
        at_end = flown(bodies, state, flight, time[clock])
        there = find_contacts(bodies, at_end)
        limit = np.full(len(there.key), -TOUCH)
        if len(order):
            place = np.searchsorted(known, there.key)
            place = np.minimum(place, len(order) - 1)
            is_known = known[place] == there.key
            limit = np.where(is_known, allowed[place], limit)
        overlapping = np.zeros(len(time), dtype=bool)
        overlapping[clock[there.body_a[there.separation < limit]]] = True
        return overlapping

    late = overlaps(time)
    if not np.any(late):
        return time
    before, after = np.zeros_like(time), time
    for _ in range(FLIGHT_HALVINGS):
        middle = np.where(late, (before + after) / 2, time)
        deep = overlaps(middle)
        before = np.where(deep, before, middle)
        after = np.where(deep, middle, after)
    return np.where(late, after, time)


def flown(bodies: Bodies, state: State, flight: Flight, time: Array) -> State:
    """The world after a flight; the time (n,) of each body, s."""
    seconds = time[:, None]
    half = seconds / 2 * flight.angular_acceleration
    orientation, spin = turn_freely(
        state.orientation, flight.angular_velocity + half, bodies.moments, time
    )
    spin = np.where(seconds > 0, spin + half, flight.angular_velocity)
    middle = flight.velocity + seconds / 2 * flight.acceleration
    velocity = flight.velocity + seconds * flight.acceleration
    position = state.position + seconds * middle
    return State(position, orientation, velocity, spin)
