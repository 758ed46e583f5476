"""Integrators, which turn accelerations into motion (slide 30)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

import numpy as np

from solutions.arrays import Array
from solutions.checks import real
from solutions.domain import Number, domain

_MOST_ITERATIONS = 30
_CONVERGED = 1e-12
"""Change of an iteration at which Newton's method stops.

It is measured in units of the largest velocity component.
"""


@domain
def ballistic_motion(
    position: Number, velocity: Number, acceleration: Number, dt: Number
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
    A constant acceleration adds a dt to the velocity. The mean velocity over
    the time is then v + a dt/2, and this times dt is the displacement:

        p' = p + v dt + a dt²/2
        v' = v + a dt
    """
    dt = dt[..., None]
    p = position + velocity * dt + acceleration * dt * dt / 2
    v = velocity + acceleration * dt
    return p, v


@domain
def explicit_euler(
    position: Number, velocity: Number, acceleration: Acceleration, dt: Number
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

        p' = p + v dt
        v' = v + a dt

    The acceleration may also be a function of position and velocity, as the
    other integrators need it. It is then taken at the start of the step.

    An undamped spring gains energy in every step, however short. Put the step
    into the energy, with a = −ω² p. The mixed terms cancel:

        ω² p'² + v'² = (1 + ω² dt²)(ω² p² + v²)
    """
    a = acceleration(position, velocity)
    dt = dt[..., None]
    p = position + velocity * dt
    v = velocity + a * dt
    return p, v


@domain
def semi_implicit_euler(
    position: Number, velocity: Number, acceleration: Acceleration, dt: Number
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

        v' = v + a dt
        p' = p + v' dt

    The energy of an undamped spring swings about a constant and does not
    drift. With a = −ω² p, each step leaves

        ω² p² + v² − ω² p·v dt

    exactly as it was, and this differs from twice the energy of a unit mass
    only by a term that swings.
    """
    a = acceleration(position, velocity)
    dt = dt[..., None]
    v = velocity + a * dt
    p = position + v * dt
    return p, v


@domain
def velocity_verlet(
    position: Number, velocity: Number, acceleration: Acceleration, dt: Number
) -> tuple[Array, Array]:
    """State after one step of velocity Verlet.

    The acceleration at the start of the step moves the position. The mean of
    the accelerations at the start and at the end of the step changes the
    velocity. The method is of second order, and it is symplectic where the
    acceleration depends only on the position.

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

        p' = p + v dt + a dt²/2
        v' = v + (a + a') dt/2

    The acceleration a' is taken at p'. Where it depends on the velocity too,
    it is taken at the predicted velocity v + a dt, because v' is not known
    yet.
    """
    a = acceleration(position, velocity)
    dt = dt[..., None]
    p = position + velocity * dt + a * dt * dt / 2
    a_after = acceleration(p, velocity + a * dt)
    v = velocity + (a + a_after) * dt / 2
    return p, v


@domain
def runge_kutta_4(
    position: Number, velocity: Number, acceleration: Acceleration, dt: Number
) -> tuple[Array, Array]:
    """State after one step of the classical Runge–Kutta method.

    It takes four accelerations and weights them 1 : 2 : 2 : 1. The first is at
    the start of the step, two are in its middle, and the last is at its end.
    The method is of fourth order and not symplectic.

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
    Each stage starts from the beginning of the step, and takes its slope from
    the stage before:

        a1 = a(p, v)
        v2 = v + a1 dt/2
        a2 = a(p + v dt/2, v2)
        v3 = v + a2 dt/2
        a3 = a(p + v2 dt/2, v3)
        v4 = v + a3 dt
        a4 = a(p + v3 dt, v4)

    The step uses the weighted means of the four velocities and of the four
    accelerations:

        p' = p + (v + 2 v2 + 2 v3 + v4) dt/6
        v' = v + (a1 + 2 a2 + 2 a3 + a4) dt/6

    An undamped spring very slowly loses energy.
    """
    p, v, a = position, velocity, acceleration
    dt = dt[..., None]
    a1 = a(p, v)
    v2 = v + a1 * dt / 2
    a2 = a(p + v * dt / 2, v2)
    v3 = v + a2 * dt / 2
    a3 = a(p + v2 * dt / 2, v3)
    v4 = v + a3 * dt
    a4 = a(p + v3 * dt, v4)
    p_after = p + (v + 2 * v2 + 2 * v3 + v4) * dt / 6
    v_after = v + (a1 + 2 * a2 + 2 * a3 + a4) * dt / 6
    return p_after, v_after


@domain
def implicit_euler(
    position: Number, velocity: Number, acceleration: Acceleration, dt: Number
) -> tuple[Array, Array]:
    """State after one step of implicit Euler.

    Everything is taken as it will be at the end of the step. The method is of
    first order and stable for any step, and it damps motion that it cannot
    follow.

    Parameters
    ----------
    position, velocity : (..., n), p and v, m, m/s
        Components along the last axis may depend on each other. There are
        n = 3 for bodies that do not know of each other, and n = 3 N, all in a
        row, for N bodies in a mesh.
    acceleration : (..., n), a, m/s², or a function of position and velocity
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

        v' = v + a(p', v') dt
        p' = p + v' dt

    The velocity v' appears on both sides. If p' is put into the first
    equation, v' is the root of

        v' − v − a(p + v' dt, v') dt

    Newton's method finds this root, with the derivatives taken by differences.
    For springs and dampers that are linear, one iteration is enough.
    """
    dt = dt[..., None]

    def change(after: Array) -> Array:
        return acceleration(position + after * dt, after) * dt

    after = velocity + acceleration(position, velocity) * dt
    for _ in range(_MOST_ITERATIONS):
        wrong = after - velocity - change(after)
        slope = _jacobian(change, after)
        correction = np.linalg.solve(slope, wrong[..., None])[..., 0]
        after = after - correction
        largest = np.max(np.abs(after), initial=0.0)
        if np.max(np.abs(correction), initial=0.0) <= _CONVERGED * largest:
            return position + after * dt, after
    raise ArithmeticError(
        f"implicit Euler found no velocity in {_MOST_ITERATIONS} iterations:"
        " shorten dt"
    )


def _jacobian(change: Callable[[Array], Array], velocity: Array) -> Array:
    """Derivatives (..., n, n) of v' − change(v') by central differences."""
    unity = np.eye(velocity.shape[-1])
    step = 1e-5 * np.maximum(np.max(np.abs(velocity), initial=0.0), 1.0)
    columns = [
        (change(velocity + step * e) - change(velocity - step * e))
        / (2 * step)
        for e in unity
    ]
    return unity - np.stack(columns, axis=-1)


Function = Callable[[Array, Array], Array]


def _function(name: str, value: Any) -> Function:
    """A function of position and velocity; a vector becomes a constant one."""
    acceleration = value if callable(value) else lambda _p, _v: value
    return lambda p, v: real(name, acceleration(p, v))


Acceleration = Annotated[Function, _function]
"""A constant acceleration (..., 3), m/s², or a function that returns it.

The function takes the position and the velocity. In an integrator it always is
such a function.
"""
