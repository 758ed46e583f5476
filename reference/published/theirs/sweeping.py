"""Published cases of swept volumes, rays and distances."""

from __future__ import annotations

import math

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
    Published(
        number=30,
        title="A ball and a cube, both moving, meet at a corner",
        statement=10,
        kind="cross-engine",
        source="Parry (dimforge/parry), crates/parry3d/tests/geometry/time_of_impact3.rs, ball_cuboid_toi",
        setup={
            "radius": 1.0,
            "half_extents": (1.0, 1.0, 1.0),
            "position": (2.0, 2.0, 2.0),
            "velocity": (-0.5, -0.5, -0.5),
            "cube_velocity": (1.0, 1.0, 1.0),
            "place_in_passing": (3.0, 3.0, 3.0),
            "velocity_in_passing": (2.0, 2.0, 2.0),
            "cube_velocity_in_passing": (-1.0, 1.0, 1.0),
            "place_inside": (1.0, 1.0, 1.0),
        },
        expected={"meets_at": (math.sqrt(3) - 1) / (1.5 * math.sqrt(3)), "passes": 1.0, "starts_inside": 0.0},
        tolerance={"meets_at": 1.2e-7, "passes": 0.0, "starts_inside": 0.0},
        reason="the test compares numbers in single precision to one rounding; the two others are a yes and an instant "
        "that is exact",
        note="The time is (√3 − 1)/‖v_ball − v_cube‖: the corner is √3 from the cube's centre, the ball's centre "
        "2 √3. The ball that passes moves away for ever; one that overlaps the cube at the start meets it at 0.",
        units={"meets_at": "s", "starts_inside": "s"},
    ),
    Published(
        number=31,
        title="A ball swept into a ball, a plane and a box, a point into a triangle and an edge into an edge",
        statement=10,
        kind="cross-engine",
        source="DART (dartsim/dart), tests/unit/collision/native/test_ccd.cpp, SphereCastSphere.DirectHit, "
        "SphereCastPlane.HitFromAbove and SphereCastBox.TranslatedBox; test_primitive_ccd.cpp, "
        "PointTriangleCcd.BothMoving, EdgeEdgeCcdExact.CrossingRootAtHalf, and CoplanarInteriorCrossing of both",
        setup={
            "radius": 0.5,
            "way": 10.0,
            "target_radius": 1.0,
            "target_place": 5.0,
            "plane_place": 5.0,
            "box_half_extents": (1.0, 1.0, 1.0),
            "box_place": 7.0,
            "triangle": (-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0),
            "point": (0.0, 0.0, 1.0),
            "point_way": (0.0, 0.0, -1.0),
            "triangle_way": (0.0, 0.0, 0.5),
            "edge": (-1.0, 0.0, 0.5, 1.0, 0.0, 0.5),
            "edge_way": (0.0, 0.0, -1.0),
            "other_edge": (0.0, -1.0, 0.0, 0.0, 1.0, 0.0),
            "flat_point": (-2.0, 0.0, 0.0),
            "flat_edge": (-2.0, -1.0, 0.0, -2.0, 1.0, 0.0),
            "flat_way": (4.0, 0.0, 0.0),
            "flat_other_edge": (-1.0, 0.0, 0.0, 1.0, 0.0, 0.0),
        },
        expected={
            "sphere_sphere": 0.35,
            "sphere_plane": 0.45,
            "sphere_box": 0.55,
            "point_triangle": 2 / 3,
            "edge_edge": 0.5,
            "in_one_plane": (0.375, 0.25),
        },
        tolerance={
            "sphere_sphere": 1e-6,
            "sphere_plane": 1e-6,
            "sphere_box": 1e-6,
            "point_triangle": 1e-2,
            "edge_edge": 1e-6,
            "in_one_plane": 0.05,
        },
        reason="the tolerances of the tests; conservative advancement may stop before the touch, for a point and a "
        "triangle by a hundredth of the way",
        note="The figures are shares of the way. The sphere of radius 0.5 moves 10 m towards what it meets, and both"
        " of the other moving parts move straight within one step. In one plane, the volume that a point and a"
        " triangle or two edges span is zero all the time, so that its root does not give the instant at which they"
        " meet.",
        origin="dart",
        labels={"in_one_plane": ("point and triangle", "edge and edge")},
    ),
)
