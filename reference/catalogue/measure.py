"""Numbers taken from a trajectory, in the same way for every engine.

Bounces are read from flight parabolas, not from samples: two neighbouring samples in free flight and the known
gravity fix the parabola s(t) = s_i + w (t − t_i) − g_n (t − t_i)(t − t_{i+1})/2, w = (s_{i+1} − s_i)/(t_{i+1} − t_i).
The samples of a semi-implicit Euler flight lie on such a parabola just as those of the exact flight do, so the apex
and the instant of impact are those of the flight itself, however coarse the samples.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.arrays import Array, Mask
from reference.errors import RunFailed
from reference.scene import geometry
from reference.scene.trajectory import Trajectory

FLIGHT_TOLERANCE = 0.1
"""How far, as a share of gravity, the acceleration between two samples may differ from gravity for these to count as
free flight. Wide enough for an engine's built-in drag (PyBullet's default takes 2 % at 5 m/s), and far below what an
impact does to it: a rebound at speed v changes the mean acceleration of a 1 ms sample by v/(0.001 s), which is below
a tenth of gravity only for v < 1 mm/s."""
ROUNDING = 1e-9
"""A gap smaller than this is rounding, m."""
REST_SPEED = 1e-3
"""A body slower than this, m/s, counts as at rest."""


@dataclass(frozen=True)
class Flight:
    """One free flight above a plane. Times in s; heights of the gap in m; speeds along the normal in m/s.

    The launch and landing are where the parabola cuts the surface, gap zero; the first flight may begin in mid-air.
    """

    launch_time: float
    landing_time: float
    apex_time: float
    apex_height: float
    launch_speed: float
    landing_speed: float


def separation(trajectory: Trajectory, body: str, plane: str) -> Array:
    """Signed gap between a body and a half-space at each sample, (n,), m."""
    index = trajectory.scenario.index(body)
    positions, orientations = trajectory.positions[:, index], trajectory.orientations[:, index]
    return geometry.separation(trajectory.scenario, body, plane, positions, orientations)


def flights(trajectory: Trajectory, body: str, plane: str) -> list[Flight]:
    """The free flights of a body above a plane, in order of time. A flight needs two samples in free fall."""
    gravity = -_normal_gravity(trajectory, plane)
    gap, times = separation(trajectory, body, plane), trajectory.times
    normal_velocity = trajectory.velocity(body) @ _normal(trajectory, plane)
    free = np.abs(np.diff(normal_velocity) / np.diff(times) + gravity) < FLIGHT_TOLERANCE * gravity
    edges = np.flatnonzero(np.diff(np.concatenate(([False], free, [False])).astype(int)))
    found = []
    for start, stop in zip(edges[::2], edges[1::2], strict=True):
        flight = _flight(times[start : stop + 1], gap[start : stop + 1], gravity)
        if flight is not None:
            found.append(flight)
    return found


def _flight(times: Array, gap: Array, gravity: float) -> Flight | None:
    """Read one flight from its samples; None where the parabola stays below the surface."""
    slopes, middles = np.diff(gap) / np.diff(times), (times[1:] + times[:-1]) / 2
    apex_times = middles + slopes / gravity  # each pair of samples names the apex of its own parabola
    heights = _parabola_height(times, gap, slopes, gravity, apex_times)
    top = int(np.argmin(np.abs(apex_times - middles)))  # the pair nearest to the apex knows it best
    if min(heights[0], heights[-1], heights[top]) <= 0:
        return None
    up, down = (float(np.sqrt(2 * heights[pair] / gravity)) for pair in (0, -1))
    return Flight(
        float(apex_times[0]) - up,
        float(apex_times[-1]) + down,
        float(apex_times[top]),
        float(heights[top]),
        gravity * up,
        gravity * down,
    )


def _parabola_height(times: Array, gap: Array, slopes: Array, gravity: float, at: Array) -> Array:
    before, after = at - times[:-1], at - times[1:]
    return np.asarray(gap[:-1] + slopes * before - gravity * before * after / 2)


def apex_heights(trajectory: Trajectory, body: str, plane: str) -> Array:
    """Highest gap of each flight after the first impact, m; empty if the body never left the plane again."""
    return np.array([flight.apex_height for flight in flights(trajectory, body, plane)[1:]])


def first_apex(trajectory: Trajectory, body: str, plane: str) -> float:
    """Height of the first rebound, m; 0 if the body did not rebound. A body that never came down is an error."""
    apexes = apex_heights(trajectory, body, plane)
    if len(apexes):
        return float(apexes[0])
    if np.min(separation(trajectory, body, plane)) > _fallen(trajectory, body, plane):
        raise RunFailed(f"{body} never reached {plane}: there is no rebound to measure")
    return 0.0


def _fallen(trajectory: Trajectory, body: str, plane: str) -> float:
    """A tenth of the initial gap, m: closer than this, the body has come down."""
    return 0.1 * float(separation(trajectory, body, plane)[0])


def impact_times(trajectory: Trajectory, body: str, plane: str) -> Array:
    """Instants at which a flight ends on the plane, s."""
    end = trajectory.times[-1]
    landings = np.array([flight.landing_time for flight in flights(trajectory, body, plane)])
    return np.asarray(landings[landings <= end])


def rest_time(trajectory: Trajectory, body: str, speed: float = REST_SPEED) -> float:
    """When the body comes to rest for good, s; infinity if it has not by the end.

    An event-driven implementation solves for this instant and reports it; a body that moves afterwards, down a slope or
    along a floor, does not rest. For all others it is the first sample of the final stretch in which the body stays
    slower than `speed`, m/s.
    """
    times = trajectory.times
    moving = np.flatnonzero(np.linalg.norm(trajectory.velocity(body), axis=1) > speed)
    last_moving = float(times[moving[-1]]) if len(moving) else -np.inf
    for event in trajectory.events:
        if event.kind in ("rest", "stop") and event.body == body and event.time >= last_moving:
            return event.time
    later = times[times > last_moving]
    return float(later[0]) if len(later) else float("inf")


def rest_height(trajectory: Trajectory, body: str, plane: str) -> float:
    """Gap at the end, m: 0 for a body that rests exactly on the plane, negative when it has sunk in."""
    return float(separation(trajectory, body, plane)[-1])


def residual_speed(trajectory: Trajectory, body: str, window: float) -> float:
    """Largest speed in the last `window` seconds, m/s."""
    return float(np.max(np.linalg.norm(trajectory.velocity(body)[_last(trajectory, window)], axis=1)))


def drift(trajectory: Trajectory, body: str, window: float) -> float:
    """Largest distance from where the body was when the last `window` seconds began, m."""
    late = trajectory.position(body)[_last(trajectory, window)]
    return float(np.max(np.linalg.norm(late - late[0], axis=1)))


def at_end(trajectory: Trajectory, body: str) -> tuple[Array, Array]:
    """Position, m, and velocity, m/s, of a body at the end of its scenario, (3,) each.

    Where the timestep does not divide the duration, the last sample lies later, by less than a sample. There the body
    moves on the cubic through the places and velocities of the last two: exact where the force grows evenly.
    """
    times, place, velocity = trajectory.times[-2:], trajectory.position(body)[-2:], trajectory.velocity(body)[-2:]
    interval = float(times[1] - times[0])
    s = (trajectory.scenario.duration - float(times[0])) / interval
    if abs(s - 1) < ROUNDING:
        return place[1], velocity[1]
    slope, (first, last) = (place[1] - place[0]) / interval, velocity
    moved = s * first + s**2 * (3 * slope - 2 * first - last) + s**3 * (first + last - 2 * slope)
    speed = first + 2 * s * (3 * slope - 2 * first - last) + 3 * s**2 * (first + last - 2 * slope)
    return place[0] + interval * moved, speed


def displacement(trajectory: Trajectory, body: str) -> float:
    """Distance between the start and the end of the scenario, m."""
    return float(np.linalg.norm(at_end(trajectory, body)[0] - trajectory.position(body)[0]))


def stopping_distance(trajectory: Trajectory, body: str, plane: str) -> float:
    """Distance along the plane from the start to the final position, m; an error if the body still moves."""
    if rest_time(trajectory, body) == float("inf"):
        raise RunFailed(f"{body} still moves at the end: it has no stopping distance")
    normal, positions = _normal(trajectory, plane), trajectory.position(body)
    way = positions[-1] - positions[0]
    return float(np.linalg.norm(way - (way @ normal) * normal))


def deepest_penetration(trajectory: Trajectory, body: str, plane: str) -> float:
    """Largest overlap with the plane at any sample, m; 0 if there was none."""
    return float(max(0.0, -np.min(separation(trajectory, body, plane))))


def energy(trajectory: Trajectory, body: str) -> Array:
    """Kinetic plus potential energy of a body at each sample, (n,), J; potential zero at the origin."""
    entry = trajectory.scenario.body(body)
    index = trajectory.scenario.index(body)
    velocity, position = trajectory.velocities[:, index], trajectory.positions[:, index]
    spin = _into_body(trajectory.orientations[:, index], trajectory.angular_velocities[:, index])
    if entry.immovable:
        raise RunFailed(f"{body} is immovable: it has no energy to measure")
    inertia = np.array(entry.moments_of_inertia())
    translation = entry.mass * np.sum(velocity**2, axis=1) / 2
    potential = -entry.mass * position @ np.array(trajectory.scenario.gravity)
    return np.asarray(translation + np.sum(inertia * spin**2, axis=1) / 2 + potential)


def momentum(trajectory: Trajectory) -> Array:
    """Total linear momentum of all movable bodies at each sample, (n, 3), kg m/s."""
    masses = np.array([0.0 if body.immovable else body.mass for body in trajectory.scenario.bodies])
    return np.asarray(np.einsum("b,nbi->ni", masses, trajectory.velocities))


def _into_body(orientation: Array, vector: Array) -> Array:
    """World vectors (n, 3) in the body's frame."""
    return geometry.rotate(geometry.opposite(orientation), vector)


def _last(trajectory: Trajectory, window: float) -> Mask:
    """Which samples lie in the last `window` seconds; one on the edge counts in spite of rounding."""
    return np.asarray(trajectory.times >= trajectory.times[-1] - window * (1 + 1e-9))


def _normal(trajectory: Trajectory, plane: str) -> Array:
    return np.array(trajectory.scenario.body(plane).shape.normal)  # type: ignore[union-attr]


def _normal_gravity(trajectory: Trajectory, plane: str) -> float:
    return float(_normal(trajectory, plane) @ np.array(trajectory.scenario.gravity))
