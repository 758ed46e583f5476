"""Wind: sampled at the position, felt by the relative velocity (slide 30)."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from solutions.arrays import Array
from solutions.checks import real
from solutions.domain import NotNegative, Positive, Triple, domain, require


@domain
def wind_force(
    velocity: Triple,
    wind: Triple,
    area: NotNegative,
    drag_coefficient: NotNegative,
    density: NotNegative,
) -> Array:
    """Force of a wind on a body that is too fast for Stokes' drag (slide 30).

    Parameters
    ----------
    velocity : (..., 3), v, of the body, m/s
    wind : (..., 3), w, velocity of the wind, m/s
    area : (...), A, of the body as seen along the wind, m², not negative
    drag_coefficient : (...), C_D, without a unit, not negative
        It is about 0.47 for a ball, and 24/Re in a thick fluid, which is
        Stokes' drag.
    density : (...), ρ, of the air, kg/m³, not negative

    Returns
    -------
    (..., 3), N
        A body that drifts with the wind feels no force.

    Notes
    -----
    Air that the body brings to rest exerts the pressure ½ ρ ‖v − w‖² on it.
    The pressure times the area is a force, and the drag coefficient is the
    share of this force that a body of this shape feels. The force is against
    the velocity relative to the air:

        F = −½ ρ C_D A ‖v − w‖ (v − w)

    The slide counts wind among the forces that depend on the position. The
    field is sampled at the position, but its effect depends on the velocity
    v − w relative to the air.
    """
    relative = velocity - wind
    speed = np.linalg.norm(relative, axis=-1)
    per_velocity = density * drag_coefficient * area * speed / 2
    return -per_velocity[..., None] * relative


_CORNERS = np.array(list(np.ndindex(2, 2, 2)))
"""The eight corners of a cell, counted from its lowest."""


@domain
def sample_field(
    position: Triple, field: Field, origin: Triple, spacing: Positive
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
        Outside the grid the wind is that of the nearest point of the grid. A
        field that is linear in space is found exactly.

    Raises
    ------
    ValueError
        If a position is not a number.

    Notes
    -----
    Eight nodes surround a position. Along each axis the position is at some
    share s of the way from the lower node to the upper one, and these two
    weigh 1 − s and s. The weight of a node is the product of its three weights
    along the axes, and the wind is the sum of the winds at the nodes times
    these weights.
    """
    last = np.array(field.shape[:3]) - 1
    place = np.clip((position - origin) / spacing, 0, last)
    require(~np.isnan(place), "position must be a number, not nan")
    low = place.astype(int)
    share = (place - low)[..., None, :]
    weight = np.prod(np.where(_CORNERS == 1, share, 1 - share), axis=-1)
    # Beyond the last node, where the weight is 0, this node stands in.
    node = np.minimum(low[..., None, :] + _CORNERS, last)
    i, j, k = np.moveaxis(node, -1, 0)
    return np.sum(weight[..., None] * field[i, j, k], axis=-2)


def _grid(name: str, value: Any) -> Array:
    """The velocities at the nodes of a grid, (nx, ny, nz, 3)."""
    array = real(name, value)
    words = f"{name} must have shape (nx, ny, nz, 3), not {array.shape}"
    vectors = array.ndim == 4 and array.shape[-1] == 3
    require(vectors and array.size > 0, words)
    return array


Field = Annotated[Array, _grid]
"""(nx, ny, nz, 3), with a node along each axis at least."""
