"""Probes of the functions about points, edges and polyhedra."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import ArrayLike

from labs.grading.diagnosis.probes.probe import YES_OR_NO, Arguments, Draw, Probe, edge, made, refused, usual
from reference.arrays import Array

Mesh = tuple[Array, Array]
SIDES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
"""The slanted side of a tetrahedron, then those at its corner 0; all look outwards."""
TETRAHEDRON = np.array([[1.0, -2, 3], [5, 2, 1], [0, 0, 5], [3, -3, 5]])
CUBE = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
CUBE_FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
     [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
"""Two triangles for each side of a cube of 2 m around the origin."""
OCTAHEDRON = 3 * np.concatenate([np.eye(3), -np.eye(3)])
EIGHT = np.array([[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]])
L_SOLID = np.array(
    [[x, y, z] for z in (0.0, 2.0) for x, y in ((0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3))], dtype=float
)
L_FACES = np.array(
    [[2, 1, 0], [3, 2, 0], [4, 3, 0], [5, 4, 0], [6, 7, 8], [6, 8, 9], [6, 9, 10], [6, 10, 11],
     [0, 1, 7], [0, 7, 6], [1, 2, 8], [1, 8, 7], [2, 3, 9], [2, 9, 8],
     [3, 4, 10], [3, 10, 9], [4, 5, 11], [4, 11, 10], [5, 0, 6], [5, 6, 11]]
)  # fmt: skip
"""An L with arms 1 m wide and 3 m long, 2 m high. Its pocket is where x and y are both above 1."""
AXES = np.array([[2.0, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3
PLACE = np.array([1.0, -2, 3])
UNEVEN = YES_OR_NO + 1
"""One more is drawn where the opposite of all answers is a known mistake: with 40, its deviations cancel in a call."""
NOTHING = np.empty((0, 3), dtype=int)


def probes(function: str) -> tuple[Probe, ...]:
    """The probes of one of this topic's functions."""
    return tuple(_TABLE[function]())


def _turned(points: ArrayLike) -> Array:
    """Points of the L's own axes, turned and displaced."""
    return np.asarray((PLACE + np.asarray(points, dtype=float) @ AXES.T).round(6))


L_TURNED = _turned(L_SOLID)


def _tetrahedron(draw: Draw) -> Array:
    """Corners of a tetrahedron, turned so that `SIDES` look outwards."""
    while True:
        corners = np.array([draw.vector() for _ in range(4)])
        sides = corners[1:] - corners[0]
        volume = np.linalg.det(sides)
        lengths = np.linalg.norm(sides, axis=-1)
        if abs(volume) > 0.1 * np.prod(lengths):
            return corners if volume > 0 else corners[[0, 2, 1, 3]]


def _planes() -> list[Probe]:
    lying = [[1, 1, 2], [4, 1, 2], [1, 5, 2], [7, 7, 7]]
    triangle = np.array([[0, 1, 2]])
    by_hand = [
        usual("a face that lies flat", lying, triangle),
        usual("the same turned over", lying, triangle[:, ::-1]),
        usual("a tetrahedron", TETRAHEDRON, SIDES),
        usual("a cube around the origin", CUBE, CUBE_FACES),
        usual("an L, turned", L_TURNED, L_FACES),
        edge("a plane through the origin", [[0, 0, 0], [2, 0, 1], [0, 3, 1]], triangle),
        edge("a large face", 1e6 * TETRAHEDRON, SIDES[:1]),
        edge("a small face", 1e-3 * TETRAHEDRON, SIDES[1:]),
        edge("a face of micrometres", 1e-6 * TETRAHEDRON, SIDES[1:]),
        edge("a long and thin face", [[0, 0, 0], [100, 0, 0], [50, 0.01, 0]], triangle),
        refused("a face without area", [[0, 0, 0], [1, 2, 3], [2, 4, 6]], triangle),
        refused("a face of a vertex that is not there", lying, np.array([[0, 1, 4]])),
        refused("a vertex that is no number", [[0, 0, 0], [1, 0, 0], [0, float("nan"), 0]], triangle),
    ]
    return made("face_planes", by_hand, lambda draw: (_tetrahedron(draw), SIDES), single=range(2))


