"""Published distances and times of impact in the engines, by their own distances of two bodies.

No engine is asked directly when a moving body meets another. Conservative advancement finds the time of impact from
distances: a body at the distance d that moves at the speed v cannot touch before d/v, so it may move on for that long.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from reference.arrays import Array
from reference.checks import Vector
from reference.engines import pybullet_settings
from reference.engines.base import Engine
from reference.published.answers import Answer, Answers, answer_within
from reference.published.case import Published
from reference.scene.query import Distance
from reference.scene.scenario import Body, Box, HalfSpace, Sphere

NEAR = 1e-6
"""Distance at which two bodies count as touching, m, and to which an engine finds a distance by iteration."""
MOST = 100
"""Moves at most; where a ball meets a face, a corner or a ball head-on, two are enough."""
NO_FEATURES = "it is not asked for the distance of a point and a triangle, or of two edges"


def box_below_plane(case: Published, engine: Engine) -> Answers:
    """P29: the distance of a box and a half-space, negative where they overlap."""
    ground = Body("ground", HalfSpace())
    x, y, z = case.numbers("size")
    turns = np.reshape(case.numbers("orientation"), (-1, 4)).tolist()
    boxes = [
        Body("box", Box((x / 2, y / 2, z / 2)), position=(0.0, 0.0, height), orientation=tuple(turn))
        for height, turn in zip(case.numbers("height"), turns, strict=True)
    ]
    return {"distance": Answer(tuple(engine.query(Distance(box, ground)) for box in boxes))}


def ball_and_cube(case: Published, engine: Engine) -> Answers:
    """P30: the ball moves as seen from the cube, which stays."""
    cube = Body("cube", Box(_vector(case, "half_extents")))

    def meet(place: str, velocity: str, cube_velocity: str) -> float:
        ball = Body("ball", Sphere(case.value("radius")), position=_vector(case, place))
        relative = np.subtract(case.numbers(velocity), case.numbers(cube_velocity))
        return _time_of_impact(engine, ball, relative, cube)

    passing = ("velocity_in_passing", "cube_velocity_in_passing")
    speed = math.dist(case.numbers("velocity"), case.numbers("cube_velocity"))
    # Bullet makes a box smaller by its margin and rounds it with that: a corner is short by √3 − 1 of the margin
    short = (math.sqrt(3) - 1) * pybullet_settings.MARGIN if engine.name == "pybullet" else 0.0
    at_corner = answer_within(
        case, "meets_at", meet("position", "velocity", "cube_velocity"), 2 * NEAR / speed, _why(engine)
    )
    if short:
        reason = "Bullet rounds the corners of a box by its margin, so that the ball meets this one later"
        at_corner = replace(at_corner, shift=short / speed, shift_reason=reason, shift_tolerance=2 * NEAR / speed)
    return {
        "meets_at": at_corner,
        "passes": Answer(float(math.isinf(meet("place_in_passing", *passing)))),
        "starts_inside": Answer(meet("place_inside", *passing)),
    }


def swept_ball(case: Published, engine: Engine) -> Answers:
    """P31: the ball against a ball, a half-space and a box; the rest has no question that an engine takes."""
    ball, way = Body("ball", Sphere(case.value("radius"))), (case.value("way"), 0.0, 0.0)
    ahead = {name: (case.value(name), 0.0, 0.0) for name in ("target_place", "plane_place", "box_place")}
    targets = {
        "sphere_sphere": Body("target", Sphere(case.value("target_radius")), position=ahead["target_place"]),
        "sphere_plane": Body("plane", HalfSpace((-1.0, 0.0, 0.0)), position=ahead["plane_place"]),
        "sphere_box": Body("box", Box(_vector(case, "box_half_extents")), position=ahead["box_place"]),
    }
    found = {
        name: answer_within(
            case, name, _time_of_impact(engine, ball, np.array(way), target), 2 * NEAR / way[0], _why(engine)
        )
        for name, target in targets.items()
    }
    return found | {name: Answer(None, reason=NO_FEATURES) for name in case.expected if name not in found}


def _why(engine: Engine) -> str:
    return f"{engine.title}'s distances and the advancement are each good for 1 µm"


def _time_of_impact(engine: Engine, ball: Body, velocity: Array, other: Body) -> float:
    """Instant at which a body with a constant velocity, m/s, is `NEAR` another, s; infinity where it gets away."""
    speed, time = float(np.linalg.norm(velocity)), 0.0
    farthest = math.inf
    for _ in range(MOST):
        place = tuple((np.array(ball.position) + time * velocity).tolist())
        distance = engine.query(Distance(replace(ball, position=place), other))
        if distance < NEAR:
            return time
        if distance > farthest:  # two convex bodies that move apart never meet
            return math.inf
        farthest, time = distance, time + distance / speed
    raise AssertionError(f"{ball.name} is still {distance} m from {other.name} after {MOST} moves")


def _vector(case: Published, name: str) -> Vector:
    """Three numbers of the set-up."""
    x, y, z = case.numbers(name)
    return x, y, z
