"""The nodes of a mesh against a plane and a sphere (slides 4, 7 and 28)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.checks import in_unit_interval, not_negative, positive
from solutions.detection import is_colliding, signed_distance
from solutions.meshes.springs import node_vectors
from solutions.meshes.topology import Array, SpringMesh
from solutions.response import kinematic_response

UP = (0.0, 0.0, 1.0)


def mesh_plane_contact(
    mesh: SpringMesh,
    position: ArrayLike,
    velocity: ArrayLike,
    normal: ArrayLike,
    offset: ArrayLike,
    restitution: ArrayLike = 0.0,
    friction: ArrayLike = 0.0,
) -> tuple[Array, Array]:
    """Answer for every node that is behind the plane n·p + d = 0: put it back, reverse its approach, rub it.

    The normal velocity becomes −e times what it was. The tangential one loses μ times that change at most, as the
    normal impulse allows: so a node that rests and slides is slowed by μ g, whatever the timestep.

    Parameters
    ----------
    position, velocity : (..., n, 3), m and m/s
    normal : (3,), out of the plane, any length but zero; one for each mesh of a batch: (..., 1, 3)
    offset : d; for a batch (..., 1)
    restitution, friction : e, 0 to 1, and μ

    Returns
    -------
    position, velocity : (..., n, 3) each; those of pinned nodes, and of nodes in front of the plane, as they were

    Raises
    ------
    ValueError
        If the normal is zero, e is not from 0 to 1, or μ is negative.
    """
    p = node_vectors(mesh, "position", position)
    separation = signed_distance(p, normal, offset)
    n = np.asarray(normal, dtype=float)
    n = n / np.linalg.norm(n, axis=-1, keepdims=True)
    return _answered(mesh, p, velocity, n, separation, restitution, friction)


def mesh_sphere_contact(
    mesh: SpringMesh,
    position: ArrayLike,
    velocity: ArrayLike,
    centre: ArrayLike,
    radius: ArrayLike,
    restitution: ArrayLike = 0.0,
    friction: ArrayLike = 0.0,
) -> tuple[Array, Array]:
    """Answer for every node that is within a fixed sphere, as `mesh_plane_contact` does, with n away from its centre.

    Only nodes are tested: an edge of length L whose ends lie on the sphere cuts into it by L²/(8 r). Draw the sphere
    smaller by that, or keep the nodes a little off.

    Parameters
    ----------
    position, velocity : (..., n, 3), m and m/s
    centre : (3,), m; one for each mesh of a batch: (..., 1, 3)
    radius : m, positive; for a batch (..., 1)
    restitution, friction : e, 0 to 1, and μ

    Returns
    -------
    position, velocity : (..., n, 3) each. A node at the very centre has no way out that is shortest: it goes up, +z.

    Raises
    ------
    ValueError
        If the radius is not positive, e is not from 0 to 1, or μ is negative.
    """
    p = node_vectors(mesh, "position", position)
    away = p - np.asarray(centre, dtype=float)
    distance = np.linalg.norm(away, axis=-1)
    apart = distance > 0
    normal = np.where(apart[..., None], away / np.where(apart, distance, 1.0)[..., None], UP)
    return _answered(mesh, p, velocity, normal, distance - positive("radius", radius), restitution, friction)


def _answered(
    mesh: SpringMesh,
    position: Array,
    velocity: ArrayLike,
    normal: Array,
    separation: Array,
    restitution: ArrayLike,
    friction: ArrayLike,
) -> tuple[Array, Array]:
    v = node_vectors(mesh, "velocity", velocity)
    e, mu = in_unit_interval("restitution", restitution), not_negative("friction", friction)
    after = kinematic_response(v, normal, e)
    gained = np.linalg.norm(after - v, axis=-1)
    rubbed = _slowed(after, normal, mu * gained)
    hit = (is_colliding(separation) & ~mesh.pinned)[..., None]
    return np.where(hit, position - separation[..., None] * normal, position), np.where(hit, rubbed, v)


def _slowed(velocity: Array, normal: Array, most: Array) -> Array:
    """The velocity with its part along the surface made slower by so much at most, and never reversed."""
    across = np.sum(velocity * normal, axis=-1, keepdims=True) * normal
    along = velocity - across
    speed = np.linalg.norm(along, axis=-1)
    kept = 1 - np.minimum(1.0, most / np.where(speed > 0, speed, 1.0))
    return np.asarray(across + kept[..., None] * along)
