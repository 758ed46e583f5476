from __future__ import annotations

import importlib
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles import oracle

from solutions import as_printed
from solutions.detection import side_of_plane
from solutions.polyhedra import (
    convex_separation,
    face_planes,
    inside_by_parity,
    inside_by_winding,
    inside_convex,
    mesh_edges,
    orient2d,
    signed_volume,
    winding_number,
)

surface = importlib.import_module("solutions.polyhedra.surface")

# Outlines with whole coordinates, counter-clockwise; all but the square are concave.
OUTLINES = {
    "square": [(0, 0), (4, 0), (4, 4), (0, 4)],
    "L": [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)],
    "U": [(0, 0), (5, 0), (5, 4), (3, 4), (3, 1), (2, 1), (2, 4), (0, 4)],
    "comb": [(0, 0), (7, 0), (6, 4), (5, 1), (4, 4), (3, 1), (2, 4), (1, 1)],
    "arrow": [(0, 0), (3, 1), (6, 0), (3, 5)],
}
HEIGHT = 3
COORDINATE = st.integers(-2, 14).map(lambda value: value / 2)


def ears(outline):
    """Triangles that fill an outline, by cutting off one ear after another."""
    left, triangles = list(range(len(outline))), []
    points = np.array(outline, dtype=float)
    while len(left) > 2:
        for k in range(len(left)):
            a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
            others = points[[i for i in left if i not in (a, b, c)]]
            sides = [orient2d(points[i], points[j], others) >= 0 for i, j in ((a, b), (b, c), (c, a))]
            if orient2d(points[a], points[b], points[c]) > 0 and not np.any(np.all(sides, axis=0)):
                triangles.append((a, b, c))
                del left[k]
                break
    return np.array(triangles)


def extruded(outline, height=HEIGHT):
    """The outline pulled up along z: a closed mesh whose faces look outwards."""
    n, cap = len(outline), ears(outline)
    ring = np.arange(n)
    ahead = np.roll(ring, -1)
    walls = [np.stack([ring, ahead, ahead + n], axis=1), np.stack([ring, ahead + n, ring + n], axis=1)]
    low = np.column_stack([np.array(outline, dtype=float), np.zeros(n)])
    high = low + np.array([0, 0, height])
    return np.concatenate([low, high]), np.concatenate([cap[:, ::-1], cap + n, *walls])


def area(outline):
    following = outline[1:] + outline[:1]
    return sum(a * d - b * c for (a, b), (c, d) in zip(outline, following, strict=True)) / 2


