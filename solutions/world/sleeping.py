"""Sleeping: bodies that have been still are left out of a step (slide 22).

It saves time, and it is not physics: a body that creeps slowly enough stops
creeping. So it is off unless `Rules.sleep_speed` is above 0.
"""

from __future__ import annotations

import numpy as np

from solutions.arrays import Booleans
from solutions.world.bodies import Bodies, State
from solutions.world.contacts import Contacts, find_contacts
from solutions.world.rules import Rules


def with_sleepers(
    bodies: Bodies, state: State, asleep: Booleans
) -> tuple[Bodies, State]:
    """The world of a step in which sleeping bodies (n,) do not move.

    They are immovable, so that awake bodies find them where they lie, and two
    sleepers make no contact. What held them is forgotten, and found again when
    they wake.
    """
    if not np.any(asleep):
        return bodies, state
    rigid = bodies._replace(
        inverse_mass=np.where(asleep, 0.0, bodies.inverse_mass),
        moments=np.where(asleep[:, None], np.inf, bodies.moments),
    )
    velocity = np.where(asleep[:, None], 0.0, state.velocity)
    spin = np.where(asleep[:, None], 0.0, state.angular_velocity)
    return rigid, state._replace(velocity=velocity, angular_velocity=spin)


def is_fast(bodies: Bodies, state: State, rules: Rules) -> Booleans:
    """Whether each body (n,) moves too fast to sleep.

    Its speed is that of its centre, or of its surface at `sleep_size`. An
    immovable body that moves is driven, such as a lift. It never sleeps,
    however slow it is.
    """
    spin = rules.sleep_size * np.linalg.norm(state.angular_velocity, axis=-1)
    speed = np.maximum(np.linalg.norm(state.velocity, axis=-1), spin)
    too_fast = speed >= rules.sleep_speed
    return np.where(bodies.inverse_mass > 0, too_fast, speed > 0)


def is_awake(bodies: Bodies, state: State, rules: Rules) -> Booleans:
    """Whether each body (n,) is too fast to sleep, or touches a driven one.

    A sleeper is immovable for a step, and two immovable bodies make no
    contact. So a sleeper would not notice what is driven into it.
    """
    fast = is_fast(bodies, state, rules)
    driven = fast & (bodies.inverse_mass == 0)
    if not np.any(driven):
        return fast
    contacts = find_contacts(bodies, state, rules.margin)
    return fast | with_neighbours(driven, contacts)


def with_neighbours(chosen: Booleans, contacts: Contacts) -> Booleans:
    """The chosen bodies (n,), and all that touch one of them."""
    reached = chosen.copy()
    reached[contacts.body_a[chosen[contacts.body_b]]] = True
    reached[contacts.body_b[chosen[contacts.body_a]]] = True
    return reached
