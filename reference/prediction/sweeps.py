"""The contacts of one step, solved together: each in turn with the impulses of the others, until nothing changes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.arrays import Array
from reference.prediction.both import Both, NoRule
from reference.prediction.impulses import Rule

MOST_SWEEPS = 100
"""The contacts take their turn until none changes; so often at most. After that the end is looked for directly."""
MOST_LEAPS = 50
"""So many leaps to the end at most; where all contacts that push go on pushing, two or three are enough."""
STILL = 1e-11
"""A leap is the last if it changes no velocity of a contact by more than this, m/s: that is rounding."""
SAME = 1e-15
"""A change of less than this share of the largest impulse is none."""


def swept(contacts: list[tuple[Both, Rule]], k: Array, weight: Array) -> tuple[Array, Array]:
    """The impulses of the contacts of a step, along t and n of each, (2 n,), and those that only move, along n, (n,).

    k: (2 n, 2 n), what a unit impulse changes of each velocity, 1/kg. weight: what it adds to them in the step.
    """
    pushes = np.zeros(len(contacts))

    def sweep(impulses: Array) -> Array:
        impulses = impulses.copy()
        for number, (both, rule) in enumerate(contacts):
            own = slice(2 * number, 2 * number + 2)
            others = k[own] @ impulses - k[own, own] @ impulses[own]
            given = rule.given(both.met(weight[own], others))
            impulses[own] = given.along, given.pressed
            pushes[number] = given.push / both.inverse_masses[2]
        return impulses

    impulses = np.zeros(len(k))
    for _ in range(MOST_SWEEPS):
        before, impulses = impulses, sweep(impulses)
        if len(contacts) < 2 or np.all(np.abs(impulses - before) <= SAME * np.max(np.abs(impulses))):
            return impulses, pushes
    return _end_of(sweep, k, impulses), pushes


def _end_of(sweep: Callable[[Array], Array], k: Array, impulses: Array) -> Array:
    """The impulses that a sweep does not change, by Newton's method.

    Through a light body between heavy ones a sweep carries little, so that a hundred sweeps are far from the end. But
    while the same contacts push and grip, a sweep is an affine map. Its slopes, from one more sweep for each impulse,
    say where it ends.
    """
    for _ in range(MOST_LEAPS):
        here = sweep(impulses)
        size = float(np.max(np.abs(here)))
        slopes = np.stack([sweep(impulses + size * unit) - here for unit in np.eye(len(here))], axis=1) / size
        try:
            leap = np.linalg.solve(np.eye(len(here)) - slopes, here - impulses)
        except np.linalg.LinAlgError:
            raise NoRule from None
        impulses = impulses + leap
        if np.max(np.abs(k @ leap)) <= STILL:
            return sweep(impulses)
    raise NoRule
