"""Signs that decide what lies inside, by hand."""

from __future__ import annotations

import itertools

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.case import Published

SIDE = 1e-6
"""How much the side of a triangle may differ from the one that is looked for."""


def neighbouring_points(case: Published, code: Implementation) -> Answers:
    """P24: how often the plain test in doubles, which the case is about, differs from the exact sign."""
    i, j = np.meshgrid(*2 * [np.arange(int(case.value("count")))], indexing="ij")
    p = np.array(case.numbers("first")) + np.stack([i, j], axis=-1) * case.value("unit")
    q, r = np.array(case.numbers("q")), np.array(case.numbers("r"))
    u, v = q - p, r - p
    plain = np.sign(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])
    exact = code.function("orient2d")(p, q, r)
    return as_answers(points=float(plain.size), wrong_signs=float(np.sum(plain != exact)))


def star_polyhedra(case: Published, code: Implementation) -> Answers:
    """P34: the winding number of each, with every face as a fan of triangles from one of its corners."""
    golden, point = case.value("golden_ratio"), case.numbers("point")
    signs = itertools.product((1.0, -1.0), repeat=2)
    peaks = np.array([np.roll((0.0, a, b * golden), shift) for a, b in signs for shift in range(3)])
    triangles = _triangles(peaks, 2.0)
    middles = np.mean(peaks[triangles], axis=1)  # the vertices of a dodecahedron
    count = code.function("winding_number")
    solids = {
        "great_dodecahedron": (peaks, _pentagons(peaks, peaks, 1)),
        "small_stellated_dodecahedron": (peaks, _pentagons(peaks, peaks, 2)),
        "great_icosahedron": (peaks, _triangles(peaks, 2 * golden)),
        "great_stellated_dodecahedron": (middles, _pentagons(middles, peaks, 2)),
    }
    return as_answers(**{name: float(count(point, *solid)) for name, solid in solids.items()})


def _triangles(vertices: Array, side: float) -> Array:
    """All equilateral triangles of that side, turned so that their normal points away from the middle, (n, 3)."""
    found = np.array(list(itertools.combinations(range(len(vertices)), 3)))
    corners = vertices[found]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1)
    found, corners = (part[np.all(np.abs(sides - side) < SIDE, axis=-1)] for part in (found, corners))
    inwards = np.linalg.det(corners) < 0
    found[inwards] = found[inwards, ::-1]
    return found


def _pentagons(vertices: Array, axes: Array, step: int) -> Array:
    """Across each axis, the five vertices on the plane next to the outermost, as a fan of three triangles, (n, 3).

    step: 1 joins neighbours to a pentagon, 2 every other vertex to a pentagram.
    """
    fans = []
    for axis in axes:
        heights = np.round(vertices @ axis, 6)
        ring = np.flatnonzero(heights == np.unique(heights)[-2])
        across = vertices[ring] - np.outer(heights[ring], axis) / (axis @ axis)
        turned = np.cross(axis, across[0]) / np.linalg.norm(axis)
        order = ring[np.argsort(np.arctan2(across @ turned, across @ across[0]))]
        a, *rest = order[np.arange(5) * step % 5]
        fans += [(a, b, c) for b, c in itertools.pairwise(rest)]
    return np.array(fans)
