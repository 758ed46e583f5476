"""Wrong functions about a world of bodies, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from reference.arrays import Array


def solve_by_sweeps(matrix: ArrayLike, offset: ArrayLike, sweeps: int, start: ArrayLike = 0.0) -> Array:
    """Forces at the feet of a crane."""
    a, b = np.asarray(matrix, dtype=float), np.asarray(offset, dtype=float)
    f = np.array(np.broadcast_to(start, b.shape), dtype=float)
    for _ in range(sweeps):
        for i in range(len(b)):
            f[i] += max(0.0, -(a[i] @ f + b[i]) / a[i, i])
    return f


def propagate_impacts(velocity: ArrayLike, mass: ArrayLike, restitution: ArrayLike, most: int = 1) -> Array:
    """Velocities of wagons that are shunted."""
    v = np.array(velocity, dtype=float)
    share = np.broadcast_to(1 / np.asarray(mass, dtype=float), v.shape[-1:])
    e = np.broadcast_to(restitution, (max(len(share) - 1, 0),))
    for i in range(len(e)):
        j = (1 + e[i]) * np.maximum(0.0, v[..., i] - v[..., i + 1]) / (share[i] + share[i + 1])
        v[..., i] -= j * share[i]
        v[..., i + 1] += j * share[i + 1]
    return v


def rotate_by_momentum(
    orientation: ArrayLike, angular_velocity: ArrayLike, moments: ArrayLike, dt: float
) -> tuple[Array, Array]:
    """How a satellite tumbles."""
    q, w = np.asarray(orientation, dtype=float), np.asarray(angular_velocity, dtype=float)
    angle = float(np.linalg.norm(w) * dt)
    half = w * dt * (np.sin(angle / 2) / angle if angle else 0.5)
    s, u = np.cos(angle / 2), half
    after = np.array([s * q[0] - u @ q[1:], *(s * q[1:] + q[0] * u + np.cross(u, q[1:]))])
    return after, w


def _dropped(program: Callable[..., Any]) -> str:
    """What is wrong with the heights of a ball that bounces and comes to rest, with its steps of 1/240 s."""
    for height, e in ((1.0, 0.5), (0.3, 0.8), (2.0, 0.0)):
        gap, rate, dt = height, 0.0, 1 / 240
        found = np.asarray(program(height, e, 480), dtype=float)
        if found.shape != (480,):
            return f"It must return 480 heights, not something of the shape {found.shape}."
        for number, mine in enumerate(found):
            if gap <= 0 and rate < 0:
                rate = -e * rate if -rate > 0.1 else 0.0
            fall = 9.81 * dt
            rate = max(rate - fall, 0.0) if gap <= 0 and rate == 0 else rate - fall
            gap += rate * dt
            if abs(mine - gap) > NEAR:
                return (
                    f"Dropped from {height:g} m with e = {e:g}, the ball should be at {1e3 * gap:.3f} mm after"
                    f" {number + 1} steps, and your program says {1e3 * mine:.3f} mm."
                ).replace("-", "−")
    return ""


NEAR = 1e-6
"""A mended program may differ from the right height by so much, m."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"bouncer": _dropped}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
SUSPECTS: dict[str, tuple[Any, ...]] = {
    "crane": ("solve_by_sweeps", solve_by_sweeps, (2,), (3,), (4,)),
    "wagons": ("propagate_impacts", propagate_impacts, (3,), (4,), (5,)),
    "satellite": ("rotate_by_momentum", rotate_by_momentum, (4,), (3,)),
}
"""Key → the function that it should be, the wrong one, and the shapes that a result may have."""
