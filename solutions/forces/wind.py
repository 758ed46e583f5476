"""Wind: a velocity field that acts through the relative velocity (slide 30).

The field is sampled at the position of the body.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import not_negative, positive, vector

_CORNERS = np.array(list(np.ndindex(2, 2, 2)))


def sample_field(
    position: ArrayLike,
    field: ArrayLike,
    origin: ArrayLike,
    spacing: ArrayLike,
) -> Array:
    """Velocity of the wind at a position, from the nodes of a grid (slide 30).

    Between the nodes it is linear along each axis.

    Parameters
    ----------
    position : (..., 3), m
    field : (nx, ny, nz, 3), wind at the nodes, m/s
        There is at least one node along each axis.
    origin : (3,), place of node (0, 0, 0), m
    spacing : (3,) or one number, from node to node, m, above zero

    Returns
    -------
    (..., 3), m/s
        Outside the grid the wind is that of the nearest point of the grid. A field that
        is linear in space is found exactly.

    Raises
    ------
    ValueError
        If field does not have the shape (nx, ny, nz, 3) with a node along each axis,
        spacing is not positive, or a position is not a number or does not have three
        components.

    Notes
    -----
    Eight nodes surround a position. Along each axis the position is at some share s of
    the way from the lower node to the upper one, and these two weigh 1 − s and s. The
    weight of a node is the product of its three weights along the axes, and the wind is
    the sum of the winds at the nodes times these weights.
    """
    values, x = np.asarray(field, dtype=float), vector("position", position)
    if values.ndim != 4 or values.shape[-1] != 3 or 0 in values.shape:
        raise ValueError(
            f"field must have shape (nx, ny, nz, 3), not {values.shape}"
        )
    last = np.array(values.shape[:3]) - 1
    place = np.clip(
        (x - vector("origin", origin)) / positive("spacing", spacing), 0, last
    )
    if np.any(np.isnan(place)):
        raise ValueError("position must be a number, not nan")
    # On the last node this is that node, and its neighbour has the weight 0.
    low = place.astype(int)
    share = (place - low)[..., None, :]
    weight = np.prod(
        np.where(_CORNERS == 1, share, 1 - share), axis=-1
    )  # (..., 8)
    node = np.minimum(low[..., None, :] + _CORNERS, last)
    return np.asarray(
        np.sum(
            weight[..., None]
            * values[node[..., 0], node[..., 1], node[..., 2]],
            axis=-2,
        )
    )


def wind_force(
    velocity: ArrayLike,
    wind: ArrayLike,
    area: ArrayLike,
    drag_coefficient: ArrayLike,
    density: ArrayLike,
) -> Array:
    """Force of a wind on a body that is too fast for Stokes' drag (slide 30).

    Parameters
    ----------
    velocity : (..., 3), v, of the body, m/s
    wind : (..., 3), w, velocity of the wind, m/s
    area : (...), A, of the body as seen along the wind, m², not negative
    drag_coefficient : (...), C_D, not negative
        It is about 0.47 for a ball, and 24/Re in a thick fluid, which is
        Stokes' drag.
    density : (...), ρ, of the air, kg/m³, not negative

    Returns
    -------
    (..., 3), N
        A body that drifts with the wind feels no force.

    Raises
    ------
    ValueError
        If area, drag_coefficient or density is negative, or a velocity does
        not have three components.

    Notes
    -----
    Air that the body brings to rest exerts the pressure ½ ρ ‖v − w‖² on it.
    The pressure times the area is a force, and the drag coefficient is the
    share of this force that a body of this shape feels. The force is against
    the velocity relative to the air:

        F = −½ ρ C_D A ‖v − w‖ (v − w)

    The slide counts wind among the forces that depend on the position. The
    field is sampled at the position, but its effect depends on the velocity v
    − w relative to the air.
    """
    relative = vector("velocity", velocity) - vector("wind", wind)
    size = not_negative("density", density) * not_negative(
        "drag_coefficient", drag_coefficient
    )
    speed = np.linalg.norm(relative, axis=-1)
    return np.asarray(
        -(size * not_negative("area", area) * speed / 2)[..., None] * relative
    )
