"""The winding number around many points, where parts of the mesh that are well away are replaced by their caps."""

from __future__ import annotations

import importlib

import numpy as np
import pytest
from oracles import oracle

from solutions.polyhedra import inside_by_parity, solid_angle, winding_number

solid_angles = importlib.import_module("solutions.polyhedra.solid_angles")
RNG = np.random.default_rng(8)


def torus(around=16, across=10):
    """A torus, stretched, turned and off the centre; it is concave."""
    u, v = (k * 2 * np.pi / n for k, n in zip(np.indices((around, across)), (around, across), strict=True))
    out = 2 + 0.7 * np.cos(v)
    vertices = np.stack([out * np.cos(u), out * np.sin(u), 0.7 * np.sin(v)], axis=-1).reshape(-1, 3) * [1, 0.6, 1.7]
    i, j = (k.reshape(-1) for k in np.indices((around, across)))
    a, b, c, d = ((i + p) % around * across + (j + q) % across for p, q in ((0, 0), (1, 0), (1, 1), (0, 1)))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    turn = np.linalg.qr(RNG.normal(size=(3, 3)))[0]
    return vertices @ (turn * np.sign(np.linalg.det(turn))) + [30.0, -7.0, 0.4], faces


VERTICES, CLOSED = torus()
FIRST, SECOND = CLOSED[:160], CLOSED[160:]  # the two triangles of each quad
LOOSE = VERTICES[CLOSED].reshape(-1, 3), np.arange(3 * len(CLOSED)).reshape(-1, 3)
MESHES = {
    "closed": (VERTICES, CLOSED),
    "inside out": (VERTICES, CLOSED[:, ::-1]),
    "with a large hole": (VERTICES, np.concatenate([FIRST[70:], SECOND[70:]])),
    "with many small holes": (VERTICES, CLOSED[RNG.uniform(size=len(CLOSED)) < 0.9]),
    "loose triangles": LOOSE,
    "some faces turned over": (VERTICES, np.where(RNG.uniform(size=(len(CLOSED), 1)) < 0.1, CLOSED[:, ::-1], CLOSED)),
    "some faces twice": (VERTICES, np.concatenate([CLOSED, FIRST[:40], SECOND[:40], SECOND[:9]])),
    "two of unequal size": (
        np.concatenate([VERTICES, 0.01 * VERTICES + [29.0, -7.0, 0.0]]),
        np.concatenate([CLOSED, CLOSED + len(VERTICES)]),
    ),
    "soup": (VERTICES.mean(axis=0) + RNG.normal(size=(900, 3)), np.arange(900).reshape(-1, 3)),
    "sheet": (VERTICES * [1, 1, 0] + [0, 0, 0.4], CLOSED),
    "with faces without area": (VERTICES, np.concatenate([CLOSED, CLOSED[:50, [0, 0, 1]]])),
}
LOW, HIGH = VERTICES.min(axis=0), VERTICES.max(axis=0)
POINTS = RNG.uniform(LOW - 0.3, HIGH + 0.3, (400, 3))


@pytest.mark.statement(9, oracle="closed forms")
def test_a_solid_angle_is_that_of_an_octant_or_of_a_half_square():
    octant = np.eye(3)[[0, 2, 1]]  # seen from the origin its front, and from beyond its back
    assert solid_angle([0, 0, 0], octant) == pytest.approx(-np.pi / 2, rel=1e-14)
    assert solid_angle([0, 0, 0], octant[::-1]) == pytest.approx(np.pi / 2, rel=1e-14)
    # a square of half side s at the height h: 4 arcsin(s²/(s² + h²)), whatever the unit of length
    s, h = 0.7, 0.3
    square = np.array([[-s, -s, h], [s, -s, h], [s, s, h], [-s, s, h]])
    for unit in (1e-60, 1.0, 1e60):
        halves = solid_angle([0, 0, 0], unit * square[[[0, 1, 2], [0, 2, 3]]])
        assert np.sum(halves) == pytest.approx(4 * np.arcsin(s**2 / (s**2 + h**2)), rel=1e-14)
        assert halves[0] == pytest.approx(halves[1], rel=1e-13)


def test_a_solid_angle_is_zero_in_the_plane_of_the_triangle():
    triangle = np.array([[1, 0, 2], [4, 1, 3], [2, 5, 1.0]])
    weights = np.array([[1, 0, 0], [0.5, 0.5, 0], [0.25, 0.25, 0.5], [2, -0.5, -0.5]])
    assert solid_angle(weights @ triangle, triangle).tolist() == [0, 0, 0, 0]
    assert solid_angle([0, 0, 0], triangle[[0, 1, 1]]) == 0
    just_behind = solid_angle(triangle.mean(axis=0) - 1e-9 * np.array([-3, -2, 14.0]), triangle)
    assert just_behind == pytest.approx(2 * np.pi, abs=1e-7)


@pytest.mark.statement(9, oracle="the sum of the solid angles of all faces")
@pytest.mark.parametrize("name", MESHES)
def test_a_winding_number_is_a_sum_of_solid_angles(name):
    vertices, faces = MESHES[name]
    angles = solid_angle(POINTS[:40, None], vertices[faces])
    assert winding_number(POINTS[:40], vertices, faces) == pytest.approx(angles.sum(axis=1) / (4 * np.pi), abs=1e-13)


