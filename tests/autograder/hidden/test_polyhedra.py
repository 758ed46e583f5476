"""Points, edges and polyhedra: drawn examples against other ways of finding the same, limiting cases, many at once."""

from __future__ import annotations

import itertools
import math

import numpy as np

from labs.grading.calling.scenario_runs import compared_with_theory, with_solutions
from labs.grading.judging.comparison import expect, numbers, refuse_changes
from labs.grading.judging.markers import asks

SIDES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
"""The sides of a tetrahedron, looking outwards: the one opposite corner 0, then those opposite 1, 2 and 3."""
CUBE = np.array(list(itertools.product((0.0, 1.0), repeat=3)))
CUBE_FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
     [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
U_OUTLINE = [(0, 0), (5, 0), (5, 4), (4, 4), (4, 1), (1, 1), (1, 4), (0, 4)]
U_SOLID = np.array([(x, y, z) for z in (0.0, 2.0) for x, y in U_OUTLINE])
"""A U that lies on its back, 2 m high. Its pocket is where x is from 1 to 4, and y above 1."""
_FLOOR = np.array([[0, 1, 4], [0, 4, 5], [1, 2, 3], [1, 3, 4], [0, 5, 6], [0, 6, 7]])
_K = np.arange(8)
_NEXT = (_K + 1) % 8
U_FACES = np.concatenate(
    [_FLOOR[:, ::-1], _FLOOR + 8, np.column_stack([_K, _NEXT, _NEXT + 8]), np.column_stack([_K, _NEXT + 8, _K + 8])]
)
NOWHERE = (math.inf, [math.nan, math.nan, math.nan])


def tetrahedron(draw):
    """Corners of a tetrahedron with sides of other lengths and other angles, turned and displaced."""
    leaning = np.array([[1, 0, 0], [draw.number(-0.4, 0.4), 1, 0], [draw.number(-0.4, 0.4), draw.number(-0.4, 0.4), 1]])
    lengths = np.array([draw.number(1, 4) for _ in range(3)])
    corners = np.concatenate([np.zeros((1, 3)), lengths[:, None] * leaning])
    return draw.vector() + corners @ draw.turn().T


def unit_normal(a, b, c):
    """At right angles to both sides, by singular values, on the side from which a, b, c run counter-clockwise."""
    normal = np.linalg.svd([b - a, c - a])[2][2]
    return normal * np.sign(np.linalg.det([b - a, c - a, normal]))


def planes(vertices, faces):
    corners = vertices[faces]
    normal = np.array([unit_normal(*each) for each in corners])
    return normal, -np.sum(normal * corners.mean(axis=1), axis=1)


@asks("face_planes", 4, "Every corner of a face is in its plane, and the normal has unit length and points outwards.")
def test_the_plane_of_any_face_holds_its_corners_and_looks_outwards(submission, part, examples):
    def solid(draw):
        return tetrahedron(draw), SIDES

    with part(1, "any tetrahedron"):
        examples.agree(submission.face_planes, planes, solid)
    with part(1, "in millimetres and in kilometres, and long thin faces"):
        vertices = np.array([[1.0, -2, 3], [5, 2, 1], [0, 0, 5], [3, -3, 5]])
        for size in (1e-6, 1e-3, 1e3, 1e6):
            expect(submission.face_planes, (size * vertices, SIDES), planes(size * vertices, SIDES))
        long = np.array([[0, 0, 2], [100, 0, 2], [50, 0.01, 2]])
        expect(submission.face_planes, (long, np.array([[0, 1, 2]])), ([[0, 0, 1]], [-2]))
    with part(1, "the solid is behind every plane, wherever the origin is"):

        def behind(vertices, place):
            normal, offset = numbers(submission.face_planes, (vertices + 9 * place, SIDES), 2)
            heights = (vertices + 9 * place) @ np.transpose(normal) + offset
            np.testing.assert_allclose(np.max(heights, axis=0), 0, atol=1e-2)
            assert np.all(np.min(heights, axis=0) < -1e-2), "all corners are in the plane of a face, or before it"

        examples.every(lambda draw: (tetrahedron(draw), draw.vector()), behind)
    with part(1, "other meshes, their arrays left as they were"):
        for vertices, faces in ((U_SOLID, U_FACES), (CUBE - 0.5, CUBE_FACES[::-1]), (CUBE, CUBE_FACES[:, [1, 2, 0]])):
            expect(submission.face_planes, (vertices, faces), planes(vertices, faces))
            refuse_changes(submission.face_planes)


def separation(point, vertices, faces):
    """By volumes: the height above a face is three times the volume of the tetrahedron on it, over its area."""
    heights = []
    for a, b, c in vertices[faces]:
        area = np.sqrt(np.linalg.det([[(b - a) @ (b - a), (b - a) @ (c - a)], [(b - a) @ (c - a), (c - a) @ (c - a)]]))
        heights.append(np.linalg.det([b - a, c - a, point - a]) / area)
    return max(heights), int(np.argmax(heights))


@asks("convex_separation", 5, "The largest of the heights above all face planes, and its face.")
def test_the_separation_of_any_point(submission, part, examples):
    corners = np.array([[0.5, -1, 2], [4, 0.5, 1], [1, 3, 2.5], [1.5, 0.5, 5]])

    def around(draw):
        shares = np.array([draw.number(0.1, 1) for _ in range(4)]) ** 2
        return (shares / shares.sum()) @ corners + draw.number(0, 2) * draw.unit(), corners, SIDES

    with part(2, "any point in or around a tetrahedron"):
        examples.agree(submission.convex_separation, separation, around, count=16)
    with part(1, "on a face, at a corner, in the middle of a cube, beyond edges and corners of it; any size"):
        for point, found in (
            ([0.25, 1, 0.5], (0, 6)), ([1, 0, 1], (0, 2)), ([0.5, 0.5, 0.5], (-0.5, 0)), ([2, 2, 2], (1, 2)),
            ([3, 0.5, 1.5], (2, 2)), ([-2, 4, 1.5], (3, 6)), ([0.25, 0.5, 0.75], (-0.25, 0)),
            ([1e6, -2e6, 0], (2e6, 4)),
        ):  # fmt: skip
            expect(submission.convex_separation, (point, CUBE, CUBE_FACES), found)
        for size in (2.0**-20, 2.0**-10, 2.0**10, 2.0**20):  # exactly, so that equal heights stay equal
            for point, height, face in (([0.25, 0.5, 0.75], -0.25, 0), ([0.5, 1.5, 1.25], 0.5, 6)):
                given = (size * np.array(point), size * CUBE, CUBE_FACES)
                expect(submission.convex_separation, given, (size * height, face))
    with part(1, "one step inwards or outwards along the normal changes it by the step"):

        def steady(point, vertices, faces, step):
            depth, face = numbers(submission.convex_separation, (point, vertices, faces), 2)
            normal = unit_normal(*vertices[faces[int(face)]])
            away, _ = numbers(submission.convex_separation, (point + step * normal, vertices, faces), 2)
            np.testing.assert_allclose(away, depth + step, atol=1e-3)

        examples.every(lambda draw: (*around(draw), draw.number(0, 3)), steady)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.convex_separation, separation, around, single=(1, 2))


