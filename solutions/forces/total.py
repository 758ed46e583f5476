"""All forces of a scene on each of its bodies, added up (slide 30)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.arrays import Array
from solutions.checks import vector
from solutions.forces.drag import stokes_drag
from solutions.forces.gravity import uniform_gravity
from solutions.forces.springs import spring_damper_force


def total_force(
    position: ArrayLike,
    velocity: ArrayLike,
    mass: ArrayLike,
    radius: ArrayLike,
    gravity: ArrayLike,
    viscosity: ArrayLike,
    fluid_velocity: ArrayLike,
    ends: NDArray[np.intp],
    stiffness: ArrayLike,
    rest_length: ArrayLike,
    damping: ArrayLike,
) -> Array:
    """Sum of all forces on each ball of a scene (slide 30).

    N balls have their weights, a fluid drags each of them, and S springs with
    dampers join pairs of them.

    Parameters
    ----------
    position, velocity : (N, 3), m, m/s
    mass, radius : (N,), kg, m
    gravity : (3,), g, m/s²
    viscosity : one number, η, of the fluid, Pa s
    fluid_velocity : (N, 3), of the fluid at each ball, or (3,) everywhere, m/s
    ends : (S, 2), whole numbers, the two balls that each spring joins, from 0
        A ball may be at the end of any number of springs, or of none.
    stiffness : (S,), k, of each spring, N/m
    rest_length : (S,), L0, m
    damping : (S,), k_d, N s/m

    Returns
    -------
    (N, 3), on each ball, N
        The fluid has no buoyancy here.

    Raises
    ------
    ValueError
        If ends does not have the shape (S, 2) or names a ball that there is
        not, or as `stokes_drag`, `spring_damper_force` and `uniform_gravity`.

    Notes
    -----
    Forces add. Each ball has its weight and the drag of the fluid. A spring
    pulls its first end with the force F of `spring_damper_force`, and its
    second end with −F, by Newton's third law. So springs and dampers add
    nothing to the total momentum of a scene, and the sum over all balls is
    that of the weights and the drags alone.

    The springs are taken one after the other. `mesh_forces` of the lab on
    meshes takes them all at once, for which adding needs care.
    """
    x, v, pairs = (
        vector("position", position),
        vector("velocity", velocity),
        np.asarray(ends),
    )
    if (
        pairs.ndim != 2
        or pairs.shape[-1] != 2
        or np.any(pairs < 0)
        or np.any(pairs >= len(x))
    ):
        raise ValueError(
            f"ends must have the shape (S, 2) and whole numbers from 0 to {len(x) - 1}, not {pairs}"
        )
    first, second = pairs[:, 0], pairs[:, 1]
    pulls = spring_damper_force(
        x[first],
        x[second],
        v[first],
        v[second],
        stiffness,
        rest_length,
        damping,
    )
    force = uniform_gravity(mass, gravity) + stokes_drag(
        v, fluid_velocity, viscosity, radius
    )
    for a, b, pull in zip(first, second, pulls, strict=True):
        force[a] = force[a] + pull
        force[b] = force[b] - pull
    return force
