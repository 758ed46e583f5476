"""Wrong functions about impulses between rigid bodies, and a program to mend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import Contract, body, every, nonzero, not_negative, unit, vector
from reference.arrays import Array
from reference.errors import InvalidInput


def edge_edge_normal(edge_a: ArrayLike, edge_b: ArrayLike, centre_a: ArrayLike, centre_b: ArrayLike) -> Array:
    """Normal of two edges that cross."""
    across = np.cross(np.asarray(edge_a, dtype=float), np.asarray(edge_b, dtype=float))
    return np.asarray(across / np.linalg.norm(across))


def inverse_effective_mass(body_a: Any, body_b: Any, normal: ArrayLike) -> float:
    """Normal velocity that the points of contact gain from a unit impulse."""
    arm, inverse_inertia = np.asarray(body_a[2], dtype=float), np.asarray(body_a[4], dtype=float)
    n = np.asarray(normal, dtype=float)
    turned = np.cross(inverse_inertia @ np.cross(arm, n), arm)
    return float(body_a[3] + body_b[3] + n @ turned)


def world_inverse_inertia(inertia: ArrayLike, orientation: ArrayLike) -> Array:
    """Inverse inertia of a turned body, in the world frame."""
    w, x, y, z = np.asarray(orientation, dtype=float)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    moments = np.asarray(inertia, dtype=float)
    inverse = np.where(moments > 0, 1 / np.where(moments > 0, moments, 1.0), 0.0)
    return np.asarray(turn.T @ np.diag(inverse) @ turn)


def _bounces(program: Callable[..., Any]) -> str:
    """What is wrong with the momenta and velocities of a ball after each of three steps with a floor."""
    for mass, velocity in ((2.0, -3.0), (0.5, -4.0), (2.0, 1.0)):
        away, ball = abs(velocity), f"A ball of {mass:g} kg at {_signed(velocity)} m/s"
        found = [(float(p), float(v)) for p, v in program(mass, velocity)]
        if len(found) != 3:
            return f"{ball}: the program returned P and v after each of three steps, and yours after {len(found)}."
        for step, (p, v) in enumerate(found):
            said = f"{ball}: after step {step}, P = {_signed(p)} kg m/s and v = {_signed(v)} m/s."
            if abs(p - mass * v) > NEAR:
                return f"{said} Such a P and such a v do not belong to one ball of {mass:g} kg."
            if abs(v - away) > NEAR:
                return f"{said} It should be on its way up at {_signed(away)} m/s."
    return ""


def _signed(value: float) -> str:
    return f"{value + 0.0:+.4g}".replace("-", "−")


NEAR = 1e-6
"""A mended program may differ from the right numbers by so much."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"momenta": _bounces}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
PARALLEL = 1e-9
"""The sine of the angle between two edges below which they count as parallel."""


def _not_parallel(edge_a: Array, edge_b: Array, *_: Any) -> None:
    a, b = (edge / np.max(np.abs(edge)) for edge in (edge_a, edge_b))
    if np.linalg.norm(np.cross(a, b)) <= PARALLEL * np.linalg.norm(a) * np.linalg.norm(b):
        raise InvalidInput(
            f"edge_a {edge_a.tolist()} and edge_b {edge_b.tolist()} are parallel: they have no single normal"
        )


SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "crates": (
        "edge_edge_normal",
        edge_edge_normal,
        Contract(
            {"edge_a": nonzero, "edge_b": nonzero, "centre_a": vector, "centre_b": vector}, together=_not_parallel
        ),
    ),
    "hammer": (
        "inverse_effective_mass",
        inverse_effective_mass,
        Contract({"body_a": body, "body_b": body, "normal": unit()}),
    ),
    "aircraft": (
        "world_inverse_inertia",
        world_inverse_inertia,
        Contract({"inertia": every(not_negative, vector), "orientation": unit(4)}),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
