"""Centre of mass and principal moments of evenly filled shapes (slide 18).

A caller who knows the moments of a body better, as of a hollow one, can use
their own numbers in place of these.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from solutions.arrays import Array
from solutions.checks import finite, positive
from solutions.domain import (
    FiniteNotNegative,
    FinitePositive,
    Positive,
    domain,
)
from solutions.impulse import (
    box_inertia,
    rotation_matrix,
    sphere_inertia,
    world_inertia,
)
from solutions.world.rotation import orientation_of, quaternion_product
from solutions.world.shapes import Shape
from solutions.world.volumes import tetrahedra, volume

ROUNDING_OF_MASS = 1e-12
"""Share of a body's size up to which a centre counts as its origin.

The same share of the largest moment counts as no product of inertia.
"""
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
OPPOSITE = np.array([1.0, -1.0, -1.0, -1.0])
"""A unit quaternion times this is the rotation back."""


@domain
def mass_properties(
    shape: Shape, mass: Positive
) -> tuple[Array, Array, Array]:
    """Centre of mass, principal moments and principal axes of a shape.

    Parameters
    ----------
    shape : see `solutions.world.shapes`
        Filled evenly. The mass of a compound is shared out among its parts by
        their volumes. Where parts overlap, the mass is counted twice.
    mass : kg, positive; infinity for an immovable body

    Returns
    -------
    centre : (3,), m, in the shape's own frame
    moments : (3,), kg m², about the centre and along the principal axes
    orientation : (4,), unit quaternion w, x, y, z
        It turns the principal axes into the shape's own. It is (1, 0, 0, 0)
        exactly if the shape's own axes are principal, to rounding.

    Raises
    ------
    ValueError
        If a half-space has a finite mass, a length is negative or not finite,
        the faces of a polyhedron look inwards, or there is no such kind of
        shape.

    Notes
    -----
    An immovable body has three infinite moments. It needs no centre, and so
    its own frame is returned as it is.

    About the axes of the shape, the inertia of most bodies is a full matrix I.
    It is symmetric, so that it has three perpendicular eigenvectors, the
    principal axes. With these as the columns of R,

        I = R diag(I₁, I₂, I₃) Rᵀ
    """
    if np.isinf(mass):
        return np.zeros(3), np.full(3, np.inf), np.array(UPRIGHT)
    centre, inertia = _centre_and_inertia(shape, float(mass))
    moments, orientation = _principal(inertia)
    size = np.sqrt(moments.max() / mass)
    if np.linalg.norm(centre) <= ROUNDING_OF_MASS * size:
        centre = np.zeros(3)
    return centre, moments, orientation


def in_principal_axes(
    shape: Shape, mass: float
) -> tuple[Shape, Array, Array, Array]:
    """The same shape, about its centre of mass and along its principal axes.

    A body of this shape has a diagonal inertia, and its position is its centre
    of mass.

    Parameters
    ----------
    shape : see `solutions.world.shapes`
    mass : kg, positive; infinity for an immovable body

    Returns
    -------
    shape : the same kind
        It is the very shape that was given if its frame is already the
        principal one.
    moments : (3,), kg m²
    centre, orientation : (3,) and (4,), as `mass_properties` returns them
        They say where the new frame lies in the old one. A body whose old
        frame is at p and turned by q has its new frame at p + R(q) centre, and
        it is turned by the `quaternion_product` of q and the orientation.

    Raises
    ------
    ValueError
        As `mass_properties`.
    """
    centre, moments, orientation = mass_properties(shape, mass)
    if np.any(centre != 0) or np.any(orientation != UPRIGHT):
        shape = _seen_from(shape, centre, orientation)
    return shape, moments, centre, orientation


def _centre_and_inertia(shape: Shape, mass: float) -> tuple[Array, Array]:
    """Centre (3,) and inertia (3, 3) about it, along the shape's own axes."""
    kind, *rest = shape
    if not np.isfinite(volume(shape)):
        raise ValueError(
            "a half-space must have an infinite mass, and be no part of a"
            f" compound, not {mass:g} kg"
        )
    if kind == "polyhedron":
        return _polyhedron(mass, *rest)
    if kind == "compound":
        return _compound(mass, rest[0])
    if kind == "sphere":
        moments = sphere_inertia(mass, rest[0])
    elif kind == "box":
        moments = box_inertia(mass, 2 * np.asarray(rest[0], dtype=float))
    else:
        moments = capsule_inertia(mass, *rest)
    return np.zeros(3), np.diag(moments)


