"""Wind: a velocity field that is sampled at a position and acts through the relative velocity (slide 30)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import not_negative, positive, vector

Array = NDArray[np.float64]
_CORNERS = np.array(list(np.ndindex(2, 2, 2)))


def sample_field(position: ArrayLike, field: ArrayLike, origin: ArrayLike, spacing: ArrayLike) -> Array:
    """Velocity of the wind at a position, linear between the nodes of a grid (slide 30).

    Outside the grid the wind is that of its nearest point. A field that is linear in space is found exactly.

    Parameters
    ----------
    position : (..., 3), m
    field : (nx, ny, nz, 3), wind at the nodes, m/s, at least one node along each axis
    origin : (3,), place of node (0, 0, 0), m
    spacing : (3,) or one number, from node to node, m

    Returns
    -------
    (..., 3), m/s
    """
    values, x = np.asarray(field, dtype=float), vector("position", position)
    if values.ndim != 4 or values.shape[-1] != 3 or 0 in values.shape:
        raise ValueError(f"field must have shape (nx, ny, nz, 3), not {values.shape}")
    last = np.array(values.shape[:3]) - 1
    place = np.clip((x - vector("origin", origin)) / positive("spacing", spacing), 0, last)
    if np.any(np.isnan(place)):
        raise ValueError("position must be a number, not nan")
    low = place.astype(int)  # on the last node it is that node, whose neighbour weighs nothing
    share = (place - low)[..., None, :]
    weight = np.prod(np.where(_CORNERS == 1, share, 1 - share), axis=-1)  # (..., 8)
    node = np.minimum(low[..., None, :] + _CORNERS, last)
    return np.asarray(np.sum(weight[..., None] * values[node[..., 0], node[..., 1], node[..., 2]], axis=-2))


def wind_force(
    velocity: ArrayLike, wind: ArrayLike, area: ArrayLike, drag_coefficient: ArrayLike, density: ArrayLike
) -> Array:
    """Force of a wind on a body too fast for Stokes: F = −½ ρ C_D A ‖v − w‖ (v − w) (slide 30).

    The slide counts wind among the forces that hang on the position. The field is sampled there, but what it does hangs
    on the velocity v − w: a body that drifts with the wind feels none.

    Parameters
    ----------
    velocity, wind : (..., 3), v and w, m/s
    area : (...), A, of the body seen along the wind, m²
    drag_coefficient : (...), C_D: about 0.47 for a ball, 24/Re in a thick fluid, which is Stokes' drag
    density : (...), ρ, of the air, kg/m³

    Returns
    -------
    (..., 3), N
    """
    relative = vector("velocity", velocity) - vector("wind", wind)
    size = not_negative("density", density) * not_negative("drag_coefficient", drag_coefficient)
    speed = np.linalg.norm(relative, axis=-1)
    return np.asarray(-(size * not_negative("area", area) * speed / 2)[..., None] * relative)
