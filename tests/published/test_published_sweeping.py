from __future__ import annotations

import numpy as np
import pytest

from reference.published.theirs import published
from solutions.sweeping import ray_box


@pytest.mark.statement(10, oracle="P19: Box2D's unit tests of distance, time of impact and rays")
def test_segments_boxes_and_rays_meet_as_in_box2d(as_published):
    as_published("P19")


@pytest.mark.statement(10, oracle="Box2D's unit test of the time of impact")
def test_the_slab_test_finds_the_time_of_box2d_for_a_segment_and_a_box():
    case = published("P19")
    half = np.array([*case.numbers("box_half_extents"), 0.0])
    place, way = case.values("segment_place", "segment_way")
    slabs, _ = ray_box([place, 0, 0], [way, 0, 0], half * [1, 2, 1])  # grown by the segment, which is as high
    assert slabs == case.expected["time_of_impact"]


@pytest.mark.statement(10, oracle="P30: Parry's ball and cube")
def test_a_ball_and_a_cube_that_both_move_meet_as_in_parry_or_pass(as_published):
    found = as_published("P30")["meets_at"][0]
    assert found <= published("P30").expected["meets_at"]  # conservative advancement is never late


@pytest.mark.statement(10, oracle="P31: DART's own tests of continuous detection")
def test_a_swept_ball_a_point_and_an_edge_meet_what_they_meet_in_dart(as_published):
    as_published("P31")
