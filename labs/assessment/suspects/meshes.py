"""Wrong functions about spring meshes, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labs.assessment.contracts import Contract, array, as_floats, mesh, pairs, refuse_other_nodes, rows
from reference.arrays import Array
from reference.errors import InvalidInput

GRAVITY = 9.81
NEAR = 3.0
"""A mended program may differ from the right height by what the lamp moves in so many steps at the speed of one, m."""


def mesh_forces(mesh: Any, position: Any, velocity: Any) -> Array:
    """Forces of the strings of a marionette."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    force = np.zeros_like(p)
    for (i, j), rest, stiffness, damping in zip(*mesh[:4], strict=True):
        way = p[j] - p[i]
        length = np.sqrt(way @ way)
        if length > 0:
            u = way / length
            pull = max(0.0, stiffness * (length - rest)) + damping * ((v[j] - v[i]) @ u)
            force[i] += pull * u
            force[j] -= pull * u
    return force


def diagonals(position: Any, edges: Any, candidates: Any) -> NDArray[np.bool_]:
    """Bars of a scaffold, as many as the count asks for."""
    missing = 3 * len(position) - 6 - len(edges)
    return np.asarray(np.arange(len(candidates)) < missing)


def timestep_bound(mesh: Any) -> float:
    """A safe step of a game, which takes the most stiffness of any node and the smallest mass of any node."""
    edges, _, *springs, mass, pinned = (np.asarray(each) for each in mesh)
    free = ~pinned.astype(bool)
    least = np.min(mass[free], initial=np.inf)
    k, c = (2 * np.max(np.bincount(edges.ravel(), np.repeat(each, 2), len(mass))[free], initial=0.0) / least
            for each in springs)  # fmt: skip
    below = c + np.sqrt(c * c + 4 * k)
    return float(4 / below) if below > 0 else float("inf")


def _falls_from_rest(program: Callable[..., Any]) -> str:
    """What is wrong with a lamp that hangs on a cord, which is cut after a while."""
    for length, held, dt in ((1.0, 2.0, 0.001), (0.5, 5.0, 0.002), (2.0, 0.1, 0.001)):
        after = 0.25
        found = float(program(length, held, after, dt))
        lowest = min(0.1 * length, GRAVITY * held**2 / 2)
        speed = 0.0 if lowest < GRAVITY * held**2 / 2 else GRAVITY * held
        needed = -length - lowest - speed * after - GRAVITY * after**2 / 2
        allowed = NEAR * GRAVITY * dt * (held + after)
        if not abs(found - needed) <= allowed:
            return (
                f"A cord of {length:g} m that is cut after {held:g} s: a quarter of a second later the lamp should be"
                f" at {needed:.2f} m, and your program says {found:.2f} m."
            ).replace("-", "−")
    return ""


MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"lamp": _falls_from_rest}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
CANDIDATES = 2
"""Bars of which a scaffold may need one or both."""


def _of_two_nodes(name: str, value: Any) -> Any:
    found = mesh(name, value)
    if len(found.mass) != 2:
        raise InvalidInput(f"{name} must have 2 nodes, not {len(found.mass)}")
    return found


def _bars_between_nodes(position: Array, edges: Any, candidates: Any) -> None:
    refuse_other_nodes("edges", edges, len(position))
    refuse_other_nodes("candidates", candidates, len(position))
    if len(candidates) != CANDIDATES:
        raise InvalidInput(f"candidates must be {CANDIDATES} bars, not {len(candidates)}")


SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "marionette": (
        "mesh_forces",
        mesh_forces,
        Contract({"mesh": _of_two_nodes, "position": as_floats(array(2, 3)), "velocity": as_floats(array(2, 3))}),
    ),
    "scaffold": (
        "diagonals",
        diagonals,
        Contract({"position": rows(3), "edges": pairs, "candidates": pairs}, together=_bars_between_nodes),
    ),
    "game": ("timestep_bound", timestep_bound, Contract({"mesh": mesh})),
}
"""Key → the function that it should be, the wrong one, and what both take."""