def meeting(start, end, triangle):
    """By three equations: start + t (end − start) = a + u (b − a) + v (c − a)."""
    a, b, c = triangle
    t, u, v = np.linalg.solve(np.column_stack([end - start, a - b, a - c]), a - start)
    if min(t, 1 - t, u, v, 1 - u - v) < 0:
        return math.inf, np.full(3, math.nan)
    return t, np.array([1 - u - v, u, v])


def segment(draw):
    """A segment and a triangle in general position, more often meeting than not."""
    corners = tetrahedron(draw)[1:]
    first, second = draw.number(0.1, 0.4), draw.number(0.1, 0.4) + 0.003  # so that no weight below is zero
    weights = np.roll([first, second, 1 - first - second], draw.rng.integers(3))
    if not draw.rng.integers(3):
        weights = np.array([1, 1, 1]) - 2 * weights if draw.rng.integers(2) else 2 * weights - 1 / 3
    a, b, c = corners
    way = draw.sign() * draw.number(1, 5) * unit_normal(a, b, c) + draw.number(-0.5, 0.5) * (b - a)
    fraction = draw.number(0.05, 0.95) + draw.rng.choice([1, -1, 0, 0, 0])
    place = weights @ corners
    return place - fraction * way, place + (1 - fraction) * way, corners


