from __future__ import annotations

import numpy as np
import pytest

from reference.published import published
from solutions.sweeping import ray_box, ray_capsule, ray_sphere, separation_of_hulls, sweep_boxes, sweep_convex


def in_space(*points):
    """Points of the plane, with z = 0."""
    return np.array([(*point, 0.0) for point in points])


@pytest.mark.statement(10, oracle="Box2D's unit test of the distance of two segments")
def test_two_segments_are_as_far_apart_as_in_box2d():
    case = published("P19")
    a, b = (in_space(case.setup[name][:2], case.setup[name][2:]) for name in ("segment_a", "segment_b"))
    squared = separation_of_hulls(a, b)[0] ** 2
    assert squared == pytest.approx(case.expected["squared_distance"], abs=case.tolerance["squared_distance"])


@pytest.mark.statement(10, oracle="Box2D's unit test of the time of impact")
def test_a_segment_swept_into_a_box_touches_it_when_box2d_says():
    case = published("P19")
    half, place, way = (case.setup[name] for name in ("box_half_extents", "segment_place", "segment_way"))
    expected, tolerance = case.expected["time_of_impact"], case.tolerance["time_of_impact"]
    still = np.zeros(3)
    slabs, _ = sweep_boxes([place, 0, 0], [way, 0, 0], [0, half[1], 0], still, still, [*half, 0], 1.0)
    assert slabs == expected
    segment = in_space((0, -half[1]), (0, half[1]))
    box = in_space(*((x, y) for x in (-half[0], half[0]) for y in (-half[1], half[1])))
    advanced = sweep_convex(segment, [place, 0, 0], [way, 0, 0], still, 0.0, box, still, still, still, 0.0, 1.0)
    assert advanced == pytest.approx(expected, abs=tolerance)


@pytest.mark.statement(10, oracle="Box2D's unit tests of rays")
def test_rays_meet_a_circle_a_box_and_a_segment_at_the_same_fractions_as_in_box2d():
    case = published("P19")
    origin, way, centre = in_space(case.setup["ray_origin"], case.setup["ray_way"], case.setup["circle_centre"])
    end = case.setup["segment_half_length"]
    found = {
        "ray_circle": ray_sphere(origin - centre, way, case.setup["circle_radius"]),
        "ray_box": ray_box(origin, way, [*case.setup["box_half_extents"], 0.0])[0],
        "ray_segment": ray_capsule(origin, way, [0, -end, 0], [0, end, 0], 0.0),
    }
    for name, fraction in found.items():
        assert fraction == pytest.approx(case.expected[name], abs=case.tolerance[name])
