"""Numbers of a spring that swings, taken from a trajectory.

The samples of a swing lie on a smooth curve, in theory and for every step method. So a polynomial through six
neighbouring samples gives the values between them, to (ω dt)⁶ of the swing.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import Polynomial

from reference.arrays import Array
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.settings import Settings
from reference.scene.trajectory import Trajectory

_AROUND = 6
"""Samples for one polynomial."""


def length(trajectory: Trajectory) -> tuple[Array, Array]:
    """Length of the first spring, m, and how fast it grows, m/s, at each sample, (n,)."""
    spring = trajectory.scenario.springs[0]
    ends = [
        _end(trajectory, name, point)
        for name, point in ((spring.body_a, spring.point_a), (spring.body_b, spring.point_b))
    ]
    along, moving = ends[0][0] - ends[1][0], ends[0][1] - ends[1][1]
    lengths = np.linalg.norm(along, axis=1)
    return lengths, np.asarray(np.sum(along * moving, axis=1) / lengths)


def at(times: Array, values: Array, time: float) -> float:
    """A value at a time, s, between the samples or at one."""
    if not times[0] <= time <= times[-1]:
        raise RunFailed(f"the run ends at {times[-1]:g} s: it has nothing at {time:g} s")
    return float(_around(times, values, int(np.searchsorted(times, time)))(time))


def left_by_curve(settings: Settings, time: float) -> float:
    """What a curve through the samples leaves of a change that takes so many seconds, as a share of it.

    A polynomial through six samples, h apart, is off by h⁶ f⁽⁶⁾/720 times the product of the distances in samples,
    which is 17 at most. Its slope, and with it an instant of turning, is off by h⁵ f⁽⁶⁾ 5!/720 at most.
    """
    steps = settings.timestep * settings.sample_every / time
    return max(17 * steps**6, 120 * steps**5) / 720


def first_turn(times: Array, values: Array) -> tuple[float, float]:
    """When a value that grows at first turns back, s, and how large it is there."""
    falls = np.flatnonzero(np.diff(values) < 0)
    if not len(falls):
        raise RunFailed("the spring is still growing at the end: it does not turn back")
    return _extreme(times, values, int(falls[0]))


def last_beyond(times: Array, values: Array, limit: float) -> float:
    """When the size of a value is last above a limit, s; an error if it is so at the end."""
    outside = np.flatnonzero(np.abs(values) > limit)
    if not len(outside) or outside[-1] == len(values) - 1:
        raise RunFailed(f"the size is not within {limit:g} at the end, or always: there is no last time")
    place = int(outside[-1])
    side = np.sign(values[place])
    near = _around(times, side * values - limit, place + 1)
    return _root(near, float(times[place]), float(times[place + 1]))


def _extreme(times: Array, values: Array, place: int) -> tuple[float, float]:
    near = _around(times, values, place)
    low, high = float(times[max(place - 1, 0)]), float(times[min(place + 1, len(times) - 1)])
    time = _root(near.deriv(), low, high)
    return time, float(near(time))


def _around(times: Array, values: Array, place: int) -> Polynomial:
    first = max(0, min(place - _AROUND // 2, len(times) - _AROUND))
    part = slice(first, first + _AROUND)
    return Polynomial.fit(times[part], values[part], min(_AROUND, len(times)) - 1)


def _root(curve: Polynomial, low: float, high: float) -> float:
    """The real root in an interval, which a rounding error may put just outside."""
    found = curve.roots()
    real = found[np.abs(found.imag) < 1e-9 * (1 + np.abs(found.real))].real
    slack = high - low
    inside = real[(real >= low - slack) & (real <= high + slack)]
    if not len(inside):
        raise RunFailed("no root lies between the samples")
    return float(inside[np.argmin(np.abs(inside - (low + high) / 2))])


def _end(trajectory: Trajectory, name: str, point: tuple[float, float, float]) -> tuple[Array, Array]:
    """Place, m, and velocity, m/s, of an end of a spring at each sample, (n, 3)."""
    if not name:
        return np.broadcast_to(point, (len(trajectory.times), 3)), np.zeros((len(trajectory.times), 3))
    body = trajectory.scenario.index(name)
    turns = trajectory.orientations[:, body]
    arm = geometry.rotate(turns, np.broadcast_to(point, (len(turns), 3)))
    spin = np.cross(trajectory.angular_velocities[:, body], arm)
    return trajectory.position(name) + arm, trajectory.velocity(name) + spin


def turns(times: Array, values: Array) -> list[float]:
    """When a value turns from growing to falling, s, after its first fall; a start that falls is no turn."""
    grows = np.diff(values) > 0
    return [_extreme(times, values, int(place) + 1)[0] for place in np.flatnonzero(grows[:-1] & ~grows[1:])]
