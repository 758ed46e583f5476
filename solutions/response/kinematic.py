"""Kinematic response: a collision gives a body a new velocity (slide 7)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import Share, Triple, Unit, domain


@domain
def kinematic_response(
    velocity: Triple,
    normal: Unit,
    restitution: Share,
    plane_velocity: Triple = (0.0, 0.0, 0.0),
) -> Array:
    """Velocity after a collision with a plane that nothing can stop (slide 7).

    The plane may move. It keeps its own velocity, and it has no friction: a
    plane that slides within itself does not drag the body along.

    Parameters
    ----------
    velocity : (..., 3), v, m/s
    normal : (..., 3), N, unit, out of the plane
    restitution : (...), e, 0 to 1
    plane_velocity : (..., 3), w, m/s

    Returns
    -------
    (..., 3), m/s
        A body keeps its velocity where it and the plane do not approach each
        other along the normal: it moves away from the plane, or beside it.

    Notes
    -----
    Sit on the plane. From there the body has the velocity u = v − w, and the
    collision is that with a plane at rest. The velocity u is the sum of its
    component along the plane, u − (u·N) N, and its normal component (u·N) N.
    The collision leaves the first as it is and multiplies the second by −e.
    Added up again, this is

        u' = u − (1 + e) (u·N) N    if u·N < 0

    The plane keeps its velocity, so that v' = u' + w:

        v' = v − (1 + e) (u·N) N    if u·N < 0

    The slide's v − 2 (v·N) N is the case w = 0 and e = 1. The slide has no
    guard: its formula, applied to a body that already moves away, would throw
    the body back in.

    A racket that meets a ball with the speed W sends a ball of speed V back
    with e V + (1 + e) W. The energy of the ball may grow, because the plane
    does work on it.
    """
    relative = velocity - plane_velocity
    # u·N, or 0 where they do not approach
    approach = np.minimum(np.vecdot(relative, normal), 0.0)
    return velocity - ((1 + restitution) * approach)[..., None] * normal
