"""Closed forms of avoidance, against hand-written code, sampled ways and balances that are solved for."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from reference import avoidance_truth as truth
from solutions.avoidance import nearest_approach, repelling_force


def test_straight_ways_come_as_near_as_the_hand_written_approach_says():
    rng = np.random.default_rng(3)
    places, speeds, radii = rng.normal(0, 3, (6, 3)), rng.normal(0, 1, (6, 3)), rng.uniform(0.1, 0.4, 6)
    one, other = (list(side) for side in zip(*itertools.combinations(range(6), 2), strict=True))
    _, gaps = nearest_approach(places[one], speeds[one], places[other], speeds[other], radii[one], radii[other])
    found = truth.least_gap_of_straight_ways(*(each.tolist() for each in (places, speeds, radii)))
    assert found == pytest.approx(gaps.min(), abs=1e-12)


def test_two_on_the_same_course_keep_their_gap():
    found = truth.least_gap_of_straight_ways([(0, 0, 0), (0, 2, 0)], [(1, 1, 0), (1, 1, 0)], [0.3, 0.5])
    assert found == pytest.approx(1.2)


def test_two_who_walk_alike_meet_after_half_of_their_gap():
    # 5 m and 4 m to go with a gap of 3 m: after 1.5 m each they meet, and 3.5 m are left of the longer way.
    assert truth.left_where_two_meet((5.0, 4.0), 3.0) == 3.5


@pytest.mark.parametrize("pull", [0.5, 3.0, 7.9])
def test_a_field_carries_a_pull_where_the_hand_written_force_is_as_large(pull):
    def left_over(gap: float) -> float:
        return float(repelling_force(gap, (0.0, 0.0, 1.0), 8.0, 0.6)[2]) - pull

    assert truth.gap_of_balance(8.0, 0.6, pull) == pytest.approx(brentq(left_over, 0.0, 0.6), abs=1e-9)
    assert truth.gap_of_balance(pull / 2, 0.6, pull) == 0.0
    assert math.isclose(truth.gap_of_balance(pull, 0.6, pull), 0.0)


def test_where_the_straight_line_misses_the_sphere_nothing_is_to_go_around():
    start, centre, radius = (-2.0, 0.3, 0.4), (0.1, 0.0, 0.0), 0.7
    for goal in ((1.5, 1.4, 1.1), (-1.9, 0.2, 2.0)):
        assert truth.way_around(start, goal, centre, radius) == pytest.approx(math.dist(start, goal), rel=1e-15)
    (x, y), rise = (-2.0, 2.0), 1e-9  # a line that touches the ball, and one that just does not
    touching, past = (truth.way_around((x, up, 0), (y, up, 0), (0, 0, 0), 1.0) for up in (1 - rise, 1 + rise))
    assert touching == pytest.approx(past, abs=1e-8)


def test_the_shortest_way_around_is_the_taut_string_over_a_sphere():
    start, goal, radius = (-2.0, 0.3, 0.4), (1.5, -0.2, 0.1), 0.7
    found = truth.way_around(start, goal, (0.0, 0.0, 0.0), radius)
    # A string in the plane of the three points, over a polygon of 2000 tangents.
    ends = np.array([start, goal])
    across = np.cross(*ends)
    side = np.cross(across, ends[0]) / np.linalg.norm(np.cross(across, ends[0]))
    ahead = ends[0] / np.linalg.norm(ends[0])
    flat = np.stack([ends @ ahead, ends @ side], axis=-1)
    angles = np.linspace(*np.arctan2(flat[:, 1], flat[:, 0]), 2000)
    on_sphere = radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)

    def taut(first: int, last: int) -> float:
        return float(np.linalg.norm(np.diff([flat[0], *on_sphere[first:last], flat[1]], axis=0), axis=-1).sum())

    touching = [np.arccos(radius / np.linalg.norm(end)) for end in flat]
    whole = abs(angles[-1] - angles[0])
    first, last = (round(2000 * share / whole) for share in (touching[0], whole - touching[1]))
    assert found == pytest.approx(taut(first, last), abs=2e-6)
    assert found < min(taut(first - 40, last + 40), taut(first - 40, last))