def _separation() -> list[Probe]:
    mesh, middle = (TETRAHEDRON, SIDES), TETRAHEDRON.mean(axis=0)
    by_hand = [
        usual("in the middle of a tetrahedron", middle, *mesh),
        usual("close to its slanted face", [2.5, -0.5, 3.8], *mesh),
        usual("before its slanted face", [5, 1.5, 6], *mesh),
        usual("beyond a corner", [8, 5.5, 0.25], *mesh),
        usual("beyond an edge", [3, -3, 1], *mesh),
        usual("beyond the corner of a cube by 1 m along each axis", [2, 2, 2], CUBE, CUBE_FACES),
        usual("beyond its edge, more to one side", [0.25, 4, 2], CUBE, CUBE_FACES),
        usual("in a cube, near a side", [0.125, -0.75, 0.5], CUBE, CUBE_FACES),
        edge("in the middle of a cube", [0, 0, 0], CUBE, CUBE_FACES),
        edge("on a side of a cube", [0.25, 1, 0.5], CUBE, CUBE_FACES),
        edge("at a corner of a cube", [1, -1, 1], CUBE, CUBE_FACES),
        edge("very far away", [1e6, -2e6, 1e6], *mesh),
        edge("a cube with a vertex of no face far away", [0.5, 0.25, 0.125], [*CUBE, [9, 9, 9]], CUBE_FACES),
        refused("a concave solid", [0.5, 0.5, 0.5], L_SOLID, L_FACES),
        refused("a solid turned inside out", middle, TETRAHEDRON, SIDES[:, ::-1]),
        refused("a point that is no number", [0, float("nan"), 0], *mesh),
        refused("no face", [0, 0, 0], TETRAHEDRON, NOTHING),
    ]

    def maker(draw: Draw) -> Arguments:
        point = TETRAHEDRON[draw.rng.integers(4)] + draw.vector(draw.rng.choice([1.0, 4.0]))
        return (0.4 * middle + 0.6 * point).round(2), *mesh

    return made("convex_separation", by_hand, maker, count=YES_OR_NO, single=(1, 2))


CORNERS = np.array([[-2.0, -2, -0.5], [2, 0, -1.5], [-1, 4, 1.5]])
"""A triangle along no axis."""


def _through(weights: ArrayLike, fraction: float, way: ArrayLike, corners: Array = CORNERS) -> Arguments:
    """A segment that meets the plane of a triangle at the point with these weights, at this fraction."""
    place, along = np.asarray(weights) @ corners, np.asarray(way, dtype=float)
    return place - fraction * along, place + (1 - fraction) * along, corners


def _triangle() -> list[Probe]:
    down = [-0.5, 1, -8]
    flat = [[0, 0, 0], [4, 0, 0], [0, 4, 0]]
    by_hand = [
        usual("from the front through the middle", *_through([0.25, 0.5, 0.25], 0.25, down)),
        usual("from the back", *_through([0.5, 0.125, 0.375], 0.75, [3, 2, 4])),
        usual("beside the triangle, opposite the first corner", *_through([-0.25, 0.75, 0.5], 0.5, down)),
        usual("beside it, opposite the second", *_through([0.75, -0.25, 0.5], 0.5, down)),
        usual("beside it, opposite the third", *_through([0.5, 0.75, -0.25], 0.5, down)),
        usual("beyond the first corner", *_through([1.75, -0.25, -0.5], 0.5, down)),
        usual("beyond the second corner", *_through([-0.5, 1.75, -0.25], 0.5, down)),
        usual("beyond the third corner", *_through([-0.25, -0.5, 1.75], 0.5, down)),
        usual("it does not come as far", *_through([0.25, 0.5, 0.25], 1.25, down)),
        usual("it starts behind the triangle", *_through([0.25, 0.5, 0.25], -0.5, down)),
        usual("straight down on a triangle that lies flat", [1, 1, 3], [1, 1, -1], flat),
        usual("an upright triangle", [-1, 1, 1], [3, 1.5, 0.5], [[0, 0, 0], [0, 4, 0], [0, 0, 4]]),
        usual("another upright triangle", [1, 2, 1], [1.5, -2, 0.5], [[0, 0, 0], [4, 0, 0], [0, 0, 4]]),
        usual("past an upright triangle", [-1, 3, 3], [3, 3.5, 2.5], [[0, 0, 0], [0, 4, 0], [0, 0, 4]]),
        edge("along the plane of the triangle, beside it", [1, 1, 2], [3, 1, 2], flat),
        edge("hardly into the triangle", *_through([0.25, 0.5, 0.25], 0.999, down)),
        edge("from just before the triangle", *_through([0.25, 0.5, 0.25], 0.001, down)),
        edge("all a thousand times smaller", *(0.001 * part for part in _through([0.5, 0.125, 0.375], 0.5, down))),
        edge("all in micrometres", *(1e-6 * part for part in _through([0.25, 0.5, 0.25], 0.25, down))),
        edge("close to a side, within", *_through([0.001, 0.5, 0.499], 0.5, down)),
        edge("close to a side, beyond", *_through([-0.001, 0.5, 0.501], 0.5, down)),
        refused("a triangle without area", [1, 1, 1], [1, 1, -1], [[0, 0, 0], [1, 2, 0], [2, 4, 0]]),
        refused("an end that is no number", [1, float("nan"), 1], [1, 1, -1], flat),
    ]

    def maker(draw: Draw) -> Arguments:
        corners = np.array([draw.vector() for _ in range(3)])
        while np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0])) < 6:
            corners = np.array([draw.vector() for _ in range(3)])
        first, second = sorted((draw.number(0.1, 0.45), draw.number(0.55, 0.9)))
        weights = np.array([first, second - first, 1 - second])
        if draw.rng.integers(3) == 0:
            weights = np.array([1.4, 1.2, 1.3]) - 2 * weights[draw.rng.permutation(3)]
            weights /= weights.sum()
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        way = draw.sign() * normal / np.linalg.norm(normal) * draw.number(1, 6) + draw.vector(0.5)
        fraction = draw.number(0.1, 0.9) if draw.rng.integers(5) else draw.number(1.1, 2)
        return tuple(np.round(part, 4) for part in _through(weights, fraction, way, corners))

    return made("segment_triangle", by_hand, maker, count=YES_OR_NO)


