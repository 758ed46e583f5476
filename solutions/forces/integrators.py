"""Integrators: from accelerations to motion, and the largest step that each can take (slide 30)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Acceleration = ArrayLike | Callable[[Array, Array], ArrayLike]
"""A constant acceleration (..., 3), m/s², or a function of position and velocity that returns it."""
_MOST_ITERATIONS = 30
_CONVERGED = 1e-12
"""Change of an iteration, over the size of the velocities, below which Newton's method is done."""


def ballistic_motion(
    position: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after a time dt of constant acceleration, exactly: p + v dt + a dt²/2 and v + a dt.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    return p + v * time + a * time**2 / 2, v + a * time


def explicit_euler(
    position: ArrayLike, velocity: ArrayLike, acceleration: Acceleration, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after one step of p' = p + v dt, v' = v + a dt: everything as it was at the start of the step.

    First order. An undamped spring gains energy in every step, however short.

    Parameters
    ----------
    position, velocity : (..., 3), m, m/s
    acceleration : (..., 3), m/s², or a function of position and velocity
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    return p + v * time, v + a * time


def semi_implicit_euler(
    position: ArrayLike, velocity: ArrayLike, acceleration: Acceleration, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after one step of the integrator that most engines use: v' = v + a dt, then p' = p + v' dt.

    First order, and symplectic: the energy of an undamped spring swings about a constant and does not drift.

    Parameters
    ----------
    position, velocity : (..., 3), m, m/s
    acceleration : (..., 3), m/s², or a function of position and velocity
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    after = v + a * time
    return p + after * time, after


def velocity_verlet(
    position: ArrayLike, velocity: ArrayLike, acceleration: Acceleration, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after one step of p' = p + v dt + a dt²/2, v' = v + (a + a') dt/2, with a' at the end of the step.

    Second order, and symplectic where a depends on the position alone. Where it depends on the velocity too, a' is
    taken at p' and at the velocity v + a dt that is foreseen.

    Parameters
    ----------
    position, velocity : (..., 3), m, m/s
    acceleration : (..., 3), m/s², or a function of position and velocity
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    after = p + v * time + a * time**2 / 2
    return after, v + (a + _at(acceleration, after, v + a * time)) * time / 2


def runge_kutta_4(
    position: ArrayLike, velocity: ArrayLike, acceleration: Acceleration, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after one step of the classical Runge–Kutta method: four accelerations, weighted 1 : 2 : 2 : 1.

    Fourth order, not symplectic: an undamped spring very slowly loses energy.

    Parameters
    ----------
    position, velocity : (..., 3), m, m/s
    acceleration : (..., 3), m/s², or a function of position and velocity
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each
    """
    p, v, a1, time = _state(position, velocity, acceleration, dt)
    v2 = v + a1 * time / 2
    a2 = _at(acceleration, p + v * time / 2, v2)
    v3 = v + a2 * time / 2
    a3 = _at(acceleration, p + v2 * time / 2, v3)
    v4 = v + a3 * time
    a4 = _at(acceleration, p + v3 * time, v4)
    return p + (v + 2 * v2 + 2 * v3 + v4) * time / 6, v + (a1 + 2 * a2 + 2 * a3 + a4) * time / 6


def implicit_euler(
    position: ArrayLike, velocity: ArrayLike, acceleration: Acceleration, dt: ArrayLike
) -> tuple[Array, Array]:
    """State after one step of v' = v + a(p', v') dt, p' = p + v' dt: everything as it will be at the end of the step.

    First order, stable for any step, and it damps what it cannot follow. The velocity v' is found by Newton's method
    with the derivatives taken by differences; for springs and dampers that are linear one iteration does it.

    Parameters
    ----------
    position, velocity : (..., n), m, m/s. What lies along the last axis may hang together: 3 for bodies that do not
        know of each other, 3 N, all in a row, for N bodies in a mesh
    acceleration : (..., n), m/s², or a function of position and velocity, each (..., n)
    dt : (...), s

    Returns
    -------
    position, velocity : (..., n) each

    Raises
    ------
    ArithmeticError
        If thirty iterations do not settle: the step is too long for the force.
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)

    def change(after: Array) -> Array:
        return np.asarray(_at(acceleration, p + after * time, after) * time)

    after = v + a * time
    for _ in range(_MOST_ITERATIONS):
        wrong = after - v - change(after)
        correction = np.linalg.solve(_jacobian(change, after), wrong[..., None])[..., 0]
        after = after - correction
        if np.max(np.abs(correction), initial=0.0) <= _CONVERGED * np.max(np.abs(after), initial=0.0):
            return p + after * time, after
    raise ArithmeticError(f"implicit Euler found no velocity in {_MOST_ITERATIONS} iterations: shorten dt")


def _jacobian(change: Callable[[Array], Array], velocity: Array) -> Array:
    """Derivatives (..., n, n) of v' − change(v') by central differences."""
    size = velocity.shape[-1]
    step = 1e-5 * np.maximum(np.max(np.abs(velocity), initial=0.0), 1.0)
    columns = [(change(velocity + step * e) - change(velocity - step * e)) / (2 * step) for e in np.eye(size)]
    return np.asarray(np.eye(size) - np.stack(columns, axis=-1))


def _at(acceleration: Acceleration, position: Array, velocity: Array) -> Array:
    return np.asarray(acceleration(position, velocity) if callable(acceleration) else acceleration, dtype=float)


def _state(
    position: ArrayLike, velocity: ArrayLike, acceleration: Acceleration, dt: ArrayLike
) -> tuple[Array, Array, Array, Array]:
    """Position, velocity, their acceleration, and the time step with an axis for the components."""
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    return p, v, _at(acceleration, p, v), np.asarray(dt, dtype=float)[..., None]
