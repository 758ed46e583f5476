"""The last phase of a step: the bodies move, and overlaps are taken back."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.world.bodies import Bodies, State
from solutions.world.rotation import turn_freely, turned
from solutions.world.rows import Rows, speeds
from solutions.world.rules import Rules
from solutions.world.sequential import Targets, solve_sequentially

NEGLIGIBLE_DEPTH = 1e-12
"""An overlap deeper than the slop by less than this, m, counts as the slop."""


def moved_on(
    bodies: Bodies,
    state: State,
    velocity: Array,
    angular_velocity: Array,
    push: Array,
    dt: float,
) -> State:
    """The state after a step with these velocities and a push (n, 6).

    The position gains Δt v, with the velocity after the impulses
    (semi-implicit Euler); the orientation turns so that the angular momentum
    stays what it is.
    """
    position = state.position + dt * velocity + push[:, :3]
    orientation, spin = turn_freely(
        state.orientation, angular_velocity, bodies.moments, dt
    )
    return State(
        position,
        turned(orientation, push[:, 3:]) if np.any(push) else orientation,
        velocity,
        spin,
    )


def pushed_apart(
    rows: Rows,
    groups: list[slice],
    separation: Array,
    velocity: Array,
    angular_velocity: Array,
    dt: float,
    rules: Rules,
) -> Array:
    """How far each body moves and turns out of overlaps, (n, 6), m and rad.

    Parameters
    ----------
    rows, groups : of m contacts
    separation : (m,), where the step begins, m
    velocity, angular_velocity : (n, 3), at the end of the step, m/s and rad/s
    dt : s
    rules : how the world responds

    Notes
    -----
    It takes back a share of what will be deeper than the slop at the end of
    the step. It is a motion beside the velocities, and so it adds no kinetic
    energy. What it lifts has more potential energy afterwards.
    """
    rate = speeds(rows, velocity, angular_velocity)[:, 0]
    ahead = separation + dt * rate + rules.slop
    if not np.any(ahead < -NEGLIGIBLE_DEPTH):
        return np.zeros((len(velocity), 6))
    # Here a speed is a way, m. Where less than the slop is left of an overlap,
    # or a gap, other pushes may use up what is missing, and no more.
    way = np.where(ahead < 0, -rules.recovery * ahead, -ahead)
    smooth, at_rest = np.zeros(len(ahead)), np.zeros_like(velocity)
    along, about, _ = solve_sequentially(
        rows,
        groups,
        at_rest,
        at_rest,
        Targets(way, smooth, smooth, smooth > 0),
        0.0,
        rules.push_sweeps,
        rules.tolerance,
    )
    return np.concatenate([along, about], axis=-1)
