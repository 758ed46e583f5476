"""Numbers of two bodies that attract each other, taken from a trajectory: apsides, period, and what is conserved.

All numbers describe the motion of the first body as seen from the second, so that the motion of their centre does not
matter.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.catalogue import swings
from reference.errors import RunFailed
from reference.scene.trajectory import Trajectory


@dataclass(frozen=True)
class Apsides:
    """Times, s, of the first two approaches and of the first two recessions after the start."""

    near: tuple[float, float]
    far: tuple[float, float]


def seen_from_the_other(trajectory: Trajectory) -> tuple[Array, Array]:
    """Place, m, and velocity, m/s, of the first body as seen from the second, at each sample, (n, 3)."""
    pull = trajectory.scenario.attractions[0]
    place = trajectory.position(pull.body_a) - trajectory.position(pull.body_b)
    return np.asarray(place), np.asarray(trajectory.velocity(pull.body_a) - trajectory.velocity(pull.body_b))


def distance(trajectory: Trajectory) -> Array:
    """Distance of the two centres at each sample, (n,), m."""
    return np.asarray(np.linalg.norm(seen_from_the_other(trajectory)[0], axis=1))


def apsides(trajectory: Trajectory) -> Apsides:
    """When the bodies are nearest and farthest, twice each; an error where they are so less often."""
    times, gap = trajectory.times, distance(trajectory)
    near, far = swings.turns(times, -gap), swings.turns(times, gap)
    if min(len(near), len(far)) < 2:
        raise RunFailed(f"{len(near)} near and {len(far)} far points by the end: it takes two of each")
    return Apsides((near[0], near[1]), (far[0], far[1]))


def turned(trajectory: Trajectory) -> float:
    """Angle from the first near point to the second, rad, in the direction of the motion."""
    place, velocity = seen_from_the_other(trajectory)
    axis = np.cross(place[0], velocity[0])
    axis /= np.linalg.norm(axis)
    first, second = (_at(trajectory.times, place, time) for time in apsides(trajectory).near)
    return float(np.arctan2(np.cross(first, second) @ axis, first @ second))


def energy_gained(trajectory: Trajectory) -> float:
    """From the first far point to the second, as a share of the energy at the first one."""
    scenario = trajectory.scenario
    pull = scenario.attractions[0]
    masses = scenario.body(pull.body_a).mass, scenario.body(pull.body_b).mass
    place, velocity = seen_from_the_other(trajectory)
    # Per reduced mass: v²/2 − G (m_A + m_B)/r
    energy = np.sum(velocity**2, axis=1) / 2 - pull.constant * sum(masses) / np.linalg.norm(place, axis=1)
    first, second = (swings.at(trajectory.times, energy, time) for time in apsides(trajectory).far)
    return (second - first) / abs(first)


def angular_momentum_gained(trajectory: Trajectory) -> float:
    """From start to end, as a share of that at the start: the length of the difference of the two vectors."""
    place, velocity = seen_from_the_other(trajectory)
    first, last = (np.cross(place[sample], velocity[sample]) for sample in (0, -1))
    return float(np.linalg.norm(last - first) / np.linalg.norm(first))


def _at(times: Array, values: Array, time: float) -> Array:
    return np.array([swings.at(times, values[:, axis], time) for axis in range(3)])


def distance_at(trajectory: Trajectory, time: float) -> float:
    """Distance of the two centres at a time, m."""
    return swings.at(trajectory.times, distance(trajectory), time)
