"""The forces of the lecture, acting on bodies of the world (slides 25 to 30).

Each function returns the force on every body and the torque about its centre
of mass. So the results of several functions add up:

    force, torque = np.sum([gravity_forces(…), spring_forces(…)], axis=0)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.domain import Positive, domain
from solutions.forces import (
    buoyancy,
    spring_damper_force,
    stokes_drag,
    uniform_gravity,
    wind_force,
)
from solutions.meshes import SpringMesh, mesh_forces
from solutions.world.attachments import (
    AnyState,
    ForceAndTorque,
    body_numbers,
    forces_at_points,
    point_motion,
)


@domain
def gravity_forces(
    state: AnyState, mass: Positive, gravity: ArrayLike
) -> ForceAndTorque:
    """Weight of each body (slide 25).

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    mass : (..., n), kg, positive
    gravity : (3,), m/s²

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        The weight acts at the centre of mass and turns no body. An immovable
        body, of infinite mass, is given no force.
    """
    movable = np.where(np.isfinite(mass), mass, 0.0)
    return _at_centres(state, uniform_gravity(movable, gravity))


@domain
def drag_forces(
    state: AnyState,
    fluid_velocity: ArrayLike,
    viscosity: ArrayLike,
    radius: ArrayLike,
) -> ForceAndTorque:
    """Drag of a thick fluid on each ball (slide 26).

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    fluid_velocity : (..., n, 3), or (3,) where it is the same for all, m/s
    viscosity : (...), Pa s, not negative
    radius : (..., n), m, not negative

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        The drag of `stokes_drag` acts at the centre. The fluid brakes no spin.

    """
    _, _, velocity, _ = state
    force = stokes_drag(velocity, fluid_velocity, viscosity, radius)
    return _at_centres(state, force)


@domain
def buoyancy_forces(
    state: AnyState,
    volume: ArrayLike,
    fluid_density: ArrayLike,
    gravity: ArrayLike,
) -> ForceAndTorque:
    """Lift of each body by the fluid that it displaces (slide 26).

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    volume : (..., n), m³, not negative
        `solutions.world.volumes.volume` gives that of a shape.
    fluid_density : (...), kg/m³, not negative
    gravity : (3,), m/s²

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        The lift acts at the centre, where it turns no body: the fluid is
        everywhere.
    """
    return _at_centres(state, buoyancy(volume, fluid_density, gravity))


@domain
def wind_forces(
    state: AnyState,
    wind: ArrayLike,
    area: ArrayLike,
    drag_coefficient: ArrayLike,
    density: ArrayLike,
) -> ForceAndTorque:
    """Force of the wind on each body (slide 30).

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    wind : (..., n, 3), or (3,) where it is the same for all, m/s
        `sample_field` gives the wind at the positions of the bodies.
    area : (..., n), of each body as seen along the wind, m², not negative
    drag_coefficient : (..., n), not negative
    density : (...), of the air, kg/m³, not negative

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        The force of `wind_force` acts at the centre and turns no body.
    """
    _, _, velocity, _ = state
    force = wind_force(velocity, wind, area, drag_coefficient, density)
    return _at_centres(state, force)


@domain
def mesh_body_forces(
    state: AnyState, mesh: SpringMesh, body: ArrayLike
) -> ForceAndTorque:
    """Forces of a spring mesh whose nodes are bodies (slide 28).

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    mesh : SpringMesh of k nodes
        Only its springs and dampers count here. The masses are those of the
        bodies.
    body : (k,), number of the body that is each node; no body twice

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        The springs are tied to the centres and turn no body. A node that the
        mesh calls pinned is pulled like any other. To hold it, its body must
        be immovable.

    Raises
    ------
    ValueError
        If there is no such body, one is named twice, or there is not one for
        each node.
    """
    position, _, velocity, _ = state
    body = body_numbers("body", body, position.shape[-2], least=0)
    if len(np.unique(body)) < body.size:
        raise ValueError(f"body must not name a body twice: {body.tolist()}")
    force = np.zeros_like(position)
    force[..., body, :] = mesh_forces(
        mesh, position[..., body, :], velocity[..., body, :]
    )
    return force, np.zeros_like(position)


def spring_forces(
    state: AnyState,
    body_a: ArrayLike,
    point_a: ArrayLike,
    body_b: ArrayLike,
    point_b: ArrayLike,
    stiffness: ArrayLike,
    rest_length: ArrayLike = 0.0,
    damping: ArrayLike = 0.0,
) -> ForceAndTorque:
    """Forces of springs and dampers between points of bodies (slide 29).

    There are m springs, with a damper beside each.

    Parameters
    ----------
    state : position, orientation, velocity, angular_velocity
    body_a, body_b : (m,), number of the body at each end, or −1 for the world
    point_a, point_b : (m, 3), m
        Where the end is tied, in the body's own frame; in the world frame for
        −1.
    stiffness : (m,) or one for all, N/m, not negative
    rest_length : (m,) or one for all, m, not negative
    damping : (m,) or one for all, N s/m, not negative

    Returns
    -------
    force, torque : (..., n, 3) each, N and N m
        A body that several springs pull gets the sum.

    Raises
    ------
    ValueError
        If there is no such body.

    Notes
    -----
    `point_motion` gives the places and the velocities of the two ends, and
    from these `spring_damper_force` gives the force F on end A. End B gets −F.
    `forces_at_points` adds up what all ends do to each body.

    The two forces are opposite and act along the same line. So a spring
    between two bodies changes neither the momentum nor the angular momentum of
    the pair.
    """
    place_a, velocity_a = point_motion(state, body_a, point_a)
    place_b, velocity_b = point_motion(state, body_b, point_b)
    ends = place_a, place_b, velocity_a, velocity_b
    on_a = spring_damper_force(*ends, stiffness, rest_length, damping)
    force_a, torque_a = forces_at_points(state, body_a, place_a, on_a)
    force_b, torque_b = forces_at_points(state, body_b, place_b, -on_a)
    return force_a + force_b, torque_a + torque_b


def _at_centres(state: AnyState, force: Array) -> ForceAndTorque:
    """A force on each body that acts at its centre, and turns none."""
    shape = state[0].shape
    return np.array(np.broadcast_to(force, shape)), np.zeros(shape)
