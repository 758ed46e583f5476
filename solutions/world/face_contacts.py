"""Where two hulls touch face to face: one face is clipped on the other.

The face whose normal is that of the contact is the reference face, and the
face of the other hull that looks most nearly against it is the incident one.
Seen along the normal, both are convex polygons. The corners of what they have
in common are

- corners of the incident face inside the reference face,
- corners of the reference face inside the incident face, and
- places where two sides cross.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Booleans, Integers
from solutions.world.clipping import ON_SIDE, behind_sides, clip
from solutions.world.hulls import Hull


class Faces(NamedTuple):
    """One face of each of n hulls.

    Attributes
    ----------
    corners : (n, s, 3), m
    normal : (n, 3), unit, out of the face
    vertex : (n, s), part of a contact's feature number for each corner
    edge : (n, s), the same for the side from each corner to the next
    real : (n, s), False where a corner repeats the last one
    """

    corners: Array
    normal: Array
    vertex: Integers
    edge: Integers
    real: Booleans


class Places(NamedTuple):
    """Places where hulls may touch, n pairs with k places each.

    Attributes
    ----------
    point : (n, k, 3), halfway between the two surfaces, m
    separation : (n, k), m; infinite where there is no such place
    feature : (n, k), a number that names the place on the two hulls
    """

    point: Array
    separation: Array
    feature: Integers


def feature_steps(a: Hull, b: Hull) -> tuple[int, int, int]:
    """Where the numbers of B's vertices and of edges begin; a row's length.

    Notes
    -----
    Two hulls touch with a vertex of A, with a vertex of B, or with an edge of
    each. The vertices of A have the numbers 0, 1, …, those of B follow, and
    then come the edges of A with those of B, row by row. A place has the same
    number whichever face is the reference face.
    """
    vertices_a, vertices_b = a.vertices.shape[1], b.vertices.shape[1]
    return vertices_a, vertices_a + vertices_b, len(b.edges.ends)


def face_contacts(
    a: Hull, b: Hull, face_a: Integers, face_b: Integers, on_b: Booleans
) -> Places:
    """Where faces (n,) of A and B touch; the reference is B's where `on_b`."""
    of_b, of_edges, row = feature_steps(a, b)
    slots = max(a.faces.shape[1], b.faces.shape[1])
    first = _chosen(a, face_a, slots, 0, of_edges, row)
    second = _chosen(b, face_b, slots, of_b, 0, 1)
    on = ON_SIDE * np.minimum(a.size, b.size)
    reference = _either(on_b, second, first)
    incident = _either(on_b, first, second)
    return _clipped(reference, incident, on)


def _chosen(
    hull: Hull,
    face: Integers,
    slots: int,
    of_vertices: int,
    of_edges: int,
    row: int,
) -> Faces:
    """One face of each hull; its last corner, repeated, fills the slots."""
    slot = np.minimum(np.arange(slots), hull.faces.shape[1] - 1)
    numbers = hull.faces[face[:, None], slot]
    pair = np.arange(len(face))
    return Faces(
        hull.vertices[pair[:, None], numbers],
        hull.normal[pair, face],
        of_vertices + numbers,
        of_edges + row * hull.edges.number[face[:, None], slot],
        numbers != np.roll(numbers, -1, axis=1),
    )


def _either(chosen: Booleans, yes: Faces, no: Faces) -> Faces:
    """One of two faces of each pair."""
    wide = chosen[:, None]
    return Faces(
        np.where(wide[..., None], yes.corners, no.corners),
        np.where(wide, yes.normal, no.normal),
        np.where(wide, yes.vertex, no.vertex),
        np.where(wide, yes.edge, no.edge),
        np.where(wide, yes.real, no.real),
    )


def _clipped(reference: Faces, incident: Faces, on: Array) -> Places:
    """The corners of what two faces have in common, in slots.

    The first slots are the beginnings of the parts of the incident face's
    sides that are inside. Then come the ends of those that the reference face
    cuts off, and then the corners of the reference face. What is within `on`
    of a side counts as inside where it belongs to the incident face, and as
    outside where it is a corner of the reference face. So a corner that both
    have in common is neither lost nor counted twice.
    """
    normal = reference.normal[:, None]
    near = np.repeat(on[:, None], reference.edge.shape[1], axis=1)
    way = np.roll(incident.corners, -1, axis=1) - incident.corners
    behind = behind_sides(
        incident.corners, reference.corners, reference.normal
    )
    part = clip(behind, np.roll(behind, -1, axis=1), near)
    begin = incident.corners + part.entry[..., None] * way
    end = incident.corners + part.leaving[..., None] * way
    inside = incident.real & part.inside
    # A side that only grazes a corner of the reference face is one place. One
    # that has just reached its own end is none, because the next side begins
    # there.
    length = np.sqrt(np.vecdot(way, way))
    long = (part.leaving - part.entry) * length > 4 * near
    begins = inside & (long | part.cut_out | ~part.cut_in)
    ends = inside & long & part.cut_out
    pair = np.arange(len(on))[:, None]
    cut_by = reference.edge[pair, part.entry_side]
    cut_off_by = reference.edge[pair, part.leaving_side]

    # Seen against its own normal, the incident face runs the other way round.
    within = behind_sides(
        reference.corners, incident.corners, -reference.normal
    )
    slope = np.vecdot(incident.normal, reference.normal)[:, None]
    no_side = ~incident.real[:, None]
    covered = np.all((within > on[:, None, None]) | no_side, axis=2)
    corners = reference.real & covered
    to_incident = incident.corners[:, :1] - reference.corners
    below = np.vecdot(to_incident, incident.normal[:, None])

    on_incident = np.concatenate([begin, end], axis=1)
    height = np.vecdot(on_incident - reference.corners[:, :1], normal)
    foot = on_incident - height[..., None] * normal
    on_reference = np.concatenate([foot, reference.corners], axis=1)
    separation = np.concatenate([height, below / slope], axis=1)
    real = np.concatenate([begins, ends, corners], axis=1)
    beginning = np.where(part.cut_in, incident.edge + cut_by, incident.vertex)
    ending = incident.edge + cut_off_by
    return Places(
        on_reference + normal * (separation / 2)[..., None],
        np.where(real, separation, np.inf),
        np.concatenate([beginning, ending, reference.vertex], axis=1),
    )
