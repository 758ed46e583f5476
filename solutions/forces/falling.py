"""A fall through a fluid: the motion and the terminal velocity (slide 26)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from solutions.arrays import Array
from solutions.domain import (
    FinitePositive,
    NotNegative,
    Number,
    Positive,
    Triple,
    domain,
    require,
)
from solutions.forces.correlations import LARGEST_REYNOLDS, drag_correction
from solutions.forces.reynolds import check_stokes_regime, reynolds_number
from solutions.vectors import quotient


@domain
def terminal_velocity(
    radius: Positive,
    density: NotNegative,
    fluid_density: NotNegative,
    viscosity: Positive,
    gravity: Triple,
) -> Array:
    """Velocity of a sphere that falls steadily through a fluid (slide 26).

    The fluid is at rest.

    Parameters
    ----------
    radius : (...), r, m, above zero
    density : (...), ρ_s, of the sphere, kg/m³, not negative
    fluid_density : (...), ρ_f, kg/m³, not negative
    viscosity : (...), η, Pa s, above zero
    gravity : (..., 3), g, m/s²

    Returns
    -------
    (..., 3), m/s, relative to the fluid
        It is along gravity for a sphere that is denser than the fluid, and
        against gravity for a lighter one: a bubble rises.

    Warns
    -----
    StokesRegimeWarning
        Where the Reynolds number of this fall is above `STOKES_LIMIT`.
        `terminal_velocity_corrected` still holds there.

    Notes
    -----
    In a steady fall the forces are in balance. The slide sets m g = 6πr η v,
    the weight equal to the drag, and forgets the buoyancy. With it, the weight
    of the sphere less that of the displaced fluid equals the drag:

        (4/3) πr³ (ρ_s − ρ_f) g = 6πr η v_t

    Dividing by 6πr η gives

        v_t = 2 (ρ_s − ρ_f) r² g/(9 η)
    """
    excess = density - fluid_density
    velocity = (2 * excess * radius**2 / (9 * viscosity))[..., None] * gravity
    check_stokes_regime(
        reynolds_number(
            velocity, np.zeros(3), radius, fluid_density, viscosity
        )
    )
    return velocity


@domain
def relaxation_time(
    mass: Positive, shape_factor: Positive, viscosity: Positive
) -> Array:
    """Time in which drag takes away all but 1/e of a velocity.

    Parameters
    ----------
    mass : (...), m, kg, above zero
    shape_factor : (...), K, m, above zero
    viscosity : (...), η, Pa s, above zero

    Returns
    -------
    (...), τ, s
        The fluid that moves along with the body, which is its added mass, is
        left out.

    Notes
    -----
    With drag alone, m dv/dt = −K η v. The velocity is then v0 e^(−t/τ) with

        τ = m/(K η)
    """
    return mass / (shape_factor * viscosity)


@domain
def drag_motion(
    position: Triple,
    velocity: Triple,
    terminal: Triple,
    relaxation: FinitePositive,
    dt: Number,
) -> tuple[Array, Array]:
    """State after a time dt under constant forces and linear drag, exactly.

    Parameters
    ----------
    position : (..., 3), p0, m
    velocity : (..., 3), v0, m/s
    terminal : (..., 3), v_t, terminal velocity as seen from the ground, m/s
        In a wind, it is the velocity of the wind plus the terminal velocity
        relative to the wind.
    relaxation : (...), τ, s, above zero and finite
    dt : (...), t, s

    Returns
    -------
    position, velocity : (..., 3) each, m, m/s

    Notes
    -----
    At the velocity v_t all forces are in balance, and the drag is linear. So
    the difference between the velocity and v_t decays:

        dv/dt = −(v − v_t)/τ

    The solution of this equation, and its integral over time, are

        x = t/τ
        v = v0 + (v_t − v0)(1 − e^(−x))
        p = p0 + v0 τ (1 − e^(−x)) + v_t τ (x − 1 + e^(−x))

    From rest this is a fall with the velocity v_t (1 − e^(−x)). Where there is
    next to no drag, v_t and τ are both very large, and x is very small. The
    last bracket is then a tiny difference of numbers near 1, so the function
    sums it as a power series where x is small.
    """
    tau = relaxation[..., None]
    x = dt[..., None] / tau
    lost = -np.expm1(-x)  # 1 − e^(−x)
    behind = terminal * tau * _falling_behind(x)
    p = position + velocity * tau * lost + behind
    v = velocity + (terminal - velocity) * lost
    return p, v


@domain
def terminal_velocity_corrected(
    radius: Positive,
    density: NotNegative,
    fluid_density: NotNegative,
    viscosity: Positive,
    gravity: Triple,
    correction: Callable[[Array], Array] = drag_correction,
) -> Array:
    """Velocity of steady fall of a sphere with its measured drag.

    It holds also where Stokes' law does not.

    Parameters
    ----------
    radius : (...), r, m, above zero
    density : (...), ρ_s, of the sphere, kg/m³, not negative
    fluid_density : (...), ρ_f, kg/m³, not negative
    viscosity : (...), η, Pa s, above zero
    gravity : (..., 3), g, m/s²
    correction : function φ of the Reynolds number (...), without a unit
        It returns the true drag over Stokes' drag, more than half of it.

    Returns
    -------
    (..., 3), m/s, relative to the fluid
        It is along gravity for a sphere that is denser than the fluid, and
        against gravity for a lighter one.

    Raises
    ------
    ValueError
        If the fall is faster than the correction is known for.

    Notes
    -----
    Stokes' law predicts a fall with some Reynolds number S. In a steady fall
    the drag equals the weight less the buoyancy, so the true drag is Stokes'
    drag at S. The true drag at the Reynolds number Re is φ(Re) times Stokes'
    drag at Re, and Stokes' drag is proportional to Re. Therefore

        Re φ(Re) = S

    The left side grows with Re. A fit may put φ a little below 1 in a slow
    flow, so the search begins with Re between 0 and 2 S. Halving this interval
    sixty times finds Re to the last digit but one.
    """
    excess = density - fluid_density
    stokes = (2 * excess * radius**2 / (9 * viscosity))[..., None] * gravity
    speed = np.linalg.norm(stokes, axis=-1)
    target = 2 * radius * fluid_density * speed / viscosity
    low = np.zeros_like(target)
    high = np.minimum(2 * target, LARGEST_REYNOLDS)
    words = "the fall is too fast: its Reynolds number is above"
    known = high * correction(high) >= target
    require(known, f"{words} {LARGEST_REYNOLDS:g}")
    for _ in range(60):
        middle = (low + high) / 2
        slower = middle * correction(middle) < target
        low = np.where(slower, middle, low)
        high = np.where(slower, high, middle)
    return stokes * quotient(high, target, 1.0)[..., None]


def _falling_behind(x: Array) -> Array:
    """Return x − 1 + e^(−x), with all its digits."""
    small = np.where(np.abs(x) < 0.5, x, 0.0)
    series = np.zeros_like(small)
    for k in range(16, 1, -1):
        series = (1 - small * series) / k
    return np.where(np.abs(x) < 0.5, small * small * series, x + np.expm1(-x))