@pytest.fixture
def counted(monkeypatch):
    """Counts the solid angles that are summed."""
    count = []
    angles = solid_angles._half_solid_angles

    def counting(point, vertices, faces, area):
        count.append(len(point) * len(faces))
        return angles(point, vertices, faces, area)

    monkeypatch.setattr(solid_angles, "_half_solid_angles", counting)
    return count


@pytest.fixture
def summed(monkeypatch, counted):
    """Counts them, and tries caps for as few points as there are here."""
    for few in ("FEW_POINTS", "MANY_POINTS"):
        monkeypatch.setattr(solid_angles, few, 3)
    return counted


@pytest.mark.statement(9, oracle="the sum of the solid angles of all faces")
@pytest.mark.parametrize("name", MESHES)
def test_caps_change_no_winding_number_by_more_than_rounding(name, summed):
    vertices, faces = MESHES[name]
    every = solid_angles.sum_of_angles(POINTS, vertices, faces)
    summed.clear()
    # sums of some hundred angles, each with an error of 1e-16 or, for a sliver, a little more
    assert winding_number(POINTS, vertices, faces) == pytest.approx(every, abs=2e-13)
    most = {"soup": 1.0, "with many small holes": 0.9, "some faces turned over": 0.9}.get(name, 0.6)
    assert sum(summed) <= most * len(POINTS) * len(faces)  # and it takes fewer of them


def test_caps_serve_a_few_hundred_points_if_there_are_many_faces(counted):
    vertices, faces = torus(120, 100)
    points = RNG.uniform(vertices.min(axis=0), vertices.max(axis=0), (220, 3))
    winding_number(points, vertices, faces)
    assert sum(counted) < 0.6 * len(points) * len(faces)


@pytest.mark.statement(9, oracle="parity, with exact signs")
def test_caps_leave_the_winding_number_of_a_solid_whole(summed):
    far = RNG.uniform(LOW - 50, HIGH + 50, (100, 3))
    points = np.concatenate([POINTS, far])
    inside = inside_by_parity(points, VERTICES, CLOSED)
    assert 40 < np.sum(inside) < 300
    assert winding_number(points, VERTICES, CLOSED) == pytest.approx(inside.astype(float), abs=1e-13)
    # beyond the box there is nothing left to sum
    assert np.all(winding_number(HIGH + [[1.0, 0, 0], [0, 9, 2]] * np.ones((50, 1, 1)), VERTICES, CLOSED) == 0)


@pytest.mark.statement(9, oracle="the side from which a step of 1e-9 of the size was made")
def test_a_billionth_off_the_surface_caps_do_not_change_the_side(summed):
    corners = VERTICES[CLOSED]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    weights = np.array([[1, 1, 1], [8, 1, 1], [0.02, 0.49, 0.49]])
    on_face = (weights / weights.sum(axis=1, keepdims=True)) @ corners
    step = 1e-9 * np.ptp(VERTICES, axis=0).max() * normal[:, None]
    assert winding_number(on_face - step, VERTICES, CLOSED) == pytest.approx(np.ones((320, 3)), abs=1e-13)
    assert winding_number(on_face + step, VERTICES, CLOSED) == pytest.approx(np.zeros((320, 3)), abs=1e-13)


def test_on_the_surface_caps_give_the_angle_that_all_faces_give(summed):
    # coordinates in steps of 1/16, so that points lie on vertices, edges and faces exactly
    vertices = np.round(VERTICES * 16) / 16
    corners = vertices[CLOSED]
    on_it = np.concatenate(
        [vertices, (corners[:, 0] + corners[:, 1]) / 2, (corners + corners[:, [1, 2, 0]]).mean(axis=1)]
    )
    every = solid_angles.sum_of_angles(on_it, vertices, CLOSED)
    fractions = np.abs(every - np.round(every)) > 1e-9
    assert np.sum(fractions) > 50
    # where an angle is 0 or 2π by rounding alone, both are right, so whole numbers may differ there
    assert winding_number(on_it, vertices, CLOSED) == pytest.approx(every, abs=1e-12)


@pytest.mark.statement(9, oracle="libigl's winding number")
@pytest.mark.parametrize("name", ["closed", "with a large hole", "two of unequal size", "soup"])
def test_libigl_finds_the_same_winding_number_for_many_points(name, summed):
    theirs = oracle("igl").winding_number(*MESHES[name], POINTS)
    assert winding_number(POINTS, *MESHES[name]) == pytest.approx(theirs, abs=1e-12)


def test_the_cap_of_a_part_has_the_same_rim():
    def rim(faces):
        edges = solid_angles.directed_edges(faces)
        count = np.zeros((len(VERTICES), len(VERTICES)), dtype=int)
        np.add.at(count, tuple(edges.T), 1)
        return count - count.T

    part = np.concatenate([FIRST[20:90], SECOND[20:90], FIRST[20:30], SECOND[120:123, ::-1]])
    assert np.array_equal(rim(solid_angles.cap(part)), rim(part))
    assert solid_angles.cap(CLOSED).shape == (0, 3)
    assert len(solid_angles.cap(np.concatenate([FIRST[20:90], SECOND[20:90]]))) < 40