def _side() -> list[Probe]:
    by_hand = [
        usual("to the left of a line along x", [0, 0], [2, 0], [1, 1]),
        usual("to the right of it", [0, 0], [2, 0], [1, -1]),
        usual("to the left of a line against x", [2, 1], [0, 1], [1, -3]),
        usual("to the left of a line along y", [1, 0], [1, 5], [-2, 3]),
        usual("to the right of a slanted line", [1, -2], [4, 3], [4, -1]),
        usual("beyond the second point", [1, -2], [4, 3], [9, 9]),
        usual("before the first point", [1, -2], [4, 3], [-2, -6]),
        edge("on the line, between the points", [1, -2], [4, 3], [2.5, 0.5]),
        edge("on the line, beyond them", [1, -2], [4, 3], [7, 8]),
        edge("at the first point", [1, -2], [4, 3], [1, -2]),
        edge("at the second point", [1, -2], [4, 3], [4, 3]),
        edge("no line", [1, -2], [1, -2], [4, 3]),
        edge("all three points at the origin", [0, 0], [0, 0], [0, 0]),
        edge("hardly to the left", [0, 0], [1, 2], [1, 2.001]),
        edge("a tenth of a thousandth of a millimetre", [0, 0], [1e-7, 2e-7], [-1e-7, 1e-7]),
        edge("very long", [0, 0], [1e6, 2e6], [1e6, -1e6]),
        refused("a coordinate that is no number", [0, 0], [1, float("nan")], [1, 1]),
        refused("points in space", [0, 0, 0], [1, 0, 0], [0, 1, 0]),
    ]

    def maker(draw: Draw) -> Arguments:
        return tuple(draw.vector()[:2] for _ in range(3))

    return made("side_of_line", by_hand, maker, count=UNEVEN)


def _in_l(draw: Draw) -> Array:
    """A point in an arm of the turned L, or anywhere in or around it, at a distance from its surface."""
    if draw.rng.integers(3) == 0:
        along, across = draw.number(0.1, 2.9), draw.number(0.1, 0.9)
        return _turned(np.array([*(along, across)[:: draw.sign()], draw.number(0.1, 1.9)]))
    while True:
        own = np.array([draw.number(-0.9, 3.9), draw.number(-0.9, 3.9), draw.number(-0.5, 2.5)])
        if np.min(np.abs(own[:, None] - [[0, 1, 3], [0, 1, 3], [0, 2, 2]])) > 0.05:
            return _turned(own)


