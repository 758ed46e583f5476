"""Swept volumes by others."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published import Answers, Published, said
from reference.published.in_engines import questions

STILL = np.zeros(3)


def box2d(case: Published, code: Implementation) -> Answers:
    """P19: the distance of two segments, the advancement of one to a box, and three rays."""
    ends = [_in_space(*np.reshape(case.values(name), (2, 2))) for name in ("segment_a", "segment_b")]
    distance, _ = code.function("separation_of_hulls")(*ends)
    hulls = said(squared_distance=float(distance) ** 2, time_of_impact=_advanced(case, code))
    return {**hulls, **_rays(case, code)}


def _in_space(*points: Array | tuple[float, ...]) -> Array:
    """Points of the plane, with z = 0."""
    return np.array([(*point, 0.0) for point in points])


def _advanced(case: Published, code: Implementation) -> float:
    """When the moving segment touches the box, both as hulls of their corners."""
    wide, high = case.values("box_half_extents")
    box = _in_space((-wide, -high), (-wide, high), (wide, -high), (wide, high))
    place, way = (case.value(name) * np.eye(3)[0] for name in ("segment_place", "segment_way"))
    segment = (_in_space((0.0, -high), (0.0, high)), place, way, STILL, 0.0)
    return float(code.function("sweep_convex")(*segment, box, STILL, STILL, STILL, 0.0, 1.0))


def _rays(case: Published, code: Implementation) -> Answers:
    origin, way, centre = _in_space(*map(case.values, ("ray_origin", "ray_way", "circle_centre")))
    end = np.array([0.0, case.value("segment_half_length"), 0.0])
    box = code.function("ray_box")(origin, way, [*case.values("box_half_extents"), 0.0])[0]
    circle = code.function("ray_sphere")(origin - centre, way, case.value("circle_radius"))
    segment = code.function("ray_capsule")(origin, way, -end, end, 0.0)
    return said(ray_circle=float(circle), ray_box=float(box), ray_segment=float(segment))


CASES = (
    Published(
        number=19,
        title="Nearest points of two segments, a segment swept into a box, and rays against three shapes",
        statement=10,
        kind="cross-engine",
        source="Box2D 3 (Erin Catto; github.com/erincatto/box2d), "
        "its unit tests test/test_distance.c and test/test_shape.c",
        setup={
            "segment_a": (-1.0, -1.0, -1.0, 1.0),
            "segment_b": (2.0, 0.0, 1.0, 0.0),
            "box_half_extents": (1.0, 1.0),
            "segment_place": 2.0,
            "segment_way": -2.0,
            "ray_origin": (-4.0, 0.0),
            "ray_way": (8.0, 0.0),
            "circle_centre": (1.0, 0.0),
            "circle_radius": 1.0,
            "segment_half_length": 1.0,
        },
        expected={
            "squared_distance": 4.0,
            "time_of_impact": 0.5,
            "ray_circle": 0.5,
            "ray_box": 0.375,
            "ray_segment": 0.5,
        },
        tolerance={
            "squared_distance": 1e-15,
            "time_of_impact": 1e-6,
            "ray_circle": 1e-15,
            "ray_box": 1e-15,
            "ray_segment": 1e-15,
        },
        reason="closed forms, exact in binary; conservative advancement stops one tolerance of 1e-6 m before the touch",
        note="In the plane, ends of segments as x, y, x, y. The swept segment is x = 2 and moves by −2; the "
        "ray's segment is x = 0. The circle that a ray meets half-way has its centre at (1, 0) and radius 1.",
        units={"squared_distance": "m²"},
        by_hand=box2d,
        in_engine=questions.rays_and_distance,
    ),
)
