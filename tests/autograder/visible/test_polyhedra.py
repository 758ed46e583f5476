"""Points, edges and polyhedra (slide 9): examples that a student sees.

The solids are turned and away from the origin, so that no axis is special. `corner_at(x, y, z)` is the place of a point
in the own axes of the tetrahedron: there its three sides at the corner are x = 0, y = 0 and z = 0, and its fourth side
is x + 2 y + 2 z = 6.
"""

from __future__ import annotations

import math

import numpy as np

from labs.grading.judging.comparison import expect
from labs.grading.judging.markers import asks

TURN = np.array([[2.0, -1, 2], [2, 2, -1], [-1, 2, 2]]) / 3
"""A rotation: its columns are unit vectors at right angles to each other."""
CORNER = np.array([1.0, -2, 3])
NOWHERE = (math.inf, [math.nan, math.nan, math.nan])
"""The answer where a segment does not meet a triangle."""


def corner_at(x, y, z):
    """The place of a point of the tetrahedron's own axes."""
    return (CORNER + TURN @ [x, y, z]).round(12)  # 0 and not 1e-16, which a message would show


TETRAHEDRON = np.array([corner_at(0, 0, 0), corner_at(6, 0, 0), corner_at(0, 3, 0), corner_at(0, 0, 3)]).round(9)
"""Corners (1, −2, 3), (5, 2, 1), (0, 0, 5) and (3, −3, 5)."""
SIDES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
"""The slanted side, then those at x = 0, y = 0 and z = 0; all look outwards."""
NORMALS = np.array([[4 / 9, 4 / 9, 7 / 9], [-2 / 3, -2 / 3, 1 / 3], [1 / 3, -2 / 3, -2 / 3], [-2 / 3, 1 / 3, -2 / 3]])
OFFSETS = np.array([-35 / 9, -5 / 3, 1 / 3, 10 / 3])
CUBE = np.array([[x, y, z] for x in (0, 2) for y in (0, 2) for z in (0, 2)], dtype=float)
CUBE_FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
     [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
"""A cube of 2 m with a corner at the origin, and two triangles for each of its sides."""


def prism(outline, triangles, height):
    """An outline pulled up along z: the triangles of its floor, turned round, those of its lid, and its walls."""
    count, floor = len(outline), np.asarray(triangles)
    low = np.column_stack([outline, np.zeros(count)])
    k = np.arange(count)
    following = (k + 1) % count
    walls = [np.column_stack([k, following, following + count]), np.column_stack([k, following + count, k + count])]
    return np.concatenate([low, low + np.array([0, 0, height])]), np.concatenate(
        [floor[:, ::-1], floor + count, *walls]
    )


L_OUTLINE = np.array([[0.0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
L_SOLID, L_FACES = prism(L_OUTLINE, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], 2.0)
"""An L with arms 1 m wide and 3 m long, 2 m high: its pocket is where x and y are both above 1."""
L_TURNED = CORNER + L_SOLID @ TURN.T


def in_l(*places):
    """The places of points of the L's own axes, when it is turned."""
    return CORNER + np.asarray(places, dtype=float) @ TURN.T


@asks(
    "face_planes", 4, "The corners run counter-clockwise as seen from outside, and so the normal points outwards.",
    "Slide 9 needs the plane of each face. Which product of two sides is at right angles to both, and in which order?",
)  # fmt: skip
def test_every_face_has_a_plane_that_looks_outwards(submission, part):
    lying = [[1, 1, 2], [4, 1, 2], [1, 5, 2], [7, 7, 7]]
    with part(1, "a face that lies flat, and the same turned over"):
        expect(submission.face_planes, (lying, np.array([[0, 1, 2]])), ([[0, 0, 1]], [-2]))
        expect(submission.face_planes, (lying, np.array([[0, 2, 1]])), ([[0, 0, -1]], [2]))
        expect(submission.face_planes, (lying, np.array([[2, 0, 1]])), ([[0, 0, 1]], [-2]))
    with part(1, "a slanted face away from the origin"):
        expect(submission.face_planes, (TETRAHEDRON, SIDES[:1]), (NORMALS[:1], OFFSETS[:1]))
        expect(submission.face_planes, (TETRAHEDRON, SIDES[2:3]), (NORMALS[2:3], OFFSETS[2:3]))
        expect(submission.face_planes, (TETRAHEDRON, SIDES[3:]), (NORMALS[3:], OFFSETS[3:]))
    with part(1, "a face a thousand times as large, a thousandth or a millionth as large"):
        expect(submission.face_planes, (1000 * TETRAHEDRON, SIDES[1:2]), (NORMALS[1:2], 1000 * OFFSETS[1:2]))
        for size in (1e-3, 1e-6):
            expect(submission.face_planes, (size * TETRAHEDRON, SIDES[:1]), (NORMALS[:1], size * OFFSETS[:1]))
    with part(1, "several faces in one call"):
        expect(submission.face_planes, (TETRAHEDRON, SIDES), (NORMALS, OFFSETS))
        expect(submission.face_planes, (TETRAHEDRON, SIDES[::-1]), (NORMALS[::-1], OFFSETS[::-1]))


@asks(
    "convex_separation", 4, "Of all planes the one above which the point is highest decides.",
    "Slide 9: inside is behind all the face planes. Which of the heights is the first to be positive as you go out?",
)  # fmt: skip
def test_the_plane_above_which_a_point_is_highest_decides(submission, part):
    mesh = TETRAHEDRON, SIDES
    with part(1, "inside, nearest to each of the faces"):
        expect(submission.convex_separation, (corner_at(1.5, 0.75, 1.125), *mesh), (-0.25, 0))
        expect(submission.convex_separation, (corner_at(0.25, 1, 0.5), *mesh), (-0.25, 1))
        expect(submission.convex_separation, (corner_at(2, 0.125, 0.5), *mesh), (-0.125, 2))
        expect(submission.convex_separation, (corner_at(2, 0.5, 0.375), *mesh), (-0.375, 3))
    with part(1, "outside, before each of the faces"):
        expect(submission.convex_separation, (corner_at(3, 1.5, 1.5), *mesh), (1.0, 0))
        expect(submission.convex_separation, (corner_at(-2, 0.5, 0.5), *mesh), (2.0, 1))
        expect(submission.convex_separation, (corner_at(1, -0.5, 1), *mesh), (0.5, 2))
        expect(submission.convex_separation, (corner_at(1, 0.75, -4), *mesh), (4.0, 3))
    with part(1, "beyond an edge and a corner, where the solid is farther away"):
        expect(submission.convex_separation, (corner_at(-1, -3, -2), *mesh), (3.0, 2))
        expect(submission.convex_separation, (corner_at(10, -1, 1), *mesh), (4 / 3, 0))
        expect(submission.convex_separation, ([3, 3, 3.25], CUBE, CUBE_FACES), (1.25, 10))
    with part(1, "several points in one call"):
        points = [corner_at(1.5, 0.75, 1.125), corner_at(-2, 0.5, 0.5), corner_at(1, 0.75, -4)]
        expect(submission.convex_separation, (points, *mesh), ([-0.25, 2, 4], [0, 1, 3]))
        table = np.reshape([*points, *points[::-1]], (2, 3, 3))
        expect(submission.convex_separation, (table, *mesh), ([[-0.25, 2, 4], [4, 2, -0.25]], [[0, 1, 3], [3, 1, 0]]))


CORNERS = np.array([[-2.0, -2, -0.5], [2, 0, -1.5], [-1, 4, 1.5]])
"""A triangle along no axis; its normal is along (8, −11, 22)."""


def through(weights, fraction, way):
    """Start and end of a segment that meets the triangle's plane at the point with these weights, at this fraction."""
    place, along = np.asarray(weights) @ CORNERS, np.asarray(way, dtype=float)
    return place - fraction * along, place + (1 - fraction) * along


@asks(
    "segment_triangle", 5, "The segment goes through the plane between its ends, and there it is within all sides.",
    "Slide 9, edge against face. At which fraction is the height above the plane zero? Is that place on the face?",
)  # fmt: skip
def test_an_edge_meets_a_face_where_it_is_within_all_sides(submission, part):
    down, slanted = [-0.5, 1, -8], [3, 2, 4]
    with part(1, "through the face, from the front and from the back"):
        for weights, fraction, way in (
            ([0.25, 0.5, 0.25], 0.25, down), ([0.5, 0.125, 0.375], 0.75, slanted),
            ([0.125, 0.25, 0.625], 0.5, [0, 0, 1]),
        ):  # fmt: skip
            expect(submission.segment_triangle, (*through(weights, fraction, way), CORNERS), (fraction, weights))
        start, end = through([0.25, 0.5, 0.25], 0.25, down)  # and in micrometres
        expect(submission.segment_triangle, (1e-6 * start, 1e-6 * end, 1e-6 * CORNERS), (0.25, [0.25, 0.5, 0.25]))
        upright = np.array([[2.0, 0, 0], [2, 4, 0], [2, 0, 4]])
        for axis in range(3):  # a face across each of the axes in turn
            given = (np.roll(each, axis, axis=-1) for each in ([0.0, 0, 2.5], [8.0, 4, 0.5], upright))
            expect(submission.segment_triangle, tuple(given), (0.25, [0.25, 0.25, 0.5]))
    with part(1, "through the plane, but beside the face: beyond one side or two"):
        for weights in (
            [-0.25, 0.75, 0.5], [0.75, -0.25, 0.5], [0.5, 0.75, -0.25],
            [-0.25, 0.5, 0.75], [0.5, -0.25, 0.75], [0.75, 0.5, -0.25],
            [1.75, -0.25, -0.5], [-0.5, 1.75, -0.25], [-0.25, -0.5, 1.75],
        ):  # fmt: skip
            for way in (down, slanted):
                expect(submission.segment_triangle, (*through(weights, 0.5, way), CORNERS), NOWHERE)
    with part(1, "not as far as the plane, or away from it; along a plane beside it"):
        for fraction in (-0.5, 1.25):
            for way in (down, slanted):
                ends = through([0.25, 0.5, 0.25], fraction, way)
                expect(submission.segment_triangle, (*ends, CORNERS), NOWHERE)
        beside = np.array([0, 0, 3]) + through([0.25, 0.5, 0.25], 0.5, CORNERS[1] - CORNERS[0])
        expect(submission.segment_triangle, (*beside, CORNERS), NOWHERE)
    with part(1, "the corners in another order, or the triangle turned over"):
        start, end = through([0.5, 0.125, 0.375], 0.25, down)
        expect(submission.segment_triangle, (start, end, CORNERS[[1, 2, 0]]), (0.25, [0.125, 0.375, 0.5]))
        expect(submission.segment_triangle, (start, end, CORNERS[[0, 2, 1]]), (0.25, [0.5, 0.375, 0.125]))
        expect(submission.segment_triangle, (end, start, CORNERS), (0.75, [0.5, 0.125, 0.375]))
    with part(1, "several in one call"):
        hit, beyond = through([0.25, 0.5, 0.25], 0.25, down), through([-0.25, 0.75, 0.5], 0.5, slanted)
        starts, ends = np.stack([hit, beyond], axis=1)
        both = ([0.25, math.inf], [[0.25, 0.5, 0.25], NOWHERE[1]])
        expect(submission.segment_triangle, (starts, ends, CORNERS), both)
        expect(submission.segment_triangle, (*hit, np.array([CORNERS, CORNERS + np.array([9, 0, 0])])), both)


@asks(
    "side_of_line", 3, "The sign of the area of the triangle a, b, c says whether it turns to the left.",
    "Slide 9, the test that decides everything. You turn left from one vector to another: which sign has their cross"
    " product?",
)  # fmt: skip
def test_a_point_is_left_of_a_line_on_it_or_right(submission, part):
    a, b = [1, -2], [4, 3]
    with part(1, "left and right of a slanted line, near an end and beyond it"):
        for c, side in (
            ([1, 1], 1), ([4, -1], -1), ([4, 3.5], 1), ([4, 2.5], -1), ([1.5, -2], -1), ([0.5, -2], 1),
            ([7, 9], 1), ([9, 9], -1), ([-2, -6], 1), ([-2, -8], -1), ([0, 0], 1), ([3, 0], -1),
        ):  # fmt: skip
            expect(submission.side_of_line, (a, b, c), side)
            expect(submission.side_of_line, (b, a, c), -side)
        expect(submission.side_of_line, ([-3, 1], [-5, -2], [-4, -2]), 1)
        expect(submission.side_of_line, ([-3, 1], [-5, -2], [-5, -1]), -1)
        for size in (2.0**-20, 2.0**20):  # in other units of length
            for c, side in (([1, 1], 1), ([4, -1], -1), ([2, 0], 1), ([9, 9], -1)):
                expect(submission.side_of_line, tuple(size * np.array([a, b, c], dtype=float)), side)
    with part(1, "on the line: between its points, beyond them, at one of them; and no line at all"):
        for c in ([7, 8], [-2, -7], [2.5, 0.5], a, b):
            expect(submission.side_of_line, (a, b, c), 0)
        expect(submission.side_of_line, (a, a, [3, 3]), 0)
    with part(1, "several points in one call, and several lines"):
        expect(submission.side_of_line, (a, b, [[1, 1], [4, -1], [7, 8]]), [1, -1, 0])
        expect(submission.side_of_line, ([a, b], [b, a], [4, -1]), [-1, 1])
        expect(submission.side_of_line, ([[0, 0], [2, 1]], [3, 1], [[1, 2], [4, 0]]), [1, -1])


TENTHS = np.array([[0.1, 0.2, 0.3], [1.3, 0.5, 0.1], [0.4, 1.7, 0.2], [0.7, 0.8, 1.9]])
"""A tetrahedron whose coordinates are rounded, as most are: `SIDES` are its faces."""
ONE_TURNED = np.array([[0, 3, 1], *CUBE_FACES[1:].tolist()])
"""The cube's faces, one of them turned over: it has an inside all the same."""
OCTAHEDRON = np.array([[3.0, 0, 0], [-3, 0, 0], [0, 3, 0], [0, -3, 0], [0, 0, 3], [0, 0, -3]])
EIGHT = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])


@asks(
    "inside_by_parity", 5, "A ray that crosses the surface an odd number of times starts inside.",
    "Slide 9. A ray leaves a cube through the diagonal of a side. How many triangles does it meet? How often does it"
    " cross the surface?",
)  # fmt: skip
def test_a_ray_crosses_the_surface_an_odd_number_of_times_from_inside(submission, part):
    with part(1, "in a turned L, in its pocket, and outside of it"):
        for place, inside in (
            ([0.4, 0.6, 0.7], 1), ([2.6, 0.3, 1.1], 1), ([0.7, 2.8, 1.7], 1), ([1.4, 1.7, 0.9], 0),
            ([2.7, 1.3, 1.2], 0), ([3.2, 0.5, 0.8], 0), ([0.4, 0.6, 2.3], 0), ([0.4, 0.6, -0.4], 0),
            ([-0.3, 1.2, 1.4], 0), ([9, -7, 5], 0),
        ):  # fmt: skip
            expect(submission.inside_by_parity, (in_l(place)[0], L_TURNED, L_FACES), inside)
    with part(1, "behind other parts of the surface, in every direction; cubes around a cube; a face turned over"):
        for place, inside in (([0.1, 0.7, 1.3], 1), ([-0.1, 0.7, 1.3], 0), ([1.6, 0.7, 1.3], 1)):
            expect(submission.inside_by_parity, (place, CUBE, ONE_TURNED), inside)
        middles = 5 * np.concatenate([np.zeros((1, 3)), np.eye(3), -np.eye(3)])
        cubes = np.concatenate([CUBE - 1 + middle for middle in middles])
        faces = np.concatenate([CUBE_FACES + 8 * k for k in range(7)])
        for place, inside in (([0.1, 0.2, 0.3], 1), ([0.1, 0.3, 2.5], 0), ([0.2, 0.1, -4.6], 1), ([-2.4, 0.1, 0.3], 0)):
            expect(submission.inside_by_parity, (place, cubes, faces), inside)
        nested = np.concatenate([size * (CUBE - 1) for size in (1, 3, 7)]) + CORNER
        for place, inside in (([0.1, 0.2, 0.3], 1), ([2.1, 0.2, 0.3], 0), ([-5.1, 0.2, 0.3], 1), ([0.1, 0.2, 7.3], 0)):
            expect(submission.inside_by_parity, (CORNER + place, nested, faces[:36]), inside)
        for place, inside in (
            ([0.3, 0.4, -0.7], 0), ([0.3, 0.4, 2.7], 0), ([-0.7, 0.4, 0.8], 0), ([3.7, 0.4, 0.8], 0),
            ([0.3, -0.7, 0.8], 0), ([0.3, 3.7, 0.8], 0), ([1.6, 2.4, 0.8], 0), ([0.6, 2.4, 0.8], 1),
        ):  # fmt: skip
            expect(submission.inside_by_parity, (place, L_SOLID, L_FACES), inside)
            expect(submission.inside_by_parity, (place, L_SOLID, L_FACES[:, ::-1]), inside)
            for size in (1e-3, 1e3):  # in other units of length
                given = (size * np.array(place), size * L_SOLID, L_FACES)
                expect(submission.inside_by_parity, given, inside)
    with part(1, "a ray through a diagonal, an edge or a corner; also of a speck, far away, and close to the surface"):
        expect(submission.inside_by_parity, ([1, 1, 1], CUBE, CUBE_FACES), 1)
        expect(submission.inside_by_parity, ([0, 0, 0], OCTAHEDRON, EIGHT), 1)
        # No move of the point by a number of metres is right for all of these. In powers of two nothing is rounded.
        for size in (2.0**-40, 2.0**30):
            expect(submission.inside_by_parity, ([size, size, size], size * CUBE, CUBE_FACES), 1)
        far = 2.0**50 * np.array([3, 1, 2])
        expect(submission.inside_by_parity, (far + 1, far + CUBE, CUBE_FACES), 1)
        for nearly, inside in ((1 - 2.0**-40, 1), (1 + 2.0**-40, 0)):
            for way in np.eye(3):
                expect(submission.inside_by_parity, (1 + nearly * way, CUBE, CUBE_FACES), inside)
                expect(submission.inside_by_parity, (1 - nearly * way, CUBE, CUBE_FACES), inside)
        for place, inside in (
            ([1, 1, 0], 1), ([1, 0, 1], 1), ([0, 1, 1], 1), ([0.5, 0.5, -0.5], 1), ([-1, 1, 0.5], 1),
            ([1, -1, -0.5], 1), ([0, -1, 0], 1), ([-1, 0, 0.5], 1), ([-1, 0, -0.5], 1), ([-2, 0, 0.5], 1),
            ([0, -2, 0.5], 1), ([0, 1, -5], 0), ([1, 0, -5], 0), ([0, -1, -5], 0), ([-1, 0, -5], 0), ([1, 1, -5], 0),
            ([-1, 1, -5], 0), ([1, -1, -5], 0), ([-1, -1, -5], 0), ([2, 1, -5], 0), ([2, -1, -5], 0),
            ([-1, -2, -5], 0), ([-2, 1, -5], 0), ([0, 0, -5], 0), ([3, 0, -5], 0), ([0, 3, -5], 0), ([-3, 0, -5], 0),
            ([0, -3, -5], 0), ([-5, 0, 0], 0), ([0, -5, 0], 0), ([2, -2, 0], 0), ([0, 4, 0], 0), ([0, 5, 0], 0),
            ([5, 0, 0], 0), ([0, 0, 5], 0),
        ):  # fmt: skip
            expect(submission.inside_by_parity, (place, OCTAHEDRON, EIGHT), inside)
    with part(1, "a ray along a wall, over the edge of a pocket, and hardly beside an edge"):
        # Computed to lie under a slanted edge: in plain floats it may be on the same side of the edge in both faces.
        for place, inside in (([0.4, 0.275, -0.75], 0), ([0.175, 0.575, -0.725], 0), ([0.3, 0.4, 0.7], 1)):
            expect(submission.inside_by_parity, (place, TENTHS, SIDES), inside)
        for place, inside in (
            ([1, 0.5, 1], 1), ([0.5, 1, 1], 1), ([0.75, 0.75, 1], 1), ([1, 2, -1], 0), ([2, 1, -1], 0), ([1, 1, -1], 0),
            ([3, 3, -1], 0), ([3, 0.5, -1], 0), ([0.5, 3, -1], 0), ([0, 0.5, -1], 0), ([0.5, 0, -1], 0),
            ([0, 0, -1], 0), ([3, 0, -1], 0), ([3, 1, -1], 0), ([1, 3, -1], 0), ([0, 3, -1], 0), ([3, 2, 1], 0),
            ([2, 3, 1], 0),
        ):  # fmt: skip
            expect(submission.inside_by_parity, (place, L_SOLID, L_FACES), inside)
    with part(1, "several points in one call"):
        expect(submission.inside_by_parity, ([[1, 1, 1], [1, 1, 3], [1, 1, -1]], CUBE, CUBE_FACES), [1, 0, 0])
        places = in_l([0.4, 0.6, 0.7], [1.4, 1.7, 0.9], [2.6, 0.3, 1.1], [0.4, 0.6, 2.3])
        expect(submission.inside_by_parity, (places.reshape(2, 2, 3), L_TURNED, L_FACES), [[1, 0], [1, 0]])


@asks(
    "winding_number", 4, "The solid angles of a closed surface add up to the whole sphere from inside, and to nothing"
    " from outside.",
    "Slide 9. Under which part of a sphere around the point is each face seen, and does the point see its back?",
)  # fmt: skip
def test_the_solid_angles_of_all_faces_add_up(submission, part):
    cube, middle = TURN @ (CUBE - 1).T, CORNER
    cube = cube.T + CORNER
    with part(1, "inside and outside of a turned L, and in its pocket"):
        for place, count in (([0.4, 0.6, 0.7], 1), ([2.6, 0.3, 1.1], 1), ([1.4, 1.7, 0.9], 0), ([9, -7, 5], 0)):
            expect(submission.winding_number, (in_l(place)[0], L_TURNED, L_FACES), count)
    with part(1, "turned inside out, and twice round"):
        expect(submission.winding_number, (in_l([0.4, 0.6, 0.7])[0], L_TURNED, L_FACES[:, ::-1]), -1)
        expect(submission.winding_number, (middle, cube, np.concatenate([CUBE_FACES, CUBE_FACES])), 2)
        expect(submission.winding_number, (middle, cube, np.concatenate([CUBE_FACES, CUBE_FACES[:, ::-1]])), 0)
    with part(1, "a face is missing, or all but one of them"):
        expect(submission.winding_number, (middle, cube, CUBE_FACES[1:]), 11 / 12)
        expect(submission.winding_number, (middle, cube, CUBE_FACES[3:5]), 2 / 12)
        expect(submission.winding_number, ([0, 0, 0], [[2, 0, 0], [0, 3, 0], [0, 0, 5]], np.array([[0, 1, 2]])), 1 / 8)
        expect(submission.winding_number, ([0, 0, 0], [[2, 0, 0], [0, 3, 0], [0, 0, 5]], np.array([[0, 2, 1]])), -1 / 8)
    with part(1, "several points in one call"):
        places = in_l([0.4, 0.6, 0.7], [1.4, 1.7, 0.9], [2.6, 0.3, 1.1], [0.4, 0.6, 2.3], [0.1, 0.1, 0.1], [7, 7, 7])
        expect(submission.winding_number, (places, L_TURNED, L_FACES), [1, 0, 1, 0, 1, 0])
        expect(submission.winding_number, (places.reshape(2, 3, 3), L_TURNED, L_FACES), [[1, 0, 1], [0, 1, 0]])
        two = np.array([middle, middle + TURN @ [5, 0.1, 0.2]])
        expect(submission.winding_number, (two, cube, CUBE_FACES), [1, 0])


def box(low, size):
    """An upright box, turned and displaced with the L."""
    return CORNER + (np.asarray(low) + CUBE / 2 * size) @ TURN.T


@asks(
    "polyhedra_intersect", 5, "Either an edge of one goes through a face of the other, or one lies within the other.",
    "Slide 9. Push a bar through a cube. Which corners are inside the other solid, and which edges go through faces?",
)  # fmt: skip
def test_two_solids_meet_by_an_edge_or_by_what_lies_within(submission, part):
    cube, bar = box([0, 0, 0], [2, 2, 2]), box([1.2, 0.2, -2], [0.3, 0.2, 7])  # it goes beside the diagonals
    with part(1, "a corner of one in the other, and apart"):
        shifted, aside = box([1.5, 1.3, 1.2], [3, 2, 4]), box([2.3, 0.2, 0.1], [1, 2, 3])
        expect(submission.polyhedra_intersect, (cube, CUBE_FACES, shifted, CUBE_FACES), True)
        expect(submission.polyhedra_intersect, (cube, CUBE_FACES, aside, CUBE_FACES), False)
        expect(submission.polyhedra_intersect, (aside, CUBE_FACES, cube, CUBE_FACES), False)
    with part(1, "a bar through a cube: no corner of either is in the other"):
        expect(submission.polyhedra_intersect, (cube, CUBE_FACES, bar, CUBE_FACES), True)
        expect(submission.polyhedra_intersect, (bar, CUBE_FACES, cube, CUBE_FACES), True)
    with part(1, "one within the other, or a part of it"):
        within = box([0.5, 0.7, 0.8], [0.3, 0.4, 0.5])
        two = np.concatenate([box([3, 0, 0], [1, 1, 1]), within]), np.concatenate([CUBE_FACES, CUBE_FACES + 8])
        expect(submission.polyhedra_intersect, (*two, cube, CUBE_FACES), True)
        expect(submission.polyhedra_intersect, (cube, CUBE_FACES, *two), True)
        expect(submission.polyhedra_intersect, (cube, CUBE_FACES, within, CUBE_FACES), True)
        expect(submission.polyhedra_intersect, (within, CUBE_FACES, cube, CUBE_FACES), True)
    with part(1, "in the pocket of an L, and through its arm"):
        pocketed, crossing = box([1.2, 1.3, 0.4], [1.5, 1.6, 1]), box([1.4, -0.5, 0.6], [0.4, 3, 0.5])
        expect(submission.polyhedra_intersect, (L_TURNED, L_FACES, pocketed, CUBE_FACES), False)
        expect(submission.polyhedra_intersect, (pocketed, CUBE_FACES, L_TURNED, L_FACES), False)
        expect(submission.polyhedra_intersect, (L_TURNED, L_FACES, crossing, CUBE_FACES), True)
        expect(submission.polyhedra_intersect, (crossing, CUBE_FACES, L_TURNED, L_FACES), True)
    with part(1, "solids with other numbers of corners, and corners of no face"):
        # The corner of no face comes first and last, because a loop may begin or end with it.
        inside = in_l([9, 9, 9], [2.2, 0.2, 0.5], [2.6, 0.3, 0.5], [2.3, 0.8, 0.6], [2.4, 0.4, 1.4], [9, 9, 9])
        faces = np.array([[1, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4]])
        expect(submission.polyhedra_intersect, (inside, faces, L_TURNED, L_FACES), True)
        expect(submission.polyhedra_intersect, (L_TURNED, L_FACES, inside, faces), True)
        stray = [0.5, 0.5, 0.5]
        beside = in_l(stray, [2.2, 1.2, 0.5], [2.6, 1.3, 0.5], [2.3, 1.8, 0.6], [2.4, 1.4, 1.4], stray)
        expect(submission.polyhedra_intersect, (beside, faces, L_TURNED, L_FACES), False)
        expect(submission.polyhedra_intersect, (L_TURNED, L_FACES, beside, faces), False)