def exact_side(outline, x, y):
    """In fractions: 1 within the outline, 0 on it, −1 outside."""
    x, y, inside = Fraction(x), Fraction(y), False
    for (x0, y0), (x1, y1) in zip(outline, outline[1:] + outline[:1], strict=True):
        turn = (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
        if turn == 0 and min(x0, x1) <= x <= max(x0, x1) and min(y0, y1) <= y <= max(y0, y1):
            return 0
        if (y0 > y) != (y1 > y) and (turn > 0) == (y1 > y0):
            inside = not inside
    return 1 if inside else -1


def exact_side_of_solid(outline, point):
    x, y, z = point
    upright = (0 < z < HEIGHT) - (z < 0 or z > HEIGHT)
    return min(exact_side(outline, x, y), upright)


def grid_with_truth(outline):
    """All points at half coordinates around the solid: their rays meet its vertices, its edges and its walls."""
    steps = np.arange(-2, 16) / 2
    points = np.stack(np.meshgrid(steps, steps, steps[:11]), axis=-1).reshape(-1, 3)
    flat = {(x, y): exact_side(outline, x, y) for x in steps for y in steps}
    upright = ((points[:, 2] > 0) & (points[:, 2] < HEIGHT)).astype(int) - (
        (points[:, 2] < 0) | (points[:, 2] > HEIGHT)
    )
    return points, np.minimum([flat[x, y] for x, y in points[:, :2]], upright)


def bent(seed):
    """A turn and a stretch, the same for a mesh and its points; it keeps what is inside."""
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    if np.linalg.det(turn) < 0:
        turn[0] *= -1
    return lambda p: (p * [1.0, 0.7, 2.1]) @ turn.T + [0.3, -5.1, 2.7]


each_outline = pytest.mark.parametrize("outline", OUTLINES.values(), ids=OUTLINES)


@pytest.mark.statement(9, oracle="exact fractions, on a grid that meets all vertices and edges")
@each_outline
def test_parity_and_winding_number_are_right_on_a_grid_through_vertices(outline):
    points, truth = grid_with_truth(outline)
    off = truth != 0
    assert np.sum(truth > 0) > 100
    assert np.array_equal(inside_by_parity(points[off], *extruded(outline)), truth[off] > 0)
    assert np.array_equal(inside_by_winding(points[off], *extruded(outline)), truth[off] > 0)


@pytest.mark.statement(9, oracle="exact fractions, before a turn and a stretch")
@each_outline
def test_both_ways_are_right_on_a_solid_turned_at_random(outline):
    points, truth = grid_with_truth(outline)
    off, move = truth != 0, bent(len(outline))
    vertices, faces = extruded(outline)
    # off the surface here means by 0.1 or more: the turn moves a point by 1e-15
    assert np.array_equal(inside_by_parity(move(points[off]), move(vertices), faces), truth[off] > 0)
    assert np.array_equal(inside_by_winding(move(points[off]), move(vertices), faces), truth[off] > 0)


@pytest.mark.statement(9, oracle="the side from which a step of 1e-9 of the size was made")
@each_outline
@pytest.mark.parametrize("turned", [False, True])
def test_both_ways_are_right_a_billionth_off_the_surface(outline, turned):
    move = bent(3) if turned else np.asarray
    vertices, faces = extruded(outline)
    vertices = np.asarray(move(vertices), dtype=float)
    normal, _ = face_planes(vertices, faces)
    weights = np.array([[1, 1, 1], [8, 1, 1], [1, 8, 1], [1, 1, 8], [0.98, 0.01, 0.01], [0.02, 0.49, 0.49]])
    weights /= weights.sum(axis=1, keepdims=True)
    on_face = weights @ vertices[faces]  # within each face
    step = 1e-9 * np.ptp(vertices, axis=0).max() * normal[:, None]
    for inside in (inside_by_parity, inside_by_winding):
        assert np.all(inside(on_face - step, vertices, faces))
        assert not np.any(inside(on_face + step, vertices, faces))


@pytest.mark.statement(9, oracle="exact fractions, two billionths of the size off vertices and edges")
@each_outline
def test_next_to_vertices_and_edges_both_ways_are_right(outline):
    vertices, faces = extruded(outline)
    rng = np.random.default_rng(6)
    ends = vertices[mesh_edges(vertices, faces)]
    along = ends[:, 0] + rng.uniform(size=(len(ends), 1)) * (ends[:, 1] - ends[:, 0])
    step = rng.normal(size=(10, 1, 3))
    step *= 2e-9 * np.ptp(vertices) / np.linalg.norm(step, axis=-1, keepdims=True)
    points = (np.concatenate([vertices, along]) + step).reshape(-1, 3)
    truth = np.array([exact_side_of_solid(outline, point) for point in points.tolist()])
    assert np.all(truth != 0)
    assert np.array_equal(inside_by_parity(points, vertices, faces), truth > 0)
    # by the winding number as well, though steps along the surface leave some of these points nearer than 1e-9
    assert np.array_equal(inside_by_winding(points, vertices, faces), truth > 0)


@pytest.mark.statement(9, oracle="exact fractions")
@given(st.sampled_from(sorted(OUTLINES)), COORDINATE, COORDINATE, COORDINATE, st.floats(-1e-12, 1e-12))
def test_parity_is_right_for_points_just_off_the_grid(name, x, y, z, off):
    # exact arithmetic: even a millionth of a millionth beside a vertical edge the parity is right
    point = (x + off, y - off / 3, z)
    truth = exact_side_of_solid(OUTLINES[name], point)
    if truth:
        assert bool(inside_by_parity(point, *extruded(OUTLINES[name]))) == (truth > 0)


@each_outline
def test_the_faces_look_outwards_and_the_volume_is_that_of_a_prism(outline):
    vertices, faces = extruded(outline)
    assert signed_volume(vertices, faces) == pytest.approx(area(outline) * HEIGHT, rel=1e-14)  # sums of a few numbers
    # far along one axis 6 of 16 digits of the vertices are gone, and no more
    assert signed_volume(np.add(vertices, [1e6, 0, 0]), faces) == pytest.approx(area(outline) * HEIGHT, rel=1e-9)
    assert signed_volume(vertices + 1e3, faces[:, ::-1]) == pytest.approx(-area(outline) * HEIGHT, rel=1e-12)
    assert len(vertices) - len(mesh_edges(vertices, faces)) + len(faces) == 2  # Euler


def test_of_cubes_that_fill_space_exactly_one_has_each_point():
    vertices, faces = extruded(OUTLINES["square"], 4)
    steps = np.arange(9) / 2
    points = np.stack(np.meshgrid(steps, steps, steps), axis=-1).reshape(-1, 3)
    shifts = 4 * (np.stack(np.meshgrid(*3 * [[0, 1, 2]]), axis=-1).reshape(-1, 3) - 1.0)
    assert np.all(np.sum([inside_by_parity(points, vertices + shift, faces) for shift in shifts], axis=0) == 1)


@pytest.mark.statement(9, oracle="solid angles of a cube")
def test_on_a_cube_the_winding_number_is_the_solid_angle_inside():
    vertices, faces = extruded(OUTLINES["square"], 4)
    where = [[2, 2, 2], [2, 1, 0], [2, 2, 0], [2, 0, 0], [0, 4, 1], [4, 4, 4], [5, 2, 2], [4, 4, 5]]
    # each is a sum of a dozen angles
    assert winding_number(where, vertices, faces) == pytest.approx([1, 0.5, 0.5, 0.25, 0.25, 0.125, 0, 0], abs=1e-14)


@pytest.mark.parametrize("scale", [2.0**-20, 2.0**20])
def test_inside_does_not_depend_on_the_unit_of_length(scale):
    vertices, faces = extruded(OUTLINES["comb"])
    vertices, points = bent(7)(vertices), bent(7)(np.random.default_rng(7).uniform(-0.5, [7, 4, 3], (500, 3)))
    # a power of two changes no digit
    assert np.array_equal(
        winding_number(scale * points, scale * vertices, faces), winding_number(points, vertices, faces)
    )
    inside = inside_by_parity(scale * points, scale * vertices, faces)
    assert np.array_equal(inside, inside_by_parity(points, vertices, faces))
    assert 50 < np.sum(inside) < 450


def test_inside_out_the_winding_number_is_negative():
    vertices, faces = extruded(OUTLINES["U"])
    points, truth = grid_with_truth(OUTLINES["U"])
    points, truth = points[truth != 0], truth[truth != 0]
    # half a dozen angles of rounding 1e-16 each
    assert winding_number(points, vertices, faces[:, ::-1]) == pytest.approx(np.where(truth > 0, -1, 0), abs=1e-13)
    for inside in (inside_by_parity, inside_by_winding):
        assert np.array_equal(inside(points, vertices, faces[:, ::-1]), truth > 0)


@pytest.mark.erratum(9)
def test_an_open_mesh_has_no_plain_inside():
    vertices, faces = extruded(OUTLINES["square"], 4)
    open_faces = faces[2:]  # the floor is gone
    with pytest.raises(ValueError, match="closed surface: 4 edges"):
        inside_by_parity([2, 2, 2], vertices, open_faces)
    winding = winding_number([[2, 2, 3.5], [2, 2, 2], [2, 2, 0.5], [2, 2, -0.5]], vertices, open_faces)
    assert np.all(np.diff(winding) < 0)
    assert winding[1] == pytest.approx(5 / 6, abs=1e-14)  # at the middle one of six faces is missing


@pytest.mark.erratum(9)
def test_parity_and_winding_number_differ_where_enclosed_twice():
    vertices, faces = extruded(OUTLINES["square"], 4)
    both = np.concatenate([vertices, vertices + 2]), np.concatenate([faces, faces + len(vertices)])
    assert winding_number([3, 3, 3], *both) == pytest.approx(2, abs=1e-14)
    assert inside_by_winding([3, 3, 3], *both)
    assert not inside_by_parity([3, 3, 3], *both)


def test_loose_triangles_and_faces_without_area_change_nothing():
    vertices, faces = extruded(OUTLINES["comb"])
    points, truth = grid_with_truth(OUTLINES["comb"])
    points, truth = points[truth != 0], truth[truth != 0]
    loose = vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)
    assert np.array_equal(inside_by_parity(points, *loose), truth > 0)
    idle = np.concatenate([faces, [[1, 1, 5]]])
    assert np.array_equal(inside_by_parity(points, vertices, idle), truth > 0)
    assert np.array_equal(inside_by_winding(points, vertices, idle), truth > 0)