@asks("segment_triangle", 6, "Three equations with three unknowns: the fraction and two weights.")
def test_any_segment_meets_a_triangle_where_three_equations_say(submission, part, examples):
    flat = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
    with part(2, "any segment and triangle"):
        examples.agree(submission.segment_triangle, meeting, segment, count=24)
    with part(1, "in millimetres and in kilometres; long, short and hardly through; upright triangles"):
        for size in (1e-6, 1e-4, 1e3, 1e6):
            for case in (([1, 1.5, 2], [1.2, 1, -1], flat), ([1, 1, 3], [1.5, 0.5, 0.25], flat)):
                scaled = tuple(size * np.asarray(each) for each in case)
                expect(submission.segment_triangle, scaled, meeting(*scaled))
        for start, end in (([1, 1, 1e4], [1, 1, -1e4]), ([1, 1, 1e-6], [1, 1, -3e-6]), ([1, 1, 1], [1, 1, -1e-4])):
            expect(submission.segment_triangle, (start, end, flat), meeting(np.array(start), np.array(end), flat))
        for axis in (1, 2):  # upright triangles
            for start, end in (([1, 0.5, 2], [0.75, 1.25, -1]), ([1, 3.5, 2], [0.75, 4.25, -1])):
                turned_over = tuple(np.roll(np.array(each), axis, axis=-1) for each in (start, end, flat))
                expect(submission.segment_triangle, turned_over, meeting(*turned_over))
    with part(1, "beside the plane, without a warning's number"):
        for start, end in (([1, 1, 2], [3, 1, 2]), ([-9, 1, -0.5], [9, 1, -0.5]), ([1, 1, 2], [1, 1, 2])):
            expect(submission.segment_triangle, (start, end, flat), NOWHERE)
    with part(1, "turned round and turned over, it is the same place"):

        def same(start, end, triangle):
            there, back = (start, end, triangle), (end, start, triangle[::-1])
            t, weights = numbers(submission.segment_triangle, there, 2, finite=False)
            other, others = numbers(submission.segment_triangle, back, 2, finite=False)
            assert np.isfinite(t) == np.isfinite(other), "it meets the triangle from one side alone"
            if np.isfinite(t):
                np.testing.assert_allclose(t + other, 1, atol=1e-3)
                np.testing.assert_allclose(weights, others[::-1], atol=1e-3)

        examples.every(segment, same)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.segment_triangle, meeting, segment)


@asks("segment_triangle", 1, "A segment enters and leaves a solid where theory says.")
def test_a_segment_enters_and_leaves_a_solid_as_theory_says(submission, part):
    code = with_solutions(submission, "polyhedra")
    with part(1, "an octahedron that is regular in nothing"):
        compared_with_theory(code, "convex-solid", ("turned", "size=0.05"), ("face", "segment"))


def aside(a, b, c):
    """By angles: how far the way to c is turned against the way to b."""
    to_b, to_c = b - a, c - a
    return np.sign(np.sin(math.atan2(to_c[1], to_c[0]) - math.atan2(to_b[1], to_b[0])))


def three_points(draw):
    """C is well away from the line."""
    a, way = draw.vector()[:2], draw.vector()[:2]
    beside = np.array([-way[1], way[0]])
    return a, a + way, a + draw.number(-3, 3) * way + draw.sign() * draw.number(0.1, 2) * beside


@asks("side_of_line", 4, "The sign of the angle from the line to the point.")
def test_any_point_beside_a_line_is_left_or_right_of_it(submission, part, examples):
    with part(1, "any line and point"):
        examples.agree(submission.side_of_line, aside, three_points, count=20)
    with part(1, "on the line, at its points, and where there is no line"):
        for a, b, c in (
            ([0, 0], [2, 1], [4, 2]), ([0, 0], [2, 1], [-6, -3]), ([3, -1], [3, 5], [3, 2]), ([-1, 4], [7, 4], [2, 4]),
            ([1, 2], [1, 2], [3, 4]), ([1, 2], [3, 4], [1, 2]), ([1, 2], [3, 4], [3, 4]), ([5, 5], [5, 5], [5, 5]),
        ):  # fmt: skip
            expect(submission.side_of_line, (a, b, c), 0)
    with part(1, "small and large triangles: there is no tolerance"):
        for size in (1e-8, 1e-4, 1e4, 1e8):
            for a, c, side in (([0, 0], [1, 1], 1), ([0, 0], [1, -1], -1), ([2, 2], [3, 1], 1), ([2, 2], [2, 1], -1)):
                corners = [size * np.asarray(each, dtype=float) for each in (a, [3, 0.5], c)]
                expect(submission.side_of_line, tuple(corners), side)
        expect(submission.side_of_line, ([0, 0], [1, 2], [1, 2.000001]), 1)
        expect(submission.side_of_line, ([0, 0], [1, 2], [1, 1.999999]), -1)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.side_of_line, aside, three_points)


