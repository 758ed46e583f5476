"""Drag in a slow, thick flow, terminal velocity, and their limit (slides 26 and 30)."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, unit, vector

Array = NDArray[np.float64]
STOKES_LIMIT = 0.1
"""Reynolds number above which a `StokesRegimeWarning` is given.

The true drag on a sphere exceeds Stokes' drag by 1.8 % there, and by 13 % at 1.
"""


class StokesRegimeWarning(UserWarning):
    """The flow is too fast for the drag to be proportional to the velocity."""


def stokes_drag(
    velocity: ArrayLike,
    fluid_velocity: ArrayLike,
    viscosity: ArrayLike,
    shape_factor: ArrayLike,
    fluid_density: ArrayLike = 0.0,
) -> Array:
    """Drag of a thick fluid on a body that moves slowly through it (slide 26).

    The drag is proportional to the velocity of the body relative to the fluid. This
    holds only for a Reynolds number far below 1.

    Parameters
    ----------
    velocity : (..., 3), v, of the body, m/s
    fluid_velocity : (..., 3), u, of the fluid, m/s
    viscosity : (...), η, Pa s, not negative
    shape_factor : (...), K, m, not negative; 6πr for a sphere
    fluid_density : (...), kg/m³, not negative
        Where it is given, the function checks the Reynolds number of the sphere with
        the same K.

    Returns
    -------
    (..., 3), N

    Raises
    ------
    ValueError
        If viscosity, shape_factor or fluid_density is negative, a velocity does not
        have three components, or fluid_density is given and viscosity is zero.

    Warns
    -----
    StokesRegimeWarning
        Where that Reynolds number is above `STOKES_LIMIT`.

    Notes
    -----
    The drag is

        F = −K η (v − u)

    The slide writes −K n v. Its n is the viscosity η. Its v must be the velocity
    relative to the fluid, v − u; otherwise a body that drifts along with a river would
    be braked.
    """
    relative = vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity)
    k, eta = not_negative("shape_factor", shape_factor), not_negative("viscosity", viscosity)
    if np.any(np.asarray(fluid_density) != 0):
        check_stokes_regime(reynolds_number(velocity, fluid_velocity, k / (6 * np.pi), fluid_density, eta))
    return np.asarray(-(k * eta)[..., None] * relative)


def spheroid_drag(
    velocity: ArrayLike,
    fluid_velocity: ArrayLike,
    viscosity: ArrayLike,
    shape_factors: ArrayLike,
    axis: ArrayLike,
) -> Array:
    """Drag of a thick fluid on a spheroid that may point in any direction (slide 26).

    The slide says "shape". The spheroid's axis of symmetry need not be along its
    motion.

    Parameters
    ----------
    velocity : (..., 3), v, of the body, m/s
    fluid_velocity : (..., 3), u, of the fluid, m/s
    viscosity : (...), η, Pa s, not negative
    shape_factors : (..., 2), K_∥ along the axis and K_⊥ across it, m, not negative
        These are what `spheroid_shape_factors` returns.
    axis : (..., 3), d, the axis of symmetry, of unit length

    Returns
    -------
    (..., 3), N

    Raises
    ------
    ValueError
        If axis does not have length 1, viscosity or a shape factor is negative, or a
        velocity does not have three components.

    Notes
    -----
    Split the velocity relative to the fluid into a part along the axis and a part
    across it. Each part is resisted with its own shape factor:

        F = −η (K_∥ (w·d) d + K_⊥ (w − (w·d) d)),    w = v − u

    A slender body falls up to twice as fast lengthwise as broadside. If it falls
    aslant, it drifts to the side, because its K_∥ is smaller than its K_⊥.
    """
    d, k = unit("axis", axis), not_negative("shape_factors", shape_factors)
    relative = vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity)
    along = np.sum(relative * d, axis=-1)[..., None] * d
    resisted = k[..., 0, None] * along + k[..., 1, None] * (relative - along)
    return np.asarray(-not_negative("viscosity", viscosity)[..., None] * resisted)


def buoyancy(volume: ArrayLike, fluid_density: ArrayLike, gravity: ArrayLike) -> Array:
    """Lift by the fluid that a body displaces (slide 26).

    The slide leaves it out.

    Parameters
    ----------
    volume : (...), V, of the body, m³, not negative
    fluid_density : (...), ρ_f, kg/m³, not negative
    gravity : (..., 3), g, m/s²

    Returns
    -------
    (..., 3), N, against gravity

    Raises
    ------
    ValueError
        If volume or fluid_density is negative, or gravity does not have three
        components.

    Notes
    -----
    Imagine that the body is replaced by fluid at rest. The pressure around it is the
    same as before, and it carries the weight ρ_f V g of this fluid. So the pressure
    exerts the force

        F = −ρ_f V g

    on the fluid, and also on the body in its place.
    """
    displaced = not_negative("fluid_density", fluid_density) * not_negative("volume", volume)
    return np.asarray(-displaced[..., None] * vector("gravity", gravity))


def relaxation_time(
    mass: ArrayLike,
    shape_factor: ArrayLike,
    viscosity: ArrayLike,
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
        The fluid that moves along with the body, which is its added mass, is left out.

    Raises
    ------
    ValueError
        If an argument is not positive.

    Notes
    -----
    With drag alone, m dv/dt = −K η v. The velocity is then v0 e^(−t/τ) with

        τ = m/(K η)
    """
    return np.asarray(
        positive("mass", mass) / (positive("shape_factor", shape_factor) * positive("viscosity", viscosity))
    )


