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
"""An overlap that is deeper than the slop by less than this, m, is no deeper."""


def moved_on(
    bodies: Bodies,
    state: State,
    velocity: Array,
    angular_velocity: Array,
    push: Array,
    dt: float,
) -> State:
    """The state after a step with these velocities, and a push (n, 6) beside them.

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
    """How far each body is moved and turned (n, 6) out of the overlaps, m and rad.

    It takes back a share of what will be deeper than the slop at the end of
    the step. It is a motion beside the velocities, and so it adds no kinetic
    energy. What it lifts has more potential energy afterwards.
    """
    ahead = (
        separation
        + dt * speeds(rows, velocity, angular_velocity)[:, 0]
        + rules.slop
    )
    nothing, none = np.zeros_like(velocity), np.zeros(len(ahead))
    if not np.any(ahead < -NEGLIGIBLE_DEPTH):
        return np.zeros((len(velocity), 6))
    # Here a speed is a way, m. Where less than the slop is left of an overlap,
    # or a gap, other pushes may use up what is missing, and no more.
    targets = Targets(
        np.where(ahead < 0, -rules.recovery * ahead, -ahead),
        none,
        none,
        none > 0,
    )
    along, about, _ = solve_sequentially(
        rows,
        groups,
        nothing,
        nothing,
        targets,
        0.0,
        rules.push_sweeps,
        rules.tolerance,
    )
    return np.concatenate([along, about], axis=-1)
