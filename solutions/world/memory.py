"""What a step leaves to the next one: impulses of contacts (slide 22)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Integers
from solutions.world.contacts import Contacts
from solutions.world.rows import Rows
from solutions.world.vectors import tangents


class Memory(NamedTuple):
    """Impulses to begin with.

    Attributes
    ----------
    key : (m,), of the contacts
    impulse : (m, 3), on A, in the world frame, N s
        Of a penalty contact, not what it has given, but Δt times the force of
        its spring along the surface, from which the next step knows the
        stretch.
    still : (n,), for how long each body has been slow, s; 0 if nothing sleeps
    unsettled : how many more steps take more sweeps than usual
        Bodies may rest on each other when nothing is known of their contacts
        yet. The usual sweeps would then need many steps to find what carries a
        tower, and until then it has fallen. It is 0 after an impact.
    """

    key: Integers
    impulse: Array
    still: Array | float = 0.0
    unsettled: int = 0

    @property
    def carried(self) -> Integers:
        """The keys of the contacts whose impulse is not 0."""
        return self.key[np.any(self.impulse, axis=-1)]


NOTHING = Memory(np.zeros(0, dtype=np.int64), np.zeros((0, 3)), unsettled=5)
"""What the first step finds."""


def remembered(memory: Memory, contacts: Contacts, rows: Rows) -> Array:
    """Impulses (m, 3) of the last step, where features stay, N s.

    They are kept in the world frame, because the directions of friction turn
    with the normal from step to step.
    """
    if not len(memory.key):
        return np.zeros((len(contacts.key), 3))
    order = np.argsort(memory.key, kind="stable")
    place = np.searchsorted(memory.key, contacts.key, sorter=order)
    place = order[np.minimum(place, len(order) - 1)]
    stays = memory.key[place] == contacts.key
    had = np.where(stays[:, None], memory.impulse[place], 0.0)
    # Along t − a n friction takes a·λ_t from the normal impulse; λ_n is that
    # much more.
    friction = np.stack(
        [np.vecdot(had, tangent) for tangent in tangents(contacts.normal)],
        axis=-1,
    )
    normal = np.vecdot(had, contacts.normal)
    normal = normal + np.vecdot(rows.coupling, friction)
    return np.concatenate([normal[:, None], friction], axis=-1)
