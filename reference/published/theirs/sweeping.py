"""Published cases of swept volumes, rays and distances."""

from __future__ import annotations

from reference.published.case import Published

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
    ),
)
