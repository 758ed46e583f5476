"""Mass properties of shapes: against quadrature, trimesh, MuJoCo and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle

from solutions.impulse import box_inertia, rotation_matrix, sphere_inertia, world_inertia
from solutions.world.mass import UPRIGHT, capsule_inertia, in_principal_axes, mass_properties
from solutions.world.rotation import orientation_of, quaternion_product
from solutions.world.volumes import volume

TURNED = np.array([0.5, 0.1, -0.7, 0.5])  # of length 1
AWAY = np.array([0.7, -2.0, 1.1])
QUARTER = np.array([np.sqrt(0.5), 0, 0, np.sqrt(0.5)])  # about z
CUBE = np.array(list(np.ndindex(2, 2, 2)), dtype=float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
"""A box as a polyhedron of four-sided faces, counterclockwise from outside: its corners are 0 or 1."""
L_SHAPE = (
    "compound",
    (
        (("box", (0.5, 0.1, 0.2)), (0.5, 0, 0), UPRIGHT),
        (("sphere", 0.3), (0.0, 0.8, 0.1), UPRIGHT),
        (("capsule", 0.2, 0.4), (-0.3, 0.1, -0.6), TURNED),
    ),
)


def inertia_of(shape, mass):
    """The whole matrix, about the centre of mass and along the shape's own axes."""
    _, moments, orientation = mass_properties(shape, mass)
    return world_inertia(moments, orientation)


def box_of_faces(size, orientation=UPRIGHT, position=(0, 0, 0)):
    """A polyhedron whose middle is at the position."""
    return ("polyhedron", (CUBE - 0.5) * size @ rotation_matrix(orientation).T + position, QUADS)


def hull(count=12):
    """A convex solid of triangles around points on an ellipsoid, away from its origin."""
    points = np.random.default_rng(5).normal(size=(count, 3))
    points *= np.array([1.0, 2.0, 0.5]) / np.linalg.norm(points, axis=-1, keepdims=True)
    faces = oracle("scipy.spatial").ConvexHull(points).simplices
    corners = points[faces]
    outwards = np.linalg.det(corners) > 0  # seen from the origin, which is inside
    return ("polyhedron", points + AWAY, np.where(outwards[:, None], faces, faces[:, ::-1]))


@pytest.mark.parametrize(("radius", "half_length"), [(0.4, 0.7), (0.9, 0.05), (0.3, 0.0)])
def test_a_capsule_is_the_sum_over_its_discs(radius, half_length):
    node, weight = np.polynomial.legendre.leggauss(5)  # exact up to the ninth power; the discs have the fourth
    height = np.concatenate(
        [half_length * node, half_length + radius * (node + 1) / 2, -half_length - radius * (node + 1) / 2]
    )
    slice_ = np.concatenate([half_length * weight, radius * weight / 2, radius * weight / 2])
    squared = radius**2 - np.maximum(np.abs(height) - half_length, 0) ** 2  # radius of the disc at this height
    area = np.pi * squared
    density = 3.0 / np.sum(slice_ * area)
    about_z = density * np.sum(slice_ * area * squared / 2)
    about_x = density * np.sum(slice_ * area * (squared / 4 + height**2))
    assert capsule_inertia(3.0, radius, half_length) == pytest.approx([about_x, about_x, about_z], rel=1e-14)
    assert volume(("capsule", radius, half_length)) == pytest.approx(np.sum(slice_ * area), rel=1e-14)


def test_a_ball_and_a_box_have_the_closed_forms_to_the_last_bit():
    for shape, moments in (
        (("sphere", 0.3), sphere_inertia(2.0, 0.3)),
        (("box", (0.3, 0.1, 0.2)), box_inertia(2.0, (0.6, 0.2, 0.4))),
    ):
        centre, found, orientation = mass_properties(shape, 2.0)
        assert np.array_equal(found, moments)
        assert np.array_equal(centre, np.zeros(3))
        assert np.array_equal(orientation, UPRIGHT)


def test_a_regular_tetrahedron_has_a_twentieth_of_mass_times_edge_squared():
    corners = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / np.sqrt(8)  # edges of 1
    faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    centre, moments, _ = mass_properties(("polyhedron", corners + AWAY, faces), 3.0)
    assert moments == pytest.approx(np.full(3, 3.0 / 20), rel=1e-13)
    assert centre == pytest.approx(AWAY, rel=1e-14)
    assert volume(("polyhedron", corners, faces)) == pytest.approx(1 / np.sqrt(72), rel=1e-14)