def in_u(own):
    """Whether a point of the U's own axes is in it."""
    x, y, z = own
    outside = not (0 < x < 5 and 0 < y < 4 and 0 < z < 2)
    return not outside and not (1 < x < 4 and y > 1)


def own_place(draw):
    """A point in or around a U, in its own axes: as near as 1 cm to a wall, but not nearer."""
    whole = np.array([draw.rng.integers(8) - 1, draw.rng.integers(7) - 1, draw.rng.integers(4) - 1])
    return whole + np.array([draw.number(0.01, 0.99) for _ in range(3)])


TURN = np.array([[2.0, 3, 6], [3, -6, 2], [6, 2, -3]]) / 7
PLACE = np.array([-2.0, 1, 0.5])
U_TURNED = PLACE + U_SOLID @ TURN.T


def turned(own):
    return PLACE + TURN @ own


def in_turned_u(point, vertices, faces):
    return in_u(TURN.T @ (point - PLACE))


GRID = np.array(list(itertools.product((-0.5, 0, 0.5, 1, 1.5), repeat=3)))
"""Points that are in a cube of 2 m around 0.5, or outside, and straight above, below and beside all its vertices."""


@asks("inside_by_parity", 7, "The number of crossings is odd, also where a ray meets edges and vertices.")
def test_any_point_in_or_around_a_u(submission, part, examples):
    def around(draw):
        return turned(own_place(draw)), U_TURNED, U_FACES

    with part(2, "any point in or around a turned U"):
        examples.agree(submission.inside_by_parity, in_turned_u, around, count=30)
    with part(1, "a U that lies along the axes: above and below every vertex and edge"):
        xs, ys, zs = (-0.5, 0, 0.5, 1, 2.5, 4, 4.5, 5, 5.5), (-0.5, 0, 0.5, 1, 2.5, 4, 4.5), (-1, 3)
        outside = np.array(list(itertools.product(xs, ys, zs)))
        expect(submission.inside_by_parity, (outside, U_SOLID, U_FACES), np.zeros(len(outside)))
        within = np.array(list(itertools.product((0.5, 4.5), (0.5, 1, 2.5, 3.5), (0.5, 1, 1.5))))
        expect(submission.inside_by_parity, (within, U_SOLID, U_FACES), np.ones(len(within)))
    with part(1, "an octahedron on a grid through all its corners and edges"):
        corners = 3 * np.concatenate([np.eye(3), -np.eye(3)])
        faces = np.array([[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]])
        grid = np.array([each for each in itertools.product(range(-4, 5), repeat=3) if np.sum(np.abs(each)) != 3])
        inside = np.sum(np.abs(grid), axis=1) < 3
        expect(submission.inside_by_parity, (grid, corners, faces), inside)
        expect(submission.inside_by_parity, (grid, corners, faces[:, ::-1]), inside)
        for size in (1e-6, 1e6):
            expect(submission.inside_by_parity, (size * grid, size * corners, faces), inside)
    with part(1, "a hollow, two solids, and a solid of loose triangles"):
        shell = np.concatenate([CUBE, 5 * CUBE - 2.1]), np.concatenate([CUBE_FACES, CUBE_FACES + 8])
        expect(submission.inside_by_parity, ([[0.5, 0.5, 0.5], [1.5, 0.5, 0.5], [9, 0.5, 0.5]], *shell), [0, 1, 0])
        two = np.concatenate([CUBE, CUBE + np.array([0, 0, 3])]), np.concatenate([CUBE_FACES, CUBE_FACES + 8])
        expect(submission.inside_by_parity, ([[0.5, 0.5, 0.5], [0.5, 0.5, 2], [0.5, 0.5, 3.5]], *two), [1, 0, 1])
        loose = CUBE[CUBE_FACES].reshape(-1, 3), np.arange(36).reshape(-1, 3)
        expect(submission.inside_by_parity, ([[0.5, 0.5, 0.5], [0.5, 0.5, 2]], *loose), [1, 0])
        one_turned = np.concatenate([CUBE_FACES[:1, ::-1], CUBE_FACES[1:]])
        middle = CUBE[CUBE_FACES[0]].mean(axis=0)
        places = [middle + share * (0.5 - middle) for share in (0.1, -0.1)]
        expect(submission.inside_by_parity, (places, CUBE, one_turned), [1, 0])
    with part(1, "a millionth off the surface; hardly beside a slanted edge"):
        tenths = np.array([[0.1, 0.2, 0.3], [1.3, 0.5, 0.1], [0.4, 1.7, 0.2], [0.7, 0.8, 1.9]])
        sides = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
        shares = np.arange(1, 12)[:, None] / 12
        for end in (1, 2):  # far below the edge from the first corner: outside
            under = tenths[0] + shares * (tenths[end] - tenths[0]) - [0, 0, 1]
            expect(submission.inside_by_parity, (under, tenths, sides), np.zeros(11))
        places = [[2, 0.5, z] for z in (1e-6, -1e-6, 2 - 1e-6, 2 + 1e-6)]
        expect(submission.inside_by_parity, (places, U_SOLID, U_FACES), [1, 0, 1, 0])
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.inside_by_parity, in_turned_u, around, single=(1, 2))


