"""The responses of a step, each under its name."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from solutions.arrays import Array
from solutions.world.contacts import Contacts
from solutions.world.penalty import solve_with_springs
from solutions.world.rows import Rows
from solutions.world.rules import Rules
from solutions.world.sequential import Targets, solve_sequentially
from solutions.world.simultaneous import solve_simultaneously

Answer = tuple[Array, Array, Array]
"""Velocities and spins (n, 3) of bodies, impulses (m, 3) of contacts."""
UNSETTLED_SHARE, UNSETTLED_SWEEPS, UNSETTLED_TOLERANCE = 10, 500, 0.1
"""How many sweeps may follow on the usual ones in the first steps of a run.

It is so many times the usual sweeps, but no more than so many. They end at a
tolerance that is so many times that of the rules. A tower of 8 boxes takes
some 200 of them in its first step, and one of 30 boxes 240.
"""


class Question(NamedTuple):
    """What a response has to answer.

    Attributes
    ----------
    contacts, rows : m contacts
    groups : contacts that may take their turn together
    velocity, angular_velocity : (n, 3), m/s and rad/s
        With what all other forces add in this step.
    before : (m, 3), speeds of the contacts before the step, m/s
    targets : what the impulses have to reach, by Newton's law
    restitution : (m,), e
    start : (m, 3), what the last step left, N s
    unsettled : whether more sweeps are needed
        They are where a run begins with bodies at rest.
    dt : s
    rules : how to respond
    """

    contacts: Contacts
    rows: Rows
    groups: list[slice]
    velocity: Array
    angular_velocity: Array
    before: Array
    targets: Targets
    restitution: Array
    start: Array
    unsettled: bool
    dt: float
    rules: Rules


def sequential(question: Question) -> Answer:
    """Contact after contact, again and again; see `solve_sequentially`."""
    more = min(UNSETTLED_SHARE * question.rules.sweeps, UNSETTLED_SWEEPS)
    more *= question.unsettled
    return solve_sequentially(
        question.rows,
        question.groups,
        question.velocity,
        question.angular_velocity,
        question.targets,
        question.start,
        question.rules.sweeps,
        question.rules.tolerance * (UNSETTLED_TOLERANCE if more else 1.0),
        more,
    )


def simultaneous(question: Question) -> Answer:
    """All contacts at once; see `solve_simultaneously`."""
    return solve_simultaneously(
        question.rows,
        question.velocity,
        question.angular_velocity,
        question.targets,
        question.rules.directions,
    )


def penalty(question: Question) -> Answer:
    """Springs and dampers; see `solve_with_springs`."""
    return solve_with_springs(
        question.rows,
        question.velocity,
        question.angular_velocity,
        question.contacts.separation,
        question.before,
        question.restitution,
        question.targets.kinetic_friction,
        question.start,
        question.rules.stiffness,
        question.dt,
    )


RESPONSES: dict[str, Callable[[Question], Answer]] = {
    "sequential": sequential,
    "simultaneous": simultaneous,
    "penalty": penalty,
}
