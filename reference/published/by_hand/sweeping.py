"""Swept volumes, rays and distances by hand."""

from __future__ import annotations

import numpy as np

from reference.arrays import Array
from reference.engines.implementation import Implementation
from reference.published.answers import Answers, as_answers
from reference.published.by_hand.axes import STILL, X, Y
from reference.published.case import Published


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