def test_inside_does_not_depend_on_the_size_of_a_block(monkeypatch):
    vertices, faces = extruded(OUTLINES["U"])
    points = np.random.default_rng(5).uniform(-1, 6, (50, 2, 3))
    before = inside_by_parity(points, vertices, faces), winding_number(points, vertices, faces)
    monkeypatch.setattr(surface, "PAIRS", 7)
    assert before[0].shape == (50, 2)
    assert np.array_equal(inside_by_parity(points, vertices, faces), before[0])
    assert np.array_equal(winding_number(points, vertices, faces), before[1])
    square = extruded(OUTLINES["square"])
    assert convex_separation(points, *square)[0].shape == (50, 2)


# Convex solids


@pytest.mark.statement(9, oracle="the six distances of a box")
def test_within_a_box_the_depth_is_that_to_the_nearest_side():
    vertices, faces = extruded(OUTLINES["square"], 4)
    points = np.random.default_rng(1).uniform(-2, 6, (1000, 3))
    separation, face = convex_separation(points, vertices, faces)
    assert separation == pytest.approx(np.max(np.abs(points - 2), axis=1) - 2, abs=1e-15)  # no more than a rounding
    normal, offset = face_planes(vertices, faces)
    assert np.vecdot(normal[face], points) + offset[face] == pytest.approx(separation, abs=1e-15)
    assert np.array_equal(inside_convex(points, vertices, faces), separation <= 0)
    assert np.array_equal(inside_by_parity(points, vertices, faces), separation < 0)  # none is on the surface


