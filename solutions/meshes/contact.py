"""The nodes of a mesh against a plane and a sphere (slides 4, 7 and 28)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import in_unit_interval, not_negative, positive
from solutions.detection import is_colliding
from solutions.meshes.mesh import AnyMesh, SpringMesh, as_mesh
from solutions.meshes.springs import node_vectors
from solutions.response import kinematic_response

UP = (0.0, 0.0, 1.0)


def mesh_sphere_contact(
    mesh: AnyMesh,
    position: ArrayLike,
    velocity: ArrayLike,
    centre: ArrayLike,
    radius: ArrayLike,
    restitution: ArrayLike = 0.0,
    friction: ArrayLike = 0.0,
) -> tuple[Array, Array]:
    """State of the nodes after their contact with a fixed sphere.

    A node inside the sphere is moved back onto its surface, by the shortest
    way. If the node approaches the surface, the sphere gives it the normal
    impulse that turns its normal velocity v_n into −e v_n, and an impulse of
    friction against its sliding, as large as Coulomb's law allows, but never
    more than stops the sliding.

    Parameters
    ----------
    mesh : SpringMesh of n nodes
    position, velocity : (n, 3), m and m/s
    centre : (3,), m
    radius : m, positive
    restitution : e, from 0 to 1
    friction : μ, not negative

    Returns
    -------
    position, velocity : (n, 3) each, m and m/s
        A pinned node and a node on or outside the sphere keep both. A node
        inside that already moves away, or along the surface, keeps its
        velocity. A node exactly at the centre has no shortest way out: it
        moves up, along +z, and up is its normal.

    Raises
    ------
    ValueError
        If the radius is not positive, e is not from 0 to 1, μ is negative, or
        an array does not fit the mesh.

    Notes
    -----
    The sphere gives a node of mass m the normal impulse m (1 + e) |v_n|.
    Coulomb's law limits the impulse of friction to μ times the normal impulse.
    Divided by the mass, that limit is

        |Δv_t| ≤ μ (1 + e) |v_n|

    so the mass drops out.

    Only nodes are tested. The middle of an edge of length L whose ends lie on
    the sphere is √(r² − L²/4) from the centre, by Pythagoras. It lies below
    the surface by

        r − √(r² − L²/4) ≈ L²/(8 r)

    where the approximation holds for an edge that is short compared with the
    radius. Leading axes of position and velocity make a batch, (..., n, 3),
    with a centre (..., 1, 3) and a radius (..., 1) for each.
    """
    mesh = as_mesh(mesh)
    p = node_vectors(mesh, "position", position)
    away = p - np.asarray(centre, dtype=float)
    distance = np.linalg.norm(away, axis=-1)
    apart = distance > 0
    normal = np.where(
        apart[..., None], away / np.where(apart, distance, 1.0)[..., None], UP
    )
    return _answered(
        mesh,
        p,
        velocity,
        normal,
        distance - positive("radius", radius),
        restitution,
        friction,
    )


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
    e = in_unit_interval("restitution", restitution)
    mu = not_negative("friction", friction)
    after = kinematic_response(v, normal, e)
    gained = np.linalg.norm(after - v, axis=-1)
    rubbed = _slowed(after, normal, mu * gained)
    hit = (is_colliding(separation) & ~mesh.pinned)[..., None]
    put_back = position - separation[..., None] * normal
    return np.where(hit, put_back, position), np.where(hit, rubbed, v)


def _slowed(velocity: Array, normal: Array, most: Array) -> Array:
    """The velocity with its tangential speed reduced by at most `most`.

    The tangential velocity is never reversed.
    """
    across = np.sum(velocity * normal, axis=-1, keepdims=True) * normal
    along = velocity - across
    speed = np.linalg.norm(along, axis=-1)
    kept = 1 - np.minimum(1.0, most / np.where(speed > 0, speed, 1.0))
    return np.asarray(across + kept[..., None] * along)