def _parity() -> list[Probe]:
    in_two, on_top = (
        (np.concatenate([CUBE, CUBE + aside]), np.concatenate([CUBE_FACES, CUBE_FACES + 8]))
        for aside in ([5, 0, 0], [0, 0, 5])
    )
    tip = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 3]])
    one_turned = np.array([[0, 3, 1], *CUBE_FACES[1:].tolist()])
    tenths = np.array([[0.1, 0.2, 0.3], [1.3, 0.5, 0.1], [0.4, 1.7, 0.2], [0.7, 0.8, 1.9]])
    nested = np.concatenate([CUBE, 3 * CUBE + 0.125]), np.concatenate([CUBE_FACES, CUBE_FACES + 8])
    by_hand = [
        usual("in the arm of an L", _turned([2.6, 0.3, 1.1]), L_TURNED, L_FACES),
        usual("in its other arm", _turned([0.4, 2.7, 0.9]), L_TURNED, L_FACES),
        usual("in its corner", _turned([0.3, 0.4, 0.5]), L_TURNED, L_FACES),
        usual("in its pocket", _turned([1.7, 1.4, 0.9]), L_TURNED, L_FACES),
        usual("below it", _turned([0.7, 0.6, -1.3]), L_TURNED, L_FACES),
        usual("above it", _turned([0.7, 0.6, 2.3]), L_TURNED, L_FACES),
        usual("in an L that lies upright", [0.3, 0.6, 0.7], L_SOLID, L_FACES),
        usual("below an L that lies upright", [0.3, 0.6, -0.7], L_SOLID, L_FACES),
        usual("beside its arm", [0.3, -0.5, 0.7], L_SOLID, L_FACES),
        usual("between two cubes", [2.5, 0.125, 0.25], *in_two),
        usual("in the second of two cubes", [5.25, 0.125, 0.375], *in_two),
        usual("in the first of two cubes, towards the second", [0.25, 0.125, 0.375], *in_two),
        usual("in the lower of two cubes, one above the other", [0.25, 0.125, 0.375], *on_top),
        usual("between two cubes, one above the other", [0.25, 0.125, 2.5], *on_top),
        usual("between two cubes, close to the upper one", [-0.5, 0.375, 3.875], *on_top),
        usual("in a hollow", [0.25, 0.125, 0.375], *nested),
        usual("in the wall of a hollow solid", [1.75, 0.125, 0.375], *nested),
        usual("in a solid turned inside out", [0.3, 0.6, 0.7], L_SOLID, L_FACES[:, ::-1]),
        usual("in a cube with one face turned over", [-0.9, -0.3, 0.3], CUBE, one_turned),
        usual("beside a cube with one face turned over", [-1.1, -0.3, 0.3], CUBE, one_turned),
        usual("in a cube of two kilometres", [300, 125, -250], 1000 * CUBE, CUBE_FACES),
        usual("in a cube of two millimetres", [0.0003, 0.00025, -0.0005], 0.001 * CUBE, CUBE_FACES),
        edge("in the middle of a cube: the diagonals of its sides", [0, 0, 0], CUBE, CUBE_FACES),
        edge("in a cube, a diagonal above", [0.5, 0.5, 0.25], CUBE, CUBE_FACES),
        edge("in the middle of an octahedron: its corners", [0, 0, 0], OCTAHEDRON, EIGHT),
        edge("in an octahedron: its edges", [1, 0, 0.5], OCTAHEDRON, EIGHT),
        edge("in a tetrahedron, straight below its tip", [1, 1, 1], tip, SIDES),
        edge("below a tetrahedron, straight below its tip", [1, 1, -1], tip, SIDES),
        edge("below an edge of an octahedron", [1, 0, -5], OCTAHEDRON, EIGHT),
        edge("below a corner of an octahedron", [0, 0, -5], OCTAHEDRON, EIGHT),
        edge("below its widest corner, which a ray only touches", [3, 0, -5], OCTAHEDRON, EIGHT),
        edge("below its widest edge, which a ray only touches", [1, 2, -5], OCTAHEDRON, EIGHT),
        edge("below the first edge of a tetrahedron, as far as floats can tell", [0.4, 0.275, -0.75], tenths, SIDES),
        edge("below another edge of it", [0.175, 0.575, -0.725], tenths, SIDES),
        edge("in it, below a third edge", [0.3, 0.4, 0.7], tenths, SIDES),
        edge("a wall above, along the ray", [1, 2, -1], L_SOLID, L_FACES),
        edge("in an L, on the level of its edges", [0.5, 1, 1], L_SOLID, L_FACES),
        edge("in the pocket, beyond an edge of the L", [3, 2, 1], L_SOLID, L_FACES),
        edge("close to the surface, within", [0.5, 0.375, 1.999999], L_SOLID, L_FACES),
        edge("close to the surface, outside", [0.5, 0.375, 2.000001], L_SOLID, L_FACES),
        edge("far away", [1e6, 2e6, -3e6], L_TURNED, L_FACES),
        edge("in a speck of a cube, a diagonal above", [0, 0, 0], 2.0**-40 * CUBE, CUBE_FACES),
        edge("in a cube far away, a diagonal above", [3 * 2.0**40] * 3, 3 * 2.0**40 + 2.0**20 * CUBE, CUBE_FACES),
        edge("no face", [0, 0, 0], CUBE, NOTHING),
        refused("an open surface", [0, 0, 0], CUBE, CUBE_FACES[1:]),
        refused("a point that is no number", [0, 0, float("nan")], CUBE, CUBE_FACES),
        refused("a face of a vertex that is not there", [0, 0, 0], CUBE, CUBE_FACES + 1),
    ]
    maker = lambda draw: (_in_l(draw), L_TURNED, L_FACES)  # noqa: E731
    return made("inside_by_parity", by_hand, maker, count=UNEVEN, single=(1, 2))