def test_the_surface_belongs_to_a_convex_solid():
    vertices, faces = extruded(OUTLINES["square"], 4)
    points = [[4, 2, 2], [4, 4, 4], [4.25, 2, 2], [4.5, 2, 2], [2, 2, 2]]
    assert inside_convex(points, vertices, faces).tolist() == [True, True, False, False, True]
    assert inside_convex(points, vertices, faces, 0.25).tolist() == [True, True, True, False, True]
    assert side_of_plane(convex_separation(points, vertices, faces)[0]).tolist() == [0, 0, 1, 1, -1]


@pytest.mark.statement(9, oracle="the exact depth in a regular tetrahedron")
def test_a_tetrahedron_is_as_deep_as_its_inscribed_ball():
    vertices = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1.0]])
    faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]
    assert convex_separation([0, 0, 0], vertices, faces)[0] == pytest.approx(-1 / 3**0.5, rel=1e-15)


@pytest.mark.erratum(9)
def test_the_convex_test_is_wrong_on_a_concave_solid():
    points, truth = grid_with_truth(OUTLINES["L"])
    printed = as_printed.inside_polyhedron(points, *extruded(OUTLINES["L"]))
    inside = truth > 0
    # A point in an arm of the L is in front of the wall of the notch: only where the arms cross it is called inside.
    assert not np.any(printed & (truth < 0))
    assert np.sum(inside) == 165
    assert np.sum(inside & ~printed) == 120
    assert not as_printed.inside_polyhedron([3, 1, 1], *extruded(OUTLINES["L"]))
    assert inside_by_parity([3, 1, 1], *extruded(OUTLINES["L"]))
    with pytest.raises(ValueError, match="convex"):
        inside_convex([3, 1, 1], *extruded(OUTLINES["L"]))


@pytest.mark.erratum(9)
def test_counting_touched_faces_is_wrong_where_a_ray_meets_an_edge():
    vertices, faces = extruded(OUTLINES["square"], 4)
    # on the diagonal the ray up meets the edge between the two halves of the lid
    diagonal = [[1, 1, 2], [3, 3, 2], [1, 3, 2], [3, 1, 2]]
    printed = as_printed.inside_by_touched_faces(diagonal, vertices, faces)
    assert not np.all(printed)
    assert np.all(inside_by_parity(diagonal, vertices, faces))


