"""Several impacts at once, as in Newton's cradle (slide 22).

The result depends on whether the impacts follow one another or happen
together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, in_unit_interval, positive
from solutions.world.complementarity import solve_by_pivots


def propagate_impacts(
    velocity: ArrayLike,
    mass: ArrayLike,
    restitution: ArrayLike,
    most: int = 10_000,
) -> Array:
    """Velocities of a row of touching balls after impacts of two at a time.

    The pairs are resolved one after another from the left, and again from the
    left, until no two balls approach.

    Parameters
    ----------
    velocity : (..., n), to the right, m/s
    mass : (n,) or one number, kg
    restitution : (n − 1,) or one number, e, 0 to 1
    most : sweeps at most
        With e < 1 the impacts may continue for ever, ever weaker.

    Returns
    -------
    (..., n), m/s

    Raises
    ------
    ValueError
        If a mass is not positive, two neighbours are immovable, e is not from
        0 to 1, a velocity is not finite, or the shapes do not fit.

    Notes
    -----
    Five equal elastic balls of which the first moves at speed 1 end with (0,
    0, 0, 0, 1). This is what a cradle does whose balls barely touch.
    """
    v, share, e = _row(velocity, mass, restitution)
    v = v.copy()
    for _ in range(most):
        before = v.copy()
        for i in range(len(e)):
            j = (
                (1 + e[i])
                * np.maximum(0.0, v[..., i] - v[..., i + 1])
                / (share[i] + share[i + 1])
            )
            v[..., i] -= j * share[i]
            v[..., i + 1] += j * share[i + 1]
        if np.array_equal(
            v, before
        ):  # no two balls approach by more than rounding
            break
    return v


def simultaneous_impacts(
    velocity: ArrayLike,
    mass: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """Velocities of a row of touching balls after one impact of all pairs at once.

    Newton's rule of restitution holds for every pair of neighbours together.

    Parameters
    ----------
    velocity : (..., n), to the right, m/s
    mass : (n,) or one number, kg
    restitution : (n − 1,) or one number, e, 0 to 1

    Returns
    -------
    (..., n), m/s

    Raises
    ------
    ValueError
        As propagate_impacts, or if two immovable bodies come together with
        balls between them.

    Notes
    -----
    With the velocity u at which a pair parts, positive when it moves apart,
    and the impulse j of the pair, Newton's rule is

        u⁺ ≥ −e min(u, 0),    j ≥ 0,    and one of them with equality

    This is a linear complementarity problem for the impulses j. Five equal
    elastic balls of which the first moves at speed 1 end with (−0.6, 0.4, 0.4,
    0.4, 0.4).

    The impact keeps the momentum, but it may create energy. With e = 1, (1, 0,
    0.1) becomes (−0.3, 0.7, 0.7): the right pair, which would have parted, is
    thrown together and pushed without restitution.
    """
    v, share, e = _row(velocity, mass, restitution)
    # u = apart v. An impulse pushes the left ball back and the right one on.
    apart = np.diff(np.eye(len(share)), axis=0)
    u = np.matvec(apart, v)
    j = solve_by_pivots((apart * share) @ apart.T, u + e * np.minimum(u, 0.0))
    return np.asarray(v + share * np.matvec(apart.T, j))


def _row(
    velocity: ArrayLike, mass: ArrayLike, restitution: ArrayLike
) -> tuple[Array, Array, Array]:
    """Velocities (..., n), inverse masses (n,) and restitutions (n − 1,) of a row.

    Refuses what cannot be a row of balls.
    """
    v = finite("velocity", velocity)
    if v.ndim == 0:
        raise ValueError("velocity must have shape (..., n), not ()")
    count = v.shape[-1]
    share = np.broadcast_to(1 / positive("mass", mass), count)
    if np.any(share[:-1] + share[1:] == 0):
        raise ValueError(
            "mass must be finite for one of two neighbours, not inf for both"
        )
    return (
        v,
        share,
        np.broadcast_to(
            in_unit_interval("restitution", restitution), max(count - 1, 0)
        ),
    )
