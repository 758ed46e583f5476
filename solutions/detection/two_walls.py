"""A puck between two walls: back up time, then go the rest (slide 3)."""

from __future__ import annotations

from solutions.domain import (
    Finite,
    FiniteNotNegative,
    FinitePositive,
    domain,
    require,
)


@domain
def count_impacts(
    position: Finite,
    velocity: Finite,
    length: FinitePositive,
    dt: FinitePositive,
    duration: FiniteNotNegative,
) -> tuple[int, float]:
    """Count the impacts of a puck between two walls, step by step (slide 3).

    The walls are at x = 0 and at x = length. The puck slides without friction.
    At a wall it turns round and keeps its speed. Every impact happens exactly
    at its own instant, and a step may hold several.

    Parameters
    ----------
    position : float, x at the start, m, from 0 to length
    velocity : float, v, m/s, positive towards the wall at x = length
    length : float, m, from wall to wall, positive
    dt : float, s, length of a step, positive
    duration : float, s, not negative
        A whole number of steps: as many are made as are nearest to
        duration/dt.

    Returns
    -------
    count : int
        0 for a puck that does not move, even if it touches a wall. A puck that
        starts on a wall hits it at once if it moves into it, and does not hit
        it if it moves away. An impact at the end of a step happens in that
        step, also at the end of the last one; where rounding puts it just
        beyond, rounding decides.
    position : float, x at the end, m

    Notes
    -----
    Neither result depends on dt, because between two impacts the velocity is
    constant and the arrival at the wall is exact. This holds only if the puck
    goes the rest of the step after an impact, with the new velocity. Without
    it the clock runs on by dt while the puck has moved for a part of dt: half
    a step is lost at each impact, on average.

    A check without a loop: let the puck go straight on, through copies of the
    strip between the walls laid side by side. After the time t it is at
    y = x + v t. It has hit a wall for each multiple of length that it has
    passed, and every second copy of the strip is a mirror image.
    """
    x, v = float(position), float(velocity)
    far_wall = float(length)
    step = float(dt)
    rule = f"position must be from 0 to {far_wall:g}, not {x:g}"
    require(0 <= x <= far_wall, rule)
    count = 0
    if v == 0:
        return count, x
    for _ in range(round(float(duration) / step)):
        remaining = step
        while True:
            wall = far_wall if v > 0 else 0.0
            time_to_wall = (wall - x) / v
            if time_to_wall > remaining:
                break
            x, v = wall, -v
            count += 1
            remaining -= time_to_wall
        x += v * remaining
    return count, x