@each_outline
def test_of_the_solids_only_the_square_is_taken_for_convex(outline):
    vertices, faces = extruded(outline)
    for unit, place in ((1, 0), (1e-12, 0), (1e12, 0), (1, [1e12, 0, 0])):
        moved = unit * vertices + place
        if outline is OUTLINES["square"]:
            assert abs(convex_separation(moved[0], moved, faces)[0]) < 1e-3 * unit  # rounding of 1e12
        else:
            with pytest.raises(ValueError, match="convex"):
                convex_separation(moved[0], moved, faces)
    with pytest.raises(ValueError, match="convex"):
        convex_separation(vertices[0], vertices, faces[:, ::-1])


def test_a_distant_vertex_of_no_face_changes_nothing():
    vertices, faces = extruded(OUTLINES["L"])
    with_another = np.concatenate([vertices, [[1e12, 0, 0]]])
    with pytest.raises(ValueError, match="convex"):
        convex_separation([3, 1, 1], with_another, faces)
    square, its_faces = extruded(OUTLINES["square"])
    square = np.concatenate([square, [[1e12, 0, 0]]])
    assert convex_separation([2, 2, HEIGHT / 2], square, its_faces)[0] < 0
    assert signed_volume(square, its_faces) == 4 * 4 * HEIGHT


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: inside_by_parity([0, 0, np.nan], *extruded(OUTLINES["L"])), "point must be finite"),
        (lambda: inside_by_parity([0, 0], *extruded(OUTLINES["L"])), r"point must have shape"),
        (lambda: winding_number([0, 0, 0], [[0, 0, 0.0]], [[0, 0, 1]]), "faces must name vertices 0 to 0, not 1"),
        (lambda: winding_number([0, 0, 0], [[0, 0, 0.0]], [[0, 0, -1]]), "not -1"),
        (lambda: winding_number([0, 0, 0], [[0, 0]], [[0, 0, 0]]), "vertices must have shape"),
        (lambda: winding_number([0, 0, 0], [[0, 0, 0]], [[0, 0]]), "faces must be whole numbers"),
        (lambda: face_planes([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]), "face 0 has none"),
        (lambda: convex_separation([0, 0, 0], np.zeros((3, 3)), np.empty((0, 3), int)), "must not be empty"),
        (lambda: inside_convex([0, 0, 0], *extruded(OUTLINES["square"]), -1.0), "tolerance must be zero or positive"),
    ],
)
def test_what_makes_no_sense_is_refused_by_name(call, words):
    with pytest.raises(ValueError, match=words):
        call()


def test_nothing_is_inside_a_mesh_without_faces():
    nothing = np.zeros((0, 3)), np.zeros((0, 3), dtype=int)
    assert not inside_by_parity([0, 0, 0], *nothing)
    assert winding_number([0, 0, 0], *nothing) == 0
    assert signed_volume(*nothing) == 0


# Others


@pytest.mark.statement(9, oracle="libigl's winding number")
@each_outline
def test_libigl_finds_the_same_winding_number(outline):
    igl = oracle("igl")
    vertices, faces = extruded(outline)
    points = np.random.default_rng(2).uniform(-2, 8, (2000, 3))
    theirs = igl.winding_number(vertices, faces, points)
    assert winding_number(points, vertices, faces) == pytest.approx(theirs, abs=1e-12)  # sums of two dozen angles


@pytest.mark.statement(9, oracle="shapely's point in polygon, on a prism")
@each_outline
def test_shapely_finds_the_same_points_within_the_outline(outline):
    shapely = oracle("shapely")
    points = np.random.default_rng(3).uniform(-1, 8, (2000, 3))
    within = shapely.contains_xy(shapely.Polygon(outline), *points[:, :2].T) & (points[:, 2] > 0)
    assert np.array_equal(inside_by_parity(points, *extruded(outline)), within & (points[:, 2] < HEIGHT))


@pytest.mark.statement(9, oracle="trimesh's contains")
def test_trimesh_finds_the_same_points_within_a_bent_torus():
    trimesh = oracle("trimesh")
    oracle("rtree")
    torus = trimesh.creation.torus(2.0, 0.7, major_sections=16, minor_sections=10)
    points = np.random.default_rng(4).uniform(-3, 3, (500, 3)) * [1, 1, 0.3]
    mine = inside_by_parity(points, torus.vertices, torus.faces)
    assert 50 < np.sum(mine) < 450
    assert np.array_equal(mine, torus.contains(points))
    assert np.array_equal(mine, inside_by_winding(points, torus.vertices, torus.faces))
