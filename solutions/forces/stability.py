"""Largest stable steps of both Eulers for a damped spring (slides 29 and 30)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, not_negative, positive


def spring_step_limit(
    stiffness: ArrayLike,
    mass: ArrayLike,
    damping: ArrayLike,
) -> tuple[Array, Array]:
    """Largest stable steps of both Eulers for a mass on a damped spring.

    Both take the forces of the spring and of the damper as they are at the
    start of the step. Beyond its limit the motion grows without end.

    Parameters
    ----------
    stiffness : (...), k, of the spring, N/m, above zero
    mass : (...), m, kg, above zero
    damping : (...), c, of the damper, N s/m, not negative

    Returns
    -------
    explicit, semi_implicit : (...) each, s
        The limit of explicit Euler is 0 without a damper.

    Raises
    ------
    ValueError
        If stiffness or mass is not positive and finite, or damping is negative
        or not finite.

    Notes
    -----
    A step makes new numbers of the position and the velocity by a matrix. Its
    trace T and its determinant D decide: the motion stays bounded as long as
    ‖T‖ ≤ 1 + D and D ≤ 1. With K = k dt²/m and C = c dt/m, both Eulers have
    the trace 2 − C or less:

        explicit         T = 2 − C        D = 1 − C + K
        semi-implicit    T = 2 − C − K    D = 1 − C

    For semi-implicit Euler the condition −T ≤ 1 + D is K + 2 C ≤ 4. This is a
    quadratic in dt, with the root

        dt = 4 m/(c + √(c² + 4 k m))

    For explicit Euler there are two conditions. D ≤ 1 is dt ≤ c/k, and −T ≤ 1
    + D is 2 C − K ≤ 4. The second decides where c² > 4 k m, when the motion
    does not swing:

        dt = c/k underdamped,    dt = 4 m/(c + √(c² − 4 k m)) overdamped
    """
    k, m = (
        finite("stiffness", positive("stiffness", stiffness)),
        finite("mass", positive("mass", mass)),
    )
    c = finite("damping", not_negative("damping", damping))
    squared, critical = c * c, 4 * k * m
    overdamped = squared > critical
    root = np.sqrt(np.where(overdamped, squared - critical, 0.0))
    explicit = np.where(
        overdamped, 4 * m / np.where(overdamped, c + root, 1.0), c / k
    )
    return explicit, np.asarray(4 * m / (c + np.sqrt(squared + critical)))
