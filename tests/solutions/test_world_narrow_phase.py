"""Where any two pieces touch: against hulls of differences, from elsewhere, and in another engine."""

from __future__ import annotations

import numpy as np
import pytest
from oracles import oracle
from pieces_in_touch import ALL, about, core, each, outside, place, radius, scene, touch, way_out

from solutions.world.hull_pairs import BIAS
from solutions.world.shapes import BOX, CAPSULE, HALF_SPACE, POLYHEDRON, SPHERE, Placed

# Any two pieces


@each(*(kinds for kinds in ALL if HALF_SPACE not in kinds))
def test_deepest_place_is_as_deep_as_the_shortest_way_out(kinds):
    oracle("scipy")
    a, b = scene(kinds, 30, 3, 1.2)
    found, exact, overlapping = touch(kinds, a, b), 0, 0
    for i in range(30):
        way = way_out(core(a, kinds[0], i), core(b, kinds[1], i)) - radius(a, kinds[0], i) - radius(b, kinds[1], i)
        depths = found.separation[found.pair == i]
        assert (depths.size > 0) == (way <= 0)
        if depths.size:
            # a face may be preferred to edges by the bias, of which the size is at most 2 m here
            assert depths.min() == pytest.approx(way, abs=2 * BIAS)
            overlapping += 1
            exact += abs(depths.min() - way) < 1e-12  # rounding of a hull of differences
    assert overlapping >= 10
    assert exact >= 0.8 * overlapping  # few are near enough to both for the bias to matter


@each(*ALL)
def test_contact_is_halfway_between_the_surfaces_along_the_normal(kinds):
    a, b = scene(kinds, 40, 4, 1.2)
    found = touch(kinds, a, b, 0.05)
    np.testing.assert_allclose(np.linalg.norm(found.normal, axis=1), 1.0, rtol=1e-14)
    assert np.all(found.separation <= 0.05)
    assert len(np.unique(found.pair)) >= 10
    ways = found.normal * found.separation[:, None] / 2
    for i, on_a, on_b in zip(found.pair, found.point + ways, found.point - ways, strict=True):
        for point, piece, kind in ((on_a, a, kinds[0]), (on_b, b, kinds[1])):
            # rounding; only a tilted capsule bulges beyond the place where a face cuts its core
            assert outside(point, piece, kind, i) <= 1e-12
            assert kind == CAPSULE or outside(point, piece, kind, i) >= -1e-12


@each((SPHERE, SPHERE), (CAPSULE, CAPSULE), (BOX, BOX), (POLYHEDRON, POLYHEDRON))
def test_swapping_two_pieces_turns_the_normal_and_nothing_else(kinds):
    a, b = scene(kinds, 30, 5, 1.2)
    found, swapped = touch(kinds, a, b), touch(kinds, b, a)

    def in_space_order(places, sign):
        rows = np.column_stack([places.pair, places.point, sign * places.normal, places.separation])
        return rows[np.lexsort(np.round(rows, 9).T[::-1])]

    # rounding, where other faces are clipped
    np.testing.assert_allclose(in_space_order(found, 1), in_space_order(swapped, -1), atol=1e-12)
    assert len(found.pair) >= 15


@each(*ALL)
def test_turning_both_pieces_turns_the_contacts_with_them(kinds):
    a, b = scene(kinds, 30, 6, 1.2)
    turn, shift = about([3.0, -1, 2], 77), np.array([0.4, -1.5, 2.0])

    def moved(piece):
        return Placed(
            piece.position @ turn.T + shift,
            turn @ piece.rotation,
            piece.size,
            piece.vertices @ turn.T + shift,
            piece.faces,
        )

    before, after = touch(kinds, a, b, 0.02), touch(kinds, moved(a), moved(b), 0.02)
    np.testing.assert_array_equal(before.pair, after.pair)
    np.testing.assert_array_equal(before.feature, after.feature)
    # some roundings of numbers of order one, some of them divided by a small distance
    np.testing.assert_allclose(after.point, before.point @ turn.T + shift, atol=1e-12)
    np.testing.assert_allclose(after.normal, before.normal @ turn.T, atol=1e-12)
    np.testing.assert_allclose(after.separation, before.separation, atol=1e-12)


