"""Numbers taken from runs in which bodies steer themselves: how near they come, whether and when they arrive."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.arrays import Array
from reference.errors import RunFailed
from reference.scene.clearance import Nearest, nearest
from reference.scene.query import Query
from reference.scene.trajectory import Trajectory

ARRIVED = 0.05
"""A body has arrived where it is no farther from its goal, m."""


def clearance(trajectory: Trajectory) -> float:
    """Least gap between any two bodies, m, from the poses; negative where they overlap."""
    return _nearest(trajectory).gap


def clearance_asked(trajectory: Trajectory, query: Callable[[Query], float]) -> float:
    """The same by an implementation's own answer for the two bodies that come nearest, m."""
    return query(_nearest(trajectory).question())


def overlap(trajectory: Trajectory) -> float:
    """Deepest overlap of any two bodies, m; 0 where no two touch."""
    return max(0.0, -clearance(trajectory))


def contacts(trajectory: Trajectory) -> float:
    """How many contacts without a gap the implementation reports, over all samples."""
    return float(np.sum(trajectory.contacts.separation <= 0))


def _nearest(trajectory: Trajectory) -> Nearest:
    found = nearest(trajectory.scenario, trajectory.positions)
    if found is None:
        raise RunFailed("it has no two bodies that could meet")
    return found


def distances_left(trajectory: Trajectory) -> Array:
    """How far each steered body is from its goal at each sample, (n, steered), m."""
    places = [
        (name, goal)
        for each in trajectory.scenario.steering
        for name, goal in zip(each.bodies, each.goals, strict=True)
    ]
    return np.stack([np.linalg.norm(trajectory.position(name) - goal, axis=-1) for name, goal in places], axis=-1)


def farthest_left(trajectory: Trajectory) -> float:
    """How far the body that is farthest from its goal at the end is from it, m."""
    return float(np.max(distances_left(trajectory)[-1]))


def arrived(trajectory: Trajectory) -> float:
    """How many bodies are at their goals at the end."""
    return float(np.sum(distances_left(trajectory)[-1] <= ARRIVED))


def time_to_arrive(trajectory: Trajectory) -> float:
    """When the last body arrives for good, s: where the distance that is left falls to `ARRIVED`, between samples."""
    left, times = distances_left(trajectory), trajectory.times
    if np.any(left[-1] > ARRIVED):
        raise RunFailed("not every body arrives")
    ends = []
    for own in left.T:
        (outside,) = np.nonzero(own > ARRIVED)
        at = int(outside[-1]) if len(outside) else 0
        share = (own[at] - ARRIVED) / (own[at] - own[at + 1]) if len(outside) else 0.0
        ends.append(float(times[at] + share * (times[at + 1] - times[at])))
    return max(ends)


def speeding(trajectory: Trajectory) -> float:
    """By how much the fastest steered body exceeds its top speed at any sample, m/s; 0 where none does."""
    excess = [
        np.max(np.linalg.norm(trajectory.velocity(name), axis=-1)) - each.max_speed
        for each in trajectory.scenario.steering
        for name in each.bodies
    ]
    return max(0.0, float(max(excess)))
