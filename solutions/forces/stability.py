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
    A step turns the position and the velocity into new ones by a matrix. Its
    trace T and its determinant D decide: the motion stays bounded as long as
    |T| ≤ 1 + D and D ≤ 1. With

        κ = k dt²/m
        γ = c dt/m

    the two Eulers have

        explicit         T = 2 − γ        D = 1 − γ + κ
        semi-implicit    T = 2 − γ − κ    D = 1 − γ

    Both have 1 + D − T = κ, so T ≤ 1 + D always holds, and −T ≤ 1 + D is left.
    For semi-implicit Euler this is κ + 2 γ ≤ 4, a quadratic in dt with the
    root

        dt = 4 m/(c + √(c² + 4 k m))

    It always has D ≤ 1. For explicit Euler both conditions count. The first,
    D ≤ 1, is dt ≤ c/k. The second, −T ≤ 1 + D, is 2 γ − κ ≤ 4. It decides
    where c² > 4 k m, when the motion does not swing:

        dt = c/k                        underdamped
        dt = 4 m/(c + √(c² − 4 k m))    overdamped
    """
    damping_squared = damping * damping
    critical_squared = 4 * stiffness * mass
    overdamped = damping_squared > critical_squared
    beyond = np.where(overdamped, damping_squared - critical_squared, 0.0)
    root = np.sqrt(beyond)
    explicit = np.where(
        overdamped, quotient(4 * mass, damping + root), damping / stiffness
    )
    semi_implicit_root = np.sqrt(damping_squared + critical_squared)
    semi_implicit = 4 * mass / (damping + semi_implicit_root)
    return explicit, semi_implicit
