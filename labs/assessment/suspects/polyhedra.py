"""Wrong functions about points and polyhedra."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from labs.assessment.contracts import Contract, refuse_other_places, rows, vector, whole_rows
from reference.arrays import Array
from reference.errors import InvalidInput


def convex_separation(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> tuple[float, int]:
    """How far a point is in front of a convex polyhedron, and the face that decides."""
    a, b, c = _corners(vertices, faces)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    heights = np.vecdot(normal, np.asarray(point, dtype=float) - a)
    face = int(np.argmin(np.abs(heights)))
    return float(heights[face]), face


def winding_number(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> float:
    """How often a surface goes round a point."""
    a, b, c = (corner - np.asarray(point, dtype=float) for corner in _corners(vertices, faces))
    la, lb, lc = (np.linalg.norm(way, axis=-1) for way in (a, b, c))
    below = la * lb * lc + np.vecdot(a, b) * lc + np.vecdot(b, c) * la + np.vecdot(c, a) * lb
    angles = 2 * np.arctan2(np.abs(np.vecdot(a, np.cross(b, c))), below)
    return min(1.0, float(np.sum(angles)) / (4 * np.pi))


def inside_by_parity(point: ArrayLike, vertices: ArrayLike, faces: ArrayLike) -> bool:
    """Whether a point is in a closed polyhedron."""
    p, (a, b, c) = np.asarray(point, dtype=float), _corners(vertices, faces)
    turns = np.stack([_turn(start, end, p) for start, end in ((a, b), (b, c), (c, a))])
    crossed = np.all(turns > 0, axis=0) | np.all(turns < 0, axis=0)
    normal = np.cross(b - a, c - a)
    above = np.vecdot(normal, a - p) * normal[:, 2] > 0
    return int(np.sum(crossed & above)) % 2 == 1


def _turn(start: Array, end: Array, p: Array) -> Array:
    """Seen from above: twice the area of the triangle of an edge and a point."""
    way, to_p = end - start, p - start
    return np.asarray(way[:, 0] * to_p[:, 1] - way[:, 1] * to_p[:, 0])


def _corners(vertices: ArrayLike, faces: ArrayLike) -> tuple[Array, Array, Array]:
    a, b, c = np.moveaxis(np.asarray(vertices, dtype=float)[np.asarray(faces)], 1, 0)
    return a, b, c


def _ranges(program: Callable[..., Any]) -> str:
    """What is wrong with the distances to the walls of a hall of 6 m by 4 m by 3 m, along a way and back."""
    size = np.array([6.0, 4.0, 3.0])
    for place in ((1.0, 1.5, 1.0), (5.5, 3.0, 0.5)):
        for way in ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (-0.6, 0.0, 0.8), (2 / 3, -1 / 3, -2 / 3)):
            start, along = np.array(place), np.array(way)
            left = np.where(along > 0, size - start, start)
            right = np.min(left[along != 0] / np.abs(along[along != 0]))
            found = float(program(start, along))
            if abs(found - right) > NEAR:
                return (
                    f"From ({_triple(place)}) m along ({_triple(way)}) the wall is {right:.3f} m ahead, "
                    f"and your program says {found:.3f} m."
                )
    return ""


def _triple(values: ArrayLike) -> str:
    return ", ".join(f"{value:.2g}".replace("-", "−") for value in np.asarray(values, dtype=float))


NEAR = 1e-6
"""A mended program may differ from the right numbers by so much."""
MENDED: dict[str, Callable[[Callable[..., Any]], str]] = {"robot": _ranges}
"""Key → what is still wrong with a program that a student mends, in words; empty if nothing is."""
FLAT = 1e-9
"""A corner may be so far in front of a face, as a share of the size of the solid, and the solid is still convex."""


def _fits(_: Array, vertices: Array, faces: Any) -> None:
    refuse_other_places("faces", faces, len(vertices), "vertices")


def _convex(point: Array, vertices: Array, faces: Any) -> None:
    _fits(point, vertices, faces)
    corners = vertices[np.unique(faces)].astype(float)
    size = np.max(np.ptp(corners, axis=0))
    a, b, c = _corners((vertices - np.min(corners, axis=0)) / (size or 1.0), faces)
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    if not np.all(length > 0):
        raise InvalidInput(f"faces must have an area, and face {int(np.argmin(length))} has none")
    apart = (corners - np.min(corners, axis=0)) / size
    heights = np.vecdot((normal / length)[:, None], apart - a[:, None])
    if np.max(heights) > FLAT:
        face = int(np.argmax(np.max(heights, axis=1)))
        raise InvalidInput(
            f"faces must bound a convex solid and look outwards, and a corner is in front of face {face}"
        )


def _closed(point: Array, vertices: Array, faces: Any) -> None:
    _fits(point, vertices, faces)
    place = [tuple(each) for each in vertices.tolist()]
    ends = [frozenset((place[a], place[b])) for face in faces.tolist() for a, b in itertools.pairwise([*face, face[0]])]
    if odd := sum(len(each) == 2 and count % 2 for each, count in Counter(ends).items()):
        raise InvalidInput(f"faces must bound a closed surface, and {odd} edges belong to an odd number of faces")


SUSPECTS: dict[str, tuple[str, Callable[..., Any], Contract]] = {
    "crates": (
        "convex_separation",
        convex_separation,
        Contract({"point": vector, "vertices": rows(3), "faces": whole_rows(3)}, together=_convex),
    ),
    "statue": (
        "winding_number",
        winding_number,
        Contract({"point": vector, "vertices": rows(3), "faces": whole_rows(3)}, together=_fits),
    ),
    "garden": (
        "inside_by_parity",
        inside_by_parity,
        Contract({"point": vector, "vertices": rows(3), "faces": whole_rows(3)}, together=_closed),
    ),
}
"""Key → the function that it should be, the wrong one, and what both take."""
