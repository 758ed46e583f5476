"""Balls on springs that a loop in the notebook moves, in a replay: a scene of the student's own, of no catalogue."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from labs.desk.display import Replay
from reference.arrays import Array
from reference.errors import InvalidInput
from reference.scene.forces import Spring
from reference.scene.scenario import Body, Scenario, Sphere
from reference.viewer import page
from reference.viewer.clip_making import clip
from reference.viewer.poses import Poses, rate_of

YOURS = "yours"


def in_motion(places: ArrayLike, duration: float, radius: ArrayLike, ends: ArrayLike = ()) -> Replay:
    """A replay of balls, with lines for the springs between them.

    places: (n, balls, 3), m, at n instants that divide the duration, s, evenly. radius: (balls,), m. ends: (s, 2), the
    two balls that each spring joins, from 0.

    Raises
    ------
    InvalidInput
        If the places are not of that form or not finite, there is not a radius for each ball, or a spring joins a ball
        that there is not.
    """
    ways, radii = np.asarray(places, dtype=float), np.asarray(radius, dtype=float)
    if ways.ndim != 3 or ways.shape[2] != 3 or len(ways) < 2:
        raise InvalidInput(f"places must have the shape (n, balls, 3), not {ways.shape}")
    if not np.all(np.isfinite(ways)):
        raise InvalidInput("places must be finite: somewhere a ball is at inf or NaN")
    count = ways.shape[1]
    if radii.shape != (count,):
        raise InvalidInput(f"radius must have the shape ({count},), one for each ball, not {radii.shape}")
    pairs = np.asarray(ends, dtype=int).reshape(-1, 2)
    if np.any(pairs < 0) or np.any(pairs >= count):
        raise InvalidInput(f"springs join balls from 0 to {count - 1}, not {pairs.tolist()}")
    scenario = _scenario(ways[0], float(duration), radii, pairs)
    times = np.arange(round(scenario.duration * rate_of(scenario)) + 1) / rate_of(scenario)
    known = np.linspace(0.0, scenario.duration, len(ways))
    flat = ways.reshape(len(ways), -1)
    shown = np.stack([np.interp(times, known, along) for along in flat.T], axis=-1).reshape(len(times), count, 3)
    upright = np.broadcast_to([1.0, 0.0, 0.0, 0.0], (len(times), count, 4))
    names = tuple(body.name for body in scenario.bodies)
    told = f"{count} balls and {len(pairs)} springs"
    whole = clip(scenario, {YOURS: Poses(YOURS, names, times, shown, upright)}, f"your own scene, {told}")
    return Replay(f'<div style="max-width:640px">{page.frame(whole)}</div>', f"[replay: {YOURS}, {told}]")


def _scenario(start: Array, duration: float, radii: Array, pairs: Array) -> Scenario:
    """What the replay draws: only shapes and ends of springs count, and no other number."""
    bodies = tuple(
        Body(f"ball {number}", Sphere(radius), mass=1.0, position=tuple(place))
        for number, (place, radius) in enumerate(zip(start, radii, strict=True))
    )
    springs = tuple(Spring(f"ball {a}", f"ball {b}", 1.0, 1.0) for a, b in pairs)
    return Scenario("own scene", bodies, (), duration, springs=springs)
