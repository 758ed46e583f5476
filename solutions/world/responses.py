"""The responses of a step, each under its name."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from solutions.arrays import Array
from solutions.world.contacts import Contacts
from solutions.world.penalty import solve_with_springs
from solutions.world.rows import Rows
from solutions.world.rules import Rules
from solutions.world.sequential import Wanted, solve_sequentially
from solutions.world.simultaneous import solve_simultaneously

Answer = tuple[Array, Array, Array]
"""Velocities and spins (n, 3) of the bodies, impulses (m, 3) of the contacts."""
UNSETTLED_SHARE, UNSETTLED_SWEEPS, UNSETTLED_TOLERANCE = 10, 500, 0.1
"""How many sweeps may follow on the usual ones in the first steps of a run.

It is so many times the usual sweeps, but no more than so many. They end at a tolerance
that is so many times that of the rules. A tower of 8 boxes takes some 200 of them in
its first step, and one of 30 boxes 240.
"""


class Question(NamedTuple):
    """What a response has to answer.

    Attributes
    ----------
    contacts, rows : m contacts
    groups : contacts that may take their turn together
    velocity, angular_velocity : (n, 3), with what all other forces add in this step
    before : (m, 3), speeds of the contacts before the step, m/s
    wanted : what Newton's law wants
    restitution : (m,), e
    start : (m, 3), what the last step left, N s
    unsettled : whether a run begins with bodies at rest, so that more sweeps are needed
    dt : s
    rules : how to respond
    """

    contacts: Contacts
    rows: Rows
    groups: list[slice]
    velocity: Array
    angular_velocity: Array
    before: Array
    wanted: Wanted
    restitution: Array
    start: Array
    unsettled: bool
    dt: float
    rules: Rules


def sequential(asked: Question) -> Answer:
    """Contact after contact, again and again; see `solve_sequentially`."""
    more = min(UNSETTLED_SHARE * asked.rules.sweeps, UNSETTLED_SWEEPS)
    more *= asked.unsettled

    return solve_sequentially(
        asked.rows,
        asked.groups,
        asked.velocity,
        asked.angular_velocity,
        asked.wanted,
        asked.start,
        asked.rules.sweeps,
        asked.rules.tolerance * (UNSETTLED_TOLERANCE if more else 1.0),
        more,
    )


def simultaneous(asked: Question) -> Answer:
    """All contacts at once; see `solve_simultaneously`."""
    return solve_simultaneously(
        asked.rows,
        asked.velocity,
        asked.angular_velocity,
        asked.wanted,
        asked.rules.directions,
    )


def penalty(asked: Question) -> Answer:
    """Springs and dampers; see `solve_with_springs`."""
    return solve_with_springs(
        asked.rows,
        asked.velocity,
        asked.angular_velocity,
        asked.contacts.separation,
        asked.before,
        asked.restitution,
        asked.wanted.kinetic_friction,
        asked.start,
        asked.rules.stiffness,
        asked.dt,
    )


RESPONSES: dict[str, Callable[[Question], Answer]] = {
    "sequential": sequential,
    "simultaneous": simultaneous,
    "penalty": penalty,
}
