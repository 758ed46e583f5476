"""The convex pieces of bodies, and where they are at an instant."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from solutions.arrays import Array, Integers
from solutions.checks import finite, in_space, positive, unit, vector
from solutions.impulse import rotation_matrix
from solutions.world.boxes import BOX_FACES, BOX_VERTICES
from solutions.world.hulls import checked_solid
from solutions.world.shapes import (
    BOX,
    CAPSULE,
    HALF_SPACE,
    POLYHEDRON,
    SPHERE,
    Placed,
    Shape,
)
from solutions.world.vectors import tangents

NEEDS = {
    "sphere": ("radius",),
    "capsule": ("radius", "half_length"),
    "box": ("half_extents",),
    "polyhedron": ("vertices", "faces"),
    "half-space": ("normal",),
    "compound": ("parts",),
}
"""What the tuple of each kind of shape contains after its name."""
NO_FACES = np.zeros((0, 3), dtype=np.int64)


class Pieces(NamedTuple):
    """All convex pieces of a world, p of them.

    Attributes
    ----------
    body : (p,), the body to which each belongs
    kind : (p,), SPHERE to HALF_SPACE
    size : (p, 3), m, as in `Placed`
    position : (p, 3), of its origin in the body's own axes, m
    rotation : (p, 3, 3), from its own axes to the body's
    hull : (p,), which of the hulls it is; −1 for a piece without corners
    hulls : the vertices (v, 3) and the faces (f, s) of each hull
        In the piece's own axes, m. All boxes have the same hull, ±1 along each
        axis, times their size.
    """

    body: Integers
    kind: Integers
    size: Array
    position: Array
    rotation: Array
    hull: Integers
    hulls: tuple[tuple[Array, Integers], ...]

    def rows(self, chosen: Integers) -> Pieces:
        """Some of the pieces, in the order given."""
        return Pieces(
            self.body[chosen],
            self.kind[chosen],
            self.size[chosen],
            self.position[chosen],
            self.rotation[chosen],
            self.hull[chosen],
            self.hulls,
        )


def pieces_of(shapes: Sequence[Shape]) -> Pieces:
    """The convex pieces of bodies with these shapes.

    Parameters
    ----------
    shapes : n shapes, as `solutions.world.shapes` describes them

    Raises
    ------
    ValueError
        If there is no such kind of shape, it has another number of parts, a
        size is not positive and finite, or a polyhedron is none.
    """
    body, kind, size, position, rotation, hull = [], [], [], [], [], []
    hulls: list[tuple[Array, Integers]] = [(BOX_VERTICES, BOX_FACES)]
    for number, whole in enumerate(shapes):
        for shape, place, turn in _convex(whole, np.zeros(3), np.eye(3)):
            which, lengths, its_hull = HALF_SPACE, [0.0, 0.0, 0.0], -1
            if shape[0] == "sphere":
                which = SPHERE
                lengths = [_length(shape[1]), 0.0, 0.0]
            elif shape[0] == "capsule":
                which = CAPSULE
                lengths = [_length(shape[1]), _length(shape[2]), 0.0]
            elif shape[0] == "box":
                which, its_hull = BOX, 0
                half_extents = vector("half_extents", shape[1])
                lengths = [_length(half) for half in half_extents]
            elif shape[0] == "polyhedron":
                which = POLYHEDRON
                vertices = in_space("vertices", shape[1])
                its_hull = _place_of(hulls, vertices, shape[2])
            else:
                normal = unit("normal", vector("normal", shape[1]))
                turn = turn @ _axes_along(normal)
            body.append(number)
            kind.append(which)
            size.append(lengths)
            position.append(place)
            rotation.append(turn)
            hull.append(its_hull)
    return Pieces(
        np.array(body, dtype=np.int64),
        np.array(kind, dtype=np.int64),
        np.array(size).reshape(-1, 3),
        np.array(position).reshape(-1, 3),
        np.array(rotation).reshape(-1, 3, 3),
        np.array(hull, dtype=np.int64),
        tuple(hulls),
    )


def _convex(
    shape: Shape, position: Array, rotation: Array
) -> Iterator[tuple[Shape, Array, Array]]:
    """A shape's convex pieces, each with its place in the body."""
    kind = shape[0] if isinstance(shape, tuple | list) and shape else None
    if kind not in NEEDS:
        raise ValueError(
            f"shape must be a tuple that begins with {', '.join(NEEDS)}, not"
            f" {kind or shape!r}"
        )
    if len(shape) != 1 + len(NEEDS[kind]):
        raise ValueError(
            f"a {kind} needs {', '.join(NEEDS[kind])}, not {len(shape) - 1}"
            " numbers or arrays"
        )
    if kind != "compound":
        yield shape, position, rotation
        return
    if not len(shape[1]):
        raise ValueError("a compound must have parts, not none")
    for part, place, orientation in shape[1]:
        yield from _convex(
            part,
            position + rotation @ in_space("position", place),
            rotation @ rotation_matrix(orientation),
        )


