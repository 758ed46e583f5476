"""Closed forms for solids, and the geometry of predictions, against exact rationals, sampling and other packages."""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np
import pytest
from oracles import oracle

from reference.catalogue.scenarios.concave_solid import HIGH, INNER_LEFT, LOW, RIGHT, channel, under_the_lid
from reference.catalogue.scenarios.convex_solid import SOLID
from reference.prediction import solids
from reference.prediction.answering import BULLETS_STEPS, on_a_grid
from reference.scene.scenario import Body
from reference.scene.surfaces import winding_number
from reference.solid_truth import after_a_wall, chord, lid

RNG = np.random.default_rng(7)
CHANNEL = channel(0.375)
BOTH = {"convex": SOLID, "concave": CHANNEL}
every_solid = pytest.mark.parametrize("solid", BOTH.values(), ids=BOTH)


def triangles(solid) -> np.ndarray:
    return solid.points[np.array(solid.faces)]


def places(solid, count: int) -> np.ndarray:
    low, high = solid.points.min(axis=0) - 0.2, solid.points.max(axis=0) + 0.2
    return RNG.uniform(low, high, (count, 3))


def inside_exactly(point, solid) -> bool:
    """Parity of the faces that a ray along a skew way crosses, in rationals: no place of the ray is rounded."""
    start = [Fraction(float(each)) for each in point]
    end = [x + w for x, w in zip(start, (Fraction(31), Fraction(17), Fraction(97)), strict=True)]
    crossed = 0
    for face in triangles(solid).tolist():
        a, b, c = ([Fraction(each) for each in corner] for corner in face)
        sides = [volume(a, b, c, start), volume(a, b, c, end)]
        turns = [volume(start, end, *pair) for pair in ((a, b), (b, c), (c, a))]
        crossed += sides[0] * sides[1] < 0 and len({turn > 0 for turn in turns}) == 1
    return crossed % 2 == 1


def volume(a, b, c, d) -> Fraction:
    (x, y, z), (u, v, w), (p, q, r) = ([m - n for m, n in zip(each, d, strict=True)] for each in (a, b, c))
    return x * (v * r - w * q) - y * (u * r - w * p) + z * (u * q - v * p)


@every_solid
def test_the_winding_number_agrees_with_parity_in_exact_rationals(solid):
    for point in places(solid, 60):
        found = winding_number(point, triangles(solid))
        assert found == pytest.approx(float(inside_exactly(point, solid)), abs=1e-12)


@every_solid
def test_a_distance_is_the_least_to_any_point_of_the_surface(solid):
    weights = np.array([(i, j, 40 - i - j) for i in range(41) for j in range(41 - i)]) / 40
    samples = np.einsum("wc,fcx->fwx", weights, triangles(solid)).reshape(-1, 3)
    for point in places(solid, 20):
        nearest = np.min(np.linalg.norm(samples - point, axis=-1))
        found = np.min(solids.distances(point, triangles(solid)))
        assert found <= nearest + 1e-12
        assert found == pytest.approx(nearest, abs=0.02)  # the samples are up to 2 cm apart


@every_solid
def test_the_hull_has_the_volume_that_qhull_finds(solid):
    spatial = oracle("scipy.spatial")
    hull, inner = solids.hull(solid.points), solid.points.mean(axis=0)
    assert all(solids.in_convex(point, hull) for point in 0.999 * solid.points + 0.001 * inner)
    deepest = solids.depth_or_gap(inner, hull)
    planes = spatial.ConvexHull(solid.points).equations
    assert deepest == pytest.approx(np.max(planes[:, :3] @ inner + planes[:, 3]), abs=1e-12)


def test_a_chord_lies_between_the_places_where_a_sampled_line_is_inside():
    corners = triangles(SOLID)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    offsets = np.sum(normals * corners[:, 0], -1)
    for start in places(SOLID, 10):
        way = 3 * (SOLID.points.mean(axis=0) - start)
        found = chord(start, way, normals, offsets)
        shares = np.linspace(-1, 2, 30001)
        behind = np.all((start + shares[:, None] * way) @ normals.T <= offsets, axis=-1)
        assert found == pytest.approx(np.count_nonzero(behind) * 1e-4 * np.linalg.norm(way), abs=2e-3)
    assert chord(np.array([9.0, 9, 9]), np.array([1.0, -1, 0.3]), normals, offsets) == 0


def test_the_lid_is_where_the_hull_begins():
    hull = solids.hull(CHANNEL.points)
    for x in (-0.1, 0.1, 0.4):
        height = lid((INNER_LEFT, HIGH), (RIGHT, LOW), x)
        assert solids.depth_or_gap(np.array([x, 0.0, height]), hull) == pytest.approx(0.0, abs=1e-12)
        assert under_the_lid(np.array([x, 0.0, height - 1e-6]))
        assert not under_the_lid(np.array([x, 0.0, height + 1e-6]))


@pytest.mark.slow
def test_the_pieces_of_the_channel_fill_it_and_nothing_else():
    pieces = [solids.hull(CHANNEL.points[list(piece)]) for piece in CHANNEL.pieces]
    for point in places(CHANNEL, 200):
        assert any(solids.in_convex(point, piece) for piece in pieces) == inside_exactly(point, CHANNEL)


