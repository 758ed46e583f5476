"""Largest stable steps of both Eulers for a damped spring (slides 29, 30)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import FiniteNotNegative, FinitePositive, domain
from solutions.vectors import quotient


@domain
def spring_step_limit(
    stiffness: FinitePositive,
    mass: FinitePositive,
    damping: FiniteNotNegative,
) -> tuple[Array, Array]:
    """Largest stable steps of both Eulers for a mass on a damped spring.

    Both take the forces of the spring and of the damper as they are at the
    start of the step. Beyond its limit the motion grows without end.

    Parameters
    ----------
    stiffness : (...), k, of the spring, N/m, above zero and finite
    mass : (...), m, kg, above zero and finite
    damping : (...), c, of the damper, N s/m, not negative and finite

    Returns
    -------
    explicit, semi_implicit : (...) each, s
        The limit of explicit Euler is 0 without a damper.

    Notes
    -----
    A step makes new numbers of the position and the velocity by a matrix. Its
    trace T and its determinant D decide: the motion stays bounded as long as
    |T| ≤ 1 + D and D ≤ 1. With K = k dt²/m and C = c dt/m, both Eulers have
    the trace 2 − C or less:

        explicit         T = 2 − C        D = 1 − C + K
        semi-implicit    T = 2 − C − K    D = 1 − C

    For semi-implicit Euler the condition −T ≤ 1 + D is K + 2 C ≤ 4. This is a
    quadratic in dt, with the root

        dt = 4 m/(c + √(c² + 4 k m))

    For explicit Euler there are two conditions. The first, D ≤ 1, is
    dt ≤ c/k. The second, −T ≤ 1 + D, is 2 C − K ≤ 4. It decides where
    c² > 4 k m, when the motion does not swing:

        dt = c/k                        underdamped
        dt = 4 m/(c + √(c² − 4 k m))    overdamped
    """
    squared = damping * damping
    critical = 4 * stiffness * mass
    overdamped = squared > critical
    root = np.sqrt(np.where(overdamped, squared - critical, 0.0))
    explicit = np.where(
        overdamped, quotient(4 * mass, damping + root), damping / stiffness
    )
    semi_implicit = 4 * mass / (damping + np.sqrt(squared + critical))
    return explicit, semi_implicit
