"""Poisson's law for many contacts: compression, then restitution (slide 12)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from solutions.arrays import Array
from solutions.world.sequential import Wanted

Answer = tuple[Array, Array, Array]
"""Velocities and spins (n, 3) of the bodies, impulses (m, 3) of the contacts."""


def solve_in_two_phases(
    solve: Callable[[Wanted, Array], Answer],
    wanted: Wanted,
    restitution: Array,
    start: Array,
) -> Answer:
    """Velocities and impulses where an impact gives back a share e of its impulse.

    Parameters
    ----------
    solve : finds an answer for what is wanted, from impulses to begin with
        Its rows hold the tangents themselves; they are not decoupled.
    wanted : as Newton's law would want it
        The contacts that rebound are the same here; their speeds are not used.
    restitution : (m,), e
    start : (m, 3), impulses to begin with, N s

    Returns
    -------
    velocity, angular_velocity : (n, 3)
    impulse : (m, 3), N s

    Notes
    -----
    1. Compression: no contact approaches any more. This takes the normal impulses p.
    2. Restitution: each contact that rebounds gets at least (1 + e) p, and more where
       the others would drive it together again. Friction is found a second time, in a
       cone as wide as the new normal impulse.

    For one contact this is `poisson_impulse` as long as the slip keeps its direction or
    ends for good. That function follows the slip through the impact. Here friction
    opposes the slip at the end of each phase. The two differ where the slip turns
    round, or changes its direction, within a phase.

    **Energy.** Without friction and with one e for all contacts the energy cannot rise.
    Compression takes pᵀA p/2, because p·u = 0 after it. The impulses e p give back e²
    times that, and what else the second phase needs takes energy as compression does.
    Newton's law has no such property: see `solve_simultaneously`.

    The velocities hold what the forces add in this step, and compression ends all of
    it. So a drop leaves the floor at e (v + g Δt), where Newton's law gives e v.
    """
    stopped = wanted._replace(
        speed=np.where(wanted.rebounds, 0.0, wanted.speed),
        rebounds=np.zeros_like(wanted.rebounds),
    )
    velocity, angular_velocity, impulse = solve(stopped, start)
    if not np.any(wanted.rebounds):
        return velocity, angular_velocity, impulse
    least = np.where(wanted.rebounds, (1 + restitution) * impulse[:, 0], 0.0)
    return solve(stopped._replace(least=least), impulse)
