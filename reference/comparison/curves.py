"""Plotted curves: thinned to the points that make them, and packed into bytes for recordings."""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np

from reference.arrays import Array
from reference.catalogue.family import Family
from reference.scene.trajectory import Trajectory

NEAR = 1e-3
"""How far thinning may move a curve, as a share of its range: a third of a dot in a figure of 300 dots."""
MOST_POINTS = 400
"""How many points are kept at most; a curve that never runs straight is then followed less closely."""
TIME_DECIMALS, VALUE_DECIMALS = 6, 7
"""Decimals that are kept of times, s, and of values, in the unit of the family's curve."""


@dataclass(frozen=True)
class Series:
    """A plotted curve: times in s and values in the unit of the family's curve, joined by straight lines."""

    times: tuple[float, ...]
    values: tuple[float, ...]

    @classmethod
    def of(cls, family: Family, trajectory: Trajectory) -> Series:
        """The family's curve of a trajectory, thinned; an impact stays as sudden as it is in the samples."""
        end = family.curve.until or trajectory.times[-1]
        times, values = trajectory.times, family.curve.values(trajectory)
        inside = (times <= end) & np.isfinite(values)
        times, values = np.round(times[inside], TIME_DECIMALS), np.round(values[inside], VALUE_DECIMALS)
        kept = corners(times, values)
        return cls(tuple(times[kept].tolist()), tuple(values[kept].tolist()))

    def dense(self) -> tuple[Array, Array]:
        """Times and values with many points on the straight lines as well, since only points can carry a marker."""
        times, values = np.array(self.times), np.array(self.values)
        between = np.linspace(times[0], times[-1], MOST_POINTS) if len(times) else times
        order = np.argsort(np.concatenate([times, between]), kind="stable")
        within = np.interp(between, times, values) if len(times) else values
        return np.concatenate([times, between])[order], np.concatenate([values, within])[order]


def corners(times: Array, values: Array) -> list[int]:
    """Indices of the points to keep: straight lines between them pass near all others (Douglas and Peucker).

    The point that is farthest off is taken first, so that a limit to their number drops those that matter least.
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
    """The point between two others that the line between these misses most, as an entry of a heap.

    An entry is minus the distance, so that the largest comes first, the index of the point, and both others.
    """
    if last - first < 2 or times[last] == times[first]:
        return 0.0, first, first, last
    slope = (values[last] - values[first]) / (times[last] - times[first])
    off = np.abs(values[first:last] - values[first] - slope * (times[first:last] - times[first]))
    place = int(np.argmax(off))
    return -float(off[place]), first + place, first, last


def pack(series: Series) -> bytes:
    """A curve as bytes: all times, then all values."""
    return np.array([series.times, series.values], dtype="<f4").tobytes()


def unpack(packed: bytes) -> Series:
    """The curve in some bytes, with seven digits of each value."""
    found: Array = np.frombuffer(packed, dtype="<f4").astype(np.float64).reshape(2, -1)
    times, values = np.round(found[0], TIME_DECIMALS), found[1]
    return Series(tuple(times.tolist()), tuple(float(f"{value:.7g}") for value in values))
