"""P19 in the engines: rays. In space a ball stands for the circle, a cube for the square, a plane for the segment."""

from __future__ import annotations

from reference.engines.base import Engine
from reference.published import Answer, Answers, Published
from reference.query import Ray
from reference.scenario import Body, Box, HalfSpace, Shape, Sphere


def rays(case: Published, engine: Engine) -> Answers:
    """The three rays. No engine here knows segments, and none is asked when a moving body meets another."""
    width, height = case.values("box_half_extents")
    shapes: dict[str, tuple[Shape, str]] = {
        "ray_circle": (Sphere(case.value("circle_radius")), "circle_centre"),
        "ray_box": (Box((width, height, 1.0)), ""),
        "ray_segment": (HalfSpace((-1.0, 0.0, 0.0)), ""),
    }
    start, way = _in_space(case, "ray_origin"), _in_space(case, "ray_way")
    found = {
        name: engine.query(Ray(Body(name, shape, position=_in_space(case, place)), start, way))
        for name, (shape, place) in shapes.items()
    }
    asked = {name: Answer(share) for name, share in found.items()}
    absent = Answer(None, reason="it is asked for rays and for distances of balls and boxes only")
    return {name: asked.get(name, absent) for name in case.expected}


def _in_space(case: Published, name: str) -> tuple[float, float, float]:
    """A place or a way of the plane; its origin where there is no name."""
    x, y = case.values(name) if name else (0.0, 0.0)
    return x, y, 0.0
