"""P19 in the engines: rays and a distance, with solids in space for the case's shapes in the plane.

A ball replaces the circle, a cube the square, and a half-space the segment that the ray meets. Boxes replace the two
other segments. The first box fills the far side of its segment and the second ends where its segment does, so that the
nearest points are the same.
"""

from __future__ import annotations

from reference.engines.base import Engine
from reference.published.answers import Answer, Answers, answer_within
from reference.published.case import Published
from reference.scene.query import Distance, Ray
from reference.scene.scenario import Body, Box, HalfSpace, Shape, Sphere

THICKNESS = 0.05
"""Half of the boxes' thickness, m; the distance does not depend on it."""
ITERATED = 1e-6
"""How far off a distance may be that an engine finds by iteration, m."""


def rays_and_distance(case: Published, engine: Engine) -> Answers:
    """P19: the three rays and the distance. No engine here is asked when a moving body meets another."""
    width, height = case.numbers("box_half_extents")
    shapes: dict[str, tuple[Shape, str]] = {
        "ray_circle": (Sphere(case.value("circle_radius")), "circle_centre"),
        "ray_box": (Box((width, height, 1.0)), ""),
        "ray_segment": (HalfSpace((-1.0, 0.0, 0.0)), ""),
    }
    start, way = _in_space(case, "ray_origin"), _in_space(case, "ray_way")
    found = {
        name: Answer(engine.query(Ray(Body(name, shape, position=_in_space(case, place)), start, way)))
        for name, (shape, place) in shapes.items()
    }
    distance = engine.query(Distance(*_segments(case)))
    reason = "the nearest points are found by iteration, to 1 µm"
    return found | {
        "squared_distance": answer_within(case, "squared_distance", distance**2, 2 * distance * ITERATED, reason),
        "time_of_impact": Answer(None, reason="it is not asked when a moving body meets another"),
    }


def _segments(case: Published) -> tuple[Body, Body]:
    """A box with the first segment, along y, in its face towards +x; one with the second, along x, as its middle."""
    x, low, _, high = case.numbers("segment_a")
    far, y, near, _ = case.numbers("segment_b")
    first = Box((THICKNESS, (high - low) / 2, THICKNESS))
    second = Box((abs(far - near) / 2, THICKNESS, THICKNESS))
    return (
        Body("first", first, position=(x - THICKNESS, (low + high) / 2, 0.0)),
        Body("second", second, position=((far + near) / 2, y, 0.0)),
    )


def _in_space(case: Published, name: str) -> tuple[float, float, float]:
    """A point or a vector of the plane, in space; the origin where there is no name."""
    x, y = case.numbers(name) if name else (0.0, 0.0)
    return x, y, 0.0