def rectangle_seen(x, y, h):
    """The solid angle of a rectangle from a corner's foot, h away: its sides are x and y long, with their signs."""
    return math.atan2(x * y, h * math.sqrt(x * x + y * y + h * h))


def without_lid(point, vertices, faces):
    """Round a point in a unit cube whose lid, z = 1, is missing; turned like the U. Only from below the lid."""
    x, y, z = TURN.T @ (point - PLACE)
    lid = sum(
        sign * rectangle_seen(a, b, 1 - z)
        for sign, a, b in ((1, 1 - x, 1 - y), (-1, -x, 1 - y), (-1, 1 - x, -y), (1, -x, -y))
    )
    inside = 0 < x < 1 and 0 < y < 1 and 0 < z < 1
    return float(inside) - lid / (4 * math.pi)


OPEN_CUBE = PLACE + CUBE @ TURN.T
NO_LID = np.delete(CUBE_FACES, [10, 11], axis=0)


@asks("winding_number", 6, "The share of the sphere under which all backs are seen, less that of the fronts.")
def test_the_winding_number_of_open_and_closed_surfaces(submission, part, examples):
    def below_the_lid(draw):
        own = np.array([draw.number(-0.5, 1.5), draw.number(-0.5, 1.5), draw.number(-1, 0.9)])
        return turned(own + 0.003), OPEN_CUBE, NO_LID

    with part(2, "a box without its lid lacks the solid angle of the lid"):
        examples.agree(submission.winding_number, without_lid, below_the_lid, count=12)
    with part(1, "in and around a U: whole numbers"):

        def whole(own):
            found = numbers(submission.winding_number, (turned(own), U_TURNED, U_FACES))
            np.testing.assert_allclose(found, float(in_u(own)), atol=1e-4)
            back = numbers(submission.winding_number, (turned(own), U_TURNED, U_FACES[:, ::-1]))
            np.testing.assert_allclose(back, -float(in_u(own)), atol=1e-4)

        examples.every(lambda draw: (own_place(draw),), whole)
    with part(1, "on a face, an edge and a corner of a cube; no face; a face without area"):
        for point, share in (
            ([1, 0.25, 0.5], 1 / 2),
            ([0.75, 1, 0.5], 1 / 2),
            ([1, 1, 0.25], 1 / 4),
            ([0, 1, 0], 1 / 8),
        ):
            expect(submission.winding_number, (point, CUBE, CUBE_FACES), share)
        expect(submission.winding_number, ([1, 2, 3], CUBE, SIDES[:0]), 0.0)
        flat = np.concatenate([CUBE_FACES, [[0, 0, 1]]])
        expect(submission.winding_number, ([0.25, 0.5, 0.125], CUBE, flat), 1.0)
    with part(1, "twice round, and the same in any unit of length"):
        twice = np.concatenate([CUBE, 3 * CUBE - 1]), np.concatenate([CUBE_FACES, CUBE_FACES + 8])
        expect(submission.winding_number, ([[0.5, 0.25, 0.5], [1.5, 0.25, 0.5], [3, 3, 3]], *twice), [2, 1, 0])
        for size in (1e-6, 1e6):
            expect(submission.winding_number, ([0, 0, 0], size * np.eye(3), np.array([[0, 1, 2]])), 1 / 8)
            for point, count in (([0.5, 0.25, 0.5], 1), ([1.5, 0.25, 0.5], 0)):
                expect(submission.winding_number, (size * np.array(point), size * CUBE, CUBE_FACES), count)
    with part(1, "many at once, their arrays left as they were"):
        examples.together(submission.winding_number, without_lid, below_the_lid, single=(1, 2))