@each(*ALL)
def test_contacts_of_a_pair_do_not_depend_on_other_pairs(kinds):
    pieces = scene(kinds, 12, 7, 0.9)
    together = touch(kinds, *pieces, 0.1)
    key = together.pair * 65536 + together.feature
    assert np.all(np.diff(key) > 0)  # in order, and no feature twice
    assert together.feature.min() >= 0
    assert together.feature.max() < 65536
    for i in range(12):
        alone = touch(
            kinds, *(Placed(*(value[i : i + 1] for value in piece[:4]), piece.faces) for piece in pieces), 0.1
        )
        for one, all_of_them in zip(alone[1:], together[1:], strict=True):
            np.testing.assert_array_equal(one, all_of_them[together.pair == i])


@each(*ALL)
def test_a_smaller_margin_leaves_out_distant_contacts_alone(kinds):
    a, b = scene(kinds, 30, 8, 1.3)
    wide, narrow = touch(kinds, a, b, 0.3), touch(kinds, a, b, 0.0)
    near = wide.separation <= 0
    assert 0 < np.count_nonzero(near) < len(near)
    for few, many in zip(narrow, wide, strict=True):
        np.testing.assert_array_equal(few, many[near])


@each(*ALL)
def test_no_pairs_and_pairs_far_apart_have_no_contacts(kinds):
    far = place(kinds[0], [[0, 0, 50.0]]), place(kinds[1], [[0, 0, 0.0]])
    none = (Placed(*(value[:0] for value in piece[:4]), piece.faces) for piece in far)
    for found in (touch(kinds, *far, 0.1), touch(kinds, *none, 0.1)):
        assert found.point.shape == found.normal.shape == (0, 3)
        assert found.pair.shape == found.separation.shape == found.feature.shape == (0,)


# Against an engine


@pytest.mark.slow
@each((SPHERE, SPHERE), (SPHERE, CAPSULE), (CAPSULE, CAPSULE), (SPHERE, BOX), (CAPSULE, BOX), (BOX, BOX))
def test_pieces_are_as_far_apart_as_in_pybullet(kinds):
    bullet = oracle("pybullet")
    a, b = scene(kinds, 200, 11, 1.4)
    found, compared = touch(kinds, a, b, 0.1), 0
    client = bullet.connect(bullet.DIRECT)
    try:
        for i in range(200):
            bodies = [in_bullet(bullet, client, piece, kind, i) for piece, kind in ((a, kinds[0]), (b, kinds[1]))]
            theirs = bullet.getClosestPoints(*bodies, 0.1, physicsClientId=client)
            ours = found.separation[found.pair == i]
            nearest = min((contact[8] for contact in theirs), default=np.inf)
            if ours.size and -0.2 < nearest < 0.1:
                # theirs ends its search at some 1e-4 m; ours may prefer a face by the bias, of a size up to 1.9 m
                assert ours.min() == pytest.approx(nearest, abs=2.5e-3)
                compared += 1
            for body in bodies:
                bullet.removeBody(body, physicsClientId=client)
    finally:
        bullet.disconnect(client)
    assert compared >= 15


def in_bullet(bullet, client, piece, kind, i):
    r, half, _ = piece.size[i]
    shape = {
        SPHERE: {"shapeType": bullet.GEOM_SPHERE, "radius": r},
        CAPSULE: {"shapeType": bullet.GEOM_CAPSULE, "radius": r, "height": 2 * half},
        BOX: {"shapeType": bullet.GEOM_BOX, "halfExtents": piece.size[i].tolist()},
    }[kind]
    number = bullet.createCollisionShape(**shape, physicsClientId=client)
    return bullet.createMultiBody(
        1.0, number, -1, piece.position[i].tolist(), quaternion(piece.rotation[i]), physicsClientId=client
    )


def quaternion(rotation):
    """In PyBullet's order x, y, z, w."""
    from scipy.spatial.transform import Rotation  # noqa: PLC0415

    return Rotation.from_matrix(rotation).as_quat().tolist()
