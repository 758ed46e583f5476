"""Plotted curves: thinned to the points that make them, and packed into bytes for recordings."""

from __future__ import annotations

import heapq
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from reference.arrays import Array
from reference.scene.trajectory import Trajectory

if TYPE_CHECKING:
    from reference.catalogue.family import Family

NEAR = 1e-3
"""Share of a curve's range that thinning may move it by: a third of a dot in a figure of 300."""
MOST_POINTS = 400
"""Of a curve that never runs straight; it is followed less closely."""


@dataclass(frozen=True)
class Series:
    """A plotted curve: times in s, values in the unit of the family's curve, with straight lines between."""

    times: tuple[float, ...]
    values: tuple[float, ...]

    @classmethod
    def of(cls, family: Family, trajectory: Trajectory) -> Series:
        """The family's curve of a trajectory, thinned: an impact stays as sudden as the samples have it."""
        end = family.curve.until or trajectory.times[-1]
        times, values = trajectory.times, family.curve.values(trajectory)
        inside = (times <= end) & np.isfinite(values)
        times, values = np.round(times[inside], 6), np.round(values[inside], 7)
        kept = corners(times, values)
        return cls(tuple(times[kept].tolist()), tuple(values[kept].tolist()))

    def dense(self) -> tuple[Array, Array]:
        """Times and values with many points on the straight lines as well: markers stand on points alone."""
        times, values = np.array(self.times), np.array(self.values)
        between = np.linspace(times[0], times[-1], MOST_POINTS) if len(times) else times
        order = np.argsort(np.concatenate([times, between]), kind="stable")
        within = np.interp(between, times, values) if len(times) else values
        return np.concatenate([times, between])[order], np.concatenate([values, within])[order]


def corners(times: Array, values: Array) -> list[int]:
    """Where the points are that are kept; straight lines between them are near all the others (Douglas and Peucker).

    The one that is farthest off is taken first, so that a limit to their number leaves out what is seen least.
    """
    if len(times) < 3:
        return list(range(len(times)))
    last, near = len(times) - 1, NEAR * float(np.ptp(values))
    kept, waiting = [0, last], [_farthest(times, values, 0, last)]
    while len(kept) < MOST_POINTS and -waiting[0][0] > near:
        _, place, first, last = heapq.heappop(waiting)
        kept.append(place)
        for start, end in ((first, place), (place, last)):
            heapq.heappush(waiting, _farthest(times, values, start, end))
    return sorted(kept)


def _farthest(times: Array, values: Array, first: int, last: int) -> tuple[float, int, int, int]:
    """The point between two that a straight line misses most, below zero how far, to come first in a heap; and both."""
    if last - first < 2 or times[last] == times[first]:
        return 0.0, first, first, last
    slope = (values[last] - values[first]) / (times[last] - times[first])
    off = np.abs(values[first:last] - values[first] - slope * (times[first:last] - times[first]))
    place = int(np.argmax(off))
    return -float(off[place]), first + place, first, last


def pack(series: Series) -> bytes:
    """All times, then all values."""
    return np.array([series.times, series.values], dtype="<f4").tobytes()


def unpack(packed: bytes) -> Series:
    """The curve in some bytes, as it was but for the eighth digit."""
    found: Array = np.frombuffer(packed, dtype="<f4").astype(np.float64).reshape(2, -1)
    times, values = np.round(found[0], 6), found[1]
    return Series(tuple(times.tolist()), tuple(float(f"{value:.7g}") for value in values))
