"""The nodes of a mesh against a plane and a sphere (slides 4, 7 and 28)."""

from __future__ import annotations

import numpy as np

from solutions.arrays import Array
from solutions.detection import is_colliding
from solutions.domain import NotNegative, Number, Positive, Share, domain
from solutions.meshes.mesh import Mesh
from solutions.meshes.springs import require_fit
from solutions.response import kinematic_response
from solutions.vectors import direction, quotient

UP = (0.0, 0.0, 1.0)


@domain
def mesh_sphere_contact(
    mesh: Mesh,
    position: Number,
    velocity: Number,
    centre: Number,
    radius: Positive,
    restitution: Share = 0.0,
    friction: NotNegative = 0.0,
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
    position, velocity : (n, 3), m, m/s
    centre : (3,), m
    radius : one number, r, m, positive
    restitution : one number, e, from 0 to 1
    friction : one number, μ, without a unit, not negative

    Returns
    -------
    position, velocity : (n, 3) each, m, m/s
        A pinned node and a node on or outside the sphere keep both. A node
        inside that already moves away, or along the surface, keeps its
        velocity. A node exactly at the centre has no shortest way out: it
        moves up, along +z, and up is its normal.

    Raises
    ------
    ValueError
        If an array does not fit the mesh.

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
    radius.

    The function also takes a batch of states: position and velocity
    (..., n, 3), with a centre (..., 1, 3) and a radius (..., 1) for each.
    """
    require_fit(mesh, position=position, velocity=velocity)
    away = position - centre
    distance = np.linalg.norm(away, axis=-1)
    normal = np.where(distance[..., None] > 0, direction(away), UP)
    separation = distance - radius

    bounced = kinematic_response(velocity, normal, restitution)
    normal_impulse = np.linalg.norm(bounced - velocity, axis=-1)  # per mass
    slowed = _slowed(bounced, normal, friction * normal_impulse)
    on_surface = position - separation[..., None] * normal

    hit = (is_colliding(separation) & ~mesh.pinned)[..., None]
    p = np.where(hit, on_surface, position)
    v = np.where(hit, slowed, velocity)
    return p, v


def _slowed(velocity: Array, normal: Array, most: Array) -> Array:
    """The velocity, with its sliding reduced by a speed of at most `most`.

    The sliding is never reversed.
    """
    normal_part = np.sum(velocity * normal, axis=-1, keepdims=True) * normal
    sliding = velocity - normal_part
    speed = np.linalg.norm(sliding, axis=-1)
    kept = 1 - np.minimum(1.0, quotient(most, speed))
    return normal_part + kept[..., None] * sliding
