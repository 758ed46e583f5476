"""Impacts in time order: the world is backed up to each (slides 3 and 21)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from solutions.arrays import Array, Integers
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
from solutions.world.approach import closing
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.flights import (
    backed_up,
    flown,
    held,
    reach,
    until_next,
)
from solutions.world.rows import contact_rows, speeds
from solutions.world.rules import Rules
from solutions.world.shapes import TOUCH

IMPULSES: dict[str, Callable[..., Array]] = {
    "dissipative": dissipative_impulse,
    "newton": friction_impulse,
    "poisson": poisson_impulse,
    "stronge": stronge_impulse,
}
"""The impulse of one impact with friction, under the name of its law."""


def step_in_time_order(
    bodies: Bodies,
    state: State,
    acceleration: Array,
    angular_acceleration: Array,
    dt: float,
    rules: Rules,
) -> tuple[State, int]:
    """One step in which each impact happens at its instant.

    Parameters
    ----------
    bodies, state : the world
    acceleration, angular_acceleration : (n, 3), m/s² and rad/s²
        Of all forces except those of the contacts.
    dt : s
    rules : how the world responds

    Returns
    -------
    state : at the end of the step
    impacts : how many there were

    Notes
    -----
    Every group of bodies has a clock of its own. In each round it does one of
    two things.

    **Impact.** Where two surfaces touch and approach by more than
    `rest_speed`, the first such contact, in the order of the contacts, gets
    its impulse, alone, as if no other touched. So a cradle passes the impulse
    on from ball to ball. The others have their turn in the next rounds, if
    they still approach.

    **Flight.** Otherwise the bodies fly until the next impact. Slide 21's
    resting contacts are slower, and their gap is at most `margin`. They lose
    their approach without rebound, and constant forces, those of sequential
    impulses, hold them to the end of the step. All others are watched. As long
    as the normal of a contact stays what it is, its gap is

        s + u t + a t²/2

    The flight lasts to the first of all roots. For a ball over a plane this is
    the instant of the impact. Two balls come no nearer than by this formula,
    so that the flight ends before their impact, and the rounds close in on it
    as Newton's method does. Where turning bodies overlap at the end of the
    flight, it is halved until they do not: the world is backed up.

    The bodies fly on parabolas, without error. So the result depends on the
    timestep only through contacts that rest and through bodies that turn.

    **Zeno.** The impacts of a step may have no end, as when balls come to rest
    upon each other. Twenty-five discs with e = ½ that fall into a box at 240
    Hz have more than 4000 impacts in the step at 0.24 s if `rest_speed` is 0.
    With 0.1 m/s they have 59 at most and come to rest within a second, because
    contacts that rest are held by forces. To leave out their rebound is not
    enough: weight drives them together again at once.

    After `looks` rounds the rest of the step is resolved after the fact. All
    surfaces that touch lose their approach without rebound, together, and the
    bodies fly to the end of the step without another look. The world then
    continues, and the overlaps are pushed apart. An error instead would end
    every run in which a pile comes to rest.
    """
    _, clock = np.unique(bodies.group, return_inverse=True)
    left = np.full(np.max(clock, initial=-1) + 1, dt)
    impacts = 0
    for look in range(rules.looks + 1):
        if not np.any(left > 0):
            break
        last = look == rules.looks

        # What is near, and what of it touches, rests or strikes
        gap = reach(bodies, state, acceleration, left[clock])
        near = find_contacts(bodies, state, gap)
        rows = contact_rows(
            near,
            state.position,
            bodies.inverse_mass,
            _inverse_inertia(bodies, state),
        )
        apart = speeds(rows, state.velocity, state.angular_velocity)[:, 0]
        of = clock[near.body_a]
        touching = near.separation <= TOUCH
        slow = near.separation <= rules.margin
        slow &= np.abs(apart) <= rules.rest_speed
        if np.any(slow & ~touching):  # two that pass each other do not rest
            half = left[clock, None] / 2
            velocity = state.velocity + half * acceleration
            spin = state.angular_velocity + half * angular_acceleration
            closes, touches = closing(
                bodies, state, near, velocity, spin, left[of]
            )
            slow &= touches | ~closes
        resting = slow | touching & last
        striking = np.flatnonzero(
            touching & (apart < -rules.rest_speed) & ~resting & (left[of] > 0)
        )

        # Impacts, one in each group
        first = striking[np.unique(of[striking], return_index=True)[1]]
        state = _struck(bodies, state, near, first, rules.law)
        impacts += len(first)

        # Flights of all other groups
        time = left.copy()
        time[of[first]] = 0.0
        flies = time[of] > 0
        kept = np.flatnonzero(resting & flies)
        watched = np.flatnonzero(~resting & flies)
        flight = held(
            bodies,
            state,
            near,
            rows,
            kept,
            acceleration,
            angular_acceleration,
            left[clock],
            rules,
        )
        if not last:
            time = until_next(near, rows, watched, flight, clock, time)
            time = backed_up(bodies, state, near, resting, flight, clock, time)
        state = flown(bodies, state, flight, time[clock])
        left = left - time
    return state, impacts


def _struck(
    bodies: Bodies, state: State, near: Contacts, first: Integers, law: str
) -> State:
    """The world after an impact at each of these contacts.

    No two of them share a body.
    """
    if not len(first):
        return state
    a, b, normal = near.body_a[first], near.body_b[first], near.normal[first]
    inverse_inertia = _inverse_inertia(bodies, state)
    body_a, body_b = (
        Body(
            state.velocity[number],
            state.angular_velocity[number],
            near.point[first] - state.position[number],
            bodies.inverse_mass[number],
            inverse_inertia[number],
        )
        for number in (a, b)
    )
    of_a, of_b = bodies.material[a], bodies.material[b]
    restitution = bodies.surfaces.restitution[of_a, of_b]
    friction = bodies.surfaces.kinetic_friction[of_a, of_b]
    if not np.any(friction):
        after = collide(body_a, body_b, normal, restitution)
    else:
        u_a, u_b = (point_velocity(*body[:3]) for body in (body_a, body_b))
        u = relative_velocity(u_a, u_b)
        k_a, k_b = (
            point_inverse_mass(
                body.inverse_mass, body.inverse_inertia, body.arm
            )
            for body in (body_a, body_b)
        )
        impulse = IMPULSES[law](u, normal, k_a + k_b, restitution, friction)
        after = apply_impulse(body_a, body_b, impulse)
    velocity, spin = state.velocity.copy(), state.angular_velocity.copy()
    velocity[a], spin[a], velocity[b], spin[b] = after
    return state._replace(velocity=velocity, angular_velocity=spin)


def _inverse_inertia(bodies: Bodies, state: State) -> Array:
    return world_inverse_inertia(bodies.moments, state.orientation)
