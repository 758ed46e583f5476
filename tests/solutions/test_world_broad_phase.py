"""The broad phase of the world: pairs of boxes that overlap, beside a comparison of all with all."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solutions.world.broad_phase import FARTHEST, FEW, pairs_in_grid

INFINITE = math.inf
# Sums of numbers with few digits are exact, so that many boxes of the examples touch.
PLACE = st.integers(-12, 12).map(lambda value: value / 4)
EDGE = st.sampled_from([0.0, 0.25, 0.5, 0.5, 0.5, 0.75, 4.0, INFINITE])
BOX = st.tuples(PLACE, PLACE, PLACE, EDGE, EDGE, EDGE, st.integers(-1, 1))


def all_with_all(lower, upper, group=None) -> np.ndarray:
    """The pairs that overlap, in a loop over all pairs and in plain Python."""
    group = [0] * len(lower) if group is None else group
    rows = [(*low, *high) for low, high in zip(np.asarray(lower).tolist(), np.asarray(upper).tolist(), strict=True)]
    pairs = [
        (i, j)
        for i, (a, b, c, d, e, f) in enumerate(rows)
        for j, (p, q, r, s, t, u) in enumerate(rows[i + 1 :], i + 1)
        if group[i] == group[j] and a <= s and p <= d and b <= t and q <= e and c <= u and r <= f
    ]
    return np.array(pairs, dtype=int).reshape(-1, 2)


def cubes(rng: np.random.Generator, count: int, room, edge) -> tuple[np.ndarray, np.ndarray]:
    """Boxes with their centres anywhere in a room, and edges up to a third shorter than the given ones."""
    centre = rng.uniform(0, room, (count, 3))
    half = np.broadcast_to(edge, (count, 1)) * rng.uniform(1 / 3, 1 / 2, (count, 3))
    return centre - half, centre + half


@given(st.lists(BOX, max_size=40), st.sampled_from([0, FEW // 3 + 1, FEW + 1]))
def test_the_grid_finds_what_a_comparison_of_all_boxes_finds(boxes, crowd):
    """A crowd in each group, far away, decides on the way: no grid, a grid of small groups, or one with columns."""
    rows = np.array([*boxes, *[(99.0, 99 + k, 99, 0.5, 0.5, 0.5, g) for k in range(crowd) for g in (-1, 0, 1)]])
    rows = rows.reshape(-1, 7)
    lower, upper, group = rows[:, :3], rows[:, :3] + rows[:, 3:6], rows[:, 6].astype(int)
    for labels in (None, group):
        assert np.array_equal(pairs_in_grid(lower, upper, labels), all_with_all(lower, upper, labels))


@pytest.mark.parametrize("spread", [0.0, 0.5, 1.5])
def test_boxes_of_many_sizes_between_planes_meet_all_their_partners(spread):
    """Sizes scatter by factors of 1, some 3 and some 20, in both directions, among five half-spaces."""
    rng = np.random.default_rng(1)
    lower, upper = cubes(rng, 300, (3.0, 2.0, 1.0), 0.2 * np.exp(spread * rng.normal(size=(300, 1))))
    below, above = np.full((5, 3), -INFINITE), np.full((5, 3), INFINITE)
    above[0, 2] = above[1, 0] = above[2, 1] = 0.1
    below[3, 0], below[4, 1] = 2.9, 1.9
    lower, upper = np.vstack([below, lower]), np.vstack([above, upper])
    pairs = pairs_in_grid(lower, upper)
    assert len(pairs) > 300
    assert np.array_equal(pairs, all_with_all(lower, upper))


def test_boxes_that_touch_overlap_and_by_a_last_digit_less_they_do_not():
    """A lattice of cubes with an edge of 1/10, whose sums are rounded: in each direction, a neighbour touches."""
    corner = np.argwhere(np.ones((7, 5, 3))) - np.array([3, 2, 1])
    lower, upper = 0.1 * corner, 0.1 * (corner + 1)
    apart = np.abs(corner[:, None] - corner).max(axis=-1)
    touching = np.argwhere(np.triu(apart <= 1, 1))
    assert np.array_equal(pairs_in_grid(lower, upper), touching)
    assert not len(pairs_in_grid(lower, np.nextafter(upper, -INFINITE)))


def test_boxes_that_touch_across_a_rounded_column_are_found():
    """A box begins just below 0 and ends where the next begins; by rounding, they begin two of its widths apart."""
    width, least = 0.3, np.nextafter(0.0, -1.0)
    lower, upper = np.zeros((FEW + 3, 3)), np.full((FEW + 3, 3), width / 2)
    lower[2:, 2] = 1 + np.arange(FEW + 1)  # so many others, one above the other, that there are columns
    upper[2:, 2] = lower[2:, 2] + 0.5
    lower[:2, 0], upper[:2, 0] = (least, width), (width, 1.5 * width)
    assert math.floor(width / width) - math.floor(least / width) == 2
    assert pairs_in_grid(lower, upper).tolist() == [[0, 1]]


@pytest.mark.parametrize("far", [1e3, 1e7, 1e17, 1e300])
def test_one_box_far_away_neither_hides_pairs_nor_makes_others(far):
    rng = np.random.default_rng(2)
    lower, upper = cubes(rng, 200, 1.0, 0.2)
    expected = all_with_all(lower, upper)
    lower[77], upper[77] = (far, -far, far), (far, -far, far)
    pairs = expected[~np.any(expected == 77, axis=1)]
    assert np.array_equal(pairs_in_grid(lower, upper), pairs)


def test_two_heaps_beyond_the_last_column_are_searched_all_the_same():
    """All columns beyond the last count as that one, on either side of the middle, which one more heap is."""
    rng = np.random.default_rng(3)
    lower, upper = cubes(rng, 150, 1.0, 0.2)
    shift = np.repeat([[-4.0, 0, 0], [0, 0, 0], [0, 5, 1]], 50, axis=0) * FARTHEST
    assert np.array_equal(pairs_in_grid(lower + shift, upper + shift), all_with_all(lower + shift, upper + shift))


def test_each_scene_of_an_ensemble_finds_what_it_finds_alone():
    """Scenes of 1 to 60 boxes in the same room, each over a ground of its own, in any order."""
    rng = np.random.default_rng(4)
    group = np.repeat([7, -3, 10**12, 0, 5], [1, 3, 33, 50, 60])
    lower, upper = cubes(rng, len(group), 1.0, 0.3)
    first = np.unique(group, return_index=True)[1]
    lower[first], upper[first] = -INFINITE, (INFINITE, INFINITE, 0.1)
    mixed = rng.permutation(len(group))
    lower, upper, group = lower[mixed], upper[mixed], group[mixed]
    alone = [members[pairs_in_grid(lower[members], upper[members])]
             for members in (np.flatnonzero(group == each) for each in np.unique(group))]  # fmt: skip
    together = np.concatenate(alone)
    together = together[np.lexsort(together.T[::-1])]
    assert len(together) > 100
    assert np.array_equal(pairs_in_grid(lower, upper, group), together)


def test_boxes_in_one_place_are_all_pairs():
    count = FEW + 8
    every = np.argwhere(np.triu(np.ones((count, count)), 1))
    for edge in (0.0, 0.3, 1e200):
        lower = np.tile([0.1, -0.2, 0.3], (count, 1))
        assert np.array_equal(pairs_in_grid(lower, lower + edge), every)
    whole = np.full((count, 3), INFINITE)
    assert np.array_equal(pairs_in_grid(-whole, whole), every)


def test_no_box_and_a_single_box_have_no_pairs():
    for count in (0, 1):
        pairs = pairs_in_grid(np.zeros((count, 3)), np.ones((count, 3)), np.zeros(count, dtype=int))
        assert (pairs.shape, pairs.dtype) == ((0, 2), np.int64)


def test_a_crowd_is_searched_without_a_look_at_all_pairs():
    """All pairs would not fit in memory: cubes in a row, each touching two, far from the origin and from one more."""
    count = 200_000
    lower = np.full((count, 3), 1e9)
    lower[1:, 1] += np.random.default_rng(5).permutation(count - 1)
    lower[0] = 1e15
    pairs = pairs_in_grid(lower, lower + 1)
    assert np.all(np.abs(np.diff(lower[pairs, 1], axis=1)) == 1)
    assert len(pairs) == count - 2


@pytest.mark.parametrize(
    ("lower", "upper", "group", "says"),
    [
        ([[0, math.nan, 0]], [[1, 1, 1]], None, "lower must not be above upper"),
        ([[0, 0, 0]], [[1, 1, math.nan]], None, "lower must not be above upper"),
        ([[0, 0, 0]], [[1, -1, 1]], None, r"not \[0. 0. 0.\] and \[ 1. -1.  1.\]"),
        ([[0, INFINITE, 0]], [[1, INFINITE, 1]], None, "lower must not be above upper"),
        ([[0, 0]], [[1, 1]], None, r"the shape \(n, 3\)"),
        ([0, 0, 0], [1, 1, 1], None, r"the shape \(n, 3\)"),
        ([[0, 0, 0]], [[1, 1, 1], [2, 2, 2]], None, r"not \(1, 3\) and \(2, 3\)"),
        ([[0, 0, 0]], [[1, 1, 1]], [0, 1], r"group must have the shape \(1,\), not \(2,\)"),
    ],
)
def test_corners_that_make_no_box_are_refused(lower, upper, group, says):
    with pytest.raises(ValueError, match=says):
        pairs_in_grid(lower, upper, group)
