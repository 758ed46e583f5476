"""Numbers of a throw, taken from a trajectory: where and when it is highest, and where it lands at its launch height.

Two neighbouring samples and the known acceleration fix a parabola in space, p(t) = p_i + w (t − t_i) +
a (t − t_i)(t − t_{i+1})/2, w = (p_{i+1} − p_i)/(t_{i+1} − t_i). The samples of the exact flight lie on it, and so do
those of semi-implicit Euler. So no number depends on where the samples lie.
"""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array
from reference.errors import RunFailed
from reference.scene.scenario import Scenario
from reference.scene.trajectory import Trajectory


def acceleration(scenario: Scenario, body: str) -> Array:
    """Acceleration of a body by weight and by constant forces, (3,), m/s²."""
    pushes = [push.at(0.0) for push in scenario.forces if push.body == body]
    push = np.sum([*pushes, (0.0, 0.0, 0.0)], axis=0)
    return np.asarray(np.array(scenario.gravity) + push / scenario.body(body).mass)


def apex(trajectory: Trajectory, body: str) -> tuple[float, float]:
    """When a body is highest, s, and how high above its launch, m."""
    times, places, steps, slopes = _chords(trajectory, body)
    down = acceleration(trajectory.scenario, body)[2]
    after = steps / 2 - slopes[:, 2] / down  # each pair of samples names the apex of its own parabola
    pair = int(np.argmin(np.abs(after - steps / 2)))  # the nearest one knows it best
    t, h = after[pair], steps[pair]
    if not -h / 2 <= t <= 3 * h / 2:
        raise RunFailed(f"{body} still rises at the end: it has no apex")
    height = places[pair, 2] + slopes[pair, 2] * t + down * t * (t - h) / 2
    return float(times[pair] + t), float(height)


def landing(trajectory: Trajectory, body: str) -> Array:
    """Way from the launch to where a body is back at its height, (3,), m."""
    _, places, steps, slopes = _chords(trajectory, body)
    pull = acceleration(trajectory.scenario, body)
    heights = trajectory.position(body)[:, 2] - trajectory.position(body)[0, 2]
    falls = np.flatnonzero((heights[:-1] > 0) & (heights[1:] <= 0))
    if not len(falls):
        raise RunFailed(f"{body} is not back at the height of its launch by the end")
    pair = int(falls[0])
    h, slope = steps[pair], slopes[pair]
    # Height 0 at the time t after the sample: (a/2) t² + b t + s = 0, with a < 0 and s > 0 and so one root ahead
    b, s = slope[2] - pull[2] * h / 2, places[pair, 2]
    t = 2 * s / (-b + math.sqrt(b * b - 2 * pull[2] * s))
    return np.asarray(places[pair] + slope * t + pull * t * (t - h) / 2)


def _chords(trajectory: Trajectory, body: str) -> tuple[Array, Array, Array, Array]:
    """Times and places, seen from the launch, of all samples but the last; the steps after them, and their slopes."""
    times, places = trajectory.times, trajectory.position(body) - trajectory.position(body)[0]
    steps = np.diff(times)
    return times[:-1], places[:-1], steps, np.diff(places, axis=0) / steps[:, None]