def _length(value: float) -> float:
    return float(positive("size of a shape", finite("size of a shape", value)))


def _place_of(
    hulls: list[tuple[Array, Integers]],
    vertices: Array,
    faces: Sequence[Sequence[int]],
) -> int:
    """Where a hull stands in the list; one that is not there yet is added."""
    longest = max((len(face) for face in faces), default=0)
    padded = np.array(
        [[*face, *[face[-1]] * (longest - len(face))] for face in faces]
    )
    # The first is that of the boxes, whose vertices are multiplied by a size.
    for place, (others, their_faces) in enumerate(hulls[1:], 1):
        same = np.array_equal(others, vertices)
        if same and np.array_equal(their_faces, padded):
            return place
    hulls.append(checked_solid(vertices, padded))
    return len(hulls) - 1


def _axes_along(normal: Array) -> Array:
    """A rotation whose third column is the normal, (3, 3)."""
    first, second = tangents(normal)
    return np.stack([first, second, normal], axis=-1)


def place_pieces(
    pieces: Pieces, position: Array, orientation: Array
) -> tuple[Array, Array]:
    """Where the pieces are when their bodies are at these places.

    Parameters
    ----------
    pieces : p pieces
    position : (n, 3), of the bodies, m
    orientation : (n, 4), of the bodies, unit quaternions

    Returns
    -------
    position : (p, 3), of the origin of each piece, m
    rotation : (p, 3, 3), from its own axes to the world's
    """
    of_body = rotation_matrix(orientation)[pieces.body]
    arm = np.matvec(of_body, pieces.position)
    return position[pieces.body] + arm, of_body @ pieces.rotation


def placed(
    pieces: Pieces, chosen: Integers, position: Array, rotation: Array
) -> Placed:
    """The chosen pieces (k,), of one kind and hull, at these places."""
    at, turn, size = position[chosen], rotation[chosen], pieces.size[chosen]
    hull = pieces.hull[chosen[0]]
    if hull < 0:
        return Placed(at, turn, size, np.zeros((len(chosen), 0, 3)), NO_FACES)
    corners, faces = pieces.hulls[hull]
    if hull == 0:
        own = corners * size[:, None, :]
    else:
        own = np.broadcast_to(corners, (len(chosen), *corners.shape))
    return Placed(at, turn, size, at[:, None, :] + own @ turn.mT, faces)


def bounding_boxes(
    pieces: Pieces, position: Array, rotation: Array
) -> tuple[Array, Array]:
    """Lowest and highest corner (p, 3) of a box around each piece, m."""
    middle, reach = position.copy(), np.zeros_like(position)
    for kind in np.unique(pieces.kind):
        chosen = np.flatnonzero(pieces.kind == kind)
        turn, size = rotation[chosen], pieces.size[chosen]
        if kind == SPHERE:
            reach[chosen] = size[:, :1]
        elif kind == CAPSULE:
            reach[chosen] = size[:, :1] + size[:, 1:2] * np.abs(turn[:, :, 2])
        elif kind == BOX:
            reach[chosen] = np.matvec(np.abs(turn), size)
        elif kind == HALF_SPACE:
            reach[chosen] = np.inf
        else:
            for hull in np.unique(pieces.hull[chosen]):
                some = chosen[pieces.hull[chosen] == hull]
                corners = placed(pieces, some, position, rotation).vertices
                low, high = np.min(corners, axis=1), np.max(corners, axis=1)
                middle[some] = (low + high) / 2
                reach[some] = (high - low) / 2
    return middle - reach, middle + reach