def test_a_turned_box_of_faces_away_from_its_origin_is_a_box():
    size = np.array([0.6, 0.2, 0.4])
    shape = box_of_faces(size, TURNED, AWAY)
    centre, moments, orientation = mass_properties(shape, 2.0)
    assert centre == pytest.approx(AWAY, rel=1e-14)
    assert np.sort(moments) == pytest.approx(np.sort(box_inertia(2.0, size)), rel=1e-13)
    assert world_inertia(moments, orientation) == pytest.approx(
        world_inertia(box_inertia(2.0, size), TURNED), rel=1e-13
    )
    assert volume(shape) == pytest.approx(size.prod(), rel=1e-14)


def test_a_convex_solid_has_the_mass_properties_that_trimesh_finds():
    trimesh = oracle("trimesh")
    _, vertices, faces = shape = hull()
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    mesh.density = 2.0 / mesh.volume
    centre, _, _ = mass_properties(shape, 2.0)
    assert centre == pytest.approx(mesh.center_mass, rel=1e-12)
    assert inertia_of(shape, 2.0) == pytest.approx(mesh.moment_inertia, rel=1e-10, abs=1e-12)
    assert volume(shape) == pytest.approx(mesh.volume, rel=1e-12)


def test_a_compound_has_the_mass_properties_that_mujoco_finds():
    mujoco = oracle("mujoco")
    size = {"box": "{0} {1} {2}", "sphere": "{0}", "capsule": "{0} {1}"}
    geoms = "".join(
        f"<geom type='{kind}' size='{size[kind].format(*np.ravel(lengths))}' pos='{' '.join(map(str, position))}' "
        f"quat='{' '.join(map(str, orientation))}' density='1000'/>"
        for (kind, *lengths), position, orientation in L_SHAPE[1]
    )
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody><body><freejoint/>{geoms}</body></worldbody></mujoco>")
    mass = model.body_mass[1]
    centre, _, _ = mass_properties(L_SHAPE, mass)
    assert mass == pytest.approx(1000 * volume(L_SHAPE), rel=1e-12)
    assert centre == pytest.approx(model.body_ipos[1], rel=1e-12)
    expected = world_inertia(model.body_inertia[1], model.body_iquat[1])
    assert inertia_of(L_SHAPE, mass) == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.trace(expected))


def test_a_box_cut_into_unequal_parts_of_all_kinds_is_the_box():
    # 2 x 3 x 1 around AWAY: a slab of faces, a box laid on its side, and two more in a compound of their own
    end = (box_of_faces((2, 0.5, 1)), AWAY + np.array((0, -1.25, 0)), UPRIGHT)
    side = (("box", (1.25, 0.3, 0.5)), AWAY + np.array((-0.7, 0.25, 0)), QUARTER)
    small = (("box", (0.7, 1.25, 0.1)), (0, 0, -0.4), UPRIGHT)
    large = (("box", (0.7, 1.25, 0.4)), (0, 0, 0.1), UPRIGHT)
    rest = (("compound", (small, large)), AWAY + np.array((0.3, 0.25, 0)), UPRIGHT)
    whole = ("compound", (end, side, rest))
    centre, moments, orientation = mass_properties(whole, 5.0)
    assert centre == pytest.approx(AWAY, rel=1e-14)
    assert moments == pytest.approx(box_inertia(5.0, (2, 3, 1)), rel=1e-14)
    assert np.array_equal(orientation, UPRIGHT)
    assert volume(whole) == pytest.approx(6.0, rel=1e-14)


@pytest.mark.parametrize(
    "make",
    [
        lambda: L_SHAPE,
        hull,
        lambda: box_of_faces((0.3, 0.1, 0.2), UPRIGHT, AWAY),
        lambda: box_of_faces((0.3, 0.1, 0.2), TURNED),
    ],
    ids=["compound", "convex solid", "only shifted", "only turned"],
)
def test_a_shape_that_is_moved_and_turned_takes_its_mass_along(make):
    shape = make()
    moved = ("compound", ((shape, AWAY, TURNED),))
    centre, moments, _ = mass_properties(shape, 2.0)
    moved_centre, moved_moments, _ = mass_properties(moved, 2.0)
    rotation = rotation_matrix(TURNED)
    assert moved_centre == pytest.approx(AWAY + rotation @ centre, rel=1e-13)
    assert np.sort(moved_moments) == pytest.approx(np.sort(moments), rel=1e-12)
    expected = rotation @ inertia_of(shape, 2.0) @ rotation.T
    assert inertia_of(moved, 2.0) == pytest.approx(expected, rel=1e-11, abs=1e-14)


