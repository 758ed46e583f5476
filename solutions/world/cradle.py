"""Several impacts at once, as in Newton's cradle (slide 22).

The result depends on whether the impacts follow one another or happen
together.
"""

from __future__ import annotations

from typing import Annotated

import numpy as np

from solutions.arrays import Array
from solutions.checks import finite, with_shape
from solutions.domain import Positive, Share, domain, require
from solutions.world.complementarity import solve_by_pivots

AlongARow = Annotated[Array, with_shape(..., "n"), finite]
"""(..., n), finite, one number for each ball of a row."""


@domain
def propagate_impacts(
    velocity: AlongARow,
    mass: Positive,
    restitution: Share,
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
    most : sweeps at most, a number
        With e < 1 the impacts may continue for ever, ever weaker.

    Returns
    -------
    (..., n), m/s

    Raises
    ------
    ValueError
        If two neighbours are immovable, or the shapes do not fit.

    Notes
    -----
    Two neighbours that approach get the impulse of one impact, with the
    shares w = 1/M:

        j = (1 + e) (v_left − v_right)/(w_left + w_right)

    Five equal elastic balls of which the first moves at speed 1 end with
    (0, 0, 0, 0, 1). This is what a cradle does whose balls barely touch.
    """
    v = velocity.copy()
    w, e = _row(mass, restitution, v.shape[-1])
    for _ in range(most):
        before = v.copy()
        for i in range(len(e)):
            approach = np.maximum(0.0, v[..., i] - v[..., i + 1])
            j = (1 + e[i]) * approach / (w[i] + w[i + 1])
            v[..., i] -= j * w[i]
            v[..., i + 1] += j * w[i + 1]
        # No two balls approach by more than rounding any longer.
        if np.array_equal(v, before):
            break
    return v


@domain
def simultaneous_impacts(
    velocity: AlongARow, mass: Positive, restitution: Share
) -> Array:
    """Velocities of a row of touching balls when all pairs collide at once.

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

    With u = G v and the shares w = 1/M, the impulses change it by
    G diag(w) Gᵀ j. This is a linear complementarity problem for them.

    Five equal elastic balls of which the first moves at speed 1 end with
    (−0.6, 0.4, 0.4, 0.4, 0.4).

    The impact keeps the momentum, but it may create energy. With e = 1,
    (1, 0, 0.1) becomes (−0.3, 0.7, 0.7): the right pair, which would have
    parted, is thrown together and pushed without restitution.
    """
    w, e = _row(mass, restitution, velocity.shape[-1])
    # An impulse pushes the left ball of a pair back and the right one on.
    g = np.diff(np.eye(len(w)), axis=0)
    u = np.matvec(g, velocity)
    j = solve_by_pivots((g * w) @ g.T, u + e * np.minimum(u, 0.0))
    return velocity + w * np.matvec(g.T, j)


def _row(mass: Array, restitution: Array, count: int) -> tuple[Array, Array]:
    """Inverse masses (n,) and restitutions (n − 1,) of a row of n balls."""
    w = np.broadcast_to(1 / mass, count)
    require(
        w[:-1] + w[1:] > 0,
        "mass must be finite for one of two neighbours, not inf for both",
    )
    return w, np.broadcast_to(restitution, max(count - 1, 0))
