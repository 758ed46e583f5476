"""Wrong functions about impulses between rigid bodies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from reference.arrays import Array


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


SUSPECTS: dict[str, tuple[str, Callable[..., Any], tuple[int, ...]]] = {
    "crates": ("edge_edge_normal", edge_edge_normal, (3,)),
    "hammer": ("inverse_effective_mass", inverse_effective_mass, ()),
    "aircraft": ("world_inverse_inertia", world_inverse_inertia, (3, 3)),
}
"""Key → the function that it should be, the wrong one, and the shape of one result."""
