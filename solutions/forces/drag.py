"""Drag in a slow, thick flow: the force, the shape, the terminal velocity, and where it ends (slides 26 and 30)."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

from solutions.checks import finite, not_negative, positive, unit, vector

Array = NDArray[np.float64]
STOKES_LIMIT = 0.1
"""Reynolds number above which a `StokesRegimeWarning` is given. The true drag on a sphere exceeds Stokes by 1.8 % there
and by 13 % at 1."""


class StokesRegimeWarning(UserWarning):
    """The flow is too fast for the drag to be proportional to the velocity."""


def stokes_drag(
    velocity: ArrayLike,
    fluid_velocity: ArrayLike,
    viscosity: ArrayLike,
    shape_factor: ArrayLike,
    fluid_density: ArrayLike = 0.0,
) -> Array:
    """Drag of a thick fluid on a body: F = −K η (v − u) (slide 26).

    The slide writes −K n v: its n is the viscosity η, and its v must be relative to the fluid, or a body that drifts
    along with a river would be braked. It holds for Re ≪ 1 alone.

    Parameters
    ----------
    velocity, fluid_velocity : (..., 3), v and u, m/s
    viscosity : (...), η, Pa s
    shape_factor : (...), K, m: 6πr for a sphere
    fluid_density : (...), kg/m³; where it is given, the Reynolds number of the sphere with the same K is checked

    Returns
    -------
    (..., 3), N

    Warns
    -----
    StokesRegimeWarning
        Where that Reynolds number is above `STOKES_LIMIT`.
    """
    relative = vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity)
    k, eta = not_negative("shape_factor", shape_factor), not_negative("viscosity", viscosity)
    if np.any(np.asarray(fluid_density) != 0):
        check_stokes_regime(reynolds_number(velocity, fluid_velocity, k / (6 * np.pi), fluid_density, eta))
    return np.asarray(-(k * eta)[..., None] * relative)


def spheroid_drag(
    velocity: ArrayLike, fluid_velocity: ArrayLike, viscosity: ArrayLike, shape_factors: ArrayLike, axis: ArrayLike
) -> Array:
    """Drag of a thick fluid on a spheroid, which needs not point against its motion (slide 26: "shape").

        F = −η (K_∥ (w·d) d + K_⊥ (w − (w·d) d)),    w = v − u

    A slender body falls up to twice as fast lengthwise as broadside, and aslant it drifts to the side.

    Parameters
    ----------
    velocity, fluid_velocity : (..., 3), m/s
    viscosity : (...), η, Pa s
    shape_factors : (..., 2), K_∥ along the axis and K_⊥ across it, m, as `spheroid_shape_factors` gives them
    axis : (..., 3), d, unit, of symmetry

    Returns
    -------
    (..., 3), N
    """
    d, k = unit("axis", axis), not_negative("shape_factors", shape_factors)
    relative = vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity)
    along = np.sum(relative * d, axis=-1)[..., None] * d
    resisted = k[..., 0, None] * along + k[..., 1, None] * (relative - along)
    return np.asarray(-not_negative("viscosity", viscosity)[..., None] * resisted)


def buoyancy(volume: ArrayLike, fluid_density: ArrayLike, gravity: ArrayLike) -> Array:
    """Lift by the fluid that a body displaces: F = −ρ_f V g; the slide leaves it out (slide 26).

    Parameters
    ----------
    volume : (...), V, m³
    fluid_density : (...), ρ_f, kg/m³
    gravity : (..., 3), m/s²

    Returns
    -------
    (..., 3), N
    """
    displaced = not_negative("fluid_density", fluid_density) * not_negative("volume", volume)
    return np.asarray(-displaced[..., None] * vector("gravity", gravity))


def relaxation_time(mass: ArrayLike, shape_factor: ArrayLike, viscosity: ArrayLike) -> Array:
    """Time in which drag takes away all but 1/e of a velocity: τ = m/(K η).

    The fluid that moves along with the body (added mass) is left out.

    Parameters
    ----------
    mass : (...), kg
    shape_factor : (...), K, m
    viscosity : (...), η, Pa s

    Returns
    -------
    (...), s
    """
    return np.asarray(
        positive("mass", mass) / (positive("shape_factor", shape_factor) * positive("viscosity", viscosity))
    )


def terminal_velocity(
    radius: ArrayLike, density: ArrayLike, fluid_density: ArrayLike, viscosity: ArrayLike, gravity: ArrayLike
) -> Array:
    """Velocity at which a sphere falls steadily through a fluid at rest (slide 26).

    The slide sets m g = 6πr η v and forgets the buoyancy. With it,

        v_t = 2 (ρ_s − ρ_f) r² g/(9 η)

    along gravity for a heavy sphere, against it for a light one: a bubble rises.

    Parameters
    ----------
    radius : (...), r, m
    density, fluid_density : (...), ρ_s and ρ_f, kg/m³
    viscosity : (...), η, Pa s
    gravity : (..., 3), m/s²

    Returns
    -------
    (..., 3), m/s, relative to the fluid

    Warns
    -----
    StokesRegimeWarning
        Where the Reynolds number of this fall is above `STOKES_LIMIT`: `terminal_velocity_corrected` knows more.
    """
    r, eta, rho = positive("radius", radius), positive("viscosity", viscosity), not_negative("density", density)
    excess = rho - not_negative("fluid_density", fluid_density)
    found = np.asarray((2 * excess * r**2 / (9 * eta))[..., None] * vector("gravity", gravity))
    check_stokes_regime(reynolds_number(found, np.zeros(3), r, fluid_density, eta))
    return found


def drag_motion(
    position: ArrayLike, velocity: ArrayLike, terminal: ArrayLike, relaxation: ArrayLike, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after a time dt under constant forces and linear drag, exactly.

        v = v_t + (v0 − v_t) e^(−t/τ),    p = p0 + v_t t + (v0 − v_t) τ (1 − e^(−t/τ))

    From rest this is the fall v_t (1 − e^(−t/τ)). In a wind, v_t is the wind's velocity plus the one relative to it.

    Parameters
    ----------
    position, velocity : (..., 3), m, m/s
    terminal : (..., 3), v_t, m/s, seen from the ground
    relaxation : (...), τ, s, finite
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, last = vector("position", position), vector("velocity", velocity), vector("terminal", terminal)
    tau = finite("relaxation", positive("relaxation", relaxation))[..., None]
    time = np.asarray(dt, dtype=float)[..., None]
    lost = -np.expm1(-time / tau)
    return p + last * time + (v - last) * tau * lost, v + (last - v) * lost


def reynolds_number(
    velocity: ArrayLike, fluid_velocity: ArrayLike, radius: ArrayLike, fluid_density: ArrayLike, viscosity: ArrayLike
) -> Array:
    """How far inertia outweighs viscosity in the flow around a sphere: Re = 2 r ρ_f ‖v − u‖/η.

    Parameters
    ----------
    velocity, fluid_velocity : (..., 3), m/s
    radius : (...), m
    fluid_density : (...), kg/m³
    viscosity : (...), Pa s, above zero

    Returns
    -------
    (...)
    """
    speed = np.linalg.norm(vector("velocity", velocity) - vector("fluid_velocity", fluid_velocity), axis=-1)
    rho, r = not_negative("fluid_density", fluid_density), not_negative("radius", radius)
    return np.asarray(2 * r * rho * speed / positive("viscosity", viscosity))


def check_stokes_regime(reynolds: ArrayLike) -> None:
    """Warn where the flow is too fast for Stokes' drag, once, with the largest Reynolds number.

    Parameters
    ----------
    reynolds : (...), of a sphere, not negative

    Warns
    -----
    StokesRegimeWarning
        Where it is above `STOKES_LIMIT`.
    """
    largest = np.max(not_negative("reynolds", reynolds), initial=0.0)
    if largest > STOKES_LIMIT:
        text = f"Stokes' drag is 1.8 % too small at Re = 0.1 and 13 % at 1; here Re is {largest:.3g}"
        warnings.warn(text, StokesRegimeWarning, stacklevel=3)
