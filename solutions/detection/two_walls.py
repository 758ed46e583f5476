"""A puck between two walls: back up time, then go the rest (slide 3)."""

from __future__ import annotations

from solutions.checks import finite, not_negative, positive


def count_impacts(
    position: float,
    velocity: float,
    length: float,
    dt: float,
    duration: float,
) -> tuple[int, float]:
    """Count the impacts of a puck between two walls, step by step (slide 3).

    The walls are at x = 0 and at x = length. The puck slides without friction.
    At a wall it turns round and keeps its speed. Every impact happens exactly
    at its own instant, and a step may hold several.

    Parameters
    ----------
    position : x at the start, m, from 0 to length
    velocity : m/s, positive towards the wall at x = length
    length : m, from wall to wall
    dt : s, length of a step
    duration : s
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

    Raises
    ------
    ValueError
        If an argument is not finite, length or dt is not positive, duration is
        negative, or the puck does not start between the walls.

    Notes
    -----
    Neither result depends on dt, because between two impacts the velocity is
    constant and the arrival at the wall is exact. This holds only if the puck
    goes the rest of the step after an impact, with the new velocity. Without
    it the clock runs on by dt while the puck has moved for a part of dt: half
    a step is lost at each impact, on average.

    Reflections unfold: let the puck go straight on, through copies of the
    strip between the walls laid side by side. After the time t it is at
    y = x + v t. It has hit a wall for each multiple of length that it has
    passed, and every second copy of the strip is a mirror image.
    """
    x = float(finite("position", position))
    v = float(finite("velocity", velocity))
    length = float(finite("length", positive("length", length)))
    dt = float(finite("dt", positive("dt", dt)))
    duration = float(finite("duration", not_negative("duration", duration)))
    if not 0 <= x <= length:
        raise ValueError(f"position must be from 0 to {length:g}, not {x:g}")
    count = 0
    if v == 0:
        return count, x
    for _ in range(round(duration / dt)):
        remaining = dt
        while True:
            wall = length if v > 0 else 0.0
            arrives = (wall - x) / v  # s from now
            if arrives > remaining:
                break
            x, v, count = wall, -v, count + 1
            remaining -= arrives
        x += v * remaining
    return count, x
