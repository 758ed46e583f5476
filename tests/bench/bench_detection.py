"""How long detection and response take: a million impacts of points on planes, and continuous tests against a wall."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from labs.benching.timing import Bench
from solutions.detection import overlap_interval, signed_distance, time_of_impact_exact
from solutions.response import bounce_along_normal, kinematic_response

COUNT = 1_000_000
GRAVITY = np.array([0.0, 0.0, -9.81])
RESTITUTION = 0.7


def _points() -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Points above one slanted plane, on their way down: position, velocity, normal, offset."""
    rng = np.random.default_rng(1)
    normal = np.array([0.36, 0.48, 0.8])
    along = rng.normal(size=(COUNT, 3))
    along -= (along @ normal)[:, None] * normal
    position = along + rng.uniform(0.1, 2, size=(COUNT, 1)) * normal
    velocity = rng.normal(size=(COUNT, 3)) - 4 * normal
    return position, velocity, normal, 0.5


def ours() -> Callable[[], object]:
    """Distance, exact time, velocity on arrival, response."""
    position, velocity, normal, offset = _points()

    def call() -> object:
        separation = signed_distance(position, normal, offset)
        time = time_of_impact_exact(separation, velocity @ normal, GRAVITY @ normal)
        return time, kinematic_response(velocity + GRAVITY * time[:, None], normal, RESTITUTION)

    return call


def plain_python() -> Callable[[], object]:
    """The same, point after point, with the floats and the square root of the standard library."""
    position, velocity, normal, offset = _points()
    p, v, (a, b, c), (gx, gy, gz) = position.tolist(), velocity.tolist(), normal.tolist(), GRAVITY.tolist()
    pull = a * gx + b * gy + c * gz

    def call() -> object:
        found = []
        for (x, y, z), (vx, vy, vz) in zip(p, v, strict=True):
            s, u = a * x + b * y + c * z + offset, a * vx + b * vy + c * vz
            root = math.sqrt(u * u - 2 * pull * s)
            time = (u + root) / -pull if u >= 0 else 2 * s / (root - u)
            push = (1 + RESTITUTION) * root
            after = (vx + gx * time + push * a, vy + gy * time + push * b, vz + gz * time + push * c)
            found.append((time, after))
        return found

    return call


def pymunk_rays() -> Callable[[], object]:
    """Rays of pymunk against a segment, straight and in the plane, the time alone; a tenth of the points, ten times."""
    import pymunk  # noqa: PLC0415 - a rival that may be missing

    position, velocity, normal, offset = _points()
    height, speed = signed_distance(position, normal, offset)[: COUNT // 10], (velocity @ normal)[: COUNT // 10]
    space = pymunk.Space()
    floor = pymunk.Segment(space.static_body, (-9, 0), (9, 0), 0)
    floor.cache_bb()
    ways = [((0.0, s), (0.0, s + u)) for s, u in zip(height.tolist(), speed.tolist(), strict=True)]

    def call() -> object:
        return [floor.segment_query(start, end, 0) for _ in range(10) for start, end in ways]

    return call


def many_bounces() -> Callable[[], object]:
    """Ten thousand balls through ten seconds of bounces in one call, a third of them to rest."""
    rng = np.random.default_rng(2)
    height, e = rng.uniform(0.1, 2, size=10_000), rng.uniform(0.3, 0.98, size=10_000)
    return lambda: bounce_along_normal(height, 0.0, -9.81, e, 10.0)


def continuous_test() -> Callable[[], object]:
    """A million balls against a wall over a step."""
    rng = np.random.default_rng(3)
    x, u = rng.uniform(-1, 1, size=(2, COUNT))
    return lambda: overlap_interval(x, 20 * u, 0.02, 0.01, 0.01)


BENCHES = (
    Bench(
        "point-plane",
        "a million points: distance from a plane, exact time of impact under gravity, velocity after",
        ours,
        {"plain Python": plain_python, "pymunk, straight rays": pymunk_rays},
        0.5,
    ),
    Bench("ball-wall-interval", "a million balls: when within a step they overlap a wall", continuous_test, {}, 0.2),
    Bench(
        "many-bounces", "ten thousand balls: ten seconds of bounces, to rest or not, in one step", many_bounces, {}, 2
    ),
)
