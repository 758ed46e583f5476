"""Poses for a replay: where the moving bodies are, sampled for a viewer.

A viewer takes `Poses`: `poses_of` makes them of a trajectory that has just been run,
`reference.recording.reading.replay` of one that was recorded elsewhere.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.scene.scenario import Scenario
from reference.scene.trajectory import Trajectory

RATE = 60
"""Samples a second of a replay."""
LEAST_SAMPLES = 60
"""A run of less than a second has a whole multiple of `RATE`, so that it can be watched in slow motion."""
FARTHEST = 2e3
"""A body that flies farther than this, m, is kept at this distance."""


@dataclass(frozen=True, eq=False)
class Poses:
    """Where the moving bodies of a scenario are. The scenario itself says where the others are.

    title: whose run it is. bodies: their b names. times: (n,), s, evenly spaced from 0. positions: (n, b, 3), centres
    of mass, m. orientations: (n, b, 4), w x y z, without jumps of sign. recording: where and when it ran, if not here.
    Arrays are read-only.
    """

    title: str
    bodies: tuple[str, ...]
    times: Array
    positions: Array
    orientations: Array
    recording: str = ""

    def __post_init__(self) -> None:
        for name in ("times", "positions", "orientations"):
            view = np.asarray(getattr(self, name), dtype=np.float64).view()
            view.flags.writeable = False
            object.__setattr__(self, name, view)


def rate_of(scenario: Scenario) -> int:
    """Samples a second of a scenario's replay: `RATE`, or a multiple of it where the run is short."""
    return RATE * max(1, math.ceil(LEAST_SAMPLES / RATE / scenario.duration))


def poses_of(trajectory: Trajectory, title: str = "") -> Poses:
    """Sample a trajectory for a replay, in straight lines between its own samples, which are a few milliseconds apart.

    A trajectory does not say what happened between two of its samples, such as an impact.
    """
    scenario = trajectory.scenario
    moving = [place for place, body in enumerate(scenario.bodies) if not body.immovable]
    rate = rate_of(scenario)
    times = np.arange(math.floor(scenario.duration * rate + 1e-6) + 1) / rate
    orientations = _turning_on(trajectory.orientations[:, moving])
    return Poses(
        title or trajectory.engine,
        tuple(scenario.bodies[place].name for place in moving),
        times,
        _at(times, trajectory.times, trajectory.positions[:, moving]),
        unit_quaternions(_at(times, trajectory.times, orientations)),
    )


def _turning_on(orientations: Array) -> Array:
    """The same orientations with signs that do not jump: q and −q are one orientation."""
    same = np.sum(orientations[1:] * orientations[:-1], axis=-1) >= 0
    signs = np.cumprod(np.where(same, 1.0, -1.0), axis=0)
    return np.concatenate([orientations[:1], orientations[1:] * signs[..., np.newaxis]])


def _at(times: Array, known: Array, values: Array) -> Array:
    """Values (n, b, k) known at some times, at others."""
    right = np.clip(np.searchsorted(known, times, side="right"), 1, len(known) - 1)
    share = np.clip((times - known[right - 1]) / (known[right] - known[right - 1]), 0.0, 1.0)[:, None, None]
    return np.asarray(values[right - 1] * (1 - share) + values[right] * share, dtype=np.float64)


def unit_quaternions(orientations: Array) -> Array:
    """The same orientations (…, 4) with length 1, which interpolation and rounding have changed."""
    return np.asarray(orientations / np.linalg.norm(orientations, axis=-1, keepdims=True), dtype=np.float64)