@domain
def capsule_inertia(
    mass: Positive, radius: FinitePositive, half_length: FiniteNotNegative
) -> Array:
    """Moments of inertia of a solid capsule about its centre.

    Parameters
    ----------
    mass : kg, positive and finite
    radius : r, m, positive and finite
    half_length : h, m, not negative; the cylinder is 2 h long

    Returns
    -------
    (3,), kg m², about x, y and z of the body

    Notes
    -----
    The capsule is a cylinder with a half-ball at each end, and its mass is
    shared out by their volumes. About its own axis z, the cylinder of mass m_c
    and the two half-balls of mass m_s together have

        I_z = m_c r²/2 + 2/5 m_s r²

    About x and y, the cylinder has m_c (r²/4 + h²/3). A half-ball of mass m
    has half the moment of a ball of mass 2 m about the middle of its flat
    side, which is 2/5 m r². Its centre of mass is 3/8 r away from there. By
    the theorem of parallel axes, its moment about its own centre of mass is
    smaller by m (3/8 r)². The centre of the capsule is h + 3/8 r away from
    that, and so the moment about it is larger again by m (h + 3/8 r)². The
    difference of the two squares is h² + 3/4 h r. The sum over cylinder and
    half-balls is

        I_x = I_y = m_c (r²/4 + h²/3) + m_s (2/5 r² + h² + 3/4 h r)
    """
    r, h = float(radius), float(half_length)
    in_ends = mass * volume(("sphere", r)) / volume(("capsule", r, h))
    in_cylinder = mass - in_ends
    about_z = in_cylinder * r**2 / 2 + in_ends * 2 / 5 * r**2
    of_ends = 2 / 5 * r**2 + h**2 + 3 / 4 * h * r
    about_x = in_cylinder * (r**2 / 4 + h**2 / 3) + in_ends * of_ends
    return np.array([about_x, about_x, about_z])


def _compound(
    mass: float, parts: Sequence[tuple[Shape, ArrayLike, ArrayLike]]
) -> tuple[Array, Array]:
    """The parts' own inertias, and what their distances from the centre add.

    By the theorem of parallel axes, a part of mass m whose centre is at d from
    that of the body adds m (d·d − d dᵀ) to its own inertia.
    """
    volumes = np.array([volume(part) for part, _, _ in parts])
    positive("volume of a compound", volumes.sum())
    masses = mass * volumes / volumes.sum()
    centres, inertias = np.zeros((len(parts), 3)), np.zeros((len(parts), 3, 3))
    for i, (part, position, orientation) in enumerate(parts):
        if masses[i] > 0:
            own_centre, moments, axes = mass_properties(part, masses[i])
            place = finite("position", position)
            centres[i] = place + rotation_matrix(orientation) @ own_centre
            turn = quaternion_product(orientation, axes)
            inertias[i] = world_inertia(moments, turn)
    centre = masses @ centres / mass
    d = centres - centre
    squares = np.vecdot(d, d)[:, None, None] * np.eye(3)
    shifts = squares - d[:, :, None] * d[:, None, :]
    return centre, np.sum(inertias + masses[:, None, None] * shifts, axis=0)


def _polyhedron(
    mass: float, vertices: ArrayLike, faces: Sequence[Sequence[int]]
) -> tuple[Array, Array]:
    """Sums over tetrahedra with their tips at the middle of the vertices.

    A tetrahedron with the tip at 0 and corners a, b, c, whose sum is s, has

        s/4                                 for its centre of mass
        (a aᵀ + b bᵀ + c cᵀ + s sᵀ)/20      for its mean of x xᵀ

    With the mean C of x xᵀ over a body, its inertia is m (tr C − C).
    """
    volumes, corners, middle = tetrahedra(vertices, faces)
    share = volumes / volumes.sum()
    s = corners.sum(axis=1)
    centre = share @ s / 4
    products = np.einsum("tki,tkj->tij", corners, corners)
    products = products + s[:, :, None] * s[:, None, :]
    mean = np.einsum("t,tij->ij", share, products) / 20
    mean = mean - np.outer(centre, centre)
    return middle + centre, mass * (np.trace(mean) * np.eye(3) - mean)


def _principal(inertia: Array) -> tuple[Array, Array]:
    """Moments (3,) along the principal axes, and orientation (4,) of these."""
    moments = np.diag(inertia)
    off_diagonal = np.abs(inertia - np.diag(moments))
    if np.max(off_diagonal) <= ROUNDING_OF_MASS * moments.max():
        return moments, np.array(UPRIGHT)
    moments, axes = np.linalg.eigh(inertia)
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])  # right-handed
    return np.maximum(moments, 0.0), orientation_of(axes)


def _seen_from(shape: Shape, centre: Array, orientation: Array) -> Shape:
    """A polyhedron or a compound in a frame that lies so in its own."""
    kind, *rest = shape
    to_old = rotation_matrix(orientation)
    if kind == "polyhedron":
        vertices, faces = rest
        return kind, (vertices - centre) @ to_old, faces
    back = orientation * OPPOSITE
    parts = (
        (part, (position - centre) @ to_old, quaternion_product(back, turn))
        for part, position, turn in rest[0]
    )
    return kind, tuple(parts)