def _winding() -> list[Probe]:
    octant, face = [[2, 0, 0], [0, 3, 0], [0, 0, 5]], np.array([[0, 1, 2]])
    by_hand = [
        usual("in a cube", [0.125, -0.25, 0.5], CUBE, CUBE_FACES),
        usual("in an L", _turned([2.6, 0.3, 1.1]), L_TURNED, L_FACES),
        usual("in the pocket of an L without its floor", _turned([1.7, 1.4, 0.9]), L_TURNED, L_FACES[4:]),
        usual("an eighth of the sphere", [0, 0, 0], octant, face),
        usual("the front of it", [0, 0, 0], octant, face[:, ::-1]),
        usual("a triangle along no axis", [-2, 0, 4.5], CORNERS, face),
        usual("close before a triangle: almost half of the sphere", [-0.375, 0.5, 0.0], CORNERS, face),
        usual("turned inside out", [0.125, -0.25, 0.5], CUBE, CUBE_FACES[:, ::-1]),
        usual("a cube without a face", [0.25, 0.125, 0.5], CUBE, CUBE_FACES[1:]),
        usual("without a face, outside", [-2, 0.125, 0.5], CUBE, CUBE_FACES[1:]),
        usual("one face turned over", [0.25, 0.125, 0.5], CUBE, np.array([[0, 3, 1], *CUBE_FACES[1:].tolist()])),
        usual("twice round", [0.25, 0.125, 0.5], CUBE, np.concatenate([CUBE_FACES, CUBE_FACES])),
        edge("in the middle of a cube", [0, 0, 0], CUBE, CUBE_FACES),
        edge("on a side of a cube", [1, 0.25, 0.5], CUBE, CUBE_FACES),
        edge("at a corner of a cube", [1, 1, 1], CUBE, CUBE_FACES),
        edge("on an edge of a cube", [1, 0.25, 1], CUBE, CUBE_FACES),
        edge("in the plane of a triangle, beside it", [9, 9, 2], [[0, 0, 2], [3, 0, 2], [0, 4, 2]], face),
        edge("no face", [1, 2, 3], CUBE, NOTHING),
        edge("far away", [30, -40, 20], L_TURNED, L_FACES[4:]),
        Probe(
            (np.array([[0.5, 0.25, 0], [3, 0.5, 0.25], [-40, 7, 9]]), CUBE, CUBE_FACES), "many", "inside and outside"
        ),
        edge("a triangle without area", [1, 2, 3], [[0, 0, 0], [1, 1, 0], [2, 2, 0]], face),
        refused("a point that is no number", [0, float("nan"), 0], CUBE, CUBE_FACES),
        refused("a face of a vertex that is not there", [0, 0, 0], CUBE, CUBE_FACES + 1),
    ]

    def maker(draw: Draw) -> Arguments:
        return _in_l(draw), L_TURNED, L_FACES[3:]

    return made("winding_number", by_hand, maker, single=(1, 2))


def _box(low: ArrayLike, size: ArrayLike) -> Mesh:
    """A box in the axes of the turned L."""
    return _turned(_upright(low, size)[0]), CUBE_FACES


def _upright(low: ArrayLike, size: ArrayLike) -> Mesh:
    """A box along the axes."""
    return np.asarray(np.asarray(low) + (CUBE + 1) / 2 * np.asarray(size)), CUBE_FACES