def terminal_velocity(
    radius: ArrayLike,
    density: ArrayLike,
    fluid_density: ArrayLike,
    viscosity: ArrayLike,
    gravity: ArrayLike,
) -> Array:
    """Velocity at which a sphere falls steadily through a fluid at rest (slide 26).

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
        It is along gravity for a sphere that is denser than the fluid, and against
        gravity for a lighter one: a bubble rises.

    Raises
    ------
    ValueError
        If radius or viscosity is not positive, a density is negative, or gravity does
        not have three components.

    Warns
    -----
    StokesRegimeWarning
        Where the Reynolds number of this fall is above `STOKES_LIMIT`.
        `terminal_velocity_corrected` still holds there.

    Notes
    -----
    In a steady fall the forces are in balance. The slide sets m g = 6πr η v, the weight
    equal to the drag, and forgets the buoyancy. With it, the weight of the sphere less
    that of the displaced fluid equals the drag:

        (4/3) πr³ (ρ_s − ρ_f) g = 6πr η v_t

    Dividing by 6πr η gives

        v_t = 2 (ρ_s − ρ_f) r² g/(9 η)
    """
    r, eta, rho = positive("radius", radius), positive("viscosity", viscosity), not_negative("density", density)
    excess = rho - not_negative("fluid_density", fluid_density)
    found = np.asarray((2 * excess * r**2 / (9 * eta))[..., None] * vector("gravity", gravity))
    check_stokes_regime(reynolds_number(found, np.zeros(3), r, fluid_density, eta))
    return found


def drag_motion(
    position: ArrayLike,
    velocity: ArrayLike,
    terminal: ArrayLike,
    relaxation: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after a time dt under constant forces and linear drag, exactly.

    Parameters
    ----------
    position : (..., 3), p0, m
    velocity : (..., 3), v0, m/s
    terminal : (..., 3), v_t, terminal velocity as seen from the ground, m/s
        In a wind, it is the velocity of the wind plus the terminal velocity relative to
        the wind.
    relaxation : (...), τ, s, above zero and finite
    dt : (...), t, s

    Returns
    -------
    position, velocity : (..., 3) each, m, m/s

    Raises
    ------
    ValueError
        If relaxation is not positive or not finite, or a vector does not have three
        components.

    Notes
    -----
    The difference between the velocity and the terminal velocity decays, because at v_t
    all forces are in balance and the drag is linear: dv/dt = −(v − v_t)/τ. The solution
    of this equation, and its integral over time, are

        v = v_t + (v0 − v_t) e^(−t/τ)
        p = p0 + v_t t + (v0 − v_t) τ (1 − e^(−t/τ))

    From rest this is a fall with the velocity v_t (1 − e^(−t/τ)).
    """
    p, v, last = vector("position", position), vector("velocity", velocity), vector("terminal", terminal)
    tau = finite("relaxation", positive("relaxation", relaxation))[..., None]
    time = np.asarray(dt, dtype=float)[..., None]
    lost = -np.expm1(-time / tau)
    return p + last * time + (v - last) * tau * lost, v + (last - v) * lost


def reynolds_number(
    velocity: ArrayLike,
    fluid_velocity: ArrayLike,
    radius: ArrayLike,
    fluid_density: ArrayLike,
    viscosity: ArrayLike,
) -> Array:
    """How far inertia outweighs viscosity in the flow around a sphere.

    Parameters
    ----------
    velocity : (..., 3), v, of the sphere, m/s
    fluid_velocity : (..., 3), u, of the fluid, m/s
    radius : (...), r, m, not negative
    fluid_density : (...), ρ_f, kg/m³, not negative
    viscosity : (...), η, Pa s, above zero

    Returns
    -------
    (...), Re, without a unit

    Raises
    ------
    ValueError
        If viscosity is not positive, radius or fluid_density is negative, or a velocity
        does not have three components.

    Notes
    -----
    The Reynolds number of a sphere is taken with its diameter 2 r and with its speed
    relative to the fluid:

        Re = 2 r ρ_f ‖v − u‖/η
    """
    speed = np.linalg.norm(vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity), axis=-1)
    rho, r = not_negative("fluid_density", fluid_density), not_negative("radius", radius)
    return np.asarray(2 * r * rho * speed / positive("viscosity", viscosity))


def check_stokes_regime(reynolds: ArrayLike) -> None:
    """Warn where the flow is too fast for Stokes' drag.

    There is one warning, and it names the largest Reynolds number.

    Parameters
    ----------
    reynolds : (...), of a sphere, not negative

    Raises
    ------
    ValueError
        If reynolds is negative.

    Warns
    -----
    StokesRegimeWarning
        Where reynolds is above `STOKES_LIMIT`.
    """
    largest = np.max(not_negative("reynolds", reynolds), initial=0.0)
    if largest > STOKES_LIMIT:
        text = f"Stokes' drag is 1.8 % too small at Re = 0.1 and 13 % at 1; here Re is {largest:.3g}"
        warnings.warn(text, StokesRegimeWarning, stacklevel=3)
