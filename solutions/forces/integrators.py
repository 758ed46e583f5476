"""Integrators, which turn accelerations into motion (slide 30)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array

Acceleration = ArrayLike | Callable[[Array, Array], ArrayLike]
"""A constant acceleration (..., 3), m/s², or a function that returns it.

The function takes the position and the velocity.
"""
_MOST_ITERATIONS = 30
_CONVERGED = 1e-12
"""Change of an iteration at which Newton's method stops.

It is measured in units of the largest velocity component.
"""


def ballistic_motion(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: ArrayLike,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after a time dt of constant acceleration, exactly.

    Parameters
    ----------
    position : (..., 3), p, m
    velocity : (..., 3), v, m/s
    acceleration : (..., 3), a, m/s²
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each, m, m/s

    Notes
    -----
    A constant acceleration adds a dt to the velocity. The mean velocity over the time
    is then v + a dt/2, and this times dt is the displacement:

        p' = p + v dt + a dt²/2,    v' = v + a dt
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    return p + v * time + a * time * time / 2, v + a * time


def explicit_euler(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: Acceleration,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after one step of explicit Euler.

    Everything is taken as it was at the start of the step. The method is of
    first order.

    Parameters
    ----------
    position : (..., 3), p, m
    velocity : (..., 3), v, m/s
    acceleration : (..., 3), a, at the start of the step, m/s²
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each, at the end of the step, m, m/s

    Notes
    -----
    The step is

        p' = p + v dt,    v' = v + a dt

    Like the integrators that need it at other places as well, this one also
    takes the acceleration as a function of position and velocity.

    An undamped spring gains energy in every step, however short. With a = −ω²
    p, put the step into the energy: ω² p'² + v'² is (1 + ω² dt²) times ω² p² +
    v², because the mixed terms cancel.
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    return p + v * time, v + a * time


def semi_implicit_euler(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: Acceleration,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after one step of semi-implicit Euler.

    Most engines use this integrator. The acceleration at the start of the step
    first changes the velocity. The new velocity then moves the position. The
    method is of first order and symplectic.

    Parameters
    ----------
    position : (..., 3), p, m
    velocity : (..., 3), v, m/s
    acceleration : (..., 3), a, m/s², or a function of position and velocity
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each, m, m/s

    Notes
    -----
    The step is

        v' = v + a dt,    p' = p + v' dt

    The energy of an undamped spring swings about a constant and does not
    drift. With a = −ω² p, each step leaves ω² p² + v² − ω² p·v dt exactly as
    it was, and this differs from twice the energy of a unit mass only by a
    term that swings.
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    after = v + a * time
    return p + after * time, after


def velocity_verlet(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: Acceleration,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after one step of velocity Verlet.

    The acceleration at the start of the step moves the position. The mean of the
    accelerations at the start and at the end of the step changes the velocity. The
    method is of second order, and it is symplectic where the acceleration depends only
    on the position.

    Parameters
    ----------
    position : (..., 3), p, m
    velocity : (..., 3), v, m/s
    acceleration : (..., 3), a, m/s², or a function of position and velocity
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each, m, m/s

    Notes
    -----
    With the acceleration a' at the end of the step, the step is

        p' = p + v dt + a dt²/2,    v' = v + (a + a') dt/2

    The acceleration a' is taken at p'. Where it depends on the velocity too, it is
    taken at the predicted velocity v + a dt, because v' is not known yet.
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)
    after = p + v * time + a * time * time / 2
    return after, v + (a + _at(acceleration, after, v + a * time)) * time / 2


def runge_kutta_4(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: Acceleration,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after one step of the classical Runge–Kutta method.

    It takes four accelerations and weights them 1 : 2 : 2 : 1. The first is at the
    start of the step, two are in its middle, and the last is at its end. The method is
    of fourth order and not symplectic.

    Parameters
    ----------
    position : (..., 3), p, m
    velocity : (..., 3), v, m/s
    acceleration : (..., 3), a, m/s², or a function of position and velocity
    dt : (...), s

    Returns
    -------
    position, velocity : (..., 3) each, m, m/s

    Notes
    -----
    Each stage starts from the beginning of the step, and takes its slope from the stage
    before:

        a1 = a(p, v)
        v2 = v + a1 dt/2,    a2 = a(p + v dt/2, v2)
        v3 = v + a2 dt/2,    a3 = a(p + v2 dt/2, v3)
        v4 = v + a3 dt,      a4 = a(p + v3 dt, v4)

    The step uses the weighted means of the four velocities and of the four
    accelerations:

        p' = p + (v + 2 v2 + 2 v3 + v4) dt/6
        v' = v + (a1 + 2 a2 + 2 a3 + a4) dt/6

    An undamped spring very slowly loses energy.
    """
    p, v, a1, time = _state(position, velocity, acceleration, dt)
    v2 = v + a1 * time / 2
    a2 = _at(acceleration, p + v * time / 2, v2)
    v3 = v + a2 * time / 2
    a3 = _at(acceleration, p + v2 * time / 2, v3)
    v4 = v + a3 * time
    a4 = _at(acceleration, p + v3 * time, v4)
    return p + (v + 2 * v2 + 2 * v3 + v4) * time / 6, v + (
        a1 + 2 * a2 + 2 * a3 + a4
    ) * time / 6


