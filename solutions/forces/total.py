"""All forces of a scene on each of its bodies, added up (slide 30)."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np

from solutions.arrays import Array, Integers
from solutions.domain import NotNegative, Triple, domain, require
from solutions.forces.drag import stokes_drag
from solutions.forces.gravity import uniform_gravity
from solutions.forces.springs import spring_damper_force


@domain
def total_force(
    position: Triple,
    velocity: Triple,
    mass: NotNegative,
    radius: NotNegative,
    gravity: Triple,
    viscosity: NotNegative,
    fluid_velocity: Triple,
    ends: Ends,
    stiffness: NotNegative,
    rest_length: NotNegative,
    damping: NotNegative,
) -> Array:
    """Sum of all forces on each ball of a scene (slide 30).

    N balls have their weights, a fluid drags each of them, and S springs with
    dampers join pairs of them.

    Parameters
    ----------
    position, velocity : (N, 3), p and v, m, m/s
    mass : (N,), m, kg, not negative and finite
    radius : (N,), r, m, not negative
    gravity : (3,), g, m/s²
    viscosity : one number, η, of the fluid, Pa s, not negative
    fluid_velocity : (N, 3), u, at each ball, or (3,) everywhere, m/s
    ends : (S, 2), whole numbers, the two balls that each spring joins, from 0
        A ball may be at the end of any number of springs, or of none.
    stiffness : (S,), k, of each spring, N/m, not negative
    rest_length : (S,), L0, m, not negative
    damping : (S,), k_d, N s/m, not negative

    Returns
    -------
    (N, 3), on each ball, N
        Neither `buoyancy` nor `wind_force` is part of it.

    Raises
    ------
    ValueError
        If ends names a ball that does not exist.

    Notes
    -----
    Forces add. Each ball has its weight and the drag of the fluid:

        F = m g − 6πr η (v − u)

    where u is the velocity of the fluid. To this a spring adds the force of
    `spring_damper_force` on its first end, and the opposite force on its
    second end, by Newton's third law. So springs and dampers add nothing to
    the total momentum of a scene, and the sum over all balls is that of the
    weights and the drags alone.

    The springs are taken one after the other. `mesh_forces` of the lab on
    meshes takes them all at once, for which adding needs care.
    """
    last = len(position) - 1
    exist = (ends >= 0) & (ends <= last)
    require(
        exist, f"ends must name balls from 0 to {last}, not {ends.tolist()}"
    )
    weight = uniform_gravity(mass, gravity)
    force = weight + stokes_drag(velocity, fluid_velocity, viscosity, radius)
    first, second = ends.T
    pulls = spring_damper_force(
        position[first],
        position[second],
        velocity[first],
        velocity[second],
        stiffness,
        rest_length,
        damping,
    )
    for a, b, pull in zip(first, second, pulls, strict=True):
        force[a] = force[a] + pull
        force[b] = force[b] - pull
    return force


def _ends(name: str, value: Any) -> Integers:
    """Return pairs of numbers (S, 2); refuse other shapes."""
    array = np.asarray(value)
    words = f"{name} must have the shape (S, 2), not {array.shape}"
    require(array.ndim == 2 and array.shape[1] == 2, words)
    return array


Ends = Annotated[Integers, _ends]
"""(S, 2), the numbers of the two balls that each spring joins."""
