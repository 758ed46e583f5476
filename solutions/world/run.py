"""Many steps of the world, with forces that depend on its state (slides 23 to 29)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.world.bodies import Bodies, State
from solutions.world.memory import NOTHING
from solutions.world.rules import Rules
from solutions.world.step import advance_world

Forces = Callable[[State], tuple[Array, Array]]
"""Forces and torques on all bodies in a state, (n, 3) each, N and N m."""


def run_world(
    bodies: Bodies,
    state: State,
    acceleration: ArrayLike,
    dt: float,
    steps: int,
    rules: Rules = Rules(),  # noqa: B008  (an immutable tuple)
    forces: Sequence[Forces] = (),
    every: int = 1,
) -> State:
    """The states of a world over many steps.

    Parameters
    ----------
    bodies, state : the world at the start
    acceleration : (3,) or (n, 3), g, m/s²
    dt : s
    steps : how many
    rules : how it responds to contacts
    forces : functions of the state, such as springs, drag and wind
    every : a state is kept after so many steps

    Returns
    -------
    State, whose arrays have one more axis in front: one entry for each state kept
        The first is the start.

    Raises
    ------
    ValueError
        If a number of steps is not whole or too small, or as `advance_world`.
    """
    for name, count, least in (("steps", steps, 0), ("every", every, 1)):
        if count < least or count != int(count):
            raise ValueError(
                f"{name} must be a whole number from {least}, not {count}"
            )
    kept, memory = [state], NOTHING
    for count in range(1, steps + 1):
        acting = [force(state) for force in forces]
        force, torque = (
            sum((each[part] for each in acting), np.zeros(3))
            for part in (0, 1)
        )
        state, memory, _ = advance_world(
            bodies, state, acceleration, dt, rules, memory, force, torque
        )
        if count % every == 0:
            kept.append(state)
    return State(*(np.stack(parts) for parts in zip(*kept, strict=True)))
