"""A step with one collision, at its instant or at a time step (slide 6)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.domain import NotNegative, Share, Triple, Truth, Unit, domain
from solutions.forces import ballistic_motion, semi_implicit_euler
from solutions.response.kinematic import kinematic_response


@domain
def respond_at_impact(
    position: Triple,
    velocity: Triple,
    acceleration: Triple,
    normal: Unit,
    restitution: Share,
    time_of_impact: NotNegative,
    dt: NotNegative,
) -> tuple[Array, Array]:
    """State after a step with one collision, by backing up to it (slide 6).

    The body moves freely to T, responds there, and moves freely to the end of
    the step.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
        At the start of the step.
    normal : (..., 3), n, unit, out of the plane
    restitution : (...), e, 0 to 1
    time_of_impact : (...), T, s from the start of the step, not negative
        Exact or the slide's. T = dt is a collision at the very end of the
        step. A later T means no collision, and so does infinity.
    dt : (...), s, length of the step, not negative

    Returns
    -------
    position, velocity : (..., 3) each, at the end of the step
        A second collision in the same step is not seen here.

    Notes
    -----
    The slide stops at the response. The rest of the step, Δt − T, must be
    integrated with the new velocity. If a program left it out, every bounce
    would lose half a step of time on average.
    """
    struck = (time_of_impact <= dt)[..., None]
    before = np.minimum(time_of_impact, dt)
    p, v = ballistic_motion(position, velocity, acceleration, before)
    v = np.where(struck, kinematic_response(v, normal, restitution), v)
    return ballistic_motion(p, v, acceleration, dt - before)


@domain
def respond_at_step(
    position: Triple,
    velocity: Triple,
    acceleration: Triple,
    normal: Unit,
    behind: Truth,
    restitution: Share,
    dt: NotNegative,
) -> tuple[Array, Array]:
    """State after a step that looks for a collision at its start (slide 6).

    This is the slide's response at time steps. A body that starts the step
    behind the plane and moves in gets its new velocity at once. It then takes
    a step of semi-implicit Euler, and for this one step the plane carries its
    weight.

    Parameters
    ----------
    position, velocity, acceleration : (..., 3), m, m/s, m/s²
        At the start of the step.
    normal : (..., 3), n, unit, out of the plane
    behind : (...), bool
        Whether the body is behind the plane, as `is_colliding` says.
    restitution : (...), e, 0 to 1
    dt : (...), s, length of the step, not negative

    Returns
    -------
    position, velocity : (..., 3) each, at the end of the step
        A body that responds is not moved back to the plane. Of its
        acceleration, the plane takes the component that presses the body onto
        it, and leaves the rest. A body in front of the plane, on its way out
        or moving along the plane (v·n = 0) takes the free step.

    Notes
    -----
    A ball that is dropped arrives at the plane with the speed v. It is noticed
    at a depth of up to v Δt, on average v Δt/2, and turns there. Its apex
    would be at e²h. On average over all phases of the steps it differs from
    that by

        −(1 − e) v Δt/2

    because the rebound starts v Δt/2 too low, and in its first step the ball
    moves with the whole e v. So its steps rise e v Δt/2 higher than the
    parabola.

    Two other loops cost as much and err more:

    - Fly exactly over the whole step, then respond: −(1 − e²) v Δt/2. On its
      way into the plane the ball has also gained speed, and the rebound keeps
      e² of that energy.
    - Take a semi-implicit step with the weight, then respond:
      −(1 + e) v Δt/2. The first step of the rebound already loses g Δt, and so
      the steps of the rebound rise e v Δt/2 less than the parabola.

    The loop of this function looks, responds and moves. It is chosen because
    its error is the smallest, and because physics engines use it too: they
    look for contacts, change the velocities and move.
    """
    # The rule has its own guard: a body that moves out keeps its velocity.
    rebounded = kinematic_response(velocity, normal, restitution)
    start_velocity = np.where(behind[..., None], rebounded, velocity)
    struck = behind & (np.vecdot(velocity, normal) < 0)
    pressing = np.minimum(np.vecdot(acceleration, normal), 0.0)
    carried_by_plane = np.where(struck, pressing, 0.0)[..., None] * normal
    return semi_implicit_euler(
        position, start_velocity, acceleration - carried_by_plane, dt
    )