def corners_of(shape, position, orientation):
    """Points of a shape in the world: vertices, or places and axes of the parts of a compound."""
    rotation = rotation_matrix(orientation)
    if shape[0] == "polyhedron":
        return shape[1] @ rotation.T + position
    parts = [np.vstack([place, place + rotation_matrix(turn).T]) @ rotation.T + position for _, place, turn in shape[1]]
    return np.concatenate(parts)


@pytest.mark.parametrize(
    "make",
    [
        lambda: L_SHAPE,
        hull,
        lambda: box_of_faces((0.3, 0.1, 0.2), UPRIGHT, AWAY),
        lambda: box_of_faces((0.3, 0.1, 0.2), TURNED),
    ],
    ids=["compound", "convex solid", "only shifted", "only turned"],
)
def test_a_shape_in_its_principal_axes_is_where_it_was(make):
    shape = make()
    own, moments, centre, orientation = in_principal_axes(shape, 2.0)
    # a body that has its old frame at AWAY, turned by TURNED
    position = AWAY + rotation_matrix(TURNED) @ centre
    turned = quaternion_product(TURNED, orientation)
    assert corners_of(own, position, turned) == pytest.approx(corners_of(shape, AWAY, TURNED), abs=1e-14)
    again, own_moments, own_centre, upright = in_principal_axes(own, 2.0)
    assert again is own
    assert np.array_equal(own_centre, np.zeros(3))
    assert np.array_equal(upright, UPRIGHT)
    assert own_moments == pytest.approx(moments, rel=1e-13)


@pytest.mark.parametrize(
    "shape",
    [
        ("sphere", 0.3),
        ("capsule", 0.2, 0.5),
        ("box", (0.3, 0.1, 0.2)),
        box_of_faces((0.3, 0.1, 0.2)),
        box_of_faces((1, 1, 1), TURNED),  # a cube is the same about all axes, turned or not
        ("compound", ((("sphere", 0.2), (0, 0, 0.5), UPRIGHT), (("sphere", 0.2), (0, 0, -0.5), UPRIGHT))),
    ],
    ids=["sphere", "capsule", "box", "box of faces", "turned cube", "dumbbell"],
)
def test_a_shape_that_is_in_its_principal_axes_stays_as_it_is(shape):
    found, moments, centre, orientation = in_principal_axes(shape, 2.0)
    assert found is shape
    assert np.array_equal(centre, np.zeros(3))
    assert np.array_equal(orientation, UPRIGHT)
    assert np.all(moments > 0)


def test_a_dumbbell_has_the_parallel_axes_of_its_balls():
    ball = ("sphere", 0.2)
    dumbbell = ("compound", ((ball, (0.1, 0, 0.5), UPRIGHT), (ball, (0.1, 0, -0.5), UPRIGHT)))
    centre, moments, _ = mass_properties(dumbbell, 2.0)
    own = 2 / 5 * 2.0 * 0.2**2
    assert moments == pytest.approx([own + 2.0 * 0.25, own + 2.0 * 0.25, own], rel=1e-14)
    assert centre == pytest.approx([0.1, 0, 0], abs=1e-16)


def test_a_needle_has_no_negative_moment_however_it_is_turned():
    rng = np.random.default_rng(2)
    for orientation in rng.normal(size=(20, 4)):
        needle = ("box", (1e-9, 1e-9, 1.0))
        part = (needle, (0, 0, 0), orientation / np.linalg.norm(orientation))
        _, moments, _ = mass_properties(("compound", (part,)), 3.0)
        assert np.min(moments) >= 0  # 2e-18, which rounding makes -1e-16 half of the time
        assert np.sort(moments)[1:] == pytest.approx([1.0, 1.0], rel=1e-14)


def test_a_part_without_a_volume_has_no_mass():
    box = (("box", (0.3, 0.1, 0.2)), (0, 0, 0), UPRIGHT)
    plate = (("box", (5.0, 5.0, 0)), AWAY, UPRIGHT)
    assert np.array_equal(mass_properties(("compound", (box, plate)), 2.0)[1], box_inertia(2.0, (0.6, 0.2, 0.4)))


def test_an_immovable_body_has_infinite_moments_and_keeps_its_frame():
    for shape in (("half-space", (0, 0, 1)), L_SHAPE, box_of_faces((1, 2, 3), TURNED, AWAY)):
        found, moments, centre, orientation = in_principal_axes(shape, np.inf)
        assert found is shape
        assert np.array_equal(moments, np.full(3, np.inf))
        assert np.array_equal(centre, np.zeros(3))
        assert np.array_equal(orientation, UPRIGHT)
    assert volume(("half-space", (0, 0, 1))) == np.inf


