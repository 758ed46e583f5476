"""A world that a notebook makes of plain arrays, and a replay of what its own steps do to it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from labs.desk.display import Replay
from labs.desk.own_motion import YOURS
from labs.plain_worlds import BALL, BOX, FLOOR, PLANE, thing, world
from reference.errors import InvalidInput
from reference.scene.scenario import Body, Box, HalfSpace, Scenario, Sphere
from reference.viewer import camera, page
from reference.viewer.clip_making import clip
from reference.viewer.poses import Poses, rate_of

__all__ = ["BALL", "BOX", "FLOOR", "PLANE", "film", "thing", "world"]


def film(bodies: Sequence[Any], states: Sequence[Any], dt: float, oblique: bool = False) -> Replay:
    """A replay of a world.

    bodies: inverse_mass, moments, restitution, friction, meet, kind and size. states: one for each step, the first of
    them the start; position, orientation and more. dt: between two of them, s. oblique: whether it is seen from above.

    Raises
    ------
    InvalidInput
        If there are fewer than two states, or a place or an orientation is not finite.
    """
    if len(states) < 2:
        raise InvalidInput(f"a film needs two states or more, not {len(states)}")
    places, turns = (np.array([state[part] for state in states], dtype=float) for part in (0, 1))
    if not (np.all(np.isfinite(places)) and np.all(np.isfinite(turns))):
        raise InvalidInput("a body is at inf or NaN: look at the states before you film them")
    turns = turns / np.linalg.norm(turns, axis=-1, keepdims=True)
    inverse_mass, *_, kind, size = bodies
    parts = tuple(
        Body(f"body {k}", _shape(kind[k], size[k]), _mass(inverse_mass[k]), tuple(places[0, k]), tuple(turns[0, k]))
        for k in range(len(kind))
    )
    scenario = Scenario("yours/film", parts, (), dt * (len(states) - 1))
    times = np.arange(round(scenario.duration * rate_of(scenario)) + 1) / rate_of(scenario)
    seen = np.minimum(np.round(times / dt).astype(int), len(states) - 1)
    moving = [k for k in range(len(kind)) if inverse_mass[k] > 0]
    names = tuple(parts[k].name for k in moving)
    poses = Poses(YOURS, names, times, places[seen][:, moving], turns[seen][:, moving])
    whole = clip(scenario, {YOURS: poses}, "your own world")
    shown = page.frame(replace(whole, view=camera.INTO) if oblique else whole)
    return Replay(f'<div style="max-width:640px">{shown}</div>', "[replay: yours]")


def _mass(inverse: float) -> float:
    return 1 / inverse if inverse > 0 else float("inf")


def _shape(kind: int, size: Any) -> Sphere | Box | HalfSpace:
    if kind == BALL:
        return Sphere(float(size[0]))
    return Box(tuple(size)) if kind == BOX else HalfSpace(tuple(size))
