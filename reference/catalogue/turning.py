"""Numbers of bodies that turn, taken from a trajectory: spin, slip at the contact, tilt."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.scenario import HalfSpace, Sphere
from reference.scene.trajectory import Trajectory

ROLLING_SLIP = 1e-3
"""A contact point slower than this does not slip, m/s."""


def slip(trajectory: Trajectory, body: str, plane: str) -> Array:
    """Speed along the plane of a sphere's lowest point at each sample, (n,), m/s: that of v + ω × (−r n)."""
    shape, normal = trajectory.scenario.body(body).shape, _normal(trajectory, plane)
    if not isinstance(shape, Sphere):
        raise RunFailed(f"{body} is a {type(shape).__name__}; only a sphere rolls")
    spin = trajectory.angular_velocity(body)
    point = trajectory.velocity(body) + np.cross(spin, -shape.radius * normal)
    return np.asarray(np.linalg.norm(point - (point @ normal)[:, None] * normal, axis=1))


def rolling_time(trajectory: Trajectory, body: str, plane: str) -> float:
    """Instant from which the body does not slip until the end, s; infinity if it still slips then.

    Friction takes slip away at a constant rate, so the line through the last two samples that slip says when it ends.
    """
    speeds, times = slip(trajectory, body, plane), trajectory.times
    slips = np.flatnonzero(speeds > ROLLING_SLIP)
    first = int(slips[-1]) + 1 if len(slips) else 0
    if first == len(times):
        return float("inf")
    if first < 2 or speeds[first - 1] >= speeds[first - 2]:
        return float(times[first])
    rate = (speeds[first - 2] - speeds[first - 1]) / (times[first - 1] - times[first - 2])
    return float(min(times[first - 1] + speeds[first - 1] / rate, times[first]))


def speed_along(trajectory: Trajectory, body: str, plane: str) -> float:
    """Speed along the plane at the end, m/s."""
    normal, velocity = _normal(trajectory, plane), trajectory.velocity(body)[-1]
    return float(np.linalg.norm(velocity - (velocity @ normal) * normal))


def surface_speed(trajectory: Trajectory, body: str) -> float:
    """R ω at the end, m/s, for a sphere."""
    shape = trajectory.scenario.body(body).shape
    assert isinstance(shape, Sphere)
    return float(np.linalg.norm(trajectory.angular_velocity(body)[-1]) * shape.radius)


def tilt(trajectory: Trajectory, body: str, plane: str) -> Array:
    """Angle between the plane's normal and the nearest axis of a box at each sample, (n,), rad: 0 on any face."""
    return np.asarray(np.arccos(np.clip(np.max(np.abs(_axes_up(trajectory, body, plane)), axis=1), 0.0, 1.0)))


def lean(trajectory: Trajectory, body: str, plane: str) -> Array:
    """Angle by which a body has turned away from how it first stood on the plane, at each sample, (n,), rad."""
    up = _axes_up(trajectory, body, plane)
    return np.asarray(np.arccos(np.clip(up @ up[0], -1.0, 1.0)))


def face_down(trajectory: Trajectory, body: str, plane: str) -> int:
    """The face that a box lies on at the end: 1, 2, 3 for the lower along its own x, y, z; negative for the upper."""
    up = _axes_up(trajectory, body, plane)[-1]
    axis = int(np.argmax(np.abs(up)))
    return (axis + 1) * (1 if up[axis] > 0 else -1)


def position_at(trajectory: Trajectory, body: str, time: float) -> Array:
    """Position at an instant, (3,), m, on the straight line between two samples."""
    positions = trajectory.position(body)
    return np.array([np.interp(time, trajectory.times, positions[:, axis]) for axis in range(3)])


def _axes_up(trajectory: Trajectory, body: str, plane: str) -> Array:
    """The plane's normal in the body's own frame, (n, 3)."""
    inverse = geometry.opposite(trajectory.orientation(body))
    return geometry.rotate(inverse, _normal(trajectory, plane))


def _normal(trajectory: Trajectory, plane: str) -> Array:
    shape = trajectory.scenario.body(plane).shape
    if not isinstance(shape, HalfSpace):
        raise RunFailed(f"{plane} is a {type(shape).__name__}, not a half-space")
    return np.array(shape.normal)