def test_the_orientation_of_a_matrix_is_scipys_at_every_angle():
    rng, scipy_rotation = np.random.default_rng(1), oracle("scipy.spatial.transform").Rotation
    axis = rng.normal(size=(50, 3))
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    angle = np.concatenate([np.full(20, np.pi), np.linspace(0, np.pi, 30)])  # half a turn has w = 0
    axis[:3] = np.eye(3)
    matrix = scipy_rotation.from_rotvec(angle[:, None] * axis).as_matrix()
    assert rotation_matrix(orientation_of(matrix)) == pytest.approx(matrix, abs=2e-15)


@pytest.mark.parametrize(
    ("shape", "mass", "match"),
    [
        (("half-space", (0, 0, 1)), 1.0, "half-space"),
        (("compound", ((("half-space", (0, 0, 1)), (0, 0, 0), UPRIGHT),)), 1.0, "half-space"),
        (("cone", 1.0), 1.0, "cone"),
        (("polyhedron", CUBE, [face[::-1] for face in QUADS]), 1.0, "volume"),
        (("compound", ((("box", (1, 1, 0)), (0, 0, 0), UPRIGHT),)), 1.0, "volume"),
        (("sphere", -0.1), 1.0, "radius"),
        (("capsule", 0.1, np.nan), 1.0, "half_length"),
        (("sphere", 0.1), 0.0, "mass"),
        (("sphere", 0.1), np.nan, "mass"),
    ],
)
def test_what_has_no_mass_properties_is_refused_by_name(shape, mass, match):
    with pytest.raises(ValueError, match=match):
        mass_properties(shape, mass)


def damaged(faces, turned=(), missing=()):
    """The faces with some turned over and some left out."""
    return [face[::-1] if i in turned else face for i, face in enumerate(faces) if i not in missing]


@pytest.mark.parametrize(
    ("turned", "missing"), [((3,), ()), ((0, 1), ()), ((0, 4), ()), ((), (5,)), ((2,), (2, 3)), ((1,), (4,))]
)
def test_a_surface_that_is_open_or_looks_both_ways_is_refused(turned, missing):
    for _, vertices, faces in (box_of_faces((1, 2, 3), TURNED, AWAY), hull()):
        shape = ("polyhedron", vertices, damaged([tuple(face) for face in faces], turned, missing))
        with pytest.raises(ValueError, match="faces must close, and all be counterclockwise"):
            mass_properties(shape, 2.0)
        with pytest.raises(ValueError, match="faces must close"):
            volume(("compound", [(shape, AWAY, UPRIGHT)]))


def test_a_part_that_is_turned_inside_out_is_refused_unless_it_is_a_hole():
    inside_out = [tuple(8 + v for v in quad)[::-1] for quad in QUADS]
    beside = np.vstack([CUBE, CUBE / 2 + np.array([2, 0.3, 0.1])])
    near = np.vstack([CUBE, CUBE / 20 + np.array([1.1, 0.3, 0.1])])  # every moment stays possible
    with pytest.raises(ValueError, match="those of a part of it look inwards"):
        volume(("polyhedron", near, [*QUADS, *inside_out]))
    with pytest.raises(ValueError, match="those of a part of it look inwards"):
        mass_properties(("polyhedron", beside, [*QUADS, *inside_out]), 6.0)
    hollow = np.vstack([CUBE, CUBE / 2 + 0.25])
    _, moments, _ = mass_properties(("polyhedron", hollow, [*QUADS, *inside_out]), 7.0)
    np.testing.assert_allclose(moments, (8 - 0.25) / 6, rtol=1e-12)  # 8 kg of a whole cube less 1 kg of half the size


def test_a_surface_of_separate_triangles_and_one_that_touches_itself_are_solids():
    _, vertices, faces = hull()
    apart = ("polyhedron", vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
    for one, other in zip(mass_properties(apart, 2.0), mass_properties(hull(), 2.0), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-12)
    # Two cubes side by side that share an edge, along which four faces meet
    cubes = np.vstack([CUBE, CUBE + np.array([1, 1, 0])])
    two = ("polyhedron", cubes, [*QUADS, *(tuple(8 + v for v in quad) for quad in QUADS)])
    centre, *_ = mass_properties(two, 2.0)
    np.testing.assert_allclose(centre, [1, 1, 0.5], atol=1e-14)
