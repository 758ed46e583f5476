"""Wrong functions about a world of bodies, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import (
    Contract,
    every,
    matrix,
    not_negative_diagonal,
    number,
    one_or_each,
    positive,
    several,
    share,
    unit,
    vector,
    whole,
)
from reference.arrays import Array
from reference.errors import InvalidInput


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
        for step, mine in enumerate(found):
            if gap <= 0 and rate < 0:
                rate = -e * rate if -rate > 0.1 else 0.0
            fall = 9.81 * dt
            rate = max(rate - fall, 0.0) if gap <= 0 and rate == 0 else rate - fall
            gap += rate * dt
            if abs(mine - gap) > NEAR:
                return (
                    f"Dropped from {height:g} m with e = {e:g}, the ball should be at {1e3 * gap:.3f} mm after"
                    f" {step + 1} steps, and your program says {1e3 * mine:.3f} mm."
                ).replace("-", "−")
    return ""


NEAR = 1e-6
"""A mended program may differ from the right height by so much, m."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"bouncer": _dropped}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
SWEEPS, IMPACTS = 1000, 10_000
"""How often an input may go through the contacts of a crane, and through the wagons of a row: more changes nothing."""


def _as_many(name: str, value: Any, count: int) -> None:
    if np.ndim(value) and len(value) != count:
        raise InvalidInput(f"{name} must be one number or {count}, not {len(value)}")


def _crane(matrix: Array, offset: Array, sweeps: int, start: Any = 0.0) -> None:
    if matrix.shape != (len(offset), len(offset)):
        raise InvalidInput(f"matrix must have {len(offset)} rows of {len(offset)} numbers, as offset has {len(offset)}")
    not_negative_diagonal("matrix", matrix)
    _as_many("start", start, len(offset))


def _row(velocity: Array, mass: Any, restitution: Any, most: int = IMPACTS) -> None:
    _as_many("mass", mass, len(velocity))
    _as_many("restitution", restitution, len(velocity) - 1)


SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "crane": (
        "solve_by_sweeps",
        solve_by_sweeps,
        Contract(
            {"matrix": matrix, "offset": several(2, 4), "sweeps": whole(SWEEPS), "start": one_or_each(number)},
            optional=1,
            together=_crane,
        ),
    ),
    "wagons": (
        "propagate_impacts",
        propagate_impacts,
        Contract(
            {
                "velocity": several(3, 5),
                "mass": one_or_each(positive),
                "restitution": one_or_each(share),
                "most": whole(IMPACTS),
            },
            optional=1,
            together=_row,
        ),
    ),
    "satellite": (
        "rotate_by_momentum",
        rotate_by_momentum,
        Contract(
            {"orientation": unit(4), "angular_velocity": vector, "moments": every(positive, vector), "dt": number}
        ),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
