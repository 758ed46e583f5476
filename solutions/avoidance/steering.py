"""Steering to or from a target, after Reynolds (slide 1: "as in flocking")."""

from __future__ import annotations

from solutions.arrays import Array
from solutions.avoidance.directions import limited
from solutions.domain import NotNegative, Number, Positive, domain
from solutions.vectors import direction


@domain
def seek(position: Number, target: Number, max_speed: NotNegative) -> Array:
    """Velocity wanted by a body that seeks a target (slide 1).

    It wants to move straight towards the target, at full speed.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), v_max, m/s, not negative

    Returns
    -------
    (..., d), m/s
        Zero at the target.

    Notes
    -----
    The vector target − position points from the body to the target. Divided by
    its length, it is the direction, so

        v_wanted = v_max (target − position)/‖target − position‖

    A widely copied text has position − target. With this sign the body flees.
    """
    return max_speed[..., None] * direction(target - position)


@domain
def flee(position: Number, target: Number, max_speed: NotNegative) -> Array:
    """Velocity wanted by a body that flees from a target (slide 1).

    It wants to move straight away from the target, at full speed.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), m/s, not negative

    Returns
    -------
    (..., d), m/s
        Zero at the target, from which no direction leads away.
    """
    return -seek(position, target, max_speed)


@domain
def arrive(
    position: Number,
    target: Number,
    max_speed: NotNegative,
    slowing_radius: Positive,
) -> Array:
    """Velocity wanted by a body that is to stop at a target (slide 1).

    Outside the slowing radius the body moves towards the target at full speed.
    Inside, its speed is proportional to the distance that is left.

    Parameters
    ----------
    position, target : (..., d), m, d = 2 or 3
    max_speed : (...), v_max, m/s, not negative
    slowing_radius : (...), R, m, positive

    Returns
    -------
    (..., d), m/s
        Zero at the target.

    Notes
    -----
    The formula is

        v_wanted = (v_max/R)(target − position)

    and outside the slowing radius it is shortened to v_max.

    Suppose that the body is steered with the response time τ, as in
    `steering_force`. At the distance x, inside the slowing radius, its
    acceleration is (v_wanted − v)/τ with v_wanted = −v_max x/R. The body is
    then an oscillator:

        x″ = −(x′ + v_max x/R)/τ

    It stops without overshoot if its damping is at least critical. The
    characteristic equation τ λ² + λ + v_max/R = 0 has real solutions if

        R ≥ 4 v_max τ

    The force must also be large enough to brake. A body that follows v_wanted
    loses speed at the rate v_max² x/R², which is largest at x = R, so the
    condition is

        F_max ≥ m v_max²/R
    """
    rate = max_speed / slowing_radius
    return limited(rate[..., None] * (target - position), max_speed)


@domain
def steering_force(
    velocity: Number,
    wanted: Number,
    mass: Positive,
    response_time: Positive,
    max_force: NotNegative,
) -> Array:
    """Force that changes a velocity into the wanted one (slide 1).

    The force would complete the change within the response time. It is
    shortened to the largest force that the body is able to exert.

    Parameters
    ----------
    velocity, wanted : (..., d), m/s
    mass : (...), m, kg, positive
    response_time : (...), τ, s, positive
    max_force : (...), F_max, N, not negative

    Returns
    -------
    (..., d), N
        Zero where the velocity is the wanted one.

    Notes
    -----
    To change v into v_wanted within the time τ takes the acceleration
    (v_wanted − v)/τ. Newton's law gives the force

        F = m (v_wanted − v)/τ

    and it is shortened to F_max.

    Reynolds writes steering = desired − velocity. That is a difference of
    velocities, although he calls it a force. Only the division by a response
    time τ makes it one. In his text that time is one frame.
    """
    gain = mass / response_time
    return limited(gain[..., None] * (wanted - velocity), max_force)