def test_a_ray_stops_where_the_solid_is_a_margin_away():
    hull = solids.hull(SOLID.points)
    for start, end in itertools.product(2 * np.vstack([np.eye(3), -np.eye(3)]), SOLID.points + 1e-3):
        share = solids.advanced(start, end - start, hull, 0.02, 1e-13)
        if np.isfinite(share):
            touched = start + share * (end - start)
            assert solids.depth_or_gap(touched, hull) == pytest.approx(0.02, abs=1e-12)
            earlier = start + 0.99 * share * (end - start)
            assert solids.depth_or_gap(earlier, hull) > 0.02
            early = start + solids.advanced(start, end - start, hull, 0.02, 1e-2) * (end - start)
            assert -1e-12 <= solids.depth_or_gap(early, hull) - 0.02 <= 1e-2
        else:
            way = [start + part * (end - start) for part in np.linspace(0, 1, 101)]
            assert min(solids.depth_or_gap(place, hull) for place in way) > 0.019


def test_the_nearest_point_is_as_far_as_the_distance_says():
    hull = solids.hull(SOLID.points)
    for point in 2 * np.random.default_rng(3).normal(size=(60, 3)):
        nearest = solids.nearest_point(point, hull)
        assert np.linalg.norm(point - nearest) == pytest.approx(np.min(solids.distances(point, hull)), rel=1e-12)
        assert np.min(solids.distances(nearest, hull)) < 1e-12


def poses(count: int) -> list[Body]:
    quaternions = RNG.normal(size=(count, 4))
    quaternions /= np.linalg.norm(quaternions, axis=-1, keepdims=True)
    ways = RNG.uniform(-0.9, 0.9, (count, 3))
    return [
        Body(f"solid {number}", SOLID, position=tuple(way), orientation=tuple(quaternion))
        for number, (way, quaternion) in enumerate(zip(ways, quaternions, strict=True))
    ]


def test_two_convex_solids_are_as_far_apart_as_their_differences_are_from_the_origin():
    hull, found = solids.hull(SOLID.points), []
    for one, other in itertools.pairwise(poses(25)):
        first, second = (solids.placed(body, hull) for body in (one, other))
        a, b = (solids.placed(body, SOLID.points) for body in (one, other))
        differences = (a[:, None] - b).reshape(-1, 3)
        expected = solids.depth_or_gap(np.zeros(3), solids.hull(differences))
        found.append(solids.separation(first, second))
        assert found[-1] == pytest.approx(expected, abs=1e-12)
    assert min(found) < -0.1  # some overlap, and some are apart
    assert max(found) > 0.1


@pytest.mark.slow
def test_two_channels_are_as_far_apart_as_the_nearest_two_of_their_pieces():
    first, pieces = triangles(CHANNEL), [solids.hull(CHANNEL.points[list(piece)]) for piece in CHANNEL.pieces]
    for body in poses(40):
        placed = [solids.placed(body, piece) for piece in pieces]
        nearest = min(solids.separation(*pair) for pair in itertools.product(pieces, placed))
        if nearest > 0:
            assert solids.apart(first, solids.placed(body, first)) == pytest.approx(nearest, abs=1e-12)


def test_bullets_grid_moves_a_vertex_inwards_by_less_than_a_step():
    points, step = SOLID.points, np.ptp(SOLID.points, axis=0) / BULLETS_STEPS
    moved, middle = on_a_grid(points), (points.min(axis=0) + points.max(axis=0)) / 2
    assert np.all(np.abs(moved - points) < step * (1 + 1e-9))
    assert np.all(np.abs(moved - middle) <= np.abs(points - middle) + 1e-15)
    assert np.any(np.abs(moved - points) > 0.3 * step)


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
@pytest.mark.parametrize("slope", [0.1, 0.5])
def test_a_ball_off_a_wall_goes_the_way_of_two_parabolas(slope, restitution):
    normal, gravity, before, below = (np.cos(slope), np.sin(slope)), 9.81, 0.3, 0.2
    found = after_a_wall(before, below, normal, restitution, gravity)
    fallen = np.sqrt(2 * before / gravity)
    velocity = np.array([0.0, -gravity * fallen])
    towards = velocity @ normal
    velocity = velocity - towards * np.array(normal) - restitution * towards * np.array(normal)
    # The times at which the second parabola is at the floor are the roots of below + w t − g t²/2.
    times = np.roots([-gravity / 2, velocity[1], below])
    landing = float(times[times > 0][0])
    speed = velocity[1] - gravity * landing
    assert found.time == pytest.approx(fallen + landing, rel=1e-12)
    assert found.rebound == pytest.approx((restitution * speed) ** 2 / (2 * gravity), rel=1e-12, abs=1e-15)
    assert found.aside == pytest.approx(abs(velocity[0]), rel=1e-12)


def test_without_a_wall_a_ball_falls_for_the_time_that_gravity_takes():
    found = after_a_wall(0.5, 0.0, (0.0, 0.0), 0.4, 9.81)
    assert (found.time, found.rebound, found.aside) == pytest.approx((np.sqrt(1 / 9.81), 0.08, 0.0), rel=1e-12)