def _intersect() -> list[Probe]:
    cube, l_solid = _box(np.zeros(3), [2, 2, 2]), (L_TURNED, L_FACES)
    bar, within = _box([1.2, 0.2, -2], [0.3, 0.2, 7]), _box([0.5, 0.7, 0.8], [0.3, 0.4, 0.5])
    corner, aside = _box([1.5, 1.3, 1.2], [3, 2, 4]), _box([2.3, 0.2, 0.1], [1, 2, 3])
    pocketed, crossing = _box([1.2, 1.3, 0.4], [1.5, 1.6, 1]), _box([1.4, -0.5, 0.6], [0.4, 3, 0.5])
    one = _upright([0, 0, 0], [2, 2, 2])
    shell = np.concatenate([cube[0], within[0]]), np.concatenate([CUBE_FACES, CUBE_FACES[:, ::-1] + 8])
    crumb = _box([0.55, 0.75, 0.85], [0.1, 0.1, 0.1])
    parts = np.concatenate([crumb[0], aside[0]]), np.concatenate([CUBE_FACES, CUBE_FACES + 8])
    turned_parts = np.concatenate([aside[0], crumb[0]]), parts[1]
    pairs = [
        ("a corner of one in the other", cube, corner),
        ("apart", cube, aside),
        ("a bar through a cube", cube, bar),
        ("one within the other", cube, within),
        ("in the pocket of an L", l_solid, pocketed),
        ("through the arm of an L", l_solid, crossing),
        ("in the hollow of a shell", shell, crumb),
        ("a bar through a shell", shell, bar),
        ("of two parts, one within the other solid", parts, cube),
        ("of two parts, the second within the other solid", turned_parts, cube),
        ("far apart", cube, _box([50, 60, 70], [1, 2, 3])),
        ("as they lie: an L and a tetrahedron", l_solid, (TETRAHEDRON, SIDES)),
        ("a small tetrahedron beside an L", l_solid, (TETRAHEDRON / 10, SIDES)),
    ]
    touching = [
        ("face to face", one, _upright([2, 0.5, 0.5], [1, 1, 1])),
        ("corner to corner", one, _upright([2, 2, 2], [1, 1, 1])),
        ("edge to edge, crossed", one, _upright([2, -1, 2], [1, 4, 1])),
        ("the same solid", one, one),
        ("boxes that meet, solids that do not", (OCTAHEDRON, EIGHT), _upright([2, 2, 2], [1, 1, 1])),
    ]
    by_hand = [
        made_of(note + turned, *first, *second)
        for made_of, entries in ((usual, pairs), (edge, touching))
        for note, a, b in entries
        for turned, first, second in (("", a, b), (", in the other order", b, a))
    ]
    by_hand += [
        edge("a vertex of no face in the other", *_with_vertex(aside, [0.5, 0.5, 0.5]), *cube),
        edge("a vertex of no face in the other, the first", *_with_vertex(aside, [0.5, 0.5, 0.5], first=True), *cube),
        edge("the other without a face", *cube, within[0], NOTHING),
        refused("an open surface", cube[0], CUBE_FACES[1:], *within),
        refused("the other surface open", *within, cube[0], CUBE_FACES[1:]),
        refused("a vertex that is no number", *cube, np.full((4, 3), np.nan), SIDES),
    ]

    def maker(draw: Draw) -> Arguments:
        corners = _tetrahedron(draw)
        middle = corners.mean(axis=0)
        place = _turned(np.array([draw.number(-0.5, 3.2), draw.number(-0.5, 3.2), draw.number(0, 2)]))
        return *l_solid, (place + draw.number(0.1, 0.4) * (corners - middle)).round(3), SIDES

    return made("polyhedra_intersect", by_hand, maker, single=range(4))


def _with_vertex(mesh: Mesh, place: list[float], first: bool = False) -> Mesh:
    """A mesh with one more vertex, of no face: the last one, or the first."""
    vertices, faces = mesh
    vertex = _turned(np.array([place]))
    return (np.concatenate([vertex, vertices]), faces + 1) if first else (np.concatenate([vertices, vertex]), faces)


_TABLE = {
    "face_planes": _planes,
    "convex_separation": _separation,
    "segment_triangle": _triangle,
    "side_of_line": _side,
    "inside_by_parity": _parity,
    "winding_number": _winding,
    "polyhedra_intersect": _intersect,
}
