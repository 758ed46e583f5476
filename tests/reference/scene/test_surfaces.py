"""Nearest points of a surface and the flat faces of a hull, against samples, closed forms and another package."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from oracles import oracle

from reference.catalogue.scenarios.bowls import OUTER, RIM, block, bowl
from reference.catalogue.scenarios.convex_solid import SOLID
from reference.errors import InvalidInput
from reference.prediction import solids
from reference.scene import geometry, surfaces
from reference.scene.scenario import Body, Box, HalfSpace, Sphere

RNG = np.random.default_rng(11)
BOWL = bowl(0.3125)
TURN = (0.4, -0.2, 0.8, 0.4)


@pytest.mark.parametrize("solid", [SOLID, BOWL], ids=["octahedron", "bowl"])
def test_the_nearest_point_is_on_the_surface_and_as_far_away_as_it_can_be(solid):
    points = RNG.uniform(-1.2, 1.2, (300, 3))
    nearest = surfaces.nearest_points(points, solid.triangles)
    for point, found in zip(points, nearest, strict=True):
        far = float(np.min(solids.distances(point, solid.triangles)))
        assert np.linalg.norm(found - point) == pytest.approx(far, abs=1e-12)  # numbers of order one
        assert np.min(solids.distances(found, solid.triangles)) < 1e-12


def test_a_sphere_has_the_gap_to_a_cube_of_triangles_that_it_has_to_a_box():
    points = np.array([(x, y, z) for x in (-0.3, 0.3) for y in (-0.2, 0.2) for z in (-0.5, 0.5)])
    faces = [
        triangle
        for a, *others in surfaces.hull_faces(points)
        for triangle in zip([a] * 2, others, others[1:], strict=False)
    ]
    cube = type(BOWL)(tuple(map(tuple, points.tolist())), tuple(faces))
    for place in RNG.uniform(-1, 1, (60, 3)):
        ball = Body("ball", Sphere(0.1), 1.0, tuple(place))
        gaps = [
            geometry.gap(ball, Body("solid", shape, position=(0.1, 0.2, 0.0), orientation=TURN))
            for shape in (cube, Box((0.3, 0.2, 0.5)))
        ]
        assert gaps[0] == pytest.approx(gaps[1], abs=1e-12)


def test_the_gap_of_a_mesh_is_known_to_a_ball_alone():
    solid = Body("solid", BOWL)
    for other in (Body("floor", HalfSpace()), Body("box", Box((0.1, 0.1, 0.1)))):
        with pytest.raises(InvalidInput, match="solid is a mesh"):
            geometry.gap(solid, other)


def test_the_hull_of_a_bowl_is_the_block_that_fills_it_up_to_the_rim():
    solid, (left, right), (front, back) = block(), *OUTER
    assert set(solid.vertices) < set(BOWL.vertices)
    assert all(solids.depth_or_gap(vertex, solid.triangles) <= 0 for vertex in BOWL.points)
    assert solid.volume == pytest.approx((right - left) * (back - front) * RIM, rel=1e-12)


def test_the_pieces_of_a_bowl_are_convex_and_fill_it_and_nothing_else():
    for depth in (0.125, 0.3125):
        solid = bowl(depth)
        pieces = [solid.points[list(group)] for group in solid.pieces]
        for piece in pieces:
            assert {corner for face in surfaces.hull_faces(piece) for corner in face} == set(range(8))
        filled = sum(_volume(piece, surfaces.hull_faces(piece)) for piece in pieces)
        assert filled == pytest.approx(solid.volume, rel=1e-12)
        corners = [solids.hull(piece) for piece in pieces]
        for place in RNG.uniform((-1, -0.7, -0.1), (0.8, 0.8, 0.6), (100, 3)):
            inside = surfaces.winding_number(place, solid.triangles) > 0.5
            assert any(solids.in_convex(place, piece) for piece in corners) == inside


def test_the_flat_faces_of_a_hull_have_the_volume_that_another_package_finds():
    package = oracle("scipy.spatial")
    for count in (5, 8, 12):
        points = RNG.normal(size=(count, 3))
        assert _volume(points, surfaces.hull_faces(points)) == pytest.approx(
            package.ConvexHull(points).volume, rel=1e-12
        )


def _volume(points, faces) -> float:
    """A sixth of the triple products of each face's fan of triangles, m³: positive if all faces look outwards."""
    fans = [points[[face[0], b, c]] for face in faces for b, c in itertools.pairwise(face[1:])]
    return float(sum(np.linalg.det(fan) for fan in fans)) / 6
