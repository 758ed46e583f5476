"""A ball bounces over a plane: a loop that looks at each step (slide 6)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    Finite,
    NotNegative,
    Share,
    Triple,
    Unit,
    Vector,
    Whole,
    domain,
)
from solutions.response.steps import respond_at_step


@domain
def bounce(
    position: Vector,
    velocity: Triple,
    acceleration: Triple,
    normal: Unit,
    offset: Finite,
    restitution: Share,
    dt: NotNegative,
    steps: Whole,
) -> tuple[Array, Array]:
    """Where a ball is, and how fast, after each step over a plane (slide 6).

    At the start of each step the loop looks whether the centre of the ball is
    behind the plane n·p + d = 0, where n·p + d is below zero. The step is then
    that of `respond_at_step`. Touching the plane is not behind it.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
        At the start. The acceleration stays as it is.
    normal : (..., 3), n, unit, out of the plane
    offset : (...), d, m
        Of the plane that the centre must not pass. It lies one radius before
        the one that the ball touches.
    restitution : (...), e, 0 to 1
    dt : (...), s, length of each step, not negative
    steps : int, how many, 0 or more, the same for all balls of a call

    Returns
    -------
    positions, velocities : (steps + 1, ..., 3) each, m and m/s
        The first of each is the start, the last that after all steps. Each
        has an entry for every ball, also where all balls start alike. With
        e = 0 a ball moves along the plane after its response; on a slanted
        plane, rounding decides whether v·n is then below zero.

    Notes
    -----
    Three things are done in each step, in this order: look, respond, move. A
    loop that moves first and looks afterwards costs as much, and its apex is
    lower (see the notes of `respond_at_step`).
    """
    # One entry for every ball, also where all balls start alike
    p, v, *_ = np.broadcast_arrays(
        position,
        velocity,
        acceleration,
        normal,
        *(number[..., None] for number in (offset, restitution, dt)),
    )
    positions, velocities = [p], [v]
    for _ in range(int(steps)):
        behind = np.vecdot(p, normal) + offset < 0
        p, v = respond_at_step(
            p, v, acceleration, normal, behind, restitution, dt
        )
        positions.append(p)
        velocities.append(v)
    return np.stack(positions), np.stack(velocities)
