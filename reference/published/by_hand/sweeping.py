"""Swept volumes, rays and distances by hand."""

from __future__ import annotations

import itertools
import math

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, X, Y
from reference.published.case import Published

LONG = 100.0
"""How long the ball and the cube of P30 are watched, s; those that meet do so within a second."""
TOUCHING = 2e-7
"""Distance at which those two count as touching, m: 8e-8 s at their speed, and a tenth of a millionth of their size."""
NEAR = 1e-7
"""Distance at which a point and a triangle, or two edges, count as touching, m."""


def box2d(case: Published, code: Implementation) -> Answers:
    """P19: the distance of two segments, the advancement of one to a box, and three rays."""
    ends = [_in_space(*np.reshape(case.numbers(name), (2, 2))) for name in ("segment_a", "segment_b")]
    distance, _ = code.function("separation_of_hulls")(*ends)
    hulls = as_answers(squared_distance=float(distance) ** 2, time_of_impact=_advanced(case, code))
    return {**hulls, **_rays(case, code)}


def _in_space(*points: Array | tuple[float, ...]) -> Array:
    """Points of the plane, with z = 0."""
    return np.array([(*point, 0.0) for point in points])


def _advanced(case: Published, code: Implementation) -> float:
    """When the moving segment touches the box, both as hulls of their corners."""
    wide, high = case.numbers("box_half_extents")
    box = _in_space((-wide, -high), (-wide, high), (wide, -high), (wide, high))
    place, way = (case.value(name) * X for name in ("segment_place", "segment_way"))
    segment = (_in_space((0.0, -high), (0.0, high)), place, way, STILL, 0.0)
    return float(code.function("sweep_convex")(*segment, box, STILL, STILL, STILL, 0.0, 1.0))


def _rays(case: Published, code: Implementation) -> Answers:
    """How far along the ray each of the three shapes lies, as a share of its length."""
    origin, way, centre = _in_space(*map(case.numbers, ("ray_origin", "ray_way", "circle_centre")))
    end = case.value("segment_half_length") * Y
    box = code.function("ray_box")(origin, way, [*case.numbers("box_half_extents"), 0.0])[0]
    circle = code.function("ray_sphere")(origin - centre, way, case.value("circle_radius"))
    segment = code.function("ray_capsule")(origin, way, -end, end, 0.0)
    return as_answers(ray_circle=float(circle), ray_box=float(box), ray_segment=float(segment))


def ball_and_cube(case: Published, code: Implementation) -> Answers:
    """P30: the ball as a point with a radius, the cube as the hull of its corners, both moving."""
    signs = np.array(list(itertools.product((-1, 1), repeat=3)))
    corners = signs * case.numbers("half_extents")

    def meet(place: str, velocity: str, cube_velocity: str) -> float:
        ball = (STILL[None], case.numbers(place), case.numbers(velocity), STILL, case.value("radius"))
        cube = (corners, STILL, case.numbers(cube_velocity), STILL, 0.0)
        return float(code.function("sweep_convex")(*ball, *cube, LONG, TOUCHING))

    passing = meet("place_in_passing", "velocity_in_passing", "cube_velocity_in_passing")
    return as_answers(
        meets_at=meet("position", "velocity", "cube_velocity"),
        passes=float(math.isinf(passing)),
        starts_inside=meet("place_inside", "velocity_in_passing", "cube_velocity_in_passing"),
    )


def primitives(case: Published, code: Implementation) -> Answers:
    """P31: each pair by the function that is made for it."""
    radius, way, still = case.value("radius"), case.value("way") * X, STILL
    ball = (still, way, radius)
    target, box = (case.value(name) * X for name in ("target_place", "box_place"))
    grown = np.add(case.numbers("box_half_extents"), radius)
    return {
        **_features(case, code),
        **as_answers(
            sphere_sphere=float(
                code.function("sweep_sphere_sphere")(*ball, target, still, case.value("target_radius"), 1.0)
            ),
            sphere_plane=float(code.function("sweep_sphere_plane")(*ball, -X, case.value("plane_place"), 1.0)),
            # it meets a face, where the box grown by the ball is a box as well
            sphere_box=float(code.function("ray_box")(-box, way, grown)[0]),
        ),
    }


def _features(case: Published, code: Implementation) -> Answers:
    """A point against a triangle and an edge against an edge, each moving straight, and both within one plane."""
    point_meets, edges_meet = code.function("vertex_face_impact"), code.function("edge_edge_impact")
    triangle, edge, other, flat_edge, flat_other = (
        np.reshape(case.numbers(name), (-1, 3))
        for name in ("triangle", "edge", "other_edge", "flat_edge", "flat_other_edge")
    )
    point, flat_point = (np.array(case.numbers(name)) for name in ("point", "flat_point"))
    ways = ("point_way", "triangle_way", "edge_way", "flat_way")
    point_way, triangle_way, edge_way, flat_way = (np.array(case.numbers(name)) for name in ways)
    return as_answers(
        point_triangle=float(point_meets(point, triangle, point + point_way, triangle + triangle_way, NEAR)),
        edge_edge=float(edges_meet(edge, other, edge + edge_way, other, NEAR)),
        in_one_plane=(
            float(point_meets(flat_point, triangle, flat_point + flat_way, triangle, NEAR)),
            float(edges_meet(flat_edge, flat_other, flat_edge + flat_way, flat_other, NEAR)),
        ),
    )