def implicit_euler(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: Acceleration,
    dt: ArrayLike,
) -> tuple[Array, Array]:
    """State after one step of implicit Euler.

    Everything is taken as it will be at the end of the step. The method is of first
    order and stable for any step, and it damps motion that it cannot follow.

    Parameters
    ----------
    position, velocity : (..., n), p and v, m, m/s
        Components along the last axis may depend on each other. There are n = 3 for
        bodies that do not know of each other, and n = 3 N, all in a row, for N bodies
        in a mesh.
    acceleration : (..., n), m/s², or a function of position and velocity, each (..., n)
    dt : (...), s

    Returns
    -------
    position, velocity : (..., n) each, m, m/s

    Raises
    ------
    ArithmeticError
        If thirty iterations do not settle: the step is too long for the force.

    Notes
    -----
    The step is

        v' = v + a(p', v') dt,    p' = p + v' dt

    The velocity v' appears on both sides. If p' is put into the first equation, v' is
    the root of v' − v − a(p + v' dt, v') dt. Newton's method finds this root, with the
    derivatives taken by differences. For springs and dampers that are linear, one
    iteration is enough.
    """
    p, v, a, time = _state(position, velocity, acceleration, dt)

    def change(after: Array) -> Array:
        return np.asarray(_at(acceleration, p + after * time, after) * time)

    after = v + a * time
    for _ in range(_MOST_ITERATIONS):
        wrong = after - v - change(after)
        correction = np.linalg.solve(
            _jacobian(change, after), wrong[..., None]
        )[..., 0]
        after = after - correction
        if np.max(np.abs(correction), initial=0.0) <= _CONVERGED * np.max(
            np.abs(after), initial=0.0
        ):
            return p + after * time, after
    raise ArithmeticError(
        f"implicit Euler found no velocity in {_MOST_ITERATIONS} iterations: shorten dt"
    )


def _jacobian(change: Callable[[Array], Array], velocity: Array) -> Array:
    """Derivatives (..., n, n) of v' − change(v') by central differences."""
    size = velocity.shape[-1]
    step = 1e-5 * np.maximum(np.max(np.abs(velocity), initial=0.0), 1.0)
    columns = [
        (change(velocity + step * e) - change(velocity - step * e))
        / (2 * step)
        for e in np.eye(size)
    ]
    return np.asarray(np.eye(size) - np.stack(columns, axis=-1))


def _at(
    acceleration: Acceleration,
    position: Array,
    velocity: Array,
) -> Array:
    if callable(acceleration):
        return np.asarray(acceleration(position, velocity), dtype=float)
    return np.asarray(acceleration, dtype=float)


def _state(
    position: ArrayLike,
    velocity: ArrayLike,
    acceleration: Acceleration,
    dt: ArrayLike,
) -> tuple[Array, Array, Array, Array]:
    """Position, velocity, their acceleration, and the time step.

    The time step has an axis for the components.
    """
    p, v = np.asarray(position, dtype=float), np.asarray(velocity, dtype=float)
    time = np.asarray(dt, dtype=float)[..., None]
    return p, v, _at(acceleration, p, v), time