def turned_box(low, size):
    return PLACE + (np.asarray(low) + CUBE * size) @ TURN.T


def boxes(draw):
    """Two boxes with parallel sides: those of A are at even tenths of a metre, those of B at odd ones."""
    low_a, low_b = (np.array([draw.rng.integers(9) for _ in range(3)]) / 5 for _ in range(2))
    size_a, size_b = (np.array([1 + draw.rng.integers(6) for _ in range(3)]) / 5 for _ in range(2))
    return low_a, size_a, low_b + 0.1, size_b


@asks("polyhedra_intersect", 6, "Two solids have a point in common, whichever of them comes first.")
def test_any_two_solids_have_a_point_in_common_or_not(submission, part, examples):
    def both_ways(first, second, meet):
        expect(submission.polyhedra_intersect, (*first, *second), meet)
        expect(submission.polyhedra_intersect, (*second, *first), meet)

    with part(2, "boxes meet when their intervals do on all three axes"):

        def as_intervals(low_a, size_a, low_b, size_b):
            meet = bool(np.all((low_a < low_b + size_b) & (low_b < low_a + size_a)))
            both_ways((turned_box(low_a, size_a), CUBE_FACES), (turned_box(low_b, size_b), CUBE_FACES), meet)

        examples.every(boxes, as_intervals, count=16)
    with part(1, "bars through a U and through its pocket, along every axis, in any unit of length"):
        u = U_TURNED, U_FACES
        for low, size, meet in (
            ([2.2, 0.3, -1], [0.2, 0.1, 4], 1), ([2.2, 2.3, -1], [0.2, 0.1, 4], 0), ([-1, 2.2, 0.7], [7, 0.1, 0.2], 1),
            ([1.3, 2.2, 0.7], [2.4, 0.1, 0.2], 0), ([2.3, -1, 0.6], [0.2, 6, 0.1], 1),
            ([2.3, 1.4, 0.6], [0.2, 6, 0.1], 0), ([-1, 2.2, 2.3], [7, 0.1, 0.2], 0),
        ):  # fmt: skip
            both_ways(u, (turned_box(low, size), CUBE_FACES), meet)
            for unit in (1e-6, 1e6):
                both_ways((unit * U_TURNED, U_FACES), (unit * turned_box(low, size), CUBE_FACES), meet)
    with part(1, "within, in a hollow, and a corner that belongs to no face"):
        outer, inner = turned_box([0, 0, 0], [4, 4, 4]), turned_box([1.1, 0.9, 1.3], [2, 2, 2])
        shell = np.concatenate([outer, inner]), np.concatenate([CUBE_FACES, CUBE_FACES[:, ::-1] + 8])
        both_ways((outer, CUBE_FACES), (inner, CUBE_FACES), 1)
        both_ways(shell, (turned_box([1.3, 1.1, 1.5], [1, 1, 1]), CUBE_FACES), 0)
        both_ways(shell, (turned_box([0.3, 0.2, 0.4], [0.3, 0.2, 0.1]), CUBE_FACES), 1)
        astray = np.concatenate([turned_box([5, 5, 5], [1, 1, 1]), turned_box([1, 1, 1], [1, 1, 1])[:1]])
        both_ways((outer, CUBE_FACES), (astray, CUBE_FACES), 0)
    with part(1, "touching counts: face to face, edge to edge, corner to corner, and the same solid"):
        for low in ([1, 0.25, 0.5], [1, 1, 0.5], [1, 1, 1], [0, 0, 0], [-1, 0, 1]):
            both_ways((CUBE, CUBE_FACES), (CUBE + low, CUBE_FACES), 1)
    with part(1, "two that consist of several parts, their arrays left as they were"):
        middles = np.array([[0, 0, 0], [5, 0, 0], [0, 5, 0]])
        parts = (
            np.concatenate([CUBE + m for m in middles]) @ TURN.T,
            np.concatenate([CUBE_FACES + 8 * k for k in range(3)]),
        )
        apart, third = (CUBE * 0.9 + [2, 2, 0]) @ TURN.T, (CUBE * 0.5 + [0.2, 5.2, 0.3]) @ TURN.T
        both_ways(parts, (apart, CUBE_FACES), 0)
        both_ways(parts, (third, CUBE_FACES), 1)
        around_one = (CUBE * 2 + [-0.5, 4.5, -0.5]) @ TURN.T
        both_ways(parts, (around_one, CUBE_FACES), 1)
        refuse_changes(submission.polyhedra_intersect)
